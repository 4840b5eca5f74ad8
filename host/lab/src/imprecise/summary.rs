//! A table's summary of a codec.

use super::{Bounds, Model, Outcome, Row};
use serde::{Deserialize, Serialize};

/// The worst of all models that round sums to nearest, beside the bounds; and results of devices that truncate sums.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Summary {
    /// Codec.
    pub id: String,
    /// Random elements that each device encoded.
    pub elements: u64,
    /// Codes of these that differ from the CPU's.
    pub codes_differ: u64,
    /// The bound of the codes that differ, where there is one.
    pub codes_differ_at_most: Option<u64>,
    /// Codes that differ on a device that truncates sums.
    pub codes_differ_truncated: u64,
    /// Codes that each device decoded.
    pub codes: u64,
    /// Largest difference of a decoded component from the CPU's, in 2^-24.
    pub component_ulp: f64,
    /// The bound of the components' difference.
    pub component_ulp_at_most: f64,
    /// Largest angle between a decoded vector and the CPU's, degrees.
    pub angle_deg: f64,
    /// The bound of the angle.
    pub angle_deg_at_most: f64,
    /// Codes that do not come back from the worst pair of devices.
    pub codes_lost: u64,
    /// True where all codes have to come back.
    pub is_stable: bool,
}

impl Summary {
    /// Summarises a row.
    pub fn new(row: &Row, bounds: &Bounds) -> Self {
        let worst = |value: fn(&Outcome) -> f64| {
            let nearest = row.models.iter().filter(|(model, _)| model.rounds_to_nearest());
            nearest.map(|(_, outcome)| value(outcome)).fold(0.0, f64::max)
        };
        let (component_ulp_at_most, angle_deg_at_most) = bounds.decoded();
        Self {
            id: row.id.clone(),
            elements: row.elements,
            codes_differ: worst(|outcome| outcome.codes_differ as f64) as u64,
            codes_differ_at_most: bounds.codes_differ(row.elements),
            codes_differ_truncated: row
                .models
                .get(&Model::Truncate)
                .map_or(0, |outcome| outcome.codes_differ),
            codes: row.codes,
            component_ulp: worst(|outcome| outcome.component_ulp),
            component_ulp_at_most,
            angle_deg: worst(|outcome| outcome.angle_deg),
            angle_deg_at_most,
            codes_lost: row.unstable.values().copied().max().unwrap_or(0),
            is_stable: bounds.is_stable,
        }
    }
}
