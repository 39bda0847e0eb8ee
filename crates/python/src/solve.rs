//! Model problems by the words in which Python asks for them, which are those of the command.

use crate::failure::Failure;
use crate::input::word;
use eigenring_atlas::analysis::{Basis, Membranes, Request, Task, spectra, study};
use eigenring_atlas::progress::Progress;
use eigenring_iga::{Dirichlet, Domain, Ends, Membrane, Options, Solver};
use eigenring_surface::Mesh;
use serde_json::Value;
use std::path::Path;

/// What is asked for, in words.
pub struct Asked {
    pub problem: String,
    pub solution: String,
    pub levels: usize,
    pub bc: Option<String>,
    pub boundary: String,
    pub dirichlet: Option<String>,
    pub gauss: usize,
    pub depth: Option<usize>,
    pub tail: String,
    pub solver: Option<String>,
    pub sphere: bool,
    pub count: Option<usize>,
}

/// The same as the library has it.
pub enum Question {
    Solve(Request),
    Eigenvalues(Membranes),
}

/// What the mesh is called in place of its file.
const MESH: &str = "mesh";

#[derive(Clone, Copy, PartialEq)]
enum Condition {
    Dirichlet,
    Neumann,
    Closed,
}

#[derive(Clone, Copy, PartialEq)]
enum Problem {
    Poisson,
    L2,
    Biharmonic,
    PatchTest,
    Spectrum,
}

impl Asked {
    /// The question, of which each argument has a meaning for the problem.
    ///
    /// # Errors
    /// Unknown words, and arguments without a meaning.
    pub fn question(&self) -> Result<Question, Failure> {
        let problems = [
            ("poisson", Problem::Poisson),
            ("l2", Problem::L2),
            ("biharmonic", Problem::Biharmonic),
            ("patch-test", Problem::PatchTest),
            ("spectrum", Problem::Spectrum),
        ];
        let problem = word("problem", &self.problem, &problems)?;
        let conditions = [
            ("dirichlet", Condition::Dirichlet),
            ("neumann", Condition::Neumann),
            ("closed", Condition::Closed),
        ];
        let bc = self.bc.as_ref().map(|bc| word("bc", bc, &conditions)).transpose()?;
        let domain = match (bc == Some(Condition::Closed), self.sphere) {
            (true, true) => Domain::Sphere,
            (true, false) => Domain::Closed,
            (false, true) => return Err(Failure::usage("sphere is for bc='closed'", "bc='closed', sphere=True")),
            (false, false) => Domain::Planar,
        };
        let methods = [("cholesky", Solver::Cholesky), ("multigrid", Solver::Multigrid)];
        let data = [("projection", Dirichlet::Projection), ("nitsche", Dirichlet::Nitsche)];
        let tails = [("drop", false), ("scaled", true)];
        let solver = self
            .solver
            .as_ref()
            .map(|solver| word("solver", solver, &methods))
            .transpose()?;
        let dirichlet = self
            .dirichlet
            .as_ref()
            .map(|given| word("dirichlet", given, &data))
            .transpose()?;
        let options = Options {
            ends: word(
                "boundary",
                &self.boundary,
                &[("open", Ends::Open), ("natural", Ends::Natural)],
            )?,
            dirichlet: dirichlet.unwrap_or(Dirichlet::Projection),
            gauss: self.gauss,
            depth: self.depth,
            scaled: word("tail", &self.tail, &tails)?,
            solver,
        };
        if problem == Problem::Spectrum {
            if dirichlet.is_some() || solver.is_some() {
                return Err(Failure::usage(
                    "a spectrum has no choice of dirichlet and solver",
                    "these with other problems",
                ));
            }
            return Ok(Question::Eigenvalues(Membranes {
                domain,
                membrane: match bc {
                    Some(Condition::Dirichlet) => Membrane::Held,
                    _ => Membrane::Free,
                },
                count: self.count.unwrap_or(20),
                levels: self.levels,
                options,
            }));
        }
        if self.count.is_some() {
            return Err(Failure::usage(
                "count has no meaning here",
                "count with problem='spectrum'",
            ));
        }
        let task = match (problem, bc.unwrap_or(Condition::Dirichlet)) {
            (Problem::Poisson, Condition::Dirichlet) => Task::Poisson,
            (Problem::Poisson, Condition::Neumann) => Task::Neumann,
            (Problem::Poisson, Condition::Closed) => Task::LaplaceBeltrami,
            (Problem::L2, Condition::Dirichlet | Condition::Closed) => Task::L2,
            (Problem::Biharmonic, Condition::Dirichlet) => Task::Biharmonic,
            (Problem::PatchTest, Condition::Dirichlet) => Task::PatchTest,
            _ => {
                return Err(Failure::usage(
                    "this problem has no choice of bc",
                    "bc with poisson and spectrum, bc='closed' with l2",
                ));
            }
        };
        if dirichlet.is_some() && !matches!(problem, Problem::Poisson | Problem::PatchTest) {
            return Err(Failure::usage(
                "dirichlet has no effect here",
                "dirichlet with poisson and patch-test",
            ));
        }
        Ok(Question::Solve(Request {
            task,
            solution: self.solution.clone(),
            domain,
            levels: self.levels,
            options,
        }))
    }
}

impl Question {
    /// What the command prints as JSON.
    ///
    /// # Errors
    /// Those of the study; what `fits` refuses.
    pub fn answer(
        &self,
        mesh: &Mesh,
        basis: &Basis,
        fits: impl Fn(f64) -> Result<(), Failure>,
        progress: &dyn Progress,
    ) -> Result<Value, Failure> {
        let path = Path::new(MESH);
        Ok(match self {
            Question::Solve(request) => study(request, path, mesh, basis, fits, progress)?.json(),
            Question::Eigenvalues(request) => spectra(request, path, mesh, basis, fits, progress)?.json(),
        })
    }
}
