//! The nearest point of a lattice to a ray, of those whose length glTF's validator takes for 1: normals and rotations.

use super::quaternion::{largest, length, parts, points};

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
        self.search_rounded();
        // Slices are inclined to the ray: in its slice, a point as far from the ray is farther from the ray's.
        let off = self.square.sqrt() * self.most * (1.0 + self.valid);
        let reach = off.min(1.5) * length(self.slopes);
        // Up to half a step, rounding has found it.
        if reach > 0.5 {
            self.search_beside(reach);
        }
    }

    /// The slices with valid points within reach of the ray.
    fn slices(&self, reach: f64) -> core::ops::RangeInclusive<i32> {
        let [from, to] = [-1.0, 1.0].map(|side| self.most * (1.0 + side * self.valid) + side * reach);
        (from / length(self.slopes)).max(1.0) as i32..=(to / length(self.slopes)) as i32
    }

    /// Offers the points that rounding gives in each slice.
    fn search_rounded(&mut self) {
        const SLICES: usize = 8;
        let (squared_length, slices) = (parts(self.slopes, self.slopes).1, self.slices(0.5));
        // Several slices at a time, in registers of the CPU.
        for first in slices.clone().step_by(SLICES) {
            let mut squares = [0.0; SLICES];
            for (i, square) in squares.iter_mut().enumerate() {
                let slice = f64::from(first + i as i32);
                let (mut off_squared, mut off_along) = (0.0, 0.0);
                for slope in self.slopes {
                    let off = whole(slope * slice) - slope * slice;
                    off_squared += off * off;
                    off_along += off * slope;
                }
                let along = slice * squared_length + off_along;
                *square = (off_squared * squared_length - off_along * off_along) / (along * along);
            }
            for (slice, square) in (first..=*slices.end()).zip(squares) {
                // A little more than is needed, since the slopes are rounded.
                if square.max(0.0) < 1.001 * self.square {
                    self.offer(self.slopes.map(|slope| whole(slope * f64::from(slice)) as i32));
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
