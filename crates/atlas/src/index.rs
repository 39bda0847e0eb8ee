//! `index.toml`: which command makes which result files, and which tests hold them to account.
//!
//! An entry is a table or figure: what it shows, the command that makes it, its files (below the folder of
//! the index) and the tests that compare them with something else. Commands are run as a user runs them, with
//! the output folder added; so what an index claims is what anybody gets. A folder without an index, as
//! `eigenring tables --out FOLDER` leaves it, is described by the commands that its `tables.json` files
//! record.
//!
//! Which command lines make sense is for whoever runs them to say: reading an index asks for it, entry by
//! entry.

use crate::error::{Accepted, Error, accepted_in};
use crate::files;
use crate::results::EVERYTHING;
use eigenring_scheme::did_you_mean;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// Says why a command line, beginning with the word `eigenring`, is refused.
pub type Accept<'a> = &'a dyn Fn(&[String]) -> Result<(), String>;

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
    pub entries: Vec<IndexEntry>,
}

/// A table or a figure.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndexEntry {
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
    /// Whether making it takes so long that checks of everything leave it out unless asked.
    #[serde(default)]
    pub slow: bool,
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
    /// [`Error::Read`] if there is neither an index nor a `tables.json`, [`Error::InFile`] if what is there
    /// makes no sense: another version, two entries of one name, files outside the folder, or a command that
    /// is refused.
    pub fn of(folder: &Path, accept: Accept<'_>) -> Result<Self, Error> {
        let path = folder.join(INDEX);
        if !path.exists() {
            return Index::recorded(folder, accept);
        }
        Index::parse(&files::read(&path)?, accept).map_err(|error| error.in_file(&path))
    }

    fn parse(text: &str, accept: Accept<'_>) -> Result<Self, Error> {
        let index: Index =
            toml::from_str(text).map_err(|error| Error::content(error.to_string().replace('\n', " ")))?;
        if index.version != VERSION {
            let accepted = Accepted::Is(VERSION.to_string());
            return Err(Error::refused(format!("version {}", index.version), accepted));
        }
        for (position, entry) in index.entries.iter().enumerate() {
            if index.entries[..position].iter().any(|other| other.name == entry.name) {
                return Err(Error::content(format!("two entries are called '{}'", entry.name)));
            }
            entry.validate(accept)?;
        }
        Ok(index)
    }

    /// What the tables of a folder say about how they were made.
    fn recorded(folder: &Path, accept: Accept<'_>) -> Result<Self, Error> {
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
            let message = format!("neither {INDEX} nor a subfolder with {EVERYTHING} is there");
            return Err(Error::content(message).in_file(folder));
        }
        let entries = groups.into_iter().map(|path| {
            let name = path.parent().and_then(Path::file_name);
            let name = name.map_or(String::new(), |name| name.to_string_lossy().into_owned());
            IndexEntry::recorded(name, &files::read(&path)?, accept).map_err(|error| error.in_file(&path))
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
    pub fn select(&self, only: Option<&str>) -> Result<Vec<&IndexEntry>, Error> {
        let selected: Vec<&IndexEntry> = self
            .entries
            .iter()
            .filter(|entry| only.is_none_or(|name| entry.name == name))
            .collect();
        match (only, selected.is_empty()) {
            (Some(name), true) => {
                let names: Vec<&str> = self.entries.iter().map(|entry| entry.name.as_str()).collect();
                let similar = did_you_mean(name, names.iter().copied());
                Err(Error::Usage {
                    message: format!("nothing is called '{name}'{similar}"),
                    accepted: names.join(", "),
                })
            }
            _ => Ok(selected),
        }
    }
}

impl IndexEntry {
    /// The entry of a group of tables, by the command that they record.
    fn recorded(name: String, text: &str, accept: Accept<'_>) -> Result<Self, Error> {
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| Error::content(format!("no results: {error}")))?;
        let command = value["provenance"]["command"]
            .as_str()
            .ok_or_else(|| Error::content("no results: provenance.command is missing"))?;
        let entry = IndexEntry {
            name,
            shows: String::new(),
            command: command.to_owned(),
            folder: PathBuf::new(),
            check: None,
            slow: false,
            files: Vec::new(),
            tests: Vec::new(),
            atol: None,
            rtol: None,
        };
        entry.validate(accept)?;
        Ok(entry)
    }

    fn validate(&self, accept: Accept<'_>) -> Result<(), Error> {
        for path in self.files.iter().chain([&self.folder]) {
            let inside = path
                .components()
                .all(|part| matches!(part, std::path::Component::Normal(_)));
            if !inside {
                let message = format!("'{}' is not a path below the folder", path.display());
                return Err(Error::content(message));
            }
        }
        let out = Path::new("out");
        for words in [Some(self.making(out)), self.checking(out)].into_iter().flatten() {
            let refused = |why: &str| {
                let accepted = accepted_in(why);
                // the sentence of whoever refuses ends with what is accepted, which is kept as such
                let (why, accepted) = match (why.rsplit_once(": accepted "), accepted) {
                    (Some((why, rest)), Some(words)) if rest.starts_with("are ") => (why, Some(Accepted::Are(words))),
                    (Some((why, rest)), Some(words)) if rest.starts_with("is ") => (why, Some(Accepted::Is(words))),
                    _ => (why, None),
                };
                Error::Content {
                    message: format!("the command of '{}' is refused: {why}", self.name),
                    accepted,
                }
            };
            if words.first().map(String::as_str) != Some("eigenring") {
                return Err(refused("it does not begin with 'eigenring'"));
            }
            // an index that rebuilds an index would not end
            if words.get(1).map(String::as_str) == Some("reproduce") {
                return Err(refused("'reproduce' is what runs it"));
            }
            accept(&words).map_err(|why| refused(&why))?;
        }
        Ok(())
    }

    /// The words of the command that writes the files below a folder.
    pub fn making(&self, out: &Path) -> Vec<String> {
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

    /// The words of the command that re-checks the files, if there is one.
    pub fn checking(&self, out: &Path) -> Option<Vec<String>> {
        let check = self.check.as_ref()?;
        let words = check.split_whitespace();
        Some(
            words
                .map(|word| word.replace("{out}", &out.to_string_lossy()))
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes options of 'tables' and nothing else.
    fn parse(text: &str) -> Result<Index, Error> {
        let folder = tempfile::tempdir().unwrap();
        files::write(&folder.path().join(INDEX), text.as_bytes()).unwrap();
        Index::of(folder.path(), &|words| match words[1].as_str() {
            "tables" => Ok(()),
            other => Err(format!("unknown command '{other}': accepted is tables")),
        })
    }

    #[test]
    fn entries_are_found_by_name() {
        let text = "version = 1\n[[entry]]\nname = \"a\"\ncommand = \"eigenring tables --valences 5\"\nfiles = [\"x/y.csv\"]\n[[entry]]\nname = \"b\"\ncommand = \"eigenring tables\"\n";
        let index = parse(text).unwrap();
        assert_eq!(index.select(None).unwrap().len(), 2);
        assert_eq!(index.select(Some("b")).unwrap()[0].name, "b");
        let message = index.select(Some("c")).unwrap_err().to_string();
        assert!(message.ends_with("accepted is a, b"), "{message}");
    }

    #[test]
    fn senseless_entries_are_refused() {
        let entry = |rest: &str| format!("version = 1\n[[entry]]\nname = \"a\"\n{rest}\n");
        for (text, what) in [
            ("version = 2\n".to_owned(), "version 2"),
            (entry("command = \"rm -r /\""), "begin with"),
            (entry("command = \"eigenring paint\""), "'paint': accepted is tables"),
            (entry("command = \"eigenring reproduce\""), "reproduce"),
            (entry("command = \"eigenring tables\"\nfiles = [\"../x\"]"), "../x"),
            (entry("command = \"eigenring tables\"\ncolour = 1"), "colour"),
            (entry("command = \"eigenring tables\"") + &entry("")[12..], "command"),
        ] {
            let message = parse(&text).unwrap_err().to_string();
            assert!(message.contains(what), "{text}: {message}");
        }
    }
}
