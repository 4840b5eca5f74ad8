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
    let rows = recorded::<Vec<String>>("processors.csv");
    // The vectors of each row, where so many others have two digests each.
    let of_vectors = |others: usize| -> Vec<usize> {
        let of_row = |row: &Vec<String>| {
            let (levels, digests) = (row[5].split(' ').count(), row[7].parse::<usize>().unwrap());
            let left = digests.checked_sub(2 * others).filter(|left| left % (1 + levels) == 0);
            left.map(|left| left / (1 + levels))
        };
        rows.iter().map_while(of_row).collect()
    };
    let is_one = |found: Vec<usize>| {
        found.len() == rows.len() && found.iter().all(|count| *count == found[0] && *count <= vectors().len())
    };
    // A record from before there were rotations has none.
    assert!(
        [frames().len() + rotations().len(), frames().len()]
            .into_iter()
            .any(|others| is_one(of_vectors(others)))
    );
}
