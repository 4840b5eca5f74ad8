//! Cube codes: the sphere on a cube, by the face and the two coordinates on it.
//!
//! Source: Cigolle et al. 2014, section 2 (cube, and warpedcube after ISO/IEC 2005); Meyer et al. 2010, section 4,
//! eq. 8 (CM).
//!
//! The component of largest magnitude chooses the face; the two others, divided by it, are in \[-1, 1\]. The warped cube
//! stores `4/pi atan(u)` in place of `u`, by which steps near the face's edges are as wide as those in its middle.
//!
//! A coordinate of n bits is a whole number from -m to m, `m = 2^(n-1) - 1`, over `m + 1/2`: an snorm with half a step
//! to spare at each end. Steps go on evenly from face to face and no code lies on an edge. As plain snorm, which puts
//! the last points on the edges, two faces would have to tell apart the same edge in steps of different widths: with
//! u and v of different numbers of bits there is no layout in which all faces agree, and codes on the edges would not
//! survive decoding and encoding.
//!
//! * Layout: u in the low ceil((b - 3) / 2) bits, v in the next floor((b - 3) / 2), both in two's complement, and the
//!   face in the high three: twice the axis (0, 1, 2) and 1 if negative. (u, v) is (y, z), (z, x), (x, y) on
//!   the faces of x, y, z. Faces 6 and 7, which `encode` never writes, count as 4 and 5, the least integer of a
//!   coordinate as -m.
//! * Error, with a and b the half steps `1/(2 m + 1)` of u and v: cube `sqrt(a^2 + b^2)` radians, in the middles of
//!   faces: the angle of a step on a face is at most its length. Warped `pi/4 sqrt(8/9 (a^2 + a b + b^2))`, in the
//!   corners. Meyer's eq. 8 has a = b; with an odd number of bits for u and v together, v's steps are twice u's, and
//!   the maximum is sqrt(5)/2 times what table 1 has for that number of bits, 0.900 degrees at 16.
//! * Good for: data that is a cube map anyway. Costs one division to encode and one square root to decode, and
//!   selections; warped two polynomials more each way. Of the 3 bits for the face, 0.4 are wasted: `oct` of as many bits
//!   is more exact.
//! * The six axes round-trip exactly; edges and corners of the cube do not.

use crate::codec::Codec;
use crate::direction::or_z;
use crate::math::{atan_octant, floor, is_negative, negate_if, normalize, tan_octant};
use crate::scalar::{signed_code, snorm_integer, snorm_max};
use glam::{Vec2, Vec3};

/// The bits of u in a code of `bits` bits.
const fn u_bits(bits: u32) -> u32 {
    (bits - 2) / 2
}

/// The bits of v in a code of `bits` bits.
const fn v_bits(bits: u32) -> u32 {
    (bits - 3) / 2
}

/// The face of the direction of `v`: twice the axis of the component of largest magnitude, the last one if several are
/// equal, and 1 if it is negative.
#[inline(always)]
pub fn face_of(v: Vec3) -> u32 {
    let (x, y, z) = (v.x.abs(), v.y.abs(), v.z.abs());
    let z_above = z >= x && z >= y;
    let y_above = y >= x;
    let axis = if z_above {
        2
    } else if y_above {
        1
    } else {
        0
    };
    let component = if z_above {
        v.z
    } else if y_above {
        v.y
    } else {
        v.x
    };
    2 * axis + if is_negative(component) { 1 } else { 0 }
}

/// The components in the order that `face` has them: u, v, and that of the face's axis.
#[inline(always)]
pub fn to_face(v: Vec3, face: u32) -> Vec3 {
    let axis = face >> 1;
    let xy = if axis == 0 { Vec3::new(v.y, v.z, v.x) } else { Vec3::new(v.z, v.x, v.y) };
    if axis >= 2 { v } else { xy }
}

/// The inverse of [`to_face`]. Faces 6 and 7 count as 4 and 5.
#[inline(always)]
pub fn from_face(uvw: Vec3, face: u32) -> Vec3 {
    let axis = face >> 1;
    let xy = if axis == 0 { Vec3::new(uvw.z, uvw.x, uvw.y) } else { Vec3::new(uvw.y, uvw.z, uvw.x) };
    if axis >= 2 { uvw } else { xy }
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
    let scale = 1.0 / p.z.abs();
    let e = Vec2::new(
        round(is_negative(p.x), along(p.x.abs() * scale), snorm_max(u_bits(BITS))),
        round(is_negative(p.y), along(p.y.abs() * scale), snorm_max(v_bits(BITS))),
    );
    pack::<BITS>(e, face)
}

/// Cube code of `BITS` bits (16, 24 or 32).
pub struct Cube<const BITS: u32>;

impl<const BITS: u32> Codec for Cube<BITS> {
    const NAME: &'static str = match BITS {
        16 => "cube16",
        24 => "cube24",
        32 => "cube32",
        _ => panic!("Cube has 16, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    /// `sqrt(a^2 + b^2)` radians in degrees, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 1.016,
        24 => 0.062_7,
        _ => 0.003_92,
    };
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        encode::<BITS>(v, |coordinate| coordinate)
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        let face = unpack_face::<BITS>(code);
        let e = unpack::<BITS>(code);
        // In steps of u, so that only v is rounded before the normalisation.
        let side = snorm_max(u_bits(BITS)) + 0.5;
        let v_step = side / (snorm_max(v_bits(BITS)) + 0.5);
        from_face(normalize(Vec3::new(e.x, e.y * v_step, negate_if((face & 1) != 0, side))), face)
    }
}

/// Warped cube code of `BITS` bits (16, 24 or 32): equal angles along the middle lines of faces.
pub struct WarpedCube<const BITS: u32>;

impl<const BITS: u32> Codec for WarpedCube<BITS> {
    const NAME: &'static str = match BITS {
        16 => "warpedcube16",
        24 => "warpedcube24",
        32 => "warpedcube32",
        _ => panic!("WarpedCube has 16, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    /// `pi/4 sqrt(8/9 (a^2 + a b + b^2))` radians in degrees, rounded up, which leaves more than `f32` rounds.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.893,
        24 => 0.055,
        _ => 0.003_44,
    };
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        encode::<BITS>(v, atan_octant)
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        let face = unpack_face::<BITS>(code);
        let e = unpack::<BITS>(code);
        let u = tan_octant(e.x.abs() / (snorm_max(u_bits(BITS)) + 0.5));
        let v = tan_octant(e.y.abs() / (snorm_max(v_bits(BITS)) + 0.5));
        let p = Vec3::new(
            negate_if(is_negative(e.x), u),
            negate_if(is_negative(e.y), v),
            negate_if((face & 1) != 0, 1.0),
        );
        from_face(normalize(p), face)
    }
}

/// 16 bits: u of 7, v of 6, the face of 3.
pub type Cube16 = Cube<16>;
/// 24 bits: u of 11, v of 10, the face of 3.
pub type Cube24 = Cube<24>;
/// 32 bits: u of 15, v of 14, the face of 3.
pub type Cube32 = Cube<32>;
/// 16 bits, warped: u of 7, v of 6, the face of 3.
pub type WarpedCube16 = WarpedCube<16>;
/// 24 bits, warped: u of 11, v of 10, the face of 3.
pub type WarpedCube24 = WarpedCube<24>;
/// 32 bits, warped: u of 15, v of 14, the face of 3.
pub type WarpedCube32 = WarpedCube<32>;
