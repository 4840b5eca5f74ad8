//! Longitude, and latitude or height.

pub mod cylindrical;
pub mod latlong;
pub mod spherical;
pub mod spherical_wide;

use crate::arith::{
    LEAST_X, LEAST_Y, atan_quarter, from_diagonal, is_negative, max, min, negate_if, negate_positive,
    quotient, scale_to_one, with_sign,
};
use glam::Vec3;

/// The magnitudes of the components of `v`, of an L1 norm of `norm`, scaled by a power of two to an L1 norm of 1 to 2,
/// by which their squares neither overflow nor vanish. Unspecified without a usable direction.
#[inline(always)]
fn scaled(v: Vec3, norm: f32) -> Vec3 {
    let p = v.abs() * scale_to_one(norm);
    Vec3::new(max(p.x, LEAST_X), max(p.y, LEAST_Y), p.z)
}

/// The angle of (x, y) from +X in quarter turns, 0 to 1. Neither is negative, and not both are 0.
///
/// Error: at most 1.7e-7, most of it [`atan_quarter`]'s.
#[inline(always)]
fn quarter(y: f32, x: f32) -> f32 {
    let part = atan_quarter(quotient(min(x, y), max(x, y)));
    if y > x { 1.0 - part } else { part }
}

/// The angle of a vector from +X in quarter turns, 0 to 2. x and y are its magnitudes; it is on the side of +X or, if
/// `left`, of -X.
#[inline(always)]
fn half_turn(y: f32, x: f32, left: bool) -> f32 {
    let angle = quarter(y, x);
    if left { 2.0 - angle } else { angle }
}

/// The azimuth of `v`, in quarter turns, -2 to 2. `p` is [`scaled`] of `v`.
#[inline(always)]
fn azimuth(v: Vec3, p: Vec3) -> f32 {
    negate_if(is_negative(v.y), half_turn(p.y, p.x, is_negative(v.x)))
}

/// The unit vector of a cylinder's radius and height at the angle of `quarters` quarter turns, -2 to 2, about +Z. Zeros
/// are +0.
#[inline(always)]
fn around_z(radius: f32, z: f32, quarters: f32) -> Vec3 {
    let ahead = 1.0 - quarters.abs();
    let e = from_diagonal(0.5 - ahead.abs());
    let (x, y) = ((e.x - e.y) * radius, (e.x + e.y) * radius);
    Vec3::new(with_sign(x, ahead), negate_positive(quarters < 0.0, y), z)
}
