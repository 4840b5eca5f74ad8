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
//! * [`CrytekBfn24`] is the original method: one length for all directions of a cell of a table.
//! * [`SnormBest8`] (snorm8x3P) is the survey's: the best of a cell's four lengths. One direction in eleven has a better
//!   length.
//! * [`SnormNearest8`] tries the 64, and a few scales in between: no whole vector points nearer.
//! * The first two work out the lengths of cells; [`EncodeByTable`] looks them up. Their codes are the same. The compute kernels and the `unitvec` program take the table.
//! * [`SnormBest16`] (snorm16x3P) tries the 64 longest of the 16384 lengths, and the unit vector.
//!
//! The table ([`fill_table`], 805 KiB): a direction's column and row are `mid / max` and `min / max` of its magnitudes
//! in order of size, times 640. By symmetry that covers the sphere, and a row is at most its column. A cell is a word,
//! the bytes of which are four of the lengths 64 to 127; to a shader, a texel of VK_FORMAT_R8G8B8A8_UINT. The low byte
//! has the length that fits nine directions of the cell, three by three, best in the mean; each byte above it the one
//! that helps most where the ones before may be taken too. The word of a cell is number
//! `4 (g (2 g + 1) + row) + column`, `g = column / 4` rounded down: four columns side by side have their rows one after
//! the other, so that a line of a cache has 4 x 4 cells, and half a square is not stored.
//!
//! * Layout: x in the low component, then y, z, in two's complement, as in VK_FORMAT_R8G8B8_SNORM and
//!   VK_FORMAT_R16G16B16_SNORM. A component's pattern of `-2^(b-1)`, never written, counts as -1. The zero vector,
//!   never written either, decodes to (0, 0, 0).
//! * Decoding gives the components as stored, **not normalised**: the longest is at least 0.5. The format is that of
//!   plain snorm components, so that best fit and plain codes can be mixed.
//! * Error in degrees, mean and largest over uniform directions, with the survey's in brackets:
//!   snorm8x3P 0.0308, 0.319 (0.03164, 0.33443), nearest of all 0.0305, 0.319; CrytekBFN24 0.0402, 0.31 seen (0.04027,
//!   4.78260); snorm16x3P 0.000088, 0.00124 (0.00060, 0.00149).
//! * Why less than the survey's maximum: an error of 4.78 degrees would be half a step at a length of 6, read where it
//!   does not fit; here no length is under 64, since short ones gain nothing over their multiples. At 16 bits the survey
//!   tries five lengths, and the mean falls with the square root of their number.
//! * Why that table: an encoder by table spends half its time waiting for the table, the longer the larger what is in
//!   use of it. Four lengths that together fit a cell do as well as those of the four closest of 1024 x 1024 texels, and
//!   one read has them all; a table of such texels with one read for all four would be five times as large.
//! * Weakness: around the axes nothing is gained. However long, whole vectors there are a step apart, and the error
//!   is that of plain components, ten times the mean.
//! * Cost: the scan of 64 lengths takes some 1900 operations, 40 times those of an octahedral encoder (oct24: 48), and
//!   SnormNearest8 2200. By table snorm8x3P takes 146 (3 times as many), CrytekBFN24 58, and one read each.
//!   Decoding is next to free.
//! * Axes and diagonals (components of 0 and one magnitude) round-trip exactly, but for length; the axes have length 1
//!   with snorm8x3P and snorm16x3P. Mirrored or permuted, a vector gets the mirrored or permuted code.

use crate::arith::{
    ONE_AND_A_HALF_2_23, exp2, floor, integer_part, is_negative, max, min, nearest_whole, negate_if,
    signed_code, snorm_decode, snorm_max, sqrt, whole_to_u32,
};
use crate::codec::Codec;
use crate::direction::or_z;
use glam::Vec3;

/// Columns of the table.
pub const TABLE_COLUMNS: u32 = 640;

/// Words of the table, one a cell: in groups of four columns, of 4, 8, ... 640 rows.
pub const TABLE_WORDS: usize = (TABLE_COLUMNS / 4 * (TABLE_COLUMNS / 4 + 1) * 8) as usize;

/// Cells from 0 to 1. A little less than the columns, so that 1 itself is in the last.
const CELLS: f32 = TABLE_COLUMNS as f32 - 1.0 / 1024.0;

/// Lengths of a cell.
const LENGTHS: usize = 4;

/// A cell's directions along each side that its lengths are to fit, and in all.
const SAMPLES_A_SIDE: usize = 3;
const SAMPLES: usize = SAMPLES_A_SIDE * SAMPLES_A_SIDE;

/// A length counts as better than a longer one where it leaves less than this part of the error: else rounding would
/// decide between lengths that fit alike, as all do beside an axis.
const CLEARLY_LESS: f32 = 1.0 - 1.0 / 16_384.0;

/// Lengths that a scan tries, from the longest down.
const SCANNED: f32 = 64.0;

/// Directions whose least component is a larger part of the largest one are near the middle of an octant.
const MIDDLE_OF_OCTANT: f32 = 0.75;

/// Components that are a smaller part of the largest one count as 0: 2^-24. No length of these formats tells them from
/// 0, and no denormal component of a vector with a direction is a larger part.
const LEAST_PART: f32 = exp2(-24);

/// The magnitudes of a vector's components by size, as parts of the largest one, which is 1.
#[derive(Clone, Copy)]
struct Parts {
    mid: f32,
    min: f32,
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
    let max = max(max(a.x, a.y), a.z);
    Vec3::new(part(a.x, max), part(a.y, max), part(a.z, max))
}

#[inline(always)]
fn by_size(u: Vec3) -> Parts {
    let (low, high) = (min(u.x, u.y), max(u.x, u.y));
    Parts { mid: max(low, min(high, u.z)), min: min(low, u.z) }
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

/// The low byte of the two's complement of the nearest whole number, the even one of two.
#[inline(always)]
fn nearest_byte(x: f32) -> u32 {
    (x + ONE_AND_A_HALF_2_23).to_bits() & 255
}

/// The parts of `v`, which has a direction, and the reciprocal of its largest magnitude: what [`on_cube`] has, to within
/// 2^-23, by one division.
#[inline(always)]
fn parts_and_reciprocal(v: Vec3) -> (Parts, f32) {
    let a = v.abs();
    let (low, high) = (min(a.x, a.y), max(a.x, a.y));
    let reciprocal = 1.0 / max(high, a.z);
    let mid = max(low, min(high, a.z)) * reciprocal;
    let min = min(low, a.z) * reciprocal;
    let parts = Parts {
        mid: if mid < LEAST_PART { 0.0 } else { mid },
        min: if min < LEAST_PART { 0.0 } else { min },
    };
    (parts, reciprocal)
}

/// The code of `v` scaled to a largest component of `length` and rounded.
///
/// The scale of the largest component is off by 2^-23 of it at most, which rounding takes away.
#[inline(always)]
fn code_at_length(v: Vec3, reciprocal: f32, length: f32) -> u32 {
    let scale = length * reciprocal;
    nearest_byte(v.x * scale) | (nearest_byte(v.y * scale) << 8) | (nearest_byte(v.z * scale) << 16)
}

/// A length among a cell's, and how far from the direction it ends, squared and up to a factor.
#[derive(Clone, Copy)]
struct Candidate {
    length: f32,
    cost: f32,
}

impl Candidate {
    /// The vector whose largest component is `length` is off by `d = (0, dy, dz)`, and its angle to `u` has the sine
    /// `|d x u| / (|q| |u|)`. Here `|q|` counts as `length |u|`, from which it is 1.2 % at most, and the square of
    /// `d x u`, `(1 + min^2) dy^2 - 2 mid min dy dz + (1 + mid^2) dz^2`, as `dy^2 - min dy dz + (1 + mid - min) dz^2`
    /// times a factor. Which of two lengths is nearer is mistaken only where their errors are within 14 %; the
    /// mean error is the same to 0.03 %.
    #[inline(always)]
    fn of_length(u: Parts, weight: f32, length: f32) -> Self {
        let (y, z) = (u.mid * length, u.min * length);
        let (dy, dz) = (nearest_whole(y) - y, nearest_whole(z) - z);
        Self { length, cost: (dy - u.min * dz) * dy + weight * (dz * dz) }
    }

    /// `other` where it points nearer, else `self`.
    #[inline(always)]
    fn or_nearer(self, other: Self) -> Self {
        let is_nearer = other.cost * (self.length * self.length) < self.cost * (other.length * other.length);
        if is_nearer { other } else { self }
    }
}

/// Lengths of a cell, the best alone first.
type Lengths = [f32; LENGTHS];

/// The one of a cell's lengths that fits best.
#[inline(always)]
fn best_of(u: Parts, [a, b, c, d]: Lengths) -> f32 {
    let weight = 1.0 + (u.mid - u.min);
    let first = Candidate::of_length(u, weight, a).or_nearer(Candidate::of_length(u, weight, b));
    let second = Candidate::of_length(u, weight, c).or_nearer(Candidate::of_length(u, weight, d));
    first.or_nearer(second).length
}

/// The column and the row of a direction's cell.
#[inline(always)]
fn cell_of(u: Parts) -> (u32, u32) {
    (integer_part(u.mid * CELLS) as u32, integer_part(u.min * CELLS) as u32)
}

/// The sine of the error that a length leaves, up to a factor that is the same, to 1.2 %, for all lengths.
#[inline(always)]
fn sine(u: Parts, length: f32) -> f32 {
    let (y, z) = (u.mid * length, u.min * length);
    let (dy, dz) = (nearest_whole(y) - y, nearest_whole(z) - z);
    let cx = dy * u.min - dz * u.mid;
    sqrt(((cx * cx + dy * dy) + dz * dz) * (1.0 / (length * length)))
}

#[inline(always)]
fn sample_part(cell: u32, i: usize) -> f32 {
    (cell as f32 + (i as f32 + 0.5) / SAMPLES_A_SIDE as f32) / CELLS
}

/// One of the nine directions of a cell.
#[inline(always)]
fn sample(column: u32, row: u32, i: usize) -> Parts {
    Parts { mid: sample_part(column, i / SAMPLES_A_SIDE), min: sample_part(row, i % SAMPLES_A_SIDE) }
}

/// The lengths of a cell, each the one that leaves least of the mean error of the ones before; the longest of equals.
#[inline]
fn cell_lengths(column: u32, row: u32) -> Lengths {
    // By sample, then by length from 127 down: the compiler takes several lengths at a time.
    let mut errors = [[0.0; SCANNED as usize]; SAMPLES];
    let mut i = 0;
    while i < SAMPLES {
        let u = sample(column, row, i);
        let mut j = 0;
        while j < errors[i].len() {
            errors[i][j] = sine(u, 127.0 - j as f32);
            j += 1;
        }
        i += 1;
    }
    // What the lengths so far leave: no length, more than any.
    let mut left = [1.0; SAMPLES];
    let mut lengths = [0.0; LENGTHS];
    for length in &mut lengths {
        let mut totals = [0.0; SCANNED as usize];
        for (errors, left) in errors.iter().zip(left) {
            for (total, error) in totals.iter_mut().zip(errors) {
                *total += min(*error, left);
            }
        }
        let mut best = 0;
        for (j, total) in totals.iter().enumerate() {
            if *total < totals[best] * CLEARLY_LESS {
                best = j;
            }
        }
        *length = 127.0 - best as f32;
        for (errors, left) in errors.iter().zip(&mut left) {
            *left = min(errors[best], *left);
        }
    }
    lengths
}

/// A length from 64 to 127, whatever the word: its bits 17 to 22, as the first of the mantissa, with the exponent of 64.
#[inline(always)]
fn length_of(word: u32) -> f32 {
    f32::from_bits((word & 0x007e_0000) | 0x4280_0000)
}

/// The lengths in a word of the table, in the low six bits of each byte.
#[inline(always)]
fn lengths_in(word: u32) -> Lengths {
    [length_of(word << 17), length_of(word << 9), length_of(word << 1), length_of(word >> 7)]
}

/// Number of a cell's word: four columns side by side have their rows, of which they need no more than there are
/// columns to their right end, one after the other.
#[inline(always)]
fn table_index((column, row): (u32, u32)) -> u32 {
    let group = column / 4;
    4 * (group * (2 * group + 1) + row) + column
}

/// Word `index` of the table: the lengths of a cell, the best alone in the low byte.
#[inline]
pub fn table_word(index: u32) -> u32 {
    let mut group = 0;
    while 8 * (group + 1) * (group + 2) <= index {
        group += 1;
    }
    let within = index - 8 * group * (group + 1);
    let [a, b, c, d] = cell_lengths(4 * group + within % 4, within / 4).map(whole_to_u32);
    a | (b << 8) | (c << 16) | (d << 24)
}

/// Computes the table that the encoders by table read: [`TABLE_WORDS`] words, in less than a second. A shorter slice
/// gets the first of them; what a longer one has beyond is left alone.
#[cfg(not(target_arch = "spirv"))]
pub fn fill_table(table: &mut [u32]) {
    for (index, word) in (0..TABLE_WORDS as u32).zip(table) {
        *word = table_word(index);
    }
}

/// A codec whose encoder can look lengths up in the table of [`fill_table`]: a few operations in place of many, for the
/// same codes.
pub trait EncodeByTable: Codec {
    /// [`Codec::encode`], with `word` to look up a word of the table: its index is below [`TABLE_WORDS`].
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> Self::Code;

    /// [`Codec::encode`] by the table of [`fill_table`]. Another table, or one that is too short, costs accuracy only.
    #[inline(always)]
    fn encode_by_table(v: Vec3, table: &[u32]) -> Self::Code {
        Self::encode_by(v, |index| {
            let index = index as usize;
            // 0 stands for lengths of 64.
            if index < table.len() { table[index] } else { 0 }
        })
    }
}

impl EncodeByTable for SnormBest8 {
    #[inline(always)]
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        code_at_length(v, reciprocal, best_of(parts, lengths_in(word(table_index(cell_of(parts))))))
    }
}

impl EncodeByTable for CrytekBfn24 {
    #[inline(always)]
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let [length, ..] = lengths_in(word(table_index(cell_of(parts))));
        code_at_length(v, reciprocal, length)
    }
}

/// The largest angle, in degrees, that rounding at this length leaves: half the diagonal of a square of whole points in
/// the plane where the largest component is `length`. The angle is at most the distance over `length`. `rounding` is
/// what `f32` adds to the distance.
const fn error_bound(length: f32, rounding: f32) -> f32 {
    ((core::f32::consts::FRAC_1_SQRT_2 + rounding) / length).to_degrees()
}

/// snorm8x3P, 24 bits: the best of a cell's four lengths. A VK_FORMAT_R8G8B8_SNORM.
///
/// This works the lengths out, 576 trials: with more than a few vectors to encode, take [`EncodeByTable`].
/// Keeps the axes. Decodes to a vector that is not normalised.
pub struct SnormBest8;

impl Codec for SnormBest8 {
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    /// That of a length of 120. 127, which leaves 0.319 at most, need not be among a cell's lengths: found by trial of
    /// the cells, in directions 1/8 of a cell apart, that none leaves more. The rest is for those in between.
    const MAX_ERROR_DEG: f32 = error_bound(120.0, 1.0 / 16_384.0);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let (column, row) = cell_of(parts);
        code_at_length(v, reciprocal, best_of(parts, cell_lengths(column, row)))
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
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    /// 127 is a length that fits no worse than that, and is among those tried. Positions are off by 2^-17 at most.
    const MAX_ERROR_DEG: f32 = error_bound(127.0, 1.0 / 16_384.0);
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

/// CrytekBFN24, 24 bits: Kaplanyan's method, one length for all directions of a cell. A VK_FORMAT_R8G8B8_SNORM.
///
/// This works the length out; with a table at hand, take [`EncodeByTable`].
/// Decodes to a vector that is not normalised.
pub struct CrytekBfn24;

impl Codec for CrytekBfn24 {
    const BITS: u32 = 24;
    const IS_UNIT: bool = false;
    /// No length is below 64. The largest error seen is half of that, 0.31.
    const MAX_ERROR_DEG: f32 = error_bound(64.0, 1.0 / 16_384.0);
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let (column, row) = cell_of(parts);
        let [length, ..] = cell_lengths(column, row);
        code_at_length(v, reciprocal, length)
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
