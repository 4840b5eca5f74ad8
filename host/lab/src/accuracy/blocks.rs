//! Errors of normal maps in compressed blocks, beside codecs of as many bits.

use glam::DVec2;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::TAU;
use unitvec_catalogue::{AnyCodec, find};
use unitvec_oracle::angle_deg;
use unitvec_run::measure::ErrorStats;
use unitvec_texture::Pair;
use unitvec_texture::block::{Compression, compress, compress_by_channel, decompress};

/// Texels along a side of the maps.
pub const SIDE: u32 = 512;

/// A map: the normals of a field of heights with random phases, by spectral synthesis.
pub struct Spectrum {
    /// Name.
    pub name: &'static str,
    /// The power of heights falls as this power of the wave number; the power of slopes with an exponent less by 2.
    pub exponent: f64,
    /// The angle of the steepest texel to +Z, degrees. The others' slopes are nearly normally distributed.
    pub steepest_deg: f64,
}

/// The maps. Profiles of rough surfaces, which a scan sees, have a power of heights that falls as the square or the cube of the
/// wave number; in two dimensions the exponent is greater by 1.
pub const MAPS: [Spectrum; 3] = [
    Spectrum { name: "smooth", exponent: 6.0, steepest_deg: 45.0 },
    Spectrum { name: "scanned", exponent: 4.0, steepest_deg: 60.0 },
    Spectrum { name: "noise", exponent: 2.0, steepest_deg: 60.0 },
];

impl Spectrum {
    /// The unit normals of the map, row by row, [`SIDE`] in a row. The map tiles.
    pub fn normals(&self, seed: u64) -> Vec<[f32; 3]> {
        let (side, mut random) = (SIDE as usize, Pcg64Mcg::seed_from_u64(seed));
        let wave_number = |at: usize| if at < side / 2 { at as f64 } else { at as f64 - side as f64 };
        let mut waves = vec![[DVec2::ZERO; 2]; side * side];
        for (at, slopes) in waves.iter_mut().enumerate().skip(1) {
            let k = DVec2::new(wave_number(at % side), wave_number(at / side));
            let height =
                k.length().powf(-0.5 * self.exponent) * DVec2::from_angle(random.random_range(0.0..TAU));
            // The derivative of a wave: i k times it.
            *slopes = [k.x * height.perp(), k.y * height.perp()];
        }
        let [x, y] =
            [0, 1].map(|axis| transform_map(waves.iter().map(|slopes| slopes[axis]).collect(), side));
        // The real parts are the slopes of the heights' real part.
        let slopes = || x.iter().zip(&y).map(|(x, y)| DVec2::new(x.x, y.x));
        let scale = self.steepest_deg.to_radians().tan() / slopes().map(DVec2::length).fold(0.0, f64::max);
        slopes().map(|slope| (-scale * slope).extend(1.0).normalize().as_vec3().to_array()).collect()
    }
}

/// The Fourier transform of a square of complex numbers: of its rows, then of its columns.
fn transform_map(mut map: Vec<DVec2>, side: usize) -> Vec<DVec2> {
    for _ in 0..2 {
        let rows: Vec<_> = map.par_chunks(side).map(transform).collect();
        map = (0..side * side).map(|at| rows[at % side][at / side]).collect();
    }
    map
}

/// The Fourier transform of complex numbers, as many as a power of two (Cooley and Tukey 1965).
fn transform(values: &[DVec2]) -> Vec<DVec2> {
    let length = values.len();
    if length == 1 {
        return values.to_vec();
    }
    let [even, odd] = [0, 1].map(|first| {
        let half: Vec<_> = values.iter().skip(first).step_by(2).copied().collect();
        transform(&half)
    });
    let at = |at: usize| {
        let turn = DVec2::from_angle(TAU * at as f64 / length as f64);
        even[at % (length / 2)] + turn.rotate(odd[at % (length / 2)])
    };
    (0..length).map(at).collect()
}

/// How a map is stored.
#[derive(Clone, Copy)]
pub enum Stored {
    /// In compressed blocks.
    Blocks(Pair, Compression),
    /// Texel by texel.
    Codes(&'static AnyCodec),
}

impl Stored {
    /// All that are measured: each pair in each format of blocks, and codecs of 8 and 16 bits.
    pub fn all() -> Vec<Self> {
        let blocks = [Pair::Xy, Pair::Hemioct, Pair::Oct]
            .into_iter()
            .flat_map(|pair| Compression::ALL.map(|format| Self::Blocks(pair, format)));
        let codes = ["oct8p", "xyonly16", "hemioct16p", "oct16p"].into_iter().filter_map(|id| find(id).ok());
        blocks.chain(codes.map(Self::Codes)).collect()
    }

    /// The name of the codec or pair, that of the format, and bits of a texel.
    fn parts(self) -> (&'static str, &'static str, u32) {
        match self {
            Self::Codes(codec) => (codec.id, "", codec.bits),
            Self::Blocks(pair, format) => {
                let pair = match pair {
                    Pair::Xy => "xy",
                    Pair::Hemioct => "hemioct",
                    Pair::Oct => "oct",
                };
                (pair, format.name().trim_end_matches("_BLOCK"), 8)
            }
        }
    }
}

/// The errors of a map.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Row {
    /// Map.
    pub map: &'static str,
    /// Codec, or in blocks the projection: `xy`, `hemioct` or `oct`.
    pub codec: &'static str,
    /// Format of blocks: `BC5_UNORM`, `BC5_SNORM` or `BC7_UNORM`; empty where texels are stored by themselves.
    pub format: &'static str,
    /// Bits of a texel.
    pub bits: u32,
    /// Mean error, degrees.
    pub mean_deg: f64,
    /// Maximum error, degrees.
    pub max_deg: f64,
    /// Mean error where the crate `block_compression` chooses the blocks of BC5, channel by channel, degrees.
    pub by_channel_mean_deg: Option<f64>,
    /// Maximum error there, degrees.
    pub by_channel_max_deg: Option<f64>,
}

/// The errors of a map with these normals, stored so.
pub fn measure(map: &Spectrum, normals: &[[f32; 3]], stored: Stored) -> Row {
    let errors = |decoded: Vec<[f32; 3]>| -> ErrorStats {
        let pairs = normals.iter().zip(decoded);
        pairs.map(|(normal, decoded)| angle_deg(normal.map(f64::from), decoded.map(f64::from))).collect()
    };
    let (ours, by_channel) = match stored {
        Stored::Blocks(pair, format) => {
            let decoded = |bytes: &[u8]| decompress(bytes, SIDE, SIDE, pair, format).unwrap_or_default();
            let by_channel = || errors(decoded(&compress_by_channel(normals, SIDE, SIDE, pair, format)));
            let ours = errors(decoded(&compress(normals, SIDE, SIDE, pair, format)));
            (ours, (format != Compression::Bc7).then(by_channel))
        }
        Stored::Codes(codec) => {
            let decoded = normals.iter().map(|normal| codec.decode_one(codec.encode_one(*normal)));
            (errors(decoded.collect()), None)
        }
    };
    let (codec, format, bits) = stored.parts();
    Row {
        map: map.name,
        codec,
        format,
        bits,
        mean_deg: ours.mean_deg(),
        max_deg: ours.max_deg(),
        by_channel_mean_deg: by_channel.map(|errors| errors.mean_deg()),
        by_channel_max_deg: by_channel.map(|errors| errors.max_deg()),
    }
}
