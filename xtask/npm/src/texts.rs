//! Shading texts as a module of JavaScript. What texts have in common is in it once, and bundlers drop what is not imported.

use std::collections::HashMap;
use std::error::Error;
use std::fmt::Write;
use unitvec_languages::{Edition, Language, Library};

/// Joins parts to a text, and texts to one that has no part twice.
const HEAD: &str = r#"const known = new Map();
const join = (...parts) => {
  const text = parts.join("\n\n") + "\n";
  known.set(text, parts);
  return text;
};
export const merge = (...texts) => join(...new Set(texts.flatMap((text) => known.get(text) ?? [text])));
"#;

const HEAD_OF_TYPES: &str =
    "/** Texts as one, with all that they share in it once. Texts of one edition only. */
export declare function merge(...texts: string[]): string;
";

/// A module and its types: a text for each codec, named after it, with both its functions; and one for each function.
pub fn module(
    library: &Library,
    language: Language,
    edition: Edition,
) -> Result<[String; 2], Box<dyn Error>> {
    let (mut module, mut types) = (HEAD.to_owned(), HEAD_OF_TYPES.to_owned());
    let mut known = HashMap::new();
    for (name, functions) in exports(library) {
        let text = text(library, &functions, language, edition)?;
        let mut constants = Vec::new();
        for part in parts(&text) {
            let next = known.len();
            let number = *known.entry(part.clone()).or_insert(next);
            if number == next {
                writeln!(module, "const p{number} = {};", serde_json::to_string(&part)?)?;
            }
            constants.push(format!("p{number}"));
        }
        writeln!(module, "export const {name} = /* @__PURE__ */ join({});", constants.join(", "))?;
        writeln!(types, "/** `{}` in {language}. */", functions.join("`, `"))?;
        writeln!(types, "export declare const {name}: string;")?;
    }
    Ok([module, types])
}

/// The exported names, with the functions of each.
fn exports(library: &Library) -> Vec<(&str, Vec<&str>)> {
    let functions: Vec<&str> = library.functions().collect();
    let codecs = functions.iter().filter_map(|encode| {
        let id = encode.strip_suffix("_encode")?;
        let decode = functions.iter().find(|name| name.strip_suffix("_decode") == Some(id))?;
        Some((id, vec![*encode, *decode]))
    });
    codecs.chain(functions.iter().map(|name| (*name, vec![*name]))).collect()
}

fn text(
    library: &Library,
    functions: &[&str],
    language: Language,
    edition: Edition,
) -> Result<String, Box<dyn Error>> {
    let layout = library.layout(functions[0], language)?;
    let excerpt = library.excerpt(functions, language, edition)?;
    let version = env!("CARGO_PKG_VERSION");
    Ok(format!("// unitvec {version} in {language}. Licence: MIT or Apache-2.0.\n\n{layout}\n{excerpt}"))
}

/// Parts of a text: each declaration with its comment; what is in a guard is one.
fn parts(text: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let (mut is_guarded, mut is_comment) = (false, false);
    for line in text.lines() {
        let goes_on = is_guarded || is_comment || line.starts_with([' ', '}', ')']) || line.is_empty();
        match parts.last_mut() {
            Some(last) if goes_on => *last += &format!("\n{line}"),
            _ => parts.push(line.to_owned()),
        }
        is_guarded = line.starts_with("#ifndef") || is_guarded && line != "#endif";
        is_comment = line.starts_with("//");
    }
    parts.iter().map(|part| part.trim_end().to_owned()).collect()
}
