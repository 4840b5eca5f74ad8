//! Wavefront OBJ.
//!
//! The parser is our own, over the file's bytes: crates for it keep 40 bytes for a corner that takes two in the file.

use super::faces::{Fan, Positions, Sums};
use super::format::without_mark;
use super::{Mesh, MeshError, Shape, check_finite, list_of, one_part, parse_error};
use glam::Vec3;
use std::collections::HashMap;
use std::path::Path;
use std::str::FromStr;

const FORMAT: &str = "OBJ";

/// Reads the vertex normals of OBJ text in memory; `path` stands in errors.
///
/// # Errors
///
/// The errors of [`read`](crate::read), less those of opening a file.
pub fn parse(path: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    /// `v 0 0 0`, without the end of the line.
    const SHORTEST: usize = 7;
    // Counted first, so that no list grows beyond its size. Lines that are too short fail later.
    let count = |keyword: &[u8]| {
        let count = lines(bytes).filter(|line| line.keyword == keyword).count();
        count.min(bytes.len() / SHORTEST)
    };
    let mut positions = list_of(path, count(b"v"))?;
    let mut normals = list_of(path, count(b"vn"))?;
    for line in lines(bytes) {
        match line.keyword {
            b"v" => {
                let position = line.vector(path)?;
                check_finite(path, positions.len(), Vec3::from(position).as_dvec3())?;
                positions.push(position);
            }
            b"vn" => normals.push(line.vector(path)?),
            _ => {}
        }
    }
    if !normals.is_empty() {
        return one_part(path, normals, false);
    }
    let mut sums = Sums::new(path, Positions::Single(positions));
    each_triangle(path, bytes, |triangle| sums.add(triangle))?;
    sums.into_mesh()
}

/// Reads the vertices, different corners `v/vt/vn`, and triangles of OBJ text; true where its normals are computed. A corner
/// without a normal gets zero where others have one.
pub(super) fn parse_shape(path: &Path, bytes: &[u8]) -> Result<(Shape, bool), MeshError> {
    let Mesh { normals, parts } = parse(path, bytes)?;
    let computed = parts.iter().any(|part| part.computed);
    let of = |keyword: &'static [u8]| lines(bytes).filter(move |line: &Line| line.keyword == keyword);
    let positions = of(b"v").map(|line| line.vector(path)).collect::<Result<Vec<_>, _>>()?;
    let texture = of(b"vt").map(|line| line.pair(path)).collect::<Result<Vec<_>, _>>()?;
    let (mut shape, mut places, mut counts) = (Shape::default(), HashMap::new(), [0; 3]);
    let mut has_texture = true;
    for line in lines(bytes) {
        match line.keyword {
            b"v" => counts[0] += 1,
            b"vt" => counts[1] += 1,
            b"vn" => counts[2] += 1,
            b"f" => {
                let mut fan = Fan::default();
                for word in line.words() {
                    let [at, coordinate, normal] = line.corners(path, word, counts)?;
                    let normal = if computed { at } else { normal };
                    let vertex = *places.entry([at, coordinate, normal]).or_insert(shape.positions.len());
                    if vertex == shape.positions.len() {
                        shape.positions.push(of_list(path, &positions, at)?.unwrap_or_default());
                        shape.normals.push(of_list(path, &normals, normal)?.unwrap_or_default());
                        let coordinate = of_list(path, &texture, coordinate)?;
                        has_texture &= coordinate.is_some();
                        shape.texture.push(coordinate.unwrap_or_default());
                    }
                    if let Some(triangle) = fan.push(vertex as i64) {
                        shape.triangles.push(triangle.map(|corner| corner as u32));
                    }
                }
            }
            _ => {}
        }
    }
    if !has_texture {
        shape.texture = Vec::new();
    }
    Ok((shape.with_surface(path)?.with_normals(path)?, computed))
}

/// The element that a corner names, if it names one.
fn of_list<T: Copy>(path: &Path, list: &[T], index: Option<i64>) -> Result<Option<T>, MeshError> {
    let Some(index) = index else { return Ok(None) };
    let found = usize::try_from(index).ok().and_then(|index| list.get(index));
    let error = || MeshError::IndexOutOfRange { path: path.into(), index, vertices: list.len() };
    found.copied().map(Some).ok_or_else(error)
}

fn each_triangle(
    path: &Path,
    bytes: &[u8],
    mut each: impl FnMut([i64; 3]) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let mut vertices = 0;
    for line in lines(bytes) {
        match line.keyword {
            b"v" => vertices += 1,
            b"f" => {
                let mut fan = Fan::default();
                for word in line.words() {
                    let [corner, ..] = line.corners(path, word, [vertices, 0, 0])?;
                    let triangle = corner.and_then(|corner| fan.push(corner));
                    triangle.map_or(Ok(()), &mut each)?;
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// A line that begins with a word. Names and comments are in any encoding, and are not looked at.
pub(super) struct Line<'b> {
    /// Counted from 1.
    number: usize,
    pub(super) keyword: &'b [u8],
    text: &'b [u8],
}

pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let (mut rest, mut number) = (without_mark(bytes), 1);
    std::iter::from_fn(move || {
        let ends = (!rest.is_empty()).then(|| Ends::of(rest))?;
        let text = rest[..ends.line].trim_ascii();
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        let (keyword, text) = text.split_at(end);
        let line = Line { number, keyword, text };
        (rest, number) = (&rest[ends.after..], number + ends.count);
        Some(line)
    })
}

/// The end of the first line, which LF, CR or both end. A `\` before it makes a line of numbers go on; names may end in one.
struct Ends {
    line: usize,
    after: usize,
    /// Number of lines in the file.
    count: usize,
}

impl Ends {
    fn of(bytes: &[u8]) -> Self {
        let first = bytes.iter().find(|byte| !b" \t".contains(byte));
        let (mut after, mut count) = (0, 0);
        loop {
            let start = after;
            let line = bytes[start..]
                .iter()
                .position(|byte| b"\r\n".contains(byte))
                .map_or(bytes.len(), |at| start + at);
            let end = if bytes[line..].starts_with(b"\r\n") { 2 } else { 1 };
            (after, count) = (bytes.len().min(line + end), count + 1);
            let goes_on = matches!(first, Some(b'v' | b'f')) && bytes[..line].ends_with(b"\\");
            if !goes_on || after == bytes.len() {
                return Self { line, after, count };
            }
        }
    }
}

impl<'b> Line<'b> {
    pub(super) fn words(&self) -> impl Iterator<Item = &'b [u8]> + use<'b> {
        let words = self.text.split(u8::is_ascii_whitespace);
        words.map(|word| word.strip_suffix(b"\\").unwrap_or(word)).filter(|word| !word.is_empty())
    }

    /// The first three words as numbers; some programs write more.
    pub(super) fn vector(&self, path: &Path) -> Result<[f32; 3], MeshError> {
        let mut numbers = self.words().map_while(number);
        let [x, y, z] = std::array::from_fn(|_| numbers.next());
        match (x, y, z) {
            (Some(x), Some(y), Some(z)) => Ok([x, y, z]),
            _ => Err(self.error(path, "three numbers")),
        }
    }

    /// The first two words as numbers: texture coordinates.
    fn pair(&self, path: &Path) -> Result<[f32; 2], MeshError> {
        let mut numbers = self.words().map_while(number);
        let pair = numbers.next().zip(numbers.next());
        pair.map(|(u, v)| [u, v]).ok_or_else(|| self.error(path, "two numbers"))
    }

    /// The indices of position, texture coordinates and normal in a corner of a face, `2`, `2/1`, `2//3` or `2/1/3`, counted
    /// from 0, where there are so many of each. Of the latter two none is read where there is none.
    fn corners(&self, path: &Path, word: &[u8], counts: [i64; 3]) -> Result<[Option<i64>; 3], MeshError> {
        let mut words = word.split(|byte| *byte == b'/');
        let mut indices = [None; 3];
        for (at, index) in indices.iter_mut().enumerate() {
            let word = words.next().filter(|word| at == 0 || (!word.is_empty() && counts[at] > 0));
            *index = match word.map(number::<i64>) {
                None => None,
                Some(None | Some(0)) => return Err(self.error(path, "corners, which are counted from 1")),
                Some(Some(index)) if index < 0 => Some(counts[at].saturating_add(index)),
                Some(Some(index)) => Some(index - 1),
            };
        }
        Ok(indices)
    }

    fn error(&self, path: &Path, expected: &str) -> MeshError {
        let text = &self.text[..self.text.len().min(100)];
        let text = format!("{} {}", String::from_utf8_lossy(self.keyword), String::from_utf8_lossy(text));
        parse_error(path, FORMAT, format!("line {}, `{text}`, does not have {expected}", self.number))
    }
}

fn number<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{CUBE_CORNERS, CUBE_FACES, assert_close, cube_normals};
    use super::*;
    use std::fmt::Write;

    fn read(text: &str) -> Result<Mesh, MeshError> {
        parse(Path::new("a.obj"), text.as_bytes())
    }

    /// A line of numbers goes on after a `\`; a comment, or a name, that ends in one does not take the next line with it. Errors
    /// count the lines of the file, whatever ends them.
    #[test]
    fn lines_that_go_on() {
        let text = "# in C:\\meshes\\\nv 0 0 0\no a\\\nv 1 0 \\\n0\nv 0 1 0\nf 1 \\\n 2\\\n3 \\\n\n";
        for end in ["\n", "\r\n", "\r"] {
            let text = text.replace('\n', end);
            assert_eq!(read(&text).unwrap().normals, [[0.0, 0.0, 1.0]; 3], "{end:?}");
            let error = read(&format!("{text}f 1 2 x")).unwrap_err().to_string();
            assert!(error.contains("line 11, `f"), "{error}");
        }
        assert!(read("v 0 0 0\nf 1 1 1 \\").is_ok());
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
        for ends in ["\r", "\r\n"] {
            let mesh = read(&["vn 1 0 0", "vn 0 1 0", "", "vn 0 0 1"].join(ends)).unwrap();
            assert_eq!(mesh.normals, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        }
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
}
