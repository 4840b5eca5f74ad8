//! Half floats (IEEE 754 binary16), converted with integers.

use super::{is_negative, negate_if};

/// The half of 65504, the largest.
pub const HALF_MAX: u32 = 0x7bff;

/// 1.0 as a half.
pub const HALF_ONE: u32 = 0x3c00;

/// The half nearest to `x`, ties to even. Larger numbers, infinity and NaN give +-65504; numbers of either sign that
/// round to 0 give +0.
#[inline(always)]
pub fn half_encode(x: f32) -> u32 {
    let magnitude = half_encode_magnitude(x);
    magnitude | if is_negative(x) && magnitude != 0 { 0x8000 } else { 0 }
}

/// The half nearest to `|x|`, ties to even; see [`half_encode`].
#[inline(always)]
pub fn half_encode_magnitude(x: f32) -> u32 {
    let bits = x.to_bits() & 0x7fff_ffff;
    let exponent = bits >> 23;

    // From 2^-14 on: 13 bits less of the significand, 112 less of the exponent; a carry is right in both.
    let normal = bits.wrapping_sub(0x3800_0000 - 0xfff).wrapping_add((bits >> 13) & 1) >> 13;

    // From 2^-25 to 2^-14: whole multiples of 2^-24. Below, `shift` stands in for one that is larger.
    let shift = if exponent >= 102 { 126u32.wrapping_sub(exponent) & 31 } else { 25 };
    let significand = (bits & 0x007f_ffff) | 0x0080_0000;
    let whole = significand >> shift;
    let rest = significand & ((1 << shift) - 1);
    let half = (1 << shift) >> 1;
    let subnormal = whole + if rest + (whole & 1) > half { 1 } else { 0 };

    let rounded = if bits >= 0x3880_0000 { normal } else { subnormal };
    if bits >= 0x477f_f000 { HALF_MAX } else { rounded }
}

/// The number that the half in the low 16 bits of `code` stands for. Exact; infinity and NaN count as +-65504, and -0
/// as 0.
#[inline(always)]
pub fn half_decode(code: u32) -> f32 {
    let magnitude = half_decode_magnitude(code & 0x7fff);
    negate_if((code & 0x8000) != 0 && magnitude > 0.0, magnitude)
}

/// The number that a half without its sign, `code` below 2^15, stands for; see [`half_decode`].
#[inline(always)]
pub fn half_decode_magnitude(code: u32) -> f32 {
    let finite = if code > HALF_MAX { HALF_MAX } else { code };
    // 2^-24, the least half: such a multiple of it is a normal f32.
    let subnormal = finite as f32 * 5.960_464_5e-8;
    let normal = f32::from_bits((finite << 13) + 0x3800_0000);
    if finite < 0x400 { subnormal } else { normal }
}
