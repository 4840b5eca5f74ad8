//! Spherical coordinates.

use super::{Oracle, largest, snorm};
use std::f64::consts::PI;

/// The survey's spherical coordinates and its codes' bits. Positions are in half turns: the
/// first `2 theta / pi - 1`, the second `phi / pi`.
pub struct Spherical;

impl Oracle for Spherical {
    fn position(v: [f64; 3]) -> [f64; 2] {
        [2.0 * colatitude(v) - 1.0, azimuth(v)]
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        at((e[0] + 1.0) / 2.0, e[1])
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        let [i, j] = Self::unpack(code, bits);
        Self::direction([snorm(i, largest(bits)), j as f64 / steps(bits)])
    }

    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let [theta, phi] = Self::position(v);
        Self::pack([theta * largest(bits), phi * steps(bits)].map(|t| t.round() as i64), bits)
    }
}

/// The steps of phi, `2^(b-1)`, in half a turn.
pub fn steps(bits: u32) -> f64 {
    2f64.powi(bits as i32 / 2 - 1)
}

/// The angle from +Z in half turns.
pub fn colatitude(v: [f64; 3]) -> f64 {
    v[0].hypot(v[1]).atan2(v[2]) / PI
}

/// The angle from +X towards +Y in half turns.
pub fn azimuth(v: [f64; 3]) -> f64 {
    v[1].atan2(v[0]) / PI
}

/// The unit vector of a colatitude and an azimuth in half turns.
pub fn at(colatitude: f64, azimuth: f64) -> [f64; 3] {
    let ((sin, cos), (y, x)) = ((colatitude * PI).sin_cos(), (azimuth * PI).sin_cos());
    [sin * x, sin * y, cos]
}

/// The distance of a point from a position, on a circle of `period` steps.
pub fn around(position: f64, point: f64, period: f64) -> f64 {
    let off = (position - point).rem_euclid(period);
    off.min(period - off)
}

/// The distances, in steps of theta and phi, of the code's point from the position of `v`. At a pole phi does not
/// count.
pub fn steps_off(v: [f64; 3], code: u64, bits: u32) -> [f64; 2] {
    let (m, half_turn) = (largest(bits), steps(bits));
    let ([t, phi], point) = (Spherical::position(v), Spherical::unpack(code, bits));
    let [i, j] = point.map(|i| i as f64);
    let phi_off = around(phi * half_turn, j, 2.0 * half_turn);
    [(t * m - i).abs(), if i.abs() < m { phi_off } else { 0.0 }]
}

/// Half the diagonal of a cell at the equator, in degrees: by `cos d = cos a cos b` it exceeds all others.
pub fn bound_deg(bits: u32) -> f64 {
    (90.0 / largest(bits) / 2.0).hypot(180.0 / steps(bits) / 2.0)
}
