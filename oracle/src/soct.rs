//! The signed octahedral mapping of the sphere.

use super::{HemiOct, Oracle, field, largest, normalize, snorm, twos_complement};

/// White 2017: the hemi-oct integers of (x, y, |z|), `(bits - 1) / 2` bits each, and the sign of z above.
pub fn unpack(code: u64, bits: u32) -> ([i64; 2], bool) {
    let half = bits / 2;
    let point = [code, code >> half].map(|c| twos_complement(c, half));
    (point, (code >> (bits - 1)) & 1 == 1)
}

/// The code of two integers and a sign.
pub fn pack(point: [i64; 2], negative: bool, bits: u32) -> u64 {
    let half = bits / 2;
    let [u, v] = point.map(|i| field(i, half));
    u | (v << half) | (u64::from(negative) << (bits - 1))
}

/// The unit vector that a code stands for.
pub fn decode(code: u64, bits: u32) -> [f64; 3] {
    let (point, negative) = unpack(code, bits);
    let [x, y, z] = normalize(HemiOct::direction(point.map(|i| snorm(i, largest(bits)))));
    [x, y, if negative { -z } else { z }]
}

/// The position on the square of a direction, and whether z is negative.
pub fn position(v: [f64; 3]) -> ([f64; 2], bool) {
    (HemiOct::position([v[0], v[1], v[2].abs()]), v[2] < 0.0)
}

/// The code of a direction: the nearest lattice point on the square.
pub fn encode(v: [f64; 3], bits: u32) -> u64 {
    let (position, negative) = position(v);
    pack(position.map(|t| (t * largest(bits)).round() as i64), negative, bits)
}
