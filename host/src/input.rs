//! Input files, and what they hold: a mesh, raw floats, or what the name and the first bytes do not tell.

use crate::mesh::{FileFormat, MeshError};
use crate::{Error, Result};
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};

/// Endings of files that hold raw floats.
pub const RAW_ENDINGS: [&str; 3] = ["bin", "f32", "raw"];

/// A file or stream that was opened to be read.
pub struct Input {
    path: PathBuf,
    reader: Box<dyn Read>,
    length: Option<u64>,
    mesh: Option<FileFormat>,
}

impl Input {
    /// Opens a file; `-` is the standard input. Looks at its first bytes, which are still there to be read.
    ///
    /// # Errors
    /// [`Error::Read`].
    pub fn open(path: &Path) -> Result<Self> {
        let error = |source| Error::Read { path: path.to_owned(), source };
        let (mut reader, length) = open(path).map_err(error)?;
        let mut head = Vec::new();
        reader.by_ref().take(FileFormat::HEAD as u64).read_to_end(&mut head).map_err(error)?;
        let mesh = FileFormat::of(path, &head);
        let reader = Box::new(Cursor::new(head).chain(reader));
        Ok(Self { path: path.to_owned(), reader, length, mesh })
    }

    /// The format of the mesh that it holds, if it does.
    pub fn mesh(&self) -> Option<FileFormat> {
        self.mesh
    }

    /// True where raw floats can be expected: one of [`RAW_ENDINGS`], the standard input, a pipe or a device.
    pub fn is_raw(&self) -> bool {
        let ending = self.path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        self.length.is_none() || RAW_ENDINGS.iter().any(|raw| raw.eq_ignore_ascii_case(ending))
    }

    /// Its length in bytes, where it is a file.
    pub fn length(&self) -> Option<u64> {
        self.length
    }

    /// All of it.
    ///
    /// # Errors
    /// [`MeshError::Read`].
    pub fn read_all(mut self) -> Result<Vec<u8>, MeshError> {
        let mut bytes = Vec::new();
        match self.reader.read_to_end(&mut bytes) {
            Ok(_) => Ok(bytes),
            Err(source) => Err(MeshError::Read { path: self.path, source }),
        }
    }
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.reader.read(buffer)
    }
}

fn open(path: &Path) -> io::Result<(Box<dyn Read>, Option<u64>)> {
    if path == Path::new("-") {
        return Ok((Box::new(io::stdin().lock()), None));
    }
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    Ok((Box::new(file), metadata.is_file().then_some(metadata.len())))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was looked at is read again, and all after it.
    #[test]
    fn the_first_bytes_are_read_again() {
        let folder = tempfile::tempdir().unwrap();
        for length in [0, 3, FileFormat::HEAD, FileFormat::HEAD + 5] {
            let bytes: Vec<u8> = (0..length).map(|at| (at % 251) as u8).collect();
            let path = folder.path().join("a.bin");
            std::fs::write(&path, &bytes).unwrap();
            let input = Input::open(&path).unwrap();
            assert_eq!(input.length(), Some(length as u64));
            assert!(input.read_all().unwrap() == bytes, "{length}");
        }
    }

    /// Raw floats are known by the ending, in any case; a mesh is known by its first bytes whatever its ending.
    #[test]
    fn what_a_file_holds() {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes, expected) in [
            ("a.bin", &b"\0\0\0\0"[..], (None, true)),
            ("a.F32", b"", (None, true)),
            ("a.raw", b"{", (None, true)),
            ("a.fbx", b"Kaydara FBX Binary", (None, false)),
            ("bin", b"", (None, false)),
            ("a.vrm", b"glTF\x02\0\0\0", (Some(FileFormat::Gltf), false)),
            ("b.bin", b"ply\nformat", (Some(FileFormat::Ply), true)),
            ("a.obj", b"", (Some(FileFormat::Obj), false)),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            let input = Input::open(&path).unwrap();
            assert_eq!((input.mesh(), input.is_raw()), expected, "{name}");
        }
        assert!(matches!(Input::open(folder.path()), Err(Error::Read { .. })));
    }
}
