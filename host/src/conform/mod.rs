//! Shows that the CPU and a device agree to the bit, with the SPIR-V from Rust and, in a build with a GLSL compiler, with
//! that from GLSL; and how large the error is.

mod workers;

pub use workers::{Subject, run};

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
    /// Codecs of at most this many bits are decoded over all their codes; wider ones over `count` random codes.
    pub all_codes_up_to: u32,
}

/// The device's two ways to run a codec.
pub struct Gpus {
    /// With SPIR-V from Rust.
    pub spirv: Gpu,
    /// With SPIR-V from GLSL; none in a build without a GLSL compiler.
    pub glsl: Option<Gpu>,
}

/// Directions halfway between lattice points, where rounding breaks ties.
const HALFWAY: usize = 50_000;

/// The outcome for all codecs.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Device that ran the kernels.
    pub device: DeviceInfo,
    /// Random directions for each codec.
    pub random_directions: usize,
    /// Codecs of at most this many bits were decoded over all their codes.
    pub all_codes_up_to: u32,
    /// False where the build had no GLSL compiler, so that only SPIR-V from Rust was compared with the CPU.
    pub glsl_compared: bool,
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
    /// Vectors encoded in each way: random ones, normals, special ones and those of all codes decoded.
    pub vectors: u64,
    /// Codes decoded in each way.
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
    /// The first mismatches found, in words.
    pub examples: Vec<String>,
}

/// Mismatches with the CPU, by source of the kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Mismatches {
    /// SPIR-V from Rust.
    pub spirv: u64,
    /// SPIR-V from GLSL; none in a build without a GLSL compiler.
    pub glsl: Option<u64>,
}

impl Row {
    /// True where nothing differs.
    pub fn agrees(&self) -> bool {
        [self.encode_mismatches, self.decode_mismatches]
            .iter()
            .all(|mismatches| mismatches.spirv == 0 && mismatches.glsl.is_none_or(|count| count == 0))
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
    if codec.bits <= options.all_codes_up_to { 1 << codec.bits } else { options.count as u64 }
}

/// Runs one codec. `progress` is told the vectors and codes done since it was last called.
///
/// # Errors
/// What the backends meet. Mismatches are no error: they are in the row.
pub fn run_codec(
    codec: &'static CodecInfo,
    options: &Options,
    gpus: &mut Gpus,
    progress: &mut dyn FnMut(u64),
) -> Result<Row> {
    let mut comparison = Comparison::new(codec, gpus);

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
    if codec.bits <= options.all_codes_up_to {
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
    gpus: &mut Gpus,
    progress: &mut dyn FnMut(u64),
) -> Result<Row> {
    let mut comparison = Comparison::new(codec, gpus);

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

/// Runs a codec in each way and counts what differs.
struct Comparison<'a, C: 'static, const N: usize> {
    codec: &'static C,
    format: Format,
    gpus: &'a mut Gpus,
    encoded: Tally,
    decoded: Tally,
    examples: Examples,
}

/// Mismatches and elements of one half of a codec.
struct Tally {
    elements: u64,
    mismatches: Mismatches,
}

impl Tally {
    fn new(has_glsl: bool) -> Self {
        Self { elements: 0, mismatches: Mismatches { spirv: 0, glsl: has_glsl.then_some(0) } }
    }
}

impl<'a, C: Coding<N>, const N: usize> Comparison<'a, C, N> {
    fn new(codec: &'static C, gpus: &'a mut Gpus) -> Self {
        let has_glsl = gpus.glsl.is_some();
        Self {
            codec,
            format: codec.format(),
            gpus,
            encoded: Tally::new(has_glsl),
            decoded: Tally::new(has_glsl),
            examples: Examples::default(),
        }
    }

    /// The CPU's codes, after comparing the others with them.
    fn encode(&mut self, vectors: &[[f32; N]]) -> Result<Vec<u8>> {
        let bytes = self.format.bytes;
        let mut cpu = vec![0; vectors.len() * bytes];
        self.codec.encode_cpu(vectors, &mut cpu)?;
        self.encoded.elements += vectors.len() as u64;

        let mut other = vec![0; cpu.len()];
        for source in SOURCES {
            let Some(gpu) = self.gpus.of(source) else { continue };
            gpu.encode_elements(self.codec, vectors, &mut other)?;
            if cpu == other {
                continue;
            }
            let codes = cpu.chunks_exact(bytes).zip(other.chunks_exact(bytes)).zip(vectors);
            for ((cpu, other), vector) in codes.filter(|((cpu, other), _)| cpu != other) {
                *self.encoded.mismatches.of(source) += 1;
                let bits = vector.map(|c| format!("{:08x}", c.to_bits()));
                let input = format!("{vector:?} (bits {})", bits.join(" "));
                self.examples.add(self.format.function(Direction::Encode), source, input, (cpu, other));
            }
        }
        Ok(cpu)
    }

    /// The CPU's vectors, after comparing the others with them.
    fn decode(&mut self, codes: &[u8]) -> Result<Vec<[f32; N]>> {
        let bytes = self.format.bytes;
        let mut cpu = vec![[0.0; N]; codes.len() / bytes];
        self.codec.decode_cpu(codes, &mut cpu)?;
        self.decoded.elements += cpu.len() as u64;

        let mut other = vec![[0.0; N]; cpu.len()];
        for source in SOURCES {
            let Some(gpu) = self.gpus.of(source) else { continue };
            gpu.decode_elements(self.codec, codes, &mut other)?;
            let vectors = cpu.iter().zip(&other).zip(codes.chunks_exact(bytes));
            for ((cpu, other), code) in
                vectors.filter(|((cpu, other), _)| cpu.map(f32::to_bits) != other.map(f32::to_bits))
            {
                *self.decoded.mismatches.of(source) += 1;
                let input = format!("{code:02x?}");
                self.examples.add(self.format.function(Direction::Decode), source, input, (cpu, other));
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
            examples: self.examples.0,
        }
    }
}

/// The first mismatches, in words.
#[derive(Default)]
struct Examples(Vec<String>);

impl Examples {
    /// Mismatches that are told in words.
    const MAX: usize = 3;

    fn add<T: std::fmt::Debug>(&mut self, function: String, source: &str, input: String, values: (T, T)) {
        if self.0.len() < Self::MAX {
            let (cpu, other) = values;
            self.0.push(format!("{function} of {input}: cpu {cpu:02x?}, {source} {other:02x?}"));
        }
    }
}

/// The sources of kernels, as messages name them.
const SOURCES: [&str; 2] = ["spirv", "glsl"];

impl Gpus {
    fn of(&mut self, source: &str) -> Option<&mut Gpu> {
        if source == SOURCES[0] { Some(&mut self.spirv) } else { self.glsl.as_mut() }
    }
}

impl Mismatches {
    fn of(&mut self, source: &str) -> &mut u64 {
        if source == SOURCES[0] { &mut self.spirv } else { self.glsl.get_or_insert_default() }
    }
}
