//! The difference that an eye sees when it flips between two pictures: LDR-FLIP of Andersson et al. 2020 (*FLIP: A Difference
//! Evaluator for Alternating Images*), of which the equations and sections here are. Its mean goes from 0 to 1.
//!
//! Pictures are seen at 0.7 m on a display of 3840 pixels over 0.7 m, as the paper proposes.

use super::paint::from_srgb;
use glam::{DMat3, DVec3};
use image::RgbImage;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Pixels of a degree: eq. 1.
const PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * (PI / 180.0);

/// sRGB's primaries in XYZ, by columns of red, green and blue: IEC 61966-2-1, by its chromaticities.
const TO_XYZ: DMat3 = DMat3::from_cols_array(&[
    10_135_552.0 / 24_577_794.0,
    2_613_072.0 / 12_288_897.0,
    1_425_312.0 / 73_733_382.0,
    8_788_810.0 / 24_577_794.0,
    8_788_810.0 / 12_288_897.0,
    8_788_810.0 / 73_733_382.0,
    4_435_075.0 / 24_577_794.0,
    887_015.0 / 12_288_897.0,
    70_074_185.0 / 73_733_382.0,
]);

/// Sensitivities to contrast of the channels of luminance, red to green and blue to yellow: sums of the Gaussians
/// `a sqrt(pi / b) exp(-pi^2 d^2 / b)` of the distance d in degrees (eq. 4 and table 1), of which the narrow ones of factor 0
/// are left out.
const SENSITIVITIES: [&[(f64, f64)]; 3] =
    [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];

/// The width of edges and points that are seen, in degrees: section 4.2.1.
const FEATURE: f64 = 0.082;

/// The exponents of colours and features, and the knee of colours: sections 4.1.3 and 4.2.
const COLOUR: f64 = 0.7;
const PART: f64 = 0.4;
const SHARE: f64 = 0.95;
const EDGES: f64 = 0.5;

/// The mean difference of two pictures of the same size.
pub fn flip(a: &Seen, b: &Seen) -> f64 {
    let most = hyab(hunt(lab(DVec3::Y)), hunt(lab(DVec3::Z))).powf(COLOUR);
    let pixels = a.colours.par_iter().zip(&b.colours).zip(a.features.par_iter().zip(&b.features));
    // Summed in one order, so that the same pictures have the same mean.
    let differences: Vec<f64> =
        pixels.map(|((a, b), (of_a, of_b))| difference([*a, *b], [*of_a, *of_b], most)).collect();
    differences.iter().sum::<f64>() / differences.len().max(1) as f64
}

/// The difference of a pixel, of which that of colours is `most` between green and blue: section 4.3.
fn difference([a, b]: [DVec3; 2], [of_a, of_b]: [[f64; 2]; 2], most: f64) -> f64 {
    let colour = hyab(a, b).powf(COLOUR);
    let knee = PART * most;
    let colour = match colour < knee {
        true => SHARE / knee * colour,
        false => SHARE + (colour - knee) / (most - knee) * (1.0 - SHARE),
    };
    let feature = (of_a[0] - of_b[0]).abs().max((of_a[1] - of_b[1]).abs());
    colour.powf(1.0 - (feature / 2f64.sqrt()).powf(EDGES))
}

/// A picture as an eye sees it.
pub struct Seen {
    /// L*a*b* of each pixel after the eye's blur, less colourful where it is dark.
    colours: Vec<DVec3>,
    /// The strengths of edges and of points.
    features: Vec<[f64; 2]>,
}

impl Seen {
    pub fn new(picture: &RgbImage) -> Self {
        let bytes = picture.as_raw().par_chunks_exact(3);
        let opponent: Vec<DVec3> =
            bytes.map(|rgb| opponents(of_white(from_srgb([rgb[0], rgb[1], rgb[2]])))).collect();
        let size = [picture.width(), picture.height()].map(|side| side as usize);
        let channel =
            |which: usize| Plane { size, values: opponent.iter().map(|colour| colour[which]).collect() };
        let blurred = [0, 1, 2].map(|which| channel(which).blurred(SENSITIVITIES[which]));
        let to_rgb = TO_XYZ.inverse();
        let colour = |i: usize| {
            let parts = of_opponents(blurred.each_ref().map(|plane| plane[i]).into());
            let rgb = to_rgb * (parts * (TO_XYZ * DVec3::ONE));
            hunt(lab(rgb.clamp(DVec3::ZERO, DVec3::ONE)))
        };
        let colours = (0..opponent.len()).into_par_iter().map(colour).collect();
        let grey = Plane { values: opponent.iter().map(|colour| (colour.x + 16.0) / 116.0).collect(), size };
        Self { colours, features: grey.features() }
    }
}

/// A channel of a picture, row by row.
struct Plane {
    size: [usize; 2],
    values: Vec<f64>,
}

impl Plane {
    /// The sum over the neighbours in a row, and in a column, with these weights, the picture's border going on outward.
    fn filtered(&self, along_x: &[f64], along_y: &[f64]) -> Vec<f64> {
        let [width, height] = self.size;
        let row = |row: &[f64]| -> Vec<f64> {
            (0..width).map(|x| near(along_x, x, width).map(|(weight, x)| weight * row[x]).sum()).collect()
        };
        let rows: Vec<f64> = self.values.par_chunks(width.max(1)).flat_map_iter(row).collect();
        let row = |y: usize| -> Vec<f64> {
            let sum = |x| near(along_y, y, height).map(|(weight, y)| weight * rows[y * width + x]).sum();
            (0..width).map(sum).collect()
        };
        (0..height).into_par_iter().flat_map_iter(row).collect()
    }

    /// The channel after the blur of a sensitivity: section 4.1.1.
    fn blurred(&self, gaussians: &[(f64, f64)]) -> Vec<f64> {
        // Three standard deviations of the widest.
        let reach = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil();
        let blurs = gaussians.iter().map(|(factor, width)| {
            let weights = weights(reach, |x| (-PI * PI * (x / PIXELS_PER_DEGREE).powi(2) / width).exp());
            let (sum, factor) = (weights.iter().sum::<f64>(), factor * (PI / width).sqrt());
            (factor, factor * sum * sum, self.filtered(&weights, &weights))
        });
        let blurs: Vec<_> = blurs.collect();
        let whole: f64 = blurs.iter().map(|blur| blur.1).sum();
        let value =
            |i: usize| blurs.iter().map(|(factor, _, values)| factor * values[i]).sum::<f64>() / whole;
        (0..self.values.len()).map(value).collect()
    }

    /// The strengths of edges and of points, by the first and the second derivative of a Gaussian: section 4.2.1.
    fn features(&self) -> Vec<[f64; 2]> {
        let deviation = 0.5 * FEATURE * PIXELS_PER_DEGREE;
        let gaussian = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
        let reach = (3.0 * deviation).ceil();
        let smooth = balanced(weights(reach, gaussian));
        let strengths = [
            balanced(weights(reach, |x| -x * gaussian(x))),
            balanced(weights(reach, |x| (x * x / (deviation * deviation) - 1.0) * gaussian(x))),
        ]
        .map(|across| (self.filtered(&across, &smooth), self.filtered(&smooth, &across)));
        (0..self.values.len()).map(|i| strengths.each_ref().map(|(x, y)| x[i].hypot(y[i]))).collect()
    }
}

/// The weights about a place, and the places that they are of, within 0 to `side`.
fn near(weights: &[f64], at: usize, side: usize) -> impl Iterator<Item = (f64, usize)> {
    let middle = weights.len() / 2;
    let place = move |(i, weight): (usize, &f64)| (*weight, (at + i).saturating_sub(middle).min(side - 1));
    weights.iter().enumerate().map(place)
}

/// Weights at whole distances from -reach to reach.
fn weights(reach: f64, weight: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * reach as i32).map(|i| weight(f64::from(i) - reach)).collect()
}

/// Weights whose positive ones add up to 1, and negative ones to -1.
fn balanced(weights: Vec<f64>) -> Vec<f64> {
    let sum = |sign: f64| weights.iter().map(|weight| (weight * sign).max(0.0)).sum::<f64>();
    let [positive, negative] = [1.0, -1.0].map(sum);
    weights.iter().map(|weight| weight / if *weight < 0.0 { negative } else { positive }).collect()
}

/// XYZ of a linear RGB colour, as parts of white's.
fn of_white(rgb: DVec3) -> DVec3 {
    TO_XYZ * rgb / (TO_XYZ * DVec3::ONE)
}

/// Lightness, red to green and blue to yellow, of XYZ as parts of white's, which gives YCxCz (section 4.1.1), or of their roots, which
/// gives L*a*b*.
fn opponents(DVec3 { x, y, z }: DVec3) -> DVec3 {
    DVec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// The reverse of [`opponents`].
fn of_opponents(opponents: DVec3) -> DVec3 {
    let y = (opponents.x + 16.0) / 116.0;
    DVec3::new(y + opponents.y / 500.0, y, y - opponents.z / 200.0)
}

/// L*a*b* of CIE 1976 of a linear RGB colour.
fn lab(rgb: DVec3) -> DVec3 {
    const KNEE: f64 = 6.0 / 29.0;
    let root = |t: f64| if t > KNEE.powi(3) { t.cbrt() } else { t / (3.0 * KNEE * KNEE) + 4.0 / 29.0 };
    opponents(of_white(rgb).map(root))
}

/// A colour that is less colourful where it is darker, as Hunt found: section 4.1.2.
fn hunt(lab: DVec3) -> DVec3 {
    DVec3::new(lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z)
}

/// The distance of two colours that are far apart: HyAB, of section 4.1.2.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    (a.x - b.x).abs() + (a.y - b.y).hypot(a.z - b.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    fn picture(colour: impl Fn(u32, u32) -> [u32; 3]) -> RgbImage {
        RgbImage::from_fn(64, 48, |x, y| Rgb(colour(x, y).map(|byte| byte as u8)))
    }

    /// The means that flip-evaluator 1.7, of the paper's authors, gives for these pictures.
    #[test]
    fn means_are_those_of_the_authors() {
        let edge = |at: u32| move |x: u32, _| if x < at { [200, 60, 30] } else { [20, 60, 200] };
        let ramp = picture(|x, _| [4 * x, 4 * x, 255 - 4 * x]);
        let noise = picture(|x, y| [(x * 37 + y * 101 + x * y * 13) % 256; 3]);
        for (a, b, mean) in [
            (picture(|_, _| [120, 130, 140]), picture(|_, _| [126, 130, 134]), 0.108_134_8),
            (picture(edge(32)), picture(edge(34)), 0.067_277_7),
            (ramp, noise, 0.831_544_7),
        ] {
            let [a, b] = [a, b].map(|picture| Seen::new(&picture));
            assert!((flip(&a, &b) - mean).abs() < 1e-4, "{} {mean}", flip(&a, &b));
            assert_eq!(flip(&a, &a), 0.0);
        }
        let empty = Seen::new(&RgbImage::new(0, 0));
        assert_eq!(flip(&empty, &empty), 0.0);
    }
}
