//! Octahedral codes with unorm coordinates: [`oct`](crate::oct)'s square in the formats that other engines store and
//! that devices can render to.
//!
//! Source: Cigolle et al. 2014, listings 1 to 3, with 2^b values of equal distance from -1 to 1. The search is ours.
//!
//! Scaled by `m = (2^b - 1) / 2`, the lattice has its points at odd multiples of 1/2, from -m to m: none lies in the
//! middle. Seen in the octant of positive components they stay there above the equator, and below it, where the square
//! is folded, become whole numbers. The edge z = 0 of an octant cuts cells in two.
//!
//! <!-- generated: errors uoct -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `uoct16p` | 0.314 | 0.635 | 0.636 |
//! | `uoct20p` | 0.0782 | 0.158 | 0.158 |
//! | `uoct24p` | 0.0195 | 0.0396 | 0.0396 |
//! | `uoct32p` | 0.00122 | 0.00248 | 0.00251 |
//! <!-- end -->
//!
//! * Layout: x in the low half of the code, y in the high half, both `i = e + m`, 0 to `2^b - 1`.
//! * Error: at most `sqrt(2) / m` radians, as with [`oct`](crate::oct), greatest in the middle of the octants. Steps are a
//!   part of 2^-b shorter than its own.
//! * Of the six axes only -Z round-trips exactly. +Z lies between four points, `1 / (sqrt(2) (m - 1))` radians from each,
//!   0.32 degrees at 16 bits; X and Y, of either sign, are `1 / (2 m - 1)` radians off, 0.23 degrees. Flat surfaces show it.
//!   Where your own shader decodes, store [`oct`](crate::oct)'s lattice in the same format by
//!   [`oct::to_unorm`](crate::oct::to_unorm): its axes are exact, its error greater by a part of 2^-b.
//! * Code 0, one of the four corners that stand for -Z, is never written.
//! * Good for: files and formats of others, see `interop`, and UNORM formats, which devices can render to where they
//!   cannot to SNORM ones. Weaknesses: the axes, and [`oct`](crate::oct)'s folds.

use super::nearest::nearest;
use crate::arith::{SnormDivision, TWO_23, mask, max, normalize_octahedral, ratio, unorm_max, with_sign};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use crate::oct::Oct;
use glam::{Vec2, Vec3};

/// The largest coordinate of the lattice of unorms of `bits` bits: `(2^bits - 1) / 2`.
#[inline(always)]
pub(crate) const fn largest(bits: u32) -> f32 {
    unorm_max(bits) * 0.5
}

/// The integers of a lattice point, x in the low `bits` bits (at most 16), y in the next. Of the corners, which are all -Z,
/// that of code 0 gets the code of the opposite one: some decoders, such as Cesium's shaders, take 0 for no vector.
#[inline(always)]
fn pack(e: Vec2, bits: u32) -> u32 {
    let integer = |e: f32| (e + largest(bits) + TWO_23).to_bits() & mask(bits);
    let code = integer(e.x) | (integer(e.y) << bits);
    if code == 0 { u32::MAX >> (32 - 2 * bits) } else { code }
}

/// The direction of a lattice point: unit length to within 2 ULP. All steps before the normalisation are exact.
#[inline(always)]
pub(crate) fn from_lattice(e: Vec2, m: f32) -> Vec3 {
    let z = m - e.x.abs() - e.y.abs();
    let below = max(-z, 0.0);
    let v = Vec3::new(e.x - with_sign(below, e.x), e.y - with_sign(below, e.y), z);
    normalize_octahedral(v, m, 0.5 * (m + 0.5))
}

/// The precise code of `BITS` bits, as values of a UNORM format of half as many bits, which stores them exactly.
#[must_use]
#[inline(always)]
pub fn project_precise<const BITS: u32>(v: Vec3) -> Vec2
where
    Oct<BITS>: Width,
{
    let code = UOctPrecise::<BITS>::encode_vec3(v);
    let by_most = const { SnormDivision::new(BITS / 2 + 1) };
    Vec2::new(by_most.of((code & mask(BITS / 2)) as f32), by_most.of((code >> (BITS / 2)) as f32))
}

/// Octahedral code of `BITS` bits (even, 4 to 32) in two unorms, precise encoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct UOctPrecise<const BITS: u32>;

impl<const BITS: u32> Codec for UOctPrecise<BITS>
where
    Oct<BITS>: Width,
{
    const BITS: u32 = BITS;
    /// The bound of [`oct`](crate::oct), for this lattice's steps.
    const MAX_ERROR_DEG: f32 =
        (core::f32::consts::SQRT_2 * (ratio(1.0, largest(BITS / 2)) + 1.0 / 2_097_152.0)).to_degrees();
    const EXACT_AXES: bool = false;
    const NULL: Option<[u32; 2]> = Some([0, 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let (norm, m) = (l1_norm(v), largest(BITS / 2));
        let code = pack(nearest(v, norm, m, 0.5), BITS / 2);
        if is_usable(norm) { code } else { pack(Vec2::splat(0.5), BITS / 2) }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let m = largest(BITS / 2);
        let (x, y) = (code & mask(BITS / 2), (code >> (BITS / 2)) & mask(BITS / 2));
        from_lattice(Vec2::new(x as f32 - m, y as f32 - m), m)
    }
}
