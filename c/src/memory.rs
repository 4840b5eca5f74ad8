//! Functions that take pointers to the caller's memory. All `unsafe` code of this crate is here, except for exported
//! names that are not mangled, which Rust calls unsafe since two could be the same.

// The docs of these functions go to the header, where they say in words what must hold.
#![allow(clippy::missing_safety_doc)]

use crate::{Codec, Status};
use std::ffi::{CStr, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{ptr, slice};
use unitvec::slice::LengthMismatch;
use unitvec_catalogue::AnyCodec;

/// A function that encodes a slice into another of the right length.
type Encode = fn(&AnyCodec, &[f32], &mut [u8]) -> Result<(), LengthMismatch>;

/// A function that decodes a slice into another of the right length.
type Decode = fn(&AnyCodec, &[u8], &mut [f32]) -> Result<(), LengthMismatch>;

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
    unsafe { encode(codec, (elements, count), (codes, codes_size), AnyCodec::encode_here) }
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
    unsafe { decode(codec, (codes, codes_size), (elements, count), AnyCodec::decode_here) }
}

/// unitvec_encode on all cores: the same codes. The threads are started by the first call and stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_encode_parallel(
    codec: *const Codec,
    elements: *const f32,
    count: usize,
    codes: *mut c_void,
    codes_size: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { encode(codec, (elements, count), (codes, codes_size), AnyCodec::encode_cpu) }
}

/// unitvec_decode on all cores: the same elements. The threads are started by the first call and stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitvec_decode_parallel(
    codec: *const Codec,
    codes: *const c_void,
    codes_size: usize,
    elements: *mut f32,
    count: usize,
) -> Status {
    // SAFETY: as the caller promises.
    unsafe { decode(codec, (codes, codes_size), (elements, count), AnyCodec::decode_cpu) }
}

/// # Safety
/// The requirements of [`unitvec_encode`].
unsafe fn encode(
    codec: *const Codec,
    (elements, count): (*const f32, usize),
    (codes, codes_size): (*mut c_void, usize),
    run: Encode,
) -> Status {
    checked(codec, (elements.addr(), count), (codes.addr(), codes_size), |codec, floats| {
        // SAFETY: `checked` found the pointer to be aligned and not NULL, and the size to be less than isize::MAX. The
        // caller promises so many floats.
        let elements = unsafe { slice::from_raw_parts(elements, floats) };
        // SAFETY: not NULL, and of a size that is less than isize::MAX. The caller promises so many bytes, of which nothing
        // else makes use; `checked` found that the elements are none of them.
        let codes = unsafe { slice::from_raw_parts_mut(codes.cast::<u8>(), codes_size) };
        run(codec, elements, codes)
    })
}

/// # Safety
/// The requirements of [`unitvec_decode`].
unsafe fn decode(
    codec: *const Codec,
    (codes, codes_size): (*const c_void, usize),
    (elements, count): (*mut f32, usize),
    run: Decode,
) -> Status {
    checked(codec, (elements.addr(), count), (codes.addr(), codes_size), |codec, floats| {
        // SAFETY: `checked` found the pointer not to be NULL, and the size to be less than isize::MAX. The caller promises
        // so many bytes.
        let codes = unsafe { slice::from_raw_parts(codes.cast::<u8>(), codes_size) };
        // SAFETY: aligned, not NULL, and of a size that is less than isize::MAX. The caller promises so many floats, of
        // which nothing else makes use; `checked` found that the codes are none of them.
        let elements = unsafe { slice::from_raw_parts_mut(elements, floats) };
        run(codec, codes, elements)
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

/// Runs a function of the codec with the number of floats of `count` elements, where slices can be made at both addresses. Does
/// nothing where `count` is 0: then the addresses are not used.
fn checked(
    codec: *const Codec,
    (elements, count): (usize, usize),
    (codes, codes_size): (usize, usize),
    run: impl FnOnce(&AnyCodec, usize) -> Result<(), LengthMismatch>,
) -> Status {
    guarded(|| {
        let codec = Codec::at(codec).ok_or(Status::UNITVEC_ERROR_UNKNOWN_CODEC)?.any;
        let floats = count.checked_mul(codec.element.floats()).ok_or(Status::UNITVEC_ERROR_SIZE)?;
        let size = floats.checked_mul(size_of::<f32>()).ok_or(Status::UNITVEC_ERROR_SIZE)?;
        // Codes are smaller than their elements.
        if size > isize::MAX as usize || count * codec.bytes != codes_size {
            return Err(Status::UNITVEC_ERROR_SIZE);
        }
        if count == 0 {
            return Ok(());
        }
        if elements == 0 || codes == 0 {
            return Err(Status::UNITVEC_ERROR_NULL_POINTER);
        }
        if elements % align_of::<f32>() != 0 {
            return Err(Status::UNITVEC_ERROR_ALIGNMENT);
        }
        if elements < codes.saturating_add(codes_size) && codes < elements.saturating_add(size) {
            return Err(Status::UNITVEC_ERROR_OVERLAP);
        }
        run(codec, floats).map_err(|_| Status::UNITVEC_ERROR_SIZE)
    })
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
