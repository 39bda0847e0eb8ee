//! `eigenring tables`: the main job.

use crate::args::{Output, TuningArgs, Valences};
use crate::checkpoint::Checkpoints;
use crate::error::Error;
use crate::files;
use crate::progress::Terminal;
use clap::{Args, ValueEnum};
use eigenring_atlas::results::{self, FOLDER, Results, summary};
use eigenring_atlas::run::{Parameters, check, studies};
use eigenring_atlas::table::Format;
use eigenring_atlas::tension;
use eigenring_tune::study::Knots;
use eigenring_tune::sweep::{Options, Range};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Regenerate every coefficient table of the lambda-scheme from nothing, or the eigenvalue tables of the
/// tension scheme.
///
/// For each valence: tunes the stencils at 100 lambdas, finds the globally optimal lambda, fits the spline
/// stencils, and writes OUT/lambda/: the paper's tables and the samples as CSV, and tables.json with
/// everything at full precision. An interrupted run resumes when the same command is given again.
///
/// With --scheme tension: OUT/tension/ gets the leading eigenvalues of all local matrices of orders 3 to 22,
/// five initial tensions and levels 1 to 10, the smallest gaps among them, the exceptions, the paper's Table
/// 2 and characteristic meshes. Knots, tuning and --embed belong to the lambda-scheme alone.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring tables                         all of results/lambda, valences 3 to 20\n  eigenring tables --valences 5,6 --out /tmp/try\n  eigenring tables --starts full --format latex\n  eigenring tables --scheme tension        all of results/tension"
)]
pub struct Arguments {
    /// Whose tables
    #[arg(long, value_enum, default_value_t)]
    scheme: Tabulated,
    /// Valences: numbers and ranges, such as 3..20 or 3,5,8..10
    #[arg(long, value_name = "LIST", default_value = "3..20", allow_hyphen_values = true)]
    valences: Valences,
    /// Output folder; files go to its subfolder lambda or tension
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    out: PathBuf,
    /// Triple knots: detected from the samples, or those of the paper's Table 1
    #[arg(long, value_enum, default_value_t)]
    knots: KnotsArg,
    /// Also write the table that is compiled into the library
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "crates/scheme/data/lambda.json")]
    embed: Option<PathBuf>,
    /// Threads; by default one for each core. Results do not depend on it
    #[arg(long, value_name = "COUNT", value_parser = threads, allow_negative_numbers = true)]
    threads: Option<u16>,
    #[command(flatten)]
    tuning: TuningArgs,
    #[command(flatten)]
    output: Output,
}

/// The families with tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Tabulated {
    /// Ma, Wang and Ma 2023.
    #[default]
    Lambda,
    /// Fang, Ma and Wang.
    Tension,
}

/// See [`Knots`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum KnotsArg {
    /// From the samples.
    #[default]
    Detected,
    /// As tabulated.
    Paper,
}

fn threads(text: &str) -> Result<u16, String> {
    let count = text.parse().ok().filter(|count| (1..=1024).contains(count));
    count.ok_or_else(|| "accepted is 1 to 1024".to_owned())
}

/// Unfinished samples, below the results' folder.
const RESUME: &str = ".resume";

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let options = self.tuning.options();
        let knots = match self.knots {
            KnotsArg::Detected => Knots::Detected,
            KnotsArg::Paper => Knots::Paper,
        };
        let parameters = Parameters::new(self.valences.0, knots, &options, &Range::default());
        if self.scheme == Tabulated::Tension {
            let usual = Parameters::new(
                parameters.valences.clone(),
                Knots::Detected,
                &Options::default(),
                &Range::default(),
            );
            if parameters != usual || self.embed.is_some() {
                return Err(Error::usage(
                    "knots, tuning options and --embed belong to the tables of the lambda-scheme",
                    "--valences, --out, --threads and --format",
                ));
            }
            let parameters = tension::Parameters::new(parameters.valences);
            return on_threads(self.threads, || {
                eigenvalue_tables(parameters, &self.out, self.output.format())
            })?;
        }
        let results = on_threads(self.threads, || {
            regenerate(&parameters, &self.out, self.output.format())
        })??;
        if let Some(path) = &self.embed {
            let table = results::table(&results.valences, &parameters)?;
            files::write(path, table.to_json()?.as_bytes())?;
        }
        files::emit(None, summary(&results.valences).render(self.output.format()).as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Runs work on a pool of that many threads, or on one for each core.
fn on_threads<T: Send>(threads: Option<u16>, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
    let count = threads.map_or(0, usize::from);
    match rayon::ThreadPoolBuilder::new().num_threads(count).build() {
        Ok(pool) => Ok(pool.install(work)),
        Err(error) => Err(Error::usage(
            format!("cannot start {count} threads: {error}"),
            "a smaller number",
        )),
    }
}

/// Computes and writes everything below `out`.
pub fn regenerate(parameters: &Parameters, out: &Path, format: Format) -> Result<Results, Error> {
    check(parameters)?;
    let folder = out.join(FOLDER);
    files::check_writable(&folder)?;
    let resume = folder.join(RESUME);
    let kept = Checkpoints::open(&resume, parameters)?;
    let studies = studies(parameters, &kept, &Terminal)?;
    let results = Results::new(studies, parameters.clone())?;
    let mut all = results.files();
    if format == Format::Latex {
        all.extend(results.latex());
    }
    for (name, text) in all {
        files::write(&folder.join(name), text.as_bytes())?;
    }
    // only now nothing is left to resume
    drop(kept);
    files::remove_folder(&resume)?;
    Ok(results)
}

/// Computes and writes the tables of the tension scheme.
fn eigenvalue_tables(parameters: tension::Parameters, out: &Path, format: Format) -> Result<ExitCode, Error> {
    let folder = out.join(tension::FOLDER);
    files::check_writable(&folder)?;
    let results = tension::Results::new(parameters, &Terminal)?;
    let mut all = results.files();
    if format == Format::Latex {
        all.extend(results.latex());
    }
    for (name, text) in all {
        files::write(&folder.join(name), text.as_bytes())?;
    }
    files::emit(None, results.smallest_gaps().render(format).as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
