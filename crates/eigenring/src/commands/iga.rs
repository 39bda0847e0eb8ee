//! `eigenring iga`: Galerkin solutions on subdivision spaces.

use crate::args::{self, OneScheme};
use crate::error::Error;
use crate::memory;
use crate::output::Output;
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, Subcommand, ValueEnum};
use eigenring_atlas::analysis::{Request, Task as Kind, rates, study};
use eigenring_atlas::meshes;
use eigenring_atlas::table::{Format, pretty};
use eigenring_iga::{Ends, Options};
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
    /// Run although the levels may not fit into memory
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        match self.problem {
            Task::Poisson(solve) => solve.run(Kind::Poisson),
            Task::L2(solve) => solve.run(Kind::L2),
            Task::PatchTest(solve) => solve.run(Kind::PatchTest),
            Task::Rates(rates) => rates.run(),
        }
    }
}

/// Valences by default.
const USUAL: std::ops::RangeInclusive<usize> = 3..=12;

impl Rates {
    fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let scheme = self.scheme.name()?;
        let valences = match (&self.valences.valences, scheme.only_valence()?) {
            (Some(valences), _) => valences.closed()?.to_vec(),
            (None, Some(only)) => vec![only],
            (None, None) => USUAL.collect(),
        };
        self.output
            .emit(&rates(&scheme, &valences, &args::tuner())?.render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}

impl Solve {
    fn run(self, task: Kind) -> Result<ExitCode, Error> {
        self.threads.start()?;
        let format = self.output.format()?;
        let depth = match self.depth.as_str() {
            "auto" => None,
            text => {
                let depth = text.parse();
                Some(depth.map_err(|_| Error::range("depth", text, "auto and 1 to 200"))?)
            }
        };
        let request = Request {
            task,
            solution: self.solution,
            levels: self.levels,
            options: Options {
                ends: match self.boundary {
                    Beyond::Open => Ends::Open,
                    Beyond::Natural => Ends::Natural,
                },
                gauss: self.gauss,
                depth,
                scaled: self.tail == Tail::Scaled,
            },
        };
        let (mesh, notices) = meshes::read_surface(&self.file)?;
        notices.iter().for_each(|notice| note(notice));
        let scheme = self.scheme.name()?.into();
        let rules = meshes::rules(&scheme, &mesh, &[], &args::tuner())?;
        let fits = |bytes: f64| memory::check(bytes, self.force, &format!("{} levels", self.levels));
        let answer = study(&request, &self.file, &mesh, &rules, fits, &Terminal)?;
        let text = match format {
            Format::Json => pretty(&answer.json()),
            format => answer.table().render(format),
        };
        self.output.emit(&text)?;
        Ok(if answer.holds() {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        })
    }
}
