//! What codecs of directions are wrapped in: caps, and the sphere with unequal precision; and
//! an order of codes whose prefixes are regions.

mod about;
pub mod cap;
pub mod dense;
#[cfg(not(target_arch = "spirv"))]
pub mod morton;
#[cfg(not(target_arch = "spirv"))]
mod smallest;

pub use cap::Cap;
pub use dense::Dense;
#[cfg(not(target_arch = "spirv"))]
pub use smallest::smallest_cap;
