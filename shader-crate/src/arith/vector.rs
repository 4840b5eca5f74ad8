//! Vectors, with sums in a stated order.

use super::{inverse_root, root};
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

/// The distance of `v` from the z axis. An underflow of `v.x^2 + v.y^2` does not matter beside `|v.z|` of about 1.
#[inline(always)]
pub fn horizontal_length(v: Vec3) -> f32 {
    root(v.x * v.x + v.y * v.y)
}
