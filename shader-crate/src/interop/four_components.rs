//! glTF's quantised rotations: all four components in signed bytes or words.

use super::nearest::Nearest;
use super::plain::snorm;
use super::quaternion::{given, largest_number};
use crate::arith::{mask, signed_integer};

/// The deviation from unit length that glTF's validator lets pass: unitLengthThresholdVec4 of glTF-Validator 434283be.
const VALID: f64 = 0.007_69;

/// The bound of the error, in radians of rotation: half the diagonal of a cell, at the least length.
pub(super) fn bound(bits: u32) -> f64 {
    2.0 / (largest_number(bits) * (1.0 - VALID))
}

/// The code of a usable quaternion, the first component in the lowest lane.
pub(super) fn encode(q: [f32; 4], bits: u32, is_plain: bool) -> u64 {
    let lanes = numbers(q, bits, is_plain).into_iter().rev();
    lanes.fold(0, |code, number| code << bits | u64::from(number as u32 & mask(bits)))
}

/// The quaternion of a code as glTF defines it: each component divided by the largest, the lowest counting as -1.
pub(super) fn decode(code: u64, bits: u32) -> [f32; 4] {
    [0, 1, 2, 3].map(|lane| {
        let number = signed_integer((code >> (lane * bits)) as u32, bits);
        (number / largest_number(bits) as f32).max(-1.0)
    })
}

/// The numbers of four signed components: rounded, or the nearest that the validator takes for a unit quaternion.
fn numbers(q: [f32; 4], bits: u32, is_plain: bool) -> [i32; 4] {
    let plain = given(q).map(|c| snorm(c as f32, bits));
    if is_plain {
        return plain;
    }
    let mut nearest = Nearest::new(q.map(f64::from), largest_number(bits), VALID, plain);
    nearest.search();
    nearest.found
}
