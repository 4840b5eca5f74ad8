//! The codecs in shading languages: their text, and kernels from it.

mod compile;
pub mod kernel;
mod text;

pub use compile::{compile, module, store_words, words_of};
pub use text::text;
pub use unitvec_languages::{EXACT, Edition, Language, UnknownLanguage};

use std::sync::OnceLock;
use unitvec_languages::Library;

/// Text that cannot be made, or not be compiled.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// See [`unitvec_languages::Error`].
    #[error(transparent)]
    Language(#[from] unitvec_languages::Error),
    /// A compiler rejects the text.
    #[error("the {language} of {kernel} does not compile: {error}")]
    Rejected {
        /// The language.
        language: Language,
        /// Kernel: `oct16_encode`.
        kernel: String,
        /// The compiler's words.
        error: String,
    },
    /// An encoder gives a word with bits above the code.
    #[error("{kernel} in {language} gives words with bits above the code")]
    BitsAbove {
        /// The language.
        language: Language,
        /// Kernel: `oct24_encode`.
        kernel: String,
    },
    /// No compiler for this language is part of the program.
    #[error("this program has no compiler for {0}; it has glslang for HLSL and naga for WGSL")]
    NoCompiler(Language),
    /// The kernel that decodes by a table is not written in this language.
    #[error("no kernel in {0} decodes by a table; take one from Rust or GLSL")]
    NoTable(Language),
}

/// The includes that are part of the program, parsed once.
///
/// # Errors
/// [`unitvec_languages::Error`], which a test rules out.
pub fn library() -> Result<&'static Library, unitvec_languages::Error> {
    static LIBRARY: OnceLock<Result<Library, unitvec_languages::Error>> = OnceLock::new();
    LIBRARY.get_or_init(|| Library::parse(unitvec_shaders::glsl)).as_ref().map_err(Clone::clone)
}
