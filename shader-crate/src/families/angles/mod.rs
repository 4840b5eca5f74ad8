//! Longitude, and latitude or height.

pub mod cylindrical;
pub mod latlong;
pub mod spherical;
pub mod spherical_wide;

use crate::arith::{sin_cos_half_turns, without_denormals};
use crate::direction::or_z;
use glam::Vec3;

/// `v` at an L1 norm of 1, by which its squares neither overflow nor vanish, or +Z where it has no usable direction.
#[inline(always)]
fn scaled(v: Vec3) -> Vec3 {
    let (v, norm) = or_z(v);
    without_denormals(v) * (1.0 / norm)
}

/// The unit vector of a cylinder's radius and height at the angle `phi`, in half turns, about +Z. A radius of 0
/// gives zeros, not -0.
#[inline(always)]
fn around_z(radius: f32, z: f32, phi: f32) -> Vec3 {
    let turned = sin_cos_half_turns(if radius > 0.0 { phi } else { 0.0 });
    Vec3::new(radius * turned.x, radius * turned.y, z)
}
