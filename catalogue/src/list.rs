//! The rows, from the lists of [`unitvec`].

use crate::AnyCodec;
use crate::cpu::encode_by_table;
use unitvec::{for_each_codec, for_each_frame};

macro_rules! vectors {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => {
        const VECTORS: &[AnyCodec] =
            &[$(AnyCodec::of_vectors::<unitvec::$codec>()$(.$by(encode_by_table::<unitvec::$codec>))?),*];
    };
}

for_each_codec!(vectors);

macro_rules! frames {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => {
        const FRAMES: &[AnyCodec] = &[$(AnyCodec::of_frames::<unitvec::$codec>()),*];
    };
}

for_each_frame!(frames);

/// Every codec: those of vectors, by family and width, and then those of frames.
pub static CODECS: [AnyCodec; VECTORS.len() + FRAMES.len()] = {
    let mut codecs = [FRAMES[0]; VECTORS.len() + FRAMES.len()];
    let mut i = 0;
    while i < codecs.len() {
        codecs[i] = if i < VECTORS.len() { VECTORS[i] } else { FRAMES[i - VECTORS.len()] };
        i += 1;
    }
    codecs
};

/// Every codec of vectors.
pub fn vectors() -> &'static [AnyCodec] {
    &CODECS[..VECTORS.len()]
}

/// Every codec of tangent frames.
pub fn frames() -> &'static [AnyCodec] {
    &CODECS[VECTORS.len()..]
}
