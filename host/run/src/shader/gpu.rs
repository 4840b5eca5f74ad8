//! The functions of a shading language on a Vulkan device, by way of the compilers that are part of the program.

use super::kernel::{ENTRY_POINT, code_words, kernel};
use super::{Edition, Error, Language, library};
use crate::Result;
use crate::backend::{Backend, CHUNK};
use crate::glsl;
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Operation};
use unitvec_vulkan::{Device, Kernel, Runner};

/// A backend that runs HLSL, compiled by glslang, or WGSL, compiled by naga.
pub struct LanguageGpu {
    runner: Runner,
    language: Language,
    edition: Edition,
    kernels: HashMap<(&'static str, Operation), Kernel>,
    /// Codes as whole words, which is what the kernels take and give.
    words: Vec<u32>,
}

impl LanguageGpu {
    /// A backend on `device`. Output that a kernel fails to write cannot pass for its result.
    ///
    /// # Errors
    /// A failed Vulkan call.
    pub fn new(device: &Arc<Device>, language: Language, edition: Edition) -> Result<Self> {
        let runner = Runner::new(device, CHUNK, true)?;
        Ok(Self { runner, language, edition, kernels: HashMap::new(), words: Vec::new() })
    }

    fn kernel(&mut self, format: &AnyCodec, operation: Operation) -> Result<()> {
        let key = (format.id, operation);
        if !self.kernels.contains_key(&key) {
            let name = format.function(operation);
            let functions = library()
                .and_then(|library| library.excerpt(&[&name], self.language, self.edition))
                .map_err(Error::from)?;
            let text = functions + &kernel(self.language, format, operation);
            let module = compile(self.language, &name, &text)?;
            let kernel = self.runner.kernel(&module, ENTRY_POINT, None)?;
            self.kernels.insert(key, kernel);
        }
        Ok(())
    }
}

impl Backend for LanguageGpu {
    fn encode(&mut self, format: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        if count == 0 {
            return Ok(());
        }
        self.kernel(format, Operation::Encode)?;
        self.words.resize(count * code_words(format), 0);
        let kernel = &self.kernels[&(format.id, Operation::Encode)];
        let output = bytemuck::cast_slice_mut(&mut self.words);
        self.runner.run(kernel, count, bytemuck::cast_slice(elements), output)?;
        let words = self.words.chunks_exact(code_words(format));
        for (code, words) in codes.chunks_exact_mut(format.bytes).zip(words) {
            let (stored, above) = bytemuck::cast_slice::<_, u8>(words).split_at(format.bytes);
            if above.iter().any(|byte| *byte != 0) {
                let (language, kernel) = (self.language, format.function(Operation::Encode));
                return Err(Error::BitsAbove { language, kernel }.into());
            }
            code.copy_from_slice(stored);
        }
        Ok(())
    }

    fn decode(&mut self, format: &AnyCodec, codes: &[u8], elements: &mut [f32]) -> Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        if count == 0 {
            return Ok(());
        }
        self.kernel(format, Operation::Decode)?;
        self.words.clear();
        self.words.resize(count * code_words(format), 0);
        let words = self.words.chunks_exact_mut(code_words(format));
        for (code, words) in codes.chunks_exact(format.bytes).zip(words) {
            bytemuck::cast_slice_mut(words)[..format.bytes].copy_from_slice(code);
        }
        let kernel = &self.kernels[&(format.id, Operation::Decode)];
        let input = bytemuck::cast_slice(&self.words);
        self.runner.run(kernel, count, input, bytemuck::cast_slice_mut(elements))?;
        Ok(())
    }
}

/// The SPIR-V of a kernel's whole text in HLSL or WGSL, whose entry point is [`ENTRY_POINT`].
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
