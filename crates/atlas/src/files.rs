//! Reading and writing: a file is complete or not there.

use crate::error::{Accepted, Error};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Whether writing makes a file of this name, which takes the place of one that is there: not so for devices
/// and pipes, which are written into.
pub fn is_replaced(path: &Path) -> bool {
    // what a shell has opened for somebody else is not ours to replace, even if it is a file
    let opened = ["/dev", "/proc"].iter().any(|folder| path.starts_with(folder));
    !opened && std::fs::metadata(path).map_or(true, |there| there.is_file() || there.is_dir())
}

/// Writes a file under a temporary name in the same folder and renames it when it is complete. Folders are
/// made as needed, links are followed, and devices and pipes are written into.
///
/// # Errors
/// [`Error::Write`].
pub fn write(path: &Path, contents: &[u8]) -> Result<(), Error> {
    write_by(path, &|file| file.write_all(contents))
}

/// The same of contents that need not be in memory all at once: `fill` writes them.
///
/// # Errors
/// [`Error::Write`].
pub fn write_by(path: &Path, fill: &dyn Fn(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Error> {
    let failed = |source| Error::Write {
        path: path.to_owned(),
        source,
    };
    if !is_replaced(path) {
        let mut device = std::fs::File::options().write(true).open(path).map_err(failed)?;
        return match fill(&mut device).and_then(|()| device.flush()) {
            // a reader that has gone away is no error
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
            result => result.map_err(failed),
        };
    }
    // a link stays one, and what it leads to is replaced
    let target = match path.is_symlink() {
        true => path.canonicalize().map_err(failed)?,
        false => path.to_owned(),
    };
    let path = target.as_path();
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
    fill(&mut file).map_err(failed)?;
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
    String::from_utf8(read_bytes(path)?).map_err(|_| Error::Read {
        path: path.to_owned(),
        source: std::io::Error::new(std::io::ErrorKind::InvalidData, "stream did not contain valid UTF-8"),
    })
}

/// What a file of at most 64 MB holds; `-` is standard input.
///
/// # Errors
/// [`Error::Read`]; [`Error::InFile`] for a longer file.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let failed = |source| Error::Read {
        path: path.to_owned(),
        source,
    };
    let input: Box<dyn Read> = match path == Path::new("-") {
        true => Box::new(std::io::stdin()),
        false => Box::new(std::fs::File::open(path).map_err(failed)?),
    };
    let mut bytes = Vec::new();
    input.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > MAX_BYTES {
        let accepted = Accepted::Are("files up to that size".to_owned());
        return Err(Error::refused(format!("it is longer than {MAX_BYTES} bytes"), accepted).in_file(path));
    }
    Ok(bytes)
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

    #[cfg(unix)]
    #[test]
    fn devices_are_written_into_and_links_stay() {
        use std::os::unix::fs::FileTypeExt;
        let null = Path::new("/dev/null");
        write(null, b"gone").unwrap();
        assert!(std::fs::metadata(null).unwrap().file_type().is_char_device());
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        write(&file, b"one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"two").unwrap();
        assert!(link.is_symlink());
        assert_eq!(read(&file).unwrap(), "two");
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
