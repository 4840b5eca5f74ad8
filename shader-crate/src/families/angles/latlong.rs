//! Numbered patches between circles of latitude: the index of a patch is the code.
//!
//! Source: Cigolle et al. 2014, sections 2 ("latlong") and 2.3; Smith et al. 2012, "Encoding normal vectors using
//! optimized spherical coordinates". Both need a table of where the rings of patches start; here it is a formula.
//!
//! <!-- generated: errors latlong -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `latlong16` | 0.354 | 0.786 | 0.786 |
//! | `latlong24` | 0.0221 | 0.0491 | 0.0492 |
//! | `latlong32` | 0.00138 | 0.00308 | 0.00312 |
//! | `latlong16d` | 0.305 | 0.567 | 0.567 |
//! | `latlong24d` | 0.0190 | 0.0351 | 0.0352 |
//! | `latlong32d` | 0.00119 | 0.00220 | 0.00224 |
//! <!-- end -->
//!
//! # The fast format, [`LatLong`]
//!
//! `2^h` rings of equal height from +Z to -Z, h half the code's bits, and in each of them `2^h` patches of equal width.
//! The index of a patch is `ring 2^h + patch`, so that finding both is a shift and a mask, and it decodes to its middle.
//!
//! The survey calls its fast format "latlong", says that its patches are of near-equal area, and does not define them.
//! This grid is inferred: its errors are within 1 % of the survey's table 1, or less.
//!
//! * Layout: the patch in the low half of the code, counted from +X towards +Y; the ring in the high half, counted from
//!   +Z. Every code is a patch.
//! * Error: half the diagonal of a patch at the equator, at most `sqrt(5) pi / 2^(h+1)` radians.
//! * No axis round-trips exactly: the corners of four patches meet at +-X and +-Y, and +-Z are half a ring off, so that
//!   the commonest normals get the greatest errors.
//! * Good for: simplicity. [`spherical`](crate::spherical) is as good and keeps the axes.
//!
//! # The better format, [`LatLongD`]
//!
//! Rings of equal height around the z axis, each with as many patches as keep them about square. The rings' middles,
//! not their borders, lie on the poles and the equator, and the middles of their patches on the half planes through +-X
//! and +-Y, so that the six axes are patches' middles. In each hemisphere ring i = 0 ... n has its middle at i/n of the
//! way from the pole to the equator, and in each quarter turn `k_i` patches. The quarter from +X to +Y,
//! `j = 0 ... k_i - 1`, has their middles at j/`k_i` of the quarter, and the other three are that one turned. Ring 0 is
//! the pole.
//!
//! Patch j of ring i has the index `S(i) + j`, with `S(i) = floor(u (A0 + u (A1 + u A2)) + (0.95 h + 0.72515))`,
//! `h = i - 1/2`, `u = h^2`, evaluated in `f32` in that order, and `k_i = S(i + 1) - S(i)`. The polynomial is a
//! multiple of the area between the pole and ring i, `1 - cos`, to 3e-4 of its slope. The linear part gives every ring
//! 0.95 patches a quarter more than its area asks, which small rings need, whose patches fan out. For the format S need
//! not be exact, only the same everywhere, and it is made of sums and products. At 32 bits its rounding to multiples of
//! 32 changes the widths of a ring's patches by up to 0.4 %. The inverse is a square root times a polynomial, good to
//! 0.34 of a ring. That leaves two rings, and a comparison with the border between them settles which.
//!
//! * Layout: the index in the low b - 3 bits of the code, the quarter in the next two (0 from +X to +Y, 1 from +Y to
//!   -X, 2 from -X to -Y, 3 from -Y to +X), the hemisphere in the highest (1 for z < 0). Every code is a patch: n and
//!   A0 are such that S(n + 1) is `2^(b-3)`. The patches of the equator have a code in each hemisphere.
//! * Error: at most the distance of the farthest corner of all patches, computed for every ring (n = 113, 1782, 29225),
//!   and the rounding of positions in `f32`. The survey's 32-bit maximum is that of `f32` trigonometry.
//! * The six axes round-trip exactly. Mirrored at a coordinate plane, a direction decodes to the mirrored vector,
//!   exactly; turned by quarters about z, within rounding.
//! * Good for: little error without a table. Weaknesses: the cost. Patches next to each other in neighbouring rings are
//!   unrelated, so that codes must not be interpolated.

use super::{around_z, half_turn, quarter, scaled};
use crate::arith::{
    SIGN_BIT, exp2, flip_sign, floor, from_diagonal, horizontal_length, integer_part, is_negative, mask, max,
    min, ratio, root, signed_integer, signed_quotient, whole_to_u32, with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::Vec3;

/// The row and column of [`LatLong`]: the code of the direction of `v`. `half` is half the code's bits.
///
/// Patches at y < 0 are those at y > 0, mirrored: the number of one is the other's complement.
#[inline(always)]
fn grid_encode(v: Vec3, half: u32) -> u32 {
    let norm = l1_norm(v);
    let p = scaled(v, norm);
    let rings = (1 << half) as f32;
    let colatitude = half_turn(horizontal_length(p), p.z, is_negative(v.z)) * (0.5 * rings);
    let patch = whole_to_u32(floor(half_turn(p.y, p.x, is_negative(v.x)) * (0.25 * rings)));
    let patch = if is_negative(v.y) { !patch } else { patch };
    let code = (patch & mask(half)) | (whole_to_u32(floor(min(colatitude, rings - 1.0))) << half);
    if is_usable(norm) { code } else { 0 }
}

/// The middle of the patch of a code of [`LatLong`]. Patches from -X to +X count as -`2^(half-1)` to -1.
#[inline(always)]
fn grid_decode(code: u32, half: u32) -> Vec3 {
    let step = exp2(-(half as i32));
    let ring = ((code >> half) & mask(half)) as i32 as f32;
    let above = 1.0 - (ring + 0.5) * (2.0 * step);
    let meridian = from_diagonal(0.5 - above.abs());
    let z = with_sign(meridian.x - meridian.y, above);
    around_z(meridian.x + meridian.y, z, (signed_integer(code, half) + 0.5) * (4.0 * step))
}

/// The rings of a width of [`LatLongD`].
#[derive(Clone, Copy)]
struct Rings {
    /// Rings from the pole, 0, to the equator, n.
    n: f32,
    /// The polynomial of S, lowest power first.
    a0: f32,
    a1: f32,
    a2: f32,
    /// The polynomial of the inverse of S, lowest power first. 16 bits do without q2; only 32 bits need q3 and q4.
    q0: f32,
    q1: f32,
    q2: f32,
    q3: f32,
    q4: f32,
    /// The inverse of index 0.
    offset: f32,
}

impl Rings {
    /// The rings up to n, with the coefficients of both polynomials and the offset.
    const fn new(n: f32, [a0, a1, a2]: [f32; 3], [q0, q1, q2, q3, q4]: [f32; 5], offset: f32) -> Self {
        Self { n, a0, a1, a2, q0, q1, q2, q3, q4, offset }
    }

    /// The start of ring i, 0 to n + 1, given h = i - 1/2: S(i) is the whole part.
    #[inline(always)]
    fn border(self, h: f32) -> f32 {
        let u = h * h;
        u * (self.a0 + u * (self.a1 + u * self.a2)) + (0.95 * h + 0.72515)
    }

    /// A number that is more than i and less than i + 2 for the indices of ring i.
    #[inline(always)]
    fn inverse(self, index: f32) -> f32 {
        let low = self.q0 + index * self.q1;
        let high =
            if self.q4 != 0.0 { (self.q2 + index * self.q3) + (index * index) * self.q4 } else { self.q2 };
        let factor = if self.q2 != 0.0 { low + (index * index) * high } else { low };
        root(index) * factor + self.offset
    }
}

/// An integer below 2^31 as a float. Conversions of signed integers are single instructions where those of unsigned
/// ones are not.
#[inline(always)]
fn whole_to_f32(integer: u32) -> f32 {
    integer as i32 as f32
}

/// A whole number below `2^bits` as an integer. A CPU needs sums of less than 2^24 for that: see [`whole_to_u32`].
#[inline(always)]
fn index_of(whole: f32, bits: u32) -> u32 {
    if cfg!(target_arch = "spirv") {
        return integer_part(whole) as u32;
    }
    if bits <= 23 {
        return whole_to_u32(whole);
    }
    let high = floor(whole * (1.0 / 4096.0));
    (whole_to_u32(high) << 12) | whole_to_u32(whole - 4096.0 * high)
}

/// An index of `bits` bits as the sum of two floats: from 25 bits on a single one need not hold it.
#[inline(always)]
fn in_parts(index: u32, bits: u32) -> (f32, f32) {
    if bits <= 24 {
        return (whole_to_f32(index), 0.0);
    }
    let low = index & mask(12);
    (whole_to_f32(index - low), whole_to_f32(low))
}

/// The code of [`LatLongD`] of the direction of `v`, whose index has `index_bits` bits.
#[inline(always)]
fn patch_encode(v: Vec3, rings: Rings, index_bits: u32) -> u32 {
    let norm = l1_norm(v);
    let usable = is_usable(norm);
    let p = scaled(v, norm);
    let colatitude = quarter(horizontal_length(p), p.z);
    let i = floor(if usable { colatitude } else { 0.0 } * rings.n + 0.5);
    let start = floor(rings.border(i - 0.5));
    let count = floor(rings.border(i + 0.5)) - start;
    let j = floor(quarter(p.y, p.x) * count + 0.5);

    // In quarters 1 and 3 the angle from the x axis runs against j, and the last j is the next quarter's first.
    let (left, back) = (is_negative(v.x), is_negative(v.y));
    let along = if left != back { count - j } else { j };
    let turns = (if back { 2 } else { 0 }) + (left != back) as u32;
    let carries = along >= count;
    let carried = (turns + carries as u32) & 3;
    let from_start = if carries { 0.0 } else { along };

    let place = index_of(start, index_bits) + whole_to_u32(from_start) + (carried << index_bits);
    let below = if usable & is_negative(v.z) { 4 << index_bits } else { 0 };
    below | if i > 0.0 { place } else { 0 }
}

/// The middle of the patch of a code of [`LatLongD`], whose index has `index_bits` bits: unit length to within 2 ULP.
#[inline(always)]
fn patch_decode(code: u32, rings: Rings, index_bits: u32) -> Vec3 {
    let index = code & mask(index_bits);
    let (high, low) = in_parts(index, index_bits);

    let nearest = floor(rings.inverse(whole_to_f32(index)));
    let border = rings.border(nearest - 0.5);
    let before = border - high >= low + 1.0;
    let other = rings.border(if before { nearest - 1.5 } else { nearest + 0.5 });
    let ring = if before { nearest - 1.0 } else { nearest };
    let start = floor(min(border, other));
    let count = floor(max(border, other)) - start;
    // Exact: start is near.
    let from_high = high - start;
    let along = if index_bits <= 24 { from_high } else { from_high + low };

    // Both angles are taken from the middles of their quarter turns, about which the patches are symmetric.
    let divided = signed_quotient(along - 0.5 * count, count);
    let equator = from_diagonal(if along > 0.0 { divided } else { -0.5 });
    // At either end the product is 1/2 exactly.
    let meridian = from_diagonal((ring - 0.5 * rings.n) * ratio(1.0, rings.n));
    let radius = meridian.x + meridian.y;

    // Turns by quarters, but for the pole, where a turned 0 would become -0: from quarter to quarter (a, b) goes to
    // (-b, a).
    let quarter = if index > 0 { code } else { 0 };
    let odd = quarter & (1 << index_bits) != 0;
    let (a, b) = if odd { (equator.y, equator.x) } else { (equator.x, equator.y) };
    let to_sign = 30 - index_bits;
    let a = flip_sign(a, (quarter.wrapping_add(1 << index_bits) << to_sign) & SIGN_BIT);
    let b = flip_sign(b, (quarter << to_sign) & SIGN_BIT);
    let below = (code << (29 - index_bits)) & SIGN_BIT;
    let z = flip_sign(meridian.x, below) - flip_sign(meridian.y, below);
    Vec3::new((a - b) * radius, (a + b) * radius, z)
}

/// Patches of a plain grid of latitude and longitude in `BITS` bits (16, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LatLong<const BITS: u32>;

impl<const BITS: u32> Codec for LatLong<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    const EXACT_AXES: bool = false;
    /// `sqrt(5) pi / 2^(h+1)` radians in degrees, and the errors of rounding both angles and the decoded vector: at
    /// most 8e-7 radians.
    const MAX_ERROR_DEG: f32 = ratio(1.118_034 * 180.0, (1 << (BITS / 2)) as f32) + 4.6e-5;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        grid_encode(v, BITS / 2)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        grid_decode(code, BITS / 2)
    }
}

/// Nearly square patches of nearly equal area in `BITS` bits (16, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LatLongD<const BITS: u32>;

impl<const BITS: u32> LatLongD<BITS> {
    const RINGS: Rings = match BITS {
        16 => Rings::new(
            113.0,
            [0.7756357, -1.244649e-5, 7.392083e-11],
            [1.1121525, 1.7299868e-5, 0.0, 0.0, 0.0],
            0.7887458,
        ),
        24 => Rings::new(
            1782.0,
            [0.81366533, -5.2502063e-8, 1.2538275e-15],
            [1.1107166, 3.7894093e-8, 9.317108e-15, 0.0, 0.0],
            0.23774427,
        ),
        32 => Rings::new(
            29225.0,
            [0.7753543, -1.8601036e-10, 1.6516002e-20],
            [1.135677, 1.7468939e-10, 8.533958e-20, 1.2860357e-30, 8.5294734e-38],
            0.4510315,
        ),
        _ => panic!("no constants for this width"),
    };
}

impl<const BITS: u32> Codec for LatLongD<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The greatest distance from a patch's middle to its corners, 0.56671, 0.035146 and 0.0021951 degrees, and the
    /// errors of rounding both angles and the decoded vector: at most 8e-7 radians.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.56672,
        24 => 0.035147,
        32 => 0.0021952,
        _ => panic!("no constants for this width"),
    } + 4.6e-5;
    const NULL: Option<[u32; 2]> = Some([1 << (BITS - 3), 0]); // the pole's patch, in quarter 1
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        patch_encode(v, Self::RINGS, BITS - 3)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        patch_decode(code, Self::RINGS, BITS - 3)
    }
}
