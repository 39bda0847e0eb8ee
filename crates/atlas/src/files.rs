//! Reading and writing: a file is complete or not there.

use crate::error::{Accepted, Error};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Writes a file under a temporary name in the same folder and renames it when it is complete. Folders are
/// made as needed.
///
/// # Errors
/// [`Error::Write`].
pub fn write(path: &Path, contents: &[u8]) -> Result<(), Error> {
    let failed = |source| Error::Write {
        path: path.to_owned(),
        source,
    };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut file = tempfile::Builder::new()
        .prefix(".eigenring-")
        .suffix(".tmp")
        .tempfile_in(folder)
        .map_err(failed)?;
    file.write_all(contents).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    // temporary files are private; results are as readable as any other file
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let permissions = std::fs::Permissions::from_mode(0o644);
        file.as_file().set_permissions(permissions).map_err(failed)?;
    }
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Fails early if a folder cannot be written to, before long work is done for it.
///
/// # Errors
/// [`Error::Write`].
pub fn check_writable(folder: &Path) -> Result<(), Error> {
    let failed = |source| Error::Write {
        path: folder.to_owned(),
        source,
    };
    std::fs::create_dir_all(folder).map_err(failed)?;
    tempfile::Builder::new()
        .prefix(".eigenring-")
        .suffix(".tmp")
        .tempfile_in(folder)
        .map_err(failed)?;
    Ok(())
}

/// The most that is read of a file: the largest certificate of a known scheme has 3 MB, and a device may
/// never end.
const MAX_BYTES: u64 = 1 << 26;

/// The text of a file of at most 64 MB.
///
/// # Errors
/// [`Error::Read`], also for what is no text; [`Error::InFile`] for a longer file.
pub fn read(path: &Path) -> Result<String, Error> {
    let failed = |source| Error::Read {
        path: path.to_owned(),
        source,
    };
    let file = std::fs::File::open(path).map_err(failed)?;
    let mut text = String::new();
    file.take(MAX_BYTES + 1).read_to_string(&mut text).map_err(failed)?;
    if text.len() as u64 > MAX_BYTES {
        let accepted = Accepted::Are("files up to that size".to_owned());
        return Err(Error::refused(format!("it is longer than {MAX_BYTES} bytes"), accepted).in_file(path));
    }
    Ok(text)
}

/// The size in bytes of a file that must be there and not be empty.
///
/// # Errors
/// [`Error::Read`], or [`Error::InFile`] for an empty one.
pub fn size(path: &Path) -> Result<u64, Error> {
    let size = std::fs::metadata(path).map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })?;
    match size.len() {
        0 => Err(Error::content("the file is empty").in_file(path)),
        size => Ok(size),
    }
}

/// All files below a folder, as sorted paths relative to it.
///
/// # Errors
/// [`Error::Read`].
pub fn below(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(next) = folders.pop() {
        let path = folder.join(&next);
        let failed = |source| Error::Read {
            path: path.clone(),
            source,
        };
        for entry in std::fs::read_dir(&path).map_err(failed)? {
            let name = next.join(entry.map_err(failed)?.file_name());
            if folder.join(&name).is_dir() {
                folders.push(name);
            } else {
                found.push(name);
            }
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_is_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sub/table.csv");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(read(&path).unwrap(), "two");
        let names: Vec<_> = std::fs::read_dir(path.parent().unwrap()).unwrap().collect();
        assert_eq!(names.len(), 1);
    }

    #[test]
    fn a_folder_that_is_a_file_is_not_writable() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        write(&path, b"").unwrap();
        assert!(matches!(check_writable(&path), Err(Error::Write { .. })));
        assert!(matches!(write(&path.join("x"), b""), Err(Error::Write { .. })));
    }
}
