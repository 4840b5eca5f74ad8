//! The compilers of shading languages that `cargo xtask renew languages` ran, as `docs/data/languages.csv` has them,
//! and the costs of barriers, as `docs/data/barriers.csv` has them.

use super::{markdown_table, recorded};
use serde::Deserialize;
use std::collections::BTreeSet;
use unitvec_catalogue::CODECS;

/// A compiler and a driver.
#[derive(Deserialize)]
struct Row {
    language: String,
    edition: String,
    compiler: String,
    options: String,
    driver: String,
    kernels: usize,
    random: u64,
    special: u64,
    codes_differ: u64,
    special_differ: u64,
    error: f64,
    elements_differ: u64,
    component: f64,
    angle: f64,
    promise: String,
}

fn rows() -> Vec<Row> {
    recorded("languages.csv")
}

pub fn table() -> String {
    let titles = "language | edition | compiler | driver | codes that differ | of special input | error / bound | vectors that differ \
                  | components, 2^-24 | angle / bound";
    let rows = rows().into_iter().map(|row| {
        let compiler = [row.compiler.as_str(), &row.options].join(", ");
        let compiler = compiler.trim_end_matches(", ");
        let cells = if row.promise == "compiled" {
            ["compiled", "", "", "", "", ""].map(str::to_owned)
        } else {
            let number = |number: f64| if number == 0.0 { "0".to_owned() } else { number.to_string() };
            [
                row.codes_differ.to_string(),
                row.special_differ.to_string(),
                number(row.error),
                row.elements_differ.to_string(),
                number(row.component),
                number(row.angle),
            ]
        };
        let driver = if row.driver.is_empty() { "-" } else { &row.driver };
        format!("{} | {} | {compiler} | {driver} | {}", row.language, row.edition, cells.join(" | "))
    });
    markdown_table(titles, rows)
}

/// Instructions of kernels, with those that barriers and exact division add.
pub fn barriers() -> String {
    let titles = "codec | operation | HLSL | WGSL, plain | WGSL, exact | Slang, plain | Slang, exact";
    let rows = recorded::<(String, Vec<String>)>("barriers.csv").into_iter();
    markdown_table(titles, rows.map(|(codec, cells)| format!("`{codec}` | {}", cells.join(" | "))))
}

/// The claims of docs/agreement.md on the table: every compiler took both kernels of every codec, but for codecs that are newer
/// than the record, and kept promises.
#[test]
fn all_compilers_keep_their_promises() {
    let rows = rows();
    for row in &rows {
        let name =
            format!("{} {}, {} {}, {}", row.language, row.edition, row.compiler, row.options, row.driver);
        assert!(row.kernels == rows[0].kernels && row.kernels <= 2 * CODECS.len(), "{name}");
        let inputs = if row.promise == "compiled" { (0, 0) } else { (65_536, 4_096) };
        assert!(row.random >= inputs.0 && row.special == inputs.1, "{name}");
        let differ = row.codes_differ + row.special_differ + row.elements_differ;
        match row.promise.as_str() {
            "equal" => assert_eq!(differ, 0, "{name}"),
            "compiled" => assert_eq!((differ, row.driver.as_str()), (0, ""), "{name}"),
            "bounded" => assert!(row.error <= 2.0 && row.angle <= 1.0, "{name}"),
            _ => assert!(row.options == "fast math" && differ > 0, "{name}"),
        }
    }
}

/// Every language runs somewhere in both editions; WGSL by several compilers and on three drivers.
#[test]
fn the_record_is_of_all_languages() {
    let rows = rows();
    let of = |language: &str| rows.iter().filter(|row| row.language == language).collect::<Vec<_>>();
    for language in ["HLSL", "WGSL", "Slang", "MSL", "C++", "GLSL ES", "Godot's shading language"] {
        let found: BTreeSet<&str> = of(language).iter().map(|row| row.edition.as_str()).collect();
        assert_eq!(found, BTreeSet::from(["exact", "plain"]), "{language}");
    }
    // The compiler that users of Direct3D 12 have.
    let by_dxc = |row: &&&Row| row.compiler.starts_with("DXC") && row.promise == "equal";
    assert!(of("HLSL").iter().filter(by_dxc).any(|row| row.edition == "exact"));
    let wgsl = of("WGSL");
    for compiler in ["wgpu", "Dawn", "Chromium"] {
        assert!(wgsl.iter().any(|row| row.compiler.starts_with(compiler)), "{compiler}");
    }
    assert!(wgsl.iter().map(|row| &row.driver).collect::<BTreeSet<_>>().len() >= 3);
}
