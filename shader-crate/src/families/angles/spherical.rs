//! Spherical coordinates: the angle from +Z and the angle about it.
//!
//! Source: Cigolle et al. 2014, section 2, "spherical": theta in \[0, pi\] and phi in \[-pi, pi\], each mapped to \[-1,
//! 1\] and stored as a signed integer.
//!
//! With b half the code's bits and m the snorm's largest integer, `2^(b-1) - 1`, a code holds
//! `i = round((2 theta / pi - 1) m)`, the snorm of theta's range, and `j = round(phi / pi 2^(b-1))`. Phi is periodic:
//! its `2^b` steps go once around, so that -pi and pi are one code and a quarter turn is a whole number of steps. An
//! snorm there would spend two codes on the same angle and miss +-Y by half a step.
//!
//! <!-- generated: errors spherical -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `spherical16` | 0.355 | 0.787 | 0.787 |
//! | `spherical20` | 0.0885 | 0.197 | 0.197 |
//! | `spherical22` | 0.0442 | 0.0983 | 0.0985 |
//! | `spherical24` | 0.0221 | 0.0491 | 0.0493 |
//! | `spherical32` | 0.00138 | 0.00308 | 0.00312 |
//! <!-- end -->
//!
//! * Layout: i in the low half of the code, j in the high half, both in two's complement: the integers of a
//!   VK_FORMAT_R8G8_SINT at 16 bits, of a VK_FORMAT_R16G16_SINT at 32. -m is +Z, m is -Z; the pattern -m - 1 counts as
//!   -m.
//! * Error: half the diagonal of a cell at the equator, at most `sqrt((pi / 4m)^2 + (pi / 2^b)^2)` radians. The
//!   survey's 32-bit maximum comes from `f32` trigonometry near the poles; the functions of [`arith`](crate::arith) are
//!   exact enough to stay at the cells' own.
//! * The six axes round-trip exactly. Every j at theta 0 or pi is the pole, exactly; encoding writes j = 0 there.
//! * Good for: directions that are angles already, and cheap decoding in hardware that has sines. Weaknesses: codes
//!   crowd at the poles, cells at the equator are twice as wide as they are high, and two arc tangents to encode and
//!   two sines with their cosines to decode cost several times as much as [`oct`](crate::oct).

use super::{around_z, azimuth, quarter, scaled};
use crate::arith::{
    exp2, from_diagonal, horizontal_length, nearest_code, negate_if, ratio, signed_integer, snorm_clamp,
    snorm_integer, snorm_max, with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::{Vec2, Vec3};

/// The latitude and the azimuth of the direction of `v` in quarter turns.
#[inline(always)]
fn angles(v: Vec3) -> (f32, f32) {
    let norm = l1_norm(v);
    let p = scaled(v, norm);
    let latitude = with_sign(quarter(p.z, horizontal_length(p)), v.z);
    (if is_usable(norm) { latitude } else { 1.0 }, azimuth(v, p))
}

/// The i and j that are nearest to the direction of `v`, before rounding. `m` is the largest i, `half_turn` the j of pi.
///
/// i is taken from the latitude, by which directions mirrored at the equator get mirrored codes.
#[inline(always)]
pub fn lattice(v: Vec3, m: f32, half_turn: f32) -> Vec2 {
    let (latitude, quarters) = angles(v);
    let i = latitude * -m;
    let j = quarters * (0.5 * half_turn);
    // Half a step from a pole, i rounds to the even integer, which is not the pole's.
    Vec2::new(i, if i.abs() > m - 0.5 { 0.0 } else { j })
}

/// The direction of the integers i and j: unit length to within 2 ULP.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32, half_turn: f32) -> Vec3 {
    // The product of m is 1 exactly.
    let latitude = e.x.abs() * ratio(1.0, m);
    let meridian = from_diagonal(latitude - 0.5);
    let z = negate_if(e.x > 0.0, meridian.x + meridian.y);
    let quarters = if latitude < 1.0 { e.y * ratio(2.0, half_turn) } else { 0.0 };
    around_z(meridian.x - meridian.y, z, quarters)
}

/// The unquantised `2 theta / pi - 1` and `phi / pi` of the direction of `v`, both on \[-1, 1\]. (-1, 0), which is +Z,
/// where `v` has no direction. An SNORM format that stores them holds another code than this family's, whose phi has a
/// step more.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec2 {
    let (latitude, quarters) = angles(v);
    Vec2::new(-latitude, if latitude.abs() < 1.0 { 0.5 * quarters } else { 0.0 })
}

/// An angle of theta that is less differs from the equator by less than `from_lattice` rounds, and counts as 0: else a
/// zero of z could get a sign.
const LEAST_LATITUDE: f32 = exp2(-26);

/// The direction of `2 theta / pi - 1` and `phi / pi`, clamped to \[-1, 1\]; (0, 0), which is +X, where one is NaN.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec2) -> Vec3 {
    let e = snorm_clamp(e);
    from_lattice(Vec2::new(if e.x.abs() > LEAST_LATITUDE { e.x } else { 0.0 }, e.y), 1.0, 1.0)
}

unorm_projection!();

/// The j of half a turn: 2^(b-1).
const fn half_turn(bits: u32) -> f32 {
    (1 << (bits / 2 - 1)) as f32
}

/// Spherical coordinates in `BITS` bits (16, 20, 22, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Spherical<const BITS: u32>;

impl<const BITS: u32> Codec for Spherical<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// Half a step of phi times `sqrt(1 + (half_turn / 2m)^2)`, which is greatest at 16 bits, and the errors of
    /// rounding both angles and the decoded vector: at most 8e-7 radians.
    const MAX_ERROR_DEG: f32 = ratio(1.1199 * 90.0, half_turn(BITS)) + 4.6e-5;
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let e = lattice(v, snorm_max(BITS / 2), half_turn(BITS));
        nearest_code(e.x, BITS / 2) | (nearest_code(e.y, BITS / 2) << (BITS / 2))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let i = snorm_integer(code, BITS / 2);
        let j = signed_integer(code >> (BITS / 2), BITS / 2);
        from_lattice(Vec2::new(i, j), snorm_max(BITS / 2), half_turn(BITS))
    }
}
