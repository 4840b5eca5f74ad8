//! Icosahedral lattices.

use super::spherical::at;
use super::{LatLong, Oracle, Summary, cheapest, chord_squared, cross, difference, dot, normalize};
use std::sync::OnceLock;

/// The mapping. Positions are colatitude and azimuth in half turns.
pub struct Ico;

impl Oracle for Ico {
    fn position(v: [f64; 3]) -> [f64; 2] {
        LatLong::position(v)
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        at(e[0], e[1])
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        decode(code, bits)
    }
}

/// The lattice of a width: steps along an edge, and N of the weights `i (N - i)`.
pub fn lattice(bits: u32) -> (i64, i64) {
    find_lattice(bits).unwrap_or_else(|| panic!("ico{bits} is not defined"))
}

/// The lattice of a width, where there is one.
pub fn find_lattice(bits: u32) -> Option<(i64, i64)> {
    Some(match bits {
        16 => (80, 400),
        24 => (1294, 6019),
        32 => (20724, 96391),
        _ => return None,
    })
}

/// The first code of the faces in octants.
pub fn octants(bits: u32) -> i64 {
    let (n, _) = lattice(bits);
    6 * n * (n + 2)
}

/// The last code that is written.
pub fn last(bits: u32) -> u64 {
    let (n, _) = lattice(bits);
    (10 * n * n + 7) as u64
}

/// The twelve vertices: cyclic permutations of (0, +-1, +-p).
pub fn vertices() -> Vec<[f64; 3]> {
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    signs.iter().flat_map(|&[s, t]| [[0.0, s, t * p], [t * p, 0.0, s], [s, t * p, 0.0]]).collect()
}

/// A face: its vertices.
pub type Face = [[f64; 3]; 3];

/// The twenty faces: the triples of vertices that are neighbours, whose scalar products are p.
pub fn faces() -> &'static [Face] {
    static FACES: OnceLock<Vec<Face>> = OnceLock::new();
    FACES.get_or_init(|| {
        let v = vertices();
        let touch = |i: usize, j: usize| dot(v[i], v[j]) > 1.0;
        let pairs = (0..v.len()).flat_map(|i| (0..i).map(move |j| [i, j])).filter(|&[i, j]| touch(i, j));
        let triples = pairs.flat_map(|[i, j]| (0..j).map(move |k| [i, j, k]));
        triples.filter(|&[i, j, k]| touch(j, k) && touch(k, i)).map(|face| face.map(|i| v[i])).collect()
    })
}

/// The unit vector of a lattice point: a number for each vertex of a face.
pub fn point(face: Face, numbers: [i64; 3], bits: u32) -> [f64; 3] {
    let (_, warp) = lattice(bits);
    let weights = numbers.map(|i| (i * (warp - i)) as f64);
    normalize(std::array::from_fn(|axis| (0..3).map(|k| weights[k] * face[k][axis]).sum()))
}

/// A face and the numbers of its vertices, of a code: of a face that straddles a plane, the base's end on the negative
/// side, that on the positive side, and the apex; of a face in an octant, the vertices in the planes x = 0, z = 0 and
/// y = 0.
pub fn place(code: u64, bits: u32) -> (Face, [i64; 3]) {
    let (n, _) = lattice(bits);
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let code = code.min(last(bits)) as i64;
    if code < octants(bits) {
        let (line, column) = (code / (n + 2), code % (n + 2));
        let (block, row) = (line / n, line % n);
        let base = if block % 2 == 0 { 1.0 } else { -1.0 };
        let is_first = column <= n - row;
        let apex = if is_first { 1.0 } else { -1.0 };
        // For y = 0 the base is at +-z, the apex towards +-x. For the other planes x, y, z become y, z, x once or
        // twice.
        let turns = block as usize / 2;
        let face = [[0.0, -1.0, base * p], [0.0, 1.0, base * p], [apex * p, 0.0, base]];
        let face = face.map(|v| std::array::from_fn(|axis| v[(axis + 3 - turns) % 3]));
        let (steps, along) = if is_first { (row, column) } else { (n - row, column - (n + 1 - row)) };
        return (face, [n - steps - along, along, steps]);
    }
    let (line, column) = ((code - octants(bits)) / (n - 1), (code - octants(bits)) % (n - 1));
    let (block, row) = (line / (n - 2), line % (n - 2));
    let is_first = column < n - 2 - row;
    let signs = [is_first, block % 2 == 0, block / 2 == 0].map(|plus| if plus { 1.0 } else { -1.0 });
    let (a, c) = if is_first { (column + 1, row + 1) } else { (column - (n - 2 - row) + 1, n - 2 - row) };
    let face = [[0.0, 1.0, p], [1.0, p, 0.0], [p, 0.0, 1.0]];
    (face.map(|v| std::array::from_fn(|axis| v[axis] * signs[axis])), [a, n - a - c, c])
}

/// The unit vector that a code stands for.
pub fn decode(code: u64, bits: u32) -> [f64; 3] {
    let (face, numbers) = place(code, bits);
    point(face, numbers, bits)
}

/// The coordinates of a direction on a face: up to a factor, the factors of the vertices that make it up. Of one
/// sign on the face and its opposite, not all positive on others.
fn flat(face: Face, v: [f64; 3]) -> [f64; 3] {
    let handed = dot(face[0], cross(face[1], face[2]));
    std::array::from_fn(|k| dot(v, cross(face[(k + 1) % 3], face[(k + 2) % 3])) / handed)
}

/// The face that a direction is on: where the least coordinate is greatest.
pub fn face_of(v: [f64; 3]) -> Face {
    let least = |&face: &Face| flat(face, v).into_iter().fold(f64::INFINITY, f64::min);
    *faces().iter().max_by(|a, b| least(a).total_cmp(&least(b))).unwrap_or(&faces()[0])
}

/// The place of a direction on a face, in steps: the root, by bisection, of the sum of `i` with `i (N - i)` in
/// proportion to the flat coordinates.
pub fn position(face: Face, v: [f64; 3], bits: u32) -> [f64; 3] {
    let (n, warp) = lattice(bits);
    let (n, warp) = (n as f64, warp as f64);
    let m = flat(face, v).map(|t| t.max(0.0));
    let most = m.into_iter().fold(0.0, f64::max);
    let at = |scale: f64| {
        m.map(|t| {
            let w = t / most * scale;
            // The lesser root of i (N - i) = w.
            2.0 * w / (warp + (warp * warp - 4.0 * w).max(0.0).sqrt())
        })
    };
    let (mut low, mut high) = (0.0, n * (warp - n));
    for _ in 0..64 {
        let middle = (low + high) / 2.0;
        if at(middle).iter().sum::<f64>() < n { low = middle } else { high = middle }
    }
    at(high)
}

/// The unit vector of the lattice point nearest in angle to `v`: of all of its face whose numbers are within 2 of its
/// position.
pub fn nearest(v: [f64; 3], bits: u32) -> [f64; 3] {
    let (n, _) = lattice(bits);
    let face = face_of(v);
    let [a, b, _] = position(face, v, bits).map(|t| t.floor() as i64);
    let unit = normalize(v);
    let around = (a - 1..=a + 2).flat_map(|i| (b - 1..=b + 2).map(move |j| [i, j, n - i - j]));
    let points =
        around.filter(|numbers| numbers.iter().all(|&t| t >= 0)).map(|numbers| point(face, numbers, bits));
    cheapest(points, |point| chord_squared(*point, unit)).unwrap_or(unit)
}

/// The centre of the circumcircle of the unit vectors of three lattice points, a unit vector, and its radius in degrees.
pub fn circumcircle(corners: [[f64; 3]; 3]) -> ([f64; 3], f64) {
    let [a, b, c] = corners;
    let axis = normalize(cross(difference(b, a), difference(c, a)));
    let centre = if dot(axis, a) < 0.0 { axis.map(|t| -t) } else { axis };
    (centre, super::angle_deg(centre, a))
}

/// Mean and maximum of the error of hexagonal cells of equal area on a plane of the sphere's, as many as there are
/// patterns of `bits` bits: no code falls below them by more than the effect of curvature.
pub fn bound_deg(bits: u32) -> Summary {
    let area = 4.0 * std::f64::consts::PI / 2f64.powi(bits as i32);
    let max = (area * 2.0 / 27f64.sqrt()).sqrt().to_degrees();
    Summary { mean: max * (1.0 / 3.0 + 3f64.ln() / 4.0), max }
}
