//! Vectors and codes that lie among other fields, as those of vertices do.

use super::block::{BLOCK, Floats};
use super::machine::Level;
use super::stored::with_size;
use super::{Decode, Encode};
use crate::codec::Codec;
use core::fmt;
use core::marker::PhantomData;

/// One field of an array of structs, or one attribute of a vertex buffer: elements in `bytes`, the first at `offset`, the next
/// ones `stride` bytes apart. Nothing needs to be aligned.
///
/// The three fields give the number of elements: slice `bytes` to limit it. Empty `bytes` hold none. Others hold at least
/// one, and every element that begins inside must end inside; the rest of the last one's stride may be missing.
///
/// Only the element's bytes are written, [`Codec::BYTES`] of a code: check that the field is as large. An `Oct48` in a
/// `u32` overwrites the bytes behind it, and an `Oct24` leaves its upper byte as it was.
///
/// Vectors are three `f32` in native byte order; codes are [`Codec::BYTES`] bytes, little endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strided<B> {
    /// `&[u8]`, or `&mut [u8]` to be written to.
    pub bytes: B,
    /// Bytes from the beginning to the first element.
    pub offset: usize,
    /// Bytes from the beginning of an element to that of the next.
    pub stride: usize,
}

/// The argument that an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The vectors.
    Vectors,
    /// The codes.
    Codes,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vectors => "vectors",
            Self::Codes => "codes",
        })
    }
}

/// Strided vectors and codes do not fit their bytes or each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrideError {
    /// Elements would overlap.
    Stride {
        /// The vectors or the codes.
        side: Side,
        /// The stride.
        stride: usize,
        /// Bytes of an element: the least stride.
        size: usize,
    },
    /// The bytes end within an element, or before the first.
    Length {
        /// The vectors or the codes.
        side: Side,
        /// Bytes that there are.
        actual: usize,
        /// The least length: the end of the last element.
        expected: usize,
    },
    /// There are not as many codes as vectors.
    Count {
        /// The number of vectors.
        vectors: usize,
        /// The number of codes.
        codes: usize,
    },
}

impl fmt::Display for StrideError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stride { side, stride, size } => {
                write!(f, "the stride of the {side} is {stride} bytes: make it {size} at least")
            }
            Self::Length { side, actual, expected } => {
                write!(
                    f,
                    "the {side} have {actual} bytes and one of them ends at {expected}: check offset and stride"
                )
            }
            Self::Count { vectors, codes } => {
                write!(f, "{vectors} vectors and {codes} codes: give equally many")
            }
        }
    }
}

impl core::error::Error for StrideError {}

/// [`encode_slice`](super::encode_slice) from vectors among other fields to codes among other fields. Bytes between the
/// codes stay as they are.
///
/// ```
/// use core::mem::{offset_of, size_of};
/// use unitvec::slice::{Strided, encode_strided};
/// use unitvec::{Codec, Oct32};
///
/// #[derive(Clone, Copy, bytemuck::NoUninit)]
/// #[repr(C)]
/// struct Vertex {
///     position: [f32; 3],
///     normal: [f32; 3],
///     uv: [f32; 2],
/// }
///
/// let vertex = Vertex { position: [1.0, 2.0, 3.0], normal: [0.0, 1.0, 0.0], uv: [0.5, 0.5] };
/// let vertices = [vertex; 100];
/// let mut codes = [0; 100 * Oct32::BYTES];
/// encode_strided::<Oct32>(
///     Strided {
///         bytes: bytemuck::cast_slice(&vertices),
///         offset: offset_of!(Vertex, normal),
///         stride: size_of::<Vertex>(),
///     },
///     Strided { bytes: &mut codes, offset: 0, stride: Oct32::BYTES },
/// )?;
/// # assert_eq!(codes[396..], Oct32::encode(vertex.normal).to_le_bytes());
/// # Ok::<(), unitvec::slice::StrideError>(())
/// ```
///
/// # Errors
/// [`StrideError`] where the vectors or the codes do not fit their bytes or are not equally many. Nothing is written then.
pub fn encode_strided<C: Codec>(
    vectors: Strided<&[u8]>,
    codes: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    encode_strided_at::<C>(Level::best(), vectors, codes)
}

/// [`decode_slice`](super::decode_slice) from codes among other fields to vectors among other fields: the reverse of
/// [`encode_strided`]. Bytes between the vectors stay as they are.
///
/// Cheap codecs, such as `oct32`, are decoded sooner by a loop of your own over the structs: gathering codes and scattering
/// vectors then costs more than the CPU's vector instructions save.
///
/// # Errors
/// The errors of [`encode_strided`].
pub fn decode_strided<C: Codec>(
    codes: Strided<&[u8]>,
    vectors: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    decode_strided_at::<C>(Level::best(), codes, vectors)
}

/// [`encode_strided`] with the instructions of a given level.
#[doc(hidden)]
pub fn encode_strided_at<C: Codec>(
    level: Level,
    from: Strided<&[u8]>,
    mut to: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    let count = expect_fit::<C>(from, to.shared())?;
    let (mut some_vectors, mut some_codes) = ([[0.0; 3]; PORTION], [0; PORTION * LARGEST_CODE]);
    for start in (0..count).step_by(PORTION) {
        let vectors = &mut some_vectors[..PORTION.min(count - start)];
        let codes = &mut some_codes[..vectors.len() * C::BYTES];
        load_vectors(from, start, vectors);
        level.run(Encode { vectors, codes, codec: PhantomData::<C> });
        with_size!(C::BYTES, SIZE => store_codes::<SIZE>(codes, &mut to, start));
    }
    Ok(())
}

/// [`decode_strided`] with the instructions of a given level.
#[doc(hidden)]
pub fn decode_strided_at<C: Codec>(
    level: Level,
    from: Strided<&[u8]>,
    mut to: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    let count = expect_fit::<C>(to.shared(), from)?;
    let (mut some_vectors, mut some_codes) = ([[0.0; 3]; PORTION], [0; PORTION * LARGEST_CODE]);
    for start in (0..count).step_by(PORTION) {
        let vectors = &mut some_vectors[..PORTION.min(count - start)];
        let codes = &mut some_codes[..vectors.len() * C::BYTES];
        with_size!(C::BYTES, SIZE => load_codes::<SIZE>(from, start, codes));
        level.run(Decode { codes, vectors: &mut *vectors, codec: PhantomData::<(C, Floats)> });
        store_vectors(vectors, &mut to, start);
    }
    Ok(())
}

/// The number of elements that are gathered at a time: whole blocks, which stay in the nearest cache.
const PORTION: usize = 4 * BLOCK;

/// Bytes of a vector.
const VECTOR: usize = size_of::<[f32; 3]>();

/// Bytes of the largest code.
const LARGEST_CODE: usize = size_of::<[u32; 2]>();

/// The number of vectors and of codes, which must be the same.
fn expect_fit<C: Codec>(vectors: Strided<&[u8]>, codes: Strided<&[u8]>) -> Result<usize, StrideError> {
    let vectors = vectors.count(Side::Vectors, VECTOR)?;
    let codes = codes.count(Side::Codes, C::BYTES)?;
    if vectors == codes { Ok(vectors) } else { Err(StrideError::Count { vectors, codes }) }
}

impl<'a> Strided<&'a [u8]> {
    /// The number of elements of `size` bytes.
    fn count(self, side: Side, size: usize) -> Result<usize, StrideError> {
        let Self { bytes, offset, stride } = self;
        if stride < size {
            return Err(StrideError::Stride { side, stride, size });
        }
        if bytes.is_empty() {
            return Ok(0);
        }
        let count = bytes.len().saturating_sub(offset).div_ceil(stride).max(1);
        let end = ((count - 1) * stride).saturating_add(offset).saturating_add(size);
        if end <= bytes.len() {
            Ok(count)
        } else {
            Err(StrideError::Length { side, actual: bytes.len(), expected: end })
        }
    }

    /// The first `size` bytes of an element, which [`count`](Self::count) has found to be there.
    #[inline(always)]
    fn element(self, index: usize, size: usize) -> &'a [u8] {
        let start = self.offset + index * self.stride;
        &self.bytes[start..start + size]
    }
}

impl Strided<&mut [u8]> {
    fn shared(&self) -> Strided<&[u8]> {
        Strided { bytes: self.bytes, offset: self.offset, stride: self.stride }
    }

    /// [`element`](Strided::element) to be written to.
    #[inline(always)]
    fn element_mut(&mut self, index: usize, size: usize) -> &mut [u8] {
        let start = self.offset + index * self.stride;
        &mut self.bytes[start..start + size]
    }
}

// Element by element, by index: with iterators over chunks the loops take half as long again.

fn load_vectors(from: Strided<&[u8]>, first: usize, vectors: &mut [[f32; 3]]) {
    for (i, vector) in vectors.iter_mut().enumerate() {
        let bytes = from.element(first + i, VECTOR);
        let float = |at| f32::from_ne_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        *vector = [float(0), float(4), float(8)];
    }
}

fn store_vectors(vectors: &[[f32; 3]], to: &mut Strided<&mut [u8]>, first: usize) {
    for (i, vector) in vectors.iter().enumerate() {
        let bytes = to.element_mut(first + i, VECTOR);
        bytes[..4].copy_from_slice(&vector[0].to_ne_bytes());
        bytes[4..8].copy_from_slice(&vector[1].to_ne_bytes());
        bytes[8..].copy_from_slice(&vector[2].to_ne_bytes());
    }
}

fn load_codes<const SIZE: usize>(from: Strided<&[u8]>, first: usize, codes: &mut [u8]) {
    for (i, code) in codes.chunks_exact_mut(SIZE).enumerate() {
        code.copy_from_slice(from.element(first + i, SIZE));
    }
}

fn store_codes<const SIZE: usize>(codes: &[u8], to: &mut Strided<&mut [u8]>, first: usize) {
    for (i, code) in codes.chunks_exact(SIZE).enumerate() {
        to.element_mut(first + i, SIZE).copy_from_slice(code);
    }
}
