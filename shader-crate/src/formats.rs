//! Codes as the float or integer values that a Vulkan format stores exactly, and back.
//!
//! A shader writes `code_to_snorm16x2(Oct32::encode(v))` to an attachment of VK_FORMAT_R16G16_SNORM, and takes
//! `Oct32::decode(snorm16x2_to_code(texel))` of a fetched texel. Nothing is rounded on the way: every value is the one
//! that the format's integers stand for, rounded correctly on every device, and it gives back its code.
//!
//! ```
//! use unitvec::{Codec, Oct32, formats};
//!
//! let code = Oct32::encode([0.6, 0.0, -0.8]);
//! let value = formats::code_to_snorm16x2(code);
//! assert_eq!(formats::snorm16x2_to_code(value), code);
//! ```
//!
//! Choose by the codec's [`Listed::VK_FORMAT`](crate::Listed::VK_FORMAT): `Oct32` is VK_FORMAT_R16G16_SNORM. snorm values
//! are in [-1, 1], unorm in [0, 1]; bits above the format's are ignored. No input is invalid: NaN counts as 0, others are
//! clamped; the nearest integer is taken, so that a value that is off by some units in the last place gives its code. Patterns that no encoder writes (the lowest integer of an snorm; -0, infinity
//! and NaN of a half) give the code that decodes alike. The first component is in the low bits of a code.
//!
//! Source: the Vulkan specification, "Fixed-Point Data Conversions"; IEEE 754 binary16.

use crate::arith::{
    SnormDivision, half_decode, half_encode, is_nan, mask, signed_integer_field, snorm_encode, snorm_integer,
    unorm_encode,
};
use glam::{IVec2, Vec2, Vec3};

/// The snorm in the `BITS` bits of `code` from bit `first` on.
#[inline(always)]
fn snorm<const BITS: u32>(code: u32, first: u32) -> f32 {
    const { SnormDivision::new(BITS) }.of(snorm_integer(code >> first, BITS))
}

/// The unorm in the byte of `code` from bit `first` on: 255 is the largest integer of an snorm of 9 bits.
#[inline(always)]
fn unorm8(code: u32, first: u32) -> f32 {
    unorm::<9>(code, first)
}

/// The unorm of one bit less than `SNORM_BITS` in the bits of `code` from bit `first` on: it has the largest integer of such an
/// snorm.
#[inline(always)]
fn unorm<const SNORM_BITS: u32>(code: u32, first: u32) -> f32 {
    const { SnormDivision::new(SNORM_BITS) }.of(((code >> first) & mask(SNORM_BITS - 1)) as f32)
}

#[inline(always)]
fn unorm_code(f: Vec2, bits: u32) -> u32 {
    unorm_encode(f.x, bits) | (unorm_encode(f.y, bits) << bits)
}

/// The half nearest to `x`.
#[inline(always)]
fn half(x: f32) -> u32 {
    if is_nan(x) { 0 } else { half_encode(x) }
}

#[inline(always)]
fn snorm_pair<const BITS: u32>(code: u32) -> Vec2 {
    Vec2::new(snorm::<BITS>(code, 0), snorm::<BITS>(code, BITS))
}

#[inline(always)]
fn pair_code(x: f32, y: f32, bits: u32) -> u32 {
    snorm_encode(x, bits) | (snorm_encode(y, bits) << bits)
}

#[inline(always)]
fn sint_pair(code: u32, bits: u32) -> IVec2 {
    IVec2::new(signed_integer_field(code, 0, bits), signed_integer_field(code, bits, bits))
}

#[inline(always)]
fn sint_code(i: IVec2, bits: u32) -> u32 {
    let most = mask(bits - 1) as i32;
    let field = |i: i32| i.max(-most - 1).min(most) as u32 & mask(bits);
    field(i.x) | (field(i.y) << bits)
}

/// Declares the functions of formats: from a code to values, and from values to the code.
macro_rules! formats {
    ($(
        $format:literal $($with_fourth:literal)?:
        $to_values:ident($code:ident: $Code:ty) = $values_of:expr,
        $to_code:ident($values:ident: $Values:ty) = $code_of:expr;
    )*) => { $(
        #[must_use]
        #[doc = concat!("Converts a code to the values to write to ", $format $(, ", or in the first three components of ", $with_fourth)?, ".")]
        #[inline(always)]
        pub fn $to_values($code: $Code) -> $Values {
            $values_of
        }

        #[must_use]
        #[doc = concat!("Converts values read from ", $format, " to the code.")]
        #[inline(always)]
        pub fn $to_code($values: $Values) -> $Code {
            $code_of
        }
    )* };
}

formats! {
    "VK_FORMAT_R8G8_SNORM":
        code_to_snorm8x2(code: u32) = snorm_pair::<8>(code),
        snorm8x2_to_code(f: Vec2) = pair_code(f.x, f.y, 8);
    "VK_FORMAT_R16G16_SNORM":
        code_to_snorm16x2(code: u32) = snorm_pair::<16>(code),
        snorm16x2_to_code(f: Vec2) = pair_code(f.x, f.y, 16);
    "VK_FORMAT_R8G8B8_SNORM" "VK_FORMAT_R8G8B8A8_SNORM":
        code_to_snorm8x3(code: u32) = snorm_pair::<8>(code).extend(snorm::<8>(code, 16)),
        snorm8x3_to_code(f: Vec3) = pair_code(f.x, f.y, 8) | (snorm_encode(f.z, 8) << 16);
    "the first three components of VK_FORMAT_A2B10G10R10_SNORM_PACK32":
        code_to_snorm10x3(code: u32) = snorm_pair::<10>(code).extend(snorm::<10>(code, 20)),
        snorm10x3_to_code(f: Vec3) = pair_code(f.x, f.y, 10) | (snorm_encode(f.z, 10) << 20);
    "VK_FORMAT_R16G16B16_SNORM" "VK_FORMAT_R16G16B16A16_SNORM":
        code_to_snorm16x3(code: [u32; 2]) = snorm_pair::<16>(code[0]).extend(snorm::<16>(code[1], 0)),
        snorm16x3_to_code(f: Vec3) = [pair_code(f.x, f.y, 16), snorm_encode(f.z, 16)];
    "VK_FORMAT_R8G8B8_UNORM" "VK_FORMAT_R8G8B8A8_UNORM":
        code_to_unorm8x3(code: u32) = Vec3::new(unorm8(code, 0), unorm8(code, 8), unorm8(code, 16)),
        unorm8x3_to_code(f: Vec3) =
            unorm_encode(f.x, 8) | (unorm_encode(f.y, 8) << 8) | (unorm_encode(f.z, 8) << 16);
    "VK_FORMAT_R8G8_UNORM":
        code_to_unorm8x2(code: u32) = Vec2::new(unorm8(code, 0), unorm8(code, 8)),
        unorm8x2_to_code(f: Vec2) = unorm_code(f, 8);
    "the first two components of VK_FORMAT_A2B10G10R10_UNORM_PACK32":
        code_to_unorm10x2(code: u32) = Vec2::new(unorm::<11>(code, 0), unorm::<11>(code, 10)),
        unorm10x2_to_code(f: Vec2) = unorm_code(f, 10);
    "VK_FORMAT_R16G16_UNORM":
        code_to_unorm16x2(code: u32) = Vec2::new(unorm::<17>(code, 0), unorm::<17>(code, 16)),
        unorm16x2_to_code(f: Vec2) = unorm_code(f, 16);
    "VK_FORMAT_R8G8_SINT":
        code_to_sint8x2(code: u32) = sint_pair(code, 8),
        sint8x2_to_code(i: IVec2) = sint_code(i, 8);
    "VK_FORMAT_R16G16_SINT":
        code_to_sint16x2(code: u32) = sint_pair(code, 16),
        sint16x2_to_code(i: IVec2) = sint_code(i, 16);
    "VK_FORMAT_R16G16_SFLOAT":
        code_to_float16x2(code: u32) = Vec2::new(half_decode(code), half_decode(code >> 16)),
        float16x2_to_code(f: Vec2) = half(f.x) | (half(f.y) << 16);
    "VK_FORMAT_R16G16B16_SFLOAT" "VK_FORMAT_R16G16B16A16_SFLOAT":
        code_to_float16x3(code: [u32; 2]) =
            Vec3::new(half_decode(code[0]), half_decode(code[0] >> 16), half_decode(code[1])),
        float16x3_to_code(f: Vec3) = [half(f.x) | (half(f.y) << 16), half(f.z)];
}
