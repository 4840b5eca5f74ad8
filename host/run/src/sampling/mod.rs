//! Directions to test and measure with.

mod special;

use glam::{DVec3, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::LazyLock;
use unitvec_catalogue::{Domain, Element};

pub use special::{special_frames, special_rotations, special_vectors};

/// The floats of random vectors of the domain, of random frames or rotations, without end.
pub fn random_elements(element: Element, domain: Domain, seed: u64) -> Box<dyn Iterator<Item = f32> + Send> {
    match element {
        Element::Vector => Box::new(random_directions(domain, seed).flatten()),
        Element::Frame => Box::new(random_frames(seed).flatten()),
        Element::Rotation => Box::new(random_rotations(seed).flatten()),
    }
}

/// The floats of [`special_vectors`], [`special_frames`] or [`special_rotations`].
pub fn special_elements(element: Element) -> &'static [f32] {
    static VECTORS: LazyLock<Vec<[f32; 3]>> = LazyLock::new(special_vectors);
    static FRAMES: LazyLock<Vec<[f32; 7]>> = LazyLock::new(special_frames);
    static ROTATIONS: LazyLock<Vec<[f32; 4]>> = LazyLock::new(special_rotations);
    match element {
        Element::Vector => VECTORS.as_flattened(),
        Element::Frame => FRAMES.as_flattened(),
        Element::Rotation => ROTATIONS.as_flattened(),
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

/// Rotations without end, uniform (Shoemake 1992, "Uniform Random Rotations": two circles whose radii have uniform squares),
/// as quaternions x, y, z, w, rounded to f32.
pub fn random_rotations(seed: u64) -> impl Iterator<Item = [f32; 4]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed ^ 2);
    std::iter::repeat_with(move || {
        let part = random.random_range(0.0..=1.0f64);
        let mut on_circle = |square: f64| {
            let (sin, cos) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
            [square.sqrt() * sin, square.sqrt() * cos]
        };
        let ([x, y], [z, w]) = (on_circle(part), on_circle(1.0 - part));
        [x, y, z, w].map(|c| c as f32)
    })
}

/// Normalises by division: glam's `normalize` multiplies by the reciprocal, which rounds once more.
fn unit(v: DVec3) -> DVec3 {
    v / v.length()
}

/// Random 64-bit codes without end; narrower ones take their low bits.
pub fn random_codes(seed: u64) -> impl Iterator<Item = u64> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    std::iter::repeat_with(move || random.random())
}

/// Codes as they are stored, of so many bytes each, little endian.
pub fn stored(codes: &[u64], bytes: usize) -> Vec<u8> {
    codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(bytes)).collect()
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
