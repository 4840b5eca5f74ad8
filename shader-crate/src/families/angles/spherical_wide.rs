//! Spherical coordinates finer than `f32`: 24 bits an angle.
//!
//! Source: Meyer et al. 2010, table 1 (SC at 48 bits); Cigolle et al. 2014, section 2. The mapping is that of
//! [`spherical`](crate::spherical).
//!
//! <!-- generated: errors spherical_wide -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `spherical48` | 5.43e-6 | 1.36e-5 | 1.60e-5 |
//! <!-- end -->
//!
//! * Layout: `i = round((2 theta / pi - 1) m)` in bits 0 to 23 of the code, with `m = 2^23 - 1`, and
//!   `j = round(phi / pi 2^23)` in bits 24 to 47, both in two's complement. A code is two words, low word first. -m is
//!   +Z, m is -Z; the pattern -m - 1 counts as -m.
//! * Error of the code: at most half the diagonal of a cell at the equator, 2.094e-7 radians, and the error of the
//!   arithmetic: 1/16 of a step along each angle. Meyer's eq. 5, for equal steps of both angles, gives 1.87e-7; his
//!   table 1 prints twice that.
//! * Error of the decoded vector: the rounding of its components adds up to `sqrt(3) 2^-25` radians.
//! * The six axes round-trip exactly. Every j at theta 0 or pi is the pole, exactly; encoding writes j = 0 there.
//! * Good for: angles that were measured, and comparison. Weakness: [`OctPrecise48`](crate::OctPrecise48) is more exact.
//!
//! # Arithmetic
//!
//! One float is too coarse: near half a turn, floats are half a step of theta apart, and `f32` trigonometry is off by a
//! step more. So the decoder takes sines and cosines as sums of two floats. The first two terms of their polynomials
//! need that; the others are small up to an eighth of a turn. Components are off by less than an ULP.
//!
//! The encoder estimates an angle in single precision and takes sine and cosine of the estimate as the decoder does.
//! The vector's distance from that direction, in steps, is a small number that one float holds. A division or root that
//! is some ULP off changes no code, but for ties.

use crate::arith::{
    COS_0, COS_1, COS_2, COS_3, SIN_0, SIN_1, SIN_2, SIN_3, atan_octant_ratio, exp2, floor, integer_part,
    is_negative, mask, max, negate_if, negate_positive, product_rest, ratio, root, scaled_to_one,
    signed_quotient,
};
use crate::codec::Codec;
use crate::direction::or_z;
use core::f32::consts::PI;
use glam::Vec3;

/// A number as the sum of two floats; the second is the part that the first lacks.
#[derive(Clone, Copy)]
struct TwoFloats {
    high: f32,
    low: f32,
}

impl TwoFloats {
    /// `a + b + low`, where `a` is 0 or no less than `b` in magnitude, and `low` is far less.
    #[inline(always)]
    fn sum(a: f32, b: f32, low: f32) -> Self {
        let high = a + b;
        Self { high, low: (b - (high - a)) + low }
    }

    /// The product with `other`.
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let high = self.high * other.high;
        let crosswise = self.high * other.low + self.low * other.high;
        Self { high, low: product_rest(self.high, other.high, high) + crosswise }
    }
}

impl From<f32> for TwoFloats {
    #[inline(always)]
    fn from(high: f32) -> Self {
        Self { high, low: 0.0 }
    }
}

/// The unit of an angle.
#[derive(Clone, Copy)]
struct Steps {
    /// Steps in a quarter turn.
    in_quarter: i32,
    /// The size of a step in half turns, cut down to a power of two.
    size: f32,
    /// The part that was cut off, relative to the size.
    excess: f32,
}

/// The steps of theta. A step is `1 / (2^24 - 2)` half turns, which is `2^-24 (1 + 2^-23)` to within 2^-69.
const THETA: Steps = Steps { in_quarter: (1 << 23) - 1, size: exp2(-24), excess: exp2(-23) };

/// The steps of phi.
const PHI: Steps = Steps { in_quarter: 1 << 22, size: exp2(-23), excess: 0.0 };

/// The distance from the z axis within which a vector of about unit length counts as a pole: far within half a step.
const POLAR: f32 = exp2(-40);

/// `base + low + linear u + rest`, in order of magnitude: `base`, `linear u`, `rest`, `low`.
#[inline(always)]
fn polynomial(base: f32, low: f32, linear: f32, u: f32, rest: f32) -> TwoFloats {
    let product = linear * u;
    let sum = TwoFloats::sum(product, rest, product_rest(linear, u, product));
    TwoFloats::sum(base, sum.high, sum.low + low)
}

/// Cosine and sine of `n` steps, up to an eighth of a turn.
#[inline(always)]
fn octant(n: i32, steps: Steps) -> (TwoFloats, TwoFloats) {
    let r = n as f32 * steps.size;
    let u = r * r;
    let cosine = polynomial(1.0, 0.0, COS_0, u, (u * u) * (COS_1 + u * (COS_2 + u * COS_3)));
    let sine_over_r = polynomial(PI, SIN_0, SIN_1, u, (u * u) * (SIN_2 + u * SIN_3));
    let sine = TwoFloats::from(r).times(sine_over_r);

    // The rest of the angle is so small that it is its own sine, and its cosine is 1.
    let turn = r * (PI * steps.excess);
    (
        TwoFloats::sum(cosine.high, cosine.low, -(turn * sine.high)),
        TwoFloats::sum(sine.high, sine.low, turn * cosine.high),
    )
}

/// Cosine and sine of `n` steps, up to a quarter turn.
#[inline(always)]
fn quarter(n: i32, steps: Steps) -> (TwoFloats, TwoFloats) {
    let rest = steps.in_quarter - n;
    let steep = n > rest;
    let (x, y) = octant(if steep { rest } else { n }, steps);
    if steep { (y, x) } else { (x, y) }
}

/// The number of steps nearest to the angle of (x, y) from +X. Neither x nor y is negative.
#[inline(always)]
fn nearest(x: TwoFloats, y: TwoFloats, steps: Steps) -> i32 {
    let steep = y.high > x.high;
    let (long, short) = if steep { (y, x) } else { (x, y) };
    let part = atan_octant_ratio(short.high, long.high);
    let estimate = integer_part(part * ratio(0.25, steps.size) + 0.5);

    let (cosine, sine) = octant(estimate, steps);
    let (forth, back) = (short.times(cosine), long.times(sine));
    let across = (forth.high - back.high) + (forth.low - back.low);
    let length = max(root(long.high * long.high + short.high * short.high), POLAR);
    let off = signed_quotient(across, length * (PI * steps.size));
    let n = estimate + integer_part(floor(off + 0.5));
    if steep { steps.in_quarter - n } else { n }
}

/// The length of (x, y), neither of which is negative.
#[inline(always)]
fn length(x: f32, y: f32) -> TwoFloats {
    let (long, short) = if y > x { (y, x) } else { (x, y) };
    let (a, b) = (long * long, short * short);
    let root = max(root(a + b), POLAR);
    let square = root * root;
    let rests =
        (product_rest(long, long, a) - product_rest(root, root, square)) + product_rest(short, short, b);
    TwoFloats { high: root, low: signed_quotient(((a - square) + b) + rests, 2.0 * root) }
}

/// Spherical coordinates in 48 bits: two integers of 24.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SphericalWide;

impl Codec for SphericalWide {
    const BITS: u32 = 48;
    /// Half the diagonal of a cell and `sqrt(3) 2^-25` are 2.61e-7 radians. The arithmetic adds less than 1/15, because
    /// it moves encoded and decoded vectors alike.
    const MAX_ERROR_DEG: f32 = 1.6e-5;
    const NULL: Option<[u32; 2]> = Some([1 << 23, 0]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, norm) = or_z(v);
        let p = scaled_to_one(v, norm).abs();
        let latitude = nearest(length(p.x, p.y), p.z.into(), THETA);
        let turned = nearest(p.x.into(), p.y.into(), PHI);
        let turned = if is_negative(v.x) { 2 * PHI.in_quarter - turned } else { turned };
        let longitude = if latitude < THETA.in_quarter { turned } else { 0 };

        let i = if is_negative(v.z) { latitude } else { -latitude } as u32 & mask(24);
        let j = if is_negative(v.y) { -longitude } else { longitude } as u32 & mask(24);
        [i | (j << 24), j >> 8]
    }

    #[inline(always)]
    fn decode_vec3([low, high]: [u32; 2]) -> Vec3 {
        let i = (low << 8) as i32 >> 8;
        let j = (((low >> 24) | (high << 8)) << 8) as i32 >> 8;
        let latitude = if i < 0 { -i } else { i };
        let latitude = if latitude < THETA.in_quarter { latitude } else { THETA.in_quarter };
        let turned = if j < 0 { -j } else { j };
        let longitude = if latitude < THETA.in_quarter { turned } else { 0 };

        let left = longitude > PHI.in_quarter;
        let (radius, z) = quarter(latitude, THETA);
        let (x, y) = quarter(if left { 2 * PHI.in_quarter - longitude } else { longitude }, PHI);
        let (x, y) = (radius.times(x), radius.times(y));
        Vec3::new(
            negate_positive(left, x.high + x.low),
            negate_positive(j < 0, y.high + y.low),
            negate_if(i > 0, z.high + z.low),
        )
    }
}
