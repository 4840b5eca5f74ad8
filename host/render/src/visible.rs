//! How far the errors of codecs are visible in rendered normals, beside the bounds of [`unitvec_choose::seen`].
//!
//! The renderer draws a body with coded normals. Here, in float64, each pixel is shaded twice, with the normal as it was encoded
//! and as the lighting pass decoded it, and the two colours are compared before they are rounded. Shading is by the formulas of the
//! papers and by samples of the light, and shares no code with the bounds.

use super::{Normals, Renderer, Result, SIDES, Shot, View, scene};
use crate::Material;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use unitvec_catalogue::AnyCodec;
use unitvec_choose::seen::{Colour, Lobe, pixel_angle};
use unitvec_oracle::angle_deg;

/// A pixel that shows a surface. All vectors have unit length.
#[derive(Clone, Copy, Debug)]
pub struct Pixel {
    /// The normal as it was encoded.
    pub normal: DVec3,
    /// The decoded normal.
    pub decoded: DVec3,
    /// The direction to the eye.
    pub to_eye: DVec3,
}

/// The pixels of the bumpy sphere from four sides, with normals in the codec.
///
/// # Errors
/// The errors of [`Renderer::render`].
pub fn sphere(renderer: &mut Renderer, codec: &'static AnyCodec) -> Result<Vec<Pixel>> {
    let (mut pixels, width) = (Vec::new(), renderer.size.width);
    for side in 0..SIDES {
        let (normals, view) = (Normals::Codec(codec), View::Side(side));
        let shot = Shot { normals, view, ..Shot::new(Material::Lambertian) };
        let (camera, _) = scene::arrange(&shot, renderer.size);
        let unit = |v: Vec3| v.as_dvec3().normalize();
        pixels.extend((0..).zip(renderer.seen(&shot)?).filter_map(|(at, seen)| {
            let to_eye = -camera.ray([at % width, at / width]);
            seen.map(|seen| Pixel { normal: unit(seen.normal), decoded: unit(seen.decoded), to_eye })
        }));
    }
    Ok(pixels)
}

/// Lights, one at a time, and the points of each.
const LIGHTS: usize = 8;
const POINTS: u32 = 64;

/// The largest change of a colour in steps, under lights that show most of it: for each of the pixels with the greatest errors there
/// is one by which the lobe is steepest at its normal, in the direction of its error. `peak`: the light at the lobe's peak.
pub fn largest_change(pixels: &[Pixel], lobe: Lobe, peak: f64, colour: Colour) -> f64 {
    let steepest = lobe.steepest(peak, colour).angle;
    let mut worst: Vec<&Pixel> = pixels.iter().collect();
    let error = |pixel: &Pixel| pixel.normal.distance_squared(pixel.decoded);
    worst.sort_by(|a, b| error(b).total_cmp(&error(a)));
    let change = |pixel: &Pixel, light: &Light| {
        let [a, b] = [pixel.normal, pixel.decoded].map(|normal| light.reflected(lobe, normal, pixel.to_eye));
        a.zip(b).map_or(0.0, |(a, b)| (colour.value(peak * a) - colour.value(peak * b)).abs())
    };
    let largest = |light: Light| pixels.iter().map(|pixel| change(pixel, &light)).fold(0.0, f64::max);
    let lights = worst.into_par_iter().take(LIGHTS).map(|pixel| Light::of(pixel, lobe, steepest));
    colour.steps() * lights.map(largest).reduce(|| 0.0, f64::max)
}

/// A light: its middle, and points that are spread over its disc.
struct Light {
    middle: DVec3,
    points: Vec<DVec3>,
}

impl Light {
    /// The light for which the lobe's middle lies at this angle from the pixel's normal, beyond the decoded one.
    fn of(pixel: &Pixel, lobe: Lobe, angle: f64) -> Self {
        let Pixel { normal, decoded, to_eye } = *pixel;
        let aside = (decoded - normal * decoded.dot(normal)).normalize_or(normal.any_orthonormal_vector());
        let axis = normal * angle.cos() + aside * angle.sin();
        let middle = if lobe == Lobe::Lambert { axis } else { axis * (2.0 * axis.dot(to_eye)) - to_eye };
        let (x, y) = middle.any_orthonormal_pair();
        let radius = match lobe {
            Lobe::Ggx { light_degrees, .. } => (0.5 * light_degrees).to_radians(),
            Lobe::Lambert | Lobe::BlinnPhong { .. } => 0.0,
        };
        let count = if radius > 0.0 { POINTS } else { 1 };
        // The pattern of a sunflower's seeds.
        let point = |n: u32| {
            let share = (f64::from(n) + 0.5) / f64::from(count);
            let (sine, cosine) = (f64::from(n) * 2.399_963_229_728_653).sin_cos();
            (middle + (x * cosine + y * sine) * (radius.tan() * share.sqrt())).normalize()
        };
        Self { middle, points: (0..count).map(point).collect() }
    }

    /// The light that a surface reflects to the eye, as a share of the peak; `None` where it faces away from the light.
    fn reflected(&self, lobe: Lobe, normal: DVec3, to_eye: DVec3) -> Option<f64> {
        let half = |light: DVec3| (light + to_eye).normalize();
        match lobe {
            Lobe::Lambert => Some(normal.dot(self.middle).max(0.0)),
            _ if normal.dot(self.middle) <= 0.0 => None,
            Lobe::BlinnPhong { exponent } => Some(normal.dot(half(self.middle)).max(0.0).powf(exponent)),
            Lobe::Ggx { roughness, .. } => {
                let a2 = roughness.powi(4);
                let ggx = |n: DVec3, h: DVec3| (n.dot(h).powi(2) * (a2 - 1.0) + 1.0).powi(-2);
                let sum = |n: DVec3| self.points.iter().map(|light| ggx(n, half(*light))).sum::<f64>();
                Some(sum(normal) / sum(half(self.middle)))
            }
        }
    }
}

/// The largest way by which a reflection moves, in pixels of a flat mirror's picture at its upper edge.
pub fn largest_shift(pixels: &[Pixel], height: u32, fov_degrees: f64) -> f64 {
    let moved = |Pixel { normal, decoded, to_eye }: &Pixel| {
        let [a, b] = [normal, decoded].map(|normal| *normal * (2.0 * normal.dot(*to_eye)) - *to_eye);
        angle_deg(a.to_array(), b.to_array()).to_radians()
    };
    pixels.iter().map(moved).fold(0.0, f64::max) / pixel_angle(height, fov_degrees)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small error changes the colour by the steepest slope; by Lambert's law by its sine; and a reflection by twice its angle. The
    /// bounds of wide lights are for an eye beside the light, which blurs least.
    #[test]
    fn small_errors_are_seen_by_the_slope() {
        let turned = |degrees: f64| DVec3::new(0.6, 0.0, 0.8).rotate_towards(DVec3::Y, degrees.to_radians());
        let (error, colour) = (1e-3f64, Colour { bits: 8, is_linear: true });
        let (normal, decoded) = (turned(0.0), turned(error.to_degrees()));
        let pixels = [Pixel { normal, decoded, to_eye: normal }];
        let change = |lobe| largest_change(&pixels, lobe, 1.0, colour) / 255.0;
        assert!((change(Lobe::Lambert) - error.sin()).abs() < 1e-9);
        for lobe in [
            Lobe::BlinnPhong { exponent: 30.0 },
            Lobe::Ggx { roughness: 0.4, light_degrees: 0.0 },
            Lobe::Ggx { roughness: 0.4, light_degrees: 10.0 },
        ] {
            let bound = lobe.steepest(1.0, colour).slope * error;
            assert!((0.98..=1.001).contains(&(change(lobe) / bound)), "{lobe:?}: {}", change(lobe) / bound);
        }
        let facing = [Pixel { to_eye: turned(-20.0), ..pixels[0] }];
        assert!((largest_shift(&facing, 1080, 60.0) * pixel_angle(1080, 60.0) - 2.0 * error).abs() < 1e-9);
    }
}
