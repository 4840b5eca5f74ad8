//! Vectors and codes that lie among other fields, as those of vertices do.

use super::LengthMismatch;
use super::block::BLOCK;
use super::machine::{Level, as_chunks, as_chunks_mut};
use super::stored::with_size;
use core::fmt;

/// One field of an array of structs, or one attribute of a vertex buffer: elements in `bytes`, the first at `offset`, the next
/// ones `stride` bytes apart. Nothing needs to be aligned.
///
/// The three fields give the number of elements: slice `bytes` to limit it. Empty `bytes` hold none. Others hold at least
/// one, and every element that begins inside must end inside; the rest of the last one's stride may be missing.
///
/// Only the element's bytes are written, [`Codec::BYTES`](crate::Codec::BYTES) of a code: check that the field is as large. An `Oct48` in a
/// `u32` overwrites the bytes behind it, and an `Oct24` leaves its upper byte as it was.
///
/// Vectors are three `f32` in native byte order, frames seven; codes are [`Codec::BYTES`](crate::Codec::BYTES) bytes, little endian.
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
    /// The vectors or frames.
    Elements,
    /// The codes.
    Codes,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Elements => "elements",
            Self::Codes => "codes",
        })
    }
}

/// Strided elements and codes do not fit their bytes or each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StrideError {
    /// Elements would overlap.
    Stride {
        /// The elements or the codes.
        side: Side,
        /// The stride.
        stride: usize,
        /// Bytes of an element: the least stride.
        size: usize,
    },
    /// The bytes end within an element, or before the first.
    Length {
        /// The elements or the codes.
        side: Side,
        /// Bytes that there are.
        actual: usize,
        /// The least length: the end of the last element.
        expected: usize,
    },
    /// There are not as many codes as elements.
    Count {
        /// The number of vectors or frames.
        elements: usize,
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
            Self::Count { elements, codes } => {
                write!(f, "{elements} elements and {codes} codes: give equally many")
            }
        }
    }
}

impl core::error::Error for StrideError {}

/// Strided elements of `N` floats by a slice function, whose codes have `size` bytes.
///
/// # Errors
/// The errors of [`encode_strided`](super::encode_strided).
#[doc(hidden)]
pub fn encode_strided_with<const N: usize>(
    level: Level,
    from: Strided<&[u8]>,
    mut to: Strided<&mut [u8]>,
    size: usize,
    encode: impl Fn(Level, &[[f32; N]], &mut [u8]) -> Result<(), LengthMismatch>,
) -> Result<(), StrideError> {
    let count = expect_fit::<N>(from, to.shared(), size)?;
    let (mut some_elements, mut some_codes) = ([[0.0; N]; PORTION], [0; PORTION * LARGEST_CODE]);
    for first in (0..count).step_by(PORTION) {
        let elements = &mut some_elements[..PORTION.min(count - first)];
        load_elements(from, first, elements);
        let length = elements.len() * size;
        let is_packed = to.stride == size;
        let codes = if is_packed { &mut to.starting_mut(first)[..length] } else { &mut some_codes[..length] };
        // There are as many codes as elements, so that this cannot fail.
        let _ = encode(level, elements, codes);
        if !is_packed {
            with_size!(size, SIZE => store_codes::<SIZE>(&some_codes[..length], &mut to, first));
        }
    }
    Ok(())
}

/// The reverse of [`encode_strided_with`].
///
/// # Errors
/// The errors of [`encode_strided`](super::encode_strided).
#[doc(hidden)]
pub fn decode_strided_with<const N: usize>(
    level: Level,
    from: Strided<&[u8]>,
    mut to: Strided<&mut [u8]>,
    size: usize,
    decode: impl Fn(Level, &[u8], &mut [[f32; N]]) -> Result<(), LengthMismatch>,
) -> Result<(), StrideError> {
    let count = expect_fit::<N>(to.shared(), from, size)?;
    let (mut some_elements, mut some_codes) = ([[0.0; N]; PORTION], [0; PORTION * LARGEST_CODE]);
    for first in (0..count).step_by(PORTION) {
        let elements = &mut some_elements[..PORTION.min(count - first)];
        let length = elements.len() * size;
        let codes = if from.stride == size {
            &from.starting(first)[..length]
        } else {
            with_size!(size, SIZE => load_codes::<SIZE>(from, first, &mut some_codes[..length]));
            &some_codes[..length]
        };
        // There are as many codes as elements, so that this cannot fail.
        let _ = decode(level, codes, elements);
        store_elements(elements, &mut to, first);
    }
    Ok(())
}

/// The number of elements that are gathered at a time: whole blocks, which stay in the nearest cache.
pub const PORTION: usize = 4 * BLOCK;

/// Bytes of the largest code.
pub const LARGEST_CODE: usize = size_of::<[u32; 2]>();

/// The number of elements of `N` floats and of codes of `size` bytes, which must be the same.
fn expect_fit<const N: usize>(
    elements: Strided<&[u8]>,
    codes: Strided<&[u8]>,
    size: usize,
) -> Result<usize, StrideError> {
    let elements = elements.count(Side::Elements, size_of::<[f32; N]>())?;
    let codes = codes.count(Side::Codes, size)?;
    if elements == codes { Ok(elements) } else { Err(StrideError::Count { elements, codes }) }
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

    /// The bytes from the beginning of an element on, which [`count`](Self::count) has found to be there.
    #[inline(always)]
    fn starting(self, first: usize) -> &'a [u8] {
        &self.bytes[self.offset + first * self.stride..]
    }
}

impl Strided<&mut [u8]> {
    fn shared(&self) -> Strided<&[u8]> {
        Strided { bytes: self.bytes, offset: self.offset, stride: self.stride }
    }

    /// [`starting`](Strided::starting) to be written to.
    #[inline(always)]
    fn starting_mut(&mut self, first: usize) -> &mut [u8] {
        &mut self.bytes[self.offset + first * self.stride..]
    }
}

fn load_elements<const N: usize>(from: Strided<&[u8]>, first: usize, elements: &mut [[f32; N]]) {
    for (element, bytes) in elements.iter_mut().zip(from.starting(first).chunks(from.stride)) {
        let bytes = as_chunks(&bytes[..4 * N]).0;
        *element = core::array::from_fn(|component| f32::from_ne_bytes(bytes[component]));
    }
}

fn store_elements<const N: usize>(elements: &[[f32; N]], to: &mut Strided<&mut [u8]>, first: usize) {
    let stride = to.stride;
    for (element, bytes) in elements.iter().zip(to.starting_mut(first).chunks_mut(stride)) {
        let bytes = as_chunks_mut(&mut bytes[..4 * N]).0;
        for component in 0..N {
            bytes[component] = element[component].to_ne_bytes();
        }
    }
}

fn load_codes<const SIZE: usize>(from: Strided<&[u8]>, first: usize, codes: &mut [u8]) {
    for (code, bytes) in codes.chunks_exact_mut(SIZE).zip(from.starting(first).chunks(from.stride)) {
        code.copy_from_slice(&bytes[..SIZE]);
    }
}

fn store_codes<const SIZE: usize>(codes: &[u8], to: &mut Strided<&mut [u8]>, first: usize) {
    let stride = to.stride;
    for (code, bytes) in codes.chunks_exact(SIZE).zip(to.starting_mut(first).chunks_mut(stride)) {
        bytes[..SIZE].copy_from_slice(code);
    }
}
