//! Directions to test and measure with.

use crate::catalogue::{Domain, Element};
use glam::{DVec3, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::LazyLock;

/// The floats of random vectors of the domain, or of random frames, without end.
pub fn random_elements(element: Element, domain: Domain, seed: u64) -> Box<dyn Iterator<Item = f32> + Send> {
    match element {
        Element::Vector => Box::new(random_directions(domain, seed).flatten()),
        Element::Frame => Box::new(random_frames(seed).flatten()),
    }
}

/// The floats of [`special_vectors`], or of [`special_frames`].
pub fn special_elements(element: Element) -> &'static [f32] {
    static VECTORS: LazyLock<Vec<[f32; 3]>> = LazyLock::new(special_vectors);
    static FRAMES: LazyLock<Vec<[f32; 7]>> = LazyLock::new(special_frames);
    match element {
        Element::Vector => VECTORS.as_flattened(),
        Element::Frame => FRAMES.as_flattened(),
    }
}

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
    random_directions(Domain::Sphere, seed).map(move |normal| {
        let n = Vec3::from(normal).as_dvec3();
        // Any vector that is not along the normal gives a first tangent, and the cross product a second.
        let first = unit(n.cross(if n.x.abs() < 0.5 { DVec3::X } else { DVec3::NEG_Y }));
        let (sin, cos) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
        let tangent = unit(cos * first + sin * n.cross(first)).as_vec3();
        let handedness = if random.random() { 1.0 } else { -1.0 };
        [normal[0], normal[1], normal[2], tangent.x, tangent.y, tangent.z, handedness]
    })
}

/// By division: glam's `normalize` multiplies by the reciprocal, which rounds once more.
fn unit(v: DVec3) -> DVec3 {
    v / v.length()
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
/// break ties; on all eight faces, without end.
pub fn halfway_vectors(m: u32, seed: u64) -> impl Iterator<Item = [f32; 3]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    std::iter::repeat_with(move || {
        let x = random.random_range(0..m);
        let y = random.random_range(0..m - x);
        let halves: u32 = random.random_range(1..4);
        let [dx, dy] = [halves & 1, halves >> 1].map(|half| half as f32 / 2.0);
        let (x, y) = (x as f32 + dx, y as f32 + dy);
        let point = [x, y, m as f32 - x - y];
        point.map(|c| if random.random() { -c } else { c })
    })
}
