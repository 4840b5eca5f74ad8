//! The compilers of shading languages that `cargo xtask renew languages` ran, as `docs/data/languages.csv` has them,
//! and the costs of barriers, as `docs/data/barriers.csv` has them.

use serde::Deserialize;
use std::collections::BTreeSet;
use unitvec_catalogue::CODECS;
use unitvec_tests::repository;

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

/// Instructions of the kernels of a codec.
#[derive(Deserialize)]
struct Barriers {
    codec: String,
    operation: String,
    hlsl: u64,
    wgsl_plain: u64,
    wgsl_exact: u64,
    slang_plain: u64,
    slang_exact: u64,
}

fn rows<T: for<'a> Deserialize<'a>>(file: &str) -> Vec<T> {
    let mut reader = csv::Reader::from_path(repository().join("docs/data").join(file)).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn recorded() -> Vec<Row> {
    rows("languages.csv")
}

pub fn table() -> String {
    let mut text = String::from(
        "| language | edition | compiler | driver | codes that differ | of special input | error / bound | vectors that differ \
         | components, 2^-24 | angle / bound |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in recorded() {
        let compiler = [row.compiler.as_str(), &row.options].map(str::to_owned);
        let compiler =
            compiler.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(", ");
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
        text += &format!(
            "| {} | {} | {compiler} | {driver} | {} |\n",
            row.language,
            row.edition,
            cells.join(" | ")
        );
    }
    text
}

/// The instructions that barriers add to a kernel.
pub fn barriers() -> String {
    let mut text = String::from(
        "| codec | operation | HLSL | WGSL, plain | WGSL, exact | Slang, plain | Slang, exact |\n|---|---|---|---|---|---|---|\n",
    );
    for row in rows::<Barriers>("barriers.csv") {
        let Barriers { codec, operation, hlsl, wgsl_plain, wgsl_exact, slang_plain, slang_exact } = row;
        text += &format!(
            "| `{codec}` | {operation} | {hlsl} | {wgsl_plain} | {wgsl_exact} | {slang_plain} | {slang_exact} |\n"
        );
    }
    text
}

/// The claims of docs/agreement.md on the table: every compiler took both kernels of every codec, and kept promises.
#[test]
fn all_compilers_keep_their_promises() {
    for row in recorded() {
        let name =
            format!("{} {}, {} {}, {}", row.language, row.edition, row.compiler, row.options, row.driver);
        assert_eq!(row.kernels, 2 * CODECS.len(), "{name}: cargo xtask renew languages");
        let inputs = if row.promise == "compiled" { (0, 0) } else { (65_536, 4_096) };
        assert_eq!((row.random, row.special), inputs, "{name}");
        let differ = row.codes_differ + row.special_differ + row.elements_differ;
        match row.promise.as_str() {
            "equal" => assert_eq!(differ, 0, "{name}"),
            "compiled" => assert_eq!((differ, row.driver.as_str()), (0, ""), "{name}"),
            "bounded" => assert!(row.error <= 2.0 && row.angle <= 1.0, "{name}"),
            _ => assert!(row.options == "fast math" && differ > 0, "{name}"),
        }
    }
}

/// Every language runs somewhere, those with an exact edition in both; WGSL by two compilers and on three drivers.
#[test]
fn the_record_is_of_all_languages() {
    let rows = recorded();
    let of = |language: &str| rows.iter().filter(|row| row.language == language).collect::<Vec<_>>();
    for (language, editions) in [
        ("HLSL", &["plain"][..]),
        ("WGSL", &["exact", "plain"]),
        ("Slang", &["exact", "plain"]),
        ("MSL", &["exact", "plain"]),
        ("GLSL ES", &["exact", "plain"]),
        ("Godot's shading language", &["exact", "plain"]),
    ] {
        let found: BTreeSet<&str> = of(language).iter().map(|row| row.edition.as_str()).collect();
        assert_eq!(found, editions.iter().copied().collect(), "{language}");
    }
    let wgsl = of("WGSL");
    for compiler in ["wgpu", "Dawn", "Chromium"] {
        assert!(wgsl.iter().any(|row| row.compiler.starts_with(compiler)), "{compiler}");
    }
    assert!(wgsl.iter().map(|row| &row.driver).collect::<BTreeSet<_>>().len() >= 3);
}
