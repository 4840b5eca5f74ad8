//! Quaternions without one of their components: three numbers in equal steps.

use super::plain::snorm;
use super::quaternion::{distance, given, largest, largest_number, length, points, unit};
use crate::arith::{mask, signed_integer};
use core::f64::consts::SQRT_2;

/// Three components in equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Three {
    pub(super) lattice: Lattice,
    /// The component that the largest number stands for.
    pub(super) range: f64,
    pub(super) order: Order,
    pub(super) layout: Layout,
    pub(super) original: Original,
}

/// The numbers of a component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lattice {
    /// From 0 to `2^b - 1`: none stands for 0.
    Unorm,
    /// From `1 - 2^(b-1)` to `2^(b-1) - 1`, in two's complement.
    Snorm,
    /// The same, as a magnitude and a sign above it.
    Signed,
}

/// The order of the components, and which may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
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
pub(super) enum Layout {
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
pub(super) enum Original {
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
pub(super) const MIRROR_RANGE: f32 = 707_107.0 / 1e6;
pub(super) const FIEDLER_RANGE: f32 = 1.0 / (1_414_214.0 / 1e6);

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
            Self::Snorm => signed_integer(code, bits).into(),
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
    pub(super) fn bound(self, bits: u32) -> f64 {
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

    pub(super) fn decode(self, code: u64, bits: u32) -> [f32; 4] {
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

    pub(super) fn plain(self, q: [f32; 4], bits: u32) -> u64 {
        let q = self.original.unit(q);
        let chart = largest(q, self.charts());
        let sign = if q[chart] < 0.0 { -1.0 } else { 1.0 };
        let number = |i: usize| self.original.number(sign * q[i], bits).min(mask(bits));
        self.code(chart, self.others(chart).map(number), bits)
    }

    /// The nearest code of all that are of unit length, in any chart. Of a rotation that is nearer than some distance, q or -q
    /// has no component that is farther off than that: all such points are tried, beginning with the corners of q's cell.
    pub(super) fn nearest(self, q: [f64; 4], bits: u32) -> u64 {
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
