//! What codecs of directions are wrapped in, and what is beside them: axes, directions of the plane, vectors with a
//! length.

pub mod angle;
pub mod axial;
pub mod with_length;
