//! Codecs that are chosen at run time.

use std::ffi::{CString, c_char};
use std::ptr;
use std::sync::LazyLock;
use unitvec_catalogue::AnyCodec;

/// A codec, of vectors or of frames: see unitvec_find. It lives as long as the program.
pub struct Codec {
    pub(crate) any: &'static AnyCodec,
    pub(crate) id: CString,
    vk_format: Option<CString>,
}

/// All codecs, in the order of the list.
static CODECS: LazyLock<Vec<Codec>> =
    LazyLock::new(|| unitvec_catalogue::CODECS.iter().map(Codec::new).collect());

impl Codec {
    fn new(any: &'static AnyCodec) -> Self {
        // Neither name has a zero in it.
        let text = |name: &str| CString::new(name).unwrap_or_default();
        Self { any, id: text(any.id), vk_format: any.vk_format.map(text) }
    }

    pub(crate) fn find(id: &[u8]) -> Option<&'static Self> {
        CODECS.iter().find(|codec| codec.id.as_bytes() == id)
    }

    /// The codec at an address, if it is one of the list's: the address is compared, not read.
    pub(crate) fn at(pointer: *const Self) -> Option<&'static Self> {
        CODECS.iter().find(|codec| ptr::eq(*codec, pointer))
    }
}

/// A pointer to a value that was found, or NULL.
fn pointer<T>(found: Option<&'static T>) -> *const T {
    found.map_or(ptr::null(), |value| value)
}

/// The number of codecs.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_count() -> usize {
    CODECS.len()
}

/// The codec at an index less than unitvec_codec_count, or NULL. The order may differ between versions.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_at(index: usize) -> *const Codec {
    pointer(CODECS.get(index))
}

/// The identifier, such as "oct32p". NULL for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_id(codec: *const Codec) -> *const c_char {
    Codec::at(codec).map_or(ptr::null(), |codec| codec.id.as_ptr())
}

/// Significant bits of a code. 0 for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_bits(codec: *const Codec) -> u32 {
    Codec::at(codec).map_or(0, |codec| codec.any.bits)
}

/// Bytes of a stored code: 1, 2, 3, 4, 6 or 8. 0 for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_bytes(codec: *const Codec) -> usize {
    Codec::at(codec).map_or(0, |codec| codec.any.bytes)
}

/// Floats of an element: 3 for vectors, 7 for frames. 0 for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_floats(codec: *const Codec) -> usize {
    Codec::at(codec).map_or(0, |codec| codec.any.element.floats())
}

/// Upper bound of the angle between a direction and its decoded code, in degrees; for frames, the greater of the bounds
/// for normal and tangent. 0 for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_max_error_deg(codec: *const Codec) -> f32 {
    Codec::at(codec).map_or(0.0, |codec| codec.any.max_error_deg())
}

/// What unitvec_codec_null gives where there is no null code.
pub const UNITVEC_NO_NULL: u64 = u64::MAX;

/// The null code: one that encoding never writes, so that it can stand for vectors without a direction. UNITVEC_NO_NULL
/// where there is none, and for an unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_null(codec: *const Codec) -> u64 {
    Codec::at(codec).and_then(|codec| codec.any.null().ok()).map_or(UNITVEC_NO_NULL, |null| null.code)
}

/// The Vulkan format with the layout of the code, such as "VK_FORMAT_R16G16_SNORM". NULL where there is none, and for an
/// unknown codec.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_codec_vk_format(codec: *const Codec) -> *const c_char {
    let name = Codec::at(codec).and_then(|codec| codec.vk_format.as_ref());
    name.map_or(ptr::null(), |name| name.as_ptr())
}

/// The version of the library, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}
