//! Files that end in `.uvec`: codes behind a header that names their codec.
//!
//! One file, not codes with a second file beside them: it is renamed as a whole, and cannot be moved without its
//! header. In order, all little endian:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `unitvec` and a zero |
//! | 8 | length n of the JSON: with it the codes begin at a multiple of 64 |
//! | n | a [`Header`] as JSON, padded with spaces |
//! | count × bytes | the codes, without gaps |

use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::io::{self, Read, Write};
use std::path::Path;
use unitvec_catalogue::AnyCodec;
use unitvec_mesh::Part;

/// The first bytes of such a file.
pub const MAGIC: &[u8; 8] = b"unitvec\0";

/// What the codes are.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Header {
    version: u32,
    /// Identifier of the codec.
    pub codec: String,
    /// Bytes of a code.
    pub bytes: usize,
    /// Number of codes.
    pub count: u64,
    /// SHA-256 of the codes, in hexadecimal.
    sha256: String,
    /// True where the codec's null code stands for vectors without a direction; absent where not.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub null: bool,
    /// The ranges of the codes of a mesh's primitives.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    parts: Option<Vec<Part>>,
}

/// The version that is written, and read.
const VERSION: u32 = 1;

impl Header {
    /// The most bytes before the codes.
    pub const MOST: usize = 1 << 26;

    /// A header as long as that of any number of codes.
    pub fn new(format: &AnyCodec, null: bool, parts: Option<Vec<Part>>) -> Self {
        let (codec, count, sha256) = (format.id.to_owned(), u64::MAX, "0".repeat(64));
        Self { version: VERSION, codec, bytes: format.bytes, count, sha256, null, parts }
    }

    /// The bytes before the codes, `length` at least. `hash` is of all `count` codes.
    pub fn finish(mut self, length: usize, count: u64, hash: Sha256) -> Vec<u8> {
        (self.count, self.sha256) = (count, hex(hash));
        self.to_bytes(length)
    }

    /// The bytes before the codes, `length` at least.
    pub fn to_bytes(&self, length: usize) -> Vec<u8> {
        const START: usize = MAGIC.len() + 8;
        let mut bytes = [&MAGIC[..], &[0; 8]].concat();
        // Serialising plain structs and strings to memory has no way to fail.
        let _ = serde_json::to_writer(&mut bytes, self);
        bytes.resize(bytes.len().next_multiple_of(64).max(length), b' ');
        let length = (bytes.len() - START) as u64;
        bytes[MAGIC.len()..START].copy_from_slice(&length.to_le_bytes());
        bytes
    }

    /// Reads a header, up to the first code.
    ///
    /// # Errors
    /// Errors of reading, and one that tells what is wrong.
    pub fn read(reader: &mut impl Read) -> io::Result<Self> {
        let mut start = [0; 16];
        reader.read_exact(&mut start)?;
        let length = start[8..].iter().rev().fold(0, |length, byte| length << 8 | u64::from(*byte));
        let mut json = Vec::new();
        reader.take(length.min(Self::MOST as u64)).read_to_end(&mut json)?;
        // The codec's name stands in messages.
        let is_plain =
            |header: &Self| header.codec.chars().all(|c| c.is_ascii_alphanumeric() || "_-: ".contains(c));
        let header = serde_json::from_slice(&json).ok().filter(is_plain);
        let header: Self =
            header.ok_or_else(|| io::Error::other("its header is damaged; encode the mesh again"))?;
        match header.version {
            VERSION => Ok(header),
            other => {
                let words =
                    format!("its version is {other}, and this program reads {VERSION}: take a newer one");
                Err(io::Error::other(words))
            }
        }
    }

    /// Compares the codes that were read with the header.
    ///
    /// # Errors
    /// [`Error::Damaged`].
    pub fn check(&self, path: &Path, hash: Sha256) -> Result<()> {
        match hex(hash) == self.sha256 {
            true => Ok(()),
            false => Err(Error::Damaged { path: path.to_owned() }),
        }
    }
}

fn hex(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A stream, and the SHA-256 of what went through it.
pub struct Hashed<S> {
    /// The stream.
    pub stream: S,
    /// The hash so far, where one is wanted.
    pub hash: Option<Sha256>,
}

impl<S> Hashed<S> {
    /// A stream that nothing went through yet.
    pub fn new(stream: S, is_wanted: bool) -> Self {
        Self { stream, hash: is_wanted.then(Sha256::new) }
    }

    fn add(&mut self, bytes: &[u8]) {
        if let Some(hash) = &mut self.hash {
            hash.update(bytes);
        }
    }
}

impl<S: Read> Read for Hashed<S> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.stream.read(buffer)?;
        self.add(&buffer[..count]);
        Ok(count)
    }
}

impl<S: Write> Write for Hashed<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.stream.write(bytes)?;
        self.add(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}
