//! Vectors, with sums in a stated order.

use super::{inverse_root, inverse_root_near, is_within, ratio, root};
use glam::Vec3;

/// `a . b`, summed from x to z.
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    (a.x * b.x + a.y * b.y) + a.z * b.z
}

/// `v` at unit length, to within 2 ULP. `v . v` must be a normal number.
#[inline(always)]
pub fn normalize(v: Vec3) -> Vec3 {
    v * inverse_root(dot(v, v))
}

/// [`normalize`] for a point of an octahedron's lattice, which is cheaper on GPUs: `v` has the L1 norm `m` and the constant `unit`
/// is `(m + 1) / 2`, or all three are doubled or halved. For an `m` of `2^k - 1` from 7 to 2^17 the length is between `unit` and its double.
#[inline(always)]
pub(crate) fn normalize_octahedral(v: Vec3, m: f32, unit: f32) -> Vec3 {
    let square = dot(v, v);
    v * if is_within(m, 7.0, 131_072.0) { inverse_root_near(square, unit) } else { inverse_root(square) }
}

/// The distance of `v` from the z axis. An underflow of `v.x^2 + v.y^2` does not matter beside `|v.z|` of about 1.
#[inline(always)]
pub fn horizontal_length(v: Vec3) -> f32 {
    root(v.x * v.x + v.y * v.y)
}

/// An upper bound of `sqrt(d^2 + e^2)`: steps of Heron's method from above stay above.
pub(crate) const fn hypotenuse_bound(d: f32, e: f32) -> f32 {
    let square = d * d + e * e;
    let first = d + e;
    let second = 0.5 * (first + ratio(square, first));
    let third = 0.5 * (second + ratio(square, second));
    0.5 * (third + ratio(square, third))
}
