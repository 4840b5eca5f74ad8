//! Constants and names that the benchmark and its summary share.

/// Numbers of vectors in the slices, which fit the first cache, the second, or none.
pub const COUNTS: [usize; 3] = [1 << 10, 1 << 16, 1 << 24];

/// Name of the group of a direction and count, as criterion names its folder.
pub fn group(direction: &str, count: usize) -> String {
    format!("{direction}_{count}")
}
