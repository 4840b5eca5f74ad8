//! The push constants of the geometry pass.

use spirv_std::glam::{Mat4, Vec3, Vec4};
use unitvec::arith::dot;

/// The push constants.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Geometry {
    /// Maps object space to clip space.
    pub clip_from_object: Mat4,
    /// Rows of a rotation; w is unused.
    pub world_from_object: [Vec4; 3],
    /// The object's number, 1 and up: 0 is where nothing is drawn.
    pub object: u32,
    /// [`RAW`](crate::RAW) or 0.
    pub flags: u32,
    /// The source of a dithered code's offset.
    pub key: u32,
    /// Moves the keys that belong to the screen.
    pub seed: u32,
}

impl Geometry {
    /// A position in clip space.
    pub fn to_clip(&self, p: Vec3) -> Vec4 {
        let m = &self.clip_from_object;
        ((m.x_axis * p.x + m.y_axis * p.y) + m.z_axis * p.z) + m.w_axis
    }

    /// A normal in world space.
    pub fn to_world(&self, n: Vec3) -> Vec3 {
        let [x, y, z] = self.world_from_object;
        Vec3::new(dot(x.truncate(), n), dot(y.truncate(), n), dot(z.truncate(), n))
    }
}
