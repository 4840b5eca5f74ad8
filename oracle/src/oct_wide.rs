//! The octahedral mapping of the sphere, with codes of more than 32 bits.
//!
//! The mapping itself is that of [`super::oct`]; `f64` holds a position on these lattices to 2^-27 of a step.

use super::{Oct, Oracle, cross, dot, length, normalize};

/// Survey, section 1.2: the largest integer `2^(b-1) - 1` of the snorm components of `b = bits / 2` bits.
pub fn largest(bits: u32) -> i64 {
    (1 << (bits / 2 - 1)) - 1
}

/// The two integers, in two's complement, in the halves of a code's `bits` bits, the low half first. The code's low
/// word is the first.
pub fn unpack([low, high]: [u32; 2], bits: u32) -> [i64; 2] {
    let (code, range) = (u64::from(low) + (u64::from(high) << 32), 1i64 << (bits / 2));
    [code % range as u64, (code >> (bits / 2)) % range as u64].map(|field| {
        let integer = field as i64;
        if integer < range / 2 { integer } else { integer - range }
    })
}

/// The code of two integers: the inverse of [`unpack`].
pub fn pack(point: [i64; 2], bits: u32) -> [u32; 2] {
    let [x, y] = point.map(|i| i.rem_euclid(1 << (bits / 2)) as u64);
    let code = x + (y << (bits / 2));
    [code as u32, (code >> 32) as u32]
}

/// The unit vector that a code stands for.
pub fn decode(code: [u32; 2], bits: u32) -> [f64; 3] {
    direction(unpack(code, bits), bits)
}

/// The unit vector of a lattice point (survey, section 1.2 and listing 2). In whole numbers up to the length, since
/// `f64` does not hold a quotient by `m`.
fn direction(point: [i64; 2], bits: u32) -> [f64; 3] {
    let m = largest(bits);
    let [x, y] = point.map(|i| i.max(-m));
    let z = m - x.abs() - y.abs();
    let sign = |i: i64| if i >= 0 { 1 } else { -1 };
    let whole = if z < 0 { [(m - y.abs()) * sign(x), (m - x.abs()) * sign(y), z] } else { [x, y, z] };
    normalize(whole.map(|i| i as f64))
}

/// The real-valued position of a direction on the lattice.
pub fn position(v: [f64; 3], bits: u32) -> [f64; 2] {
    Oct::position(v).map(|t| t * largest(bits) as f64)
}

/// The angle in radians between two vectors of any length, as [`super::angle_deg`] takes it.
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

/// The code nearest in angle to the direction of `v`, by trial of the 7 x 7 lattice points around its position.
pub fn nearest(v: [f64; 3], bits: u32) -> [u32; 2] {
    let m = largest(bits);
    let centre = position(v, bits).map(|t| t.round() as i64);
    let mut best = (f64::INFINITY, centre);
    for x in centre[0] - 3..=centre[0] + 3 {
        for y in centre[1] - 3..=centre[1] + 3 {
            let point = wrap([x, y], m);
            let off = angle(v, direction(point, bits));
            if off < best.0 {
                best = (off, point);
            }
        }
    }
    pack(best.1, bits)
}

/// The lattice point of the square `[-m, m]^2` that a point beyond its border goes on to: each edge is glued to
/// itself, turned about its middle (survey, figure 3).
fn wrap([x, y]: [i64; 2], m: i64) -> [i64; 2] {
    let [x, y] = if x.abs() > m { [2 * m * x.signum() - x, -y] } else { [x, y] };
    if y.abs() > m { [-x, 2 * m * y.signum() - y] } else { [x, y] }
}

/// Meyer, eq. 10, in radians: the maximal error of rounding on the square, at sample spacing `1 / m`, leading term.
pub fn domain_bound(bits: u32) -> f64 {
    3.0 / 2f64.sqrt() / largest(bits) as f64
}

/// Meyer, eq. 11, in radians: the maximal error of the code nearest in angle, leading term.
pub fn range_bound(bits: u32) -> f64 {
    2f64.sqrt() / largest(bits) as f64
}

/// Meyer, eq. 3, in radians: the maximal error of three floats of 23-bit mantissa, `sqrt(8) / 3 eps` at `eps = 2^-24`.
pub const FPNV: f64 = 5.62e-8;
