//! The hemi-octahedral mapping of the hemisphere z >= 0.

use super::{Oracle, largest};

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
