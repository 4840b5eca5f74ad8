//! Broken files are made one field at a time.

mod buffers;

use super::super::mesh_count;
use super::super::tests::{CUBE_CORNERS, CUBE_FACES, assert_close, cube_normals};
use super::document::quoted;
use super::*;
use base64::Engine;

fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    parse(Path::new("a.glb"), bytes, Reach::Folder)
}

fn floats<const N: usize>(vectors: &[[f32; N]]) -> Vec<u8> {
    vectors.iter().flatten().flat_map(|c| c.to_le_bytes()).collect()
}

fn cube_indices() -> Vec<u8> {
    let corners = CUBE_FACES.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
    corners.flat_map(u16::to_le_bytes).collect()
}

/// Any: those of a file are not checked.
fn tangents() -> Vec<[f32; 4]> {
    CUBE_CORNERS.iter().map(|&[x, y, z]| [y, -x, 0.5, z]).collect()
}

/// The cube's buffer: 96 bytes of positions, 96 of normals, 72 of indices, 128 of tangents.
fn cube_buffer() -> Vec<u8> {
    [floats(&CUBE_CORNERS), floats(&cube_normals()), cube_indices(), floats(&tangents())].concat()
}

/// A document over a buffer of that layout, with one mesh of the given primitives.
fn json(primitives: &str, uri: &str) -> String {
    let bounds = r#""min":[-1,-1,-1],"max":[1,1,1]"#;
    format!(
        r#"{{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":[{primitives}]}}],
        "buffers":[{{"byteLength":392{uri}}}],"bufferViews":[
        {{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":96}},
        {{"buffer":0,"byteOffset":192,"byteLength":72}},
        {{"buffer":0,"byteOffset":264,"byteLength":128}}],"accessors":[
        {{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3",{bounds}}},
        {{"bufferView":1,"componentType":5126,"count":8,"type":"VEC3"}},
        {{"bufferView":2,"componentType":5123,"count":36,"type":"SCALAR"}},
        {{"bufferView":3,"componentType":5126,"count":8,"type":"VEC4"}}]}}"#
    )
}

const WITH_NORMALS: &str = r#"{"attributes":{"POSITION":0,"NORMAL":1},"indices":2}"#;
const WITH_TANGENTS: &str = r#"{"attributes":{"POSITION":0,"NORMAL":1,"TANGENT":3}}"#;
const WITHOUT_NORMALS: &str = r#"{"attributes":{"POSITION":0},"indices":2}"#;

fn glb(json: &str, blob: Option<&[u8]>) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], pad: u8| {
        let mut data = data.to_vec();
        data.resize(data.len().next_multiple_of(4), pad);
        [&(data.len() as u32).to_le_bytes(), kind.as_slice(), &data].concat()
    };
    let bin = blob.map_or(Vec::new(), |blob| chunk(b"BIN\0", blob, 0));
    let body = [chunk(b"JSON", json.as_bytes(), b' '), bin].concat();
    let length = body.len() as u32 + 12;
    [b"glTF".as_slice(), &2u32.to_le_bytes(), &length.to_le_bytes(), &body].concat()
}

fn cube(primitives: &str) -> Vec<u8> {
    glb(&json(primitives, ""), Some(&cube_buffer()))
}

fn is_parse(result: &Result<Mesh, MeshError>) -> bool {
    matches!(result, Err(MeshError::Parse { .. }))
}

/// Normals of a GLB come back bit for bit; computed ones point along the cube's diagonals.
#[test]
fn reads_and_computes() {
    let mesh = read(&cube(WITH_NORMALS)).unwrap();
    assert_eq!((mesh.computed(), mesh.normals), (0, cube_normals()));
    let mesh = read(&cube(WITHOUT_NORMALS)).unwrap();
    assert_eq!(mesh.computed(), 1);
    assert_close(&mesh.normals, &cube_normals());
}

/// All primitives count, an accessor of normals that two share once.
#[test]
fn all_primitives() {
    let mesh = read(&cube(&format!("{WITH_NORMALS},{WITHOUT_NORMALS},{WITH_NORMALS}"))).unwrap();
    assert_close(&mesh.normals, &[cube_normals(), cube_normals()].concat());
    let parts: Vec<_> = mesh.parts.iter().map(|p| (p.primitive, p.first, p.count, p.computed)).collect();
    assert_eq!(parts, [(0, 0, 8, false), (1, 8, 8, true), (2, 0, 8, false)]);
}

/// Parts name their meshes, in the order of the file.
#[test]
fn parts_of_several_meshes() {
    let second = format!(r#""meshes":[{{"name":"caf\u00e9","primitives":[{WITHOUT_NORMALS}]}},"#);
    let document = json(WITH_NORMALS, "").replace(r#""meshes":["#, &second);
    let mesh = read(&glb(&document, Some(&cube_buffer()))).unwrap();
    let parts: Vec<_> = mesh.parts.iter().map(|p| (p.mesh, p.name.as_deref(), p.first)).collect();
    assert_eq!(parts, [(0, Some("caf\u{e9}"), 0), (1, None, 8)]);
    assert_eq!(mesh_count(&mesh.parts), 2);
}

/// Primitives without normals that share their positions give one normal a vertex, of all their faces; a vertex that
/// none of them uses is zero.
#[test]
fn shared_positions() {
    // The first three faces of the cube, and the last three.
    let halves = json(
        r#"{"attributes":{"POSITION":0},"indices":2},{"attributes":{"POSITION":0},"indices":4}"#,
        "",
    )
    .replace(r#""count":36,"type":"SCALAR"}"#, r#""count":18,"type":"SCALAR"}"#)
    .replace(
        r#""type":"VEC4"}"#,
        r#""type":"VEC4"},{"bufferView":2,"byteOffset":36,"componentType":5123,"count":18,"type":"SCALAR"}"#,
    );
    let mesh = read(&glb(&halves, Some(&cube_buffer()))).unwrap();
    assert_close(&mesh.normals, &cube_normals());
    assert!(mesh.parts.iter().all(|part| (part.first, part.count) == (0, 8)));
    let one_face = json(WITHOUT_NORMALS, "").replace(r#""count":36"#, r#""count":6"#);
    let mesh = read(&glb(&one_face, Some(&cube_buffer()))).unwrap();
    // The first face is that of z = -1, corners 0 to 3.
    assert_eq!(mesh.normals, [[[0.0, 0.0, -1.0]; 4], [[0.0; 3]; 4]].concat());
}

/// The cube with normals and tangents as integers of this component type and size, four to a vector.
fn quantized(component_type: u32, normalized: bool, size: usize, integers: &[u8]) -> Vec<u8> {
    let length = integers.len() / 2;
    let document = json(WITH_TANGENTS, "")
        .replacen('{', r#"{"extensionsRequired":["KHR_mesh_quantization"],"#, 1)
        .replace(r#""byteLength":392"#, &format!(r#""byteLength":{}"#, 392 + integers.len()))
        .replace(
            r#""byteOffset":96,"byteLength":96"#,
            &format!(r#""byteOffset":392,"byteLength":{length},"byteStride":{}"#, 4 * size),
        )
        .replace(
            r#""byteOffset":264,"byteLength":128"#,
            &format!(r#""byteOffset":{},"byteLength":{length}"#, 392 + length),
        );
    let (positions, attributes) = document.split_at(document.find(r#"{"bufferView":1,"#).unwrap());
    let kind = format!(r#""normalized":{normalized},"componentType":{component_type}"#);
    let document = format!("{positions}{}", attributes.replace(r#""componentType":5126"#, &kind));
    glb(&document, Some(&[&cube_buffer(), integers].concat()))
}

/// Normals and tangents of `KHR_mesh_quantization` are c / max, the lowest integer -1, as in the specification.
#[test]
fn quantized_normals() {
    let path = Path::new("a.glb");
    let bytes: Vec<i8> = (0..64).map(|k| [0, 127, -127, -128, 1, -64][k % 6]).collect();
    let words: Vec<i16> = (0..64).map(|k| [0, 32767, -32767, -32768, 1, -16384][k % 6]).collect();
    let of_bytes = quantized(5120, true, 1, &bytes.iter().map(|&c| c as u8).collect::<Vec<_>>());
    let of_words = quantized(5122, true, 2, &words.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<_>>());
    for (file, [one, low]) in
        [(of_bytes, [1.0 / 127.0, -64.0 / 127.0]), (of_words, [1.0 / 32767.0, -16384.0 / 32767.0])]
    {
        let value = |k: usize| [0.0, 1.0, -1.0, -1.0, one, low][k % 6];
        let Frames { frames, .. } = parse_frames(path, &file, Reach::Folder).unwrap();
        assert_eq!(frames.len(), 8);
        for (vertex, frame) in frames.iter().enumerate() {
            let expected = [0, 1, 2, 32, 33, 34, 35].map(|k| value(4 * vertex + k));
            assert_eq!(*frame, expected);
            assert_eq!(read(&file).unwrap().normals[vertex], expected[..3]);
        }
    }
}

/// Integers that are not normalised, or unsigned, are no normals; as positions they serve.
#[test]
fn integers_of_other_kinds() {
    for (component_type, normalized) in [(5120, false), (5121, true)] {
        assert!(is_parse(&read(&quantized(component_type, normalized, 1, &[1; 64]))));
    }
    for (component_type, centre) in [(5120, 0u8), (5121, 128)] {
        let document = json(WITHOUT_NORMALS, "").replacen("5126", &component_type.to_string(), 1);
        let mut buffer = cube_buffer();
        for (byte, corner) in buffer.iter_mut().zip(CUBE_CORNERS.as_flattened()) {
            *byte = centre.wrapping_add_signed(*corner as i8);
        }
        assert_close(&read(&glb(&document, Some(&buffer))).unwrap().normals, &cube_normals());
    }
}

/// Frames come back bit for bit, those of a pair of accessors once.
#[test]
fn frames() {
    let expected: Vec<[f32; 7]> = cube_normals()
        .iter()
        .zip(tangents())
        .map(|([x, y, z], [a, b, c, d])| [*x, *y, *z, a, b, c, d])
        .collect();
    let read = |bytes: &[u8]| parse_frames(Path::new("a.glb"), bytes, Reach::Folder);
    let twice = format!("{WITH_TANGENTS},{WITH_TANGENTS}");
    let Frames { frames, parts, generated } = read(&cube(&twice)).unwrap();
    assert_eq!((&frames, generated), (&expected, Generated::default()));
    assert_eq!(
        parts.iter().map(|p| (p.primitive, p.first, p.count)).collect::<Vec<_>>(),
        [(0, 0, 8), (1, 0, 8)]
    );
    assert_eq!(super::tests::read(&cube(&twice)).unwrap().normals, cube_normals());
    for without in [WITH_NORMALS, WITHOUT_NORMALS] {
        let some = read(&cube(&format!("{WITH_TANGENTS},{without}"))).unwrap();
        assert_eq!((some.frames.len(), some.generated), (16, Generated { none: 8, ..Generated::default() }));
        assert_eq!(some.frames[..8], expected);
        let normals: Vec<_> = some.frames[8..].iter().map(|[x, y, z, ..]| [*x, *y, *z]).collect();
        assert_close(&normals, &cube_normals());
        assert!(some.frames[8..].iter().all(|frame| frame[3..] == [0.0; 4]));
        let result = read(&cube(&format!("{without},{without}")));
        let place = ": primitive 0 of mesh 0 lacks them";
        assert!(
            matches!(&result, Err(MeshError::NoTangents { lacking, .. }) if lacking == place),
            "{result:?}"
        );
    }
    // Points and lines have normals at most, and are no surface by themselves.
    for points in [WITH_NORMALS, WITHOUT_NORMALS].map(|primitive| primitive.replacen('{', r#"{"mode":0,"#, 1))
    {
        let some = read(&cube(&format!("{WITH_TANGENTS},{points}"))).unwrap();
        assert_eq!((some.frames.len(), some.generated.none), (16, 8));
        let normal = if points.contains("NORMAL") { cube_normals()[0] } else { [0.0; 3] };
        assert_eq!((some.frames[8][..3].to_vec(), &some.frames[8][3..]), (normal.to_vec(), &[0.0; 4][..]));
    }
    for (from, to) in [(r#"8,"type":"VEC4""#, r#"7,"type":"VEC4""#), ("VEC4", "VEC3"), (r#"T":3"#, r#"T":9"#)]
    {
        let result = read(&glb(&json(WITH_TANGENTS, "").replace(from, to), Some(&cube_buffer())));
        assert!(matches!(result, Err(MeshError::Parse { .. })), "{from} {to}: {result:?}");
    }
}

/// A square in two primitives, which share their vertices, with v downwards: the tangent goes along u, and the handedness, so
/// that n x t times it goes upwards in the texture, as glTF defines it, is that of x, -y, z.
#[test]
fn frames_from_texture_coordinates() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let positions = floats(&square.map(|[x, y]| [x, y, 0.0f32]));
    let indices: Vec<u8> = [0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes).collect();
    let buffer = [positions, floats(&square), indices].concat();
    let primitive =
        |indices| format!(r#"{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":{indices}}}"#);
    let document = |kind: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":[{},{}]}}],"buffers":[{{"byteLength":92}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
            {{"buffer":0,"byteOffset":80,"byteLength":12}}],"accessors":[
            {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
            {{"bufferView":1,"componentType":5126,"count":4,"type":"{kind}"}},
            {{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}},
            {{"bufferView":2,"byteOffset":6,"componentType":5123,"count":3,"type":"SCALAR"}}]}}"#,
            primitive(2),
            primitive(3)
        )
    };
    let read =
        |document: &str| parse_frames(Path::new("a.glb"), &glb(document, Some(&buffer)), Reach::Folder);
    let Frames { frames, parts, generated } = read(&document("VEC2")).unwrap();
    assert_eq!(frames, [[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0]; 4]);
    assert_eq!(generated, Generated { vertices: 4, ambiguous: 0, none: 0 });
    assert!(parts.iter().map(|part| (part.first, part.count, part.computed)).eq([(0, 4, true); 2]));
    for (from, to) in [("VEC2", "VEC3"), ("count\":4,\"type\":\"VEC2", "count\":3,\"type\":\"VEC2")] {
        let result = read(&document("VEC2").replace(from, to));
        assert!(matches!(result, Err(MeshError::Parse { .. })), "{result:?}");
    }
}

/// Rotations come back bit for bit, those of an accessor once, of a cubic spline the middle of each key; a file that has none, or
/// whose samplers name other values, is refused.
#[test]
fn rotations() {
    let read = |document: &str| {
        parse_rotations(Path::new("a.glb"), &glb(document, Some(&cube_buffer())), Reach::Folder)
    };
    let with = |samplers: &str, channels: &str| {
        let animation =
            format!(r#""animations":[{{"samplers":[{samplers}],"channels":[{channels}]}}],"asset""#);
        json(WITH_TANGENTS, "").replacen(r#""asset""#, &animation, 1)
    };
    let turning = r#"{"sampler":0,"target":{"path":"rotation"}}"#;
    let linear = r#"{"input":0,"output":3}"#;
    let twice = format!("{turning},{}", turning.replace(":0,", ":1,"));
    let Rotations { rotations, parts } = read(&with(&format!("{linear},{linear}"), &twice)).unwrap();
    assert_eq!(rotations, tangents());
    assert_eq!(
        parts.iter().map(|p| (p.primitive, p.first, p.count)).collect::<Vec<_>>(),
        [(0, 0, 8), (1, 0, 8)]
    );
    let cubic = read(&with(r#"{"input":0,"output":3,"interpolation":"CUBICSPLINE"}"#, turning)).unwrap();
    assert_eq!(cubic.rotations, [tangents()[1], tangents()[4], tangents()[7]]);
    let splats = WITH_TANGENTS.replace("TANGENT", "KHR_gaussian_splatting:ROTATION");
    let required = r#""extensionsRequired":["KHR_gaussian_splatting"],"asset""#;
    let splats = json(&splats, "").replacen(r#""asset""#, required, 1);
    assert_eq!(read(&splats).unwrap().rotations, tangents());
    for none in
        [json(WITH_TANGENTS, ""), with(linear, &turning.replace("rotation", "scale")), with("", turning)]
    {
        assert!(matches!(read(&none), Err(MeshError::NoRotations { .. })), "{none}");
    }
    for output in ["1", "9"] {
        let result = read(&with(&linear.replace('3', output), turning));
        assert!(matches!(result, Err(MeshError::Parse { .. })), "{output}: {result:?}");
    }
}

/// A primitive with fewer positions than normals, or more, is refused, also where another one has read the normals.
#[test]
fn counts_must_agree() {
    let positions = r#"{"bufferView":0,"componentType":5126,"count":8,"#;
    let fewer = positions.replace("\"count\":8", "\"count\":7");
    let document = json(WITH_TANGENTS, "").replace(positions, &fewer);
    let file = glb(&document, Some(&cube_buffer()));
    let of_frames = parse_frames(Path::new("a.glb"), &file, Reach::Folder).unwrap_err();
    for error in [read(&file).unwrap_err(), of_frames] {
        assert!(error.to_string().contains("7 Positions and 8 Normals"), "{error}");
    }
    let other = r#"{"attributes":{"POSITION":4,"NORMAL":1}}"#;
    let bounds = r#""min":[-1,-1,-1],"max":[1,1,1]"#;
    let document = json(&format!("{WITH_NORMALS},{other}"), "")
        .replace(r#""type":"VEC4"}"#, &format!(r#""type":"VEC4"}},{fewer}"type":"VEC3",{bounds}}}"#));
    assert!(is_parse(&read(&glb(&document, Some(&cube_buffer())))));
}

/// A byte order mark before the JSON is skipped.
#[test]
fn byte_order_mark() {
    let data = base64::engine::general_purpose::STANDARD.encode(cube_buffer());
    let document = json(WITH_NORMALS, &format!(r#","uri":"data:;base64,{data}""#));
    assert_eq!(read(format!("\u{feff}{document}").as_bytes()).unwrap().normals, cube_normals());
}

/// The command to copy has the path as one word.
#[test]
fn paths_are_quoted() {
    for (path, expected) in [("a/b-1.glb", "a/b-1.glb"), ("a b.glb", "'a b.glb'"), ("it's", r"'it'\''s'")] {
        assert_eq!(quoted(Path::new(path)), expected);
    }
}

/// NaN normals pass through, while a NaN position is an error even beside normals.
#[test]
fn not_finite() {
    let mut buffer = cube_buffer();
    buffer[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    let document = json(WITH_NORMALS, "");
    assert!(read(&glb(&document, Some(&buffer))).unwrap().normals[0][0].is_nan());
    buffer[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let result = read(&glb(&document, Some(&buffer)));
    assert!(matches!(result, Err(MeshError::NotFinite { vertex: 1, .. })));
}

/// The name of a mesh is there once, however many primitives it has, and not at any length.
#[test]
fn names_are_shared() {
    let name = "\u{e9}".repeat(300);
    let document = json(&format!("{WITH_NORMALS},{WITHOUT_NORMALS}"), "")
        .replace(r#""meshes":[{"#, &format!(r#""meshes":[{{"name":"{name}","#));
    let mesh = read(&glb(&document, Some(&cube_buffer()))).unwrap();
    let [first, second] = [0, 1].map(|part| mesh.parts[part].name.as_ref().unwrap());
    assert!(Arc::ptr_eq(first, second));
    assert_eq!(&**first, "\u{e9}".repeat(200) + "...");
}

/// Primitives that share their positions count each face once; more corners than the file can hold are refused at once.
#[test]
fn faces_are_bounded() {
    let mesh = read(&cube(&[WITHOUT_NORMALS; 9].join(","))).unwrap();
    assert_eq!((mesh.parts.len(), mesh.normals), (9, read(&cube(WITHOUT_NORMALS)).unwrap().normals));
    let accessors = 3000;
    let primitive = |k: usize| format!(r#"{{"attributes":{{"POSITION":0}},"indices":{}}}"#, 4 + k);
    let document = json(&(0..accessors).map(primitive).collect::<Vec<_>>().join(","), "");
    let indices = r#",{"bufferView":2,"componentType":5121,"count":72,"type":"SCALAR"}"#.repeat(accessors);
    let document = document.replace(r#""type":"VEC4"}"#, &format!(r#""type":"VEC4"}}{indices}"#));
    assert!(document.len() * 4 + (1 << 16) > accessors * 72);
    let more = document
        .replace(r#""byteLength":72"#, r#""byteLength":20000"#)
        .replace(r#""count":72"#, r#""count":20000"#);
    let more = more.replace(r#""byteLength":392"#, r#""byteLength":30000"#);
    let error = read(&glb(&more, Some(&vec![0; 30_000]))).unwrap_err().to_string();
    assert!(error.contains("corners of faces"), "{error}");
}

/// Strips flip every second triangle and fans turn about their first corner, so that all face up.
#[test]
fn strips_and_fans() {
    let faces_up = |mode, square: [[f32; 3]; 4]| {
        let corners = floats(&square);
        let uri = base64::engine::general_purpose::STANDARD.encode(&corners);
        let document = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":48,"uri":"data:;base64,{uri}"}}],
            "meshes":[{{"primitives":[{{"mode":{mode},"attributes":{{"POSITION":0}}}}]}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}}],"accessors":[{{"bufferView":0,
            "componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}]}}"#
        );
        read(document.as_bytes())
    };
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(faces_up(5, [a, b, d, c]).unwrap().normals, [[0.0, 0.0, 1.0]; 4]);
    assert_eq!(faces_up(6, [a, b, c, d]).unwrap().normals, [[0.0, 0.0, 1.0]; 4]);
    let (z, unused) = ([0.0, 0.0, 1.0], [0.0; 3]);
    assert_eq!(faces_up(4, [a, b, c, d]).unwrap().normals, [z, z, z, unused]);
    for points_or_lines in 0..4 {
        let result = faces_up(points_or_lines, [a, b, c, d]);
        assert!(matches!(result, Err(MeshError::NoFaces { .. })));
    }
}

/// Sparse values replace those of the base, with a base and with zeros in its place.
#[test]
fn sparse_accessors() {
    let sparse = |base: &str, count: usize| {
        json(WITH_NORMALS, "").replace(
            r#"{"bufferView":1,"componentType":5126,"count":8,"#,
            &format!(
                r#"{{{base}"componentType":5126,"count":{count},"sparse":{{"count":1,
                "indices":{{"bufferView":2,"byteOffset":2,"componentType":5123}},
                "values":{{"bufferView":0}}}},"#
            ),
        )
    };
    let buffer = cube_buffer();
    for (base, other) in [(r#""bufferView":1,"#, cube_normals()[0]), ("", [0.0; 3])] {
        let normals = read(&glb(&sparse(base, 8), Some(&buffer))).unwrap().normals;
        // The second of the cube's indices, which stand in for those of the sparse value, is 3.
        assert_eq!((normals.len(), normals[3], normals[0]), (8, CUBE_CORNERS[0], other));
    }
    assert!(is_parse(&read(&glb(&sparse("", 1 << 40), Some(&buffer)))));
    // Indices 2 and 1; twice 7; and one beyond the eight.
    for indices in [[2, 1], [7, 7], [7, 8]] {
        let mut buffer = buffer.clone();
        buffer[194..198].copy_from_slice(&indices.map(u16::to_le_bytes).concat());
        let document = sparse("", 8).replace(r#""sparse":{"count":1"#, r#""sparse":{"count":2"#);
        let error = read(&glb(&document, Some(&buffer))).unwrap_err().to_string();
        assert!(error.contains("sparse indices that do not increase"), "{indices:?}: {error}");
    }
}

/// An accessor without a place in a buffer has zeros, as many as the file could hold at most.
#[test]
fn accessors_without_bytes() {
    let of = |accessor: &str| {
        json(WITH_NORMALS, "").replacen(accessor, &accessor.replacen("\"bufferView\":1,", "", 1), 1)
    };
    let document = of(r#"{"bufferView":1,"componentType":5126,"count":8,"#);
    let read = |document: &str| read(&glb(document, Some(&cube_buffer())));
    assert_eq!(read(&document).unwrap().normals, [[0.0; 3]; 8]);
    assert!(is_parse(&read(&document.replace(r#""count":8"#, r#""count":99999999"#))));
    // One that nothing uses does not matter.
    let unused = r#"{"componentType":5126,"count":8,"type":"VEC3"},{"bufferView":2,"#;
    let document = json(WITH_NORMALS, "").replacen(r#"{"bufferView":2,"#, unused, 1);
    assert_eq!(read(&document).unwrap().normals, cube_normals());
}

/// A file of glTF 1 is told from a damaged one, as JSON and as GLB.
#[test]
fn versions() {
    let first = r#"{"asset":{"version":"1.0"},"accessors":{"a":{"count":8}},"meshes":{}}"#;
    let error = read(first.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("its version is 1.0, and 2.0 is read"), "{error}");
    let mut bytes = cube(WITH_NORMALS);
    bytes[4] = 1;
    let error = read(&bytes).unwrap_err().to_string();
    assert!(error.contains("its version is 1, and 2.0 is read"), "{error}");
}

/// Extensions of materials and attributes of the application do not matter; compression does.
#[test]
fn extensions() {
    let document = json(WITH_NORMALS, "").replace(r#""NORMAL""#, r#""_FACE":2,"NORMAL""#);
    let required = |name| document.replacen('{', &format!(r#"{{"extensionsRequired":["{name}"],"#), 1);
    let read = |name| read(&glb(&required(name), Some(&cube_buffer())));
    for name in ["KHR_materials_unlit", "EXT_texture_webp", "EXT_mesh_gpu_instancing", "CESIUM_RTC"] {
        assert_eq!(read(name).unwrap().normals, cube_normals());
    }
    assert!(is_parse(&read("KHR_of_the_future")));
    assert!(matches!(read("EXT_meshopt_compression"), Err(MeshError::Compressed { .. })));
    // Where compression is not required, the file has the geometry uncompressed.
    let used = document.replacen('{', r#"{"extensionsUsed":["EXT_meshopt_compression"],"#, 1);
    assert_eq!(super::tests::read(&glb(&used, Some(&cube_buffer()))).unwrap().normals, cube_normals());
    let used = used.replacen(r#""bufferView":1,"#, "", 1);
    let error = super::tests::read(&glb(&used, Some(&cube_buffer())));
    assert!(matches!(error, Err(MeshError::Compressed { .. })), "{error:?}");
}

/// Every number that the `gltf` crate would trust is checked first.
#[test]
fn damaged_documents() {
    let changes = [
        (r#""POSITION":0"#, r#""POSITION":9"#),
        (r#""POSITION":0"#, r#""POSITION":2"#),
        (r#""POSITION":0,"#, ""),
        (r#""NORMAL":1"#, r#""NORMAL":9"#),
        (r#""NORMAL":1"#, r#""NORMAL":2"#),
        (r#""count":8"#, r#""count":0"#),
        (r#""count":8"#, r#""count":9"#),
        (r#""count":8"#, r#""count":18446744073709551615"#),
        (r#""byteLength":96"#, r#""byteOffset":18446744073709551615,"byteLength":96"#),
        (r#""byteLength":96"#, r#""byteOffset":200,"byteLength":96"#),
        (r#""byteLength":96"#, r#""byteStride":4,"byteLength":96"#),
        (r#""buffer":0"#, r#""buffer":7"#),
        (r#""2.0""#, "2.0"),
    ];
    for (from, to) in changes {
        let document = json(WITH_NORMALS, "").replace(from, to);
        let result = read(&glb(&document, Some(&cube_buffer())));
        assert!(is_parse(&result), "{from} {to}: {result:?}");
    }
    for (from, to) in [("5123", "5126"), (r#""count":36"#, r#""count":37"#), ("SCALAR", "VEC2")] {
        let document = json(WITHOUT_NORMALS, "").replace(from, to);
        assert!(is_parse(&read(&glb(&document, Some(&cube_buffer())))), "{from} {to}");
    }
}

/// An index past the positions is reported with its value.
#[test]
fn index_out_of_range() {
    let mut buffer = cube_buffer();
    buffer[262..264].copy_from_slice(&8u16.to_le_bytes());
    let error = read(&glb(&json(WITHOUT_NORMALS, ""), Some(&buffer))).unwrap_err();
    let MeshError::IndexOutOfRange { index, vertices, .. } = error else { panic!("{error}") };
    assert_eq!((index, vertices), (8, 8));
}

/// A GLB cut off at any byte is an error, not a panic, also where its header is made to agree.
#[test]
fn truncation_is_an_error() {
    let bytes = cube(WITH_NORMALS);
    for end in 0..bytes.len() {
        let mut cut = bytes[..end].to_vec();
        assert!(read(&cut).is_err(), "{end}");
        if end >= 12 {
            cut[8..12].copy_from_slice(&(end as u32).to_le_bytes());
            assert!(read(&cut).is_err(), "{end}");
        }
    }
}

/// A GLB header may give any length. The parser goes by those of the chunks, if that of the whole is shorter.
#[test]
fn header_lengths() {
    for length in (0..=20).chain([u32::MAX]) {
        let mut bytes = cube(WITH_NORMALS);
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        let result = read(&bytes);
        match length {
            0..12 | u32::MAX => assert!(is_parse(&result), "{length}: {result:?}"),
            _ => assert_eq!(result.unwrap().normals, cube_normals()),
        }
    }
}
