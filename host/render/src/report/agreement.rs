//! A device's agreement with the CPU, as the page shows it.

use crate::conform::{Report, Row};
use minijinja::{Value, context};
use std::collections::BTreeSet;
use unitvec_run::conform as kernels;

/// The agreement of the device's kernels with the CPU, from the report of a run.
pub fn of_kernels(report: &kernels::Report) -> Value {
    let first = report.rows.first();
    let backends = first.map_or_else(Vec::new, |row| row.encode_mismatches.keys().collect());
    context! {
        device => report.device,
        totals => report.summary(),
        rounds_to_nearest => kernels::all_round_to_nearest(&report.rounding),
        backends,
        differing => differing(report.rows.iter().map(|row| (row.id.as_str(), row.mismatches()))),
    }
}

/// The ways through the pipeline, in the order of [`Checks::all`](crate::conform::Checks::all).
const WAYS: [&str; 4] =
    ["codes in attachments", "normals from textures", "normals from vertices", "codes in the scene"];

/// The graphics pipeline's agreement with the CPU, from the report of a run.
pub fn of_pipeline(report: &Report) -> Value {
    let Report { device, agreed, traits, rows, projections, .. } = report;
    let all = || rows.iter().chain(projections);
    let checks = (0..).zip(WAYS).map(|(way, what)| {
        let tallies = || all().flat_map(|row| row.checks.values()).map(|checks| checks.all()[way]);
        let compared = tallies().map(|tally| tally.compared).sum::<u64>();
        context! { what, compared, differing => tallies().map(|tally| tally.differing).sum::<u64>() }
    });
    let conversions = traits.conversions.iter().map(|one| (one.name(), one.in_words()));
    let unsupported: BTreeSet<&String> = rows.iter().flat_map(|row| &row.unsupported).collect();
    context! {
        device,
        agreed,
        codecs => rows.len(),
        sources => rows.first().map_or_else(Vec::new, |row| row.checks.keys().collect()),
        compared => all().map(Row::compared).sum::<u64>(),
        differing => all().map(Row::differences).sum::<u64>(),
        checks => checks.collect::<Vec<_>>(),
        conversions => conversions.collect::<Vec<_>>(),
        changed => traits.changed,
        failed => differing(all().map(|row| (row.id.as_str(), row.differences()))),
        unsupported,
    }
}

fn differing<'a>(rows: impl Iterator<Item = (&'a str, u64)>) -> Vec<(&'a str, u64)> {
    rows.filter(|(_, count)| *count > 0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn shown(value: Value) -> serde_json::Value {
        serde_json::to_value(value).unwrap()
    }

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
            "rounding": {{"rust": "down"}}, "arithmetic": {}, "rows": [{}, {}]}}"#,
            serde_json::to_string(&unitvec_run::conform::Arithmetic::default()).unwrap(),
            row("oct16", [2, 1]),
            row("oct32", [0, 0])
        );
        let shown = shown(of_kernels(&serde_json::from_str(&json).unwrap()));
        let totals = ["codecs", "vectors", "codes", "mismatches"].map(|key| &shown["totals"][key]);
        assert_eq!(totals, [2, 10, 12, 3]);
        assert_eq!((&shown["rounds_to_nearest"], &shown["backends"]), (&json!(false), &json!(["rust"])));
        assert_eq!(shown["differing"], json!([["oct16", 3]]));
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
        let shown = shown(of_pipeline(&serde_json::from_str(&json).unwrap()));
        assert_eq!(["codecs", "compared", "differing"].map(|key| &shown[key]), [1, 26, 3]);
        assert_eq!(shown["failed"], json!([["oct16", 3]]));
        assert_eq!(["compared", "differing"].map(|key| &shown["checks"][1][key]), [6, 2]);
        let expected = json!([["A2B10G10R10_SNORM", "no attachment; 1 of 4 fetched inexactly"]]);
        assert_eq!(shown["conversions"], expected);
    }
}
