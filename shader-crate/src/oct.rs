//! Octahedral codes: the sphere on an octahedron, unfolded into a square.
//!
//! Source: Meyer et al. 2010, section 5; Cigolle et al. 2014, sections 2 and 3, listings 1 to 5.
//!
//! The L1 norm maps a direction to the octahedron `|x| + |y| + |z| = 1`; seen along z, the half `z >= 0` fills the
//! square's central diamond and the half `z < 0` is folded out over its four edges. Both coordinates are stored as
//! snorm. Scaled by `m`, the snorm's largest integer, the codes are the whole points of the square `[-m, m]^2`: the
//! lattice that the functions here speak of.
//!
//! * Layout: x in the low half of the code, y in the high half, both in two's complement. The exception is 24
//!   bits, whose three bytes are those of listing 5: see [`snorm12x2_to_unorm8x3`].
//! * Error: at most `3 / (sqrt(2) m)` radians (Meyer eq. 10), at most `sqrt(2) / m` with the precise encoder
//!   (eq. 11), both largest in the middle of the octants.
//! * The six axes round-trip exactly. Points of the square's border stand for the same direction as their mirror
//!   image along that edge; the four corners are all -Z.

use crate::codec::Codec;
use crate::direction::or_z;
use crate::math::{dot, floor, is_negative, negate_if, normalize};
use crate::scalar::{mask, signed_code, snorm_integer, snorm_max};
use glam::{Vec2, Vec3};

/// The lattice point of the direction of `v` (listing 1, then snorm rounding): the nearest one in the square.
///
/// Rounds in the positive octant, where all signs are equal, so that mirrored directions get mirrored codes.
#[inline(always)]
pub fn lattice(v: Vec3, m: f32) -> Vec2 {
    let (v, norm) = or_z(v);
    let scale = m / norm;
    let (x, y) = (v.x.abs() * scale, v.y.abs() * scale);
    let (x, y) = fold(v.z, x, y, m);
    Vec2::new(negate_if(is_negative(v.x), floor(x + 0.5)), negate_if(is_negative(v.y), floor(y + 0.5)))
}

/// The lattice point of the direction of `v` that is nearest in angle: of the four corners of its cell, as in
/// listing 3, which the nearest of all points is among.
#[inline(always)]
pub fn lattice_precise(v: Vec3, m: f32) -> Vec2 {
    let (v, norm) = or_z(v);
    let nearest = nearest_corner(v.abs() * (m / norm), m);
    let (x, y) = fold(v.z, nearest.x, nearest.y, m);
    Vec2::new(negate_if(is_negative(v.x), x), negate_if(is_negative(v.y), y))
}

/// The direction of a lattice point (listing 2, in Stubbe's branch-light form): unit length to within 2 ULP.
///
/// All steps before the normalisation are exact for lattice points; with `m` = 1 it takes snorm values instead.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let z = m - e.x.abs() - e.y.abs();
    let below = if z < 0.0 { -z } else { 0.0 };
    let x = e.x + negate_if(e.x >= 0.0, below);
    let y = e.y + negate_if(e.y >= 0.0, below);
    normalize(Vec3::new(x, y, z))
}

/// Moves a point of the positive octant, scaled to `x + y + z = m`, to where the lower half of the octahedron is
/// folded out if `z` is negative.
#[inline(always)]
pub(crate) fn fold(z: f32, x: f32, y: f32, m: f32) -> (f32, f32) {
    if is_negative(z) { (m - y, m - x) } else { (x, y) }
}

/// The corner of the lattice cell around `p` that is nearest to it in angle, for `p` in the positive octant with
/// `x + y + z = m`.
///
/// A corner `p + d` is off by the angle of `tan^2 = |d x p|^2 / ((p + d) . p)^2`, and `|d x p|^2` is
/// `(d . d)(p . p) - (d . p)^2`. From corner to corner `d` changes by (1, 0, -1) and (0, 1, -1), `d . d` and
/// `d . p` with it. Any `p` on the ray will do, so the rounding of the scale does not matter.
///
/// The lattice goes on past the octant's edge z = 0, but the octahedron does not: the far corner of a cell that
/// this edge cuts is no candidate. Beyond it lies the mirror image of the near corner, which is never nearer.
#[inline(always)]
fn nearest_corner(p: Vec3, m: f32) -> Vec2 {
    let i = floor(p.x);
    let j = floor(p.y);
    let k = m - i - j;
    let d = Vec3::new(i - p.x, j - p.y, k - p.z);

    let pp = dot(p, p);
    let (step_x, step_y) = (p.x - p.z, p.y - p.z);
    let (dd, dp) = (dot(d, d), dot(d, p));
    let dd_x = dd + 2.0 * (d.x - d.z) + 2.0;
    let dd_y = dd + 2.0 * (d.y - d.z) + 2.0;
    let dd_xy = dd_x + dd_y - dd + 2.0;

    let near = Candidate::new(i, j, pp, dd, dp);
    let right = Candidate::new(i + 1.0, j, pp, dd_x, dp + step_x);
    let up = Candidate::new(i, j + 1.0, pp, dd_y, dp + step_y);
    let far = Candidate::new(i + 1.0, j + 1.0, pp, dd_xy, dp + step_x + step_y);

    let best = near.or_nearer(right).or_nearer(up);
    let best = if k < 2.0 { best } else { best.or_nearer(far) };
    Vec2::new(best.x, best.y)
}

/// A lattice point and the squared tangent of its angle to `p`, as a fraction.
#[derive(Clone, Copy)]
struct Candidate {
    x: f32,
    y: f32,
    numerator: f32,
    denominator: f32,
}

impl Candidate {
    #[inline(always)]
    fn new(x: f32, y: f32, pp: f32, dd: f32, dp: f32) -> Self {
        let along = pp + dp;
        Self { x, y, numerator: dd * pp - dp * dp, denominator: along * along }
    }

    /// `other` where it is nearer to `p`, else `self`.
    #[inline(always)]
    fn or_nearer(self, other: Self) -> Self {
        if other.numerator * self.denominator < self.numerator * other.denominator { other } else { self }
    }
}

/// Packs a lattice point of the 24-bit format (`m` = 2047) into three bytes, the first in the low bits.
///
/// The bytes are those of listing 5, for an RGB8 texture: with `u = x + 2047` and `v = y + 2047` of 12 bits each,
/// `u >> 4`, `(u & 15) << 4 | v >> 8` and `v & 255`.
#[inline(always)]
pub fn snorm12x2_to_unorm8x3(e: Vec2) -> u32 {
    let u = signed_code(e.x + 2047.0, 12);
    let v = signed_code(e.y + 2047.0, 12);
    (u >> 4) | ((u & 15) << 12) | (v & 0xf00) | ((v & 255) << 16)
}

/// The lattice point of three bytes as [`snorm12x2_to_unorm8x3`] packs them. The pattern 4095 of a component, which
/// encoding never writes, counts as 4094 (+1).
#[inline(always)]
pub fn unorm8x3_to_snorm12x2(code: u32) -> Vec2 {
    let u = ((code & 255) << 4) | ((code >> 12) & 15);
    let v = (code & 0xf00) | ((code >> 16) & 255);
    let (x, y) = (u as f32 - 2047.0, v as f32 - 2047.0);
    Vec2::new(if x > 2047.0 { 2047.0 } else { x }, if y > 2047.0 { 2047.0 } else { y })
}

/// The code of a lattice point.
#[inline(always)]
pub(crate) fn pack<const BITS: u32>(e: Vec2) -> u32 {
    if BITS == 24 {
        return snorm12x2_to_unorm8x3(e);
    }
    signed_code(e.x, BITS / 2) | (signed_code(e.y, BITS / 2) << (BITS / 2))
}

/// The lattice point of a code.
#[inline(always)]
pub(crate) fn unpack<const BITS: u32>(code: u32) -> Vec2 {
    if BITS == 24 {
        return unorm8x3_to_snorm12x2(code);
    }
    Vec2::new(snorm_integer(code & mask(BITS / 2), BITS / 2), snorm_integer(code >> (BITS / 2), BITS / 2))
}

/// `radians_times_m` at this width in degrees, and what the rounding of the position in f32 (at most 2^-21 of the
/// square's half side) adds.
const fn error_bound(radians_times_m: f32, bits: u32) -> f32 {
    (radians_times_m * (1.0 / snorm_max(bits / 2) + 1.0 / 2_097_152.0)).to_degrees()
}

/// Octahedral code of `BITS` bits (16, 20, 22, 24 or 32), fast encoder.
pub struct Oct<const BITS: u32>;

impl<const BITS: u32> Codec for Oct<BITS> {
    const NAME: &'static str = match BITS {
        16 => "oct16",
        20 => "oct20",
        22 => "oct22",
        24 => "oct24",
        32 => "oct32",
        _ => panic!("Oct has 16, 20, 22, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(3.0 * core::f32::consts::FRAC_1_SQRT_2, BITS);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        pack::<BITS>(lattice(v, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        from_lattice(unpack::<BITS>(code), snorm_max(BITS / 2))
    }
}

/// Octahedral code of `BITS` bits (16, 20, 22, 24 or 32), precise encoder: the format of [`Oct`], a third less
/// error at most.
pub struct OctPrecise<const BITS: u32>;

impl<const BITS: u32> Codec for OctPrecise<BITS> {
    const NAME: &'static str = match BITS {
        16 => "oct16p",
        20 => "oct20p",
        22 => "oct22p",
        24 => "oct24p",
        32 => "oct32p",
        _ => panic!("OctPrecise has 16, 20, 22, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(core::f32::consts::SQRT_2, BITS);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        pack::<BITS>(lattice_precise(v, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        Oct::<BITS>::decode(code)
    }
}

/// 16 bits, fast: a VK_FORMAT_R8G8_SNORM.
pub type Oct16 = Oct<16>;
/// 20 bits, fast: two snorm10.
pub type Oct20 = Oct<20>;
/// 22 bits, fast: two snorm11.
pub type Oct22 = Oct<22>;
/// 24 bits, fast: three bytes, VK_FORMAT_R8G8B8_UNORM.
pub type Oct24 = Oct<24>;
/// 32 bits, fast: a VK_FORMAT_R16G16_SNORM.
pub type Oct32 = Oct<32>;
/// 16 bits, precise: a VK_FORMAT_R8G8_SNORM.
pub type OctPrecise16 = OctPrecise<16>;
/// 20 bits, precise: two snorm10.
pub type OctPrecise20 = OctPrecise<20>;
/// 22 bits, precise: two snorm11.
pub type OctPrecise22 = OctPrecise<22>;
/// 24 bits, precise: three bytes, VK_FORMAT_R8G8B8_UNORM.
pub type OctPrecise24 = OctPrecise<24>;
/// 32 bits, precise: a VK_FORMAT_R16G16_SNORM.
pub type OctPrecise32 = OctPrecise<32>;
