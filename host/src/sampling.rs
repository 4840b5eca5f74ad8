//! Directions to test and measure with.

use crate::catalogue::Domain;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Directions without end, uniform over the domain, rounded to f32. The same seed gives the same directions.
pub fn random_directions(domain: Domain, seed: u64) -> impl Iterator<Item = [f32; 3]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    std::iter::repeat_with(move || direction(&mut random, domain))
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

/// Random 64-bit codes without end; narrower ones take their low bits.
pub fn random_codes(seed: u64) -> impl Iterator<Item = u64> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    std::iter::repeat_with(move || random.random())
}

/// Calls `each` with chunks of at most `size` of the first `count` items.
///
/// # Errors
/// The first error of `each`.
pub fn in_chunks<T, E>(
    mut items: impl Iterator<Item = T>,
    count: usize,
    size: usize,
    mut each: impl FnMut(&[T]) -> Result<(), E>,
) -> Result<(), E> {
    let mut chunk = Vec::with_capacity(count.min(size));
    let mut left = count;
    while left > 0 {
        chunk.clear();
        chunk.extend(items.by_ref().take(left.min(size)));
        if chunk.is_empty() {
            break;
        }
        left -= chunk.len();
        each(&chunk)?;
    }
    Ok(())
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
