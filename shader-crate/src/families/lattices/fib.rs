//! Spherical Fibonacci points: a spiral from pole to pole whose points all stand for the same area. The number of a
//! point is the code.
//!
//! Source: Keinert, Innmann, Sänger and Stamminger 2015, "Spherical Fibonacci Mapping": the points, and the bases of
//! their lattice by which the nearest one is found.
//!
//! With `N = 2^b` points and `g = (sqrt(5) - 1) / 2`, point i has the height `z = 1 - (2i + 1) / N` and the azimuth
//! `frac(i g)` of a turn. Over azimuth and number the points are a lattice: from i to i + F(k), with F(k) the k-th
//! Fibonacci number, the azimuth changes by `-(-g)^k` of a turn. Where a horizontal circle has the radius r, the steps
//! by F(k) and F(k+1) with `k = floor(log(sqrt(5) pi N r^2) / log(1 / g^2))` are a reduced basis: no other two are
//! shorter. So the nearest point is a corner of the cell that these two make around a direction.
//!
//! <!-- generated: errors fib -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `fib16` | 0.303 | 0.611 | 0.611 |
//! | `fib24` | 0.0189 | 0.0382 | 0.0382 |
//! | `fib32` | 0.00118 | 0.00239 | 0.00241 |
//! <!-- end -->
//!
//! * Layout: the code is i, counted from +Z to -Z. Every code is a point, and no point has two codes.
//! * Error: the mean is about a hundredth above the bound for any code of so many points, that of a hexagonal lattice:
//!   the cells run from nearly hexagonal to square and back with each k. The maximum is a quarter above its bound. It
//!   lies between points 1, 2 and 4 beside either pole, where the spiral's turns are no lattice yet; farther on the
//!   maximum is that of a square lattice.
//! * No axis round-trips exactly: +-Z are `sqrt(2 / N)` radians off.
//! * Good for: sets of points to sample or search by, since the codes are the numbers that others who use these points
//!   have; and a mean error below that of all square grids. Weaknesses: the cost of encoding, an arc tangent and the
//!   exact distances of four points. Neighbouring points have numbers far apart, so that codes must not be
//!   interpolated. The poles.
//!
//! # Arithmetic
//!
//! At 32 bits points are 5.4e-5 radians apart. Azimuths are fractions of a turn in 32 bits: 1.5e-9 radians. The product
//! of i and g is one of integers, with g in 64 bits, put together from 16 bits times 16. Turns wrap and subtract
//! exactly as integers do, and so do numbers of points: the encoder takes the cell from `f32`, where it is good to 0.03
//! of a cell, and measures exactly from there. A wrong cell does no harm: up to a quarter of a cell beyond its border
//! the nearest point is still a corner. The height is `1 - z` near the poles, as `(x^2 + y^2) / (1 + |z|)`, and z
//! itself elsewhere. Encoding and decoding are off by at most 2e-7 radians each.

use crate::arith::{
    LEAST_X, LEAST_Y, atan_octant_of_normal, coefficients, cos_eighth, exp2, integer_part, inverse_root,
    is_negative, mask, max, min, negate_if, quotient, ratio, reciprocal, root, scale_to_one, sin_eighth,
    small_floor, whole_to_i32, whole_to_u32,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::Vec3;

/// The upper 32 of the 64 bits of g, `(sqrt(5) - 1) / 2`.
pub const GOLDEN_HIGH: u32 = 0x9e37_79b9;
/// The lower 32 of the 64 bits of g, rounded.
pub const GOLDEN_LOW: u32 = 0x7f4a_7c16;

coefficients! {
    /// `2 sin(pi d)^2 = u (CHORD_0 + u (CHORD_1 + u (CHORD_2 + u (CHORD_3 + u CHORD_4))))` with `u = d^2`, for d in
    /// \[-1/2, 1/2\]: relative error 1.0e-6 before rounding.
    pub CHORD_0 = 19.73919, CHORD_1 = -64.93598, CHORD_2 = 85.35731, CHORD_3 = -59.191452, CHORD_4 = 21.72156;
}

/// The number that is added to those of points so that those of a cell beside a pole are not negative.
const SHIFT: u32 = 64;
/// The azimuth that [`SHIFT`] adds.
const SHIFT_TURN: u32 = turn(SHIFT);

/// The number of the last point: `bits` bits set. `bits` is 1 to 32.
#[inline(always)]
const fn last(bits: u32) -> u32 {
    !0 >> (32 - bits)
}

/// The azimuth of point `i` in turns, a fraction of 32 bits, cut off: bits 32 to 63 of the product of i and g.
#[inline(always)]
pub const fn turn(i: u32) -> u32 {
    let (i_low, i_high) = (i & 0xffff, i >> 16);
    let low = i_low * (GOLDEN_LOW & 0xffff);
    let middle = i_high * (GOLDEN_LOW & 0xffff) + (low >> 16);
    let other_middle = i_low * (GOLDEN_LOW >> 16) + (middle & 0xffff);
    let high = i_high * (GOLDEN_LOW >> 16) + (middle >> 16) + (other_middle >> 16);
    i.wrapping_mul(GOLDEN_HIGH).wrapping_add(high)
}

/// [`turn`] for `i` below 2^17, in which one product holds all bits that count.
#[inline(always)]
const fn turn_of_step(i: u32) -> u32 {
    i.wrapping_mul(GOLDEN_HIGH).wrapping_add(((i & mask(17)) * (GOLDEN_LOW >> 17)) >> 15)
}

/// A fraction of a turn in 32 bits as a float, in \[-1/2, 1/2\].
#[inline(always)]
fn signed_turn(turn: u32) -> f32 {
    turn as i32 as f32 * exp2(-32)
}

/// The integer part of a number from 0 to 2^31, and the rest.
#[inline(always)]
fn split(x: f32) -> (u32, f32) {
    let whole = integer_part(x);
    (whole as u32, x - whole as f32)
}

/// The azimuth of `v` in turns, a fraction of 32 bits: anything beside the z axis, where it does not matter. `scaled` is v at
/// an L1 norm of 1 to 2.
///
/// Octants are put together as integers, since a float between 1/4 and 1/2 has no bits for the precision of the arc
/// tangent.
#[inline(always)]
fn azimuth(v: Vec3, scaled: Vec3) -> u32 {
    let (x, y) = (max(scaled.x.abs(), LEAST_X), max(scaled.y.abs(), LEAST_Y));
    let (octant, _) = split(atan_octant_of_normal(quotient(min(x, y), max(x, y))) * exp2(29));
    let quarter = if y > x { (1 << 30) - octant } else { octant };
    let half = if is_negative(v.x) { (1 << 31) - quarter } else { quarter };
    if is_negative(v.y) { 0u32.wrapping_sub(half) } else { half }
}

/// `(1 / g)^k`, for k below 32.
#[inline(always)]
fn golden_power(k: u32) -> f32 {
    let one = if k & 1 != 0 { 1.618_034 } else { 1.0 };
    let two = if k & 2 != 0 { 2.618_034 } else { 1.0 };
    let four = if k & 4 != 0 { 6.854_102 } else { 1.0 };
    let eight = if k & 8 != 0 { 46.978_714 } else { 1.0 };
    let sixteen = if k & 16 != 0 { 2_206.999_5 } else { 1.0 };
    ((one * two) * (four * eight)) * sixteen
}

/// A direction beside the points, in the hemisphere z >= 0.
#[derive(Clone, Copy)]
struct Place {
    /// `1 - z`.
    depth: f32,
    /// z.
    height: f32,
    /// `1 - z^2`.
    radius_squared: f32,
    /// Its place among the numbers of the points: a whole number, and a [`fraction`](Self::fraction) to add.
    whole: u32,
    /// The fraction to add to [`whole`](Self::whole), -3/2 to 1/2.
    fraction: f32,
}

impl Place {
    /// The place of a vector with an L1 norm of 1 to 2.
    #[inline(always)]
    fn new(v: Vec3, bits: u32) -> Self {
        let horizontal = v.x * v.x + v.y * v.y;
        let reciprocal = inverse_root(horizontal + v.z * v.z);
        let height = v.z.abs() * reciprocal;
        let radius_squared = (horizontal * reciprocal) * reciprocal;
        let from_pole = quotient(radius_squared, 1.0 + height);
        let is_polar = height > 0.5;

        let half = exp2(bits as i32 - 1);
        let (whole, rest) = split(if is_polar { from_pole } else { height } * half);
        Self {
            depth: if is_polar { from_pole } else { 1.0 - height },
            height,
            radius_squared,
            whole: if is_polar { whole } else { (1 << (bits - 1)) - whole },
            fraction: negate_if(!is_polar, rest) - 0.5,
        }
    }
}

/// Two steps of the lattice, by F(k) and by F(k+1).
#[derive(Clone, Copy)]
struct Basis {
    /// F(k).
    step: f32,
    /// F(k+1).
    next_step: f32,
    /// The turn of the first step, without sign: `g^k`.
    turn: f32,
    /// The turn of the second step, `g^(k+1)`.
    next_turn: f32,
    /// Whether k is even: then the first step goes in the negative sense, otherwise the second.
    is_even: bool,
}

impl Basis {
    /// The reduced basis where a horizontal circle has this radius. k is at least 2, as in the source, and at most 25.
    ///
    /// The bits of a float, taken as a number, are its logarithm to the base 2, but for 0 to 0.086. A k that is off by
    /// up to 1/2 before rounding suffices: only there does a triangle of the cell become obtuse. The offset is
    /// `log2(sqrt(5) pi)` and half of 0.086, rounded, less the bias of the exponent.
    #[inline(always)]
    fn new(radius_squared: f32, bits: u32) -> Self {
        const OFFSET: f32 = 2.875 - 127.0;
        let logarithm = (radius_squared.to_bits() >> 8) as f32 * exp2(-15) + (bits as f32 + OFFSET);
        // log(2) / log(1 / g^2).
        let k = small_floor(0.720_210_1 * logarithm);
        let k = whole_to_u32(if k > 2.0 { k } else { 2.0 });
        let power = golden_power(k);
        let turn = reciprocal(power);
        Self {
            // F(k) is (1 / g)^k / sqrt(5), rounded.
            step: small_floor(power * 0.447_213_6 + 0.5),
            next_step: small_floor(power * 0.723_606_8 + 0.5),
            turn,
            next_turn: turn * 0.618_034,
            is_even: k & 1 == 0,
        }
    }
}

/// A point, and a measure of its distance from the place sought.
#[derive(Clone, Copy)]
struct Candidate {
    i: u32,
    cost: f32,
}

impl Candidate {
    /// Point `i`, which `place` is `turn` around from.
    ///
    /// The cost is half the square of the distance. With depths t and u, `w = r s` the product of both radii and d the
    /// angle between both meridians, that is `w 2 sin(d/2)^2` around and, along the meridian, half of `(t - u)^2 +
    /// (r - s)^2`, which equals `(t - u)^2 / (t + u - t u + w)`. Nothing cancels, since the difference of t and u is
    /// that of the numbers.
    ///
    /// Numbers below 0 are no points. Beyond the pole lie others, but none is nearer than the cell's other corners.
    #[inline(always)]
    fn new(place: Place, i: u32, turn: u32, bits: u32) -> Self {
        let steps = place.whole.wrapping_sub(i) as i32 as f32 + place.fraction;
        let difference = steps * exp2(1 - bits as i32);
        let depth = place.depth - difference;
        let is_point = depth > 0.0;
        let depth = depth.abs();
        let radii = root(place.radius_squared * (depth * (2.0 - depth)));

        let d = signed_turn(turn);
        let u = d * d;
        let chord = u * (CHORD_0 + u * (CHORD_1 + u * (CHORD_2 + u * (CHORD_3 + u * CHORD_4))));
        let sum = (place.depth + depth * place.height) + radii;
        let cost = quotient(difference * difference, sum) + radii * chord;
        // More than any distance.
        Self { i, cost: if is_point { cost } else { 4.0 } }
    }

    /// `other` where it costs less, else `self`.
    #[inline(always)]
    fn or_cheaper(self, other: Self) -> Self {
        if other.cost < self.cost { other } else { self }
    }
}

/// The number of the point of `2^bits` that is nearest to the direction of `v`.
///
/// Point N - 1 - i is point i mirrored at the equator and at a meridian: directions below the equator are mirrored so
/// first, which makes the one pole do for both.
#[inline(always)]
pub fn nearest(v: Vec3, bits: u32) -> u32 {
    let norm = l1_norm(v);
    let scaled = v * scale_to_one(norm);
    let is_mirrored = is_negative(v.z);
    let azimuth = azimuth(v, scaled);
    let turn_to = if is_mirrored { turn(last(bits)).wrapping_sub(azimuth) } else { azimuth };
    let place = Place::new(scaled, bits);
    let basis = Basis::new(place.radius_squared, bits);

    // The coordinates of `place` in the basis, whose determinant is 1 or -1.
    let across = negate_if(basis.is_even, signed_turn(turn_to));
    let number = place.depth * exp2(bits as i32 - 1) - 0.5;
    let a = whole_to_i32(small_floor(across * basis.next_step + number * basis.next_turn)) as u32;
    let b = whole_to_i32(small_floor(number * basis.turn - across * basis.step)) as u32;

    let (step, next_step) = (whole_to_u32(basis.step), whole_to_u32(basis.next_step));
    let (turn_step, next_turn_step) = (turn_of_step(step), turn_of_step(next_step));
    let i = a.wrapping_mul(step).wrapping_add(b.wrapping_mul(next_step));
    let off = turn_to.wrapping_add(SHIFT_TURN).wrapping_sub(turn(i.wrapping_add(SHIFT)));
    let i_next = i.wrapping_add(next_step);
    let off_next = off.wrapping_sub(next_turn_step);

    let near = Candidate::new(place, i, off, bits);
    let right = Candidate::new(place, i.wrapping_add(step), off.wrapping_sub(turn_step), bits);
    let up = Candidate::new(place, i_next, off_next, bits);
    let far = Candidate::new(place, i_next.wrapping_add(step), off_next.wrapping_sub(turn_step), bits);
    let best = near.or_cheaper(right).or_cheaper(up).or_cheaper(far);
    let code = (if is_mirrored { !best.i } else { best.i }) & last(bits);
    // The point nearest to +Z is the first.
    if is_usable(norm) { code } else { 0 }
}

/// Point `i` of `2^bits`, of unit length to within 2 ULP. Higher bits of `i` are ignored.
///
/// Heights are counted from the equator and depths from the pole, so that both are precise. The azimuth is the middle
/// of its unit of 2^-32 turns; from the nearest of the four horizontal axes, a float holds it to 2^-28 turns.
#[inline(always)]
pub fn point(i: u32, bits: u32) -> Vec3 {
    let i = i & last(bits);
    let is_mirrored = i >> (bits - 1) != 0;
    let from_pole = if is_mirrored { last(bits) - i } else { i };
    let unit = exp2(1 - bits as i32);
    let depth = (from_pole as i32 as f32 + 0.5) * unit;
    let height = ((last(bits - 1) - from_pole) as i32 as f32 + 0.5) * unit;
    let radius = root(depth * (2.0 - depth));

    let azimuth = turn(i);
    let quarter = azimuth.wrapping_add(1 << 29) >> 30;
    let half_turns = (2 * azimuth.wrapping_sub(quarter << 30) as i32 + 1) as f32 * exp2(-32);
    let (sine, cosine) = (radius * sin_eighth(half_turns), radius * cos_eighth(half_turns));
    let (x, y) = if quarter & 1 != 0 { (-sine, cosine) } else { (cosine, sine) };
    let is_turned = quarter & 2 != 0;
    Vec3::new(negate_if(is_turned, x), negate_if(is_turned, y), negate_if(is_mirrored, height))
}

/// Spherical Fibonacci points in `BITS` bits (16, 24 or 32): the nearest point is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Fib<const BITS: u32>;

impl<const BITS: u32> Codec for Fib<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const EXACT_AXES: bool = false;
    /// The distance of points 1, 2 and 4 from the middle of the circle through them, 156.3102 degrees over `sqrt(N)`,
    /// and the errors of rounding both directions: at most 4e-7 radians.
    const MAX_ERROR_DEG: f32 = ratio(156.310_5, (1 << (BITS / 2)) as f32) + 2.4e-5;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        nearest(v, BITS)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        point(code, BITS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// F(k).
    fn fibonacci(k: u32) -> u32 {
        (0..k).fold((0, 1), |(a, b), _| (b, u32::wrapping_add(a, b))).0
    }

    #[test]
    fn turns_are_the_product_with_64_bits() {
        let golden = (u64::from(GOLDEN_HIGH) << 32) | u64::from(GOLDEN_LOW);
        let numbers = (0..100_000u32).flat_map(|n| [n, n.wrapping_mul(0x9e37_79b1), !n, n << 16, !(n << 16)]);
        for i in numbers {
            assert_eq!(turn(i), (u64::from(i).wrapping_mul(golden) >> 32) as u32, "{i}");
            let step = i & mask(17);
            assert!(turn(step).wrapping_sub(turn_of_step(step)) <= 4, "{step}");
        }
    }

    #[test]
    fn basis_is_made_of_fibonacci_numbers() {
        for bits in [16, 24, 32] {
            for step in 0..=4000u16 {
                let radius_squared = exp2(-40) * (f32::from(step) / 100.0).exp2();
                let basis = Basis::new(radius_squared, bits);
                let area = 5f64.sqrt() * core::f64::consts::PI * 2f64.powi(bits as i32);
                let exact = (area * f64::from(radius_squared)).ln() / (2.0 * (0.5 + 1.25f64.sqrt()).ln());
                let k = (2..=25).find(|&k| basis.turn > 0.618f32.powf(k as f32 + 0.5)).unwrap();
                // Between k and k + 1, but for the logarithm's error.
                assert!((f64::from(k) + 0.5 - exact).abs() < 0.57 || (exact < 2.0 && k == 2), "{k} {exact}");
                assert_eq!([basis.step, basis.next_step], [k, k + 1].map(|k| fibonacci(k) as f32));
                assert_eq!(basis.is_even, k % 2 == 0);
            }
        }
    }

    #[test]
    fn chord_is_that_of_the_sine() {
        for n in 1..=10_000 {
            let u = (f64::from(n) / 20_000.0).powi(2);
            let coefficients = [CHORD_0, CHORD_1, CHORD_2, CHORD_3, CHORD_4].map(f64::from);
            let fitted = u * coefficients.into_iter().rev().fold(0.0, |sum, c| sum * u + c);
            let exact = 2.0 * (core::f64::consts::PI * u.sqrt()).sin().powi(2);
            assert!((fitted / exact - 1.0).abs() < 2e-6, "{u}");
        }
    }
}
