//! PLY, ASCII and binary of both byte orders, parsed by `ply-rs-bw`; an element at a time, since a list of all faces takes
//! many times their size in the file.

mod header;
#[cfg(test)]
mod tests;

use std::path::Path;

use ply_rs_bw::ply::{
    ElementDef, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use glam::DVec3;

use super::faces::{Fan, Positions, Strip, Sums, resolve};
use super::{Mesh, MeshError, Part, Rotations, Shape, check_finite, list_of, one_part};
pub(crate) use header::{Payload, check_counts, size};

pub(super) const FORMAT: &str = "PLY";

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
    Ok((shape.with_surface(path)?.with_normals(path)?, source == Source::Faces))
}

/// Reads the rotations of Gaussian splats, in the properties that the first program for them wrote (Kerbl et al. 2023).
pub(super) fn parse_rotations(path: &Path, bytes: &[u8]) -> Result<Rotations, MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    let vertex = header.elements.get("vertex");
    if vertex.is_some_and(|vertex| has_scalars(vertex, &[PACKED_ROTATION])) {
        let (extension, method) = (PACKED_ROTATION, "PlayCanvas's packing of splats");
        let remedy = "unpack it by `npx @playcanvas/splat-transform FILE.compressed.ply FILE.ply`".to_owned();
        return Err(MeshError::Compressed { path: path.into(), extension, method, remedy });
    }
    let vertex = vertex.filter(|vertex| has_scalars(vertex, &ROTATION) && vertex.count > 0);
    let count = vertex.ok_or_else(|| MeshError::NoRotations { path: path.into() })?.count;
    let mut rotations = list_of(path, count)?;
    for (name, element) in &header.elements {
        if name != "vertex" {
            payload.skip(element)?;
            continue;
        }
        for _ in 0..count {
            rotations.push(payload.next::<Vertex>(element)?.rotation);
        }
    }
    Ok(Rotations { rotations, parts: vec![Part::whole(count, false)] })
}

/// The properties of a normal.
pub(super) const NORMAL: [&str; 3] = ["nx", "ny", "nz"];

/// The properties of a rotation: x, y, z and w, which comes first in the file.
pub(super) const ROTATION: [&str; 4] = ["rot_1", "rot_2", "rot_3", "rot_0"];

/// The property of `.compressed.ply` files that holds a rotation's smallest three in 32 bits.
const PACKED_ROTATION: &str = "packed_rotation";

/// The property names in use for texture coordinates.
const COORDINATES: [[&str; 2]; 3] = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]];

/// True where an element has all of these properties, as numbers.
pub(super) fn has_scalars(element: &ElementDef, names: &[&str]) -> bool {
    names.iter().all(|name| {
        let property = element.properties.get(*name);
        property.is_some_and(|property| matches!(property.data_type, PropertyType::Scalar(_)))
    })
}

/// The source of the normals.
#[derive(Clone, Copy, PartialEq)]
enum Source {
    Normals,
    Faces,
}

impl Source {
    fn of(header: &Header) -> Option<Self> {
        let vertex = header.elements.get("vertex")?;
        if has_scalars(vertex, &NORMAL) {
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
    pub(super) rotation: [f32; 4],
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
