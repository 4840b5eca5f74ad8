//! Numbered patches between circles of latitude: the index of a patch is the code.
//!
//! Source: Cigolle et al. 2014, sections 2 ("latlong") and 2.3; Smith et al. 2012, "Encoding normal vectors using
//! optimized spherical coordinates". Both need a table of where the rings of patches start; here it is a formula.
//!
//! # The fast format, [`LatLong`]
//!
//! `2^h` rings of equal height from +Z to -Z, h half the code's bits, and in each of them `2^h` patches of equal
//! width. The index of a patch is `ring 2^h + patch`, so that finding both is a shift and a mask, and it decodes to
//! its middle.
//!
//! * Layout: the patch in the low half of the code, counted from +X towards +Y; the ring in the high half, counted
//!   from +Z. Every code is a patch.
//! * Error: half the diagonal of a patch at the equator, at most `sqrt(5) pi / 2^(h+1)` radians: 0.787, 0.0492 and
//!   0.00311 degrees at 16, 24 and 32 bits. Mean over uniform directions: 0.354, 0.0221 and 0.00138.
//! * No axis round-trips exactly: the corners of four patches meet at +-X and +-Y, and +-Z are half a ring off, so
//!   the commonest normals get the greatest errors. Good for simplicity; [`spherical`](crate::spherical) is as good
//!   and keeps the axes.
//!
//! # The better format, [`LatLongD`]
//!
//! Rings of equal height around the z axis, each with as many patches as keep them about square. The rings'
//! middles, not their borders, lie on the poles and the equator, and the middles of their patches on the half
//! planes through +-X and +-Y, so that the six axes are patches' middles. In each hemisphere ring i = 0 ... n has
//! its middle at i/n of the way from the pole to the equator, and in each quarter turn `k_i` patches: the quarter
//! from +X to +Y, j = 0 ... `k_i` - 1, has their middles at j/`k_i` of the quarter, and the other three are that
//! one turned. Ring 0 is the pole.
//!
//! Patch j of ring i has the index `S(i) + j`, with `S(i) = floor(u (A0 + u (A1 + u A2)) + (0.95 i + 0.25))`,
//! `u = (i - 1/2)^2`, evaluated in `f32` in that order, and `k_i = S(i + 1) - S(i)`. The polynomial is a multiple of the
//! area between the pole and ring i, `1 - cos`, to 3e-4 of its slope; the linear part gives every ring 0.95 patches
//! a quarter more than its area asks, which small rings need, whose patches fan out. For the format S need not be
//! exact, only the same everywhere, and it is made of sums and products. At 32 bits its rounding to multiples of 32
//! changes the widths of a ring's patches by up to 0.4 %. The inverse is a square root times a polynomial, good to
//! a sixth of a ring, then one comparison.
//!
//! * Layout: the index in the low b - 3 bits of the code, the quarter in the next two (0 from +X to +Y, 1 from +Y
//!   to -X, 2 from -X to -Y, 3 from -Y to +X), the hemisphere in the highest (1 for z < 0). Every code is a patch:
//!   n and A0 are such that S(n + 1) is `2^(b-3)`. The patches of the equator have a code in each hemisphere.
//! * Error: at most 0.5668, 0.0352 and 0.00224 degrees at 16, 24 and 32 bits (n = 113, 1782, 29225): the farthest
//!   corner of all patches, computed for every ring, and the rounding of positions in `f32`. Mean over uniform
//!   directions: 0.3046, 0.0190 and 0.00119. That is within 1 % of the survey's table, whose 32-bit maximum,
//!   0.00381, is that of `f32` trigonometry.
//! * The six axes round-trip exactly. Mirrored at a coordinate plane, a direction decodes to the decoded vector's
//!   image, exactly; turned by quarters about z, within rounding.
//! * Good for the least error in 16 bits of all formats here, without a table. Weak: decoding takes a square root,
//!   two sines and two evaluations of S, several times [`oct`](crate::oct)'s cost; patches next to each other in
//!   neighbouring rings are unrelated, so codes must not be interpolated.

use crate::codec::Codec;
use crate::math::{atan2_half_turns, floor, is_negative, negate_if, sin_cos_half_turns, sqrt};
use crate::scalar::{mask, signed_code, whole_to_u32};
use crate::spherical::{around_z, horizontal_length, scaled, signed_integer};
use glam::Vec3;

/// The row and column of [`LatLong`]: the code of the direction of `v`. `half` is half the code's bits.
#[inline(always)]
pub fn grid_encode(v: Vec3, half: u32) -> u32 {
    let v = scaled(v);
    let rings = (1 << half) as f32;
    let ring = floor(atan2_half_turns(horizontal_length(v), v.z) * rings);
    let last = rings - 1.0;
    let patch = floor(atan2_half_turns(v.y, v.x) * (0.5 * rings));
    signed_code(patch, half) | (whole_to_u32(if ring < last { ring } else { last }) << half)
}

/// The middle of the patch of a code of [`LatLong`]. Patches from -X to +X count as -`2^(half-1)` to -1.
#[inline(always)]
pub fn grid_decode(code: u32, half: u32) -> Vec3 {
    let step = 1.0 / (1 << half) as f32;
    let ring = ((code >> half) & mask(half)) as f32;
    let meridian = sin_cos_half_turns((ring + 0.5) * step);
    around_z(meridian.y, meridian.x, (signed_integer(code, half) + 0.5) * (2.0 * step))
}

/// The rings of a width of [`LatLongD`].
#[derive(Clone, Copy)]
pub struct Rings {
    /// Rings from the pole, 0, to the equator, n.
    pub n: f32,
    /// Lowest power first, the polynomial of S.
    pub a0: f32,
    /// See [`a0`](Self::a0).
    pub a1: f32,
    /// See [`a0`](Self::a0).
    pub a2: f32,
    /// Patches in an eighth of the sphere, S(n + 1), as a reciprocal.
    pub unit: f32,
    /// Lowest power first, the polynomial of the inverse of S, of the index as a part of all.
    pub q0: f32,
    /// See [`q0`](Self::q0).
    pub q1: f32,
    /// See [`q0`](Self::q0).
    pub q2: f32,
    /// See [`q0`](Self::q0).
    pub q3: f32,
    /// See [`q0`](Self::q0).
    pub q4: f32,
    /// What the inverse is off by, mostly the effect of the linear part of S.
    pub offset: f32,
}

/// The rings of the format of 16 bits.
pub const RINGS_16: Rings = Rings {
    n: 113.0,
    a0: 0.7756357,
    a1: -1.244649e-5,
    a2: 7.392083e-11,
    unit: 1.0 / 8_192.0,
    q0: 104.36025,
    q1: -10.2527895,
    q2: 67.22143,
    q3: -85.247475,
    q4: 38.234226,
    offset: -0.17366897,
};

/// The rings of the format of 24 bits.
pub const RINGS_24: Rings = Rings {
    n: 1782.0,
    a0: 0.81366533,
    a1: -5.2502063e-8,
    a2: 1.2538275e-15,
    unit: 1.0 / 2_097_152.0,
    q0: 1607.1187,
    q1: 112.42228,
    q2: 105.19552,
    q3: -92.46996,
    q4: 51.018177,
    offset: -0.13045794,
};

/// The rings of the format of 32 bits.
pub const RINGS_32: Rings = Rings {
    n: 29225.0,
    a0: 0.7753543,
    a1: -1.8601036e-10,
    a2: 1.6516002e-20,
    unit: 1.0 / 536_870_912.0,
    q0: 26315.662,
    q1: 2157.9614,
    q2: 622.8445,
    q3: -66.86007,
    q4: 196.69493,
    offset: -0.15143372,
};

impl Rings {
    /// S(i): the index of the first patch of ring i, 0 to n + 1, in an eighth of the sphere.
    #[inline(always)]
    pub fn start(self, i: f32) -> u32 {
        let u = (i - 0.5) * (i - 0.5);
        index_of(floor(u * (self.a0 + u * (self.a1 + u * self.a2)) + (0.95 * i + 0.25)))
    }

    /// About where between the starts of the rings an index lies: more than i - 1/2 and less than i + 3/2 for the
    /// indices of ring i.
    #[inline(always)]
    pub fn inverse(self, index: u32) -> f32 {
        let t = (index as f32 + 0.5) * self.unit;
        let high = self.q2 + t * (self.q3 + t * self.q4);
        sqrt(t) * (self.q0 + t * (self.q1 + t * high)) + self.offset
    }
}

/// A whole number from 0 to 2^32 - 256 as an integer.
#[inline(always)]
fn index_of(whole: f32) -> u32 {
    let high = floor(whole * (1.0 / 4096.0));
    (whole_to_u32(high) << 12) | whole_to_u32(whole - 4096.0 * high)
}

/// The code of [`LatLongD`] of the direction of `v`, whose index has `index_bits` bits.
#[inline(always)]
pub fn patch_encode(v: Vec3, rings: Rings, index_bits: u32) -> u32 {
    let v = scaled(v);
    let colatitude = atan2_half_turns(horizontal_length(v), v.z.abs());
    let i = floor(colatitude * (2.0 * rings.n) + 0.5);
    let start = rings.start(i);
    let count = rings.start(i + 1.0) - start;
    let angle = atan2_half_turns(v.y.abs(), v.x.abs());
    let j = whole_to_u32(floor(angle * (2.0 * count as f32) + 0.5));

    // In quarters 1 and 3 the angle from the x axis runs against j, and the last j is the next quarter's first.
    let (left, back) = (is_negative(v.x), is_negative(v.y));
    let along = if left != back { count - j } else { j };
    let front_quarter = if left { 1 } else { 0 };
    let back_quarter = if left { 2 } else { 3 };
    let quarter = if back { back_quarter } else { front_quarter };
    let carried = if along == count { (quarter + 1) & 3 } else { quarter };
    let from_start = if along == count { 0 } else { along };

    let place = start + from_start + (carried << index_bits);
    let below = if is_negative(v.z) { 4 << index_bits } else { 0 };
    below | if i > 0.0 { place } else { 0 }
}

/// The middle of the patch of a code of [`LatLongD`], whose index has `index_bits` bits: unit length to within 2
/// ULP.
#[inline(always)]
pub fn patch_decode(code: u32, rings: Rings, index_bits: u32) -> Vec3 {
    let index = code & mask(index_bits);
    let border = floor(rings.inverse(index) + 0.5);
    let border_start = rings.start(border);
    let before = index < border_start;
    let other_start = rings.start(if before { border - 1.0 } else { border + 1.0 });
    let i = if before { border - 1.0 } else { border };
    let start = if before { other_start } else { border_start };
    let count = if before { border_start } else { other_start } - start;

    let quarter = (code >> index_bits) & 3;
    let along = index - start;
    let j = if quarter & 1 != 0 { count - along } else { along };
    let divided = 0.5 * (j as f32 / count as f32);
    let equator = sin_cos_half_turns(if j < count { divided } else { 0.5 });
    // The product of n is 1/2 exactly.
    let meridian = sin_cos_half_turns(i * (0.5 / rings.n));

    let (x, y) = (meridian.y * equator.x, meridian.y * equator.y);
    Vec3::new(
        negate_if((quarter + 1) & 2 != 0 && x > 0.0, x),
        negate_if(quarter & 2 != 0 && y > 0.0, y),
        negate_if((code >> index_bits) & 4 != 0 && meridian.x > 0.0, meridian.x),
    )
}

/// Patches of a plain grid of latitude and longitude in `BITS` bits (16, 24 or 32).
pub struct LatLong<const BITS: u32>;

impl<const BITS: u32> Codec for LatLong<BITS> {
    const NAME: &'static str = match BITS {
        16 => "latlong16",
        24 => "latlong24",
        32 => "latlong32",
        _ => panic!("LatLong has 16, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    const EXACT_AXES: bool = false;
    /// `sqrt(5) pi / 2^(h+1)` radians in degrees, and what the rounding of both angles and of the decoded vector
    /// adds: at most 7e-7 radians.
    const MAX_ERROR_DEG: f32 = 1.118_034 * 180.0 / (1 << (BITS / 2)) as f32 + 4e-5;
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        grid_encode(v, BITS / 2)
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        grid_decode(code, BITS / 2)
    }
}

/// Nearly square patches of nearly equal area in `BITS` bits (16, 24 or 32).
pub struct LatLongD<const BITS: u32>;

impl<const BITS: u32> LatLongD<BITS> {
    const RINGS: Rings = match BITS {
        16 => RINGS_16,
        24 => RINGS_24,
        _ => RINGS_32,
    };
}

impl<const BITS: u32> Codec for LatLongD<BITS> {
    const NAME: &'static str = match BITS {
        16 => "latlong16d",
        24 => "latlong24d",
        32 => "latlong32d",
        _ => panic!("LatLongD has 16, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    /// The greatest distance from a patch's middle to its corners, 0.56671, 0.035146 and 0.0021951 degrees, and
    /// what the rounding of both angles and of the decoded vector adds: at most 7e-7 radians.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.56672,
        24 => 0.035147,
        _ => 0.0021952,
    } + 4e-5;
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        patch_encode(v, Self::RINGS, BITS - 3)
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        patch_decode(code, Self::RINGS, BITS - 3)
    }
}

/// 16 bits, fast.
pub type LatLong16 = LatLong<16>;
/// 24 bits, fast.
pub type LatLong24 = LatLong<24>;
/// 32 bits, fast.
pub type LatLong32 = LatLong<32>;
/// 16 bits, better distributed.
pub type LatLongD16 = LatLongD<16>;
/// 24 bits, better distributed.
pub type LatLongD24 = LatLongD<24>;
/// 32 bits, better distributed.
pub type LatLongD32 = LatLongD<32>;
