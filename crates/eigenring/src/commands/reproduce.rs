//! `eigenring reproduce`: rebuild the stored results, or check that they can be rebuilt.

use super::Cli;
use crate::args;
use crate::command_line::explain;
use crate::error::Error;
use crate::files;
use crate::progress::bar;
use crate::threads::Threads;
use clap::{Args, Parser};
use eigenring_atlas::difference::{Report, compare_files};
use eigenring_atlas::index::{Index, IndexEntry};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Output, Stdio};

/// Rebuild results/, or re-check it: every table and figure that its index.toml lists.
///
/// With --check nothing is written there: each entry is made anew in a temporary folder and compared, number
/// by number, with the files; the worst entries are printed and the exit code is 1 if any differs by more
/// than the tolerances. Entries with a check of their own, which take long to make, are checked by it, and
/// made anew when named with --only. Pictures are compared by the numbers that are stored beside them. A
/// notice tells what differs within the tolerances: on one platform that is stale.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring reproduce --check\n  eigenring reproduce --check --only lambda-tables\n  eigenring reproduce"
)]
pub struct Arguments {
    /// Compare instead of writing
    #[arg(long)]
    check: bool,
    /// Check slow entries too; without, only that their files are there
    #[arg(long, requires = "check")]
    slow: bool,
    /// One entry of the index
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// The folder with the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    out: PathBuf,
    /// Absolute tolerance of a number
    #[arg(long, value_name = "X", default_value = "1e-9", requires = "check", value_parser = args::number, allow_negative_numbers = true)]
    atol: f64,
    /// Relative tolerance of a number
    #[arg(long, value_name = "X", default_value = "1e-6", requires = "check", value_parser = args::number, allow_negative_numbers = true)]
    rtol: f64,
    #[command(flatten)]
    threads: Threads,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        for (what, tolerance) in [("absolute tolerance", self.atol), ("relative tolerance", self.rtol)] {
            if !(tolerance >= 0.0 && tolerance.is_finite()) {
                return Err(Error::range(what, tolerance, "0 and above, finite"));
            }
        }
        let index = Index::of(&self.out, &accept)?;
        let entries = index.select(self.only.as_deref())?;
        let progress = bar("results", entries.len());
        let mut same = true;
        for entry in entries {
            progress.set_message(entry.name.clone());
            let report = match (self.check, self.only.is_some()) {
                (true, named) => self.check(entry, named)?,
                (false, _) => {
                    make(entry, &self.out, self.threads)?;
                    Report {
                        same: true,
                        text: format!("rebuilt    {}: {}\n", entry.name, entry.command),
                    }
                }
            };
            same &= report.same;
            files::emit(None, report.text.as_bytes())?;
            progress.inc(1);
        }
        progress.finish_and_clear();
        Ok(ExitCode::from(u8::from(!same)))
    }

    /// Compares an entry with what is made anew, or runs its own check unless it was asked for by name.
    fn check(&self, entry: &IndexEntry, named: bool) -> Result<Report, Error> {
        let present = |path: &PathBuf| files::size(&self.out.join(path));
        for path in &entry.files {
            present(path)?;
        }
        if !named && let Some((holds, text)) = recheck(entry, &self.out, self.threads)? {
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
        if entry.slow && !named && !self.slow {
            return Ok(Report {
                same: true,
                text: format!("slow       {}: left out, see --slow\n", entry.name),
            });
        }
        let folder = tempfile::tempdir().map_err(|source| eigenring_atlas::Error::Write {
            path: std::env::temp_dir(),
            source,
        })?;
        make(entry, folder.path(), self.threads)?;
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
            let report = compare_files(folder.path(), &self.out, &path, tolerances)?;
            whole.same &= report.same;
            whole.text.push_str(&report.text);
        }
        Ok(whole)
    }
}

/// Says why the parser refuses a command line.
fn accept(words: &[String]) -> Result<(), String> {
    Cli::try_parse_from(words).map(|_| ()).map_err(|error| {
        let arguments: Vec<_> = words.iter().map(Into::into).collect();
        explain(&error, &arguments)
    })
}

/// Makes the files of an entry below a folder.
fn make(entry: &IndexEntry, out: &Path, threads: Threads) -> Result<(), Error> {
    let words = entry.making(out);
    let output = run(&words, threads)?;
    if output.status.success() {
        return Ok(());
    }
    let message = String::from_utf8_lossy(&output.stderr);
    Err(Error::Rebuild {
        command: words.join(" "),
        message: message.trim().trim_start_matches("error: ").to_owned(),
    })
}

/// Runs the command that re-checks the files of an entry, if there is one: whether it succeeds, and what it
/// prints.
fn recheck(entry: &IndexEntry, out: &Path, threads: Threads) -> Result<Option<(bool, String)>, Error> {
    let Some(words) = entry.checking(out) else {
        return Ok(None);
    };
    let output = run(&words, threads)?;
    let text = if output.status.success() {
        output.stdout
    } else {
        [output.stdout, output.stderr].concat()
    };
    Ok(Some((
        output.status.success(),
        String::from_utf8_lossy(&text).into_owned(),
    )))
}

/// Runs this program with other arguments. Its bar, if it draws one, is not shown: the caller counts entries.
fn run(words: &[String], threads: Threads) -> Result<Output, Error> {
    let program = std::env::current_exe().map_err(Error::Start)?;
    let mut command = Command::new(program);
    if let Some(count) = threads.given() {
        command.env("RAYON_NUM_THREADS", count.to_string());
    }
    command
        .args(&words[1..])
        .stdin(Stdio::null())
        .output()
        .map_err(Error::Start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_held_to_what_the_parser_takes() {
        let folder = tempfile::tempdir().unwrap();
        let read = |command: &str| {
            let text = format!("version = 1\n[[entry]]\nname = \"a\"\ncommand = \"{command}\"\n");
            files::write(&folder.path().join("index.toml"), text.as_bytes()).unwrap();
            Index::of(folder.path(), &accept).map_err(Error::from)
        };
        assert!(read("eigenring tables --valences 5").is_ok());
        for (command, part) in [
            ("eigenring tables --valences 2", "accepted"),
            ("eigenring stencil -N 5 --lambda 0.5", "--out"),
            ("eigenring paint", "'paint'"),
        ] {
            let error = read(command).unwrap_err();
            assert!(
                error.line().contains(part) && error.accepted().is_some(),
                "{}",
                error.line()
            );
        }
    }
}
