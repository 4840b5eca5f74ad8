//! Octahedral codes: the sphere on an octahedron, unfolded into a square.
//!
//! Source: Meyer et al. 2010, section 5; Cigolle et al. 2014, sections 2 and 3, listings 1 to 5. Eq. 9 of Meyer et al.,
//! as printed, gives x the sign of v and y that of u in the lower half, which tears the map where these differ. This is
//! listing 1.
//!
//! The L1 norm maps a direction to the octahedron `|x| + |y| + |z| = 1`. Seen along z, the half `z >= 0` fills the
//! square's central diamond, and the half `z < 0` is folded out over the diamond's four edges. Both coordinates are
//! stored as snorm. Scaled by `m`, the snorm's largest integer, the codes are the whole points of the square
//! `[-m, m]^2`: the lattice that the functions here speak of.
//!
//! <!-- generated: errors oct -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `oct8` | 6.09 | 17.2 | 17.4 |
//! | `oct8p` | 5.67 | 11.4 | 11.6 |
//! | `oct12` | 1.38 | 3.92 | 3.92 |
//! | `oct12p` | 1.29 | 2.61 | 2.61 |
//! | `oct16` | 0.337 | 0.957 | 0.957 |
//! | `oct16p` | 0.315 | 0.638 | 0.638 |
//! | `oct18` | 0.168 | 0.477 | 0.477 |
//! | `oct18p` | 0.157 | 0.318 | 0.318 |
//! | `oct20` | 0.0837 | 0.238 | 0.238 |
//! | `oct20p` | 0.0782 | 0.159 | 0.159 |
//! | `oct22` | 0.0418 | 0.119 | 0.119 |
//! | `oct22p` | 0.0391 | 0.0792 | 0.0792 |
//! | `oct24` | 0.0209 | 0.0594 | 0.0594 |
//! | `oct24p` | 0.0195 | 0.0396 | 0.0396 |
//! | `oct32` | 0.00131 | 0.00373 | 0.00377 |
//! | `oct32p` | 0.00122 | 0.00247 | 0.00251 |
//! <!-- end -->
//!
//! * Layout: x in the low half of the code, y in the high half, both in two's complement. The exception is 24 bits,
//!   whose three bytes are those of listing 5: see [`snorm12x2_to_uint8x3`].
//! * Error: at most `3 / (sqrt(2) m)` radians (Meyer eq. 10), with the precise encoder at most `sqrt(2) / m` (eq. 11).
//!   Both are greatest in the middle of the octants.
//! * The six axes round-trip exactly. Points of the square's border stand for the same direction as their mirror image
//!   along that edge. The four corners are all -Z.
//! * Good for: almost anything. Weakness: codes jump where x or y is 0 and z < 0, so that components cannot be
//!   filtered there, and bend at `z = 0`.

use super::nearest::Corner;
use super::{fold, unpack, usable_code};
use crate::arith::{
    SnormDivision, TWO_23, exp2, floor, is_nan, max, min, normalize_octahedral, over, quotient, ratio,
    snorm_clamp, snorm_max, unorm_max, whole_to_u32, with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::{UVec3, Vec2, Vec3};

/// The position of `v`, of the L1 norm `norm`, on the square `[-m, m]^2`, not rounded (listing 1); `m` is the largest
/// integer of an snorm, or 1. Unspecified without a usable direction.
///
/// Below the equator x is folded to `m - |y| s`, with `s = m / norm`. Since `norm` is `|x| + |y| + |z|`, that is
/// `(|x| + |z|) s`. Signs are those of the bits: a component of -0 gives, below the equator, the mirrored point of the
/// square's border, which stands for the same direction.
#[inline(always)]
pub fn position(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let scale = over(m, norm);
    let below = max(-v.z, 0.0);
    Vec2::new(with_sign((v.x.abs() + below) * scale, v.x), with_sign((v.y.abs() + below) * scale, v.y))
}

/// The lattice point that is nearest in angle to the direction of `v`, of the L1 norm `norm`: the nearest of the four
/// corners of its cell, as in listing 3. The nearest of all points is among these.
#[inline(always)]
fn precise_point(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let p = v.abs() * over(m, norm);
    let p = if m < WIDE { p } else { at_least(p, m * LEAST_PART) };
    let nearest = if m < FEW { searched_corner(p, m) } else { nearest_corner(p, m) };
    let (x, y) = fold(v.z, nearest.x, nearest.y, m);
    Vec2::new(with_sign(x, v.x), with_sign(y, v.y))
}

/// The components, raised to `least` where they are less: denormals, which some devices flush, would else break ties by
/// their effect in [`projected`].
#[inline(always)]
fn at_least(p: Vec3, least: f32) -> Vec3 {
    Vec3::new(max(p.x, least), max(p.y, least), max(p.z, least))
}

/// The lattice point that is nearest in angle to the direction of `v`; (0, 0), which is +Z, where it has none.
#[inline(always)]
pub fn lattice_precise(v: Vec3, m: f32) -> Vec2 {
    let norm = l1_norm(v);
    let e = precise_point(v, norm, m);
    if is_usable(norm) { e } else { Vec2::ZERO }
}

/// The direction of a lattice point (listing 2, in Stubbe's branch-light form): unit length to within 2 ULP.
///
/// All steps before the normalisation are exact for lattice points; with `m` = 1 it takes snorm values instead.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let z = m - e.x.abs() - e.y.abs();
    let below = max(-z, 0.0);
    let (x, y) = (e.x - with_sign(below, e.x), e.y - with_sign(below, e.y));
    normalize_octahedral(Vec3::new(x, y, z), m, 0.5 * (m + 1.0))
}

/// Listing 1: the octahedral projection of the direction of `v`, unquantised, on \[-1, 1\]<sup>2</sup>: for an SNORM format,
/// to which the hardware rounds. (0, 0), which is +Z, where `v` has no direction.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec2 {
    let norm = l1_norm(v);
    let e = position(v, norm, 1.0);
    if is_usable(norm) { e } else { Vec2::ZERO }
}

/// Listing 2: the direction of a point of \[-1, 1\]<sup>2</sup>. Points beyond it are clamped; a point with NaN is
/// +Z's.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec2) -> Vec3 {
    from_lattice(snorm_clamp(e), 1.0)
}

unorm_projection!();

/// Listing 3: the precise code of `BITS` bits (even, 4 to 32) as values of an SNORM format of half as many bits, which stores
/// them exactly.
#[must_use]
#[inline(always)]
pub fn project_precise<const BITS: u32>(v: Vec3) -> Vec2
where
    Oct<BITS>: Width,
{
    let (e, by_m) = (lattice_precise(v, snorm_max(BITS / 2)), const { SnormDivision::new(BITS / 2) });
    Vec2::new(by_m.of(e.x), by_m.of(e.y))
}

/// A pair of snorm values of half of `BITS` bits, as [`project_precise`] gives them, on \[0, 1\] for a UNORM format of as many
/// bits, whose values from 0 to `2^b - 2` stand for them: exact axes at a step a part of `2^(1-b)` longer than that of
/// [`uoct`](crate::uoct). Values between are rounded, those beyond \[-1, 1\] clamped, a pair with NaN is +Z's.
#[must_use]
#[inline(always)]
pub fn to_unorm<const BITS: u32>(e: Vec2) -> Vec2
where
    Oct<BITS>: Width,
{
    let (m, by_most) = (snorm_max(BITS / 2), const { SnormDivision::new(BITS / 2 + 1) });
    let e = snorm_clamp(e);
    Vec2::new(by_most.of(floor(e.x * m + (m + 0.5))), by_most.of(floor(e.y * m + (m + 0.5))))
}

/// The inverse of [`to_unorm`], for values from a fetch.
#[must_use]
#[inline(always)]
pub fn from_unorm<const BITS: u32>(u: Vec2) -> Vec2
where
    Oct<BITS>: Width,
{
    let (m, most, by_m) = (snorm_max(BITS / 2), unorm_max(BITS / 2), const { SnormDivision::new(BITS / 2) });
    let value = |u: f32| by_m.of(min(floor(min(max(u, 0.0), 1.0) * most + 0.5) - m, m));
    let e = Vec2::new(value(u.x), value(u.y));
    if is_nan(u.x.abs() + u.y.abs()) { Vec2::ZERO } else { e }
}

/// The three bytes of a pair of snorm12 values, whole numbers. Ties go up.
#[inline(always)]
fn bytes(f: Vec2) -> Vec3 {
    let f = snorm_clamp(f);
    let (u, v) = (floor(f.x * 2047.0 + 2047.5), floor(f.y * 2047.0 + 2047.5));
    let (high, carry) = (floor(u * (1.0 / 16.0)), floor(v * (1.0 / 256.0)));
    Vec3::new(high, (u - high * 16.0) * 16.0 + carry, v - carry * 256.0)
}

/// The inverse of [`bytes`], for whole numbers up to 255.
#[inline(always)]
fn from_bytes(bytes: Vec3) -> Vec2 {
    let high = floor(bytes.y * (1.0 / 16.0));
    let (u, v) = (bytes.x * 16.0 + high, (bytes.y - high * 16.0) * 256.0 + bytes.z);
    const BY_2047: SnormDivision = SnormDivision::new(12);
    Vec2::new(min(BY_2047.of(u - 2047.0), 1.0), min(BY_2047.of(v - 2047.0), 1.0))
}

/// Listing 5: a pair of snorm12 values on \[-1, 1\] as three unorm8 values, for a UNORM format: those of (0, 0) where
/// one is NaN.
#[inline(always)]
pub fn snorm12x2_to_unorm8x3(f: Vec2) -> Vec3 {
    const BY_255: SnormDivision = SnormDivision::new(9);
    let bytes = bytes(f);
    Vec3::new(BY_255.of(bytes.x), BY_255.of(bytes.y), BY_255.of(bytes.z))
}

/// Listing 5: the inverse, for unorm8 values from a fetch.
#[inline(always)]
pub fn unorm8x3_to_snorm12x2(u: Vec3) -> Vec2 {
    let byte = |x: f32| floor(min(max(x, 0.0), 1.0) * 255.0 + 0.5);
    let f = from_bytes(Vec3::new(byte(u.x), byte(u.y), byte(u.z)));
    if is_nan(l1_norm(u)) { Vec2::ZERO } else { f }
}

/// Listing 5 for an integer format: the three bytes of [`snorm12x2_to_unorm8x3`].
#[inline(always)]
pub fn snorm12x2_to_uint8x3(f: Vec2) -> UVec3 {
    let bytes = bytes(f);
    UVec3::new(whole_to_u32(bytes.x), whole_to_u32(bytes.y), whole_to_u32(bytes.z))
}

/// The inverse of [`snorm12x2_to_uint8x3`]. Numbers above 255 count as 255.
#[inline(always)]
pub fn uint8x3_to_snorm12x2(u: UVec3) -> Vec2 {
    from_bytes(Vec3::new(u.x.min(255) as f32, u.y.min(255) as f32, u.z.min(255) as f32))
}

/// The corner of the lattice cell around `p` that is nearest to it in angle, for `p` in the positive octant with
/// `x + y + z = m`.
///
/// A point c of the octahedron is off by the angle of `tan^2 = |c x p|^2 / (c . p)^2`. With `X = 3 p.x / m - 1`, `Y`
/// likewise, 0 in the octant's middle, and `d = c - p` seen along z, `3 / m^2 |c x p|^2` is
///
/// ```text
/// N(d) = (2 + Y^2) dx^2 + 2 (1 - X Y) dx dy + (2 + X^2) dy^2
/// ```
///
/// The middle term is never negative, and no angle of the triangle right, up and near (the corners at (i + 1, j),
/// (i, j + 1), (i, j)), or right, up and far, is obtuse. So only three of the comparisons count. With q = `p` as seen
/// from the cell's middle, `A = (2 + Y^2) q.x + (1 - X Y) q.y`, `B = (1 - X Y) q.x + (2 + X^2) q.y` and
/// `H = (1 - X Y) / 2`, right is nearer than up where `A > B`. If so, right is nearer than near where
/// `A > -H`, and far nearer than right where `B > H`; if not, far is nearer than up where `A > H`, and up nearer than
/// near where `B > -H`.
///
/// The lattice goes on past the octant's edge z = 0, and the octahedron does not: where this edge cuts a cell, the far
/// corner is not a point of the octahedron. It never comes out as the nearest one.
#[inline(always)]
fn nearest_corner(p: Vec3, m: f32) -> Vec2 {
    let middle = Vec2::new(floor(p.x) + 0.5, floor(p.y) + 0.5);
    let q = Vec2::new(p.x - middle.x, p.y - middle.y);
    let at = Vec2::new(p.x * ratio(3.0, m) - 1.0, p.y * ratio(3.0, m) - 1.0);
    let weighs = m < SMALL;
    let q = if !weighs && m < LARGE { approached(q, at, m) } else { q };
    let q = if m < WIDE { q } else { projected(q, p, middle, m) };

    // A and B, with their common part taken out.
    let turn = at.y * q.x - at.x * q.y;
    let sum = q.x + q.y;
    let a = (q.x + sum) + at.y * turn;
    let b = (q.y + sum) - at.x * turn;
    let cross = 1.0 - at.x * at.y;
    let (a, b) = if weighs { weighed(a, b, cross, q, at, m) } else { (a, b) };

    let half = 0.5 * cross;
    let right_before_up = a >= b;
    let least_b = if right_before_up { half } else { -half };
    let x = middle.x + if a > -least_b { 0.5 } else { -0.5 };
    let y = middle.y + if b > least_b { 0.5 } else { -0.5 };
    Vec2::new(x, y)
}

/// The corner (x, y) of a lattice cell, as `p` sees it. One beyond the edge z = 0 is none of the octant's, and farther than
/// any.
#[inline(always)]
fn corner(x: f32, y: f32, p: Vec3, m: f32) -> Corner {
    let z = m - x - y;
    let a = y * p.z - z * p.y;
    let b = z * p.x - x * p.z;
    let c = x * p.y - y * p.x;
    let (across, along) = ((a * a + b * b) + c * c, (x * p.x + y * p.y) + z * p.z);
    Corner { at: Vec2::new(x, y), across, along: if z < 0.0 { 0.0 } else { along * along } }
}

/// [`nearest_corner`] for any `m`: the best of the four corners, as listing 3 finds it.
#[inline(always)]
fn searched_corner(p: Vec3, m: f32) -> Vec2 {
    let (x, y) = (floor(p.x), floor(p.y));
    let near = corner(x, y, p, m);
    let right = corner(x + 1.0, y, p, m);
    let up = corner(x, y + 1.0, p, m);
    let far = corner(x + 1.0, y + 1.0, p, m);
    near.or_nearer(right).or_nearer(up).or_nearer(far).at
}

/// Squares of fewer steps than this (up to 12 bits) are so coarse that [`weighed`] no longer finds the nearest corner.
const FEW: f32 = 63.0;

/// 2^-26, the part of the largest denormal in the shortest usable vector.
const LEAST_PART: f32 = exp2(-26);

/// Squares of fewer steps than this (14 to 18 bits) take [`weighed`], others (20 to 24 bits) [`approached`].
const SMALL: f32 = 256.0;

/// In squares of this many steps and more (32 bits) the denominators change less than the rounding of `p` does.
const LARGE: f32 = 4096.0;

/// Squares of this many steps and more (beyond 32 bits) are [`projected`]. In others the rounding of the scale is at
/// most 2^-7 of a step.
const WIDE: f32 = 65536.0;

/// `q` at the point where the ray of `p` hits the plane `x + y + z = m`.
#[inline(always)]
fn projected(q: Vec2, p: Vec3, middle: Vec2, m: f32) -> Vec2 {
    let missing = (((m - middle.x) - middle.y) - p.z) - (q.x + q.y);
    let stretch = missing * ratio(1.0, m);
    Vec2::new(q.x + stretch * p.x, q.y + stretch * p.y)
}

/// A and B with the denominators `(c . p)^2` taken into account.
///
/// From corner to corner `c . p` changes by `e . p`, a part `3 / m (e . (X, Y, Z)) / S` of itself, where `Z = -X - Y`,
/// `S = 3 + X^2 + Y^2 + Z^2`, and e = (1, 0, -1) to the right. To first order in 1 / m that moves the line where two
/// corners tie as if q were `q + u (X, Y)`, with `u = 3 / m N / S` and the corners' N there: A becomes
/// `A + u (2 X + Y)`, B likewise. The terms left out are 2^-14 of a step at 16 bits. N, where near or far ties with
/// another or right with up:
///
/// ```text
/// A q.x + B q.y + (2 + Z^2) / 4 - max(|A + B| - 2 H, 0)
/// ```
#[inline(always)]
fn weighed(a: f32, b: f32, cross: f32, q: Vec2, at: Vec2, m: f32) -> (f32, f32) {
    let minus_z = at.x + at.y;
    let z_squared = minus_z * minus_z;
    let over = max((a + b).abs() - cross, 0.0);
    let n = ((a * q.x + b * q.y) + (0.25 * z_squared + 0.5)) - over;
    let half_s = z_squared + (0.5 + cross);
    let u = n * quotient(ratio(1.5, m), half_s);
    (a + u * (at.x + minus_z), b + u * (at.y + minus_z))
}

/// `q` with the denominators taken into account for the most part: [`weighed`] with 0.1265 in place of `N / S`.
///
/// `N / S` is 1/12 to 1/6 in the octant's corners, where (X, Y) is largest. The constant leaves at most 0.2 / m of a
/// step: 4e-4, 2e-4 and 1e-4 at 20, 22 and 24 bits.
#[inline(always)]
fn approached(q: Vec2, at: Vec2, m: f32) -> Vec2 {
    Vec2::new(q.x + at.x * ratio(0.3795, m), q.y + at.y * ratio(0.3795, m))
}

/// 2^23 + 2047: the low 12 bits of its sum with x from -2047 to 2047 are x + 2047, rounded to the nearest.
const BIAS: f32 = TWO_23 + 2047.0;

/// Packs the lattice point nearest to `e` in the 24-bit format (`m` = 2047) into three bytes, the first in the low bits.
///
/// The bytes are those of listing 5, which takes them for an RGB8 texture: with `u = x + 2047` and `v = y + 2047` of 12 bits each,
/// `u >> 4`, `(u & 15) << 4 | v >> 8` and `v & 255`. That is u and v in 24 bits, the highest byte first.
#[inline(always)]
pub(super) fn pack_bytes(e: Vec2) -> u32 {
    let both = ((e.x + BIAS).to_bits() << 12).wrapping_add((e.y + BIAS).to_bits());
    ((both >> 16) & 255) | (both & 0xff00) | ((both & 255) << 16)
}

/// The lattice point of three bytes as [`pack_bytes`] packs them. The pattern 4095 of a component, which
/// encoding never writes, counts as 4094 (+1).
#[inline(always)]
pub(super) fn unpack_bytes(code: u32) -> Vec2 {
    let both = ((code & 255) << 16) | (code & 0xff00) | ((code >> 16) & 255);
    let (u, v) = ((both >> 12) | TWO_23.to_bits(), (both & 0xfff) | TWO_23.to_bits());
    Vec2::new(min(f32::from_bits(u) - BIAS, 2047.0), min(f32::from_bits(v) - BIAS, 2047.0))
}

/// `radians_times_m` at this width in degrees, and the error of rounding the position in f32 (at most 2^-21 of the
/// square's half side).
const fn error_bound(radians_times_m: f32, bits: u32) -> f32 {
    (radians_times_m * (ratio(1.0, snorm_max(bits / 2)) + 1.0 / 2_097_152.0)).to_degrees()
}

/// Widths that are not in the list.
macro_rules! widths {
    ($($bits:literal)*) => { $(impl Width for Oct<$bits> {})* };
}

widths!(4 6 10 14 26 28 30);

/// Octahedral code of `BITS` bits (even, 4 to 32), fast encoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Oct<const BITS: u32>;

impl<const BITS: u32> Codec for Oct<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(3.0 * core::f32::consts::FRAC_1_SQRT_2, BITS);
    const NULL: Option<[u32; 2]> = Some([if BITS == 24 { 0xff_ffff } else { 1 << (BITS / 2 - 1) }, 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let norm = l1_norm(v);
        usable_code::<BITS>(norm, position(v, norm, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        from_lattice(unpack::<BITS>(code), snorm_max(BITS / 2))
    }
}

/// Octahedral code of `BITS` bits (even, 4 to 32), precise encoder: the format of [`Oct`], a third less error at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OctPrecise<const BITS: u32>;

impl<const BITS: u32> Codec for OctPrecise<BITS>
where
    Oct<BITS>: Width,
{
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(core::f32::consts::SQRT_2, BITS);
    const NULL: Option<[u32; 2]> = Oct::<BITS>::NULL;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let norm = l1_norm(v);
        usable_code::<BITS>(norm, precise_point(v, norm, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        Oct::<BITS>::decode_vec3(code)
    }
}
