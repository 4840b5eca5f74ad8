//! Best fit codes: three snorm components of a vector whose length is chosen so that it points as it should.
//!
//! Source: Kaplanyan 2010, "CryENGINE 3: Reaching the speed of light" (best fit normals); Cigolle et al. 2014,
//! section 2.2.
//!
//! Rounded unit vectors are but a shell of the cube of whole vectors `[-m, m]^3`. As the decoder's caller normalises,
//! any whole vector will do, and one of them points nearest. Its length is told by its largest component, the whole
//! number `k`: with `u = |v| / max`, the candidates are the `round(k u)`. A vector and its double point alike, so the
//! `k` above `m / 2` are all there is to try: 64 for `m` = 127.
//!
//! * [`CrytekBfn24`] is the original method: the one length in the closest texel of a table.
//! * [`SnormBest8`] (snorm8x3P) is the survey's: the best of the lengths in the four closest texels, and the longest,
//!   127. One direction in fourteen has a better length.
//! * [`SnormNearest8`] tries the 64, and a few scales in between: no whole vector points nearer.
//! * The first two work the lengths of texels out; [`crytek_bfn24_encode_by_table`] and [`snorm8x3p_encode_by_table`]
//!   look them up. Their codes are the same. The compute kernels and the `unitvec` program take the table.
//! * [`SnormBest16`] (snorm16x3P) tries the 64 longest of the 16384 lengths, and the unit vector.
//!
//! The table ([`fill_table`], 1 MiB) has 1024 x 1024 texels. A direction's column and row are `mid / max` and
//! `min / mid` of its magnitudes in order of size, times 1024: by symmetry that covers the sphere. A texel is a byte,
//! the length `k` (64 to 127) that fits the direction of the texel's middle best. Row by row, that is the image of a
//! VK_FORMAT_R8_UINT texture; in words, the leftmost of four texels is the low byte.
//!
//! * Layout: x in the low component, then y, z, in two's complement, as in VK_FORMAT_R8G8B8_SNORM and
//!   VK_FORMAT_R16G16B16_SNORM. A component's pattern of `-2^(b-1)`, never written, counts as -1. The zero vector,
//!   never written either, decodes to (0, 0, 0).
//! * Decoding gives the components as stored, **not normalised**: the longest is at least 0.5. The format is that of
//!   plain snorm components, so that best fit and plain codes can be mixed.
//! * Error in degrees, mean and largest over uniform directions, with the survey's in brackets:
//!   snorm8x3P 0.0308, 0.319 (0.03164, 0.33443), nearest of all 0.0305, 0.319; CrytekBFN24 0.0336, 0.31 seen (0.04027,
//!   4.78260); snorm16x3P 0.000088, 0.00124 (0.00060, 0.00149).
//! * Why less than the survey's: its table must be coarser. Tables as here, but of 512, 544, 576 and 768 texels a side
//!   give CrytekBFN24 a mean of 0.0414, 0.0403, 0.0394 and 0.0357, and snorm8x3P one of 0.0357, 0.0348, 0.0341 and
//!   0.0316. An error of 4.78 degrees would be half a step at a length of 6, read where it does not fit; here no length
//!   is under 64, since short ones gain nothing over their multiples. At 16 bits the survey tries five lengths, and the
//!   mean falls with the square root of their number.
//! * Weakness: around the axes nothing is gained. However long, whole vectors there are a step apart, and the error
//!   is that of plain components, ten times the mean.
//! * Cost: the scan of 64 lengths takes some 1900 operations, 40 times those of an octahedral encoder (oct24: 48), and
//!   SnormNearest8 2200. By table snorm8x3P takes 258 (5.4 times as many) and four reads, CrytekBFN24 87 and one.
//!   Decoding is next to free.
//! * Axes and diagonals (components of 0 and one magnitude) round-trip exactly, but for length; the axes have length 1
//!   with snorm8x3P and snorm16x3P. Mirrored or permuted, a vector gets the mirrored or permuted code.

use crate::codec::Codec;
use crate::direction::or_z;
use crate::math::{floor, is_negative, negate_if, sqrt};
use crate::scalar::{signed_code, snorm_decode, snorm_max, whole_to_u32};
use glam::Vec3;

/// Texels along a side of the table.
pub const TABLE_SIDE: u32 = 1024;

/// Words of the table: four texels each.
pub const TABLE_WORDS: usize = (TABLE_SIDE * TABLE_SIDE / 4) as usize;

const SIDE: f32 = TABLE_SIDE as f32;

/// Lengths that a scan tries, from the longest down.
const SCANNED: f32 = 64.0;

/// Directions whose least component is a larger part of the largest one are near the middle of an octant.
const MIDDLE_OF_OCTANT: f32 = 0.75;

/// Components that are a smaller part of the largest one count as 0: 2^-24. No length of these formats tells them from
/// 0, and no denormal component of a vector with a direction is a larger part.
const LEAST_PART: f32 = f32::from_bits((127 - 24) << 23);

/// The magnitudes of a vector's components by size, as parts of the largest one, which is 1.
#[derive(Clone, Copy)]
struct Parts {
    mid: f32,
    min: f32,
}

#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a < b { b } else { a }
}

/// `a / max`, or 0 where that is too small to matter.
#[inline(always)]
fn part(a: f32, max: f32) -> f32 {
    let part = a / max;
    if part < LEAST_PART { 0.0 } else { part }
}

/// The magnitudes of the components of `v`, which has a direction, over that of the largest one.
#[inline(always)]
fn on_cube(v: Vec3) -> Vec3 {
    let a = v.abs();
    let max = greater(greater(a.x, a.y), a.z);
    Vec3::new(part(a.x, max), part(a.y, max), part(a.z, max))
}

#[inline(always)]
fn by_size(u: Vec3) -> Parts {
    let (low, high) = (lesser(u.x, u.y), greater(u.x, u.y));
    Parts { mid: greater(low, lesser(high, u.z)), min: lesser(low, u.z) }
}

/// A candidate: the scale of `u` whose rounding it is, and the squared sine of its angle to `u`, up to a factor, as a
/// fraction.
#[derive(Clone, Copy)]
struct Fit {
    scale: f32,
    numerator: f32,
    denominator: f32,
}

impl Fit {
    /// The vector whose largest component is `k`, a whole number.
    ///
    /// It is off by `d = (0, dy, dz)`, and its angle to `u` has the sine `|d x u| / (|q| |u|)`.
    #[inline(always)]
    fn of_length(u: Parts, k: f32) -> Self {
        let (y, z) = (u.mid * k, u.min * k);
        let (qy, qz) = (floor(y + 0.5), floor(z + 0.5));
        let (dy, dz) = (qy - y, qz - z);
        let cx = dy * u.min - dz * u.mid;
        Self { scale: k, numerator: (cx * cx + dy * dy) + dz * dz, denominator: (k * k + qy * qy) + qz * qz }
    }

    /// The vector `u` times `scale`, rounded; any scale.
    #[inline(always)]
    fn of_scale(u: Parts, scale: f32) -> Self {
        let (y, z) = (u.mid * scale, u.min * scale);
        let (qx, qy, qz) = (floor(scale + 0.5), floor(y + 0.5), floor(z + 0.5));
        let (dx, dy, dz) = (qx - scale, qy - y, qz - z);
        let (cx, cy, cz) = (dy * u.min - dz * u.mid, dz - dx * u.min, dx * u.mid - dy);
        Self { scale, numerator: (cx * cx + cy * cy) + cz * cz, denominator: (qx * qx + qy * qy) + qz * qz }
    }

    /// `other` where it points nearer to `u`, else `self`.
    #[inline(always)]
    fn or_nearer(self, other: Self) -> Self {
        if other.numerator * self.denominator < self.numerator * other.denominator { other } else { self }
    }

    /// The best of `self` and the 64 lengths from `longest` down; of equals the first.
    #[inline(always)]
    fn or_scanned(self, u: Parts, longest: f32) -> Self {
        let mut best = self;
        let mut k = longest;
        while k > longest - SCANNED {
            best = best.or_nearer(Self::of_length(u, k));
            k -= 1.0;
        }
        best
    }
}

/// The length of the 64 from 127 down that fits best.
#[inline(always)]
fn best_length(u: Parts) -> f32 {
    Fit::of_length(u, 127.0).or_scanned(u, 127.0).scale
}

/// The scale that fits best of all, up to 127.25.
///
/// The rounding at a length is the nearest in its plane, which need not be the nearest in angle, least so near the
/// middle of an octant, to which the planes lie aslant. Scales between whole numbers find what is left.
#[inline(always)]
fn best_scale(u: Parts) -> f32 {
    let mut best = Fit::of_length(u, 127.0).or_scanned(u, 127.0);
    let end = if u.min > MIDDLE_OF_OCTANT { 111.5 } else { 123.5 };
    let mut scale = 127.25;
    while scale > end {
        best = best.or_nearer(Fit::of_scale(u, scale));
        scale -= 0.5;
    }
    best.scale
}

/// The whole vector of a scale: magnitudes rounded, with the signs of `v`.
#[inline(always)]
fn at_scale(v: Vec3, u: Vec3, scale: f32) -> Vec3 {
    Vec3::new(
        negate_if(is_negative(v.x), floor(u.x * scale + 0.5)),
        negate_if(is_negative(v.y), floor(u.y * scale + 0.5)),
        negate_if(is_negative(v.z), floor(u.z * scale + 0.5)),
    )
}

/// Whole vectors of components from -127 to 127 to 24 bits.
#[inline(always)]
fn pack8(q: Vec3) -> u32 {
    signed_code(q.x, 8) | (signed_code(q.y, 8) << 8) | (signed_code(q.z, 8) << 16)
}

/// Where a direction lies in the table, as column and row; whole numbers are the edges of texels.
#[inline(always)]
fn table_position(u: Parts) -> (f32, f32) {
    (u.mid * SIDE, if u.mid > 0.0 { u.min / u.mid * SIDE } else { 0.0 })
}

/// `i`, or the nearest column or row of the table.
#[inline(always)]
fn in_table(i: f32) -> f32 {
    greater(0.0, lesser(i, SIDE - 1.0))
}

/// The length of a texel: the one that fits its middle best.
#[inline(always)]
fn texel_length(column: f32, row: f32) -> f32 {
    let mid = (column + 0.5) / SIDE;
    best_length(Parts { mid, min: mid * ((row + 0.5) / SIDE) })
}

/// The length that the table has for a texel. Where it has none (the table is too short, or not one of
/// [`fill_table`]), 127.
#[inline(always)]
fn length_in_table(table: &[u32], column: f32, row: f32) -> f32 {
    let index = whole_to_u32(in_table(row)) * TABLE_SIDE + whole_to_u32(in_table(column));
    let word = (index / 4) as usize;
    let texels = if word < table.len() { table[word] } else { 0 };
    let texel = (texels >> (8 * (index % 4))) & 255;
    if texel.wrapping_sub(64) < 64 { texel as f32 } else { 127.0 }
}

/// Word `index` of the table: texels `4 index` to `4 index + 3`, row by row, the first in the low byte.
pub fn table_word(index: u32) -> u32 {
    let first = 4 * (index % (TABLE_SIDE / 4));
    let row = (index / (TABLE_SIDE / 4)) as f32;
    let mut word = 0;
    let mut i = 0;
    while i < 4 {
        word |= whole_to_u32(texel_length((first + i) as f32, row)) << (8 * i);
        i += 1;
    }
    word
}

/// Computes the table that the encoders by table read: [`TABLE_WORDS`] words, in less than a second. A shorter slice
/// gets the first of them; what a longer one has beyond is left alone.
#[cfg(not(target_arch = "spirv"))]
pub fn fill_table(table: &mut [u32]) {
    for (index, word) in (0..TABLE_WORDS as u32).zip(table) {
        *word = table_word(index);
    }
}

/// The lengths of four texels: left and right above, left and right below.
type FourLengths = [f32; 4];

/// The column and row of the upper left one of the four texels whose middles are closest to a direction.
#[inline(always)]
fn closest_four(u: Parts) -> (f32, f32) {
    let (x, y) = table_position(u);
    (floor(x - 0.5), floor(y - 0.5))
}

/// The length of the four and of 127 that fits best.
#[inline(always)]
fn best_of_four(u: Parts, [a, b, c, d]: FourLengths) -> f32 {
    let best = Fit::of_length(u, 127.0)
        .or_nearer(Fit::of_length(u, a))
        .or_nearer(Fit::of_length(u, b))
        .or_nearer(Fit::of_length(u, c))
        .or_nearer(Fit::of_length(u, d));
    best.scale
}

/// The snorm8x3P code of the direction of `v`, the lengths taken from the table: the code of [`SnormBest8`].
#[inline(always)]
pub fn snorm8x3p_encode_by_table(v: Vec3, table: &[u32]) -> u32 {
    let (v, _) = or_z(v);
    let u = on_cube(v);
    let parts = by_size(u);
    let (column, row) = closest_four(parts);
    let lengths = [
        length_in_table(table, column, row),
        length_in_table(table, column + 1.0, row),
        length_in_table(table, column, row + 1.0),
        length_in_table(table, column + 1.0, row + 1.0),
    ];
    pack8(at_scale(v, u, best_of_four(parts, lengths)))
}

/// The CrytekBFN24 code of the direction of `v`, its length taken from the table: the code of [`CrytekBfn24`].
#[inline(always)]
pub fn crytek_bfn24_encode_by_table(v: Vec3, table: &[u32]) -> u32 {
    let (v, _) = or_z(v);
    let u = on_cube(v);
    let (x, y) = table_position(by_size(u));
    pack8(at_scale(v, u, length_in_table(table, floor(x), floor(y))))
}

/// The largest angle, in degrees, that rounding at this length leaves: half the diagonal of a square of whole points in
/// the plane where the largest component is `length`. The angle is at most the distance over `length`. `rounding` is
/// what `f32` adds to the distance.
const fn error_bound(length: f32, rounding: f32) -> f32 {
    ((core::f32::consts::FRAC_1_SQRT_2 + rounding) / length).to_degrees()
}

/// snorm8x3P, 24 bits: the best of the lengths of the four closest texels, and of 127. A VK_FORMAT_R8G8B8_SNORM.
///
/// This works the texels' lengths out, 256 trials: with more than a few vectors to encode, take
/// [`snorm8x3p_encode_by_table`]. Keeps the axes. Decodes to a vector that is not normalised.
pub struct SnormBest8;

impl Codec for SnormBest8 {
    const NAME: &'static str = "snorm8x3p";
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    /// 127 is a length that fits no worse than that, and is among those tried. Positions are off by 2^-17 at most.
    const MAX_ERROR_DEG: f32 = error_bound(127.0, 1.0 / 16_384.0);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (v, _) = or_z(v);
        let u = on_cube(v);
        let parts = by_size(u);
        let (column, row) = closest_four(parts);
        let (left, right) = (in_table(column), in_table(column + 1.0));
        let (above, below) = (in_table(row), in_table(row + 1.0));
        let lengths = [
            texel_length(left, above),
            texel_length(right, above),
            texel_length(left, below),
            texel_length(right, below),
        ];
        pack8(at_scale(v, u, best_of_four(parts, lengths)))
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        Vec3::new(snorm_decode(code, 8), snorm_decode(code >> 8, 8), snorm_decode(code >> 16, 8))
    }
}

/// The format of [`SnormBest8`], 24 bits, with an encoder that misses nothing: of all whole vectors the one that points
/// nearest.
///
/// Keeps the direction of any code. Decodes to a vector that is not normalised.
pub struct SnormNearest8;

impl Codec for SnormNearest8 {
    const NAME: &'static str = "snorm8x3_nearest";
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    const MAX_ERROR_DEG: f32 = SnormBest8::MAX_ERROR_DEG;
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (v, _) = or_z(v);
        let u = on_cube(v);
        pack8(at_scale(v, u, best_scale(by_size(u))))
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        SnormBest8::decode(code)
    }
}

/// CrytekBFN24, 24 bits: Kaplanyan's method, one length for all directions of a texel. A VK_FORMAT_R8G8B8_SNORM.
///
/// This works the texel's length out; with a table at hand, take [`crytek_bfn24_encode_by_table`], or, better,
/// [`snorm8x3p_encode_by_table`].
/// Decodes to a vector that is not normalised.
pub struct CrytekBfn24;

impl Codec for CrytekBfn24 {
    const NAME: &'static str = "crytek_bfn24";
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    /// No length is below 64. The largest error seen is half of that, 0.31.
    const MAX_ERROR_DEG: f32 = error_bound(64.0, 1.0 / 16_384.0);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (v, _) = or_z(v);
        let u = on_cube(v);
        let (x, y) = table_position(by_size(u));
        pack8(at_scale(v, u, texel_length(in_table(floor(x)), in_table(floor(y)))))
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        SnormBest8::decode(code)
    }
}

/// snorm16x3P, 48 bits: the best of the lengths 32704 to 32767 and of the unit vector. A VK_FORMAT_R16G16B16_SNORM.
///
/// Never further off than plain snorm16x3, but by what `f32` rounds: where it does not turn the rounding of the unit
/// vector, by less than 0.00003 degrees.
/// Decodes to a vector that is not normalised.
pub struct SnormBest16;

impl Codec for SnormBest16 {
    const NAME: &'static str = "snorm16x3p";
    const BITS: u32 = 48;
    const IS_UNIT: bool = false;
    /// 32767 is a length that fits no worse than that. Positions are off by 2^-9 at most along each axis, both in the
    /// choice and in what is chosen.
    const MAX_ERROR_DEG: f32 = error_bound(snorm_max(16), 1.0 / 128.0);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode(v: Vec3) -> [u32; 2] {
        let (v, _) = or_z(v);
        let u = on_cube(v);
        let parts = by_size(u);
        let longest = snorm_max(16);
        let unit = longest / sqrt((1.0 + parts.mid * parts.mid) + parts.min * parts.min);
        let best = Fit::of_scale(parts, unit).or_scanned(parts, longest);
        let q = at_scale(v, u, best.scale);
        [signed_code(q.x, 16) | (signed_code(q.y, 16) << 16), signed_code(q.z, 16)]
    }

    #[inline(always)]
    fn decode([low, high]: [u32; 2]) -> Vec3 {
        Vec3::new(snorm_decode(low, 16), snorm_decode(low >> 16, 16), snorm_decode(high, 16))
    }
}
