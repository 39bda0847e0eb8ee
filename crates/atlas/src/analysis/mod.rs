//! Finite elements on subdivision basis functions: one problem on the levels of a mesh, and predicted rates.

mod spectra;
pub mod studies;

pub use spectra::{Membranes, Spectra, spectra};

use crate::compare::compare;
use crate::error::Error;
use crate::meshes;
use crate::on_mesh::OnMesh;
use crate::progress::Progress;
use crate::schemes::{SchemeName, Tuner};
use crate::table::Table;
use eigenring_iga::{
    Dirichlet, Domain, Ends, Norms, Options, Outcome, Problem, Solver, Study, accepts, predicted, solution,
};
use eigenring_nonuniform::{Outside, Scheme};
use eigenring_scheme::user::Reading;
use eigenring_surface::{Mesh, Rules};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Poisson's equation with a manufactured solution.
    Poisson,
    /// The same with fluxes on the boundary.
    Neumann,
    /// Laplace and Beltrami's operator plus 1 on a closed surface.
    LaplaceBeltrami,
    /// A clamped plate.
    Biharmonic,
    /// The projection in the mean square.
    L2,
    /// Poisson's equation with a linear solution, which must be met.
    PatchTest,
}

impl Task {
    fn name(self) -> &'static str {
        match self {
            Task::Poisson | Task::Neumann | Task::LaplaceBeltrami => "poisson",
            Task::Biharmonic => "biharmonic",
            Task::L2 => "l2",
            Task::PatchTest => "patch-test",
        }
    }

    fn problem(self) -> Problem {
        match self {
            Task::Poisson | Task::PatchTest => Problem::Poisson,
            Task::Neumann => Problem::Neumann,
            Task::LaplaceBeltrami => Problem::LaplaceBeltrami,
            Task::Biharmonic => Problem::Biharmonic,
            Task::L2 => Problem::L2,
        }
    }

    /// What is known on the boundary.
    fn condition(self) -> Option<&'static str> {
        match self {
            Task::Poisson | Task::PatchTest | Task::Biharmonic => Some("dirichlet"),
            Task::Neumann => Some("neumann"),
            Task::LaplaceBeltrami => Some("closed"),
            Task::L2 => None,
        }
    }
}

/// What makes the spaces of a mesh.
#[derive(Debug)]
pub enum Basis {
    /// A scheme whose regular part is bicubic.
    Rules(Box<Rules>),
    /// A scheme with knot intervals.
    Intervals(Scheme, Outside),
}

impl Basis {
    /// That of a scheme on a mesh.
    ///
    /// # Errors
    /// Those of [`meshes::rules`].
    pub fn new(scheme: &OnMesh, mesh: &Mesh, outside: Outside, tuner: &Tuner<'_>) -> Result<Self, Error> {
        match scheme.name {
            SchemeName::NonUniform(scheme) => Ok(Basis::Intervals(scheme, outside)),
            _ => Ok(Basis::Rules(Box::new(meshes::rules(scheme, mesh, &[], tuner)?))),
        }
    }

    /// What the scheme is called.
    pub fn name(&self) -> String {
        match self {
            Basis::Rules(rules) => rules.definition().name(),
            Basis::Intervals(scheme, _) => scheme.to_string(),
        }
    }

    /// The spaces of a mesh.
    ///
    /// # Errors
    /// Those of [`Study`].
    pub fn study(&self, mesh: &Mesh, domain: Domain) -> Result<Study<'_>, eigenring_iga::Error> {
        match self {
            Basis::Rules(rules) => Study::new(mesh, rules, domain),
            Basis::Intervals(scheme, outside) => Study::with_intervals(mesh, *scheme, *outside, domain),
        }
    }
}

/// A problem on the first levels of a mesh.
#[derive(Clone, Debug)]
pub struct Request {
    /// What is solved.
    pub task: Task,
    /// A name of [`solution::NAMES`]; the patch test has its own.
    pub solution: String,
    /// What the mesh is the control mesh of.
    pub domain: Domain,
    /// How many levels, from 1.
    pub levels: usize,
    /// Quadrature and boundary.
    pub options: Options,
}

/// The most levels: the last has 262144 elements for each face.
const MOST_LEVELS: usize = 10;

/// What the errors of a linear solution must not exceed: L2, H1, H2. Rounding leaves some 1e-15 of it, and
/// each derivative divides by the size of elements.
const PATCH_TEST: [f64; 3] = [1e-12, 1e-11, 1e-9];

/// What was found.
#[derive(Clone, Debug)]
pub struct Answer {
    request: Request,
    path: PathBuf,
    scheme: String,
    outcomes: Vec<Outcome>,
    predicted: [Option<f64>; 4],
}

/// What is wrong with a mesh is wrong in its file.
fn refused(error: eigenring_iga::Error, path: &Path) -> Error {
    use eigenring_iga::Error as Iga;
    match error {
        Iga::Range { .. } | Iga::NotBicubic(_) | Iga::Lambda { .. } | Iga::NotH2 { .. } | Iga::Combination { .. } => {
            Error::from(error)
        }
        _ => Error::from(error).in_file(path),
    }
}

/// A mesh whose first levels can be solved on.
fn prepared<'a>(
    path: &Path,
    mesh: &Mesh,
    basis: &'a Basis,
    domain: Domain,
    levels: usize,
    progress: &dyn Progress,
) -> Result<Study<'a>, Error> {
    if !(1..=MOST_LEVELS).contains(&levels) {
        return Err(Error::Range {
            what: "levels",
            given: levels.to_string(),
            accepted: format!("1 to {MOST_LEVELS}"),
        });
    }
    let study = basis.study(mesh, domain).map_err(|error| refused(error, path))?;
    if study.steps > 0 {
        progress.note(&match basis {
            Basis::Rules(_) => format!(
                "{} first, so that extraordinary vertices and corners are apart",
                if study.steps == 1 {
                    "a step of Catmull-Clark comes".to_owned()
                } else {
                    format!("{} steps of Catmull-Clark come", study.steps)
                }
            ),
            Basis::Intervals(scheme, _) => format!(
                "level 0 is the net after {} of {scheme}: from then on rules at extraordinary vertices do not change",
                if study.steps == 1 {
                    "one level".to_owned()
                } else {
                    format!("{} levels", study.steps)
                }
            ),
        });
    }
    if !study.simple().is_empty() {
        let list: Vec<String> = study.simple().iter().map(ToString::to_string).collect();
        let list = list.join(", ");
        progress.note(&format!(
            "the simple rule was taken for want of an eigen-polyhedron at {list}"
        ));
    }
    Ok(study)
}

fn ends_name(ends: Ends) -> &'static str {
    match ends {
        Ends::Open => "open",
        Ends::Natural => "natural",
    }
}

/// Solves a problem on the levels of a mesh, whose file is named in errors. `fits` refuses the bytes that the
/// last level takes, if they are too many.
///
/// # Errors
/// [`Error::Range`] for an unknown solution and a number of levels; those of `fits` and of [`Study`].
pub fn study<E: From<Error>>(
    request: &Request,
    path: &Path,
    mesh: &Mesh,
    basis: &Basis,
    fits: impl Fn(f64) -> Result<(), E>,
    progress: &dyn Progress,
) -> Result<Answer, E> {
    let name = match request.task {
        Task::PatchTest => "lin",
        _ => &request.solution,
    };
    let Some(u) = solution::named(name) else {
        return Err(Error::Range {
            what: "solution",
            given: name.to_owned(),
            accepted: solution::NAMES.join(", "),
        }
        .into());
    };
    let study = prepared(path, mesh, basis, request.domain, request.levels, progress)?;
    fits(study.bytes(request.levels - 1, &request.options, None))?;
    let level = |level: usize| study.level(level, request.task.problem(), &u, &request.options);
    let outcomes = (0..request.levels).map(level).collect::<Result<_, _>>();
    Ok(Answer {
        request: Request {
            solution: name.to_owned(),
            ..request.clone()
        },
        path: path.to_owned(),
        scheme: basis.name(),
        outcomes: outcomes.map_err(|error| refused(error, path))?,
        predicted: study.predicted(request.task.problem(), request.options.ends),
    })
}

fn norms(of: &Norms) -> [(&'static str, f64); 4] {
    [("L2", of.l2), ("H1", of.h1), ("H2", of.h2), ("Linf", of.linf)]
}

/// A function of the norms of two outcomes by their names.
fn paired(of: &Norms, and: &Norms, f: fn(f64, f64) -> f64) -> Value {
    let pairs = norms(of).into_iter().zip(norms(and));
    Value::Object(
        pairs
            .map(|((name, a), (_, b))| (name.to_owned(), json!(f(a, b))))
            .collect(),
    )
}

impl Answer {
    /// Whether a patch test is passed; true of what is none.
    pub fn holds(&self) -> bool {
        let met = |outcome: &Outcome| {
            let error = [outcome.error.l2, outcome.error.h1, outcome.error.h2];
            error.iter().zip(PATCH_TEST).all(|(error, bound)| *error <= bound)
        };
        self.request.task != Task::PatchTest || self.outcomes.iter().all(met)
    }

    /// The errors of each level.
    pub fn table(&self) -> Table {
        let mut table = Table::new(["level", "dof", "L2", "H1", "H2", "Linf"]);
        for (level, outcome) in self.outcomes.iter().enumerate() {
            let mut row = vec![level.into(), outcome.dof.into()];
            row.extend(norms(&outcome.error).map(|(_, error)| error.into()));
            table.push(row);
        }
        table
    }

    /// Everything: errors absolute and relative, rates to the level before in `h = 2^-level`, predicted ones,
    /// seconds.
    pub fn json(&self) -> Value {
        let level = |(number, outcome): (usize, &Outcome)| {
            let before = number.checked_sub(1).map(|before| &self.outcomes[before]);
            let mut level = Map::new();
            level.insert("level".to_owned(), number.into());
            level.insert("h".to_owned(), 0.5_f64.powi(number as i32).into());
            level.insert("faces".to_owned(), outcome.faces.into());
            level.insert("dof".to_owned(), outcome.dof.into());
            for (name, error) in norms(&outcome.error) {
                level.insert(name.to_owned(), error.into());
            }
            let relative = paired(&outcome.error, &outcome.norm, |a, b| a / b);
            let rate = before.map(|before| paired(&outcome.error, &before.error, |a, b| (b / a).log2()));
            let [assembly, solve, errors] = outcome.seconds;
            level.insert("relative".to_owned(), relative);
            level.insert("rate".to_owned(), rate.unwrap_or_else(|| json!({})));
            level.insert(
                "solver".to_owned(),
                match outcome.solver {
                    Solver::Cholesky => "cholesky".into(),
                    Solver::Multigrid => "multigrid".into(),
                },
            );
            level.insert("iterations".to_owned(), json!(outcome.iterations));
            level.insert("quadrature_points".to_owned(), outcome.points.into());
            level.insert(
                "seconds".to_owned(),
                json!({ "assembly": assembly, "solve": solve, "errors": errors }),
            );
            Value::Object(level)
        };
        let levels: Vec<Value> = self.outcomes.iter().enumerate().map(level).collect();
        let [l2, h1, linf, h2] = self.predicted;
        json!({
            "mesh": self.path.display().to_string(),
            "scheme": self.scheme,
            "problem": self.request.task.name(),
            "solution": self.request.solution,
            "bc": self.request.task.condition(),
            "sphere": self.request.domain == Domain::Sphere,
            "boundary": ends_name(self.request.options.ends),
            "dirichlet": match self.request.options.dirichlet {
                Dirichlet::Projection => "projection",
                Dirichlet::Nitsche => "nitsche",
            },
            "gauss": self.request.options.gauss,
            "depth": self.request.options.depth.map_or(json!("auto"), Value::from),
            "tail": if self.request.options.scaled { "scaled" } else { "drop" },
            "levels": levels,
            "predicted": { "L2": l2, "H1": h1, "Linf": linf, "H2": h2 },
        })
    }
}

/// Lambda and the rates that it predicts in the open space, a row for each valence. On a mesh, vertices of
/// valence 4 are regular.
///
/// # Errors
/// A scheme that has no finite elements here; those of the scheme.
pub fn rates(scheme: &SchemeName, valences: &[usize], tuner: &Tuner<'_>) -> Result<Table, Error> {
    let mut table = Table::new(["scheme", "valence", "lambda", "L2", "H1", "Linf", "H2"]);
    let at_four = Rules::new(scheme.definition(Reading::default())?).lists_four();
    for &valence in valences {
        let rules = scheme.scheme(valence, tuner)?;
        if at_four || !accepts(&rules)? {
            return Err(eigenring_iga::Error::NotBicubic(rules.name().to_owned()).into());
        }
        let row = compare(std::slice::from_ref(scheme), &[valence], tuner)?.remove(0);
        let of = |lambda: f64| predicted(if valence == 4 { 0.0 } else { lambda });
        let rates = row.lambda.map(of);
        let mut cells = vec![row.scheme.as_str().into(), valence.into(), row.lambda.into()];
        cells.extend((0..4).map(|norm| rates.map(|rates| rates[norm]).into()));
        table.push(cells);
    }
    Ok(table)
}
