//! The lengths of a cell without arrays that are indexed, which rust-gpu would test and GPUs keep in memory: the sines are
//! computed for each of the four lengths again.

use super::scan::SCANNED;
use super::table::{CLEARLY_LESS, Lengths, sample, sine};
use crate::arith::min;
use glam::Vec3;

/// A value for each of a cell's directions, three by three.
type Nine = [Vec3; 3];

/// The sines that a length leaves in the cell's directions.
#[inline(always)]
fn sines((column, row): (u32, u32), length: f32) -> Nine {
    let at = |i| sine(sample(column, row, i), length);
    [Vec3::new(at(0), at(1), at(2)), Vec3::new(at(3), at(4), at(5)), Vec3::new(at(6), at(7), at(8))]
}

#[inline(always)]
fn smaller([a, b, c]: Nine, [d, e, f]: Nine) -> Nine {
    let each = |a: Vec3, b: Vec3| Vec3::new(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z));
    [each(a, d), each(b, e), each(c, f)]
}

/// The sum, in order.
#[inline(always)]
fn total([a, b, c]: Nine) -> f32 {
    a.x + a.y + a.z + b.x + b.y + b.z + c.x + c.y + c.z
}

/// The length that leaves least of the errors of those before it, and the errors that it leaves.
#[inline(always)]
fn next(cell: (u32, u32), left: Nine) -> (f32, Nine) {
    let (mut best, mut least) = (127.0, total(smaller(sines(cell, 127.0), left)));
    let mut length = 126.0;
    while length > 127.0 - SCANNED {
        let total = total(smaller(sines(cell, length), left));
        if total < least * CLEARLY_LESS {
            (best, least) = (length, total);
        }
        length -= 1.0;
    }
    (best, smaller(sines(cell, best), left))
}

/// [`cell_lengths`](super::table::cell_lengths), to the bit.
#[inline(always)]
pub(super) fn cell_lengths(column: u32, row: u32) -> Lengths {
    let cell = (column, row);
    let (a, left) = next(cell, [Vec3::ONE; 3]);
    let (b, left) = next(cell, left);
    let (c, left) = next(cell, left);
    let (d, _) = next(cell, left);
    [a, b, c, d]
}

#[cfg(test)]
mod tests {
    use super::super::table;

    #[test]
    fn shaders_compute_the_same_lengths() {
        for column in (0..table::TABLE_COLUMNS).step_by(7) {
            for row in (0..=column).step_by(5) {
                let expected = table::cell_lengths(column, row).map(f32::to_bits);
                assert_eq!(super::cell_lengths(column, row).map(f32::to_bits), expected, "{column} {row}");
            }
        }
    }
}
