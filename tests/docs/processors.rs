//! Processors on which the codecs gave the same bits, from `docs/data/processors.csv`.

use unitvec_catalogue::{frames, vectors};
use unitvec_tests::repository;

fn record() -> String {
    std::fs::read_to_string(repository().join("docs/data/processors.csv")).unwrap()
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').collect()
}

/// The record as a table.
pub fn table() -> String {
    let record = record();
    let mut text = String::new();
    for (index, line) in record.lines().enumerate() {
        text += &format!("| {} |\n", cells(line).join(" | "));
        if index == 0 {
            text += &format!("{}|\n", "|---".repeat(cells(line).len()));
        }
    }
    text
}

/// The record covers all codecs: by the functions of single vectors and by those of slices, which vectors have at every
/// level and frames at one. Its hash in `records.lock` shows that it covers all processors.
#[test]
fn the_record_is_of_all_codecs() {
    for row in record().lines().skip(1).map(cells) {
        let levels = row[5].split(' ').count();
        let digests = vectors().len() * (1 + levels) + frames().len() * 2;
        assert_eq!(row[7], digests.to_string(), "{row:?}: cargo xtask renew processors");
    }
}
