//! Files that this run has read or written, which no output replaces.

use std::collections::HashSet;
#[cfg(unix)]
use std::fs::{File, Metadata};
use std::io;
#[cfg(unix)]
use std::os::fd::AsFd;
use std::path::{Component, Path, Prefix};
use std::sync::{LazyLock, Mutex, PoisonError};

/// A file, by whatever name: device and number.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = std::path::PathBuf;

static USED: LazyLock<Mutex<HashSet<Identity>>> = LazyLock::new(Mutex::default);

/// Notes that a file is read; `-` is that behind the standard input.
pub fn note_read(path: &Path) {
    note(identity(path, io::stdin()));
}

/// Notes that a file was written.
pub(crate) fn note_written(path: &Path) {
    note(identity(path, io::stdout()));
}

fn note(identity: Option<Identity>) {
    USED.lock().unwrap_or_else(PoisonError::into_inner).extend(identity);
}

/// Refuses an output that this run has read or written, such as a buffer of a glTF file; `-` is the file behind the standard
/// output.
///
/// # Errors
/// One that says so.
pub fn check_unused(path: &Path) -> io::Result<()> {
    let used = USED.lock().unwrap_or_else(PoisonError::into_inner);
    match identity(path, io::stdout()).is_some_and(|identity| used.contains(&identity)) {
        true => Err(io::Error::other("this run has read or written it; give the output another name")),
        false => Ok(()),
    }
}

/// True where what is read and what is written are one file, by links of any kind; `-` is the file that the standard
/// input, or output, was redirected to.
pub fn is_same_file(read: &Path, written: &Path) -> bool {
    let [read, written] = [identity(read, io::stdin()), identity(written, io::stdout())];
    read.is_some() && read == written
}

/// The identity of a file, of that behind the stream for `-`.
#[cfg(unix)]
fn identity(path: &Path, stream: impl AsFd) -> Option<Identity> {
    let metadata = if path == Path::new("-") { behind(stream) } else { path.metadata() };
    metadata.ok().filter(Metadata::is_file).map(|metadata| identity_of(&metadata))
}

#[cfg(unix)]
fn identity_of(metadata: &Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino())
}

#[cfg(unix)]
fn behind(stream: impl AsFd) -> io::Result<Metadata> {
    File::from(stream.as_fd().try_clone_to_owned()?).metadata()
}

#[cfg(not(unix))]
fn identity<S>(path: &Path, _: S) -> Option<Identity> {
    if is_device(path) { None } else { path.canonicalize().ok() }
}

/// True for a name that Windows keeps for a device or a pipe: `NUL`, `CON`, `\\.\pipe\name`. Windows tells nothing else of those,
/// and a look at a pipe opens it.
pub(crate) fn is_device(path: &Path) -> bool {
    let whole = std::path::absolute(path).unwrap_or_default();
    matches!(whole.components().next(), Some(Component::Prefix(it)) if matches!(it.kind(), Prefix::DeviceNS(_)))
}

/// True for `-` and, where the system shows it, for a path that the standard output is open to.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new("-") || is_open_as_stdout(path)
}

#[cfg(unix)]
fn is_open_as_stdout(path: &Path) -> bool {
    let is_it =
        |stdout: &Metadata| path.metadata().is_ok_and(|data| identity_of(&data) == identity_of(stdout));
    behind(io::stdout()).is_ok_and(|stdout| is_it(&stdout))
}

#[cfg(not(unix))]
fn is_open_as_stdout(_: &Path) -> bool {
    false
}
