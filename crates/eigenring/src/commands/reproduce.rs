//! `eigenring reproduce`: rebuild the stored results, or check that they can be rebuilt.

use crate::args;
use crate::compare::{Comparison, compare_csv, compare_json};
use crate::error::Error;
use crate::files;
use crate::index::{Entry, Index};
use crate::progress::bar;
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Rebuild results/, or re-check it: every table and figure that its index.toml lists.
///
/// With --check nothing is written there: each entry is made anew in a temporary folder and compared, number by number, with
/// the files; the worst entries are printed and the exit code is 1 if any differs by more than the tolerances. Entries
/// with a check of their own, which take long to make, are checked by it, and made anew when named with --only. Pictures
/// are compared by the numbers that are stored beside them.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring reproduce --check\n  eigenring reproduce --check --only lambda-tables\n  eigenring reproduce"
)]
pub struct Arguments {
    /// Compare instead of writing
    #[arg(long)]
    check: bool,
    /// One entry of the index
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
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

/// How many of the worst entries are printed for each file.
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
        let index = Index::of(&self.out)?;
        let entries = index.select(self.only.as_deref())?;
        let progress = bar("results", entries.len());
        let mut same = true;
        for entry in entries {
            progress.set_message(entry.name.clone());
            let report = match (self.check, self.only.is_some()) {
                (true, named) => self.check(entry, named)?,
                (false, _) => {
                    entry.make(&self.out)?;
                    Report {
                        same: true,
                        text: format!("rebuilt    {}: {}\n", entry.name, entry.command),
                    }
                }
            };
            same &= report.same;
            progress.suspend(|| files::emit(None, report.text.as_bytes()))?;
            progress.inc(1);
        }
        progress.finish_and_clear();
        Ok(ExitCode::from(u8::from(!same)))
    }

    /// Compares an entry with what is made anew, or runs its own check unless it was asked for by name.
    fn check(&self, entry: &Entry, named: bool) -> Result<Report, Error> {
        let present = |path: &PathBuf| files::size(&self.out.join(path));
        for path in &entry.files {
            present(path)?;
        }
        if !named && let Some((holds, text)) = entry.recheck(&self.out)? {
            let verdict = if holds { "holds" } else { "REFUTED" };
            let mut report = format!("{verdict:9}  {}\n", entry.name);
            if !holds {
                report.extend(text.lines().map(|line| format!("           {line}\n")));
            }
            return Ok(Report {
                same: holds,
                text: report,
            });
        }
        let folder = tempfile::tempdir().map_err(|source| Error::Write {
            path: std::env::temp_dir(),
            source,
        })?;
        entry.make(folder.path())?;
        let made = if entry.files.is_empty() {
            files::below(folder.path())?
        } else {
            entry.files.clone()
        };
        let mut whole = Report {
            same: true,
            text: String::new(),
        };
        for path in made {
            let tolerances = (entry.atol.unwrap_or(self.atol), entry.rtol.unwrap_or(self.rtol));
            let report = compare(folder.path(), &self.out, &path, tolerances)?;
            whole.same &= report.same;
            whole.text.push_str(&report.text);
        }
        Ok(whole)
    }
}

struct Report {
    same: bool,
    text: String,
}

/// Compares one file that was made anew with the one that is stored.
fn compare(anew: &Path, stored: &Path, path: &Path, (atol, rtol): (f64, f64)) -> Result<Report, Error> {
    let name = path.to_string_lossy();
    let numbers = match path.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => compare_csv,
        Some("json") => compare_json,
        // a picture or a page: there must be one
        _ => {
            files::size(&anew.join(path))?;
            files::size(&stored.join(path))?;
            return Ok(Report {
                same: true,
                text: format!("present    {name}\n"),
            });
        }
    };
    let (expected, found) = (files::read(&anew.join(path))?, files::read(&stored.join(path))?);
    let Comparison {
        compared,
        mut differences,
    } = numbers(&expected, &found, atol, rtol);
    let verdict = if differences.is_empty() { "same" } else { "DIFFERENT" };
    let mut text = format!(
        "{verdict:9}  {name}: {compared} entries compared, {} differ\n",
        differences.len()
    );
    differences.sort_by(|a, b| b.excess.total_cmp(&a.excess));
    for difference in differences.iter().take(SHOWN) {
        text.push_str(&format!(
            "           {}: stored {}, now {}\n",
            difference.place, difference.found, difference.expected
        ));
    }
    Ok(Report {
        same: differences.is_empty(),
        text,
    })
}
