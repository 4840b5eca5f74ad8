//! glTF's quantised normals: x, y and z in signed bytes or words, beside an unused lane.

use super::plain::{most, snorm};
use super::{around, nearest_of};
use crate::arith::nearest_whole;
use glam::Vec3;

/// The deviation from unit length that glTF's validator lets pass: ACCESSOR_VECTOR3_NON_UNIT of glTF-Validator 434283be.
pub(super) const VALID: f32 = 0.006_74;

/// The lengths that are tried a step: a quarter step apart no code that is less than 3/8 of a step off is missed.
const TRIALS_A_STEP: f32 = 4.0;

/// Rounding is among the trials: half the diagonal of a cell.
pub(super) fn bound_deg(bits: u32) -> f32 {
    (0.866_025_4 / (most(bits - 1) * (1.0 - VALID))).to_degrees()
}

fn code([x, y, z]: [i32; 3], bits: u32) -> [u32; 2] {
    match bits {
        8 => [u32::from_le_bytes([x as u8, y as u8, z as u8, 0]), 0],
        _ => [u32::from(x as u16) | u32::from(y as u16) << 16, u32::from(z as u16)],
    }
}

/// The vector of a code as glTF defines it: each component divided by the largest, the lowest counting as -1. Not of unit
/// length.
pub(super) fn decode([low, high]: [u32; 2], bits: u32) -> Vec3 {
    let [x, y, z, _] = low.to_le_bytes().map(|byte| f32::from(byte as i8));
    let v = match bits {
        8 => Vec3::new(x, y, z),
        _ => Vec3::from_array([low as i16, (low >> 16) as i16, high as i16].map(f32::from)),
    };
    v.to_array().map(|c| (c / most(bits - 1)).max(-1.0)).into()
}

/// The 3 by 3 by 3 points around one, which comes first.
fn cube([x, y, z]: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    around([x, y], [0, 1, -1]).flat_map(move |[x, y]| [0, 1, -1].map(|k| [x, y, z + k]))
}

/// The vectors of the 3 by 3 by 3 points around the rounded one that encoders write alike whether they normalise first or not.
pub(super) fn beside(v: Vec3, bits: u32) -> impl Iterator<Item = Vec3> {
    let rounded = move |v: Vec3| v.normalize().to_array().map(|t| snorm(t, bits));
    let vectors = cube(rounded(v))
        .map(move |point| (point, Vec3::from_array(point.map(|c| c as f32 / most(bits - 1)))));
    vectors.filter(move |(point, vector)| rounded(*vector) == *point).map(|(_, vector)| vector)
}

/// The code of a usable direction: rounded, or the nearest that the validator takes for a unit vector, of the points next to
/// the ray at lengths a quarter step apart.
pub(super) fn encode(v: Vec3, bits: u32, is_plain: bool) -> [u32; 2] {
    let v = v.normalize();
    let plain = v.to_array().map(|t| snorm(t, bits));
    if is_plain {
        return code(plain, bits);
    }
    let most = most(bits - 1);
    let [shortest, longest] = [-VALID, VALID].map(|part| (f64::from(most) * (1.0 + f64::from(part))).powi(2));
    let is_valid = |[x, y, z]: &[i32; 3]| {
        let fits = x.abs().max(y.abs()).max(z.abs()) <= most as i32;
        let [x, y, z] = [*x, *y, *z].map(f64::from);
        let square = x * x + y * y + z * z;
        fits && shortest < square && square < longest
    };
    let (least, steps) = (most * (1.0 - VALID), (2.0 * VALID * most * TRIALS_A_STEP) as u32);
    let trials = (0..=steps)
        .map(|i| (v * (least + i as f32 / TRIALS_A_STEP)).to_array().map(|c| nearest_whole(c) as i32));
    let points = cube(plain).chain(trials).filter(is_valid);
    code(nearest_of(v, points, |point| Vec3::from_array(point.map(|c| c as f32))).unwrap_or(plain), bits)
}
