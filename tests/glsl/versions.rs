//! The flattened files, and so the includes that they are made of, in all versions of GLSL.

use super::calls;
use rspirv::dr::{Operand, load_bytes};
use rspirv::spirv::Decoration;
use std::process::Command;
use unitvec_tests::{glsl_families, repository};

/// Versions of GLSL, and whether a fragment shader's inputs have locations there, as SPIR-V needs.
const VERSIONS: [(&str, bool); 7] = [
    ("330", false),
    ("400", false),
    ("450", true),
    ("460", true),
    ("300 es", false),
    ("310 es", true),
    ("320 es", true),
];

/// A fragment shader that calls every function of some families' codecs, with the flattened files after `before`.
fn shader((version, has_locations): (&str, bool), before: &str, families: &[String]) -> String {
    let read = |file| std::fs::read_to_string(repository().join("glsl/flat").join(file)).unwrap();
    let text: String = families.iter().map(read).collect();
    let calls: String = families.iter().map(|file| calls(file)).collect();
    let location = if has_locations { "layout(location = 0) " } else { "" };
    format!(
        "#version {version}\n{before}\n{text}\n{location}in vec3 direction;\n{location}out vec4 color;\n\
         void main() {{\nvec3 v = direction;\n{calls}color = vec4(v, 1.0);\n}}\n"
    )
}

/// Fails unless glslang's own checker accepts a fragment shader: shaderc has not all versions.
pub fn assert_valid(what: &str, shader: &str, options: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shader.frag");
    std::fs::write(&path, shader).unwrap();
    let output = Command::new("glslangValidator")
        .args(options)
        .arg(&path)
        .output()
        .expect("glslangValidator is missing: `cargo xtask setup` installs it");
    assert!(output.status.success(), "{what}: {}", String::from_utf8_lossy(&output.stdout));
}

/// All families in one shader, and each alone in the oldest version, which shows that a file has all that it needs.
#[test]
fn families_compile_in_all_versions() {
    let all: Vec<String> = glsl_families().into_iter().collect();
    for family in &all {
        let alone = shader(VERSIONS[0], "", std::slice::from_ref(family));
        assert_valid(&format!("{family} in {:?}", VERSIONS[0]), &alone, &[]);
    }
    for version in VERSIONS {
        assert_valid(&format!("all families in {version:?}"), &shader(version, "", &all), &[]);
    }
}

/// Files are in the reverse order, so that they come after those that have them, and before.
#[test]
fn families_compile_in_any_order() {
    let reversed: Vec<String> = glsl_families().into_iter().rev().collect();
    assert_valid("all families reversed", &shader(("450", true), "", &reversed), &[]);
}

/// A fragment shader of ES has mediump integers unless it says otherwise: codes of 32 bits need highp, which SPIR-V
/// shows as the lack of the decoration RelaxedPrecision.
#[test]
fn nothing_is_mediump_in_es() {
    let all: Vec<String> = glsl_families().into_iter().collect();
    let relaxed = |statement| count_relaxed(&shader(("310 es", true), statement, &all));
    assert_eq!(relaxed("precision highp float;"), 0);
    assert_eq!(relaxed("precision mediump float;\nprecision mediump int;"), 0);
}

/// The decorations RelaxedPrecision in the SPIR-V of a fragment shader.
fn count_relaxed(shader: &str) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shader.spv");
    assert_valid("ES 3.10", shader, &["-V", "-o", path.to_str().unwrap()]);
    let spirv = load_bytes(std::fs::read(&path).unwrap()).unwrap();
    let relaxed = Operand::Decoration(Decoration::RelaxedPrecision);
    spirv.annotations.iter().filter(|line| line.operands.contains(&relaxed)).count()
}
