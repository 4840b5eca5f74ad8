//! Raw components as half floats, and the conversion to and from them.
//!
//! Source: Cigolle et al. 2014, section 3 (float x 3); IEEE 754 binary16. The error: Meyer et al. 2010, eq. 3.
//!
//! The conversion is all integer arithmetic: devices may round their own either way, and flush denormals.
//!
//! * Layout: x in bits 0 to 15, y in 16 to 31, z in 32 to 47: a VK_FORMAT_R16G16B16_SFLOAT.
//! * Raw: the components are stored as they are, each rounded to the nearest half (ties to even), and come back so:
//!   lengths from 2^-13 to 2^15 hold their direction, larger components saturate to 65504. The caller renormalises.
//! * Error: at most `sqrt(2)/3 2^-10` radians (0.0264 degrees), near (1/2, 1/2, 1/2) and its multiples by powers of
//!   two; unit vectors come nowhere near those, and for them `sqrt(3) 2^-12` (0.0243 degrees) holds.
//! * The survey's errors, mean 0.00635 and maximum 0.02635 degrees, are those of truncating conversion (measured so:
//!   0.00634, 0.0255); rounded to nearest they are 0.00606 and 0.0228.
//! * Good for: vectors whose length matters too. It spends bits near the axes' planes, where they do not help:
//!   snorm16x3 has a ninth of the error, `oct32` a fifth in two thirds of the bits.
//! * The six axes round-trip exactly. Patterns of infinity and NaN, which `encode` never writes, decode to +-65504; -0,
//!   which it does not write either, to 0; and three zeros, which have no direction, to +Z.

use crate::codec::Codec;
use crate::direction::or_z;
use crate::math::{is_negative, negate_if};
use glam::Vec3;

/// The half of 65504, the largest.
pub const HALF_MAX: u32 = 0x7bff;

/// 1.0 as a half.
pub const HALF_ONE: u32 = 0x3c00;

/// The half nearest to `x`, ties to even. What is too large gives +-65504, infinity and NaN too; what rounds to 0 gives
/// +0, of either sign.
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
    let normal = bits.wrapping_sub(0x3800_0000).wrapping_add(0xfff + ((bits >> 13) & 1)) >> 13;

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

/// Raw components as half floats: a VK_FORMAT_R16G16B16_SFLOAT.
pub struct Float16x3;

impl Codec for Float16x3 {
    const NAME: &'static str = "float16x3";
    const BITS: u32 = 48;
    const IS_UNIT: bool = false;
    /// For vectors of lengths from 2^-13 to 2^15. Meyer's eq. 3 with 10 bits, rounded up.
    const MAX_ERROR_DEG: f32 = 0.0264;
    type Code = [u32; 2];

    #[inline(always)]
    fn encode(v: Vec3) -> [u32; 2] {
        let (v, _) = or_z(v);
        let low = half_encode(v.x) | (half_encode(v.y) << 16);
        let z = half_encode(v.z);
        [low, if (low | z) == 0 { HALF_ONE } else { z }]
    }

    #[inline(always)]
    fn decode(code: [u32; 2]) -> Vec3 {
        let none = ((code[0] & 0x7fff_7fff) | (code[1] & 0x7fff)) == 0;
        let z = if none { HALF_ONE } else { code[1] };
        Vec3::new(half_decode(code[0]), half_decode(code[0] >> 16), half_decode(z))
    }
}
