//! A device's agreement with the CPU, as the page shows it.

use crate::conform::{Conversion, Report, Row};
use serde::Serialize;
use std::collections::BTreeSet;
use unitvec_run::backend::BackendKind;
use unitvec_run::conform as kernels;
use unitvec_vulkan::DeviceInfo;

/// The agreement of the device's kernels with the CPU.
#[derive(Serialize)]
pub struct Agreement<'a> {
    device: &'a DeviceInfo,
    totals: kernels::Summary<'a>,
    rounds_to_nearest: bool,
    /// The backends that were compared.
    backends: Vec<BackendKind>,
    /// The codecs that differ, with how often.
    differing: Vec<(&'a str, u64)>,
}

impl<'a> Agreement<'a> {
    /// Sums up the report of a run.
    pub fn of(report: &'a kernels::Report) -> Self {
        let first = report.rows.first();
        Self {
            device: &report.device,
            totals: report.summary(),
            rounds_to_nearest: kernels::all_round_to_nearest(&report.rounding),
            backends: first.map_or_else(Vec::new, |row| row.encode_mismatches.keys().copied().collect()),
            differing: differing(report.rows.iter().map(|row| (row.id.as_str(), row.mismatches()))),
        }
    }
}

/// The graphics pipeline's agreement with the CPU.
#[derive(Serialize)]
pub struct Pipeline<'a> {
    device: &'a DeviceInfo,
    agreed: bool,
    codecs: usize,
    /// The languages of the shaders.
    sources: Vec<BackendKind>,
    /// Texels and vertices.
    compared: u64,
    differing: u64,
    checks: [Check; 4],
    /// The device's conversions of the numbers of formats, by the formats' names.
    conversions: Vec<(&'a str, String)>,
    /// Vectors that changed between vertex and fragment shader beyond what Vulkan allows.
    changed: u64,
    /// The codecs that differ, with how often.
    failed: Vec<(&'a str, u64)>,
    /// Formats that the device does not support, with their uses.
    unsupported: BTreeSet<&'a str>,
}

/// One way through the pipeline.
#[derive(Serialize)]
struct Check {
    what: &'static str,
    compared: u64,
    differing: u64,
}

impl<'a> Pipeline<'a> {
    /// Sums up the report of a run.
    pub fn of(report: &'a Report) -> Self {
        let Report { device, agreed, traits, rows, projections, .. } = report;
        const WHAT: [&str; 4] =
            ["codes in attachments", "normals from textures", "normals from vertices", "codes in the scene"];
        let mut checks = WHAT.map(|what| Check { what, compared: 0, differing: 0 });
        let all = || rows.iter().chain(projections);
        for of_source in all().flat_map(|row| row.checks.values()) {
            for (check, tally) in checks.iter_mut().zip(of_source.all()) {
                check.compared += tally.compared;
                check.differing += tally.differing;
            }
        }
        let in_words = |one: &'a Conversion| (one.name(), one.in_words());
        Self {
            device,
            agreed: *agreed,
            codecs: rows.len(),
            sources: rows.first().map_or_else(Vec::new, |row| row.checks.keys().copied().collect()),
            compared: all().map(Row::compared).sum(),
            differing: all().map(Row::differences).sum(),
            checks,
            conversions: traits.conversions.iter().map(in_words).collect(),
            changed: traits.changed,
            failed: differing(all().map(|row| (row.id.as_str(), row.differences()))),
            unsupported: rows.iter().flat_map(|row| &row.unsupported).map(String::as_str).collect(),
        }
    }
}

/// The rows with any difference.
fn differing<'a>(rows: impl Iterator<Item = (&'a str, u64)>) -> Vec<(&'a str, u64)> {
    rows.filter(|(_, count)| *count > 0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEVICE: &str =
        r#""device": {"index": 0, "name": "n", "kind": "software", "driver": "d", "api_version": "1.3"}"#;

    /// A report of `conform` with one codec that differs is read as it was written.
    #[test]
    fn agreement_is_read_from_conforms_report() {
        let row = |id: &str, [encode, decode]: [u64; 2]| {
            format!(
                r#"{{"id": "{id}", "bits": 16, "vectors": 5, "codes": 6, "mean_deg": 0.1, "max_deg": 0.2,
                "encode_mismatches": {{"rust": {encode}}}, "decode_mismatches": {{"rust": {decode}}}, "examples": []}}"#
            )
        };
        let json = format!(
            r#"{{{DEVICE}, "random_directions": 5, "all_codes_up_to": 8, "glsl_compared": false, "agreed": false,
            "rounding": {{"rust": "down"}}, "rows": [{}, {}]}}"#,
            row("oct16", [2, 1]),
            row("oct32", [0, 0])
        );
        let report = serde_json::from_str(&json).unwrap();
        let Agreement { totals, rounds_to_nearest, backends, differing, .. } = Agreement::of(&report);
        assert_eq!((totals.codecs, totals.vectors, totals.codes, totals.mismatches), (2, 10, 12, 3));
        assert_eq!((rounds_to_nearest, backends), (false, vec![BackendKind::Rust]));
        assert_eq!(differing, [("oct16", 3)]);
    }

    /// A report of `conform pipeline` with one codec that differs in a texture is read as it was written.
    #[test]
    fn the_pipeline_is_read_from_conforms_report() {
        let json = format!(
            r#"{{{DEVICE}, "random_directions": 5, "glsl_compared": false, "agreed": false, "traits": {{"conversions": [
            {{"format": "A2B10G10R10_SNORM_PACK32", "rounding": null, "steps_off": 0.0, "fetched": 4, "inexact": 1}}],
            "interpolated": 9, "flushed": 1, "changed": 0}}, "projections": [], "rows": [{{"id": "oct16", "bits": 16,
            "texel": "R8G8_SNORM", "attribute": "R8G8_SNORM", "unsupported": ["R8G8B8_SNORM as attachment"], "checks": {{"rust": {{
            "attachment": {{"compared": 5, "differing": 0}}, "texture": {{"compared": 6, "differing": 2}},
            "vertex": {{"compared": 7, "differing": 0}}, "scene": {{"compared": 8, "differing": 0}}}}}}, "examples": [],
            "projected": {{"rust": {{"texels": 3, "differing": 2, "max_steps": 1, "unexplained": 1}}}}}}]}}"#
        );
        let report = serde_json::from_str(&json).unwrap();
        let pipeline = Pipeline::of(&report);
        assert_eq!((pipeline.codecs, pipeline.compared, pipeline.differing), (1, 26, 3));
        assert_eq!(pipeline.failed, [("oct16", 3)]);
        assert_eq!((pipeline.checks[1].compared, pipeline.checks[1].differing), (6, 2));
        let expected = ("A2B10G10R10_SNORM", "no attachment; 1 of 4 fetched inexactly".to_owned());
        assert_eq!(pipeline.conversions, [expected]);
    }
}
