//! Spherical Fibonacci points, from Keinert et al. 2015, "Spherical Fibonacci Mapping".

use super::{Oracle, cheapest, chord_squared, cross, difference, dot, normalize};
use crate::spherical::{at, azimuth, colatitude};
use std::f64::consts::{PI, TAU};

/// The points, numbered from +Z to -Z. Positions are a height and an azimuth in half turns.
pub struct Fib;

impl Oracle for Fib {
    fn position(v: [f64; 3]) -> [f64; 2] {
        [normalize(v)[2], azimuth(v)]
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        at(e[0].acos() / PI, e[1])
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        point(code as i64, bits)
    }

    /// The nearest point.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        nearest(v, bits)
    }
}

/// The golden ratio's fraction, `(sqrt(5) - 1) / 2`, in 128 bits.
const GOLDEN: u128 = 0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c834;

/// The azimuth of point `i` in turns, 0 to 1.
pub fn turn(i: i64) -> f64 {
    ((i as u128).wrapping_mul(GOLDEN) >> 75) as f64 / 2f64.powi(53)
}

/// Their eq. 1: point `i` of `2^bits`.
pub fn point(i: i64, bits: u32) -> [f64; 3] {
    let depth = (2.0 * i as f64 + 1.0) / 2f64.powi(bits as i32);
    let (radius, (y, x)) = ((depth * (2.0 - depth)).sqrt(), (TAU * turn(i)).sin_cos());
    [radius * x, radius * y, 1.0 - depth]
}

/// The code of the nearest point: among the 16 around the cell of the lattice, whose basis is that of the paper's
/// section 3, and the first and last 64.
pub fn nearest(v: [f64; 3], bits: u32) -> u64 {
    let (v, count) = (normalize(v), 2f64.powi(bits as i32));
    let from_pole = (colatitude([v[0], v[1], v[2].abs()]) * PI / 2.0).sin().powi(2);
    let number = if v[2] < 0.0 { count * (1.0 - from_pole) } else { count * from_pole } - 0.5;
    let around = azimuth(v) / 2.0;

    let ratio = (1.0 + 5f64.sqrt()) / 2.0;
    let zone = (5f64.sqrt() * PI * count * 4.0 * from_pole * (1.0 - from_pole)).ln() / (2.0 * ratio.ln());
    let k = zone.floor().max(2.0) as i32;
    let [f, g] = [k, k + 1].map(|k| (ratio.powi(k) / 5f64.sqrt()).round());
    let [turn_f, turn_g] = [k, k + 1].map(|k| -(-ratio).powi(-k));
    let determinant = turn_f * g - turn_g * f;
    let a = ((around * g - number * turn_g) / determinant).floor();
    let b = ((number * turn_f - around * f) / determinant).floor();

    let around_cell = (0..16).map(|n| (a as i64 + n % 4 - 1) * f as i64 + (b as i64 + n / 4 - 1) * g as i64);
    let ends = (0..64).flat_map(|i| [i, count as i64 - 1 - i]).filter(|_| from_pole * count < 32.0);
    let candidates = around_cell.chain(ends).filter(|i| (0..count as i64).contains(i));
    cheapest(candidates, |i| chord_squared(v, point(*i, bits))).map_or(0, |i| i as u64)
}

/// The place farthest from all points: the middle of the circle through points 1, 2 and 4.
pub fn hole(bits: u32) -> [f64; 3] {
    let [a, b, c] = [1, 2, 4].map(|i| point(i, bits));
    let middle = normalize(cross(difference(b, a), difference(c, a)));
    if dot(middle, a) > 0.0 { middle } else { middle.map(|t| -t) }
}

/// The greatest angle in degrees between a direction and its nearest point.
pub fn bound_deg(bits: u32) -> f64 {
    super::angle_deg(hole(bits), point(1, bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::angle_deg;

    /// Directions that are even over the sphere, and those within some points of a pole: the search over all 2^16
    /// points finds none nearer. No angle exceeds the bound.
    #[test]
    fn nearest_is_the_nearest_of_all() {
        let points: Vec<[f64; 3]> = (0..1 << 16).map(|i| point(i, 16)).collect();
        for n in 0..400 {
            let (depth, turn) = (0.005 * f64::from(n) + 0.0011, 0.7548776 * f64::from(n));
            let depth = if n < 200 { depth } else { depth * 1e-4 };
            let radius = (depth * (2.0 - depth)).sqrt();
            let height = if n % 2 == 0 { 1.0 - depth } else { depth - 1.0 };
            let v = [radius * (TAU * turn).cos(), radius * (TAU * turn).sin(), height];
            let cosine = |p: &[f64; 3]| dot(*p, v);
            let best = points.iter().max_by(|a, b| cosine(a).total_cmp(&cosine(b))).unwrap();
            let ours = angle_deg(v, Fib::decode(nearest(v, 16), 16));
            assert!(ours <= angle_deg(v, *best) + 1e-9 && ours <= bound_deg(16), "{v:?}");
        }
    }

    /// Codes of all widths, at even distances and at both ends, are their own points' nearest.
    #[test]
    fn points_are_found() {
        for bits in [16, 24, 32] {
            let last = u64::MAX >> (64 - bits);
            for code in (0..10_000).flat_map(|n| [n * (last / 10_000), n, last - n]) {
                assert_eq!(nearest(Fib::decode(code, bits), bits), code);
            }
        }
    }
}
