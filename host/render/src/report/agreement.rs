//! A device's agreement with the CPU, from the reports of `unitvec conform`.

use crate::conform::{Checks, Conversion, Traits};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use unitvec_vulkan::DeviceInfo;

/// A device's agreement with the CPU, from a report of `unitvec conform --json`.
#[derive(Clone, Debug, Serialize)]
pub struct Agreement {
    device: DeviceInfo,
    codecs: usize,
    vectors: u64,
    codes: u64,
    mismatches: u64,
    /// The backends that were compared.
    backends: Vec<String>,
    /// The codecs that differ, with how often.
    differing: Vec<(String, u64)>,
}

#[derive(Deserialize)]
struct Conform {
    device: DeviceInfo,
    rows: Vec<ConformRow>,
}

#[derive(Deserialize)]
struct ConformRow {
    id: String,
    vectors: u64,
    codes: u64,
    encode_mismatches: BTreeMap<String, u64>,
    decode_mismatches: BTreeMap<String, u64>,
}

impl Agreement {
    /// Reads such a report.
    ///
    /// # Errors
    /// The parser's error for any other text.
    pub fn parse(json: &[u8]) -> serde_json::Result<Self> {
        let Conform { device, rows } = serde_json::from_slice(json)?;
        let count = |row: &ConformRow| {
            row.encode_mismatches.values().chain(row.decode_mismatches.values()).sum::<u64>()
        };
        let of_row = rows.iter().map(|row| (row.id.clone(), count(row)));
        Ok(Self {
            codecs: rows.len(),
            vectors: rows.iter().map(|row| row.vectors).sum(),
            codes: rows.iter().map(|row| row.codes).sum(),
            mismatches: rows.iter().map(count).sum(),
            backends: rows
                .first()
                .map_or_else(Vec::new, |row| row.encode_mismatches.keys().cloned().collect()),
            differing: of_row.filter(|(_, count)| *count > 0).collect(),
            device,
        })
    }
}

/// The graphics pipeline's agreement with the CPU, from a report of `unitvec conform pipeline --json`.
#[derive(Clone, Debug, Serialize)]
pub struct Pipeline {
    device: DeviceInfo,
    agreed: bool,
    codecs: usize,
    /// The languages of the shaders.
    sources: Vec<String>,
    /// Texels and vertices.
    compared: u64,
    differing: u64,
    checks: Vec<Check>,
    /// The device's conversions of the numbers of formats, by the formats' names.
    conversions: Vec<(String, String)>,
    /// Vectors that changed between vertex and fragment shader beyond what Vulkan allows.
    changed: u64,
    /// The codecs that differ, with how often.
    failed: Vec<(String, u64)>,
    /// Formats that the device does not support, with their uses.
    unsupported: BTreeSet<String>,
}

/// One way through the pipeline.
#[derive(Clone, Debug, Serialize)]
struct Check {
    what: &'static str,
    compared: u64,
    differing: u64,
}

#[derive(Deserialize)]
struct PipelineReport {
    device: DeviceInfo,
    agreed: bool,
    traits: Traits,
    rows: Vec<PipelineRow>,
    projections: Vec<PipelineRow>,
}

#[derive(Deserialize)]
struct PipelineRow {
    id: String,
    unsupported: Vec<String>,
    checks: BTreeMap<String, Checks>,
    #[serde(default)]
    projected: BTreeMap<String, Projected>,
}

#[derive(Deserialize)]
struct Projected {
    unexplained: u64,
}

impl PipelineRow {
    fn differing(&self) -> u64 {
        let tallies = self.checks.values().flat_map(Checks::all).map(|tally| tally.differing);
        tallies.sum::<u64>() + self.projected.values().map(|projected| projected.unexplained).sum::<u64>()
    }
}

impl Pipeline {
    /// Reads such a report.
    ///
    /// # Errors
    /// The parser's error for any other text.
    pub fn parse(json: &[u8]) -> serde_json::Result<Self> {
        let PipelineReport { device, agreed, traits, rows, projections } = serde_json::from_slice(json)?;
        const WHAT: [&str; 4] =
            ["codes in attachments", "normals from textures", "normals from vertices", "codes in the scene"];
        let mut checks = WHAT.map(|what| Check { what, compared: 0, differing: 0 });
        let all = || rows.iter().chain(&projections);
        for of_source in all().flat_map(|row| row.checks.values()) {
            for (check, tally) in checks.iter_mut().zip(of_source.all()) {
                check.compared += tally.compared;
                check.differing += tally.differing;
            }
        }
        let in_words = |one: &Conversion| (one.name().to_owned(), one.in_words());
        let of_row = all().map(|row| (row.id.clone(), row.differing()));
        Ok(Self {
            device,
            agreed,
            codecs: rows.len(),
            sources: rows.first().map_or_else(Vec::new, |row| row.checks.keys().cloned().collect()),
            compared: checks.iter().map(|check| check.compared).sum(),
            differing: all().map(PipelineRow::differing).sum(),
            checks: checks.to_vec(),
            conversions: traits.conversions.iter().map(in_words).collect(),
            changed: traits.changed,
            failed: of_row.filter(|(_, count)| *count > 0).collect(),
            unsupported: rows.into_iter().flat_map(|row| row.unsupported).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A report of `conform` with one codec that differs.
    #[test]
    fn agreement_is_read_from_conforms_report() {
        let json = br#"{"device": {"index": 0, "name": "n", "kind": "software", "driver": "d", "api_version": "1.3"},
            "rows": [{"id": "oct16", "vectors": 5, "codes": 6, "encode_mismatches": {"rust": 2}, "decode_mismatches": {"rust": 1}},
                     {"id": "oct32", "vectors": 5, "codes": 6, "encode_mismatches": {"rust": 0}, "decode_mismatches": {"rust": 0}}]}"#;
        let agreement = Agreement::parse(json).unwrap();
        assert_eq!(
            (agreement.codecs, agreement.vectors, agreement.codes, agreement.mismatches),
            (2, 10, 12, 3)
        );
        assert_eq!(agreement.differing, [("oct16".to_owned(), 3)]);
        assert!(Agreement::parse(b"{}").is_err());
    }

    /// A report of `conform pipeline` with one codec that differs in a texture.
    #[test]
    fn the_pipeline_is_read_from_conforms_report() {
        let json = br#"{"device": {"index": 0, "name": "n", "kind": "software", "driver": "d", "api_version": "1.3"}, "agreed": false,
            "traits": {"conversions": [
            {"format": "A2B10G10R10_SNORM_PACK32", "rounding": null, "steps_off": 0.0, "fetched": 4, "inexact": 1}],
            "interpolated": 9, "flushed": 1, "changed": 0}, "projections": [], "rows": [{"id": "oct16", "unsupported": ["R8G8B8_SNORM as attachment"], "checks": {"rust": {
            "attachment": {"compared": 5, "differing": 0}, "texture": {"compared": 6, "differing": 2},
            "vertex": {"compared": 7, "differing": 0}, "scene": {"compared": 8, "differing": 0}}},
            "projected": {"rust": {"texels": 3, "differing": 2, "max_steps": 1, "unexplained": 1}}}]}"#;
        let pipeline = Pipeline::parse(json).unwrap();
        assert_eq!((pipeline.codecs, pipeline.compared, pipeline.differing), (1, 26, 3));
        assert_eq!(pipeline.failed, [("oct16".to_owned(), 3)]);
        assert_eq!((pipeline.checks[1].compared, pipeline.checks[1].differing), (6, 2));
        let expected = ("A2B10G10R10_SNORM".to_owned(), "no attachment; 1 of 4 fetched inexactly".to_owned());
        assert_eq!(pipeline.conversions, [expected]);
        assert!(Pipeline::parse(b"{}").is_err());
    }
}
