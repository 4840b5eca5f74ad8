//! The rule for usable directions, on which every codec's handling of bad input rests.

use crate::arith::{is_within, max};
use glam::Vec3;

/// Least L1 norm of a usable direction: 2^-64.
///
/// Far enough above the denormals (under 2^-126) that whether a device flushes them to zero changes no code, and far
/// below any result of arithmetic on geometry.
pub const MIN_NORM: f32 = f32::from_bits((127 - 64) << 23);

/// L1 norms from here on give no direction: 2^100. Below it `1 / norm` is a normal number.
pub const MAX_NORM: f32 = f32::from_bits((127 + 100) << 23);

/// `|x| + |y| + |z|`.
#[inline(always)]
pub fn l1_norm(v: Vec3) -> f32 {
    (v.x.abs() + v.y.abs()) + v.z.abs()
}

/// True where a vector of this L1 norm has a usable direction: `MIN_NORM <= l1_norm < MAX_NORM`. False for zero, infinity
/// and NaN.
#[inline(always)]
pub fn is_usable(l1_norm: f32) -> bool {
    is_within(l1_norm, MIN_NORM, MAX_NORM)
}

/// `v` and its L1 norm, or +Z and 1 where `v` has no usable direction.
#[inline(always)]
pub fn or_z(v: Vec3) -> (Vec3, f32) {
    let norm = l1_norm(v);
    if is_usable(norm) { (v, norm) } else { (Vec3::Z, 1.0) }
}

/// `v`, moved up to the equator if below it (z of at least 0), its L1 norm, and whether that and `v` have a usable
/// direction.
#[inline(always)]
pub fn upper(v: Vec3) -> (Vec3, f32, bool) {
    let upper = Vec3::new(v.x, v.y, max(v.z, 0.0));
    let norm = l1_norm(upper);
    let usable = l1_norm(v).to_bits() < MAX_NORM.to_bits() && norm.to_bits() >= MIN_NORM.to_bits();
    (upper, norm, usable)
}
