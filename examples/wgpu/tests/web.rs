//! The vectors of the page `examples/web`.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use unitvec::{Codec, Oct32};

/// Axes, a mesh's normals of other lengths, a tie, and what has no direction.
const NORMALS: [[f32; 3]; 8] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.6, 0.0, -0.8],
    [1.0, 2.0, 3.0],
    [-0.2672612, 0.5345225, -0.8017837],
    [-1e-20, 1e-20, 1e-20],
    [0.0, 0.0, 0.0],
    [f32::NAN, 1.0, 0.0],
];

/// The page's vectors are what the CPU gives: oct32 is released, so they never change.
#[test]
fn vectors_of_the_page_are_those_of_the_cpu() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../web/vectors.js");
    let bits = |vector: [f32; 3]| vector.map(|x| format!("{:#010x}", x.to_bits())).join(", ");
    let mut text = "// Normals with the code of oct32 and the decoded vector that the Rust crate gives, floats by their bits.\n\
                    export const VECTORS = [\n"
        .to_owned();
    for normal in NORMALS {
        let code = Oct32::encode(normal);
        let [normal, decoded] = [normal, Oct32::decode(code)].map(bits);
        writeln!(text, "    {{ normal: [{normal}], code: {code:#010x}, decoded: [{decoded}] }},").unwrap();
    }
    text += "];\n";
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
}
