//! The precision of normals that is seen: the largest error that changes no colour of a picture by half a step, and moves no
//! reflection by half a pixel.
//!
//! Where a normal is off by the angle e, its angle to any other direction changes by at most e. A colour that depends on one such
//! angle changes by at most e times its steepest slope: by less than half a step of d bits where `e < 1 / (2 (2^d - 1) slope)`.
//! Lambert's slope is at most 1. Meyer et al. 2010 (*On Floating-Point Normal Vectors*), section 3, allow a whole step of 2^-d and
//! steps of equal light; [`least_bits`] counts normals as they do.
//!
//! Highlights here are the distribution of microfacets alone. Fresnel's factor, shadowing and the cosine of the light change over
//! a right angle, not over the width of a highlight, and are left out. Light that several lobes reflect at one place adds up, and
//! so do their slopes.

use std::f64::consts::{FRAC_PI_2, PI};

/// The colours that a picture can have, in each channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// Bits d, of 2^d - 1 steps from black to white.
    pub bits: u32,
    /// True if steps are equal in light; false if they are equal on the curve of sRGB (IEC 61966-2-1), which is steepest in the
    /// dark: 12.92.
    pub is_linear: bool,
}

/// Where the curve of sRGB ends to be a line.
const LINE: f64 = 0.003_130_8;

impl Colour {
    /// The steps from black to white.
    pub fn steps(self) -> f64 {
        f64::from(self.bits).exp2() - 1.0
    }

    /// The value that stands for this much light, both from 0 for black to 1 for white, before it is rounded to a step.
    /// Brighter light is white.
    pub fn value(self, light: f64) -> f64 {
        let light = light.clamp(0.0, 1.0);
        match self.is_linear {
            true => light,
            false if light <= LINE => 12.92 * light,
            false => 1.055 * light.powf(1.0 / 2.4) - 0.055,
        }
    }

    /// The derivative of [`value`](Self::value).
    fn slope(self, light: f64) -> f64 {
        match self.is_linear {
            _ if light > 1.0 => 0.0,
            true => 1.0,
            false if light <= LINE => 12.92,
            false => 1.055 / 2.4 * light.powf(1.0 / 2.4 - 1.0),
        }
    }
}

/// The light that a surface reflects, as a share of its peak: a function of one angle, which falls from 0 to a right angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// A matt surface: `cos t`, t being the angle between normal and light.
    Lambert,
    /// Blinn's highlight (Blinn 1977): `cos^s t`, t being the angle between the normal and the half vector of light and eye. Its
    /// slope `s cos^(s - 1) t sin t` is steepest where `tan^2 t = 1 / (s - 1)`, and there about `sqrt(s / e)`, of Euler's e.
    BlinnPhong {
        /// The exponent s, 1 or more.
        exponent: f64,
    },
    /// The highlight of GGX (Walter et al. 2007, eq. 33), with `a = roughness^2` (Burley 2012) and `k = 1 / a^2 - 1`:
    /// `(1 + k sin^2 t)^-2`. Its slope is steepest where `sin^2 t` is about `1 / (5 k)`, and there about `1.035 / a`.
    ///
    /// A light that is wide blurs it. If the light moves by an angle, the half vector moves by half of it, or by more, so that the
    /// highlight is at least the mean over a disc of a quarter of the light's diameter. That lowers the slope towards
    /// `1 / (2 a)`, since the image of the light's rim remains.
    Ggx {
        /// Roughness, from 0.01 to 1.
        roughness: f64,
        /// The light's diameter in degrees, from 0 to 180.
        light_degrees: f64,
    },
}

/// Where a colour changes most with the angle of a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steepest {
    /// Change of [`Colour::value`] per radian.
    pub slope: f64,
    /// Angle in radians.
    pub angle: f64,
}

impl Lobe {
    /// The largest error in degrees that changes no colour by half a step; infinite for a lobe that is the same everywhere. `peak`:
    /// the light at the peak, as a multiple of white.
    pub fn max_error_deg(self, peak: f64, colour: Colour) -> f64 {
        (0.5 / (colour.steps() * self.steepest(peak, colour).slope)).to_degrees()
    }

    /// The steepest place, searched from the dark end to the peak in steps that are finest where the lobe bends. The light there is
    /// the sum of what it falls by on the way.
    pub fn steepest(self, peak: f64, colour: Colour) -> Steepest {
        const PLACES: u32 = 4096;
        let (edge, width) = self.bend();
        let [first, last] = [-edge, FRAC_PI_2 - edge].map(|angle| (angle / width).asinh());
        let place =
            |n| (edge + width * (last + (first - last) * f64::from(n) / f64::from(PLACES)).sinh()).max(0.0);
        let at = |angle: f64, fall: f64, share: f64| {
            let slope = colour.slope(peak * share) * peak * fall;
            Steepest { slope, angle }
        };
        let (mut angle, mut fall, mut share) = (FRAC_PI_2, self.fall(FRAC_PI_2), self.least());
        let mut best = at(angle, fall, share);
        for next in (1..=PLACES).map(place) {
            let next_fall = self.fall(next);
            share += 0.5 * (fall + next_fall) * (angle - next);
            (angle, fall) = (next, next_fall);
            let here = at(angle, fall, share);
            best = if here.slope > best.slope { here } else { best };
        }
        best
    }

    /// The angle around which it bends most, and over which width.
    fn bend(self) -> (f64, f64) {
        match self {
            Self::Lambert => (0.0, 1.0),
            Self::BlinnPhong { exponent } => (0.0, 0.1 / exponent.max(1.0).sqrt()),
            Self::Ggx { roughness, light_degrees } => (radius(light_degrees), 0.1 * alpha(roughness)),
        }
    }

    /// The share at a right angle, or less.
    fn least(self) -> f64 {
        match self {
            Self::Lambert | Self::BlinnPhong { .. } => 0.0,
            Self::Ggx { roughness, .. } => alpha(roughness).powi(4),
        }
    }

    /// What it falls by, per radian: the derivative of the share, downwards.
    fn fall(self, angle: f64) -> f64 {
        match self {
            Self::Lambert => angle.sin(),
            Self::BlinnPhong { exponent } => {
                let exponent = exponent.max(1.0);
                exponent * angle.cos().powf(exponent - 1.0) * angle.sin()
            }
            Self::Ggx { roughness, light_degrees } => {
                let k = alpha(roughness).powi(-2) - 1.0;
                match radius(light_degrees) {
                    0.0 => 4.0 * k * angle.sin() * angle.cos() * (1.0 + k * angle.sin().powi(2)).powi(-3),
                    radius => blurred_fall(angle, k, radius),
                }
            }
        }
    }
}

fn alpha(roughness: f64) -> f64 {
    roughness.clamp(0.01, 1.0).powi(2)
}

/// The radius in radians of the disc of half vectors that belong to a light.
fn radius(light_degrees: f64) -> f64 {
    (0.25 * light_degrees.clamp(0.0, 180.0)).to_radians()
}

/// The fall of GGX's mean over a disc of the sphere, as a share of the mean at the peak.
///
/// A disc of radius R that moves gains and loses at its rim: the integral over it changes by `sin R` times that of `f cos p` around
/// the rim, where p is the place on it, from the direction of the peak. At the peak the integral over the disc is at least
/// that of `f cos t`, which is `pi u / (1 + k u)` with `u = sin^2 R`. Places on the rim are denser by the peak.
fn blurred_fall(angle: f64, k: f64, radius: f64) -> f64 {
    const PLACES: u32 = 256;
    let u = radius.sin().powi(2);
    let share = |cosine: f64| (1.0 + k * (1.0 - cosine * cosine)).powi(-2);
    // What the whole rim has in common cancels.
    let common = share((angle + radius).cos());
    let width = (1.0 / (k.sqrt() * radius)).min(1.0);
    let step = (PI / width).asinh() / f64::from(PLACES);
    let part = |n: u32| {
        let t = (f64::from(n) + 0.5) * step;
        let p = width * t.sinh();
        let cosine = angle.cos() * radius.cos() + angle.sin() * radius.sin() * p.cos();
        (share(cosine) - common) * p.cos() * width * t.cosh() * step
    };
    let rim = 2.0 * (0..PLACES).map(part).sum::<f64>();
    rim * radius.sin() * (1.0 + k * u) / (PI * u)
}

/// The largest error in degrees for which a flat mirror shows everything less than half a pixel from its place, to a camera with so
/// many pixels from top to bottom and a field of view of `fov_degrees` over them.
///
/// A reflected ray `v - 2 (v . n) n` turns by at most twice what the normal turns by. A pixel is `2 tan(fov / 2) / pixels` wide on the
/// plane in front of the eye, and at the picture's upper and lower edge takes `cos^2(fov / 2)` of that as an angle, which makes
/// `sin(fov) / pixels`.
pub fn mirror_error_deg(pixels: u32, fov_degrees: f64) -> f64 {
    (pixel_angle(pixels, fov_degrees) / 4.0).to_degrees()
}

/// The angle of a pixel at the middle of the picture's upper edge, in radians.
pub fn pixel_angle(pixels: u32, fov_degrees: f64) -> f64 {
    fov_degrees.to_radians().sin() / f64::from(pixels.max(1))
}

/// The bits that number as many normals as discs of this radius cover the sphere with, if they could pack it perfectly: `4 / e^2`
/// of e in radians (Meyer et al. 2010, eq. 1 and 4). Their e of 2^-d gives 2 (d + 1) bits; that of floats, by their eq. 3, 51.
pub fn least_bits(error_deg: f64) -> f64 {
    2.0 - 2.0 * error_deg.to_radians().log2()
}

#[cfg(test)]
mod tests {
    use super::*;

    const EIGHT: Colour = Colour { bits: 8, is_linear: true };
    const SRGB: Colour = Colour { bits: 8, is_linear: false };

    fn ggx(roughness: f64, light_degrees: f64) -> Lobe {
        Lobe::Ggx { roughness, light_degrees }
    }

    fn assert_near(a: f64, b: f64, tolerance: f64) {
        assert!((a / b - 1.0).abs() < tolerance, "{a} {b}");
    }

    /// Eq. 1: 2^(2 (d + 1)) normals for a whole step of 2^-d, 2^18 for 8 bits. Eq. 4: 51 bits for floats, by the error of eq. 3.
    #[test]
    fn meyers_numbers_come_out() {
        for d in [8, 10, 12] {
            let bits = least_bits((-f64::from(d)).exp2().to_degrees());
            assert!((bits - f64::from(2 * (d + 1))).abs() < 1e-12, "{d}");
        }
        let floats = (2f64.sqrt() / 3.0 * 2f64.powi(-23)).to_degrees();
        assert_eq!(least_bits(floats).ceil(), 51.0);
    }

    /// Half a step of 255, by the slope of 1, and by 12.92 in the dark end of sRGB.
    #[test]
    fn lambert_is_in_closed_form() {
        assert_near(Lobe::Lambert.max_error_deg(1.0, EIGHT), (0.5f64 / 255.0).to_degrees(), 1e-9);
        assert_near(Lobe::Lambert.max_error_deg(1.0, SRGB), (0.5f64 / 255.0 / 12.92).to_degrees(), 1e-9);
    }

    /// The steepest slopes of highlights of a point light, from their derivatives' zeros. On the curve of sRGB above its line, a
    /// power is a power again: of s / 2.4, and of 2 / 2.4.
    #[test]
    fn slopes_of_highlights_are_in_closed_form() {
        let steepest_power = |s: f64| s.sqrt() * ((s - 1.0) / s).powf(0.5 * (s - 1.0));
        let steepest_ggx = |roughness: f64, power: f64| {
            let k = roughness.powi(-4) - 1.0;
            // The zero of the logarithm's derivative, 1 / u - 1 / (1 - u) = 2 (power + 1) k / (1 + k u).
            let b = (2.0 * power + 1.0) * k + 2.0;
            let u = (b - (b * b - 8.0 * power * k).sqrt()) / (4.0 * power * k);
            2.0 * power * k * (u * (1.0 - u)).sqrt() * (1.0 + k * u).powf(-power - 1.0)
        };
        for s in [2.0, 20.0, 1000.0] {
            let lobe = Lobe::BlinnPhong { exponent: s };
            assert_near(lobe.steepest(1.0, EIGHT).slope, steepest_power(s), 1e-5);
            assert_near(lobe.steepest(1.0, EIGHT).angle.tan().powi(2), 1.0 / (s - 1.0), 0.03);
        }
        assert_near(
            Lobe::BlinnPhong { exponent: 1000.0 }.steepest(1.0, SRGB).slope,
            1.055 * steepest_power(1000.0 / 2.4),
            1e-4,
        );
        for roughness in [0.02, 0.1, 0.4, 0.8] {
            assert_near(ggx(roughness, 0.0).steepest(1.0, EIGHT).slope, steepest_ggx(roughness, 2.0), 1e-5);
        }
        assert_near(ggx(0.1, 0.0).steepest(1.0, SRGB).slope, 1.055 * steepest_ggx(0.1, 2.0 / 2.4), 1e-3);
        assert_eq!(ggx(1.0, 0.0).max_error_deg(1.0, EIGHT), f64::INFINITY);
    }

    /// The mean over the light's disc, summed over rings and places on them, and its slope by differences.
    #[test]
    fn wide_lights_blur_as_the_mean_over_their_disc() {
        for (roughness, light_degrees) in [(0.1, 0.5), (0.1, 5.0), (0.3, 20.0), (0.05, 2.0)] {
            let (k, disc) = (f64::powi(roughness, -4) - 1.0, f64::to_radians(0.25 * light_degrees));
            let mean = |angle: f64| {
                let (mut sum, mut area) = (0.0, 0.0);
                for (ring, place) in (0..400).flat_map(|ring| (0..400).map(move |place| (ring, place))) {
                    let (r, p) =
                        (disc * (f64::from(ring) + 0.5) / 400.0, PI * (f64::from(place) + 0.5) / 400.0);
                    let cosine = angle.cos() * r.cos() + angle.sin() * r.sin() * p.cos();
                    sum += r.sin() * (1.0 + k * (1.0 - cosine * cosine)).powi(-2);
                    area += r.sin();
                }
                sum / area
            };
            let lobe = ggx(roughness, light_degrees);
            let Steepest { slope, angle } = lobe.steepest(1.0, EIGHT);
            let (near, far) = (angle - 1e-5, angle + 1e-5);
            assert_near(slope, (mean(near) - mean(far)) / 2e-5 / mean(0.0), 5e-3);
            // What the search sums up to at the peak.
            let summed =
                (0..20_000).map(|n| lobe.fall((f64::from(n) + 0.5) * FRAC_PI_2 / 20_000.0)).sum::<f64>();
            assert_near(summed * FRAC_PI_2 / 20_000.0 + lobe.least(), 1.0, 5e-3);
        }
    }

    /// Finer colours, peaks that are brighter, up to white, and smoother surfaces allow less; wider lights more.
    #[test]
    fn demands_are_monotonous() {
        let falls = |errors: &[f64]| errors.windows(2).all(|pair| pair[1] < pair[0]);
        for is_linear in [true, false] {
            let colour = |bits| Colour { bits, is_linear };
            let at = |roughness, light, peak, bits| ggx(roughness, light).max_error_deg(peak, colour(bits));
            assert!(falls(&[1, 6, 8, 10, 16].map(|bits| at(0.2, 0.5, 1.0, bits))));
            assert!(falls(&[0.25, 0.5, 1.0].map(|peak| at(0.2, 0.5, peak, 8))));
            assert!(falls(&[0.9, 0.5, 0.2, 0.1, 0.01].map(|roughness| at(roughness, 0.5, 1.0, 8))));
            assert!(falls(&[90.0, 10.0, 5.0, 1.0, 0.01].map(|light| at(0.1, light, 1.0, 8))));
            assert_near(at(0.1, 1e-4, 1.0, 8), at(0.1, 0.0, 1.0, 8), 1e-3);
        }
        assert!(falls(&[480, 1080, 2160].map(|pixels| mirror_error_deg(pixels, 60.0))));
    }

    /// A ray is turned by twice the normal's turn; the angle between the rays of the outermost half pixels is that of half a pixel.
    #[test]
    fn mirrors_move_by_half_a_pixel() {
        let ray = |y: f64| (30f64.to_radians().tan() * y).atan();
        let half = ray(1.0) - ray(1.0 - 1.0 / 1080.0);
        assert_near(2.0 * mirror_error_deg(1080, 60.0).to_radians(), half, 1e-3);
    }
}
