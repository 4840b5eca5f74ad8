//! Sums and products as two floats, exactly, without fused multiplication.

/// `x` without the lower 12 of its 24 bits: a product of two such numbers is exact, and so is what they leave.
#[inline(always)]
pub(crate) fn upper_half(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xffff_f000)
}

/// `a + b`, rounded, and what the rounding took from it, exactly (Knuth 1969).
#[inline(always)]
pub(crate) fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let b_in_sum = sum - a;
    let rest = (a - (sum - b_in_sum)) + (b - b_in_sum);
    (sum, rest)
}

/// What the rounding takes from the product of `a` and `b`, exactly (Dekker 1971): `a b - product`, where `product`
/// is `a * b` and no partial product is denormal.
#[inline(always)]
pub(crate) fn product_rest(a: f32, b: f32, product: f32) -> f32 {
    let (a_upper, b_upper) = (upper_half(a), upper_half(b));
    let (a_lower, b_lower) = (a - a_upper, b - b_upper);
    (((a_upper * b_upper - product) + a_upper * b_lower) + a_lower * b_upper) + a_lower * b_lower
}
