//! The program's commands, run as a user runs them.

use serde_json::Value;
use std::path::Path;
use unitvec_host::catalogue::{CATALOGUE, Domain};
use unitvec_host::measure::angle_deg;
use unitvec_host::{mesh, sampling};
use unitvec_tests::program::{run, run_with_input, stderr, stdout};
use unitvec_tests::{BACKENDS, repository};

fn raw(vectors: &[[f32; 3]]) -> Vec<u8> {
    vectors.iter().flatten().flat_map(|component| component.to_le_bytes()).collect()
}

fn vectors(raw: &[u8]) -> Vec<[f32; 3]> {
    let components: Vec<f32> =
        raw.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect();
    components.chunks_exact(3).map(|vector| vector.try_into().unwrap()).collect()
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn codecs_lists_the_catalogue() {
    let table = stdout(&run(["codecs"]));
    let json: Value = serde_json::from_slice(&run(["codecs", "--json"]).stdout).unwrap();
    assert_eq!(json.as_array().unwrap().len(), CATALOGUE.len());
    for (codec, entry) in CATALOGUE.iter().zip(json.as_array().unwrap()) {
        assert!(table.lines().any(|line| line.starts_with(codec.id)), "{}", codec.id);
        assert_eq!(entry["id"], codec.id);
        assert_eq!(entry["bits"], codec.bits);
        assert_eq!(entry["bytes"], codec.bytes);
    }
}

#[test]
fn devices_marks_the_one_that_would_be_used() {
    let output = run(["devices"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.lines().any(|line| line.starts_with('*') && line.contains("llvmpipe")), "{text}");
}

/// All backends write the same files, and decoding gives the directions back within the codec's error.
#[test]
fn files_round_trip_on_every_backend() {
    let folder = tempfile::tempdir().unwrap();
    // More than one chunk, and not a multiple of four.
    let directions = sampling::random_directions(Domain::Hemisphere, 11);
    let original: Vec<[f32; 3]> = directions.take((1 << 20) + 5).collect();
    let input = folder.path().join("normals.bin");
    std::fs::write(&input, raw(&original)).unwrap();
    for codec in CATALOGUE.iter().filter(|codec| ["oct16", "oct24p", "hemioct32"].contains(&codec.id)) {
        let mut results = Vec::new();
        for &backend in BACKENDS {
            let (codes, back) = (folder.path().join("codes"), folder.path().join("back"));
            let validate: &[&str] = if backend == "cpu" { &[] } else { &["--validate"] };
            let arguments = [validate, &["--codec", codec.id, "--backend", backend]].concat();
            let encoded = run([&["encode"], &arguments[..], &[path(&input), path(&codes)]].concat());
            assert!(encoded.status.success(), "{}", stderr(&encoded));
            let decoded = run([&["decode"], &arguments[..], &[path(&codes), path(&back)]].concat());
            assert!(decoded.status.success(), "{}", stderr(&decoded));
            results.push((std::fs::read(&codes).unwrap(), std::fs::read(&back).unwrap()));
        }
        assert!(results.iter().all(|result| *result == results[0]), "{}", codec.id);
        let (codes, back) = &results[0];
        assert_eq!(codes.len(), original.len() * codec.bytes);
        let back = vectors(back);
        assert_eq!(back.len(), original.len());
        let worst = original.iter().zip(&back).map(|(a, b)| angle_deg(*a, *b)).fold(0.0, f64::max);
        assert!(worst <= f64::from(codec.max_error_deg), "{}: {worst}", codec.id);
    }
}

#[test]
fn standard_streams_are_a_pipe() {
    let original: Vec<[f32; 3]> = sampling::random_directions(Domain::Sphere, 5).take(1000).collect();
    let encoded = run_with_input(["encode", "--codec", "oct32p", "-", "-"], &raw(&original));
    assert!(encoded.status.success(), "{}", stderr(&encoded));
    assert_eq!(encoded.stdout.len(), 4000);
    let decoded = run_with_input(["decode", "--codec", "oct32", "-", "-"], &encoded.stdout);
    let back = vectors(&decoded.stdout);
    assert!(original.iter().zip(&back).all(|(a, b)| angle_deg(*a, *b) < 0.0026));
    let nothing = run_with_input(["encode", "--codec", "oct16", "-", "-"], &[]);
    assert!(nothing.status.success() && nothing.stdout.is_empty());
}

#[test]
fn a_mesh_is_encoded_as_its_normals() {
    let folder = tempfile::tempdir().unwrap();
    let bunny = repository().join("host/data/bunny.obj");
    let codes = folder.path().join("bunny.oct16p");
    let output = run(["encode", "--codec", "oct16p", path(&bunny), path(&codes)]);
    assert!(output.status.success(), "{}", stderr(&output));
    let normals = mesh::read(&bunny).unwrap().normals;
    assert_eq!(std::fs::read(&codes).unwrap().len(), 2 * normals.len());
}

#[test]
fn conform_reports_in_words_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("report.json");
    let bunny = repository().join("host/data/bunny.obj");
    let arguments = ["conform", "--validate", "--codec", "oct16", "--codec", "hemioct32", "--count", "1000"];
    let output = run([&arguments[..], &["--json", path(&json), path(&bunny)]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("conform: PASS"), "{text}");
    let covered = "(all codes of up to 16 bits, 1000 random codes of more)";
    assert!(text.trim_end().ends_with(covered), "{text}");
    let report: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    assert_eq!(report["agreed"], true);
    assert_eq!(report["all_codes_up_to"], 16);
    assert_eq!(report["random_directions"], 1000);
    assert_eq!(report["glsl_compared"], cfg!(feature = "glsl"));
    assert!(report["device"]["name"].as_str().unwrap().contains("llvmpipe"));
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(
        rows.iter().map(|row| row["id"].as_str().unwrap()).collect::<Vec<_>>(),
        ["oct16", "hemioct32"]
    );
    for row in rows {
        assert!(row["vectors"].as_u64().unwrap() > 1000);
        assert!(row["mean_deg"].as_f64().unwrap() > 0.0);
        assert!(row["max_deg"].as_f64().unwrap() > row["mean_deg"].as_f64().unwrap());
        for half in ["encode_mismatches", "decode_mismatches"] {
            let glsl = if cfg!(feature = "glsl") { Value::from(0) } else { Value::Null };
            assert_eq!((&row[half]["spirv"], &row[half]["glsl"]), (&Value::from(0), &glsl));
        }
    }
    assert_eq!(rows[0]["bits"], 16);
}

/// The report goes to a pipe whole: no table around it.
fn report(arguments: &[&str]) -> Value {
    let output = run([&["conform", "--json", "-"], arguments].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// All codes of 20 bits are decoded with `--exhaustive`, and as many as are asked for without.
#[test]
fn conform_decodes_all_codes_where_it_says_so() {
    let arguments = ["--codec", "oct20", "--count", "10"];
    let codes = |report: &Value| report["rows"][0]["codes"].as_u64().unwrap();
    let (short, whole) = (report(&arguments), report(&[&arguments[..], &["--exhaustive"]].concat()));
    assert_eq!(short["rows"][0]["id"], "oct20");
    assert_eq!((&short["all_codes_up_to"], &whole["all_codes_up_to"]), (&16.into(), &24.into()));
    assert_eq!(codes(&whole) - codes(&short), (1 << 20) - 10);
}

/// A replaced file keeps its permissions, and a link to it stays a link.
#[cfg(unix)]
#[test]
fn a_replaced_file_keeps_its_place_and_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("target"), folder.path().join("link"));
    std::fs::write(&target, b"old").unwrap();
    std::fs::set_permissions(&target, PermissionsExt::from_mode(0o600)).unwrap();
    symlink(&target, &link).unwrap();
    let output = run_with_input(["encode", "--codec", "oct16", "-", path(&link)], &raw(&[[0.0, 0.0, 1.0]]));
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(link.is_symlink());
    assert_eq!(std::fs::read(&target).unwrap(), [0, 0]);
    assert_eq!(target.metadata().unwrap().permissions().mode() & 0o777, 0o600);
}

/// The codecs chosen meet the demand, those of fewest bytes come first, and of those the cheapest.
#[test]
fn choose_gives_the_cheapest_that_meets_the_demand() {
    let demand = ["choose", "--max-error", "0.05", "--mean-error", "0.02", "--bits", "32", "--json"];
    let report: Value = serde_json::from_slice(&run(demand).stdout).unwrap();
    let candidates = report["candidates"].as_array().unwrap();
    assert!(candidates.len() > 5);
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap_or(f64::INFINITY);
    let order =
        |row: &Value| (row["bytes"].as_u64(), number(row, "encode_cost") + number(row, "decode_cost"));
    for row in candidates {
        assert!(number(row, "max_error_deg") <= 0.05 && number(row, "mean_error_deg") <= 0.02, "{row}");
        assert!(row["bits"].as_u64().unwrap() <= 32, "{row}");
        assert!(!row["id"].as_str().unwrap().starts_with("hemi"), "{row}");
    }
    assert!(candidates.is_sorted_by(|a, b| order(a) <= order(b)));
    assert!(candidates[0]["encode_cost"].is_number(), "the shipped costs lack {}", candidates[0]["id"]);

    let hemisphere = stdout(&run(["choose", "--max-error", "0.6", "--bits", "16", "--hemisphere"]));
    assert!(hemisphere.contains("hemioct16"), "{hemisphere}");
    let none = run(["choose", "--max-error", "1e-9"]);
    assert_eq!(none.status.code(), Some(1));
    assert!(stdout(&none).contains("no codec meets this demand"));
    assert_eq!(run(["choose", "--max-error", "zero"]).status.code(), Some(2));
}

/// With other costs the choice is another one.
#[test]
fn choose_goes_by_the_costs_it_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let costs = folder.path().join("costs.json");
    let row = |id: &str, direction: &str| {
        format!(
            r#"{{"id": "{id}", "direction": "{direction}", "source": "rust", "alu_ratio_to_oct32": 0.1}}"#
        )
    };
    let rows = [row("ico24", "encode"), row("ico24", "decode")].join(", ");
    std::fs::write(&costs, format!(r#"{{"device": {{"name": "imagined"}}, "rows": [{rows}]}}"#)).unwrap();
    let chosen = stdout(&run(["choose", "--max-error", "0.05", "--costs", path(&costs)]));
    assert!(chosen.contains("imagined") && chosen.contains("\nico24: "), "{chosen}");
    std::fs::write(&costs, "{}").unwrap();
    let refused = run(["choose", "--max-error", "0.05", "--costs", path(&costs)]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(stderr(&refused).contains("is not a report of `unitvec bench --json`"), "{}", stderr(&refused));
}

/// A row for each direction and source, with figures that can be; and a CSV of the same rows.
#[cfg(feature = "glsl")]
#[test]
fn bench_reports_every_direction_and_source() {
    let folder = tempfile::tempdir().unwrap();
    let [json, csv, markdown] =
        ["json", "csv", "md"].map(|kind| folder.path().join(format!("report.{kind}")));
    let output = run([
        "bench",
        "--device",
        "llvmpipe",
        "--validate",
        "--count",
        "4099",
        "--samples",
        "2",
        "--codec",
        "oct16",
        "--codec",
        "snorm8x3p",
        "--codec",
        "frame64",
        "--json",
        path(&json),
        "--csv",
        path(&csv),
        "--markdown",
        path(&markdown),
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("warning: this device is a CPU") && text.contains("bench: 3 codecs"), "{text}");
    let report: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    assert_eq!(report["device"]["kind"], "software");
    let rows = report["rows"].as_array().unwrap();
    let named = |row: &Value| ["id", "direction", "source"].map(|key| row[key].as_str().unwrap().to_owned());
    let names: Vec<String> = rows.iter().map(|row| named(row).join(" ")).collect();
    for id in ["oct16", "snorm8x3p", "frame64"] {
        for kind in ["encode rust", "encode glsl", "decode rust", "decode glsl"] {
            assert!(names.contains(&format!("{id} {kind}")), "{id} {kind}");
        }
    }
    assert!(names.contains(&"oct16 decode rust-table".to_owned()));
    assert_eq!(rows.len(), 13);
    for row in rows {
        assert!(
            row["vectors_per_s"].as_f64().unwrap() > 0.0 && row["copy_bytes_per_s"].as_f64().unwrap() > 0.0
        );
        assert_eq!(row["alu_ns_per_vector"].is_number(), row["source"] != "rust-table", "{row}");
    }
    assert_eq!(rows[0]["survey_ns_per_vector"].as_f64(), Some(0.023132));
    assert_eq!(std::fs::read_to_string(&csv).unwrap().lines().count(), 14);
    assert_eq!(std::fs::read_to_string(&markdown).unwrap().matches("\n| `").count(), 3);
}
