use std::path::{Path, PathBuf};

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// A texture that cannot be read, or not be written as asked. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// See [`unitvec_files::Error`].
    #[error(transparent)]
    Files(#[from] unitvec_files::Error),
    /// The file is damaged, or its parser does not know it.
    #[error("cannot read {} as {format}: {reason}; check that the file is whole, or export it again", .path.display())]
    Damaged {
        /// The file's path.
        path: PathBuf,
        /// `png`, `tga`, `exr`, `ktx2` or `dds`.
        format: &'static str,
        /// The fault, in one line.
        reason: String,
    },
    /// The file is whole, and holds something other than a map of vectors, or codes of another codec.
    #[error("{} {what}", .path.display())]
    Unsupported {
        /// The file's path.
        path: PathBuf,
        /// The property and the remedy.
        what: String,
    },
    /// The codec does not go with the format or the option.
    #[error("{codec} {what}")]
    Codec {
        /// Codec.
        codec: &'static str,
        /// The obstacle and the remedy.
        what: String,
    },
    /// A dds or png cannot hold what it should.
    #[error("cannot make the {format}: {reason}; name an OUT that ends in .ktx2")]
    Output {
        /// `png` or `dds`.
        format: &'static str,
        /// The obstacle, in one line.
        reason: String,
    },
}

impl Error {
    pub(crate) fn damaged(path: &Path, format: &'static str, reason: impl std::fmt::Display) -> Self {
        Self::Damaged { path: path.to_owned(), format, reason: unitvec_files::one_line(reason) }
    }

    pub(crate) fn unsupported(path: &Path, what: impl Into<String>) -> Self {
        Self::Unsupported { path: path.to_owned(), what: what.into() }
    }

    /// True where the command line is at fault.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Codec { .. } | Self::Output { .. } => true,
            Self::Files(error) => error.is_usage(),
            _ => false,
        }
    }
}
