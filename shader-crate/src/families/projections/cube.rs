//! Cube codes: the sphere on a cube, by the face and the two coordinates on it.
//!
//! Source: Cigolle et al. 2014, section 2 (cube, and warpedcube after ISO/IEC 2005); Meyer et al. 2010, section 4, eq.
//! 8 (CM).
//!
//! The component of largest magnitude chooses the face; the two others, divided by it, are in \[-1, 1\]. The warped
//! cube stores `4/pi atan(u)` in place of `u`, by which steps near the face's edges are as wide as those in its middle.
//!
//! A coordinate of n bits is a whole number from -m to m, `m = 2^(n-1) - 1`, over `m + 1/2`: an snorm with half a step
//! to spare at each end. Steps go on evenly from face to face and no code lies on an edge. A plain snorm has its last
//! points on the edges, which two faces share: with different numbers of bits for u and v the faces' steps along an
//! edge would differ, and codes on the edges would not survive decoding and encoding.
//!
//! <!-- generated: errors cube -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `cube16` | 0.414 | 1.02 | 1.02 |
//! | `cube24` | 0.0255 | 0.0626 | 0.0627 |
//! | `cube32` | 0.00159 | 0.00391 | 0.00392 |
//! | `cube48` | 6.26e-6 | 1.53e-5 | 1.83e-5 |
//! | `warpedcube16` | 0.394 | 0.885 | 0.893 |
//! | `warpedcube24` | 0.0243 | 0.0548 | 0.0550 |
//! | `warpedcube32` | 0.00152 | 0.00343 | 0.00344 |
//! <!-- end -->
//!
//! * Layout: u in the low ceil((b - 3) / 2) bits, v in the next floor((b - 3) / 2), both in two's complement, and the
//!   face in the high three: twice the axis (0, 1, 2) and 1 if negative. (u, v) is (y, z), (z, x), (x, y) on the faces
//!   of x, y, z. Faces 6 and 7, which `encode` never writes, count as 4 and 5, the least integer of a coordinate as -m.
//! * Error, with a and b the half steps `1/(2 m + 1)` of u and v: cube `sqrt(a^2 + b^2)` radians, in the middles of
//!   faces, where the angle of a step is its length. Warped `pi/4 sqrt(8/9 (a^2 + a b + b^2))`, in the corners. Meyer's
//!   eq. 8 has a = b. With an odd number of bits for u and v together, v's steps are twice u's, and the maximum is
//!   sqrt(5)/2 times Meyer's.
//! * 48 bits (`cube48`), two words, low word first: u has 23 bits and v 22, and a step of u is about as wide as one of
//!   floats. So the encoder takes the quotient as two floats, and the decoder gives the floats nearest to the exact
//!   components. Their rounding moves u by less than half a step, and the code survives.
//! * The survey says, without figures, that cube's error is slightly worse than that of snorm x 3 at the same size.
//!   Ours is several times lower, and so is Meyer's bound.
//! * Good for: data that is a cube map anyway. Encoding takes one division, decoding one square root, and both some
//!   selections; warped two polynomials more each way. Six faces waste 0.4 of the 3 bits for the face: [`oct`](crate::oct)
//!   with as many bits is more exact.
//! * The six axes round-trip exactly; edges and corners of the cube do not.

use crate::arith::{
    atan_octant, coordinate, exp2, face_of, floor, from_face, is_negative, mask, negate_if, negate_positive,
    normalize, normalize_parts, quotient, ratio, reciprocal, scaled_to_one, signed_code, snorm_integer,
    snorm_max, tan_octant, to_face,
};
use crate::codec::{Codec, Width};
use crate::direction::or_z;
use glam::{Vec2, Vec3};

/// The bits of u in a code of `bits` bits.
const fn u_bits(bits: u32) -> u32 {
    (bits - 2) / 2
}

/// The bits of v in a code of `bits` bits.
const fn v_bits(bits: u32) -> u32 {
    (bits - 3) / 2
}

/// The whole number nearest to `magnitude * (m + 1/2)`, at most `m`, with a sign.
#[inline(always)]
fn round(negative: bool, magnitude: f32, m: f32) -> f32 {
    let rounded = floor(magnitude * (m + 0.5) + 0.5);
    negate_if(negative, if rounded > m { m } else { rounded })
}

/// The code of a face and its whole coordinates.
#[inline(always)]
fn pack<const BITS: u32>(e: Vec2, face: u32) -> u32 {
    let (n, k) = (u_bits(BITS), v_bits(BITS));
    signed_code(e.x, n) | (signed_code(e.y, k) << n) | (face << (n + k))
}

/// The whole coordinates of a code.
#[inline(always)]
fn unpack<const BITS: u32>(code: u32) -> Vec2 {
    let (n, k) = (u_bits(BITS), v_bits(BITS));
    Vec2::new(snorm_integer(code, n), snorm_integer(code >> n, k))
}

/// The face of a code.
#[inline(always)]
fn unpack_face<const BITS: u32>(code: u32) -> u32 {
    (code >> (BITS - 3)) & 7
}

/// The code of the direction of `v`, with the place `along` of a coordinate's magnitude on its face, 0 to 1.
#[inline(always)]
fn encode<const BITS: u32>(v: Vec3, along: impl Fn(f32) -> f32) -> u32 {
    let (v, _) = or_z(v);
    let face = face_of(v);
    let p = to_face(v, face);
    let scale = reciprocal(p.z.abs());
    let e = Vec2::new(
        round(is_negative(p.x), along(p.x.abs() * scale), snorm_max(u_bits(BITS))),
        round(is_negative(p.y), along(p.y.abs() * scale), snorm_max(v_bits(BITS))),
    );
    pack::<BITS>(e, face)
}

/// Cube code of `BITS` bits (16, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cube<const BITS: u32>;

impl<const BITS: u32> Codec for Cube<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// `sqrt(a^2 + b^2)` radians in degrees, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 1.016,
        24 => 0.062_7,
        32 => 0.003_92,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([1 << (u_bits(BITS) - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        encode::<BITS>(v, |coordinate| coordinate)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let face = unpack_face::<BITS>(code);
        let e = unpack::<BITS>(code);
        // In steps of u, so that only v is rounded before the normalisation.
        let side = snorm_max(u_bits(BITS)) + 0.5;
        let v_step = ratio(side, snorm_max(v_bits(BITS)) + 0.5);
        from_face(normalize(Vec3::new(e.x, e.y * v_step, negate_if((face & 1) != 0, side))), face)
    }
}

/// The whole number nearest to `(2^(bits-1) - 1/2) x / side`, at most `2^(bits-1) - 1`, for `x` of 0 to `side`.
#[inline(always)]
fn round_wide(x: f32, side: f32, bits: u32) -> i32 {
    // Twice the factor of `x / side` is `2^bits - 1`.
    let (doubled, _) = coordinate(x, side, 0.0, reciprocal(side), bits + 1);
    let rounded = (doubled.whole + 1) >> 1;
    let m = mask(bits - 1) as i32;
    if rounded > m { m } else { rounded }
}

/// The integer of the low `bits` bits of a code, in two's complement, as its magnitude and whether it is negative. The
/// least counts as the next.
#[inline(always)]
fn magnitude(code: u32, bits: u32) -> (i32, bool) {
    let integer = (code << (32 - bits)) as i32 >> (32 - bits);
    let size = if integer < 0 { -integer } else { integer };
    let m = mask(bits - 1) as i32;
    (if size > m { m } else { size }, integer < 0)
}

/// Cube code of 48 bits: u of 23, v of 22, the face of 3.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CubeWide;

impl CubeWide {
    const U_BITS: u32 = u_bits(48);
    const V_BITS: u32 = v_bits(48);
}

impl Codec for CubeWide {
    const BITS: u32 = 48;
    /// `sqrt(a^2 + b^2)`, and `sqrt(3) 2^-25` for the rounding of the decoded vector: 3.19e-7 radians.
    const MAX_ERROR_DEG: f32 = 1.83e-5;
    const NULL: Option<[u32; 2]> = Some([1 << (Self::U_BITS - 1), 0]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, norm) = or_z(v);
        let face = face_of(v);
        let p = to_face(scaled_to_one(v, norm), face);
        let side = p.z.abs();
        let i = round_wide(p.x.abs(), side, Self::U_BITS);
        let j = round_wide(p.y.abs(), side, Self::V_BITS);
        let i = if is_negative(p.x) { -i } else { i } as u32 & mask(Self::U_BITS);
        let j = if is_negative(p.y) { -j } else { j } as u32 & mask(Self::V_BITS);
        [i | (j << Self::U_BITS), (j >> (32 - Self::U_BITS)) | (face << (Self::U_BITS + Self::V_BITS - 32))]
    }

    #[inline(always)]
    fn decode_vec3([low, high]: [u32; 2]) -> Vec3 {
        let (i, left) = magnitude(low, Self::U_BITS);
        let (j, down) = magnitude((low >> Self::U_BITS) | (high << (32 - Self::U_BITS)), Self::V_BITS);
        let face = (high >> (Self::U_BITS + Self::V_BITS - 32)) & 7;
        // Half a side is 2^23 - 1; then a step of u is 2, and one of v `4 + 2 / (2^22 - 1)`.
        let (u, v) = (2 * i, 4 * j);
        let rest = j as f32 * ratio(2.0, mask(Self::V_BITS) as f32);
        let upper = Vec3::new((u >> 12) as f32, (v >> 12) as f32, 2047.0);
        let lower = Vec3::new((u & 4095) as f32, (v & 4095) as f32 + rest, 4095.0) * exp2(-12);
        let p = normalize_parts(upper, lower);
        let p = Vec3::new(
            negate_positive(left, p.x),
            negate_positive(down, p.y),
            negate_if((face & 1) != 0, p.z),
        );
        from_face(p, face)
    }
}

/// Warped cube code of `BITS` bits (16, 24 or 32): equal angles along the middle lines of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct WarpedCube<const BITS: u32>;

impl<const BITS: u32> Codec for WarpedCube<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// `pi/4 sqrt(8/9 (a^2 + a b + b^2))` radians in degrees, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.893,
        24 => 0.055,
        32 => 0.003_44,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([1 << (u_bits(BITS) - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        encode::<BITS>(v, atan_octant)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let face = unpack_face::<BITS>(code);
        let e = unpack::<BITS>(code);
        let u = tan_octant(quotient(e.x.abs(), snorm_max(u_bits(BITS)) + 0.5));
        let v = tan_octant(quotient(e.y.abs(), snorm_max(v_bits(BITS)) + 0.5));
        let p = Vec3::new(
            negate_if(is_negative(e.x), u),
            negate_if(is_negative(e.y), v),
            negate_if((face & 1) != 0, 1.0),
        );
        from_face(normalize(p), face)
    }
}
