//! Azimuthal codes: a hemisphere on a disk by a classic map projection, the disk on a square or as it is, and one bit
//! for the hemisphere.
//!
//! Source: Cigolle et al. 2014, section 2; Snyder, "Map Projections: A Working Manual", 1987 (the projections);
//! Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997 (concentric); the ellipse map is the
//! elliptical grid map. Three [`Projection`]s times three [`SquareMap`]s, at five widths.
//!
//! With `rho = sqrt(x^2 + y^2)`, on the unit sphere:
//!
//! | projection | disk point | back, with `rim = 1 - r^2` |
//! |---|---|---|
//! | [`Stereo`] | `r = rho / (1 + abs(z))` | `(2 p, rim) / (2 - rim)` |
//! | [`Eqarea`] | `r = sqrt(1 - abs(z)) = rho / sqrt(1 + abs(z))` | `(p sqrt(1 + rim), rim)` |
//! | [`Eqdist`] | `r = 2/pi atan2(rho, abs(z))` | `(p sin(pi r / 2) / r, cos(pi r / 2))` |
//!
//! * Layout: u, snorm of `BITS / 2` bits in two's complement, in the low bits; v, n = `BITS / 2 - 1` bits in two's
//!   complement, above it; the hemisphere (1 for z < 0) in the highest bit.
//! * v runs from `-2^(n-1)` to `2^(n-1)` in steps of `2^-(n-1)`, where snorm has `2^(n-1) - 1`. Its two ends share
//!   the pattern of `-2^(n-1)`. They lie on the equator (on the disk as it is, also beyond), which both hemispheres
//!   share, so that there the highest bit is free to tell them apart: 1 says +1, 0 says -1.
//! * Error: the table below; never more than [`Codec::MAX_ERROR_DEG`], which is `K / 2^(n-1)` radians. The image of
//!   the straight segment from a point to its lattice point is at least as long as the angle between their
//!   directions, and K is the greatest length that half a step of u with half a step of v has on the sphere: see
//!   [`SquareMap::STRETCH`].
//! * The six axes round-trip exactly. A direction mirrored at a coordinate plane gets the mirrored vector, exactly.
//!   x and y cannot be swapped: u has twice the steps.
//! * Good for: comparison with the survey. [`oct`](crate::oct) has a lower mean error at each
//!   width and costs less; its precise encoder has a lower maximum too. Of these, [`Eqarea`] with [`Ellipse`] has
//!   the lowest mean, [`Eqdist`] the lowest maxima. A code of the survey's own program is not one of these: there v
//!   has other steps.
//! * Cost: encoding takes 1 (stereo) to 5 (eqarea+ellipse) square roots and 2 to 5 divisions other than by constants
//!   and, for [`Eqdist`] and [`Concentric`] each, an arc tangent polynomial; decoding takes none to 3 square roots,
//!   none to 5 divisions, [`Concentric`] a sine and cosine, [`Eqdist`] two polynomials of 4 terms.
//! * Weaknesses: without a map to the square a part of `1 - pi/4` of the codes is spare; [`Concentric`] creases at
//!   the diagonals, where its maxima lie. Codes of the equator come in pairs, one for each hemisphere.
//!
//! Why v is not an snorm: at 16 bits its steps would be 1/63, not 1/64, and the survey's errors are lower than that
//! gives: the means of stereo, eqarea and eqdist with concentric would be 1.013, 1.012 and 1.011 times the
//! published ones, and the maximum of eqarea+concentric20 1.041 times. As it is, all 45 means are 0.993 to 1.007
//! times the published ones. An offset grid without zero (u of 255 steps, v of 127) would come as near, but not
//! have the axes. The maxima are at most 1.04 times the published ones, over 10^6 directions, with one exception,
//! eqarea+concentric22 (1.042): the maximum is that of a few cells on the rim at the diagonals, and which
//! directions come near those is chance. Twelve other samples of 10^6 gave 1.020 to 1.044; the survey's value is
//! 0.947 of the supremum.
//!
//! Why +ellipse is better here at 20 to 32 bits than in the survey, which at 32 bits has maxima of 0.017 to 0.026
//! degrees: the usual way back to the square, `sqrt(2 + d + 2 sqrt(2) x) / 2 - sqrt(2 + d - 2 sqrt(2) x) / 2` with
//! `d = x^2 - y^2`, takes the root of a difference that vanishes at the square's corners, so that an error of 2^-24
//! becomes one of 2^-12. Here that difference does not occur: see [`Ellipse`]. Its maxima at 32 bits are those of
//! exact arithmetic, 5 to 7 times below the survey's; stereo32's is 0.7 times.
//!
//! Mean and greatest error, in degrees, over 10^6 directions and some next to the equator, the poles and the
//! diagonals:
//!
//! | codec | 16 | 20 | 22 | 24 | 32 |
//! |---|---|---|---|---|---|
//! | `stereo` | 0.399 / 0.992 | 0.0996 / 0.2491 | 0.0498 / 0.1245 | 0.0248 / 0.0623 | 0.00156 / 0.00389 |
//! | `stereo_concentric` | 0.374 / 1.318 | 0.0934 / 0.3309 | 0.0467 / 0.1668 | 0.0233 / 0.0851 | 0.00146 / 0.00519 |
//! | `stereo_ellipse` | 0.381 / 0.992 | 0.0951 / 0.2491 | 0.0475 / 0.1245 | 0.0238 / 0.0623 | 0.00149 / 0.00389 |
//! | `eqarea` | 0.385 / 0.983 | 0.0962 / 0.2480 | 0.0481 / 0.1235 | 0.0241 / 0.0613 | 0.00150 / 0.00387 |
//! | `eqarea_concentric` | 0.366 / 1.023 | 0.0913 / 0.2571 | 0.0456 / 0.1283 | 0.0228 / 0.0646 | 0.00143 / 0.00404 |
//! | `eqarea_ellipse` | 0.350 / 0.905 | 0.0875 / 0.2251 | 0.0437 / 0.1134 | 0.0219 / 0.0567 | 0.00137 / 0.00355 |
//! | `eqdist` | 0.382 / 0.786 | 0.0955 / 0.1964 | 0.0477 / 0.0983 | 0.0238 / 0.0490 | 0.00149 / 0.00306 |
//! | `eqdist_concentric` | 0.361 / 1.054 | 0.0901 / 0.2643 | 0.0451 / 0.1322 | 0.0226 / 0.0656 | 0.00141 / 0.00420 |
//! | `eqdist_ellipse` | 0.355 / 0.781 | 0.0885 / 0.1954 | 0.0442 / 0.0978 | 0.0221 / 0.0489 | 0.00138 / 0.00306 |

use crate::arith::{
    NEGLIGIBLE, atan_octant_ratio, dot, floor, horizontal_length, is_negative, mask, negate_if, signed_code,
    sin_cos_half_turns, snorm_integer, snorm_max, sqrt,
};
use crate::codec::Codec;
use crate::direction::or_z;
use core::marker::PhantomData;
use glam::{Vec2, Vec3};

/// A point of the unit disk's quadrant x, y >= 0.
#[derive(Clone, Copy)]
pub struct Disk {
    /// The point.
    pub point: Vec2,
    /// Its distance from the middle. Only [`Projection::to_disk`] gives it.
    pub radius: f32,
    /// `1 - radius^2`: how far it is inside the rim, to a small relative error where the [`SquareMap`] needs that.
    pub rim: f32,
}

/// A projection of the hemisphere to the unit disk, on the octant of positive components.
pub trait Projection {
    /// Which one: 0, 1, 2.
    const INDEX: u32;

    /// The disk point of the direction of `v`, whose components are not negative and have the sum 1.
    fn to_disk(v: Vec3) -> Disk;

    /// The unit vector of a disk point. Where `rim` is slightly negative the vector is of unit length to the
    /// second order.
    fn from_disk(disk: Disk) -> Vec3;
}

/// A way to lay the disk on the square, on the quadrant of positive coordinates.
pub trait SquareMap {
    /// Which one: 0, 1, 2.
    const INDEX: u32;

    /// The K of [`Codec::MAX_ERROR_DEG`] with each projection, by [`Projection::INDEX`]: the greatest length of
    /// `k a/2 + b/2` and `k a/2 - b/2`, where a and b are the derivatives of the direction by u and v, and k, at
    /// most 64/127, is u's step over v's. Rounded up.
    const STRETCH: [f32; 3];

    /// The point on the square of a disk point.
    fn to_square(disk: Disk) -> Vec2;

    /// The lattice point to write where `e` is the one that rounding gave. `m` has the largest integers.
    fn settle(e: Vec2, m: Vec2) -> Vec2;

    /// The disk point of a lattice point.
    fn to_disk(e: Vec2, m: Vec2) -> Disk;
}

/// Stereographic projection: conformal, and the cheapest.
pub struct Stereo;

impl Projection for Stereo {
    const INDEX: u32 = 0;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let scale = 1.0 / (sqrt(dot(v, v)) + v.z);
        Disk {
            point: Vec2::new(v.x * scale, v.y * scale),
            radius: horizontal_length(v) * scale,
            rim: 2.0 * v.z * scale,
        }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        // Divisions rather than a product with the reciprocal: its rounding would take the length beyond 2 ULP.
        let sum = 2.0 - disk.rim;
        Vec3::new(2.0 * disk.point.x / sum, 2.0 * disk.point.y / sum, disk.rim / sum)
    }
}

/// Lambert's azimuthal equal-area projection.
pub struct Eqarea;

impl Projection for Eqarea {
    const INDEX: u32 = 1;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let length = sqrt(dot(v, v));
        let scale = 1.0 / sqrt(length * (length + v.z));
        Disk {
            point: Vec2::new(v.x * scale, v.y * scale),
            radius: horizontal_length(v) * scale,
            rim: v.z / length,
        }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        let scale = sqrt(1.0 + disk.rim);
        Vec3::new(disk.point.x * scale, disk.point.y * scale, disk.rim)
    }
}

/// `sin(pi r / 2) / r = 1 + c (SINC_0 + c (SINC_1 + c (SINC_2 + c SINC_3)))` with `c = 1 - r^2`, for r in \[0, 1\]:
/// absolute error 7.6e-9 before rounding. Exact on the rim.
pub const SINC_0: f32 = 0.49999976;
/// See [`SINC_0`].
pub const SINC_1: f32 = 0.066577174;
/// See [`SINC_0`].
pub const SINC_2: f32 = 0.0040679215;
/// See [`SINC_0`].
pub const SINC_3: f32 = 0.00015146394;

/// `cos(pi r / 2) / (1 - r^2) = 1 + w (COSC_0 + w (COSC_1 + w (COSC_2 + w COSC_3)))` with `w = r^2`, for r in
/// \[0, 1\]: absolute error 1e-9 before rounding. Exact in the middle.
pub const COSC_0: f32 = -0.23370051;
/// See [`COSC_0`].
pub const COSC_1: f32 = 0.019968653;
/// See [`COSC_0`].
pub const COSC_2: f32 = -0.0008935995;
/// See [`COSC_0`].
pub const COSC_3: f32 = 2.3629505e-5;

/// Azimuthal equidistant projection: the distance from the middle is the angle from the pole.
pub struct Eqdist;

impl Projection for Eqdist {
    const INDEX: u32 = 2;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let rho = horizontal_length(v);
        let flat = rho > v.z;
        let (shorter, longer) = if flat { (v.z, rho) } else { (rho, v.z) };
        // The smaller of the radius and 1 - radius, both of which have a small relative error so.
        let part = 0.5 * atan_octant_ratio(shorter, longer);
        let rest = 1.0 - part;
        let (radius, inside) = if flat { (rest, part) } else { (part, rest) };
        let quotient = radius / rho;
        let scale = if rho > NEGLIGIBLE { quotient } else { 0.0 };
        Disk { point: Vec2::new(v.x * scale, v.y * scale), radius, rim: inside * (1.0 + radius) }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        let c = disk.rim;
        let scale = 1.0 + c * (SINC_0 + c * (SINC_1 + c * (SINC_2 + c * SINC_3)));
        let w = 1.0 - c;
        let z = c + c * (w * (COSC_0 + w * (COSC_1 + w * (COSC_2 + w * COSC_3))));
        Vec3::new(disk.point.x * scale, disk.point.y * scale, z)
    }
}

/// No map: the disk lies in the square, whose corners, a part of `1 - pi/4`, are spare.
///
/// Rounding takes points near the rim to lattice points beyond it. Such a point stands for a point of the rim: it
/// is moved to the rim along the coordinate in which a step counts for more, or, where that takes more than half
/// a step, along the other one for the rest. So it stays in its cell, and rounding takes it back to the same
/// lattice point. As the rim's slope is taken as constant, the point comes to lie outside by up to 2^-7 of a
/// step, of which the projections make a direction on the equator.
///
/// A lattice point is remote where the disk covers nothing of its cell, or only the last 64th of a step at the
/// corner that points to the middle. Remote ones are never written, so that whatever is written comes back: where
/// rounding gives one, which takes a position in that last 64th, the next point inward is written. Remote codes
/// decode to +-X or +-Y, whichever is nearer.
pub struct Plain;

/// How far, in steps, points beyond the rim are moved at most: a 64th less than half a step, which is twice what the
/// rounding of a position in `f32` comes to at 32 bits.
pub const REACH: f32 = 0.484375;

impl SquareMap for Plain {
    const INDEX: u32 = 0;
    const STRETCH: [f32; 3] = [1.12, 1.1549, 0.9071];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        disk.point
    }

    #[inline(always)]
    fn settle(e: Vec2, m: Vec2) -> Vec2 {
        let p = e / m;
        let inward = if p.x / m.x > p.y / m.y { Vec2::X } else { Vec2::Y };
        if is_remote(e, m) { e - inward } else { e }
    }

    #[inline(always)]
    fn to_disk(e: Vec2, m: Vec2) -> Disk {
        let p = e / m;
        let rim = 1.0 - (p.x * p.x + p.y * p.y);
        let onto_rim = move_to_rim(p, m, -0.5 * rim);
        let axis = if p.x > p.y { Vec2::X } else { Vec2::Y };
        let on_rim = if is_remote(e, m) { axis } else { onto_rim };
        let rest = 1.0 - (on_rim.x * on_rim.x + on_rim.y * on_rim.y);
        if rim > 0.0 {
            Disk { point: p, radius: 0.0, rim }
        } else {
            Disk { point: on_rim, radius: 0.0, rim: if rest < 0.0 { rest } else { 0.0 } }
        }
    }
}

/// True for lattice points of whose cell the disk covers nothing, or next to nothing.
#[inline(always)]
fn is_remote(e: Vec2, m: Vec2) -> bool {
    let corner = (e - REACH) / m;
    corner.x * corner.x + corner.y * corner.y > 1.0
}

/// The point on the rim for a point `p` beyond it, where `excess` is `(|p|^2 - 1) / 2`.
#[inline(always)]
fn move_to_rim(p: Vec2, m: Vec2, excess: f32) -> Vec2 {
    // What one step on each axis takes off the excess.
    let slope = p / m;
    let along_u = slope.x > slope.y;
    let (steep, gentle) = if along_u { (slope.x, slope.y) } else { (slope.y, slope.x) };
    let alone = excess / steep;
    let remainder = (excess - REACH * steep) / gentle;
    let (first, second) = if alone < REACH { (alone, 0.0) } else { (REACH, remainder) };
    let moved = if along_u { Vec2::new(first, second) } else { Vec2::new(second, first) };
    p - moved / m
}

/// Shirley and Chiu's concentric map: keeps relative areas; circles become squares. It creases at the diagonals.
pub struct Concentric;

impl SquareMap for Concentric {
    const INDEX: u32 = 1;
    const STRETCH: [f32; 3] = [1.5478, 1.162, 1.2157];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        let p = disk.point;
        let steep = p.y > p.x;
        let (shorter, longer) = if steep { (p.x, p.y) } else { (p.y, p.x) };
        let across = disk.radius * atan_octant_ratio(shorter, longer);
        if steep { Vec2::new(across, disk.radius) } else { Vec2::new(disk.radius, across) }
    }

    #[inline(always)]
    fn settle(e: Vec2, _: Vec2) -> Vec2 {
        e
    }

    #[inline(always)]
    fn to_disk(e: Vec2, m: Vec2) -> Disk {
        let s = e / m;
        let steep = s.y > s.x;
        let (shorter, radius) = if steep { (s.x, s.y) } else { (s.y, s.x) };
        let quotient = shorter / radius;
        let octant = if radius > 0.0 { quotient } else { 0.0 };
        let turn = sin_cos_half_turns(0.25 * octant);
        let (across, along) = (radius * turn.y, radius * turn.x);
        let point = if steep { Vec2::new(across, along) } else { Vec2::new(along, across) };
        Disk { point, radius, rim: 1.0 - radius * radius }
    }
}

/// The elliptical grid map: lines of the square become ellipses. Smooth but for the corners.
///
/// From square (s, t) to disk (x, y): `x = s sqrt(1 - t^2/2)`, `y = t sqrt(1 - s^2/2)`. Then `1 - x^2 - y^2 = (1
/// - s^2)(1 - t^2)`.
///
/// Back: with `d = x^2 - y^2 = s^2 - t^2` the first equation is a quadratic one of s^2, the solution of which is
/// `s^2 = 4 x^2 / (2 + d + root)` where `root^2 = (2 + d)^2 - 8 x^2 = d^2 + 4 rim`; and `t^2 = 4 y^2 / (2 - d +
/// root)`. Only sums of positive terms occur, and `d`, which the root passes on at most as it is: so if `rim` has
/// a small relative error the result has.
pub struct Ellipse;

impl SquareMap for Ellipse {
    const INDEX: u32 = 2;
    const STRETCH: [f32; 3] = [1.12, 1.022, 0.8796];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        let p = disk.point;
        let difference = (p.x - p.y) * (p.x + p.y);
        let sum = 2.0 + sqrt(difference * difference + 4.0 * disk.rim);
        Vec2::new(2.0 * p.x / sqrt(sum + difference), 2.0 * p.y / sqrt(sum - difference))
    }

    #[inline(always)]
    fn settle(e: Vec2, _: Vec2) -> Vec2 {
        e
    }

    #[inline(always)]
    fn to_disk(e: Vec2, m: Vec2) -> Disk {
        let s = e / m;
        let point = Vec2::new(s.x * sqrt(1.0 - 0.5 * s.y * s.y), s.y * sqrt(1.0 - 0.5 * s.x * s.x));
        // (1 - s^2) (1 - t^2), with one rounding less near the middle.
        let factor = 1.0 - s.x * s.x;
        Disk { point, radius: 0.0, rim: factor - factor * (s.y * s.y) }
    }
}

/// The largest integers of u and v: v's is a power of two, see the module's layout.
#[inline(always)]
pub const fn largest(bits: u32) -> (f32, f32) {
    (snorm_max(bits / 2), (1 << (bits / 2 - 2)) as f32)
}

/// `stretch` steps of v in degrees, and what the rounding of the position in f32 adds: at most 2^-21 per axis, of
/// which four times the length of `k/2` and 1/2 are more than enough.
const fn error_bound(stretch: f32, bits: u32) -> f32 {
    (stretch * (1.0 / largest(bits).1 + 4.0 / 2_097_152.0)).to_degrees()
}

/// Azimuthal code of `BITS` bits (16, 20, 22, 24 or 32): the projection `P`, laid on the square by `S`.
pub struct Azimuthal<P: Projection, S: SquareMap, const BITS: u32>(PhantomData<(P, S)>);

impl<P: Projection, S: SquareMap, const BITS: u32> Codec for Azimuthal<P, S, BITS> {
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(S::STRETCH[P::INDEX as usize], BITS);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (u_bits, v_bits) = (BITS / 2, BITS / 2 - 1);
        let (u_max, v_max) = largest(BITS);
        let m = Vec2::new(u_max, v_max);
        let (v, norm) = or_z(v);
        let s = S::to_square(P::to_disk(v.abs() * (1.0 / norm)));
        let e = S::settle(Vec2::new(floor(s.x * m.x + 0.5), floor(s.y * m.y + 0.5)), m);

        let (left, back, below) = (is_negative(v.x), is_negative(v.y), is_negative(v.z));
        let flag = if e.y < m.y { below } else { !back };
        let sign = if flag { 1 << (BITS - 1) } else { 0 };
        signed_code(negate_if(left, e.x), u_bits)
            | (signed_code(negate_if(back, e.y), v_bits) << u_bits)
            | sign
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        let (u_bits, v_bits) = (BITS / 2, BITS / 2 - 1);
        let (u_max, v_max) = largest(BITS);
        let m = Vec2::new(u_max, v_max);
        let u = snorm_integer(code & mask(u_bits), u_bits);
        let v = ((code << 1 << (32 - BITS)) as i32 >> (32 - v_bits)) as f32;
        let flag = (code >> (BITS - 1)) & 1 != 0;

        let n = P::from_disk(S::to_disk(Vec2::new(u.abs(), v.abs()), m));
        let back = v < 0.0 && !(flag && v <= -m.y);
        Vec3::new(signed(u < 0.0, n.x), signed(back, n.y), signed(flag, n.z))
    }
}

/// `-x` where `negative`, else `x`; 0 where x is not positive.
#[inline(always)]
fn signed(negative: bool, x: f32) -> f32 {
    if x > 0.0 { negate_if(negative, x) } else { 0.0 }
}
