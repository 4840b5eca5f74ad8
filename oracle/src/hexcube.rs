//! The hexagonal lattices on a cube's faces.

use super::{cheapest, chord_squared, normalize};

/// The lattice of a face, about its middle.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// Half columns to the last point of even rows, an even number; odd rows end a half column before.
    pub columns: i64,
    /// Rows to the last, an even number.
    pub rows: i64,
    /// Half columns and rows to the face's edges.
    pub edges: [f64; 2],
}

/// The lattice of a width.
pub fn lattice(bits: u32) -> Lattice {
    find_lattice(bits).unwrap_or_else(|| panic!("hexcube{bits} is not defined"))
}

/// The lattice of a width, where there is one.
pub fn find_lattice(bits: u32) -> Option<Lattice> {
    let (columns, rows, beyond) = match bits {
        16 => (96, 56, [0.08, 0.53]),
        24 => (1552, 900, [0.005, 0.5]),
        32 => (24778, 14444, [0.025, 0.5]),
        _ => return None,
    };
    Some(Lattice { columns, rows, edges: [columns as f64 + beyond[0], rows as f64 + beyond[1]] })
}

impl Lattice {
    /// The points of a face: rows of `columns + 1` points, with rows of one less between them.
    pub fn points(&self) -> i64 {
        (self.rows + 1) * (self.columns + 1) + self.rows * self.columns
    }

    /// True where a face has the point.
    pub fn has(&self, [i, j]: [i64; 2]) -> bool {
        (i + j) % 2 == 0 && i.abs() <= self.columns && j.abs() <= self.rows
    }
}

/// The last code that is written.
pub fn last(bits: u32) -> u64 {
    (6 * lattice(bits).points() - 1) as u64
}

/// The face of a code, twice the axis and 1 if negative, and the point's half column and row about the middle.
pub fn place(code: u64, bits: u32) -> (usize, [i64; 2]) {
    let of = lattice(bits);
    let code = code.min(last(bits)) as i64;
    let (face, number) = (code / of.points(), code % of.points());
    let (pair, rest) = (number / (2 * of.columns + 1), number % (2 * of.columns + 1));
    let is_odd = rest > of.columns;
    let [row, column] =
        if is_odd { [2 * pair + 1, 2 * (rest - of.columns) - 1] } else { [2 * pair, 2 * rest] };
    (face as usize, [column - of.columns, row - of.rows])
}

/// The axes along which a face's columns and rows are counted.
fn axes(face: usize) -> [usize; 2] {
    [[1, 2], [0, 2], [0, 1]][face / 2]
}

/// The unit vector at u and v on a face: the inverse of the warp `u = 25 X / (17 + 8 |X|)`.
pub fn direction(face: usize, uv: [f64; 2]) -> [f64; 3] {
    let mut v = [0.0; 3];
    v[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
    for (axis, t) in axes(face).into_iter().zip(uv) {
        v[axis] = 17.0 * t / (25.0 - 8.0 * t.abs());
    }
    normalize(v)
}

/// The unit vector of a face's point.
pub fn point(face: usize, [i, j]: [i64; 2], bits: u32) -> [f64; 3] {
    let [across, along] = lattice(bits).edges;
    direction(face, [i as f64 / across, j as f64 / along])
}

/// The unit vector that a code stands for.
pub fn decode(code: u64, bits: u32) -> [f64; 3] {
    let (face, place) = place(code, bits);
    point(face, place, bits)
}

/// The face of a direction, that of its largest component, the last one if several are equal.
pub fn face_of(v: [f64; 3]) -> usize {
    let axis = (0..3).max_by(|&a, &b| v[a].abs().total_cmp(&v[b].abs())).unwrap_or(0);
    2 * axis + usize::from(v[axis] < 0.0)
}

/// The place of a direction on a face that it crosses, in half columns and rows about the middle.
pub fn position(v: [f64; 3], face: usize, bits: u32) -> [f64; 2] {
    let [a, b] = axes(face).map(|axis| v[axis] / v[face / 2].abs());
    let [across, along] = lattice(bits).edges;
    [(a, across), (b, along)].map(|(t, edge)| 25.0 * t / (17.0 + 8.0 * t.abs()) * edge)
}

/// The unit vector of a face's point nearest in angle to `v`, of those up to 3 half columns and 2 rows away.
pub fn nearest_on(v: [f64; 3], face: usize, bits: u32) -> Option<[f64; 3]> {
    let of = lattice(bits);
    let [x, y] = position(v, face, bits).map(|t| t.round() as i64);
    let unit = normalize(v);
    let around = (x - 3..=x + 3).flat_map(|i| (y - 2..=y + 2).map(move |j| [i, j]));
    let points = around.filter(|&place| of.has(place)).map(|place| point(face, place, bits));
    cheapest(points, |point| chord_squared(*point, unit))
}

/// The unit vector of the point nearest in angle to `v` on its face.
pub fn nearest(v: [f64; 3], bits: u32) -> [f64; 3] {
    nearest_on(v, face_of(v), bits).unwrap_or(v)
}

/// The unit vector of the point nearest in angle to `v` on all faces.
pub fn nearest_of_all(v: [f64; 3], bits: u32) -> [f64; 3] {
    let faces = (0..3).map(|axis| 2 * axis + usize::from(v[axis] < 0.0)).filter(|&face| v[face / 2] != 0.0);
    let points = faces.filter_map(|face| nearest_on(v, face, bits));
    cheapest(points, |point| chord_squared(*point, normalize(v))).unwrap_or(v)
}
