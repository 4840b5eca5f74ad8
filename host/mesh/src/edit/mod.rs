//! Files of meshes whose normals and tangents, or rotations of splats, are moved; all else in them stays as it is, byte for byte.

mod gltf;
mod obj;
mod ply;

use crate::{FileFormat, MeshError, Reach, list_of};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Vectors that are moved at a time.
const CHUNK: usize = 1 << 14;

/// An attribute of vertices that holds unit vectors or unit quaternions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Attribute {
    /// The normal.
    Normal,
    /// The tangent; its fourth component, the handedness, changes with frames alone.
    Tangent,
    /// The rotation of a Gaussian splat: x, y, z and w.
    Rotation,
}

/// A function that moves vectors of a mesh and a kind.
pub type ChangeVectors<'c> = dyn FnMut(usize, Attribute, &mut [[f32; 3]]) + 'c;

/// A function that moves vectors in place, some at a time. Its first argument is the mesh: its index in a glTF file, else 0.
pub enum Change<'c> {
    /// Moves normals and tangents, each by themselves.
    Vectors(&'c mut ChangeVectors<'c>),
    /// Moves normals with their tangents and handedness.
    Frames(&'c mut dyn FnMut(usize, &mut [[f32; 7]])),
    /// Moves rotations of Gaussian splats.
    Rotations(&'c mut dyn FnMut(usize, &mut [[f32; 4]])),
}

impl Change<'_> {
    /// The attributes that are moved, those of each list together.
    fn groups(&self) -> &'static [&'static [Attribute]] {
        match self {
            Self::Vectors(_) => &[&[Attribute::Normal], &[Attribute::Tangent]],
            Self::Frames(_) => &[&[Attribute::Normal, Attribute::Tangent]],
            Self::Rotations(_) => &[&[Attribute::Rotation]],
        }
    }
}

/// A file whose vectors were moved.
#[derive(Debug)]
pub struct Edited {
    /// The contents of the file.
    pub bytes: Vec<u8>,
    /// The names of the meshes; none for OBJ and PLY, which have one mesh.
    pub meshes: Vec<Option<Arc<str>>>,
    /// The files that it names: buffers and images of glTF.
    pub files: Vec<Beside>,
    /// Vectors that were left out, in words: those of morph targets, for example.
    pub warnings: Vec<String>,
}

/// A file that a glTF file names.
#[derive(Debug)]
pub struct Beside {
    /// The path from the folder of the glTF file.
    pub name: PathBuf,
    /// The path that it was found at.
    pub source: PathBuf,
    /// The first bytes, where vectors in them were moved; those after them, and all of other files, stay.
    pub start: Option<Vec<u8>>,
}

/// Moves the vectors of a mesh file in memory; `path` stands in errors, and buffers within `reach` of it may be read.
///
/// # Errors
///
/// [`MeshError::NotMovable`] for vectors that cannot be moved where they are, [`MeshError::NoTangents`] where frames are
/// wanted and some vertex has none, and the errors of [`parse`](crate::parse).
pub fn edit(
    path: &Path,
    format: FileFormat,
    bytes: &[u8],
    reach: Reach,
    change: Change<'_>,
) -> Result<Edited, MeshError> {
    match (format, change) {
        (FileFormat::Gltf, change) => gltf::edit(path, bytes, reach, change),
        (_, Change::Vectors(change)) => {
            let edit = if format == FileFormat::Obj { obj::edit } else { ply::edit_normals };
            edit(path, bytes, &mut |normals| change(0, Attribute::Normal, normals))
        }
        (_, Change::Frames(_)) => Err(MeshError::NoTangents { path: path.into(), lacking: String::new() }),
        (FileFormat::Ply, Change::Rotations(change)) => {
            ply::edit_rotations(path, bytes, &mut |rotations| change(0, rotations))
        }
        (FileFormat::Obj, Change::Rotations(_)) => Err(no_splats(path)),
    }
}

/// The files that a mesh file in memory names, as far as they are there: buffers and images of glTF.
///
/// # Errors
///
/// [`MeshError::Parse`] for what is no glTF.
pub fn sources(path: &Path, format: FileFormat, bytes: &[u8]) -> Result<Vec<PathBuf>, MeshError> {
    if format == FileFormat::Gltf { gltf::sources(path, bytes) } else { Ok(Vec::new()) }
}

/// The error of a file without normals.
fn no_normals(path: &Path) -> MeshError {
    not_movable(path, "there are no normals".into(), "export the mesh with normals")
}

/// The error of a file without splats.
fn no_splats(path: &Path) -> MeshError {
    let remedy = "name a .ply with rot_0 to rot_3, or a .gltf or .glb with KHR_gaussian_splatting";
    not_movable(path, "only rotations of splats are moved".into(), remedy)
}

fn not_movable(path: &Path, reason: String, remedy: &'static str) -> MeshError {
    MeshError::NotMovable { path: path.into(), reason, remedy }
}

/// The place of a part of a text in the whole.
fn span(whole: &[u8], part: &[u8]) -> Option<Range<usize>> {
    let start = (part.as_ptr() as usize).checked_sub(whole.as_ptr() as usize)?;
    let end = start.checked_add(part.len())?;
    (end <= whole.len()).then_some(start..end)
}

/// The shortest text of a number that is read as the same `f32`.
fn shortest(value: f32) -> String {
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// A copy of a file with parts of it replaced, from its beginning to its end.
struct Splice<'b> {
    bytes: &'b [u8],
    done: usize,
    copy: Vec<u8>,
}

impl<'b> Splice<'b> {
    fn new(path: &Path, bytes: &'b [u8]) -> Result<Self, MeshError> {
        Ok(Self { bytes, done: 0, copy: list_of(path, bytes.len())? })
    }

    /// Replaces a part that begins behind those before; another is left as it is.
    fn replace(&mut self, part: Range<usize>, with: &[u8]) {
        if let Some(kept) = self.bytes.get(self.done..part.start) {
            self.copy.extend_from_slice(kept);
            self.copy.extend_from_slice(with);
            self.done = part.end;
        }
    }

    fn finish(mut self) -> Vec<u8> {
        self.copy.extend_from_slice(self.bytes.get(self.done..).unwrap_or_default());
        self.copy
    }
}

/// The vectors of a file with one list of them, of `N` components each.
struct Moved<'b, 'c, const N: usize> {
    splice: Splice<'b>,
    change: &'c mut dyn FnMut(&mut [[f32; N]]),
    /// Writes a component in a place of so many bytes.
    write: &'c dyn Fn(f32, usize) -> Vec<u8>,
    waiting: Vec<([Range<usize>; N], [f32; N])>,
}

impl<const N: usize> Moved<'_, '_, N> {
    /// Takes the next vector, and the places of its components.
    fn push(&mut self, places: [Range<usize>; N], vector: [f32; N]) {
        self.waiting.push((places, vector));
        if self.waiting.len() == CHUNK {
            self.flush();
        }
    }

    fn flush(&mut self) {
        let mut moved: Vec<_> = self.waiting.iter().map(|(_, vector)| *vector).collect();
        (self.change)(&mut moved);
        for ((places, vector), moved) in self.waiting.drain(..).zip(moved) {
            let mut axes: [usize; N] = std::array::from_fn(|axis| axis);
            axes.sort_by_key(|axis| places[*axis].start);
            for axis in axes.into_iter().filter(|axis| moved[*axis].to_bits() != vector[*axis].to_bits()) {
                self.splice.replace(places[axis].clone(), &(self.write)(moved[axis], places[axis].len()));
            }
        }
    }

    fn finish(mut self) -> Edited {
        self.flush();
        Edited { bytes: self.splice.finish(), meshes: vec![None], files: Vec::new(), warnings: Vec::new() }
    }
}
