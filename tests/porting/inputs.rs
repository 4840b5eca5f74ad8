//! The inputs of `vectors/`, the same for all codecs. `vectors/README.md` describes them.

use super::CASES;
use unitvec::direction::{MAX_NORM, MIN_NORM};
use unitvec_oracle::{cross, normalize};
use unitvec_tests::directions::Rng;

/// Inputs with something special about them, then random unit vectors.
pub fn vectors() -> Vec<[f32; 3]> {
    let mut rng = Rng::new(1);
    let random = std::iter::repeat_with(|| narrow(direction(&mut rng)));
    special().into_iter().chain(random).take(CASES).collect()
}

/// The inputs for frames. Random tangents are perpendicular to the normals.
pub fn frames() -> Vec<[f32; 7]> {
    let mut rng = Rng::new(2);
    let random = std::iter::repeat_with(|| {
        let normal = direction(&mut rng);
        let tangent = normalize(cross(normal, direction(&mut rng)));
        let handedness = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
        frame(narrow(normal), narrow(tangent), handedness)
    });
    special_frames().into_iter().chain(random).take(CASES).collect()
}

/// The inputs for rotations: the special vectors with three values of w, then random unit quaternions.
pub fn rotations() -> Vec<[f32; 4]> {
    let mut rng = Rng::new(3);
    let random = std::iter::repeat_with(|| {
        let q = [(); 4].map(|()| rng.range(-1.0, 1.0));
        let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        q.map(|c| (c / length) as f32)
    });
    let special = special().into_iter().flat_map(|[x, y, z]| [[x, y, z, 0.0], [x, y, z, 1.0], [z, x, y, -x]]);
    special.step_by(2).chain(random).take(CASES).collect()
}

/// A unit vector: three random numbers from -1 to 1, divided by the vector's length.
fn direction(rng: &mut Rng) -> [f64; 3] {
    normalize([(); 3].map(|()| rng.range(-1.0, 1.0)))
}

fn narrow(v: [f64; 3]) -> [f32; 3] {
    v.map(|t| t as f32)
}

fn special() -> Vec<[f32; 3]> {
    let corners = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [0.0, 3.0, 4.0]];
    let corners = corners.into_iter().flat_map(in_all_orders_and_signs);
    corners.chain(zeros()).chain(lengths()).chain(beside_one()).collect()
}

/// The different vectors that have these components in any order and with any signs.
fn in_all_orders_and_signs([x, y, z]: [f32; 3]) -> Vec<[f32; 3]> {
    let mut vectors: Vec<[f32; 3]> = Vec::new();
    for order in [[x, y, z], [y, z, x], [z, x, y], [x, z, y], [z, y, x], [y, x, z]] {
        for signs in 0..8 {
            let v = [0, 1, 2]
                .map(|i| if (signs >> i) & 1 == 1 && order[i] != 0.0 { -order[i] } else { order[i] });
            if !vectors.contains(&v) {
                vectors.push(v);
            }
        }
    }
    vectors
}

/// The zero vector, with all signs.
fn zeros() -> impl Iterator<Item = [f32; 3]> {
    (0..8).map(|signs| [0, 1, 2].map(|i| if (signs >> i) & 1 == 1 { -0.0 } else { 0.0 }))
}

/// Vectors of odd lengths: denormal, the least and the greatest that a direction is taken from and their neighbours, huge,
/// infinite, NaN.
fn lengths() -> impl Iterator<Item = [f32; 3]> {
    let lengths = [
        f32::from_bits(1),
        1e-40,
        f32::MIN_POSITIVE.next_down(),
        f32::MIN_POSITIVE,
        MIN_NORM.next_down(),
        MIN_NORM,
        MAX_NORM / 2.0,
        MAX_NORM.next_down(),
        MAX_NORM,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
    ];
    lengths.into_iter().flat_map(|t| [[t, 0.0, 0.0], [0.0, -t, 0.0], [0.0, 0.0, -t], [t, -t, t]])
}

/// A small number, or none, beside 1.
fn beside_one() -> impl Iterator<Item = [f32; 3]> {
    let power = |exponent| 2f32.powi(exponent);
    let small =
        [-0.0, f32::from_bits(1), -1e-40, f32::MIN_POSITIVE, power(-30), -power(-24), power(-13), -power(-8)];
    small.into_iter().flat_map(|t| [[1.0, t, -t], [t, 1.0, t], [-t, t, -1.0]])
}

fn special_frames() -> Vec<[f32; 7]> {
    let [x, z, oblique] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.25, -0.5, 1.0]];
    let axes = in_all_orders_and_signs(x);
    let mut frames: Vec<[f32; 7]> = Vec::new();
    for &normal in &axes {
        for &tangent in axes.iter().filter(|axis| (0..3).all(|i| axis[i] == 0.0 || normal[i] == 0.0)) {
            frames.extend([1.0, -1.0].map(|handedness| frame(normal, tangent, handedness)));
        }
    }
    let odd = [0.0, f32::NAN, f32::MIN_POSITIVE, 1e-40, f32::INFINITY];
    frames.extend(odd.into_iter().flat_map(|t| [t, -t]).map(|handedness| frame(z, x, handedness)));
    frames.extend(special().into_iter().step_by(3).map(|normal| frame(normal, [0.5, 0.25, -1.0], 1.0)));
    frames.extend(special().into_iter().skip(1).step_by(3).map(|tangent| frame(oblique, tangent, -1.0)));
    frames
}

fn frame([nx, ny, nz]: [f32; 3], [tx, ty, tz]: [f32; 3], handedness: f32) -> [f32; 7] {
    [nx, ny, nz, tx, ty, tz, handedness]
}
