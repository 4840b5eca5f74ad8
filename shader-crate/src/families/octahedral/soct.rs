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
//! * Error: that of [`hemioct`](crate::hemioct) with a bit less, at most `sqrt(3/2) / m` radians (m the snorm's largest
//!   integer). The bit divides [`oct`](crate::oct)'s maximum by `sqrt(3)`, where a bit more usually gains `sqrt(2)`.
//! * The six axes round-trip exactly. A direction mirrored at a coordinate plane, or with x and y swapped, gets the
//!   mirrored vector, exactly.
//! * Good for: formats with a bit to spare beside two snorms, such as packed vertices or G-buffers. Decoding needs no
//!   fold, and no component jumps within a hemisphere. Weakness: stored alone, a code wastes most of its last byte.
//! * Each direction of the equator has two codes, one with either sign; both decode to z = 0. Encoding gives z = 0 the
//!   sign 0, and a small negative z that rounds to 0 the sign 1.

use super::hemioct::{error_bound, position};
use crate::arith::{
    SIGN_BIT, flip_sign, is_negative, is_set, max, nearest_pair, normalize_octahedral, snorm_clamp,
    snorm_integers, snorm_max,
};
use crate::codec::{Codec, RawCode, Width};
use crate::direction::{is_usable, l1_norm};
use core::marker::PhantomData;
use glam::{Vec2, Vec3};

/// The direction of a point of `[-m, m]^2` and the sign, in bit 31: unit length to within 2 ULP.
///
/// z is the difference of two numbers that both have the sign: 0 has none then.
#[inline(always)]
pub(crate) fn from_lattice(e: Vec2, sign_bit: u32, m: f32) -> Vec3 {
    let below = sign_bit & SIGN_BIT;
    let across = 2.0 * max(e.x.abs(), e.y.abs());
    let z = flip_sign(2.0 * m, below) - flip_sign(across, below);
    normalize_octahedral(Vec3::new(e.x + e.y, e.x - e.y, z), m, m + 1.0)
}

/// The code, of `bits` bits, of the direction of `v`, of an L1 norm of `norm`, whose u and v are packed in `uv`. The code of
/// +Z where `v` has no direction.
#[inline(always)]
pub(crate) fn code<C: RawCode>(v: Vec3, norm: f32, uv: u32, bits: u32) -> C {
    let sign = |bit: u32| if is_negative(v.z) { 1 << bit } else { 0 };
    let (low, high) = if bits <= 32 { (uv | sign(bits - 1), 0) } else { (uv, sign(0)) };
    let usable = is_usable(norm);
    C::from_low_high(if usable { low } else { 0 }, if usable { high } else { 0 })
}

/// The sign of a code of `bits` bits, in bit 31.
#[inline(always)]
pub(crate) fn sign_bit([low, high]: [u32; 2], bits: u32) -> u32 {
    if bits <= 32 { low << (32 - bits) } else { high << 31 }
}

/// The unquantised projection of the direction of `v`: u and v on \[-1, 1\], for an SNORM format, and 1 for z < 0,
/// else 0. (0, 0, 0), which is +Z, where `v` has no direction.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec3 {
    let norm = l1_norm(v);
    let e = position(v, norm, 1.0).extend(if is_negative(v.z) { 1.0 } else { 0.0 });
    if is_usable(norm) { e } else { Vec3::ZERO }
}

/// The direction of u and v, clamped to \[-1, 1\], below the equator where the third is 1/2 or more. +-Z where u or v is
/// NaN.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec3) -> Vec3 {
    let sign_bit = if is_set(e.z) { SIGN_BIT } else { 0 };
    from_lattice(snorm_clamp(Vec2::new(e.x, e.y)), sign_bit, 1.0)
}

unorm_projection!(<>);

/// Signed octahedral code of `BITS` bits (17 or 25; 33 with codes of two words).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SOct<const BITS: u32, C = u32>(PhantomData<C>);

impl<const BITS: u32, C: RawCode> Codec for SOct<BITS, C>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(BITS);
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = C;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> C {
        let norm = l1_norm(v);
        code(v, norm, nearest_pair(position(v, norm, snorm_max(BITS / 2)), BITS / 2), BITS)
    }

    #[inline(always)]
    fn decode_vec3(code: C) -> Vec3 {
        let words = code.to_words();
        from_lattice(snorm_integers(words[0], BITS / 2), sign_bit(words, BITS), snorm_max(BITS / 2))
    }
}
