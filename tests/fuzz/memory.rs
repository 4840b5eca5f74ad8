//! The memory that readers take: at most four times the file's size, or four times that of its vectors as f32 where that is
//! more, and a fixed amount.
//!
//! The files here take the most: they have the shortest lines and the smallest types.

use super::{FIXED, ZEROS, seeds};
use base64::Engine;
use std::path::Path;
use unitvec_mesh as mesh;
use unitvec_mesh::{FileFormat, Reach};
use unitvec_tests::repository;

/// The size of which four times is allowed: compact files hold vectors in fewer bytes than f32 take.
pub fn size(file: usize, vectors: usize) -> usize {
    file.max(12 * vectors)
}

/// The reason why the most memory that was in use at a time, with the file itself, is too much.
pub fn check(peak: usize, file: usize, vectors: usize, slack: usize) -> Result<(), String> {
    let most = 4 * size(file, vectors) + slack;
    match peak <= most {
        true => Ok(()),
        false => {
            Err(format!("{peak} bytes of memory for a file of {file} with {vectors} vectors: over {most}"))
        }
    }
}

/// Vertices of the files; a count that no vector's growth by doubling fits.
const COUNT: usize = 70_001;

/// Reads a file. Returns the most memory that was in use at a time, with the file itself.
fn peak(path: &Path, bytes: &[u8], expected: Option<usize>) -> usize {
    let mut read = None;
    let memory = allocation_counter::measure(|| {
        let format = FileFormat::of(path, bytes).unwrap();
        read = Some(mesh::parse(path, format, bytes, Reach::Folder).map(|mesh| mesh.normals.len()));
    });
    let vectors = read.as_ref().and_then(|read| read.as_ref().ok().copied());
    assert_eq!(vectors, expected, "{}: {read:?}", path.display());
    let moving = allocation_counter::measure(|| {
        let format = FileFormat::of(path, bytes).unwrap();
        let change = &mut |_, _, _: &mut [[f32; 3]]| ();
        let _ = mesh::edit::edit(path, format, bytes, Reach::Folder, mesh::edit::Change::Vectors(change));
    });
    bytes.len() + memory.bytes_max.max(moving.bytes_max) as usize
}

/// Reads a file of so many vectors, or of none that can be read, and checks the memory.
fn measure(name: &str, bytes: &[u8], expected: Option<usize>) {
    let (peak, vectors) = (peak(Path::new(name), bytes, expected), expected.unwrap_or(0));
    let slack = if name.contains(".gl") { FIXED + ZEROS } else { FIXED };
    check(peak, bytes.len(), vectors, slack).unwrap_or_else(|reason| panic!("{name}: {reason}"));
    let ratio = peak as f64 / size(bytes.len(), vectors) as f64;
    println!("memory: {name} of {} bytes, {vectors} vectors: {ratio:.2} times", bytes.len());
}

#[test]
fn obj_of_short_lines() {
    let vertices = "v 0 0 1\n".repeat(COUNT) + "v 1 0 0\nv 0 1 0\n";
    measure("vertices.obj", format!("{vertices}f 1 -1 -2\n").as_bytes(), Some(COUNT + 2));
    measure("faces.obj", format!("v 0 0 0\n{}", "f 1 1 1\n".repeat(COUNT)).as_bytes(), Some(1));
    measure("polygon.obj", format!("v 0 0 0\nf{}\n", " 1".repeat(COUNT)).as_bytes(), Some(1));
    measure("normals.obj", "vn 0 0 1\n".repeat(COUNT).as_bytes(), Some(COUNT));
    measure("lines.obj", "v\n".repeat(COUNT).as_bytes(), None);
    measure("empty.obj", "\n".repeat(COUNT).as_bytes(), None);
    measure("line.obj", format!("v {}", "1".repeat(COUNT)).as_bytes(), None);
    measure("latin.obj", &b"v \xff\xff\xff\n".repeat(COUNT), None);
}

#[test]
fn ply_of_small_types() {
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    let file = |format: &str, elements: &str, payload: &[u8]| {
        [format!("ply\nformat {format} 1.0\n{elements}end_header\n").as_bytes(), payload].concat()
    };
    let vertices = format!("element vertex {COUNT}\n{xyz}");
    let one_face = "element face 1\nproperty list uchar int vertex_indices\n";
    let (little, big) = (seeds::PLY_FORMATS[1], seeds::PLY_FORMATS[2]);
    let payload = [&vec![0; 12 * COUNT][..], &[3], &[0; 12]].concat();
    measure("vertices.ply", &file(little, &format!("{vertices}{one_face}"), &payload), Some(COUNT));
    let text = "0 0 0\n".repeat(COUNT) + "3 0 1 2\n";
    let ascii = file("ascii", &format!("{vertices}{one_face}"), text.as_bytes());
    measure("ascii.ply", &ascii, Some(COUNT));
    let faces =
        format!("element vertex 1\n{xyz}element face {COUNT}\nproperty list uchar uchar vertex_indices\n");
    let payload = [&[0; 12][..], &[3, 0, 0, 0].repeat(COUNT)].concat();
    measure("faces.ply", &file(big, &faces, &payload), Some(1));
    let empty = [&[0; 12][..], &vec![0; COUNT], &[3, 0, 0, 0]].concat();
    let faces = faces.replace(&COUNT.to_string(), &(COUNT + 1).to_string());
    measure("empty_faces.ply", &file(big, &faces, &empty), Some(1));
    let polygon = format!("element vertex 1\n{xyz}element face 1\nproperty list uint uchar vertex_indices\n");
    let payload = [&[0; 12][..], &(COUNT as u32).to_le_bytes(), &vec![0; COUNT]].concat();
    measure("polygon.ply", &file(little, &polygon, &payload), Some(1));
    let normals = format!("element vertex {COUNT}\n{}", xyz.replace("float ", "char n"));
    measure("normals.ply", &file(little, &normals, &vec![1; 3 * COUNT]), Some(COUNT));
    let comments = format!("element vertex 0\n{}", "element a 0\n".repeat(COUNT));
    measure("header.ply", &file(little, &comments, &[]), None);
}

/// A document with one buffer of so many bytes, in one view of a stride, and accessors and primitives as given.
fn document(length: usize, stride: usize, accessors: &str, primitives: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length}}}],"bufferViews":[{{"buffer":0,
        "byteLength":{length}}},{{"buffer":0,"byteLength":{length},"byteStride":{stride}}}],
        "accessors":[{accessors}],"meshes":[{{"primitives":[{primitives}]}}]}}"#
    )
}

fn accessor(view: usize, kind: &str) -> String {
    format!(r#"{{"bufferView":{view},{kind},"count":{COUNT},"type":"VEC3","min":[0,0,0],"max":[1,1,1]}}"#)
}

const FLOATS: &str = r#""componentType":5126"#;
const BYTES: &str = r#""componentType":5120,"normalized":true"#;
const WITH_NORMALS: &str = r#"{"attributes":{"POSITION":0,"NORMAL":1}}"#;
const WITHOUT: &str = r#"{"attributes":{"POSITION":0}}"#;

#[test]
fn gltf_of_small_types() {
    let floats = vec![0; 12 * COUNT];
    let json = document(floats.len(), 12, &accessor(0, FLOATS), WITHOUT);
    measure("faces.glb", &seeds::glb_of(&json, &floats), Some(COUNT));
    let both = [accessor(0, FLOATS), accessor(1, FLOATS)].join(",");
    let json = document(floats.len(), 12, &both, WITH_NORMALS);
    measure("normals.glb", &seeds::glb_of(&json, &floats), Some(COUNT));
    let inside = base64::engine::general_purpose::STANDARD.encode(&floats);
    let uri = format!(r#""byteLength":{},"uri":"data:;base64,{inside}""#, floats.len());
    let json = json.replacen(&format!(r#""byteLength":{}"#, floats.len()), &uri, 1);
    measure("inside.gltf", json.as_bytes(), Some(COUNT));
    let both = [accessor(1, BYTES), accessor(1, BYTES)].join(",");
    let json = document(4 * COUNT, 4, &both, WITH_NORMALS);
    measure("bytes.glb", &seeds::glb_of(&json, &vec![1; 4 * COUNT]), Some(COUNT));
    let json = document(4 * COUNT, 4, &accessor(1, BYTES), WITHOUT);
    measure("bytes_faces.glb", &seeds::glb_of(&json, &vec![1; 4 * COUNT]), Some(COUNT));
}

/// Files that ask for more memory than they have bytes for: accessors over the same bytes, and over none.
#[test]
fn gltf_that_asks_for_more() {
    let bin = vec![0; 4 * COUNT];
    let primitives = |count: usize| {
        let one = |k: usize| format!(r#"{{"attributes":{{"POSITION":0,"NORMAL":{k}}}}}"#);
        (1..count).map(one).collect::<Vec<_>>().join(",")
    };
    let same = vec![accessor(1, BYTES); 100].join(",");
    measure("overlapping.glb", &seeds::glb_of(&document(bin.len(), 4, &same, &primitives(100)), &bin), None);
    let zeros =
        vec![format!(r#"{{{FLOATS},"count":{},"type":"VEC3","min":[0,0,0],"max":[0,0,0]}}"#, 1 << 15); 100];
    measure(
        "zeros.gltf",
        document(1, 4, &zeros.join(","), &primitives(100)).replace("},{\"b", "},{ \"b").as_bytes(),
        None,
    );
}

/// Parts of documents that normals do not depend on are not kept.
#[test]
fn gltf_of_many_nodes() {
    for part in ["nodes", "materials", "images", "scenes", "skins", "samplers"] {
        let json = format!(r#"{{"asset":{{"version":"2.0"}},"{part}":[{}{{}}]}}"#, "{},".repeat(COUNT));
        measure(&format!("{part}.gltf"), json.as_bytes(), None);
    }
}

/// The exception: a document of nothing but the shortest objects takes [`OBJECTS`] times its text, since each becomes a
/// structure of the parser's. In files with vertices the objects are few.
#[test]
fn gltf_of_many_objects() {
    const OBJECTS: usize = 24;
    let promised = std::fs::read_to_string(repository().join("host/program/README.md")).unwrap();
    assert!(promised.contains(&format!("up to {OBJECTS} times for a glTF document")));
    let list = |object: &str| vec![object; COUNT].join(",");
    for (name, part) in [
        (
            "accessors",
            format!(r#""accessors":[{}]"#, list(r#"{"componentType":5126,"count":1,"type":"VEC3"}"#)),
        ),
        (
            "bounds",
            format!(
                r#""accessors":[{{"componentType":5126,"count":1,"type":"VEC3","min":[{}]}}]"#,
                list("0")
            ),
        ),
        ("primitives", format!(r#""meshes":[{{"primitives":[{}]}}]"#, list(r#"{"attributes":{}}"#))),
        (
            "attributes",
            format!(r#""meshes":[{{"primitives":[{}]}}]"#, list(r#"{"attributes":{"POSITION":0}}"#)),
        ),
        (
            "targets",
            format!(r#""meshes":[{{"primitives":[{{"attributes":{{}},"targets":[{}]}}]}}]"#, list("{}")),
        ),
        ("meshes", format!(r#""meshes":[{}]"#, list(r#"{"primitives":[]}"#))),
        ("views", format!(r#""bufferViews":[{}]"#, list(r#"{"buffer":0,"byteLength":1}"#))),
        ("buffers", format!(r#""buffers":[{}]"#, list(r#"{"byteLength":1}"#))),
        ("extensions", format!(r#""extensionsRequired":[{}]"#, list(r#""""#))),
    ] {
        let json = format!(r#"{{"asset":{{"version":"2.0"}},{part}}}"#);
        let peak = peak(Path::new("a.gltf"), json.as_bytes(), None);
        println!("memory: {name} of {} bytes: {:.2} times", json.len(), peak as f64 / json.len() as f64);
        assert!(peak <= OBJECTS * json.len(), "{name}: {peak} bytes of memory for {}", json.len());
    }
}
