//! `eigenring tables`: the main job.

use super::{RESULTS, UNSTORED};
use crate::args::{self, TuningArgs};
use crate::checkpoint::Checkpoints;
use crate::error::Error;
use crate::files::{self, Written};
use crate::output::{FormatOption, Wide};
use crate::progress::{Terminal, say};
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, ValueEnum};
use eigenring_atlas::gallery::Gallery;
use eigenring_atlas::results::{self, FOLDER, Results, summary};
use eigenring_atlas::run::{Parameters, check, studies};
use eigenring_atlas::studies::Study;
use eigenring_atlas::table::{Format, Table, WIDTH};
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
///
/// With --scheme surfaces or tension-surfaces: OUT/surfaces/ or OUT/tension-surfaces/ gets pictures of limit
/// surfaces like those of the papers, with tables of curvature and of the spectra of features.
///
/// With --scheme nonuniform: OUT/nonuniform/ gets the maxima of blending functions, where eigen-polyhedra
/// exist, the gaps of Lemma 1 on HNUSS, and reflection lines.
///
/// With --study: OUT/studies/ gets what is shown of the lambda-scheme beyond the papers' tables. optimality:
/// that no admissible stencil at lambda_C* is better than the tuned one, for valences 5 to 20, with the
/// weight and without, by interval branch and bound. margin: which objectives, distances of the next
/// eigenvalue from mu and signs of curvature go together at valences 5 to 8 (a Pareto front). normalisation:
/// lambda_C* and its stencil where no scale of the eigenvectors enters the objective, beside those of the
/// paper.
/// large: spline tables of the valences from 21 to 64. sharp: splines with as many coefficients that lose
/// less against the samples, beside those of the paper's knots. fine: what those with more coefficients lose
/// that lambda:fine,lambda=L stands for.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring tables                         all of results/lambda, valences 3 to 20\n  eigenring tables --valences 5,6          two valences, below eigenring-out\n  eigenring tables --starts full --format latex\n  eigenring tables --scheme tension        all of results/tension"
)]
pub struct Arguments {
    /// Whose tables
    #[arg(long, value_enum, default_value_t)]
    scheme: Tabulated,
    /// What is shown of the lambda-scheme beyond the papers' tables
    #[arg(long, value_enum, conflicts_with = "scheme")]
    study: Option<StudyArg>,
    #[command(flatten)]
    valences: OptionalValences,
    /// Output folder; files go to its subfolder lambda, tension or studies. By default results, or
    /// eigenring-out with --valences or any option that changes the numbers
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Knots: triple ones detected from the samples, those of the paper's Table 1, or those with which the
    /// splines lose least, by a fit that looks at the objective (sharp); or the detected ones with as many
    /// single ones as it takes to lose less than a hundredth (fine)
    #[arg(long, value_enum, default_value_t)]
    knots: KnotsArg,
    /// Also write the table that is compiled into the library; by default where it is compiled from
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    embed: Option<Option<PathBuf>>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    tuning: TuningArgs,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    format: FormatOption,
}

/// The families with tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Tabulated {
    /// Ma, Wang and Ma 2023.
    #[default]
    Lambda,
    /// Fang, Ma and Wang.
    Tension,
    /// Pictures and curvature of surfaces of the lambda-scheme.
    Surfaces,
    /// Pictures of surfaces of the tension scheme, and spectra of its features.
    TensionSurfaces,
    /// Pictures and counts of schemes with knot intervals.
    Nonuniform,
}

/// See [`Study`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StudyArg {
    /// That no stencil is better than the tuned ones.
    Optimality,
    /// What it costs to keep eigenvalues apart and curvatures of one sign.
    Margin,
    /// The best lambda without a scale of eigenvectors.
    Normalisation,
    /// Spline tables of the valences from 21 to 64.
    Large,
    /// Splines with as many coefficients that lose less.
    Sharp,
    /// Splines with more coefficients.
    Fine,
}

impl StudyArg {
    fn study(self) -> Study {
        match self {
            StudyArg::Optimality => Study::Optimality,
            StudyArg::Margin => Study::Margin,
            StudyArg::Normalisation => Study::Normalisation,
            StudyArg::Large => Study::Large,
            StudyArg::Sharp => Study::Sharp,
            StudyArg::Fine => Study::Fine,
        }
    }
}

/// See [`Knots`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum KnotsArg {
    /// From the samples.
    #[default]
    Detected,
    /// As tabulated.
    Paper,
    /// Those, and the fit, that raise the objective least above the samples; slow.
    Sharp,
    /// Detected, with more single knots where it takes them.
    Fine,
}

/// Unfinished samples, below the results' folder.
const RESUME: &str = ".resume";

/// Where `--embed` writes by default: the table of all valences, as the library carries it.
const EMBEDDED: &str = "crates/scheme/data/lambda.json";

/// Where `--knots fine --embed` does.
const EMBEDDED_FINE: &str = "crates/scheme/data/lambda-fine.json";

/// The valences that are tabulated by default.
fn usual_valences() -> Vec<usize> {
    (3..=20).collect()
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let options = self.tuning.options();
        let knots = match self.knots {
            KnotsArg::Detected => Knots::Detected,
            KnotsArg::Paper => Knots::Paper,
            KnotsArg::Sharp => Knots::Sharp,
            KnotsArg::Fine => Knots::Fine,
        };
        let valences = match &self.valences.valences {
            Some(valences) => valences.closed()?.to_vec(),
            None => usual_valences(),
        };
        let parameters = Parameters::new(valences.clone(), knots, &options, &Range::default());
        let usual = Parameters::new(valences, Knots::Detected, &Options::default(), &Range::default());
        // what is stored has the default parameters, and nothing else takes its place unasked
        let stored = self.valences.valences.is_none() && parameters == usual;
        let default = if stored { RESULTS } else { UNSTORED };
        let out = self.out.clone().unwrap_or_else(|| default.into());
        let format = self.format.format();
        let wide = self.wide.of(format)?;
        let gallery = match self.scheme {
            Tabulated::Surfaces => Some(Gallery::Lambda),
            Tabulated::TensionSurfaces => Some(Gallery::Tension),
            Tabulated::Nonuniform => Some(Gallery::NonUniform),
            _ => None,
        };
        if let Some(gallery) = gallery {
            if parameters != usual || self.embed.is_some() || self.valences.valences.is_some() {
                return Err(Error::usage(
                    "valences, knots, tuning options and --embed belong to tables of coefficients and eigenvalues",
                    "--out and --threads",
                ));
            }
            self.threads.start()?;
            return surfaces(gallery, &out);
        }
        if let Some(study) = self.study {
            if parameters != usual || self.embed.is_some() || self.valences.valences.is_some() {
                return Err(Error::usage(
                    "valences, knots, tuning options and --embed belong to tables of coefficients and eigenvalues",
                    "--out and --threads",
                ));
            }
            self.threads.start()?;
            return studied(study.study(), &out);
        }
        if self.scheme == Tabulated::Tension {
            if parameters != usual || self.embed.is_some() {
                return Err(Error::usage(
                    "knots, tuning options and --embed belong to the tables of the lambda-scheme",
                    "--valences, --out, --threads and --format",
                ));
            }
            self.threads.start()?;
            return eigenvalue_tables(tension::Parameters::new(parameters.valences), &out, format, wide);
        }
        let fine = Parameters {
            knots: Knots::Fine,
            ..usual.clone()
        };
        let embed = match &self.embed {
            Some(None) if self.valences.valences.is_none() && parameters == fine => Some(EMBEDDED_FINE.into()),
            Some(None) if !stored => {
                let message = format!(
                    "{EMBEDDED} is the table of all valences with the default options, {EMBEDDED_FINE} that with \
                     --knots fine"
                );
                return Err(Error::usage(message, "--embed FILE"));
            }
            Some(path) => Some(path.clone().unwrap_or_else(|| EMBEDDED.into())),
            None => None,
        };
        self.threads.start()?;
        let (results, mut written) = regenerate(&parameters, &out, format)?;
        if let Some(path) = embed {
            let table = results::table(&results.valences, &parameters)?;
            written.write(path, table.to_json()?.as_bytes())?;
        }
        let words = results::in_words(&results.valences);
        finish(&summary(&results.valences), &words, &written, format, wide)
    }
}

/// Prints a table; what it says in words and the files go to standard error.
fn finish(table: &Table, words: &str, written: &Written, format: Format, wide: bool) -> Result<ExitCode, Error> {
    let text = match format {
        Format::Text if !wide => table.fitted(WIDTH),
        _ => table.render(format),
    };
    files::emit(None, text.as_bytes())?;
    if format == Format::Text {
        say(words);
    }
    written.say();
    Ok(ExitCode::SUCCESS)
}

/// Computes and writes everything below `out`.
fn regenerate(parameters: &Parameters, out: &Path, format: Format) -> Result<(Results, Written), Error> {
    check(parameters)?;
    let folder = out.join(FOLDER);
    files::check_writable(out, &folder)?;
    let resume = folder.join(RESUME);
    let kept = Checkpoints::open(&resume, parameters)?;
    let studies = studies(parameters, &kept, &Terminal)?;
    let results = Results::new(studies, parameters.clone())?;
    let mut all = results.files();
    if format == Format::Latex {
        all.extend(results.latex());
    }
    let written = write_all(&folder, all)?;
    // only now nothing is left to resume
    drop(kept);
    files::remove_folder(&resume)?;
    Ok((results, written))
}

/// Computes and writes the tables of the tension scheme.
fn eigenvalue_tables(
    parameters: tension::Parameters,
    out: &Path,
    format: Format,
    wide: bool,
) -> Result<ExitCode, Error> {
    let folder = out.join(tension::FOLDER);
    files::check_writable(out, &folder)?;
    let results = tension::Results::new(parameters, &Terminal)?;
    let mut all = results.files();
    if format == Format::Latex {
        all.extend(results.latex());
    }
    let written = write_all(&folder, all)?;
    finish(&results.smallest_gaps(), &results.in_words(), &written, format, wide)
}

/// Draws and computes what is shown of surfaces.
fn surfaces(gallery: Gallery, out: &Path) -> Result<ExitCode, Error> {
    let folder = out.join(gallery.folder());
    files::check_writable(out, &folder)?;
    let mut written = Written::default();
    for (name, bytes) in gallery.files(&args::tuner())? {
        written.write(folder.join(name), &bytes)?;
    }
    written.say();
    Ok(ExitCode::SUCCESS)
}

/// Computes what a study shows.
fn studied(study: Study, out: &Path) -> Result<ExitCode, Error> {
    let folder = out.join(eigenring_atlas::studies::FOLDER);
    files::check_writable(out, &folder)?;
    let mut written = Written::default();
    for (name, bytes) in study.files(&Terminal)? {
        written.write(folder.join(name), &bytes)?;
    }
    written.say();
    Ok(ExitCode::SUCCESS)
}

fn write_all(folder: &Path, files: Vec<(String, String)>) -> Result<Written, Error> {
    let mut written = Written::default();
    for (name, text) in files {
        written.write(folder.join(name), text.as_bytes())?;
    }
    Ok(written)
}
