//! The hemisphere on the disk.

use crate::arith::{
    NEGLIGIBLE, atan_octant_ratio, coefficients, dot, horizontal_length, inverse_root, quotient, reciprocal,
    root, signed_quotient,
};
use core::fmt::Debug;
use core::hash::Hash;
use glam::{Vec2, Vec3};

/// A point of the unit disk's quadrant x, y >= 0.
#[derive(Clone, Copy)]
pub struct Disk {
    /// The point.
    pub point: Vec2,
    /// Its distance from the middle. Only [`Projection::to_disk`] gives it.
    pub radius: f32,
    /// `1 - radius^2`: how far it is inside the rim, to a small relative error where the [`SquareMap`](super::SquareMap) needs that.
    pub rim: f32,
}

/// A projection of the hemisphere to the unit disk, on the octant of positive components.
pub trait Projection: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// Number of the projection: 0, 1, 2.
    const INDEX: u32;

    /// The disk point of the direction of `v`, whose components are not negative and have the sum 1.
    fn to_disk(v: Vec3) -> Disk;

    /// The unit vector of a disk point. Where `rim` is slightly negative the vector is of unit length to the
    /// second order.
    fn from_disk(disk: Disk) -> Vec3;
}

/// Stereographic projection: conformal, and the cheapest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Stereo;

impl Projection for Stereo {
    const INDEX: u32 = 0;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let scale = reciprocal(root(dot(v, v)) + v.z);
        Disk {
            point: Vec2::new(v.x * scale, v.y * scale),
            radius: horizontal_length(v) * scale,
            rim: 2.0 * v.z * scale,
        }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        // Divisions rather than a product with the reciprocal: its rounding would take the length beyond 2 ULP.
        let half_rim = 0.5 * disk.rim;
        let over_half_sum = |half| signed_quotient(half, 1.0 - half_rim);
        Vec3::new(over_half_sum(disk.point.x), over_half_sum(disk.point.y), over_half_sum(half_rim))
    }
}

/// Lambert's azimuthal equal-area projection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Eqarea;

impl Projection for Eqarea {
    const INDEX: u32 = 1;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let length = root(dot(v, v));
        let scale = inverse_root(length * (length + v.z));
        Disk {
            point: Vec2::new(v.x * scale, v.y * scale),
            radius: horizontal_length(v) * scale,
            rim: signed_quotient(v.z, length),
        }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        let scale = root(1.0 + disk.rim);
        Vec3::new(disk.point.x * scale, disk.point.y * scale, disk.rim)
    }
}

coefficients! {
    /// `sin(pi r / 2) / r = 1 + c (SINC_0 + c (SINC_1 + c (SINC_2 + c SINC_3)))` with `c = 1 - r^2`, for r in \[0, 1\]:
    /// absolute error 7.6e-9 before rounding. Exact on the rim.
    pub SINC_0 = 0.49999976, SINC_1 = 0.066577174, SINC_2 = 0.0040679215, SINC_3 = 0.00015146394;

    /// `cos(pi r / 2) / (1 - r^2) = 1 + w (COSC_0 + w (COSC_1 + w (COSC_2 + w COSC_3)))` with `w = r^2`, for r in
    /// \[0, 1\]: absolute error 1e-9 before rounding. Exact in the middle.
    pub COSC_0 = -0.23370051, COSC_1 = 0.019968653, COSC_2 = -0.0008935995, COSC_3 = 2.3629505e-5;
}

/// Azimuthal equidistant projection: the distance from the middle is the angle from the pole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Eqdist;

impl Projection for Eqdist {
    const INDEX: u32 = 2;

    #[inline(always)]
    fn to_disk(v: Vec3) -> Disk {
        let rho = horizontal_length(v);
        let flat = rho > v.z;
        let (shorter, longer) = if flat { (v.z, rho) } else { (rho, v.z) };
        // The smaller of the radius and 1 - radius, both of which thus have a small relative error.
        let part = 0.5 * atan_octant_ratio(shorter, longer);
        let rest = 1.0 - part;
        let (radius, inside) = if flat { (rest, part) } else { (part, rest) };
        let ratio = quotient(radius, rho);
        let scale = if rho > NEGLIGIBLE { ratio } else { 0.0 };
        Disk { point: Vec2::new(v.x * scale, v.y * scale), radius, rim: inside * (1.0 + radius) }
    }

    #[inline(always)]
    fn from_disk(disk: Disk) -> Vec3 {
        let c = disk.rim;
        let scale = 1.0 + c * (SINC_0 + c * (SINC_1 + c * (SINC_2 + c * SINC_3)));
        let w = 1.0 - c;
        let z = c + c * (w * (COSC_0 + w * (COSC_1 + w * (COSC_2 + w * COSC_3))));
        Vec3::new(disk.point.x * scale, disk.point.y * scale, z)
    }
}
