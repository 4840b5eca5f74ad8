//! Inputs to trip over. The program of `tests/processors` has this file too, and so it uses nothing else of the host.

use unitvec::direction::{MAX_NORM, MIN_NORM};

/// Inputs to trip over, the same for the CPU and for GPUs: all triples of odd components, vectors at the ends of the range
/// of usable lengths, the octahedron's fold lines, and ties with denormals beside them.
pub fn special_vectors() -> Vec<[f32; 3]> {
    [odd_triples(), ends_of_the_usable_norms(), fold_lines(), ties()].concat()
}

/// Frames of [`special_vectors`]: as normals, with their own components in another order as tangents and one of them
/// as handedness, and as tangents of an oblique normal.
pub fn special_frames() -> Vec<[f32; 7]> {
    let vectors = special_vectors().into_iter();
    vectors.flat_map(|[x, y, z]| [[x, y, z, y, z, x, z], [0.25, -0.5, 1.0, x, y, z, x]]).collect()
}

/// Rotations of [`special_vectors`]: with a w of 0, 1 and one of their own components.
pub fn special_rotations() -> Vec<[f32; 4]> {
    let vectors = special_vectors().into_iter();
    vectors.flat_map(|[x, y, z]| [[x, y, z, 0.0], [x, y, z, 1.0], [z, x, y, x]]).collect()
}

/// Magnitudes that are odd in one way or another: zero, denormals, the ends of the range of usable norms, infinity, and
/// components of axes, octant corners and diagonals.
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

/// Vectors of which the sum of two magnitudes is halfway between two floats, so that the third, a zero or a denormal,
/// decides how an exact sum of all three rounds. The shortest are next to the least usable norm.
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
    const TWO_37: f32 = (1u64 << 37) as f32;
    let short = [0x0040_0000, 0x0b5e_c650, 0x0d87_a780].map(f32::from_bits);
    vectors.extend([short, [short[0], short[1] * TWO_37, short[2] * TWO_37]]);
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
