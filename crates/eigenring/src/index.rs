//! `index.toml`: which command makes which result files, and which tests hold them to account.
//!
//! An entry is a table or figure: what it shows, the command that makes it, its files (below the folder of the index) and the
//! tests that compare them with something else. Commands are run as a user runs them, by this program, with the output folder
//! added; so what an index claims is what anybody gets. A folder without an index, as `eigenring tables --out FOLDER` leaves
//! it, is described by the commands that its `tables.json` files record.

use crate::commands::Cli;
use crate::error::Error;
use crate::files;
use clap::Parser;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The file's name.
pub const INDEX: &str = "index.toml";

/// The version of its format.
const VERSION: u32 = 1;

/// All entries of a results folder.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Index {
    /// [`VERSION`].
    version: u32,
    /// In the order in which they are rebuilt: later ones may read the files of earlier ones.
    #[serde(rename = "entry", default)]
    pub entries: Vec<Entry>,
}

/// A table or a figure.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its name, for `--only`.
    pub name: String,
    /// What it shows, with the paper's number.
    #[serde(default)]
    pub shows: String,
    /// What makes it, without `--out`.
    pub command: String,
    /// The subfolder that is handed to the command as `--out`; none for commands that choose their own.
    #[serde(default)]
    pub folder: PathBuf,
    /// What re-checks it when making it anew takes long; `{out}` stands for the folder.
    pub check: Option<String>,
    /// Its files, relative to the folder; none means all that the command writes.
    #[serde(default)]
    pub files: Vec<PathBuf>,
    /// `path::function` of the tests that compare it with the literature or with independent computations.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Absolute tolerance of its numbers, if other than the command's.
    pub atol: Option<f64>,
    /// Relative tolerance of its numbers, if other than the command's.
    pub rtol: Option<f64>,
}

impl Index {
    /// The index of a folder.
    ///
    /// # Errors
    /// [`Error::Read`] if there is neither an index nor a `tables.json`, [`Error::BadFile`] if what is there makes no sense:
    /// another version, two entries of one name, files outside the folder, or a command that this program would refuse.
    pub fn of(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(INDEX);
        if !path.exists() {
            return Index::recorded(folder);
        }
        let bad = |message: String| Error::BadFile {
            path: path.clone(),
            message,
        };
        let index: Index =
            toml::from_str(&files::read(&path)?).map_err(|error| bad(error.to_string().replace('\n', " ")))?;
        if index.version != VERSION {
            return Err(bad(format!("version {}: accepted is {VERSION}", index.version)));
        }
        for (position, entry) in index.entries.iter().enumerate() {
            if index.entries[..position].iter().any(|other| other.name == entry.name) {
                return Err(bad(format!("two entries are called '{}'", entry.name)));
            }
            entry.validate().map_err(bad)?;
        }
        Ok(index)
    }

    /// What the tables of a folder say about how they were made.
    fn recorded(folder: &Path) -> Result<Self, Error> {
        let mut groups: Vec<PathBuf> = std::fs::read_dir(folder)
            .map_err(|source| Error::Read {
                path: folder.to_owned(),
                source,
            })?
            .filter_map(|entry| Some(entry.ok()?.path().join(EVERYTHING)))
            .filter(|path| path.exists())
            .collect();
        groups.sort();
        if groups.is_empty() {
            return Err(Error::BadFile {
                path: folder.to_owned(),
                message: format!("neither {INDEX} nor a subfolder with {EVERYTHING} is there"),
            });
        }
        let entries = groups.into_iter().map(|path| {
            let bad = |message: String| Error::BadFile {
                path: path.clone(),
                message,
            };
            let text = files::read(&path)?;
            let value: serde_json::Value =
                serde_json::from_str(&text).map_err(|error| bad(format!("no results: {error}")))?;
            let command = value["provenance"]["command"]
                .as_str()
                .ok_or_else(|| bad("no results: provenance.command is missing".to_owned()))?;
            let entry = Entry {
                name: path
                    .parent()
                    .and_then(Path::file_name)
                    .map_or(String::new(), |name| name.to_string_lossy().into_owned()),
                shows: String::new(),
                command: command.to_owned(),
                folder: PathBuf::new(),
                check: None,
                files: Vec::new(),
                tests: Vec::new(),
                atol: None,
                rtol: None,
            };
            entry.validate().map_err(bad)?;
            Ok(entry)
        });
        Ok(Index {
            version: VERSION,
            entries: entries.collect::<Result<_, Error>>()?,
        })
    }

    /// The entry of a name, or all of them.
    ///
    /// # Errors
    /// [`Error::Usage`] with the names that there are.
    pub fn select(&self, only: Option<&str>) -> Result<Vec<&Entry>, Error> {
        let selected: Vec<&Entry> = self
            .entries
            .iter()
            .filter(|entry| only.is_none_or(|name| entry.name == name))
            .collect();
        match (only, selected.is_empty()) {
            (Some(name), true) => Err(Error::Usage {
                message: format!("nothing is called '{name}'"),
                accepted: self
                    .entries
                    .iter()
                    .map(|entry| entry.name.as_str())
                    .collect::<Vec<_>>()
                    .join(", "),
            }),
            _ => Ok(selected),
        }
    }
}

/// The file in which a group of tables records its provenance.
const EVERYTHING: &str = "tables.json";

impl Entry {
    fn validate(&self) -> Result<(), String> {
        for path in self.files.iter().chain([&self.folder]) {
            let inside = path
                .components()
                .all(|part| matches!(part, std::path::Component::Normal(_)));
            if !inside {
                return Err(format!("'{}' is not a path below the folder", path.display()));
            }
        }
        let out = Path::new("out");
        for words in [Some(self.making(out)), self.checking(out)].into_iter().flatten() {
            let refused = |why: String| format!("the command of '{}' is refused: {why}", self.name);
            if words.first().map(String::as_str) != Some("eigenring") {
                return Err(refused("it does not begin with 'eigenring'".to_owned()));
            }
            // an index that rebuilds an index would not end
            if words.get(1).map(String::as_str) == Some("reproduce") {
                return Err(refused("'reproduce' is what runs it".to_owned()));
            }
            Cli::try_parse_from(&words).map_err(|error| {
                let arguments: Vec<_> = words.iter().map(Into::into).collect();
                refused(crate::command_line::explain(&error, &arguments))
            })?;
        }
        Ok(())
    }

    /// The words of the command that writes the files below a folder.
    fn making(&self, out: &Path) -> Vec<String> {
        let words = self.command.split_whitespace().map(str::to_owned);
        let out = if self.folder.as_os_str().is_empty() {
            out.to_owned()
        } else {
            out.join(&self.folder)
        };
        words
            .chain(["--out".to_owned(), out.to_string_lossy().into_owned()])
            .collect()
    }

    /// The words of the command that re-checks the files.
    fn checking(&self, out: &Path) -> Option<Vec<String>> {
        let check = self.check.as_ref()?;
        let words = check.split_whitespace();
        Some(
            words
                .map(|word| word.replace("{out}", &out.to_string_lossy()))
                .collect(),
        )
    }

    /// Makes the files below a folder.
    ///
    /// # Errors
    /// [`Error::Rebuild`] with what the command says.
    pub fn make(&self, out: &Path) -> Result<(), Error> {
        let words = self.making(out);
        let output = run(&words)?;
        if output.status.success() {
            return Ok(());
        }
        let message = String::from_utf8_lossy(&output.stderr);
        Err(Error::Rebuild {
            command: words.join(" "),
            message: message.trim().trim_start_matches("error: ").to_owned(),
        })
    }

    /// Runs the command that re-checks the files, if there is one: whether it succeeds, and what it prints.
    ///
    /// # Errors
    /// [`Error::Output`] if it cannot be started.
    pub fn recheck(&self, out: &Path) -> Result<Option<(bool, String)>, Error> {
        let Some(words) = self.checking(out) else {
            return Ok(None);
        };
        let output = run(&words)?;
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
}

/// Runs this program with other arguments. Its bar, if it draws one, is not shown: the caller counts entries.
fn run(words: &[String]) -> Result<std::process::Output, Error> {
    let program = std::env::current_exe().map_err(Error::Start)?;
    Command::new(program)
        .args(&words[1..])
        .stdin(Stdio::null())
        .output()
        .map_err(Error::Start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Index, Error> {
        let folder = tempfile::tempdir().unwrap();
        files::write(&folder.path().join(INDEX), text.as_bytes()).unwrap();
        Index::of(folder.path())
    }

    #[test]
    fn entries_are_found_by_name() {
        let text = "version = 1\n[[entry]]\nname = \"a\"\ncommand = \"eigenring tables --valences 5\"\nfiles = [\"x/y.csv\"]\n[[entry]]\nname = \"b\"\ncommand = \"eigenring tables\"\n";
        let index = parse(text).unwrap();
        assert_eq!(index.select(None).unwrap().len(), 2);
        assert_eq!(index.select(Some("b")).unwrap()[0].name, "b");
        let message = index.select(Some("c")).unwrap_err().line();
        assert!(message.ends_with("accepted is a, b"), "{message}");
    }

    #[test]
    fn senseless_entries_are_refused() {
        let entry = |rest: &str| format!("version = 1\n[[entry]]\nname = \"a\"\n{rest}\n");
        for (text, what) in [
            ("version = 2\n".to_owned(), "version 2"),
            (entry("command = \"rm -r /\""), "begin with"),
            (entry("command = \"eigenring tables --valences 2\""), "accepted"),
            (entry("command = \"eigenring reproduce\""), "reproduce"),
            (entry("command = \"eigenring stencil -N 5 --lambda 0.5\""), "--out"),
            (entry("command = \"eigenring tables\"\nfiles = [\"../x\"]"), "../x"),
            (entry("command = \"eigenring tables\"\ncolour = 1"), "colour"),
            (entry("command = \"eigenring tables\"") + &entry("")[12..], "command"),
        ] {
            let message = parse(&text).unwrap_err().line();
            assert!(message.contains(what), "{text}: {message}");
        }
    }
}
