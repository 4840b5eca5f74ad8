//! Formats of mesh files.

use std::path::Path;

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// Wavefront OBJ: text, known by its ending alone.
    Obj,
    /// PLY.
    Ply,
    /// glTF 2.0, as JSON or binary.
    Gltf,
}

impl FileFormat {
    /// The number of a file's first bytes that [`of`](Self::of) should be given. In JSON, `asset` may come late.
    pub const HEAD: usize = 1 << 20;

    /// The format by the first bytes; where they do not decide, by the ending, in any case: obj, ply, gltf, glb. So a
    /// VRM file, which is a GLB by another name, is read as one.
    pub fn of(path: &Path, head: &[u8]) -> Option<Self> {
        let is_ply = head.starts_with(b"ply\n") || head.starts_with(b"ply\r");
        let is_gltf = head.starts_with(b"glTF") || is_gltf_json(head);
        match (is_ply, is_gltf) {
            (true, _) => Some(Self::Ply),
            (_, true) => Some(Self::Gltf),
            _ => Self::of_ending(path),
        }
    }

    /// True where a file of this format that begins with these bytes is text as a whole.
    pub fn is_text(self, head: &[u8]) -> bool {
        match self {
            Self::Obj => true,
            Self::Ply => {
                // A line ends in one of them, or in both.
                let lines = head.split(|byte| b"\r\n".contains(byte));
                lines.take(3).any(|line| line.starts_with(b"format ascii"))
            }
            Self::Gltf => !head.starts_with(b"glTF"),
        }
    }

    /// The format by a file's ending, in any case.
    pub fn of_ending(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }
}

/// Text without the byte order mark that it may begin with.
pub(super) fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(text)
}

/// True for a JSON object with `asset`, which every glTF file must have.
fn is_gltf_json(head: &[u8]) -> bool {
    const KEY: &[u8] = b"\"asset\"";
    without_mark(head).trim_ascii_start().starts_with(b"{")
        && head.windows(KEY.len()).any(|bytes| bytes == KEY)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes that do not decide leave it to the ending, in any case.
    #[test]
    fn endings() {
        let of = |name| FileFormat::of(Path::new(name), b"\0\0\x80\x3f");
        assert_eq!(of("a.obj"), Some(FileFormat::Obj));
        assert_eq!(of("b/a.PLY"), Some(FileFormat::Ply));
        assert_eq!([of("a.b.glTF"), of("a.Glb")], [Some(FileFormat::Gltf); 2]);
        assert_eq!(["obj", ".obj", "a.stl", "a.obj.gz", "-"].map(of), [None; 5]);
    }

    /// Distinctive bytes decide whatever the ending; bytes that are close to them do not.
    #[test]
    fn first_bytes() {
        for (head, format) in [
            (&b"glTF\x02\0\0\0"[..], FileFormat::Gltf),
            (b"{\"asset\":{\"version\":\"2.0\"}}", FileFormat::Gltf),
            (b"\xef\xbb\xbf{\"asset\":{}}", FileFormat::Gltf),
            (b"\n {\n \"accessors\": [],\n \"asset\": {", FileFormat::Gltf),
            (b"ply\nformat ascii 1.0\n", FileFormat::Ply),
            (b"ply\r\nformat", FileFormat::Ply),
        ] {
            for name in ["a.vrm", "a.bin", "a.obj", "a", "-"] {
                assert_eq!(FileFormat::of(Path::new(name), head), Some(format), "{name}");
            }
        }
        for head in [&b""[..], b"glT", b"plyglTF", b"{\"assets\":0}", b"[\"asset\"]", b"{", b"ply"] {
            assert_eq!(FileFormat::of(Path::new("a.bin"), head), None, "{head:?}");
        }
    }
}
