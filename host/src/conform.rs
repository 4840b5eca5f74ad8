//! Shows that the CPU, the SPIR-V from Rust and the SPIR-V from GLSL agree to the bit, and how large the error is.

use crate::backend::{CHUNK, Gpu};
use crate::catalogue::{CodecInfo, Coding, Direction, Format, FrameInfo};
use crate::measure::ErrorStats;
use crate::sampling;
use crate::vulkan::DeviceInfo;
use crate::{Error, Result};
use serde::Serialize;

/// What to run.
pub struct Options {
    /// Random directions for each codec.
    pub count: usize,
    /// Seed of those directions.
    pub seed: u64,
    /// Further directions: the normals of meshes.
    pub normals: Vec<[f32; 3]>,
}

/// Codecs of at most this many bits are decoded over all their codes; wider ones over random codes.
const EXHAUSTIVE_BITS: u32 = 24;

/// Directions halfway between lattice points, where rounding breaks ties.
const HALFWAY: usize = 50_000;

/// The outcome for all codecs.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Device that ran the kernels.
    pub device: DeviceInfo,
    /// True if no row has a mismatch.
    pub agreed: bool,
    /// One row a codec.
    pub rows: Vec<Row>,
}

/// The outcome for one codec.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Codec.
    pub id: &'static str,
    /// Its bits.
    pub bits: u32,
    /// Vectors encoded three ways: random ones, normals, special ones and those of all codes decoded.
    pub vectors: u64,
    /// Codes decoded three ways.
    pub codes: u64,
    /// Mean error over the random directions, degrees; of a frame's normals.
    pub mean_deg: f64,
    /// Largest error over the random directions, degrees; of a frame's normals.
    pub max_deg: f64,
    /// Mean error of a frame's tangents, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangent_mean_deg: Option<f64>,
    /// Largest error of a frame's tangents, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangent_max_deg: Option<f64>,
    /// Codes that differ from the CPU's.
    pub encode_mismatches: Mismatches,
    /// Vectors that differ from the CPU's in any bit.
    pub decode_mismatches: Mismatches,
    /// Device time of a vector in nanoseconds, where the device tells.
    pub device_ns: DeviceTime,
    /// The first mismatches found, in words.
    pub examples: Vec<String>,
}

/// Mismatches with the CPU, by source of the kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Mismatches {
    /// SPIR-V from Rust.
    pub spirv: u64,
    /// SPIR-V from GLSL.
    pub glsl: u64,
}

/// Mean device nanoseconds a vector.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct DeviceTime {
    /// Encoding, SPIR-V from Rust.
    pub encode_spirv: Option<f64>,
    /// Encoding, SPIR-V from GLSL.
    pub encode_glsl: Option<f64>,
    /// Decoding, SPIR-V from Rust.
    pub decode_spirv: Option<f64>,
    /// Decoding, SPIR-V from GLSL.
    pub decode_glsl: Option<f64>,
}

impl Row {
    /// True where nothing differs.
    pub fn agrees(&self) -> bool {
        self.encode_mismatches == Mismatches::default() && self.decode_mismatches == Mismatches::default()
    }
}

/// Vectors and codes that [`run_codec`] passes through each backend: for progress.
pub fn work(codec: &CodecInfo, options: &Options) -> u64 {
    let special = (sampling::special_vectors().len() + HALFWAY) as u64;
    (options.count as u64)
        .saturating_add(options.normals.len() as u64 + special)
        .saturating_add(code_count(codec, options))
}

/// Frames and codes that [`run_frame`] passes through each backend: for progress.
pub fn frame_work(options: &Options) -> u64 {
    let special = 2 * sampling::special_vectors().len() as u64;
    (options.count as u64).saturating_mul(2).saturating_add(special)
}

/// Largest integer of a coordinate's snorm, up to where f32 still has halves.
fn lattice_size(codec: &CodecInfo) -> u32 {
    (1 << (codec.bits / 2 - 1).min(22)) - 1
}

fn code_count(codec: &CodecInfo, options: &Options) -> u64 {
    if codec.bits <= EXHAUSTIVE_BITS { 1 << codec.bits } else { options.count as u64 }
}

/// Runs one codec. `progress` is told the vectors and codes done since it was last called.
///
/// # Errors
/// What the backends meet. Mismatches are no error: they are in the row.
pub fn run_codec(
    codec: &'static CodecInfo,
    options: &Options,
    spirv: &mut Gpu,
    glsl: &mut Gpu,
    progress: &mut dyn FnMut(u64),
) -> Result<Row> {
    spirv.warm_up(codec)?;
    glsl.warm_up(codec)?;
    let mut comparison = Comparison::new(codec, spirv, glsl);

    let mut errors = ErrorStats::default();
    let random = sampling::random_directions(codec.domain, options.seed);
    sampling::in_chunks(random, options.count, CHUNK, |vectors| {
        let codes = comparison.encode(vectors)?;
        for (original, decoded) in vectors.iter().zip(comparison.decode(&codes)?) {
            errors.add(*original, decoded);
        }
        progress(vectors.len() as u64);
        Ok::<(), Error>(())
    })?;

    let mut others = options.normals.clone();
    others.extend(sampling::special_vectors());
    others.extend(sampling::halfway_vectors(lattice_size(codec), HALFWAY, options.seed));
    for vectors in others.chunks(CHUNK) {
        let codes = comparison.encode(vectors)?;
        comparison.decode(&codes)?;
        progress(vectors.len() as u64);
    }

    let count = code_count(codec, options) as usize;
    let each = |codes: &[u64]| comparison.round_trip(codes, progress);
    if codec.bits <= EXHAUSTIVE_BITS {
        sampling::in_chunks(0.., count, CHUNK, each)?;
    } else {
        sampling::in_chunks(sampling::random_codes(options.seed), count, CHUNK, each)?;
    }
    Ok(comparison.into_row(&errors))
}

/// Runs a codec of frames, as [`run_codec`]: random frames, special vectors as normals and as tangents, random codes.
///
/// # Errors
/// As [`run_codec`].
pub fn run_frame(
    codec: &'static FrameInfo,
    options: &Options,
    spirv: &mut Gpu,
    glsl: &mut Gpu,
    progress: &mut dyn FnMut(u64),
) -> Result<Row> {
    spirv.warm_up(codec)?;
    glsl.warm_up(codec)?;
    let mut comparison = Comparison::new(codec, spirv, glsl);

    let (mut normals, mut tangents) = (ErrorStats::default(), ErrorStats::default());
    let random = sampling::random_frames(options.seed);
    sampling::in_chunks(random, options.count, CHUNK, |frames| {
        let codes = comparison.encode(frames)?;
        for (original, decoded) in frames.iter().zip(comparison.decode(&codes)?) {
            let vectors = |[a, b, c, d, e, f, _]: [f32; 7]| ([a, b, c], [d, e, f]);
            let ((normal, tangent), (decoded_normal, decoded_tangent)) =
                (vectors(*original), vectors(decoded));
            normals.add(normal, decoded_normal);
            tangents.add(tangent, decoded_tangent);
        }
        progress(frames.len() as u64);
        Ok::<(), Error>(())
    })?;

    let special = sampling::special_frames();
    let codes = comparison.encode(&special)?;
    comparison.decode(&codes)?;
    progress(special.len() as u64);

    let codes = sampling::random_codes(options.seed);
    sampling::in_chunks(codes, options.count, CHUNK, |codes| comparison.round_trip(codes, progress))?;
    let mut row = comparison.into_row(&normals);
    row.tangent_mean_deg = Some(tangents.mean_deg());
    row.tangent_max_deg = Some(tangents.max_deg());
    Ok(row)
}

/// Runs a codec three ways and counts what differs.
struct Comparison<'a, C: 'static, const N: usize> {
    codec: &'static C,
    format: Format,
    spirv: &'a mut Gpu,
    glsl: &'a mut Gpu,
    encoded: Tally,
    decoded: Tally,
    examples: Vec<String>,
}

/// Mismatches, elements and device time of one half of a codec.
#[derive(Default)]
struct Tally {
    elements: u64,
    mismatches: Mismatches,
    spirv_ns: Option<f64>,
    glsl_ns: Option<f64>,
}

impl<'a, C: Coding<N>, const N: usize> Comparison<'a, C, N> {
    /// Mismatches that are told in words.
    const MAX_EXAMPLES: usize = 3;

    fn new(codec: &'static C, spirv: &'a mut Gpu, glsl: &'a mut Gpu) -> Self {
        Self {
            codec,
            format: codec.format(),
            spirv,
            glsl,
            encoded: Tally::default(),
            decoded: Tally::default(),
            examples: Vec::new(),
        }
    }

    /// The CPU's codes, after comparing the others with them.
    fn encode(&mut self, vectors: &[[f32; N]]) -> Result<Vec<u8>> {
        let size = vectors.len() * self.format.bytes;
        let (mut cpu, mut spirv, mut glsl) = (vec![0; size], vec![0; size], vec![0; size]);
        self.codec.encode_cpu(vectors, &mut cpu)?;
        let spirv_ns = self.spirv.encode_elements(self.codec, vectors, &mut spirv)?;
        let glsl_ns = self.glsl.encode_elements(self.codec, vectors, &mut glsl)?;
        self.encoded.add(vectors.len(), spirv_ns, glsl_ns);

        let bytes = self.format.bytes;
        let differs = |other: &[u8], n: usize| cpu[n * bytes..][..bytes] != other[n * bytes..][..bytes];
        for (n, vector) in vectors.iter().enumerate() {
            for (name, other) in [("spirv", &spirv), ("glsl", &glsl)] {
                if differs(other, n) {
                    *self.encoded.mismatches.of(name) += 1;
                    let codes = (&cpu[n * bytes..][..bytes], &other[n * bytes..][..bytes]);
                    let bits = vector.map(|c| format!("{:08x}", c.to_bits()));
                    self.example(
                        Direction::Encode,
                        name,
                        format!("{vector:?} (bits {})", bits.join(" ")),
                        codes,
                    );
                }
            }
        }
        Ok(cpu)
    }

    /// The CPU's vectors, after comparing the others with them.
    fn decode(&mut self, codes: &[u8]) -> Result<Vec<[f32; N]>> {
        let count = codes.len() / self.format.bytes;
        let (mut cpu, mut spirv, mut glsl) =
            (vec![[0.0; N]; count], vec![[0.0; N]; count], vec![[0.0; N]; count]);
        self.codec.decode_cpu(codes, &mut cpu)?;
        let spirv_ns = self.spirv.decode_elements(self.codec, codes, &mut spirv)?;
        let glsl_ns = self.glsl.decode_elements(self.codec, codes, &mut glsl)?;
        self.decoded.add(count, spirv_ns, glsl_ns);

        for n in 0..count {
            for (name, other) in [("spirv", &spirv), ("glsl", &glsl)] {
                if cpu[n].map(f32::to_bits) != other[n].map(f32::to_bits) {
                    *self.decoded.mismatches.of(name) += 1;
                    let code = &codes[n * self.format.bytes..][..self.format.bytes];
                    self.example(Direction::Decode, name, format!("{code:02x?}"), (cpu[n], other[n]));
                }
            }
        }
        Ok(cpu)
    }

    /// Decodes codes and encodes what they stand for: every lattice point is an encoder's input as well.
    fn round_trip(&mut self, codes: &[u64], progress: &mut dyn FnMut(u64)) -> Result<()> {
        let bytes: Vec<u8> =
            codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(self.format.bytes)).collect();
        let vectors = self.decode(&bytes)?;
        self.encode(&vectors)?;
        progress(vectors.len() as u64);
        Ok(())
    }

    fn example<T: std::fmt::Debug>(
        &mut self,
        direction: Direction,
        source: &str,
        input: String,
        values: (T, T),
    ) {
        if self.examples.len() < Self::MAX_EXAMPLES {
            let (cpu, other) = values;
            self.examples.push(format!(
                "{} of {input}: cpu {cpu:02x?}, {source} {other:02x?}",
                self.format.function(direction)
            ));
        }
    }

    fn into_row(self, errors: &ErrorStats) -> Row {
        let (encoded, decoded) = (self.encoded, self.decoded);
        Row {
            id: self.format.id,
            bits: self.format.bits,
            vectors: encoded.elements,
            codes: decoded.elements,
            mean_deg: errors.mean_deg(),
            max_deg: errors.max_deg(),
            tangent_mean_deg: None,
            tangent_max_deg: None,
            encode_mismatches: encoded.mismatches,
            decode_mismatches: decoded.mismatches,
            device_ns: DeviceTime {
                encode_spirv: encoded.per_element(encoded.spirv_ns),
                encode_glsl: encoded.per_element(encoded.glsl_ns),
                decode_spirv: decoded.per_element(decoded.spirv_ns),
                decode_glsl: decoded.per_element(decoded.glsl_ns),
            },
            examples: self.examples,
        }
    }
}

impl Tally {
    fn add(&mut self, elements: usize, spirv_ns: Option<f64>, glsl_ns: Option<f64>) {
        self.elements += elements as u64;
        let sum = |total: Option<f64>, ns: Option<f64>| ns.map(|ns| total.unwrap_or(0.0) + ns);
        self.spirv_ns = sum(self.spirv_ns, spirv_ns);
        self.glsl_ns = sum(self.glsl_ns, glsl_ns);
    }

    fn per_element(&self, ns: Option<f64>) -> Option<f64> {
        ns.map(|ns| ns / self.elements.max(1) as f64)
    }
}

impl Mismatches {
    fn of(&mut self, source: &str) -> &mut u64 {
        if source == "spirv" { &mut self.spirv } else { &mut self.glsl }
    }
}
