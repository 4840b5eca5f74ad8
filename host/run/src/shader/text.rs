//! The functions of some codecs as one text, ready to paste.

use super::{Edition, Error, Language, library};
use std::fmt::Write;
use unitvec_catalogue::{AnyCodec, Operation};

/// The functions of these codecs in a language, and all that they need, below a comment that describes each. `command`
/// is the command that wrote it.
///
/// # Errors
/// [`Error::Language`], which tests rule out for the codecs of the catalogue.
pub fn text(
    formats: &[&'static AnyCodec],
    language: Language,
    edition: Edition,
    command: &str,
) -> Result<String, Error> {
    let library = library()?;
    let functions: Vec<String> = formats
        .iter()
        .flat_map(|format| Operation::ALL.map(|operation| format.function(operation)))
        .collect();
    let names: Vec<&str> = functions.iter().map(String::as_str).collect();
    let body = library.excerpt(&names, language, edition)?;

    let mut layouts: Vec<String> = Vec::new();
    for name in &names {
        let layout = library.layout(name, language)?;
        if !layouts.contains(&layout) {
            layouts.push(layout);
        }
    }
    let mut head = format!(
        "// unitvec {}: {} in {language}{}.\n// Written by `{command}`. Licence: {}.\n//\n",
        env!("CARGO_PKG_VERSION"),
        if formats.len() == 1 { "a codec" } else { "codecs" },
        if edition == Edition::Exact { ", exact edition" } else { "" },
        env!("CARGO_PKG_LICENSE").replace("OR", "or"),
    );
    let widest = formats.iter().map(|format| format.id.len()).max().unwrap_or_default();
    for format in formats {
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
