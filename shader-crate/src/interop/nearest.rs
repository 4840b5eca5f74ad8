//! The nearest point of a lattice to a ray, of those whose length glTF's validator takes for 1: normals and rotations.

use super::quaternion::{largest, length, parts, points};
use crate::arith::min;
use crate::slice::machine::{Level, Task};
use core::ops::RangeInclusive;

/// Slices that are looked at together: two registers of 16 numbers, or four of 8.
const LANES: usize = 32;

/// The most blocks of slices: of 16 bits 32767 * (2 * 0.0077 + 1 / 32767) slices have points within half a step of the ray, and the
/// blocks on either side of unit length end in part empty.
const BLOCKS: usize = 18;

/// The part of the least square offset up to which a point may be the nearest. Angles are offsets by lengths, of which valid
/// ones differ by up to 1.6 %: 3.2 % in squares, and a margin.
const ABOUT: f32 = 1.1;

/// The allowance for the error of square offsets, in squares of parts of a step. Offsets are right to 2^8 parts or, of half a
/// step, to 2^-23 of themselves, so that this is a margin too.
const ROUNDED: f32 = 1.0e9;

/// A search of `N` components. The points of a slice have the same number for the ray's largest component.
pub(super) struct Nearest<const N: usize> {
    ray: [f64; N],
    /// The ray where its largest component is 1 or -1.
    slopes: [f64; N],
    /// The place of that component.
    axis: usize,
    /// The largest component of a point, and its length.
    most: f64,
    /// The deviation from that length that is valid, as a part of it.
    valid: f64,
    /// The square of the tangent of the angle between the ray and the point found.
    square: f64,
    /// The nearest valid point so far, or the one that stands for none.
    pub(super) found: [i32; N],
}

impl<const N: usize> Nearest<N> {
    pub(super) fn new(ray: [f64; N], most: f64, valid: f64, found: [i32; N]) -> Self {
        let axis = largest(ray, &core::array::from_fn::<_, N, _>(|place| place));
        let slopes = ray.map(|c| c / ray[axis].abs());
        Self { ray, slopes, axis, most, valid, square: f64::INFINITY, found }
    }

    /// Takes the point if it is valid and nearer.
    #[inline(always)]
    pub(super) fn offer(&mut self, point: [i32; N]) {
        let numbers = point.map(f64::from);
        if self.is_valid(numbers) {
            let (across, along) = parts(self.ray, numbers);
            let square = across / (along * along);
            if square < self.square {
                (self.square, self.found) = (square, point);
            }
        }
    }

    #[inline(always)]
    fn is_valid(&self, point: [f64; N]) -> bool {
        let [shortest, longest] = [-self.valid, self.valid].map(|off| self.most * (1.0 + off));
        let fits = point.iter().all(|c| c.abs() <= self.most);
        let square = point.iter().fold(0.0, |sum, c| sum + c * c);
        fits && shortest * shortest < square && square < longest * longest
    }

    /// Looks at all points that may be nearer.
    pub(super) fn search(&mut self) {
        Level::best().run(Rounded(self));
        // Slices are inclined to the ray: in its slice, a point as far from the ray is farther from the ray's.
        let off = self.square.sqrt() * self.most * (1.0 + self.valid);
        let reach = off.min(1.5) * length(self.slopes);
        // Up to half a step, rounding has found it.
        if reach > 0.5 {
            self.search_beside(reach);
        }
    }

    /// The slices with valid points within reach of the ray.
    fn slices(&self, reach: f64) -> RangeInclusive<i32> {
        let [from, to] = [-1.0, 1.0].map(|side| self.most * (1.0 + side * self.valid) + side * reach);
        let [from, to] = [from, to].map(|along| along / length(self.slopes));
        from.max(1.0) as i32..=to.min(self.most) as i32
    }

    /// Offers the points that rounding gives in each slice, if they are off by about the least: first those of unit length
    /// and more, so that of points on one ray the one of about unit length is taken. Offsets are counted in f32, so that a
    /// register holds many slices, and few points are left for float64.
    #[inline(always)]
    fn search_rounded(&mut self) {
        let slices = self.slices(0.5);
        let (start, end) = (*slices.start(), *slices.end());
        let of_unit = (self.most / length(self.slopes)) as i32;
        let upper = (of_unit..end + 1).step_by(LANES);
        let blocks = || upper.clone().chain((start..of_unit).step_by(LANES));
        // The components but the largest, which is that of the slice.
        let mut slopes = self.slopes;
        slopes.swap(0, self.axis);
        let narrow = slopes.map(|slope| slope as f32);
        let mut lanes = [[0; LANES]; N];
        for c in 1..N {
            let parts = parts_of_step(slopes[c]);
            lanes[c] = core::array::from_fn(|i| parts.wrapping_mul(i as u32));
        }
        let (mut squares, mut least) = ([[f32::INFINITY; LANES]; BLOCKS], [f32::INFINITY; LANES]);
        for (first, squares) in blocks().zip(&mut squares) {
            let at_first = slopes.map(|slope| parts_of_step(slope * f64::from(first)));
            for i in 0..LANES {
                let mut off = [0.0; N];
                for c in 1..N {
                    off[c] = at_first[c].wrapping_add(lanes[c][i]) as i32 as f32;
                }
                let mut square = 0.0;
                for c in 1..N {
                    square += off[c] * off[c];
                    for d in c + 1..N {
                        let area = off[c] * narrow[d] - off[d] * narrow[c];
                        square += area * area;
                    }
                }
                squares[i] = square;
                // Of slices at the ends, points may not be valid.
                let slice = first + i as i32;
                let is_valid = (slice > start + 1) & (slice < end - 1);
                least[i] = min(least[i], if is_valid { square } else { f32::INFINITY });
            }
        }
        let limit = ABOUT * least.into_iter().fold(f32::INFINITY, min) + ROUNDED;
        for (first, squares) in blocks().zip(&squares) {
            let mut is_any = false;
            for square in squares {
                is_any |= *square < limit;
            }
            if is_any {
                for (slice, square) in (first..=end).zip(squares) {
                    if *square < limit {
                        self.offer(self.slopes.map(|slope| whole(slope * f64::from(slice)) as i32));
                    }
                }
            }
        }
    }

    /// Offers all points within reach of the ray in each slice.
    fn search_beside(&mut self, reach: f64) {
        for slice in self.slices(reach) {
            let at = self.slopes.map(|slope| slope * f64::from(slice));
            let mut ranges = at.map(|t| [t - reach, t + reach]);
            ranges[self.axis] = [at[self.axis]; 2];
            points(ranges).for_each(|point| self.offer(point));
        }
    }
}

/// The nearest whole number, of numbers below 2^51.
#[inline(always)]
fn whole(x: f64) -> f64 {
    const ONE_AND_A_HALF_2_52: f64 = 6_755_399_441_055_744.0;
    (x + ONE_AND_A_HALF_2_52) - ONE_AND_A_HALF_2_52
}

/// The parts of a step that offsets are counted in.
const STEP: f64 = 4_294_967_296.0;

/// The parts of a step beyond the nearest whole number, in two's complement.
#[inline(always)]
fn parts_of_step(x: f64) -> u32 {
    (x * STEP) as i64 as u32
}

/// The search of the points that rounding gives.
struct Rounded<'a, const N: usize>(&'a mut Nearest<N>);

impl<const N: usize> Task for Rounded<'_, N> {
    #[inline(always)]
    fn run(self, _: Level) {
        self.0.search_rounded();
    }
}
