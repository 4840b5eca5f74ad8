//! Equal-area octahedral codes: the lattice of [`oct`](crate::oct), with cells of equal area on the sphere.
//!
//! Source: Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD" (the map). The encoders are ours.
//!
//! In the octant of positive components, `r = sqrt(1 - z)` and `phi = 2/pi atan2(y, x)`, both 0 to 1, give the point
//! (r - r phi, r phi) of the triangle `u + v <= 1`. Signs and the fold of the half `z < 0` are [`oct`](crate::oct)'s.
//! Back, `r = u + v`, `phi = v / r`, `z = 1 - r^2`, and (x, y) has the length `r sqrt(2 - r^2)`. Near a pole `1 - z`
//! cancels; for a vector of length l, r is `sqrt((x^2 + y^2) / (l (l + z)))`.
//!
//! With m the snorm's largest integer, a lattice point lies on ring `s = m r`, a circle of latitude: 0 is the pole and
//! m the equator. On its ring it is the point j of 0 to s, at `phi = j / s`. So an octant's lattice is made of rings of
//! points at equal distances. In r and phi, unlike u and v, the sphere's metric is diagonal: with `c^2 = 2 - r^2`, it
//! is `4 dr^2 / c^2 + (pi/2)^2 r^2 c^2 dphi^2`. Hence both encoders choose a ring, then the nearest point of that ring:
//!
//! * The fast one takes the nearest ring. Rounding u and v costs the same and has a larger error, and a bias to one
//!   side at an octant's edge.
//! * The precise one tries the rings on either side. The nearest of all points is on one of them: along a ring the next
//!   point is at most `pi/4 c / m` away, and with half a ring that is no more than the `2 / (c m)` to a third ring. The
//!   result is that of a search of the cell's four corners. Two points are compared by their chord: see
//!   [`lattice_precise`].
//!
//! <!-- generated: errors eaoct -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `eaoct16` | 0.309 | 0.678 | 0.678 |
//! | `eaoct16p` | 0.306 | 0.584 | 0.594 |
//! | `eaoct20` | 0.0769 | 0.168 | 0.169 |
//! | `eaoct20p` | 0.0761 | 0.147 | 0.148 |
//! | `eaoct22` | 0.0384 | 0.0841 | 0.0842 |
//! | `eaoct22p` | 0.0380 | 0.0734 | 0.0738 |
//! | `eaoct24` | 0.0192 | 0.0421 | 0.0421 |
//! | `eaoct24p` | 0.0190 | 0.0367 | 0.0369 |
//! | `eaoct32` | 0.00120 | 0.00263 | 0.00272 |
//! | `eaoct32p` | 0.00119 | 0.00229 | 0.00239 |
//! <!-- end -->
//!
//! * Layout: x in the low half of the code, y in the high half, both snorm in two's complement; at 24 bits the three
//!   bytes of [`oct::snorm12x2_to_uint8x3`](crate::oct::snorm12x2_to_uint8x3).
//! * Error: with the fast encoder at most `1.5026 / m` radians, half a ring and half a step away from ring 1; with the
//!   precise one at most `sqrt(1/2 + pi^2 / 8) / m = 1.3168 / m`, half the diagonal of a cell near a pole and a plane y
//!   = 0. Such places are rare: random directions seldom hit them.
//! * The six axes round-trip exactly. Points of the square's border stand for the same direction as their mirror image
//!   along that edge. The four corners are all -Z. A direction mirrored at a coordinate plane decodes to the mirrored
//!   vector, exactly; so does one with x and y swapped, where they differ.
//! * Good for: less error than [`oct`](crate::oct) in the same format of two snorms, and directions that are averaged,
//!   sampled or counted, since all cells have the same area. Weaknesses: codes jump and bend where those of
//!   [`oct`](crate::oct) do. Encoding takes an arc tangent, decoding a sine and a cosine.
//!
//! No two-float arithmetic is needed: r has an error of at most `8 2^-24`, phi of `4 2^-24`. At 32 bits the position is
//! good to 2^-6 of a step, and mostly to 2^-9.

use super::{unpack, usable_code};
use crate::arith::{
    SnormDivision, atan_quarter, cos_eighth, exp2, floor, is_negative, max, min, negate_positive, quotient,
    ratio, root, scale_to_one, signed_quotient, sin_eighth, snorm_clamp, snorm_max, with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::{Vec2, Vec3};

/// The least that x and y count as, beside an L1 norm of 1 to 2: 2^-26, which moves a direction by less than 2^-10 of a
/// step. So nothing is divided by 0, and no denormal counts, since some devices flush them: scaled, they are all less.
const LEAST: f32 = exp2(-26);

/// A direction of the positive octant, mirrored so that `phi` is at most 1/2.
#[derive(Clone, Copy)]
pub(crate) struct Polar {
    /// `r`, 0 to 1 and perhaps an ULP.
    pub(crate) radius: f32,
    /// `phi`, 0 to 1/2.
    pub(crate) turn: f32,
    /// True where x and y were swapped.
    pub(crate) swapped: bool,
}

/// A lattice point of a [`Polar`]'s half octant: on ring `ring`, the one of number `place`. And a measure of its chord.
#[derive(Clone, Copy)]
struct Candidate {
    ring: f32,
    place: f32,
    cost: f32,
}

/// `r` and `phi` of the direction of `v`, of an L1 norm of `norm`. Unspecified without a usable direction.
///
/// With `v` scaled by a power of two, exactly, to an L1 norm of 1 to 2, squares neither overflow nor vanish where they
/// count. With a the longer and b the shorter of x and y, one division would serve for both `(a^2 + b^2) / (l (l + z))`
/// and `b / a`, but takes five products more, which all wait for each other: a fifth more time on lavapipe.
#[inline(always)]
pub(crate) fn polar(v: Vec3, norm: f32) -> Polar {
    let p = v.abs() * scale_to_one(norm);
    let (x, y) = (max(p.x, LEAST), max(p.y, LEAST));
    let (a, b) = (max(x, y), min(x, y));

    let horizontal = a * a + b * b;
    let length = root(horizontal + p.z * p.z);
    let radius = root(quotient(horizontal, length * (length + p.z)));
    Polar { radius, turn: atan_quarter(quotient(b, a)), swapped: y > x }
}

/// Moves a lattice point of [`polar`]'s half octant to the half octant of the direction of `v`. With m the largest
/// coordinate, (x, y) is folded out to (m - y, m - x), which is as far away along both axes.
#[inline(always)]
pub(crate) fn unfolded(v: Vec3, swapped: bool, ring: f32, place: f32, m: f32) -> Vec2 {
    let (x, y) = if swapped { (place, ring - place) } else { (ring - place, place) };
    let folded = if is_negative(v.z) { m - ring } else { 0.0 };
    Vec2::new(with_sign(x + folded, v.x), with_sign(y + folded, v.y))
}

/// The lattice point of the direction of `v`, of an L1 norm of `norm`: on the nearest ring the nearest point.
/// Unspecified without a usable direction.
#[inline(always)]
pub fn lattice(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let p = polar(v, norm);
    let ring = floor(p.radius * m + 0.5);
    let place = floor(p.turn * ring + 0.5);
    unfolded(v, p.swapped, ring, place, m)
}

/// Clarberg's projection of the direction of `v`, unquantised, on \[-1, 1\]<sup>2</sup>: for an SNORM format, to which the
/// hardware rounds. Its codes have a mean error 8 % and a maximum 43 % above those of [`lattice`]. (0, 0), which is +Z, where
/// `v` has no direction.
#[must_use]
#[inline(always)]
pub fn project(v: Vec3) -> Vec2 {
    let norm = l1_norm(v);
    let p = polar(v, norm);
    let e = unfolded(v, p.swapped, p.radius, p.radius * p.turn, 1.0);
    if is_usable(norm) { e } else { Vec2::ZERO }
}

/// The direction of a point of \[-1, 1\]<sup>2</sup>. Points beyond it are clamped; a point with NaN is +Z's.
#[must_use]
#[inline(always)]
pub fn unproject(e: Vec2) -> Vec3 {
    from_lattice(snorm_clamp(e), 1.0)
}

unorm_projection!();

/// The precise code of `BITS` bits, those of [`EaOct`], as values of an SNORM format of half as many bits, which stores them
/// exactly.
#[must_use]
#[inline(always)]
pub fn project_precise<const BITS: u32>(v: Vec3) -> Vec2
where
    EaOct<BITS>: Width,
{
    let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
    let (e, by_m) = (lattice_precise(v, norm, m), const { SnormDivision::new(BITS / 2) });
    let e = Vec2::new(by_m.of(e.x), by_m.of(e.y));
    if is_usable(norm) { e } else { Vec2::ZERO }
}

/// The lattice point of the direction of `v`, of an L1 norm of `norm`, that is nearest in angle: the nearest one of the
/// ring below or above. Unspecified without a usable direction.
///
/// The chord between points at r and phi and at R and `phi - q` has the square `(r C - R c)^2 + 4 r R c C sin^2(pi q /
/// 4)`, with `C^2 = 2 - R^2`. With `d = R - r` and `k = r / c^2`, `C` is `c (1 - k d)` and the first summand
/// `4 d^2 / c^2 (1 + k d)`, both but for a part of `d^2`: at most 6e-5 at 16 bits. Times `c^4 m^2 / 4` and with radii in
/// steps of `1/m` that is a sum without cancellation, and without divisions but those in q.
#[inline(always)]
pub fn lattice_precise(v: Vec3, norm: f32, m: f32) -> Vec2 {
    let p = polar(v, norm);
    let below = floor(p.radius * m);
    let inner = candidate(p, below, m);
    let outer = candidate(p, below + 1.0, m);
    let nearest = if outer.cost < inner.cost { outer } else { inner };
    unfolded(v, p.swapped, nearest.ring, nearest.place, m)
}

/// The nearest point on a ring that is at most a step from `p`.
///
/// `sin^2 a` is `a^2 - a^4 / 3`, to 0.1 % on ring 1 and much better on others. On ring 0, which is one point, q does
/// not count. Ring m + 1, beyond the equator, never costs less than ring m.
#[inline(always)]
fn candidate(p: Polar, ring: f32, m: f32) -> Candidate {
    const PI_2_16: f32 = 0.616_850_26;
    const PI_2_16_TIMES_PI_2_48: f32 = 0.126_834_75;
    let steps = p.radius * m;
    let along = p.turn * ring;
    let place = floor(along + 0.5);
    let across = ring - steps;
    let q = signed_quotient(along - place, max(ring, 1.0));

    let c_squared = 2.0 - p.radius * p.radius;
    let change = across * (p.radius * ratio(1.0, m));
    let turned = (steps * ring) * (q * q) * (PI_2_16 - PI_2_16_TIMES_PI_2_48 * (q * q));
    let cost =
        across * across * (c_squared + change) + turned * ((c_squared * c_squared) * (c_squared - change));
    Candidate { ring, place, cost }
}

/// The direction of a lattice point: unit length to within 2 ULP.
///
/// The rings' numbers are exact, and so are the poles and the equator; the length does not depend on the rounding of r,
/// since z and the distance from the axis are of the same one. With `m` = 1 it takes snorm values instead.
#[inline(always)]
pub fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let at = ring_of(e, m);
    from_ring(e, at, quotient(at.place, max(at.ring, f32::MIN_POSITIVE)), m)
}

/// The place of a lattice point: number `place` on ring `ring`, mirrored so that this is at most half of `ring`.
#[derive(Clone, Copy)]
pub(crate) struct Ring {
    pub(crate) ring: f32,
    pub(crate) place: f32,
    /// True where x and y were swapped.
    pub(crate) swapped: bool,
    /// Negative below the equator.
    pub(crate) above: f32,
}

/// The ring of a lattice point.
#[inline(always)]
pub(crate) fn ring_of(e: Vec2, m: f32) -> Ring {
    let (x, y) = (e.x.abs(), e.y.abs());
    let sum = x + y;
    let above = m - sum;
    let ring = min(sum, 2.0 * m - sum);
    Ring { ring, place: min(min(x, y), m - max(x, y)), swapped: y > x, above }
}

/// The direction at `phi` = `turn`, 0 to 1/2, on a ring, with the signs of `e`.
#[inline(always)]
pub(crate) fn from_ring(e: Vec2, Ring { ring, swapped, above, .. }: Ring, turn: f32, m: f32) -> Vec3 {
    let (sine, cosine) = (sin_eighth(0.5 * turn), cos_eighth(0.5 * turn));
    let radius = ring * ratio(1.0, m);
    let z = (1.0 - radius) * (1.0 + radius);
    let horizontal = radius * root(1.0 + z);
    let (near, far) = (horizontal * cosine, horizontal * sine);
    let (x, y) = if swapped { (far, near) } else { (near, far) };
    Vec3::new(negate_positive(e.x < 0.0, x), negate_positive(e.y < 0.0, y), with_sign(z, above))
}

/// `radians_times_m` at this width in degrees, and the error of rounding in f32: at most `8 2^-24` in r, which is
/// `16 2^-24` radians at the equator, `4 2^-24` in phi, 3/2 as much in radians, and 2^-22 for the decoded vector.
const fn error_bound(radians_times_m: f32, bits: u32) -> f32 {
    (ratio(radians_times_m, snorm_max(bits / 2)) + 26.0 / 16_777_216.0).to_degrees()
}

/// Equal-area octahedral code of `BITS` bits (16, 20, 22, 24 or 32), fast encoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EaOct<const BITS: u32>;

impl<const BITS: u32> Codec for EaOct<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// Half a ring out from ring s, midway between two of its points, the nearest one is
    /// `sqrt(1/4 + 4 s (s + 1/2) sin^2(pi / 8 s))` rings away: most for s = 1, `sqrt(1/4 + 6 sin^2(pi/8))`. Rings are
    /// farthest apart near a pole: `sqrt(2) / m`.
    const MAX_ERROR_DEG: f32 = error_bound(1.502_6, BITS);
    const NULL: Option<[u32; 2]> = Some([if BITS == 24 { 0xff_ffff } else { 1 << (BITS / 2 - 1) }, 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let norm = l1_norm(v);
        usable_code::<BITS>(norm, lattice(v, norm, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        from_lattice(unpack::<BITS>(code), snorm_max(BITS / 2))
    }
}

/// Equal-area octahedral code of `BITS` bits (16, 20, 22, 24 or 32), precise encoder: the format of [`EaOct`], 1 % less
/// error in the mean, an eighth less at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EaOctPrecise<const BITS: u32>;

impl<const BITS: u32> Codec for EaOctPrecise<BITS>
where
    EaOct<BITS>: Width,
{
    const BITS: u32 = BITS;
    /// Half the diagonal of a cell between two rings, `sqrt(1 / c^2 + pi^2 c^2 / 16) / m`, which is greatest for c =
    /// `sqrt(2)`, at a pole; as great only where the two rings' points lie opposite each other, next to y = 0 or x = 0.
    const MAX_ERROR_DEG: f32 = error_bound(1.316_8, BITS);
    const NULL: Option<[u32; 2]> = EaOct::<BITS>::NULL;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let norm = l1_norm(v);
        usable_code::<BITS>(norm, lattice_precise(v, norm, snorm_max(BITS / 2)))
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        EaOct::<BITS>::decode_vec3(code)
    }
}
