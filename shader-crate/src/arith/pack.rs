//! Integers in the low bits of words.

use super::{ONE_AND_A_HALF_2_23, whole_to_i32};
use glam::Vec2;

/// The low `bits` bits set. `bits` is 1 to 31.
#[inline(always)]
pub const fn mask(bits: u32) -> u32 {
    (1 << bits) - 1
}

/// The two's complement, in `bits` bits (at most 22), of a whole number from -2^21 to 2^21 - 1.
#[inline(always)]
pub fn signed_code(whole: f32, bits: u32) -> u32 {
    whole_to_i32(whole) as u32 & mask(bits)
}

/// The two's complement, in `bits` bits (at most 22), of the whole number nearest to `x`, the even one of two. Magnitudes
/// up to 2^21; for others, and NaN, any code.
///
/// One addition rounds and converts: the sum's last place is the unit. It needs a device that rounds sums to nearest, as
/// all known ones do; one that truncates gives the whole number below.
#[inline(always)]
pub fn nearest_code(x: f32, bits: u32) -> u32 {
    (x + ONE_AND_A_HALF_2_23).to_bits() & mask(bits)
}

/// The integer of the low `bits` bits (2 to 25) of a code, in two's complement.
#[inline(always)]
pub fn signed_integer(code: u32, bits: u32) -> f32 {
    ((code << (32 - bits)) as i32 >> (32 - bits)) as f32
}

/// The nearest whole numbers to those of `e`, as by [`nearest_code`], as one code: x in the low `bits` bits (at most 16), y
/// in the next.
#[inline(always)]
pub fn nearest_pair(e: Vec2, bits: u32) -> u32 {
    nearest_code(e.x, bits) | (nearest_code(e.y, bits) << bits)
}
