//! Cylindrical coordinates: the angle about z, and z itself.
//!
//! Source: the pair `(atan2(y, x) / pi, z)` of K. Narkowicz's article on octahedron normals, there called spherical
//! coordinates. By Archimedes the cylinder around the sphere has its area, so that all codes stand for equal areas.
//!
//! <!-- generated: errors cylindrical -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `cylindrical16` | 0.374 | 5.09 | 5.09 |
//! | `cylindrical24` | 0.0230 | 1.27 | 1.27 |
//! | `cylindrical32` | 0.00144 | 0.317 | 0.319 |
//! <!-- end -->
//!
//! * Layout: phi / pi in the low half of the code, z in the high half, both snorm in two's complement: a
//!   VK_FORMAT_R8G8_SNORM at 16 bits, a VK_FORMAT_R16G16_SNORM at 32. phi = -pi and pi are two codes of one angle.
//! * Error, with m the snorm's largest integer: at most `acos(1 - 1 / 2m)`, about `sqrt(1/m)` radians, for directions
//!   half a step of z from a pole. Elsewhere half the diagonal of a cell, about `sqrt((pi r / 2m)^2 + (1 / 2mr)^2)`
//!   with r the distance from the axis.
//! * +X, -X, +Z and -Z round-trip exactly. +-Y do not, since a quarter turn is half a step off the odd snorm's
//!   integers. Every angle at z = +-1 is the pole, exactly; encoding writes 0 there.
//! * Good for: horizontal directions, and where z itself must be to hand, as one snorm of the code. Encoding takes one
//!   arc tangent, decoding one sine and cosine. Weakness: the poles, where a step of z turns the direction by its
//!   square root. Eight more bits divide the error there by 4, elsewhere by 16.

use super::{around_z, azimuth, scaled};
use crate::arith::{
    dot, inverse_root, max, min, nearest_code, ratio, root, snorm_clamp, snorm_integer, snorm_max, with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::{Vec2, Vec3};

/// The z of the direction of `v`, which an inexact reciprocal may take beyond 1, and its azimuth in quarter turns.
#[inline(always)]
fn height_and_azimuth(v: Vec3) -> (f32, f32) {
    let norm = l1_norm(v);
    let p = scaled(v, norm);
    let height = with_sign(p.z * inverse_root(dot(p, p)), v.z);
    (if is_usable(norm) { height } else { 1.0 }, azimuth(v, p))
}

/// The snorm integers of phi / pi and z that are nearest to the direction of `v`, before rounding. `m` is the snorm's
/// largest integer.
#[inline(always)]
pub fn lattice(v: Vec3, m: f32) -> Vec2 {
    let (height, quarters) = height_and_azimuth(v);
    // An inexact reciprocal could take z beyond m.
    let z = max(min(height * m, m), -m);
    let phi = quarters * (0.5 * m);
    Vec2::new(if z.abs() > m - 0.5 { 0.0 } else { phi }, z)
}

/// The direction of a pair of snorm integers: unit length to within 2 ULP. `m^2 - z^2` has both factors exact, and
/// the product of `1 / m` and m is 1 exactly.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let step = ratio(1.0, m);
    let radius = root((m - e.y) * (m + e.y)) * step;
    around_z(radius, e.y * step, if radius > 0.0 { e.x * (2.0 * step) } else { 0.0 })
}

/// The unquantised `phi / pi` and z of the direction of `v`, both on \[-1, 1\]: for an SNORM format, to which the
/// hardware rounds. (0, 1), which is +Z, where `v` has no direction.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec2 {
    let (height, quarters) = height_and_azimuth(v);
    let z = max(min(height, 1.0), -1.0);
    Vec2::new(if z.abs() < 1.0 { 0.5 * quarters } else { 0.0 }, z)
}

/// The direction of `phi / pi` and z, clamped to \[-1, 1\]; (0, 0), which is +X, where one is NaN.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec2) -> Vec3 {
    from_lattice(snorm_clamp(e), 1.0)
}

unorm_projection!();

/// Cylindrical coordinates in `BITS` bits (16, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cylindrical<const BITS: u32>;

impl<const BITS: u32> Codec for Cylindrical<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const EXACT_AXES: bool = false;
    /// `acos(1 - 1 / 2m)`, and the error of rounding z in `f32`, at most 2^-22: the error goes with the square root of
    /// the distance from the pole, so its relative growth is half that of the half step `1 / 2m`.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 5.0859,
        24 => 1.2665,
        32 => 0.316_53,
        _ => panic!("no constants for this width"),
    } * (1.0 + snorm_max(BITS / 2) * (1.0 / 4_194_304.0));
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let e = lattice(v, snorm_max(BITS / 2));
        nearest_code(e.x, BITS / 2) | (nearest_code(e.y, BITS / 2) << (BITS / 2))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let phi = snorm_integer(code, BITS / 2);
        let z = snorm_integer(code >> (BITS / 2), BITS / 2);
        from_lattice(Vec2::new(phi, z), snorm_max(BITS / 2))
    }
}
