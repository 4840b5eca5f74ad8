//! The camera of the scene. Right-handed, +Y up; computed in f64, so that the shaders of both languages get the same
//! floats.

use super::picture::Size;
use super::renderer::Lighting;
use bytemuck::Zeroable;
use glam::{DMat4, DVec3, DVec4};

/// A camera and the size of its picture.
#[derive(Clone, Copy)]
pub(super) struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    pub(super) forward: DVec3,
    /// The tangent of half the picture's height.
    tangent: f64,
    size: Size,
    /// The middle of the part that fills the picture and half its extent, both from -1 to 1 across the whole, y downwards.
    part: [[f64; 2]; 2],
}

/// The nearest and farthest distance that is visible.
const NEAR: f64 = 0.5;
const FAR: f64 = 100.0;

impl Camera {
    pub(super) fn new(eye: DVec3, at: DVec3, height_degrees: f64, size: Size) -> Self {
        let forward = (at - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let tangent = (0.5 * height_degrees).to_radians().tan();
        Self { eye, right, up, forward, tangent, size, part: [[0.0; 2], [1.0; 2]] }
    }

    /// The camera of a part of the picture, which fills it: left, top, width and height in pixels of the whole.
    pub(super) fn closer(self, [left, top, width, height]: [u32; 4]) -> Self {
        let along = |from: u32, part: u32, whole: u32| {
            let (from, half) = (f64::from(from), 0.5 * f64::from(part));
            ((from + half) / (0.5 * f64::from(whole)) - 1.0, half / (0.5 * f64::from(whole)))
        };
        let (x, y) = (along(left, width, self.size.width), along(top, height, self.size.height));
        Self { part: [[x.0, y.0], [x.1, y.1]], ..self }
    }

    /// The direction of unit length in which the centre of a pixel is seen.
    pub(super) fn ray(&self, [column, row]: [u32; 2]) -> DVec3 {
        let place = |pixel: u32, pixels: u32, axis: usize| {
            let [middle, half] = self.part.map(|part| part[axis]);
            middle + half * ((2.0 * f64::from(pixel) + 1.0) / f64::from(pixels) - 1.0)
        };
        let x = self.tangent * self.aspect() * place(column, self.size.width, 0);
        let y = -self.tangent * place(row, self.size.height, 1);
        (self.forward + self.right * x + self.up * y).normalize()
    }

    fn aspect(&self) -> f64 {
        f64::from(self.size.width) / f64::from(self.size.height)
    }

    /// Maps to Vulkan's clip space, whose y points down and whose depth goes from 0 to 1. A point `offset` of a pixel
    /// away from a pixel's centre is seen there.
    pub(super) fn clip_from_world(&self, offset: [f64; 2]) -> DMat4 {
        let row = |axis: DVec3| axis.extend(-axis.dot(self.eye));
        let depth = row(self.forward);
        let [middle, half] = self.part;
        let x = (row(self.right) / (self.tangent * self.aspect()) - depth * middle[0]) / half[0];
        let y = (-row(self.up) / self.tangent - depth * middle[1]) / half[1];
        let z = (depth - DVec4::W * NEAR) * (FAR / (FAR - NEAR));
        let shift = |offset: f64, pixels: u32| depth * (2.0 * offset / f64::from(pixels));
        let rows = [x - shift(offset[0], self.size.width), y - shift(offset[1], self.size.height), z, depth];
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
    }

    /// The lighting pass's constants of this camera, whose pixels are seen at an offset from their centres.
    pub(super) fn lighting(&self, offset: [f64; 2]) -> Lighting {
        let Size { width, height } = self.size;
        let [middle, half] = self.part;
        let (x, y) = (2.0 * half[0] / f64::from(width), -2.0 * half[1] / f64::from(height));
        let corner = [middle[0] - half[0], half[1] - middle[1]];
        let viewport = [x, y, x * offset[0] + corner[0], y * offset[1] + corner[1]];
        let vector = |v: DVec3| v.extend(0.0).as_vec4().to_array();
        Lighting {
            right: vector(self.right * (self.tangent * self.aspect())),
            up: vector(self.up * self.tangent),
            forward: vector(self.forward),
            viewport: viewport.map(|value| value as f32),
            ..Lighting::zeroed()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on the ray of a place in the picture is drawn at that place, whatever the offset and the part. A part's corner
    /// is the whole's.
    #[test]
    fn rays_meet_what_is_drawn_there() {
        let size = Size { width: 640, height: 360 };
        let camera = Camera::new(DVec3::new(3.0, 2.0, 5.0), DVec3::new(0.5, 0.0, -1.0), 40.0, size);
        let ray = |camera: Camera, pixel: [f64; 2], offset| {
            let rays = camera.lighting(offset);
            let [x, y] = [0, 1].map(|axis| {
                f64::from(rays.viewport[axis]) * pixel[axis] + f64::from(rays.viewport[axis + 2])
            });
            let vector = |v: [f32; 4]| DVec3::new(v[0].into(), v[1].into(), v[2].into());
            vector(rays.forward) + vector(rays.right) * x + vector(rays.up) * y
        };
        let closer = camera.closer([100, 50, 160, 90]);
        assert!(ray(closer, [0.0, 360.0], [0.0; 2]).distance(ray(camera, [100.0, 140.0], [0.0; 2])) < 1e-6);
        for (camera, offset) in
            [(camera, [0.0, 0.0]), (closer, [0.0, 0.0]), (camera, [0.25, -0.375]), (closer, [0.25, -0.375])]
        {
            for pixel in [[320.5, 180.5], [10.5, 20.5], [600.5, 300.5]] {
                let ray = ray(camera, pixel, offset);
                if offset == [0.0; 2] {
                    assert!(camera.ray(pixel.map(|at| at as u32)).distance(ray.normalize()) < 1e-6);
                }
                let clip = camera.clip_from_world(offset) * (camera.eye + ray * 7.0).extend(1.0);
                let drawn = [
                    (clip.x / clip.w * 0.5 + 0.5) * f64::from(size.width),
                    (clip.y / clip.w * 0.5 + 0.5) * f64::from(size.height),
                ];
                for axis in [0, 1] {
                    assert!((drawn[axis] - pixel[axis]).abs() < 1e-3, "{offset:?} {pixel:?} {drawn:?}");
                }
                assert!((0.0..=clip.w).contains(&clip.z));
            }
        }
    }
}
