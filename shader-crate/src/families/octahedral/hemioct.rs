//! Hemi-octahedral codes: the hemisphere z >= 0 on the upper half of an octahedron, turned to fill the square.
//!
//! Source: Cigolle et al. 2014, section 5, listing 6.
//!
//! The half octahedron's diamond, rotated by 45 degrees and scaled, is the whole square `[-1, 1]^2`: twice the points
//! of [`oct`](crate::oct) for half the sphere.
//!
//! <!-- generated: errors hemioct -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `hemioct16` | 0.240 | 0.553 | 0.553 |
//! | `hemioct16p` | 0.239 | 0.552 | 0.553 |
//! | `hemioct24` | 0.0149 | 0.0343 | 0.0343 |
//! | `hemioct24p` | 0.0148 | 0.0343 | 0.0343 |
//! | `hemioct32` | 0.000930 | 0.00215 | 0.00218 |
//! | `hemioct32p` | 0.000926 | 0.00214 | 0.00218 |
//! <!-- end -->
//!
//! * Layout: u = x + y in the low half of the code, v = x - y in the high half, both snorm in two's complement.
//! * Error: at most `sqrt(3/2) / m` radians (m the snorm's largest integer), in the middle of the octants. There cells are
//!   rectangles, of which rounding finds the nearest corner: the precise encoder lowers the mean alone.
//! * Domain: z >= 0. A direction below the equator gets the code of its horizontal part, (x, y, 0); one without a
//!   horizontal part, -Z, gets that of +Z.
//! * Good for: tangent-space normal maps. The map is continuous, and bends where x or y is 0.

use super::nearest::Corner;
use crate::arith::{
    SnormDivision, dot, floor, max, nearest_pair, normalize_octahedral, over, ratio, snorm_clamp,
    snorm_integers, snorm_max,
};
use crate::codec::{Codec, Width};
use crate::direction::{MAX_NORM, MIN_NORM};
use glam::{Vec2, Vec3};

/// The place of `v` on the square `[-m, m]^2` (listing 6); `norm` is the L1 norm of (x, y, |z|).
#[inline(always)]
pub(crate) fn position(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let scale = over(m, norm);
    Vec2::new((v.x + v.y) * scale, (v.x - v.y) * scale)
}

/// The L1 norms of `v`, and of `v` moved up to the equator if below it.
#[inline(always)]
pub(crate) fn norms(v: Vec3) -> (f32, f32) {
    let across = v.x.abs() + v.y.abs();
    (across + v.z.abs(), across + max(v.z, 0.0))
}

/// True where both norms give a direction: `whole`, not the smaller one, is not too large, `upper` not too small. The
/// comparisons are of integers, since a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
pub(crate) fn is_usable(whole: f32, upper: f32) -> bool {
    whole.to_bits() < MAX_NORM.to_bits() && upper.to_bits() >= MIN_NORM.to_bits()
}

/// The direction of a lattice point (listing 6): unit length to within 2 ULP, z >= 0, since `|x| + |y|` is twice the
/// larger of `|e.x|` and `|e.y|`. All steps before the normalisation are exact for lattice points; with `m` = 1 it takes
/// snorm values instead.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let (x, y) = (e.x + e.y, e.x - e.y);
    normalize_octahedral(Vec3::new(x, y, 2.0 * (m - max(e.x.abs(), e.y.abs()))), m, m + 1.0)
}

/// Listing 6: the projection of the direction of `v`, unquantised, on \[-1, 1\]<sup>2</sup>: for an SNORM format, to which
/// the hardware rounds. (0, 0), which is +Z, where `v` has no direction above the equator or on it.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec2 {
    let (whole, upper) = norms(v);
    let e = position(v, upper, 1.0);
    if is_usable(whole, upper) { e } else { Vec2::ZERO }
}

/// Listing 6: the direction of a point of \[-1, 1\]<sup>2</sup>. Points beyond it are clamped; a point with NaN is
/// +Z's.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec2) -> Vec3 {
    from_lattice(snorm_clamp(e), 1.0)
}

unorm_projection!();

/// The lattice point that is nearest in angle to `v`, which has a z of at least 0 and the L1 norm `norm`: of the four corners
/// of its cell. At an octant's middle cells are rectangles, whose nearest corner rounding finds; elsewhere they are askew.
#[inline(always)]
fn precise_point(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let e = position(v, norm, m);
    let scale = over(2.0 * m, norm);
    let p = Vec3::new(v.x * scale, v.y * scale, v.z * scale);
    let (x, y, length) = (floor(e.x), floor(e.y), dot(p, p));
    let near = corner(x, y, p, m, length);
    let right = corner(x + 1.0, y, p, m, length);
    let up = corner(x, y + 1.0, p, m, length);
    let far = corner(x + 1.0, y + 1.0, p, m, length);
    near.or_nearer(right).or_nearer(up).or_nearer(far).at
}

/// The corner (u, v) of a cell, as `p` sees it, of an L1 norm of `2 m`. Beyond the square's border z is below 0, and the corner
/// farther than another.
#[inline(always)]
fn corner(u: f32, v: f32, p: Vec3, m: f32, length: f32) -> Corner {
    let z = 2.0 * (m - max(u.abs(), v.abs()));
    let d = Vec3::new((u + v) - p.x, (u - v) - p.y, z - p.z);
    Corner::beside(Vec2::new(u, v), dot(d, d), dot(d, p), length)
}

/// The precise point of any `v`; (0, 0), which is +Z, where it has no direction above the equator or on it.
#[inline(always)]
fn lattice_precise(v: Vec3, m: f32) -> Vec2 {
    let (whole, upper) = norms(v);
    let e = precise_point(Vec3::new(v.x, v.y, max(v.z, 0.0)), upper, m);
    if is_usable(whole, upper) { e } else { Vec2::ZERO }
}

/// The precise code of `BITS` bits (16, 24 or 32) as values of an SNORM format of half as many bits, which stores them
/// exactly.
#[must_use]
#[inline(always)]
pub fn project_precise<const BITS: u32>(v: Vec3) -> Vec2
where
    HemiOct<BITS>: Width,
{
    let (e, by_m) = (lattice_precise(v, snorm_max(BITS / 2)), const { SnormDivision::new(BITS / 2) });
    Vec2::new(by_m.of(e.x), by_m.of(e.y))
}

/// `sqrt(3/2) / m` radians in degrees, and the error of rounding the position in f32 (at most 2^-21 of the square's
/// half side). The snorms have half of `bits`, rounded down.
pub(super) const fn error_bound(bits: u32) -> f32 {
    (1.224_744_9 * (ratio(1.0, snorm_max(bits / 2)) + 1.0 / 2_097_152.0)).to_degrees()
}

/// Hemi-octahedral code of `BITS` bits (16, 24 or 32) for directions with z >= 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct HemiOct<const BITS: u32>;

impl<const BITS: u32> Codec for HemiOct<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The bound for directions with z >= 0.
    const MAX_ERROR_DEG: f32 = error_bound(BITS);
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let (whole, upper) = norms(v);
        let code = nearest_pair(position(v, upper, snorm_max(BITS / 2)), BITS / 2);
        if is_usable(whole, upper) { code } else { 0 }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        from_lattice(snorm_integers(code, BITS / 2), snorm_max(BITS / 2))
    }
}

/// Hemi-octahedral code of `BITS` bits (16, 24 or 32), precise encoder: the format of [`HemiOct`], the nearest codes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct HemiOctPrecise<const BITS: u32>;

impl<const BITS: u32> Codec for HemiOctPrecise<BITS>
where
    HemiOct<BITS>: Width,
{
    const BITS: u32 = BITS;
    /// The bound of [`HemiOct`]: it is attained at the octants' middles, where rounding finds the nearest code.
    const MAX_ERROR_DEG: f32 = error_bound(BITS);
    const NULL: Option<[u32; 2]> = HemiOct::<BITS>::NULL;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        nearest_pair(lattice_precise(v, snorm_max(BITS / 2)), BITS / 2)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        HemiOct::<BITS>::decode_vec3(code)
    }
}
