//! Parallel projections: xy only, with the sign of z (PP), and from six sides (SPP).

use super::raw::{half, half_code, snorm_max};
use super::{HemiOct, Oracle, field, normalize, twos_complement};

/// The data stored besides the two components: nothing, the sign of z, the sextant.
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

/// Steps in a unit, of both components.
fn steps(kind: Kind, bits: u32) -> [f64; 2] {
    half_steps(kind, bits).map(|half| 0.5 / half)
}

/// 1 on the border of the disk or the sextant, for a point of the positive quadrant.
fn extent(kind: Kind, [x, y]: [f64; 2]) -> f64 {
    let disk = x * x + y * y;
    if kind == Kind::Spp { disk + x.max(y).powi(2) } else { disk }
}

/// The extent up to which points are inside: the formats' own, with the margin that they leave for the rounding in
/// `f32`.
fn limit(kind: Kind, bits: u32) -> f64 {
    match kind {
        Kind::Spp => 1.0 - 2f64.powi(-21),
        _ if is_fine(kind, bits) => 1.0 + 3.0 * 2f64.powi(-23),
        _ => 1.0,
    }
}

/// True where a step is so small that points outside are not moved inwards.
fn is_fine(kind: Kind, bits: u32) -> bool {
    widths(kind, bits)[0] > 22
}

/// The fall of the extent with a step inwards along each component, up to a factor.
fn slopes(kind: Kind, [x, y]: [f64; 2], steps: [f64; 2]) -> [f64; 2] {
    let weights = match kind {
        Kind::Spp if x >= y => [2.0, 1.0],
        Kind::Spp => [1.0, 2.0],
        _ => [1.0, 1.0],
    };
    [weights[0] * x / steps[0], weights[1] * y / steps[1]]
}

/// Whole numbers, not negative, with `by` less in the one along which the border is reached sooner.
fn inwards(kind: Kind, e: [f64; 2], bits: u32, by: f64) -> [f64; 2] {
    let steps = steps(kind, bits);
    let [x, y] = slopes(kind, [e[0] / steps[0], e[1] / steps[1]], steps);
    if x >= y { [e[0] - by, e[1]] } else { [e[0], e[1] - by] }
}

/// The point that whole numbers, not negative, stand for: their own, or else the one 7/16 of a step inwards. `None`
/// where both are outside.
fn settled(kind: Kind, e: [f64; 2], bits: u32) -> Option<[f64; 2]> {
    let (steps, by) = (steps(kind, bits), if is_fine(kind, bits) { 0.0 } else { 7.0 / 16.0 });
    let points = [e, inwards(kind, e, bits, by)].map(|e| [e[0] / steps[0], e[1] / steps[1]]);
    points.into_iter().find(|&p| extent(kind, p) <= limit(kind, bits))
}

/// The integers of a code, and the bits above them.
fn unpack(code: u64, kind: Kind, bits: u32) -> ([i64; 2], u64) {
    let [a, b] = widths(kind, bits);
    let integer = |code: u64, b: u32| twos_complement(code, b).max(-snorm_max(b) as i64);
    ([integer(code, a), integer(code >> a, b)], (code >> (a + b)) % 8)
}

/// The code of a direction: the nearest whole numbers, or those one step inwards where they stand for no point.
pub fn encode(v: [f64; 3], kind: Kind, bits: u32) -> u64 {
    let unit = normalize(if kind == Kind::XyOnly { HemiOct::domain(v) } else { v });
    let larger = |a: usize, b: usize| if unit[b].abs() > unit[a].abs() { b } else { a };
    let axis = if kind == Kind::Spp { larger(larger(0, 1), 2) } else { 2 };
    let p = [unit[(axis + 1) % 3], unit[(axis + 2) % 3]];
    let ([a, b], steps) = (widths(kind, bits), steps(kind, bits));
    let e = [0, 1].map(|i| (p[i].abs() * steps[i]).round().min(snorm_max([a, b][i])));
    let e = if settled(kind, e, bits).is_some() { e } else { inwards(kind, e, bits, 1.0) };
    let [x, y] = [0, 1].map(|i| e[i].copysign(p[i]) as i64);
    let negative = u64::from(unit[axis] < 0.0);
    let top = match kind {
        Kind::XyOnly => 0,
        Kind::Pp => negative,
        Kind::Spp => 2 * axis as u64 + negative,
    };
    field(x, a) | (field(y, b) << a) | (top << (a + b))
}

/// The vector of a code, the third component 0 where its point is off the disk by more than the format settles.
pub fn decode(code: u64, kind: Kind, bits: u32) -> [f64; 3] {
    let (e, top) = unpack(code, kind, bits);
    let (whole, steps) = (e.map(|i| i.abs() as f64), steps(kind, bits));
    let p = settled(kind, whole, bits).unwrap_or([whole[0] / steps[0], whole[1] / steps[1]]);
    let p: [f64; 2] = std::array::from_fn(|i| if e[i] < 0 { -p[i] } else { p[i] });
    from_components(p, kind, top)
}

/// False where the rounding in `f32` decides what a code stands for, or its point is far outside.
pub fn is_settled(code: u64, kind: Kind, bits: u32) -> bool {
    const MARGIN: f64 = 1e-6;
    let (e, _) = unpack(code, kind, bits);
    let (whole, steps) = (e.map(|i| i.abs() as f64), steps(kind, bits));
    let beyond = |e: [f64; 2]| extent(kind, [e[0] / steps[0], e[1] / steps[1]]) - limit(kind, bits);
    if beyond(whole) < -MARGIN {
        return true;
    }
    let [x, y] = slopes(kind, [whole[0] / steps[0], whole[1] / steps[1]], steps);
    let is_tie = (x - y).abs() <= MARGIN * x || whole[0] / steps[0] == whole[1] / steps[1];
    let inset = inwards(kind, whole, bits, 7.0 / 16.0);
    beyond(whole) > MARGIN && beyond(inset) < -MARGIN && !is_tie && !is_fine(kind, bits)
}

fn from_components([x, y]: [f64; 2], kind: Kind, top: u64) -> [f64; 3] {
    let third = (1.0 - x * x - y * y).max(0.0).sqrt();
    let third = if kind != Kind::XyOnly && top % 2 == 1 { -third } else { third };
    match (kind, top / 2) {
        (Kind::Spp, 0) => [third, x, y],
        (Kind::Spp, 1) => [y, third, x],
        _ => [x, y, third],
    }
}

/// The point of two halves without signs on the disk: their own, or else that with the larger one 7/16 of the way to the
/// next smaller half.
fn settled_halves(codes: [u64; 2]) -> Option<[f64; 2]> {
    let (p, inner) = (codes.map(half), codes.map(|c| half(c.saturating_sub(1))));
    let moved = |i: usize| p[i] - 7.0 / 16.0 * (p[i] - inner[i]);
    let inset = if p[0] >= p[1] { [moved(0), p[1]] } else { [p[0], moved(1)] };
    [p, inset].into_iter().find(|&p| extent(Kind::XyOnly, p) <= 1.0)
}

/// The xyonly32f code of a direction.
pub fn encode_halves(v: [f64; 3]) -> u64 {
    let unit = normalize(HemiOct::domain(v));
    let mut codes = [half_code(unit[0].abs()), half_code(unit[1].abs())];
    if settled_halves(codes).is_none() {
        codes[if codes[0] >= codes[1] { 0 } else { 1 }] -= 1;
    }
    let [x, y] = [0, 1].map(|i| codes[i] | if unit[i] < 0.0 { 0x8000 } else { 0 });
    x | (y << 16)
}

/// The vector of an xyonly32f code, as [`decode`].
pub fn decode_halves(code: u64) -> [f64; 3] {
    let codes = [code, code >> 16].map(|c| c & 0x7fff);
    let p = settled_halves(codes).unwrap_or(codes.map(half));
    let signed = [0, 1].map(|i| if (code >> (16 * i)) & 0x8000 == 0 { p[i] } else { -p[i] });
    from_components(signed, Kind::XyOnly, 0)
}

/// [`is_settled`] for xyonly32f.
pub fn is_settled_halves(code: u64) -> bool {
    let p = [code, code >> 16].map(|c| half(c & 0x7fff));
    extent(Kind::XyOnly, p) < 1.0 - 1e-6
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
