//! naga, which wgpu and Bevy read GLSL with, reads the flattened files. Here and not among the other tests, since naga has
//! crates in common with procedural macros: all of these would be built twice.

use naga::ShaderStage;
use naga::front::glsl::{Frontend, Options};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::path::Path;

/// All functions of each file are parsed and validated.
#[test]
fn naga_reads_the_flattened_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../glsl/flat");
    let mut read = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let shader = format!("#version 450\n{text}\nvoid main() {{}}\n");
        let module = Frontend::default()
            .parse(&Options::from(ShaderStage::Fragment), &shader)
            .unwrap_or_else(|error| panic!("{}: {}", path.display(), error.emit_to_string(&shader)));
        assert!(module.functions.len() > 10, "{}", path.display());
        Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {}", path.display(), error.emit_to_string(&shader)));
        read += 1;
    }
    assert!(read > 10);
}
