//! The plane that the components are stored in, and the points outside its border.

use crate::arith::{SnormDivision, floor, max, min, ratio, snorm_max};
use glam::Vec2;

/// The inset of points outside, when they are decoded, in steps.
pub(super) const INSET: f32 = 0.4375;

/// The extent of a sextant: 2^-21 less than 1, so that rounding does not turn the largest component into another.
const SEXTANT_LIMIT: f32 = 0.999_999_5;

/// The factor that takes a point of this extent, from 1 on, inside, by 2^-21: the tangent of `1 / sqrt(extent)` at 1,
/// which nowhere is above it. A square root would differ from device to device. `half_unit` is half an extent of 1.
#[inline(always)]
pub(super) fn onto_border(extent: f32, half_unit: f32) -> f32 {
    1.499_999_5 - half_unit * extent
}

/// The plane that the components are stored in. For constants only: see [`SnormDivision::new`].
#[derive(Clone, Copy)]
pub(super) struct Plane {
    /// The widths of the two components.
    pub(super) x_bits: u32,
    pub(super) y_bits: u32,
    /// The largest whole numbers.
    m: Vec2,
    /// Steps in a unit.
    steps: Vec2,
    by_x: SnormDivision,
    by_y: SnormDivision,
    /// The size of a sextant's step.
    step: Vec2,
    /// Points are inside up to this [`extent`](Self::extent).
    limit: f32,
    /// Half an extent of 1.
    half_unit: f32,
    /// The inset of points outside, when they are decoded, in steps.
    inset: f32,
    /// Whether the border is that of a sextant and not of the disk.
    sextant: bool,
    /// Whether extents are those of points in steps: for two components of 8 bits, where they tell the same points
    /// outside.
    in_steps: bool,
}

impl Plane {
    /// The plane of the disk. With 23 bits and more a component has no room for an inset, and needs none: points
    /// outside are so by less than the length's rounding.
    pub(super) const fn disk(x_bits: u32, y_bits: u32) -> Self {
        let m = Vec2::new(snorm_max(x_bits), snorm_max(y_bits));
        let fine = x_bits > 22;
        let in_steps = x_bits == 8 && y_bits == 8;
        let square = m.x * m.x;
        // 1 + 3 2^-23: half a unit of the last place in length more than the coarser component is off.
        let unit_limit = if fine { 1.000_000_4 } else { 1.0 };
        Self {
            x_bits,
            y_bits,
            m,
            steps: m,
            by_x: SnormDivision::new(x_bits),
            by_y: SnormDivision::new(y_bits),
            step: Vec2::ZERO,
            limit: if in_steps { square } else { unit_limit },
            half_unit: if in_steps { ratio(0.5, square) } else { 0.5 },
            inset: if fine { 0.0 } else { INSET },
            sextant: false,
            in_steps,
        }
    }

    /// The plane of a sextant.
    pub(super) const fn sextant(u_bits: u32, v_bits: u32) -> Self {
        use core::f32::consts::{FRAC_1_SQRT_2, SQRT_2};
        let disk = Self::disk(u_bits, v_bits);
        let m = disk.m;
        Self {
            steps: Vec2::new(m.x * SQRT_2, m.y * SQRT_2),
            step: Vec2::new(ratio(1.0, m.x) * FRAC_1_SQRT_2, ratio(1.0, m.y) * FRAC_1_SQRT_2),
            limit: SEXTANT_LIMIT,
            sextant: true,
            ..disk
        }
    }

    /// `e` in units of the plane, without a division, so that all devices agree on which points are inside.
    #[inline(always)]
    fn parts(self, e: Vec2) -> Vec2 {
        if self.sextant { e * self.step } else { Vec2::new(self.by_x.of(e.x), self.by_y.of(e.y)) }
    }

    /// The extent of a point of the positive quadrant: the limit on the border.
    #[inline(always)]
    fn extent(self, e: Vec2) -> f32 {
        let p = if self.in_steps { e } else { self.parts(e) };
        let larger = max(p.x, p.y);
        let disk = p.x * p.x + p.y * p.y;
        if self.sextant { disk + larger * larger } else { disk }
    }

    /// Whether the border is reached sooner along the first component.
    #[inline(always)]
    fn is_along_x(self, e: Vec2) -> bool {
        if self.x_bits == self.y_bits {
            return e.x >= e.y;
        }
        let p = self.parts(e);
        let (x, y) = (p.x * self.steps.y, p.y * self.steps.x);
        let weighed_x = if p.x >= p.y { 2.0 } else { 0.5 } * x;
        if self.sextant { weighed_x >= y } else { x >= y }
    }

    /// The whole numbers of a point of the positive quadrant, inside or, before rounding, on the border.
    #[inline(always)]
    pub(super) fn round(self, p: Vec2) -> Vec2 {
        let e = Vec2::new(floor(p.x * self.steps.x + 0.5), floor(p.y * self.steps.y + 0.5));
        // Rounding exceeds m only where the steps are as fine as that of the length.
        let e = if self.inset > 0.0 { e } else { Vec2::new(min(e.x, self.m.x), min(e.y, self.m.y)) };
        let along_x = self.is_along_x(e);
        // Points outside when moved are outside as they are.
        let outside = self.extent(inwards(e, true, along_x, self.inset)) > self.limit;
        inwards(e, outside, along_x, 1.0)
    }

    /// The point that whole numbers, not negative, stand for: not outside.
    #[inline(always)]
    pub(super) fn point(self, e: Vec2) -> Vec2 {
        let extent = self.extent(e);
        let inset = inwards(e, extent > self.limit, self.is_along_x(e), self.inset);
        let onto_border = onto_border(extent, self.half_unit);
        let below = Vec2::new(floor(e.x * onto_border), floor(e.y * onto_border));
        self.parts(if self.extent(inset) > self.limit { below } else { inset })
    }
}

/// `e` with `by` steps less in the component along which the border is reached sooner, if it `moves`.
#[inline(always)]
fn inwards(e: Vec2, moves: bool, along_x: bool, by: f32) -> Vec2 {
    let less_x = if moves & along_x { by } else { 0.0 };
    let less_y = if moves & !along_x { by } else { 0.0 };
    Vec2::new(e.x - less_x, e.y - less_y)
}
