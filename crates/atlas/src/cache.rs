//! What was tuned on demand, remembered between runs.
//!
//! Entries are JSON files in a folder named after the version of the tool, so that a new version tunes anew.
//! An entry that cannot be read is as good as none.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// A folder of remembered results; by default none.
#[derive(Clone, Debug, Default)]
pub struct Cache {
    folder: Option<PathBuf>,
}

impl Cache {
    /// The cache in a folder, or none.
    pub fn at(folder: Option<&Path>) -> Self {
        Cache {
            folder: folder.map(|folder| folder.join(env!("CARGO_PKG_VERSION"))),
        }
    }

    /// The user's cache: in `$EIGENRING_CACHE`, else `$XDG_CACHE_HOME/eigenring`, else `~/.cache/eigenring`;
    /// none where no variable says where that is.
    pub fn of_user() -> Self {
        let variable = |name: &str| {
            std::env::var_os(name)
                .filter(|value| !value.is_empty())
                .map(PathBuf::from)
        };
        let folder = variable("EIGENRING_CACHE")
            .or_else(|| variable("XDG_CACHE_HOME").map(|path| path.join("eigenring")))
            .or_else(|| variable("HOME").map(|path| path.join(".cache/eigenring")));
        Cache::at(folder.as_deref())
    }

    fn path(&self, key: &str) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.json")))
    }

    /// What is remembered under a key.
    pub fn get<T: DeserializeOwned>(&self, key: &str) -> Option<T> {
        let text = std::fs::read_to_string(self.path(key)?).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Remembers a value; gives the file, or `None` if that is not possible. The value is of use either way.
    pub fn put<T: Serialize>(&self, key: &str, value: &T) -> Option<PathBuf> {
        let path = self.path(key)?;
        let text = serde_json::to_string(value).ok()?;
        crate::files::write(&path, text.as_bytes()).ok()?;
        Some(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_remembered_to_the_bit_and_bad_entries_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(Some(folder.path()));
        assert_eq!(cache.get::<f64>("x"), None);
        let path = cache.put("x", &(1.0_f64 / 3.0)).unwrap();
        assert_eq!(cache.get::<f64>("x"), Some(1.0 / 3.0));
        std::fs::write(path, "0.33 garbage").unwrap();
        assert_eq!(cache.get::<f64>("x"), None);
        assert_eq!(Cache::at(None).put("x", &1.0), None);
    }
}
