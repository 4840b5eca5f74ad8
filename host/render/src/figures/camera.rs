//! Cameras that take the pictures of the scene.

use crate::{Material, Normals, Renderer, Result, Seen, Shot, View};
use image::RgbImage;
use image::imageops::{FilterType, resize};

/// Takes pictures, as bytes of sRGB.
pub trait Camera {
    /// Takes a picture.
    ///
    /// # Errors
    /// Any error of rendering.
    fn picture(&mut self, shot: &Shot) -> Result<RgbImage>;

    /// The surface that each pixel of the last picture shows.
    ///
    /// # Errors
    /// Any error of rendering.
    fn surface(&mut self, shot: &Shot) -> Result<Vec<Option<Seen>>>;
}

impl Camera for Renderer {
    fn picture(&mut self, shot: &Shot) -> Result<RgbImage> {
        let picture = self.render(shot)?;
        // The picture has as many bytes as its size asks for.
        Ok(RgbImage::from_raw(picture.size.width, picture.size.height, picture.to_srgb8())
            .unwrap_or_default())
    }

    fn surface(&mut self, shot: &Shot) -> Result<Vec<Option<Seen>>> {
        self.seen(shot)
    }
}

/// A shot of some normals.
pub fn shot(normals: Normals, material: Material, view: View) -> Shot {
    Shot { normals, view, ..Shot::new(material) }
}

/// A part of the view, rendered to fill a picture and shrunk to this width, which smooths its edges.
pub fn closer(camera: &mut dyn Camera, shot: &Shot, part: [u32; 4], width: u32) -> Result<RgbImage> {
    Ok(shrunk(&camera.picture(&Shot { part: Some(part), ..*shot })?, width))
}

/// A whole picture, this wide.
pub fn shrunk(picture: &RgbImage, width: u32) -> RgbImage {
    let height = (picture.height() * width).div_ceil(picture.width());
    resize(picture, width, height, FilterType::Triangle)
}
