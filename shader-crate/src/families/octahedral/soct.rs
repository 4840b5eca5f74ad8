//! Signed octahedral codes: [`hemioct`](crate::hemioct)'s square for each hemisphere, and a bit to say which.
//!
//! Source: White 2017, "Signed Octahedron Normal Encoding" (the format); Cigolle et al. 2014, section 5, listing 6
//! (hemi-oct).
//!
//! [`oct`](crate::oct) keeps the sign of z by folding the lower half out over the square's corners. Here a bit says it,
//! and each hemisphere has the whole square to itself.
//!
//! <!-- generated: errors soct -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `soct17` | 0.240 | 0.553 | 0.553 |
//! | `soct25` | 0.0149 | 0.0343 | 0.0343 |
//! | `soct33` | 0.000930 | 0.00215 | 0.00218 |
//! <!-- end -->
//!
//! * Layout: u = x + y in the low bits, v = x - y above it, both snorm of half of `BITS - 1` bits in two's complement;
//!   in the highest bit 1 for z < 0. 33 bits take two words, with the sign in bit 0 of the higher one.
//! * Error: that of [`hemioct`](crate::hemioct) with a bit less, at most `sqrt(3/2) / m` radians
//!   (m the snorm's largest integer). The bit divides [`oct`](crate::oct)'s maximum by
//!   `sqrt(3)`, where a bit more usually gains `sqrt(2)`.
//! * The six axes round-trip exactly. A direction mirrored at a coordinate plane, or with x and y swapped, gets the
//!   mirrored vector, exactly.
//! * Good for: formats with a bit to spare beside two snorms, such as packed vertices or G-buffers. Decoding needs no
//!   fold, and no component jumps within a hemisphere. Weakness: stored alone, a code wastes most of its last byte.
//! * Each direction of the equator has two codes, one with either sign; both decode to z = 0. Encoding gives z = 0 the
//!   sign 0, and a small negative z that rounds to 0 the sign 1.

use super::hemioct::{error_bound, position};
use crate::arith::{
    SIGN_BIT, biased, is_negative, is_set, max, nearest_pair, normalize, snorm_clamp, snorm_integers,
    snorm_max, unbiased, with_sign,
};
use crate::codec::Codec;
use crate::direction::{is_usable, l1_norm};
use glam::{Vec2, Vec3};

/// The code of u and v, of `bits` bits each, of the direction of `v` of this L1 norm.
#[inline(always)]
fn pair(v: Vec3, norm: f32, bits: u32) -> u32 {
    nearest_pair(position(v, norm, snorm_max(bits)), bits)
}

/// The direction of a point of `[-m, m]^2` and the sign, in bit 31: unit length to within 2 ULP.
///
/// z is the difference of two numbers that both have the sign: 0 has none then.
#[inline(always)]
pub(crate) fn from_lattice(e: Vec2, sign_bit: u32, m: f32) -> Vec3 {
    let below = f32::from_bits(sign_bit & SIGN_BIT);
    let across = 2.0 * max(e.x.abs(), e.y.abs());
    let z = with_sign(2.0 * m, below) - with_sign(across, below);
    normalize(Vec3::new(e.x + e.y, e.x - e.y, z))
}

/// [`from_lattice`] of the code of u and v, of `bits` bits each.
#[inline(always)]
fn from_parts(code: u32, sign_bit: u32, bits: u32) -> Vec3 {
    from_lattice(snorm_integers(code, bits), sign_bit, snorm_max(bits))
}

/// The unquantised projection of the direction of `v`: u and v on \[-1, 1\], for an SNORM format, and 1 for z < 0,
/// else 0. (0, 0, 0), which is +Z, where `v` has no direction.
#[inline(always)]
pub fn project(v: Vec3) -> Vec3 {
    let norm = l1_norm(v);
    let e = position(v, norm, 1.0).extend(if is_negative(v.z) { 1.0 } else { 0.0 });
    if is_usable(norm) { e } else { Vec3::ZERO }
}

/// The direction of u and v, clamped to \[-1, 1\], below the equator where the third is 1/2 or more. +-Z where u or v is
/// NaN.
#[inline(always)]
pub fn unproject(e: Vec3) -> Vec3 {
    let sign_bit = if is_set(e.z) { SIGN_BIT } else { 0 };
    from_lattice(snorm_clamp(Vec2::new(e.x, e.y)), sign_bit, 1.0)
}

/// [`project`] with u and v on \[0, 1\], for a UNORM format such as VK_FORMAT_A2B10G10R10_UNORM_PACK32, with the
/// hemisphere in alpha.
#[inline(always)]
pub fn project_unorm(v: Vec3) -> Vec3 {
    let e = project(v);
    biased(Vec2::new(e.x, e.y)).extend(e.z)
}

/// [`unproject`] for a point whose u and v are on \[0, 1\], as a UNORM format gives it.
#[inline(always)]
pub fn unproject_unorm(e: Vec3) -> Vec3 {
    unproject(unbiased(Vec2::new(e.x, e.y)).extend(e.z))
}

/// Signed octahedral code of `BITS` bits (17 or 25).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SOct<const BITS: u32>;

impl<const BITS: u32> Codec for SOct<BITS> {
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(BITS);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let norm = l1_norm(v);
        let code = pair(v, norm, BITS / 2) | if is_negative(v.z) { 1 << (BITS - 1) } else { 0 };
        if is_usable(norm) { code } else { 0 }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        from_parts(code, code << (32 - BITS), BITS / 2)
    }
}

/// Signed octahedral code of 33 bits: two snorm16, and the sign of z in a second word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SOct33;

impl Codec for SOct33 {
    const BITS: u32 = 33;
    const MAX_ERROR_DEG: f32 = error_bound(33);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let norm = l1_norm(v);
        let code = [pair(v, norm, 16), if is_negative(v.z) { 1 } else { 0 }];
        if is_usable(norm) { code } else { [0, 0] }
    }

    #[inline(always)]
    fn decode_vec3([low, high]: [u32; 2]) -> Vec3 {
        from_parts(low, high << 31, 16)
    }
}
