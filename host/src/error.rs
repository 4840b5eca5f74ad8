use crate::isa::radv;
use crate::{catalogue, glsl, imprecise, input, link, mesh, modules, render, shader, vulkan};
use std::io;
use std::path::{Path, PathBuf};

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Anything that stops a command. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// See [`catalogue::UnknownCodec`].
    #[error(transparent)]
    UnknownCodec(#[from] catalogue::UnknownCodec),
    /// See [`vulkan::Error`].
    #[error(transparent)]
    Vulkan(#[from] vulkan::Error),
    /// See [`modules::Error`].
    #[error(transparent)]
    Modules(#[from] modules::Error),
    /// See [`glsl::Error`].
    #[error(transparent)]
    Glsl(#[from] glsl::Error),
    /// See [`shader::Error`].
    #[error(transparent)]
    Shader(#[from] shader::Error),
    /// See [`radv::Error`].
    #[error(transparent)]
    Radv(#[from] radv::Error),
    /// See [`imprecise::Error`].
    #[error(transparent)]
    Imprecise(#[from] imprecise::Error),
    /// See [`render::Error`].
    #[error(transparent)]
    Render(#[from] render::Error),
    /// See [`mesh::MeshError`].
    #[error(transparent)]
    Mesh(#[from] mesh::MeshError),
    /// See [`link::Error`].
    #[error("{} cannot be linked: {error}", .path.display())]
    Link {
        /// Path of the module.
        path: PathBuf,
        /// Cause.
        error: link::Error,
    },
    /// The options do not go together.
    #[error("{0}")]
    Usage(String),
    /// The reader of the standard output, or of another pipe, has gone away: no fault, and nothing more to do.
    #[error("the output was closed by its reader")]
    ReaderGone,
    /// A slice function was given the wrong sizes.
    #[error(transparent)]
    LengthMismatch(#[from] unitvec::slice::LengthMismatch),
    /// A file or pipe cannot be read.
    #[error("cannot read {}: {source}; check that it exists and may be read", .path.display())]
    Read {
        /// Its path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// A file that is no mesh and does not have the name of raw floats.
    #[error(
        "{} is neither a mesh (.obj, .ply, .gltf, .glb) nor named as raw f32 (.{}); export it as .glb or .obj, or, if it is \
         raw f32, add --raw",
        .path.display(),
        input::RAW_ENDINGS.join(", .")
    )]
    UnknownInput {
        /// Its path.
        path: PathBuf,
    },
    /// Text where raw floats were expected.
    #[error(
        "{} is text, not raw f32; save a mesh as .obj or .glb and name that file, or, if it is raw f32, add --raw",
        .path.display()
    )]
    TextInput {
        /// Its path.
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
        /// Its place in the file, counted from 0.
        index: u64,
        /// The file.
        path: PathBuf,
    },
    /// A file or pipe cannot be written; a file of that name, if there was one, is as before.
    #[error("cannot write {}: {source}; {}", .path.display(), remedy(source))]
    Write {
        /// Its path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// Costs to choose by that are not a report of `unitvec bench`.
    #[error("{} is not a report of `unitvec bench --json`: {reason}", .path.display())]
    BadCosts {
        /// Its path.
        path: PathBuf,
        /// What the parser says.
        reason: String,
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

/// What a parser says, as one line: it may quote the input at length. The mark that it may end with is left out, since the
/// message goes on.
pub(crate) fn one_line(text: impl std::fmt::Display) -> String {
    const MAX_CHARS: usize = 200;
    let mut line = String::new();
    let text = text.to_string();
    let words = text.split(|c: char| c.is_whitespace() || c.is_control()).filter(|word| !word.is_empty());
    for (at, char) in words.flat_map(|word| [" ", word]).flat_map(str::chars).skip(1).enumerate() {
        if at == MAX_CHARS {
            return line + "...";
        }
        line.push(char);
    }
    line.truncate(line.trim_end_matches([';', '.', ' ']).len());
    line
}

/// What to do about a file or folder that cannot be written.
fn remedy(source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file stands where a folder has to be: name another path, or move the file away"
        }
        io::ErrorKind::IsADirectory => "a folder has this name: name another path, or move the folder away",
        _ => "check that its folder exists, may be written to and has room",
    }
}

impl Error {
    /// The error of writing to `path`, `-` being the standard output.
    pub fn writing(path: &Path, source: io::Error) -> Self {
        if source.kind() == io::ErrorKind::BrokenPipe {
            return Self::ReaderGone;
        }
        let path = if path == Path::new("-") { Path::new("the standard output") } else { path };
        Self::Write { path: path.to_owned(), source }
    }

    /// The error of an input that ends `left` bytes after so many whole elements of `size` bytes.
    pub(crate) fn truncated(path: &Path, whole: u64, unit: &str, size: usize, left: usize) -> Self {
        Self::Truncated { path: path.to_owned(), whole, unit: format!("{unit} of {size} bytes"), left }
    }

    /// True where the command line itself is at fault, which exits with status 2 instead of 1.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Usage(_)
                | Self::UnknownCodec(_)
                | Self::UnknownInput { .. }
                | Self::TextInput { .. }
                | Self::Vulkan(vulkan::Error::UnknownDevice { .. })
        )
    }
}
