//! The program's commands, run as a user runs them.

use crate::convert::{path, two_meshes};
use crate::faults::assert_fails;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::path::Path;
use unitvec_catalogue::CODECS;
use unitvec_catalogue::Element;
use unitvec_catalogue::Operation;
#[cfg(feature = "glsl")]
use unitvec_catalogue::find;
#[cfg(feature = "glsl")]
use unitvec_run::glsl::Compiler;
use unitvec_tests::program::{command, run, stderr, stdout};
use unitvec_tests::{BACKENDS, repository};

/// The standard output of a command line that succeeds.
fn printed(line: &str) -> String {
    let output = run(line.split(' '));
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    stdout(&output)
}

/// The standard output as JSON, without a table around it.
fn json(line: &str) -> Value {
    serde_json::from_str(&printed(line)).unwrap()
}

fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn codecs_lists_the_catalogue() {
    let (table, json) = (printed("codecs"), json("codecs --json -"));
    assert_eq!(json.as_array().unwrap().len(), CODECS.len());
    for (codec, entry) in CODECS.iter().zip(json.as_array().unwrap()) {
        assert!(table.lines().any(|line| line.starts_with(codec.id)), "{}", codec.id);
        assert_eq!(entry["id"], codec.id);
        assert_eq!(entry["bits"], codec.bits);
        let element =
            ["vector", "frame", "rotation"][Element::ALL.iter().position(|e| *e == codec.element).unwrap()];
        assert_eq!(entry["element"], element);
        assert_eq!(entry["encode_function"], codec.function(Operation::Encode));
        assert_eq!(entry["bytes"], codec.bytes);
    }
    let types: HashMap<_, _> =
        json.as_array().unwrap().iter().map(|entry| (entry["rust_type"].as_str(), &entry["id"])).collect();
    assert_eq!(types.len(), CODECS.len());
    for (rust_type, id) in
        [("OctPrecise16", "oct16p"), ("Snorm11x11x10", "snorm11_11_10"), ("Frame64", "frame64")]
    {
        assert_eq!(types[&Some(rust_type)], id);
    }
    // No line ends within a name.
    let words: HashSet<&str> = table.split([' ', ',', '\n']).collect();
    for name in ["gltf-snorm16", "frame32-or-zero", "draco:2-16", "smallest3:4-20", "spz"] {
        assert!(words.contains(name), "{name}: {table}");
    }
}

/// True where a JSON value is what a schema describes: of the right type, with all keys that it requires and no others.
fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    if let Some(path) = schema["$ref"].as_str() {
        return fits(root, root.pointer(&path[1..]).unwrap(), value);
    }
    if let Some(kinds) = schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        return kinds.iter().any(|kind| fits(root, kind, value));
    }
    let is_type = |name: &Value| match name.as_str().unwrap() {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        _ => value.is_object(),
    };
    let has_type = match &schema["type"] {
        Value::Null => true,
        Value::Array(names) => names.iter().any(is_type),
        name => is_type(name),
    };
    let is_listed = ["enum", "required"].map(|key| schema[key].as_array());
    let member_fits = |(key, member): (&String, &Value)| {
        let kind = schema["properties"].get(key).or(schema.get("additionalProperties"));
        kind.is_some_and(|kind| fits(root, kind, member))
    };
    has_type
        && (schema["const"].is_null() || schema["const"] == *value)
        && is_listed[0].is_none_or(|values| values.contains(value))
        && is_listed[1].into_iter().flatten().all(|key| value.get(key.as_str().unwrap()).is_some())
        && value.as_array().into_iter().flatten().all(|item| fits(root, &schema["items"], item))
        && value.as_object().into_iter().flatten().all(member_fits)
}

/// `unitvec schema` describes what each command writes with `--json`, and no command writes anything else.
#[test]
fn schemas_describe_what_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let [codes, back, mesh] = ["codes", "back", "two.gltf"].map(|name| folder.path().join(name));
    std::fs::write(&mesh, two_meshes()).unwrap();
    let (codes, back, mesh) = (path(&codes), path(&back), path(&mesh));
    let waves = repository().join("host/texture/data/waves.png");
    let [bunny, torus] =
        ["bunny.obj", "torus.glb"].map(|name| repository().join("host/mesh/data").join(name));
    let mut commands = vec![
        ("codecs", String::new()),
        ("encode", format!("--codec hemioct16 {mesh} {codes}")),
        ("decode", format!("--codec oct16 {codes} {back}")),
        ("normals", format!("{mesh} {back}")),
        ("snap", format!("--for oct16 {mesh} {back}")),
        ("texture", format!("--codec hemioct16 {} {back}.ktx2", path(&waves))),
        ("write", format!("--normals {} {} {back}.glb", torus.display(), torus.display())),
        (
            "compare",
            format!("--codec oct16 --view 1,0,0 --side 64 --samples 1 -o {back} {}", bunny.display()),
        ),
        ("error", format!("--codec oct16 {mesh}")),
        ("error", format!("--codec vector32 {mesh}")),
        ("choose", "--bits 16".into()),
        ("accuracy", "--count 10 --table 3".into()),
        ("conform", "--count 10 --codec oct16,frame32".into()),
        ("conform kernels", "--count 10 --codec oct8".into()),
        ("conform pipeline", "--count 16 --codec oct16".into()),
        ("conform imprecise", "--count 10 --codec oct16".into()),
    ];
    if cfg!(feature = "glsl") {
        let few = "--count 100 --samples 1 --codec oct16".to_owned();
        commands.extend([("bench", few.clone()), ("bench device", few)]);
        commands.push(("bench compiler", "--gpu navi21 --codec oct16".into()));
    }
    for (command, arguments) in &commands {
        let schema = json(&format!("schema {command}"));
        let written = json(format!("{command} --json - {arguments}").trim_end());
        assert!(fits(&schema, &schema, &written), "{command}: {written}");
        assert!(!fits(&schema, &schema, &Value::Bool(true)), "{command}");
    }
    let listed = printed("schema");
    let is_run = |name: &&str| cfg!(feature = "glsl") || !name.starts_with("bench");
    let run: HashSet<&str> = commands.iter().map(|(command, _)| *command).collect();
    assert_eq!(listed.lines().filter(is_run).collect::<HashSet<_>>(), run);
}

#[test]
fn devices_marks_the_one_that_would_be_used() {
    let text = printed("devices");
    assert!(text.lines().any(|line| line.starts_with('*') && line.contains("llvmpipe")), "{text}");
}

#[test]
fn conform_reports_in_words_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("report.json");
    let bunny = repository().join("host/mesh/data/bunny.obj");
    let line = format!(
        "conform --validate --codec oct16 --codec hemioct32 --count 1000 --json {} {}",
        path(&json),
        path(&bunny)
    );
    let text = printed(&line);
    assert!(text.contains("conform: PASS"), "{text}");
    let covered = "(all codes of up to 16 bits, 1000 random codes of more)";
    assert!(text.contains(covered), "{text}");
    let report = read_json(&json);
    assert_eq!(report["agreed"], true);
    assert_eq!((&report["all_codes_up_to"], &report["random_directions"]), (&16.into(), &1000.into()));
    assert_eq!(report["glsl_compared"], cfg!(feature = "glsl"));
    assert!(report["device"]["name"].as_str().unwrap().contains("llvmpipe"));
    let rows = report["rows"].as_array().unwrap();
    assert!(rows.iter().map(|row| row["id"].as_str().unwrap()).eq(["oct16", "hemioct32"]));
    for row in rows {
        assert!(row["vectors"].as_u64().unwrap() > 1000);
        assert!(row["mean_deg"].as_f64().unwrap() > 0.0);
        assert!(row["max_deg"].as_f64().unwrap() > row["mean_deg"].as_f64().unwrap());
        for half in ["encode_mismatches", "decode_mismatches"] {
            let compared = row[half].as_object().unwrap();
            assert!(compared.values().all(|mismatches| *mismatches == 0), "{compared:?}");
            assert_eq!(compared.len() + 1, BACKENDS.len());
            assert!(compared.keys().all(|backend| BACKENDS.contains(&backend.as_str())), "{compared:?}");
        }
    }
    assert_eq!(rows[0]["bits"], 16);
}

/// `--summary` condenses in one line the JSON's rows for each codec.
#[test]
fn conform_sums_up_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let summary = folder.path().join("summary.tsv");
    let line =
        format!("conform --codec oct12 --codec frame32 --count 10 --json - --summary {}", path(&summary));
    let report = json(&line);
    let device = ["name", "driver", "api_version"].map(|field| report["device"][field].as_str().unwrap());
    let rows = report["rows"].as_array().unwrap();
    let total = |field| rows.iter().map(|row| row[field].as_u64().unwrap()).sum::<u64>().to_string();
    let (vectors, codes) = (total("vectors"), total("codes"));
    let text = std::fs::read_to_string(&summary).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split('\t').collect()).collect();
    assert_eq!(lines[0], ["device", "driver", "vulkan", "codecs", "vectors", "codes", "mismatches"]);
    assert_eq!(lines[1..], [[&device[..], &["2", &vectors, &codes, "0"]].concat()]);
}

/// All codes of 20 bits are decoded with `--exhaustive`, and as many as are asked for without.
#[test]
fn conform_decodes_all_codes_where_it_says_so() {
    let [short, whole] = ["", " --exhaustive"]
        .map(|option| json(&format!("conform --json - --codec oct20 --count 10{option}")));
    let codes = |report: &Value| report["rows"][0]["codes"].as_u64().unwrap();
    assert_eq!(short["rows"][0]["id"], "oct20");
    assert_eq!((&short["all_codes_up_to"], &whole["all_codes_up_to"]), (&16.into(), &24.into()));
    assert_eq!(codes(&whole) - codes(&short), (1 << 20) - 10);
}

/// The codecs chosen satisfy the demand; those of fewest bytes come first, and of those the cheapest.
#[test]
fn choose_gives_the_cheapest_that_meets_the_demand() {
    let report = json("choose --max-error 0.05 --mean-error 0.02 --bits 32 --json -");
    let candidates = report["candidates"].as_array().unwrap();
    assert!(candidates.len() > 5);
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap_or(f64::INFINITY);
    let order = |row: &Value| (row["bytes"].as_u64(), number(row, "cost"));
    for row in candidates {
        assert!(number(row, "bound_deg") <= 0.05 && number(row, "mean_deg") <= 0.02, "{row}");
        assert!(row["bits"].as_u64().unwrap() <= 32, "{row}");
        assert!(!row["id"].as_str().unwrap().starts_with("hemi"), "{row}");
    }
    assert!(candidates.is_sorted_by(|a, b| order(a) <= order(b)));
    let sum = number(&candidates[0], "encode_cost") + number(&candidates[0], "decode_cost");
    assert_eq!(number(&candidates[0], "cost"), sum);

    let hemisphere = printed("choose --max-error 0.6 --bits 16 --hemisphere");
    assert!(hemisphere.contains("hemioct16"), "{hemisphere}");
    let finest = printed("choose --bits 24");
    assert!(finest.contains("take ico24: no codec of so few bits has a smaller bound"), "{finest}");
    assert!(finest.contains("oct24 (encoded often: G-buffers)"), "{finest}");
    for (line, status, words) in [
        ("choose", 2, "--max-error <DEG>"),
        ("choose --max-error zero", 2, "zero"),
        ("choose --max-error 1e-9", 1, "no codec meets this demand; nearest: oct52p (bound "),
        ("choose --bits 7", 1, "nearest: oct8p (8 bits, 1.14 times what is asked; 1 byte"),
        ("choose --bits 16 --weights 0,0", 2, "one of them above 0"),
        ("choose --bits 16 --weights 1", 2, "two numbers"),
        ("choose --bits 16 --frames --hemisphere", 2, "cannot be used with"),
    ] {
        let output = run(line.split(' '));
        assert_eq!(output.status.code(), Some(status), "{line}");
        assert!((stdout(&output) + &stderr(&output)).contains(words), "{line}");
    }
}

/// Decoding alone counts where encoding has no weight; codecs that would be better and fail by little are named; frames
/// have codecs of their own; what the order goes by is shown.
#[test]
fn choose_weighs_names_misses_and_takes_frames() {
    let report = json("choose --max-error 0.05 --weights 0,1 --json -");
    let rows = report["candidates"].as_array().unwrap();
    let least = rows.iter().filter(|row| row["bytes"] == rows[0]["bytes"]);
    let least = least.map(|row| row["decode_cost"].as_f64().unwrap()).reduce(f64::min);
    assert_eq!(rows[0]["decode_cost"].as_f64(), least);
    assert!(rows.iter().all(|row| row["cost"] == row["decode_cost"]));

    let both = json("choose --max-error 0.05 --json -");
    let miss = &both["misses"][0];
    assert_eq!((&miss["id"], &miss["exceeds"]), (&"oct24".into(), &"bound".into()));
    let times = miss["bound_deg"].as_f64().unwrap() / 0.05;
    assert!(miss["times"].as_f64().is_some_and(|said| (said - times).abs() < 1e-9 && said < 1.25), "{miss}");

    let frames = json("choose --frames --max-error 0.5 --json -");
    let ids: Vec<&str> =
        frames["candidates"].as_array().unwrap().iter().filter_map(|row| row["id"].as_str()).collect();
    assert_eq!(ids, ["frame32", "frame64"]);
    assert!(printed("choose --frames --max-error 0.3").contains("take frame64: "));

    let table = printed("choose --max-error 0.05");
    for heading in ["bytes", "bound", "max", "mean", "encode", "decode", "cost", "recommended for"] {
        assert!(table.lines().nth(1).unwrap().contains(heading), "{table}");
    }
    assert!(
        table.contains("near misses: oct24 (bound 0.0594, 1.19 times what is asked; 3 bytes, cost 2.6)"),
        "{table}"
    );
}

/// What is seen limits the error, by the closed forms of a matt surface in light and of a mirror, and with other limits the least
/// counts.
#[test]
fn choose_goes_by_what_is_seen() {
    let error = |line: &str| json(&format!("{line} --json -"))["unseen"]["max_error_deg"].as_f64().unwrap();
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    assert!(near(error("choose --color-depth 8 --linear"), (0.5f64 / 255.0).to_degrees()));
    assert!(near(error("choose --mirror --pixels 500 --fov 90"), (1.0f64 / 2000.0).to_degrees()));
    let sharp = error("choose --color-depth 8 --roughness 0.1");
    assert!(sharp < error("choose --color-depth 8 --roughness 0.1 --light-degrees 5"));
    let report = json("choose --color-depth 8 --linear --max-error 0.05 --json -");
    assert_eq!(report["candidates"], json("choose --max-error 0.05 --json -")["candidates"]);
    let text = printed("choose --color-depth 8 --linear --mirror --gpu rdna3 --bits 32");
    assert!(text.contains("not seen: errors up to 0.0115 degrees, by the mirror; "), "{text}");
    for (line, words) in [
        ("choose --color-depth 0", "1..=32"),
        ("choose --color-depth 8 --roughness 0", "not a number from 0.01 to 1"),
        ("choose --color-depth 8 --roughness nan", "not a number from 0.01 to 1"),
        ("choose --roughness 0.1 --bits 16", "--color-depth <BITS>"),
        ("choose --mirror --fov 180", "not a number from 0.1 to 179"),
        ("choose --mirror --pixels 0", "0 is not in 1"),
    ] {
        let output = run(line.split(' '));
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(stderr(&output).contains(words), "{line}");
    }
}

/// The costs of RDNA 2 are those to choose by where nothing else is named.
#[test]
fn choose_takes_the_costs_of_a_gpu() {
    let with = |gpu: &str| json(&format!("choose --max-error 0.05 --json -{gpu}"));
    let default = with("");
    assert!(default["costs_of"].as_str().unwrap().starts_with("RDNA 2 (navi21)"), "{default}");
    assert_eq!(default, with(" --gpu navi21"));
    assert!(with(" --gpu gcn4")["costs_of"].as_str().unwrap().contains("polaris10"));
    let lavapipe = with(" --gpu lavapipe");
    assert!(lavapipe["costs_of"].as_str().unwrap().contains("llvmpipe"));
    assert_ne!(lavapipe["candidates"][0]["encode_cost"], default["candidates"][0]["encode_cost"]);
    let mut unknown = command(["choose", "--max-error", "0.05", "--gpu", "voodoo2"]);
    assert_fails(&mut unknown, 2, &["bench compiler --gpu voodoo2 --json FILE", "rdna2 (navi21: RX 6000)"]);
    let mut other = command(["choose", "--max-error", "0.05", "--gpu", "RTX 4090"]);
    assert_fails(&mut other, 2, &["NVIDIA", "bench device --device NAME"]);
}

/// The choice is another one with other costs; a report without `oct32` has no reference for them.
#[test]
fn choose_goes_by_the_costs_it_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let costs = folder.path().join("costs.json");
    let choose = ["choose", "--max-error", "0.05", "--costs", path(&costs)];
    // A clock that shows no time gives no speed.
    let times = json!({"ratio_to_oct32": 0.1, "ns_per_vector": 1, "vectors_per_s": null});
    let row =
        |operation: &str| json!({"id": "ico24", "operation": operation, "source": "rust", "times": times});
    let device =
        json!({"index": 0, "name": "imagined", "kind": "discrete", "driver": "b", "api_version": "1.3.0"});
    let rows = [row("encode"), row("decode")];
    let imagined = json!({"device": device, "kernel": "measured", "sources": {}, "rows": rows});
    std::fs::write(&costs, imagined.to_string()).unwrap();
    let chosen = stdout(&run(choose));
    assert!(chosen.contains("imagined") && chosen.contains("\ntake ico24: "), "{chosen}");
    let row = json!({"id": "oct16", "operation": "encode", "source": "glsl", "inverse_throughput": 100});
    for (report, words) in [
        (json!({}), "is not a report of `unitvec bench --json`"),
        (json!({"device": device, "sources": {}, "rows": [row]}), "no cost of oct32"),
    ] {
        std::fs::write(&costs, report.to_string()).unwrap();
        assert_fails(&mut command(choose), 1, &[words]);
    }
}

/// A row for each operation and backend has plausible figures; the CSV has the same rows.
#[cfg(feature = "glsl")]
#[test]
fn bench_reports_every_operation_and_backend() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    cost_kernels(folder.path(), &["oct32", "oct16", "snorm8x3p", "frame64"]);
    let files = ["json", "csv", "markdown"].map(|kind| format!("--{kind} {}", path(&file(kind))));
    let text = printed(&format!(
        "bench --device llvmpipe --validate --cost-kernels {} --count 4099 --samples 2 --codec oct16,snorm8x3p,frame64 {}",
        path(folder.path()),
        files.join(" ")
    ));
    assert!(text.contains("warning: this device is a CPU") && text.contains("bench: 3 codecs"), "{text}");
    let report = read_json(&file("json"));
    assert_eq!(report["device"]["kind"], "software");
    let rows = report["rows"].as_array().unwrap();
    let named = |row: &Value| ["id", "operation", "source"].map(|key| row[key].as_str().unwrap().to_owned());
    let names: Vec<String> = rows.iter().map(|row| named(row).join(" ")).collect();
    for id in ["oct16", "snorm8x3p", "frame64"] {
        for kind in ["encode rust", "encode glsl", "decode rust", "decode glsl"] {
            assert!(names.contains(&format!("{id} {kind}")), "{id} {kind}");
        }
    }
    assert!(names.contains(&"oct16 decode table".to_owned()));
    assert_eq!(rows.len(), 13);
    for row in rows {
        let times = &row["times"];
        assert!(["vectors_per_s", "copy_bytes_per_s"].iter().all(|key| times[key].as_f64().unwrap() > 0.0));
        assert_eq!(times["ns_per_vector"].is_number(), row["source"] != "table", "{row}");
    }
    // The survey's figure of oct16.
    assert!(text.contains(" 0.0231 "), "{text}");
    let text = |kind| std::fs::read_to_string(file(kind)).unwrap();
    assert_eq!((text("csv").lines().count(), text("markdown").matches("\n| `").count()), (14, 3));
}

/// Kernels that measure, compiled from GLSL, in a folder as `cargo xtask spirv --cost` writes those from Rust.
#[cfg(feature = "glsl")]
pub fn cost_kernels(folder: &Path, ids: &[&str]) {
    let compiler = Compiler::new().unwrap();
    let write = |name: String, module: Vec<u8>| {
        let name = format!("{name}_cost");
        std::fs::write(folder.join(format!("{name}.spv")), with_entry_point(&module, &name)).unwrap();
    };
    for operation in Operation::ALL {
        write(format!("baseline_{operation}"), compiler.cost_kernel(None, operation).unwrap());
        for format in ids.iter().map(|id| find(id).unwrap()) {
            write(format.function(operation), compiler.cost_kernel(Some(format), operation).unwrap());
        }
    }
}

/// A module whose only entry point, `main`, has another name.
#[cfg(feature = "glsl")]
fn with_entry_point(module: &[u8], name: &str) -> Vec<u8> {
    const OP_ENTRY_POINT: [u8; 2] = [15, 0];
    let main = module.windows(8).position(|bytes| bytes == b"main\0\0\0\0").unwrap();
    assert_eq!(module[main - 12..][..2], OP_ENTRY_POINT);
    let mut words = name.as_bytes().to_vec();
    words.resize(name.len() / 4 * 4 + 4, 0);
    let length = u16::from_le_bytes([module[main - 10], module[main - 9]]) as usize + words.len() / 4 - 2;
    let mut renamed = [&module[..main], &words, &module[main + 8..]].concat();
    renamed[main - 10..main - 8].copy_from_slice(&(length as u16).to_le_bytes());
    renamed
}

/// The kernels from GLSL are measured without those from Rust that measure; where one is missing, the message names the
/// command that builds it.
#[cfg(feature = "glsl")]
#[test]
fn bench_says_how_to_build_the_kernels_that_measure() {
    let folder = tempfile::tempdir().unwrap();
    let [costs, none] = ["report.json", "none"].map(|name| folder.path().join(name));
    let few = "bench --device llvmpipe --count 100 --samples 1 --codec oct16";
    let text = printed(&format!("{few} --json {}", path(&costs)));
    assert!(text.contains("cargo xtask spirv --cost"), "{text}");
    for row in read_json(&costs)["rows"].as_array().unwrap() {
        assert_eq!(row["times"]["ratio_to_oct32"].is_number(), row["source"] == "glsl", "{row}");
    }
    let chosen = json(&format!("choose --max-error 1 --bits 16 --json - --costs {}", path(&costs)));
    let first = &chosen["candidates"][0];
    assert_eq!((&first["id"], first["encode_cost"].is_number()), (&json!("oct16"), true));
    let mut without = command(few.split(' ').chain(["--cost-kernels", path(&none)]));
    assert_fails(&mut without, 1, &["`cargo xtask spirv --cost` builds it"]);
}
