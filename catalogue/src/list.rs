//! The rows, from the lists of [`unitvec`].

use crate::AnyCodec;
use crate::cpu::encode_by_table;
use unitvec::{for_each_codec, for_each_frame, for_each_rotation};

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

macro_rules! rotations {
    ($([$id:ident $codec:ident = $($rest:tt)*])*) => {
        const ROTATIONS: &[AnyCodec] = &[$(AnyCodec::of_rotations::<unitvec::$codec>()),*];
    };
}

for_each_rotation!(rotations);

/// The number of codecs before those of rotations.
const BEFORE_ROTATIONS: usize = VECTORS.len() + FRAMES.len();

/// Every codec: those of vectors, by family and width, then those of frames, and then those of rotations.
pub static CODECS: [AnyCodec; BEFORE_ROTATIONS + ROTATIONS.len()] = {
    let mut codecs = [FRAMES[0]; BEFORE_ROTATIONS + ROTATIONS.len()];
    let mut i = 0;
    while i < codecs.len() {
        codecs[i] = if i < VECTORS.len() {
            VECTORS[i]
        } else if i < BEFORE_ROTATIONS {
            FRAMES[i - VECTORS.len()]
        } else {
            ROTATIONS[i - BEFORE_ROTATIONS]
        };
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
    &CODECS[VECTORS.len()..BEFORE_ROTATIONS]
}

/// Every codec that stores a direction: those of vectors and of tangent frames.
pub fn directions() -> &'static [AnyCodec] {
    &CODECS[..BEFORE_ROTATIONS]
}

/// Every codec of rotations.
pub fn rotations() -> &'static [AnyCodec] {
    &CODECS[BEFORE_ROTATIONS..]
}
