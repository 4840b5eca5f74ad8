//! Offsets from data that encoder and decoder both know.

use glam::{UVec2, Vec2, Vec3};

/// Every bit of the result depends on every bit of `x`: two rounds of shift and multiplication. The multipliers are
/// those of C. Wellons' "lowbias32".
#[inline(always)]
fn hash(x: u32) -> u32 {
    // The sum makes 0 a key as good as others.
    let x = x.wrapping_add(0x9e37_79b9);
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// The middle of one of 2^16 intervals of \[-1/2, 1/2\]: every step is exact.
#[inline(always)]
fn component(bits: u32) -> f32 {
    (bits as f32 + 0.5) * (1.0 / 65536.0) - 0.5
}

/// The offset of a key that both sides know, such as a vertex index: pseudo-random, each component in (-1/2, 1/2).
#[inline(always)]
pub fn dither_from_key(key: u32) -> Vec2 {
    let bits = hash(key);
    Vec2::new(component(bits & 0xffff), component(bits >> 16))
}

/// The offset of a pixel. To have other offsets in each frame, add the frame's number, times some large odd number, to
/// a component.
#[inline(always)]
pub fn dither_from_pixel(pixel: UVec2) -> Vec2 {
    dither_from_key(pixel.x ^ hash(pixel.y))
}

/// The offset of a texel of a tile of noise in VK_FORMAT_R8G8_UNORM: the middles of 256 intervals of \[-1/2, 1/2\].
#[inline(always)]
pub fn dither_from_texel(texel: Vec2) -> Vec2 {
    Vec2::new(texel.x * (255.0 / 256.0) - (255.0 / 512.0), texel.y * (255.0 / 256.0) - (255.0 / 512.0))
}

/// The bits of a coordinate; zeros of both signs and denormals, which some devices flush, give the same bits.
#[inline(always)]
fn coordinate(x: f32) -> u32 {
    if x.abs() < f32::MIN_POSITIVE { 0 } else { x.to_bits() }
}

/// The offset of a position, from all its bits: one that both sides have to the bit, in the object's own coordinates, stays
/// with the surface.
#[inline(always)]
pub fn dither_from_position(position: Vec3) -> Vec2 {
    let x = hash(coordinate(position.x));
    let xy = hash(x ^ coordinate(position.y));
    dither_from_key(xy ^ coordinate(position.z))
}
