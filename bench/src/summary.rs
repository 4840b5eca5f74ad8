//! `cargo run -p unitvec-bench --bin summary [FOLDER]`: the last `cargo bench -p unitvec-bench` as a table in Markdown,
//! from criterion's folder (`target/criterion`, or as CARGO_TARGET_DIR has it).

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};
use unitvec_bench::{COUNTS, group};

/// Nanoseconds a vector: the median over the samples, by the name of what was measured.
fn medians(folder: &Path, count: usize) -> Result<BTreeMap<String, f64>, Box<dyn Error>> {
    let mut medians = BTreeMap::new();
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in entries {
        let entry = entry?;
        let Ok(text) = fs::read_to_string(entry.path().join("new/estimates.json")) else { continue };
        let estimates: serde_json::Value = serde_json::from_str(&text)?;
        let median = estimates["median"]["point_estimate"].as_f64().ok_or("estimates without a median")?;
        medians.insert(entry.file_name().to_string_lossy().into_owned(), median / count as f64);
    }
    Ok(medians)
}

/// What memcpy takes for the vectors as floats, or as meshopt's four components.
fn copy_of(name: &str) -> &str {
    match name {
        "meshopt16" | "oct32-i16x4" => "memcpy8",
        _ => "memcpy12",
    }
}

fn print_direction(root: &Path, direction: &str) -> Result<(), Box<dyn Error>> {
    let mut columns = Vec::new();
    for count in COUNTS {
        columns.push(medians(&root.join(group(direction, count)), count)?);
    }
    println!(
        "\n| {direction} | 1k | 64k | 16M | meshopt16 / it: 1k | 64k | 16M | memcpy / it: 1k | 64k | 16M |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for name in columns[0].keys() {
        let of = |reference: &str, decimals: usize| -> String {
            columns
                .iter()
                .map(|column| match (column.get(name), column.get(reference)) {
                    (Some(own), Some(other)) => format!(" {:.decimals$} |", other / own),
                    _ => " |".into(),
                })
                .collect()
        };
        let own: String = columns
            .iter()
            .map(|column| column.get(name).map_or(" |".into(), |own| format!(" {own:.2} |")))
            .collect();
        let copy = if columns[0].contains_key(copy_of(name)) { copy_of(name) } else { "memcpy12" };
        println!("| `{name}` |{own}{}{}", of("meshopt16", 2), of(copy, 2));
    }
    Ok(())
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
    println!("{}. Nanoseconds a vector, one core; then ratios of speed, more is better:", machine());
    println!("to meshopt's 16-bit filter in vectors, and to memcpy of the vectors as they lie in memory.");
    print_direction(&root, "encode")?;
    print_direction(&root, "decode")
}
