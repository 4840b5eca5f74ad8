//! The tables of formats in docs/formats.md and docs/engines.md.

use super::markdown_table;
use unitvec_catalogue::{AnyCodec, Element, FORMATS, RECOMMENDED, Usage, find};

/// The names of each format in the APIs.
pub fn names() -> String {
    let cell = |names: &[&str]| {
        let name = |name: &&str| if name.is_empty() { "-".to_owned() } else { format!("`{name}`") };
        names.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let rows = FORMATS.iter().map(|format| {
        let one = [format.vulkan, format.dxgi, format.opengl].map(|name| cell(&[name])).join(" | ");
        format!("{one} | {} | {}", cell(&format.metal), cell(&format.webgpu))
    });
    markdown_table("`VK_FORMAT_` | `DXGI_FORMAT_` | `GL_` | Metal | WebGPU", rows)
}

/// The uses of each format that Vulkan requires of every device.
pub fn promised() -> String {
    let rows = FORMATS.iter().map(|format| {
        let cells = [Usage::Attachment, Usage::Texture, Usage::Vertex]
            .map(|usage| if format.promised.contains(&usage) { "yes" } else { "ask" });
        format!("`{}` | {}", format.vulkan, cells.join(" | "))
    });
    markdown_table("format | colour attachment | texture | vertex attribute", rows)
}

/// The recommended codecs in their formats, each with the purpose and the expressions that write and read it.
pub fn uses() -> impl Iterator<Item = (&'static str, &'static AnyCodec, &'static str, [String; 2])> {
    RECOMMENDED.into_iter().flat_map(|row| {
        row.choices.iter().flat_map(move |choice| {
            let codec = find(choice.id).unwrap();
            let mut formats = vec![choice.format, choice.anywhere];
            formats.dedup();
            formats.into_iter().map(move |format| (row.purpose, codec, format, expressions(codec, format)))
        })
    })
}

/// The expressions that write an element to a format and read it: of `normal`, `tangent`, and what is fetched as `value`.
fn expressions(codec: &AnyCodec, format: &str) -> [String; 2] {
    let AnyCodec { id, family, bits, .. } = codec;
    let value = if *bits > 32 { "value.xy" } else { "value.x" };
    if codec.element == Element::Frame {
        return [format!("{id}_encode(normal, tangent)"), format!("{id}_decode({value}, normal, tangent)")];
    }
    if !format.ends_with("_SNORM") {
        return [format!("{id}_encode(normal)"), format!("{id}_decode({value})")];
    }
    let write = match id.strip_suffix('p') {
        Some(_) => format!("float32x3_to_{family}n_precise(normal, {bits})"),
        None => format!("float32x3_to_{family}(normal)"),
    };
    [write, format!("{family}_to_float32x3(value.xy)")]
}

/// The table of the recommended codecs in their formats.
pub fn table() -> String {
    let mut last = "";
    let rows = uses().map(|(purpose, codec, format, [write, read])| {
        let shown = if purpose == last { "" } else { purpose };
        last = purpose;
        format!("{shown} | `{}` | `{format}` | `{write}` | `{read}`", codec.id)
    });
    markdown_table("for | codec | format | write | read", rows)
}
