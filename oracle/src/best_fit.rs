//! Best fit: searches for the whole vector that points nearest, and the integers of three snorm components.

use super::{angle_deg, cheapest, cross, dot, neighbourhood, normalize, raw, twos_complement};

/// The integers, of `bits` bits, in a code of three components, x lowest; `-2^(bits-1)` is the second pattern of -1.
pub fn integers(code: u64, bits: u32) -> [i64; 3] {
    let m = (1 << (bits - 1)) - 1;
    [0, 1, 2].map(|i| twos_complement(code >> (i * bits), bits).max(-m))
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
    let nearest = cheapest(all.iter(), |direction| -dot(magnitudes, **direction));
    nearest.map_or(f64::NAN, |direction| angle_deg(*direction, magnitudes))
}

/// The angle in degrees from `v` to the nearest whole vector of components up to `m`, by trial of the 9 around the
/// point where the ray of `v` meets each of the planes `max = 1, 2, ... m`.
pub fn least_error(v: [f64; 3], m: u32) -> f64 {
    let u = sorted(on_cube(v));
    let whole = (1..=m).flat_map(|length| {
        let [x, y, z] = u.map(|t| (t * f64::from(length)).round() as i64);
        neighbourhood([z, y], 1).map(move |[z, y]| [x, y, z])
    });
    let whole =
        whole.filter(|q| q.iter().all(|t| (0..=i64::from(m)).contains(t))).map(|q| q.map(|t| t as f64));
    cheapest(whole, |q| sine_squared(u, *q)).map_or(f64::NAN, |q| angle_deg(q, u))
}

/// The angle in degrees from `v` to itself scaled to a largest component of `length` and rounded.
pub fn error_at_length(v: [f64; 3], length: f64) -> f64 {
    let u = sorted(on_cube(v));
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

/// Magnitudes in order of size, the largest first.
fn sorted(mut u: [f64; 3]) -> [f64; 3] {
    u.sort_by(|a, b| b.total_cmp(a));
    u
}

fn sine_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let c = cross(a, b);
    dot(c, c) / (dot(a, a) * dot(b, b))
}

/// A vector of whole magnitudes for a direction, and how near it points: the square of the sine between them, as a
/// fraction and up to a factor of all fits to that direction.
#[derive(Clone, Copy)]
struct Fit {
    whole: [f64; 3],
    numerator: f64,
    denominator: f64,
}

impl Fit {
    fn of(u: [f64; 3], whole: [f64; 3]) -> Self {
        let c = cross(u, whole);
        Self { whole, numerator: dot(c, c), denominator: dot(whole, whole) }
    }

    fn or_nearer(self, other: Self) -> Self {
        if other.numerator * self.denominator < self.numerator * other.denominator { other } else { self }
    }
}

/// The magnitudes of `v` over the largest one.
fn on_cube(v: [f64; 3]) -> [f64; 3] {
    let max = v.iter().fold(0.0, |max: f64, t| max.max(t.abs()));
    v.map(|t| t.abs() / max)
}

/// `u`, whose largest component is 1, rounded at a length.
fn at_length(u: [f64; 3], length: u32) -> Fit {
    Fit::of(u, u.map(|t| (t * f64::from(length)).round()))
}

/// The code, in three snorms of `b` bits, of whole magnitudes with the signs of `v`.
fn code(v: [f64; 3], whole: [f64; 3], b: u32) -> u64 {
    raw::pack(std::array::from_fn(|i| whole[i].copysign(v[i])), [b; 3])
}

/// The whole vector that points nearest of all: tries the four points around the ray in each of the planes where the
/// largest component is 64 to 127; shorter vectors have multiples there.
pub fn snorm8x3_nearest(v: [f64; 3]) -> u64 {
    let u = on_cube(v);
    let axis = (0..3).find(|&i| u[i] == 1.0).unwrap_or(0);
    let turned: [f64; 3] = std::array::from_fn(|i| u[(axis + i) % 3]);
    let mut best = at_length(turned, 127);
    for length in (64..128).map(f64::from) {
        // Truncated by conversion: the standard library's floor is a call, and this is the inner loop.
        let [y, z] = [turned[1], turned[2]].map(|t| f64::from((t * length) as u32));
        for [y, z] in [[y, z], [y + 1.0, z], [y, z + 1.0], [y + 1.0, z + 1.0]] {
            best = best.or_nearer(Fit::of(turned, [length, y.min(127.0), z.min(127.0)]));
        }
    }
    code(v, std::array::from_fn(|i| best.whole[(3 + i - axis) % 3]), 8)
}

/// The code of the unit vector rounded, or of the best of the 64 greatest lengths.
pub fn snorm16x3p(v: [f64; 3]) -> u64 {
    let u = on_cube(v);
    let scanned = (32767 - 63..=32767).rev().map(|length| at_length(u, length)).reduce(Fit::or_nearer);
    let plain = Fit::of(u, normalize(v).map(|t| (t.abs() * raw::snorm_max(16)).round()));
    code(v, scanned.map_or(plain, |scanned| plain.or_nearer(scanned)).whole, 16)
}

/// Cells of the best fit table from 0 to 1: 640, but that 1 is in the last.
const TABLE_CELLS: f64 = 640.0 - 1.0 / 1024.0;

/// A length counts as better than a longer one where it leaves less than this part of the error.
const CLEARLY_LESS: f64 = 1.0 - 1.0 / 16_384.0;

/// The four lengths of a direction's cell. The first fits nine directions of the cell best in the mean; each of the
/// others is the one that leaves least of the mean error where those before it may be taken too.
fn cell_lengths(u: [f64; 3]) -> [u32; 4] {
    // Truncated by conversion.
    let [_, column, row] = sorted(u).map(|t| (t * TABLE_CELLS) as u32);
    let directions = cell_directions(column, row, TABLE_CELLS);
    let errors: Vec<[f64; 9]> = (64..=127)
        .rev()
        .map(|length| {
            directions.map(|u| {
                let fit = at_length(u, length);
                (fit.numerator / fit.denominator).sqrt()
            })
        })
        .collect();
    let with = |left: [f64; 9], more: [f64; 9]| std::array::from_fn(|i| left[i].min(more[i]));
    let mut left = [f64::INFINITY; 9];
    [(); 4].map(|()| {
        let total = |j: usize| with(left, errors[j]).iter().sum::<f64>();
        let best = (1..64).fold((0, total(0)), |best, j| {
            let total = total(j);
            if total < best.1 * CLEARLY_LESS { (j, total) } else { best }
        });
        left = with(left, errors[best.0]);
        127 - best.0 as u32
    })
}

/// The code at the best of the lengths of the direction's cell.
pub fn snorm8x3p(v: [f64; 3]) -> u64 {
    let u = on_cube(v);
    let fits = cell_lengths(u).map(|length| at_length(u, length));
    code(v, fits.into_iter().fold(fits[0], Fit::or_nearer).whole, 8)
}

/// Kaplanyan's method: the code at one length for the direction's cell.
pub fn crytek_bfn24(v: [f64; 3]) -> u64 {
    let u = on_cube(v);
    code(v, at_length(u, cell_lengths(u)[0]).whole, 8)
}
