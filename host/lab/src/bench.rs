//! Costs of encoding and decoding on a device: arithmetic after the survey's method, and how close to memory speed the
//! shipped kernels run.

use crate::Result;
use serde::Deserialize;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use unitvec_catalogue::{self as catalogue, AnyCodec, Domain, Element, Operation};
use unitvec_choose::REFERENCE;
use unitvec_choose::costs::{KernelKind, Report, Row, Source, Times};
use unitvec_manifest::modules;
use unitvec_manifest::modules::Modules;
use unitvec_oracle::survey;
use unitvec_run::backend::{KernelSource, decode_table};
use unitvec_run::shader::Edition;
use unitvec_run::{glsl, sampling};
use unitvec_vulkan::{self as vulkan, BufferPromise, Device, Division, Kernel, Runner, Table};

/// Times that a cost kernel encodes or decodes each vector, as the survey did (section 4.2).
const REPETITIONS: u32 = 100;

/// The extent of the measurements.
pub struct Options {
    /// Vectors of a dispatch.
    pub count: usize,
    /// Dispatches of each cost kernel.
    pub samples: usize,
    /// Dispatches of each shipped kernel.
    pub throughput_samples: usize,
    /// The folder of kernels from Rust that measure arithmetic, which `cargo xtask spirv --cost` builds. They run as they are.
    /// Without them the arithmetic of SPIR-V from GLSL alone is measured.
    pub cost_kernels: Option<PathBuf>,
}

/// A row of the survey's table 2.
#[derive(Deserialize)]
struct Published {
    name: String,
    gpu_encode_ns_per_vector: f64,
    gpu_decode_ns_per_vector: f64,
}

/// The survey's figure for a codec, in nanoseconds.
pub fn survey_ns(id: &str, operation: Operation) -> Option<f64> {
    let name = catalogue::find(id).ok()?.survey_name;
    let mut rows = csv::Reader::from_reader(survey::TABLE_2.as_bytes());
    let row = rows.deserialize::<Published>().filter_map(|row| row.ok()).find(|row| row.name == name)?;
    Some(match operation {
        Operation::Encode => row.gpu_encode_ns_per_vector,
        Operation::Decode => row.gpu_decode_ns_per_vector,
    })
}

/// Measures on one device.
pub struct Bench {
    runner: Runner,
    sources: [KernelSource; 2],
    compiler: glsl::Compiler,
    best_fit_table: Table,
    /// The baseline and the kernel of [`REFERENCE`].
    references: HashMap<(Operation, Source), [Kernel; 2]>,
    options: Options,
    vectors: Vec<u8>,
    codes: Vec<u64>,
}

impl Bench {
    /// Prepares to measure.
    ///
    /// # Errors
    /// [`vulkan::Error::MissingFeature`] for a device without timestamps; any error of the kernels.
    pub fn new(device: &Arc<Device>, modules: Modules, options: Options) -> Result<Self> {
        let mut runner = Runner::new(device, options.count, false)?;
        let best_fit_table = runner.table(bytemuck::cast_slice(catalogue::best_fit_table()))?;
        let mut bench = Self {
            runner,
            sources: [
                KernelSource::Rust(modules, Edition::Exact),
                KernelSource::Glsl(glsl::Compiler::new()?),
            ],
            compiler: glsl::Compiler::new()?,
            best_fit_table,
            references: HashMap::new(),
            vectors: random_elements(Element::Vector, options.count),
            codes: sampling::random_codes(1).take(options.count).collect(),
            options,
        };
        let reference = catalogue::find(REFERENCE)?;
        for operation in Operation::ALL {
            for source in bench.measured() {
                let kernel = |format| bench.cost_kernel(source, format, operation);
                let pair = [kernel(None)?, kernel(Some(reference))?];
                bench.references.insert((operation, source), pair);
            }
        }
        Ok(bench)
    }

    /// The rows measured, with what they were measured on.
    pub fn report(&self, rows: Vec<Row>) -> Report {
        let device = self.runner.device().info().clone();
        let (count, repetitions) = (Some(self.options.count), Some(REPETITIONS));
        Report { count, repetitions, ..Report::new(device, KernelKind::Measured, rows) }
    }

    /// Measures both operations of a codec.
    ///
    /// # Errors
    /// Any error of the kernels.
    pub fn measure(&mut self, format: &AnyCodec) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        for operation in Operation::ALL {
            let measured = self.cost(format, operation)?;
            let of = |one| measured.iter().find(|(source, _)| *source == one).map(|(_, costs)| costs);
            let (rust, glsl) = (of(Source::Rust), of(Source::Glsl));
            let (copy, speeds) = self.throughput(format, operation)?;
            let traffic = (format.element.bytes() + format.bytes) as f64;
            for (source, vectors_per_s) in speeds {
                let costs = of(source);
                let to_glsl = rust.zip(glsl).map(|(rust, glsl)| ratio(&rust.codec, &glsl.codec));
                let times = Times {
                    ns_per_vector: costs.map(|costs| median(costs.codec.clone())),
                    spread_ns: costs.map(|costs| spread(&costs.codec)),
                    ratio_to_oct32: costs.map(|costs| ratio(&costs.codec, &costs.reference)),
                    ratio_to_glsl: to_glsl.filter(|_| source == Source::Rust),
                    vectors_per_s: finite(vectors_per_s),
                    bytes_per_s: finite(vectors_per_s * traffic),
                    copy_bytes_per_s: finite(copy * traffic),
                };
                rows.push(Row { times: Some(Box::new(times)), ..Row::new(format.id, operation, source) });
            }
        }
        Ok(rows)
    }

    fn measured(&self) -> impl Iterator<Item = Source> + use<> {
        let has_rust = self.options.cost_kernels.is_some();
        SOURCES.into_iter().filter(move |source| has_rust || *source == Source::Glsl)
    }

    /// The kernel that measures a codec's arithmetic; the baseline without a codec.
    fn cost_kernel(&self, source: Source, format: Option<&AnyCodec>, operation: Operation) -> Result<Kernel> {
        let table = format.and_then(|format| self.table_of(format, operation));
        if let (Source::Rust, Some(folder)) = (source, &self.options.cost_kernels) {
            let function =
                format.map_or_else(|| format!("baseline_{operation}"), |format| format.function(operation));
            let name = format!("{function}_cost");
            // Arithmetic is measured with the device's own division, as other libraries have it.
            let module = modules::cost_kernel(folder, &name)?;
            let promise = BufferPromise::ExactSize;
            return Ok(self.runner.kernel_for(promise, Division::Device, &module, &name, table)?);
        }
        let module = self.compiler.cost_kernel(format, operation)?;
        Ok(self.runner.kernel(&module, glsl::ENTRY_POINT, table)?)
    }

    fn table_of(&self, format: &AnyCodec, operation: Operation) -> Option<&Table> {
        (operation == Operation::Encode && format.encodes_by_table).then_some(&self.best_fit_table)
    }

    /// Costs of the kernels of each source that is measured.
    fn cost(&mut self, format: &AnyCodec, operation: Operation) -> Result<Vec<(Source, Costs)>> {
        let sources: Vec<Source> = self.measured().collect();
        let kernels = sources.iter().map(|source| self.cost_kernel(*source, Some(format), operation));
        let kernels = kernels.collect::<Result<Vec<Kernel>>>()?;
        let input: Vec<u8> = match operation {
            Operation::Encode => self.elements(Element::Vector),
            Operation::Decode => {
                let words = |code: &u64| [*code as u32, (*code >> 32) as u32, 0];
                let words: Vec<[u32; 3]> = self.codes.iter().map(words).collect();
                bytemuck::cast_slice(&words).to_vec()
            }
        };
        // Kernels that are compared are side by side: the codec's kernels are next to each other.
        let mut order: Vec<(usize, usize, &Kernel)> = Vec::new();
        for (index, (source, kernel)) in sources.iter().zip(&kernels).enumerate() {
            let [baseline, reference] = &self.references[&(operation, *source)];
            let parts = [baseline, reference, kernel];
            order.extend(alternating(index, parts.len()).map(|part| (index, part, parts[part])));
        }
        let (runner, count) = (&mut self.runner, self.options.count);
        let mut sums = vec![0; count * 4];
        let mut time = |kernel: &Kernel, repetitions| -> Result<f64> {
            let ns = runner.run_cost(kernel, count, repetitions, &input, &mut sums)?;
            Ok(ns.ok_or_else(|| no_timestamps(runner))? / count as f64 / f64::from(REPETITIONS))
        };
        // Drivers compile at the first dispatch.
        for (_, _, kernel) in &order {
            time(kernel, 4)?;
        }
        let mut costs: Vec<_> = sources.into_iter().map(|source| (source, Costs::default())).collect();
        for sample in 0..self.options.samples {
            let mut times = vec![[0.0; 3]; costs.len()];
            for (index, part, kernel) in alternating(sample, order.len()).map(|i| order[i]) {
                times[index][part] = time(kernel, REPETITIONS)?;
            }
            for ((_, costs), [baseline, reference, codec]) in costs.iter_mut().zip(times) {
                costs.codec.push(codec - baseline);
                costs.reference.push(reference - baseline);
            }
        }
        Ok(costs)
    }

    /// Vectors a second of a kernel that copies, and of the shipped ones by their sources.
    fn throughput(&mut self, format: &AnyCodec, operation: Operation) -> Result<(f64, Vec<(Source, f64)>)> {
        let count = self.options.count;
        let copy = self.compiler.copy_kernel(format, operation)?;
        let table = self.table_of(format, operation).cloned();
        let kernel = |source: &KernelSource, runner| source.kernel(runner, format, operation, table.as_ref());
        let [rust, glsl] = &self.sources;
        let mut kernels = vec![
            (None, self.runner.kernel(&copy, glsl::ENTRY_POINT, None)?),
            (Some(Source::Rust), kernel(rust, &self.runner)?),
            (Some(Source::Glsl), kernel(glsl, &self.runner)?),
        ];
        if (format.bytes, operation) == (2, Operation::Decode) {
            let table = self.runner.table(bytemuck::cast_slice(&decode_table(format)?))?;
            let kernel = rust.decode_by_table(&self.runner, &table)?;
            kernels.push((Some(Source::Table), kernel));
        }

        let (element, code) = (count * format.element.bytes(), count * format.bytes);
        let (input, mut output) = match operation {
            Operation::Encode => (self.elements(format.element), vec![0; code]),
            Operation::Decode => (sampling::stored(&self.codes, format.bytes), vec![0; element]),
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
        let mut speeds = times.into_iter().map(|times| count as f64 / (median(times) * 1e-9));
        let copy = speeds.next().unwrap_or(f64::NAN);
        let sources = kernels.iter().filter_map(|(source, _)| *source);
        Ok((copy, sources.zip(speeds).collect()))
    }

    fn elements(&self, element: Element) -> Vec<u8> {
        match element {
            Element::Vector => self.vectors.clone(),
            Element::Frame | Element::Rotation => random_elements(element, self.options.count),
        }
    }
}

/// The bytes of random elements.
fn random_elements(element: Element, count: usize) -> Vec<u8> {
    let floats = sampling::random_elements(element, Domain::Sphere, 1);
    let floats: Vec<f32> = floats.take(count * element.floats()).collect();
    bytemuck::cast_slice(&floats).to_vec()
}

/// Nanoseconds a vector of each dispatch, less those of a dispatch of the baseline beside it.
#[derive(Default)]
struct Costs {
    codec: Vec<f64>,
    /// The time of [`REFERENCE`], beside the codec.
    reference: Vec<f64>,
}

/// The kernels measured, in the order of a [`Bench`]'s sources.
const SOURCES: [Source; 2] = [Source::Rust, Source::Glsl];

/// 0 to n - 1, backwards every other time: so a device that slows down or speeds up does so for all alike.
fn alternating(sample: usize, n: usize) -> impl Iterator<Item = usize> {
    (0..n).map(move |i| if sample & 1 == 0 { i } else { n - 1 - i })
}

fn no_timestamps(runner: &Runner) -> vulkan::Error {
    let device = runner.device().info().name.clone();
    vulkan::Error::MissingFeature { device, feature: "timestamps on its compute queue" }
}

fn finite(speed: f64) -> Option<f64> {
    speed.is_finite().then_some(speed)
}

/// The median: the mean of the two in the middle for an even number.
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
        let known = catalogue::vectors()
            .iter()
            .filter(|codec| survey_ns(codec.id, Operation::Decode).is_some())
            .count();
        assert_eq!(known, 17);
        assert_eq!(survey_ns("oct32", Operation::Encode), Some(0.023160));
    }

    #[test]
    fn medians_of_odd_and_even_numbers() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }
}
