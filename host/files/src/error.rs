use std::io;
use std::path::{Path, PathBuf};

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// A file that cannot be read or written. Each message is one line that names the file and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The reader of the standard output, or of another pipe, has gone away: no fault, and nothing more to do.
    #[error("the output was closed by its reader")]
    ReaderGone,
    /// Binary output would go to a terminal.
    #[error("the output is binary and would go to the terminal; name a file instead, or redirect: > FILE")]
    Terminal,
    /// A file or pipe cannot be read.
    #[error("cannot read {}: {}", .path.display(), reason(source))]
    Read {
        /// The file's path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// A file or pipe cannot be written; any file of that name is as before.
    #[error("cannot write {}: {}", .path.display(), obstacle(.path, source))]
    Write {
        /// The file's path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
}

impl Error {
    /// The error of reading `path`.
    pub fn reading(path: &Path, source: io::Error) -> Self {
        Self::Read { path: path.to_owned(), source }
    }

    /// The error of writing to `path`, `-` being the standard output.
    pub fn writing(path: &Path, source: io::Error) -> Self {
        if source.kind() == io::ErrorKind::BrokenPipe {
            return Self::ReaderGone;
        }
        let path = if path == Path::new("-") { Path::new("the standard output") } else { path };
        Self::Write { path: path.to_owned(), source }
    }

    /// True where the command line is at fault.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::Terminal)
    }
}

/// Why a file cannot be read, and the remedy.
fn reason(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => "there is no such file; check its name and folder".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder; name a file in it".to_owned(),
        io::ErrorKind::UnexpectedEof => "it ends early; is it cut short?".to_owned(),
        io::ErrorKind::Other => source.to_string(),
        _ => format!("{source}; check that it may be read"),
    }
}

/// Why a file or folder cannot be written, and the remedy.
fn obstacle(path: &Path, source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => match path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            Some(folder) => format!("there is no folder {}; make it first", folder.display()),
            None => "the folder of this command is gone; change to another".to_owned(),
        },
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            format!(
                "{source}; a file stands where a folder has to be: name another path, or move the file away"
            )
        }
        io::ErrorKind::IsADirectory => {
            "a folder has this name: name another path, or move the folder away".to_owned()
        }
        io::ErrorKind::PermissionDenied if path.is_file() => {
            "access denied: it is read-only or another program has it open; allow writing, or name another path".to_owned()
        }
        io::ErrorKind::Other => source.to_string(),
        _ => format!("{source}; check that its folder may be written to and has room"),
    }
}
