//! Raw snorm components: x, y and z each as a normalised signed integer.
//!
//! Source: Cigolle et al. 2014, sections 1.2 and 2 (snorm x 3).
//!
//! <!-- generated: errors snorm -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `snorm5x3` | 1.45 | 3.29 | 3.31 |
//! | `snorm8x3` | 0.170 | 0.390 | 0.391 |
//! | `snorm10x3` | 0.0423 | 0.0970 | 0.0972 |
//! | `snorm11_11_10` | 0.0294 | 0.0686 | 0.0687 |
//! | `snorm16x3` | 0.000660 | 0.00151 | 0.00153 |
//! <!-- end -->
//!
//! * Layout: x in the low bits, then y, then z, in two's complement; `snorm11_11_10` gives x and y 11 bits and z 10.
//! * Raw: the components are stored as they are, clamped to \[-1, 1\], and come back so. Give a vector of unit length.
//!   Decoded vectors are off unit length by up to the error, and the caller renormalises.
//! * Error: at most `asin(sqrt(dx^2 + dy^2 + dz^2))` for unit vectors, the components' half steps being `1/(2 m)`: the
//!   half diagonal of a cell of the lattice, where it is at right angles to the direction.
//! * Good for: targets that the hardware converts and blends. Encoding is three roundings, decoding three divisions. A
//!   third of the bits tells lengths apart: [`oct`](crate::oct) with as many bits is several times as exact.
//! * The six axes round-trip exactly. The pattern of three zeros has no direction: `decode` takes it as +Z, and
//!   `encode` writes +Z where all components round to 0.

use crate::arith::{mask, snorm_code, snorm_decode};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::Vec3;

/// The bits of x and of y, and where z begins, in a code of `bits` bits.
const fn width(bits: u32) -> u32 {
    bits.div_ceil(3)
}

/// The code of +Z: z at its largest, the others 0.
const fn z_code(bits: u32) -> u32 {
    let low = 2 * width(bits);
    mask(bits - low - 1) << low
}

/// Raw snorm components in `BITS` bits (15, 24, 30, or 32 as 11, 11 and 10).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Snorm3<const BITS: u32>;

impl<const BITS: u32> Codec for Snorm3<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const IS_UNIT: bool = false;
    /// The bound for unit vectors: `asin` of the cell's half diagonal, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = match BITS {
        15 => 3.31,
        24 => 0.3908,
        30 => 0.0972,
        32 => 0.0687,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([0; 2]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let w = width(BITS);
        let (x, y) = (snorm_code(v.x, w), snorm_code(v.y, w));
        let code = x | (y << w) | (snorm_code(v.z, BITS - 2 * w) << (2 * w));
        let code = if is_usable(l1_norm(v)) { code } else { 0 };
        if code == 0 { z_code(BITS) } else { code }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let w = width(BITS);
        let used = code << (32 - BITS);
        let code = if used == 0 { z_code(BITS) } else { code };
        Vec3::new(
            snorm_decode(code, w),
            snorm_decode(code >> w, w),
            snorm_decode(code >> (2 * w), BITS - 2 * w),
        )
    }
}

/// Raw snorm components of 16 bits each: a VK_FORMAT_R16G16B16_SNORM.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Snorm16x3;

impl Codec for Snorm16x3 {
    const BITS: u32 = 48;
    const IS_UNIT: bool = false;
    /// The bound for unit vectors: `asin` of the cell's half diagonal, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = 0.001_53;
    const NULL: Option<[u32; 2]> = Some([0; 2]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let low = snorm_code(v.x, 16) | (snorm_code(v.y, 16) << 16);
        let z = snorm_code(v.z, 16);
        let [low, z] = if is_usable(l1_norm(v)) { [low, z] } else { [0, 0] };
        [low, if (low | z) == 0 { mask(15) } else { z }]
    }

    #[inline(always)]
    fn decode_vec3(code: [u32; 2]) -> Vec3 {
        let z = code[1] & mask(16);
        let z = if (code[0] | z) == 0 { mask(15) } else { z };
        Vec3::new(snorm_decode(code[0], 16), snorm_decode(code[0] >> 16, 16), snorm_decode(z, 16))
    }
}
