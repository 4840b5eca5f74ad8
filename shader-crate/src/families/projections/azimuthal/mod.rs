//! Azimuthal codes: a hemisphere on a disk by a classic map projection, the disk on a square or as it is, and one bit
//! for the hemisphere.
//!
//! Source: Cigolle et al. 2014, section 2; Snyder, "Map Projections: A Working Manual", 1987 (the projections); Shirley
//! and Chiu, "A Low Distortion Map Between Disk and Square", 1997 (concentric). The survey's ellipse map is in its
//! supplement, not in its text. Ours is inferred: the elliptical grid map, which is not equal-area as the survey's is
//! said to be, has the means of its table 1. Three [`Projection`]s times three [`SquareMap`]s, at five widths.
//!
//! With `rho = sqrt(x^2 + y^2)`, on the unit sphere:
//!
//! | projection | disk point | back, with `rim = 1 - r^2` |
//! |---|---|---|
//! | [`Stereo`] | `r = rho / (1 + abs(z))` | `(2 p, rim) / (2 - rim)` |
//! | [`Eqarea`] | `r = sqrt(1 - abs(z)) = rho / sqrt(1 + abs(z))` | `(p sqrt(1 + rim), rim)` |
//! | [`Eqdist`] | `r = 2/pi atan2(rho, abs(z))` | `(p sin(pi r / 2) / r, cos(pi r / 2))` |
//!
//! * Layout: u, snorm of `BITS / 2` bits in two's complement, in the low bits; v, n = `BITS / 2 - 1` bits in two's
//!   complement, above it; the hemisphere (1 for z < 0) in the highest bit.
//! * v runs from `-2^(n-1)` to `2^(n-1)` in steps of `2^-(n-1)`, where snorm has `2^(n-1) - 1`. Its two ends share the
//!   pattern of `-2^(n-1)`. They lie on the equator (on the disk as it is, also beyond), which both hemispheres share.
//!   So the highest bit is free to tell them apart there: 1 says +1, 0 says -1.
//! * Error: never more than [`Codec::MAX_ERROR_DEG`], which is `K / 2^(n-1)` radians. The image of the straight segment
//!   from a point to its lattice point is at least as long as the angle between their directions. K is the greatest
//!   length that half a step of u with half a step of v has on the sphere: see [`SquareMap::STRETCH`].
//! * The six axes round-trip exactly. A direction mirrored at a coordinate plane gets the mirrored vector, exactly. x
//!   and y cannot be swapped: u has twice the steps.
//! * Good for: comparison with the survey. [`oct`](crate::oct) has a lower mean error at each width and costs less; its
//!   precise encoder has a lower maximum too. Of these, [`Eqarea`] with [`Ellipse`] has the lowest mean, [`Eqdist`] the
//!   lowest maxima. A code of the survey's own program is not one of these: its v has other steps.
//! * Weaknesses: without a map to the square a part of `1 - pi/4` of the codes is spare. [`Concentric`] creases at the
//!   diagonals, where its maxima lie. Codes of the equator come in pairs, one for each hemisphere.
//!
//! Not stable across devices: 32 bits without a map. Lattice points beyond the rim are moved by up to 31/64 of a step. That
//! leaves 1/64 to the border of their cell, which is 8 2^-24, and plain encoding on a device that divides as badly as Vulkan
//! allows is off by up to twice as much. Such a code may come back as its neighbour on the rim.
//!
//! Why v is not an snorm: at 16 bits its steps would be 1/63, not 1/64, and the errors would be above the survey's,
//! some means by more than a hundredth. As it is, all means agree with the published ones. A grid without zero
//! (u of 255 steps, v of 127) would come as near, but would not have the axes. The maxima of the equal-area maps with
//! concentric are those of a few cells on the rim at the diagonals, which a sample hits or misses.
//!
//! Why +ellipse has lower maxima here than in the survey (stereo from 20 bits on, eqdist from 22, eqarea at 32; the
//! others are as good): the usual way back to the square,
//! `sqrt(2 + d + 2 sqrt(2) x) / 2 - sqrt(2 + d - 2 sqrt(2) x) / 2` with `d = x^2 - y^2`, takes the root of a difference
//! that vanishes at the square's corners, so that an error of 2^-24 becomes one of 2^-12. Here that difference does not
//! occur: see [`Ellipse`]. Its maxima at 32 bits are those of exact arithmetic.
//!
//! <!-- generated: errors azimuthal -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `stereo16` | 0.399 | 1.00 | 1.00 |
//! | `stereo20` | 0.0997 | 0.250 | 0.251 |
//! | `stereo22` | 0.0498 | 0.125 | 0.125 |
//! | `stereo24` | 0.0249 | 0.0626 | 0.0628 |
//! | `stereo32` | 0.00156 | 0.00391 | 0.00404 |
//! | `stereo_concentric16` | 0.374 | 1.33 | 1.39 |
//! | `stereo_concentric20` | 0.0934 | 0.340 | 0.347 |
//! | `stereo_concentric22` | 0.0467 | 0.171 | 0.173 |
//! | `stereo_concentric24` | 0.0233 | 0.0852 | 0.0868 |
//! | `stereo_concentric32` | 0.00146 | 0.00537 | 0.00558 |
//! | `stereo_ellipse16` | 0.381 | 1.00 | 1.00 |
//! | `stereo_ellipse20` | 0.0951 | 0.250 | 0.251 |
//! | `stereo_ellipse22` | 0.0475 | 0.125 | 0.125 |
//! | `stereo_ellipse24` | 0.0238 | 0.0626 | 0.0628 |
//! | `stereo_ellipse32` | 0.00149 | 0.00391 | 0.00404 |
//! | `eqarea16` | 0.385 | 0.996 | 1.03 |
//! | `eqarea20` | 0.0962 | 0.249 | 0.259 |
//! | `eqarea22` | 0.0481 | 0.125 | 0.129 |
//! | `eqarea24` | 0.0241 | 0.0625 | 0.0647 |
//! | `eqarea32` | 0.00150 | 0.00391 | 0.00416 |
//! | `eqarea_concentric16` | 0.365 | 1.04 | 1.04 |
//! | `eqarea_concentric20` | 0.0913 | 0.259 | 0.260 |
//! | `eqarea_concentric22` | 0.0456 | 0.130 | 0.130 |
//! | `eqarea_concentric24` | 0.0228 | 0.0649 | 0.0651 |
//! | `eqarea_concentric32` | 0.00143 | 0.00407 | 0.00419 |
//! | `eqarea_ellipse16` | 0.351 | 0.911 | 0.915 |
//! | `eqarea_ellipse20` | 0.0875 | 0.228 | 0.229 |
//! | `eqarea_ellipse22` | 0.0438 | 0.114 | 0.114 |
//! | `eqarea_ellipse24` | 0.0219 | 0.0571 | 0.0573 |
//! | `eqarea_ellipse32` | 0.00137 | 0.00358 | 0.00369 |
//! | `eqdist16` | 0.382 | 0.787 | 0.812 |
//! | `eqdist20` | 0.0954 | 0.197 | 0.203 |
//! | `eqdist22` | 0.0477 | 0.0983 | 0.102 |
//! | `eqdist24` | 0.0238 | 0.0491 | 0.0509 |
//! | `eqdist32` | 0.00149 | 0.00307 | 0.00327 |
//! | `eqdist_concentric16` | 0.361 | 1.06 | 1.09 |
//! | `eqdist_concentric20` | 0.0901 | 0.268 | 0.272 |
//! | `eqdist_concentric22` | 0.0450 | 0.135 | 0.136 |
//! | `eqdist_concentric24` | 0.0225 | 0.0676 | 0.0682 |
//! | `eqdist_concentric32` | 0.00141 | 0.00420 | 0.00438 |
//! | `eqdist_ellipse16` | 0.355 | 0.787 | 0.788 |
//! | `eqdist_ellipse20` | 0.0885 | 0.197 | 0.197 |
//! | `eqdist_ellipse22` | 0.0442 | 0.0983 | 0.0985 |
//! | `eqdist_ellipse24` | 0.0221 | 0.0491 | 0.0493 |
//! | `eqdist_ellipse32` | 0.00138 | 0.00307 | 0.00317 |
//! <!-- end -->

mod disk;
mod square;

pub use disk::*;
pub use square::*;

use crate::arith::{
    SnormDivision, exp2, floor, is_negative, is_set, negate_if, negate_positive, ratio, reciprocal,
    signed_code, signed_integer, signed_quotient, snorm_clamp, snorm_integer, snorm_max,
};
use crate::codec::{Codec, Width};
use crate::direction::or_z;
use core::marker::PhantomData;
use glam::{Vec2, Vec3};

/// The lattice of a width.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// The largest integers of u and v: v's is a power of two, see the module's layout.
    pub largest: Vec2,
    by_u: SnormDivision,
    v_step: f32,
}

impl Lattice {
    /// The lattice of `bits` bits. For constants only: see [`SnormDivision::new`].
    pub const fn new(bits: u32) -> Self {
        let v_step = exp2(2 - bits as i32 / 2);
        let largest = Vec2::new(snorm_max(bits / 2), (1 << (bits / 2 - 2)) as f32);
        Self { largest, by_u: SnormDivision::new(bits / 2), v_step }
    }

    /// `e / largest`, without a division, so that all devices agree on which points are inside the disk. Correctly
    /// rounded for whole `e`.
    #[inline(always)]
    fn parts(self, e: Vec2) -> Vec2 {
        Vec2::new(self.by_u.of(e.x), e.y * self.v_step)
    }

    /// `p / largest`, rounded as the device divides; v's is a power of two.
    #[inline(always)]
    fn over_largest(self, p: Vec2) -> Vec2 {
        Vec2::new(signed_quotient(p.x, self.largest.x), p.y * self.v_step)
    }
}

/// The place of the direction of `v`, of this L1 norm, on the square, without signs.
#[inline(always)]
fn to_square<P: Projection, S: SquareMap>(v: Vec3, norm: f32) -> Vec2 {
    S::to_square(P::to_disk(v.abs() * reciprocal(norm)))
}

/// The projection `P` of the direction of `v`, laid on the square by `S`, unquantised: u and v on \[-1, 1\], and 1 for z < 0,
/// else 0. (0, 0, 0), which is +Z, where `v` has no direction.
///
/// An SNORM format that stores u and v holds another code than this family's, whose v has steps of a power of two.
#[must_use]
#[inline(always)]
pub fn project<P: Projection, S: SquareMap>(v: Vec3) -> Vec3 {
    let (v, norm) = or_z(v);
    let s = to_square::<P, S>(v, norm);
    let below = if is_negative(v.z) { 1.0 } else { 0.0 };
    Vec3::new(signed(is_negative(v.x), s.x), signed(is_negative(v.y), s.y), below)
}

/// The direction of u and v, clamped to \[-1, 1\], below the equator where the third is 1/2 or more. +-Z where u or v is NaN.
/// On the disk as it is, points beyond the rim are moved to it, towards the middle.
#[must_use]
#[inline(always)]
pub fn unproject<P: Projection, S: SquareMap>(e: Vec3) -> Vec3 {
    let s = snorm_clamp(Vec2::new(e.x, e.y));
    let n = P::from_disk(S::square_to_disk(s.abs()));
    Vec3::new(signed(s.x < 0.0, n.x), signed(s.y < 0.0, n.y), signed(is_set(e.z), n.z))
}

unorm_projection!(<P: Projection, S: SquareMap>);

/// `stretch` steps of v in degrees, and the error of rounding the position in f32: at most 2^-21 per axis, of which
/// four times the length of `k/2` and 1/2 are more than enough.
const fn error_bound(stretch: f32, bits: u32) -> f32 {
    (stretch * (ratio(1.0, Lattice::new(bits).largest.y) + 4.0 / 2_097_152.0)).to_degrees()
}

/// Azimuthal code of `BITS` bits (16, 20, 22, 24 or 32): the projection `P`, laid on the square by `S`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Azimuthal<P: Projection, S: SquareMap, const BITS: u32>(PhantomData<(P, S)>);

impl<P: Projection, S: SquareMap, const BITS: u32> Azimuthal<P, S, BITS> {
    const LATTICE: Lattice = Lattice::new(BITS);
}

impl<P: Projection, S: SquareMap, const BITS: u32> Codec for Azimuthal<P, S, BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const STABLE_ACROSS_DEVICES: bool = S::INDEX != Plain::INDEX || BITS < 32;
    const MAX_ERROR_DEG: f32 = error_bound(S::STRETCH[P::INDEX as usize], BITS);
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let (u_bits, v_bits) = (BITS / 2, BITS / 2 - 1);
        let m = Self::LATTICE.largest;
        let (v, norm) = or_z(v);
        let s = to_square::<P, S>(v, norm);
        let e = S::settle(Vec2::new(floor(s.x * m.x + 0.5), floor(s.y * m.y + 0.5)), Self::LATTICE);

        let (left, back, below) = (is_negative(v.x), is_negative(v.y), is_negative(v.z));
        let flag = if e.y < m.y { below } else { !back };
        let sign = if flag { 1 << (BITS - 1) } else { 0 };
        signed_code(negate_if(left, e.x), u_bits)
            | (signed_code(negate_if(back, e.y), v_bits) << u_bits)
            | sign
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let (u_bits, v_bits) = (BITS / 2, BITS / 2 - 1);
        let m = Self::LATTICE.largest;
        let u = snorm_integer(code, u_bits);
        let v = signed_integer(code >> u_bits, v_bits);
        let flag = code & (1 << (BITS - 1)) != 0;

        let n = P::from_disk(S::to_disk(Vec2::new(u.abs(), v.abs()), Self::LATTICE));
        let back = v < 0.0 && !(flag && v <= -m.y);
        // The same for numbers that are not negative: GPUs take less for one, CPUs for the other.
        let part = |negative, x| {
            if cfg!(target_arch = "spirv") { negate_positive(negative, x) } else { signed(negative, x) }
        };
        Vec3::new(part(u < 0.0, n.x), part(back, n.y), signed(flag, n.z))
    }
}

/// `-x` where `negative`, else `x`; 0 where x is not positive.
#[inline(always)]
fn signed(negative: bool, x: f32) -> f32 {
    if x > 0.0 { negate_if(negative, x) } else { 0.0 }
}
