//! What the compiler of a GPU's driver makes of the kernels: exact, the same on every machine, and to be had of GPUs that
//! are not there.

pub mod pareto;
pub mod radv;

use crate::bench::REFERENCE;
use crate::catalogue::{self, AnyCodec, Operation};
use crate::error::one_line;
use crate::manifest::sha256_hex;
use crate::modules::Modules;
use crate::textbook::{TEXTBOOK, Textbook};
use crate::vulkan::{DeviceInfo, Inspector, Statistics};
use crate::{Error, Result, glsl};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// A generation of GPUs, and the one that stands for it.
#[derive(Clone, Copy, Debug)]
pub struct Generation {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its name in prose.
    pub title: &'static str,
    /// Code name of the GPU.
    pub gpu: &'static str,
    /// The first version of Mesa that was seen to compile for it.
    pub mesa: &'static str,
    /// The figures that ship with the program.
    costs: &'static [u8],
}

/// The generation whose costs are taken where none is named.
pub const USUAL: &str = "rdna2";

/// The generations whose costs ship with the program, the oldest first.
pub const GENERATIONS: [Generation; 5] = [
    generation("gcn4", "GCN 4", "polaris10", "22.3", include_bytes!("../../data/costs_polaris10.json")),
    generation("gcn5", "GCN 5", "vega10", "22.3", include_bytes!("../../data/costs_vega10.json")),
    generation("rdna2", "RDNA 2", "navi21", "22.3", include_bytes!("../../data/costs_navi21.json")),
    generation("rdna3", "RDNA 3", "navi31", "25.0", include_bytes!("../../data/costs_navi31.json")),
    generation("rdna4", "RDNA 4", "gfx1201", "25.0", include_bytes!("../../data/costs_gfx1201.json")),
];

const fn generation(
    name: &'static str,
    title: &'static str,
    gpu: &'static str,
    mesa: &'static str,
    costs: &'static [u8],
) -> Generation {
    Generation { name, title, gpu, mesa, costs }
}

/// The generation of this name, or of a GPU of this code name: `rdna2`, `RDNA 2`, `navi21`.
pub fn find_generation(name: &str) -> Option<&'static Generation> {
    let name = plain(name);
    GENERATIONS.iter().find(|generation| [generation.name, generation.gpu].contains(&name.as_str()))
}

/// The code name of a GPU or of the one that stands for a generation; any other name as it is.
pub fn code_name(name: &str) -> String {
    find_generation(name).map_or_else(|| plain(name), |generation| generation.gpu.to_owned())
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| !" -_".contains(*c)).collect::<String>().to_lowercase()
}

impl Generation {
    /// Path in the repository of the figures that ship with the program.
    pub fn path(&self) -> PathBuf {
        format!("host/data/costs_{}.json", self.gpu).into()
    }

    /// Those figures.
    ///
    /// # Errors
    /// [`Error::BadCosts`], which would be a fault of this crate.
    pub fn shipped(&self) -> Result<Report> {
        Report::parse(&self.path(), self.costs)
    }
}

/// What a kernel was compiled from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Rust: the SPIR-V that ships.
    Rust,
    /// The GLSL that ships.
    Glsl,
    /// GLSL as people write it from the papers' formulas.
    Textbook,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rust => "rust",
            Self::Glsl => "glsl",
            Self::Textbook => "textbook",
        })
    }
}

/// What a compiler made of the kernels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Device and driver.
    pub device: DeviceInfo,
    /// The files that the kernels came from, with the first half of their SHA-256.
    pub sources: BTreeMap<String, String>,
    /// One row a codec, operation and source.
    pub rows: Vec<Row>,
}

/// What it made of one kernel. Figures that the driver does not give are null.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Codec; for a textbook's kernel the codec in the same format.
    pub id: String,
    /// What the kernel does.
    pub operation: Operation,
    /// What it was compiled from.
    pub source: Source,
    /// For a textbook's kernel, which one.
    #[serde(default)]
    pub textbook: Option<String>,
    /// Instructions of the kernel, which takes four vectors an invocation.
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
    /// Vector registers.
    #[serde(default)]
    pub vector_registers: Option<u64>,
    /// Bytes of machine code.
    #[serde(default)]
    pub code_bytes: Option<u64>,
}

impl Report {
    /// A report of `unitvec bench --isa --json`.
    ///
    /// # Errors
    /// [`Error::BadCosts`] if it is not one.
    pub fn parse(path: &Path, json: &[u8]) -> Result<Self> {
        serde_json::from_slice(json)
            .map_err(|error| Error::BadCosts { path: path.to_owned(), reason: one_line(error) })
    }

    /// As JSON, a row a line.
    pub fn to_json(&self) -> String {
        // Serialising plain structs and strings to memory has no way to fail.
        let json = |value: serde_json::Result<String>| value.unwrap_or_default();
        let rows: Vec<String> = self.rows.iter().map(|row| json(serde_json::to_string(row))).collect();
        format!(
            "{{\"device\": {},\n\"sources\": {},\n\"rows\": [\n{}\n]}}\n",
            json(serde_json::to_string(&self.device)),
            json(serde_json::to_string_pretty(&self.sources)),
            rows.join(",\n")
        )
    }

    /// What was compiled for, and by what: `RDNA 2 (navi21), radv Mesa 22.3.6`.
    pub fn subject(&self) -> String {
        let DeviceInfo { name, driver, .. } = &self.device;
        let stand_in = name.strip_prefix("Null hardware (RADV ").and_then(|name| name.strip_suffix(')'));
        match stand_in.and_then(find_generation) {
            Some(generation) => format!("{} ({}), {driver}", generation.title, generation.gpu),
            None => format!("{}, {driver}", stand_in.unwrap_or(name)),
        }
    }

    /// The row of a kernel; of textbooks' for one codec the first.
    pub fn row(&self, id: &str, operation: Operation, source: Source) -> Option<&Row> {
        self.rows.iter().find(|row| (row.id.as_str(), row.operation, row.source) == (id, operation, source))
    }

    /// The inverse throughput of a kernel as a multiple of that of `oct32`'s from GLSL.
    pub fn ratio_to_oct32(&self, row: &Row) -> Option<f64> {
        self.ratio(row, REFERENCE, |row| row.inverse_throughput)
    }

    /// The instructions of a kernel as a multiple of those of the codec's kernel from GLSL.
    pub fn ratio_to_glsl(&self, row: &Row) -> Option<f64> {
        self.ratio(row, &row.id, |row| row.instructions)
    }

    fn ratio(&self, row: &Row, id: &str, figure: fn(&Row) -> Option<u64>) -> Option<f64> {
        Some(figure(row)? as f64 / figure(self.row(id, row.operation, Source::Glsl)?)? as f64)
    }
}

/// Compiles the kernels of these codecs, of all sources; `done` hears of each codec that is finished.
///
/// # Errors
/// What loading and compiling meet; [`glsl::Error::NotBuiltIn`] without the GLSL compiler.
pub fn measure(
    inspector: &Inspector,
    modules: &Modules,
    formats: &[&'static AnyCodec],
    done: impl Fn(&'static AnyCodec) + Sync,
) -> Result<Report> {
    // glslang starts faster while another one runs.
    let _compiler = glsl::Compiler::new()?;
    let measured: Result<Vec<Vec<Row>>> = formats
        .par_iter()
        .map(|format| {
            let rows = of_codec(inspector, modules, format)?;
            done(format);
            Ok(rows)
        })
        .collect();
    Ok(Report {
        device: inspector.device().info().clone(),
        sources: sources(modules, formats)?,
        rows: measured?.into_iter().flatten().collect(),
    })
}

fn of_codec(inspector: &Inspector, modules: &Modules, format: &AnyCodec) -> Result<Vec<Row>> {
    let compiler = glsl::Compiler::new()?;
    let mut rows = Vec::new();
    for operation in Operation::ALL {
        let name = format.function(operation);
        let mut add = |source, module: &[u8], entry_point: &str, textbook: Option<&Textbook>| -> Result<()> {
            let statistics = inspector.statistics(module, entry_point)?;
            let device = &inspector.device().info().name;
            rows.push(Row::new(format.id, operation, source, textbook, &statistics, device));
            Ok(())
        };
        add(Source::Rust, &modules.load(&name)?, &name, None)?;
        add(Source::Glsl, &compiler.kernel(format, operation)?, glsl::ENTRY_POINT, None)?;
        for textbook in TEXTBOOK.iter().filter(|textbook| textbook.codec == format.id) {
            let module = compiler.textbook_kernel(textbook, operation)?;
            add(Source::Textbook, &module, glsl::ENTRY_POINT, Some(textbook))?;
        }
    }
    Ok(rows)
}

impl Row {
    /// What the driver told of a kernel that it compiled for the device of this name; the textbook is that of [`Source::Textbook`].
    pub fn new(
        id: &str,
        operation: Operation,
        source: Source,
        textbook: Option<&Textbook>,
        statistics: &Statistics,
        device: &str,
    ) -> Self {
        // RADV's names, and that of Intel's drivers for the first.
        let of = |names: &[&str]| names.iter().find_map(|name| statistics.get(*name).copied());
        Self {
            id: id.to_owned(),
            operation,
            source,
            textbook: textbook.map(|textbook| textbook.id.to_owned()),
            instructions: of(&["Instructions", "Instruction Count"]),
            vector_instructions: vector_instructions(statistics, device),
            inverse_throughput: of(&["Inverse Throughput"]),
            latency: of(&["Latency"]),
            vector_registers: of(&["VGPRs"]),
            code_bytes: of(&["Code size"]),
        }
    }
}

/// Vectors that an invocation takes.
const GROUP: f64 = crate::vulkan::GROUP as f64;

/// Vector instructions of a kernel besides those of its vectors: three make the number of the group and compare it, two
/// make addresses of it. Some kernels have one more or less.
const SHARED: f64 = 5.0;

/// Vector instructions a vector: by RADV's own count, which newer versions give; else from the inverse throughput T, where
/// that tells.
///
/// On RDNA 1 and 2 a wave of 64 takes two cycles for any vector instruction. The compiler counts three quarters of what
/// stands in the branch of the invocations that have vectors, so that an instruction for each of four vectors adds
/// 4 x 2 x 3/4 = 6 to T, and [`SHARED`], three of which stand before the branch, 3 x 2 + 2 x 2 x 3/4 = 9. On GCN some
/// instructions take four times as long as others: T does not tell how many there are. Nor does it where the latency,
/// divided among the waves that run at once, limits the kernel.
fn vector_instructions(statistics: &Statistics, device: &str) -> Option<f64> {
    const RDNA: [&str; 9] =
        ["navi10", "navi12", "navi14", "navi21", "navi22", "navi23", "navi24", "vangogh", "rembrandt"];
    if let Some(count) = statistics.get("VALU") {
        return Some((*count as f64 - SHARED) / GROUP);
    }
    let of = |name: &str| statistics.get(name).map(|value| *value as f64);
    let (throughput, latency) = (of("Inverse Throughput")?, of("Latency")?);
    // A wave of 64 counts as two.
    let waves = of("Subgroups per SIMD")? / 2.0;
    let device = device.to_lowercase();
    let is_known = RDNA.iter().any(|gpu| device.contains(&format!("radv {gpu}")));
    (is_known && throughput > (latency / waves).ceil()).then(|| to_hundredths((throughput - 9.0) / 6.0))
}

fn to_hundredths(number: f64) -> f64 {
    (100.0 * number).round() / 100.0
}

/// The files that the kernels of these codecs come from, GLSL and modules, as in [`Report::sources`].
///
/// # Errors
/// [`glsl::Error::NoSource`], which would be a fault of this crate.
pub fn sources(modules: &Modules, formats: &[&'static AnyCodec]) -> Result<BTreeMap<String, String>> {
    let half = |sha256: &str| sha256.get(..32).unwrap_or(sha256).to_owned();
    let mut sources = BTreeMap::new();
    for path in unitvec_shaders::glsl_paths().filter(|path| is_source(path, formats)) {
        let text = glsl::source(path)?;
        sources.insert(format!("glsl/{path}"), half(&sha256_hex(text.as_bytes())));
    }
    for module in &modules.manifest().modules {
        let has = |name: &str| module.entry_points.iter().any(|entry| entry.name == name);
        if formats.iter().any(|format| has(&format.function(Operation::Encode))) {
            sources.insert(format!("spirv/{}", module.file), half(&module.sha256));
        }
    }
    Ok(sources)
}

/// True of GLSL that all codecs share, of textbooks', and of a codec's own.
fn is_source(path: &str, formats: &[&'static AnyCodec]) -> bool {
    const SHARED: [&str; 6] = [
        "unitvec/arith.glsl",
        "kernels/encode.comp",
        "kernels/decode.comp",
        "kernels/group.glsl",
        "kernels/words.glsl",
        "kernels/table.glsl",
    ];
    SHARED.contains(&path)
        || path.starts_with("textbook/")
        || formats.iter().any(|format| path == glsl_file(format.id))
}

/// The file in `glsl/` with a codec's functions.
pub fn glsl_file(id: &str) -> String {
    format!("unitvec/{}", catalogue::find(id).map_or_else(|_| String::new(), AnyCodec::glsl_file))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statistics(entries: &[(&str, u64)]) -> Statistics {
        entries.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    }

    /// The driver's own count comes first; T tells on RDNA 2 where latency is not what limits the kernel.
    #[test]
    fn vector_instructions_are_counted_where_that_can_be() {
        let older = [("Inverse Throughput", 183), ("Latency", 989), ("Subgroups per SIMD", 32)];
        let navi21 = "Null hardware (RADV NAVI21)";
        assert_eq!(vector_instructions(&statistics(&older), navi21), Some(29.0));
        assert_eq!(vector_instructions(&statistics(&older), "Null hardware (RADV VEGA10)"), None);
        let bound = [("Inverse Throughput", 38), ("Latency", 600), ("Subgroups per SIMD", 32)];
        assert_eq!(vector_instructions(&statistics(&bound), navi21), None);
        assert_eq!(vector_instructions(&statistics(&[("VALU", 121)]), navi21), Some(29.0));
    }

    #[test]
    fn gpus_are_named_by_generation_or_code_name() {
        for name in ["rdna2", "RDNA 2", "navi21", "Navi21"] {
            assert_eq!(code_name(name), "navi21");
        }
        assert_eq!(code_name("navi10"), "navi10");
        assert!(find_generation("navi10").is_none());
    }
}
