//! Fields of normals: mips against closed forms, and what a map tells of itself.

use unitvec::angle_deg;
use unitvec_texture::NormalMap;
use unitvec_texture::mips::chain;
use unitvec_texture::space::{count_below, is_object_space, upward};

fn map(width: u32, height: u32, vector: impl Fn(f64, f64) -> [f64; 3]) -> NormalMap {
    let at = |at: u32| vector(f64::from(at % width), f64::from(at / width));
    let unit = |v: [f64; 3]| v.map(|c| (c / v.iter().map(|c| c * c).sum::<f64>().sqrt()) as f32);
    NormalMap { width, height, vectors: (0..width * height).map(|i| unit(at(i))).collect(), alpha: None }
}

/// The normals of `sin(0.3 x + 0.2 Y) + cos(0.2 x - 0.35 Y)`, where Y points up: against the rows, which are counted down.
fn waves(sign: f64) -> NormalMap {
    map(40, 30, |x, row| {
        let (a, b) = (0.3 * x - 0.2 * row, 0.2 * x + 0.35 * row);
        let [by_x, by_y] = [0.3 * a.cos() - 0.2 * b.sin(), 0.2 * a.cos() + 0.35 * b.sin()];
        [-by_x, -by_y * sign, 1.0]
    })
}

#[test]
fn y_is_guessed_both_ways() {
    let [up, down] = [1.0, -1.0].map(|sign| upward(&waves(sign)));
    assert!(up > 0.95 && down < -0.95, "{up} {down}");
    let mut turned = waves(1.0);
    turned.flip_y();
    assert_eq!(turned, waves(-1.0));
    // One direction tells nothing, nor do waves along one axis, nor unrelated slopes.
    assert_eq!(upward(&map(9, 9, |_, _| [0.1, 0.2, 1.0])), 0.0);
    assert_eq!(upward(&map(9, 9, |x, _| [x.sin(), 0.0, 1.0])), 0.0);
    let noise = map(64, 64, |x, y| [(x * 12.99 + y * 78.23).sin(), (x * 39.35 + y * 11.14).sin(), 2.0]);
    assert!(upward(&noise).abs() < 0.1, "{}", upward(&noise));
    assert_eq!(upward(&map(1, 1, |_, _| [0.0, 0.0, 1.0])), 0.0);
}

#[test]
fn a_few_texels_below_are_no_object_space() {
    let lower =
        |most: f64| map(100, 50, move |x, y| [1.0, 0.0, if 100.0 * y + x < most { -0.5 } else { -0.003 }]);
    assert_eq!([5.0, 6.0].map(|most| is_object_space(&lower(most))), [false, true]);
    assert_eq!(count_below(&lower(6.0)), 6);
}

#[test]
fn mips_of_a_constant_are_constant() {
    let levels = chain(&map(5, 12, |_, _| [0.36, 0.48, 0.8]));
    let sizes: Vec<_> = levels.iter().map(|level| [level.map.width, level.map.height]).collect();
    assert_eq!(sizes, [[5, 12], [2, 6], [1, 3], [1, 1]]);
    for level in &levels {
        assert!(level.map.vectors.iter().all(|v| angle_deg(*v, [0.36, 0.48, 0.8]) < 1e-4));
        // A length that is off by a part in 10^7 gives a roughness of its fourth root.
        assert!(level.roughness().iter().all(|roughness| *roughness < 0.03));
    }
}

#[test]
fn opposites_cancel_out() {
    let levels = chain(&map(2, 1, |x, _| [1.0 - 2.0 * x, 0.0, 0.0]));
    assert_eq!((levels[1].map.vectors[0], levels[1].lengths[0]), ([0.0, 0.0, 1.0], 0.0));
    assert_eq!(levels[1].roughness(), [1.0]);
}

/// The mean of two normals that are `t` off an axis has the length `r = cos t`; Toksvig's variance is `(1 - r) / r`.
#[test]
fn lost_length_is_roughness() {
    for t in [0.1f64, 0.3, 0.5] {
        let levels = chain(&map(2, 2, |x, _| [(1.0 - 2.0 * x) * t.sin(), 0.0, t.cos()]));
        let alpha = (2.0 * (1.0 - t.cos()) / t.cos()).sqrt();
        assert!((f64::from(levels[1].roughness()[0]).powi(2) - alpha).abs() < 1e-5, "{t}");
    }
}

/// Each texel of an odd size counts as much as every other: the last level is the mean of all.
#[test]
fn odd_sizes_keep_the_mean() {
    for (width, height) in [(5, 3), (7, 1), (11, 13)] {
        let map = map(width, height, |x, y| [(x * 1.7).sin(), (y * 2.3 + x).cos(), 1.0]);
        let sum = |c: usize| map.vectors.iter().map(|v| f64::from(v[c])).sum::<f64>();
        let mean = [sum(0), sum(1), sum(2)].map(|c| c / f64::from(width * height));
        let last = chain(&map).pop().unwrap();
        let length = mean.iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!(angle_deg(last.map.vectors[0], mean.map(|c| c as f32)) < 1e-4, "{width} x {height}");
        assert!((f64::from(last.lengths[0]) - length).abs() < 1e-6);
    }
}
