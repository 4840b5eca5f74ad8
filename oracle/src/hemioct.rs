//! The hemi-octahedral mapping of the hemisphere z >= 0.

use super::oct::tangent_squared;
use super::{Oracle, cheapest, largest, neighbourhood};

/// The hemi-oct mapping (survey, listing 6) and its codes' bits.
pub struct HemiOct;

impl Oracle for HemiOct {
    /// Survey, listing 6 (`float32x3_to_hemioct`).
    fn position(v: [f64; 3]) -> [f64; 2] {
        let norm = v[0].abs() + v[1].abs() + v[2];
        let p = [v[0] / norm, v[1] / norm];
        [p[0] + p[1], p[0] - p[1]]
    }

    /// Survey, listing 6 (`hemioct_to_float32x3`), before the normalisation. On the equator z can come out as a
    /// rounding error; of either sign, it is within the error of `f64`.
    fn direction(e: [f64; 2]) -> [f64; 3] {
        let temp = [(e[0] + e[1]) * 0.5, (e[0] - e[1]) * 0.5];
        [temp[0], temp[1], 1.0 - temp[0].abs() - temp[1].abs()]
    }

    /// Below the equator, the horizontal part; +Z if there is none.
    fn domain(v: [f64; 3]) -> [f64; 3] {
        match v {
            [0.0, 0.0, _] => [0.0, 0.0, 1.0],
            [x, y, z] => [x, y, z.max(0.0)],
        }
    }
}

/// The maximal error in degrees, at sample spacing `eps = 1 / m`, by the argument of Meyer's eq. 10.
///
/// Half a step on both axes of the turned square is `(eps/2, 0, -eps/2)` or `(0, eps/2, -eps/2)` on the octahedron,
/// of length `eps / sqrt(2)`, and subtends the largest angle at the middle of the octant, `1 / sqrt(3)` from the
/// origin: `sqrt(3/2) eps`.
pub fn bound_deg(bits: u32) -> f64 {
    (1.5f64.sqrt() / largest(bits)).to_degrees()
}

/// The code nearest in angle to the direction of `v`, by trial of the 7 x 7 lattice points around its position.
pub fn nearest_in_neighbourhood(v: [f64; 3], bits: u32) -> u64 {
    let (v, m) = (HemiOct::domain(v), largest(bits));
    let centre = HemiOct::position(v).map(|t| (t * m).round() as i64);
    let around = neighbourhood(centre, 3).filter(|point| point.iter().all(|i| i.abs() <= m as i64));
    let vector = |point: [i64; 2]| HemiOct::direction(point.map(|i| i as f64 / m));
    HemiOct::pack(cheapest(around, |point| tangent_squared(v, vector(*point))).unwrap_or(centre), bits)
}
