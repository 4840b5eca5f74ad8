//! The GLSL kernels, compiled at run time by glslang through shaderc.

use crate::catalogue::{Direction, Element, Format};
use crate::manifest;
use include_dir::{Dir, include_dir};
use shaderc::{
    CompileOptions, EnvVersion, IncludeType, OptimizationLevel, ResolvedInclude, ShaderKind, TargetEnv,
};

static SOURCES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../glsl");

/// GLSL that does not become SPIR-V.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// shaderc has no compiler to give.
    #[error("the GLSL compiler (shaderc) cannot be started: {0}")]
    NoCompiler(shaderc::Error),
    /// A source file is not in the program.
    #[error("the program was built without glsl/{file}; build it again from a whole repository")]
    NoSource {
        /// Path in `glsl/`.
        file: String,
    },
    /// glslang rejects the source.
    #[error("glsl/{file} does not compile for {kernel}: {error}")]
    Rejected {
        /// Path in `glsl/`.
        file: String,
        /// Kernel: `oct16_encode`.
        kernel: String,
        /// glslang's words.
        error: shaderc::Error,
    },
}

/// Name of the entry point of all GLSL kernels.
pub const ENTRY_POINT: &str = "main";

/// A GLSL compiler.
pub struct Compiler {
    compiler: shaderc::Compiler,
}

impl Compiler {
    /// Starts glslang.
    ///
    /// # Errors
    /// [`Error::NoCompiler`].
    pub fn new() -> Result<Self, Error> {
        Ok(Self { compiler: shaderc::Compiler::new().map_err(Error::NoCompiler)? })
    }

    /// The SPIR-V of a codec's kernel, optimised; its entry point is [`ENTRY_POINT`].
    ///
    /// # Errors
    /// [`Error::NoSource`] or [`Error::Rejected`].
    pub fn kernel(&self, format: Format, direction: Direction) -> Result<Vec<u8>, Error> {
        let function = format.function(direction);
        let file = match format.element {
            Element::Vector => format!("{direction}.comp"),
            Element::Frame => format!("frame_{direction}.comp"),
        };
        self.kernel_file(&file, &function, &macros(format, direction))
    }

    /// The SPIR-V of the kernel that measures a codec's arithmetic.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn cost_kernel(&self, format: Format, direction: Direction) -> Result<Vec<u8>, Error> {
        let function = format.function(direction);
        self.kernel_file(&format!("{direction}_cost.comp"), &function, &macros(format, direction))
    }

    /// The SPIR-V of the kernel that measures what the others do besides encoding or decoding.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn baseline_kernel(&self, direction: Direction) -> Result<Vec<u8>, Error> {
        self.kernel_file(&format!("{direction}_cost.comp"), "baseline", &[])
    }

    /// The SPIR-V of a kernel that reads and writes as many bytes as a codec's, and does nothing else.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn copy_kernel(&self, format: Format, direction: Direction) -> Result<Vec<u8>, Error> {
        self.kernel_file("copy.comp", "copy", &macros(format, direction))
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
            file,
            kernel: kernel.to_owned(),
            error,
        })
    }

    /// Compiles a compute shader that may include files of `glsl/`, as if it lay there itself under the name `file`.
    ///
    /// # Errors
    /// glslang's.
    pub fn compile(
        &self,
        file: &str,
        text: &str,
        macros: &[(String, String)],
    ) -> std::result::Result<Vec<u8>, shaderc::Error> {
        let mut options = CompileOptions::new()?;
        options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_2 as u32);
        options.set_optimization_level(OptimizationLevel::Performance);
        options.set_include_callback(|wanted, kind, from, _depth| include(wanted, kind, from));
        for (name, value) in macros {
            options.add_macro_definition(name, Some(value));
        }
        let artifact =
            self.compiler.compile_into_spirv(text, ShaderKind::Compute, file, ENTRY_POINT, Some(&options))?;
        Ok(artifact.as_binary_u8().to_vec())
    }
}

/// The macros that the kernel files are compiled with.
fn macros(format: Format, direction: Direction) -> Vec<(String, String)> {
    let mut macros = vec![
        (direction.to_string().to_uppercase(), format.function(direction)),
        ("BYTES".into(), format.bytes.to_string()),
    ];
    if format.element == Element::Frame {
        macros.push(("FRAME".into(), "1".into()));
    }
    if direction == Direction::Encode && format.encodes_by_table {
        macros.push(("TABLE".into(), "1".into()));
    }
    macros
}

/// Text of a file of `glsl/`.
///
/// # Errors
/// [`Error::NoSource`] where there is none of that name.
pub fn source(file: &str) -> Result<&'static str, Error> {
    SOURCES
        .get_file(file)
        .and_then(|file| file.contents_utf8())
        .ok_or_else(|| Error::NoSource { file: file.to_owned() })
}

/// Resolves `#include` relative to the including file, as the standard include form does.
fn include(wanted: &str, kind: IncludeType, from: &str) -> Result<ResolvedInclude, String> {
    let path = match kind {
        IncludeType::Relative => relative(from, wanted),
        IncludeType::Standard => wanted.to_owned(),
    };
    match source(&path) {
        Ok(text) => Ok(ResolvedInclude { resolved_name: path, content: text.to_owned() }),
        Err(error) => Err(error.to_string()),
    }
}

/// `wanted`, seen from the folder of `from`: `kernels/a.comp` and `../unitvec/b.glsl` give `unitvec/b.glsl`.
fn relative(from: &str, wanted: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in wanted.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            name => parts.push(name),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::relative;

    #[test]
    fn includes_are_relative_to_the_including_file() {
        assert_eq!(relative("kernels/encode.comp", "../unitvec/unitvec.glsl"), "unitvec/unitvec.glsl");
        assert_eq!(relative("unitvec/unitvec.glsl", "oct.glsl"), "unitvec/oct.glsl");
        assert_eq!(relative("shader.comp", "./unitvec/oct.glsl"), "unitvec/oct.glsl");
    }
}
