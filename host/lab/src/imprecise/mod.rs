//! The codecs on devices that round as badly as Vulkan allows: the kernels' modules, rewritten, on a device that rounds
//! well.

mod bounds;
mod difference;
mod experiment;
mod model;
mod rewrite;
mod summary;

pub use bounds::Bounds;
pub use difference::{of_codes, of_elements};
pub use experiment::Gpus;
pub use model::Model;
pub use rewrite::{Error, rewrite};
pub use summary::Summary;

use crate::Result;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unitvec_catalogue::AnyCodec;
use unitvec_run::backend::BackendKind;
use unitvec_run::shader::Edition;
use unitvec_run::workers;

/// The extent of the experiment.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Options {
    /// Random vectors or frames for each codec, and random codes for those whose codes are not all decoded.
    pub count: usize,
    /// Seeds of the random elements and of [`Model::Bits`]: each is a run of its own.
    pub seeds: Vec<u64>,
    /// The models.
    pub models: Vec<Model>,
    /// Codecs of at most this many bits are decoded over all their codes.
    pub all_codes_up_to: u32,
}

impl Options {
    /// Elements and codes of a codec of this format, for each source.
    pub fn work(&self, format: &AnyCodec) -> u64 {
        (self.count as u64 + self.codes(format)) * self.seeds.len() as u64
    }

    /// Codes for each seed.
    fn codes(&self, format: &AnyCodec) -> u64 {
        if format.bits <= self.all_codes_up_to { 1 << format.bits } else { self.count as u64 }
    }
}

/// The outcome for one codec: of all models, seeds and sources of kernels.
#[derive(Clone, Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Row {
    /// Codec.
    pub id: String,
    /// Random elements that each device encoded.
    pub elements: u64,
    /// Codes that each device decoded.
    pub codes: u64,
    /// Results of plain kernels on the devices of each model.
    pub models: BTreeMap<Model, Outcome>,
    /// Results of exact kernels, which are the CPU's wherever sums are rounded to nearest.
    pub exact: BTreeMap<Model, Outcome>,
    /// Codes that do not come back, by the models of the devices that decode and encode; `exact` is the CPU. Devices that
    /// truncate sums are not among them.
    pub unstable: BTreeMap<String, u64>,
}

/// Results of one model's devices compared with the CPU: the worst where kernels from several sources differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Outcome {
    /// Random elements with another code than the CPU's.
    pub codes_differ: u64,
    /// Differences in special elements: denormals, infinities, NaN, the ends of ranges, ties.
    pub special_differ: u64,
    /// Largest error of a random element whose code differs, as a part of the codec's error bound.
    pub error: f64,
    /// Decoded elements that differ from the CPU's in any bit.
    pub elements_differ: u64,
    /// Largest difference of a decoded component from the CPU's, in ULP of the numbers from 0.5 to 1, which are 2^-24.
    pub component_ulp: f64,
    /// Largest angle between a decoded vector and the CPU's, degrees.
    pub angle_deg: f64,
}

impl Outcome {
    /// Adds results for other elements.
    pub fn add(&mut self, other: Self) {
        self.merge(other, |count, other| count + other);
    }

    /// True where any code or vector is not the CPU's.
    pub fn differs(&self) -> bool {
        self.codes_differ + self.special_differ + self.elements_differ > 0
    }

    /// Merges results for the same elements: the worse of both.
    fn worse(&mut self, other: Self) {
        self.merge(other, u64::max);
    }

    fn merge(&mut self, other: Self, counts: fn(u64, u64) -> u64) {
        self.codes_differ = counts(self.codes_differ, other.codes_differ);
        self.special_differ = counts(self.special_differ, other.special_differ);
        self.elements_differ = counts(self.elements_differ, other.elements_differ);
        self.error = self.error.max(other.error);
        self.component_ulp = self.component_ulp.max(other.component_ulp);
        self.angle_deg = self.angle_deg.max(other.angle_deg);
    }
}

impl Row {
    /// The objections to this row, in words: counts and differences above their bounds, and codes that do not come back
    /// where the codec promises it.
    pub fn objections(&self, bounds: &Bounds) -> Vec<String> {
        let outcomes = self.models.iter().flat_map(|(model, outcome)| {
            let objections = bounds.objections(*model, self.elements, outcome);
            objections.into_iter().map(move |text| format!("{model}: {text}"))
        });
        let worst = self.unstable.iter().max_by_key(|(_, count)| **count).filter(|_| bounds.is_stable);
        let unstable = worst.map(|(pair, count)| {
            let pairs = self.unstable.len();
            format!("codes that do not come back, of {pairs} pairs of devices: {count} {pair}, the worst")
        });
        let exact =
            self.exact.iter().filter(|(model, outcome)| model.rounds_to_nearest() && outcome.differs());
        let exact =
            exact.map(|(model, outcome)| format!("{model}: exact kernels differ from the CPU: {outcome:?}"));
        outcomes.chain(unstable).chain(exact).collect()
    }
}

/// Runs codecs on several threads. `open` opens the devices of a thread; `progress` receives the work done since the
/// last call, and `each` the rows, in the codecs' order.
///
/// # Errors
/// The first error of a device or of `each`. Differences are no error: they are in the rows.
pub fn run<E: From<crate::Error> + Send>(
    formats: Vec<&'static AnyCodec>,
    options: &Options,
    open: impl Fn() -> Result<Gpus, E> + Sync,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let work = |format, gpus: &mut Gpus, progress: &mut dyn FnMut(u64)| {
        Ok(experiment::run(format, options, gpus, progress)?)
    };
    workers::run(formats, open, work, progress, each)
}

/// The error bound of a codec in degrees: for frames the normal's or the tangent's, whichever is less.
pub fn error_bound(format: &AnyCodec) -> f64 {
    format.max_errors_deg.iter().copied().fold(f32::INFINITY, f32::min).into()
}

/// Merges rows of several sources of kernels: the worse of each.
fn merged(rows: BTreeMap<(Edition, BackendKind), Row>) -> Option<Row> {
    rows.into_values().reduce(|mut all, row| {
        for (worst, of_row) in [(&mut all.models, row.models), (&mut all.exact, row.exact)] {
            for (model, outcome) in of_row {
                worst.entry(model).or_default().worse(outcome);
            }
        }
        for (pair, count) in row.unstable {
            let worst = all.unstable.entry(pair).or_default();
            *worst = count.max(*worst);
        }
        all
    })
}
