//! Sums, products and quotients as two floats, and unit vectors as exact as floats are, without fused multiplication.

use super::{dot, exp2, integer_part, inverse_root, small_floor, whole_to_i32};
use glam::Vec3;

/// `x` without the lower 12 of its 24 bits: a product of two such numbers is exact, and so is the rest.
#[inline(always)]
pub(crate) fn upper_half(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xffff_f000)
}

/// `a + b`, rounded, and the remainder, exactly (Knuth 1969).
#[inline(always)]
pub(crate) fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let b_in_sum = sum - a;
    let rest = (a - (sum - b_in_sum)) + (b - b_in_sum);
    (sum, rest)
}

/// The remainder that rounding takes from the product of `a` and `b`, exactly (Dekker 1971): `a b - product`, where
/// `product` is `a * b` and no partial product is denormal.
#[inline(always)]
pub(crate) fn product_rest(a: f32, b: f32, product: f32) -> f32 {
    let (a_upper, b_upper) = (upper_half(a), upper_half(b));
    let (a_lower, b_lower) = (a - a_upper, b - b_upper);
    (((a_upper * b_upper - product) + a_upper * b_lower) + a_lower * b_upper) + a_lower * b_lower
}

/// A whole number on the lattice, and how far beyond it a position lies: 0 to 1.
#[derive(Clone, Copy)]
pub(crate) struct Coordinate {
    pub(crate) whole: i32,
    pub(crate) fraction: f32,
}

/// The coordinate `(2^(bits-1) - 1) x / (sum + rest)`, for `x` of 0 to `sum`, and the quotient's first float.
/// `reciprocal` is `1 / sum`.
///
/// With the quotient `q + r`, all but the last of the summands `2^(bits-1) q - q + (2^(bits-1) - 1) r` are exact, and
/// the last is some steps at most.
#[inline(always)]
pub(crate) fn coordinate(x: f32, sum: f32, rest: f32, reciprocal: f32, bits: u32) -> (Coordinate, f32) {
    let quotient = x * reciprocal;
    let product = quotient * sum;
    let remainder = ((x - product) - product_rest(quotient, sum, product)) - quotient * rest;
    let steps = exp2(bits as i32 - 1);

    let first = quotient * steps;
    let whole = integer_part(first);
    let beyond = ((first - whole as f32) - quotient) + (remainder * reciprocal) * steps;
    let carry = small_floor(beyond);
    (Coordinate { whole: whole + whole_to_i32(carry), fraction: beyond - carry }, quotient)
}

/// The unit vector of `upper + lower`, whose components are 0 or more. Each component is the float nearest to the exact
/// one: half an ULP off at most, and 2^-33 for the arithmetic.
///
/// The components of `upper` are whole numbers of up to 12 bits, whose squares have a sum of up to 2^24; those of
/// `lower` are at most 1. So all products with a reciprocal length of 12 bits are exact, or as good as it. The error of
/// its square, `t`, is small and known to 2^-33, and `1 / sqrt(1 + t)` is `1 - t/2 + 3/8 t^2` to 2^-34.
#[inline(always)]
pub(crate) fn normalize_parts(upper: Vec3, lower: Vec3) -> Vec3 {
    let squares = dot(upper, upper);
    let other_squares = 2.0 * dot(upper, lower) + dot(lower, lower);
    let estimate = inverse_root(squares + other_squares);
    let reciprocal = f32::from_bits((estimate.to_bits() + 0x800) & 0xffff_f000);

    let scale = reciprocal * reciprocal;
    let (scale_upper, squares_upper) = (upper_half(scale), upper_half(squares));
    let (scale_lower, squares_lower) = (scale - scale_upper, squares - squares_upper);
    let t = ((squares_upper * scale_upper - 1.0)
        + (squares_upper * scale_lower + squares_lower * scale_upper))
        + (squares_lower * scale_lower + other_squares * scale);
    let correction = t * (t * 0.375 - 0.5);

    let (upper, lower) = (upper * reciprocal, lower * reciprocal);
    upper + (lower + (upper + lower) * correction)
}
