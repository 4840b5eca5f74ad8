//! The drivers that `cargo xtask renew drivers` ran, as `docs/data/drivers.tsv` has them.

use std::collections::BTreeSet;
use unitvec_tests::repository;

/// The committed rows: cells by the names of their columns.
struct Recorded(Vec<Vec<(String, String)>>);

impl Recorded {
    fn new() -> Self {
        let text = std::fs::read_to_string(repository().join("docs/data/drivers.tsv")).unwrap_or_default();
        let cells = |line: &str| line.split('\t').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines().map(cells);
        let names = lines.next().unwrap_or_default();
        Self(lines.map(|cells| names.iter().cloned().zip(cells).collect()).collect())
    }

    /// The cells of a column, in the rows' order.
    fn column(&self, name: &str) -> Vec<&str> {
        let cell = |row: &[(String, String)]| row.iter().position(|(other, _)| other == name);
        self.0.iter().map(|row| cell(row).map_or("", |at| row[at].1.as_str())).collect()
    }
}

/// The columns of the docs, and their headings.
const COLUMNS: [(&str, &str); 8] = [
    ("driver", "driver"),
    ("device", "device"),
    ("vulkan", "Vulkan"),
    ("origin", "file or package"),
    ("codecs", "codecs"),
    ("vectors", "vectors encoded"),
    ("codes", "codes decoded"),
    ("mismatches", "mismatches"),
];

pub fn table() -> String {
    let recorded = Recorded::new();
    let columns = COLUMNS.map(|(name, _)| recorded.column(name));
    let headings = COLUMNS.map(|(_, heading)| heading).join(" | ");
    let mut text = format!("| {headings} |\n|{}\n", "---|".repeat(COLUMNS.len()));
    for row in 0..recorded.0.len() {
        let cells: Vec<&str> = columns.iter().map(|column| column[row]).collect();
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

/// The claims of docs/agreement.md about the table: lavapipe of three releases of Mesa and SwiftShader, all codecs and
/// the same inputs on each, no mismatch.
#[test]
fn drivers_of_two_makers_agree() {
    let recorded = Recorded::new();
    let drivers = recorded.column("driver");
    let of_mesa: BTreeSet<&str> =
        drivers.iter().filter_map(|driver| driver.split_once("Mesa ")?.1.get(..2)).collect();
    assert!(of_mesa.len() >= 3 && drivers.iter().any(|driver| driver.contains("SwiftShader")), "{drivers:?}");
    for same in ["codecs", "vectors", "codes", "mismatches"] {
        assert_eq!(recorded.column(same).into_iter().collect::<BTreeSet<_>>().len(), 1, "{same}");
    }
    assert_eq!(recorded.column("mismatches")[0], "0");
}
