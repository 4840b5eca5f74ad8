//! How a function ended.

use std::ffi::c_char;

/// How a function of arrays ended. Where it is not UNITVEC_OK, nothing was written, but for UNITVEC_ERROR_INTERNAL.
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
    /// The pointer to the elements is not aligned as float is.
    UNITVEC_ERROR_ALIGNMENT = 4,
    /// The elements and the codes overlap.
    UNITVEC_ERROR_OVERLAP = 5,
    /// A defect of the library: what was to be written is incomplete. Please report it.
    UNITVEC_ERROR_INTERNAL = 6,
}

/// What a status means, in a line of English that lives as long as the program. Any number may be given.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_status_text(status: u32) -> *const c_char {
    let text = match status {
        0 => c"success",
        1 => c"unknown codec: pass what unitvec_find or unitvec_codec_at gave, unless it is NULL",
        2 => c"the pointer to the elements or to the codes is NULL",
        3 => c"the size of the codes is not the count of elements times unitvec_codec_bytes",
        4 => c"the pointer to the elements is not aligned as float is",
        5 => c"the elements and the codes overlap",
        6 => c"internal error of unitvec: please report it",
        _ => c"not a unitvec_status",
    };
    text.as_ptr()
}
