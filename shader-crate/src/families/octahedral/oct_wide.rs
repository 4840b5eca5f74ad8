//! Octahedral codes finer than `f32`: 24 and 26 bits a component, for positions that one float cannot hold.
//!
//! Source: Meyer et al. 2010, section 5 and table 1. Their 52 bits make the code's largest error that of three floats.
//! The mapping is that of [`oct`](crate::oct).
//!
//! <!-- generated: errors oct_wide -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `oct48` | 5.13e-6 | 1.67e-5 | 1.75e-5 |
//! | `oct48p` | 4.80e-6 | 1.15e-5 | 1.27e-5 |
//! | `oct52p` | 1.08e-6 | 4.09e-6 | 5.39e-6 |
//! <!-- end -->
//!
//! * Layout: x in the low bits of the code, y in those above it, both snorm in two's complement: bits 0 to 23 and 24 to
//!   47, or 0 to 25 and 26 to 51. A code is two words, low word first.
//! * Error of the code, with `m` the snorm's largest integer: at most `3 / (sqrt(2) m)` radians with the fast encoder
//!   (Meyer eq. 10), at most `sqrt(2) / m` with the precise one (eq. 11), both in the middle of the octants.
//! * Error of the decoded vector: its components are the floats nearest to the exact ones, which turns it by up to
//!   `sqrt(3) 2^-25` radians more. At 52 bits that is as much again. So the code is as exact as three floats (Meyer's
//!   eq. 3), and the `f32` vector that it decodes to is not; a decoder of higher precision gets the rest out of the
//!   code. Measured, as in the table, `oct52p` gains from the treatment of decoded vectors by [`OctWidePrecise`]: many
//!   `f32` unit vectors come back exactly.
//! * The six axes round-trip exactly. Points of the square's border stand for the same direction as their mirror image
//!   along that edge. The four corners are all -Z. Mirrored directions have mirrored codes, at z = 0 too.
//! * Good for: measured and engineering geometry, in 6 or 8 bytes for the 12 of three floats. For geometry that is only
//!   looked at, 32 bits suffice. Weakness: several times the cost of the 32-bit codes.
//!
//! # Arithmetic
//!
//! A position on the lattice takes 25 bits and some more to round it by; a float has 24. So the encoder takes the
//! quotient `|x| / (|x| + |y| + |z|)` as a sum of two floats: Knuth's two-sum gives the L1 norm exactly, Dekker's
//! product gives the remainder of a first quotient, and that gives the second. No fused multiplication is used. The
//! position is good to 2^-20 of a step, even where a device's division is off by some ULP. The decoder corrects a
//! reciprocal length of 12 bits, whose products are exact, by the error of its square. Where a device's division or
//! root is 3 ULP off, a few decoded vectors and `oct52p` codes in a million differ in the last place. Such a vector may
//! have a code of its own in `oct52p`, whose lattice is finer than floats: it is not stable across devices.

use crate::arith::{
    Coordinate, coordinate, dot, exp2, is_negative, mask, negate_if, normalize_parts, ratio, reciprocal,
    scaled_to_one, two_sum,
};
use crate::codec::{Codec, Width};
use crate::direction::or_z;
use glam::Vec3;

/// A direction in the positive octant, on the octahedron `x + y + z = m`.
#[derive(Clone, Copy)]
struct Position {
    x: Coordinate,
    y: Coordinate,
    /// The position as a part of `m`, in single precision.
    part: Vec3,
    /// The vector itself without signs, scaled by a power of two to an L1 norm of 1 to 2, exactly: then no partial
    /// product that counts is denormal.
    vector: Vec3,
}

/// A lattice point of the positive octant, and a measure of its angle from the direction sought.
#[derive(Clone, Copy)]
struct Candidate {
    x: i32,
    y: i32,
    cost: f32,
}

impl Candidate {
    /// `other` where it costs less, else `self`.
    #[inline(always)]
    fn or_cheaper(self, other: Self) -> Self {
        if other.cost < self.cost { other } else { self }
    }
}

/// The place of a direction with the L1 norm `norm` in the positive octant, after mirroring.
#[inline(always)]
fn position(v: Vec3, norm: f32, bits: u32) -> Position {
    let vector = scaled_to_one(v, norm).abs();
    let (sum_xy, rest_xy) = two_sum(vector.x, vector.y);
    let (sum, rest_z) = two_sum(sum_xy, vector.z);
    let rest = rest_xy + rest_z;
    let reciprocal = reciprocal(sum);
    let (x, part_x) = coordinate(vector.x, sum, rest, reciprocal, bits);
    let (y, part_y) = coordinate(vector.y, sum, rest, reciprocal, bits);
    Position { x, y, part: Vec3::new(part_x, part_y, vector.z * reciprocal), vector }
}

/// Moves a lattice point of the positive octant to where the lower half of the octahedron is folded out if `v.z` is
/// negative, gives it the signs of `v.x` and `v.y`, and packs it.
#[inline(always)]
fn pack<const BITS: u32>(v: Vec3, x: i32, y: i32) -> [u32; 2] {
    let m = mask(BITS / 2 - 1) as i32;
    let (x, y) = if is_negative(v.z) { (m - y, m - x) } else { (x, y) };
    let x = if is_negative(v.x) { -x } else { x } as u32 & mask(BITS / 2);
    let y = if is_negative(v.y) { -y } else { y } as u32 & mask(BITS / 2);
    [x | (y << (BITS / 2)), y >> (32 - BITS / 2)]
}

/// Half of `BITS` bits in two's complement as an integer, with `-2^(BITS/2-1)` taken as `-(2^(BITS/2-1) - 1)`: both
/// stand for -1. Bits above are ignored.
#[inline(always)]
fn snorm_integer<const BITS: u32>(code: u32) -> i32 {
    let m = mask(BITS / 2 - 1) as i32;
    let integer = (code << (32 - BITS / 2)) as i32 >> (32 - BITS / 2);
    if integer < -m { -m } else { integer }
}

/// The lattice point nearest to `p` along each axis; ties go up. Rounding in the positive octant, before the fold,
/// gives mirrored directions mirrored codes.
#[inline(always)]
fn nearest_on_axes(p: Position) -> (i32, i32) {
    (p.x.whole + if p.x.fraction < 0.5 { 0 } else { 1 }, p.y.whole + if p.y.fraction < 0.5 { 0 } else { 1 })
}

/// The lattice point nearest to `p` in angle: the nearest of the four corners of its cell. The nearest of all is among
/// these.
///
/// [`oct`](crate::oct) has the measure, `|d x p|^2 / ((p + d) . p)^2` with `d` from `p` to the corner, and why the far
/// corner of a cell at the octant's edge z = 0 is left out. Here the denominator is left out too: from corner to corner
/// it differs by 2^-21 of itself, which matters less than the rounding of the decoded vector, 2^-24 radians. Then any
/// factor of `p` cancels, and `d` is (a, b, -a-b), since corners and `p` have the sum `m`.
///
/// At 52 bits a corner that decodes to the vector itself costs least: see [`OctWidePrecise`].
#[inline(always)]
fn nearest_corner<const BITS: u32>(p: Position) -> (i32, i32) {
    let (x, y) = (p.x.whole, p.y.whole);
    let z = mask(BITS / 2 - 1) as i32 - x - y;
    let (to_right, to_up) = (1.0 - p.x.fraction, 1.0 - p.y.fraction);

    let near = candidate::<BITS>(x, y, -p.x.fraction, -p.y.fraction, p);
    let right = candidate::<BITS>(x + 1, y, to_right, -p.y.fraction, p);
    let up = candidate::<BITS>(x, y + 1, -p.x.fraction, to_up, p);
    let far = candidate::<BITS>(x + 1, y + 1, to_right, to_up, p);

    let best = near.or_cheaper(right).or_cheaper(up);
    let best = if z < 2 { best } else { best.or_cheaper(far) };
    (best.x, best.y)
}

#[inline(always)]
fn candidate<const BITS: u32>(x: i32, y: i32, a: f32, b: f32, p: Position) -> Candidate {
    let part = p.part;
    let along = a * (part.x - part.z) + b * (part.y - part.z);
    let squared = 2.0 * ((a * a + a * b) + b * b);
    let cost = squared * dot(part, part) - along * along;
    let is_own = BITS == 52 && decode_octant::<BITS>(x, y, mask(BITS / 2 - 1) as i32 - x - y) == p.vector;
    Candidate { x, y, cost: if is_own { -1.0 } else { cost } }
}

/// The unit vector of the lattice point (x, y, z) of the positive octant, as exact as by [`normalize_parts`].
#[inline(always)]
fn decode_octant<const BITS: u32>(x: i32, y: i32, z: i32) -> Vec3 {
    let low_bits = BITS / 2 - 13;
    let low_mask = (1 << low_bits) - 1;
    let upper = Vec3::new((x >> low_bits) as f32, (y >> low_bits) as f32, (z >> low_bits) as f32);
    let lower = Vec3::new((x & low_mask) as f32, (y & low_mask) as f32, (z & low_mask) as f32);
    normalize_parts(upper, lower * exp2(-(low_bits as i32)))
}

#[inline(always)]
fn decode<const BITS: u32>([low, high]: [u32; 2]) -> Vec3 {
    let x = snorm_integer::<BITS>(low);
    let y = snorm_integer::<BITS>((low >> (BITS / 2)) | (high << (32 - BITS / 2)));
    let m = mask(BITS / 2 - 1) as i32;
    let (across, up) = (if x < 0 { -x } else { x }, if y < 0 { -y } else { y });
    let z = m - across - up;
    let (across, up, height) = if z < 0 { (m - up, m - across, -z) } else { (across, up, z) };
    let v = decode_octant::<BITS>(across, up, height);
    // Components of 0 are not negated: they would become -0.
    Vec3::new(negate_if(x < 0 && across > 0, v.x), negate_if(y < 0 && up > 0, v.y), negate_if(z < 0, v.z))
}

/// The error in radians of a code that is `radians_times_m` off, with the decoded vector's rounding, at most `sqrt(3)
/// 2^-25`, in degrees. The margin of 2^-8 covers the arithmetic: 2^-20 of a step, and 2^-33 per component.
const fn error_bound(radians_times_m: f32, bits: u32) -> f32 {
    let lattice = ratio(radians_times_m, mask(bits / 2 - 1) as f32);
    ((lattice + 1.732_050_8 * exp2(-25)) * (1.0 + exp2(-8))).to_degrees()
}

/// Octahedral code of `BITS` bits (48), fast encoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OctWide<const BITS: u32>;

impl<const BITS: u32> Codec for OctWide<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const MAX_ERROR_DEG: f32 = error_bound(3.0 * core::f32::consts::FRAC_1_SQRT_2, BITS);
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, norm) = or_z(v);
        let (x, y) = nearest_on_axes(position(v, norm, BITS / 2));
        pack::<BITS>(v, x, y)
    }

    #[inline(always)]
    fn decode_vec3(code: [u32; 2]) -> Vec3 {
        decode::<BITS>(code)
    }
}

/// Octahedral code of `BITS` bits (48 or 52), precise encoder: the nearest code in angle, a third less error at most
/// than the fast one.
///
/// At 52 bits the steps of the lattice are about those of floats. A decoded vector, rounded to `f32`, can lie nearer to
/// another code than to its own, and that code can decode to another vector: so it is for 0.3 % of all codes. The
/// encoder therefore decodes the corners of a vector's cell. Where one gives the vector itself, whatever power of two
/// it is scaled by, it takes that code, though another one may be nearer: then the code is up to 5.1e-8 radians off,
/// but the decoded vector is not off at all, and stays as it is however often it is encoded. A decoded vector's own
/// code is always such a corner, since its rounding moves a position by less than a step: by at most 0.83 along each
/// axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OctWidePrecise<const BITS: u32>;

impl<const BITS: u32> Codec for OctWidePrecise<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const STABLE_ACROSS_DEVICES: bool = BITS < 52;
    const MAX_ERROR_DEG: f32 = error_bound(core::f32::consts::SQRT_2, BITS);
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, norm) = or_z(v);
        let (x, y) = nearest_corner::<BITS>(position(v, norm, BITS / 2));
        pack::<BITS>(v, x, y)
    }

    #[inline(always)]
    fn decode_vec3(code: [u32; 2]) -> Vec3 {
        decode::<BITS>(code)
    }
}
