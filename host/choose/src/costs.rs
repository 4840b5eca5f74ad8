//! Costs on GPUs: the recorded results of their drivers' compilers for the kernels.

use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use unitvec_catalogue::Operation;
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
    /// Rust: the SPIR-V that ships, with the device's own division and square root.
    Rust,
    /// Rust: the SPIR-V as it ships, which puts the device's division and square root right.
    Exact,
    /// The GLSL that ships.
    Glsl,
    /// GLSL as people write it from the papers' formulas.
    Textbook,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// A compiler's figures for the kernels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Report {
    /// Device and driver.
    pub device: DeviceInfo,
    /// The files that the kernels came from, with the first half of their SHA-256.
    pub sources: BTreeMap<String, String>,
    /// One row a codec, operation and source.
    pub rows: Vec<Row>,
}

/// A compiler's figures for one kernel. Those that the driver does not give are null.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Row {
    /// Codec; for a textbook's kernel the codec in the same format.
    pub id: String,
    /// The kernel's operation.
    pub operation: Operation,
    /// The kernel's source language.
    pub source: Source,
    /// The textbook, for a textbook's kernel.
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
    /// A report of `unitvec bench compiler --json`.
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
        format!(
            "{{\"device\": {},\n\"sources\": {},\n\"rows\": [\n{}\n]}}\n",
            json(serde_json::to_string(&self.device)),
            json(serde_json::to_string_pretty(&self.sources)),
            rows.join(",\n")
        )
    }

    /// The GPU and the compiler: `RDNA 2 (navi21), radv Mesa 22.3.6`.
    pub fn subject(&self) -> String {
        let DeviceInfo { name, driver, .. } = &self.device;
        let stand_in = name.strip_prefix("Null hardware (RADV ").and_then(|name| name.strip_suffix(')'));
        match stand_in.and_then(find_generation) {
            Some(generation) => format!("{} ({}), {driver}", generation.title, generation.gpu),
            None => format!("{}, {driver}", stand_in.unwrap_or(name)),
        }
    }

    /// The row of a kernel; the first row of textbooks' kernels for one codec.
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
