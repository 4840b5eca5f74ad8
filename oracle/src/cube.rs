//! The cube map and the warped cube map.

use super::{field, normalize, twos_complement};
use std::f64::consts::FRAC_PI_4;

/// The two widths of the coordinates in a code of `bits` bits.
pub fn widths(bits: u32) -> [u32; 2] {
    [(bits - 3).div_ceil(2), (bits - 3) / 2]
}

/// The half steps of the coordinates: `1 / (2 m + 1)`.
pub fn half_steps(bits: u32) -> [f64; 2] {
    widths(bits).map(|b| 1.0 / ((1i64 << b) - 1) as f64)
}

/// The unit vector of a code.
pub fn decode(code: u64, bits: u32, warped: bool) -> [f64; 3] {
    let [a, b] = widths(bits);
    let coordinate = |field: u64, b: u32| {
        let m = (1i64 << (b - 1)) - 1;
        let t = twos_complement(field, b).max(-m) as f64 / (m as f64 + 0.5);
        if warped { (FRAC_PI_4 * t).tan() } else { t }
    };
    let (u, v, face) = (coordinate(code, a), coordinate(code >> a, b), (code >> (a + b)) % 8);
    let w = if face % 2 == 0 { 1.0 } else { -1.0 };
    normalize(match face / 2 {
        0 => [w, u, v],
        1 => [v, w, u],
        _ => [u, v, w],
    })
}

/// The code of a direction: the face of its largest component, and the nearest whole coordinates.
pub fn encode(v: [f64; 3], bits: u32, warped: bool) -> u64 {
    let larger = |a: usize, b: usize| if v[b].abs() > v[a].abs() { b } else { a };
    let axis = larger(larger(0, 1), 2);
    let face = 2 * axis as u64 + u64::from(v[axis] < 0.0);
    let [a, b] = widths(bits);
    let point = position(v, face << (a + b), bits, warped);
    let [x, y] = [0, 1].map(|i| {
        let m = ((1i64 << ([a, b][i] - 1)) - 1) as f64;
        point[i].round().clamp(-m, m) as i64
    });
    field(x, a) | (field(y, b) << a) | (face << (a + b))
}

/// The position of a direction, in steps, on the face of a code; at most half a step over the face's edge if the code is
/// of the right face.
pub fn position(v: [f64; 3], code: u64, bits: u32, warped: bool) -> [f64; 2] {
    let face = (code >> (bits - 3)) % 8;
    let [u, w, d] = match face / 2 {
        0 => [v[1], v[2], v[0]],
        1 => [v[2], v[0], v[1]],
        _ => v,
    };
    let warp = |t: f64| if warped { t.atan() / FRAC_PI_4 } else { t };
    assert!((d < 0.0) == (face % 2 == 1) && u.abs() <= d.abs() && w.abs() <= d.abs(), "{v:?}: {code:#x}");
    let [a, b] = half_steps(bits);
    [warp(u / d.abs()) / (2.0 * a), warp(w / d.abs()) / (2.0 * b)]
}

/// The integers of a code.
pub fn integers(code: u64, bits: u32) -> [i64; 2] {
    let [a, b] = widths(bits);
    [(code, a), (code >> a, b)].map(|(field, b)| twos_complement(field, b))
}

/// Meyer, eq. 8, with half steps that differ: the angle of a cell's corner from its middle, at the face's middle.
pub fn bound_deg(bits: u32) -> f64 {
    let [a, b] = half_steps(bits);
    (a * a + b * b).sqrt().atan().to_degrees()
}

/// The greatest error in degrees of the warped cube, whose steps subtend the largest angles along the diagonal, in the
/// cube's corner. There the metric of the warped coordinates is `(pi/4)^2 4/9 ((2, -1), (-1, 2))`.
pub fn warped_bound_deg(bits: u32) -> f64 {
    let [a, b] = half_steps(bits);
    (FRAC_PI_4 * (8.0 / 9.0 * (a * a + a * b + b * b)).sqrt()).to_degrees()
}
