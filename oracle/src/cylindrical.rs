//! Cylindrical coordinates.

use super::spherical::{around, azimuth};
use super::{Oracle, largest, length};
use std::f64::consts::PI;

/// The article's `(atan2(y, x) / pi, z)` and its codes' bits.
pub struct Cylindrical;

impl Oracle for Cylindrical {
    fn position(v: [f64; 3]) -> [f64; 2] {
        [azimuth(v), v[2] / length(v)]
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        let (radius, (y, x)) = ((1.0 - e[1] * e[1]).sqrt(), (e[0] * PI).sin_cos());
        [radius * x, radius * y, e[1]]
    }
}

/// The distances, in steps of phi and z, of the code's point from the position of `v`. At a pole phi does not count.
pub fn steps_off(v: [f64; 3], code: u64, bits: u32) -> [f64; 2] {
    let m = largest(bits);
    let ([phi, z], point) = (Cylindrical::position(v), Cylindrical::unpack(code, bits));
    let [j, k] = point.map(|i| i as f64);
    [if k.abs() < m { around(phi * m, j, 2.0 * m) } else { 0.0 }, (z * m - k).abs()]
}

/// The greatest error in degrees: half a step of z off a pole.
pub fn bound_deg(bits: u32) -> f64 {
    (1.0 - 0.5 / largest(bits)).acos().to_degrees()
}
