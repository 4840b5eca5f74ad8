//! glTF's quantised rotations: all four components in signed bytes or words.

use super::plain::snorm;
use super::quaternion::{distance, given, largest, largest_number, length, points, unit};
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
    let q = unit(q);
    let (most, axis) = (largest_number(bits), largest(q, &[0, 1, 2, 3]));
    let (off, rounded) = valid_rounded(q, axis, most).unwrap_or((f64::INFINITY, plain));
    // Slices are inclined to the ray: in its slice, a point as far from the ray is farther from the ray's.
    let reach = (off * most * (1.0 + VALID)).min(1.5) / q[axis].abs();
    // Up to half a step, rounding has found it.
    if reach > 0.5 { valid_beside(q, axis, most, reach, (off, rounded)) } else { rounded }
}

/// True for a point that the validator takes for a unit quaternion.
fn is_valid(point: [i32; 4], most: f64) -> bool {
    let length = length(point.map(f64::from));
    (length / most - 1.0).abs() < VALID && point.iter().all(|c| f64::from(c.abs()) <= most)
}

/// The slices with valid points within reach of the ray, whose largest component is `size`. The points of a slice have the
/// same number for the largest component.
fn slices(size: f64, most: f64, reach: f64) -> core::ops::RangeInclusive<i32> {
    let [from, to] = [-VALID, VALID].map(|off| size * (most * (1.0 + off) + reach * off.signum()));
    from.max(1.0) as i32..=to as i32
}

/// The nearest valid point of those that rounding gives in each slice, and its distance.
fn valid_rounded(q: [f64; 4], axis: usize, most: f64) -> Option<(f64, [i32; 4])> {
    /// A sum with it is rounded to a whole number.
    const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
    const SLICES: usize = 8;
    let others = [1, 2, 3].map(|i| q[(axis + i) & 3]);
    let (size, slices, mut best) = (q[axis].abs(), slices(q[axis].abs(), most, 0.5), None);
    let (mut nearest, by_size) = (f64::INFINITY, 1.0 / size);
    let slopes = others.map(|c| c * by_size);
    // The squared tangents of several slices at a time, in registers of the CPU.
    for first in slices.clone().step_by(SLICES) {
        let mut squares = [0.0; SLICES];
        for (i, square) in squares.iter_mut().enumerate() {
            let slice = f64::from(first + i as i32);
            let off = slopes.map(|slope| slope * slice - ((slope * slice + WHOLE) - WHOLE));
            let inward = off[0] * others[0] + off[1] * others[1] + off[2] * others[2];
            let across = off[0] * off[0] + off[1] * off[1] + off[2] * off[2] - inward * inward;
            let along = slice * by_size - inward;
            *square = across / (along * along);
        }
        for (slice, square) in (first..=*slices.end()).zip(squares) {
            if square < nearest {
                let point = q.map(|c| (c / size * f64::from(slice)).round_ties_even() as i32);
                if is_valid(point, most) {
                    (nearest, best) = (square, Some(point));
                }
            }
        }
    }
    best.map(|point| (nearest.max(0.0).sqrt(), point))
}

/// The nearest valid point of all within reach of the ray in each slice, or the best so far.
fn valid_beside(q: [f64; 4], axis: usize, most: f64, reach: f64, mut best: (f64, [i32; 4])) -> [i32; 4] {
    for slice in slices(q[axis].abs(), most, reach) {
        let ray = q.map(|c| c / q[axis].abs() * f64::from(slice));
        let mut ranges = ray.map(|t| [t - reach, t + reach]);
        ranges[axis] = [ray[axis].round(); 2];
        for point in points(ranges).filter(|point| is_valid(*point, most)) {
            let off = distance(q, point.map(|c| c as f32));
            if off < best.0 {
                best = (off, point);
            }
        }
    }
    best.1
}
