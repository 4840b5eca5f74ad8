//! Rotations in the formats of other software: unit quaternions x, y, z, w, of which q and -q are one rotation.
//!
//! ```
//! use unitvec::{interop::RotationFormat, rotation_angle_deg};
//!
//! let format = RotationFormat::named("spz")?;
//! let turn = [0.18, 0.36, 0.54, 0.74];
//! let nearest = format.decode(format.encode(turn));
//! let plain = format.decode(format.plain().encode(turn));
//! assert!(rotation_angle_deg(turn, nearest) <= rotation_angle_deg(turn, plain));
//! # Ok::<(), unitvec::interop::UnknownFormat>(())
//! ```
//!
//! Most formats drop one component, the largest, and store the other three in equal steps; the decoder takes it back from the
//! length of 1, whether it is the largest or not. So a rotation lies in up to four *charts*, one for each dropped component.
//! Charts stretch distances, and by twice where all components are equal: there rounding each number misses the nearest code
//! of the chart, and another chart, in which the rotation lies between other codes, has one that is nearer still for one
//! rotation in six.
//!
//! Without a usable quaternion (zero, NaN, infinity) all encoders write the code of the identity. Of formats of unsigned
//! numbers no decoder gives the identity back, nor other rotations with components of 0.

use super::plain::snorm;
use super::{UnknownFormat, joined, parted, width};
use crate::arith::mask;
use crate::codec::storage_bytes;
use crate::slice::{LengthMismatch, load_each, store_each};
use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
use core::fmt;

/// A format of rotations, with the nearest or the [plain](Self::plain) encoder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationFormat {
    /// The name, without a width.
    pub name: &'static str,
    /// The bits of a component, the sign's included.
    pub component_bits: u32,
    /// The least and the greatest number of them.
    pub widths: [u32; 2],
    /// The source of encoder and decoder: repository, commit, file.
    pub source: &'static str,
    /// The bits of a code, the low ones first.
    pub layout: &'static str,
    /// The original's answer to a quaternion of length 0.
    pub zero: &'static str,
    packing: Packing,
    is_plain: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Packing {
    /// Three components; the fourth is at least 0.
    Three(Three),
    /// Four components in signed lanes.
    Four,
}

/// Three components in equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Three {
    lattice: Lattice,
    /// The component that the largest number stands for.
    range: f64,
    order: Order,
    layout: Layout,
    original: Original,
}

/// The numbers of a component.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lattice {
    /// From 0 to `2^b - 1`: none stands for 0.
    Unorm,
    /// From `1 - 2^(b-1)` to `2^(b-1) - 1`, in two's complement.
    Snorm,
    /// The same, as a magnitude and a sign above it.
    Signed,
}

/// The order of the components, and which may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    /// x, y, z, w.
    W4,
    /// w, x, y, z.
    W1,
    /// From the one after the dropped one on, in a circle.
    Cyclic,
    /// x, y, z; w is always dropped.
    Xyz,
}

/// The place in a code of the index of the dropped component and of the numbers a, b and c, from the low bits up.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Layout {
    /// c, b, a, index.
    IndexHigh,
    /// Index, a, b, c.
    IndexLow,
    /// a, b, c.
    NoIndex,
    /// Four bytes: a, b, c, and the index above 252.
    Rgba,
    /// Four signed words: a, b, c, and the largest number with the index in its low two bits. The decoder rounds to words.
    Lanes,
}

/// The software whose plain encoder it is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Original {
    Mirror,
    League,
    Fiedler,
    Ply,
    Sog,
    Spz,
    Spz2,
    Meshopt,
}

/// The ranges of Mirror and of Fiedler, who write 1 / sqrt(2) and sqrt(2) with six decimals.
const MIRROR_RANGE: f32 = 707_107.0 / 1e6;
const FIEDLER_RANGE: f32 = 1.0 / (1_414_214.0 / 1e6);

/// All formats of rotations, with the least width where there are several.
pub static ROTATIONS: [RotationFormat; 10] = {
    use Lattice::{Signed, Snorm, Unorm};
    use Layout::{IndexHigh, IndexLow, Lanes, NoIndex, Rgba};
    use Order::{Cyclic, W1, W4, Xyz};
    use Original::{Fiedler, League, Meshopt, Mirror, Ply, Sog, Spz, Spz2};
    use Packing::Four;
    type Text = &'static str;
    const fn of(name: Text, widths: [u32; 2], packing: Packing, texts: [Text; 3]) -> RotationFormat {
        let ([source, layout, zero], component_bits) = (texts, widths[0]);
        RotationFormat { name, component_bits, widths, source, layout, zero, packing, is_plain: false }
    }
    const fn three(lattice: Lattice, range: f64, order: Order, layout: Layout, by: Original) -> Packing {
        Packing::Three(Three { lattice, range, order, layout, original: by })
    }
    const ROOT: f64 = FRAC_1_SQRT_2;
    const MIRROR: f64 = MIRROR_RANGE as f64;
    const FIEDLER: f64 = FIEDLER_RANGE as f64;
    const BY_MIRROR: Text = "MirrorNetworking/Mirror 2237ac3b, Assets/Mirror/Core/Tools/Compression.cs";
    const BY_LEAGUE: Text = "LeagueToolkit/LeagueToolkit 00515383, Core/Primitives/QuantizedQuaternion.cs";
    const BY_FIEDLER: Text = "GPopov/protocol2 08f26db5, 002_serialization_strategies.cpp: 2 to 10 bits";
    const BY_PLAYCANVAS: Text = "playcanvas/splat-transform 8d6b801f, src/lib/writers";
    const BY_SPZ: Text = "nianticlabs/spz 21715c38, src/cc/load-spz.cc and splat-utils.h: versions 3 and 4";
    const BY_SPZ2: Text = "nianticlabs/spz 21715c38, src/cc/load-spz.cc and splat-utils.h: versions 1 and 2";
    const BY_MESHOPT: Text = "zeux/meshoptimizer b5b2c439, src/vertexfilter.cpp; KHR_meshopt_compression";
    const BY_GLTF: Text = "glTF, KHR_gaussian_splatting; zeux/meshoptimizer b5b2c439, gltf/stream.cpp";
    const CBA: Text = "c, b, a, unsigned, of x, y, z, w without the largest; its index, 2 bits";
    const ABC: Text = "the index of the largest, 2 bits; a, b, c, unsigned, of x, y, z, w without it";
    const OF_W: Text = "c, b, a, unsigned, of w, x, y, z without the largest; its index, 2 bits";
    const BYTES: Text = "a, b, c, unsigned bytes, of w, x, y, z without the largest; 252 + its index";
    const SIGNS: Text = "c, b, a, 9 bits and a sign each, of x, y, z, w without the largest; its index";
    const XYZ: Text = "x, y, z, unsigned bytes, where w is at least 0";
    const WORDS: Text = "signed words: the three after the largest, in a circle; the largest number | index";
    const TURN: Text = "the code of a half turn about x";
    const TURN_Z: Text = "the code of a half turn about z";
    const REFUSED: Text = "0, which the validator refuses";
    const UNDEFINED: Text = "NaN: no defined code";
    [
        of("quat10x3", [10; 2], three(Unorm, MIRROR, W4, IndexHigh, Mirror), [BY_MIRROR, CBA, TURN]),
        of("quat15x3", [15; 2], three(Unorm, ROOT, W4, IndexHigh, League), [BY_LEAGUE, CBA, TURN]),
        of("smallest3", [4, 20], three(Unorm, FIEDLER, W4, IndexLow, Fiedler), [BY_FIEDLER, ABC, TURN]),
        of("playcanvas-ply", [10; 2], three(Unorm, ROOT, W1, IndexHigh, Ply), [BY_PLAYCANVAS, OF_W, TURN_Z]),
        of("sog", [8; 2], three(Unorm, ROOT, W1, Rgba, Sog), [BY_PLAYCANVAS, BYTES, "bytes 0, 0, 0, 252"]),
        of("spz", [10; 2], three(Signed, ROOT, W4, IndexHigh, Spz), [BY_SPZ, SIGNS, UNDEFINED]),
        of("spz2", [8; 2], three(Unorm, 1.0, Xyz, NoIndex, Spz2), [BY_SPZ2, XYZ, UNDEFINED]),
        of("meshopt-quat", [4, 16], three(Snorm, ROOT, Cyclic, Lanes, Meshopt), [BY_MESHOPT, WORDS, TURN]),
        of("gltf-quat8", [8; 2], Four, [BY_GLTF, "x, y, z, w, signed bytes", REFUSED]),
        of("gltf-quat16", [16; 2], Four, [BY_GLTF, "x, y, z, w, signed words", REFUSED]),
    ]
};

/// The name, as [`RotationFormat::named`] takes it.
impl fmt::Display for RotationFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        if self.widths[0] < self.widths[1] { write!(f, ":{}", self.component_bits) } else { Ok(()) }
    }
}

impl RotationFormat {
    /// The format of this name: `spz`, or `meshopt-quat:12` where there are several widths.
    ///
    /// # Errors
    /// [`UnknownFormat`], which lists the formats, or the widths of this one.
    pub fn named(name: &str) -> Result<Self, UnknownFormat> {
        let (base, bits) = name.split_once(':').map_or((name, None), |(base, bits)| (base, Some(bits)));
        let format = ROTATIONS.iter().find(|format| format.name.eq_ignore_ascii_case(base));
        let format = *format.ok_or_else(|| UnknownFormat::Name { name: name.to_owned() })?;
        Ok(Self { component_bits: width(format.name, format.widths, bits)?, ..format })
    }

    /// All formats, at each of their widths.
    pub fn all() -> impl Iterator<Item = Self> {
        ROTATIONS.iter().flat_map(|format| {
            (format.widths[0]..=format.widths[1]).map(|component_bits| Self { component_bits, ..*format })
        })
    }

    /// The same format with the plain encoder of the original.
    #[must_use]
    pub fn plain(self) -> Self {
        Self { is_plain: true, ..self }
    }

    /// Significant bits of a code.
    pub fn bits(self) -> u32 {
        let Packing::Three(Three { layout, .. }) = self.packing else { return 4 * self.component_bits };
        match layout {
            Layout::Lanes => 64,
            Layout::Rgba => 32,
            Layout::NoIndex => 24,
            Layout::IndexHigh | Layout::IndexLow => 3 * self.component_bits + 2,
        }
    }

    /// Bytes of a stored code.
    pub fn bytes(self) -> usize {
        storage_bytes(self.bits())
    }

    /// An upper bound of the nearest encoder's error, in degrees of rotation.
    pub fn max_error_deg(self) -> f32 {
        let radians = match self.packing {
            Packing::Three(three) => three.bound(self.component_bits),
            // Half the diagonal of a cell, at the least length.
            Packing::Four => 2.0 / (largest_number(self.component_bits) * (1.0 - VALID)),
        };
        radians.to_degrees() as f32
    }

    /// The code of a rotation: of a quaternion of any length, in x, y, z, w.
    #[must_use]
    pub fn encode(self, q: impl Into<[f32; 4]>) -> u64 {
        const IDENTITY: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
        let q = q.into();
        let is_usable = q.iter().all(|c| c.is_finite()) && q != [0.0; 4];
        let q = if is_usable { q } else { IDENTITY };
        match self.packing {
            Packing::Three(three) if self.is_plain => three.plain(q, self.component_bits),
            Packing::Three(three) => three.nearest(unit(q), self.component_bits),
            Packing::Four => {
                // The first component is in the lowest lane.
                let lanes = four(q, self.component_bits, self.is_plain).into_iter().rev();
                let lanes = lanes.map(|number| u64::from(number as u32 & mask(self.component_bits)));
                lanes.fold(0, |code, lane| code << self.component_bits | lane)
            }
        }
    }

    /// The quaternion of a code, of unit length to within 2 ULP; with `meshopt-quat` and glTF's as their integers have it.
    /// A component that is dropped is at least 0. Where the others are longer than 1, which only `spz2` writes, it is 0.
    #[must_use]
    pub fn decode(self, code: u64) -> [f32; 4] {
        match self.packing {
            Packing::Three(three) => three.decode(code, self.component_bits),
            Packing::Four => [0, 1, 2, 3].map(|lane| {
                let number = (code >> (lane * self.component_bits)) as u32 & mask(self.component_bits);
                let largest = largest_number(self.component_bits) as f32;
                (Lattice::Snorm.number(number, self.component_bits) as f32 / largest).max(-1.0)
            }),
        }
    }

    /// [`encode`](Self::encode) as words, low word first.
    #[doc(hidden)]
    pub fn encode_words(self, q: [f32; 4]) -> [u32; 2] {
        parted(self.encode(q))
    }

    /// [`decode`](Self::decode) of words, low word first.
    #[doc(hidden)]
    pub fn decode_words(self, code: [u32; 2]) -> [f32; 4] {
        self.decode(joined(code))
    }

    /// [`encode`](Self::encode) of each rotation, into [`bytes`](Self::bytes) little-endian bytes each, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `codes` is as long as the rotations' codes. Nothing is written then.
    pub fn encode_slice(self, rotations: &[[f32; 4]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        store_each(rotations, codes, self.bytes(), |q| self.encode_words(*q))
    }

    /// The reverse of [`encode_slice`](Self::encode_slice).
    ///
    /// # Errors
    /// The errors of [`encode_slice`](Self::encode_slice).
    pub fn decode_slice(self, codes: &[u8], rotations: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        load_each(codes, rotations, self.bytes(), |code| self.decode_words(code))
    }
}

/// The squared sine of the angle between two quaternions, and its cosine, times their lengths squared.
fn parts([x, y, z, w]: [f64; 4], [a, b, c, d]: [f64; 4]) -> (f64, f64) {
    let areas = [x * b - y * a, x * c - z * a, x * d - w * a, y * c - z * b, y * d - w * b, z * d - w * c];
    (areas.iter().map(|area| area * area).sum(), x * a + y * b + z * c + w * d)
}

/// The tangent of the angle between two quaternions up to their signs: not less than the distance of unit quaternions.
fn distance(a: [f64; 4], b: [f32; 4]) -> f64 {
    let (across, along) = parts(a, b.map(f64::from));
    if along == 0.0 { f64::INFINITY } else { across.sqrt() / along.abs() }
}

/// The points whose components are whole numbers of these ranges.
fn points<const N: usize>(ranges: [[f64; 2]; N]) -> impl Iterator<Item = [i32; N]> {
    let ranges = ranges.map(|[from, to]| [from.ceil() as i32, to.floor() as i32]);
    let first = ranges.iter().all(|[from, to]| from <= to).then_some(ranges.map(|[from, _]| from));
    core::iter::successors(first, move |point| {
        let mut point = *point;
        for (number, [from, to]) in point.iter_mut().zip(ranges) {
            if *number < to {
                *number += 1;
                return Some(point);
            }
            *number = from;
        }
        None
    })
}

fn length(q: [f64; 4]) -> f64 {
    q.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The place of the largest magnitude, the first of equals in this order.
fn largest(q: [f64; 4], order: &[usize]) -> usize {
    order.iter().copied().reduce(|a, b| if q[b].abs() > q[a].abs() { b } else { a }).unwrap_or(3)
}

/// The largest signed number.
fn largest_number(bits: u32) -> f64 {
    f64::from(mask(bits - 1))
}

impl Lattice {
    /// The largest number, counted from the middle, and the number of the middle.
    fn sizes(self, bits: u32) -> (f64, f64) {
        match self {
            Self::Unorm => (f64::from(mask(bits)) * 0.5, f64::from(mask(bits)) * 0.5),
            Self::Snorm | Self::Signed => (largest_number(bits), 0.0),
        }
    }

    /// The bits of a number.
    fn bits_of(self, number: i32, bits: u32) -> u32 {
        match self {
            Self::Unorm | Self::Snorm => number as u32 & mask(bits),
            Self::Signed => number.unsigned_abs() | u32::from(number < 0) << (bits - 1),
        }
    }

    /// The number of these bits, counted from the middle.
    fn number(self, code: u32, bits: u32) -> f64 {
        let sign = 1 << (bits - 1);
        match self {
            Self::Unorm => f64::from(code) - f64::from(mask(bits)) * 0.5,
            Self::Snorm => f64::from((code ^ sign).wrapping_sub(sign) as i32),
            Self::Signed if code & sign != 0 => -f64::from(code ^ sign),
            Self::Signed => f64::from(code),
        }
    }
}

impl Three {
    /// The distance of two neighbouring numbers.
    fn step(self, bits: u32) -> f64 {
        self.range / self.lattice.sizes(bits).0
    }

    /// What a decoded quaternion is off the unit sphere, or off the quaternion that its numbers stand for, at most.
    fn tolerance(self, bits: u32) -> f64 {
        let half_diagonal = match self.layout {
            // Of a cell of words, in four dimensions.
            Layout::Lanes => 1.0 / 32_767.0,
            // Of a cell beyond the ball, which rounding may leave.
            Layout::NoIndex => 0.75f64.sqrt() * self.step(bits),
            _ => 0.0,
        };
        // Decoders round to f32.
        half_diagonal + 2e-7
    }

    /// The bound of the error, in radians of rotation.
    fn bound(self, bits: u32) -> f64 {
        let step = self.step(bits);
        if self.order == Order::Xyz {
            // Where w is 0, what rounding moves the point by moves its square by twice as much.
            let moved = 0.75f64.sqrt() * step;
            return 4.0 * (0.5 * (moved * moved + (2.0 * moved + moved * moved)).sqrt()).asin();
        }
        // With u the three components by the fourth, at most 1, squared distances are d d + (u d)(u d): the farthest point of
        // a cubic lattice is a step away, for u at a vertex or the middle of a face of its cube. Within a step the fourth
        // component changes by 3 steps of its size at most, and distances with it.
        2.0 * step * (1.0 + 3.0 * step) + 2.0 * self.tolerance(bits)
    }

    /// The components that may be dropped, in the original's order.
    fn charts(self) -> &'static [usize] {
        match self.order {
            Order::W4 | Order::Cyclic => &[0, 1, 2, 3],
            Order::W1 => &[3, 0, 1, 2],
            Order::Xyz => &[3],
        }
    }

    /// The components that are not dropped, in the order of their numbers.
    fn others(self, chart: usize) -> [usize; 3] {
        let first = if self.order == Order::Cyclic { chart + 1 } else { self.charts()[0] };
        let mut others = (first..first + 4).map(|i| i & 3).filter(|i| *i != chart);
        [(); 3].map(|()| others.next().unwrap_or_default())
    }

    fn code(self, chart: usize, [a, b, c]: [u32; 3], bits: u32) -> u64 {
        let index = if self.order == Order::W1 { (chart as u64 + 1) & 3 } else { chart as u64 };
        let numbers = [a, b, c].map(u64::from);
        let from = |width: u32, [a, b, c]: [u64; 3]| a | b << width | c << (2 * width);
        match self.layout {
            Layout::IndexHigh => from(bits, [numbers[2], numbers[1], numbers[0]]) | index << (3 * bits),
            Layout::IndexLow => index | from(bits, numbers) << 2,
            Layout::NoIndex => from(bits, numbers),
            Layout::Rgba => from(8, numbers) | (252 | index) << 24,
            Layout::Lanes => {
                let sign = 1 << (bits - 1);
                let words = numbers.map(|number| (number ^ sign).wrapping_sub(sign) & 0xffff);
                from(16, words) | (u64::from(mask(bits - 1)) & !3 | index) << 48
            }
        }
    }

    /// The dropped component and the numbers of a code.
    fn of_code(self, code: u64, bits: u32) -> (usize, [u32; 3]) {
        let at = |first: u32| (code >> first) as u32 & mask(bits);
        let ([a, b, c], index) = match self.layout {
            Layout::IndexHigh => ([at(2 * bits), at(bits), at(0)], code >> (3 * bits)),
            Layout::IndexLow => ([at(2), at(2 + bits), at(2 + 2 * bits)], code),
            Layout::NoIndex => ([at(0), at(bits), at(2 * bits)], 3),
            Layout::Rgba => ([at(0), at(8), at(16)], code >> 24),
            Layout::Lanes => ([at(0), at(16), at(32)], code >> 48),
        };
        let index = index as usize & 3;
        (if self.order == Order::W1 { (index + 3) & 3 } else { index }, [a, b, c])
    }

    fn decode(self, code: u64, bits: u32) -> [f32; 4] {
        let (chart, numbers) = self.of_code(code, bits);
        if self.layout == Layout::Lanes {
            return of_words(code, chart);
        }
        let step = self.step(bits);
        let mut q = [0.0; 4];
        for (i, number) in self.others(chart).into_iter().zip(numbers) {
            q[i] = self.lattice.number(number, bits) * step;
        }
        let rest = 1.0 - q.iter().map(|c| c * c).sum::<f64>();
        q[chart] = rest.max(0.0).sqrt();
        q.map(|c| c as f32)
    }

    fn plain(self, q: [f32; 4], bits: u32) -> u64 {
        let q = self.original.unit(q);
        let chart = largest(q, self.charts());
        let sign = if q[chart] < 0.0 { -1.0 } else { 1.0 };
        let number = |i: usize| self.original.number(sign * q[i], bits).min(mask(bits));
        self.code(chart, self.others(chart).map(number), bits)
    }

    /// The nearest code of all that are of unit length, in any chart. Of a rotation that is nearer than some distance, q or -q
    /// has no component that is farther off than that: all such points are tried, beginning with the corners of q's cell.
    fn nearest(self, q: [f64; 4], bits: u32) -> u64 {
        let first = largest(q, self.charts());
        let upright = if q[first] < 0.0 { q.map(|c| -c) } else { q };
        let mut best = self.best(upright, first, 1.0, bits, (f64::INFINITY, 0));
        for chart in self.charts() {
            for q in [q, q.map(|c| -c)] {
                // Places are rounded to less than the last summand.
                let reach = (best.0 + self.tolerance(bits)) / self.step(bits) + 1e-6;
                if q[*chart] >= -reach * self.step(bits) {
                    best = self.best(q, *chart, reach, bits, best);
                }
            }
        }
        best.1
    }

    /// The nearest code of a chart whose numbers are within reach, in steps, or the best so far: distances and codes.
    fn best(self, q: [f64; 4], chart: usize, reach: f64, bits: u32, mut best: (f64, u64)) -> (f64, u64) {
        let ((most, middle), step, tolerance) =
            (self.lattice.sizes(bits), self.step(bits), self.tolerance(bits));
        let others = self.others(chart);
        // What meshoptimizer's f32 adds to the fourth component, or the rounding of places.
        let slack = if self.layout == Layout::Lanes { 3e-6 } else { 1e-6 * step };
        let ranges = others.map(|i| {
            let place = q[i] / step;
            let [from, to] = [(place - reach).max(-most), (place + reach).min(most)];
            [from + middle, to + middle]
        });
        for point in points(ranges) {
            let number = |k: usize| (f64::from(point[k]) - middle) * step;
            let (square, length_squared) = (0..3).fold((0.0, 0.0), |(square, length), k| {
                let off = number(k) - q[others[k]];
                (square + off * off, length + number(k) * number(k))
            });
            // What is decoded is off the point by the tolerance, and q off the point by its three components at least. With
            // the fourth: `(rest - q_c)^2 > room`, squared once more to have no root; decoders in f32 lose it where it is small.
            let farthest = best.0 + tolerance + slack;
            let (room, rest) = (farthest * farthest - square, (1.0 - length_squared).max(0.0));
            let (least, upright) = (rest + q[chart] * q[chart] - room, q[chart].max(0.0));
            if room < 0.0 || rest > 0.01 && least > 0.0 && least * least > 4.0 * upright * upright * rest {
                continue;
            }
            let code = self.code(chart, point.map(|number| self.lattice.bits_of(number, bits)), bits);
            let decoded = self.decode(code, bits);
            let off = distance(q, decoded);
            if off < best.0 && (length(decoded.map(f64::from)) - 1.0).abs() <= tolerance {
                best = (off, code);
            }
        }
        best
    }
}

/// The decoder of meshoptimizer's filter: words, rounded half away from 0; here divided by the largest.
fn of_words(code: u64, chart: usize) -> [f32; 4] {
    let word = |lane: usize| i32::from((code >> (16 * lane)) as i16);
    let scale = 1.0 / 2f32.sqrt() / (word(3) | 3) as f32;
    let [x, y, z] = [0, 1, 2].map(|lane| word(lane) as f32 * scale);
    let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
    let mut q = [0.0; 4];
    for (lane, c) in [w, x, y, z].into_iter().enumerate() {
        let rounded = (c * 32_767.0 + if c >= 0.0 { 0.5 } else { -0.5 }) as i16;
        q[(chart + lane) & 3] = f32::from(rounded) / 32_767.0;
    }
    q
}

/// The quaternion of unit length.
fn unit(q: [f32; 4]) -> [f64; 4] {
    let q = q.map(f64::from);
    q.map(|c| c / length(q))
}

/// The quaternion as it is, for originals that take it for one of unit length; others are made such, in f32.
fn given(q: [f32; 4]) -> [f64; 4] {
    let wide = q.map(f64::from);
    if (length(wide) - 1.0).abs() <= 1e-3 { wide } else { unit(q).map(|c| f64::from(c as f32)) }
}

/// The plain encoders, in the originals' precision and order of operations.
impl Original {
    /// The quaternion that the original rounds.
    fn unit(self, q: [f32; 4]) -> [f64; 4] {
        let [x, y, z, w] = q;
        let norm = (x * x + y * y + z * z + w * w).sqrt();
        // A sum in f64 that begins with w.
        let wide = length([w, x, y, z].map(f64::from));
        match self {
            Self::Spz | Self::Spz2 if !norm.is_normal() => unit(q),
            // Without -0.
            Self::Spz | Self::Spz2 => q.map(|c| f64::from(c / norm + 0.0)),
            Self::Sog => q.map(|c| f64::from(c) / wide),
            Self::Ply => q.map(|c| f64::from(c) * (1.0 / wide)),
            Self::Mirror | Self::League | Self::Fiedler | Self::Meshopt => given(q),
        }
    }

    /// The bits of a component's number.
    fn number(self, t: f64, bits: u32) -> u32 {
        /// 2 with a root of 12 digits.
        const ROOT: f64 = 141_421_356_237.0 / 1e11;
        let (narrow, most) = (t as f32, f64::from(mask(bits)));
        let relative = |range: f32| (narrow + range) / (range + range) * most as f32;
        match self {
            Self::Mirror => relative(MIRROR_RANGE) as u32,
            Self::Fiedler => (relative(FIEDLER_RANGE) + 0.5) as u32,
            Self::League => (most / 2.0 * (ROOT * t + 1.0)).round_ties_even() as u32,
            Self::Ply => ((t * (SQRT_2 * 0.5) + 0.5) * most + 0.5) as u32,
            Self::Sog => (most * (t * SQRT_2 * 0.5 + 0.5)) as u32,
            Self::Spz => {
                let largest = mask(bits - 1) as f32;
                let magnitude = largest * (narrow.abs() / core::f32::consts::FRAC_1_SQRT_2) + 0.5;
                // A component of 0 has a sign, too.
                magnitude as u32 | u32::from(t.is_sign_negative()) << (bits - 1)
            }
            Self::Spz2 => (narrow * 127.5 + 127.5).round() as u32,
            Self::Meshopt => snorm(narrow * 2f32.sqrt(), bits) as u32 & mask(bits),
        }
    }
}

/// The deviation from unit length that glTF's validator lets pass: unitLengthThresholdVec4 of glTF-Validator 434283be.
const VALID: f64 = 0.007_69;

/// The numbers of four signed components: rounded, or the nearest that the validator takes for a unit quaternion.
fn four(q: [f32; 4], bits: u32, is_plain: bool) -> [i32; 4] {
    let plain = given(q).map(|c| snorm(c as f32, bits));
    if is_plain {
        return plain;
    }
    let q = unit(q);
    let (most, axis) = (largest_number(bits), largest(q, &[0, 1, 2, 3]));
    let (off, rounded) = valid_rounded(q, axis, most).unwrap_or((f64::INFINITY, plain));
    // Slices are inclined to the ray: in its slice, a point as far from the ray is farther from the ray's.
    let reach = (off * most * (1.0 + VALID)).min(1.5) / q[axis].abs();
    // Up to half a step, rounding has found it.
    if reach > 0.5 { valid_beside(q, axis, most, reach, (off, rounded)) } else { rounded }
}

/// True for a point that the validator takes for a unit quaternion.
fn is_valid(point: [i32; 4], most: f64) -> bool {
    let length = length(point.map(f64::from));
    (length / most - 1.0).abs() < VALID && point.iter().all(|c| f64::from(c.abs()) <= most)
}

/// The slices with valid points within reach of the ray, whose largest component is `size`. The points of a slice have the
/// same number for the largest component.
fn slices(size: f64, most: f64, reach: f64) -> core::ops::RangeInclusive<i32> {
    let [from, to] = [-VALID, VALID].map(|off| size * (most * (1.0 + off) + reach * off.signum()));
    from.max(1.0) as i32..=to as i32
}

/// The nearest valid point of those that rounding gives in each slice, and its distance.
fn valid_rounded(q: [f64; 4], axis: usize, most: f64) -> Option<(f64, [i32; 4])> {
    /// A sum with it is rounded to a whole number.
    const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
    const SLICES: usize = 8;
    let others = [1, 2, 3].map(|i| q[(axis + i) & 3]);
    let (size, slices, mut best) = (q[axis].abs(), slices(q[axis].abs(), most, 0.5), None);
    let (mut nearest, by_size) = (f64::INFINITY, 1.0 / size);
    let slopes = others.map(|c| c * by_size);
    // The squared tangents of several slices at a time, in registers of the CPU.
    for first in slices.clone().step_by(SLICES) {
        let mut squares = [0.0; SLICES];
        for (i, square) in squares.iter_mut().enumerate() {
            let slice = f64::from(first + i as i32);
            let off = slopes.map(|slope| slope * slice - ((slope * slice + WHOLE) - WHOLE));
            let inward = off[0] * others[0] + off[1] * others[1] + off[2] * others[2];
            let across = off[0] * off[0] + off[1] * off[1] + off[2] * off[2] - inward * inward;
            let along = slice * by_size - inward;
            *square = across / (along * along);
        }
        for (slice, square) in (first..=*slices.end()).zip(squares) {
            if square < nearest {
                let point = q.map(|c| (c / size * f64::from(slice)).round_ties_even() as i32);
                if is_valid(point, most) {
                    (nearest, best) = (square, Some(point));
                }
            }
        }
    }
    best.map(|point| (nearest.max(0.0).sqrt(), point))
}

/// The nearest valid point of all within reach of the ray in each slice, or the best so far.
fn valid_beside(q: [f64; 4], axis: usize, most: f64, reach: f64, mut best: (f64, [i32; 4])) -> [i32; 4] {
    for slice in slices(q[axis].abs(), most, reach) {
        let ray = q.map(|c| c / q[axis].abs() * f64::from(slice));
        let mut ranges = ray.map(|t| [t - reach, t + reach]);
        ranges[axis] = [ray[axis].round(); 2];
        for point in points(ranges).filter(|point| is_valid(*point, most)) {
            let off = distance(q, point.map(|c| c as f32));
            if off < best.0 {
                best = (off, point);
            }
        }
    }
    best.1
}
