//! Differences between a picture and the one that it should be.

use super::flip::{Seen, flip};
use image::RgbImage;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The difference of two pictures of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// Mean over pixels and channels, in steps of 1/255.
    pub mean: f64,
    /// The largest, in the same steps.
    pub max: u8,
    /// Structural similarity of the brightness (Wang et al. 2004): 1 for equal pictures.
    pub ssim: f64,
    /// What an eye sees of it when it flips between the two, at 67 pixels a degree (Andersson et al. 2020): 0 for equal pictures,
    /// 1 at most.
    pub flip: f64,
}

/// A picture that others are compared with, and what all comparisons need of it.
pub struct Original<'p> {
    picture: &'p RgbImage,
    seen: Seen,
}

impl<'p> Original<'p> {
    /// The picture as an original.
    pub fn new(picture: &'p RgbImage) -> Self {
        Self { picture, seen: Seen::new(picture) }
    }

    /// The difference of a picture of the same size.
    pub fn difference(&self, other: &RgbImage) -> Difference {
        let steps = self.picture.as_raw().par_iter().zip(other.as_raw()).map(|(a, b)| a.abs_diff(*b));
        let (sum, max) = steps
            .fold(|| (0u64, 0), |(sum, max), step| (sum + u64::from(step), max.max(step)))
            .reduce(|| (0, 0), |(sum, max), (other, other_max): (u64, u8)| (sum + other, max.max(other_max)));
        Difference {
            mean: sum as f64 / other.as_raw().len().max(1) as f64,
            max,
            ssim: ssim(self.picture, other),
            flip: flip(&self.seen, &Seen::new(other)),
        }
    }
}

impl Difference {
    /// Formats the difference in one line.
    pub fn in_words(&self) -> String {
        format!("mean {:.2} max {} SSIM {:.3} FLIP {:.3}", self.mean, self.max, self.ssim, self.flip)
    }

    /// The numbers as tables have them: the mean, the largest, SSIM and FLIP.
    pub fn cells(&self) -> [String; 4] {
        let Self { mean, max, ssim, flip } = self;
        [format!("{mean:.3}"), max.to_string(), format!("{ssim:.4}"), format!("{flip:.4}")]
    }
}

/// The mean difference over some pixels, in steps of 1/255.
pub fn mean_where(pixels: &[bool], a: &RgbImage, b: &RgbImage) -> f64 {
    let chosen = a.pixels().zip(b.pixels()).zip(pixels).filter(|(_, chosen)| **chosen);
    let steps =
        chosen.flat_map(|((a, b), _)| a.0.into_iter().zip(b.0)).map(|(a, b)| f64::from(a.abs_diff(b)));
    mean(steps)
}

/// The mean of some numbers; 0 of none.
pub fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0.0f64), |(sum, count), number| (sum + number, count + 1.0));
    sum / count.max(1.0)
}

/// NaN for pictures that have no window to compare.
fn ssim(a: &RgbImage, b: &RgbImage) -> f64 {
    let [a, b] = [a, b].map(image::imageops::grayscale);
    let compared = image_compare::gray_similarity_structure(&image_compare::Algorithm::MSSIMSimple, &a, &b);
    compared.map_or(f64::NAN, |similarity| similarity.score)
}

/// The difference so many times over, as the survey shows it: black where nothing differs.
pub fn amplified(a: &RgbImage, b: &RgbImage, times: u8) -> RgbImage {
    let mut result = a.clone();
    for (to, from) in result.iter_mut().zip(b.iter()) {
        *to = to.abs_diff(*from).saturating_mul(times);
    }
    result
}

/// Spearman's rank correlation; equal values share the mean of their ranks. NaN where a side has only one value.
pub fn rank_correlation(pairs: &[(f64, f64)]) -> f64 {
    let first = ranks(pairs.iter().map(|pair| pair.0).collect());
    let second = ranks(pairs.iter().map(|pair| pair.1).collect());
    let middle = (pairs.len() as f64 - 1.0) / 2.0;
    let product =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum() };
    product(&first, &second) / (product(&first, &first) * product(&second, &second)).sqrt()
}

fn ranks(values: Vec<f64>) -> Vec<f64> {
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        below as f64 + (equal as f64 - 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}

/// The window of this size in which two pictures differ most: left, top, width, height; on a grid of an eighth of it.
pub fn most_different(a: &RgbImage, b: &RgbImage, [width, height]: [u32; 2]) -> [u32; 4] {
    let [width, height] = [width.min(a.width()).max(1), height.min(a.height()).max(1)];
    let sum = |left: u32, top: u32| -> u64 {
        let row = |y: u32| {
            let from = 3 * (y * a.width() + left) as usize;
            from..from + 3 * width as usize
        };
        let rows = (top..top + height).map(row);
        rows.flat_map(|row| a.as_raw()[row.clone()].iter().zip(&b.as_raw()[row]))
            .map(|(a, b)| u64::from(a.abs_diff(*b)))
            .sum()
    };
    let steps = |whole: u32, part: u32| (0..=whole - part).step_by((part / 8).max(1) as usize);
    let corners =
        steps(a.height(), height).flat_map(|top| steps(a.width(), width).map(move |left| (left, top)));
    let corners: Vec<(u32, u32)> = corners.collect();
    let best =
        corners.into_par_iter().max_by_key(|(left, top)| (sum(*left, *top), u32::MAX - top, u32::MAX - left));
    let (left, top) = best.unwrap_or_default();
    [left, top, width, height]
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn differences_are_counted() {
        let a = RgbImage::from_pixel(16, 16, Rgb([10, 20, 30]));
        let mut b = a.clone();
        assert_eq!(Original::new(&a).difference(&b), Difference { mean: 0.0, max: 0, ssim: 1.0, flip: 0.0 });
        b.put_pixel(12, 14, Rgb([10, 26, 0]));
        let difference = Original::new(&a).difference(&b);
        assert_eq!((difference.mean, difference.max), (36.0 / 768.0, 30));
        assert!(difference.ssim < 1.0 && difference.flip > 0.0);
        assert_eq!(amplified(&a, &b, 8).get_pixel(12, 14), &Rgb([0, 48, 240]));
        let mut pixels = [false; 256];
        pixels[14 * 16 + 12] = true;
        pixels[0] = true;
        assert_eq!(mean_where(&pixels, &a, &b), 6.0);
        let [left, top, ..] = most_different(&a, &b, [8, 8]);
        assert!((5..=8).contains(&left) && (7..=8).contains(&top));
    }

    /// The example of textbooks: 1 - 6 * sum of d^2 / (n (n^2 - 1)) without ties, here with d^2 = 4 x 1 of five.
    #[test]
    fn ranks_are_correlated() {
        let pairs = [(1.0, 20.0), (2.0, 10.0), (3.0, 40.0), (4.0, 30.0), (5.0, 50.0)];
        assert!((rank_correlation(&pairs) - (1.0 - 6.0 * 4.0 / 120.0)).abs() < 1e-12);
        let falling: Vec<(f64, f64)> = (0..9).map(|n| (f64::from(n), f64::from(-n))).collect();
        assert!((rank_correlation(&falling) + 1.0).abs() < 1e-12);
        assert!(rank_correlation(&[(1.0, 1.0), (1.0, 2.0)]).is_nan());
    }
}
