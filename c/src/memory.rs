//! Functions that take pointers to the caller's memory. All `unsafe` code of this crate is here, except for exported
//! names that are not mangled, which Rust calls unsafe since two could be the same.

// The docs of these functions go to the header, where they say in words what must hold.
#![allow(clippy::missing_safety_doc)]

use crate::elements::{Array, Arrays, PORTION, Portion};
use crate::{Codec, Elements, Status};
use std::ffi::{CStr, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{ptr, slice};
use unitvec_catalogue::{AnyCodec, Operation, has_threads};

/// The codec, of vectors or of frames, with an identifier, such as "oct32p". NULL where there is none, and for NULL. `id` must be
/// NULL or a string that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_find(id: *const c_char) -> *const Codec {
    if id.is_null() {
        return ptr::null();
    }
    // SAFETY: not NULL, and the caller promises a zero at the end.
    let id = unsafe { CStr::from_ptr(id) };
    Codec::find(id.to_bytes()).map_or(ptr::null(), |codec| codec)
}

/// Encodes `count` elements of unitvec_codec_floats floats each, without gaps, to codes of unitvec_codec_bytes bytes
/// each, little endian, without gaps. The floats of a frame are normal, tangent and handedness. The work stays on the
/// calling thread. There must be `count` elements at `elements`, and `codes_size` bytes at `codes`, which nothing else
/// uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_encode(
    codec: *const Codec,
    elements: *const f32,
    count: usize,
    codes: *mut c_void,
    codes_size: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { packed(codec, Operation::Encode, (elements.cast_mut(), count), (codes, codes_size), false) }
}

/// Decodes codes, as unitvec_encode writes them, to `count` elements. The work stays on the calling thread. There must
/// be `codes_size` bytes at `codes`, and room for `count` elements at `elements`, which nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_decode(
    codec: *const Codec,
    codes: *const c_void,
    codes_size: usize,
    elements: *mut f32,
    count: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { packed(codec, Operation::Decode, (elements, count), (codes.cast_mut(), codes_size), false) }
}

/// unitvec_encode on all cores: the same codes. The threads are started by the first call and stay; a process that was
/// forked after it works on the calling thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_encode_parallel(
    codec: *const Codec,
    elements: *const f32,
    count: usize,
    codes: *mut c_void,
    codes_size: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { packed(codec, Operation::Encode, (elements.cast_mut(), count), (codes, codes_size), true) }
}

/// unitvec_decode on all cores: the same elements, on the threads of unitvec_encode_parallel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_decode_parallel(
    codec: *const Codec,
    codes: *const c_void,
    codes_size: usize,
    elements: *mut f32,
    count: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { packed(codec, Operation::Decode, (elements, count), (codes.cast_mut(), codes_size), true) }
}

/// unitvec_encode for elements and codes among other data, also of double: the same codes, each `code_stride` bytes
/// behind the one before, on the calling thread. A double is rounded to float; a vector of doubles whose direction
/// floats cannot hold is divided by its largest component first. `without_direction` is NULL, or receives the number of
/// vectors that have no usable direction and so get the code of +Z: those with a NaN or an infinity, zeros, and floats
/// of an L1 norm below 2^-64 or from 2^100 on. Of frames only the normals count. There must be `count` elements and
/// codes, which nothing else writes meanwhile. Codes may lie in fields of the same structs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_encode_strided(
    codec: *const Codec,
    elements: *const Elements,
    count: usize,
    codes: *mut c_void,
    code_stride: usize,
    without_direction: *mut usize,
) -> Status {
    guarded(|| {
        // SAFETY: as the caller promises.
        let lacking = unsafe { strided(codec, Operation::Encode, elements, count, (codes, code_stride)) }?;
        // SAFETY: NULL, or a number of the caller's.
        if let Some(number) = unsafe { without_direction.as_mut() } {
            *number = lacking;
        }
        Ok(())
    })
}

/// unitvec_decode for codes and elements among other data: the reverse of unitvec_encode_strided. There must be `count`
/// codes, and room for as many elements, which nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_decode_strided(
    codec: *const Codec,
    codes: *const c_void,
    code_stride: usize,
    elements: *const Elements,
    count: usize,
) -> Status {
    let codes = (codes.cast_mut(), code_stride);
    // SAFETY: as the caller promises.
    guarded(|| unsafe { strided(codec, Operation::Decode, elements, count, codes) }.map(drop))
}

/// Gathers portions of what an operation reads, and scatters what it makes of them. Returns the number of encoded
/// elements without a direction.
///
/// # Safety
/// The requirements of [`unitvec_encode_strided`] or [`unitvec_decode_strided`].
unsafe fn strided(
    codec: *const Codec,
    operation: Operation,
    elements: *const Elements,
    count: usize,
    (start, stride): (*mut c_void, usize),
) -> Result<usize, Status> {
    let codec = Codec::at(codec).ok_or(Status::UNITVEC_ERROR_UNKNOWN_CODEC)?.any;
    if count == 0 {
        return Ok(0);
    }
    // SAFETY: NULL, or a struct of the caller's.
    let elements = unsafe { elements.as_ref() }.ok_or(Status::UNITVEC_ERROR_NULL_POINTER)?;
    let codes = Array { start: start.cast(), stride, size: codec.bytes };
    let arrays = Arrays::new(elements, codes, count, codec.element.floats(), operation)?;
    let (doubles, floats, codes) = ([0.0; 7 * PORTION], [0.0; 7 * PORTION], [0; 8 * PORTION]);
    let (mut portion, mut lacking) = (Portion { doubles, floats, codes }, 0);
    for first in (0..count).step_by(PORTION) {
        let some = PORTION.min(count - first);
        let rest = |i: usize| Array { start: arrays.all[i].at(first), ..arrays.all[i] };
        // SAFETY: the caller promises `count` values in each array, and the portion has room for `some`.
        arrays.read.clone().for_each(|i| unsafe { copy(rest(i), portion.array(&arrays, i), some) });
        let outcome = match operation {
            Operation::Encode => portion.encode(codec, elements.scalar, some),
            Operation::Decode => portion.decode(codec, some),
        };
        lacking += outcome.map_err(|_| Status::UNITVEC_ERROR_SIZE)?;
        // SAFETY: as above, the other way.
        arrays.written.clone().for_each(|i| unsafe { copy(portion.array(&arrays, i), rest(i), some) });
    }
    Ok(lacking)
}

/// # Safety
/// Both arrays have `count` values, of one size, and share no bytes. They need not be aligned.
unsafe fn copy(from: Array, to: Array, count: usize) {
    // SAFETY: as the caller promises.
    let copy = |size| (0..count).for_each(|i| unsafe { from.at(i).copy_to_nonoverlapping(to.at(i), size) });
    // Copies of known size are single instructions.
    match from.size {
        4 => copy(4),
        8 => copy(8),
        size => copy(size),
    }
}

/// Does nothing where `count` is 0: then the addresses are not used.
///
/// # Safety
/// The requirements of [`unitvec_encode`] or [`unitvec_decode`].
unsafe fn packed(
    codec: *const Codec,
    operation: Operation,
    (elements, count): (*mut f32, usize),
    (codes, codes_size): (*mut c_void, usize),
    parallel: bool,
) -> Status {
    guarded(|| {
        let codec = Codec::at(codec).ok_or(Status::UNITVEC_ERROR_UNKNOWN_CODEC)?.any;
        if count.checked_mul(codec.bytes) != Some(codes_size) {
            return Err(Status::UNITVEC_ERROR_SIZE);
        }
        if count == 0 {
            return Ok(());
        }
        let array = |start: *mut c_void, size| Array { start: start.cast(), stride: size, size };
        let numbers = array(elements.cast(), codec.element.bytes());
        let is_shared = numbers.overlaps(array(codes, codec.bytes), count)?;
        if !elements.is_aligned() {
            return Err(Status::UNITVEC_ERROR_ALIGNMENT);
        }
        if is_shared {
            return Err(Status::UNITVEC_ERROR_OVERLAP);
        }
        let (floats, codes, parallel) =
            (count * codec.element.floats(), codes.cast::<u8>(), parallel && has_threads());
        // SAFETY: `overlaps` found that neither pointer is NULL, that sizes are less than isize::MAX and that no memory
        // is shared; the floats are aligned. The caller promises so many floats and bytes, and that nothing else uses
        // those that are written, nor writes the others.
        let outcome = unsafe {
            match operation {
                Operation::Encode => {
                    let run = if parallel { AnyCodec::encode_cpu } else { AnyCodec::encode_here };
                    run(
                        codec,
                        slice::from_raw_parts(elements, floats),
                        slice::from_raw_parts_mut(codes, codes_size),
                    )
                }
                Operation::Decode => {
                    let run = if parallel { AnyCodec::decode_cpu } else { AnyCodec::decode_here };
                    run(
                        codec,
                        slice::from_raw_parts(codes, codes_size),
                        slice::from_raw_parts_mut(elements, floats),
                    )
                }
            }
        };
        outcome.map_err(|_| Status::UNITVEC_ERROR_SIZE)
    })
}

/// Runs a function whose panics must not unwind into C.
fn guarded(run: impl FnOnce() -> Result<(), Status>) -> Status {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => Status::UNITVEC_OK,
        Ok(Err(status)) => status,
        Err(_) => Status::UNITVEC_ERROR_INTERNAL,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_status() {
        assert_eq!(guarded(|| panic!("on purpose")), Status::UNITVEC_ERROR_INTERNAL);
        assert_eq!(guarded(|| Err(Status::UNITVEC_ERROR_SIZE)), Status::UNITVEC_ERROR_SIZE);
        assert_eq!(guarded(|| Ok(())), Status::UNITVEC_OK);
    }
}
