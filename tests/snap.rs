//! `unitvec snap`: files whose vectors moved, and in which nothing else did.

use crate::faults::{assert_fails, fails};
use crate::fuzz::seeds::{PLY_FORMATS, glb_of};
use base64::Engine;
use serde_json::{Value, json};
use std::path::Path;
use unitvec_catalogue::{AnyCodec, Element, find, find_any};
use unitvec_mesh as mesh;
use unitvec_mesh::{BUNNY, FileFormat, Reach, has_direction};
use unitvec_run::sampling;
use unitvec_tests::names;
use unitvec_tests::program::{command, raw, stderr, stdout};

/// Frames, one without a direction, one with NaN, and one without a tangent.
pub fn frames() -> Vec<[f32; 7]> {
    let mut frames: Vec<[f32; 7]> = sampling::random_frames(7).take(40).collect();
    frames[3][..3].fill(0.0);
    frames[5][1] = f32::NAN;
    frames[8][3..6].fill(0.0);
    frames
}

/// A vector as a codec decodes it, unless it has no direction.
fn decoded(codec: &AnyCodec, vector: [f32; 3]) -> [f32; 3] {
    if has_direction(vector) { codec.decode_one(codec.encode_one(vector)) } else { vector }
}

/// The frames as they should be moved.
fn snapped(codec: &AnyCodec, frames: &[[f32; 7]]) -> Vec<[f32; 7]> {
    let snap = |frame: &[f32; 7]| {
        let [normal, tangent] = [0, 3].map(|at| [frame[at], frame[at + 1], frame[at + 2]]);
        let [normals, tangents] = [normal, tangent].map(has_direction);
        let mut moved: [f32; 7] = match codec.element {
            Element::Frame => codec.decode_one(codec.encode_one(*frame)),
            Element::Vector | Element::Rotation => {
                let [[a, b, c], [d, e, f]] = [normal, tangent].map(|vector| decoded(codec, vector));
                [a, b, c, d, e, f, frame[6]]
            }
        };
        let is_of_frame = codec.element == Element::Frame;
        if !normals {
            moved[..3].copy_from_slice(&normal);
        }
        if !tangents || (is_of_frame && !normals) {
            moved[3..6].copy_from_slice(&tangent);
        }
        moved
    };
    frames.iter().map(snap).collect()
}

/// The least and greatest components of vectors, as JSON.
fn bounds<const N: usize>(frames: &[[f32; 7]], at: usize) -> String {
    let all = |component: usize| frames.iter().map(move |frame| frame[at + component]);
    let side = |pick: fn(f32, f32) -> f32| {
        (0..N).map(|n| all(n).reduce(pick).unwrap().to_string()).collect::<Vec<_>>().join(", ")
    };
    format!(r#""min": [{}], "max":[{}]"#, side(f32::min), side(f32::max))
}

/// A document of a mesh: normals and positions take turns, and the tangents come after them.
fn document(frames: &[[f32; 7]], uri: &str) -> (String, Vec<u8>) {
    let turns = frames.iter().flat_map(|frame| raw(&[&[1.0, 2.0, 3.0], &frame[..3]].concat()));
    let tangents = frames.iter().flat_map(|frame| raw(&frame[3..]));
    let buffer: Vec<u8> = turns.chain(tangents).chain([1, 2, 3]).collect();
    let (count, turns) = (frames.len(), 24 * frames.len());
    let kind = format!(r#""componentType":5126, "count":{count}"#);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},  "unknown":[1.50,{{"min":[0.10]}}], "meshes":[{{"name":"m\u00e9","primitives":[
        {{"attributes":{{"POSITION":0,"NORMAL":1,"TANGENT":2}}}},{{"attributes":{{"NORMAL":1,"POSITION":0,"TANGENT":2}}}}]}}],
        "buffers":[{{"byteLength":{}{uri}}}],"bufferViews":[{{"buffer":0,"byteLength":{turns},"byteStride":24}},
        {{"buffer":0,"byteOffset":{turns},"byteLength":{}}}],"accessors":[
        {{"bufferView":0,{kind},"type":"VEC3","min":[1,2,3],"max":[1,2,3]}},
        {{"bufferView":0,"byteOffset":12,{kind},"type":"VEC3", {}}},
        {{"bufferView":1,{kind},"type":"VEC4",{} }}]}}"#,
        buffer.len() - 3,
        16 * count,
        bounds::<3>(frames, 0),
        bounds::<4>(frames, 3),
    );
    (json, buffer)
}

/// Files of the same name, the first of which names the others.
pub type Files = Vec<(&'static str, Vec<u8>)>;

fn glb(frames: &[[f32; 7]]) -> Files {
    let (json, buffer) = document(frames, "");
    vec![("a.glb", glb_of(&json, &buffer))]
}

fn inside(frames: &[[f32; 7]]) -> Files {
    let data = base64::engine::general_purpose::STANDARD.encode(document(frames, "").1);
    vec![("a.gltf", document(frames, &format!(r#","uri":"data:;base64,{data}""#)).0.into())]
}

/// A buffer in a folder, and a picture.
fn outside(frames: &[[f32; 7]]) -> Files {
    let (json, buffer) = document(frames, r#","uri":"./b/a%20b.bin""#);
    let json = json.replace(r#""meshes""#, r#""images":[{"uri":"p.png"},{"uri":"absent.png"}],"meshes""#);
    vec![("a.gltf", json.into()), ("b/a b.bin", buffer), ("p.png", b"png".to_vec())]
}

pub fn obj(frames: &[[f32; 7]]) -> Files {
    let line = |[x, y, z, ..]: &[f32; 7]| format!("v 1.0 2 3\r\n  vn\t{x} {y}  {z} 1 # n\r\n");
    let lines: String = frames.iter().map(line).collect();
    vec![("a.obj", [b"\xef\xbb\xbf# caf\xe9\n", lines.as_bytes(), b"f 1//1 2//2 3//3"].concat())]
}

/// The bytes of a number in a binary PLY file.
fn binary(format: &str, kind: &str, c: f32) -> Vec<u8> {
    match (format == PLY_FORMATS[2], kind) {
        (true, "double") => f64::from(c).to_be_bytes().into(),
        (true, _) => c.to_be_bytes().into(),
        (false, "double") => f64::from(c).to_le_bytes().into(),
        (false, _) => c.to_le_bytes().into(),
    }
}

/// Floats or doubles out of order, behind a list.
fn ply(format: &str, frames: &[[f32; 7]], kind: &str) -> Files {
    let mut body = Vec::new();
    for [x, y, z, ..] in frames {
        // The parser takes no NaN as text.
        let is_left_out = format == "ascii" && [x, y, z].iter().any(|c| c.is_nan());
        let normal = if is_left_out { [0.0; 3] } else { [*z, *x, *y] };
        if format == "ascii" {
            body.extend(format!("2 0.50 1 {} 7.0 {}  {}\n", normal[0], normal[1], normal[2]).bytes());
            continue;
        }
        let float = |c| binary(format, "float", c);
        let [z, x, y] = normal.map(|c| binary(format, kind, c));
        body.extend([vec![2], float(0.5), float(1.0), z, float(7.0), x, y].concat());
    }
    let header = format!(
        "ply\nformat {format} 1.0\ncomment c\nelement vertex {}\nproperty list uchar float w\nproperty {kind} nz\n\
         property float q\nproperty {kind} nx\nproperty {kind} ny\nend_header\n",
        frames.len()
    );
    vec![("a.ply", [header.as_bytes(), &body].concat())]
}

/// Makes a container of frames.
pub type Make = Box<dyn Fn(&[[f32; 7]]) -> Files>;

pub fn containers() -> Vec<Make> {
    let plys = PLY_FORMATS.into_iter().flat_map(|format| ["float", "double"].map(|kind| (format, kind)));
    let plys = plys.map(|(format, kind)| -> Make { Box::new(move |frames| ply(format, frames, kind)) });
    [glb, inside, outside, obj].into_iter().map(|make| -> Make { Box::new(make) }).chain(plys).collect()
}

pub fn write(folder: &Path, files: &Files) {
    for (name, content) in files {
        std::fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        std::fs::write(folder.join(name), content).unwrap();
    }
}

/// Runs a line in a folder. Returns the standard error of a success.
pub fn succeeds(folder: &Path, line: &str) -> String {
    let output = command(line.split(' ')).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    stderr(&output) + &stdout(&output)
}

fn normals(folder: &Path, name: &str) -> Vec<[f32; 3]> {
    let (path, bytes) = (folder.join(name), std::fs::read(folder.join(name)).unwrap());
    let format = FileFormat::of(&path, &bytes).unwrap();
    mesh::parse(&path, format, &bytes, Reach::Folder).unwrap().normals
}

/// Each container becomes the same container of the moved vectors, to the byte; and stays as it is when moved again. The
/// plain encoder finds the codes that the precise one finds of the originals.
#[test]
fn only_the_vectors_move() {
    for make in containers() {
        let files = make(&frames());
        let is_gltf = files[0].0.starts_with("a.gl");
        for codec in ["oct16p", "oct32", "frame32"].iter().filter(|id| is_gltf || **id != "frame32") {
            let folder = tempfile::tempdir().unwrap();
            let (codec, name) = (find(codec).unwrap(), files[0].0);
            write(&folder.path().join("in"), &files);
            for out in ["out", "again"] {
                std::fs::create_dir(folder.path().join(out)).unwrap();
            }
            succeeds(folder.path(), &format!("snap --for {} in/{name} out/{name}", codec.id));
            succeeds(folder.path(), &format!("snap --for {} out/{name} again", codec.id));
            for (name, expected) in make(&snapped(codec, &frames())) {
                for out in ["out", "again"] {
                    let read = std::fs::read(folder.path().join(out).join(name)).unwrap();
                    assert!(read == expected, "{} {name}: {}", codec.id, String::from_utf8_lossy(&read));
                }
            }
            let [before, after] = ["in", "out"].map(|one| normals(&folder.path().join(one), name));
            if codec.element == Element::Vector {
                let plain = find(codec.id.trim_end_matches('p')).unwrap();
                for (before, after) in before.into_iter().zip(after) {
                    assert_eq!(decoded(codec, before).map(f32::to_bits), after.map(f32::to_bits));
                    assert_eq!(
                        [codec, plain].map(|codec| codec.encode_one(after)),
                        [codec.encode_one(before); 2]
                    );
                }
            }
        }
    }
}

/// Splats in a PLY file: other properties before, between and after the components of their rotations.
fn splats(format: &str, kind: &str, rotations: &[[f32; 4]]) -> Vec<u8> {
    let numbers = |q: &[f32; 4]| [0.5, q[3], q[0], 7.0, q[1], q[2], -1.0];
    let names = ["x", "rot_0", "rot_1", "opacity", "rot_2", "rot_3", "scale_0"];
    let names = names.map(|name| format!("property {kind} {name}\n")).concat();
    let header = format!("ply\nformat {format} 1.0\nelement vertex {}\n{names}end_header\n", rotations.len());
    // As text, the shorter of the two.
    let text = |c: f32| [format!("{c} "), format!("{c:e} ")].into_iter().min_by_key(String::len).unwrap();
    let number = |c| if format == "ascii" { text(c).into_bytes() } else { binary(format, kind, c) };
    let end: &[u8] = if format == "ascii" { b"\n" } else { b"" };
    let rows = rotations.iter().flat_map(|q| [&numbers(q).map(number).concat()[..], end].concat());
    header.into_bytes().into_iter().chain(rows).collect()
}

/// Rotations of splats become those that they are decoded to, or that a format's encoder writes better; of no length, and all
/// else, they stay. Codes of rotations go back into the file.
#[test]
fn rotations_of_splats_move() {
    let mut rotations: Vec<[f32; 4]> = sampling::random_rotations(7).take(40).collect();
    rotations[3] = [0.0; 4];
    rotations[5] = rotations[5].map(|c| 4.0 * c);
    for (format, kind) in
        PLY_FORMATS.into_iter().flat_map(|format| ["float", "double"].map(|kind| (format, kind)))
    {
        for id in ["sog", "spz", "quat32"] {
            let folder = tempfile::tempdir().unwrap();
            write(folder.path(), &vec![("a.ply", splats(format, kind, &rotations))]);
            let told = succeeds(folder.path(), &format!("snap --for {id} a.ply b.ply"));
            assert!(told.starts_with("mesh 0: 40 rotations, 1 left as they are, moved by "), "{told}");
            assert_eq!(told.contains("the format's own encoder is off by"), id != "quat32", "{told}");
            let codec = find_any(id).unwrap();
            let expected: Vec<[f32; 4]> = rotations.iter().map(|q| codec.snapped(*q)).collect();
            let decoded: [f32; 4] = codec.decode_one(codec.encode_one(rotations[5]));
            assert!(expected[3] == rotations[3] && (id != "quat32" || expected[5] == decoded));
            let read = std::fs::read(folder.path().join("b.ply")).unwrap();
            assert!(read == splats(format, kind, &expected), "{id} {format} {kind}");
        }
        let (folder, codec) = (tempfile::tempdir().unwrap(), find("quat32").unwrap());
        write(folder.path(), &vec![("a.ply", splats(format, kind, &rotations))]);
        succeeds(folder.path(), "encode --codec quat32 a.ply a.uvec");
        succeeds(folder.path(), "decode --into a.ply a.uvec b.ply");
        let expected: Vec<[f32; 4]> =
            rotations.iter().map(|q| codec.decode_one(codec.encode_one(*q))).collect();
        assert!(std::fs::read(folder.path().join("b.ply")).unwrap() == splats(format, kind, &expected));
    }
}

/// Rotations of splats in glTF become those that they are decoded to, and so do their bounds; normals beside them stay. Codes
/// of rotations go back into the file.
#[test]
fn rotations_of_splats_in_gltf_move() {
    let codec = find("quat32").unwrap();
    let rotation = |frame: &[f32; 7]| -> [f32; 4] { codec.snapped([3, 4, 5, 6].map(|at| frame[at])) };
    let moved =
        |frame: &[f32; 7]| std::array::from_fn(|i| if i < 3 { frame[i] } else { rotation(frame)[i - 3] });
    let moved: Vec<[f32; 7]> = frames().iter().map(moved).collect();
    for make in [inside, outside] {
        let splats = |frames: &[[f32; 7]]| {
            let mut files = make(frames);
            let text = String::from_utf8(std::mem::take(&mut files[0].1)).unwrap();
            files[0].1 = text.replace("TANGENT", "KHR_gaussian_splatting:ROTATION").into_bytes();
            files
        };
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &splats(&frames()));
        std::fs::create_dir(folder.path().join("out")).unwrap();
        let told = succeeds(folder.path(), "snap --for quat32 a.gltf out");
        assert!(told.starts_with("mesh 0 (mé): 40 rotations, 0 left as they are, moved by "), "{told}");
        std::fs::create_dir(folder.path().join("into")).unwrap();
        succeeds(folder.path(), "encode --codec quat32 a.gltf a.uvec");
        succeeds(folder.path(), "decode --into a.gltf a.uvec into");
        for (name, expected) in splats(&moved) {
            for out in ["out", "into"] {
                let read = std::fs::read(folder.path().join(out).join(name)).unwrap();
                assert!(read == expected, "{name}: {}", String::from_utf8_lossy(&read));
            }
        }
    }
}

/// Rows of counts and angles, and warnings; files of a folder, of which one fails.
#[test]
fn what_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let [(_, json), others @ ..] = &outside(&frames())[..] else { panic!() };
    let targets = String::from_utf8(json.clone())
        .unwrap()
        .replace(r#""TANGENT":2}},{"#, r#""TANGENT":2},"targets":[{"NORMAL":0}]},{"#);
    write(folder.path(), &[&[("in/a.gltf", targets.into_bytes())], &obj(&frames())[..]].concat());
    write(&folder.path().join("in"), &others.to_vec());
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let told = succeeds(folder.path(), "snap --for frame32 --json - in/a.gltf out");
    let told: Value = serde_json::from_str(&told).unwrap();
    let (row, mean) = (&told[0]["rows"][1], told[0]["rows"][0]["moved"]["mean_deg"].as_f64().unwrap());
    let counts = ["mesh", "name", "part", "vectors", "left_alone"].map(|key| row[key].clone());
    assert_eq!(json!(counts), json!([0, "m\u{e9}", "tangent", 40, 3]));
    assert!(mean > 0.0 && mean < told[0]["rows"][0]["moved"]["max_deg"].as_f64().unwrap());
    assert_eq!(
        told[0]["warnings"],
        json!(["primitives that have morph targets, which are left as they are: 1"])
    );
    let told = succeeds(folder.path(), "snap --for hemioct16 a.obj out");
    assert!(told.contains("mesh 0: 40 normals, 2 left as they are, moved by "), "{told}");
    assert!(told.lines().nth(1).unwrap().contains("the codec is for z >= 0 only"), "{told}");
    assert_eq!(names(&folder.path().join("out")), ["a.gltf", "a.obj", "b", "p.png"]);
    // Two that share a buffer: the second would replace what the first wrote.
    std::fs::copy(folder.path().join("in/a.gltf"), folder.path().join("in/c.gltf")).unwrap();
    let output = command("snap --for oct16 in out".split(' ')).current_dir(folder.path()).output().unwrap();
    assert!(stderr(&output).contains("b/a b.bin would replace a file that this run"), "{}", stderr(&output));
    assert!(!folder.path().join("out/c.gltf").exists());
    // So would a mesh of another name in a later run; one that replaces its own output would not.
    let written = std::fs::read(folder.path().join("out/b/a b.bin")).unwrap();
    let mut later = command("snap --for oct20 in/a.gltf out/other.gltf".split(' '));
    assert_fails(
        later.current_dir(folder.path()),
        2,
        &["b/a b.bin would replace", "there already", "another folder"],
    );
    assert_eq!(std::fs::read(folder.path().join("out/b/a b.bin")).unwrap(), written);
    succeeds(folder.path(), "snap --for oct20 in/a.gltf out");
    // Buffers of a later input are no place for those of an earlier one.
    std::fs::create_dir(folder.path().join("a")).unwrap();
    write(&folder.path().join("a"), &outside(&frames()));
    std::fs::rename(folder.path().join("a/a.gltf"), folder.path().join("a/z.gltf")).unwrap();
    let mut both = command("snap --for oct16 a/z.gltf in/a.gltf in".split(' '));
    assert_fails(both.current_dir(folder.path()), 2, &["in/a.gltf is the input"]);
    let mut both = command("snap --for oct16 a/z.gltf in/c.gltf in/b".split(' '));
    both.current_dir(folder.path()).status().unwrap();
    assert_eq!(std::fs::read(folder.path().join("in/b/a b.bin")).unwrap(), others[0].1);
}

/// Files that cannot be moved in place: what is in the way, and the remedy. Nothing is written.
#[test]
fn refusals() {
    let text = String::from_utf8(inside(&frames()).remove(0).1).unwrap();
    let gltf = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1).into_bytes()
    };
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty char nx\nproperty char ny\nproperty char nz\nend_header\n0 0 1\n";
    let sparse =
        r#""sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}},"#;
    for (name, content, codec, words) in [
        ("a.obj", BUNNY.to_vec(), "oct16", ["there are no normals", "export the mesh with normals"]),
        ("a.obj", obj(&frames()).remove(0).1, "frame32", ["a normal and a tangent", ".glb"]),
        ("a.ply", ply.into(), "oct16", ["quantised already", "before it is quantised"]),
        ("a.ply", ply.replace("nx", "x").into(), "oct16", ["no normals", "export"]),
        ("a.ply", ply.into(), "spz", ["only rotations of splats", "rot_0 to rot_3"]),
        ("a.obj", BUNNY.to_vec(), "quat32", ["only rotations of splats", "a .ply"]),
        ("a.gltf", gltf(r#""NORMAL":1,"#, ""), "frame32", ["primitive 0 of mesh 0", "export"]),
        (
            "a.gltf",
            gltf(
                "5126, \"count\":40,\"type\":\"VEC4\"",
                "5120,\"normalized\":true,\"count\":40,\"type\":\"VEC4\"",
            ),
            "oct16",
            ["accessor 2 has integers", "before it is quantised"],
        ),
        (
            "a.gltf",
            gltf(r#"":12,"#, &format!(r#"":12,{sparse}"#)),
            "oct16",
            ["accessor 1 is sparse", "export"],
        ),
        (
            "a.gltf",
            gltf(r#""POSITION":0"#, r#""POSITION":1"#),
            "oct16",
            ["accessor 1 shares bytes", "of its own"],
        ),
        (
            "a.gltf",
            gltf(r#""byteOffset":12"#, r#""byteOffset":8"#),
            "oct16",
            ["accessor 0 shares bytes", "of its own"],
        ),
        (
            "a.gltf",
            gltf("{", r#"{"extensionsUsed":["EXT_meshopt_compression"],"#),
            "oct16",
            ["meshoptimizer", "decompress"],
        ),
    ] {
        fails(
            &[(name, &content)],
            &format!("snap --for {codec} {name} out"),
            1,
            &[&[name], &words[..]].concat(),
        );
    }
    let (json, buffer) = document(&frames(), r#","uri":"a.bin""#);
    let files: [(&str, &[u8]); 2] = [("a.bin", &buffer), ("a.gltf", json.as_bytes())];
    for (out, words) in [
        ("a.gltf", "is the input"),
        ("a.glb", "the same ending"),
        ("b.gltf", "the buffer a.bin would replace a file"),
        ("-", "the buffer a.bin cannot lie beside"),
    ] {
        fails(&files, &format!("snap --for oct16 a.gltf {out}"), 2, &[words]);
    }
    fails(&files, "snap --for oct16 a.gltf a.bin", 1, &["another name"]);
}
