//! Raw components as half floats, and the conversion to and from them.
//!
//! Source: Cigolle et al. 2014, section 2 (float x 3); IEEE 754 binary16. The error: Meyer et al. 2010, eq. 3.
//!
//! The conversion is all integer arithmetic: devices may round their own either way, and flush denormals.
//!
//! <!-- generated: errors float -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `float16x3` | 0.00606 | 0.0234 | 0.0264 |
//! <!-- end -->
//!
//! * Layout: x in bits 0 to 15, y in 16 to 31, z in 32 to 47: a VK_FORMAT_R16G16B16_SFLOAT.
//! * Raw: the components are stored as they are, each rounded to the nearest half (ties to even), and come back so.
//!   Lengths from 2^-13 to 2^15 hold their direction; larger components saturate to 65504. The caller renormalises.
//! * Error: at most `sqrt(2)/3 2^-10` radians, near (1/2, 1/2, 1/2) and its multiples by powers of two. Unit vectors
//!   come nowhere near those; for them `sqrt(3) 2^-12` holds.
//! * The survey's errors are those of truncating conversion, which measures the same; rounding to nearest has less.
//! * Good for: vectors whose length matters too. It spends bits near the axes' planes, where they do not help:
//!   [`snorm16x3`](crate::snorm) and [`oct32`](crate::oct) have a fraction of the error.
//! * The six axes round-trip exactly. Patterns of infinity and NaN, which `encode` never writes, decode to +-65504; -0,
//!   which it does not write either, to 0; and three zeros, which have no direction, to +Z.

use crate::arith::{HALF_ONE, half_decode, half_encode};
use crate::codec::Codec;
use crate::direction::or_z;
use glam::Vec3;

/// Raw components as half floats: a VK_FORMAT_R16G16B16_SFLOAT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Float16x3;

impl Codec for Float16x3 {
    const BITS: u32 = 48;
    const IS_UNIT: bool = false;
    /// The bound for vectors of lengths from 2^-13 to 2^15: Meyer's eq. 3 with 10 bits, rounded up.
    const MAX_ERROR_DEG: f32 = 0.0264;
    const NULL: Option<[u32; 2]> = Some([0; 2]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, _) = or_z(v);
        let low = half_encode(v.x) | (half_encode(v.y) << 16);
        let z = half_encode(v.z);
        [low, if (low | z) == 0 { HALF_ONE } else { z }]
    }

    #[inline(always)]
    fn decode_vec3(code: [u32; 2]) -> Vec3 {
        let none = ((code[0] & 0x7fff_7fff) | (code[1] & 0x7fff)) == 0;
        let z = if none { HALF_ONE } else { code[1] };
        Vec3::new(half_decode(code[0]), half_decode(code[0] >> 16), half_decode(z))
    }
}
