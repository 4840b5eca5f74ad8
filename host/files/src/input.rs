//! Files read within bounds.

use crate::used::{is_device, note_read};
use crate::{Error, Result};
use std::fs::{DirEntry, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Opens a file, or the standard input for `-`. Returns its length where it is a file.
///
/// # Errors
/// Errors of opening, and one for a folder.
pub fn open(path: &Path) -> io::Result<(Box<dyn Read>, Option<u64>)> {
    note_read(path);
    if path == Path::new("-") {
        return Ok((Box::new(io::stdin().lock()), None));
    }
    let file = File::open(path)?;
    if is_device(path) {
        return Ok((Box::new(file), None));
    }
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    Ok((Box::new(file), metadata.is_file().then_some(metadata.len())))
}

/// Adds the files that are wanted in a folder and in those below it, in the order of their names. Links to folders are
/// left out, since they may lead back.
///
/// # Errors
/// [`Error::Read`] for a folder that cannot be read.
pub fn add_below(folder: &Path, is_wanted: &dyn Fn(&Path) -> bool, files: &mut Vec<PathBuf>) -> Result<()> {
    let entries = || std::fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>();
    let mut entries = entries().map_err(|source| Error::reading(folder, source))?;
    entries.sort_by_key(DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            true => add_below(&path, is_wanted, files)?,
            false if is_wanted(&path) && path.is_file() => files.push(path),
            false => {}
        }
    }
    Ok(())
}

/// Reads the whole of a file, or of the standard input for `-`, that should be small, such as a report of costs.
///
/// # Errors
/// [`Error::Read`], also if there are more than 64 MiB.
pub fn read_small(path: &Path) -> Result<Vec<u8>> {
    const MOST: usize = 1 << 26;
    let read = || {
        let mut bytes = Vec::new();
        open(path)?.0.take(MOST as u64 + 1).read_to_end(&mut bytes)?;
        match bytes.len() > MOST {
            true => Err(io::Error::other(format!("it has more than {MOST} bytes"))),
            false => Ok(bytes),
        }
    };
    read().map_err(|source| Error::reading(path, source))
}

/// Reads a file up to this length. A device or a pipe is refused: it might never end, or never begin.
///
/// # Errors
/// Errors of reading.
pub fn read_start(file: &Path, length: u64) -> io::Result<Vec<u8>> {
    let metadata = file.metadata()?;
    if !metadata.is_file() {
        return Err(io::Error::other("it is no file"));
    }
    let mut bytes = Vec::new();
    note_read(file);
    bytes.try_reserve_exact(usize::try_from(length.min(metadata.len())).unwrap_or(usize::MAX))?;
    File::open(file)?.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}
