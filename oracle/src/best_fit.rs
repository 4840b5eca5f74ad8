//! Best fit: searches for the whole vector that points nearest, and the integers of three snorm components.

use super::{angle_deg, cross, dot, normalize, twos_complement};

/// The integers, of `bits` bits, in a code of three components, x lowest; `-2^(bits-1)` is the second pattern of -1.
pub fn integers(code: u64, bits: u32) -> [i32; 3] {
    let m = (1 << (bits - 1)) - 1;
    [0, 1, 2].map(|i| twos_complement((code >> (i * bits)) as u32, bits).max(-m))
}

/// The unit vectors of the whole vectors of components from 0 to `m`, but for the zero vector.
pub fn all_directions(m: u32) -> Vec<[f64; 3]> {
    let side = m + 1;
    (1..side * side * side)
        .map(|i| normalize([i % side, i / side % side, i / side / side].map(f64::from)))
        .collect()
}

/// The angle in degrees from `v` to the nearest of [`all_directions`], by trial of every one.
pub fn least_error_of_all(v: [f64; 3], all: &[[f64; 3]]) -> f64 {
    let magnitudes = normalize(v.map(f64::abs));
    let mut best = (f64::NEG_INFINITY, [0.0; 3]);
    for &direction in all {
        let cosine = dot(magnitudes, direction);
        if cosine > best.0 {
            best = (cosine, direction);
        }
    }
    angle_deg(best.1, magnitudes)
}

/// The angle in degrees from `v` to the nearest whole vector of components up to `m`, by trial of the 9 around the
/// point where the ray of `v` meets each of the planes `max = 1, 2, ... m`.
pub fn least_error(v: [f64; 3], m: u32) -> f64 {
    let u = on_cube(v);
    let mut best = (f64::INFINITY, [0.0; 3]);
    for length in 1..=m {
        let length = f64::from(length);
        for step in 0..9 {
            let steps = [0.0, f64::from(step % 3) - 1.0, f64::from(step / 3) - 1.0];
            let q = [0, 1, 2].map(|i| (u[i] * length).round() + steps[i]);
            if q.iter().all(|&t| (0.0..=f64::from(m)).contains(&t)) {
                let sine = sine_squared(u, q);
                if sine < best.0 {
                    best = (sine, q);
                }
            }
        }
    }
    angle_deg(best.1, u)
}

/// The angle in degrees from `v` to itself scaled to a largest component of `length` and rounded.
pub fn error_at_length(v: [f64; 3], length: f64) -> f64 {
    let u = on_cube(v);
    angle_deg(u, u.map(|t| (t * length).round()))
}

/// The survey's plain snorm components: the unit vector, rounded.
pub fn plain_error(v: [f64; 3], m: f64) -> f64 {
    let unit = normalize(v);
    angle_deg(unit, unit.map(|t| (t * m).round()))
}

/// Nine directions of a cell of the table, three by three, in the middles of its ninths: `mid / max` and `min / max`
/// times `cells` are its column and row.
pub fn cell_directions(column: u32, row: u32, cells: f64) -> [[f64; 3]; 9] {
    std::array::from_fn(|i| {
        let at = |cell: u32, i: usize| (f64::from(cell) + (i as f64 + 0.5) / 3.0) / cells;
        [1.0, at(column, i / 3), at(row, i % 3)]
    })
}

/// Magnitudes in order of size, the largest 1.
fn on_cube(v: [f64; 3]) -> [f64; 3] {
    let mut u = v.map(f64::abs);
    u.sort_by(|a, b| b.total_cmp(a));
    u.map(|t| t / u[0])
}

fn sine_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let c = cross(a, b);
    dot(c, c) / (dot(a, a) * dot(b, b))
}
