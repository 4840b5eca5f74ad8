//! The files of `shaders/`, all of them in one text, as people include, import or join them.

use crate::{Result, told};
use std::fs;
use std::path::PathBuf;
use unitvec_host::catalogue::{Element, Format, Operation, formats};
use unitvec_host::shader::kernel::code_words;
use unitvec_host::shader::{Edition, Language, library};

/// The file that includes the others.
const ALL: &str = "unitvec.glsl";

/// Where the files of a language lie.
pub fn folder(language: Language, edition: Edition) -> PathBuf {
    let repository = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    PathBuf::from(repository).join("shaders").join(language.folder(edition))
}

/// A text that has all files, and calls every codec's functions.
pub fn text(language: Language, edition: Edition) -> Result<String> {
    let files = match language {
        Language::Hlsl | Language::Msl => format!("#include \"unitvec.{}\"\n", language.extension()),
        Language::Slang => "import unitvec;\n".to_owned(),
        _ => joined(language, edition)?,
    };
    Ok(files + &calls(language))
}

/// The files one after the other, without the lines by which they include each other.
fn joined(language: Language, edition: Edition) -> Result<String> {
    let library = library().map_err(told)?;
    let (folder, mut text) = (folder(language, edition), String::new());
    for name in library.files().filter(|name| *name != ALL) {
        let path = folder.join(library.file_name(name, language).unwrap_or_default());
        let file = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        text.extend(file.lines().filter(|line| !line.starts_with("#include")).flat_map(|line| [line, "\n"]));
    }
    Ok(text)
}

/// A function that encodes and decodes by every codec.
fn calls(language: Language) -> String {
    let (head, reference) = match language {
        Language::Wgsl => (
            "fn all_codecs(c: vec2u, n: vec3f, t: vec4f) -> vec2u {
    var code = c;
    var normal = n;
    var tangent = t;\n",
            "&",
        ),
        Language::GlslEs | Language::Godot => {
            ("uvec2 all_codecs(uvec2 code, vec3 normal, vec4 tangent) {\n", "")
        }
        _ => ("uint2 all_codecs(uint2 code, float3 normal, float4 tangent) {\n", ""),
    };
    let calls: String = formats().map(|format| call(format, reference)).collect();
    format!("\n{head}{calls}    return code;\n}}\n")
}

fn call(format: Format, reference: &str) -> String {
    let code = if code_words(format) == 1 { "code.x" } else { "code" };
    let [encode, decode] = Operation::ALL.map(|operation| format.function(operation));
    match format.element {
        Element::Vector => format!("    {code} = {encode}(normal);\n    normal = {decode}({code});\n"),
        Element::Frame => format!(
            "    {code} = {encode}(normal, tangent);\n    {decode}({code}, {reference}normal, {reference}tangent);\n"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file that nobody joins would be compiled nowhere.
    #[test]
    fn all_files_are_joined() {
        for edition in [Edition::Plain, Edition::Exact] {
            let text = joined(Language::Godot, edition).unwrap();
            let files = fs::read_dir(folder(Language::Godot, edition)).unwrap();
            let files = files.filter(|file| file.as_ref().unwrap().path().is_file()).count();
            assert_eq!(text.matches("#ifndef UNITVEC_").count(), files - 1, "{edition:?}");
            assert!(!text.contains("#include") && calls(Language::Godot).contains("frame64_decode("));
        }
    }
}
