//! Standard output, and the files that commands write beside it.

use crate::error::Error;
pub use eigenring_atlas::files::{below, check_writable, read, size, write};
use std::io::Write;
use std::path::Path;

/// Writes to standard output, or to a file if one is given. A reader that has gone away is no error.
pub fn emit(out: Option<&Path>, contents: &[u8]) -> Result<(), Error> {
    if let Some(path) = out {
        return Ok(write(path, contents)?);
    }
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(contents).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(Error::Output),
    }
}

/// Removes a folder with all that it holds.
pub fn remove_folder(folder: &Path) -> Result<(), Error> {
    let failed = |source| {
        Error::Atlas(eigenring_atlas::Error::Write {
            path: folder.to_owned(),
            source,
        })
    };
    std::fs::remove_dir_all(folder).map_err(failed)
}
