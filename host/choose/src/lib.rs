//! Chooses codecs: their costs on GPUs, and those that satisfy a demand at the least cost.

#![deny(unsafe_code)]

pub mod costs;
mod error;

pub use costs::REFERENCE;
pub use error::{Error, Result};

use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::path::Path;
use unitvec_catalogue::{AnyCodec, Domain, Operation, vectors};
use unitvec_files::one_line;
use unitvec_run::backend::{BackendKind, Cpu};
use unitvec_run::measure::measure;

/// The recommended codecs for one purpose.
pub struct Recommendation {
    /// The purpose.
    pub purpose: &'static str,
    /// Identifiers, the first choice first.
    pub codecs: &'static [&'static str],
    /// The number of codecs in the short table, which the README has.
    pub in_short: usize,
}

/// The recommended codecs by purpose.
pub const RECOMMENDED: [Recommendation; 8] = [
    recommend("encoded often: G-buffers", &["oct32", "oct24", "oct16"], 1),
    recommend("encoded once: vertices, textures", &["oct32p", "oct24p", "oct16p"], 3),
    recommend("z >= 0: tangent-space normal maps", &["hemioct16", "hemioct24"], 2),
    recommend("two snorms and a sign bit", &["soct17", "soct25"], 1),
    recommend("least maximum error for the bytes", &["ico16", "ico24", "ico32"], 3),
    recommend("very few bits", &["oct8p", "oct12p"], 1),
    recommend("finer than 32 bits", &["oct48p", "oct52p"], 1),
    recommend("a normal with its tangent", &["frame32", "frame64"], 2),
];

const fn recommend(
    purpose: &'static str,
    codecs: &'static [&'static str],
    in_short: usize,
) -> Recommendation {
    Recommendation { purpose, codecs, in_short }
}

impl Recommendation {
    /// The codecs in the short table.
    pub fn short(&self) -> &'static [&'static str] {
        &self.codecs[..self.in_short]
    }
}

/// The demands on a codec.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// The largest error that is allowed in any direction, in degrees; without it the least error is the choice.
    pub max_error_deg: Option<f64>,
    /// The largest mean error that is allowed, in degrees.
    pub mean_error_deg: Option<f64>,
    /// Most bits of a code.
    pub bits: Option<u32>,
    /// True if encoders that read a table are ruled out.
    pub no_table: bool,
    /// True if all directions have z >= 0.
    pub hemisphere: bool,
}

/// Costs of codecs, as multiples of `oct32`'s, for both operations.
pub struct Costs {
    device: String,
    by_codec: HashMap<String, [f64; 2]>,
}

/// The part that [`Costs`] reads of the report of `unitvec bench --json` on a device.
#[derive(Deserialize)]
struct Report {
    device: ReportDevice,
    rows: Vec<ReportRow>,
}

#[derive(Deserialize)]
struct ReportDevice {
    name: String,
}

#[derive(Deserialize)]
struct ReportRow {
    id: String,
    operation: Operation,
    backend: BackendKind,
    alu_ratio_to_oct32: Option<f64>,
}

impl Costs {
    /// The costs on a generation of GPUs, by the name of either, or on `lavapipe`: they ship with the program.
    ///
    /// # Errors
    /// [`Error::UnknownGpu`]; [`Error::BadCosts`], which would be a fault of this crate.
    pub fn shipped(name: &str) -> Result<Self> {
        if let Some(generation) = costs::find_generation(name) {
            return Self::compiled(&generation.path(), &generation.shipped()?);
        }
        if !name.eq_ignore_ascii_case("lavapipe") {
            return Err(Error::UnknownGpu(name.to_owned()));
        }
        Self::parse(
            Path::new("host/choose/data/costs_lavapipe.json"),
            include_bytes!("../data/costs_lavapipe.json"),
        )
    }

    /// The costs in a report of `unitvec bench device --json` or `unitvec bench compiler --json`.
    ///
    /// # Errors
    /// [`Error::BadCosts`] if the file is no such report.
    pub fn parse(path: &Path, json: &[u8]) -> Result<Self> {
        if let Ok(report) = costs::Report::parse(path, json) {
            return Self::compiled(path, &report);
        }
        let report: Report = serde_json::from_slice(json)
            .map_err(|error| Error::BadCosts { path: path.to_owned(), reason: one_line(error) })?;
        let ratio = |row: ReportRow| Some((row.id, row.operation, row.alu_ratio_to_oct32?));
        // Where arithmetic from Rust was not measured, arithmetic from GLSL counts.
        let is_measured = |row: &ReportRow| row.alu_ratio_to_oct32.is_some();
        let has = |kind| report.rows.iter().any(|row| row.backend == kind && is_measured(row));
        let kind = if has(BackendKind::Rust) { BackendKind::Rust } else { BackendKind::Glsl };
        let rows = report.rows.into_iter().filter(|row| row.backend == kind);
        Ok(Self::new(report.device.name, rows.filter_map(ratio)))
    }

    /// Reads costs as inverse throughput, for the kernels from GLSL.
    fn compiled(path: &Path, report: &costs::Report) -> Result<Self> {
        let rows = report.rows.iter().filter(|row| row.source == costs::Source::Glsl);
        let ratio = |row: &costs::Row| Some((row.id.clone(), row.operation, report.ratio_to_oct32(row)?));
        let costs = Self::new(report.subject(), rows.filter_map(ratio));
        if costs.by_codec.is_empty() {
            let reason = format!("it has no inverse throughput of {REFERENCE}, which costs are multiples of");
            return Err(Error::BadCosts { path: path.to_owned(), reason });
        }
        Ok(costs)
    }

    fn new(device: String, ratios: impl Iterator<Item = (String, Operation, f64)>) -> Self {
        let mut by_codec: HashMap<String, [f64; 2]> = HashMap::new();
        for (id, operation, ratio) in ratios {
            by_codec.entry(id).or_insert([f64::NAN; 2])[operation as usize] = ratio;
        }
        Self { device, by_codec }
    }

    /// The device they are of.
    pub fn device(&self) -> &str {
        &self.device
    }

    /// The cost of this operation of a codec, where it is known.
    pub fn of(&self, id: &str, operation: Operation) -> Option<f64> {
        self.by_codec.get(id).map(|costs| costs[operation as usize]).filter(|cost| cost.is_finite())
    }
}

/// A codec that satisfies the demand.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Candidate {
    /// Codec.
    pub id: &'static str,
    /// The codec's bits.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// Upper bound of the codec's error, in degrees.
    pub max_error_deg: f64,
    /// The codec's mean error, measured now, in degrees.
    pub mean_error_deg: f64,
    /// Cost of encoding as a multiple of `oct32`'s, where it is known.
    pub encode_cost: Option<f64>,
    /// Cost of decoding as a multiple of `oct32`'s, where it is known.
    pub decode_cost: Option<f64>,
}

/// Random directions that mean errors are measured over.
pub const COUNT: usize = 100_000;

/// The codecs that satisfy a demand, the best choice first: fewest bytes, then cheapest, decoding and encoding
/// together, then least mean error. Among codecs of as many bytes, those without measured cost come last.
///
/// # Errors
/// [`LengthMismatch`](unitvec::slice::LengthMismatch), which would be a fault of this crate.
pub fn candidates(demand: &Demand, costs: &Costs) -> Result<Vec<Candidate>> {
    let mut candidates = Vec::new();
    for codec in vectors().iter().filter(|codec| meets(codec, demand)) {
        let domain = if demand.hemisphere { Domain::Hemisphere } else { Domain::Sphere };
        let mean_error_deg = measure(&mut Cpu, codec, domain, COUNT, 1)?.normal.mean_deg();
        if demand.mean_error_deg.is_some_and(|limit| mean_error_deg > limit) {
            continue;
        }
        candidates.push(Candidate {
            id: codec.id,
            bits: codec.bits,
            bytes: codec.bytes,
            max_error_deg: f64::from(codec.max_error_deg()),
            mean_error_deg,
            encode_cost: costs.of(codec.id, Operation::Encode),
            decode_cost: costs.of(codec.id, Operation::Decode),
        });
    }
    candidates.sort_by(|a, b| {
        let by_error = a.max_error_deg.total_cmp(&b.max_error_deg);
        let by_demand = if demand.max_error_deg.is_some() { a.bytes.cmp(&b.bytes) } else { by_error };
        by_demand.then(a.cost().total_cmp(&b.cost())).then(a.mean_error_deg.total_cmp(&b.mean_error_deg))
    });
    Ok(candidates)
}

impl Candidate {
    /// The cost of both operations; infinite where it was not measured.
    pub fn cost(&self) -> f64 {
        self.encode_cost.zip(self.decode_cost).map_or(f64::INFINITY, |(encode, decode)| encode + decode)
    }
}

/// True if a codec satisfies all demands but the mean error, which has to be measured. Raw component formats do not:
/// they do not decode to unit vectors.
fn meets(codec: &AnyCodec, demand: &Demand) -> bool {
    codec.is_unit
        && demand.max_error_deg.is_none_or(|limit| f64::from(codec.max_error_deg()) <= limit)
        && demand.bits.is_none_or(|bits| codec.bits <= bits)
        && !(demand.no_table && codec.encodes_by_table)
        && (demand.hemisphere || codec.domain == Domain::Sphere)
}
