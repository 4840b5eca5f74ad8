use crate::backend::BackendKind;

/// What the renderer cannot do. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// There are shaders in Rust and in GLSL.
    #[error("the renderer has no shaders in {language}; take rust or glsl")]
    NoSuchShaders {
        /// What was asked for.
        language: BackendKind,
    },
    /// A module is not inside the program.
    #[error("the renderer's module {module} is missing; `cargo xtask spirv` builds it")]
    NoModule {
        /// Its file.
        module: String,
    },
    /// A codec without an offset.
    #[error("{id} has no dithered shaders; take one of {}", super::shaders::dithered().collect::<Vec<_>>().join(", "))]
    NotDithered {
        /// Codec.
        id: &'static str,
    },
    /// Points that did not arrive.
    #[error("the device drew {drawn} of {wanted} points, each on a texel of its own: a fault of its driver")]
    NotDrawn {
        /// Those that were drawn.
        drawn: usize,
        /// Those there are.
        wanted: usize,
    },
    /// Samples that make no picture.
    #[error("a picture has 1 to {limit} samples in each direction of a pixel, not {samples}")]
    BadSamples {
        /// What was asked for.
        samples: u32,
        /// The most there are.
        limit: u32,
    },
}
