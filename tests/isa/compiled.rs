//! The kernels compiled again, by the driver that is installed here.

use super::{RENEW, committed, rdna2};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use unitvec_catalogue::{AnyCodec, CODECS, Operation};
use unitvec_choose::costs::{GENERATIONS, Generation, KernelKind, Report, Row, Source};
use unitvec_lab::isa::glsl_file;
use unitvec_run::conform::widest_of_each_series;
use unitvec_tests::program::{command, refusal, run, stderr, stdout};
use unitvec_tests::repository;

/// Names the file of a newer RADV than the system's: `cargo xtask renew costs` fetches one and sets it.
pub const NEWER_DRIVER: &str = "UNITVEC_NEWER_RADV_ICD";

/// The file of the newer RADV, for a generation that the oldest one does not know.
pub fn newer_driver(generation: &Generation) -> Option<PathBuf> {
    std::env::var_os(NEWER_DRIVER).map(PathBuf::from).filter(|_| generation.mesa != GENERATIONS[0].mesa)
}

/// The report of the driver, the system's or the one in this file, on kernels of these codecs for a GPU.
pub fn compiled(
    (gpu, kernel): (&str, KernelKind),
    driver: Option<&Path>,
    codecs: impl IntoIterator<Item = &'static AnyCodec>,
) -> Result<Report, String> {
    let ids: Vec<&str> = codecs.into_iter().map(|codec| codec.id).collect();
    let mut bench = command(["bench", "compiler", "--json", "-", "--gpu", gpu]);
    bench.args(["--kernel", if kernel == KernelKind::One { "one" } else { "four" }]);
    bench.args(["--codec", &ids.join(",")]);
    if std::env::var_os("UNITVEC_COMPILERS").is_none() {
        bench.env("UNITVEC_COMPILERS", repository().join("target/compilers"));
    }
    match driver {
        Some(driver) => bench.arg("--driver").arg(driver),
        None => bench.env_remove("UNITVEC_RADV_ICD"),
    };
    let output = bench.output().unwrap();
    if !output.status.success() {
        return Err(stderr(&output).lines().last().unwrap_or_default().to_owned());
    }
    Ok(Report::parse(Path::new("-"), &output.stdout).unwrap())
}

type Key = (String, Operation, Source, Option<String>);

fn key(row: &Row) -> Key {
    (row.id.clone(), row.operation, row.source, row.textbook.clone())
}

/// A line for each kernel that takes over 2 % more than before, or that had no figures.
pub fn dearer(before: &Report, after: &Report) -> Vec<String> {
    let known: BTreeMap<Key, &Row> = before.rows.iter().map(|row| (key(row), row)).collect();
    let mut found = Vec::new();
    for row in &after.rows {
        let name = format!("{} {} from {}", row.id, row.operation, row.source);
        let Some(old) = known.get(&key(row)) else {
            found.push(format!("{name}: no figures before"));
            continue;
        };
        let figures = [
            ("inverse throughput", old.inverse_throughput, row.inverse_throughput),
            ("instructions", old.instructions, row.instructions),
        ];
        for (figure, old, new) in figures {
            // Not every driver tells both.
            let Some(old) = old else { continue };
            let new = new.unwrap_or(u64::MAX);
            if new.saturating_mul(100) > old.saturating_mul(102) {
                found.push(format!("{name}: {figure} {old} before, {new} after"));
            }
        }
    }
    found
}

/// True if the file of a codec's GLSL is the same in both.
fn is_unchanged(id: &str, before: &Report, after: &Report) -> bool {
    let file = format!("glsl/{}", glsl_file(id));
    before.sources.get(&file) == after.sources.get(&file)
}

/// Prints, even where tests pass, that figures could not be compared.
fn cannot_compare(reason: &str) {
    let said = format!("the costs on {} are not compared: {reason}", rdna2().gpu);
    assert!(std::env::var_os("UNITVEC_REQUIRE_ISA").is_none(), "UNITVEC_REQUIRE_ISA is set, but {said}");
    let _ = writeln!(std::io::stderr(), "warning: {said}");
}

/// The report of the driver here, if it is of the device of the committed one.
pub fn comparable(before: &Report, after: Result<Report, String>) -> Option<Report> {
    let reason = match after {
        Ok(after) if before.device == after.device => return Some(after),
        Ok(after) => {
            format!("the figures are of {}, and the driver here is {}", before.subject(), after.subject())
        }
        Err(reason) => reason,
    };
    cannot_compare(&reason);
    None
}

/// No kernel has become dearer on RDNA 2: those of the widest codec of each series are compiled again, and `cargo xtask renew
/// costs` lists the others.
#[test]
fn no_kernel_is_dearer_than_committed() {
    let before = committed(rdna2());
    let Some(after) =
        comparable(&before, compiled((rdna2().gpu, KernelKind::Four), None, widest_of_each_series()))
    else {
        return;
    };
    let found = dearer(&before, &after);
    let of_same_file: Vec<&str> = CODECS
        .iter()
        .map(|format| format.id)
        .filter(|id| is_unchanged(id, &before, &after))
        .filter(|id| found.iter().any(|line| line.starts_with(&format!("{id} "))))
        .collect();
    assert!(
        found.is_empty(),
        "dearer than committed:\n{}\nof these the codec's GLSL has not changed: {of_same_file:?}\nif it has to be: {RENEW}",
        found.join("\n")
    );
}

/// A row is found to be dearer beyond 2 %, by either figure, and a new one named.
#[test]
fn two_per_cent_are_noticed() {
    let report = |throughput: u64, instructions: u64| {
        let mut report = committed(rdna2());
        report.rows.truncate(1);
        report.rows[0].inverse_throughput = Some(throughput);
        report.rows[0].instructions = Some(instructions);
        report
    };
    assert!(dearer(&report(100, 200), &report(102, 204)).is_empty());
    assert_eq!(dearer(&report(100, 200), &report(103, 200)).len(), 1);
    assert_eq!(dearer(&report(100, 200), &report(100, 205)).len(), 1);
    assert!(dearer(&report(100, 200), &report(50, 100)).is_empty());
    let empty = Report { rows: Vec::new(), ..report(1, 1) };
    assert!(dearer(&empty, &report(1, 1))[0].contains("no figures before"));
}

/// Faults end in one line, with the remedy.
#[test]
fn failures_name_the_remedy() {
    let failed = |arguments: &[&str], status: i32| {
        refusal(&run([&["bench", "compiler", "--codec", "oct32"], arguments].concat()), status)
    };
    let lacks = failed(&["--device", "lavapipe"], 1);
    assert!(
        lacks.contains("VK_KHR_pipeline_executable_properties") && lacks.contains("--gpu navi21"),
        "{lacks}"
    );
    let unknown = failed(&["--gpu", "voodoo2"], 1);
    assert!(unknown.contains("does not know the GPU `voodoo2`") && unknown.contains("--driver"), "{unknown}");
    let missing = failed(&["--gpu", "rdna2", "--driver", "/no/such.json"], 1);
    assert!(missing.contains("/no/such.json") && missing.contains("radeon_icd"), "{missing}");
    let both = failed(&["--gpu", "rdna2", "--device", "1"], 2);
    assert!(both.contains("--gpu and --device"), "{both}");
}

/// A driver's file that is not RADV's is refused.
#[test]
fn other_drivers_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("radeon_icd.json");
    std::fs::write(
        &file,
        r#"{"file_format_version": "1.0.0", "ICD": {"library_path": "none.so", "api_version": "1.3.0"}}"#,
    )
    .unwrap();
    let output = run(["bench", "compiler", "--gpu", "navi21", "--driver", file.to_str().unwrap()]);
    let said = refusal(&output, 1);
    assert!(said.contains("cannot be used"), "{said}");
}

/// A row for each kernel, in JSON, CSV, Markdown and the table, and a chart. The JSON is what `choose` takes.
#[test]
fn reports_agree() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [json, csv, markdown, chart] = ["json", "csv", "md", "svg"].map(file);
    let codecs = ["--codec", "oct32", "--codec", "frame32", "--codec", "snorm8x3p"];
    let outputs = ["--json", &json, "--csv", &csv, "--markdown", &markdown, "--chart", &chart];
    let output =
        run([&["bench", "compiler", "--gpu", "rdna2", "--kernel", "four"], &codecs[..], &outputs[..]]
            .concat());
    if !output.status.success() && stderr(&output).contains("is not installed") {
        return cannot_compare(&stderr(&output));
    }
    assert!(output.status.success(), "{}", stderr(&output));
    let read = |path: &str| std::fs::read_to_string(path).unwrap();
    let report: Value = serde_json::from_str(&read(&json)).unwrap();
    let rows = report["rows"].as_array().unwrap();
    assert!(report["device"]["driver"].as_str().unwrap().contains("Mesa"));
    assert!(report["sources"]["glsl/unitvec/oct.glsl"].is_string());
    let table = stdout(&output);
    for row in rows {
        let text = |key: &str| row[key].as_str().unwrap();
        let name = row["textbook"].as_str().unwrap_or_else(|| text("id"));
        let figure = |key: &str| row[key].as_u64().unwrap().to_string();
        let words = [name, text("operation"), text("source"), &figure("inverse_throughput")];
        let is_row = |line: &&str| line.split_whitespace().take(4).eq(words);
        let line = table.lines().find(is_row).unwrap_or_else(|| panic!("{words:?} is not in {table}"));
        assert!(line.ends_with(&figure("code_bytes")), "{line}");
    }
    for source in ["rust", "glsl", "textbook"] {
        assert!(rows.iter().any(|row| row["id"] == "oct32" && row["source"] == source), "{source}");
    }
    assert_eq!(read(&csv).lines().count(), 1 + rows.len());
    assert_eq!(read(&markdown).lines().filter(|line| line.starts_with("| ")).count(), 1 + rows.len());
    assert!(read(&chart).contains("RDNA 2"));
    let chosen = stdout(&run(["choose", "--max-error", "0.01", "--bits", "32", "--costs", &json]));
    assert!(chosen.contains("RDNA 2") && chosen.contains("\noct32 "), "{chosen}");
}

/// Compiles all kernels again, for all generations, and lists those that have become dearer.
#[test]
#[ignore = "`cargo xtask renew costs` runs it: a minute or two"]
fn renew() {
    let mut left = Vec::new();
    for generation in &GENERATIONS {
        let path = repository().join(generation.path());
        match compiled((generation.gpu, KernelKind::Four), newer_driver(generation).as_deref(), &CODECS) {
            Ok(report) => {
                let before = Report::parse(&path, &std::fs::read(&path).unwrap_or_default());
                let notes =
                    before.map_or_else(|error| vec![error.to_string()], |before| dearer(&before, &report));
                notes.iter().for_each(|note| println!("{}: {note}", generation.gpu));
                unitvec_files::write_file(&path, report.to_json().as_bytes()).unwrap();
                println!("{}: written, of {}", path.display(), report.subject());
            }
            Err(reason) => left.push(format!("{}: {reason}", generation.path().display())),
        }
    }
    assert!(left.is_empty(), "not renewed:\n{}", left.join("\n"));
}
