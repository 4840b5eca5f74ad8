//! Directions to test and measure with.

use crate::catalogue::Domain;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// `count` directions, uniform over the domain, rounded to f32. The same seed gives the same directions.
pub fn random_directions(domain: Domain, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    (0..count).map(|_| direction(&mut random, domain)).collect()
}

/// Archimedes: z is uniform for points uniform on the sphere.
fn direction(random: &mut impl Rng, domain: Domain) -> [f32; 3] {
    let z = match domain {
        Domain::Sphere => random.random_range(-1.0..=1.0f64),
        Domain::Hemisphere => random.random_range(0.0..=1.0f64),
    };
    let angle = random.random_range(0.0..std::f64::consts::TAU);
    let radius = (1.0 - z * z).sqrt();
    [radius * angle.cos(), radius * angle.sin(), z].map(|c| c as f32)
}

/// `count` random 32-bit codes.
pub fn random_codes(count: usize, seed: u64) -> Vec<u32> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    (0..count).map(|_| random.random()).collect()
}

/// Every triple of components that are odd in one way or another: both zeros, denormals, the ends of the range of
/// usable lengths, infinities, NaN. Axes, octant corners, diagonals and fold lines, unnormalised, are among them.
pub fn special_vectors() -> Vec<[f32; 3]> {
    const MAGNITUDES: [f32; 14] = [
        0.0,
        1e-45,
        1e-40,
        f32::MIN_POSITIVE,
        1e-30,
        1e-20,
        0.25,
        1.0 / 3.0,
        0.5,
        1.0,
        3.0,
        1e20,
        f32::MAX,
        f32::INFINITY,
    ];
    let components: Vec<f32> =
        MAGNITUDES.into_iter().flat_map(|m| [m, -m]).chain([f32::NAN, -f32::NAN]).collect();
    let mut vectors = Vec::with_capacity(components.len().pow(3));
    for &x in &components {
        for &y in &components {
            vectors.extend(components.iter().map(|&z| [x, y, z]));
        }
    }
    vectors
}

/// Directions of points halfway between lattice points of an octahedron with `m` steps an edge, where rounding has to
/// break ties; on all eight faces.
pub fn halfway_vectors(m: u32, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    (0..count)
        .map(|_| {
            let x = random.random_range(0..m);
            let y = random.random_range(0..m - x);
            let halves: u32 = random.random_range(1..4);
            let [dx, dy] = [halves & 1, halves >> 1].map(|half| half as f32 / 2.0);
            let (x, y) = (x as f32 + dx, y as f32 + dy);
            let point = [x, y, m as f32 - x - y];
            point.map(|c| if random.random() { -c } else { c })
        })
        .collect()
}
