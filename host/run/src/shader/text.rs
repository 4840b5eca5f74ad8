//! Functions as one text, ready to paste.

use super::{Edition, Error, Language, library};
use std::fmt::Write;
use unitvec_catalogue::{AnyCodec, CODECS, Operation};

/// These functions in a language, and all that they need, below a comment that describes their codecs. `command` is the
/// command that wrote it.
///
/// # Errors
/// [`Error::Language`], which tests rule out for the functions of the library.
pub fn text(
    functions: &[String],
    language: Language,
    edition: Edition,
    command: &str,
) -> Result<String, Error> {
    let library = library()?;
    let names: Vec<&str> = functions.iter().map(String::as_str).collect();
    let is_named =
        |format: &&AnyCodec| Operation::ALL.iter().any(|half| functions.contains(&format.function(*half)));
    let formats: Vec<&AnyCodec> = CODECS.iter().filter(is_named).collect();
    let body = library.excerpt(&names, language, edition)?;

    let mut layouts: Vec<String> = Vec::new();
    for name in &names {
        let layout = library.layout(name, language)?;
        if !layouts.contains(&layout) {
            layouts.push(layout);
        }
    }
    let mut head = format!(
        "// unitvec {}: functions in {language}{}.\n// Written by `{command}`. Licence: {}.\n",
        env!("CARGO_PKG_VERSION"),
        if edition == Edition::Exact { ", exact edition" } else { "" },
        env!("CARGO_PKG_LICENSE").replace("OR", "or"),
    );
    if !formats.is_empty() {
        head += "//\n";
    }
    let widest = formats.iter().map(|format| format.id.len()).max().unwrap_or_default();
    for format in &formats {
        // Writing to a String cannot fail.
        let _ = writeln!(head, "//   {:widest$}  {}", format.id, about(format));
    }
    for layout in layouts {
        head = head + "//\n" + &layout;
    }
    Ok(head + "\n" + &body)
}

/// Bits, error and Vulkan format.
fn about(format: &AnyCodec) -> String {
    let error = match format.max_errors_deg {
        [normal, tangent] => format!("{normal} degrees (normal) and {tangent} degrees (tangent)"),
        _ => format!("{} degrees", format.max_error_deg()),
    };
    let mut parts = vec![format!("{} bits", format.bits), format!("error up to {error}")];
    parts.extend(format.vk_format.map(str::to_owned));
    parts.join(", ")
}
