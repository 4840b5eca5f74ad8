//! The table of the lengths that fit a cell of directions best.

use super::scan::{LEAST_PART, Parts, SCANNED};
use crate::arith::{
    ONE_AND_A_HALF_2_23, integer_part, max, min, nearest_whole, quotient, reciprocal, root, whole_to_u32,
};
use glam::Vec3;

/// Columns of the table.
pub const TABLE_COLUMNS: u32 = 640;

/// Words of the table, one a cell: in groups of four columns, of 4, 8, ... 640 rows.
pub const TABLE_WORDS: usize = (TABLE_COLUMNS / 4 * (TABLE_COLUMNS / 4 + 1) * 8) as usize;

/// Cells from 0 to 1. A little less than the columns, so that 1 itself is in the last.
const CELLS: f32 = TABLE_COLUMNS as f32 - 1.0 / 1024.0;

/// Lengths of a cell.
const LENGTHS: usize = 4;

/// A cell's directions that its lengths are to fit: three along each side.
const SAMPLES: usize = 9;

/// A length counts as better than a longer one where it leaves less than this part of the error: else rounding would
/// decide between lengths that fit alike, as all do beside an axis.
pub(super) const CLEARLY_LESS: f32 = 1.0 - 1.0 / 16_384.0;

/// The low byte of the two's complement of the nearest whole number, the even one of two.
#[inline(always)]
fn nearest_byte(x: f32) -> u32 {
    (x + ONE_AND_A_HALF_2_23).to_bits() & 255
}

/// The parts of `v`, which has a direction, as `on_cube` gives them, to within 2^-23, and the reciprocal of its
/// largest magnitude: by one division.
#[inline(always)]
pub(super) fn parts_and_reciprocal(v: Vec3) -> (Parts, f32) {
    let a = v.abs();
    let (low, high) = (min(a.x, a.y), max(a.x, a.y));
    let reciprocal = reciprocal(max(high, a.z));
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
pub(super) fn code_at_length(v: Vec3, reciprocal: f32, length: f32) -> u32 {
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
pub(super) type Lengths = [f32; LENGTHS];

/// The one of a cell's lengths that fits best.
#[inline(always)]
pub(super) fn best_of(u: Parts, [a, b, c, d]: Lengths) -> f32 {
    let weight = 1.0 + (u.mid - u.min);
    let first = Candidate::of_length(u, weight, a).or_nearer(Candidate::of_length(u, weight, b));
    let second = Candidate::of_length(u, weight, c).or_nearer(Candidate::of_length(u, weight, d));
    first.or_nearer(second).length
}

/// The column and the row of a direction's cell.
#[inline(always)]
pub(super) fn cell_of(u: Parts) -> (u32, u32) {
    (integer_part(u.mid * CELLS) as u32, integer_part(u.min * CELLS) as u32)
}

/// The sine of the error that a length leaves, up to a factor that is the same, to 1.2 %, for all lengths.
#[inline(always)]
pub(super) fn sine(u: Parts, length: f32) -> f32 {
    let (y, z) = (u.mid * length, u.min * length);
    let (dy, dz) = (nearest_whole(y) - y, nearest_whole(z) - z);
    let cx = dy * u.min - dz * u.mid;
    root(((cx * cx + dy * dy) + dz * dz) * reciprocal(length * length))
}

#[inline(always)]
fn sample_part(cell: u32, i: usize) -> f32 {
    quotient(cell as f32 + quotient(i as f32 + 0.5, 3.0), CELLS)
}

/// One of the nine directions of a cell.
#[inline(always)]
pub(super) fn sample(column: u32, row: u32, i: usize) -> Parts {
    Parts { mid: sample_part(column, i / 3), min: sample_part(row, i % 3) }
}

/// The lengths of a cell, each the one that leaves least of the mean error of those before it; the longest of equals.
#[cfg_attr(target_arch = "spirv", allow(dead_code))]
#[inline]
pub(super) fn cell_lengths(column: u32, row: u32) -> Lengths {
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
    // The errors that the lengths so far leave: with no length, more than any.
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

/// The lengths in a word of the table, in the low six bits of each byte: 64 to 127, whatever the word.
#[inline(always)]
pub(super) fn lengths_in(word: u32) -> Lengths {
    let bytes = (word & 0x3f3f_3f3f) | 0x4040_4040;
    let length = |shift: u32| ((bytes >> shift) & 0xff) as f32;
    [length(0), length(8), length(16), length(24)]
}

/// Number of a cell's word: four columns side by side have their rows, of which they need no more than there are
/// columns to their right end, one after the other.
#[inline(always)]
pub(super) fn table_index((column, row): (u32, u32)) -> u32 {
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
    let [a, b, c, d] = super::cell_lengths(4 * group + within % 4, within / 4).map(whole_to_u32);
    a | (b << 8) | (c << 16) | (d << 24)
}

/// Computes the table that the encoders by table read: [`TABLE_WORDS`] words, in less than a second. A shorter slice
/// gets the first of them; a longer one keeps its other words.
#[cfg(not(target_arch = "spirv"))]
pub fn fill_table(table: &mut [u32]) {
    for (index, word) in (0..TABLE_WORDS as u32).zip(table) {
        *word = table_word(index);
    }
}
