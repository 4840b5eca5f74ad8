//! Processors on which the codecs gave the same bits, from `docs/data/processors.csv`.

use super::{markdown_table, recorded};
use unitvec_catalogue::{frames, vectors};
use unitvec_tests::repository;

/// The record as a table.
pub fn table() -> String {
    let record = std::fs::read_to_string(repository().join("docs/data/processors.csv")).unwrap();
    let mut rows = record.lines().map(|line| line.replace(',', " | "));
    markdown_table(&rows.next().unwrap(), rows)
}

/// The record covers all codecs: by the functions of single vectors and by those of slices, which vectors have at every
/// level and frames at one. Its hash in `records.lock` shows that it covers all processors.
#[test]
fn the_record_is_of_all_codecs() {
    for row in recorded::<Vec<String>>("processors.csv") {
        let levels = row[5].split(' ').count();
        let digests = vectors().len() * (1 + levels) + frames().len() * 2;
        assert_eq!(row[7], digests.to_string(), "{row:?}: cargo xtask renew processors");
    }
}
