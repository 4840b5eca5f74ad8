//! What codecs cost on lavapipe, as `unitvec bench --json` wrote it to `host/data/costs_lavapipe.json`.

use serde_json::Value;
use std::sync::OnceLock;
use unitvec_host::catalogue::formats;
use unitvec_tests::repository;

fn report() -> &'static Value {
    static REPORT: OnceLock<Value> = OnceLock::new();
    REPORT.get_or_init(|| {
        let text = std::fs::read(repository().join("host/data/costs_lavapipe.json")).unwrap();
        serde_json::from_slice(&text).unwrap()
    })
}

/// A figure of a codec's row, of SPIR-V from Rust: `operation` is `encode` or `decode`.
fn figure(id: &str, operation: &str, by_table: bool, key: &str) -> Option<f64> {
    let is_it = |row: &&Value| {
        (&row["id"], &row["operation"], &row["backend"]) == (&id.into(), &operation.into(), &"rust".into())
            && row["by_table"] == by_table
    };
    report()["rows"].as_array().unwrap().iter().find(is_it)?[key].as_f64()
}

/// The arithmetic of encoding or decoding as a multiple of `oct32`'s, where it was measured.
pub fn cost(id: &str, operation: &str) -> Option<f64> {
    figure(id, operation, false, "alu_ratio_to_oct32")
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
}

/// The costs of both operations.
pub fn both(id: &str) -> String {
    ["encode", "decode"].map(|operation| number(cost(id, operation), 1)).join(" / ")
}

/// The device, and how much it did.
pub fn device() -> String {
    let (report, device) = (report(), &report()["device"]);
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    format!(
        "Measured on {}, Vulkan {}: {} vectors, {} times each.\n",
        text(&device["driver"]),
        text(&device["api_version"]),
        report["count"],
        report["repetitions"]
    )
}

/// The shipped kernel's speed in per cent of that of a copy.
fn of_copy(id: &str, operation: &str) -> Option<f64> {
    let figure = |key| figure(id, operation, false, key);
    Some(100.0 * figure("bytes_per_s")? / figure("copy_bytes_per_s")?)
}

/// The table of all codecs.
pub fn table() -> String {
    let mut text = String::from(
        "| codec | encode / oct32 | decode / oct32 | encode: rust / glsl | decode: rust / glsl | encode, % of copy \
         | decode, % of copy |\n|---|---|---|---|---|---|---|\n",
    );
    for format in formats() {
        let cells = [("alu_ratio_to_oct32", 1), ("alu_ratio_to_glsl", 2)].map(|(key, digits)| {
            ["encode", "decode"].map(|operation| number(figure(format.id, operation, false, key), digits))
        });
        let copy = ["encode", "decode"].map(|operation| number(of_copy(format.id, operation), 0));
        text += &format!("| `{}` | {} |\n", format.id, [cells.as_flattened(), &copy].concat().join(" | "));
    }
    text
}

/// The speed of decoding by table as a multiple of that of the codec's own kernel, where a table is made for it.
pub fn by_table(id: &str) -> Option<f64> {
    let speed = |by_table| figure(id, "decode", by_table, "vectors_per_s");
    Some(speed(true)? / speed(false)?)
}
