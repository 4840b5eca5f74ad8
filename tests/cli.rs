//! The program's commands, run as a user runs them.

use crate::faults::assert_fails;
use base64::Engine;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::path::Path;
use unitvec::{angle_deg, rotation_angle_deg};
use unitvec_catalogue::Element;
use unitvec_catalogue::Operation;
#[cfg(feature = "glsl")]
use unitvec_catalogue::find;
use unitvec_catalogue::{CODECS, Domain, frames, rotations, vectors};
#[cfg(feature = "glsl")]
use unitvec_run::glsl::Compiler;
use unitvec_run::sampling;
use unitvec_tests::program::{command, run, run_with_input, stderr, stdout};
use unitvec_tests::{BACKENDS, repository};

fn raw<const N: usize>(elements: &[[f32; N]]) -> Vec<u8> {
    elements.iter().flatten().flat_map(|component| component.to_le_bytes()).collect()
}

fn elements<const N: usize>(raw: &[u8]) -> Vec<[f32; N]> {
    let components: Vec<f32> =
        raw.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect();
    components.chunks_exact(N).map(|element| element.try_into().unwrap()).collect()
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

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
    let mut commands = vec![
        ("codecs", String::new()),
        ("encode", format!("--codec hemioct16 {mesh} {codes}")),
        ("decode", format!("--codec oct16 {codes} {back}")),
        ("normals", format!("{mesh} {back}")),
        ("snap", format!("--for oct16 {mesh} {back}")),
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

/// The codes of a file and their decoded values, which are the same on every backend.
fn convert(codec: &str, folder: &Path, input: &Path) -> (Vec<u8>, Vec<u8>) {
    let [codes, back] = ["codes", "back"].map(|name| folder.join(name));
    let mut results = BACKENDS.iter().map(|&backend| {
        let validate: &[&str] = if backend == "cpu" { &[] } else { &["--validate"] };
        let arguments = [validate, &["--codec", codec, "--backend", backend]].concat();
        for (command, from, to) in [("encode", input, &codes), ("decode", &codes, &back)] {
            let output = run([&[command], &arguments[..], &[path(from), path(to)]].concat());
            assert!(output.status.success(), "{}", stderr(&output));
        }
        (std::fs::read(&codes).unwrap(), std::fs::read(&back).unwrap())
    });
    let first = results.next().unwrap();
    assert!(results.all(|result| result == first), "{codec}");
    first
}

/// The largest angle between vectors at `at` in the elements.
fn worst<const N: usize>(original: &[[f32; N]], back: &[[f32; N]], at: usize) -> f64 {
    assert_eq!(back.len(), original.len());
    let vector = |element: &[f32; N]| [element[at], element[at + 1], element[at + 2]];
    original.iter().zip(back).map(|(a, b)| angle_deg(vector(a), vector(b))).fold(0.0, f64::max)
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
    for codec in vectors().iter().filter(|codec| ["oct16", "oct24p", "hemioct32"].contains(&codec.id)) {
        let (codes, back) = convert(codec.id, folder.path(), &input);
        assert_eq!(codes.len(), original.len() * codec.bytes);
        let worst = worst(&original, &elements(&back), 0);
        assert!(worst <= f64::from(codec.max_error_deg()), "{}: {worst}", codec.id);
    }
}

/// A glTF file with its buffer inside, of a view for each accessor.
fn gltf(meshes: Value, views: &[Vec<u8>], accessors: Value) -> String {
    let mut end = 0;
    let mut view = |bytes: &Vec<u8>| {
        end += bytes.len();
        json!({"buffer": 0, "byteOffset": end - bytes.len(), "byteLength": bytes.len()})
    };
    let all: Vec<Value> = views.iter().map(&mut view).collect();
    let uri = base64::engine::general_purpose::STANDARD.encode(views.concat());
    let buffer = json!({"byteLength": end, "uri": format!("data:;base64,{uri}")});
    json!({"asset": {"version": "2.0"}, "meshes": meshes, "buffers": [buffer], "bufferViews": all, "accessors": accessors})
        .to_string()
}

/// An accessor of floats, with the bounds that positions need.
fn accessor(view: usize, count: usize, of_type: &str) -> Value {
    json!({"bufferView": view, "componentType": 5126, "count": count, "type": of_type, "min": [0, 0, 0], "max": [1, 1, 1]})
}

/// A glTF file of points with normals and tangents.
fn framed(frames: &[[f32; 7]]) -> String {
    let normals: Vec<[f32; 3]> = frames.iter().map(|frame| std::array::from_fn(|at| frame[at])).collect();
    let tangents: Vec<[f32; 4]> =
        frames.iter().map(|frame| std::array::from_fn(|at| frame[3 + at])).collect();
    let tangent = json!({"bufferView": 1, "componentType": 5126, "count": frames.len(), "type": "VEC4"});
    gltf(
        json!([{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1}}]}]),
        &[raw(&normals), raw(&tangents)],
        json!([accessor(0, frames.len(), "VEC3"), tangent]),
    )
}

/// A glTF file with an animation of rotations: one sampler linear, the other a cubic spline, whose keys are tangent, value and
/// tangent; a channel that moves is in between.
fn animated(rotations: &[[f32; 4]]) -> String {
    let (linear, cubic) = rotations.split_at(rotations.len() / 2);
    let keys: Vec<[f32; 4]> = cubic.iter().flat_map(|q| [[7.0; 4], *q, [-7.0; 4]]).collect();
    let output = |view: usize, count: usize| json!({"bufferView": view, "componentType": 5126, "count": count, "type": "VEC4"});
    let text =
        gltf(json!([]), &[raw(linear), raw(&keys)], json!([output(0, linear.len()), output(1, keys.len())]));
    let mut document: Value = serde_json::from_str(&text).unwrap();
    let channel =
        |sampler: usize, path: &str| json!({"sampler": sampler, "target": {"node": 0, "path": path}});
    document["animations"] = json!([{
        "name": "turn",
        "channels": [channel(1, "rotation"), channel(0, "translation"), channel(0, "rotation"), channel(1, "rotation")],
        "samplers": [{"input": 0, "output": 0}, {"input": 0, "output": 1, "interpolation": "CUBICSPLINE"}],
    }]);
    document.to_string()
}

/// Raw rotations and those of a glTF animation get the same codes from every backend, and come back within the codec's error.
#[test]
fn rotations_round_trip_on_every_backend() {
    let folder = tempfile::tempdir().unwrap();
    let original: Vec<[f32; 4]> = sampling::random_rotations(13).take(20_003).collect();
    let [file, animation] = ["rotations.bin", "animation.gltf"].map(|name| folder.path().join(name));
    std::fs::write(&file, raw(&original)).unwrap();
    std::fs::write(&animation, animated(&original)).unwrap();
    for codec in rotations() {
        let (codes, back) = convert(codec.id, folder.path(), &file);
        assert!((&codes, &back) == (&convert(codec.id, folder.path(), &animation).0, &back), "{}", codec.id);
        let back: Vec<[f32; 4]> = elements(&back);
        let worst = original.iter().zip(&back).map(|(a, b)| rotation_angle_deg(*a, *b)).fold(0.0, f64::max);
        assert!(worst <= f64::from(codec.max_error_deg()), "{}: {worst}", codec.id);
    }
}

/// Raw frames and those of a glTF file get the same codes from every backend, and come back within the codec's errors.
#[test]
fn frames_round_trip_on_every_backend() {
    let folder = tempfile::tempdir().unwrap();
    let original: Vec<[f32; 7]> = sampling::random_frames(12).take(100_003).collect();
    let [file, mesh] = ["frames.bin", "frames.gltf"].map(|name| folder.path().join(name));
    std::fs::write(&file, raw(&original)).unwrap();
    std::fs::write(&mesh, framed(&original)).unwrap();
    for codec in frames() {
        let (codes, back) = convert(codec.id, folder.path(), &file);
        let of_mesh = convert(codec.id, folder.path(), &mesh);
        assert!((&codes, &back) == (&of_mesh.0, &of_mesh.1), "{}", codec.id);
        assert_eq!(codes.len(), original.len() * codec.bytes);
        let back: Vec<[f32; 7]> = elements(&back);
        for (at, bound) in [0, 3].into_iter().zip(codec.max_errors_deg) {
            let worst = worst(&original, &back, at);
            assert!(worst <= f64::from(*bound), "{}: {worst}", codec.id);
        }
        assert!(original.iter().zip(&back).all(|(a, b)| a[6] == b[6]), "{}", codec.id);
    }
}

#[test]
fn standard_streams_are_a_pipe() {
    let original: Vec<[f32; 3]> = sampling::random_directions(Domain::Sphere, 5).take(1000).collect();
    let encoded = run_with_input(["encode", "--codec", "oct32p", "-", "-"], &raw(&original));
    assert!(encoded.status.success(), "{}", stderr(&encoded));
    assert_eq!(encoded.stdout.len(), 4000);
    let decoded = run_with_input(["decode", "--codec", "oct32", "-", "-"], &encoded.stdout);
    let back: Vec<[f32; 3]> = elements(&decoded.stdout);
    assert!(original.iter().zip(&back).all(|(a, b)| angle_deg(*a, *b) < 0.0026));
    let nothing = run_with_input(["encode", "--codec", "oct16", "-", "-"], &[]);
    assert!(nothing.status.success() && nothing.stdout.is_empty());
}

/// A glTF file with two meshes. The first has normals: +X, zero and NaN. The second, `bare`, has four vertices and one
/// face, which faces -Z and does not use its second vertex.
fn two_meshes() -> String {
    let normals = raw(&[[1.0, 0.0, 0.0], [0.0; 3], [f32::NAN, 0.0, 0.0]]);
    let corners = raw(&[[0.0, 0.0, 0.0], [1.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    let normal = json!({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"});
    let indices = json!({"bufferView": 2, "componentType": 5121, "count": 3, "type": "SCALAR"});
    gltf(
        json!([
            {"primitives": [{"mode": 0, "attributes": {"POSITION": 1, "NORMAL": 0}}]},
            {"name": "bare", "primitives": [{"attributes": {"POSITION": 2}, "indices": 3}]}
        ]),
        &[normals, corners, vec![0, 2, 3]],
        json!([normal, accessor(1, 3, "VEC3"), accessor(1, 4, "VEC3"), indices]),
    )
}

/// The directions of [`two_meshes`] as a codec that keeps the axes decodes them.
const OF_TWO_MESHES: [[f32; 3]; 7] = {
    let (x, z, down) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    [x, z, z, down, z, down, down]
};

fn decoded(codes: &[u8]) -> Vec<[f32; 3]> {
    elements(&run_with_input(["decode", "--codec", "oct16", "--quiet", "-", "-"], codes).stdout)
}

/// One line gives the number and source of the vectors, and the result for those without a direction; each vertex has
/// its place.
#[test]
fn encode_says_what_it_did_with_a_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let [mesh, codes] = ["two.gltf", "codes"].map(|name| folder.path().join(name));
    std::fs::write(&mesh, two_meshes()).unwrap();
    let arguments = ["encode", "--codec", "oct16", path(&mesh), path(&codes)];
    let told = run(arguments);
    assert_eq!(
        stderr(&told),
        "7 vectors from 2 meshes, 3 without a direction (stored as +Z; the first is number 1), lengths 1.0000 to 1.0000, \
         normals computed from faces: in 1 of 2 primitives\n"
    );
    assert_eq!(stdout(&told), "");
    assert_eq!(decoded(&std::fs::read(&codes).unwrap()), OF_TWO_MESHES);
    let quiet = run([&arguments[..], &["--quiet"]].concat());
    assert!(quiet.status.success() && quiet.stderr.is_empty() && quiet.stdout.is_empty());
}

/// The mesh: four vertices, three of which a face uses, give four codes, the third that of +Z.
#[test]
fn an_unused_vertex_keeps_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let [mesh, codes] = ["four.obj", "codes"].map(|name| folder.path().join(name));
    std::fs::write(&mesh, "v 0 0 0\nv 0 1 0\nv 5 5 5\nv 1 0 0\nf 1 2 4\n").unwrap();
    let told = stderr(&run(["encode", "--codec", "oct16", path(&mesh), path(&codes)]));
    let (z, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(decoded(&std::fs::read(&codes).unwrap()), [down, down, z, down]);
    let line = "4 vectors from 1 mesh, 1 without a direction (stored as +Z; the first is number 2), lengths 1.0000 to \
        1.0000, normals computed from faces: yes\n";
    assert_eq!(told, line);
}

/// JSON has the facts of the line, and where each primitive begins. It goes where the codes do not.
#[test]
fn encode_says_it_in_json() {
    let folder = tempfile::tempdir().unwrap();
    let [mesh, codes] = ["two.gltf", "codes"].map(|name| folder.path().join(name));
    std::fs::write(&mesh, two_meshes()).unwrap();
    let encode = |out| run(["encode", "--json", "-", "--codec", "oct16", path(&mesh), out]);
    let to_file = encode(path(&codes));
    assert!(to_file.stderr.is_empty());
    let mut json: Value = serde_json::from_slice(&to_file.stdout).unwrap();
    let part = |mesh: u64, name: Value, first: u64, count: u64, computed: bool| json!({"mesh": mesh, "name": name, "primitive": 0, "first": first, "count": count, "computed": computed});
    let expected = json!({
        "input": path(&mesh), "output": path(&codes), "codec": "oct16", "element": "vector", "count": 7,
        "without_direction": 3, "first_without_direction": 1, "lengths": [1.0, 1.0], "keeps_lengths": false, "meshes": 2,
        "parts": [part(0, Value::Null, 0, 3, false), part(1, "bare".into(), 3, 4, true)],
    });
    assert_eq!(json, expected);
    let to_stdout = encode("-");
    assert_eq!(to_stdout.stdout, std::fs::read(&codes).unwrap());
    json["output"] = "-".into();
    assert_eq!(serde_json::from_slice::<Value>(&to_stdout.stderr).unwrap(), json);
}

/// The line of raw vectors and frames, of codecs that need words of their own, and of decoding.
#[test]
fn lines_of_raw_input() {
    let vectors = raw(&[[0.0f32; 3], [0.0, 0.6, -0.8], [3.0, 0.0, 0.0], [f32::NAN; 3], [0.0, 0.0, 1.0]]);
    let [normal, none] = [[0.0, 0.0, 1.0], [0.0f32; 3]];
    let frame = |normal: [f32; 3], tangent: [f32; 3]| [raw(&[normal, tangent]), raw(&[[1.0]])].concat();
    let frames = [frame(normal, none), frame(none, none), frame(normal, [1.0, 0.0, 0.0])].concat();
    for (command, codec, input, line) in [
        (
            "encode",
            "oct16",
            &vectors,
            "5 vectors, 2 without a direction (stored as +Z; the first is number 0), lengths 1.0000 to 3.0000",
        ),
        (
            "encode",
            "hemioct16",
            &vectors,
            "5 vectors, 2 without a direction (stored as +Z; the first is number 0), 1 below the equator (moved up to it), lengths 1.0000 to 3.0000",
        ),
        (
            "encode",
            "snorm8x3",
            &vectors,
            "5 vectors, 2 without a direction (stored as +Z; the first is number 0), lengths 1.0000 to 3.0000, components stored as given, clamped",
        ),
        (
            "encode",
            "hemioct16",
            &raw(&[[0.0f32, 0.0, -1.0]]),
            "1 vector, 1 without a direction (stored as +Z; the first is number 0), 0 below the equator, lengths 1.0000 to 1.0000",
        ),
        (
            "encode",
            "frame64",
            &frame([0.0, 0.6, 0.8], [0.0, 0.6, 0.8]),
            "1 frame, 0 normals without a direction, 1 tangent without a direction (stored as a perpendicular to the \
             normal; the first is number 0), lengths 1.0000 to 1.0000",
        ),
        (
            "encode",
            "snorm8x3p",
            &vectors,
            "5 vectors, 2 without a direction (stored as +Z; the first is number 0), lengths 1.0000 to 3.0000",
        ),
        (
            "encode",
            "frame32",
            &frames,
            "3 frames, 1 normal without a direction (stored as +Z; the first is number 1), 2 tangents without a direction \
             (stored as a perpendicular to the normal; the first is number 0), lengths 1.0000 to 1.0000",
        ),
        (
            "encode",
            "oct16",
            &vectors[48..].to_vec(),
            "1 vector, 0 without a direction, lengths 1.0000 to 1.0000",
        ),
        ("decode", "oct16", &vectors[..10].to_vec(), "5 vectors"),
        ("decode", "frame64", &vectors[..8].to_vec(), "1 frame"),
    ] {
        let told = run_with_input([command, "--codec", codec, "-", "-"], input);
        assert_eq!(stderr(&told).lines().next(), Some(line), "{command} {codec}");
    }
}

/// Vectors without a direction come back as zeros: a .uvec file knows it, bare codes need the option. Codecs without a
/// null code are refused.
#[test]
fn null_codes_come_back_as_zeros() {
    let folder = tempfile::tempdir().unwrap();
    let input = raw(&[[0.0f32; 3], [0.0, 0.0, -1.0], [3.0, 0.0, 0.0], [f32::NAN; 3]]);
    let codes = folder.path().join("codes.uvec");
    let encode = |out| run_with_input(["encode", "--null", "--codec", "hemioct16", "-", out], &input);
    let line = "4 vectors, 3 without a direction (2 stored as null, 1 stored as +Z; the first is number 0), 0 below \
        the equator, lengths 1.0000 to 3.0000\n";
    assert_eq!(stderr(&encode(path(&codes))), line);
    let expected = raw(&[[0.0f32; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0; 3]]);
    assert_eq!(run(["decode", path(&codes), "-"]).stdout, expected);
    let bare = encode("-").stdout;
    let decode = |null| run_with_input(["decode", null, "--codec", "hemioct16", "-", "-"], &bare).stdout;
    assert!(decode("--null") == expected && decode("--quiet") != expected);
    for codec in ["fib16", "frame32"] {
        let mut command = command(["encode", "--null", "--codec", codec, "-", "-"]);
        assert_fails(&mut command, 2, &[codec, "has no code to spare", "but latlong16, latlong24"]);
    }
}

/// The standard output is known by its other names too: the codes are appended to it, and JSON goes elsewhere.
#[test]
fn another_name_of_the_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    std::fs::write(&out, b"before").unwrap();
    let appended = std::fs::File::options().append(true).open(&out).unwrap();
    let arguments = ["encode", "--json", "-", "--codec", "oct16", "host/mesh/data/bunny.obj", "/dev/stdout"];
    let to_file = command(arguments).current_dir(repository()).stdout(appended).output().unwrap();
    let to_pipe = command(arguments).current_dir(repository()).output().unwrap();
    for output in [&to_file, &to_pipe] {
        let json: Value = serde_json::from_slice(&output.stderr).unwrap();
        assert_eq!(json["count"].as_u64().unwrap() as usize * 2, to_pipe.stdout.len());
    }
    assert_eq!(std::fs::read(&out).unwrap(), [&b"before"[..], &to_pipe.stdout].concat());
}

/// The header and the chunk of a GLB.
fn glb(json: &str) -> Vec<u8> {
    let json = format!("{json:<0$}", json.len().next_multiple_of(4));
    let [length, whole] = [json.len(), json.len() + 20].map(|length| (length as u32).to_le_bytes());
    [b"glTF", &2u32.to_le_bytes()[..], &whole, &length, b"JSON", json.as_bytes()].concat()
}

/// First bytes identify a mesh whatever its ending, and from a pipe; `--raw` takes it as floats all the same. Raw
/// floats need a known ending or `--raw`.
#[test]
fn files_are_known_by_their_first_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float nx\nproperty float ny\nproperty float nz\n\
        end_header\n1 0 0\n";
    let x = vec![[1.0, 0.0, 0.0]];
    let vrm = glb(&two_meshes());
    for (name, content, expected) in [
        ("a.vrm", &vrm[..], OF_TWO_MESHES.to_vec()),
        ("a.bin", &vrm, OF_TWO_MESHES.to_vec()),
        ("a.obj", two_meshes().as_bytes(), OF_TWO_MESHES.to_vec()),
        ("a.unknown", ply.as_bytes(), x.clone()),
        ("a.glb", ply.as_bytes(), x.clone()),
        ("a.f32", &raw(&x), x.clone()),
        ("a.RAW", &raw(&x), x),
    ] {
        let file = folder.path().join(name);
        std::fs::write(&file, content).unwrap();
        let from_file = run(["encode", "--codec", "oct16", path(&file), "-"]);
        assert_eq!(decoded(&from_file.stdout), expected, "{name}: {}", stderr(&from_file));
        let from_pipe = run_with_input(["encode", "--codec", "oct16", "-", "-"], content);
        assert_eq!(from_pipe.stdout, from_file.stdout, "{name}");
    }
    let floats = folder.path().join("a.vrm");
    std::fs::write(&floats, &vrm[..12]).unwrap();
    let told = stderr(&run(["encode", "--raw", "--codec", "oct16", path(&floats), "-"]));
    assert!(told.starts_with("1 vector, "), "{told}");
    let told = stderr(&run(["decode", "--raw", "--codec", "oct32", path(&floats), "-"]));
    assert_eq!(told, "3 vectors\n");
}

/// The output of `normals` is input of `encode`: the same codes, and the file's own normals untouched.
#[test]
fn normals_are_exported() {
    let folder = tempfile::tempdir().unwrap();
    let [two, frame_file, out] = ["two.glb", "framed.gltf", "out.bin"].map(|name| folder.path().join(name));
    std::fs::write(&two, glb(&two_meshes())).unwrap();
    let told = run(["normals", path(&two), path(&out)]);
    assert_eq!(
        stderr(&told),
        "7 vectors from 2 meshes, 3 without a direction (1 written as +Z, 2 as in the file; the first is number 1), lengths \
         1.0000 to 1.0000, normals computed from faces: in 1 of 2 primitives\n"
    );
    let normals: Vec<[f32; 3]> = elements(&std::fs::read(&out).unwrap());
    assert_eq!(normals[1], [0.0; 3]);
    assert!(normals[2][0].is_nan());
    assert_eq!((normals[0], &normals[3..]), (OF_TWO_MESHES[0], &OF_TWO_MESHES[3..]));
    let codes = |input| run(["encode", "--codec", "oct16", input, "-"]).stdout;
    assert_eq!(codes(path(&out)), codes(path(&two)));

    let original: Vec<[f32; 7]> = sampling::random_frames(3).take(10).collect();
    std::fs::write(&frame_file, framed(&original)).unwrap();
    let told = run(["normals", "--frames", "--json", "-", path(&frame_file), path(&out)]);
    assert_eq!(elements::<7>(&std::fs::read(&out).unwrap()), original);
    let json: Value = serde_json::from_slice(&told.stdout).unwrap();
    assert_eq!((&json["element"], &json["count"]), (&"frame".into(), &10.into()));
    assert_eq!((&json["written_as_z"], json["parts"].as_array().unwrap().len()), (&0.into(), 1));
    assert_eq!((&json["tangents_without_direction"], &json["codec"]), (&0.into(), &Value::Null));
    assert_eq!(run(["normals", "--quiet", path(&frame_file), "-"]).stdout.len(), 120);
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
    let row = |operation: &str| json!({"id": "ico24", "operation": operation, "backend": "rust", "alu_ratio_to_oct32": 0.1});
    let imagined = json!({"device": {"name": "imagined"}, "rows": [row("encode"), row("decode")]});
    std::fs::write(&costs, imagined.to_string()).unwrap();
    let chosen = stdout(&run(choose));
    assert!(chosen.contains("imagined") && chosen.contains("\ntake ico24: "), "{chosen}");
    let device = json!({"index": 0, "name": "a", "kind": "discrete", "driver": "b", "api_version": "1.3.0"});
    let row = json!({"id": "oct16", "operation": "encode", "source": "glsl", "inverse_throughput": 100});
    for (report, words) in [
        (json!({}), "is not a report of `unitvec bench --json`"),
        (json!({"device": device, "sources": {}, "rows": [row]}), "no inverse throughput of oct32"),
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
    let named = |row: &Value| ["id", "operation", "backend"].map(|key| row[key].as_str().unwrap().to_owned());
    let names: Vec<String> = rows.iter().map(|row| named(row).join(" ")).collect();
    for id in ["oct16", "snorm8x3p", "frame64"] {
        for kind in ["encode rust", "encode glsl", "decode rust", "decode glsl"] {
            assert!(names.contains(&format!("{id} {kind}")), "{id} {kind}");
        }
    }
    let by_table = |row: &&Value| row["by_table"] == true;
    let by_table: Vec<String> = rows.iter().filter(by_table).map(|row| named(row).join(" ")).collect();
    assert_eq!(by_table, ["oct16 decode rust"]);
    assert_eq!(rows.len(), 13);
    for row in rows {
        assert!(
            row["vectors_per_s"].as_f64().unwrap() > 0.0 && row["copy_bytes_per_s"].as_f64().unwrap() > 0.0
        );
        assert_eq!(row["alu_ns_per_vector"].is_number(), row["by_table"] == false, "{row}");
    }
    assert_eq!(rows[0]["survey_ns_per_vector"].as_f64(), Some(0.023132));
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
        assert_eq!(row["alu_ratio_to_oct32"].is_number(), row["backend"] == "glsl", "{row}");
    }
    let chosen = json(&format!("choose --max-error 1 --bits 16 --json - --costs {}", path(&costs)));
    let first = &chosen["candidates"][0];
    assert_eq!((&first["id"], first["encode_cost"].is_number()), (&json!("oct16"), true));
    let mut without = command(few.split(' ').chain(["--cost-kernels", path(&none)]));
    assert_fails(&mut without, 1, &["`cargo xtask spirv --cost` builds it"]);
}
