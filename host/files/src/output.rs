//! Output files that exist whole or not at all.

#[cfg(target_os = "linux")]
use crate::unnamed;
use crate::used::{check_unused, is_device, is_stdout, note_written};
use crate::{Error, Result};
use std::fs::{File, OpenOptions};
use std::io::{self, IsTerminal, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// Names that temporary files and folders were given; those of finished ones are gone.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file being written. Until [`finish`](Self::finish) it has no name or, where the system has no such files, a temporary one in
/// the same folder; dropped before that, it leaves nothing behind. `-` is the standard output and a device or pipe is itself:
/// those are written directly. Another name of the standard output, such as `/dev/stdout`, is as `-`. A link stays, and the file
/// that it leads to is replaced.
pub struct Output {
    path: PathBuf,
    target: PathBuf,
    to: Destination,
    is_stdout: bool,
    is_terminal: bool,
}

enum Destination {
    /// A file without a name, which ends with the program, however that ends.
    #[cfg(target_os = "linux")]
    Unnamed(File),
    Named(NamedTempFile),
    Direct(Box<dyn Write>),
}

impl Output {
    /// Starts a file that will be `path`.
    ///
    /// # Errors
    /// [`Error::Write`] if its folder cannot be written to.
    pub fn create(path: &Path) -> Result<Self> {
        let error = |source| Error::writing(path, source);
        let is_stdout = is_stdout(path);
        let target = target(path).map_err(error)?;
        let (to, is_terminal) = open(&target, is_stdout).map_err(error)?;
        Ok(Self { path: path.to_owned(), target, to, is_stdout, is_terminal })
    }

    /// Creates as [`create`](Self::create) does, for binary data: a terminal would show noise, and might obey it.
    ///
    /// # Errors
    /// The errors of [`create`](Self::create), and [`Error::Terminal`].
    pub fn create_binary(path: &Path) -> Result<Self> {
        let output = Self::create(path)?;
        if output.is_terminal {
            return Err(Error::Terminal);
        }
        Ok(output)
    }

    /// True where the output is the standard output, by whatever name.
    pub fn is_stdout(&self) -> bool {
        self.is_stdout
    }

    /// The path it will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Replaces the first bytes, by as many as were written there or fewer; a stream has none to go back to.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn rewrite_start(&mut self, bytes: &[u8]) -> Result<()> {
        let rewritten = match self.to.file() {
            Some(file) => file.rewind().and_then(|()| file.write_all(bytes)),
            None => Err(io::Error::other("it is no file that can be gone back in; name a file")),
        };
        rewritten.map_err(|source| Error::writing(&self.path, source))
    }

    /// Flushes the file and gives it its name, replacing any file that had it.
    ///
    /// # Errors
    /// [`Error::Write`], also for a file that this run has read or written; the file that had the name is still there then.
    pub fn finish(mut self) -> Result<()> {
        let path = self.path.clone();
        let whole = match self.to.file() {
            Some(file) => check_unused(&self.target).and_then(|()| file.sync_all()),
            None => Ok(()),
        };
        // Held while there is a temporary name, so that an interrupt leaves none behind.
        let _held = TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner);
        let finished = whole.and_then(|()| match self.to {
            #[cfg(target_os = "linux")]
            Destination::Unnamed(file) => {
                let named = builder().make_in(folder_of(&self.target), |path| unnamed::link(&file, path))?;
                named.persist(&self.target).map(drop).map_err(|error| error.error)
            }
            Destination::Named(file) => file.persist(&self.target).map(drop).map_err(|error| error.error),
            Destination::Direct(mut writer) => writer.flush(),
        });
        finished.map(|()| note_written(&self.target)).map_err(|source| Error::writing(&path, source))
    }
}

impl Destination {
    /// The file that has its name to come. Its own errors do not tell the temporary name.
    fn file(&mut self) -> Option<&mut File> {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => Some(file),
            Self::Named(file) => Some(file.as_file_mut()),
            Self::Direct(_) => None,
        }
    }

    fn writer(&mut self) -> &mut dyn Write {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => file,
            Self::Named(file) => file.as_file_mut(),
            Self::Direct(writer) => writer,
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.to.writer().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.writer().flush()
    }
}

/// The path to write to. A link stays one: its target is replaced. The target has to exist, since a file that nobody
/// named would appear in an unknown place.
fn target(path: &Path) -> io::Result<PathBuf> {
    if is_device(path) {
        return Ok(path.to_owned());
    }
    if path.is_symlink() && path.metadata().is_err() {
        return Err(io::Error::other("it is a link to nothing"));
    }
    Ok(path.canonicalize().ok().or_else(|| of_any_length(path)).unwrap_or_else(|| path.to_owned()))
}

/// The path of a new file that Windows takes at any length: the folder's canonical path begins with `\\?\`.
fn of_any_length(path: &Path) -> Option<PathBuf> {
    if !cfg!(windows) || path.to_string_lossy().ends_with(std::path::is_separator) {
        return None;
    }
    let whole = std::path::absolute(path).ok()?;
    Some(whole.parent()?.canonicalize().ok()?.join(whole.file_name()?))
}

/// Opens the destination, and returns it with whether it is a terminal.
fn open(path: &Path, is_stdout: bool) -> io::Result<(Destination, bool)> {
    if is_stdout {
        check_unused(Path::new("-"))?;
        let stdout = io::stdout().lock();
        let is_terminal = stdout.is_terminal();
        return Ok((Destination::Direct(Box::new(stdout)), is_terminal));
    }
    let is_special = || path.metadata().is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir());
    if is_device(path) || is_special() {
        let file = OpenOptions::new().write(true).open(path)?;
        let is_terminal = file.is_terminal();
        return Ok((Destination::Direct(Box::new(file)), is_terminal));
    }
    if path.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let existing = path.metadata().ok().map(|metadata| metadata.permissions());
    if let Some(permissions) = &existing {
        // Rename would replace a file that must not be written to.
        OpenOptions::new().append(true).open(path)?;
        if cfg!(windows) && permissions.readonly() {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
    }
    let folder = folder_of(path);
    #[cfg(target_os = "linux")]
    if let Some(file) = unnamed::create(folder, existing.as_ref()) {
        return Ok((Destination::Unnamed(file), false));
    }
    let mut builder = builder();
    match existing {
        Some(permissions) => drop(builder.permissions(permissions)),
        None => plain_permissions(&mut builder),
    }
    // Held until the file is listed, so that an interrupt in between leaves none behind.
    let mut temporary = TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner);
    // The error's own text names the temporary file.
    let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    temporary.push(file.path().to_owned());
    Ok((Destination::Named(file), false))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A maker of temporary names.
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".unitvec-");
    builder
}

/// Makes a write beyond the size that the shell allows for files an error, where it would end the program.
pub fn fail_beyond_limits() {
    #[cfg(unix)]
    // Without it the program ends by the signal, and does no other harm.
    let _ = signal_hook::flag::register(rustix::process::Signal::XFSZ.as_raw(), Default::default());
}

/// Takes in a temporary folder, for [`remove_unfinished`].
pub fn remember(folder: &Path) {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).push(folder.to_owned());
}

/// Leaves a folder alone from here on.
pub fn forget(folder: &Path) {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| path != folder);
}

/// Removes the temporary files and folders of all unfinished outputs, for an interrupted program, in which nothing is
/// dropped.
pub fn remove_unfinished() {
    for path in TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        // Files that were finished or dropped are gone; for the others nobody is left to report an error to.
        let _ = if path.is_dir() { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
    }
}

/// Read and write for all, less the umask, as for a plain new file. Temporary files are private otherwise.
fn plain_permissions(builder: &mut tempfile::Builder<'_, '_>) {
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    #[cfg(not(unix))]
    let _ = builder;
}

/// Writes a whole small file, as [`Output`] does.
///
/// # Errors
/// [`Error::Write`].
pub fn write_file(path: &Path, content: &[u8]) -> Result<()> {
    let mut output = Output::create(path)?;
    output.write_all(content).map_err(|source| Error::writing(path, source))?;
    output.finish()
}
