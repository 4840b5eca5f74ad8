//! Input files, and their contents: a mesh, a texture, raw floats, or unknown.

use crate::container::{self, Header};
use crate::raw::{Dtype, Npy, swap_if_big_endian};
use crate::{Error, Result};
use std::fmt;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use unitvec_catalogue::{AnyCodec, Element};
use unitvec_files::shown;
use unitvec_mesh as mesh;
use unitvec_mesh::{FileFormat, Frames, Mesh, MeshError, Part, Reach, Rotations};
use unitvec_texture::Source;

/// Endings of files that hold raw floats.
pub const RAW_ENDINGS: [&str; 3] = ["bin", "f32", "raw"];

/// True for a path with one of these endings, in upper or lower case.
pub fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let own = path.extension().unwrap_or_default();
    endings.iter().any(|ending| own.eq_ignore_ascii_case(ending))
}

/// The name of a file in JSON: text, or, where it is not UTF-8, the list of its bytes.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(untagged)]
pub enum FileName {
    /// The name.
    Text(String),
    /// The bytes of a name that is no text.
    Bytes(Vec<u8>),
}

impl From<&Path> for FileName {
    fn from(path: &Path) -> Self {
        match path.to_str() {
            Some(text) => Self::Text(text.to_owned()),
            None => Self::Bytes(path.as_os_str().as_encoded_bytes().to_vec()),
        }
    }
}

/// The name as a terminal shows it, which may be less than the whole of it.
impl fmt::Display for FileName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&match self {
            Self::Text(text) => shown(text),
            Self::Bytes(bytes) => shown(String::from_utf8_lossy(bytes)),
        })
    }
}

/// A file or stream that was opened to be read.
pub struct Input {
    path: PathBuf,
    reader: Box<dyn Read>,
    length: Option<u64>,
    /// Bytes read of it.
    read: u64,
    mesh: Option<FileFormat>,
    is_texture: bool,
    array: bool,
    container: bool,
    is_text: bool,
    is_broken_text: bool,
}

impl Input {
    /// Opens a file; `-` is the standard input. Looks at its first bytes, which are still there to be read.
    ///
    /// # Errors
    /// [`unitvec_files::Error::Read`].
    pub fn open(path: &Path) -> Result<Self> {
        let error = |source| unitvec_files::Error::reading(path, source);
        let (mut reader, length) = unitvec_files::open(path).map_err(error)?;
        let mut head = Vec::new();
        reader.by_ref().take(FileFormat::HEAD as u64).read_to_end(&mut head).map_err(error)?;
        let (mesh, is_text) = (FileFormat::of(path, &head), is_text(&head));
        let is_broken_text = mesh.is_some_and(|format| format.is_text(&head)) && head.contains(&0);
        let (array, container) = (head.starts_with(Npy::MAGIC), head.starts_with(container::MAGIC));
        let (is_texture, path) =
            (mesh.is_none() && unitvec_texture::kind(path, &head).is_some(), path.to_owned());
        let reader = Box::new(Cursor::new(head).chain(reader));
        Ok(Self {
            path,
            reader,
            length,
            read: 0,
            mesh,
            is_texture,
            array,
            container,
            is_text,
            is_broken_text,
        })
    }

    /// The format of the mesh in the file, if it holds one.
    pub fn mesh(&self) -> Option<FileFormat> {
        self.mesh
    }

    /// True where raw floats can be expected: one of [`RAW_ENDINGS`], the standard input, a pipe or a device.
    pub fn is_raw(&self) -> bool {
        self.length.is_none() || has_ending(&self.path, &RAW_ENDINGS)
    }

    /// The header of a NumPy array, read from the input, if it is one.
    ///
    /// # Errors
    /// Those of [`Npy::read`].
    pub fn array(&mut self) -> Result<Option<Npy>> {
        match self.array {
            true => Npy::read(self).map(Some).map_err(|error| self.error(error)),
            false => Ok(None),
        }
    }

    /// The header of codes that have one, read from the input.
    ///
    /// # Errors
    /// Those of [`Header::read`].
    pub fn header(&mut self) -> Result<Option<Header>> {
        match self.container {
            true => Header::read(self).map(Some).map_err(|error| self.error(error)),
            false => Ok(None),
        }
    }

    /// An error of reading this input.
    pub fn error(&self, source: io::Error) -> Error {
        unitvec_files::Error::reading(&self.path, source).into()
    }

    /// Compares the number of elements that a header promises with what is left of the file.
    ///
    /// # Errors
    /// [`Error::Truncated`], or [`Error::Files`] for another number.
    pub fn expect(&self, count: u64, bytes: usize, unit: &str) -> Result<Option<u64>> {
        match self.count(bytes, unit)? {
            Some(there) if there != count => {
                let words =
                    format!("its header is of {count} {unit}, and there are {there}; copy the file again");
                Err(self.error(io::Error::other(words)))
            }
            _ => Ok(Some(count)),
        }
    }

    /// Refuses a file that is neither a mesh, an array nor, as far as its start shows, raw floats.
    fn check(&self) -> Result<()> {
        let path = || self.path.clone();
        match self.mesh {
            _ if self.array || self.is_texture => Ok(()),
            None if self.container || !self.is_raw() => Err(Error::UnknownInput { path: path() }),
            None if self.is_text => Err(Error::TextInput { path: path() }),
            _ => Ok(()),
        }
    }

    /// The input's length in bytes, where it is a file.
    pub fn length(&self) -> Option<u64> {
        self.length
    }

    /// Reads the whole input as a mesh, by [`mesh::parse`] for example.
    ///
    /// # Errors
    /// [`MeshError::UnknownFormat`] where it is none, and any error of `parse`.
    pub fn parse<T>(
        mut self,
        parse: impl FnOnce(&Path, FileFormat, &[u8], Reach) -> Result<T, MeshError>,
        reach: Reach,
    ) -> Result<T> {
        let format = self.mesh.ok_or_else(|| MeshError::UnknownFormat { path: self.path.clone() })?;
        let bytes =
            self.read_all(format).map_err(|source| unitvec_files::Error::reading(&self.path, source))?;
        Ok(parse(&self.path, format, &bytes, reach)?)
    }

    /// Reads a whole mesh. Input that cannot be one is found before it fills the memory: 100 GB of zeros are quickly
    /// made.
    fn read_all(&mut self, format: FileFormat) -> io::Result<Vec<u8>> {
        /// A GLB has two chunks, whose lengths have 32 bits each.
        const MOST_OF_GLTF: u64 = 1 << 34;
        if self.is_broken_text {
            return Err(io::Error::other("it has zeros where its format has text"));
        }
        if format == FileFormat::Gltf && self.length.is_some_and(|length| length > MOST_OF_GLTF) {
            return Err(io::Error::other("it is longer than glTF can be"));
        }
        self.read_whole()
    }

    fn read_whole(&mut self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(self.length.and_then(|length| length.try_into().ok()).unwrap_or(0))?;
        self.read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    /// Reads the whole input as a texture, of codes of this codec if one is given.
    ///
    /// # Errors
    /// Errors of reading, and of [`unitvec_texture::read`].
    pub fn texture(mut self, codec: Option<&'static AnyCodec>) -> Result<Source> {
        // What is no texture is refused without its bytes.
        let bytes = if self.is_texture { self.read_whole() } else { Ok(Vec::new()) };
        let bytes = bytes.map_err(|source| self.error(source))?;
        Ok(unitvec_texture::read(&self.path, &bytes, codec)?)
    }

    /// The number of elements of so many bytes, if it is known.
    ///
    /// # Errors
    /// [`Error::Truncated`] where by the file's length it ends within an element, so that nobody waits to learn it.
    pub fn count(&self, bytes: usize, unit: &str) -> Result<Option<u64>> {
        let Some(length) = self.length.map(|length| length.saturating_sub(self.read)) else {
            return Ok(None);
        };
        let (whole, left) = (length / bytes as u64, (length % bytes as u64) as usize);
        match left {
            0 => Ok(Some(whole)),
            _ => Err(Error::truncated(&self.path, whole, unit, bytes, left)),
        }
    }
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(buffer)?;
        self.read += count as u64;
        if count == 0 && !buffer.is_empty() && self.length.is_some_and(|length| self.read < length) {
            return Err(io::Error::other("it became shorter while it was read"));
        }
        Ok(count)
    }
}

/// Vectors or frames to encode: those of a mesh or a texture, or raw ones.
pub struct Elements {
    /// Little-endian f32. Computed normals without a direction are zero.
    pub floats: Box<dyn Read>,
    /// The number of elements, where it is known.
    pub count: Option<u64>,
    /// The ranges of the elements of a mesh's primitives.
    pub parts: Option<Vec<Part>>,
    /// True for raw floats whose kind nothing tells.
    pub is_guess: bool,
    /// What was made of a mesh beside what it has, in words: see [`mesh::Generated`].
    pub note: Option<String>,
}

/// What the command line says of a file of elements.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kind {
    /// Raw floats, whatever the name and the first bytes say.
    pub raw: bool,
    /// The kind of raw floats; f32 if not given.
    pub dtype: Option<Dtype>,
    /// The files that a mesh may name as its buffers.
    pub reach: Reach,
}

impl Elements {
    /// True where elements of a mesh are computed from its faces.
    pub fn are_computed(&self) -> bool {
        self.parts.iter().flatten().any(|part| part.computed)
    }

    /// Opens a file or, with `-`, the standard input: as a mesh, a texture or a NumPy array where it is one, as raw floats where
    /// [`Input::is_raw`]. With [`Kind::raw`], as raw floats in any case.
    ///
    /// # Errors
    /// [`Error::UnknownInput`] if it is neither, [`Error::TextInput`] if it is text instead of raw floats, and any
    /// error of reading.
    pub fn open(path: &Path, element: Element, kind: Kind) -> Result<Self> {
        let mut input = Input::open(path)?;
        if !kind.raw {
            input.check()?;
            if kind.dtype.is_some() && (input.array || input.mesh.is_some() || input.is_texture) {
                let words = format!(
                    "{} tells the kind of its floats; leave --dtype out, or add --raw",
                    path.display()
                );
                return Err(Error::Usage(words));
            }
            if let Some(array) = input.array()? {
                let (dtype, count) = array.elements(element).map_err(|error| input.error(error))?;
                let count = input.expect(count, element.floats() * dtype.bytes, element.plural())?;
                return Ok(Self {
                    floats: dtype.as_f32(input),
                    count,
                    parts: None,
                    is_guess: false,
                    note: None,
                });
            }
        }
        if input.is_texture && !kind.raw {
            if element != Element::Vector {
                return Err(Error::Usage(format!(
                    "{} holds vectors, no {}",
                    path.display(),
                    element.plural()
                )));
            }
            let vectors = input.texture(None)?.map.vectors;
            return Ok(Self { parts: None, ..Self::of_mesh(vectors, Vec::new()) });
        }
        match (input.mesh.filter(|_| !kind.raw), element) {
            (None, _) => {
                let dtype = kind.dtype.unwrap_or(Dtype::F32);
                let count = input.count(element.floats() * dtype.bytes, element.plural())?;
                let is_guess = kind.dtype.is_none();
                Ok(Self { floats: dtype.as_f32(input), count, parts: None, is_guess, note: None })
            }
            (Some(_), Element::Vector) => {
                let Mesh { normals, parts } = input.parse(mesh::parse, kind.reach)?;
                Ok(Self::of_mesh(normals, parts))
            }
            (Some(_), Element::Frame) => {
                let Frames { frames, parts, generated } = input.parse(mesh::parse_frames, kind.reach)?;
                Ok(Self { note: generated.in_words(), ..Self::of_mesh(frames, parts) })
            }
            (Some(_), Element::Rotation) => {
                let Rotations { rotations, parts } = input.parse(mesh::parse_rotations, kind.reach)?;
                Ok(Self::of_mesh(rotations, parts))
            }
        }
    }

    /// Finds early the files that [`open`](Self::open) would refuse before it parses them. Pipes are left alone, since
    /// they can be opened once.
    ///
    /// # Errors
    /// The errors of [`open`](Self::open).
    pub fn check(path: &Path, raw: bool) -> Result<()> {
        if path == Path::new("-") || path.metadata().is_ok_and(|data| !data.is_file() && !data.is_dir()) {
            return Ok(());
        }
        let input = Input::open(path)?;
        if raw { Ok(()) } else { input.check() }
    }

    fn of_mesh<const N: usize>(elements: Vec<[f32; N]>, parts: Vec<Part>) -> Self {
        let count = Some(elements.len() as u64);
        let floats = Box::new(Cursor::new(Bytes::of(elements)));
        Self { floats, count, parts: Some(parts), is_guess: false, note: None }
    }
}

/// The little-endian bytes of floats, in the place of the floats.
struct Bytes<const N: usize>(Vec<[f32; N]>);

impl<const N: usize> Bytes<N> {
    fn of(mut elements: Vec<[f32; N]>) -> Self {
        swap_if_big_endian(elements.as_flattened_mut());
        Self(elements)
    }
}

impl<const N: usize> AsRef<[u8]> for Bytes<N> {
    fn as_ref(&self) -> &[u8] {
        bytemuck::cast_slice(self.0.as_flattened())
    }
}

/// True for printable text in UTF-8, of which the end may be cut off. Floats of directions have bytes that are not.
fn is_text(head: &[u8]) -> bool {
    let whole = match std::str::from_utf8(head) {
        Err(error) if error.error_len().is_none() => head.get(..error.valid_up_to()),
        Err(_) => None,
        Ok(_) => Some(head),
    };
    let is_printable = |byte: &u8| !byte.is_ascii_control() || byte.is_ascii_whitespace();
    whole.is_some_and(|text| !text.is_empty() && text.iter().all(is_printable))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw::to_bytes;

    /// Bytes that were looked at are read again, and all after them.
    #[test]
    fn the_first_bytes_are_read_again() {
        let folder = tempfile::tempdir().unwrap();
        for length in [0, 3, FileFormat::HEAD, FileFormat::HEAD + 5] {
            let bytes: Vec<u8> = (0..length).map(|at| (at % 251) as u8).collect();
            let path = folder.path().join("a.bin");
            std::fs::write(&path, &bytes).unwrap();
            let (mut input, mut read) = (Input::open(&path).unwrap(), Vec::new());
            assert_eq!(input.length(), Some(length as u64));
            input.read_to_end(&mut read).unwrap();
            assert!(read == bytes, "{length}");
        }
    }

    /// Text is not taken for raw floats, unless asked to be; no bytes at all are no text.
    #[test]
    fn text_is_no_raw_input() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bin");
        let floats = to_bytes(&[0.6, -0.8, 0.0]);
        let late = format!("{{{}\"asset\":{{}}}}", " ".repeat(FileFormat::HEAD));
        let umlauts = "\u{e4}".repeat(FileFormat::HEAD);
        for (content, is_text) in [
            (&b"v 0 0 0\r\nvn 0 0 1\n"[..], true),
            ("# M\u{fc}nchen\nv 0 0 0".as_bytes(), true),
            (late.as_bytes(), true),
            (umlauts.as_bytes(), true),
            (&format!("a{umlauts}").into_bytes(), true),
            (b"", false),
            (&floats, false),
            (b"v 0 0 0\0", false),
            (b"v 0 0 0\xff", false),
        ] {
            std::fs::write(&path, content).unwrap();
            for found in [
                Elements::open(&path, Element::Vector, Kind::default()).map(drop),
                Elements::check(&path, false),
            ] {
                assert_eq!(matches!(found, Err(Error::TextInput { .. })), is_text, "{}", content.len());
            }
            let raw = Kind { raw: true, ..Kind::default() };
            let raw = Elements::open(&path, Element::Vector, raw).map(drop);
            assert!(matches!(raw, Ok(()) | Err(Error::Truncated { .. })), "{raw:?}");
        }
    }
}
