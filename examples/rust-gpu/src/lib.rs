//! A shader of one's own that stores normals as `oct32` and lights by what it stored.

#![no_std]

use spirv_std::glam::{UVec3, Vec3, Vec4};
use spirv_std::spirv;
use unitvec::{Codec, Oct32};

/// Towards the sun.
const LIGHT: Vec3 = Vec3::new(0.48, 0.6, 0.64);

/// For each normal its code, and how bright the light is on the surface of the decoded one.
#[spirv(compute(threads(64)))]
pub fn light(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] normals: &[Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] codes: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] brightness: &mut [f32],
) {
    let i = id.x as usize;
    if i < normals.len() && i < codes.len() && i < brightness.len() {
        let code = Oct32::encode(normals[i].truncate());
        let normal: Vec3 = Oct32::decode(code);
        codes[i] = code;
        brightness[i] = normal.dot(LIGHT).max(0.0);
    }
}
