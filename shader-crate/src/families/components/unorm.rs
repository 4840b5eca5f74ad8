//! Raw components, scaled and biased to unorm: `v * 0.5 + 0.5`.
//!
//! Source: the usual encoding of normal maps; Cigolle et al. 2014, section 1.2 ("scaled and biased unorm").
//!
//! <!-- generated: errors unorm -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `unorm8x3` | 0.170 | 0.388 | 0.389 |
//! <!-- end -->
//!
//! * Layout: x in the low byte, then y, then z: a VK_FORMAT_R8G8B8_UNORM. A byte `i` stands for `(2 i - 255) / 255`.
//! * Raw: the components are stored as they are, clamped to \[-1, 1\], and come back so. Give a vector of unit length.
//!   Decoded vectors are off unit length by up to the error, and the caller renormalises.
//! * Error: at most `asin(sqrt(3)/255)` for unit vectors: the half diagonal of a cell.
//! * Good for: RGB8 targets without snorm, and data that other programs wrote so. [`oct24`](crate::oct) needs no more
//!   bits and has a fraction of the error.
//! * It cannot hold 0, which becomes 1/255: no axis round-trips exactly, each is off by `sqrt(2)/255` radians.

use crate::arith::{mask, snorm_quotient, unorm_code};
use crate::codec::Codec;
use crate::direction::{is_usable, l1_norm};
use glam::Vec3;

/// The byte of a component.
#[inline(always)]
fn encode_component(r: f32) -> u32 {
    unorm_code(r * 0.5 + 0.5, 8)
}

/// The code of +Z. 0 becomes 128, the even one of the two next to it.
const Z_CODE: u32 = 0xff_8080;

/// The component of the low byte of `code`: one rounding, and the same magnitude for `i` and `255 - i`.
#[inline(always)]
fn decode_component(code: u32) -> f32 {
    // 255 is the largest integer of an snorm of 9 bits.
    snorm_quotient(2.0 * (code & mask(8)) as f32 - 255.0, 9)
}

/// Raw components as scaled and biased unorm8: a VK_FORMAT_R8G8B8_UNORM.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Unorm8x3;

impl Codec for Unorm8x3 {
    const BITS: u32 = 24;
    const EXACT_AXES: bool = false;
    const IS_UNIT: bool = false;
    /// The bound for unit vectors: `asin(sqrt(3)/255)`, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = 0.3893;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let code = encode_component(v.x) | (encode_component(v.y) << 8) | (encode_component(v.z) << 16);
        if is_usable(l1_norm(v)) { code } else { Z_CODE }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        Vec3::new(decode_component(code), decode_component(code >> 8), decode_component(code >> 16))
    }
}
