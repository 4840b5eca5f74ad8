//! Seeded random directions.

use crate::tested::narrow;
use glam::Vec3;
use std::f64::consts::TAU;
use unitvec::direction::{MAX_NORM, MIN_NORM};

pub use unitvec_processors::Rng;

/// A uniform unit vector with z in `[low, high)`. By Archimedes, z and the angle about its axis are uniform; both are taken
/// in `f64` and the vector is rounded to `f32`.
fn zone(rng: &mut Rng, low: f64, high: f64) -> Vec3 {
    let (z, angle) = (rng.range(low, high), rng.range(0.0, TAU));
    let r = (1.0 - z * z).sqrt();
    narrow([r * angle.cos(), r * angle.sin(), z])
}

/// Unit vectors, uniform on the sphere.
pub fn sphere(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| zone(&mut rng, -1.0, 1.0))
}

/// Unit vectors, uniform on the hemisphere z >= 0.
pub fn hemisphere(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| zone(&mut rng, 0.0, 1.0))
}

/// Vectors that keep to the coordinate planes and axes, where octahedra have their edges and the unfolded square
/// its border: uniform ones, some components of which are made a hundred times smaller. Of any length.
pub fn near_planes(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| {
        let choice = rng.bits();
        Vec3::from_array(std::array::from_fn(|i| if (choice >> i) & 1 == 0 { v[i] } else { v[i] * 0.01 }))
    })
}

/// Unit vectors around the middles of the octants, by up to `radius` on the octahedron along each axis.
pub fn near_octant_middles(seed: u64, count: usize, radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let [x, y] = [(); 2].map(|()| 1.0 / 3.0 + rng.range(-radius, radius));
        let (p, signs) = ([x, y, 1.0 - x - y], rng.bits());
        let p: [f64; 3] = std::array::from_fn(|i| if (signs >> i) & 1 == 0 { p[i] } else { -p[i] });
        narrow(unitvec_oracle::normalize(p))
    })
}

/// Unit vectors with two magnitudes that are equal or nearly so: at the edges and corners of a cube.
pub fn near_diagonals(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| {
        let t = v.y * (1.0 + rng.range(-1.0, 1.0) as f32 * 2f32.powi(-((rng.bits() % 26) as i32)));
        let near =
            [Vec3::new(t, v.y, v.z), Vec3::new(t, v.x, v.y), Vec3::new(v.x, v.y, t), Vec3::new(v.y, t, v.y)];
        near[(rng.bits() % 4) as usize].normalize()
    })
}

/// The six unit vectors of the axes: +X, +Y, +Z, -X, -Y, -Z.
pub const AXES: [Vec3; 6] = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];

/// True if the contract of [`unitvec::Codec`] asks for the direction: for an L1 norm in `[2^-64, 2^100)`. `None` where
/// the norm's rounding in `f32` decides.
pub fn usable(v: Vec3) -> Option<bool> {
    let norm: f64 = v.to_array().iter().map(|&t| f64::from(t).abs()).sum();
    let limits = [MIN_NORM, MAX_NORM].map(f64::from);
    let open = limits.iter().any(|limit| (norm / limit - 1.0).abs() <= f64::from(f32::EPSILON));
    (!open).then(|| (limits[0]..limits[1]).contains(&norm))
}

/// Any three floats: of any bits if `any`, else of exponents that are close together, so that the directions are all over
/// the sphere.
pub fn any_vector(rng: &mut Rng, any: bool) -> Vec3 {
    let exponent = 20 + rng.bits() as u32 % 212;
    let bits = |bits: u32| if any { bits } else { (bits & 0x81ff_ffff) + (exponent << 23) };
    Vec3::from_array([(); 3].map(|()| f32::from_bits(bits(rng.bits() as u32))))
}

/// Unit vectors within `radius` of `centre` along each axis.
pub fn around(seed: u64, count: usize, centre: [f64; 3], radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| narrow(unitvec_oracle::normalize(centre.map(|t| t + rng.range(-radius, radius)))))
}
