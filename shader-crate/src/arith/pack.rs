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
    signed_integer_field(code, 0, bits) as f32
}

/// The integer of `bits` bits (1 to 32) of a code, from bit `first` on, in two's complement.
#[inline(always)]
pub(crate) fn signed_integer_field(code: u32, first: u32, bits: u32) -> i32 {
    (code << (32 - first - bits)) as i32 >> (32 - bits)
}

/// The integer of `bits` bits (2 to 25) of a code, from bit `first` on, in two's complement.
///
/// A GPU takes two shifts, which are one instruction; on a CPU with SSE4.1 three are a little faster.
#[inline(always)]
pub fn signed_integer_at(code: u32, first: u32, bits: u32) -> f32 {
    if cfg!(target_arch = "spirv") {
        signed_integer_field(code, first, bits) as f32
    } else {
        signed_integer(code >> first, bits)
    }
}

/// The whole numbers nearest to those of `e`, as [`nearest_code`] gives them, as one code: x in the low `bits` bits (at
/// most 16), y in the next.
#[inline(always)]
pub fn nearest_pair(e: Vec2, bits: u32) -> u32 {
    nearest_code(e.x, bits) | (nearest_code(e.y, bits) << bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the standard library's rounding, for quarters and their neighbours.
    #[test]
    fn the_nearest_whole_number_is_the_even_one_of_two() {
        for bits in [8, 11, 16, 21] {
            let most = 1 << (bits - 1);
            for quarter in (-4 * most..=4 * most - 4).step_by(if bits > 16 { 1021 } else { 1 }) {
                let exact = quarter as f32 / 4.0;
                for x in [exact.next_down(), exact, exact.next_up()] {
                    let expected = x.round_ties_even() as i32 as u32 & mask(bits);
                    assert_eq!(nearest_code(x, bits), expected, "{x} in {bits} bits");
                }
            }
        }
    }
}
