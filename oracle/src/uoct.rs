//! The octahedral mapping with unorm coordinates.

use super::oct::tangent_squared;
use super::{Oct, Oracle, cheapest, neighbourhood, normalize};

/// The largest integer of the unorms of codes of `bits` bits.
pub fn most(bits: u32) -> i64 {
    (1 << (bits / 2)) - 1
}

/// The unit vector of the integers of a code (survey, section 1.2, eq. 2, and listing 2). In whole numbers, twice as large.
fn direction([x, y]: [i64; 2], bits: u32) -> [f64; 3] {
    let m = most(bits);
    let [x, y] = [2 * x - m, 2 * y - m];
    let z = m - x.abs() - y.abs();
    let sign = |i: i64| if i >= 0 { 1 } else { -1 };
    let folded = if z < 0 { [(m - y.abs()) * sign(x), (m - x.abs()) * sign(y), z] } else { [x, y, z] };
    normalize(folded.map(|i| i as f64))
}

/// The unit vector that a code stands for.
pub fn decode(code: u64, bits: u32) -> [f64; 3] {
    let low = 1 << (bits / 2);
    direction([(code % low) as i64, (code / low % low) as i64], bits)
}

/// The code nearest in angle to the direction of `v`, by trial of the 9 x 9 lattice points around its position. The corners
/// are all -Z: of these, the one of the largest integers.
pub fn nearest(v: [f64; 3], bits: u32) -> u64 {
    let m = most(bits);
    let centre = Oct::position(v).map(|t| ((t * 0.5 + 0.5) * m as f64).round() as i64);
    let around = neighbourhood(centre, 4).filter(|point| point.iter().all(|i| (0..=m).contains(i)));
    let [x, y] = cheapest(around, |point| tangent_squared(v, direction(*point, bits))).unwrap_or(centre);
    let [x, y] = if [x, y] == [0, 0] { [m, m] } else { [x, y] };
    x as u64 | (y as u64) << (bits / 2)
}

/// The maximal error in degrees of the code nearest in angle: Meyer's eq. 11 for steps of `2 / (2^b - 1)`.
pub fn bound_deg(bits: u32) -> f64 {
    (2f64.sqrt() * 2.0 / most(bits) as f64).to_degrees()
}

/// The error of +Z in degrees: between four points, half a step off in x and in y.
pub fn error_of_z_deg(bits: u32) -> f64 {
    (0.5f64.sqrt() / (most(bits) as f64 / 2.0 - 1.0)).atan().to_degrees()
}
