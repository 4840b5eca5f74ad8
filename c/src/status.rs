//! The results of functions.

use std::ffi::{CStr, c_char};

/// The result of a function for arrays. Unless it is UNITVEC_OK or UNITVEC_ERROR_INTERNAL, nothing was written.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(non_camel_case_types)]
pub enum Status {
    /// All was done.
    UNITVEC_OK = 0,
    /// The codec is NULL, or was not given by unitvec_find or unitvec_codec_at.
    UNITVEC_ERROR_UNKNOWN_CODEC = 1,
    /// A pointer to the elements or to the codes is NULL, and there are some.
    UNITVEC_ERROR_NULL_POINTER = 2,
    /// The size of the codes is not the count of elements times unitvec_codec_bytes, or is beyond what memory can hold.
    UNITVEC_ERROR_SIZE = 3,
    /// The pointer to the elements is not aligned as float is, and there are some.
    UNITVEC_ERROR_ALIGNMENT = 4,
    /// What would be written overlaps elements or codes. Strided arrays that overlap as a whole are right only if their
    /// strides are equal and no values share bytes.
    UNITVEC_ERROR_OVERLAP = 5,
    /// A defect of the library: the output is incomplete. Please report it.
    UNITVEC_ERROR_INTERNAL = 6,
    /// A stride is less than the bytes of a number or code, or the scalar is unknown.
    UNITVEC_ERROR_LAYOUT = 7,
}

impl Status {
    const TEXTS: [(Self, &'static CStr); 8] = [
        (Self::UNITVEC_OK, c"success"),
        (
            Self::UNITVEC_ERROR_UNKNOWN_CODEC,
            c"unknown codec: pass what unitvec_find or unitvec_codec_at gave, unless it is NULL",
        ),
        (Self::UNITVEC_ERROR_NULL_POINTER, c"the pointer to the elements or to the codes is NULL"),
        (
            Self::UNITVEC_ERROR_SIZE,
            c"the size of the codes is not the count of elements times unitvec_codec_bytes",
        ),
        (Self::UNITVEC_ERROR_ALIGNMENT, c"the pointer to the elements is not aligned as float is"),
        (Self::UNITVEC_ERROR_OVERLAP, c"elements or codes that would be written overlap others"),
        (Self::UNITVEC_ERROR_INTERNAL, c"internal error of unitvec: please report it"),
        (
            Self::UNITVEC_ERROR_LAYOUT,
            c"a stride is less than the bytes of a number or code, or the scalar is unknown",
        ),
    ];
}

/// The meaning of a status, in a line of English that lives as long as the program. Any number may be given.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_status_text(status: u32) -> *const c_char {
    let known = Status::TEXTS.into_iter().find(|(known, _)| *known as u32 == status);
    known.map_or(c"not a unitvec_status", |(_, text)| text).as_ptr()
}
