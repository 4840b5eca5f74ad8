//! Pixels.

use spirv_std::glam::{UVec2, Vec4};
use unitvec::arith::whole_to_u32;

/// The pixel with this centre.
pub fn pixel_at(centre: Vec4) -> UVec2 {
    UVec2::new(whole_to_u32(centre.x), whole_to_u32(centre.y))
}
