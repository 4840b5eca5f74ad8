//! The drivers that `cargo xtask renew drivers` ran, as `docs/data/drivers.tsv` has them.

use super::{markdown_table, recorded};
use serde::Deserialize;
use std::collections::BTreeSet;

/// A driver, and the inputs that it was given.
#[derive(Deserialize)]
struct Driver {
    origin: String,
    device: String,
    driver: String,
    vulkan: String,
    codecs: u64,
    vectors: u64,
    codes: u64,
    mismatches: u64,
}

pub fn table() -> String {
    let rows = recorded("drivers.tsv").into_iter().map(|row| {
        let Driver { origin, device, driver, vulkan, codecs, vectors, codes, mismatches } = row;
        format!("{driver} | {device} | {vulkan} | {origin} | {codecs} | {vectors} | {codes} | {mismatches}")
    });
    let titles =
        "driver | device | Vulkan | file or package | codecs | vectors encoded | codes decoded | mismatches";
    markdown_table(titles, rows)
}

/// The claims of docs/agreement.md about the table: lavapipe of three releases of Mesa and SwiftShader, all codecs and
/// the same inputs on each, no mismatch.
#[test]
fn drivers_of_two_makers_agree() {
    let rows = recorded::<Driver>("drivers.tsv");
    let release = |row: &Driver| Some(row.driver.split_once("Mesa ")?.1.get(..2)?.to_owned());
    assert!(rows.iter().filter_map(release).collect::<BTreeSet<_>>().len() >= 3);
    assert!(rows.iter().any(|row| row.driver.contains("SwiftShader")));
    let inputs = |row: &Driver| (row.codecs, row.vectors, row.codes);
    assert!(rows.iter().all(|row| inputs(row) == inputs(&rows[0]) && row.mismatches == 0));
}
