//! What codecs of directions are wrapped in, and what is beside them: axes, directions of the plane, vectors with a
//! length, caps, and the sphere with unequal precision; and an order of codes whose prefixes are regions.

mod about;
pub mod angle;
pub mod axial;
pub mod cap;
pub mod dense;
#[cfg(not(target_arch = "spirv"))]
pub mod morton;
#[cfg(not(target_arch = "spirv"))]
mod smallest;
pub mod with_length;

pub use cap::Cap;
pub use dense::Dense;
#[cfg(not(target_arch = "spirv"))]
pub use smallest::smallest_cap;
