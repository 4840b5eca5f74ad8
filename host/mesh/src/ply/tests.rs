//! Headers, elements and faces of PLY files.

use super::super::tests::{CUBE_CORNERS, CUBE_FACES, assert_close, cube_normals};
use super::*;

fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    parse(Path::new("a.ply"), bytes)
}

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// A number of a payload as text and in little-endian bytes.
type Number = (String, Vec<u8>);

/// A number of the type that its header declares.
macro_rules! number {
    ($n:expr) => {
        ($n.to_string(), $n.to_le_bytes().to_vec())
    };
}

fn written((text, bytes): &Number, encoding: &str) -> Vec<u8> {
    match encoding {
        "ascii" => format!("{text} ").into_bytes(),
        "binary_big_endian" => bytes.iter().rev().copied().collect(),
        _ => bytes.clone(),
    }
}

fn file(encoding: &str, header: &str, elements: &[Vec<Number>]) -> Vec<u8> {
    let mut bytes = format!("ply\nformat {encoding} 1.0\n{header}end_header\n").into_bytes();
    for element in elements {
        bytes.extend(element.iter().flat_map(|number| written(number, encoding)));
        bytes.extend((encoding == "ascii").then_some(b'\n'));
    }
    bytes
}

/// The cube without normals: positions as doubles, faces as lists of shorts after a property to skip.
fn cube(encoding: &str, list: &str) -> Vec<u8> {
    let header = format!(
        "comment a cube\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n\
        element face 6\nproperty uchar flags\nproperty list uchar short {list}\n"
    );
    let corners = CUBE_CORNERS.map(|corner| corner.map(|c| number!(f64::from(c))).into());
    let faces = CUBE_FACES.map(|face| {
        let indices = face.map(|i| number!(i as i16));
        [number!(7u8), number!(4u8)].into_iter().chain(indices).collect()
    });
    file(encoding, &header, &corners.into_iter().chain(faces).collect::<Vec<_>>())
}

/// Two vertices with normals of mixed types, and an element to skip before them.
fn with_normals(encoding: &str, second: f32) -> Vec<u8> {
    let header = "element extra 1\nproperty list uchar float weights\n\
        element vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty short ny\nproperty double nz\n";
    let extra = vec![number!(2u8), number!(0.5f32), number!(0.5f32)];
    let vertex = |n: f32| {
        let position = [1.0f32, 2.0, 3.0].map(|c| number!(c));
        position.into_iter().chain([number!(n), number!(-3i16), number!(0.25f64)]).collect()
    };
    file(encoding, header, &[extra, vertex(0.5), vertex(second)])
}

/// A face list without normals gives the cube's diagonals in every encoding, under both names.
#[test]
fn computes_from_faces() {
    for encoding in ENCODINGS {
        for list in INDICES {
            let mesh = read(&cube(encoding, list)).unwrap();
            assert_eq!(mesh.computed(), 1);
            assert_close(&mesh.normals, &cube_normals());
        }
    }
}

/// Rotations of splats come back as x, y, z, w, bit for bit, in every encoding; a file of points has none, and
/// that of packed splats is refused as such.
#[test]
fn rotations_of_splats() {
    let names =
        ["x", "rot_0", "rot_1", "rot_2", "rot_3"].map(|name| format!("property float {name}\n")).concat();
    let splat = |w: f32| [9.0, w, 0.25, -2.0, f32::MIN_POSITIVE].map(|c| number!(c)).to_vec();
    let header = format!("element vertex 2\n{names}");
    for encoding in ENCODINGS {
        let bytes = file(encoding, &header, &[splat(0.5), splat(-1.0)]);
        let Rotations { rotations, parts } = parse_rotations(Path::new("a.ply"), &bytes).unwrap();
        assert_eq!(rotations, [0.5, -1.0].map(|w| [0.25, -2.0, f32::MIN_POSITIVE, w]));
        assert_eq!((parts.len(), parts[0].count), (1, 2));
    }
    for header in [header.replace("rot_3", "rot_4"), header.replace("vertex", "point")] {
        let bytes = file(ENCODINGS[1], &header, &[splat(0.5), splat(-1.0)]);
        let result = parse_rotations(Path::new("a.ply"), &bytes);
        assert!(matches!(result, Err(MeshError::NoRotations { .. })), "{result:?}");
    }
    let packed = "element vertex 1\nproperty uint packed_rotation\n";
    let bytes = file(ENCODINGS[1], packed, &[vec![number!(7_u32)]]);
    let result = parse_rotations(Path::new("a.compressed.ply"), &bytes);
    assert!(matches!(result, Err(MeshError::Compressed { .. })), "{result:?}");
}

/// Strips give the cube's diagonals too, from one list, before the vertices or after them; a corner below zero ends a strip.
#[test]
fn strips() {
    let corners: String = CUBE_CORNERS.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let strips: Vec<_> = CUBE_FACES.iter().map(|[a, b, c, d]| format!("{b} {c} {a} {d}")).collect();
    let list = format!("{} {}\n", 5 * strips.len() - 1, strips.join(" -1 "));
    let vertices = "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
    let tristrips = "element tristrips 1\nproperty list int int vertex_indices\n";
    for [first, second] in
        [[(vertices, &corners), (tristrips, &list)], [(tristrips, &list), (vertices, &corners)]]
    {
        let [header, payload] = [first.0.to_owned() + second.0, first.1.to_owned() + second.1];
        let file = format!("ply\nformat ascii 1.0\n{header}end_header\n{payload}");
        assert_close(&read(file.as_bytes()).unwrap().normals, &cube_normals());
        let (shape, _) = parse_shape(Path::new("a.ply"), file.as_bytes()).unwrap();
        assert_eq!(shape.triangles.len(), 12);
    }
}

/// Lines end as those of Windows or of old Macs, comments have any encoding, and words any space between them.
#[test]
fn headers_of_other_programs() {
    let plain = triangle("int", "2");
    for end in ["\r", "\r\n", " \t\n"] {
        let text = String::from_utf8(plain.clone()).unwrap();
        let text = text.replace('\n', end).replace("element ", " element \t");
        let bytes = text.replace("1.0", &format!("1.0{end}comment \u{fffd}")).into_bytes();
        let bytes: Vec<u8> = bytes.into_iter().filter(|byte| ![0xef, 0xbf].contains(byte)).collect();
        assert_eq!(read(&bytes).unwrap().normals, [[0.0, 0.0, 1.0]; 3], "{end:?}");
    }
    // The first byte of the data ends no line.
    let vertex = "element vertex 1\nproperty uchar nx\nproperty uchar ny\nproperty uchar nz\n";
    let mut bytes = file(ENCODINGS[1], vertex, &[vec![number!(b'\n'), number!(0u8), number!(1u8)]]);
    let end = bytes.len() - 3;
    bytes[..end].iter_mut().filter(|byte| **byte == b'\n').for_each(|byte| *byte = b'\r');
    assert_eq!(read(&bytes).unwrap().normals, [[10.0, 0.0, 1.0]]);
}

/// Normals of any numeric type come back as they are in every encoding, NaN too.
#[test]
fn normals_pass_through() {
    for encoding in ENCODINGS {
        let mesh = read(&with_normals(encoding, 4.0)).unwrap();
        assert_eq!(mesh.normals, [[0.5, -3.0, 0.25], [4.0, -3.0, 0.25]]);
        assert_eq!(mesh.computed(), 0);
    }
    assert!(read(&with_normals(ENCODINGS[1], f32::NAN)).unwrap().normals[1][0].is_nan());
}

fn triangle(index_type: &str, last: &str) -> Vec<u8> {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property int z\nelement face 1\nproperty list uint {index_type} vertex_index\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n3 0 1 {last}\n"
    )
    .into_bytes()
}

/// Every integer type serves as an index; a float does not.
#[test]
fn index_types() {
    for index_type in ["char", "uchar", "short", "ushort", "int", "uint", "int8", "uint32"] {
        assert_eq!(read(&triangle(index_type, "2")).unwrap().normals, [[0.0, 0.0, 1.0]; 3]);
    }
    assert!(matches!(read(&triangle("float", "2")), Err(MeshError::Parse { .. })));
}

/// An index past the vertices or below zero is reported with its value.
#[test]
fn index_out_of_range() {
    for bad in [3, -1] {
        let error = read(&triangle("int", &bad.to_string())).unwrap_err();
        let MeshError::IndexOutOfRange { index, vertices, .. } = error else { panic!("{error}") };
        assert_eq!((index, vertices), (bad, 3));
    }
}

/// A position that is not finite is an error, also where normals are there.
#[test]
fn positions_must_be_finite() {
    let mut bytes = with_normals(ENCODINGS[1], 0.0);
    let second = bytes.len() - 26;
    bytes[second..second + 4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(matches!(read(&bytes), Err(MeshError::NotFinite { vertex: 1, .. })));
    let mut bytes = cube(ENCODINGS[1], INDICES[0]);
    let first = bytes.len() - 6 * 10 - 8 * 24;
    bytes[first..first + 8].copy_from_slice(&1e300f64.to_le_bytes());
    assert!(matches!(read(&bytes), Err(MeshError::NotFinite { vertex: 0, .. })));
}

/// A point cloud without normals has nothing to compute them from.
#[test]
fn needs_faces() {
    let header = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let bytes = file(ENCODINGS[0], header, &[vec![number!(0u8), number!(0u8), number!(0u8)]]);
    assert!(matches!(read(&bytes), Err(MeshError::NoFaces { .. })));
}

/// Counts that no file of this size can hold fail at once instead of filling the memory.
#[test]
fn absurd_counts_fail() {
    for (header, elements) in [
        ("element vertex 18446744073709551615\nproperty float x\n", vec![]),
        (
            "element face 99999999999999\nproperty list uchar int vertex_index\nelement vertex 1\nproperty float x\n",
            vec![],
        ),
        (
            "element face 1\nproperty list uint int vertex_index\nelement vertex 1\n\
            property float x\nproperty float y\nproperty float z\n",
            vec![vec![number!(255u8), number!(255u8), number!(255u8), number!(255u8)]],
        ),
    ] {
        for encoding in ENCODINGS {
            let result = read(&file(encoding, header, &elements));
            assert!(matches!(result, Err(MeshError::Parse { .. })), "{header}: {result:?}");
        }
    }
}

/// Elements without properties take no time in binary files, and a line each in text. The sum counts.
#[test]
fn many_empty_elements() {
    let empty = |count: usize| (0..9).map(|n| format!("element a{n} {count}\n")).collect::<String>();
    let vertex = "element vertex 1\nproperty uchar nx\nproperty uchar ny\nproperty uchar nz\n";
    let vertices = [vec![number!(0u8), number!(0u8), number!(1u8)]];
    for encoding in &ENCODINGS[1..] {
        let mesh = read(&file(encoding, &(empty(usize::MAX) + vertex), &vertices)).unwrap();
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]]);
    }
    assert!(read(&file(ENCODINGS[0], &(empty(50) + vertex), &vertices)).is_err());
}

/// The parser keeps one element, or property, of a name; the data are of both.
#[test]
fn names_that_are_there_twice() {
    let vertex = "element vertex 1\nproperty uchar nx\nproperty uchar ny\nproperty uchar nz\n";
    let vertices = [vec![number!(0u8), number!(0u8), number!(1u8)]];
    for more in ["property uchar nx\n", "element vertex 2\nproperty uchar nx\n"] {
        let error = read(&file(ENCODINGS[1], &(vertex.to_owned() + more), &vertices)).unwrap_err();
        assert!(error.to_string().contains("the same name"), "{error}");
    }
    let lists =
        "element face 0\nproperty list uchar int vertex_index\nproperty list uchar int vertex_indices\n";
    assert!(read(&file(ENCODINGS[1], &(vertex.to_owned() + lists), &vertices)).is_err());
}

/// A binary file cut off at any byte is an error, and so is an empty one. (`tests/fuzz` damages files otherwise.)
#[test]
fn truncation_is_an_error() {
    for encoding in &ENCODINGS[1..] {
        for bytes in [cube(encoding, INDICES[0]), with_normals(encoding, 1.0)] {
            assert!((0..bytes.len()).all(|end| read(&bytes[..end]).is_err()));
        }
    }
}
