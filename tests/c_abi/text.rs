//! The texts that are generated from the list, or from other files.

use crate::docs::compare;
use std::fmt::Write;
use std::process::Command;
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Element};
use unitvec_tests::repository;

/// `c/src/codecs.rs` has the functions of every codec of the list, and `c/include/unitvec.h` is cbindgen's header for
/// the sources. `cargo xtask renew c` writes both.
#[test]
fn sources_and_header_are_renewed() {
    compare(&repository().join("c/src/codecs.rs"), &codecs());
    let arguments = ["run", "--quiet", "--package", "xtask-header"];
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(repository()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    compare(&repository().join("c/include/unitvec.h"), &String::from_utf8(output.stdout).unwrap());
}

/// Only `memory.rs` in the C library has `unsafe`, except for the names that are exported.
#[test]
fn unsafe_code_is_in_one_module() {
    for entry in std::fs::read_dir(repository().join("c/src")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap().replace("#[unsafe(no_mangle)]", "");
        let mut code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let has_unsafe = code.any(|line| line.contains("unsafe"));
        assert_eq!(has_unsafe, path.ends_with("memory.rs"), "{}", path.display());
    }
}

/// The functions of every codec. They are written out, since cbindgen does not expand macros.
fn codecs() -> String {
    let mut text = "//! The functions of every codec of the list, each codec's an object file. \
                    Generated: `cargo xtask renew c`.\n"
        .to_owned();
    for codec in &CODECS {
        let element = match codec.element {
            Element::Vector => VECTOR,
            Element::Frame => FRAME,
            Element::Rotation => ROTATION,
        };
        write!(text, "{}", functions(codec, &about(codec), element)).unwrap();
    }
    text
}

fn about(codec: &AnyCodec) -> String {
    let domain = if codec.domain == Domain::Hemisphere { "directions with z >= 0, " } else { "" };
    match codec.max_errors_deg {
        [normal, tangent] => format!("normal at most {normal}, tangent {tangent} degrees off"),
        _ => format!("{domain}at most {} degrees off", codec.max_error_deg()),
    }
}

/// The words in the functions of an element.
#[derive(Clone, Copy)]
struct Names {
    element: &'static str,
    r#type: &'static str,
    suffix: &'static str,
}

const VECTOR: Names = Names { element: "vector", r#type: "Vec3", suffix: "" };
const FRAME: Names = Names { element: "frame", r#type: "Frame", suffix: "_frame" };
const ROTATION: Names = Names { element: "rotation", r#type: "Quat", suffix: "_rotation" };

fn functions(codec: &AnyCodec, about: &str, names: Names) -> String {
    let AnyCodec { id, rust_type, bits, .. } = codec;
    let Names { element, r#type, suffix } = names;
    let (code, narrow, widened) =
        if *bits > 32 { ("u64", "", "code") } else { ("u32", " as u32", "code.into()") };
    format!(
        "
mod {id} {{
    use crate::single::{{{type}, decode{suffix}, encode{suffix}}};

    /// The code of a {element} by {id}: {bits} bits, {about}.
    #[unsafe(no_mangle)]
    pub extern \"C\" fn unitvec_{id}_encode({element}: {type}) -> {code} {{
        encode{suffix}::<unitvec::{rust_type}>({element}){narrow}
    }}

    /// The {element} of a code of {id}. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern \"C\" fn unitvec_{id}_decode(code: {code}) -> {type} {{
        decode{suffix}::<unitvec::{rust_type}>({widened})
    }}
}}
"
    )
}

/// A line of C a codec, for `codecs.c`.
pub fn calls() -> String {
    let kind = |format: &AnyCodec| match (format.element.floats(), format.bits) {
        (3, ..=32) => "VECTOR32",
        (3, _) => "VECTOR64",
        (4, ..=32) => "ROTATION32",
        (4, _) => "ROTATION64",
        (_, ..=32) => "FRAME32",
        _ => "FRAME64",
    };
    CODECS.iter().map(|format| format!("{}({})\n", kind(format), format.id)).collect()
}
