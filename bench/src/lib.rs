//! What the benchmark and its summary share.

/// Vectors of the slices: in the first cache, in the second, in none.
pub const COUNTS: [usize; 3] = [1 << 10, 1 << 16, 1 << 24];

/// Name of the group of a direction and count, as criterion names its folder.
pub fn group(direction: &str, count: usize) -> String {
    format!("{direction}_{count}")
}
