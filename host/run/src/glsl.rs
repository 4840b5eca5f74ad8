//! The GLSL kernels, compiled at run time by glslang through shaderc. Without the feature `glsl` there is no compiler:
//! [`Compiler::new`] returns an error.

#[cfg(feature = "glsl")]
mod glslang;
#[cfg(not(feature = "glsl"))]
#[path = "glsl/no_glslang.rs"]
mod glslang;

use glslang::Glslang;
use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};
use unitvec_catalogue::{AnyCodec, Element, Operation};
use unitvec_languages::{EXACT, Edition};
use unitvec_manifest as manifest;

/// GLSL that could not be compiled to SPIR-V.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The program was built without the feature `glsl`.
    #[error(
        "this build has no GLSL compiler; in a clone of the repository, `cargo install --path host/program --features glsl` \
         installs one that has (Debian: after `apt-get install g++ libshaderc-dev glslang-dev spirv-tools`)"
    )]
    NotBuiltIn,
    /// shaderc could not create a compiler.
    #[error("the GLSL compiler (shaderc) cannot be started: {0}")]
    NoCompiler(String),
    /// The source file does not exist.
    #[error("there is no file {file}")]
    NoSource {
        /// Path in the repository.
        file: String,
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
pub enum Stage {
    /// A compute shader.
    Compute,
    /// A vertex shader.
    Vertex,
    /// A fragment shader.
    Fragment,
}

/// A shader in GLSL that may include files of `glsl/`, and others beside it.
pub struct Shader<'a> {
    /// The shader's stage.
    pub stage: Stage,
    /// The shader's name, which includes are relative to.
    pub file: &'a str,
    /// The shader's text.
    pub text: &'a str,
    /// Finds the text of an included file that does not lie in `glsl/`, or another text for one that does.
    pub beside: &'a dyn Fn(&str) -> Option<&'static str>,
}

/// Name of the entry point of all GLSL kernels.
pub const ENTRY_POINT: &str = "main";

/// The file that includes all families.
const ALL: &str = "unitvec/unitvec.glsl";

/// Kernels of codecs that this process has compiled: several devices, threads and tests want the same ones.
static KERNELS: LazyLock<Mutex<Modules>> = LazyLock::new(Mutex::default);

/// SPIR-V by codec, operation and edition.
type Modules = HashMap<(&'static str, Operation, Edition), Vec<u8>>;

/// The work of the optimiser.
#[derive(Clone, Copy)]
enum Optimisation {
    None,
    Performance,
}

/// A GLSL compiler.
pub struct Compiler {
    glslang: Glslang,
    edition: Edition,
    optimisation: Optimisation,
}

impl Compiler {
    /// Starts glslang.
    ///
    /// # Errors
    /// [`Error::NotBuiltIn`] or [`Error::NoCompiler`].
    pub fn new() -> Result<Self, Error> {
        Self::of(Edition::Plain)
    }

    /// Starts glslang, for this edition of the GLSL.
    ///
    /// # Errors
    /// [`Error::NotBuiltIn`] or [`Error::NoCompiler`].
    pub fn of(edition: Edition) -> Result<Self, Error> {
        Ok(Self { glslang: Glslang::new()?, edition, optimisation: Optimisation::Performance })
    }

    /// The same compiler without its optimiser: functions keep their names, and calls stay.
    #[must_use]
    pub fn unoptimised(self) -> Self {
        Self { optimisation: Optimisation::None, ..self }
    }

    /// The SPIR-V of a codec's kernel, optimised; its entry point is [`ENTRY_POINT`]. A process compiles each kernel once.
    ///
    /// # Errors
    /// [`Error::NoSource`] or [`Error::Rejected`].
    pub fn kernel(&self, format: &AnyCodec, operation: Operation) -> Result<Vec<u8>, Error> {
        let (key, kernels) =
            ((format.id, operation, self.edition), || KERNELS.lock().unwrap_or_else(PoisonError::into_inner));
        if let Some(module) = kernels().get(&key) {
            return Ok(module.clone());
        }
        let (file, function) = (format!("{operation}.comp"), format.function(operation));
        let module =
            self.kernel_file(&file, &function, &macros(format, operation, &function), Some(format))?;
        kernels().insert(key, module.clone());
        Ok(module)
    }

    /// The SPIR-V of a kernel of `glsl/kernels/` around another function with this format, optimised, with macros besides
    /// those of [`kernel`](Self::kernel).
    ///
    /// # Errors
    /// The errors of [`kernel`](Self::kernel).
    pub fn function_kernel(
        &self,
        format: &AnyCodec,
        operation: Operation,
        function: &str,
        others: &[(&str, &str)],
    ) -> Result<Vec<u8>, Error> {
        let mut macros = macros(format, operation, function);
        macros.extend(others.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())));
        self.kernel_file(&format!("{operation}.comp"), function, &macros, None)
    }

    /// The SPIR-V of the kernel that measures a codec's arithmetic; without a codec, the work of these kernels besides it.
    ///
    /// # Errors
    /// The errors of [`kernel`](Self::kernel).
    pub fn cost_kernel(&self, format: Option<&AnyCodec>, operation: Operation) -> Result<Vec<u8>, Error> {
        let function = format.map_or_else(|| "baseline".to_owned(), |format| format.function(operation));
        let macros = format.map_or_else(Vec::new, |format| macros(format, operation, &function));
        self.kernel_file(&format!("{operation}_cost.comp"), &function, &macros, format)
    }

    /// The SPIR-V of a kernel that reads and writes as many bytes as a codec's, and does nothing else.
    ///
    /// # Errors
    /// The errors of [`kernel`](Self::kernel).
    pub fn copy_kernel(&self, format: &AnyCodec, operation: Operation) -> Result<Vec<u8>, Error> {
        self.kernel_file("copy.comp", "copy", &macros(format, operation, "copy"), None)
    }

    /// The SPIR-V of the kernel that decodes two-byte codes by a table.
    ///
    /// # Errors
    /// The errors of [`kernel`](Self::kernel).
    pub fn decode_by_table(&self) -> Result<Vec<u8>, Error> {
        let macros = [("BYTES".into(), "2".into())];
        self.kernel_file("decode_by_table.comp", manifest::DECODE_BY_TABLE, &macros, None)
    }

    /// Compiles a kernel. One of a codec gets its family for the file that includes all of them: glslang spends most of its time
    /// on reading, and a family, with the arithmetic that it includes, is a fifth of the text.
    fn kernel_file(
        &self,
        file: &str,
        kernel: &str,
        macros: &[(String, String)],
        codec: Option<&AnyCodec>,
    ) -> Result<Vec<u8>, Error> {
        let file = format!("kernels/{file}");
        let family = codec.map(|codec| source(&format!("unitvec/{}", codec.glsl_file()))).transpose()?;
        let beside = |path: &str| family.filter(|_| path == ALL);
        let shader = Shader { stage: Stage::Compute, file: &file, text: source(&file)?, beside: &beside };
        self.compile_shader(shader, macros).map_err(|error| Error::Rejected {
            file: format!("glsl/{file}"),
            kernel: kernel.to_owned(),
            error,
        })
    }

    /// Compiles a compute shader that may include files of `glsl/`, as if it lay there itself under the name `file`.
    ///
    /// # Errors
    /// glslang's.
    pub fn compile(&self, file: &str, text: &str, macros: &[(String, String)]) -> Result<Vec<u8>, String> {
        self.compile_shader(Shader { stage: Stage::Compute, file, text, beside: &|_| None }, macros)
    }

    /// Compiles a shader of any stage; the entry point is [`ENTRY_POINT`].
    ///
    /// # Errors
    /// glslang's.
    pub fn compile_shader(&self, shader: Shader<'_>, macros: &[(String, String)]) -> Result<Vec<u8>, String> {
        let exact = (self.edition == Edition::Exact).then(|| (EXACT.to_owned(), String::new()));
        let macros: Vec<_> = macros.iter().cloned().chain(exact).collect();
        self.glslang.compile(SourceLanguage::Glsl, &shader, &macros, self.optimisation)
    }

    /// Compiles a compute shader in HLSL, whose entry point is [`ENTRY_POINT`].
    ///
    /// # Errors
    /// glslang's.
    pub fn compile_hlsl(&self, file: &str, text: &str) -> Result<Vec<u8>, String> {
        let shader = Shader { stage: Stage::Compute, file, text, beside: &|_| None };
        self.glslang.compile(SourceLanguage::Hlsl, &shader, &[], self.optimisation)
    }
}

/// The macros that the kernel files are compiled with for a function of this format.
pub fn macros(format: &AnyCodec, operation: Operation, function: &str) -> Vec<(String, String)> {
    let mut macros = vec![
        (operation.to_string().to_uppercase(), function.to_owned()),
        ("BYTES".into(), format.bytes.to_string()),
    ];
    match format.element {
        Element::Vector => {}
        Element::Frame => macros.push(("FRAME".into(), "1".into())),
        Element::Rotation => macros.push(("ROTATION".into(), "1".into())),
    }
    if operation == Operation::Encode && format.encodes_by_table {
        macros.push(("TABLE".into(), "1".into()));
    }
    macros
}

/// Text of a file of `glsl/`.
///
/// # Errors
/// [`Error::NoSource`] where no file has that name.
pub fn source(file: &str) -> Result<&'static str, Error> {
    unitvec_shaders::glsl(file).ok_or_else(|| Error::NoSource { file: format!("glsl/{file}") })
}
