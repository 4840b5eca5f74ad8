//! Losses by `unitvec error`, held against the oracle, against sorting and against cases worked out by hand.

use serde_json::Value;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use unitvec::interop::Format;
use unitvec_catalogue::{self as catalogue, Domain, Element, RECOMMENDED, Recommendation, find};
use unitvec_oracle::angle_deg;
use unitvec_run::sampling;
use unitvec_tests::program::{raw, refusal, run, run_with_input, stderr, stdout};
use unitvec_tests::repository;

fn file(folder: &TempDir, name: &str, floats: &[f32]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, raw(floats)).unwrap();
    path
}

/// The report on files.
fn report(codecs: &[&str], files: &[&Path]) -> Value {
    let codecs = codecs.iter().flat_map(|id| ["--codec".as_ref(), id.as_ref()]);
    let files = files.iter().map(|path| path.as_os_str());
    let output = run(["error", "--json", "-"].map(AsRef::as_ref).into_iter().chain(codecs).chain(files));
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The row of a codec and part, in a file or of all.
fn row<'a>(rows: &'a Value, id: &str, part: &str) -> &'a Value {
    let is_it = |row: &&Value| row["id"] == id && row["part"] == part;
    rows.as_array().unwrap().iter().find(is_it).unwrap_or_else(|| panic!("no {id} {part} in {rows}"))
}

/// The figures of a row are those of these errors, some of them worked out in float64 from the f32 input.
fn assert_errors(row: &Value, mut errors: Vec<f64>, left_out: usize) {
    let (count, mean) = (errors.len(), errors.iter().sum::<f64>() / errors.len() as f64);
    errors.sort_by(f64::total_cmp);
    // The least that so many per cent do not exceed.
    let quantile = |percent: usize| errors[(count * percent).div_ceil(100) - 1];
    assert_eq!((&row["count"], &row["left_out"]), (&count.into(), &left_out.into()), "{row}");
    let bin = 2f64.powi(-12);
    for (name, expected, bin) in [
        ("mean_deg", mean, 0.0),
        ("median_deg", quantile(50), bin),
        ("p99_deg", quantile(99), bin),
        ("max_deg", errors[count - 1], 0.0),
    ] {
        let found = row[name].as_f64().unwrap();
        // Decoding rounds to f32: half an ulp of 1 is 3.4e-6 degrees a component.
        assert!((found - expected).abs() <= bin * expected + 1e-5, "{name}: {expected} in {row}");
    }
}

/// Vectors with some that have no direction between them.
fn vectors() -> Vec<[f32; 3]> {
    let mut vectors: Vec<_> = sampling::random_directions(Domain::Sphere, 21).take(1000).collect();
    for (at, bad) in [(0, 0.0), (500, f32::NAN), (900, f32::INFINITY)] {
        vectors.insert(at, [bad, 0.0, 0.0]);
    }
    vectors
}

#[test]
fn figures_are_the_oracles() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "in.bin", vectors().as_flattened());
    let codecs = ["oct16", "oct24p", "ico16", "snorm8x3"];
    let report = report(&codecs, &[&path]);
    for id in codecs {
        let oracle = unitvec_oracle::round_trip(id).unwrap();
        let error = |vector: [f32; 3]| angle_deg(vector.map(f64::from), oracle(vector.map(f64::from)));
        let usable = || vectors().into_iter().filter(|vector| vector[1] != 0.0);
        let errors: Vec<f64> = usable().map(error).collect();
        let found = row(&report["rows"], id, "vector");
        assert_eq!((&found["file"], &found["bits"]), (&path.to_str().into(), &find(id).unwrap().bits.into()));
        let worst = &found["worst"];
        let at = worst["index"].as_u64().unwrap() as usize;
        assert!((error(vectors()[at]) - found["max_deg"].as_f64().unwrap()).abs() < 1e-5, "{id}: {worst}");
        let components = vectors()[at].map(|component| Value::from(f64::from(component)));
        let shown =
            worst["original"].as_array().unwrap().iter().map(|c| Value::from(c.as_f64().unwrap() as f32));
        assert!(shown.eq(components), "{id}: {worst}");
        assert_errors(found, errors, 3);
    }
}

/// `snorm8x3` keeps 127ths of its input, so that exact, inexact and lost components can be predicted by hand.
#[test]
fn figures_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let step = 1.0 / 127.0;
    let path = file(
        &folder,
        "in.bin",
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.25 * step, 0.0], [0.25 * step, 0.0, 0.0]].concat(),
    );
    let report = report(&["snorm8x3"], &[&path]);
    let row = row(&report["rows"], "snorm8x3", "vector");
    let off = (1.25f64 / 127.0).atan().to_degrees() - (1.0f64 / 127.0).atan().to_degrees();
    // Nothing is left of the last, so that it comes back as +Z.
    assert_errors(row, vec![0.0, off, 90.0], 1);
    assert_eq!(row["worst"]["index"], 3);
    assert_eq!(row["worst"]["decoded"], serde_json::json!([0.0, 0.0, 1.0]));
}

/// A frame without a normal counts for neither part, one without a tangent for its normal alone.
#[test]
fn frames_have_two_errors() {
    let folder = tempfile::tempdir().unwrap();
    let mut frames: Vec<[f32; 7]> = sampling::random_frames(22).take(500).collect();
    frames[7][..3].fill(0.0);
    frames[8][3..6].fill(0.0);
    let path = file(&folder, "in.bin", frames.as_flattened());
    let report = report(&["frame32", "frame64"], &[&path]);
    for codec in catalogue::frames() {
        let mut codes = vec![0; frames.len() * codec.bytes];
        codec.encode_cpu(frames.as_flattened(), &mut codes).unwrap();
        let mut decoded = vec![[0.0; 7]; frames.len()];
        codec.decode_cpu(&codes, decoded.as_flattened_mut()).unwrap();
        for (part, at, left_out) in [("normal", 0, &[7][..]), ("tangent", 3, &[7, 8])] {
            let vector = |frame: [f32; 7]| [frame[at], frame[at + 1], frame[at + 2]].map(f64::from);
            let kept = (0..frames.len()).filter(|index| !left_out.contains(index));
            let errors = kept.map(|index| angle_deg(vector(frames[index]), vector(decoded[index]))).collect();
            assert_errors(row(&report["rows"], codec.id, part), errors, left_out.len());
        }
    }
}

/// Rotations have angles of rotation, whatever their signs are; one without a direction is left out.
#[test]
fn rotations_have_angles_of_rotation() {
    let folder = tempfile::tempdir().unwrap();
    let mut rotations: Vec<[f32; 4]> = sampling::random_rotations(23).take(500).collect();
    rotations[7].fill(0.0);
    let path = file(&folder, "in.bin", rotations.as_flattened());
    let report = report(&["quat24", "quat64"], &[&path]);
    for codec in catalogue::rotations().iter().filter(|codec| ["quat24", "quat64"].contains(&codec.id)) {
        let kept = rotations.iter().enumerate().filter(|(index, _)| *index != 7);
        let errors = kept.map(|(_, rotation)| {
            let decoded: [f32; 4] = codec.decode_one(codec.encode_one(*rotation));
            let unit = |q: [f32; 4]| unitvec_oracle::quat::unit(q.map(f64::from));
            unitvec_oracle::quat::angle_deg(unit(*rotation), unit(decoded))
        });
        assert_errors(row(&report["rows"], codec.id, "rotation"), errors.collect(), 1);
    }
}

/// Over more than a chunk, and over files: the totals are those of all their vectors.
#[test]
fn totals_are_of_all_files() {
    let folder = tempfile::tempdir().unwrap();
    let mut long = vec![[0.0, 0.0, 1.0]; (1 << 20) + 5];
    let worst = long.len() - 2;
    long[worst] = [0.6, 0.48, 0.64];
    let short: Vec<_> = vectors().into_iter().filter(|vector| vector[2] < -0.9).collect();
    let paths = [("long.bin", &long), ("short.bin", &short)]
        .map(|(name, vectors)| file(&folder, name, vectors.as_flattened()));
    let report = report(&["hemioct16"], &[&paths[0], &paths[1]]);
    let oracle = unitvec_oracle::round_trip("hemioct16").unwrap();
    let error = |vector: &[f32; 3]| angle_deg(vector.map(f64::from), oracle(vector.map(f64::from)));
    let of = |vectors: &[[f32; 3]]| vectors.iter().map(error).collect::<Vec<f64>>();
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert_errors(&rows[0], of(&long), 0);
    assert_eq!(rows[0]["worst"]["index"], worst);
    assert_errors(&rows[1], of(&short), 0);
    let total = row(&report["totals"], "hemioct16", "vector");
    assert_errors(total, [of(&long), of(&short)].concat(), 0);
    // Vectors below the hemisphere come back above it.
    assert!(total["max_deg"].as_f64().unwrap() > 50.0, "{total}");
    assert_eq!(total["worst"]["file"], paths[1].to_str().unwrap());
    assert_eq!(total["worst"], rows[1]["worst"]);
}

/// Pipes give the same as files, and Vulkan the same as the CPU.
#[test]
fn inputs_and_backends_are_alike() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, "in.bin", vectors().as_flattened());
    let of_file = report(&["oct32"], &[&path]);
    let arguments = ["error", "--json", "-", "--codec", "oct32", "--backend", "rust", "-"];
    let output = run_with_input(arguments, &raw(vectors().as_flattened()));
    let of_pipe: Value = serde_json::from_slice(&output.stdout).unwrap();
    for figure in ["count", "left_out", "mean_deg", "median_deg", "p99_deg", "max_deg"] {
        assert_eq!(of_file["rows"][0][figure], of_pipe["rows"][0][figure], "{figure}");
    }
    let nothing = run_with_input(["error", "--json", "-", "-"], &[]);
    let report: Value = serde_json::from_slice(&nothing.stdout).unwrap();
    assert_eq!((&report["rows"][0]["count"], &report["rows"][0]["mean_deg"]), (&0.into(), &Value::Null));
}

/// README's recommendations for any direction are the default; a line for each file and codec, and for both together.
#[test]
fn the_table_has_the_recommended_codecs() {
    let bunny = repository().join("host/mesh/data/bunny.obj");
    let [one, two] = [1, 2].map(|count| {
        let arguments = ["error".into()].into_iter().chain(vec![bunny.clone(); count]);
        stdout(&run(arguments.collect::<Vec<PathBuf>>()))
    });
    let mut shown = 0;
    for id in RECOMMENDED.iter().flat_map(Recommendation::short).map(|choice| choice.id) {
        let lines = |text: &str| text.lines().filter(|line| line.contains(&format!(" {id} "))).count();
        let is_shown = find(id).is_ok_and(|c| c.element == Element::Vector && c.domain == Domain::Sphere);
        assert_eq!((lines(&one), lines(&two)), if is_shown { (1, 3) } else { (0, 0) }, "{id}\n{one}\n{two}");
        shown += usize::from(is_shown);
    }
    assert!(shown > 5);
    assert_eq!(two.matches("all files").count(), shown);
    assert!(!one.contains("all files"));
}

/// A file that another encoder wrote is found to be of its format; beside its original it has that encoder's errors, and a
/// row tells those of the nearest codes. Other numbers and other orders of vectors are told.
#[test]
fn a_quantised_file_is_recognised() {
    let folder = tempfile::tempdir().unwrap();
    let vectors: Vec<[f32; 3]> = sampling::random_directions(Domain::Sphere, 17).take(1000).collect();
    let format = Format::named("tiles3d-oct16").unwrap();
    let plain = |v: &[f32; 3]| -> [f32; 3] { format.decode(format.plain().encode(*v)) };
    let made: Vec<[f32; 3]> = vectors.iter().map(plain).collect();
    let original = file(&folder, "original.f32", vectors.as_flattened());
    let path = file(&folder, "made.f32", made.as_flattened());
    let error = |made: &Path| {
        run(["error", "--json", "-", "--original", original.to_str().unwrap(), made.to_str().unwrap()])
    };
    let report: Value = serde_json::from_slice(&error(&path).stdout).unwrap();
    let names: Vec<&str> = report["quantised"][0]["formats"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap())
        .collect();
    // Finer ones have these points among theirs.
    assert_eq!(names[..4], ["tiles3d-oct16", "quantized-mesh", "nanite:8", "cycles:8"]);
    assert!(names[4..].iter().all(|name| Format::named(name).unwrap().bits() > 16), "{names:?}");
    let mean = |id: &str| row(&report["rows"], id, "vector")["mean_deg"].as_f64().unwrap();
    let [as_it_is, plain, nearest] = ["as it is", "tiles3d-oct16 plain", "tiles3d-oct16"].map(mean);
    assert!((as_it_is - plain).abs() < 1e-6 && nearest < 0.95 * plain, "{report}");

    let turned: Vec<[f32; 3]> = made.iter().rev().copied().collect();
    let report: Value =
        serde_json::from_slice(&error(&file(&folder, "turned.f32", turned.as_flattened())).stdout).unwrap();
    assert!(report["warnings"][0].as_str().unwrap().contains("in the same order?"), "{report}");
    let short = refusal(&error(&file(&folder, "short.f32", made[1..].as_flattened())), 2);
    assert!(short.contains("has 999 vectors") && short.contains("1000"), "{short}");
    refusal(&error(Path::new("-")), 2);
}

#[test]
fn codecs_of_two_kinds_are_refused() {
    let said = refusal(&run(["error", "--codec", "oct32", "--codec", "frame32", "in.bin"]), 2);
    assert!(said.contains("one after the other"), "{said}");
}

/// The table mentions computed normals, and that a hemisphere codec moves vectors below it; otherwise neither.
#[test]
fn what_was_measured_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("own.obj");
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n").unwrap();
    let own = file.to_str().unwrap();
    let bunny = repository().join("host/mesh/data/bunny.obj");
    let computed = stdout(&run(["error", "--codec", "hemioct16", bunny.to_str().unwrap(), own]));
    let line = computed.lines().find(|line| line.starts_with("normals computed from faces: ")).unwrap();
    assert!(line.ends_with("bunny.obj"), "{line}");
    assert!(computed.contains("take z < 0 as z = 0"), "{computed}");
    let plain = stdout(&run(["error", "--codec", "oct16", own]));
    assert!(!plain.contains("computed") && !plain.contains("z < 0"), "{plain}");
}
