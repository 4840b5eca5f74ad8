//! Pictures from functions: of the sphere as seen from far away, and of a square.

use super::canvas::Theme;
use crate::picture::{linear, srgb8};
use glam::{DMat3, DVec2, DVec3};
use image::{Rgb, RgbImage};
use rayon::prelude::*;
use unitvec_catalogue::Domain;

/// Linear red, green and blue.
pub type Colour = DVec3;

/// Samples of a pixel in a row.
pub const SAMPLES: u32 = 4;

/// Half the side of the square around a disc of radius 1.
pub const MARGIN: f64 = 1.03;

/// The view of the sphere: rows are right, up and towards the eye. z is upwards; above the equator and beside an
/// octant's middle, so that octants of all kinds are visible.
pub fn from_the_side() -> DMat3 {
    let (turn, height) = (0.45f64, 0.6f64);
    let eye = DVec3::new(height.cos() * turn.cos(), height.cos() * turn.sin(), height.sin());
    let right = DVec3::Z.cross(eye).normalize();
    DMat3::from_cols(right, eye.cross(right), eye).transpose()
}

/// The view along the axis z for the hemisphere, [`from_the_side`] for the sphere.
pub fn of_domain(domain: Domain) -> DMat3 {
    if domain == Domain::Hemisphere { DMat3::IDENTITY } else { from_the_side() }
}

/// A square picture of a function of the plane [-1, 1]^2, y upwards; `samples` by `samples` samples a pixel.
pub fn square(side: u32, samples: u32, colour: impl Fn(DVec2) -> Colour + Sync) -> RgbImage {
    let scale = 2.0 / f64::from(side * samples);
    let pixels: Vec<u8> = (0..side * side)
        .into_par_iter()
        .flat_map_iter(|pixel| {
            let (left, top) = (pixel % side * samples, pixel / side * samples);
            let sample = |n: u32| {
                let x = f64::from(left + n % samples) + 0.5;
                let y = f64::from(top + n / samples) + 0.5;
                colour(DVec2::new(scale * x - 1.0, 1.0 - scale * y))
            };
            let sum: Colour = (0..samples * samples).map(sample).sum();
            to_srgb(sum / f64::from(samples * samples))
        })
        .collect();
    // The buffer has as many bytes as the picture asks for.
    RgbImage::from_raw(side, side, pixels).unwrap_or_default()
}

/// A picture with every fifth step of each colour: where it is as fine as noise, nobody sees that, and its file is half as large.
pub fn coarse(mut picture: RgbImage) -> RgbImage {
    picture.iter_mut().for_each(|step| *step = step.saturating_add(2) / 5 * 5);
    picture
}

/// A picture of a function of directions, over the half of the sphere that is seen; paper around it.
pub fn disc(
    theme: Theme,
    side: u32,
    samples: u32,
    view: DMat3,
    colour: impl Fn(DVec3) -> Colour + Sync,
) -> RgbImage {
    let paper = from_srgb(theme.paper);
    square(side, samples, |place| seen(place, view).map_or(paper, &colour))
}

/// The direction that is seen at a place of a disc's square.
fn seen(place: DVec2, view: DMat3) -> Option<DVec3> {
    let place = place * MARGIN;
    let depth = 1.0 - place.length_squared();
    (depth >= 0.0).then(|| view.transpose() * place.extend(depth.sqrt()))
}

/// The place of a direction on a disc's square, if it is on the near side.
pub fn place(direction: DVec3, view: DMat3) -> Option<DVec2> {
    let turned = view * direction;
    (turned.z > 0.0).then(|| turned.truncate() / MARGIN)
}

/// The pixel of a place.
pub fn pixel(place: DVec2, side: u32) -> DVec2 {
    DVec2::new(1.0 + place.x, 1.0 - place.y) * (f64::from(side) / 2.0)
}

/// Adds up light or ink at places between pixels, so that dots are smooth.
pub struct Dots {
    side: u32,
    ink: Vec<f64>,
}

impl Dots {
    /// An image without a dot.
    pub fn new(side: u32) -> Self {
        Self { side, ink: vec![0.0; (side * side) as usize] }
    }

    /// Adds a dot of a pixel's size, shared among the four pixels that it lies on.
    pub fn add(&mut self, place: DVec2, amount: f64) {
        let at = pixel(place, self.side) - 0.5;
        let first = at.floor();
        let part = at - first;
        for corner in [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE] {
            let share = (DVec2::ONE - (part - corner).abs()).clamp(DVec2::ZERO, DVec2::ONE);
            let to = first + corner;
            if to.cmpge(DVec2::ZERO).all() && to.cmplt(DVec2::splat(f64::from(self.side))).all() {
                self.ink[to.y as usize * self.side as usize + to.x as usize] += amount * share.x * share.y;
            }
        }
    }

    /// Converts the image to a picture, in the paper's opposite on the paper.
    pub fn picture(&self, theme: Theme) -> RgbImage {
        let pixels = self.ink.iter().flat_map(|ink| {
            let left = 2.0 * (-ink).exp() - 1.0;
            theme.paper.map(f64::from).map(|paper| (127.5 + (paper - 127.5) * left).round() as u8)
        });
        coarse(RgbImage::from_raw(self.side, self.side, pixels.collect()).unwrap_or_default())
    }
}

/// The bytes of a linear colour, by the curve of sRGB.
pub fn to_srgb(colour: Colour) -> [u8; 3] {
    colour.to_array().map(srgb8)
}

/// The linear colour of bytes.
pub fn from_srgb(bytes: [u8; 3]) -> Colour {
    Colour::from_array(bytes.map(|byte| linear(f64::from(byte))))
}

/// A strip of colours from 0 at the left to 1 at the right.
pub fn strip(width: u32, height: u32, colour: impl Fn(f64) -> Colour) -> RgbImage {
    RgbImage::from_fn(width, height, |x, _| Rgb(to_srgb(colour((f64::from(x) + 0.5) / f64::from(width)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_of_srgb_comes_back() {
        for byte in 0..=255 {
            assert_eq!(to_srgb(from_srgb([byte; 3])), [byte; 3]);
        }
    }

    /// Anything drawn at a direction's place is drawn with that direction.
    #[test]
    fn places_and_directions_agree() {
        for view in [Domain::Sphere, Domain::Hemisphere].map(of_domain) {
            let direction = seen(DVec2::new(0.3, -0.5), view).unwrap();
            assert!((direction.length() - 1.0).abs() < 1e-12);
            assert!(place(direction, view).unwrap().distance(DVec2::new(0.3, -0.5)) < 1e-12);
            assert!(place(-direction, view).is_none());
        }
    }

    /// A dot's ink is the same wherever it falls.
    #[test]
    fn dots_are_shared() {
        for place in [DVec2::ZERO, DVec2::new(0.113, 0.207)] {
            let mut dots = Dots::new(8);
            dots.add(place, 1.0);
            assert!((dots.ink.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}
