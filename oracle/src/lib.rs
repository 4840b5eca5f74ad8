//! The codecs once more, in `f64` and straight from the papers' formulas.
//!
//! The papers: "survey" is Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
//! Vectors"; "Meyer" is Meyer et al. 2010, "On Floating-Point Normal Vectors". Nothing here calls or copies codec
//! code.
//!
//! Small functions are `#[inline]`: tests and tables call them 10^9 times.

pub mod azimuthal;
pub mod best_fit;
pub mod cube;
pub mod cylindrical;
pub mod eaoct;
pub mod fib;
pub mod frame;
pub mod hemioct;
pub mod hexcube;
pub mod ico;
pub mod latlong;
pub mod oct;
pub mod parallel;
pub mod quat;
pub mod raw;
pub mod reference;
pub mod soct;
pub mod spherical;
pub mod survey;
pub mod uoct;

pub use cylindrical::Cylindrical;
pub use eaoct::EaOct;
pub use fib::Fib;
pub use hemioct::HemiOct;
pub use ico::Ico;
pub use latlong::{LatLong, LatLongD};
pub use oct::Oct;
pub use reference::{Reference, round_trip};
pub use spherical::Spherical;

/// An octahedral mapping of directions to the square `[-1, 1]^2`, and its code's bits.
pub trait Oracle {
    /// The real-valued position of a direction (any length) on the square.
    fn position(v: [f64; 3]) -> [f64; 2];

    /// The direction (any length) of a position on the square.
    fn direction(e: [f64; 2]) -> [f64; 3];

    /// The direction that is encoded in place of `v`: `v` itself if the mapping covers the sphere.
    fn domain(v: [f64; 3]) -> [f64; 3] {
        v
    }

    /// The pair of snorm integers in a code: the first in the low half, the second in the high half.
    fn unpack(code: u64, bits: u32) -> [i64; 2] {
        split_halves(code, bits)
    }

    /// The code of a pair of snorm integers.
    fn pack(point: [i64; 2], bits: u32) -> u64 {
        join_halves(point, bits)
    }

    /// The unit vector that a code stands for.
    fn decode(code: u64, bits: u32) -> [f64; 3] {
        let m = largest(bits);
        normalize(Self::direction(Self::unpack(code, bits).map(|i| snorm(i, m))))
    }

    /// The code of a direction of any length: the lattice point nearest on the square.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let m = largest(bits);
        Self::pack(Self::position(Self::domain(v)).map(|t| (t * m).round() as i64), bits)
    }
}

/// Survey, section 1.2: the largest integer `2^(b-1) - 1` of the snorm components of `b = bits / 2` bits.
#[inline]
pub fn largest(bits: u32) -> f64 {
    ((1i64 << (bits / 2 - 1)) - 1) as f64
}

/// Survey, section 1.2: the value of the snorm integer `i`, `clamp(i / (2^(b-1) - 1), -1, 1)`.
#[inline]
pub fn snorm(i: i64, m: f64) -> f64 {
    (i as f64 / m).clamp(-1.0, 1.0)
}

/// The integer that the low `b` bits of `bits` are in two's complement.
#[inline]
pub fn twos_complement(bits: u64, b: u32) -> i64 {
    let low = (bits % (1 << b)) as i64;
    if low < 1 << (b - 1) { low } else { low - (1 << b) }
}

/// The low `b` bits of an integer in two's complement: the inverse of [`twos_complement`].
pub fn field(integer: i64, b: u32) -> u64 {
    integer as u64 % (1 << b)
}

/// The two integers, in two's complement, in the halves of a code's `bits` bits, the low half first.
#[inline]
pub fn split_halves(code: u64, bits: u32) -> [i64; 2] {
    [twos_complement(code, bits / 2), twos_complement(code >> (bits / 2), bits / 2)]
}

/// The code whose halves are two integers: the inverse of [`split_halves`].
pub fn join_halves(point: [i64; 2], bits: u32) -> u64 {
    let [low, high] = point.map(|i| field(i, bits / 2));
    low | (high << (bits / 2))
}

/// Survey, listing 1: +1 or -1.
#[inline]
pub fn sign_not_zero(t: f64) -> f64 {
    if t >= 0.0 { 1.0 } else { -1.0 }
}

/// The scalar product.
#[inline]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The Euclidean length.
#[inline]
pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// `a` scaled to length 1.
#[inline]
pub fn normalize(a: [f64; 3]) -> [f64; 3] {
    let l = length(a);
    a.map(|t| t / l)
}

/// The vector product.
#[inline]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The angle between two vectors of any length, in radians: `atan2(|a x b|, a . b)`, exact for small angles too.
#[inline]
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

/// [`angle`] in degrees.
#[inline]
pub fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    angle(a, b).to_degrees()
}

/// The difference of two vectors.
#[inline]
pub fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// The square of the distance between two points.
#[inline]
pub fn chord_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord = difference(a, b);
    dot(chord, chord)
}

/// The first of the candidates whose cost is least; none where every cost is infinite or NaN.
pub fn cheapest<T>(candidates: impl Iterator<Item = T>, cost: impl Fn(&T) -> f64) -> Option<T> {
    let (mut best, mut least) = (None, f64::INFINITY);
    for candidate in candidates {
        let cost = cost(&candidate);
        if cost < least {
            (best, least) = (Some(candidate), cost);
        }
    }
    best
}

/// The points of the lattice up to `reach` steps from one along each axis, in order of x, then y.
pub fn neighbourhood([x, y]: [i64; 2], reach: i64) -> impl Iterator<Item = [i64; 2]> {
    (x - reach..=x + reach).flat_map(move |x| (y - reach..=y + reach).map(move |y| [x, y]))
}

/// The largest angle, in degrees, by which a position off by `steps` of the square's half side along each axis
/// turns a direction on the octahedron: Meyer, eq. 10, where `steps` is half the sample spacing.
pub fn turn_deg(steps: f64) -> f64 {
    (3.0 / 2f64.sqrt() * 2.0 * steps).to_degrees()
}

/// Mean and maximum of a sequence.
#[derive(Clone, Copy, Debug, Default)]
pub struct Summary {
    /// The arithmetic mean.
    pub mean: f64,
    /// The largest value.
    pub max: f64,
}

impl Summary {
    /// The summary of `values`.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut sum, mut count, mut max) = (0.0, 0.0, f64::NEG_INFINITY);
        for value in values {
            sum += value;
            count += 1.0;
            max = value.max(max);
        }
        Self { mean: sum / count, max }
    }
}
