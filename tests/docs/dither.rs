//! Effects of dither on errors, as docs/dither.md has them.

use super::tables::degrees;
use super::{costs, markdown_table};
use crate::isa::dithered;
use std::collections::BTreeMap;
use unitvec::dither::*;
use unitvec::glam::{UVec2, Vec2, Vec3};
use unitvec::*;
use unitvec_catalogue::{Operation, find};
use unitvec_choose::costs::Source as Compiled;
use unitvec_oracle::{angle_deg, normalize};
use unitvec_tests::directions::{Rng, sphere};
use unitvec_tests::repository;
use unitvec_tests::tested::widen;

/// Sources of offsets: none, a random number, and the keys.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Source {
    Plain,
    Uniform,
    Pixel,
    BlueNoise,
    Position,
}

const SOURCES: [(Source, &str); 5] = [
    (Source::Plain, "plain"),
    (Source::Uniform, "uniform"),
    (Source::Pixel, "pixel"),
    (Source::BlueNoise, "blue noise"),
    (Source::Position, "position"),
];

impl Source {
    /// The offset of a pixel that shows a position.
    fn offset(self, pixel: UVec2, position: Vec3, rng: &mut Rng) -> Vec2 {
        match self {
            Self::Plain => Vec2::ZERO,
            Self::Uniform => Vec2::new(rng.range(-0.5, 0.5) as f32, rng.range(-0.5, 0.5) as f32),
            Self::Pixel => dither_from_pixel(pixel),
            Self::BlueNoise => {
                let texel = 2 * (pixel.y % 64 * 64 + pixel.x % 64) as usize;
                let tile = unitvec_shaders::blue_noise();
                dither_from_texel(Vec2::new(f32::from(tile[texel]), f32::from(tile[texel + 1])) / 255.0)
            }
            Self::Position => dither_from_position(position),
        }
    }
}

/// Codes a vector and back, plain or dithered.
type Trip = fn(Vec3, Option<Vec2>) -> Vec3;

fn trip<C: Dithered>(v: Vec3, offset: Option<Vec2>) -> Vec3 {
    match offset {
        Some(offset) => C::decode_dithered(C::encode_dithered(v, offset), offset),
        None => C::decode_vec3(C::encode_vec3(v)),
    }
}

const CODECS: [(&str, Trip); 10] = [
    ("oct16", trip::<Oct16>),
    ("oct16p", trip::<OctPrecise16>),
    ("oct24", trip::<Oct24>),
    ("oct24p", trip::<OctPrecise24>),
    ("oct32", trip::<Oct32>),
    ("oct32p", trip::<OctPrecise32>),
    ("hemioct16", trip::<HemiOct16>),
    ("soct17", trip::<SOct17>),
    ("eaoct16", trip::<EaOct16>),
    ("eaoct16p", trip::<EaOctPrecise16>),
];

/// The effect of a source of offsets on a codec.
#[derive(Clone, Copy, Debug)]
struct Noise {
    mean: f64,
    max: f64,
    autocorrelation: f64,
}

/// The mean and the largest error of random directions, pixel by pixel, in degrees.
fn errors(id: &str, trip: Trip, source: Source, count: usize) -> (f64, f64) {
    let (mut rng, mut sum, mut max) = (Rng::new(61), 0.0, 0f64);
    for (n, v) in sphere(62, count).enumerate() {
        let v = if id.starts_with("hemi") { Vec3::new(v.x, v.y, v.z.abs()) } else { v };
        let pixel = UVec2::new(n as u32 % 1024, n as u32 / 1024);
        let offset = (source != Source::Plain).then(|| source.offset(pixel, v, &mut rng));
        let off = angle_deg(widen(trip(v, offset)), normalize(widen(v)));
        (sum, max) = (sum + off, max.max(off));
    }
    (sum / count as f64, max)
}

/// Pixels across the patch over which errors are correlated, and the lattice steps, roughly, that its normals turn by.
const PATCH: u32 = 512;
const STEPS: f64 = 5.0;

/// The likeness of neighbouring pixels' errors, from 1 (the same) to -1, on a panel that is curved a little: the
/// correlation of the error's vectors from pixel to pixel, along rows and columns.
fn autocorrelation(trip: Trip, mean_deg: f64, source: Source) -> f64 {
    let mut rng = Rng::new(63);
    let extent = STEPS * 2.6 * mean_deg.to_radians();
    let error = |x: u32, y: u32, rng: &mut Rng| {
        let [s, t] = [x, y].map(|i| (f64::from(i) / f64::from(PATCH) - 0.5) * extent);
        let exact = normalize([0.31 + s, 0.52 + t, 0.8 + 0.3 * s - 0.2 * t]);
        let v = Vec3::from_array(exact.map(|c| c as f32));
        let position = Vec3::new(x as f32 / 64.0, y as f32 / 64.0, (s * t) as f32);
        let offset = (source != Source::Plain).then(|| source.offset(UVec2::new(x, y), position, rng));
        let back = widen(trip(v, offset));
        [0, 1, 2].map(|i| back[i] - exact[i])
    };
    let pixels: Vec<[f64; 3]> = (0..PATCH * PATCH).map(|n| error(n % PATCH, n / PATCH, &mut rng)).collect();
    let count = pixels.len() as f64;
    let mean = [0, 1, 2].map(|i| pixels.iter().map(|e| e[i]).sum::<f64>() / count);
    let product = |a: usize, b: usize| -> f64 {
        (0..3).map(|i| (pixels[a][i] - mean[i]) * (pixels[b][i] - mean[i])).sum()
    };
    let (side, mut along, mut pairs) = (PATCH as usize, 0.0, 0.0);
    for n in 0..pixels.len() {
        for (next, inside) in [(n + 1, n % side + 1 < side), (n + side, n / side + 1 < side)] {
            if inside {
                (along, pairs) = (along + product(n, next), pairs + 1.0);
            }
        }
    }
    let variance = (0..pixels.len()).map(|n| product(n, n)).sum::<f64>() / count;
    along / pairs / variance
}

fn measured(id: &str, trip: Trip, source: Source, count: usize) -> Noise {
    let (mean, max) = errors(id, trip, source, count);
    let plain = if source == Source::Plain { mean } else { errors(id, trip, Source::Plain, 4096).0 };
    Noise { mean, max, autocorrelation: autocorrelation(trip, plain, source) }
}

/// Measures what the docs state.
#[test]
#[ignore = "`cargo xtask renew errors` runs it: a minute or two"]
fn measure() {
    let mut text = String::from("codec,offsets,mean_deg,max_deg,autocorrelation\n");
    for (id, trip) in CODECS {
        for (source, name) in SOURCES {
            let Noise { mean, max, autocorrelation } = measured(id, trip, source, 1 << 22);
            text += &format!("{id},{name},{mean:.6e},{max:.6e},{autocorrelation:.4}\n");
        }
    }
    unitvec_files::write_file(&repository().join("docs/data/dither.csv"), text.as_bytes()).unwrap();
}

/// The committed measurements, by codec and source.
fn recorded() -> BTreeMap<(String, String), Noise> {
    let rows = super::recorded::<(String, String, f64, f64, f64)>("dither.csv").into_iter();
    rows.map(|(id, name, mean, max, autocorrelation)| ((id, name), Noise { mean, max, autocorrelation }))
        .collect()
}

/// The table of docs/dither.md.
pub fn table() -> String {
    let recorded = recorded();
    let pairs = CODECS.iter().flat_map(|(id, _)| SOURCES.map(|(_, name)| (id, name)));
    let rows = pairs.map(|(id, name)| {
        let Noise { mean, max, autocorrelation } = recorded[&((*id).to_owned(), name.to_owned())];
        format!("`{id}` | {name} | {} | {} | {autocorrelation:.3}", degrees(mean), degrees(max))
    });
    markdown_table("codec | offsets | mean error | maximum | from pixel to pixel", rows)
}

/// Vector instructions of a dithered function on RDNA 2, for one vector.
fn cost(id: &str, key: &str, operation: Operation) -> Option<f64> {
    dithered::committed().row(&dithered::row_id(id, key), operation, Compiled::Glsl)?.vector_instructions
}

/// The cost of dither: vector instructions without and with it, for a vector, and the difference between them.
pub fn cost_table() -> String {
    let rows = dithered::CODECS.map(|id| {
        let cells = Operation::ALL.map(|operation| {
            let plain = costs::vector_instructions(id, operation);
            let dithered = cost(id, dithered::GIVEN, operation);
            let more = plain.zip(dithered).map(|(plain, dithered)| dithered - plain);
            [plain, dithered, more].map(|number| costs::number(number, 1)).join(" | ")
        });
        format!("`{id}` | {}", cells.join(" | "))
    });
    markdown_table("codec | encode: plain | dithered | more | decode: plain | dithered | more", rows)
}

/// The cost of the keys: vector instructions more than with an offset that is at hand.
pub fn key_table() -> String {
    let rows = dithered::KEYS.map(|key| {
        let cells = Operation::ALL.map(|operation| {
            let of = |key| cost(dithered::KEYED, key, operation);
            let more = of(key).zip(of(dithered::GIVEN)).map(|(with, without)| with - without);
            costs::number(more, 1)
        });
        format!("`dither_from_{key}` | {}", cells.join(" | "))
    });
    markdown_table("offset | encode | decode", rows)
}

/// The greatest error of `eaoct` over its plain maximum. Ring 1 has a point every quarter turn. Moved outwards by half a ring it stands for
/// directions up to half a ring farther out and an eighth turn aside: `sqrt(2^2 + 1.5^2 - 2 2 1.5 cos 45) = 1.416` rings, of
/// `sqrt(2) / m` radians each, where the plain bound is `1.5026 / m`, and the sample's maximum 1.3 % below it.
const EAOCT: f64 = 1.36;

/// Dither costs no error: the means are within a fifth of a percent. Plain errors go on from pixel to pixel; dithered ones do not
/// go on, or with blue noise rather change sides.
#[test]
fn dither_takes_the_bands_and_adds_no_error() {
    let recorded = recorded();
    for (id, _) in CODECS {
        let of = |name: &str| recorded[&(id.to_owned(), name.to_owned())];
        let plain = of("plain");
        assert!(plain.autocorrelation > 0.95, "{id}: {plain:?}");
        for (source, name) in SOURCES.into_iter().skip(1) {
            let noise = of(name);
            assert!(
                (noise.mean / plain.mean - 1.0).abs() < 0.002,
                "{id}, {name}: {noise:?}, plain {plain:?}"
            );
            let growth = if id.starts_with("eaoct") { EAOCT } else { 1.02 };
            assert!(noise.max < growth * plain.max, "{id}, {name}: {noise:?}, plain {plain:?}");
            let is_uncorrelated = noise.autocorrelation.abs() < 0.02;
            assert!(
                is_uncorrelated || (source == Source::BlueNoise && noise.autocorrelation < -0.05),
                "{id}, {name}: {noise:?}"
            );
        }
    }
}

/// A smaller sample agrees with the committed measurements.
#[test]
fn dither_is_as_recorded() {
    let recorded = recorded();
    for (id, trip) in CODECS.into_iter().filter(|(id, _)| ["oct16", "eaoct16p"].contains(id)) {
        for (source, name) in SOURCES {
            let (committed, fresh) =
                (recorded[&(id.to_owned(), name.to_owned())], measured(id, trip, source, 1 << 15));
            let agrees = (fresh.mean / committed.mean - 1.0).abs() < 0.015
                && fresh.max <= 1.01 * committed.max
                && (fresh.autocorrelation - committed.autocorrelation).abs() < 0.01;
            assert!(agrees, "{id}, {name}: {committed:?} committed, {fresh:?} measured");
        }
    }
}

/// docs/dither.md, "What other passes see": at 16 bits the normals of a flat wall pass a test of cosines for 0.999, and
/// occlusion changes by less than three steps of 255. Normals of a wall's pixels differ, by at most twice the greatest error.
#[test]
fn other_passes_see_what_the_docs_say() {
    let recorded = recorded();
    for ((id, name), noise) in &recorded {
        let turn = noise.max.to_radians();
        let is_short = find(id).unwrap().bits < 18;
        assert!(!is_short || ((2.0 * turn).cos() > 0.999 && 255.0 * 0.5 * turn < 3.0), "{id}, {name}");
    }
    let wall = Vec3::new(0.31, 0.52, 0.8).normalize();
    let seen = |n: u32| widen(trip::<Oct16>(wall, Some(dither_from_pixel(UVec2::new(n % 64, n / 64)))));
    let apart = (1..4096).map(|n| angle_deg(seen(n), seen(n - 1))).fold(0.0, f64::max);
    let max = recorded[&("oct16".to_owned(), "pixel".to_owned())].max;
    assert!(0.5 * max < apart && apart <= 2.0 * max, "{apart} apart, {max} off");
}
