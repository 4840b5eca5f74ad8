//! docs/web-engines.md: codes as vertex attributes in engines for browsers, and what normals cost in GLB files.

use super::tables::degrees;
use super::{markdown_table, recorded};
use serde::Deserialize;

#[derive(Deserialize)]
struct Drawn {
    engine: String,
    version: String,
    api: String,
    material: String,
    codec: String,
    largest: u32,
    limit: u32,
}

const CODECS: [&str; 4] = ["oct16p", "oct24p", "oct32p", "frame32"];

/// A row for each engine and material: the largest difference by codec, and its limit.
pub fn engines() -> String {
    let drawn: Vec<Drawn> = recorded("web_engines.csv");
    let rows = drawn.chunks(CODECS.len()).map(|codecs| {
        assert!(codecs.iter().map(|row| row.codec.as_str()).eq(CODECS));
        let Drawn { engine, version, api, material, .. } = &codecs[0];
        let cells: Vec<_> = codecs.iter().map(|row| format!("{} ({})", row.largest, row.limit)).collect();
        format!("{engine} {version} | {api} | {material} | {}", cells.join(" | "))
    });
    let codecs = CODECS.map(|id| format!("`{id}`")).join(" | ");
    markdown_table(&format!("engine | API | material | {codecs}"), rows)
}

#[derive(Deserialize)]
struct File {
    mesh: String,
    file: String,
    positions: String,
    bytes: u64,
    gzip: u64,
    gpu_bytes: u32,
    three_ms: f64,
    babylon_ms: f64,
    mean_deg: f64,
    max_deg: f64,
}

/// A row for each file of a mesh.
pub fn sizes(mesh: &str) -> String {
    let files: Vec<File> = recorded("web_sizes.csv");
    let rows = files.iter().filter(|file| file.mesh == mesh).map(|file| {
        let File { file: name, positions, gpu_bytes, .. } = file;
        let [bytes, gzip] = [file.bytes, file.gzip].map(|bytes| format!("{:.0}", bytes as f64 / 1e3));
        let times = format!("{:.0} | {:.0}", file.three_ms, file.babylon_ms);
        let errors = format!("{} / {}", degrees(file.mean_deg), degrees(file.max_deg));
        format!("{name} | {positions} | {bytes} | {gzip} | {gpu_bytes} | {times} | {errors}")
    });
    let times = "three.js, ms | Babylon.js, ms";
    let titles =
        format!("normals | positions | kB | kB, gzip | GPU bytes a vertex | {times} | mean / max, degrees");
    markdown_table(&titles, rows)
}
