//! Files of vectors and codes, converted chunk by chunk.

use crate::backend::{Backend, CHUNK};
use crate::catalogue::CodecInfo;
use crate::{Error, Result};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Bytes of a raw vector: three little-endian f32.
pub const VECTOR_BYTES: usize = 12;

/// An input or an output with the path that its errors name.
pub struct Named<'a, S: ?Sized> {
    /// Path, `-` for a standard stream.
    pub path: &'a Path,
    /// Where the bytes come from or go to.
    pub stream: &'a mut S,
}

impl<'a, S: ?Sized> Named<'a, S> {
    /// Names a stream.
    pub fn new(path: &'a Path, stream: &'a mut S) -> Self {
        Self { path, stream }
    }

    fn path(&self) -> PathBuf {
        self.path.to_owned()
    }
}

/// Where bytes come from.
pub type Input<'a> = Named<'a, dyn Read + 'a>;

/// Where bytes go to.
pub type Sink<'a> = Named<'a, dyn Write + 'a>;

/// Encodes raw vectors until the input ends, in bounded memory. `progress` is told the vectors done so far. Returns
/// their number.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within a vector, and whatever reading, encoding or writing meets.
pub fn encode(
    backend: &mut dyn Backend,
    codec: &'static CodecInfo,
    mut input: Input<'_>,
    mut output: Sink<'_>,
    progress: &mut dyn FnMut(u64),
) -> Result<u64> {
    let mut bytes = vec![0; CHUNK * VECTOR_BYTES];
    let mut vectors = vec![[0.0; 3]; CHUNK];
    let mut codes = vec![0; CHUNK * codec.bytes];
    let mut done = 0;
    loop {
        let count = read_elements(&mut input, &mut bytes, VECTOR_BYTES, "vectors", done)?;
        if count == 0 {
            return Ok(done);
        }
        from_bytes(&bytes[..count * VECTOR_BYTES], &mut vectors[..count]);
        encode_chunk(backend, codec, &vectors[..count], &mut codes[..count * codec.bytes], &mut output)?;
        done += count as u64;
        progress(done);
    }
}

/// Encodes vectors from memory. `progress` is told the vectors done so far.
///
/// # Errors
/// Whatever encoding or writing meets.
pub fn encode_vectors(
    backend: &mut dyn Backend,
    codec: &'static CodecInfo,
    vectors: &[[f32; 3]],
    mut output: Sink<'_>,
    progress: &mut dyn FnMut(u64),
) -> Result<u64> {
    let mut codes = vec![0; CHUNK.min(vectors.len()) * codec.bytes];
    let mut done = 0;
    for chunk in vectors.chunks(CHUNK) {
        encode_chunk(backend, codec, chunk, &mut codes[..chunk.len() * codec.bytes], &mut output)?;
        done += chunk.len() as u64;
        progress(done);
    }
    Ok(done)
}

/// Decodes dense codes into raw vectors until the input ends, in bounded memory. `progress` is told the vectors done
/// so far. Returns their number.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within a code, and whatever reading, decoding or writing meets.
pub fn decode(
    backend: &mut dyn Backend,
    codec: &'static CodecInfo,
    mut input: Input<'_>,
    mut output: Sink<'_>,
    progress: &mut dyn FnMut(u64),
) -> Result<u64> {
    let mut codes = vec![0; CHUNK * codec.bytes];
    let mut vectors = vec![[0.0; 3]; CHUNK];
    let mut bytes = vec![0; CHUNK * VECTOR_BYTES];
    let mut done = 0;
    loop {
        let count = read_elements(&mut input, &mut codes, codec.bytes, "codes", done)?;
        if count == 0 {
            return Ok(done);
        }
        backend.decode(codec, &codes[..count * codec.bytes], &mut vectors[..count])?;
        to_bytes(&vectors[..count], &mut bytes[..count * VECTOR_BYTES]);
        write(&mut output, &bytes[..count * VECTOR_BYTES])?;
        done += count as u64;
        progress(done);
    }
}

fn encode_chunk(
    backend: &mut dyn Backend,
    codec: &'static CodecInfo,
    vectors: &[[f32; 3]],
    codes: &mut [u8],
    output: &mut Sink<'_>,
) -> Result<()> {
    backend.encode(codec, vectors, codes)?;
    write(output, codes)
}

fn write(output: &mut Sink<'_>, bytes: &[u8]) -> Result<()> {
    output.stream.write_all(bytes).map_err(|source| Error::writing(output.path, source))
}

/// Fills `buffer` with as many whole elements as there are; 0 at the end of the input. `before` elements were read
/// already.
fn read_elements(
    input: &mut Input<'_>,
    buffer: &mut [u8],
    size: usize,
    unit: &str,
    before: u64,
) -> Result<usize> {
    let filled =
        read_until_full(input.stream, buffer).map_err(|source| Error::Read { path: input.path(), source })?;
    let (count, left) = (filled / size, filled % size);
    if left == 0 {
        return Ok(count);
    }
    let unit = format!("{unit} of {size} bytes");
    Err(Error::Truncated { path: input.path(), whole: before + count as u64, unit, left })
}

fn read_until_full(input: &mut dyn Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match input.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(count) => filled += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

fn from_bytes(bytes: &[u8], vectors: &mut [[f32; 3]]) {
    let component = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    for (bytes, vector) in bytes.chunks_exact(VECTOR_BYTES).zip(vectors) {
        *vector = [component(&bytes[..4]), component(&bytes[4..8]), component(&bytes[8..])];
    }
}

fn to_bytes(vectors: &[[f32; 3]], bytes: &mut [u8]) {
    for (component, bytes) in vectors.as_flattened().iter().zip(bytes.chunks_exact_mut(4)) {
        bytes.copy_from_slice(&component.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::Cpu;
    use crate::catalogue::find;

    /// Hands out its bytes a few at a time, as a pipe may.
    struct Trickle<'a>(&'a [u8]);

    impl Read for Trickle<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = buffer.len().min(self.0.len()).min(7);
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    struct FullDisk;

    impl Write for FullDisk {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn run_encode(input: &[u8], output: &mut dyn Write) -> Result<u64> {
        let codec = find("oct24").unwrap();
        let (from, to) = (Path::new("in"), Path::new("out"));
        encode(&mut Cpu, codec, Named::new(from, &mut Trickle(input)), Named::new(to, output), &mut |_| ())
    }

    #[test]
    fn short_reads_do_not_cut_the_input() {
        let mut codes = Vec::new();
        let one: Vec<u8> = [0.0f32, 0.0, 1.0].iter().flat_map(|c| c.to_le_bytes()).collect();
        assert_eq!(run_encode(&one.repeat(100), &mut codes).unwrap(), 100);
        assert_eq!(codes.len(), 300);
    }

    #[test]
    fn an_input_cut_within_a_vector_is_an_error() {
        let error = run_encode(&[0; 12 * 5 + 4], &mut Vec::new()).unwrap_err();
        assert!(matches!(error, Error::Truncated { whole: 5, left: 4, .. }), "{error}");
    }

    #[test]
    fn a_full_disk_is_an_error_that_names_the_file() {
        let error = run_encode(&[0; 24], &mut FullDisk).unwrap_err();
        assert!(matches!(&error, Error::Write { path, .. } if path == Path::new("out")), "{error}");
    }
}
