//! Shows that the CPU and a device agree to the bit, with the SPIR-V from Rust, from WGSL and, in a build with a GLSL compiler,
//! from GLSL and HLSL; and how large the error is.

mod arithmetic;
mod plan;
mod rounding;
mod series;

pub use arithmetic::Arithmetic;
pub use plan::Plan;
pub use rounding::Rounding;
pub use series::widest_of_each_series;

use crate::backend::{Backend, BackendKind, Cpu};
use crate::measure::ElementErrors;
use crate::{Error, Result, sampling, workers};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Element, Operation};
use unitvec_vulkan::DeviceInfo;

/// The extent of a run.
pub struct Options {
    /// Random vectors or frames for each codec.
    pub count: usize,
    /// The random elements' seed.
    pub seed: u64,
    /// Further directions: the normals of meshes.
    pub normals: Vec<[f32; 3]>,
    /// Codecs of at most this many bits are decoded over all their codes; wider ones over `count` random codes.
    pub all_codes_up_to: u32,
}

/// The backends that are compared with the CPU.
pub type Backends = BTreeMap<BackendKind, Box<dyn Backend>>;

/// The outcome for all codecs.
#[derive(Debug, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Report {
    /// Device that ran the kernels.
    pub device: DeviceInfo,
    /// Random vectors or frames for each codec.
    pub random_directions: usize,
    /// Codecs of at most this many bits were decoded over all their codes.
    pub all_codes_up_to: u32,
    /// False where the build had no GLSL compiler, so that GLSL and HLSL were not compared with the CPU.
    pub glsl_compared: bool,
    /// Each backend's rounding of sums, by which many encoders turn positions into codes.
    pub rounding: BTreeMap<BackendKind, Rounding>,
    /// The device's arithmetic.
    pub arithmetic: Arithmetic,
    /// Plain functions, which divide and take roots as the device does; none in a build that does not run them.
    pub plain: Option<Plain>,
    /// True if no row has a mismatch, all backends round sums to nearest, the device's arithmetic is good enough for exact kernels,
    /// and plain functions keep within their bounds.
    pub agreed: bool,
    /// One row a codec.
    pub rows: Vec<Row>,
}

/// The outcome for plain functions of all codecs, from Rust and GLSL, the worse of both.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Plain {
    /// Codes of random and special elements that differ from the CPU's.
    pub codes_differ: u64,
    /// Decoded elements that differ from the CPU's in any bit.
    pub elements_differ: u64,
    /// Differences above a bound, with the codec's name, and codes that do not come back.
    pub objections: Vec<String>,
}

/// The outcome on a device, for the table in docs/devices.md: `unitvec conform --share`.
#[derive(Clone, Debug, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shared {
    /// Version of unitvec.
    pub unitvec: String,
    /// Device that ran the kernels.
    pub device: String,
    /// Its kind.
    pub kind: unitvec_vulkan::DeviceKind,
    /// Its driver.
    pub driver: String,
    /// Vulkan version that it implements.
    pub vulkan: String,
    /// The device's arithmetic.
    pub arithmetic: Arithmetic,
    /// True if the run ended in PASS.
    pub agreed: bool,
    /// False where the build had no GLSL compiler, so that GLSL and HLSL were not compared with the CPU.
    pub glsl_compared: bool,
    /// Codecs.
    pub codecs: usize,
    /// Vectors and frames encoded by each backend.
    pub vectors: u64,
    /// Codes decoded by each backend.
    pub codes: u64,
    /// Codes and vectors of all backends that differ from the CPU's.
    pub mismatches: u64,
    /// Plain functions.
    pub plain: Option<Plain>,
}

/// The outcome for one codec.
#[derive(Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Row {
    /// Codec.
    pub id: String,
    /// The codec's bits.
    pub bits: u32,
    /// Vectors encoded by each backend: random ones, normals, special ones and those of all codes decoded.
    pub vectors: u64,
    /// Codes decoded by each backend.
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

/// The outcome for all codecs in one line.
#[derive(Debug, Serialize)]
pub struct Summary<'a> {
    /// Device that ran the kernels.
    pub device: &'a str,
    /// The device's driver.
    pub driver: &'a str,
    /// Vulkan version that it implements.
    pub vulkan: &'a str,
    /// Codecs.
    pub codecs: usize,
    /// Vectors and frames encoded by each backend.
    pub vectors: u64,
    /// Codes decoded by each backend.
    pub codes: u64,
    /// Codes and vectors of all backends that differ from the CPU's.
    pub mismatches: u64,
}

/// How each backend rounds.
pub type Roundings = BTreeMap<BackendKind, Rounding>;

/// True where all backends round sums to nearest, which encoders need.
pub fn all_round_to_nearest(rounding: &Roundings) -> bool {
    rounding.values().all(|rounding| *rounding == Rounding::Nearest)
}

impl Report {
    /// The report on a device, with the verdict.
    pub fn new(
        device: DeviceInfo,
        options: &Options,
        rounding: Roundings,
        arithmetic: Arithmetic,
        plain: Option<Plain>,
        rows: Vec<Row>,
    ) -> Self {
        let keeps_bounds = plain.as_ref().is_none_or(|plain| plain.objections.is_empty());
        Self {
            device,
            random_directions: options.count,
            all_codes_up_to: options.all_codes_up_to,
            glsl_compared: cfg!(feature = "glsl"),
            agreed: rows.iter().all(Row::agrees)
                && all_round_to_nearest(&rounding)
                && arithmetic.objection().is_none()
                && keeps_bounds,
            arithmetic,
            plain,
            rounding,
            rows,
        }
    }

    /// The part of this report that says something about the device, and nothing about its user.
    pub fn shared(&self) -> Shared {
        let Summary { device, driver, vulkan, codecs, vectors, codes, mismatches } = self.summary();
        Shared {
            unitvec: env!("CARGO_PKG_VERSION").to_owned(),
            device: device.to_owned(),
            kind: self.device.kind,
            driver: driver.to_owned(),
            vulkan: vulkan.to_owned(),
            arithmetic: self.arithmetic,
            agreed: self.agreed,
            glsl_compared: self.glsl_compared,
            codecs,
            vectors,
            codes,
            mismatches,
            plain: self.plain.clone(),
        }
    }

    /// Summarises this report in one line.
    pub fn summary(&self) -> Summary<'_> {
        let total = |of: fn(&Row) -> u64| self.rows.iter().map(of).sum();
        Summary {
            device: &self.device.name,
            driver: &self.device.driver,
            vulkan: &self.device.api_version,
            codecs: self.rows.len(),
            vectors: total(|row| row.vectors),
            codes: total(|row| row.codes),
            mismatches: total(Row::mismatches),
        }
    }
}

/// Mismatches with the CPU, of each backend that was compared.
pub type Mismatches = BTreeMap<BackendKind, u64>;

impl Row {
    /// The number of mismatches that are described in words.
    const EXAMPLES: usize = 3;

    /// Codes and vectors of all backends that differ from the CPU's.
    pub fn mismatches(&self) -> u64 {
        self.encode_mismatches.values().chain(self.decode_mismatches.values()).sum()
    }

    /// True where nothing differs.
    pub fn agrees(&self) -> bool {
        self.mismatches() == 0
    }

    /// Counts where the results of a backend differ from the CPU's, all as bytes, and describes the first in words.
    fn compare(
        &mut self,
        format: &AnyCodec,
        operation: Operation,
        kind: BackendKind,
        input: &[u8],
        cpu: &[u8],
        other: &[u8],
    ) {
        if cpu == other {
            return;
        }
        let (element, code): ((_, Shown), (_, Shown)) =
            ((format.element.bytes(), shown_element), (format.bytes, |code| format!("{code:02x?}")));
        let (mismatches, (from, shown_input), (to, shown)) = match operation {
            Operation::Encode => (&mut self.encode_mismatches, element, code),
            Operation::Decode => (&mut self.decode_mismatches, code, element),
        };
        let results = cpu.chunks_exact(to).zip(other.chunks_exact(to));
        for (input, (cpu, other)) in input.chunks_exact(from).zip(results).filter(|(_, (a, b))| a != b) {
            *mismatches.entry(kind).or_default() += 1;
            if self.examples.len() < Self::EXAMPLES {
                let (function, input) = (format.function(operation), shown_input(input));
                let (cpu, other) = (shown(cpu), shown(other));
                self.examples.push(format!("{function} of {input}: cpu {cpu}, {kind} {other}"));
            }
        }
    }
}

/// Runs all plans, on several threads. `open` opens the backends of a thread; `progress` receives the work done since
/// the last call, and `each` the rows, in the plans' order.
///
/// # Errors
/// The first error of a thread or of `each`. Mismatches are no error: they are in the rows.
pub fn run<E: From<Error> + Send>(
    plans: Vec<Plan<'_>>,
    open: impl Fn() -> Result<Backends, E> + Sync,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let work = |plan: Plan<'_>, backends: &mut Backends, progress: &mut dyn FnMut(u64)| {
        Ok(plan.run(backends, progress)?)
    };
    workers::run(plans, open, work, progress, each)
}

/// Runs one codec on the CPU and on each backend, and counts what differs.
struct Comparison<'a> {
    format: &'static AnyCodec,
    backends: &'a mut Backends,
    errors: ElementErrors,
    row: Row,
}

impl<'a> Comparison<'a> {
    fn new(format: &'static AnyCodec, backends: &'a mut Backends) -> Self {
        let none: Mismatches = backends.keys().map(|kind| (*kind, 0)).collect();
        let (encode_mismatches, decode_mismatches) = (none.clone(), none);
        let (id, bits) = (format.id.to_owned(), format.bits);
        let row = Row { id, bits, encode_mismatches, decode_mismatches, ..Row::default() };
        Self { format, backends, errors: ElementErrors::default(), row }
    }

    /// Encodes elements and decodes their codes; adds the errors where they are `measured`.
    fn elements(&mut self, elements: &[f32], measured: bool) -> Result<()> {
        let codes = self.encode(elements)?;
        let decoded = self.decode(&codes)?;
        if measured {
            let floats = self.format.element.floats();
            let pairs = elements.chunks_exact(floats).zip(decoded.chunks_exact(floats));
            pairs.for_each(|(original, decoded)| self.errors.add(self.format.element, original, decoded));
        }
        Ok(())
    }

    /// Decodes codes and encodes the elements: every lattice point is an encoder's input as well.
    fn codes(&mut self, codes: &[u64]) -> Result<()> {
        let elements = self.decode(&sampling::stored(codes, self.format.bytes))?;
        self.encode(&elements).map(drop)
    }

    /// The CPU's codes, after comparing the others with them.
    fn encode(&mut self, elements: &[f32]) -> Result<Vec<u8>> {
        let count = elements.len() / self.format.element.floats();
        self.row.vectors += count as u64;
        let mut cpu = vec![0; count * self.format.bytes];
        Cpu.encode(self.format, elements, &mut cpu)?;
        let mut other = vec![0; cpu.len()];
        for (kind, backend) in self.backends.iter_mut() {
            backend.encode(self.format, elements, &mut other)?;
            let input = bytemuck::cast_slice(elements);
            self.row.compare(self.format, Operation::Encode, *kind, input, &cpu, &other);
        }
        Ok(cpu)
    }

    /// The CPU's elements, after comparing the others with them.
    fn decode(&mut self, codes: &[u8]) -> Result<Vec<f32>> {
        let count = codes.len() / self.format.bytes;
        self.row.codes += count as u64;
        let mut cpu = vec![0.0; count * self.format.element.floats()];
        Cpu.decode(self.format, codes, &mut cpu)?;
        let mut other = vec![0.0; cpu.len()];
        for (kind, backend) in self.backends.iter_mut() {
            backend.decode(self.format, codes, &mut other)?;
            let (cpu, other) = (bytemuck::cast_slice(&cpu), bytemuck::cast_slice(&other));
            self.row.compare(self.format, Operation::Decode, *kind, codes, cpu, other);
        }
        Ok(cpu)
    }

    fn into_row(self) -> Row {
        let ElementErrors { normal, tangent } = self.errors;
        let of_tangent = |degrees: f64| (self.format.element == Element::Frame).then_some(degrees);
        Row {
            mean_deg: normal.mean_deg(),
            max_deg: normal.max_deg(),
            tangent_mean_deg: of_tangent(tangent.mean_deg()),
            tangent_max_deg: of_tangent(tangent.max_deg()),
            ..self.row
        }
    }
}

/// Formats bytes for a message.
type Shown = fn(&[u8]) -> String;

fn shown_element(bytes: &[u8]) -> String {
    let floats: Vec<f32> = bytes.chunks_exact(4).map(bytemuck::pod_read_unaligned).collect();
    let bits: Vec<String> = floats.iter().map(|float| format!("{:08x}", float.to_bits())).collect();
    format!("{floats:?} (bits {})", bits.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_vulkan::DeviceKind;

    fn row(differing: [u64; 3]) -> Row {
        let [of_rust, of_glsl, decoded] = differing;
        Row {
            vectors: 10,
            codes: 100,
            encode_mismatches: [(BackendKind::Rust, of_rust), (BackendKind::Glsl, of_glsl)].into(),
            decode_mismatches: [(BackendKind::Rust, decoded)].into(),
            ..Row::default()
        }
    }

    /// The mismatches of all codecs and backends, encoding and decoding, are in the one line.
    #[test]
    fn a_summary_adds_all_rows() {
        let device = DeviceInfo {
            index: 0,
            name: "name".to_owned(),
            kind: DeviceKind::Software,
            driver: "driver".to_owned(),
            api_version: "1.3.0".to_owned(),
        };
        let report = Report {
            device,
            random_directions: 1,
            all_codes_up_to: 16,
            glsl_compared: true,
            rounding: BTreeMap::new(),
            arithmetic: Arithmetic::default(),
            plain: None,
            agreed: false,
            rows: vec![row([1, 2, 4]), row([8, 0, 0]), row([0; 3])],
        };
        let Summary { device, driver, vulkan, codecs, vectors, codes, mismatches } = report.summary();
        assert_eq!((device, driver, vulkan), ("name", "driver", "1.3.0"));
        assert_eq!((codecs, vectors, codes, mismatches), (3, 30, 300, 15));
        assert_eq!(report.rows.iter().map(Row::agrees).collect::<Vec<_>>(), [false, false, true]);
    }
}
