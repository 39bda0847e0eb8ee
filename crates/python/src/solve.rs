//! Model problems by the words in which Python asks for them, which are those of the command.

use crate::failure::Failure;
use eigenring_atlas::analysis::{Basis, Membranes, Request, Task, spectra, study};
use eigenring_atlas::progress::Progress;
use eigenring_iga::{Dirichlet, Domain, Ends, Membrane, Options, Solver};
use eigenring_surface::Mesh;
use serde_json::Value;
use std::path::Path;

/// What is asked for, in words.
pub struct Asked<'a> {
    pub problem: &'a str,
    pub solution: &'a str,
    pub levels: usize,
    pub bc: Option<&'a str>,
    pub boundary: &'a str,
    pub dirichlet: Option<&'a str>,
    pub gauss: usize,
    pub depth: Option<usize>,
    pub tail: &'a str,
    pub solver: Option<&'a str>,
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

/// What a word stands for.
fn named<T: Copy>(what: &str, given: &str, words: &[(&str, T)]) -> Result<T, Failure> {
    match words.iter().find(|(word, _)| *word == given) {
        Some((_, value)) => Ok(*value),
        None => {
            let accepted: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            Err(Failure::usage(format!("{what} is '{given}'"), accepted.join(", ")))
        }
    }
}

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

impl Asked<'_> {
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
        let problem = named("problem", self.problem, &problems)?;
        let conditions = [
            ("dirichlet", Condition::Dirichlet),
            ("neumann", Condition::Neumann),
            ("closed", Condition::Closed),
        ];
        let bc = self.bc.map(|bc| named("bc", bc, &conditions)).transpose()?;
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
            .map(|solver| named("solver", solver, &methods))
            .transpose()?;
        let dirichlet = self.dirichlet.map(|word| named("dirichlet", word, &data)).transpose()?;
        let options = Options {
            ends: named(
                "boundary",
                self.boundary,
                &[("open", Ends::Open), ("natural", Ends::Natural)],
            )?,
            dirichlet: dirichlet.unwrap_or(Dirichlet::Projection),
            gauss: self.gauss,
            depth: self.depth,
            scaled: named("tail", self.tail, &tails)?,
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
            solution: self.solution.to_owned(),
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
