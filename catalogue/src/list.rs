//! The rows, from the lists of [`unitvec`].

use crate::cpu::encode_by_table;
use crate::{CodecInfo, FrameInfo};
use unitvec::{for_each_codec, for_each_frame};

macro_rules! catalogue {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => {
        /// Every codec of vectors, by family and width.
        pub static CATALOGUE: &[CodecInfo] =
            &[$(CodecInfo::of::<unitvec::$codec>()$(.$by(encode_by_table::<unitvec::$codec>))?),*];
    };
}

for_each_codec!(catalogue);

macro_rules! frames {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => {
        /// Every codec of tangent frames.
        pub static FRAMES: &[FrameInfo] = &[$(FrameInfo::of::<unitvec::$codec>()),*];
    };
}

for_each_frame!(frames);
