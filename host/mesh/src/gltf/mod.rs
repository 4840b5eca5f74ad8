//! glTF 2.0 (`.gltf` with its buffers, `.glb`), parsed by the `gltf` crate.

pub(super) mod accessor;
pub(super) mod buffers;
pub(super) mod document;
pub(super) mod shape;
#[cfg(test)]
mod tests;
mod texture;

use std::borrow::Cow;
use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::hash::Hash;
use std::path::Path;
use std::sync::Arc;

use ::gltf::accessor::{DataType, Dimensions, Item, Iter};
use ::gltf::binary::Glb;
use ::gltf::json::validation::Checked;
use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Buffer, Document, Semantic};

use glam::Vec3;

use super::faces::{Fan, Positions, Strip, Sums};
use super::format::without_mark;
use super::{
    Frames, Generated, Mesh, MeshError, Part, Reach, Rotations, check_finite, list_of, parse_error, place,
    reserve,
};
use buffers::Content;
use document::{Animation, Geometry, Primitive, Primitives, check_not_compressed, wrong_version};

pub(super) const FORMAT: &str = "glTF";

/// Reads the normals of all primitives of all meshes, in the order of [`Mesh`].
pub(super) fn parse(path: &Path, bytes: &[u8], reach: Reach) -> Result<Mesh, MeshError> {
    let file = load(path, bytes, reach, &[Semantic::Positions, Semantic::Normals])?;
    let without_normals = |primitive: &Primitive| primitive.get(&Semantic::Normals).is_none();
    let faces = file.grouped(|one| without_normals(one).then(|| one.get(&Semantic::Positions)))?;
    let (mut all, mut has_faces) = (Collected::new(&file), false);
    for (mesh, at, primitive) in file.primitives() {
        match primitive.get(&Semantic::Normals) {
            Some(accessor) => {
                file.check_counts(primitive, [Semantic::Positions, Semantic::Normals])?;
                all.add(mesh, at, Accessors::Normals(accessor), |normals| {
                    file.positions(primitive, |_| ())?;
                    reserve(path, normals, file.accessor(accessor)?.count())?;
                    file.vectors(primitive, &Semantic::Normals, Dimensions::Vec3, |normal| {
                        normals.push(normal)
                    })
                })?;
            }
            None => {
                let accessor = file.attribute(primitive, &Semantic::Positions)?;
                all.add(mesh, at, Accessors::Faces(accessor.index()), |normals| {
                    let mut positions = list_of(path, accessor.count())?;
                    file.positions(primitive, |position| positions.push(position))?;
                    let mut sums = Sums::new(path, Positions::Single(positions));
                    for primitive in faces.get(&primitive.get(&Semantic::Positions)).into_iter().flatten() {
                        sums.add_all(triangles(file.mode(primitive)?, file.corners(primitive)?))?;
                    }
                    has_faces |= sums.has_faces();
                    let computed = sums.normals();
                    reserve(path, normals, computed.len())?;
                    normals.extend(computed);
                    Ok(())
                })?;
            }
        }
    }
    let mesh = Mesh { normals: all.elements, parts: all.parts };
    let is_computed = mesh.computed() == mesh.parts.len();
    if mesh.normals.is_empty() || (is_computed && !has_faces) {
        return Err(MeshError::NoFaces { path: path.into() });
    }
    Ok(mesh)
}

/// Reads the tangent frames of all primitives of all meshes, in the order of [`Frames`].
pub(super) fn parse_frames(path: &Path, bytes: &[u8], reach: Reach) -> Result<Frames, MeshError> {
    let semantics = [Semantic::Positions, Semantic::Normals, Semantic::Tangents, Semantic::TexCoords(0)];
    let file = load(path, bytes, reach, &semantics)?;
    let groups = file.grouped(|primitive| Some(shape::key(primitive)))?;
    let (mut all, mut generated) = (Collected::new(&file), Generated::default());
    let sources = [Semantic::Tangents, Semantic::TexCoords(0)];
    let has_source = |primitive: &Primitive| sources.iter().any(|source| primitive.get(source).is_some());
    let has_tangents = file.primitives().any(|(.., primitive)| has_source(primitive));
    let mut has_surface = false;
    for (mesh, at, primitive) in file.primitives() {
        match (primitive.get(&Semantic::Normals), primitive.get(&Semantic::Tangents)) {
            (Some(normals), Some(tangents)) => {
                file.check_counts(primitive, [Semantic::Positions, Semantic::Normals])?;
                file.check_counts(primitive, [Semantic::Normals, Semantic::Tangents])?;
                has_surface = true;
                let read = |frames: &mut Vec<_>| file.add_frames(primitive, frames);
                all.add(mesh, at, Accessors::Frames(normals, tangents), read)?;
            }
            (_, None) if has_tangents => {
                all.add(mesh, at, Accessors::Shape(shape::key(primitive)), |frames| {
                    let shape = file.shape(primitive, &groups)?.with_normals(path)?;
                    has_surface |= !shape.triangles.is_empty();
                    // In glTF v grows downwards.
                    frames.extend(shape.frames(path, -1.0, &mut generated)?);
                    Ok(())
                })?
            }
            _ => return Err(file.no_tangents(mesh, at)),
        }
    }
    if all.elements.is_empty() {
        return Err(MeshError::NoTangents { path: path.into(), lacking: String::new() });
    }
    if !has_surface {
        return Err(MeshError::NoSurface { path: path.into() });
    }
    Ok(Frames { frames: all.elements, parts: all.parts, generated })
}

/// Reads the rotations of all samplers of all animations, and of all splats, in the order of [`Rotations`].
pub(super) fn parse_rotations(path: &Path, bytes: &[u8], reach: Reach) -> Result<Rotations, MeshError> {
    let file = load(path, bytes, reach, &[])?;
    let mut all = Collected::new(&file);
    for Rotating { name, of, at, accessor: index, is_cubic } in file.rotations() {
        let accessor = file.accessor(index)?;
        let name = || name.map(short);
        all.put(of, at, name, Accessors::Rotations(index), accessor.count(), |rotations| {
            reserve(path, rotations, accessor.count())?;
            let mut at = 0;
            file.vectors_of(&accessor, false, Dimensions::Vec4, |rotation| {
                // A key of a cubic spline is a tangent, the value and another tangent.
                if !is_cubic || at % 3 == 1 {
                    rotations.push(rotation);
                }
                at += 1;
            })
        })?;
    }
    match all.elements.is_empty() {
        true => Err(MeshError::NoRotations { path: path.into() }),
        false => Ok(Rotations { rotations: all.elements, parts: all.parts }),
    }
}

/// The accessors that the elements of a primitive or a sampler come from.
#[derive(PartialEq, Eq, Hash)]
enum Accessors {
    Normals(u32),
    /// Computed: the accessor of positions.
    Faces(usize),
    /// The accessors of normals and of tangents.
    Frames(u32, u32),
    /// Tangents are generated.
    Shape(shape::Key),
    Rotations(u32),
}

/// A sampler of an animation, or a primitive of splats: its place, the accessor of its rotations, and whether these have tangents
/// beside them.
struct Rotating<'f> {
    /// The name of the animation or the mesh.
    name: Option<&'f str>,
    /// The place of that.
    of: usize,
    at: usize,
    accessor: u32,
    is_cubic: bool,
}

/// The elements of the primitives or samplers so far, and where those of each lie.
struct Collected<'f, const N: usize> {
    file: &'f File<'f>,
    elements: Vec<[f32; N]>,
    parts: Vec<Part>,
    /// First and count of the elements read already.
    places: HashMap<Accessors, (usize, usize)>,
}

impl<'f, const N: usize> Collected<'f, N> {
    fn new(file: &'f File<'f>) -> Self {
        Self { file, elements: Vec::new(), parts: Vec::new(), places: HashMap::new() }
    }

    /// Adds a primitive of a mesh; elements from the same accessors are read once.
    fn add(
        &mut self,
        mesh: usize,
        primitive: usize,
        from: Accessors,
        read: impl FnOnce(&mut Vec<[f32; N]>) -> Result<(), MeshError>,
    ) -> Result<(), MeshError> {
        let file = self.file;
        let of = &file.meshes[mesh].primitives[primitive];
        let vertices = file.attribute(of, &Semantic::Positions)?.count();
        let name = || file.meshes[mesh].name.as_deref().map(short);
        self.put(mesh, primitive, name, from, vertices, read)
    }

    /// Adds a primitive of a mesh, or a sampler of an animation, of that name, which has as many elements as `count` at most.
    fn put(
        &mut self,
        mesh: usize,
        primitive: usize,
        name: impl FnOnce() -> Option<Arc<str>>,
        from: Accessors,
        count: usize,
        read: impl FnOnce(&mut Vec<[f32; N]>) -> Result<(), MeshError>,
    ) -> Result<(), MeshError> {
        let computed = matches!(from, Accessors::Faces(_) | Accessors::Shape([_, None, _]));
        let (first, count) = match self.places.entry(from) {
            Entry::Occupied(place) => *place.get(),
            Entry::Vacant(place) => {
                let first = self.elements.len();
                self.file.check_vertices(first.saturating_add(count))?;
                read(&mut self.elements)?;
                *place.insert((first, self.elements.len() - first))
            }
        };
        // One name for all primitives of a mesh.
        let named = self.parts.last().filter(|part| part.mesh == mesh);
        let name = named.map_or_else(name, |part| part.name.clone());
        self.parts.push(Part { mesh, name, primitive, first, count, computed });
        Ok(())
    }
}

/// A chunk of a GLB, or the whole of a `.gltf`.
type Chunk<'b> = Cow<'b, [u8]>;

/// The JSON of a file, and the binary chunk of a GLB.
pub(super) fn chunks<'b>(path: &Path, bytes: &'b [u8]) -> Result<(Chunk<'b>, Option<Chunk<'b>>), MeshError> {
    let bytes = without_mark(bytes);
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.into(), None));
    }
    // The parser subtracts the header's size from this length unchecked.
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    if length.is_some_and(|length| length < 12) {
        return Err(parse_error(path, FORMAT, "the GLB header gives a length below its own"));
    }
    match Glb::from_slice(bytes) {
        Ok(Glb { json, bin, .. }) => Ok((json, bin)),
        Err(::gltf::Error::Binary(::gltf::binary::Error::Version(version))) => {
            Err(wrong_version(path, version))
        }
        Err(error) => Err(parse_error(path, FORMAT, error)),
    }
}

/// Parses and validates the parts that hold geometry.
pub(super) fn load<'p>(
    path: &'p Path,
    bytes: &'p [u8],
    reach: Reach,
    semantics: &[Semantic],
) -> Result<File<'p>, MeshError> {
    let (json, blob) = chunks(path, bytes)?;
    let (root, meshes, animations) = Geometry::of(path, &json)?.into_root();
    check_not_compressed(path, &root.extensions_required)?;
    // Some files use compression without requiring it, and have nothing else.
    if root.accessors.iter().any(|one| one.buffer_view.is_none() && one.sparse.is_none()) {
        check_not_compressed(path, &root.extensions_used)?;
    }
    let document = document::validated(root).map_err(|error| parse_error(path, FORMAT, error))?;
    let mut file = File { path, document, meshes, animations, buffers: Vec::new(), size: bytes.len() };
    let used = file.used_buffers(semantics)?;
    let mut root = file.document.into_json();
    let outside;
    (file.buffers, outside) = buffers::read(path, &mut root.buffers, &used, blob, reach)?;
    file.document = Document::from_json_without_validation(root);
    file.size += outside;
    Ok(file)
}

/// A name as far as anybody reads it. Each primitive of a mesh tells it in JSON.
pub(super) fn short(name: &str) -> Arc<str> {
    const MOST: usize = 200;
    match name.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &name[..end]).into(),
        None => name.into(),
    }
}

/// A document and its buffers. Those that are used are at least as long as it declares them, the others empty.
pub(super) struct File<'p> {
    pub(super) path: &'p Path,
    pub(super) document: Document,
    pub(super) meshes: Vec<Primitives>,
    animations: Vec<Animation>,
    pub(super) buffers: Vec<Content<'p>>,
    /// Bytes of the document and these buffers.
    pub(super) size: usize,
}

impl File<'_> {
    /// The primitives, each with the places of its mesh and of itself there.
    pub(super) fn primitives(&self) -> impl Iterator<Item = (usize, usize, &Primitive)> {
        self.meshes.iter().enumerate().flat_map(|(mesh, all)| {
            all.primitives.iter().enumerate().map(move |(at, primitive)| (mesh, at, primitive))
        })
    }

    /// The sources of rotations: those of animations, then those of splats.
    fn rotations(&self) -> impl Iterator<Item = Rotating<'_>> {
        let of_animations = self.animations.iter().enumerate().flat_map(|(of, animation)| {
            let name = animation.name.as_deref();
            let samplers = animation.rotations();
            samplers.map(move |(at, accessor, is_cubic)| Rotating { name, of, at, accessor, is_cubic })
        });
        let of_splats = self.primitives().filter_map(|(of, at, primitive)| {
            let name = self.meshes[of].name.as_deref();
            primitive.rotations().map(|accessor| Rotating { name, of, at, accessor, is_cubic: false })
        });
        of_animations.chain(of_splats)
    }

    pub(super) fn accessor(&self, index: u32) -> Result<Accessor<'_>, MeshError> {
        let accessor = self.document.accessors().nth(index as usize);
        accessor.ok_or_else(|| self.error(format!("no accessor {index}")))
    }

    fn mode(&self, primitive: &Primitive) -> Result<Mode, MeshError> {
        match primitive.mode {
            Checked::Valid(mode) => Ok(mode),
            Checked::Invalid => Err(self.error("a primitive has a mode that glTF does not know")),
        }
    }

    /// The buffers that these attributes lie in and, where a primitive has no normals, its indices; texture coordinates and all
    /// indices where they are asked for, and tangents are not or are not there. Without attributes, those of rotations.
    fn used_buffers(&self, semantics: &[Semantic]) -> Result<BTreeSet<usize>, MeshError> {
        if semantics.is_empty() {
            return self.buffers_of(self.rotations().map(|rotating| rotating.accessor));
        }
        let mut used = BTreeSet::new();
        let texture = Semantic::TexCoords(0);
        for (.., primitive) in self.primitives() {
            let has = |semantic| semantics.contains(&semantic) && primitive.get(&semantic).is_some();
            let has_texture = semantics.contains(&texture) && !has(Semantic::Tangents);
            let has_faces = has_texture || primitive.get(&Semantic::Normals).is_none();
            let indices = primitive.indices.filter(|_| has_faces);
            let attributes = semantics.iter().filter(|semantic| has_texture || **semantic != texture);
            let attributes = attributes.filter_map(|semantic| primitive.get(semantic));
            used.append(&mut self.buffers_of(attributes.chain(indices))?);
        }
        Ok(used)
    }

    /// The buffers that these accessors lie in.
    fn buffers_of(&self, accessors: impl Iterator<Item = u32>) -> Result<BTreeSet<usize>, MeshError> {
        let mut used = BTreeSet::new();
        for index in accessors {
            let accessor = self.accessor(index)?;
            let sparse = accessor.sparse().map(|sparse| [sparse.indices().view(), sparse.values().view()]);
            let views = accessor.view().into_iter().chain(sparse.into_iter().flatten());
            used.extend(views.map(|view| view.buffer().index()));
        }
        Ok(used)
    }

    /// Refuses more vertices than a file of this size has: where accessors overlap, or have no bytes at all, a short file
    /// could ask for any memory.
    fn check_vertices(&self, vertices: usize) -> Result<(), MeshError> {
        // Three components take a byte each, at least.
        self.check_total(vertices, self.size / 3, "vertices")
    }

    pub(super) fn check_total(&self, count: usize, most: usize, what: &str) -> Result<(), MeshError> {
        /// Accessors of zeros without bytes are rare, and short.
        const ZEROS: usize = 1 << 16;
        match count <= most + ZEROS {
            true => Ok(()),
            false => Err(self.error(format!("{count} {what} in a file of {} bytes", self.size))),
        }
    }

    /// Reads the positions, and checks that all are finite.
    fn positions(&self, primitive: &Primitive, mut each: impl FnMut([f32; 3])) -> Result<(), MeshError> {
        let (mut vertex, mut checked) = (0, Ok(()));
        self.vectors(primitive, &Semantic::Positions, Dimensions::Vec3, |position| {
            if checked.is_ok() {
                checked = check_finite(self.path, vertex, Vec3::from(position).as_dvec3());
                vertex += 1;
                each(position);
            }
        })?;
        checked
    }

    /// Primitives by the accessors that their vertices come from: where some share these, all their faces count at each vertex,
    /// the same faces once.
    fn grouped<K: Copy + Eq + Hash>(
        &self,
        key: impl Fn(&Primitive) -> Option<K>,
    ) -> Result<HashMap<K, Vec<&Primitive>>, MeshError> {
        /// An index takes a byte at least. Files of several levels of detail may share some.
        const SHARED: usize = 4;
        let (mut faces, mut seen) = (HashMap::<K, Vec<_>>::new(), HashSet::new());
        let mut corners = 0_usize;
        for (.., primitive) in self.primitives() {
            let Some(key) = key(primitive) else { continue };
            let positions = self.attribute(primitive, &Semantic::Positions)?;
            if seen.insert((key, primitive.indices, self.mode(primitive)?.as_gl_enum())) {
                let corner = primitive.indices.map_or_else(|| Ok(positions), |index| self.accessor(index))?;
                corners = corners.saturating_add(corner.count());
                faces.entry(key).or_default().push(primitive);
            }
        }
        self.check_total(corners, SHARED * self.size, "corners of faces")?;
        Ok(faces)
    }

    /// Adds the normals and tangents of a primitive.
    fn add_frames(&self, primitive: &Primitive, frames: &mut Vec<[f32; 7]>) -> Result<(), MeshError> {
        self.positions(primitive, |_| ())?;
        reserve(self.path, frames, self.attribute(primitive, &Semantic::Normals)?.count())?;
        let first = frames.len();
        self.vectors(primitive, &Semantic::Normals, Dimensions::Vec3, |[x, y, z]| {
            frames.push([x, y, z, 0.0, 0.0, 0.0, 0.0]);
        })?;
        let mut frames = frames[first..].iter_mut();
        self.vectors(primitive, &Semantic::Tangents, Dimensions::Vec4, |tangent: [f32; 4]| {
            if let Some(frame) = frames.next() {
                frame[3..].copy_from_slice(&tangent);
            }
        })
    }

    /// The vertices that a primitive's faces are made of.
    fn corners<'a>(&'a self, primitive: &Primitive) -> Result<Box<dyn Iterator<Item = i64> + 'a>, MeshError> {
        let Some(index) = primitive.indices else {
            return Ok(Box::new((0..).take(self.attribute(primitive, &Semantic::Positions)?.count())));
        };
        let accessor = self.accessor(index)?;
        self.check_extents(&accessor)?;
        let kind = (accessor.data_type(), accessor.dimensions());
        let corners = match kind {
            (DataType::U8, Dimensions::Scalar) => self.integers::<u8>(accessor),
            (DataType::U16, Dimensions::Scalar) => self.integers::<u16>(accessor),
            (DataType::U32, Dimensions::Scalar) => self.integers::<u32>(accessor),
            _ => None,
        };
        corners.ok_or_else(|| self.error(format!("accessor {index} cannot be indices")))
    }

    fn integers<'a, T: Item + Into<i64> + 'a>(
        &'a self,
        accessor: Accessor<'a>,
    ) -> Option<Box<dyn Iterator<Item = i64> + 'a>> {
        let integers = Iter::<T>::new(accessor, |buffer| self.data(buffer))?;
        Some(Box::new(integers.map(Into::into)))
    }

    fn attribute(&self, primitive: &Primitive, semantic: &Semantic) -> Result<Accessor<'_>, MeshError> {
        let index = primitive.get(semantic);
        self.accessor(index.ok_or_else(|| self.error(format!("a primitive has no {semantic:?}")))?)
    }

    /// Checks that a primitive has as many of one attribute as of the other.
    pub(super) fn check_counts(
        &self,
        primitive: &Primitive,
        semantics: [Semantic; 2],
    ) -> Result<(), MeshError> {
        let [a, b] = &semantics;
        let counts = [self.attribute(primitive, a)?.count(), self.attribute(primitive, b)?.count()];
        match counts {
            [first, second] if first != second => {
                Err(self.error(format!("a primitive has {first} {a:?} and {second} {b:?}")))
            }
            _ => Ok(()),
        }
    }

    fn data(&self, buffer: Buffer) -> Option<&[u8]> {
        self.buffers.get(buffer.index()).map(|bytes| &***bytes)
    }

    /// The error of a primitive without normals or tangents.
    pub(super) fn no_tangents(&self, mesh: usize, at: usize) -> MeshError {
        let lacking = format!(": {} lacks them", place(at, mesh, self.meshes[mesh].name.as_deref()));
        MeshError::NoTangents { path: self.path.into(), lacking }
    }

    pub(super) fn error(&self, reason: impl std::fmt::Display) -> MeshError {
        parse_error(self.path, FORMAT, reason)
    }
}

/// The triangles of a primitive, wound as the specification orders them; points and lines have none.
fn triangles(mode: Mode, corners: impl Iterator<Item = i64>) -> impl Iterator<Item = [i64; 3]> {
    let (mut fan, mut strip) = (Fan::default(), Strip::default());
    let mut last = [0; 2];
    corners.enumerate().filter_map(move |(at, corner)| {
        let [a, b] = last;
        last = [b, corner];
        match mode {
            Mode::Triangles => (at % 3 == 2).then_some([a, b, corner]),
            Mode::TriangleStrip => strip.push(corner),
            Mode::TriangleFan => fan.push(corner),
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => None,
        }
    })
}
