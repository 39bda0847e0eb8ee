//! Standard output, and the files that commands write beside it.
//!
//! A file is complete or not there; a device or a pipe is written into. Every file is named on standard error
//! as soon as it is written, unless the command lists its files itself.

use crate::error::Error;
use crate::progress::{note, say};
pub use eigenring_atlas::files::{below, read, read_bytes, size};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes to standard output, or to a file if one is given. A reader that has gone away is no error.
pub fn emit(out: Option<&Path>, contents: &[u8]) -> Result<(), Error> {
    emit_by(out, &|out| out.write_all(contents))
}

/// The same of contents that need not be in memory all at once: `fill` writes them.
pub fn emit_by(out: Option<&Path>, fill: &dyn Fn(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Error> {
    if let Some(path) = out {
        if let Some(folder) = path.parent() {
            announce(folder);
        }
        eigenring_atlas::files::write_by(path, fill)?;
        if eigenring_atlas::files::is_replaced(path) {
            say(&format!("wrote {}", path.display()));
        }
        return Ok(());
    }
    crate::progress::pause(|| {
        let mut stdout = std::io::stdout().lock();
        match fill(&mut stdout).and_then(|()| stdout.flush()) {
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
            result => result.map_err(Error::Output),
        }
    })
}

/// Writes a file and says so.
pub fn save(path: &Path, contents: &[u8]) -> Result<(), Error> {
    write(path, contents)?;
    if eigenring_atlas::files::is_replaced(path) {
        say(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// Writes a file that the command lists itself, or none that a user would look for.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), Error> {
    if let Some(folder) = path.parent() {
        announce(folder);
    }
    Ok(eigenring_atlas::files::write(path, contents)?)
}

/// Fails early if a folder, which is that of the output or below it, cannot be written to, before long work
/// is done for it.
pub fn check_writable(out: &Path, folder: &Path) -> Result<(), Error> {
    announce(out);
    Ok(eigenring_atlas::files::check_writable(folder)?)
}

/// Says which folders are about to be made, if there is more than one: the others may be spelled wrongly.
fn announce(folder: &Path) {
    let missing: Vec<&Path> = folder
        .ancestors()
        .take_while(|part| !part.as_os_str().is_empty() && !part.exists())
        .collect();
    if missing.len() > 1 {
        note(&format!("{} is made, with the folders above it", folder.display()));
    }
}

/// Files that a command writes, to be listed at its end.
#[derive(Debug, Default)]
pub struct Written(Vec<PathBuf>);

impl Written {
    /// Writes a file.
    pub fn write(&mut self, path: PathBuf, contents: &[u8]) -> Result<(), Error> {
        write(&path, contents)?;
        self.0.push(path);
        Ok(())
    }

    /// The list, a file a line.
    pub fn list(&self) -> String {
        self.0.iter().map(|path| format!("{}\n", path.display())).collect()
    }

    /// Names the files on standard error.
    pub fn say(&self) {
        self.0.iter().for_each(|path| say(&format!("wrote {}", path.display())));
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
