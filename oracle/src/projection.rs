//! Parallel projections: xy only, with the sign of z (PP), and from six sides (SPP).

use super::raw::{half, snorm};

/// What is stored besides the two components: nothing, the sign of z, the sextant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Nothing: z >= 0.
    XyOnly,
    /// The sign of z.
    Pp,
    /// The sextant, in three bits.
    Spp,
}

/// The widths of the components in a code of `bits` bits.
pub fn widths(kind: Kind, bits: u32) -> [u32; 2] {
    let left = bits - [0, 1, 3][kind as usize];
    [left.div_ceil(2), left / 2]
}

/// The half steps of the components.
pub fn half_steps(kind: Kind, bits: u32) -> [f64; 2] {
    let unit = if kind == Kind::Spp { 0.5f64.sqrt() } else { 1.0 };
    widths(kind, bits).map(|b| 0.5 * unit / ((1i64 << (b - 1)) - 1) as f64)
}

/// The vector of a code, if its point is on the disk or in the sextant by a margin of `margin`.
pub fn decode(code: u64, kind: Kind, bits: u32, margin: f64) -> Option<[f64; 3]> {
    let [a, b] = widths(kind, bits);
    let unit = if kind == Kind::Spp { 0.5f64.sqrt() } else { 1.0 };
    let [x, y] = [snorm(code, a) * unit, snorm(code >> a, b) * unit];
    let top = (code >> (a + b)) % 8;
    from_components(x, y, kind, top, margin)
}

/// The vector of an xyonly32f code, if its point is on the disk by a margin of `margin`.
pub fn decode_halves(code: u64, margin: f64) -> Option<[f64; 3]> {
    from_components(half(code & 0xffff), half((code >> 16) & 0xffff), Kind::XyOnly, 0, margin)
}

fn from_components(x: f64, y: f64, kind: Kind, top: u64, margin: f64) -> Option<[f64; 3]> {
    let square = 1.0 - x * x - y * y;
    let least = if kind == Kind::Spp { x.abs().max(y.abs()).powi(2) } else { 0.0 };
    if square < least + margin {
        return None;
    }
    let third = if kind != Kind::XyOnly && top % 2 == 1 { -square.sqrt() } else { square.sqrt() };
    Some(match (kind, top / 2) {
        (Kind::Spp, 0) => [third, x, y],
        (Kind::Spp, 1) => [y, third, x],
        _ => [x, y, third],
    })
}

/// Meyer, eqs. 6 and 7, with half steps that differ.
pub fn bound_deg(kind: Kind, bits: u32) -> f64 {
    let [a, b] = half_steps(kind, bits);
    if kind == Kind::Spp {
        (2.0 * (a * a + a * b + b * b)).sqrt().to_degrees()
    } else {
        (1.0 - (a * a + b * b).sqrt()).acos().to_degrees()
    }
}
