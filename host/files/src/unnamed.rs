//! Files that have no name before they are whole.

use rustix::fs::{AtFlags, CWD, OFlags, linkat};
use std::fs::{File, OpenOptions, Permissions};
use std::io;
use std::os::fd::AsRawFd;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// The path by which the kernel shows an open file.
fn shown(file: &File) -> PathBuf {
    format!("/proc/self/fd/{}", file.as_raw_fd()).into()
}

/// Opens a file that is in no folder yet, and can be linked into this one. `None` where the file system has none, or where
/// no /proc shows it.
pub fn create(folder: &Path, permissions: Option<&Permissions>) -> Option<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).mode(0o666).custom_flags(OFlags::TMPFILE.bits().cast_signed());
    let file = options.open(folder).ok()?;
    permissions.map_or(Ok(()), |permissions| file.set_permissions(permissions.clone())).ok()?;
    shown(&file).is_symlink().then_some(file)
}

/// Gives a file a name that nothing has.
pub fn link(file: &File, path: &Path) -> io::Result<()> {
    Ok(linkat(CWD, shown(file), CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}
