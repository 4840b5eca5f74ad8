//! The GLSL kernels, compiled at run time by glslang through shaderc. Without the feature `glsl` there is no compiler:
//! [`Compiler::new`] says so.

#[cfg(feature = "glsl")]
mod glslang;
#[cfg(not(feature = "glsl"))]
#[path = "glsl/no_glslang.rs"]
mod glslang;

use crate::catalogue::{Element, Format, Operation, UnknownCodec};
use crate::manifest;
use crate::render::shaders;
use crate::textbook::Textbook;
use glslang::Glslang;
use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

/// GLSL that could not be compiled to SPIR-V.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The program was built without the feature `glsl`.
    #[error("this build has no GLSL compiler; rebuild with `--features glsl`, as `cargo xtask` does")]
    NotBuiltIn,
    /// shaderc could not create a compiler.
    #[error("the GLSL compiler (shaderc) cannot be started: {0}")]
    NoCompiler(String),
    /// There is no such source file.
    #[error("there is no file {file}")]
    NoSource {
        /// Path in the repository.
        file: String,
    },
    /// A function of `glsl/textbook/` has no codec.
    #[error("glsl/textbook, {id}: {error}")]
    NoCodec {
        /// Identifier in [`TEXTBOOK`](crate::textbook::TEXTBOOK).
        id: &'static str,
        /// The codec that it names.
        error: UnknownCodec,
    },
    /// glslang rejects the source.
    #[error("{file} does not compile for {kernel}: {error}")]
    Rejected {
        /// Path in the repository.
        file: String,
        /// Kernel: `oct16_encode`.
        kernel: String,
        /// glslang's words.
        error: String,
    },
}

/// The languages that glslang takes.
#[derive(Clone, Copy)]
enum SourceLanguage {
    Glsl,
    Hlsl,
}

/// The stages of shaders that glslang takes here.
#[derive(Clone, Copy)]
enum Stage {
    Compute,
    Vertex,
    Fragment,
}

/// What glslang compiles.
#[cfg_attr(not(feature = "glsl"), expect(dead_code, reason = "only glslang reads them"))]
struct Source<'a> {
    language: SourceLanguage,
    stage: Stage,
    /// Its name, which includes are relative to.
    file: &'a str,
    text: &'a str,
}

/// The folder of the renderer's shaders, in the repository.
const RENDER_SHADERS: &str = "host/render-shaders/glsl";

/// Name of the entry point of all GLSL kernels.
pub const ENTRY_POINT: &str = "main";

/// Kernels of codecs that this process has compiled. glslang takes about a tenth of a second for each, and several devices,
/// threads and tests want the same ones.
static KERNELS: LazyLock<Mutex<HashMap<(&str, Operation), Vec<u8>>>> = LazyLock::new(Mutex::default);

/// A GLSL compiler.
pub struct Compiler(Glslang);

impl Compiler {
    /// Starts glslang.
    ///
    /// # Errors
    /// [`Error::NotBuiltIn`] or [`Error::NoCompiler`].
    pub fn new() -> Result<Self, Error> {
        Glslang::new().map(Self)
    }

    /// The SPIR-V of a codec's kernel, optimised; its entry point is [`ENTRY_POINT`]. A process compiles each kernel once.
    ///
    /// # Errors
    /// [`Error::NoSource`] or [`Error::Rejected`].
    pub fn kernel(&self, format: Format, operation: Operation) -> Result<Vec<u8>, Error> {
        let (key, kernels) =
            ((format.id, operation), || KERNELS.lock().unwrap_or_else(PoisonError::into_inner));
        if let Some(module) = kernels().get(&key) {
            return Ok(module.clone());
        }
        let (file, function) = (format!("{operation}.comp"), format.function(operation));
        let module = self.kernel_file(&file, &function, &macros(format, operation, &function))?;
        kernels().insert(key, module.clone());
        Ok(module)
    }

    /// The SPIR-V of the kernel of a function of `glsl/textbook/`, optimised. An encoder by table, where the
    /// [format](Textbook::format) says so, reads that of [`best_fit_table`](crate::textbook::best_fit_table).
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel), and [`Error::NoCodec`].
    pub fn textbook_kernel(&self, textbook: &Textbook, operation: Operation) -> Result<Vec<u8>, Error> {
        let format = textbook.format().map_err(|error| Error::NoCodec { id: textbook.id, error })?;
        let function = textbook.function(operation);
        let mut macros = macros(format, operation, &function);
        macros.push(("TEXTBOOK".into(), "1".into()));
        self.kernel_file(&format!("{operation}.comp"), &function, &macros)
    }

    /// The SPIR-V of the kernel that measures a codec's arithmetic.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn cost_kernel(&self, format: Format, operation: Operation) -> Result<Vec<u8>, Error> {
        let function = format.function(operation);
        self.kernel_file(&format!("{operation}_cost.comp"), &function, &macros(format, operation, &function))
    }

    /// The SPIR-V of the kernel that measures what the others do besides encoding or decoding.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn baseline_kernel(&self, operation: Operation) -> Result<Vec<u8>, Error> {
        self.kernel_file(&format!("{operation}_cost.comp"), "baseline", &[])
    }

    /// The SPIR-V of a kernel that reads and writes as many bytes as a codec's, and does nothing else.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn copy_kernel(&self, format: Format, operation: Operation) -> Result<Vec<u8>, Error> {
        self.kernel_file("copy.comp", "copy", &macros(format, operation, "copy"))
    }

    /// The SPIR-V of the kernel that decodes two-byte codes by a table.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn decode_by_table(&self) -> Result<Vec<u8>, Error> {
        let macros = [("BYTES".into(), "2".into())];
        self.kernel_file("decode_by_table.comp", manifest::DECODE_BY_TABLE, &macros)
    }

    fn kernel_file(&self, file: &str, kernel: &str, macros: &[(String, String)]) -> Result<Vec<u8>, Error> {
        let file = format!("kernels/{file}");
        self.compile(&file, source(&file)?, macros).map_err(|error| Error::Rejected {
            file: format!("glsl/{file}"),
            kernel: kernel.to_owned(),
            error,
        })
    }

    /// The SPIR-V of a shader of the renderer, `vertex.vert`, for a variant of that name, optimised; its entry point is
    /// [`ENTRY_POINT`].
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn render_shader(
        &self,
        file: &str,
        variant: &str,
        macros: &[(String, String)],
    ) -> Result<Vec<u8>, Error> {
        let path = || format!("{RENDER_SHADERS}/{file}");
        let text = shaders::glsl(file).ok_or_else(|| Error::NoSource { file: path() })?;
        let stage = if file.ends_with(".vert") { Stage::Vertex } else { Stage::Fragment };
        let source = Source { language: SourceLanguage::Glsl, stage, file, text };
        self.0.compile(&source, macros).map_err(|error| Error::Rejected {
            file: path(),
            kernel: variant.to_owned(),
            error,
        })
    }

    /// Compiles a compute shader that may include files of `glsl/`, as if it lay there itself under the name `file`.
    ///
    /// # Errors
    /// glslang's.
    pub fn compile(&self, file: &str, text: &str, macros: &[(String, String)]) -> Result<Vec<u8>, String> {
        self.0.compile(&Source { language: SourceLanguage::Glsl, stage: Stage::Compute, file, text }, macros)
    }

    /// Compiles a compute shader in HLSL, whose entry point is [`ENTRY_POINT`].
    ///
    /// # Errors
    /// glslang's.
    pub fn compile_hlsl(&self, file: &str, text: &str) -> Result<Vec<u8>, String> {
        self.0.compile(&Source { language: SourceLanguage::Hlsl, stage: Stage::Compute, file, text }, &[])
    }
}

/// The macros that the kernel files are compiled with for a function of this format.
fn macros(format: Format, operation: Operation, function: &str) -> Vec<(String, String)> {
    let mut macros = vec![
        (operation.to_string().to_uppercase(), function.to_owned()),
        ("BYTES".into(), format.bytes.to_string()),
    ];
    if format.element == Element::Frame {
        macros.push(("FRAME".into(), "1".into()));
    }
    if operation == Operation::Encode && format.encodes_by_table {
        macros.push(("TABLE".into(), "1".into()));
    }
    macros
}

/// Text of a file of `glsl/`.
///
/// # Errors
/// [`Error::NoSource`] where there is none of that name.
pub fn source(file: &str) -> Result<&'static str, Error> {
    unitvec_shaders::glsl(file).ok_or_else(|| Error::NoSource { file: format!("glsl/{file}") })
}

/// Text of a file that a shader includes: of the renderer's own, or of `glsl/`.
#[cfg(feature = "glsl")]
fn included(file: &str) -> Result<&'static str, Error> {
    shaders::glsl(file).map_or_else(|| source(file), Ok)
}
