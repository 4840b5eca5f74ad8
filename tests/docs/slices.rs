//! Costs of slices on a CPU, as `docs/data/slices.json` has them.

use super::markdown_table;
use serde_json::Value;
use std::sync::LazyLock;
use unitvec_tests::repository;

static REPORT: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_slice(&std::fs::read(repository().join("docs/data/slices.json")).unwrap()).unwrap()
});

/// The rows of an operation, with nanoseconds a vector in slices of 2^10, and where that was measured 2^16 and 2^24 vectors.
fn rows(operation: &str) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
    let rows = REPORT["rows"].as_array().unwrap().iter().filter(move |row| row["operation"] == operation);
    let ns = |row: &Value| row["ns"].as_array().unwrap().iter().map(|ns| ns.as_f64().unwrap()).collect();
    rows.map(move |row| (row["name"].as_str().unwrap(), ns(row)))
}

/// The times of a row.
fn ns(operation: &str, name: &str) -> Vec<f64> {
    let found = rows(operation).find(|row| row.0 == name);
    found.unwrap_or_else(|| panic!("{name} is not in docs/data/slices.json")).1
}

/// The time of a format in slices of 2^10 vectors, in times of `oct16p`, which was measured just before it.
pub fn times(name: &str) -> String {
    let times = ns("formats", name)[0] / ns("formats", &format!("{name}-oct16p"))[0];
    if times < 10.0 { format!("{times:.1}") } else { format!("{times:.0}") }
}

/// The machine of the measurements.
pub fn machine() -> String {
    format!("Measured on: {}.\n", REPORT["machine"].as_str().unwrap())
}

/// The table of an operation. The copy is of vectors as they lie in memory: meshopt's have four components.
pub fn table(operation: &str) -> String {
    let titles =
        format!("{operation} | 1k, ns | 64k, ns | 16M, ns | speed / meshopt16, 64k | speed / memcpy, 16M");
    let rows = rows(operation).map(|(name, own)| {
        let four_components = operation == "decode" && ["meshopt16", "oct32-i16x4"].contains(&name);
        let copy = ns(operation, if four_components { "memcpy8" } else { "memcpy12" });
        let [few, some, many] = own[..] else { panic!("{name} was measured with {} counts", own.len()) };
        let [faster, of_copy] = [ns(operation, "meshopt16")[1] / some, copy[2] / many];
        format!("`{name}` | {few:.2} | {some:.2} | {many:.2} | {faster:.2} | {of_copy:.2}")
    });
    markdown_table(&titles, rows)
}
