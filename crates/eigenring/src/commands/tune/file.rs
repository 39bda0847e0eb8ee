//! `eigenring tune --scheme`: the parameters of a scheme file.

use crate::args;
use crate::error::Error;
use crate::files;
use crate::output::Output;
use crate::progress::{Terminal, note};
use clap::Args;
use eigenring_atlas::schemes::{SchemeName, setting};
use eigenring_atlas::tuning::{Condition, Descent, Goal, Kept, Plan, Tuned};
use eigenring_scheme::Number;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

/// What is minimised, under which conditions, and how it is searched.
#[derive(Args, Debug)]
pub struct FileArgs {
    /// What is minimised: E, E-unweighted, ratio, lambda:TARGET, K_m, strictness, hull, polar, or a sum of
    /// these with factors, such as 1*E+10*ratio
    #[arg(long, value_name = "OBJECTIVE", value_parser = str::parse::<Goal>, allow_hyphen_values = true)]
    minimise: Option<Goal>,
    /// What must hold: hull (no negative weight), bounded (curvature), order (the eigenvalues of linear and
    /// quadratic terms lead), c1
    #[arg(long, value_name = "CONDITION,..", value_delimiter = ',', value_parser = str::parse::<Condition>)]
    subject_to: Vec<Condition>,
    /// Leave a parameter at its value, or at another one; may be repeated
    #[arg(long, value_name = "NAME[=VALUE]", value_parser = fixed, allow_hyphen_values = true)]
    fix: Vec<(String, Option<Number>)>,
    /// Shifts the points at which the search begins
    #[arg(long, value_name = "SEED", value_parser = seed)]
    seed: Option<u64>,
    /// From how many points the search descends, beside the declared values and a swarm of particles; 6 by
    /// default
    #[arg(long, value_name = "COUNT", value_parser = args::count)]
    descents: Option<usize>,
    /// Keep what is found in this file, and go on from there
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
}

/// Descents, unless their number is given.
const DESCENTS: usize = 6;

/// The most descents that are taken for meant.
const MAX_DESCENTS: usize = 10_000;

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "accepted is a whole number".to_owned())
}

/// Reads `NAME` or `NAME=VALUE`.
fn fixed(text: &str) -> Result<(String, Option<Number>), String> {
    if !text.contains('=') {
        return Ok((text.trim().to_owned(), None));
    }
    let (name, value) = setting(text)
        .map_err(|reason| format!("{reason}: accepted is NAME or NAME=VALUE with a number or a fraction"))?;
    Ok((name, Some(value)))
}

impl FileArgs {
    /// Refuses these options where no scheme file is tuned.
    ///
    /// # Errors
    /// The option that was given.
    pub fn refuse(&self) -> Result<(), Error> {
        let options = [
            ("--minimise", self.minimise.is_some()),
            ("--subject-to", !self.subject_to.is_empty()),
            ("--fix", !self.fix.is_empty()),
            ("--seed", self.seed.is_some()),
            ("--descents", self.descents.is_some()),
            ("--resume", self.resume.is_some()),
        ];
        match options.iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::usage(
                format!("{option} has no meaning for the lambda-scheme"),
                format!("{option} with --scheme file:SCHEME.toml"),
            )),
            None => Ok(()),
        }
    }

    /// Tunes a scheme file at all valences.
    ///
    /// # Errors
    /// Those of the tuning; a scheme that is no file.
    pub fn run(&self, scheme: SchemeName, valences: &[usize], margin: f64, output: &Output) -> Result<ExitCode, Error> {
        let SchemeName::File(scheme) = scheme else {
            return Err(Error::usage(
                "tuning is for the parameters of a scheme file",
                "--scheme file:SCHEME.toml; --lambda and --global for the lambda-scheme",
            ));
        };
        if !(0.0..0.5).contains(&margin) {
            return Err(Error::range("margin", margin, "0 to below 0.5"));
        }
        let descents = self.descents.unwrap_or(DESCENTS);
        if !(1..=MAX_DESCENTS).contains(&descents) {
            return Err(Error::range(
                "number of descents",
                descents,
                format!("1 to {MAX_DESCENTS}"),
            ));
        }
        let Some(goal) = self.minimise.clone() else {
            return Err(Error::usage("no objective is given", "--minimise OBJECTIVE"));
        };
        let mut conditions = self.subject_to.clone();
        let mut known = Vec::new();
        conditions.retain(|condition| {
            !known.contains(condition) && {
                known.push(*condition);
                true
            }
        });
        let path = output.file();
        if let Some(path) = path {
            check_file(path, &scheme.path)?;
        }
        let plan = Plan {
            scheme,
            fixed: self.fix.clone(),
            goal,
            conditions,
            margin,
            seed: self.seed.unwrap_or(0),
            descents,
        };
        let stem = path
            .and_then(Path::file_stem)
            .map_or("tuned".into(), |stem| stem.to_string_lossy());
        let tuned = match &self.resume {
            Some(kept) => plan.run(valences, &stem, &Resumed::open(kept, &plan.key()?)?, &Terminal)?,
            None => plan.run(valences, &stem, &(), &Terminal)?,
        };
        if let Some(path) = path {
            write(path, &tuned)?;
        }
        files::emit(None, plan.render(&tuned, output.printed()).as_bytes())?;
        if path.is_none() {
            note("the scheme and its certificates are written with -o FILE.toml");
        }
        Ok(ExitCode::from(u8::from(!plan.holds(&tuned))))
    }
}

/// Refuses what is no name for the result, before long work is done for it.
fn check_file(path: &Path, scheme: &Path) -> Result<(), Error> {
    let is_toml = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if !is_toml {
        return Err(Error::usage(
            format!("{} is no name for a scheme file", path.display()),
            "-o FILE.toml; the table is printed",
        ));
    }
    let same = |path: &Path| std::fs::canonicalize(path).ok();
    if same(path).is_some_and(|path| Some(path) == same(scheme)) {
        return Err(Error::usage(
            format!("{} is the file that is tuned", path.display()),
            "another file",
        ));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    files::check_writable(folder, folder)
}

/// Writes the scheme, and its certificates beside it.
fn write(path: &Path, tuned: &Tuned) -> Result<(), Error> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    files::save(path, tuned.text.as_bytes())?;
    for row in &tuned.rows {
        let certificate = path.with_file_name(format!("{stem}-N{:03}.json", row.valence));
        files::save(&certificate, row.certificate.to_json()?.as_bytes())?;
    }
    Ok(())
}

/// Descents in a file: a first line with what they depend on, then a line for each, in whatever order they
/// ended. A line that was cut off is dropped.
#[derive(Debug)]
struct Resumed {
    path: PathBuf,
    file: Mutex<File>,
    known: BTreeMap<(usize, usize), Descent>,
}

impl Resumed {
    /// Opens or begins a file.
    ///
    /// # Errors
    /// A file of something else, which is left alone.
    fn open(path: &Path, key: &str) -> Result<Self, Error> {
        let mut known = BTreeMap::new();
        let mut kept = format!("{key}\n");
        if path.exists() {
            let text = files::read(path)?;
            let mut lines = text.lines();
            if lines.next().is_some_and(|first| first != key) {
                return Err(Error::usage(
                    format!("{} is not of this tuning", path.display()),
                    "a file that does not exist yet, or one of the same file, objective, conditions and options",
                ));
            }
            for line in lines {
                if let Ok(descent) = serde_json::from_str::<Descent>(line) {
                    kept.push_str(line);
                    kept.push('\n');
                    known.insert((descent.valence, descent.start), descent);
                }
            }
        }
        files::write(path, kept.as_bytes())?;
        let file = File::options().append(true).open(path);
        let file = file.map_err(|source| eigenring_atlas::Error::Write {
            path: path.to_owned(),
            source,
        })?;
        Ok(Resumed {
            path: path.to_owned(),
            file: Mutex::new(file),
            known,
        })
    }
}

impl Kept for Resumed {
    fn get(&self, valence: usize, start: usize) -> Option<Descent> {
        self.known.get(&(valence, start)).cloned()
    }

    fn add(&self, descent: &Descent) -> Result<(), eigenring_atlas::Error> {
        let failed = |source| eigenring_atlas::Error::Write {
            path: self.path.clone(),
            source,
        };
        let line = serde_json::to_string(descent).map_err(|error| failed(error.into()))? + "\n";
        // a poisoned lock means that another thread panicked while writing; its line is dropped on resumption
        let mut file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        file.write_all(line.as_bytes()).map_err(failed)
    }
}
