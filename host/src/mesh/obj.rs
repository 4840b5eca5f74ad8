//! Wavefront OBJ, parsed by `obj`.

use super::{Mesh, MeshError, check_finite, fan, one_computed_part, one_part, parse_error};
use glam::Vec3;
use obj::ObjData;
use std::path::Path;

const FORMAT: &str = "OBJ";

/// Reads the normals of OBJ text.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let data =
        ObjData::load_buf(geometry(bytes).as_bytes()).map_err(|error| parse_error(path, FORMAT, error))?;
    let positions: Vec<_> = data.position.into_iter().map(|p| Vec3::from(p).as_dvec3()).collect();
    if !data.normal.is_empty() {
        check_finite(path, &positions)?;
        return one_part(path, data.normal, false);
    }
    let polygons = data.objects.into_iter().flat_map(|object| object.groups).flat_map(|group| group.polys);
    let faces: Vec<Vec<i64>> = polygons.map(|face| face.0.iter().map(|c| c.0 as i64).collect()).collect();
    one_computed_part(path, &positions, faces.iter().flat_map(|face| fan(face)))
}

/// The lines that the normals come from. Of the others, the parser refuses those it does not know, and it loses faces
/// at some that group them. Only names and comments are ever not ASCII, and they may be in any encoding.
fn geometry(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let is_geometry =
        |line: &&str| ["v", "vn", "f"].contains(&line.split_whitespace().next().unwrap_or_default());
    text.trim_start_matches('\u{feff}').lines().filter(is_geometry).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::super::tests::{CUBE_CORNERS, CUBE_FACES, assert_close, cube_normals};
    use super::*;
    use std::fmt::Write;

    fn read(text: &str) -> Result<Mesh, MeshError> {
        parse(Path::new("a.obj"), text.as_bytes())
    }

    /// The cube, its first faces in one object, the others in a second.
    fn cube() -> String {
        let mut text = String::from("# cube\no first\n");
        for [x, y, z] in CUBE_CORNERS {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for (k, face) in CUBE_FACES.iter().enumerate() {
            let [a, b, c, d] = face.map(|i| i + 1);
            text += if k == 3 { "o second\nusemtl red\n" } else { "" };
            writeln!(text, "f {a} {b} {c} {d}").unwrap();
        }
        text
    }

    /// Faces of all objects add to one vertex: a seam would give normals that miss the diagonals.
    #[test]
    fn computes_over_all_objects() {
        let mesh = read(&cube()).unwrap();
        assert_eq!(mesh.computed(), 1);
        assert_close(&mesh.normals, &cube_normals());
    }

    /// `vn` lines come back once each, in file order, whatever the faces of the objects use.
    #[test]
    fn normals_are_the_list_of_the_file() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 2 0\nvn nan 0 0\n\
            o a\nf 1//2 2//2 3//1\no b\nvn 5 0 0\nf -3//-1 2//1 3//1\n";
        let mesh = read(text).unwrap();
        assert_eq!(mesh.computed(), 0);
        assert_eq!(mesh.normals.len(), 4);
        assert_eq!(mesh.normals[..2], [[0.0, 0.0, 1.0], [0.0, 2.0, 0.0]]);
        assert!(mesh.normals[2][0].is_nan());
        assert_eq!(mesh.normals[3], [5.0, 0.0, 0.0]);
    }

    /// A vertex that no face uses, first, between or last, keeps its place.
    #[test]
    fn unused_vertices_keep_their_place() {
        let mesh = read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 0 1 0\nv 7 7 7\nf 2 3 5\n").unwrap();
        let (z, none) = ([0.0, 0.0, 1.0], [0.0; 3]);
        assert_eq!(mesh.normals, [none, z, z, none, z, none]);
        assert_eq!((mesh.parts.len(), mesh.parts[0].first, mesh.parts[0].count), (1, 0, 6));
    }

    /// Normals need neither positions nor faces, and there may be fewer than vertices.
    #[test]
    fn normals_alone_are_enough() {
        assert_eq!(read("vn 1 0 0\nvn 0 1 0").unwrap().normals, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let fewer = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        assert_eq!(read(fewer).unwrap().normals, [[0.0, 0.0, 1.0]]);
    }

    /// Negative indices, texture coordinates, CRLF, a byte order mark and Latin-1 names are all read.
    #[test]
    fn reads_the_usual_variants() {
        let text =
            b"\xef\xbb\xbfv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\ng caf\xe9\r\nvt 0 0\r\nf -3/1 -2/1 -1/1\r\n";
        let mesh = parse(Path::new("a.obj"), text).unwrap();
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    }

    /// Bad numbers and indices are errors, and indices that overflow do no harm.
    #[test]
    fn damage_is_an_error() {
        let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
        let read_line = |line| read(&format!("{corners}f 1 2 3\n{line}\n"));
        for line in ["f 0 1 2", "f 1 2 x", "f 1 2 3.5", "v 1 2", "v 1 2 x"] {
            let result = read_line(line);
            assert!(matches!(result, Err(MeshError::Parse { .. })), "{line}: {result:?}");
        }
        for (line, bad) in [("f 1 2 4", 3), ("f 1 2 -4", -1)] {
            let result = read_line(line);
            assert!(
                matches!(result, Err(MeshError::IndexOutOfRange { index, .. }) if index == bad),
                "{line}: {result:?}"
            );
        }
        let min = isize::MIN;
        for line in [format!("f {min} {min} {min}"), format!("f 1/{min}/{min} 2/-9/-9 3/0/0")] {
            let _ = read(&format!("{corners}{line}\n"));
            let _ = read(&format!("{corners}vn 0 0 1\n{line}\n"));
        }
        assert!(matches!(read("vn 0 0\n"), Err(MeshError::Parse { .. })));
    }

    /// A vertex that is not finite is named by its place in the file, with and without normals.
    #[test]
    fn positions_must_be_finite() {
        for normals in ["", "vn 0 0 1\n"] {
            let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1e39 0\n{normals}f 3 1 2\n");
            assert!(matches!(read(&text), Err(MeshError::NotFinite { vertex: 3, .. })));
        }
    }

    /// Faces without an area leave all vertices in place, without a direction.
    #[test]
    fn faces_without_an_area() {
        let mesh = read("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\n").unwrap();
        assert_eq!((mesh.computed(), mesh.normals), (1, vec![[0.0; 3]; 3]));
    }

    /// No faces is its own error.
    #[test]
    fn needs_faces() {
        for text in ["", "v 0 0 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\n"] {
            assert!(matches!(read(text), Err(MeshError::NoFaces { .. })), "{text}");
        }
    }

    /// Text cut off anywhere does not panic.
    #[test]
    fn truncation_does_not_panic() {
        let text = cube() + "vn 0 0 1\nvn 1 0 0\n";
        for end in 0..text.len() {
            let _ = read(&text[..end]);
        }
    }
}
