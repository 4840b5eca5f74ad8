//! The example programs: compiled as their users would, run, and their output compared with the expected one.

use super::program::{Library, compile};
use std::process::Command;
use unitvec_tests::repository;

fn output(example: &str, library: Library) -> String {
    let folder = tempfile::tempdir().unwrap();
    let program = compile(&repository().join("examples").join(example), folder.path(), library);
    let output = Command::new(program).output().unwrap();
    assert!(output.status.success(), "{example}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// C99, with either library. (0, 0.6, -0.8) has the L1 norm 1.4: on the octahedron it is (0, 3/7), folded to
/// (1 - 3/7, 1 - 0): the square's (4/7, 1), times 32767.
#[test]
fn c() {
    for library in [Library::Static, Library::Shared] {
        let text = output("c/normals.c", library);
        let [x, y] = [4.0 / 7.0 * 32767.0, 32767.0].map(|t: f64| t.round() as u32);
        assert!(text.contains(&format!("oct32 of (0, 0.6, -0.8): {:#010x}", x | (y << 16))), "{text}");
        assert!(text.contains("oct32p: 3 normals in 12 bytes"), "{text}");
        assert!(text.contains("an unknown codec: unknown codec"), "{text}");
    }
}

/// C++17, with either library.
#[test]
#[cfg_attr(not(feature = "glsl"), ignore = "needs a C++ compiler, as that of GLSL does: `cargo xtask test`")]
fn cpp() {
    for library in [Library::Static, Library::Shared] {
        let text = output("cpp/vertices.cpp", library);
        // The normal's 12 of 32 bytes, position, normal and uv, become 4. A frame of seven floats takes 4 bytes too.
        assert!(text.contains("256 vertices: 8192 bytes, packed 6144"), "{text}");
        assert!(text.contains("frames: 7168 bytes, packed 1024"), "{text}");
        assert!(text.contains("too few bytes: the size of the codes"), "{text}");
    }
}
