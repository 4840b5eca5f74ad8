//! What is compiled.

use crate::cases::Case;
use crate::{Result, told};
use unitvec_host::catalogue::Operation;
use unitvec_host::shader::kernel;
use unitvec_languages::{Edition, Language, Library};

/// A text to compile, and the case that it is for.
pub struct Job<'a> {
    pub case: &'a Case,
    pub text: String,
}

/// What takes the words that a case gave, or what went wrong.
pub type Each<'a> = &'a mut dyn FnMut(&Case, Result<Vec<u32>>) -> Result<()>;

/// Whole shaders, one of each case: the codec's text as people get it, and a kernel.
pub fn jobs<'a>(
    library: &Library,
    cases: &'a [Case],
    language: Language,
    edition: Edition,
) -> Result<Vec<Job<'a>>> {
    let text = |case: &Case| -> Result<String> {
        let functions = Operation::ALL.map(|operation| case.format.function(operation));
        let functions = functions.each_ref().map(String::as_str);
        let codec = library.excerpt(&functions, language, edition).map_err(told)?;
        let language = of_host(language)?;
        let head = kernel::head(language).unwrap_or_default();
        Ok(format!("{head}{codec}{}", kernel::kernel(language, case.format, case.operation)))
    };
    cases.iter().map(|case| Ok(Job { case, text: text(case)? })).collect()
}

fn of_host(language: Language) -> Result<unitvec_host::shader::Language> {
    use unitvec_host::shader::Language as L;
    Ok(match language {
        Language::Glsl => L::Glsl,
        Language::Hlsl => L::Hlsl,
        Language::Wgsl => L::Wgsl,
        Language::Slang => L::Slang,
        Language::Msl => L::Msl,
        Language::GlslEs => L::GlslEs,
        Language::Godot => return Err("Godot has no kernels".to_owned()),
    })
}
