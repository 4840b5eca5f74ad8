//! OpenGL and OpenGL ES run the flattened files on llvmpipe, by `tests/clients/opengl.py`: all gives the test vectors.

use std::process::Command;
use unitvec_catalogue::{Element, RECOMMENDED, find};
use unitvec_tests::repository;

fn assert_agrees(version: [&str; 3], codecs: &[&str]) {
    let output = Command::new("python3")
        .arg(repository().join("tests/clients/opengl.py"))
        .args(version.iter().chain(codecs))
        .envs([("LIBGL_ALWAYS_SOFTWARE", "1"), ("MESA_SHADER_CACHE_DISABLE", "1")])
        .output()
        .expect("python3 is missing: `cargo xtask setup` installs it");
    assert!(output.status.success(), "{version:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Where there is `precise`, the recommended codecs give the CPU's bits.
#[test]
fn opengl_4_gives_the_cpus_bits() {
    let ids = RECOMMENDED.iter().flat_map(|row| row.choices).map(|choice| choice.id);
    let is_vector = |id: &&str| find(id).unwrap().element == Element::Vector;
    assert_agrees(["gl", "4.5", "450"], &ids.filter(is_vector).collect::<Vec<_>>());
}

/// Older versions leave fusing to the compiler. llvmpipe's fuses nothing in these.
#[test]
fn older_opengl_gives_the_cpus_bits() {
    for version in [["gl", "3.3", "330"], ["es", "3.0", "300 es"]] {
        assert_agrees(version, &["oct16", "oct24p", "oct32", "hemioct16", "soct17", "ico32"]);
    }
}
