//! `host/mesh/data/torus.glb`: a small mesh with tangents, from a formula, for the command lines of README and docs.

use super::compare;
use crate::fuzz::seeds::glb_of;
use unitvec::arith::sin_cos_half_turns;
use unitvec_tests::repository;

/// Cells around the torus and around its tube. The last vertices repeat the first.
const CELLS: [u16; 2] = [24, 12];

const JSON: &str = r#"{"asset":{"version":"2.0","generator":"tests/docs/torus.rs","copyright":"public domain"},
"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TANGENT":2},"indices":3}]}],"accessors":[
{"bufferView":0,"componentType":5126,"count":325,"type":"VEC3","min":[-1.4,-1.4,-0.4],"max":[1.4,1.4,0.4]},
{"bufferView":0,"byteOffset":12,"componentType":5126,"count":325,"type":"VEC3"},
{"bufferView":0,"byteOffset":24,"componentType":5126,"count":325,"type":"VEC4"},
{"bufferView":1,"componentType":5123,"count":1728,"type":"SCALAR"}],"bufferViews":[
{"buffer":0,"byteLength":13000,"byteStride":40,"target":34962},
{"buffer":0,"byteOffset":13000,"byteLength":3456,"target":34963}],"buffers":[{"byteLength":16456}]}"#;

/// Position, normal and tangent. The tangent's sign changes halfway around, as with mirrored textures.
fn vertex(column: u16, row: u16) -> [f32; 10] {
    let turn = |n: u16, of: u16| <[f32; 2]>::from(sin_cos_half_turns(2.0 * f32::from(n) / f32::from(of)));
    let ([x, y], [z, out]) = (turn(column, CELLS[0]), turn(row, CELLS[1]));
    let (radius, sign) = (1.0 + 0.4 * out, if column < CELLS[0] / 2 { 1.0 } else { -1.0 });
    [radius * y, radius * x, 0.4 * z, out * y, out * x, z, -x, y, 0.0, sign]
}

#[test]
fn the_mesh_is_the_formulas() {
    let [columns, rows] = CELLS;
    let vertices = (0..=rows).flat_map(|row| (0..=columns).flat_map(move |column| vertex(column, row)));
    let triangles = (0..rows).flat_map(|row| {
        (0..columns).map(move |column| row * (columns + 1) + column).flat_map(|a| {
            let [b, c, d] = [a + 1, a + columns + 1, a + columns + 2];
            [a, b, c, b, d, c]
        })
    });
    let vertices = vertices.flat_map(f32::to_le_bytes);
    let buffer: Vec<u8> = vertices.chain(triangles.flat_map(u16::to_le_bytes)).collect();
    compare(&repository().join("host/mesh/data/torus.glb"), &glb_of(JSON, &buffer));
}
