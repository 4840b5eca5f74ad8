//! Chooses codecs: their costs on GPUs, the precision that is seen, and those that satisfy a demand at the least cost.

#![deny(unsafe_code)]

pub mod costs;
mod error;
pub mod seen;

pub use costs::REFERENCE;
pub use error::{Error, Result};

use serde::Serialize;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::path::Path;
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Element, Measured, Operation};

/// The demands on a codec.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// The kind of element to encode.
    pub element: Element,
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
    /// Weights of encoding and of decoding in the cost.
    pub weights: [f64; 2],
}

/// Costs of codecs, as multiples of `oct32`'s, for both operations.
pub struct Costs {
    device: String,
    by_codec: HashMap<String, [f64; 2]>,
}

/// Devices that `unitvec bench device` ran on, with its reports: NVIDIA's H200, and Mesa's driver for CPUs.
pub const MEASURED: [(&str, &[u8]); 2] = [
    ("H200", include_bytes!("../data/costs_h200.json")),
    ("lavapipe", include_bytes!("../data/costs_lavapipe.json")),
];

impl Costs {
    /// The costs on a generation of GPUs, by the name of either, on another of [`costs::GPUS`], or on one of [`MEASURED`]: they
    /// ship with the program.
    ///
    /// # Errors
    /// [`Error::UnknownGpu`]; [`Error::BadCosts`], which would be a fault of this crate.
    pub fn shipped(name: &str) -> Result<Self> {
        if let Some(generation) = costs::find_generation(name) {
            return Self::of_report(&generation.path(), &generation.shipped()?);
        }
        if let Some(gpu) = costs::find_gpu(name) {
            return Ok(Self::new(format!("{} ({})", gpu.title, gpu.name), costs::counted(gpu)));
        }
        let measured = MEASURED.iter().find(|(known, _)| name.eq_ignore_ascii_case(known));
        let (name, report) = measured.ok_or_else(|| Error::UnknownGpu(name.to_owned()))?;
        Self::parse(Path::new(&format!("host/choose/data/costs_{}.json", name.to_lowercase())), report)
    }

    /// The costs in a report of `unitvec bench device --json` or `unitvec bench compiler --json`.
    ///
    /// # Errors
    /// [`Error::BadCosts`] if the file is no such report.
    pub fn parse(path: &Path, json: &[u8]) -> Result<Self> {
        Self::of_report(path, &costs::Report::parse(path, json)?)
    }

    fn of_report(path: &Path, report: &costs::Report) -> Result<Self> {
        let source = report.main_source();
        let rows = report.rows.iter().filter(|row| row.source == source);
        let ratio = |row: &costs::Row| Some((row.id.clone(), row.operation, report.ratio_to_oct32(row)?));
        let costs = Self::new(report.subject(), rows.filter_map(ratio));
        if costs.by_codec.is_empty() {
            let reason = format!("it has no cost of {REFERENCE}, which others are multiples of");
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

/// A codec with all that a choice counts.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Candidate {
    /// Codec.
    pub id: &'static str,
    /// The codec's bits.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The error that no direction exceeds, in degrees; of frames, here and below, the greater of normal's and tangent's.
    pub bound_deg: f64,
    /// The largest error measured, in degrees.
    pub max_deg: f64,
    /// The mean error measured, in degrees.
    pub mean_deg: f64,
    /// Cost of encoding as a multiple of `oct32`'s, where it is known.
    pub encode_cost: Option<f64>,
    /// Cost of decoding as a multiple of `oct32`'s, where it is known.
    pub decode_cost: Option<f64>,
    /// The weighted sum of both costs, where it is known.
    pub cost: Option<f64>,
    /// True where the encoder reads a table.
    pub reads_table: bool,
    /// The uses that the codec is recommended for.
    pub recommended_for: Vec<&'static str>,
}

/// A limit of a demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// The error of any direction.
    Bound,
    /// The mean error.
    Mean,
    /// The bits of a code.
    Bits,
}

/// A codec that fails a demand, and by how much.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Miss {
    /// The codec.
    #[serde(flatten)]
    pub candidate: Candidate,
    /// The limit that it exceeds most.
    pub exceeds: Limit,
    /// The multiple of the limit that it has.
    pub times: f64,
}

/// The codecs for a demand.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Answer {
    /// The codecs that meet the demand, the best choice first.
    pub candidates: Vec<Candidate>,
    /// Codecs that would be a better choice, and fail the demand by little; where no codec meets it, the nearest.
    pub misses: Vec<Miss>,
}

/// The multiple of a limit up to which a miss is near.
const NEAR: f64 = 1.25;

/// Most misses of an answer.
const MISSES: usize = 3;

/// Chooses codecs. The best has the fewest bytes where an error is demanded, else the least bound; then the least cost,
/// then the least mean error. Codecs without known cost come last.
pub fn choose(demand: &Demand, costs: &Costs) -> Answer {
    let (mut candidates, mut misses) = (Vec::new(), Vec::new());
    let suitable = CODECS.iter().filter(|codec| suits(codec, demand));
    for candidate in suitable.filter_map(|codec| Candidate::new(codec, demand, costs)) {
        match excess(&candidate, demand) {
            None => candidates.push(candidate),
            Some((exceeds, times)) => misses.push(Miss { candidate, exceeds, times }),
        }
    }
    candidates.sort_by(|a, b| order(demand, a, b));
    let best = candidates.first();
    let is_near =
        |miss: &Miss, best| miss.times <= NEAR && order(demand, &miss.candidate, best) == Ordering::Less;
    misses.retain(|miss| best.is_none_or(|best| is_near(miss, best)));
    misses.sort_by(|a, b| a.times.total_cmp(&b.times).then(order(demand, &a.candidate, &b.candidate)));
    misses.truncate(MISSES);
    Answer { candidates, misses }
}

impl Candidate {
    /// `None` where the errors of a codec were not measured yet.
    fn new(codec: &AnyCodec, demand: &Demand, costs: &Costs) -> Option<Self> {
        let Measured { mean_deg, max_deg } = measured(codec, demand.hemisphere)?;
        let both = Operation::ALL.map(|operation| costs.of(codec.id, operation));
        // What does not count may be unknown.
        let weighted = |(cost, weight): (Option<f64>, f64)| {
            if weight == 0.0 { Some(0.0) } else { Some(weight * cost?) }
        };
        let cost: Option<f64> = both.into_iter().zip(demand.weights).map(weighted).sum();
        Some(Self {
            id: codec.id,
            bits: codec.bits,
            bytes: codec.bytes,
            bound_deg: f64::from(codec.max_error_deg()),
            max_deg,
            mean_deg,
            encode_cost: both[0],
            decode_cost: both[1],
            cost,
            reads_table: codec.encodes_by_table,
            recommended_for: codec.recommended_for().collect(),
        })
    }
}

/// The measured errors of a codec, of a frame's normal and tangent the greater; with `above` the mean is over z >= 0.
pub fn measured(codec: &AnyCodec, above: bool) -> Option<Measured> {
    let mut parts = codec.element.directions().iter().filter_map(|of| codec.measured(of));
    let mut errors = parts.next()?;
    for part in parts {
        errors.mean_deg = errors.mean_deg.max(part.mean_deg);
        errors.max_deg = errors.max_deg.max(part.max_deg);
    }
    if let Some(over) = codec.measured("above").filter(|_| above) {
        errors.mean_deg = over.mean_deg;
    }
    Some(errors)
}

/// The order of choice.
fn order(demand: &Demand, a: &Candidate, b: &Candidate) -> Ordering {
    let by_bound = || a.bound_deg.total_cmp(&b.bound_deg);
    let by_demand = if demand.max_error_deg.is_some() { a.bytes.cmp(&b.bytes) } else { by_bound() };
    let cost = |candidate: &Candidate| candidate.cost.unwrap_or(f64::INFINITY);
    by_demand.then(cost(a).total_cmp(&cost(b))).then(a.mean_deg.total_cmp(&b.mean_deg))
}

/// True if a codec can be asked at all. Raw component formats cannot: they do not decode to unit vectors.
fn suits(codec: &AnyCodec, demand: &Demand) -> bool {
    codec.is_unit
        && codec.element == demand.element
        && !(demand.no_table && codec.encodes_by_table)
        && (demand.hemisphere || codec.domain == Domain::Sphere)
}

/// The limit that a codec exceeds most, and the multiple of it that it has.
fn excess(candidate: &Candidate, demand: &Demand) -> Option<(Limit, f64)> {
    let times = |value: f64, limit: Option<f64>| limit.map_or(0.0, |limit| value / limit);
    let all = [
        (Limit::Bound, times(candidate.bound_deg, demand.max_error_deg)),
        (Limit::Mean, times(candidate.mean_deg, demand.mean_error_deg)),
        (Limit::Bits, times(candidate.bits.into(), demand.bits.map(f64::from))),
    ];
    all.into_iter().filter(|(_, times)| *times > 1.0).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Degrees with three digits; decimals where those do not take too many zeros.
pub fn degrees(error: f64) -> String {
    if error <= 0.0 || !error.is_finite() {
        return error.to_string();
    }
    if error < 5e-4 {
        return format!("{error:.2e}");
    }
    let decimals = (2 - error.log10().floor() as i32).max(0) as usize;
    format!("{error:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_have_three_digits() {
        for (value, text) in
            [(0.63575, "0.636"), (0.0195, "0.0195"), (12.34, "12.3"), (1.5e-6, "1.50e-6"), (0.0, "0")]
        {
            assert_eq!(degrees(value), text);
        }
    }
}
