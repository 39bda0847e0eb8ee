//! `eigenring iga`: Galerkin solutions on subdivision spaces.

use crate::args::{self, OneScheme};
use crate::error::Error;
use crate::output::Output;
use crate::progress::note;
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, Subcommand, ValueEnum};
use eigenring_atlas::compare::compare;
use eigenring_atlas::meshes;
use eigenring_atlas::table::{Format, Table};
use eigenring_iga::{Ends, Norms, Options, Outcome, Problem, Study, solution};
use eigenring_scheme::Lattice;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::ExitCode;

/// Solve on the basis functions of a subdivision scheme, and measure the errors.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make fan -N 6 -o fan6.obj\n  eigenring iga poisson fan6.obj --scheme lambda:lambda=0.39 --solution exp --levels 4\n  eigenring iga patch-test fan6.obj --scheme catmull-clark --tail scaled\n  eigenring iga rates --scheme catmull-clark -N 3..12"
)]
pub struct Arguments {
    #[command(subcommand)]
    problem: Task,
}

#[derive(Subcommand, Debug)]
enum Task {
    /// Poisson's equation with a manufactured solution
    Poisson(Solve),
    /// The projection in the mean square
    L2(Solve),
    /// Poisson's equation with a linear solution, which must be met: exit 1 if it is not
    PatchTest(Solve),
    /// The rates that the subdominant eigenvalue predicts, by valence
    Rates(Rates),
}

/// Which rates are asked for.
#[derive(Args, Debug)]
struct Rates {
    #[command(flatten)]
    scheme: OneScheme,
    #[command(flatten)]
    valences: OptionalValences,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Beyond {
    Open,
    Natural,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Tail {
    Drop,
    Scaled,
}

#[derive(Args, Debug)]
struct Solve {
    /// The control mesh, planar with z = 0: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: OneScheme,
    /// sin, exp, mix, lin or quadratic
    #[arg(long, value_name = "NAME", default_value = "exp")]
    solution: String,
    /// The number of levels, 1 to 8
    #[arg(long, default_value = "4")]
    levels: usize,
    /// The solution beyond the boundary
    #[arg(long, value_enum, default_value = "open")]
    boundary: Beyond,
    /// Gauss points of an element in each direction, 2 to 10
    #[arg(long, default_value = "4")]
    gauss: usize,
    /// Annuli at extraordinary vertices: auto or 1 to 200
    #[arg(long, value_name = "auto|M", default_value = "auto")]
    depth: String,
    /// What the annuli beyond the depth count
    #[arg(long, value_enum, default_value = "drop")]
    tail: Tail,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        match self.problem {
            Task::Poisson(solve) => solve.run("poisson", Problem::Poisson),
            Task::L2(solve) => solve.run("l2", Problem::L2),
            Task::PatchTest(solve) => Solve {
                solution: "lin".to_owned(),
                ..solve
            }
            .run("patch-test", Problem::Poisson),
            Task::Rates(rates) => rates.run(),
        }
    }
}

/// What the errors of a linear solution must not exceed: L2, H1, H2.
const PATCH_TEST: [f64; 3] = [1e-12, 1e-11, 1e-9];

fn norms(of: &Norms) -> [(&'static str, f64); 4] {
    [("L2", of.l2), ("H1", of.h1), ("H2", of.h2), ("Linf", of.linf)]
}

/// A level with its rates to the one before.
fn level(number: usize, outcome: &Outcome, before: Option<&Outcome>) -> Value {
    let pairs = |values: Vec<(&str, f64)>| -> Value {
        values
            .into_iter()
            .map(|(name, value)| (name.to_owned(), json!(value)))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    let beside = |other: &Norms, f: fn(f64, f64) -> f64| {
        let own = norms(&outcome.error).into_iter().zip(norms(other));
        pairs(own.map(|((name, a), (_, b))| (name, f(a, b))).collect())
    };
    let mut value = json!({
        "level": number,
        "h": 0.5_f64.powi(number as i32),
        "faces": outcome.faces,
        "dof": outcome.dof,
        "relative": beside(&outcome.norm, |a, b| a / b),
        "rate": before.map(|before| beside(&before.error, |a, b| (b / a).log2())),
        "quadrature_points": outcome.points,
        "seconds": {"assembly": outcome.seconds[0], "solve": outcome.seconds[1], "errors": outcome.seconds[2]},
    });
    for (name, error) in norms(&outcome.error) {
        value[name] = json!(error);
    }
    value
}

fn refused(error: eigenring_iga::Error) -> Error {
    const USUAL: &str = "planar meshes of quads with boundary, under a bicubic one-ring scheme";
    let text = error.to_string();
    let (message, accepted) = text.split_once("; accepted are ").unwrap_or((&text, USUAL));
    let accepted = eigenring_atlas::Accepted::Are(accepted.to_owned());
    Error::Atlas(eigenring_atlas::Error::refused(message.to_owned(), accepted))
}

/// Valences by default.
const USUAL: std::ops::RangeInclusive<usize> = 3..=12;

/// The objective E of the regular rule is 7e-23, of rounding alone; what is below this is regular. Empirical.
const REGULAR: f64 = 1e-16;

impl Rates {
    /// A row for each valence: lambda, and the rates in the open space.
    fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let scheme = self.scheme.name()?;
        let valences = match (&self.valences.valences, scheme.only_valence()?) {
            (Some(valences), _) => valences.closed()?.to_vec(),
            (None, Some(only)) => vec![only],
            (None, None) => USUAL.collect(),
        };
        let tuner = args::tuner();
        let mut table = Table::new(["scheme", "valence", "lambda", "L2", "H1", "Linf", "H2"]);
        for valence in valences {
            let rules = scheme.scheme(valence, &tuner)?;
            if rules.lattice() != Lattice::Vertex || rules.degree() != Some(3) {
                return Err(refused(eigenring_iga::Error::NotBicubic(rules.name().to_owned())));
            }
            let row = compare(std::slice::from_ref(&scheme), &[valence], &tuner)?.remove(0);
            // without an extraordinary vertex the spline's own rates hold: E of the regular rule is zero
            let regular = valence == 4 && row.total.is_some_and(|total| total < REGULAR);
            let rates = row
                .lambda
                .map(|lambda| eigenring_iga::predicted(if regular { 0.0 } else { lambda }));
            let mut cells = vec![row.scheme.as_str().into(), valence.into(), row.lambda.into()];
            cells.extend((0..4).map(|norm| rates.map(|rates| rates[norm]).into()));
            table.push(cells);
        }
        self.output.emit(&table.render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}

impl Solve {
    fn run(self, name: &str, problem: Problem) -> Result<ExitCode, Error> {
        self.threads.start()?;
        let format = self.output.format()?;
        let u = solution::named(&self.solution)
            .ok_or_else(|| Error::range("solution", &self.solution, solution::NAMES.join(", ")))?;
        if !(1..=8).contains(&self.levels) {
            return Err(Error::range("levels", self.levels, "1 to 8"));
        }
        let depth = match self.depth.as_str() {
            "auto" => None,
            text => Some(
                text.parse()
                    .map_err(|_| Error::range("depth", text, "auto and 1 to 200"))?,
            ),
        };
        let ends = match self.boundary {
            Beyond::Open => Ends::Open,
            Beyond::Natural => Ends::Natural,
        };
        let options = Options {
            ends,
            gauss: self.gauss,
            depth,
            scaled: self.tail == Tail::Scaled,
        };
        let (mesh, notices) = meshes::read_surface(&self.file)?;
        notices.iter().for_each(|notice| note(notice));
        let scheme = self.scheme.name()?.into();
        let rules = meshes::rules(&scheme, &mesh, &[], &args::tuner())?;
        let study = Study::new(&mesh, &rules).map_err(refused)?;
        if study.steps > 0 {
            note(&format!(
                "{} Catmull-Clark steps come first: they separate extraordinary vertices",
                study.steps
            ));
        }
        let mut outcomes: Vec<Outcome> = Vec::new();
        for level in 0..self.levels {
            outcomes.push(study.level(level, problem, &u, &options).map_err(refused)?);
        }
        let met = outcomes.iter().all(|outcome| {
            let error = [outcome.error.l2, outcome.error.h1, outcome.error.h2];
            error.iter().zip(PATCH_TEST).all(|(error, bound)| *error <= bound)
        });
        let levels: Vec<Value> = (0..outcomes.len())
            .map(|k| level(k, &outcomes[k], k.checked_sub(1).map(|before| &outcomes[before])))
            .collect();
        let text = match format {
            Format::Json => {
                // extrapolated beyond the boundary, no solution is better than its second derivatives there
                let most = match ends {
                    Ends::Open => [4.0, 3.0, 4.0, 2.0],
                    Ends::Natural => [2.5, 1.5, 2.0, 0.5],
                };
                let predicted = study.predicted();
                let [l2, h1, linf, h2]: [f64; 4] = std::array::from_fn(|norm| predicted[norm].min(most[norm]));
                let value = json!({
                    "mesh": self.file.display().to_string(),
                    "scheme": rules.definition().name(),
                    "problem": name,
                    "solution": self.solution,
                    "boundary": if ends == Ends::Open { "open" } else { "natural" },
                    "gauss": self.gauss,
                    "depth": self.depth,
                    "levels": levels,
                    "predicted": {"L2": l2, "H1": h1, "Linf": linf, "H2": h2},
                });
                format!("{value:#}\n")
            }
            _ => {
                let mut text = "level     dof          L2          H1          H2        Linf\n".to_owned();
                for (k, outcome) in outcomes.iter().enumerate() {
                    text += &format!("{k:5} {:7}", outcome.dof);
                    norms(&outcome.error)
                        .iter()
                        .for_each(|(_, error)| text += &format!(" {error:11.4e}"));
                    text.push('\n');
                }
                text
            }
        };
        self.output.emit(&text)?;
        Ok(if name == "patch-test" && !met {
            ExitCode::FAILURE
        } else {
            ExitCode::SUCCESS
        })
    }
}
