//! The program's conversions: `encode`, `decode` and `normals`, from and to files and streams.

use crate::faults::assert_fails;
use base64::Engine;
use serde_json::{Value, json};
use std::path::Path;
use unitvec::{angle_deg, rotation_angle_deg};
use unitvec_catalogue::{Domain, frames, rotations, vectors};
use unitvec_run::sampling;
use unitvec_tests::program::{self, command, run, run_with_input, stderr, stdout};
use unitvec_tests::{BACKENDS, repository};

fn raw<const N: usize>(elements: &[[f32; N]]) -> Vec<u8> {
    program::raw(elements.as_flattened())
}

fn elements<const N: usize>(raw: &[u8]) -> Vec<[f32; N]> {
    let components: Vec<f32> =
        raw.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect();
    components.chunks_exact(N).map(|element| element.try_into().unwrap()).collect()
}

pub fn path(path: &Path) -> &str {
    path.to_str().unwrap()
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
pub fn two_meshes() -> String {
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
