//! Rounding to whole numbers, and whole numbers as integers.

use super::{floor, mask};

/// The integer part of `x`, for `x` between -2^31 and 2^31.
///
/// `as` saturates, which SPIR-V has no instruction for: it would take four more to keep a bound that `x` never reaches.
#[inline(always)]
#[cfg_attr(target_arch = "spirv", allow(unsafe_code))]
pub(crate) fn integer_part(x: f32) -> i32 {
    // SAFETY: `x` is in range. (Beyond it the value is undefined in SPIR-V, the behaviour is not.)
    #[cfg(target_arch = "spirv")]
    return unsafe { x.to_int_unchecked() };
    #[cfg(not(target_arch = "spirv"))]
    return x as i32;
}

/// A whole number from 0 to 2^23 - 1 as an integer.
///
/// On the CPU, the sum with 2^23 is exact and holds the number in its low 23 bits: one addition where a cast compiles
/// to a saturating sequence.
#[inline(always)]
pub fn whole_to_u32(whole: f32) -> u32 {
    if cfg!(target_arch = "spirv") {
        integer_part(whole) as u32
    } else {
        (whole + TWO_23).to_bits() & mask(23)
    }
}

/// A whole number from -2^22 to 2^22 - 1 as an integer.
///
/// The CPU adds as in [`whole_to_u32`]: the bits of the sum count up with the number.
#[inline(always)]
pub(crate) fn whole_to_i32(whole: f32) -> i32 {
    if cfg!(target_arch = "spirv") {
        integer_part(whole)
    } else {
        (whole + ONE_AND_A_HALF_2_23).to_bits().wrapping_sub(ONE_AND_A_HALF_2_23.to_bits()) as i32
    }
}

/// 2^23: its sums with numbers of 0 to 2^23 have the unit as their last place, so that the low 23 bits are the number.
pub(crate) const TWO_23: f32 = 8_388_608.0;

/// 1.5 2^23: its sums with numbers of at most 2^22 have the unit as their last place, so that they are whole; the low
/// 22 bits are their two's complement.
pub(crate) const ONE_AND_A_HALF_2_23: f32 = 12_582_912.0;

/// The nearest whole number, the even one of two, by sums: cheaper than [`floor`] on most processors. Magnitudes up to
/// 2^21.
#[inline(always)]
pub(crate) fn nearest_whole(x: f32) -> f32 {
    (x + ONE_AND_A_HALF_2_23) - ONE_AND_A_HALF_2_23
}

/// The largest integer not above `x`, as a float, for `x` from -2^21 to 2^21. Three times as fast as `floor` where a
/// CPU's base instruction set lacks that; SPIR-V has an instruction.
#[inline(always)]
pub(crate) fn small_floor(x: f32) -> f32 {
    if cfg!(target_arch = "spirv") {
        floor(x)
    } else {
        let near = nearest_whole(x);
        if near > x { near - 1.0 } else { near }
    }
}
