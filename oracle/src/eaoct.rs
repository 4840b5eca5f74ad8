//! The equal-area octahedral mapping of the sphere.

use super::oct::{Oct, nearest_around};
use super::{Oracle, largest, sign_not_zero, snorm};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Clarberg's map, and codes whose bits are those of [`Oct`].
pub struct EaOct;

/// Clarberg 2008, section 2: r = sqrt(1 - |z|) and phi = 2/pi atan(|y| / |x|) of a direction. By half angles r is
/// sqrt(2) times the sine of half the angle from the pole.
pub fn polar(v: [f64; 3]) -> [f64; 2] {
    let from_pole = v[0].hypot(v[1]).atan2(v[2].abs());
    [SQRT_2 * (from_pole / 2.0).sin(), v[1].abs().atan2(v[0].abs()) / FRAC_PI_2]
}

/// The ring of a code's point, and its number there from the x axis.
pub fn ring_point(code: u64, bits: u32) -> [i64; 2] {
    let m = largest(bits) as i64;
    let [x, y] = EaOct::unpack(code, bits).map(|i| i.abs().min(m));
    if x + y > m { [2 * m - x - y, m - x] } else { [x + y, y] }
}

/// The code of the `place`-th point of a ring, in the octant of `v`.
pub fn ring_code(v: [f64; 3], [ring, place]: [i64; 2], bits: u32) -> u64 {
    let m = largest(bits) as i64;
    let p = if v[2] < 0.0 { [m - place, m - (ring - place)] } else { [ring - place, place] };
    let sign = |t: f64| if t < 0.0 { -1 } else { 1 };
    EaOct::pack([sign(v[0]) * p[0], sign(v[1]) * p[1]], bits)
}

impl Oracle for EaOct {
    fn position(v: [f64; 3]) -> [f64; 2] {
        let [r, phi] = polar(v);
        let p = [r - r * phi, r * phi];
        let p = if v[2] < 0.0 { [1.0 - p[1], 1.0 - p[0]] } else { p };
        [p[0] * sign_not_zero(v[0]), p[1] * sign_not_zero(v[1])]
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        let [x, y] = e.map(f64::abs);
        let lower = x + y > 1.0;
        let [u, v] = if lower { [1.0 - y, 1.0 - x] } else { [x, y] };
        let r = u + v;
        // Each from its own end, so that both axes are exact.
        let (sine, cosine) =
            if r > 0.0 { ((FRAC_PI_2 * v / r).sin(), (FRAC_PI_2 * u / r).sin()) } else { (0.0, 1.0) };
        let from_axis = r * (2.0 - r * r).sqrt();
        let z = 1.0 - r * r;
        [
            from_axis * cosine * sign_not_zero(e[0]),
            from_axis * sine * sign_not_zero(e[1]),
            if lower { -z } else { z },
        ]
    }

    fn unpack(code: u64, bits: u32) -> [i64; 2] {
        Oct::unpack(code, bits)
    }

    fn pack(point: [i64; 2], bits: u32) -> u64 {
        Oct::pack(point, bits)
    }

    /// The nearest point on the nearest ring.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let [r, phi] = polar(v);
        let ring = (r * largest(bits)).round();
        ring_code(v, [ring, (phi * ring).round()].map(|t| t as i64), bits)
    }
}

/// The code nearest in angle to the direction of `v`, by trial of the 7 x 7 lattice points around its position.
pub fn nearest_in_neighbourhood(v: [f64; 3], bits: u32) -> u64 {
    let m = largest(bits);
    let direction = |point: [i64; 2]| EaOct::direction(point.map(|i| snorm(i, m)));
    EaOct::pack(nearest_around::<EaOct>(v, bits, direction), bits)
}

/// The maximal error in degrees of the nearest point on the nearest ring: from midway between two points of ring 1, out
/// by half a ring.
pub fn fast_bound_deg(bits: u32) -> f64 {
    let half_turn_sine = (PI / 8.0).sin();
    ((2.0 * (0.25 + 6.0 * half_turn_sine * half_turn_sine)).sqrt() / largest(bits)).to_degrees()
}

/// The maximal error in degrees of the nearest code: half a cell's diagonal at a pole, where rings are `sqrt(2) / m`
/// apart and a ring's points `sqrt(2) pi/2 / m`.
pub fn precise_bound_deg(bits: u32) -> f64 {
    ((SQRT_2 / 2.0).hypot(SQRT_2 * PI / 4.0) / largest(bits)).to_degrees()
}

/// The direction at r and phi in the octant of positive components.
pub fn at([r, phi]: [f64; 2]) -> [f64; 3] {
    EaOct::direction([r - r * phi, r * phi])
}
