//! glslang through shaderc.

use super::{ENTRY_POINT, Error, Optimisation, Shader, SourceLanguage, Stage, source};
use shaderc::{
    CompileOptions, EnvVersion, IncludeType, OptimizationLevel, ResolvedInclude, ShaderKind, TargetEnv,
};
use std::sync::LazyLock;

/// The compiler of the process: glslang makes its tables of built-in functions anew wherever no compiler is left.
static COMPILER: LazyLock<Result<shaderc::Compiler, shaderc::Error>> = LazyLock::new(shaderc::Compiler::new);

pub struct Glslang(&'static shaderc::Compiler);

impl Glslang {
    pub fn new() -> Result<Self, Error> {
        COMPILER.as_ref().map(Self).map_err(|error| Error::NoCompiler(error.to_string()))
    }

    pub fn compile(
        &self,
        language: SourceLanguage,
        &Shader { stage, file, text, beside }: &Shader<'_>,
        macros: &[(String, String)],
        optimisation: Optimisation,
    ) -> Result<Vec<u8>, String> {
        let kind = match stage {
            Stage::Compute => ShaderKind::Compute,
            Stage::Vertex => ShaderKind::Vertex,
            Stage::Fragment => ShaderKind::Fragment,
        };
        let compile = || {
            let mut options = CompileOptions::new()?;
            options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_1 as u32);
            options.set_optimization_level(match optimisation {
                Optimisation::None => OptimizationLevel::Zero,
                Optimisation::Performance => OptimizationLevel::Performance,
            });
            options.set_source_language(match language {
                SourceLanguage::Glsl => shaderc::SourceLanguage::GLSL,
                SourceLanguage::Hlsl => shaderc::SourceLanguage::HLSL,
            });
            options.set_include_callback(|wanted, kind, from, _depth| include(beside, wanted, kind, from));
            for (name, value) in macros {
                options.add_macro_definition(name, Some(value));
            }
            let artifact = self.0.compile_into_spirv(text, kind, file, ENTRY_POINT, Some(&options))?;
            Ok(artifact.as_binary_u8().to_vec())
        };
        compile().map_err(|error: shaderc::Error| error.to_string())
    }
}

/// Resolves `#include` relative to the including file, as the standard include form does.
fn include(
    beside: &dyn Fn(&str) -> Option<&'static str>,
    wanted: &str,
    kind: IncludeType,
    from: &str,
) -> Result<ResolvedInclude, String> {
    let path = match kind {
        IncludeType::Relative => relative(from, wanted),
        IncludeType::Standard => wanted.to_owned(),
    };
    match beside(&path).map_or_else(|| source(&path), Ok) {
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
