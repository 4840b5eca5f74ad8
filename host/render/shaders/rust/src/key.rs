//! The offset of a dithered code, from the facts that both passes know about a pixel.

use spirv_std::glam::{UVec2, Vec2, Vec3, Vec4};
use spirv_std::image::Image2d;
use unitvec::arith::{floor, whole_to_u32};
use unitvec::dither::{dither_from_pixel, dither_from_position, dither_from_texel};

const PIXEL: u32 = 1;
const BLUE_NOISE: u32 = 2;
const POSITION: u32 = 3;

/// The pixel with this centre.
pub fn pixel_at(centre: Vec4) -> UVec2 {
    UVec2::new(whole_to_u32(centre.x), whole_to_u32(centre.y))
}

/// The source of an offset.
#[derive(Clone, Copy)]
pub struct Key {
    /// The key's kind; 0 for no offset.
    pub kind: u32,
    /// Moves the keys that belong to the screen.
    pub seed: u32,
    /// The pixel's centre.
    pub centre: Vec4,
    /// The point on the object, in object space.
    pub position: Vec3,
}

impl Key {
    /// The texel where the pixel is looked up in the frame of this seed: multiples of two irrational numbers, times
    /// 2^32, spread frames evenly.
    fn pixel(&self) -> UVec2 {
        let pixel = pixel_at(self.centre);
        let x = self.seed.wrapping_mul(3_242_174_889) >> 16;
        let y = self.seed.wrapping_mul(2_447_445_414) >> 16;
        UVec2::new(pixel.x + x, pixel.y + y)
    }

    /// The cell of the position, of 1/256 a side: positions themselves differ from frame to frame where an object
    /// moves, since pixels see other points of it.
    fn cell(&self) -> Vec3 {
        let cells = self.position * 256.0;
        Vec3::new(floor(cells.x), floor(cells.y), floor(cells.z))
    }

    /// The offset.
    pub fn offset(&self, blue_noise: &Image2d) -> Vec2 {
        if self.kind == PIXEL {
            return dither_from_pixel(self.pixel());
        }
        if self.kind == BLUE_NOISE {
            let pixel = self.pixel();
            let texel: Vec4 = blue_noise.fetch(UVec2::new(pixel.x & 63, pixel.y & 63));
            return dither_from_texel(Vec2::new(texel.x, texel.y));
        }
        if self.kind == POSITION { dither_from_position(self.cell()) } else { Vec2::ZERO }
    }
}
