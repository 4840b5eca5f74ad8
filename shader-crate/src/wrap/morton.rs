//! The order of codes in which a prefix is a region: Morton's, of the codes of [`eaoct`](crate::eaoct).
//!
//! Source: Morton 1966, "A Computer Oriented Geodetic Data Base"; the cells' bound is ours.
//!
//! A code's two coordinates, counted from the corner of the square, have their bits interleaved: x in the even bits, y
//! in the odd, from bit 0 on. So the upper 2 d bits name one of 4^d squares of the map, and as the map keeps areas, all
//! but those at the square's border have equal areas. Neighbours in order are mostly neighbours on the sphere: what
//! lies in a cone is in a few ranges, which [`Cone`] gives, and so in few pages of a sorted file.
//!
//! * Layout: `BITS` bits, for codes of [`EaOct`] of 16, 20, 22, 24 or 32 bits. The pattern of `-2^(b-1)` that a
//!   coordinate never has counts as -1, as in the codec; so row and column 0 are not in use.
//! * Points of the square's border stand for the same direction as their mirror image there, and -Z has four codes:
//!   sort codes that an encoder wrote, or that [`EaOct`] decoded and encoded again.
//! * Good for: pages of sorted files, caches by direction, levels of detail. Not for size: the differences of sorted
//!   codes compress as well in the order of rows. The codes of the 16-bit format lie in the same order as the first 16
//!   bits of wider ones but for rounding: widths have lattices of their own.

use crate::angle_deg;
use crate::arith::{signed_code, snorm_max};
use crate::codec::Width;
use crate::eaoct::{EaOct, from_lattice};
use crate::families::octahedral::{pack, unpack};
use core::ops::RangeInclusive;
use glam::{Vec2, Vec3};

/// The most that the map lengthens a step of the square `[-1, 1]^2`, in degrees.
///
/// With `dr = du + dv` and `r dphi = dv - phi dr` the square of a step's length is
/// `4 dr^2 / c^2 + (pi/2)^2 c^2 (dv - phi dr)^2`, of a unit step at most `8 / c^2 + (pi/2)^2 c^2`, which is most at the
/// equator, where c is 1.
const DEG_PER_UNIT: f64 = 3.2354 * 180.0 / core::f64::consts::PI;

/// The place in Morton's order of a code of [`EaOct`] of `BITS` bits.
///
/// ```
/// use unitvec::wrap::morton::{from_morton, to_morton};
/// use unitvec::{Codec, EaOct16};
///
/// let code = EaOct16::encode([0.0, 0.6, 0.8]);
/// assert_eq!(from_morton::<16>(to_morton::<16>(code)), code);
/// ```
#[must_use]
pub fn to_morton<const BITS: u32>(code: u32) -> u32
where
    EaOct<BITS>: Width,
{
    let middle = 1 << (BITS / 2 - 1);
    let counted = |whole: f32| (whole as i32 + middle) as u32;
    let e = unpack::<BITS>(code);
    spread(counted(e.x)) | (spread(counted(e.y)) << 1)
}

/// The code of [`EaOct`] at a place in Morton's order: the inverse of [`to_morton`]. Bits above `BITS` are ignored.
#[must_use]
pub fn from_morton<const BITS: u32>(place: u32) -> u32
where
    EaOct<BITS>: Width,
{
    let e = coordinates::<BITS>(place);
    if BITS == 24 {
        pack::<BITS>(e)
    } else {
        signed_code(e.x, BITS / 2) | (signed_code(e.y, BITS / 2) << (BITS / 2))
    }
}

/// The lattice point of a place.
fn coordinates<const BITS: u32>(place: u32) -> Vec2 {
    let (middle, place) = (1i32 << (BITS / 2 - 1), place & (u32::MAX >> (32 - BITS)));
    let centred = |count: u32| (count as i32 - middle).max(1 - middle) as f32;
    Vec2::new(centred(gathered(place)), centred(gathered(place >> 1)))
}

/// The low 16 bits, each at twice its place.
fn spread(x: u32) -> u32 {
    let step = |x: u32, shift: u32, kept: u32| (x | (x << shift)) & kept;
    step(step(step(step(x & 0xffff, 8, 0x00ff_00ff), 4, 0x0f0f_0f0f), 2, 0x3333_3333), 1, 0x5555_5555)
}

/// The inverse of [`spread`], which ignores odd bits.
fn gathered(x: u32) -> u32 {
    let step = |x: u32, shift: u32, kept: u32| (x | (x >> shift)) & kept;
    step(step(step(step(x & 0x5555_5555, 1, 0x3333_3333), 2, 0x0f0f_0f0f), 4, 0x00ff_00ff), 8, 0xffff)
}

/// The ranges of places, in order, that have all codes of [`EaOct`] of `BITS` bits whose vectors lie in a cone.
///
/// They have others too, of cells that are partly in the cone: the fewer, the more `levels`.
///
/// ```
/// use unitvec::wrap::morton::{Cone, to_morton};
/// use unitvec::{Codec, EaOct16};
///
/// let code = EaOct16::encode([0.0, 0.1, 1.0]);
/// let mut ranges = Cone::<16>::new([0.0, 0.0, 1.0], 0.2, 6);
/// assert!(ranges.any(|places| places.contains(&to_morton::<16>(code))));
/// ```
#[derive(Clone, Debug)]
pub struct Cone<const BITS: u32> {
    axis: Vec3,
    half_angle_deg: f64,
    /// The levels of cells that stay whole where the cone's rim cuts them.
    whole_levels: u32,
    /// The first place that was not looked at.
    next: u64,
}

impl<const BITS: u32> Cone<BITS>
where
    EaOct<BITS>: Width,
{
    /// The cone of half-angle `half_angle`, in radians, about `axis`, of any length. Cells are divided `levels` times
    /// at most, so that the square has 4^levels; more than `BITS / 2` divide no further. Without an axis, or with a
    /// NaN, all codes are in one range.
    #[must_use]
    pub fn new(axis: impl Into<[f32; 3]>, half_angle: f32, levels: u32) -> Self {
        let axis = Vec3::from_array(axis.into());
        let half_angle_deg = f64::from(half_angle).to_degrees();
        Self { axis, half_angle_deg, whole_levels: (BITS / 2).saturating_sub(levels), next: 0 }
    }

    /// By how much, in degrees, the cell of `4^level` places from `next` on lies beyond the rim, at least, and how much
    /// of it at most.
    fn beyond(&self, level: u32) -> (f64, f64) {
        let m = snorm_max(BITS / 2);
        let reach = 0.5 * ((1u32 << level) - 1) as f32;
        let middle = coordinates::<BITS>(self.next as u32) + Vec2::splat(reach);
        let off = angle_deg(self.axis, from_lattice(middle, m)) - self.half_angle_deg;
        // Half the cell's diagonal, a step more for the row that is not in use; and the rounding of `f32`.
        let radius = DEG_PER_UNIT * core::f64::consts::SQRT_2 * f64::from(reach + 1.0) / f64::from(m) + 1e-4;
        (off - radius, off + radius)
    }
}

impl<const BITS: u32> Iterator for Cone<BITS>
where
    EaOct<BITS>: Width,
{
    type Item = RangeInclusive<u32>;

    fn next(&mut self) -> Option<RangeInclusive<u32>> {
        let mut found: Option<RangeInclusive<u32>> = None;
        while self.next < 1 << BITS {
            let mut level = (self.next.trailing_zeros() / 2).min(BITS / 2);
            let (mut least, mut most) = self.beyond(level);
            while level > self.whole_levels && !(least > 0.0 || most < 0.0 || most.is_nan()) {
                level -= 1;
                (least, most) = self.beyond(level);
            }
            let places = 1u64 << (2 * level);
            let last = (self.next + places - 1) as u32;
            let first = self.next as u32;
            self.next += places;
            match found {
                _ if least > 0.0 && found.is_some() => return found,
                _ if least > 0.0 => {}
                None => found = Some(first..=last),
                Some(range) => found = Some(*range.start()..=last),
            }
        }
        found
    }
}
