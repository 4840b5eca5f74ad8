//! Costs on GPUs: the recorded results of their drivers' compilers for the kernels.

use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use unitvec_catalogue::{AnyCodec, Operation, find};
use unitvec_files::one_line;
use unitvec_vulkan::DeviceInfo;

/// The codec that others are compared with.
pub const REFERENCE: &str = "oct32";

/// A generation of GPUs, and the GPU that stands for it.
#[derive(Clone, Copy, Debug)]
pub struct Generation {
    /// The GPU's name on the command line.
    pub name: &'static str,
    /// The GPU's name in prose.
    pub title: &'static str,
    /// The names under which such GPUs are sold.
    pub series: &'static str,
    /// Code name of the GPU.
    pub gpu: &'static str,
    /// The first version of Mesa that was seen to compile for the generation.
    pub mesa: &'static str,
    /// The figures that ship with the program.
    costs: &'static [u8],
}

/// A maker's line of GPUs, whose compiler can be asked without any of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// AMD Radeon.
    Radeon,
    /// Intel HD Graphics, Iris and Arc.
    Intel,
    /// NVIDIA GeForce.
    Nvidia,
    /// Qualcomm Adreno.
    Adreno,
    /// Arm Mali.
    Mali,
    /// Broadcom VideoCore.
    VideoCore,
}

/// A GPU with counted costs.
#[derive(Clone, Copy, Debug)]
pub struct Gpu {
    /// The GPU's name on the command line, and of the file of its counts.
    pub name: &'static str,
    /// The GPU's name in prose.
    pub title: &'static str,
    /// Products with such a GPU.
    pub series: &'static str,
    /// The line that it belongs to.
    pub line: Line,
}

/// Rows of [`GPUS`], after those of [`GENERATIONS`].
macro_rules! gpus {
    ($($line:ident $name:literal $title:literal $series:literal;)*) => {
        [
            Gpu::radeon(0),
            Gpu::radeon(1),
            Gpu::radeon(2),
            Gpu::radeon(3),
            Gpu::radeon(4),
            $(Gpu { name: $name, title: $title, series: $series, line: Line::$line }),*
        ]
    };
}

/// The GPUs whose compilers were asked about kernels of one vector, each line's oldest first.
pub const GPUS: [Gpu; 17] = gpus! {
    Intel "skl" "Intel Gen9" "HD Graphics 530";
    Intel "tgl" "Intel Xe-LP" "Iris Xe";
    Intel "dg2" "Intel Xe-HPG" "Arc A";
    Intel "bmg" "Intel Xe2" "Arc B";
    Nvidia "sm_75" "Turing" "RTX 20";
    Nvidia "sm_86" "Ampere" "RTX 30";
    Nvidia "sm_120" "Blackwell" "RTX 50";
    Adreno "a630" "Adreno 630" "Snapdragon 845";
    Adreno "a730" "Adreno 730" "Snapdragon 8 Gen 1";
    Mali "g52" "Mali-G52" "Bifrost";
    Mali "g610" "Mali-G610" "Valhall";
    VideoCore "v3d42" "VideoCore VI" "Raspberry Pi 4";
};

/// The GPU of this name or title: `dg2`, `Adreno 730`, `rdna2`.
pub fn find_gpu(name: &str) -> Option<&'static Gpu> {
    let code = code_name(name).replace('_', "");
    GPUS.iter().find(|gpu| [plain(gpu.name), plain(gpu.title)].contains(&code))
}

impl Gpu {
    /// The GPU that stands for a generation of AMD's.
    const fn radeon(index: usize) -> Self {
        let Generation { gpu, title, series, .. } = GENERATIONS[index];
        Self { name: gpu, title, series, line: Line::Radeon }
    }

    /// Path in the repository of the counts.
    pub fn path(&self) -> PathBuf {
        format!("docs/data/gpus/{}.json", self.name).into()
    }
}

/// A selection of the counts: a row a codec and operation, a column a GPU, as multiples of `oct32`'s.
const COUNTED: &str = include_str!("../data/counted.csv");

/// The costs of the kernels of one element from GLSL, as multiples of `oct32`'s.
pub(crate) fn counted(gpu: &Gpu) -> impl Iterator<Item = (String, Operation, f64)> {
    let mut lines = COUNTED.lines();
    let column = lines.next().and_then(|titles| titles.split(',').position(|title| title == gpu.name));
    lines.filter_map(move |line| {
        let cells: Vec<&str> = line.split(',').collect();
        let operation =
            Operation::ALL.into_iter().find(|one| cells.get(1) == Some(&one.to_string().as_str()))?;
        Some((cells.first()?.to_string(), operation, cells.get(column?)?.parse().ok()?))
    })
}

/// The default generation of costs.
pub const USUAL: &str = "rdna2";

/// Rows of [`GENERATIONS`]; the file of the costs has the GPU's code name.
macro_rules! generations {
    ($($name:literal $title:literal $series:literal $gpu:literal $mesa:literal;)*) => {
        [$(Generation {
            name: $name,
            title: $title,
            series: $series,
            gpu: $gpu,
            mesa: $mesa,
            costs: include_bytes!(concat!("../data/costs_", $gpu, ".json")),
        }),*]
    };
}

/// The generations whose costs ship with the program, the oldest first.
pub const GENERATIONS: [Generation; 5] = generations! {
    "gcn4" "GCN 4" "RX 400 and 500" "polaris10" "22.3";
    "gcn5" "GCN 5" "RX Vega" "vega10" "22.3";
    "rdna2" "RDNA 2" "RX 6000" "navi21" "22.3";
    "rdna3" "RDNA 3" "RX 7000" "navi31" "25.0";
    "rdna4" "RDNA 4" "RX 9000" "gfx1201" "25.0";
};

/// The generation of this name, or of a GPU of this code name: `rdna2`, `RDNA 2`, `navi21`.
pub fn find_generation(name: &str) -> Option<&'static Generation> {
    let name = plain(name);
    GENERATIONS.iter().find(|generation| [generation.name, generation.gpu].contains(&name.as_str()))
}

/// The code name of a GPU or of the GPU that stands for a generation; any other name as it is.
pub fn code_name(name: &str) -> String {
    find_generation(name).map_or_else(|| plain(name), |generation| generation.gpu.to_owned())
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| !" -_".contains(*c)).collect::<String>().to_lowercase()
}

impl Generation {
    /// Path in the repository of the figures that ship with the program.
    pub fn path(&self) -> PathBuf {
        format!("host/choose/data/costs_{}.json", self.gpu).into()
    }

    /// The figures that ship with the program.
    ///
    /// # Errors
    /// [`Error::BadCosts`], which would be a fault of this crate.
    pub fn shipped(&self) -> Result<Report> {
        Report::parse(&self.path(), self.costs)
    }
}

/// The language that a kernel was compiled from.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Rust: the SPIR-V that ships, with the device's own division and square root; in kernels of one element the functions
    /// that shaders link, which are exact.
    Rust,
    /// The exact edition, which puts the device's division and square root right: Rust's SPIR-V as it ships, or GLSL in
    /// kernels of one element.
    Exact,
    /// The GLSL that ships.
    Glsl,
    /// GLSL as people write it from the papers' formulas.
    Textbook,
    /// GLSL without a codec, which adds the components that it reads: the work of [`KernelKind::One`] besides the codec's.
    Idle,
    /// Rust, decoding codes of two bytes by a table of their vectors: of the [measured](KernelKind::Measured) alone.
    Table,
}

/// The kernels that a report is of.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum KernelKind {
    /// The kernels as they ship: four elements an invocation, packed, with a branch around them.
    #[default]
    Four,
    /// One element an invocation, with aligned reads and writes and no branch.
    One,
    /// Those that ship and those that measure arithmetic, which a device ran.
    #[value(skip)]
    Measured,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// Figures of the kernels: a compiler's, or measured ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Report {
    /// Device and driver.
    pub device: DeviceInfo,
    /// The kernels.
    #[serde(default)]
    pub kernel: KernelKind,
    /// The files that the kernels came from, with the first half of their SHA-256; of measured kernels none is named.
    pub sources: BTreeMap<String, String>,
    /// Vectors of a measured dispatch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Times that measured arithmetic encodes or decodes each vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repetitions: Option<u32>,
    /// One row a codec, operation and source.
    pub rows: Vec<Row>,
}

/// Figures of one kernel. Those that the driver does not give are null.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Row {
    /// Codec; for a textbook's kernel the codec in the same format, for an idle one its [`shape`].
    pub id: String,
    /// The kernel's operation.
    pub operation: Operation,
    /// The kernel's source language.
    pub source: Source,
    /// The textbook, for a textbook's kernel.
    #[serde(default)]
    pub textbook: Option<String>,
    /// Instructions of the kernel. In kernels of one element, those that compute, where the compiler tells: on AMD's GPUs
    /// vector instructions, on Adreno all but NOPs, on Mali-G52 arithmetic tuples.
    #[serde(default)]
    pub instructions: Option<u64>,
    /// Vector instructions a vector.
    #[serde(default)]
    pub vector_instructions: Option<f64>,
    /// Cycles of a compute unit's busiest part for 64 invocations, by the compiler's estimate.
    #[serde(default)]
    pub inverse_throughput: Option<u64>,
    /// Cycles from the first instruction to the last, by the compiler's estimate.
    #[serde(default)]
    pub latency: Option<u64>,
    /// Vector registers, by the unit that the compiler counts in.
    #[serde(default)]
    pub vector_registers: Option<u64>,
    /// Bytes of machine code.
    #[serde(default)]
    pub code_bytes: Option<u64>,
    /// Instructions by class, in the compiler's words.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub classes: BTreeMap<String, u64>,
    /// Registers that are kept in memory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spills: Option<u64>,
    /// Invocations that an instruction serves, where the compiler chooses the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u64>,
    /// Of a kernel that a device ran.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<Box<Times>>,
}

/// Times of one kernel, medians over the dispatches. Speeds are null where the device's clock shows no time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Times {
    /// Nanoseconds of arithmetic a vector, less the baseline's.
    pub ns_per_vector: Option<f64>,
    /// The largest less the smallest of the nanoseconds.
    pub spread_ns: Option<f64>,
    /// The nanoseconds' ratio to those of `oct32`, of the same operation and source, measured beside it.
    pub ratio_to_oct32: Option<f64>,
    /// For SPIR-V from Rust, the ratio to SPIR-V from GLSL, measured beside it.
    pub ratio_to_glsl: Option<f64>,
    /// Vectors that the shipped kernel takes in a second.
    pub vectors_per_s: Option<f64>,
    /// Bytes that the shipped kernel reads and writes in a second.
    pub bytes_per_s: Option<f64>,
    /// Bytes that a kernel which copies as many reads and writes in a second.
    pub copy_bytes_per_s: Option<f64>,
}

impl Times {
    /// The shipped kernel's speed in per cent of that of a copy.
    pub fn of_copy(&self) -> Option<f64> {
        Some(100.0 * self.bytes_per_s? / self.copy_bytes_per_s?)
    }
}

impl Row {
    /// A row without figures.
    pub fn new(id: &str, operation: Operation, source: Source) -> Self {
        Self {
            id: id.to_owned(),
            operation,
            source,
            textbook: None,
            instructions: None,
            vector_instructions: None,
            inverse_throughput: None,
            latency: None,
            vector_registers: None,
            code_bytes: None,
            classes: BTreeMap::new(),
            spills: None,
            width: None,
            times: None,
        }
    }
}

impl Report {
    /// A report that names no sources.
    pub fn new(device: DeviceInfo, kernel: KernelKind, rows: Vec<Row>) -> Self {
        Self { device, kernel, sources: BTreeMap::new(), count: None, repetitions: None, rows }
    }

    /// A report of `unitvec bench device --json` or `unitvec bench compiler --json`.
    ///
    /// # Errors
    /// [`Error::BadCosts`] if the bytes are no such report.
    pub fn parse(path: &Path, json: &[u8]) -> Result<Self> {
        serde_json::from_slice(json)
            .map_err(|error| Error::BadCosts { path: path.to_owned(), reason: one_line(error) })
    }

    /// Formats the report as JSON, a row a line.
    pub fn to_json(&self) -> String {
        // Serialising plain structs and strings to memory has no way to fail.
        let json = |value: serde_json::Result<String>| value.unwrap_or_default();
        let rows: Vec<String> = self.rows.iter().map(|row| json(serde_json::to_string(row))).collect();
        let amount = |name: &str, value: Option<u64>| {
            value.map_or_else(String::new, |value| format!("\"{name}\": {value},\n"))
        };
        format!(
            "{{\"device\": {},\n\"kernel\": {},\n\"sources\": {},\n{}{}\"rows\": [\n{}\n]}}\n",
            json(serde_json::to_string(&self.device)),
            json(serde_json::to_string(&self.kernel)),
            json(serde_json::to_string_pretty(&self.sources)),
            amount("count", self.count.map(|count| count as u64)),
            amount("repetitions", self.repetitions.map(u64::from)),
            rows.join(",\n")
        )
    }

    /// The GPU and the compiler, `RDNA 2 (navi21), radv Mesa 22.3.6`; the device alone where it ran the kernels.
    pub fn subject(&self) -> String {
        let DeviceInfo { name, driver, .. } = &self.device;
        let stand_in = name.strip_prefix("Null hardware (RADV ").and_then(|name| name.strip_suffix(')'));
        match stand_in.and_then(find_generation) {
            Some(generation) => format!("{} ({}), {driver}", generation.title, generation.gpu),
            None if self.kernel == KernelKind::Measured => name.clone(),
            None => format!("{}, {driver}", stand_in.unwrap_or(name)),
        }
    }

    /// The row of a kernel; the first row of textbooks' kernels for one codec.
    pub fn row(&self, id: &str, operation: Operation, source: Source) -> Option<&Row> {
        find_row(&self.rows, id, operation, source)
    }

    /// The cost of a kernel: inverse throughput, of kernels of one element instructions [beyond idle](Self::beyond_idle), of
    /// those that a device ran nanoseconds.
    pub fn cost(&self, row: &Row) -> Option<f64> {
        match self.kernel {
            KernelKind::Four => row.inverse_throughput.map(|cycles| cycles as f64),
            KernelKind::One => self.beyond_idle(row),
            KernelKind::Measured => row.times.as_ref()?.ns_per_vector,
        }
    }

    /// The source whose costs stand for the codecs: GLSL, or Rust where its arithmetic was measured.
    pub fn main_source(&self) -> Source {
        let is_measured = |row: &Row| row.source == Source::Rust && self.cost(row).is_some();
        let is_rust = self.kernel == KernelKind::Measured && self.rows.iter().any(is_measured);
        if is_rust { Source::Rust } else { Source::Glsl }
    }

    /// The [cost](Self::cost) of a kernel as a multiple of that of `oct32`'s from GLSL, or where it was measured from the
    /// kernel's own source.
    pub fn ratio_to_oct32(&self, row: &Row) -> Option<f64> {
        match &row.times {
            Some(times) => times.ratio_to_oct32,
            None => self.ratio(row, REFERENCE, |row| self.cost(row)),
        }
    }

    /// The instructions of a kernel as a multiple of those of the codec's kernel from GLSL; of measured ones the times.
    pub fn ratio_to_glsl(&self, row: &Row) -> Option<f64> {
        match &row.times {
            Some(times) => times.ratio_to_glsl,
            None => self.ratio(row, &row.id, |row| match self.kernel {
                KernelKind::One => self.beyond_idle(row),
                _ => row.instructions.map(|count| count as f64),
            }),
        }
    }

    /// The instructions of a kernel of one element beyond those of the idle one that reads and writes the same. Those that
    /// serve fewer invocations than the idle one's count for more.
    pub fn beyond_idle(&self, row: &Row) -> Option<f64> {
        let shape = if row.source == Source::Idle { row.id.clone() } else { shape(find(&row.id).ok()?) };
        let idle = self.row(&shape, row.operation, Source::Idle)?;
        let wider = idle.width.unwrap_or(1) as f64 / row.width.unwrap_or(1) as f64;
        Some(row.instructions? as f64 * wider - idle.instructions? as f64)
    }

    fn ratio(&self, row: &Row, id: &str, figure: impl Fn(&Row) -> Option<f64>) -> Option<f64> {
        Some(figure(row)? / figure(self.row(id, row.operation, Source::Glsl)?)?)
    }
}

/// The first of these rows of a codec, an operation and a source.
pub fn find_row<'a>(rows: &'a [Row], id: &str, operation: Operation, source: Source) -> Option<&'a Row> {
    rows.iter().find(|row| (row.id.as_str(), row.operation, row.source) == (id, operation, source))
}

/// The kind of element, and the bits of code, that a kernel of one element reads and writes: `vector32`.
pub fn shape(codec: &AnyCodec) -> String {
    format!("{:?}{}", codec.element, if codec.bytes > 4 { 64 } else { 32 }).to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gpus_are_named_by_generation_or_code_name() {
        for name in ["rdna2", "RDNA 2", "navi21", "Navi21"] {
            assert_eq!(code_name(name), "navi21");
        }
        assert_eq!(code_name("navi10"), "navi10");
        assert!(find_generation("navi10").is_none());
    }
}
