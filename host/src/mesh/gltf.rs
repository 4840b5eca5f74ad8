//! glTF 2.0 (`.gltf` with its buffers, `.glb`), parsed by the `gltf` crate. Long, since half of the file are its unit tests,
//! which make broken files one field at a time.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

use ::gltf::accessor::{DataType, Dimensions, Item, Iter};
use ::gltf::buffer::{Source, View};
use ::gltf::json;
use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Buffer, Document, Gltf, Primitive, Semantic};
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use glam::{DVec3, Vec3};
use percent_encoding::percent_decode_str;

use super::{Frames, Mesh, MeshError, Part, area_weighted, check_finite, finish, parse_error};

const FORMAT: &str = "glTF";

/// Reads the normals of all primitives of all meshes, as [`Mesh`] says.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let (document, file) = load(path, bytes)?;
    let faces = file.faces_to_compute_from(&document)?;
    let mut all = Collected::default();
    for (mesh, primitive) in primitives(&document) {
        match primitive.get(&Semantic::Normals) {
            Some(accessor) => all.add(&mesh, &primitive, Accessors::Normals(accessor.index()), || {
                check_finite(path, &file.positions(&primitive)?)?;
                file.normals(&primitive)
            })?,
            None => {
                let accessor = file.attribute(&primitive, &Semantic::Positions)?.index();
                all.add(&mesh, &primitive, Accessors::Faces(accessor), || {
                    let faces = faces.get(&accessor).into_iter().flatten().copied();
                    area_weighted(path, &file.positions(&primitive)?, faces)
                })?;
            }
        }
    }
    finish(path, Mesh { normals: all.elements, parts: all.parts })
}

/// Reads the tangent frames of all primitives of all meshes, as [`Frames`] says.
pub(super) fn parse_frames(path: &Path, bytes: &[u8]) -> Result<Frames, MeshError> {
    let (document, file) = load(path, bytes)?;
    let mut all = Collected::default();
    for (mesh, primitive) in primitives(&document) {
        let [Some(normals), Some(tangents)] =
            [Semantic::Normals, Semantic::Tangents].map(|semantic| primitive.get(&semantic))
        else {
            return Err(MeshError::NoTangents { path: path.into() });
        };
        if normals.count() != tangents.count() {
            return Err(file.error("a primitive has normals and tangents of different number"));
        }
        all.add(&mesh, &primitive, Accessors::Frames(normals.index(), tangents.index()), || {
            check_finite(path, &file.positions(&primitive)?)?;
            let frames = file.normals(&primitive)?.into_iter().zip(file.tangents(&primitive)?);
            Ok(frames.map(|([x, y, z], [a, b, c, d])| [x, y, z, a, b, c, d]).collect())
        })?;
    }
    if all.elements.is_empty() {
        return Err(MeshError::NoTangents { path: path.into() });
    }
    Ok(Frames { frames: all.elements, parts: all.parts })
}

fn primitives(document: &Document) -> impl Iterator<Item = (::gltf::Mesh<'_>, Primitive<'_>)> {
    document.meshes().flat_map(|mesh| mesh.primitives().map(move |primitive| (mesh.clone(), primitive)))
}

/// The accessors that the elements of a primitive come from.
#[derive(PartialEq, Eq, Hash)]
enum Accessors {
    Normals(usize),
    /// Computed: the accessor of positions.
    Faces(usize),
    /// Those of normals and of tangents.
    Frames(usize, usize),
}

/// The elements of the primitives so far, and where those of each lie.
#[derive(Default)]
struct Collected<const N: usize> {
    elements: Vec<[f32; N]>,
    parts: Vec<Part>,
    /// First and count of what was read already.
    places: HashMap<Accessors, (usize, usize)>,
}

impl<const N: usize> Collected<N> {
    /// Adds a primitive; what comes from the same accessors is read once.
    fn add(
        &mut self,
        mesh: &::gltf::Mesh,
        primitive: &Primitive,
        from: Accessors,
        read: impl FnOnce() -> Result<Vec<[f32; N]>, MeshError>,
    ) -> Result<(), MeshError> {
        let computed = matches!(from, Accessors::Faces(_));
        let (first, count) = match self.places.entry(from) {
            Entry::Occupied(place) => *place.get(),
            Entry::Vacant(place) => {
                let elements = read()?;
                let range = *place.insert((self.elements.len(), elements.len()));
                self.elements.extend(elements);
                range
            }
        };
        let name = mesh.name().map(str::to_owned);
        let (mesh, primitive) = (mesh.index(), primitive.index());
        self.parts.push(Part { mesh, name, primitive, first, count, computed });
        Ok(())
    }
}

/// Parses and validates the parts that hold geometry.
fn load<'p>(path: &'p Path, bytes: &[u8]) -> Result<(Document, File<'p>), MeshError> {
    let error = |error: gltf::Error| parse_error(path, FORMAT, error);
    // The parser subtracts the header's size from this length unchecked.
    let glb_length = bytes.strip_prefix(b"glTF").and_then(|rest| rest.get(4..8)).map(u32_from_le);
    if glb_length.is_some_and(|length| length < 12) {
        return Err(parse_error(path, FORMAT, "the GLB header gives a length below its own"));
    }
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(error)?;
    let root = geometry_of(document.into_json());
    check_not_compressed(path, &root)?;
    check_position_indices(path, &root)?;
    let document = Document::from_json(root).map_err(error)?;
    let buffers = read_buffers(path, &document, blob.as_deref())?;
    Ok((document, File { path, buffers }))
}

fn u32_from_le(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// Keeps what normals and tangents depend on, so that an unknown extension of a material, or an attribute of the
/// application's own, does not fail the validation of a mesh that can be read.
fn geometry_of(root: json::Root) -> json::Root {
    const APPEARANCE: [&str; 4] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"];
    /// Attributes in integers, which are read here.
    const QUANTIZATION: &str = "KHR_mesh_quantization";
    let json::Root { accessors, asset, buffers, buffer_views, mut meshes, mut extensions_required, .. } =
        root;
    extensions_required
        .retain(|name| name != QUANTIZATION && !APPEARANCE.iter().any(|prefix| name.starts_with(prefix)));
    for primitive in meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        primitive.attributes.retain(|semantic, _| {
            use json::validation::Checked::Valid;
            matches!(semantic, Valid(Semantic::Positions | Semantic::Normals | Semantic::Tangents))
        });
        primitive.material = None;
        primitive.targets = None;
    }
    json::Root { accessors, asset, buffers, buffer_views, meshes, extensions_required, ..Default::default() }
}

/// Refuses geometry that only a decompressor can read. Where an extension is used but not required, the file has the
/// geometry uncompressed as well.
fn check_not_compressed(path: &Path, root: &json::Root) -> Result<(), MeshError> {
    /// Extension, what it is, and whether glTF-Transform decompresses it.
    const COMPRESSIONS: [(&str, &str, bool); 3] = [
        ("KHR_draco_mesh_compression", "Draco", true),
        ("EXT_meshopt_compression", "meshoptimizer", true),
        ("KHR_meshopt_compression", "meshoptimizer", false),
    ];
    let is_required = |name: &str| root.extensions_required.iter().any(|required| required == name);
    let Some((extension, method, decompresses)) = COMPRESSIONS.into_iter().find(|c| is_required(c.0)) else {
        return Ok(());
    };
    let remedy = match decompresses {
        true => format!(
            "decompress it first, for example with `gltf-transform copy {} uncompressed.glb` (npm package \
             @gltf-transform/cli)",
            path.display()
        ),
        false => "export it without compression".to_owned(),
    };
    Err(MeshError::Compressed { path: path.into(), extension, method, remedy })
}

/// Checks the one index that the validation of the `gltf` crate uses before it is validated.
fn check_position_indices(path: &Path, root: &json::Root) -> Result<(), MeshError> {
    let indices = root.meshes.iter().flat_map(|mesh| &mesh.primitives).flat_map(|p| p.attributes.values());
    match indices.map(|index| index.value()).find(|&index| index >= root.accessors.len()) {
        Some(index) => Err(parse_error(path, FORMAT, format!("no accessor {index}"))),
        None => Ok(()),
    }
}

fn read_buffers(path: &Path, document: &Document, blob: Option<&[u8]>) -> Result<Vec<Vec<u8>>, MeshError> {
    let read = |buffer: Buffer| {
        let bytes = match buffer.source() {
            Source::Bin => {
                blob.map(<[u8]>::to_vec).ok_or_else(|| "it has neither a URI nor a BIN chunk".into())
            }
            Source::Uri(uri) => read_uri(path, uri),
        };
        bytes
            .and_then(|bytes| match bytes.len() < buffer.length() {
                true => Err(format!("it has {} of its {} bytes", bytes.len(), buffer.length())),
                false => Ok(bytes),
            })
            .map_err(|reason| MeshError::MissingBuffer { path: path.into(), buffer: buffer.index(), reason })
    };
    document.buffers().map(read).collect()
}

fn read_uri(path: &Path, uri: &str) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode_data(data);
    }
    let name = percent_decode_str(uri).decode_utf8_lossy();
    if uri.contains(':') || Path::new(name.as_ref()).is_absolute() {
        return Err("its URI is neither a relative file name nor base64 data".into());
    }
    let file = path.with_file_name(name.as_ref());
    std::fs::read(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))
}

fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    // Exporters differ over the padding.
    const LENIENT: GeneralPurposeConfig =
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let (_, encoded) = data.split_once(";base64,").ok_or("its data URI is not in base64")?;
    let engine = GeneralPurpose::new(&alphabet::STANDARD, LENIENT);
    engine.decode(encoded).map_err(|error| format!("its data URI is not in base64: {error}"))
}

/// A document's buffers, at least as long as it declares them.
struct File<'p> {
    path: &'p Path,
    buffers: Vec<Vec<u8>>,
}

impl File<'_> {
    fn positions(&self, primitive: &Primitive) -> Result<Vec<DVec3>, MeshError> {
        let positions = self.vectors::<3>(primitive, &Semantic::Positions, Dimensions::Vec3)?;
        Ok(positions.into_iter().map(|position| Vec3::from(position).as_dvec3()).collect())
    }

    fn normals(&self, primitive: &Primitive) -> Result<Vec<[f32; 3]>, MeshError> {
        self.vectors(primitive, &Semantic::Normals, Dimensions::Vec3)
    }

    fn tangents(&self, primitive: &Primitive) -> Result<Vec<[f32; 4]>, MeshError> {
        self.vectors(primitive, &Semantic::Tangents, Dimensions::Vec4)
    }

    /// The triangles of the primitives without normals, by their accessor of positions: where primitives share one, all
    /// their faces count at each vertex.
    fn faces_to_compute_from(&self, document: &Document) -> Result<HashMap<usize, Vec<[i64; 3]>>, MeshError> {
        let mut faces: HashMap<usize, Vec<_>> = HashMap::new();
        for (_, primitive) in primitives(document) {
            if primitive.get(&Semantic::Normals).is_none() {
                let positions = self.attribute(&primitive, &Semantic::Positions)?;
                let corners = match primitive.indices() {
                    Some(accessor) => self.indices(&primitive, &accessor)?,
                    None => (0..).take(positions.count()).collect(),
                };
                faces.entry(positions.index()).or_default().extend(triangles(primitive.mode(), &corners));
            }
        }
        Ok(faces)
    }

    fn indices(&self, primitive: &Primitive, accessor: &Accessor) -> Result<Vec<i64>, MeshError> {
        let is_integer = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if !is_integer || accessor.dimensions() != Dimensions::Scalar {
            return Err(self.error(format!("accessor {} cannot be indices", accessor.index())));
        }
        self.check_extents(accessor)?;
        let indices = primitive.reader(|buffer| self.data(buffer)).read_indices();
        Ok(indices.ok_or_else(|| self.error("unreadable indices"))?.into_u32().map(i64::from).collect())
    }

    fn attribute<'a>(
        &self,
        primitive: &Primitive<'a>,
        semantic: &Semantic,
    ) -> Result<Accessor<'a>, MeshError> {
        primitive.get(semantic).ok_or_else(|| self.error(format!("a primitive has no {semantic:?}")))
    }

    /// An attribute in floats or, as `KHR_mesh_quantization` has it, in integers: normalised for normals and tangents,
    /// of any kind for positions.
    fn vectors<const N: usize>(
        &self,
        primitive: &Primitive,
        semantic: &Semantic,
        dimensions: Dimensions,
    ) -> Result<Vec<[f32; N]>, MeshError>
    where
        [f32; N]: Item,
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
    {
        let accessor = self.attribute(primitive, semantic)?;
        self.check_extents(&accessor)?;
        let is_position = *semantic == Semantic::Positions;
        let vectors = match (accessor.data_type(), accessor.normalized()) {
            _ if accessor.dimensions() != dimensions => None,
            (DataType::F32, _) => self.components(&accessor, |c: f32| c),
            (DataType::I8, true) => self.components(&accessor, |c: i8| snorm(c, i8::MAX)),
            (DataType::I16, true) => self.components(&accessor, |c: i16| snorm(c, i16::MAX)),
            // Only faces are made of positions, and their normals do not depend on the scale.
            (DataType::I8, false) if is_position => self.components(&accessor, |c: i8| c.into()),
            (DataType::I16, false) if is_position => self.components(&accessor, |c: i16| c.into()),
            (DataType::U8, _) if is_position => self.components(&accessor, |c: u8| c.into()),
            (DataType::U16, _) if is_position => self.components(&accessor, |c: u16| c.into()),
            _ => None,
        };
        vectors.ok_or_else(|| {
            let kinds =
                if is_position { "floats or short integers" } else { "floats or normalised integers" };
            self.error(format!("accessor {} does not have {dimensions:?} of {kinds}", accessor.index()))
        })
    }

    /// The vectors of an accessor of the type `T`; `None` where the parser does not read it.
    fn components<T, const N: usize>(
        &self,
        accessor: &Accessor,
        to_f32: impl Fn(T) -> f32,
    ) -> Option<Vec<[f32; N]>>
    where
        [T; N]: Item,
    {
        let vectors = Iter::<[T; N]>::new(accessor.clone(), |buffer| self.data(buffer))?;
        Some(vectors.map(|vector| vector.map(&to_f32)).collect())
    }

    /// Checks that all parts of an accessor lie in their buffers: the reader takes that for granted.
    fn check_extents(&self, accessor: &Accessor) -> Result<(), MeshError> {
        /// Zeros take no space in the file: without a bound, a few bytes could ask for any memory.
        const MAX_ZEROS: usize = 1 << 24;
        let mut parts = Vec::new();
        match accessor.view() {
            Some(view) => parts.push((view, accessor.offset(), accessor.count(), accessor.size())),
            None if accessor.count() > MAX_ZEROS => {
                return Err(self.error(format!("accessor {} is too long a run of zeros", accessor.index())));
            }
            None => {}
        }
        if let Some(sparse) = accessor.sparse() {
            let (indices, values) = (sparse.indices(), sparse.values());
            parts.push((indices.view(), indices.offset(), sparse.count(), indices.index_type().size()));
            parts.push((values.view(), values.offset(), sparse.count(), accessor.size()));
        }
        match parts.iter().all(|(view, offset, count, size)| self.holds(view, *offset, *count, *size)) {
            true => Ok(()),
            false => {
                Err(self.error(format!("accessor {} is empty or ends past its buffer", accessor.index())))
            }
        }
    }

    fn holds(&self, view: &View, offset: usize, count: usize, size: usize) -> bool {
        let stride = view.stride().unwrap_or(size);
        let end = || count.checked_sub(1)?.checked_mul(stride)?.checked_add(size)?.checked_add(offset);
        let view_end = view.offset().checked_add(view.length());
        let buffer_length = self.buffers.get(view.buffer().index()).map_or(0, Vec::len);
        stride >= size
            && end().is_some_and(|end| end <= view.length())
            && view_end.is_some_and(|end| end <= buffer_length)
    }

    fn data(&self, buffer: Buffer) -> Option<&[u8]> {
        self.buffers.get(buffer.index()).map(Vec::as_slice)
    }

    fn error(&self, reason: impl std::fmt::Display) -> MeshError {
        parse_error(self.path, FORMAT, reason)
    }
}

/// A signed normalised integer as glTF defines it: the lowest value counts as the one above it.
fn snorm<T: Into<f32>>(value: T, max: T) -> f32 {
    (value.into() / max.into()).max(-1.0)
}

/// The triangles of a primitive, wound as the specification orders them; points and lines have none.
fn triangles(mode: Mode, corners: &[i64]) -> Vec<[i64; 3]> {
    match mode {
        Mode::Triangles => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        Mode::TriangleStrip => {
            let flip =
                |(k, c): (usize, &[i64])| if k % 2 == 0 { [c[0], c[1], c[2]] } else { [c[0], c[2], c[1]] };
            corners.windows(3).enumerate().map(flip).collect()
        }
        Mode::TriangleFan => super::fan(corners).collect(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::mesh_count;
    use super::super::tests::{CUBE_CORNERS, CUBE_FACES, Scratch, assert_close, cube_normals};
    use super::*;

    fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
        parse(Path::new("a.glb"), bytes)
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
        let halves = json(r#"{"attributes":{"POSITION":0},"indices":2},{"attributes":{"POSITION":0},"indices":4}"#, "")
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

    /// Normals and tangents of `KHR_mesh_quantization` are c / max, the lowest integer -1: as the specification says.
    #[test]
    fn quantized_normals() {
        let path = Path::new("a.glb");
        let bytes: Vec<i8> = (0..64).map(|k| [0, 127, -127, -128, 1, -64][k % 6]).collect();
        let words: Vec<i16> = (0..64).map(|k| [0, 32767, -32767, -32768, 1, -16384][k % 6]).collect();
        let of_bytes = quantized(5120, true, 1, &bytes.iter().map(|&c| c as u8).collect::<Vec<_>>());
        let of_words =
            quantized(5122, true, 2, &words.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<_>>());
        for (file, [one, low]) in
            [(of_bytes, [1.0 / 127.0, -64.0 / 127.0]), (of_words, [1.0 / 32767.0, -16384.0 / 32767.0])]
        {
            let value = |k: usize| [0.0, 1.0, -1.0, -1.0, one, low][k % 6];
            let Frames { frames, .. } = parse_frames(path, &file).unwrap();
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
        let read = |bytes: &[u8]| parse_frames(Path::new("a.glb"), bytes);
        let twice = format!("{WITH_TANGENTS},{WITH_TANGENTS}");
        let Frames { frames, parts } = read(&cube(&twice)).unwrap();
        assert_eq!(frames, expected);
        assert_eq!(
            parts.iter().map(|p| (p.primitive, p.first, p.count)).collect::<Vec<_>>(),
            [(0, 0, 8), (1, 0, 8)]
        );
        assert_eq!(super::tests::read(&cube(&twice)).unwrap().normals, cube_normals());
        for without in [WITH_NORMALS, WITHOUT_NORMALS] {
            let result = read(&cube(&format!("{WITH_TANGENTS},{without}")));
            assert!(matches!(result, Err(MeshError::NoTangents { .. })), "{result:?}");
        }
        for (from, to) in
            [(r#"8,"type":"VEC4""#, r#"7,"type":"VEC4""#), ("VEC4", "VEC3"), (r#"T":3"#, r#"T":9"#)]
        {
            let result = read(&glb(&json(WITH_TANGENTS, "").replace(from, to), Some(&cube_buffer())));
            assert!(matches!(result, Err(MeshError::Parse { .. })), "{from} {to}: {result:?}");
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

    /// The buffer is found as a data URI, padded or not, and in a file whose name is percent-encoded.
    #[test]
    fn external_buffers() {
        let scratch = Scratch::new("gltf-buffers");
        let encoded = base64::engine::general_purpose::STANDARD.encode([cube_buffer(), vec![0]].concat());
        std::fs::write(scratch.path("the cube.bin"), cube_buffer()).unwrap();
        let data = "data:application/octet-stream;base64,";
        for uri in [
            format!("{data}{encoded}"),
            format!("{data}{}", encoded.trim_end_matches('=')),
            "the%20cube.bin".into(),
        ] {
            let path = scratch.path("a.gltf");
            std::fs::write(&path, json(WITH_NORMALS, &format!(r#","uri":"{uri}""#))).unwrap();
            assert_eq!(super::super::read(&path).unwrap().normals, cube_normals());
        }
    }

    /// Each way in which a buffer can be missing names the buffer.
    #[test]
    fn missing_buffers() {
        let uris = [
            "absent.bin",
            "/etc/hostname",
            "http://example.org/a.bin",
            "data:,abc",
            "data:;base64,*",
            "data:;base64,AA",
        ];
        for uri in uris {
            let result = read(json(WITH_NORMALS, &format!(r#","uri":"{uri}""#)).as_bytes());
            assert!(matches!(result, Err(MeshError::MissingBuffer { buffer: 0, .. })), "{uri}: {result:?}");
        }
        for blob in [None, Some(&cube_buffer()[..100])] {
            let result = read(&glb(&json(WITH_NORMALS, ""), blob));
            assert!(matches!(result, Err(MeshError::MissingBuffer { buffer: 0, .. })));
        }
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
    }

    /// Extensions of materials and attributes of the application do not matter; compression does.
    #[test]
    fn extensions() {
        let document = json(WITH_NORMALS, "").replace(r#""NORMAL""#, r#""_FACE":2,"NORMAL""#);
        let required = |name| document.replacen('{', &format!(r#"{{"extensionsRequired":["{name}"],"#), 1);
        let read = |name| read(&glb(&required(name), Some(&cube_buffer())));
        assert_eq!(read("KHR_materials_unlit").unwrap().normals, cube_normals());
        assert!(is_parse(&read("KHR_of_the_future")));
        for (name, remedy) in [
            ("KHR_draco_mesh_compression", "gltf-transform copy a.glb"),
            ("EXT_meshopt_compression", "gltf-transform copy a.glb"),
            ("KHR_meshopt_compression", "export it without"),
        ] {
            let error = read(name).unwrap_err();
            assert!(matches!(error, MeshError::Compressed { .. }), "{error}");
            assert!([name, remedy].iter().all(|word| error.to_string().contains(word)), "{error}");
        }
    }

    /// Where compression is not required, the file has the geometry uncompressed.
    #[test]
    fn compression_that_is_not_required() {
        let used = r#"{"extensionsUsed":["EXT_meshopt_compression"],"#;
        let document = json(WITH_NORMALS, "").replacen('{', used, 1);
        assert_eq!(read(&glb(&document, Some(&cube_buffer()))).unwrap().normals, cube_normals());
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

    /// One wrong byte anywhere does not panic.
    #[test]
    fn damage_does_not_panic() {
        for primitives in [WITH_TANGENTS, WITHOUT_NORMALS] {
            let bytes = cube(primitives);
            for at in 0..bytes.len() {
                for value in [0, b'0', b'9', b'-', b'"', b',', 0xff] {
                    let mut damaged = bytes.clone();
                    damaged[at] = value;
                    let _ = (read(&damaged), parse_frames(Path::new("a.glb"), &damaged));
                }
            }
        }
    }
}
