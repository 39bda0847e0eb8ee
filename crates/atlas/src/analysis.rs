//! Finite elements on subdivision basis functions: one problem on the levels of a mesh, and predicted rates.

use crate::compare::compare;
use crate::error::Error;
use crate::progress::Progress;
use crate::schemes::{SchemeName, Tuner};
use crate::table::Table;
use eigenring_iga::{Ends, Norms, Options, Outcome, Problem, Study, accepts, predicted, solution};
use eigenring_scheme::user::Reading;
use eigenring_surface::{Mesh, Rules};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Poisson's equation with a manufactured solution.
    Poisson,
    /// The projection in the mean square.
    L2,
    /// Poisson's equation with a linear solution, which must be met.
    PatchTest,
}

impl Task {
    fn name(self) -> &'static str {
        match self {
            Task::Poisson => "poisson",
            Task::L2 => "l2",
            Task::PatchTest => "patch-test",
        }
    }

    fn problem(self) -> Problem {
        match self {
            Task::Poisson | Task::PatchTest => Problem::Poisson,
            Task::L2 => Problem::L2,
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
    /// How many levels, from 1.
    pub levels: usize,
    /// Quadrature and boundary.
    pub options: Options,
}

/// The most levels: the last has 16384 elements for each face.
const MOST_LEVELS: usize = 8;

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
    predicted: [f64; 4],
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
    rules: &Rules,
    fits: impl Fn(f64) -> Result<(), E>,
    progress: &dyn Progress,
) -> Result<Answer, E> {
    let range = |what: &'static str, given: String, accepted: String| Error::Range { what, given, accepted };
    let name = match request.task {
        Task::PatchTest => "lin",
        Task::Poisson | Task::L2 => &request.solution,
    };
    let Some(u) = solution::named(name) else {
        return Err(range("solution", name.to_owned(), solution::NAMES.join(", ")).into());
    };
    if !(1..=MOST_LEVELS).contains(&request.levels) {
        return Err(range("levels", request.levels.to_string(), format!("1 to {MOST_LEVELS}")).into());
    }
    let refused = |error: eigenring_iga::Error| {
        use eigenring_iga::Error as Iga;
        // what is wrong with the mesh is wrong in its file
        match error {
            Iga::Range { .. } | Iga::NotBicubic(_) | Iga::Lambda { .. } => Error::from(error),
            _ => Error::from(error).in_file(path),
        }
    };
    let study = Study::new(mesh, rules).map_err(refused)?;
    if study.steps > 0 {
        progress.note(&format!(
            "{} Catmull-Clark steps come first: they separate extraordinary vertices",
            study.steps
        ));
    }
    fits(study.bytes(request.levels - 1))?;
    let level = |level: usize| study.level(level, request.task.problem(), &u, &request.options);
    let outcomes = (0..request.levels).map(level).collect::<Result<_, _>>();
    Ok(Answer {
        request: Request {
            solution: name.to_owned(),
            ..request.clone()
        },
        path: path.to_owned(),
        scheme: rules.definition().name(),
        outcomes: outcomes.map_err(refused)?,
        predicted: study.predicted(request.options.ends),
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
            "boundary": match self.request.options.ends {
                Ends::Open => "open",
                Ends::Natural => "natural",
            },
            "gauss": self.request.options.gauss,
            "depth": self.request.options.depth.map_or(json!("auto"), Value::from),
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
