//! Parallel projections: two components stored, the third reconstructed from unit length.
//!
//! Source: Cigolle et al. 2014, section 5, table 3 (XYOnly); Meyer et al. 2010, section 4, eq. 6
//! (PP, for both hemispheres) and eq. 7 (SPP, from the six sides, the largest component reconstructed).
//!
//! `z = sqrt(1 - x^2 - y^2)`. Near the equator a small step of x or y is a large one of z: there the error of XYOnly
//! and PP grows as the square root of the step, which SPP avoids.
//!
//! <!-- generated: errors parallel -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `xyonly16` | 0.468 | 5.70 | 6.10 |
//! | `xyonly24` | 0.0383 | 1.49 | 1.52 |
//! | `xyonly32` | 0.00299 | 0.375 | 0.390 |
//! | `xyonly32f` | 0.0351 | 1.48 | 1.53 |
//! | `pp16` | 0.687 | 7.62 | 7.70 |
//! | `pp24` | 0.0566 | 1.89 | 1.91 |
//! | `pp32` | 0.00444 | 0.472 | 0.490 |
//! | `pp48` | 2.87e-5 | 0.0336 | 0.0710 |
//! | `spp16` | 0.429 | 1.19 | 1.32 |
//! | `spp24` | 0.0262 | 0.0740 | 0.0770 |
//! | `spp32` | 0.00164 | 0.00463 | 0.00480 |
//! | `spp48` | 6.47e-6 | 6.59e-5 | 8.00e-5 |
//! <!-- end -->
//!
//! * Layout: the first component in the low bits, then the second, both snorm in two's complement. Above them PP has
//!   the sign of z (1 if negative), SPP the sextant in three bits: twice the axis (0, 1, 2), and 1 if negative. Of the
//!   bits that are left, the first component has half, rounded up. The components of SPP are (y, z), (z, x), (x, y) in
//!   the sextants of x, y, z; they are at most sqrt(1/2), which is their 1. Sextants 6 and 7, which `encode` never
//!   writes, count as 4 and 5. `xyonly32f` has x in the low and y in the high half, as half floats.
//! * Points outside: the corners of the square are no directions, but rounding gets points there that are off the disk
//!   (for SPP: off the sextant) by part of a step. Those decode 7/16 of a step farther inwards along the component that
//!   matters more. `encode` does not write the few that this leaves outside, but the point one step inwards. Points
//!   farther out decode as a lattice point inside, toward the middle: near the border for those near it, halfway to the
//!   middle for the square's corners. So every code survives decoding and encoding; normalised instead, points near the
//!   border would wander from code to code.
//! * Points outside are found and moved without a division or a square root, so that all devices agree: a vector
//!   decoded on one encodes on any other to a code of the same vector.
//! * A vector that is of unit length to within 2^-21 is taken as it is: normalising would move its components by as
//!   much as its own rounding did, which at 48 bits is a step.
//! * Domain of XYOnly: z >= 0. A direction below the equator gets the code of its horizontal part, -Z that of +Z.
//! * Error, with a and b the half steps `1/(2 m)`: XYOnly and PP at most `arccos(1 - d)`, near `sqrt(2 d)`, with
//!   `d = sqrt(a^2 + b^2)`, on the equator: Meyer's eq. 6, where a = b. SPP at most `sqrt(a^2 + a b + b^2)` (a and b of
//!   the stored integers; a step of those is sqrt(1/2) as large), in the octants' middles: eq. 7.
//! * 48 bits: `f32` vectors have components in steps of 2^-24 to 2^-23, as wide as PP's and SPP's. The squared length,
//!   which may be off by 2^-20, and the rounding of the squares, at most 5 2^-24, turn a direction on the equator by up to
//!   1.2e-3 radians where PP's own error is 5.2e-4. SPP's own error is 3.2e-7; along the sextants' borders, where the
//!   two largest components must be told apart, points move up to three steps inwards.
//! * Good for: tangent-space normal maps, whose normals keep near +Z. Points inside decode with one square root, from
//!   snorm values that the hardware may convert; these functions add the divisions and selections for points
//!   outside. For directions all over the sphere [`oct`](crate::oct) is more exact and cheaper.
//! * Where the cost goes, in vector instructions on RDNA 2: of XYOnly16's 52 to encode the length takes 21, points outside 13,
//!   packing without the hardware's conversion 7, rounding 6, bad input 5; of its 39 to decode points outside take 21. (The
//!   textbook, which has only a root and the hardware's conversion, takes 10 and 10.)
//! * Axes round-trip exactly, all six (XYOnly: the five of its domain). `xyonly32f` spends its bits around x = 0 and y
//!   = 0, and has the largest steps at the equator, where the smallest are wanted: its errors are about those of
//!   XYOnly24. (The survey's errors of XYOnly32F are those of truncating conversion, which measures the same.)

mod plane;
mod xyonly;

pub use xyonly::{XyOnly, XyOnly32F};

use crate::arith::{
    dot, face_of, from_face, inverse_root, is_negative, mask, max, negate_if, negate_positive, root,
    scale_to_one, signed_code, snorm_integer, to_face, whole_to_u32, with_sign,
};
use crate::codec::{Codec, RawCode, Width};
use crate::direction::or_z;
use core::marker::PhantomData;
use glam::{Vec2, Vec3};
use plane::Plane;

/// `v`, of any length, at unit length; only scaled by a power of two, or not at all, where that is of unit length to
/// within 2^-21.
#[inline(always)]
fn unit(v: Vec3, l1_norm: f32) -> Vec3 {
    // The L1 norms of unit vectors, 1 to 1.74, times 1.1 have one exponent.
    let scaled = v * scale_to_one(l1_norm * 1.1);
    let square = dot(scaled, scaled);
    let is_unit = (square - 1.0).abs() <= 9.536_743e-7;
    scaled * if is_unit { 1.0 } else { inverse_root(square) }
}

/// The third component of a unit vector.
#[inline(always)]
fn third(p: Vec2) -> f32 {
    let square = 1.0 - (p.x * p.x + p.y * p.y);
    root(max(square, 0.0))
}

/// Two's complement, in `bits` bits, of a whole number below 2^23 with a sign.
#[inline(always)]
fn field(negative: bool, whole: f32, bits: u32) -> u32 {
    if bits <= 22 {
        return signed_code(negate_if(negative, whole), bits);
    }
    let magnitude = whole_to_u32(whole);
    (if negative { 0u32.wrapping_sub(magnitude) } else { magnitude }) & mask(bits)
}

/// The words of the whole numbers of a plane with the signs of `p`, and of the bits above them.
#[inline(always)]
fn pack(plane: Plane, p: Vec3, e: Vec2, top: u32) -> [u32; 2] {
    let Plane { x_bits, y_bits, .. } = plane;
    let (x, y) = (field(is_negative(p.x), e.x, x_bits), field(is_negative(p.y), e.y, y_bits));
    let low = x | (y << x_bits);
    let components = x_bits + y_bits;
    if components < 32 {
        [low | (top << components), 0]
    } else {
        [low, (y >> (32 - x_bits)) | (top << (components - 32))]
    }
}

/// The inverse of [`pack`]: the integers, and the bits above them, of which only the lowest count.
#[inline(always)]
fn unpack(plane: Plane, words: [u32; 2]) -> (Vec2, u32) {
    let Plane { x_bits, y_bits, .. } = plane;
    let components = x_bits + y_bits;
    let (y, top) = if components < 32 {
        (words[0] >> x_bits, words[0] >> components)
    } else {
        ((words[0] >> x_bits) | (words[1] << (32 - x_bits)), words[1] >> (components - 32))
    };
    // `snorm_integer` is exact up to 25 bits.
    (Vec2::new(snorm_integer(words[0], x_bits), snorm_integer(y, y_bits)), top)
}

/// The unit vector with the first two components of `e` on `plane`, the third positive unless `negative`.
#[inline(always)]
fn from_plane(plane: Plane, e: Vec2, negative: bool) -> Vec3 {
    let p = plane.point(e.abs());
    // With 23 bits and more, whose points have no inset, a number other than 0 may have become 0, which stays +0.
    let signed = |part: f32, e: f32| {
        if plane.x_bits > 22 { negate_positive(e < 0.0, part) } else { with_sign(part, e) }
    };
    Vec3::new(signed(p.x, e.x), signed(p.y, e.y), negate_positive(negative, third(p)))
}

/// Parallel projection: x, y and the sign of z in `BITS` bits (16, 24 or 32; 48 with codes of two words).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Pp<const BITS: u32, C = u32>(PhantomData<C>);

impl<const BITS: u32, C> Pp<BITS, C> {
    const PLANE: Plane = Plane::disk(BITS / 2, BITS / 2 - 1);
}

impl<const BITS: u32, C: RawCode> Codec for Pp<BITS, C>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The bound `arccos(1 - d)` and the rounding of `f32`, in degrees; at 48 bits `sqrt(2 d + 2^-20 + 5 2^-24)`, rounded up:
    /// 2^-20 is what the squared length of a vector that is taken as it is may be off by, 5 2^-24 the rounding of `f32`.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 7.7,
        24 => 1.91,
        32 => 0.49,
        48 => 0.071,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([1 << (Self::PLANE.x_bits - 1), 0]);
    type Code = C;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> C {
        let (v, norm) = or_z(v);
        let n = unit(v, norm);
        let e = Self::PLANE.round(Vec2::new(n.x.abs(), n.y.abs()));
        // The sign of v, not of n: n may have made a normal number of a denormal that another device flushes to zero.
        C::from_words(pack(Self::PLANE, n, e, if is_negative(v.z) { 1 } else { 0 }))
    }

    #[inline(always)]
    fn decode_vec3(code: C) -> Vec3 {
        let (e, top) = unpack(Self::PLANE, code.to_words());
        from_plane(Self::PLANE, e, (top & 1) != 0)
    }
}

/// Sextant parallel projection: the two smaller components and the sextant in `BITS` bits (16, 24 or 32; 48 with codes of
/// two words).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Spp<const BITS: u32, C = u32>(PhantomData<C>);

impl<const BITS: u32, C> Spp<BITS, C> {
    const PLANE: Plane = Plane::sextant(BITS / 2 - 1, BITS / 2 - 2);
}

impl<const BITS: u32, C: RawCode> Codec for Spp<BITS, C>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The bound `sqrt(a^2 + a b + b^2)`, plus its terms of higher order and the rounding of `f32`, in degrees: see the
    /// module's documentation.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 1.32,
        24 => 0.077,
        32 => 0.0048,
        48 => 8.0e-5,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([1 << (Self::PLANE.x_bits - 1), 0]);
    type Code = C;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> C {
        let (v, norm) = or_z(v);
        let face = face_of(v);
        let n = to_face(unit(v, norm), face);
        let e = Self::PLANE.round(Vec2::new(n.x.abs(), n.y.abs()));
        C::from_words(pack(Self::PLANE, n, e, face))
    }

    #[inline(always)]
    fn decode_vec3(code: C) -> Vec3 {
        let (e, top) = unpack(Self::PLANE, code.to_words());
        from_face(from_plane(Self::PLANE, e, (top & 1) != 0), top & 7)
    }
}
