//! Processors on which the codecs gave the same bits, from `docs/data/processors.csv`.

use super::{markdown_table, recorded};
use unitvec_catalogue::{frames, rotations, vectors};
use unitvec_tests::repository;

/// The record as a table.
pub fn table() -> String {
    let record = std::fs::read_to_string(repository().join("docs/data/processors.csv")).unwrap();
    let mut rows = record.lines().map(|line| line.replace(',', " | "));
    markdown_table(&rows.next().unwrap(), rows)
}

/// The record covers the same codecs on all processors, all but those that are newer: by the functions of single vectors and by
/// those of slices, which vectors have at every level, frames and rotations at one. Its hash in `records.lock` shows that it covers all
/// processors.
#[test]
fn the_record_is_of_the_same_codecs() {
    let mut of_vectors = recorded::<Vec<String>>("processors.csv").into_iter().map(|row| {
        let (levels, digests) = (row[5].split(' ').count(), row[7].parse::<usize>().unwrap());
        // A record from before there were rotations has none.
        let others = [frames().len() + rotations().len(), frames().len()].map(|count| digests - 2 * count);
        let of_vectors = others.into_iter().find(|digests| digests % (1 + levels) == 0);
        of_vectors.unwrap_or_else(|| panic!("{row:?}")) / (1 + levels)
    });
    let first = of_vectors.next().unwrap();
    assert!(first <= vectors().len() && of_vectors.all(|count| count == first));
}
