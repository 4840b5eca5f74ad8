//! What encoding and decoding cost on a device: arithmetic by the survey's method, and how close to memory speed the
//! shipped kernels run.

use crate::backend::{KernelSource, decode_table};
use crate::catalogue::{self, CATALOGUE, Coding, Direction, Domain, Element, Format};
use crate::modules::Modules;
use crate::vulkan::{self, Device, DeviceInfo, Kernel, Runner, Table};
use crate::{Result, glsl, sampling};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_oracle::survey;

/// The codec that others are compared with.
pub const REFERENCE: &str = "oct32";

/// Times that a cost kernel encodes or decodes each vector, as the survey did (section 4.2).
const REPETITIONS: u32 = 100;

/// How much to measure.
pub struct Options {
    /// Vectors of a dispatch.
    pub count: usize,
    /// Dispatches of each cost kernel.
    pub samples: usize,
    /// Dispatches of each shipped kernel.
    pub throughput_samples: usize,
}

/// What a kernel was compiled from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// Rust, by rust-gpu.
    Rust,
    /// GLSL, by glslang.
    Glsl,
    /// The Rust kernel that looks two-byte codes up in a table of their vectors: throughput alone.
    RustTable,
}

impl Source {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rust => "rust",
            Self::Glsl => "glsl",
            Self::RustTable => "rust-table",
        }
    }
}

/// All that was measured.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Device.
    pub device: DeviceInfo,
    /// Vectors of a dispatch.
    pub count: usize,
    /// Times that cost kernels encode or decode each of them.
    pub repetitions: u32,
    /// One row a codec, direction and source.
    pub rows: Vec<Row>,
}

/// What was measured of one kernel.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Codec.
    pub id: &'static str,
    /// Its bits.
    pub bits: u32,
    /// Half of the codec.
    pub direction: Direction,
    /// What the kernel was compiled from.
    pub source: Source,
    /// Nanoseconds of arithmetic a vector, less the baseline's: the median over the dispatches.
    pub alu_ns_per_vector: Option<f64>,
    /// The largest less the smallest of them.
    pub alu_spread_ns: Option<f64>,
    /// Their ratio to those of `oct32`, of the same direction and source, measured beside it: the median.
    pub alu_ratio_to_oct32: Option<f64>,
    /// For SPIR-V from Rust, their ratio to those of SPIR-V from GLSL, measured beside it: the median.
    pub alu_ratio_to_glsl: Option<f64>,
    /// Vectors that the shipped kernel takes in a second: of the median over the dispatches.
    pub vectors_per_s: f64,
    /// Bytes that it reads and writes in a second.
    pub bytes_per_s: f64,
    /// Bytes that a kernel which copies as many reads and writes in a second.
    pub copy_bytes_per_s: f64,
    /// The survey's figure, of a GeForce GTX 680.
    pub survey_ns_per_vector: Option<f64>,
}

/// A row of the survey's table 2.
#[derive(Deserialize)]
struct Published {
    name: String,
    gpu_encode_ns_per_vector: f64,
    gpu_decode_ns_per_vector: f64,
}

/// The survey's figure for a codec, in nanoseconds.
pub fn survey_ns(id: &str, direction: Direction) -> Option<f64> {
    let name = CATALOGUE.iter().find(|codec| codec.id == id)?.survey_name;
    let mut rows = csv::Reader::from_reader(survey::TABLE_2.as_bytes());
    let row = rows.deserialize::<Published>().filter_map(|row| row.ok()).find(|row| row.name == name)?;
    Some(match direction {
        Direction::Encode => row.gpu_encode_ns_per_vector,
        Direction::Decode => row.gpu_decode_ns_per_vector,
    })
}

/// Measures on one device.
pub struct Bench {
    runner: Runner,
    modules: KernelSource,
    glsl: KernelSource,
    cost_modules: Modules,
    compiler: glsl::Compiler,
    best_fit_table: Table,
    baselines: HashMap<(Direction, Source), Kernel>,
    /// Those of [`REFERENCE`].
    references: HashMap<(Direction, Source), Kernel>,
    options: Options,
    vectors: Vec<[f32; 3]>,
    codes: Vec<u64>,
}

impl Bench {
    /// Prepares to measure with `modules` and `cost_modules` of the same folder.
    ///
    /// # Errors
    /// [`vulkan::Error::MissingFeature`] for a device without timestamps; what the kernels meet.
    pub fn new(
        device: &Arc<Device>,
        modules: Modules,
        cost_modules: Modules,
        options: Options,
    ) -> Result<Self> {
        let mut runner = Runner::new(device, options.count, false)?;
        let best_fit_table = runner.table(bytemuck::cast_slice(catalogue::best_fit_table()))?;
        let mut bench = Self {
            runner,
            modules: KernelSource::Spirv(modules),
            glsl: KernelSource::Glsl(glsl::Compiler::new()?),
            cost_modules,
            compiler: glsl::Compiler::new()?,
            best_fit_table,
            baselines: HashMap::new(),
            references: HashMap::new(),
            vectors: sampling::random_directions(Domain::Sphere, 1).take(options.count).collect(),
            codes: sampling::random_codes(1).take(options.count).collect(),
            options,
        };
        for direction in DIRECTIONS {
            for source in SOURCES {
                let baseline = bench.baseline(direction, source)?;
                bench.baselines.insert((direction, source), baseline);
                let reference = bench.cost_kernel(catalogue::find(REFERENCE)?.format(), direction, source)?;
                bench.references.insert((direction, source), reference);
            }
        }
        Ok(bench)
    }

    /// The rows measured, with what they were measured on.
    pub fn report(&self, rows: Vec<Row>) -> Report {
        let device = self.runner.device().info().clone();
        Report { device, count: self.options.count, repetitions: REPETITIONS, rows }
    }

    /// Measures both directions of a codec.
    ///
    /// # Errors
    /// What the kernels meet.
    pub fn measure(&mut self, format: Format) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        for direction in DIRECTIONS {
            let [rust, glsl] = self.cost(format, direction)?;
            let speeds = self.throughput(format, direction)?;
            let traffic = (format.element.bytes() + format.bytes) as f64;
            for (source, vectors_per_s) in speeds.kernels {
                let costs = match source {
                    Source::Rust => Some(&rust),
                    Source::Glsl => Some(&glsl),
                    Source::RustTable => None,
                };
                let to_glsl = || ratio(&rust.codec, &glsl.codec);
                rows.push(Row {
                    id: format.id,
                    bits: format.bits,
                    direction,
                    source,
                    alu_ns_per_vector: costs.map(|costs| median(costs.codec.clone())),
                    alu_spread_ns: costs.map(|costs| spread(&costs.codec)),
                    alu_ratio_to_oct32: costs.map(|costs| ratio(&costs.codec, &costs.reference)),
                    alu_ratio_to_glsl: (source == Source::Rust).then(to_glsl),
                    vectors_per_s,
                    bytes_per_s: vectors_per_s * traffic,
                    copy_bytes_per_s: speeds.copy * traffic,
                    survey_ns_per_vector: survey_ns(format.id, direction),
                });
            }
        }
        Ok(rows)
    }

    fn baseline(&self, direction: Direction, source: Source) -> Result<Kernel> {
        let name = format!("baseline_{direction}");
        Ok(match source {
            Source::Glsl => {
                self.runner.kernel(&self.compiler.baseline_kernel(direction)?, glsl::ENTRY_POINT, None)?
            }
            _ => {
                let (module, entry_point) = self.cost_modules.load(&name)?;
                self.runner.kernel(&module, entry_point, None)?
            }
        })
    }

    fn cost_kernel(&self, format: Format, direction: Direction, source: Source) -> Result<Kernel> {
        let table = self.table_of(format, direction);
        Ok(match source {
            Source::Glsl => {
                let module = self.compiler.cost_kernel(format, direction)?;
                self.runner.kernel(&module, glsl::ENTRY_POINT, table)?
            }
            _ => {
                let (module, entry_point) = self.cost_modules.load(&format.function(direction))?;
                self.runner.kernel(&module, entry_point, table)?
            }
        })
    }

    fn table_of(&self, format: Format, direction: Direction) -> Option<&Table> {
        (direction == Direction::Encode && format.encodes_by_table).then_some(&self.best_fit_table)
    }

    /// Costs of the kernels from Rust and from GLSL.
    fn cost(&mut self, format: Format, direction: Direction) -> Result<[Costs; 2]> {
        let [rust, glsl] = SOURCES.map(|source| self.cost_kernel(format, direction, source));
        let (rust, glsl) = (rust?, glsl?);
        let input: Vec<u8> = match direction {
            Direction::Encode => bytemuck::cast_slice(&self.vectors).to_vec(),
            Direction::Decode => {
                let words = |code: &u64| [*code as u32, (*code >> 32) as u32, 0];
                let words: Vec<[u32; 3]> = self.codes.iter().map(words).collect();
                bytemuck::cast_slice(&words).to_vec()
            }
        };
        let [of_rust, of_glsl] = SOURCES.map(|source| (direction, source));
        // What is compared is side by side.
        let kernels = [
            &self.baselines[&of_rust],
            &self.references[&of_rust],
            &rust,
            &glsl,
            &self.references[&of_glsl],
            &self.baselines[&of_glsl],
        ];
        let (runner, count) = (&mut self.runner, self.options.count);
        let mut sums = vec![0; count * 4];
        let mut time = |kernel: &Kernel, repetitions| -> Result<f64> {
            let ns = runner.run_cost(kernel, count, repetitions, &input, &mut sums)?;
            Ok(ns.ok_or_else(|| no_timestamps(runner))? / count as f64 / f64::from(REPETITIONS))
        };
        // Drivers compile at the first dispatch.
        for kernel in kernels {
            time(kernel, 4)?;
        }
        let mut costs = [Costs::default(), Costs::default()];
        for sample in 0..self.options.samples {
            let mut times = [0.0; 6];
            for i in alternating(sample, kernels.len()) {
                times[i] = time(kernels[i], REPETITIONS)?;
            }
            let [rust_baseline, rust_reference, rust, glsl, glsl_reference, glsl_baseline] = times;
            costs[0].add(rust - rust_baseline, rust_reference - rust_baseline);
            costs[1].add(glsl - glsl_baseline, glsl_reference - glsl_baseline);
        }
        Ok(costs)
    }

    /// Vectors a second of the shipped kernels and of one that copies.
    fn throughput(&mut self, format: Format, direction: Direction) -> Result<Speeds> {
        let count = self.options.count;
        let copy = self.compiler.copy_kernel(format, direction)?;
        let table = self.table_of(format, direction).cloned();
        let kernel = |source: &KernelSource, runner| source.kernel(runner, format, direction, table.as_ref());
        let mut kernels = vec![
            (None, self.runner.kernel(&copy, glsl::ENTRY_POINT, None)?),
            (Some(Source::Rust), kernel(&self.modules, &self.runner)?),
            (Some(Source::Glsl), kernel(&self.glsl, &self.runner)?),
        ];
        let codec = CATALOGUE.iter().find(|codec| codec.id == format.id && codec.bytes == 2);
        if let (Some(codec), Direction::Decode) = (codec, direction) {
            let table = self.runner.table(bytemuck::cast_slice(&decode_table(codec)?))?;
            kernels.push((Some(Source::RustTable), self.modules.decode_by_table(&self.runner, &table)?));
        }

        let (element, code) = (count * format.element.bytes(), count * format.bytes);
        let (input, mut output) = match direction {
            Direction::Encode => (self.elements(format.element), vec![0; code]),
            Direction::Decode => {
                let bytes =
                    self.codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(format.bytes));
                (bytes.collect(), vec![0; element])
            }
        };
        let mut times = vec![Vec::new(); kernels.len()];
        for sample in 0..=self.options.throughput_samples {
            for i in alternating(sample, kernels.len()) {
                let ns = self.runner.run(&kernels[i].1, count, &input, &mut output)?;
                let ns = ns.ok_or_else(|| no_timestamps(&self.runner))?;
                // Drivers compile at the first dispatch.
                if sample > 0 {
                    times[i].push(ns);
                }
            }
        }
        let mut speeds = Speeds { copy: 0.0, kernels: Vec::new() };
        for ((source, _), times) in kernels.iter().zip(times) {
            let vectors_per_s = count as f64 / (median(times) * 1e-9);
            match source {
                Some(source) => speeds.kernels.push((*source, vectors_per_s)),
                None => speeds.copy = vectors_per_s,
            }
        }
        Ok(speeds)
    }

    fn elements(&self, element: Element) -> Vec<u8> {
        match element {
            Element::Vector => bytemuck::cast_slice(&self.vectors).to_vec(),
            Element::Frame => {
                let frames: Vec<f32> =
                    sampling::random_frames(1).take(self.options.count).flatten().collect();
                bytemuck::cast_slice(&frames).to_vec()
            }
        }
    }
}

/// Nanoseconds a vector of each dispatch, less those of a dispatch of the baseline beside it.
#[derive(Default)]
struct Costs {
    codec: Vec<f64>,
    /// Of [`REFERENCE`], beside it.
    reference: Vec<f64>,
}

impl Costs {
    fn add(&mut self, codec: f64, reference: f64) {
        self.codec.push(codec);
        self.reference.push(reference);
    }
}

/// Vectors a second.
struct Speeds {
    copy: f64,
    kernels: Vec<(Source, f64)>,
}

const DIRECTIONS: [Direction; 2] = [Direction::Encode, Direction::Decode];

/// The sources with cost kernels.
const SOURCES: [Source; 2] = [Source::Rust, Source::Glsl];

/// 0 to n - 1, backwards every other time: so a device that slows down or speeds up does so for all alike.
fn alternating(sample: usize, n: usize) -> impl Iterator<Item = usize> {
    (0..n).map(move |i| if sample & 1 == 0 { i } else { n - 1 - i })
}

fn no_timestamps(runner: &Runner) -> vulkan::Error {
    let device = runner.device().info().name.clone();
    vulkan::Error::MissingFeature { device, feature: "timestamps on its compute queue" }
}

/// The middle one, or the mean of the two in the middle.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    match times.len() {
        0 => f64::NAN,
        n => (times[(n - 1) / 2] + times[n / 2]) / 2.0,
    }
}

/// The median of the ratios of times that were taken side by side.
fn ratio(times: &[f64], others: &[f64]) -> f64 {
    median(times.iter().zip(others).map(|(time, other)| time / other).collect())
}

fn spread(times: &[f64]) -> f64 {
    let (least, most) =
        times.iter().fold((f64::INFINITY, 0.0f64), |(least, most), time| (least.min(*time), most.max(*time)));
    most - least
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The survey's 17 rows are read and belong to codecs of the catalogue.
    #[test]
    fn the_published_table_is_whole() {
        let known = CATALOGUE.iter().filter(|codec| survey_ns(codec.id, Direction::Decode).is_some()).count();
        assert_eq!(known, 17);
        assert_eq!(survey_ns("oct32", Direction::Encode), Some(0.023160));
    }

    #[test]
    fn medians_of_odd_and_even_numbers() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }
}
