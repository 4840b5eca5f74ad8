use crate::MAX_SAMPLES;
use std::path::PathBuf;
use unitvec_run::backend::BackendKind;

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of drawing or of a report. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A measurement or a backend failed.
    #[error(transparent)]
    Lab(#[from] unitvec_lab::Error),
    /// A file cannot be read or written.
    #[error(transparent)]
    Files(#[from] unitvec_files::Error),
    /// A mesh of the scene cannot be used.
    #[error(transparent)]
    Mesh(#[from] unitvec_mesh::MeshError),
    /// A language other than Rust and GLSL.
    #[error("the renderer has no shaders in {0}; take rust or glsl")]
    NoSuchShaders(BackendKind),
    /// A module's file is not inside the program.
    #[error("the renderer's module {0} is missing; `cargo xtask spirv` builds it")]
    NoModule(String),
    /// A codec without an offset.
    #[error("{id} has no dithered shaders; take one of {}", crate::shaders::dithered().collect::<Vec<_>>().join(", "))]
    NotDithered {
        /// Codec.
        id: &'static str,
    },
    /// Points that did not arrive.
    #[error("the device drew {drawn} of {wanted} points, each on a texel of its own: a fault of its driver")]
    NotDrawn {
        /// The number of points that were drawn.
        drawn: usize,
        /// The number of points in all.
        wanted: usize,
    },
    /// Samples that make no picture.
    #[error("a picture has 1 to {MAX_SAMPLES} samples in each direction of a pixel, not {0}")]
    BadSamples(u32),
    /// A chart.
    #[error("the chart cannot be drawn: {0}")]
    Chart(String),
    /// The figures of an earlier run.
    #[error(
        "{} is not of `unitvec figures`: {reason}; name another folder, or remove it and draw all figures again",
        .path.display()
    )]
    Earlier {
        /// The figures' file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// The report's template.
    #[error("the report's page cannot be made: {0}")]
    Page(String),
    /// The file of a picture that the report shows.
    #[error("the figures lack {0}; make them again with `unitvec figures`")]
    Lacking(String),
    /// A picture that differs from its description.
    #[error("{file} is not as its figures say: {reason}")]
    Unlike {
        /// The picture's file.
        file: String,
        /// The difference.
        reason: String,
    },
}

impl Error {
    /// True where the command line is at fault: the folder that it names has other figures than are needed.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::Earlier { .. } | Self::Lacking(_) | Self::Unlike { .. })
    }
}

unitvec_run::pass_on_errors!(
    Error::Lab:
    unitvec_catalogue::UnknownCodec,
    unitvec::slice::LengthMismatch,
    unitvec_vulkan::Error,
    unitvec_run::Error,
    unitvec_run::glsl::Error,
    unitvec_choose::Error
);
