//! The octahedral mapping of the sphere.

use super::{
    Oracle, cheapest, cross, dot, join_halves, largest, neighbourhood, normalize, sign_not_zero, split_halves,
};

/// The oct mapping (survey, listings 1 and 2) and its codes' bits.
pub struct Oct;

impl Oracle for Oct {
    /// Survey, listing 1 (`float32x3_to_oct`).
    fn position(v: [f64; 3]) -> [f64; 2] {
        let norm = v[0].abs() + v[1].abs() + v[2].abs();
        let p = [v[0] / norm, v[1] / norm];
        if v[2] <= 0.0 {
            [(1.0 - p[1].abs()) * sign_not_zero(p[0]), (1.0 - p[0].abs()) * sign_not_zero(p[1])]
        } else {
            p
        }
    }

    /// Survey, listing 2 (`oct_to_float32x3`), before the normalisation.
    fn direction(e: [f64; 2]) -> [f64; 3] {
        let z = 1.0 - e[0].abs() - e[1].abs();
        if z < 0.0 {
            [(1.0 - e[1].abs()) * sign_not_zero(e[0]), (1.0 - e[0].abs()) * sign_not_zero(e[1]), z]
        } else {
            [e[0], e[1], z]
        }
    }

    fn unpack(code: u64, bits: u32) -> [i64; 2] {
        if bits == 24 { unorm8x3_to_snorm12x2_slow(bytes(code)) } else { split_halves(code, bits) }
    }

    fn pack(point: [i64; 2], bits: u32) -> u64 {
        if bits == 24 { code(snorm12x2_to_unorm8x3_slow(point)) } else { join_halves(point, bits) }
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        normalize(lattice_vector(Self::unpack(code, bits), bits))
    }
}

/// The vector, of any length, of a lattice point (survey, section 1.2 and listing 2). In whole numbers: `f64` does not hold a
/// quotient by `m`, and on the equator z is exactly 0.
fn lattice_vector(point: [i64; 2], bits: u32) -> [f64; 3] {
    let m = (1 << (bits / 2 - 1)) - 1;
    let [x, y] = point.map(|i| i.clamp(-m, m));
    let z = m - x.abs() - y.abs();
    let sign = |i: i64| if i >= 0 { 1 } else { -1 };
    let whole = if z < 0 { [(m - y.abs()) * sign(x), (m - x.abs()) * sign(y), z] } else { [x, y, z] };
    whole.map(|i| i as f64)
}

/// The three bytes of an oct24 code, the first in the low bits.
pub fn bytes(code: u64) -> [u8; 3] {
    let [a, b, c, ..] = code.to_le_bytes();
    [a, b, c]
}

/// The oct24 code of three bytes.
pub fn code([a, b, c]: [u8; 3]) -> u64 {
    u64::from_le_bytes([a, b, c, 0, 0, 0, 0, 0])
}

/// Survey, listing 4 (`snorm12x2_to_unorm8x3_slow`) after its rounding, as for GL_RGB8UI: the bytes of two snorm
/// integers.
pub fn snorm12x2_to_unorm8x3_slow(point: [i64; 2]) -> [u8; 3] {
    let [x, y] = point.map(|i| (i + 2047) as u32);
    [(x >> 4) as u8, (((x & 0xF) << 4) | (y >> 8)) as u8, (y & 0xFF) as u8]
}

/// Survey, listing 4 (`unorm8x3_to_snorm12x2_slow`) before its division by 2047: the two snorm integers, the
/// second pattern of +1 as 2048.
pub fn unorm8x3_to_snorm12x2_slow(bytes: [u8; 3]) -> [i64; 2] {
    let v = bytes.map(i64::from);
    let p = [(v[0] << 4) | ((v[1] >> 4) & 15), ((v[1] & 15) << 8) | v[2]];
    p.map(|i| i - 2047)
}

/// Survey, listing 5 (`snorm12x2_to_unorm8x3`) without its final division, as for GL_RGB8UI: in `f32`, as there.
pub fn snorm12x2_to_unorm8x3(f: [f32; 2]) -> [f32; 3] {
    let u = f.map(|t| (t.clamp(-1.0, 1.0) * 2047.0 + 2047.0).round());
    let t = (u[1] / 256.0).floor();
    [u[0] / 16.0, (u[0] / 16.0).fract() * 256.0 + t, u[1] - t * 256.0].map(f32::floor)
}

/// Survey, listing 5 (`unorm8x3_to_snorm12x2`) after its multiplication by 255: in `f32`, as there.
pub fn unorm8x3_to_snorm12x2(mut u: [f32; 3]) -> [f32; 2] {
    u[1] *= 1.0 / 16.0;
    let s = [u[0] * 16.0 + u[1].floor(), u[1].fract() * (16.0 * 256.0) + u[2]];
    s.map(|t| (t * (1.0 / 2047.0) - 1.0).clamp(-1.0, 1.0))
}

/// Meyer, eq. 10, in degrees: the maximal error of rounding on the square, at sample spacing `1 / m`.
///
/// The leading term `3 / sqrt(2) eps`, which the paper's `arccos(sqrt(2 / (2 + 9 eps^2)))` stays under by a part
/// of `1.5 eps^2`: the angle of an error straddling the octant's middle lies between the two.
pub fn domain_bound_deg(bits: u32) -> f64 {
    (3.0 / 2f64.sqrt() / largest(bits)).to_degrees()
}

/// Meyer, eq. 11, in degrees: the maximal error of the code nearest in angle, `sqrt(2) eps` at `eps = 1 / m`.
pub fn range_bound_deg(bits: u32) -> f64 {
    (2f64.sqrt() / largest(bits)).to_degrees()
}

/// The unit vectors of all codes of `bits` bits.
pub fn all_directions(bits: u32) -> Vec<[f64; 3]> {
    (0..1 << bits).map(|code| Oct::decode(code, bits)).collect()
}

/// The code nearest in angle to the direction of `v`, by trial of every code: `all` is [`all_directions`].
pub fn nearest_of_all(v: [f64; 3], all: &[[f64; 3]]) -> u64 {
    cheapest((0..).zip(all), |(_, direction)| -dot(v, **direction)).map_or(0, |(code, _)| code)
}

/// The code nearest in angle to the direction of `v`, by trial of the 7 x 7 lattice points around its position.
pub fn nearest_in_neighbourhood(v: [f64; 3], bits: u32) -> u64 {
    Oct::pack(nearest_around::<Oct>(v, bits, |point| lattice_vector(point, bits)), bits)
}

/// The lattice point nearest in angle to the direction of `v`, of the 7 x 7 around its position, by the vector of each.
pub(crate) fn nearest_around<O: Oracle>(
    v: [f64; 3],
    bits: u32,
    vector: impl Fn([i64; 2]) -> [f64; 3],
) -> [i64; 2] {
    let m = largest(bits);
    let centre = O::position(v).map(|t| (t * m).round() as i64);
    let around = neighbourhood(centre, 3).map(|point| wrap(point, m as i64));
    cheapest(around, |point| tangent_squared(v, vector(*point))).unwrap_or(centre)
}

/// The square of the tangent of the angle between two vectors of any length, which orders angles of less than 90 degrees.
#[inline]
pub fn tangent_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (c, cosine) = (cross(a, b), dot(a, b));
    if cosine > 0.0 { dot(c, c) / (cosine * cosine) } else { f64::INFINITY }
}

/// The lattice point of the square `[-m, m]^2` that a point beyond its border goes on to: each edge is glued to
/// itself, turned about its middle (survey, figure 3).
#[inline]
pub fn wrap([x, y]: [i64; 2], m: i64) -> [i64; 2] {
    let [x, y] = if x.abs() > m { [2 * m * x.signum() - x, -y] } else { [x, y] };
    if y.abs() > m { [-x, 2 * m * y.signum() - y] } else { [x, y] }
}

/// Meyer, eq. 3, in radians: the maximal error of three floats of 23-bit mantissa, `sqrt(8) / 3 eps` at `eps = 2^-24`.
pub const FPNV: f64 = 5.62e-8;
