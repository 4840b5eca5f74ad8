//! On which processors the codecs gave the same bits, as `docs/data/processors.csv` has it.

use std::collections::BTreeSet;
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

/// The record is of all processors that `cargo xtask processors` knows, and of all codecs: by the functions of single
/// vectors and by those of slices, which vectors have at every level and frames at one.
#[test]
fn the_record_is_of_all_processors_and_codecs() {
    let record = record();
    let rows: Vec<Vec<&str>> = record.lines().skip(1).map(cells).collect();
    let source = std::fs::read_to_string(repository().join("xtask/src/processors.rs")).unwrap();
    let recorded: BTreeSet<&str> = rows.iter().map(|row| row[0]).collect();
    for name in &recorded {
        assert!(source.contains(&format!("\"{name}\"")), "{name}");
    }
    assert!(
        source.contains(&format!("PROCESSORS: [Processor; {}]", recorded.len())),
        "cargo xtask processors --record"
    );
    for row in rows {
        let levels = row[5].split(' ').count();
        let digests = vectors().len() * (1 + levels) + frames().len() * 2;
        assert_eq!(row[7], digests.to_string(), "{row:?}: cargo xtask processors --record");
    }
}
