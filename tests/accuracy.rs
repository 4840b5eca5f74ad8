//! `unitvec accuracy` reproduces the survey's tables.

use serde_json::Value;
use unitvec_host::accuracy::Table;
use unitvec_tests::program::{run, stderr, stdout};

/// The survey prints five decimals: its figures may be off by half a unit of the last.
const PRINTED: f64 = 0.5e-5;

fn rows(arguments: &[&str]) -> Vec<Value> {
    let output = run([&["accuracy", "--json", "-"], arguments].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    report["rows"].as_array().unwrap().clone()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"))
}

/// Every row over 10^6 directions: mean at most 1.01 times the survey's, maximum at most 1.04 times.
#[test]
fn every_row_meets_the_survey() {
    for row in ["1", "3"].iter().flat_map(|table| rows(&["--seed", "9", "--table", table])) {
        let mean_limit = 1.01 * (number(&row, "survey_mean_deg") + PRINTED);
        let max_limit = 1.04 * (number(&row, "survey_max_deg") + PRINTED);
        assert!(number(&row, "mean_deg") <= mean_limit, "{row}");
        assert!(number(&row, "max_deg") <= max_limit, "{row}");
        // Nothing beats the covering bound by more than the noise of 10^6 samples.
        assert!(number(&row, "mean_deg") >= 0.999 * number(&row, "bound_mean_deg"), "{row}");
    }
}

/// The largest errors found respect Meyer's bounds to first order, and reach them where they are tight.
#[test]
fn meyers_bounds_hold() {
    let rows = rows(&["--table", "meyer", "--count", "1000"]);
    assert!(rows.iter().any(|row| row["id"] == "oct16p"));
    for row in rows {
        // Meyer's cells are 2 2^(-b/2); an snorm of n bits has cells of 1 / (2^(n-1) - 1).
        let n = (number(&row, "bits") / 2.0 - 1.0).exp2();
        let ratio = number(&row, "max_deg") / number(&row, "survey_max_deg") * (n - 1.0) / n;
        assert!(ratio < 1.01, "{row}: {ratio}");
        if row["survey_name"].as_str().unwrap().starts_with("ONV") {
            assert!(ratio > 0.95, "{row}: {ratio}");
        }
    }
}

/// Rows come in the survey's order, and each carries its table, codec and bits.
#[test]
fn rows_are_those_of_the_survey() {
    for (name, table) in [("1", Table::One), ("3", Table::Three)] {
        let rows = rows(&["--table", name, "--count", "100"]);
        let published = table.published();
        let expected: Vec<(&str, &str)> =
            published.iter().filter_map(|row| Some((row.codec()?.id, row.name.as_str()))).collect();
        let actual: Vec<(&str, &str)> = rows
            .iter()
            .map(|row| (row["id"].as_str().unwrap(), row["survey_name"].as_str().unwrap()))
            .collect();
        assert_eq!(actual, expected);
        assert!(rows.iter().all(|row| row["table"] == name));
    }
}

/// The same seed gives the same figures on every backend, since codes and vectors are the same to the bit.
#[test]
fn backends_measure_the_same() {
    let arguments = |backend| ["--table", "3", "--count", "20000", "--backend", backend];
    let cpu = rows(&arguments("cpu"));
    assert!(!cpu.is_empty());
    assert_eq!(cpu, rows(&arguments("spirv")));
    assert_eq!(cpu, rows(&arguments("glsl")));
}

#[test]
fn rows_are_written_as_csv() {
    let output = run(["accuracy", "--table", "3", "--count", "100", "--csv", "-"]);
    let text = stdout(&output);
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("table,id,survey_name,bits,mean_deg,max_deg,survey_mean_deg"));
    assert!(lines.next().unwrap().starts_with("3,"));
}
