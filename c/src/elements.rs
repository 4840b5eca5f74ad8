//! Elements and codes anywhere in memory: where they lie, whether they can, and portions of them without gaps.

use crate::Status;
use std::ffi::c_void;
use std::ops::Range;
use unitvec::slice::LengthMismatch;
use unitvec_catalogue::{AnyCodec, Operation, has_direction};

/// Numbers of elements are `float`.
pub const UNITVEC_FLOAT32: u32 = 4;

/// Numbers of elements are `double`.
pub const UNITVEC_FLOAT64: u32 = 8;

/// Vectors or frames among other data: in an array of structs, in arrays of components, or in vertex buffers.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Elements {
    /// The places of the first element's components, aligned or not: x, y and z; of a frame those of normal and
    /// tangent, and the handedness. Those that the codec lacks are not used. Encoding reads only.
    pub components: [*mut c_void; 7],
    /// Bytes from an element to the next.
    pub stride: usize,
    /// The same for the last four components of frames, where tangents lie apart from normals. 0: as `stride`.
    pub tangent_stride: usize,
    /// UNITVEC_FLOAT32 or UNITVEC_FLOAT64.
    pub scalar: u32,
}

/// Values of `size` bytes, each `stride` bytes behind the one before.
#[derive(Clone, Copy)]
pub(crate) struct Array {
    pub start: *mut u8,
    pub stride: usize,
    pub size: usize,
}

impl Array {
    pub fn at(self, index: usize) -> *mut u8 {
        self.start.wrapping_add(index * self.stride)
    }

    /// The addresses of `count` values, of which there is one at least, and of what lies between them.
    fn span(self, count: usize) -> Result<Range<usize>, Status> {
        let start = self.start.addr();
        let length = (count - 1).checked_mul(self.stride).and_then(|length| length.checked_add(self.size));
        let end = length.filter(|length| *length <= isize::MAX as usize).and_then(|l| l.checked_add(start));
        match end {
            _ if start == 0 => Err(Status::UNITVEC_ERROR_NULL_POINTER),
            _ if count > 1 && self.stride < self.size => Err(Status::UNITVEC_ERROR_LAYOUT),
            end => Ok(start..end.ok_or(Status::UNITVEC_ERROR_SIZE)?),
        }
    }

    /// True where values share bytes. With different strides, where the spans do.
    pub fn overlaps(self, other: Self, count: usize) -> Result<bool, Status> {
        let (a, b) = (self.span(count)?, other.span(count)?);
        let gap = (b.start as i128 - a.start as i128).rem_euclid(self.stride.max(1) as i128) as usize;
        let alternate = self.stride == other.stride && gap >= self.size && gap + other.size <= self.stride;
        Ok(a.start < b.end && b.start < a.end && (count == 1 || !alternate))
    }
}

/// The array of codes, and behind it those of components.
pub(crate) struct Arrays {
    pub all: [Array; 8],
    pub read: Range<usize>,
    pub written: Range<usize>,
}

impl Arrays {
    /// The arrays of `count` codes and elements of some numbers, where the written ones share no bytes with others.
    pub fn new(
        of: &Elements,
        codes: Array,
        count: usize,
        width: usize,
        by: Operation,
    ) -> Result<Self, Status> {
        if ![UNITVEC_FLOAT32, UNITVEC_FLOAT64].contains(&of.scalar) {
            return Err(Status::UNITVEC_ERROR_LAYOUT);
        }
        let strides = [of.stride, of.tangent_stride];
        let mut all = [codes; 8];
        for (i, start) in of.components.into_iter().map(<*mut c_void>::cast).enumerate() {
            let stride = strides[usize::from(i > 2 && strides[1] > 0)];
            all[1 + i] = Array { start, stride, size: of.scalar as usize };
        }
        let (numbers, codes) = (1..1 + width, 0..1);
        let (read, written) = if by == Operation::Encode { (numbers, codes) } else { (codes, numbers) };
        for (i, j) in written.clone().flat_map(|i| (0..=width).map(move |j| (i, j))) {
            if i != j && all[i].overlaps(all[j], count)? {
                return Err(Status::UNITVEC_ERROR_OVERLAP);
            }
        }
        Ok(Self { all, read, written })
    }
}

/// The number of elements in a [`Portion`].
pub(crate) const PORTION: usize = 128;

/// Some elements, as numbers of the caller's type and as floats, and their codes.
pub(crate) struct Portion {
    pub doubles: [f64; 7 * PORTION],
    pub floats: [f32; 7 * PORTION],
    pub codes: [u8; 8 * PORTION],
}

impl Portion {
    /// The array that stands for one of the caller's.
    pub fn array(&mut self, arrays: &Arrays, index: usize) -> Array {
        let Array { size, .. } = arrays.all[index];
        let numbers: *mut u8 = match (index, size) {
            (0, _) => return Array { start: self.codes.as_mut_ptr(), stride: size, size },
            (_, 8) => self.doubles.as_mut_ptr().cast(),
            _ => self.floats.as_mut_ptr().cast(),
        };
        let width = arrays.read.len().max(arrays.written.len());
        Array { start: numbers.wrapping_add((index - 1) * size), stride: width * size, size }
    }

    /// Encodes the first elements. Returns how many have no direction.
    pub fn encode(&mut self, codec: &AnyCodec, scalar: u32, count: usize) -> Result<usize, LengthMismatch> {
        let width = codec.element.floats();
        let floats = &mut self.floats[..count * width];
        if scalar == UNITVEC_FLOAT64 {
            codec.element.round(&self.doubles, floats);
        }
        codec.encode_here(floats, &mut self.codes[..count * codec.bytes])?;
        Ok(floats.chunks(width).filter(|element| !has_direction(&element[..3])).count())
    }

    /// Decodes the first codes.
    pub fn decode(&mut self, codec: &AnyCodec, count: usize) -> Result<usize, LengthMismatch> {
        let floats = &mut self.floats[..count * codec.element.floats()];
        codec.decode_here(&self.codes[..count * codec.bytes], floats)?;
        self.doubles.iter_mut().zip(floats).for_each(|(double, float)| *double = f64::from(*float));
        Ok(0)
    }
}
