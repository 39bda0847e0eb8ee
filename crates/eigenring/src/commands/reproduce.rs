//! `eigenring reproduce`: rebuild the stored results, or check that they can be rebuilt.

use super::tables::regenerate;
use crate::args;
use crate::compare::{Comparison, compare_csv, compare_json};
use crate::error::Error;
use crate::files;
use crate::results::{EVERYTHING, FOLDER, FORMAT_VERSION, Results};
use crate::run::studies;
use crate::table::Format;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Rebuild results/ with the parameters that it records, or re-check it.
///
/// With --check nothing is written: everything is computed anew and compared, number by number, with the files; the worst
/// entries are printed and the exit code is 1 if any differs by more than the tolerances.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  eigenring reproduce --check\n  eigenring reproduce")]
pub struct Arguments {
    /// Compare instead of writing
    #[arg(long)]
    check: bool,
    /// The folder with the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    out: PathBuf,
    /// Absolute tolerance of a number
    #[arg(long, value_name = "X", default_value = "1e-9", value_parser = args::number, allow_negative_numbers = true)]
    atol: f64,
    /// Relative tolerance of a number
    #[arg(long, value_name = "X", default_value = "1e-6", value_parser = args::number, allow_negative_numbers = true)]
    rtol: f64,
}

/// How many of the worst entries are printed.
const SHOWN: usize = 10;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        for (what, tolerance) in [("absolute tolerance", self.atol), ("relative tolerance", self.rtol)] {
            if !(tolerance >= 0.0 && tolerance.is_finite()) {
                return Err(Error::Range {
                    what,
                    given: tolerance.to_string(),
                    accepted: "0 and above, finite".to_owned(),
                });
            }
        }
        let folder = self.out.join(FOLDER);
        let path = folder.join(EVERYTHING);
        let text = files::read(&path)?;
        let stored: Results = serde_json::from_str(&text).map_err(|error| Error::BadFile {
            path: path.clone(),
            message: format!("no results of this version: {error}"),
        })?;
        if stored.version != FORMAT_VERSION {
            return Err(Error::BadFile {
                path,
                message: format!("version {}: accepted is {FORMAT_VERSION}", stored.version),
            });
        }
        let parameters = stored.provenance.parameters;
        if !self.check {
            regenerate(&parameters, &self.out, Format::Text)?;
            return Ok(ExitCode::SUCCESS);
        }
        let anew = Results::new(studies(&parameters, None)?, parameters)?;
        let mut same = true;
        let mut report = String::new();
        for (name, expected) in anew.files() {
            let found = files::read(&folder.join(&name))?;
            let comparison = if name.ends_with(".csv") {
                compare_csv(&expected, &found, self.atol, self.rtol)
            } else {
                compare_json(&expected, &found, self.atol, self.rtol)
            };
            let Comparison {
                compared,
                mut differences,
            } = comparison;
            let verdict = if differences.is_empty() { "same" } else { "DIFFERENT" };
            report.push_str(&format!(
                "{verdict:9}  {name}: {compared} entries compared, {} differ\n",
                differences.len()
            ));
            differences.sort_by(|a, b| b.excess.total_cmp(&a.excess));
            for difference in differences.iter().take(SHOWN) {
                report.push_str(&format!(
                    "           {}: stored {}, now {}\n",
                    difference.place, difference.found, difference.expected
                ));
            }
            same &= differences.is_empty();
        }
        files::emit(None, report.as_bytes())?;
        Ok(ExitCode::from(u8::from(!same)))
    }
}
