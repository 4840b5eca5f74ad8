//! Seeded random directions, and inputs to trip over.

use glam::Vec3;
use std::f64::consts::TAU;

/// SplitMix64 (Steele, Lea and Flood 2014): small, and the same everywhere.
pub struct Rng(u64);

impl Rng {
    /// A generator whose sequence `seed` determines.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A uniform number of `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A uniform number of `[low, high)`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A uniform unit vector with z in `[low, high)`. By Archimedes, z and the angle about its axis are uniform; both
    /// are taken in `f64` and the vector is rounded to `f32`.
    fn zone(&mut self, low: f64, high: f64) -> Vec3 {
        let (z, angle) = (self.range(low, high), self.range(0.0, TAU));
        let r = (1.0 - z * z).sqrt();
        narrow([r * angle.cos(), r * angle.sin(), z])
    }
}

/// Unit vectors, uniform on the sphere.
pub fn sphere(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| rng.zone(-1.0, 1.0))
}

/// Unit vectors, uniform on the hemisphere z >= 0.
pub fn hemisphere(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| rng.zone(0.0, 1.0))
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
        let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
        narrow(p.map(|t| t / length))
    })
}

/// Codes over the whole range of 32 bits: `count` at even distances, and `count` at random.
pub fn codes32(seed: u64, count: u32) -> impl Iterator<Item = u32> {
    let mut rng = Rng::new(seed);
    let stride = u32::MAX / count;
    (0..count).map(move |i| i * stride).chain((0..count).map(move |_| rng.bits() as u32))
}

/// Every code of `bits` bits if there are up to 2^24, else [`codes32`] with `count / 2` of each kind.
pub fn codes(bits: u32, seed: u64, count: u32) -> Box<dyn Iterator<Item = u32>> {
    if bits <= 24 { Box::new(0..1 << bits) } else { Box::new(codes32(seed, count / 2)) }
}

/// The six unit vectors of the axes: +X, +Y, +Z, -X, -Y, -Z.
pub const AXES: [Vec3; 6] = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];

/// Inputs at the corners of arithmetic and of the octahedron: all triples of zeros, ones, denormals, infinities,
/// NaN and huge and tiny numbers, of both signs, and points of the fold lines.
pub fn special_inputs() -> Vec<[f32; 3]> {
    let magnitudes = [
        0.0,
        1.0,
        0.5,
        f32::from_bits(1),
        1e-40,
        f32::MIN_POSITIVE,
        1e-35,
        LEAST_NORM.next_down(),
        LEAST_NORM,
        1e-20,
        1e30,
        END_OF_NORMS.next_down(),
        END_OF_NORMS,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
    ];
    let scalars: Vec<f32> = magnitudes.iter().flat_map(|&t| [t, -t]).collect();
    let mut inputs = Vec::new();
    for &x in &scalars {
        for &y in &scalars {
            inputs.extend(scalars.iter().map(|&z| [x, y, z]));
        }
    }
    // The folds lie in the coordinate planes: one component a zero, of either sign, the others on a grid.
    for zero in [0.0, -0.0] {
        for i in -8i8..=8 {
            let (a, b) = (f32::from(i) / 8.0, 1.0 - f32::from(i).abs() / 8.0);
            for b in [b, -b] {
                inputs.extend([[zero, a, b], [b, zero, a], [a, b, zero]]);
            }
        }
    }
    inputs.extend([[3.0, -4.0, 12.0], [1e10, 2e10, -3e10], [-7e-10, 1e-12, -1e-11]]);
    inputs
}

/// 2^-64, the least L1 norm of a vector with a direction.
pub const LEAST_NORM: f32 = f32::from_bits((127 - 64) << 23);

/// 2^100, the least L1 norm of a vector that is too long to have a direction.
pub const END_OF_NORMS: f32 = f32::from_bits((127 + 100) << 23);

/// Whether the contract of [`unitvec::Codec`] asks for the direction: for an L1 norm in `[2^-64, 2^100)`. `None`
/// where the norm's rounding in `f32` decides.
pub fn usable(v: [f32; 3]) -> Option<bool> {
    let norm: f64 = v.iter().map(|&t| f64::from(t).abs()).sum();
    let limits = [LEAST_NORM, END_OF_NORMS].map(f64::from);
    let open = limits.iter().any(|limit| (norm / limit - 1.0).abs() <= f64::from(f32::EPSILON));
    (!open).then(|| (limits[0]..limits[1]).contains(&norm))
}

/// To `f32`, each component rounded to nearest.
fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|t| t as f32))
}
