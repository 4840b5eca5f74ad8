use crate::input;
use std::path::{Path, PathBuf};

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Anything that stops a command. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written.
    #[error(transparent)]
    Files(#[from] unitvec_files::Error),
    /// A mesh cannot be used.
    #[error(transparent)]
    Mesh(#[from] unitvec_mesh::MeshError),
    /// A texture cannot be read or written.
    #[error(transparent)]
    Texture(#[from] unitvec_texture::Error),
    /// A backend failed, or a codec or device is unknown.
    #[error(transparent)]
    Run(#[from] unitvec_run::Error),
    /// Costs cannot be had.
    #[error(transparent)]
    Choose(#[from] unitvec_choose::Error),
    /// A measurement failed.
    #[cfg(feature = "lab")]
    #[error(transparent)]
    Lab(unitvec_lab::Error),
    /// A figure or a report cannot be made.
    #[cfg(feature = "render")]
    #[error(transparent)]
    Render(unitvec_render::Error),
    /// See [`unitvec_link::Error`].
    #[error("{} cannot be linked: {error}", .path.display())]
    Link {
        /// Path of the module.
        path: PathBuf,
        /// Cause.
        error: unitvec_link::Error,
    },
    /// The options do not go together.
    #[error("{0}")]
    Usage(String),
    /// A file that is neither a mesh nor a texture and does not have the name of raw floats.
    #[error(
        "{} is neither a mesh (.obj, .ply, .gltf, .glb), nor a texture (.png, .jpeg, .tga, .exr, .ktx2, .dds), nor named as raw f32 \
         (.{}); export it as .glb or .obj, or, if it is raw f32, add --raw",
        .path.display(),
        input::RAW_ENDINGS.join(", .")
    )]
    UnknownInput {
        /// The file's path.
        path: PathBuf,
    },
    /// Text where raw floats were expected.
    #[error(
        "{} is text, not raw f32; save a mesh as .obj or .glb and name that file, or, if it is raw f32, add --raw",
        .path.display()
    )]
    TextInput {
        /// The file's path.
        path: PathBuf,
    },
    /// A backend decoded a vector that has a direction to NaN or infinity.
    #[error(
        "{id} decodes vector {index} of {} to NaN or infinity, a fault of the backend: check it with `unitvec conform`",
        .path.display()
    )]
    NotFinite {
        /// Codec.
        id: &'static str,
        /// The element's place in the file, counted from 0.
        index: u64,
        /// The file.
        path: PathBuf,
    },
    /// Codes that differ from their header.
    #[error("the codes in {} are not those that its header is of; encode the mesh again, or copy the file again", .path.display())]
    Damaged {
        /// The file's path.
        path: PathBuf,
    },
    /// Some of several inputs failed, and were told of.
    #[error("{failed} of {all} inputs failed{}", if failed < all { "; the others are done" } else { "" })]
    Some {
        /// Number that failed.
        failed: usize,
        /// Number of all.
        all: usize,
    },
    /// Input that ends within an element.
    #[error(
        "{} ends after {whole} whole {unit} and {left} bytes of another; is it cut short, or of another format?",
        .path.display()
    )]
    Truncated {
        /// Path of the input.
        path: PathBuf,
        /// Whole elements read.
        whole: u64,
        /// Element, in plural, with its size.
        unit: String,
        /// Bytes after the last whole element.
        left: usize,
    },
}

unitvec_run::pass_on_errors!(
    Error::Run:
    unitvec_catalogue::UnknownCodec,
    unitvec::slice::LengthMismatch,
    unitvec_vulkan::Error,
    unitvec_manifest::modules::Error,
    unitvec_run::glsl::Error,
    unitvec_run::shader::Error
);

// An error of a lower crate is the same error, whichever crate passed it on.

#[cfg(feature = "lab")]
impl From<unitvec_lab::Error> for Error {
    fn from(error: unitvec_lab::Error) -> Self {
        match error {
            unitvec_lab::Error::Run(error) => Self::Run(error),
            unitvec_lab::Error::Choose(error) => Self::Choose(error),
            error => Self::Lab(error),
        }
    }
}

#[cfg(feature = "lab")]
impl From<unitvec_lab::isa::stand_in::Error> for Error {
    fn from(error: unitvec_lab::isa::stand_in::Error) -> Self {
        Self::Lab(error.into())
    }
}

#[cfg(feature = "render")]
impl From<unitvec_render::Error> for Error {
    fn from(error: unitvec_render::Error) -> Self {
        match error {
            unitvec_render::Error::Lab(error) => error.into(),
            unitvec_render::Error::Files(error) => Self::Files(error),
            unitvec_render::Error::Mesh(error) => Self::Mesh(error),
            error => Self::Render(error),
        }
    }
}

impl Error {
    /// The error of an input that ends `left` bytes after so many whole elements of `size` bytes.
    pub(crate) fn truncated(path: &Path, whole: u64, unit: &str, size: usize, left: usize) -> Self {
        Self::Truncated { path: path.to_owned(), whole, unit: format!("{unit} of {size} bytes"), left }
    }

    /// True where the command line itself is at fault, which exits with status 2 instead of 1.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Usage(_) | Self::UnknownInput { .. } | Self::TextInput { .. } => true,
            Self::Files(error) => error.is_usage(),
            Self::Texture(error) => error.is_usage(),
            Self::Run(error) => error.is_usage(),
            Self::Choose(unitvec_choose::Error::UnknownGpu { .. }) => true,
            #[cfg(feature = "render")]
            Self::Render(error) => error.is_usage(),
            _ => false,
        }
    }
}
