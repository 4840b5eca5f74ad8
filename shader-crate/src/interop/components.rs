//! glTF's quantised normals: x, y and z in signed bytes or words, beside an unused lane.

use super::nearest::Nearest;
use super::plain::{most, snorm};
use super::quaternion::largest_number;
use glam::Vec3;

/// The deviation from unit length that glTF's validator lets pass: ACCESSOR_VECTOR3_NON_UNIT of glTF-Validator 434283be.
pub(super) const VALID: f32 = 0.006_74;

/// Rounding is among the trials: half the diagonal of a cell.
pub(super) fn bound_deg(bits: u32) -> f32 {
    (0.866_025_4 / (most(bits - 1) * (1.0 - VALID))).to_degrees()
}

#[inline(always)]
pub(super) fn code([x, y, z]: [i32; 3], bits: u32) -> [u32; 2] {
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
fn cube([x, y, z]: [i32; 3]) -> [[i32; 3]; 27] {
    const STEPS: [i32; 3] = [0, 1, -1];
    core::array::from_fn(|n| [x + STEPS[n / 9], y + STEPS[n / 3 % 3], z + STEPS[n % 3]])
}

/// The vectors of the 3 by 3 by 3 points around the rounded one that encoders write alike whether they normalise first or not.
pub(super) fn neighbours(v: Vec3, bits: u32) -> impl Iterator<Item = Vec3> {
    let rounded = move |v: Vec3| v.normalize().to_array().map(|t| snorm(t, bits));
    let vectors = cube(rounded(v))
        .into_iter()
        .map(move |point| (point, Vec3::from_array(point.map(|c| c as f32 / most(bits - 1)))));
    vectors.filter(move |(point, vector)| rounded(*vector) == *point).map(|(_, vector)| vector)
}

/// The code of a usable direction: rounded, or the nearest that the validator takes for a unit vector.
pub(super) fn encode(v: Vec3, bits: u32, is_plain: bool) -> [u32; 2] {
    let plain = v.normalize().to_array().map(|t| snorm(t, bits));
    if is_plain {
        return code(plain, bits);
    }
    // Not normalised, which in f32 would turn the ray by a part of what codes of 16 bits are off.
    let mut nearest =
        Nearest::new(v.to_array().map(f64::from), largest_number(bits), f64::from(VALID), plain);
    nearest.offer(plain);
    nearest.search();
    code(nearest.found, bits)
}
