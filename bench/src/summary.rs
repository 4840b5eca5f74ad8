//! `cargo run -p unitvec-bench --bin summary [FOLDER]`, which `cargo xtask renew slices` runs: the last
//! `cargo bench -p unitvec-bench`, from criterion's folder (`target/criterion`, or below CARGO_TARGET_DIR).

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};
use unitvec_bench::{COUNTS, group};

/// Nanoseconds a vector: the median over the samples, by the name of the benchmark.
fn medians(folder: &Path, count: usize) -> Result<BTreeMap<String, f64>, Box<dyn Error>> {
    let mut medians = BTreeMap::new();
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in entries {
        let entry = entry?;
        let Ok(text) = fs::read_to_string(entry.path().join("new/estimates.json")) else { continue };
        let estimates: Value = serde_json::from_str(&text)?;
        let median = estimates["median"]["point_estimate"].as_f64().ok_or("estimates without a median")?;
        medians.insert(entry.file_name().to_string_lossy().into_owned(), median / count as f64);
    }
    Ok(medians)
}

/// The rows of an operation: the benchmarks that were measured with all of these counts.
fn rows(root: &Path, operation: &str, counts: &[usize]) -> Result<Vec<Value>, Box<dyn Error>> {
    let mut columns = Vec::new();
    for &count in counts {
        columns.push(medians(&root.join(group(operation, count)), count)?);
    }
    let hundredths = |ns: &f64| (ns * 100.0).round() / 100.0;
    let ns = |name: &String| -> Option<Vec<f64>> {
        columns.iter().map(|column| column.get(name).map(hundredths)).collect()
    };
    let row = |name| Some(json!({ "operation": operation, "name": name, "ns": ns(name)? }));
    Ok(columns[0].keys().filter_map(row).collect())
}

/// The processor's name, where the system tells it.
fn machine() -> String {
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    format!(
        "{}, {} {}",
        name.map_or("unknown processor", |(_, name)| name),
        env::consts::ARCH,
        env::consts::OS
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from);
    let root = env::args_os().nth(1).map_or_else(|| target.join("criterion"), PathBuf::from);
    let rows = [
        rows(&root, "encode", &COUNTS)?,
        rows(&root, "decode", &COUNTS)?,
        rows(&root, "formats", &COUNTS[..1])?,
    ]
    .concat();
    println!("{:#}", json!({ "machine": machine(), "counts": COUNTS, "rows": rows }));
    Ok(())
}
