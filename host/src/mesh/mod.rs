//! Vertex normals from mesh files: Wavefront OBJ, PLY and glTF 2.0; from the latter tangent frames as well.
//!
//! A file's own vertex normals are passed on as they are, NaN included (but the PLY parser refuses `nan` and `inf` in
//! ASCII files). Where a file has none, they are computed from its faces.

mod gltf;
mod obj;
mod ply;

use glam::DVec3;
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

/// Vertex normals of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// One normal a vertex, as the file has it, or area-weighted unit normals where `computed`.
    ///
    /// An OBJ file's list of normals is taken once, in file order, however often its faces refer to
    /// it. Computed normals leave out each vertex without a normal of its own: one that no face uses,
    /// or whose faces have no area or cancel.
    pub normals: Vec<[f32; 3]>,
    /// True where the file had no normals; for glTF, where at least one primitive had none.
    pub computed: bool,
}

/// Why a mesh file gives no normals.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}: {source}; check that the file exists and may be read")]
    Read {
        /// The mesh file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file is damaged, or uses what its parser does not know.
    #[error("cannot parse {path} as {format}: {reason}; check that the file is whole or export it again")]
    Parse {
        /// The mesh file.
        path: PathBuf,
        /// `OBJ`, `PLY` or `glTF`.
        format: &'static str,
        /// What is wrong, in one line.
        reason: String,
    },
    /// No normals, and no face with an area to compute them from.
    #[error("{path} has neither normals nor faces to compute them from; export the mesh with normals")]
    NoFaces {
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
    #[error(
        "a face of {path} uses vertex {index}, and the vertices are 0 to {vertices} exclusive; export the mesh again"
    )]
    IndexOutOfRange {
        /// The mesh file.
        path: PathBuf,
        /// The index in the face, counted from 0.
        index: i64,
        /// Number of vertices.
        vertices: usize,
    },
    /// A file without tangents for all of its vertices; OBJ and PLY have none at all.
    #[error(
        "{path} does not give each vertex a normal and a tangent; export it as .gltf or .glb with tangents"
    )]
    NoTangents {
        /// The mesh file.
        path: PathBuf,
    },
    /// The file name has no known extension.
    #[error("{path} is no known mesh file; use .obj, .ply, .gltf or .glb")]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// A glTF buffer is absent, short or of an unknown kind.
    #[error("buffer {buffer} of {path}: {reason}; keep the .bin files beside the .gltf or export a .glb")]
    MissingBuffer {
        /// The mesh file.
        path: PathBuf,
        /// Index of the buffer in the file.
        buffer: usize,
        /// What is wrong with it, in one line.
        reason: String,
    },
}

#[derive(Clone, Copy)]
enum Format {
    Obj,
    Ply,
    Gltf,
}

/// True if `path` ends in obj, ply, gltf or glb (any case).
pub fn is_mesh(path: &Path) -> bool {
    format_of(path).is_some()
}

/// Reads the vertex normals of a mesh file, of the format its extension names.
///
/// # Errors
///
/// Every [`MeshError`]; no input makes it panic.
pub fn read(path: &Path) -> Result<Mesh, MeshError> {
    match open(path)? {
        (Format::Obj, bytes) => obj::parse(path, &bytes),
        (Format::Ply, bytes) => ply::parse(path, &bytes),
        (Format::Gltf, bytes) => gltf::parse(path, &bytes),
    }
}

/// Reads the tangent frames of the vertices of a glTF file, as it has them: normal, tangent, handedness.
///
/// # Errors
///
/// As [`read`]; [`MeshError::NoTangents`] for a file without them.
pub fn read_frames(path: &Path) -> Result<Vec<[f32; 7]>, MeshError> {
    match open(path)? {
        (Format::Gltf, bytes) => gltf::parse_frames(path, &bytes),
        _ => Err(MeshError::NoTangents { path: path.into() }),
    }
}

fn open(path: &Path) -> Result<(Format, Vec<u8>), MeshError> {
    let format = format_of(path).ok_or_else(|| MeshError::UnknownFormat { path: path.into() })?;
    let bytes = std::fs::read(path).map_err(|source| MeshError::Read { path: path.into(), source })?;
    Ok((format, bytes))
}

/// Reads the vertex normals of OBJ text in memory; `name` stands in errors.
///
/// # Errors
///
/// As [`read`], less those of opening a file.
pub fn read_obj(name: &Path, text: &[u8]) -> Result<Mesh, MeshError> {
    obj::parse(name, text)
}

fn format_of(path: &Path) -> Option<Format> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "obj" => Some(Format::Obj),
        "ply" => Some(Format::Ply),
        "gltf" | "glb" => Some(Format::Gltf),
        _ => None,
    }
}

/// The [`Mesh`] of a reader's `normals`, or [`MeshError::NoFaces`] where there are none.
fn finish(path: &Path, normals: Vec<[f32; 3]>, computed: bool) -> Result<Mesh, MeshError> {
    if normals.is_empty() {
        return Err(MeshError::NoFaces { path: path.into() });
    }
    Ok(Mesh { normals, computed })
}

/// A [`MeshError::Parse`]; `reason` is cut to one line, since parsers quote the input at length.
fn parse_error(path: &Path, format: &'static str, reason: impl Display) -> MeshError {
    const MAX_CHARS: usize = 200;
    let reason = reason.to_string();
    let line = reason.split(|c: char| c.is_whitespace() || c.is_control()).filter(|word| !word.is_empty());
    let line = line.collect::<Vec<_>>().join(" ");
    let cut = line.char_indices().nth(MAX_CHARS).map(|(at, _)| at);
    let reason = cut.map_or(line.clone(), |at| format!("{}...", &line[..at]));
    MeshError::Parse { path: path.into(), format, reason }
}

/// Checks that each coordinate is finite as an `f32`, so that no sum of cross products overflows.
fn check_finite(path: &Path, positions: &[DVec3]) -> Result<(), MeshError> {
    match positions.iter().position(|position| !position.as_vec3().is_finite()) {
        Some(vertex) => Err(MeshError::NotFinite { path: path.into(), vertex }),
        None => Ok(()),
    }
}

/// Splits a polygon into triangles that share its first corner; fewer than three corners give none.
fn fan(polygon: &[i64]) -> impl Iterator<Item = [i64; 3]> {
    let first = polygon.first().copied().unwrap_or(0);
    polygon.windows(2).skip(1).map(move |edge| [first, edge[0], edge[1]])
}

/// Area-weighted unit vertex normals: the normalised sum of the cross products of a vertex's faces.
///
/// A vertex whose sum is zero has no normal and is left out.
fn area_weighted(
    path: &Path,
    positions: &[DVec3],
    triangles: impl IntoIterator<Item = [i64; 3]>,
) -> Result<Vec<[f32; 3]>, MeshError> {
    check_finite(path, positions)?;
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = resolve(path, triangle, positions.len())?;
        // Twice the area long, so that adding it weights the face by its area.
        let normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
        [a, b, c].into_iter().for_each(|corner| sums[corner] += normal);
    }
    let used = sums.into_iter().filter(|sum| sum.length() > 0.0);
    Ok(used.map(|sum| (sum / sum.length()).as_vec3().to_array()).collect())
}

fn resolve(path: &Path, triangle: [i64; 3], vertices: usize) -> Result<[usize; 3], MeshError> {
    let mut corners = [0; 3];
    for (corner, index) in corners.iter_mut().zip(triangle) {
        *corner = usize::try_from(index)
            .ok()
            .filter(|&i| i < vertices)
            .ok_or_else(|| MeshError::IndexOutOfRange { path: path.into(), index, vertices })?;
    }
    Ok(corners)
}

#[cfg(test)]
mod tests {
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

    /// A directory that goes when the test ends.
    pub(super) struct Scratch(PathBuf);

    impl Scratch {
        pub(super) fn new(test: &str) -> Self {
            let dir = std::env::temp_dir().join(format!("unitvec-mesh-{}-{test}", std::process::id()));
            std::fs::create_dir_all(&dir).unwrap();
            Self(dir)
        }

        pub(super) fn path(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    const PATH: &str = "a.obj";

    fn weighted(positions: &[[f64; 3]], triangles: &[[i64; 3]]) -> Result<Vec<[f32; 3]>, MeshError> {
        let positions: Vec<DVec3> = positions.iter().copied().map(DVec3::from).collect();
        area_weighted(Path::new(PATH), &positions, triangles.iter().copied())
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

    /// Vertices without a defined normal are left out: unused, in a degenerate face, or cancelled.
    #[test]
    fn undefined_normals_are_left_out() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let positions = [corners.as_slice(), &[[5.0; 3]]].concat();
        assert_eq!(weighted(&positions, &[[0, 1, 2], [3, 3, 0]]).unwrap(), [[0.0, 0.0, 1.0]; 3]);
        assert_eq!(weighted(&positions, &[[0, 1, 2], [0, 2, 1]]).unwrap(), [[0.0; 3]; 0]);
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
            let error = weighted(&[[0.0; 3], [0.0, bad, 0.0]], &[]).unwrap_err();
            assert!(matches!(error, MeshError::NotFinite { vertex: 1, .. }));
        }
    }

    /// A polygon gives two triangles fewer than corners, and a degenerate one none.
    #[test]
    fn fans() {
        assert_eq!(fan(&[7, 8, 9, 10]).collect::<Vec<_>>(), [[7, 8, 9], [7, 9, 10]]);
        assert!([[].as_slice(), &[1], &[1, 2]].iter().all(|short| fan(short).next().is_none()));
    }

    /// The extension decides, in any case, before the file is opened.
    #[test]
    fn extensions() {
        assert!(["a.obj", "b/a.PLY", "a.b.glTF", "a.Glb"].iter().all(|name| is_mesh(Path::new(name))));
        assert!(["obj", ".obj", "a.stl", "a.obj.gz"].iter().all(|name| !is_mesh(Path::new(name))));
        assert!(matches!(read(Path::new("absent.stl")), Err(MeshError::UnknownFormat { .. })));
        assert!(matches!(read(Path::new("absent.ply")), Err(MeshError::Read { .. })));
        assert!(matches!(read_frames(Path::new("absent.glb")), Err(MeshError::Read { .. })));
    }

    /// A file on disk reads like the same text in memory.
    #[test]
    fn reads_files() {
        let scratch = Scratch::new("files");
        let text = b"vn 0 0 1\nvn 3 0 0\n";
        std::fs::write(scratch.path("a.OBJ"), text).unwrap();
        let mesh = read(&scratch.path("a.OBJ")).unwrap();
        assert_eq!(mesh, read_obj(Path::new("memory"), text).unwrap());
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [3.0, 0.0, 0.0]]);
    }

    /// Every message is one line that names the file.
    #[test]
    fn messages() {
        let path = || PathBuf::from(PATH);
        let errors = [
            MeshError::Read { path: path(), source: io::ErrorKind::NotFound.into() },
            parse_error(Path::new(PATH), "OBJ", format!("a\n\tb\u{7f}{}", "\u{e9}".repeat(500))),
            MeshError::NoFaces { path: path() },
            MeshError::NotFinite { path: path(), vertex: 3 },
            MeshError::IndexOutOfRange { path: path(), index: -1, vertices: 3 },
            MeshError::UnknownFormat { path: path() },
            MeshError::NoTangents { path: path() },
            MeshError::MissingBuffer { path: path(), buffer: 0, reason: "it has 1 of its 2 bytes".into() },
        ];
        for message in errors.map(|error| error.to_string()) {
            assert!(message.contains(PATH) && !message.contains(char::is_control), "{message}");
            assert!(message.chars().count() < 300, "{message}");
        }
    }
}
