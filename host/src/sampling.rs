//! Directions to test and measure with.

use crate::catalogue::{Domain, Element};
use glam::{DVec3, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::LazyLock;
use unitvec::direction::{MAX_NORM, MIN_NORM};

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

/// 64-bit codes whose fields are at the ends of their range, whatever their layout: every run of ones among zeros, and
/// every run of zeros among ones.
pub fn special_codes() -> Vec<u64> {
    let runs =
        (0..64).flat_map(|first| (1..=64 - first).map(move |length| (u64::MAX >> (64 - length)) << first));
    runs.flat_map(|run| [run, !run]).collect()
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

/// Inputs to trip over, the same for the CPU and for GPUs: all triples of odd components, vectors at the ends of the range
/// of usable lengths, the octahedron's fold lines, and ties with denormals beside them.
pub fn special_vectors() -> Vec<[f32; 3]> {
    [odd_triples(), ends_of_the_usable_norms(), fold_lines(), ties()].concat()
}

/// Magnitudes that are odd in one way or another: zero, denormals, the ends of the range of usable norms, infinity, and
/// what axes, octant corners and diagonals have.
const MAGNITUDES: [f32; 18] = [
    0.0,
    f32::from_bits(1),
    1e-40,
    below(f32::MIN_POSITIVE),
    f32::MIN_POSITIVE,
    below(MIN_NORM),
    MIN_NORM,
    1e-10,
    0.25,
    1.0 / 3.0,
    0.5,
    1.0,
    3.0,
    1e20,
    below(MAX_NORM),
    MAX_NORM,
    f32::MAX,
    f32::INFINITY,
];

/// The float next to a positive one, below it.
const fn below(x: f32) -> f32 {
    f32::from_bits(x.to_bits() - 1)
}

/// Every triple of [`MAGNITUDES`], of both signs, and NaN.
fn odd_triples() -> Vec<[f32; 3]> {
    let components: Vec<f32> =
        MAGNITUDES.into_iter().flat_map(|m| [m, -m]).chain([f32::NAN, -f32::NAN]).collect();
    let pairs = components.iter().flat_map(|&x| components.iter().map(move |&y| [x, y]));
    pairs.flat_map(|[x, y]| components.iter().map(move |&z| [x, y, z])).collect()
}

/// Vectors whose L1 norm is just in or just out of the usable range, with the norm in one component, two or three.
fn ends_of_the_usable_norms() -> Vec<[f32; 3]> {
    let parts = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.25, 0.25], [0.75, 0.1875, 0.0625]];
    let norms = [MIN_NORM, MAX_NORM]
        .into_iter()
        .flat_map(|norm| [below(norm), norm, f32::from_bits(norm.to_bits() + 1)]);
    let vectors = norms.flat_map(|norm| parts.map(|part| part.map(|c| c * norm)));
    vectors.flat_map(|v| in_every_place(v).flat_map(with_every_sign)).collect()
}

/// Points of the octahedron's edges, where one component is a zero of either sign.
fn fold_lines() -> Vec<[f32; 3]> {
    let zeros_and_eighths =
        [0.0, -0.0].into_iter().flat_map(|zero| (-8i8..=8).map(move |i| (zero, f32::from(i) / 8.0)));
    let edges = zeros_and_eighths.flat_map(|(zero, a)| [[zero, a, 1.0 - a.abs()], [zero, a, a.abs() - 1.0]]);
    edges.flat_map(in_every_place).collect()
}

/// Vectors of which the sum of two magnitudes is halfway between two floats, so that an exact sum of all three would
/// round as the third says: a zero or a denormal. The shortest are next to the least usable norm.
fn ties() -> Vec<[f32; 3]> {
    const HALF_ULP: f32 = f32::EPSILON / 2.0;
    const SCALES: [f32; 5] = [MIN_NORM, 2.0 * MIN_NORM, 16.0 * MIN_NORM, 1.0, 1e12];
    const THIRDS: [f32; 5] = [0.0, f32::from_bits(1), -1e-40, below(f32::MIN_POSITIVE), -f32::MIN_POSITIVE];
    let mut vectors = Vec::new();
    for (scale, third) in SCALES.into_iter().flat_map(|scale| THIRDS.map(|third| (scale, third))) {
        for large in [1.0, 1.0 + f32::EPSILON, 1.5, 2.0 - f32::EPSILON] {
            vectors.extend([HALF_ULP, -3.0 * HALF_ULP].map(|small| [large * scale, small * scale, third]));
        }
    }
    // A device that flushes denormals used to write another code for this one; above the least norm it still is a tie.
    let short = [2f32.powi(-127), f32::from_bits(0x0b5e_c650), f32::from_bits(0x0d87_a780)];
    vectors.extend([short, [short[0], short[1] * 2f32.powi(37), short[2] * 2f32.powi(37)]]);
    vectors.into_iter().flat_map(in_every_place).collect()
}

/// The six orders of components.
fn in_every_place([x, y, z]: [f32; 3]) -> impl Iterator<Item = [f32; 3]> {
    [[x, y, z], [x, z, y], [y, x, z], [y, z, x], [z, x, y], [z, y, x]].into_iter()
}

/// The eight choices of signs.
fn with_every_sign(v: [f32; 3]) -> impl Iterator<Item = [f32; 3]> {
    (0..8).map(move |signs| [0, 1, 2].map(|i| if (signs >> i) & 1 == 0 { v[i] } else { -v[i] }))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Each component takes every value that devices are known to treat in their own way, of both signs.
    #[test]
    fn special_vectors_hold_denormals_and_the_ends_of_the_range() {
        let largest_denormal = f32::from_bits(f32::MIN_POSITIVE.to_bits() - 1);
        let ends = [0.0, f32::from_bits(1), largest_denormal, f32::MIN_POSITIVE, f32::MAX, f32::INFINITY];
        let vectors = special_vectors();
        for place in 0..3 {
            for end in ends.into_iter().flat_map(|end| [end, -end]) {
                assert!(vectors.iter().any(|v| v[place].to_bits() == end.to_bits()), "{end:e} in {place}");
            }
            assert!(vectors.iter().any(|v| v[place].is_nan()));
        }
    }

    /// Two fields of 16 bits, as `oct32` has them, and three of 8: each at its least and its largest, while the others are
    /// at either end.
    #[test]
    fn special_codes_hold_the_ends_of_all_fields() {
        let codes = special_codes();
        let has = |code: u64, bits: u32| codes.iter().any(|other| other & (u64::MAX >> (64 - bits)) == code);
        for code in [0, 0xffff_ffff, 0x8000_0000, 0x7fff_0000, 0x7fff, 0x8000, 0x7fff_ffff, 0x8000_7fff] {
            assert!(has(code, 32), "{code:x}");
        }
        for code in
            [0x80, 0x7f, 0x8000, 0x7f00, 0x80_0000, 0x7f_0000, 0xff_ff7f, 0xff_7fff, 0x7f_ffff, 0x80_ffff]
        {
            assert!(has(code, 24), "{code:x}");
        }
    }
}
