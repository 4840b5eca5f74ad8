//! Kernels from HLSL and WGSL, by the compilers that are part of the program.

use super::kernel::{code_words, kernel};
use super::{Edition, Error, Language, library};
use crate::Result;
use crate::glsl;
use unitvec_catalogue::{AnyCodec, Operation};

/// The SPIR-V of a codec's kernel. Its entry point is [`ENTRY_POINT`](super::kernel::ENTRY_POINT), and its codes are
/// [whole words](words_of).
///
/// # Errors
/// The errors of [`compile`], or a function that the language does not have.
pub fn module(
    language: Language,
    edition: Edition,
    format: &AnyCodec,
    operation: Operation,
) -> Result<Vec<u8>> {
    let name = format.function(operation);
    let functions =
        library().and_then(|library| library.excerpt(&[&name], language, edition)).map_err(Error::from)?;
    compile(language, &name, &(functions + &kernel(language, format, operation)))
}

/// Stored codes as whole words, which these kernels take and give.
pub fn words_of(format: &AnyCodec, codes: &[u8]) -> Vec<u8> {
    let word = 4 * code_words(format);
    let mut words = vec![0; codes.len() / format.bytes * word];
    for (code, word) in codes.chunks_exact(format.bytes).zip(words.chunks_exact_mut(word)) {
        word[..format.bytes].copy_from_slice(code);
    }
    words
}

/// Stores the codes that these words are.
///
/// # Errors
/// [`Error::BitsAbove`], where a word is more than a code.
pub fn store_words(language: Language, format: &AnyCodec, words: &[u8], codes: &mut [u8]) -> Result<()> {
    let words = words.chunks_exact(4 * code_words(format));
    for (code, word) in codes.chunks_exact_mut(format.bytes).zip(words) {
        let (stored, above) = word.split_at(format.bytes);
        if above.iter().any(|byte| *byte != 0) {
            return Err(Error::BitsAbove { language, kernel: format.function(Operation::Encode) }.into());
        }
        code.copy_from_slice(stored);
    }
    Ok(())
}

/// The SPIR-V of a kernel's whole text in HLSL or WGSL, whose entry point is [`ENTRY_POINT`](super::kernel::ENTRY_POINT).
///
/// # Errors
/// [`Error::Rejected`], [`Error::NoCompiler`], or the error of a build without glslang.
pub fn compile(language: Language, name: &str, text: &str) -> Result<Vec<u8>> {
    let module = match language {
        Language::Hlsl => glsl::Compiler::new()?.compile_hlsl(name, text),
        Language::Wgsl => compile_wgsl(text),
        other => return Err(Error::NoCompiler(other).into()),
    };
    Ok(module.map_err(|error| Error::Rejected { language, kernel: name.to_owned(), error })?)
}

/// The SPIR-V that naga makes of WGSL.
fn compile_wgsl(text: &str) -> Result<Vec<u8>, String> {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| error.emit_to_string(text))?;
    let options = naga::back::spv::Options { lang_version: (1, 3), ..Default::default() };
    let words =
        naga::back::spv::write_vec(&module, &info, &options, None).map_err(|error| error.to_string())?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}
