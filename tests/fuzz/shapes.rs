//! Files whose cost is a product of two of their counts, a few of which once took gigabytes or minutes. Each is read or
//! refused within the memory of [`memory`](super::memory) and a second for each MB, in the tests' unoptimised build.

use super::{FIXED, INSTRUCTIONS, LIST, ZEROS, cpu_seconds, memory, seeds};
use std::path::Path;
use unitvec_mesh as mesh;
use unitvec_mesh::{FileFormat, Mesh, MeshError, Reach};

/// Reads a file, of so many bytes with those beside it, and checks what that took. Returns the result.
fn cost<T>(name: &str, size: usize, slack: usize, read: impl FnOnce() -> T, vectors: fn(&T) -> usize) -> T {
    let (before, mut result) = (cpu_seconds(), None);
    let memory = allocation_counter::measure(|| result = Some(read()));
    let (seconds, result) = (cpu_seconds() - before, result.unwrap());
    let peak = size + memory.bytes_max as usize;
    memory::check(peak, size, vectors(&result), slack).unwrap_or_else(|reason| panic!("{name}: {reason}"));
    println!("shapes: {name} of {size} bytes: {seconds:.2} s, {peak} bytes of memory");
    assert!(seconds < 0.5 + size as f64 / 1e6, "{name}: {seconds} s for {size} bytes");
    result
}

fn read(path: &Path, bytes: &[u8], beside: usize) -> Result<Mesh, MeshError> {
    let format = FileFormat::of(path, bytes).unwrap();
    let name = path.file_name().unwrap().to_str().unwrap();
    cost(
        name,
        bytes.len() + beside,
        FIXED + ZEROS + LIST,
        || mesh::parse(path, format, bytes, Reach::Folder),
        |read| read.as_ref().map_or(0, |mesh| mesh.normals.len()),
    )
}

fn repeated(one: &str, count: usize) -> String {
    vec![one; count].join(",")
}

/// A GLB of one mesh, whose buffer of 4,096 zeros has a view of all of it.
fn glb(name: &str, accessors: &str, primitives: &str) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":4096}}],"bufferViews":[{{"buffer":0,"byteLength":4096}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":300,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}},{accessors}],
        "meshes":[{{"name":"{name}","primitives":[{primitives}]}}]}}"#
    );
    seeds::glb_of(&json, &[0; 4096])
}

/// A long name, and many primitives that bear it; in the JSON of `--json` as well.
#[test]
fn names_and_primitives() {
    let normals = r#"{"bufferView":0,"componentType":5126,"count":300,"type":"VEC3"}"#;
    let bytes =
        glb(&"x".repeat(1 << 17), normals, &repeated(r#"{"attributes":{"POSITION":0,"NORMAL":1}}"#, 4000));
    let mesh = read(Path::new("names.glb"), &bytes, 0).unwrap();
    assert_eq!((mesh.parts.len(), mesh.normals.len()), (4000, 300));
    assert!(serde_json::to_string(&mesh.parts).unwrap().len() < 4 * bytes.len());
}

/// Primitives that share their positions, all with the same indices, and each with an accessor of its own over the same bytes.
#[test]
fn primitives_and_indices() {
    let indices = r#"{"bufferView":0,"componentType":5121,"count":4095,"type":"SCALAR"}"#;
    let one = r#"{"attributes":{"POSITION":0},"indices":1}"#;
    let padding = "x".repeat(1 << 17);
    let bytes = glb(&padding, indices, &repeated(one, 8000));
    assert_eq!(read(Path::new("same_indices.glb"), &bytes, 0).unwrap().normals.len(), 300);
    let each: Vec<_> =
        (1..=4000).map(|k| one.replace("\"indices\":1", &format!("\"indices\":{k}"))).collect();
    let bytes = glb(&padding, &repeated(indices, 4000), &each.join(","));
    let error = read(Path::new("own_indices.glb"), &bytes, 0).unwrap_err().to_string();
    assert!(error.contains("corners of faces"), "{error}");
}

/// Buffers that nothing uses, and one file by many names.
#[test]
fn buffers_and_files() {
    const LENGTH: usize = 16 << 20;
    let folder = tempfile::tempdir().unwrap();
    for name in ["used.bin", "unused.bin"] {
        std::fs::File::create(folder.path().join(name)).unwrap().set_len(LENGTH as u64).unwrap();
    }
    let buffer = |name: &str| format!(r#"{{"byteLength":{LENGTH},"uri":"{name}"}}"#);
    let names: Vec<_> = (0..64).map(|k| buffer(&("./".repeat(k) + "used.bin"))).collect();
    let ones = |of: fn(usize) -> String| (0..64).map(of).collect::<Vec<_>>().join(",");
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{},{}],"bufferViews":[{}],"accessors":[{}],"meshes":[{{"primitives":[{}]}}]}}"#,
        names.join(","),
        repeated(&buffer("unused.bin"), 64),
        ones(|k| format!(r#"{{"buffer":{k},"byteLength":36}}"#)),
        ones(|k| format!(
            r#"{{"bufferView":{k},"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}}"#
        )),
        ones(|k| format!(r#"{{"attributes":{{"POSITION":{k},"NORMAL":{k}}}}}"#)),
    );
    let mesh = read(&folder.path().join("buffers.gltf"), json.as_bytes(), LENGTH).unwrap();
    assert_eq!(mesh.normals.len(), 3 * 64);
}

/// Many elements, each with a count that the file could hold by itself.
#[test]
fn elements_and_counts() {
    let vertex = "element vertex 1\nproperty uchar nx\nproperty uchar ny\nproperty uchar nz\n";
    let file = |format: &str, elements: &str| {
        let header = format!("ply\nformat {format} 1.0\n{elements}{vertex}end_header\n");
        [header.as_bytes(), &[b'0'; 1 << 20]].concat()
    };
    let empty: String = (0..1000).map(|n| format!("element a{n} 2000000\n")).collect();
    let small: String = (0..500).map(|n| format!("element a{n} 900000\nproperty uchar x\n")).collect();
    let binary = read(Path::new("empty.ply"), &file("binary_little_endian", &empty), 0);
    assert_eq!(binary.unwrap().normals, [[48.0; 3]]);
    for (name, format, elements) in [
        ("lines.ply", "ascii", &empty),
        ("small.ply", "binary_little_endian", &small),
        ("words.ply", "ascii", &small),
    ] {
        let error = read(Path::new(name), &file(format, elements), 0).unwrap_err().to_string();
        assert!(error.contains("elements a"), "{error}");
    }
    let longer = file("binary_little_endian", &empty.repeat(50));
    let error = read(Path::new("header.ply"), &longer, 0).unwrap_err().to_string();
    assert!(error.contains("no header"), "{error}");
}

/// Many names of stubs, and many functions, in a module that is linked.
#[test]
fn names_and_functions() {
    const COPIES: u32 = 50_000;
    const NAME: u32 = 5;
    const FUNCTION: u32 = 54;
    const FUNCTION_END: u32 = 56;
    let bytes = &seeds::shader()[0];
    let mut words: Vec<u32> =
        bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    let (mut at, mut lines) = (5, Vec::new());
    while at < words.len() {
        let length = (words[at] >> 16) as usize;
        lines.push(words[at..at + length].to_vec());
        at += length;
    }
    let text = |line: &[u32]| line.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
    let name = lines
        .iter()
        .find(|line| line[0] & 0xffff == NAME && text(&line[2..]).starts_with(b"unitvec_oct16_e"));
    let mut name = name.unwrap().clone();
    let is_function = |line: &&Vec<u32>| line[0] & 0xffff == FUNCTION && line[2] == name[1];
    let mut function = lines.iter().find(is_function).unwrap().clone();
    for id in words[3]..words[3] + COPIES {
        (name[1], function[2]) = (id, id);
        words.extend(name.iter().chain(&function).chain(&[1 << 16 | FUNCTION_END]));
    }
    words[3] += COPIES;
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let read = || unitvec_link::imports(&bytes).map(|(_, names)| names.len());
    assert!(cost("stubs.spv", bytes.len(), INSTRUCTIONS, read, |_| 0).unwrap() > 0);
}
