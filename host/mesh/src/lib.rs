//! Vertex normals and tangent frames from mesh files: Wavefront OBJ, PLY and glTF 2.0; from the latter the rotations of
//! animations as well, and from both those of Gaussian splats.
//!
//! A file's own vertex normals are passed on as they are, NaN included (but the PLY parser refuses `nan` and `inf` in
//! ASCII files). Where a file has none, they are computed from its faces.

#![deny(unsafe_code)]

pub mod edit;
mod faces;
mod format;
mod gltf;
mod obj;
mod ply;
mod shape;

use glam::DVec3;
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use unitvec::direction::{is_usable, l1_norm};
use unitvec_files::one_line;

pub use format::FileFormat;
pub use obj::parse as read_obj;
pub use shape::{Generated, NormalTexture, Shape};

/// The Stanford bunny as OBJ: the mesh that conformance runs and pictures take.
pub const BUNNY: &[u8] = include_bytes!("../data/bunny.obj");

/// The Utah teapot as OBJ.
pub const TEAPOT: &[u8] = include_bytes!("../data/teapot.obj");

/// Vertex normals of a mesh file.
///
/// Their order:
///
/// * OBJ: the `vn` lines in file order, once each, whether or not the faces use them. Where normals are computed, there is
///   one for each `v` line, in file order.
/// * PLY: one normal for each vertex, in file order.
/// * glTF: mesh by mesh in file order, then primitive by primitive, then vertex by vertex. What several primitives share
///   comes once, at the first of them: an accessor of normals or, where normals are computed, of positions. [`parts`]
///   says where each primitive begins. Nodes, skins and morph targets are not applied.
///
/// [`parts`]: Self::parts
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The normals: as the file has them, or unit normals weighted by the areas of the faces.
    ///
    /// A computed normal is zero where the vertex has no face, or faces whose areas vanish or cancel.
    pub normals: Vec<[f32; 3]>,
    /// The ranges of the normals of each primitive of a glTF file. One part for OBJ and for PLY.
    pub parts: Vec<Part>,
}

impl Mesh {
    /// Number of primitives, whole files for OBJ and PLY, that had no normals.
    pub fn computed(&self) -> usize {
        self.parts.iter().filter(|part| part.computed).count()
    }

    /// Replaces the computed normals that are zero by +Z. Returns how many.
    pub fn fill_with_z(&mut self) -> usize {
        let (mut filled, mut done) = (0, 0);
        for part in self.parts.iter().filter(|part| part.computed) {
            // Parts that share their normals come after the first of them.
            if part.first < done {
                continue;
            }
            done = part.first + part.count;
            for normal in &mut self.normals[part.first..][..part.count] {
                if !has_direction(*normal) {
                    *normal = [0.0, 0.0, 1.0];
                    filled += 1;
                }
            }
        }
        filled
    }
}

/// Tangent frames. Of glTF in the order of [`Mesh`], each pair of accessors once; of OBJ and PLY those of a [`Shape`]'s vertices.
///
/// Where a file has no tangents, or a primitive none, texture coordinates give them, by MikkTSpace. A primitive that has neither,
/// in a file where another has, gets zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    /// Normal, tangent and handedness of each vertex, as the file has them.
    pub frames: Vec<[f32; 7]>,
    /// The ranges of the frames of each primitive.
    pub parts: Vec<Part>,
    /// The number of tangents that the file did not have.
    pub generated: Generated,
}

/// Rotations of the animations of a glTF file, as quaternions x, y, z, w: animation by animation in file order, sampler by
/// sampler, key by key. Tangents of cubic splines are left out. What several samplers share comes once, at the first of them.
/// Then those of its Gaussian splats, primitive by primitive; or those of a PLY file, in file order, of any length.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotations {
    /// The rotations, as the file has them.
    pub rotations: Vec<[f32; 4]>,
    /// The ranges of the rotations of each sampler.
    pub parts: Vec<Part>,
}

/// The range of the vertices of a mesh or primitive, or of the keys of a sampler of rotations.
#[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Part {
    /// Index of the mesh in the file; of a sampler, its animation.
    pub mesh: usize,
    /// The name of the mesh or the animation, where a glTF file gives one; of long names the first 200 characters.
    pub name: Option<Arc<str>>,
    /// Index of the primitive in its mesh, or of the sampler in its animation.
    pub primitive: usize,
    /// Index of its first vector, frame or rotation.
    pub first: usize,
    /// Number of its vectors, frames or rotations.
    pub count: usize,
    /// True where the normals were computed from faces.
    pub computed: bool,
}

impl Part {
    /// The part of a file that has no others.
    fn whole(count: usize, computed: bool) -> Self {
        Self { mesh: 0, name: None, primitive: 0, first: 0, count, computed }
    }

    /// The primitive and its mesh in words.
    pub fn place(&self) -> String {
        place(self.primitive, self.mesh, self.name.as_deref())
    }
}

fn place(primitive: usize, mesh: usize, name: Option<&str>) -> String {
    let name = name.map_or_else(String::new, |name| format!(" ({})", one_line(name)));
    format!("primitive {primitive} of mesh {mesh}{name}")
}

/// Number of different meshes that `parts` belong to.
pub fn mesh_count(parts: &[Part]) -> usize {
    parts.chunk_by(|a, b| a.mesh == b.mesh).count()
}

/// True where a vector has a direction that codecs can use: see [`unitvec::direction`].
pub fn has_direction(vector: [f32; 3]) -> bool {
    is_usable(l1_norm(vector.into()))
}

/// Why a mesh file gives no normals.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}: {source}; check that the file exists and may be read")]
    Read {
        /// The mesh file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// The file is damaged, or uses a feature that its parser does not know.
    #[error("cannot parse {path} as {format}: {reason}; check that the file is whole or export it again")]
    Parse {
        /// The mesh file.
        path: PathBuf,
        /// `OBJ`, `PLY` or `glTF`.
        format: &'static str,
        /// The fault, in one line.
        reason: String,
    },
    /// No normals, and no face to compute them from.
    #[error("{path} has neither normals nor faces to compute them from; export the mesh with normals")]
    NoFaces {
        /// The mesh file.
        path: PathBuf,
    },
    /// No face, where surfaces or tangents are wanted.
    #[error("{path} has no faces, and points alone have no surface; export the mesh with faces")]
    NoSurface {
        /// The mesh file.
        path: PathBuf,
    },
    /// A coordinate is NaN, infinite or beyond the range of `f32`.
    #[error("vertex {vertex} of {path} is not finite; remove or repair the vertex")]
    NotFinite {
        /// The mesh file.
        path: PathBuf,
        /// The vertex, counted from 0 in the file, or in its primitive for glTF.
        vertex: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("a face of {path} uses vertex {index} of {vertices}, counted from 0; export the mesh again")]
    IndexOutOfRange {
        /// The mesh file.
        path: PathBuf,
        /// The index in the face, counted from 0.
        index: i64,
        /// Number of vertices.
        vertices: usize,
    },
    /// A file without tangents for all of its vertices, which texture coordinates do not give either.
    #[error(
        "{path} does not give each vertex a normal and a tangent{lacking}; export it as .gltf or .glb with tangents"
    )]
    NoTangents {
        /// The mesh file.
        path: PathBuf,
        /// The first primitive without them, where none has any; or what else is in the way.
        lacking: String,
    },
    /// A file without animations that rotate and without splats; OBJ has none at all.
    #[error(
        "{path} has no rotations; name a .gltf or .glb with animations of some or with Gaussian splats, a .ply of these, or raw floats x, y, z, w"
    )]
    NoRotations {
        /// The file.
        path: PathBuf,
    },
    /// The elements do not fit into memory.
    #[error("{path} has {count} elements, too many for the memory; split the mesh, or take a larger machine")]
    Memory {
        /// The mesh file.
        path: PathBuf,
        /// Number of elements that memory was wanted for at once.
        count: usize,
    },
    /// Neither the ending nor the first bytes are those of a mesh.
    #[error("{path} is no known mesh file; use .obj, .ply, .gltf or .glb")]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The geometry of a glTF file is compressed, or the splats of a PLY file.
    #[error("{path} is compressed by {method} ({extension}); {remedy}")]
    Compressed {
        /// The mesh file.
        path: PathBuf,
        /// The glTF extension that it requires, or the PLY property that holds the rotations.
        extension: &'static str,
        /// The compression's name.
        method: &'static str,
        /// The remedy.
        remedy: String,
    },
    /// Vectors that cannot be moved in their file.
    #[error("the vectors of {path} cannot be moved: {reason}; {remedy}")]
    NotMovable {
        /// The mesh file.
        path: PathBuf,
        /// The obstacle.
        reason: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A glTF buffer is absent, short or of an unknown kind.
    #[error("buffer {buffer} of {path}: {reason}; keep the .bin files beside the .gltf or export a .glb")]
    MissingBuffer {
        /// The mesh file.
        path: PathBuf,
        /// Index of the buffer in the file.
        buffer: usize,
        /// The fault, in one line.
        reason: String,
    },
}

/// The files in which the buffers of a glTF file may lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Those in its folder and in folders below.
    #[default]
    Folder,
    /// Also those that its URIs reach by `../`.
    Anywhere,
}

/// Reads the vertex normals of a mesh file; [`FileFormat::of`] determines its format.
///
/// # Errors
///
/// Every [`MeshError`]; no input makes it panic.
pub fn read(path: &Path) -> Result<Mesh, MeshError> {
    let bytes = std::fs::read(path).map_err(|source| MeshError::Read { path: path.into(), source })?;
    let format =
        FileFormat::of(path, &bytes).ok_or_else(|| MeshError::UnknownFormat { path: path.into() })?;
    parse(path, format, &bytes, Reach::Folder)
}

/// Reads the vertex normals of a mesh file in memory; `path` stands in errors, and files within `reach` of it may be read.
///
/// # Errors
///
/// The errors of [`read`].
pub fn parse(path: &Path, format: FileFormat, bytes: &[u8], reach: Reach) -> Result<Mesh, MeshError> {
    match format {
        FileFormat::Obj => obj::parse(path, bytes),
        FileFormat::Ply => ply::parse(path, bytes),
        FileFormat::Gltf => gltf::parse(path, bytes, reach),
    }
}

/// Reads the tangent frames of a mesh file in memory, as [`parse`] does its normals.
///
/// # Errors
///
/// The errors of [`parse`]; [`MeshError::NoTangents`] for a file that has neither tangents nor texture coordinates.
pub fn parse_frames(
    path: &Path,
    format: FileFormat,
    bytes: &[u8],
    reach: Reach,
) -> Result<Frames, MeshError> {
    match format {
        FileFormat::Gltf => gltf::parse_frames(path, bytes, reach),
        FileFormat::Obj => shape::one_part(path, obj::parse_shape(path, bytes)?),
        FileFormat::Ply => shape::one_part(path, ply::parse_shape(path, bytes)?),
    }
}

/// Reads the shapes of a mesh file in memory, as [`parse`] does its normals: one of OBJ and PLY; of glTF one for
/// each set of accessors of positions, normals and texture coordinates, with the triangles of all primitives that have it.
///
/// The vertices of OBJ are the different corners `v/vt/vn` in the order in which faces first use them.
///
/// # Errors
///
/// The errors of [`parse`], and [`MeshError::NoSurface`] where there is no triangle.
pub fn parse_shapes(
    path: &Path,
    format: FileFormat,
    bytes: &[u8],
    reach: Reach,
) -> Result<Vec<Shape>, MeshError> {
    match format {
        FileFormat::Obj => Ok(vec![obj::parse_shape(path, bytes)?.0]),
        FileFormat::Ply => Ok(vec![ply::parse_shape(path, bytes)?.0]),
        FileFormat::Gltf => gltf::shape::parse_shapes(path, bytes, reach),
    }
}

/// Reads the rotations of the animations of a file in memory, or of its splats, as [`parse`] does its normals.
///
/// # Errors
///
/// The errors of [`parse`]; [`MeshError::NoRotations`] for a file without such rotations.
pub fn parse_rotations(
    path: &Path,
    format: FileFormat,
    bytes: &[u8],
    reach: Reach,
) -> Result<Rotations, MeshError> {
    match format {
        FileFormat::Gltf => gltf::parse_rotations(path, bytes, reach),
        FileFormat::Ply => ply::parse_rotations(path, bytes),
        FileFormat::Obj => Err(MeshError::NoRotations { path: path.into() }),
    }
}

/// The [`Mesh`] of a file with one list of normals.
fn one_part(path: &Path, normals: Vec<[f32; 3]>, computed: bool) -> Result<Mesh, MeshError> {
    let count = normals.len();
    if count == 0 {
        return Err(MeshError::NoFaces { path: path.into() });
    }
    Ok(Mesh { normals, parts: vec![Part::whole(count, computed)] })
}

/// Makes room for so many more elements. A file's counts are checked against its size before.
fn reserve<T>(path: &Path, list: &mut Vec<T>, count: usize) -> Result<(), MeshError> {
    list.try_reserve_exact(count).map_err(|_| MeshError::Memory { path: path.into(), count })
}

/// An empty list with room for so many elements.
fn list_of<T>(path: &Path, count: usize) -> Result<Vec<T>, MeshError> {
    let mut list = Vec::new();
    reserve(path, &mut list, count).map(|()| list)
}

/// A [`MeshError::Parse`] of one line.
fn parse_error(path: &Path, format: &'static str, reason: impl Display) -> MeshError {
    MeshError::Parse { path: path.into(), format, reason: one_line(reason) }
}

/// Checks that a coordinate is finite as an `f32`, so that no sum of cross products overflows.
fn check_finite(path: &Path, vertex: usize, position: DVec3) -> Result<(), MeshError> {
    match position.as_vec3().is_finite() {
        true => Ok(()),
        false => Err(MeshError::NotFinite { path: path.into(), vertex }),
    }
}

#[cfg(test)]
mod tests {
    use super::faces::{Fan, Positions, Sums};
    use super::*;

    /// Corners of a cube, centred on the origin.
    pub(super) const CUBE_CORNERS: [[f32; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];

    /// Faces of the cube, counter-clockwise from outside.
    ///
    /// Each fan starts at corner 0, 2, 5 or 7, no two of them neighbours, so that a
    /// corner is in one triangle of each of its faces or in two of each: the faces weigh the same.
    pub(super) const CUBE_FACES: [[u16; 4]; 6] =
        [[0, 3, 2, 1], [5, 6, 7, 4], [0, 1, 5, 4], [2, 3, 7, 6], [7, 3, 0, 4], [2, 6, 5, 1]];

    /// The area-weighted normals of the cube: towards the corners.
    pub(super) fn cube_normals() -> Vec<[f32; 3]> {
        CUBE_CORNERS.iter().map(|corner| corner.map(|c| c / 3f32.sqrt())).collect()
    }

    pub(super) fn assert_close(got: &[[f32; 3]], want: &[[f32; 3]]) {
        assert_eq!(got.len(), want.len());
        for (got, want) in got.iter().zip(want) {
            assert!(got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-6), "{got:?}, not {want:?}");
        }
    }

    const PATH: &str = "a.obj";

    fn weighted(positions: &[[f64; 3]], triangles: &[[i64; 3]]) -> Result<Vec<[f32; 3]>, MeshError> {
        let mut sums = Sums::new(Path::new(PATH), Positions::Double(positions.to_vec()));
        sums.add_all(triangles.iter().copied())?;
        Ok(sums.normals())
    }

    /// Two faces at a right angle, of areas 1/2 and 3/2, weigh on their shared edge as 1 to 3.
    #[test]
    fn faces_weigh_by_area() {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]];
        // The first faces +Z with cross product (0, 0, 1), the second +Y with (0, 3, 0).
        let normals = weighted(&positions, &[[0, 1, 2], [0, 3, 1]]).unwrap();
        let edge = [0.0, 3.0 / 10f32.sqrt(), 1.0 / 10f32.sqrt()];
        assert_close(&normals, &[edge, edge, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    }

    /// Vertices without a defined normal keep their place: unused, in a degenerate face, or cancelled.
    #[test]
    fn undefined_normals_are_zero() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let positions = [&[[5.0; 3]], corners.as_slice()].concat();
        let expected = [&[[0.0; 3]], [[0.0, 0.0, 1.0]; 3].as_slice()].concat();
        assert_eq!(weighted(&positions, &[[1, 2, 3], [0, 0, 1]]).unwrap(), expected);
        assert_eq!(weighted(&positions, &[[1, 2, 3], [1, 3, 2]]).unwrap(), [[0.0; 3]; 4]);
    }

    /// Computed normals of zero become +Z, also where parts overlap; a file's own stay as they are.
    #[test]
    fn filling_with_z() {
        let part = |first, computed| Part { mesh: 0, name: None, primitive: 0, first, count: 2, computed };
        let (zero, x) = ([0.0; 3], [1.0, 0.0, 0.0]);
        let mut mesh = Mesh {
            normals: vec![zero, x, zero, x],
            parts: vec![part(0, false), part(2, true), part(2, true), part(2, true)],
        };
        assert_eq!(mesh.computed(), 3);
        assert_eq!(mesh.fill_with_z(), 1);
        assert_eq!(mesh.normals, [zero, x, [0.0, 0.0, 1.0], x]);
    }

    /// The sums neither overflow nor vanish for the largest and the smallest `f32` coordinates.
    #[test]
    fn scale_does_not_matter() {
        for scale in [f64::from(f32::MAX), 1.0, 1e-44] {
            let positions = [[-scale, -scale, 0.0], [scale, -scale, 0.0], [0.0, scale, 0.0]];
            assert_eq!(weighted(&positions, &[[0, 1, 2]]).unwrap(), [[0.0, 0.0, 1.0]; 3]);
        }
    }

    /// An index is checked at both ends before use, and so is each coordinate.
    #[test]
    fn bad_faces_and_positions() {
        for bad in [i64::MIN, -1, 1, i64::MAX] {
            let error = weighted(&[[0.0; 3]], &[[0, 0, bad]]).unwrap_err();
            assert!(matches!(error, MeshError::IndexOutOfRange { index, vertices: 1, .. } if index == bad));
        }
        for bad in [f64::NAN, f64::INFINITY, 1e39] {
            let error = check_finite(Path::new(PATH), 1, DVec3::new(0.0, bad, 0.0)).unwrap_err();
            assert!(matches!(error, MeshError::NotFinite { vertex: 1, .. }));
        }
    }

    /// A polygon gives two triangles fewer than corners.
    #[test]
    fn fans() {
        let mut fan = Fan::default();
        assert_eq!(
            [7, 8, 9, 10].map(|corner| fan.push(corner)),
            [None, None, Some([7, 8, 9]), Some([7, 9, 10])]
        );
    }

    /// A file on disk reads like the same text in memory. One that cannot be read is reported before its format, and one that
    /// is no mesh by its name.
    #[test]
    fn files() {
        let folder = tempfile::tempdir().unwrap();
        let [obj, stl] = ["a.OBJ", "a.stl"].map(|name| folder.path().join(name));
        let text = b"vn 0 0 1\nvn 3 0 0\n";
        std::fs::write(&obj, text).unwrap();
        let mesh = read(&obj).unwrap();
        assert_eq!(mesh, read_obj(Path::new("memory"), text).unwrap());
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [3.0, 0.0, 0.0]]);
        std::fs::write(&stl, b"solid").unwrap();
        assert!(matches!(read(&stl), Err(MeshError::UnknownFormat { .. })));
        assert!(matches!(read(Path::new("absent.stl")), Err(MeshError::Read { .. })));
    }
}
