//! `results/index.toml` says what is there and who checks it; this compares it with what is there. That its
//! commands are accepted, and that they make these files, is what `eigenring reproduce --check` finds out.

use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[derive(Deserialize)]
struct Index {
    entry: Vec<IndexEntry>,
}

#[derive(Deserialize)]
struct IndexEntry {
    name: String,
    shows: String,
    files: Vec<PathBuf>,
    tests: Vec<String>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn index() -> Index {
    toml::from_str(&std::fs::read_to_string(root().join("results/index.toml")).unwrap()).unwrap()
}

/// The files below a folder but hidden ones, which belong to a run in progress.
fn below(folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.file_name().unwrap().to_string_lossy().starts_with('.') {
            continue;
        }
        if path.is_dir() {
            below(&path, found);
        } else {
            found.insert(path);
        }
    }
}

#[test]
fn every_result_belongs_to_one_entry() {
    let results = root().join("results");
    let mut stored = BTreeSet::new();
    below(&results, &mut stored);
    assert!(stored.remove(&results.join("index.toml")));
    for entry in index().entry {
        assert!(!entry.shows.is_empty() && !entry.files.is_empty(), "{}", entry.name);
        for file in entry.files {
            assert!(
                stored.remove(&results.join(&file)),
                "{}: {}",
                entry.name,
                file.display()
            );
        }
    }
    assert!(stored.is_empty(), "in no entry: {stored:?}");
}

/// That these tests exist is for the build to say: `.ci/run` looks for each among the compiled tests.
#[test]
fn every_entry_is_held_to_account() {
    for entry in index().entry {
        assert!(!entry.tests.is_empty(), "nothing holds '{}' to account", entry.name);
        for test in entry.tests {
            let (path, _) = test.split_once("::").expect("path::function");
            assert!(root().join(path).is_file(), "'{}' names no file: {path}", entry.name);
        }
    }
}
