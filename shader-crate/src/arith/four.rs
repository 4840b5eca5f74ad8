//! Four floats, as glam's vector of them. That one is a register of the CPU, and loops over slices take a register for each
//! component of several rotations instead.

use core::ops::Mul;
use glam::{Vec3, Vec4};

#[derive(Clone, Copy)]
pub(crate) struct Four {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub w: f32,
}

impl Four {
    pub const W: Self = Self::new(0.0, 0.0, 0.0, 1.0);

    #[inline(always)]
    pub const fn new(x: f32, y: f32, z: f32, w: f32) -> Self {
        Self { x, y, z, w }
    }

    #[inline(always)]
    pub fn truncate(self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }
}

impl From<Vec4> for Four {
    #[inline(always)]
    fn from(v: Vec4) -> Self {
        Self::new(v.x, v.y, v.z, v.w)
    }
}

impl From<Four> for Vec4 {
    #[inline(always)]
    fn from(v: Four) -> Self {
        Self::new(v.x, v.y, v.z, v.w)
    }
}

impl Mul<f32> for Four {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: f32) -> Self {
        Self::new(self.x * by, self.y * by, self.z * by, self.w * by)
    }
}
