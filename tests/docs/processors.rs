//! Processors on which the codecs gave the same bits, from `docs/data/processors.csv`.

use super::{markdown_table, recorded};
use std::collections::BTreeSet;
use unitvec_catalogue::CODECS;
use unitvec_tests::repository;

/// The record as a table.
pub fn table() -> String {
    let record = std::fs::read_to_string(repository().join("docs/data/processors.csv")).unwrap();
    let mut rows = record.lines().map(|line| line.replace(',', " | "));
    markdown_table(&rows.next().unwrap(), rows)
}

/// The record covers the same codecs on all processors, all but those that are newer: by the functions of single elements, and by
/// those of slices at every level. Its hash in `records.lock` shows that it covers all processors.
#[test]
fn the_record_is_of_the_same_codecs() {
    let of_row = |row: Vec<String>| {
        let (levels, digests) = (row[5].split(' ').count(), row[7].parse::<usize>().unwrap());
        assert_eq!(digests % (1 + levels), 0, "{row:?}");
        digests / (1 + levels)
    };
    let codecs: BTreeSet<usize> = recorded("processors.csv").into_iter().map(of_row).collect();
    assert!(codecs.len() == 1 && codecs.iter().all(|count| *count <= CODECS.len()), "{codecs:?}");
}
