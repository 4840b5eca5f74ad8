//! Unity's tetrahedral encoding: the face of a tetrahedron in 2 bits, and 10 bits each of x and y seen along its normal.

use super::{around, nearest_of};
use crate::arith::mask;
use glam::{Mat3, Vec3};

/// The bound of the nearest code's error: half a cell's diagonal, `sqrt(2) / 1023`, where it is seen at its flattest: a face
/// reaches to where z is 1/3.
pub(super) const BOUND_DEG: f32 = 0.238;

/// The sine and the cosine of the angle between a face's normal and the z axis, with the digits of the source.
const S: f32 = 0.816_497;
const C: f32 = 0.577_35;

/// The frames of the faces, by rows; the last is the normal.
const FACES: [Mat3; 4] = [
    Mat3::from_cols_array(&[-1.0, 0.0, 0.0, 0.0, C, S, 0.0, S, -C]),
    Mat3::from_cols_array(&[0.0, -1.0, 0.0, C, 0.0, S, -S, 0.0, C]),
    Mat3::from_cols_array(&[0.0, 1.0, 0.0, -C, 0.0, S, S, 0.0, C]),
    Mat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, -C, S, 0.0, -S, -C]),
];

/// The place of a direction on a face: its x, y and z there.
fn on_face(v: Vec3, face: usize) -> Vec3 {
    // The rows are the columns here.
    FACES[face].transpose() * v
}

fn code(x: i32, y: i32, face: usize) -> [u32; 2] {
    [x as u32 | (y as u32) << 10 | (face as u32) << 20, 0]
}

/// The direction of a code. Points outside the disc of a face count as its edge.
pub(super) fn decode(code: u32) -> Vec3 {
    let component = |first: u32| (code >> first & mask(10)) as f32 * (2.0 / 1023.0) - 1.0;
    let (x, y) = (component(0), component(10));
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    (FACES[(code >> 20 & 3) as usize] * Vec3::new(x, y, z)).normalize()
}

/// The code of a usable direction: of the nearest face's points, rounded as the render target does, or of the points around
/// that on all faces that it lies before.
pub(super) fn encode(v: Vec3, is_plain: bool) -> [u32; 2] {
    let v = v.normalize();
    let places: [Vec3; 4] = core::array::from_fn(|face| on_face(v, face));
    let number = |t: f32| ((t * 0.5 + 0.5) * 1023.0).round_ties_even() as i32;
    if is_plain {
        let face = (1..4).fold(0, |best, face| if places[face].z > places[best].z { face } else { best });
        return code(number(places[face].x), number(places[face].y), face);
    }
    let before = (0..4).filter(|face| places[*face].z > 0.0);
    let codes = before.flat_map(|face| {
        let point = [number(places[face].x), number(places[face].y)];
        around(point, [-1, 0, 1]).map(move |[x, y]| code(x.clamp(0, 1023), y.clamp(0, 1023), face))
    });
    nearest_of(v, codes, |code| decode(code[0])).unwrap_or_default()
}
