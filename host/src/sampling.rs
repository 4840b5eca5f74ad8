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

/// Tangent frames without end (normal, tangent, handedness): the normals are [`random_directions`], the tangents
/// uniform about them, both rounded to f32.
pub fn random_frames(seed: u64) -> impl Iterator<Item = [f32; 7]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed ^ 1);
    random_directions(Domain::Sphere, seed).map(move |n| {
        let [nx, ny, nz] = n.map(f64::from);
        // Any vector that is not along the normal gives a first tangent, and the cross product a second.
        let first = normalize(if nx.abs() < 0.5 { [0.0, nz, -ny] } else { [nz, 0.0, -nx] });
        let second = cross([nx, ny, nz], first);
        let (sin, cos) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
        let tangent = normalize([0, 1, 2].map(|i| cos * first[i] + sin * second[i]));
        let [tx, ty, tz] = tangent.map(|c| c as f32);
        [n[0], n[1], n[2], tx, ty, tz, if random.random() { 1.0 } else { -1.0 }]
    })
}

fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// Frames of [`special_vectors`]: as normals, with their own components in another order as tangents and one of them
/// as handedness, and as tangents of an oblique normal.
pub fn special_frames() -> Vec<[f32; 7]> {
    let vectors = special_vectors().into_iter();
    vectors.flat_map(|[x, y, z]| [[x, y, z, y, z, x, z], [0.25, -0.5, 1.0, x, y, z, x]]).collect()
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
