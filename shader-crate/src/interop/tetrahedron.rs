//! Unity's tetrahedral encoding: the face of a tetrahedron in 2 bits, and 10 bits each of x and y seen along its normal.

use super::turn::{Best, Turn, of_length};
use crate::arith::{mask, max, min};
use crate::direction::or_z;
use crate::slice::Coder;
use glam::{Mat3, Vec3};

/// The bound of the nearest code's error: half a cell's diagonal, `sqrt(2) / 1023`, where it is seen at its flattest: a face
/// reaches to where z is 1/3.
pub(super) const BOUND_DEG: f32 = 0.238;

/// The largest number.
const MOST: f32 = 1023.0;

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
#[inline(always)]
fn on_face(v: Vec3, face: usize) -> Vec3 {
    // The rows are the columns here.
    FACES[face].transpose() * v
}

#[inline(always)]
fn code(x: i32, y: i32, face: usize) -> [u32; 2] {
    [x as u32 | (y as u32) << 10 | (face as u32) << 20, 0]
}

/// The direction of a code. Points outside the disc of a face count as its edge.
pub(super) fn decode(code: u32) -> Vec3 {
    let v = of_numbers((code & mask(10)) as f32, (code >> 10 & mask(10)) as f32);
    (FACES[(code >> 20 & 3) as usize] * v).normalize()
}

/// The vector of a point, seen along the face's normal.
#[inline(always)]
fn of_numbers(x: f32, y: f32) -> Vec3 {
    let (x, y) = (x * (2.0 / MOST) - 1.0, y * (2.0 / MOST) - 1.0);
    Vec3::new(x, y, max(1.0 - x * x - y * y, 0.0).sqrt())
}

/// The number that a component is rounded to, as the render target does.
#[inline(always)]
fn number(t: f32) -> f32 {
    ((t * 0.5 + 0.5) * MOST).round_ties_even()
}

/// The code of a usable direction as Unity writes it: on the face that it lies before.
pub(super) fn plain(v: Vec3) -> [u32; 2] {
    let v = v.normalize();
    let places: [Vec3; 4] = core::array::from_fn(|face| on_face(v, face));
    let face = (1..4).fold(0, |best, face| if places[face].z > places[best].z { face } else { best });
    code(number(places[face].x) as i32, number(places[face].y) as i32, face)
}

/// The encoder of the nearest codes.
#[derive(Clone, Copy)]
pub(super) struct Nearest;

impl Coder<3> for Nearest {
    #[inline(always)]
    fn bytes(self) -> usize {
        4
    }

    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn encode(self, v: [f32; 3]) -> [u32; 2] {
        let v = of_length(or_z(v.into()).0, 1.0);
        let best = on_face_or(Best::none((0.0, 0.0, 0)), v, 0);
        let best = on_face_or(on_face_or(best, v, 1), v, 2);
        let (x, y, face) = on_face_or(best, v, 3).point;
        code(x as i32, y as i32, face)
    }

    fn decode(self, code: [u32; 2]) -> [f32; 3] {
        decode(code[0]).to_array()
    }
}

/// The nearest point by its numbers and face.
type Found = Best<(f32, f32, usize)>;

/// The nearest of the 3 by 3 points around a direction's place on a face, or the one that is nearer. Points beyond the face's disc,
/// which are all on its edge, are not sought elsewhere.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn on_face_or(best: Found, v: Vec3, face: usize) -> Found {
    let place = on_face(v, face);
    let (x, y) = (number(place.x), number(place.y));
    three!(best, |best, i| three!(best, |best, j| or_nearer(best, place, x + i, y + j, face)))
}

/// This point, or, where it lies beyond the square's border, that on it, if it is nearer.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn or_nearer(best: Found, place: Vec3, x: f32, y: f32, face: usize) -> Found {
    let (x, y) = (min(max(x, 0.0), MOST), min(max(y, 0.0), MOST));
    best.or((x, y, face), Turn::by(place, of_numbers(x, y) - place))
}
