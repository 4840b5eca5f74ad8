//! PLY, ASCII and binary of both byte orders, parsed by `ply-rs-bw`; an element at a time, since a list of all faces takes
//! many times their size in the file.

use std::path::Path;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use glam::DVec3;

use super::faces::{Fan, Positions, Strip, Sums, resolve};
use super::{Mesh, MeshError, Part, Rotations, Shape, check_finite, list_of, one_part, parse_error};

pub(super) const FORMAT: &str = "PLY";

/// The longest header: the parser takes many times its size. Those of scanners and of Gaussian splats have some kB.
const MAX_HEADER: usize = 1 << 15;

/// The longest line of an ASCII file: the parser takes many times its size.
const MAX_LINE: usize = 1 << 20;

/// Reads the normals of a PLY file: `nx ny nz` of the element `vertex`, else from the lists
/// `vertex_indices` or `vertex_index` of the elements `face` and `tristrips`.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    let source = Source::of(&header).ok_or_else(|| MeshError::NoFaces { path: path.into() })?;
    let (mut normals, mut sums, mut faces_before) = (Vec::new(), None, Vec::new());
    for (name, element) in &header.elements {
        match (name.as_str(), source) {
            ("vertex", Source::Normals) => normals = read_normals(&mut payload, element)?,
            ("vertex", Source::Faces) => sums = Some(Sums::new(path, read_positions(&mut payload, element)?)),
            (name, Source::Faces) if FACES.contains(&name) => match &mut sums {
                Some(sums) => each_triangle(&mut payload, element, |triangle| sums.add(triangle))?,
                None => {
                    faces_before.push((payload.clone(), element));
                    payload.skip(element)?;
                }
            },
            _ => payload.skip(element)?,
        }
    }
    let Some(mut sums) = sums else {
        return one_part(path, normals, false);
    };
    for (mut payload, element) in faces_before {
        each_triangle(&mut payload, element, |triangle| sums.add(triangle))?;
    }
    sums.into_mesh()
}

/// Reads the vertices and triangles of a PLY file; true where its normals are computed. Texture coordinates are those of
/// vertices.
pub(super) fn parse_shape(path: &Path, bytes: &[u8]) -> Result<(Shape, bool), MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    let source = Source::of(&header).ok_or_else(|| MeshError::NoFaces { path: path.into() })?;
    let (mut shape, mut faces) = (Shape::default(), Vec::new());
    for (name, element) in &header.elements {
        if name != "vertex" {
            faces.extend(FACES.contains(&name.as_str()).then(|| (payload.clone(), element)));
            payload.skip(element)?;
            continue;
        }
        let has = |names: &[&str; 2]| names.iter().all(|name| element.properties.contains_key(*name));
        let has_texture = COORDINATES.iter().any(has);
        for vertex in 0..element.count {
            let Vertex { position, normal, texture, .. } = payload.next(element)?;
            check_finite(path, vertex, position)?;
            shape.positions.push(position.as_vec3().to_array());
            shape.normals.extend((source == Source::Normals).then_some(normal));
            shape.texture.extend(has_texture.then_some(texture));
        }
    }
    for (mut payload, element) in faces {
        let vertices = shape.positions.len();
        each_triangle(&mut payload, element, |triangle| {
            shape.triangles.push(resolve(path, triangle, vertices)?.map(|corner| corner as u32));
            Ok(())
        })?;
    }
    Ok((shape.with_normals(path)?, source == Source::Faces))
}

/// Reads the rotations of Gaussian splats, in the properties that the first program for them wrote (Kerbl et al. 2023).
pub(super) fn parse_rotations(path: &Path, bytes: &[u8]) -> Result<Rotations, MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    let mut rotations = Vec::new();
    let is_splat = header.elements.get("vertex").is_some_and(|vertex| has_scalars(vertex, &ROTATION));
    for (name, element) in header.elements.iter().filter(|_| is_splat) {
        if name != "vertex" {
            payload.skip(element)?;
            continue;
        }
        rotations = list_of(path, element.count)?;
        for _ in 0..element.count {
            rotations.push(payload.next::<Vertex>(element)?.rotation);
        }
    }
    match rotations.len() {
        0 => Err(MeshError::NoRotations { path: path.into() }),
        count => {
            let part = Part { mesh: 0, name: None, primitive: 0, first: 0, count, computed: false };
            Ok(Rotations { rotations, parts: vec![part] })
        }
    }
}

/// The properties of a rotation: x, y, z and w, which comes first in the file.
const ROTATION: [&str; 4] = ["rot_1", "rot_2", "rot_3", "rot_0"];

/// The property names in use for texture coordinates.
const COORDINATES: [[&str; 2]; 3] = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]];

/// The data below the header, as far as it is not read.
#[derive(Clone)]
pub(super) struct Payload<'b> {
    path: &'b Path,
    pub(super) encoding: Encoding,
    pub(super) rest: &'b [u8],
    /// The line in an ASCII file, counted from 1.
    line: usize,
    /// The last byte of lines.
    line_end: u8,
}

impl<'b> Payload<'b> {
    pub(super) fn after_header(path: &'b Path, bytes: &'b [u8]) -> Result<(Header, Self), MeshError> {
        const END: &[u8] = b"\nend_header\n";
        let head = &bytes[..bytes.len().min(MAX_HEADER)];
        // Old Macs, and Rhinoceros, end lines in `\r` alone.
        let line_end = match head.iter().position(|byte| b"\r\n".contains(byte)) {
            Some(at) if head[at] == b'\r' && head.get(at + 1) != Some(&b'\n') => b'\r',
            _ => b'\n',
        };
        let (mut text, mut length, mut line) = (Vec::new(), 0, 1);
        for row in head.split_inclusive(|byte| *byte == line_end) {
            (length, line) = (length + row.len(), line + 1);
            push_line(&mut text, row);
            if text.ends_with(END) {
                break;
            }
        }
        if head.len() < bytes.len() && !text.ends_with(END) {
            return Err(parse_error(path, FORMAT, format!("no header of up to {MAX_HEADER} bytes")));
        }
        let header = Parser::<Skipped>::new().read_header(&mut Reader::new(&text[..]));
        let header = header.map_err(|error| parse_error(path, FORMAT, error))?;
        check_names(path, &text, &header)?;
        let rest = &bytes[length..];
        let encoding = header.encoding;
        Ok((header, Self { path, encoding, rest, line, line_end }))
    }

    pub(super) fn next<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshError> {
        let parser = Parser::new();
        let read = match self.encoding {
            Encoding::Ascii => return self.next_line(element),
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element),
            Encoding::BinaryLittleEndian => parser.read_little_endian_element(&mut self.rest, element),
        };
        read.map_err(|error| self.error(format!("element {}: {error}", element.name)))
    }

    fn next_line<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshError> {
        let ElementDef { name, .. } = element;
        let end = self.rest.iter().take(MAX_LINE).position(|byte| *byte == self.line_end).map(|end| end + 1);
        let line = match end.or_else(|| (self.rest.len() <= MAX_LINE).then_some(self.rest.len())) {
            None => Err(format!("it has more than {MAX_LINE} bytes")),
            Some(0) => Err("the file ends before it".to_owned()),
            Some(end) => std::str::from_utf8(&self.rest[..end]).map_err(|error| error.to_string()),
        };
        let read = line.and_then(|line| {
            self.rest = &self.rest[line.len()..];
            Parser::new().read_ascii_element(line, element).map_err(|error| error.to_string())
        });
        let read =
            read.map_err(|reason| self.error(format!("line {}, of element {name}: {reason}", self.line)));
        self.line += 1;
        read
    }

    pub(super) fn skip(&mut self, element: &ElementDef) -> Result<(), MeshError> {
        if self.encoding != Encoding::Ascii && element.properties.is_empty() {
            return Ok(());
        }
        (0..element.count).try_for_each(|_| self.next::<Skipped>(element).map(drop))
    }

    pub(super) fn error(&self, reason: String) -> MeshError {
        parse_error(self.path, FORMAT, reason)
    }
}

/// Adds a line of a header as the parser takes it: a space between words, and no comment, which may have any encoding.
fn push_line(text: &mut Vec<u8>, line: &[u8]) {
    let words: Vec<_> = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
    match words.first() {
        Some(&b"comment" | &b"obj_info") => text.extend(b"comment -"),
        _ => text.extend(words.join(&b' ')),
    }
    text.push(b'\n');
}

/// Refuses names that are there twice, since the parser drops all but one of the same name.
fn check_names(path: &Path, head: &[u8], header: &Header) -> Result<(), MeshError> {
    let lines = head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let lines = lines.take_while(|line| *line != b"end_header");
    let told = lines.filter(|line| line.starts_with(b"element ") || line.starts_with(b"property ")).count();
    let of = |element: &ElementDef| 1 + element.properties.len();
    let lists =
        |element: &ElementDef| INDICES.iter().filter(|name| element.properties.contains_key(**name)).count();
    match told > header.elements.values().map(of).sum() || header.elements.values().any(|one| lists(one) > 1)
    {
        true => {
            Err(parse_error(path, FORMAT, "two of its elements, or properties of one, have the same name"))
        }
        false => Ok(()),
    }
}

/// Refuses counts that the file cannot hold together, before memory and time are taken for them.
pub(super) fn check_counts(path: &Path, header: &Header, bytes: usize) -> Result<(), MeshError> {
    let mut all = 0_usize;
    for ElementDef { name, count, properties, .. } in header.elements.values() {
        let least = properties.values().map(|p| least_bytes(header.encoding, &p.data_type)).sum::<usize>();
        // In text an element without properties takes a line.
        let least = least.max(usize::from(header.encoding == Encoding::Ascii));
        all = all.saturating_add(count.saturating_mul(least));
        if all > bytes {
            return Err(parse_error(
                path,
                FORMAT,
                format!("{count} elements {name} in a file of {bytes} bytes"),
            ));
        }
    }
    Ok(())
}

/// The fewest bytes that a property takes. In text those are a digit and a space.
fn least_bytes(encoding: Encoding, property: &PropertyType) -> usize {
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = property;
    if encoding == Encoding::Ascii { 2 } else { size(scalar) }
}

/// The bytes of a number in binary files.
pub(super) fn size(scalar: &ScalarType) -> usize {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// True where an element has all of these properties, as numbers.
fn has_scalars(element: &ElementDef, names: &[&str]) -> bool {
    names.iter().all(|name| {
        let property = element.properties.get(*name);
        property.is_some_and(|property| matches!(property.data_type, PropertyType::Scalar(_)))
    })
}

/// The source of the normals.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Source {
    Normals,
    Faces,
}

impl Source {
    pub(super) fn of(header: &Header) -> Option<Self> {
        let vertex = header.elements.get("vertex")?;
        if has_scalars(vertex, &["nx", "ny", "nz"]) {
            return Some(Self::Normals);
        }
        let mut faces = FACES.iter().filter_map(|name| header.elements.get(*name));
        let has_indices = faces.any(|face| INDICES.iter().any(|name| face.properties.contains_key(*name)));
        (has_indices && has_scalars(vertex, &["x", "y", "z"])).then_some(Self::Faces)
    }
}

/// The normals of all vertices, whose positions are checked too.
fn read_normals(payload: &mut Payload, element: &ElementDef) -> Result<Vec<[f32; 3]>, MeshError> {
    let mut normals = list_of(payload.path, element.count)?;
    for vertex in 0..element.count {
        let Vertex { position, normal, .. } = payload.next(element)?;
        check_finite(payload.path, vertex, position)?;
        normals.push(normal);
    }
    Ok(normals)
}

fn read_positions(payload: &mut Payload, element: &ElementDef) -> Result<Positions, MeshError> {
    // Exact in f64 only.
    let is_wide = |name: &&str| {
        use ScalarType::{Double, Int, UInt};
        let kind = element.properties.get(*name).map(|property| &property.data_type);
        matches!(kind, Some(PropertyType::Scalar(Double | Int | UInt)))
    };
    let mut positions = match ["x", "y", "z"].iter().any(is_wide) {
        true => Positions::Double(list_of(payload.path, element.count)?),
        false => Positions::Single(list_of(payload.path, element.count)?),
    };
    for vertex in 0..element.count {
        let Vertex { position, .. } = payload.next(element)?;
        check_finite(payload.path, vertex, position)?;
        match &mut positions {
            Positions::Single(positions) => positions.push(position.as_vec3().to_array()),
            Positions::Double(positions) => positions.push(position.to_array()),
        }
    }
    Ok(positions)
}

fn each_triangle(
    payload: &mut Payload,
    element: &ElementDef,
    mut each: impl FnMut([i64; 3]) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    for _ in 0..element.count {
        let Face(corners) = payload.next(element)?;
        let (mut fan, mut strip) = (Fan::default(), Strip::default());
        for corner in (0..).map_while(|at| index(&corners, at)) {
            let triangle = if element.name == STRIPS { strip.push(corner) } else { fan.push(corner) };
            triangle.map_or(Ok(()), &mut each)?;
        }
    }
    Ok(())
}

#[derive(Default)]
pub(super) struct Vertex {
    position: DVec3,
    pub(super) normal: [f32; 3],
    texture: [f32; 2],
    rotation: [f32; 4],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(value) = to_f64(&property) else {
            return PropertyAccessResult::Ignored;
        };
        match name {
            "x" => self.position[0] = value,
            "y" => self.position[1] = value,
            "z" => self.position[2] = value,
            "nx" => self.normal[0] = value as f32,
            "ny" => self.normal[1] = value as f32,
            "nz" => self.normal[2] = value as f32,
            _ if name.starts_with("rot_") => match ROTATION.iter().position(|own| *own == name) {
                Some(at) => self.rotation[at] = value as f32,
                None => return PropertyAccessResult::Ignored,
            },
            _ => match COORDINATES.iter().find_map(|pair| pair.iter().position(|own| *own == name)) {
                Some(axis) => self.texture[axis] = value as f32,
                None => return PropertyAccessResult::Ignored,
            },
        }
        PropertyAccessResult::Set
    }
}

fn to_f64(property: &Property) -> Option<f64> {
    match *property {
        Property::Double(value) => Some(value),
        // Exact in f64 only: an f32 has too few bits for these.
        Property::Int(value) => Some(value.into()),
        Property::UInt(value) => Some(value.into()),
        _ => property.to_f32_lossy().map(f64::from),
    }
}

/// The element of triangle strips, which is one list for many: -1 ends a strip.
const STRIPS: &str = "tristrips";

/// The elements of faces.
const FACES: [&str; 2] = ["face", STRIPS];

/// The property names in use for the corners of a face.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// A list of indices, in the type that the file has.
struct Face(Property);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Property::ListUChar(Vec::new()))
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !INDICES.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        use Property::{ListChar, ListInt, ListShort, ListUChar, ListUInt, ListUShort};
        match property {
            ListChar(_) | ListUChar(_) | ListShort(_) | ListUShort(_) | ListInt(_) | ListUInt(_) => {
                self.0 = property;
                PropertyAccessResult::Set
            }
            _ => PropertyAccessResult::UnsupportedType,
        }
    }
}

/// An index of a face; none after the last.
fn index(list: &Property, at: usize) -> Option<i64> {
    fn get<T: Copy + Into<i64>>(list: &[T], at: usize) -> Option<i64> {
        list.get(at).map(|index| (*index).into())
    }
    match list {
        Property::ListChar(list) => get(list, at),
        Property::ListUChar(list) => get(list, at),
        Property::ListShort(list) => get(list, at),
        Property::ListUShort(list) => get(list, at),
        Property::ListInt(list) => get(list, at),
        Property::ListUInt(list) => get(list, at),
        _ => None,
    }
}

/// An element of no interest.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

#[cfg(test)]
mod tests {
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

    /// Rotations of splats come back as x, y, z, w, bit for bit, in every encoding; a file of points has none.
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
}
