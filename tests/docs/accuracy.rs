//! The errors of all codecs, as measured for the docs.

use super::compare;
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Element, Measured, find, frames, rotations, vectors};
use unitvec_lab::accuracy::meyer::{worst_error, worst_length};
use unitvec_lab::accuracy::{Row, Table, chart, covering_bound_deg};
use unitvec_run::backend::Cpu;
use unitvec_run::measure::ErrorStats;
use unitvec_tests::repository;

/// Mean and largest error in degrees.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    pub mean: f64,
    pub max: f64,
}

/// The file of the measured errors, which ships with the catalogue.
const RECORD: &str = "catalogue/data/accuracy.csv";

/// Random directions or frames that the committed means are measured over, and those that a test takes.
const COUNT: usize = 1_000_000;
const FEW: usize = 30_000;

/// The committed errors of a codec: `of` is `direction`, or a frame's `normal` or `tangent`.
pub fn of(id: &str, of: &str) -> Errors {
    let found =
        find(id).unwrap().measured(of).map(|Measured { mean_deg: mean, max_deg: max }| Errors { mean, max });
    found.unwrap_or_else(|| panic!("{id} is not in {RECORD}: cargo xtask renew errors"))
}

/// The errors over random elements: of directions, also of those with z >= 0, or of normals and of tangents.
fn sampled(codec: &AnyCodec, count: usize, seed: u64) -> Vec<(&'static str, ErrorStats)> {
    let over = |domain| unitvec_run::measure::measure(&mut Cpu, codec, domain, count, seed).unwrap();
    let errors = over(codec.domain);
    let parts = codec.element.directions().iter().copied().zip([errors.normal, errors.tangent]);
    let has_above = codec.element == Element::Vector && codec.domain == Domain::Sphere;
    let above = has_above.then(|| ("above", over(Domain::Hemisphere).normal));
    parts.chain(above).collect()
}

/// Measures what the docs state. The maximum of vectors is the largest that a search finds.
#[test]
#[ignore = "`cargo xtask renew errors` runs it: a minute or two"]
fn measure() {
    let mut text = String::from("codec,of,mean_deg,max_deg\n");
    let mut add =
        |id: &str, of: &str, mean: f64, max: f64| text += &format!("{id},{of},{mean:.6e},{max:.6e}\n");
    for codec in &CODECS {
        let worst = match codec.element {
            Element::Vector => {
                let (_, v) = worst_error(&mut Cpu, codec, 1_000_000, 1).unwrap();
                worst_length(&mut Cpu, codec, v).unwrap()
            }
            Element::Frame | Element::Rotation => 0.0,
        };
        for (of, errors) in sampled(codec, COUNT, 1) {
            let worst = if of == "above" { 0.0 } else { worst };
            add(codec.id, of, errors.mean_deg(), errors.max_deg().max(worst));
        }
    }
    let path = repository().join(RECORD);
    unitvec_files::write_file(&path, text.as_bytes()).unwrap();
}

/// Fails unless another, smaller sample agrees with the committed errors: its mean to five standard errors, and its
/// maximum to a hundredth, by which a search can miss the worst place.
fn assert_agrees(id: &str, of_what: &str, fresh: &ErrorStats, bound: f32) {
    let committed = of(id, of_what);
    let Errors { mean, max } = committed;
    let both = format!("{id}: {committed:?} committed, {fresh:?} measured");
    assert!((fresh.mean_deg() - mean).abs() < 5.0 * fresh.standard_error_deg(), "{both}");
    assert!(fresh.max_deg() <= 1.01 * max && max <= f64::from(bound), "{both}");
    // Where a bound holds for the worst length of a cell, or is mostly f32's rounding, no direction comes near it.
    let least = if ["crytek_bfn24", "oct52p", "pp48", "spp48"].contains(&id) { 0.45 } else { 0.8 };
    // Nor where no search looked for the worst.
    let is_near = of_what == "above" || max >= least * f64::from(bound);
    assert!(is_near, "{id}: the bound {bound} is far from {max}");
}

/// The committed errors are those of the codecs, and none but theirs.
#[test]
fn committed_errors_are_what_codecs_have() {
    for codec in &CODECS {
        let fresh = sampled(codec, FEW, 2);
        for ((of, errors), bound) in fresh.iter().zip(codec.max_errors_deg.iter().cycle()) {
            assert_agrees(codec.id, of, errors, *bound);
        }
    }
    let of_sphere = vectors().iter().filter(|codec| codec.domain == Domain::Sphere).count();
    let lines = std::fs::read_to_string(repository().join(RECORD)).unwrap().lines().count();
    assert_eq!(lines - 1, vectors().len() + of_sphere + 2 * frames().len() + rotations().len());
}

/// A precise encoder's mean error is below that of the fast encoder of its format.
#[test]
fn precise_encoders_are_better_than_fast_ones() {
    let fast_of = |id: &str| find(id.strip_suffix('p')?).ok();
    let pairs = vectors().iter().filter_map(|precise| Some([precise, fast_of(precise.id)?]));
    for pair in pairs {
        let [precise, fast] = pair.map(|codec| of(codec.id, "direction").mean);
        assert!(precise < fast, "{}", pair[0].id);
    }
}

/// Docs of `azimuthal`: where +ellipse has lower maxima than in the survey, by more than a sample leaves open, and where not.
#[test]
fn ellipse_is_better_where_the_docs_say() {
    for row in Table::One.published().iter().filter(|row| row.name.contains("+ellipse")) {
        let firsts = [("stereo", 20), ("eqdist", 22), ("eqarea", 32)];
        let (_, first) = firsts.into_iter().find(|(name, _)| row.name.starts_with(name)).unwrap();
        let ratio = of(row.codec().unwrap().id, "direction").max / row.max_error_deg;
        let is_right = if row.bits >= first { ratio < 0.975 } else { (0.98..1.03).contains(&ratio) };
        assert!(is_right, "{}: {ratio}", row.name);
    }
}

/// docs/codecs.md: at 16, 24 and 32 bits `ico` beats the maximum of every row of the survey's table 1, and no row has a
/// lower mean by more than a sample leaves open.
#[test]
fn ico_beats_the_survey() {
    for bits in [16, 24, 32] {
        let ico = of(&format!("ico{bits}"), "direction");
        for row in Table::One.published().iter().filter(|row| row.bits == bits) {
            // A sample leaves a thousandth of the mean open, the survey half a unit of the last digit that it prints.
            let mean = 1.001 * row.mean_error_deg + 0.5e-5;
            assert!(ico.max < row.max_error_deg && ico.mean < mean, "{}", row.name);
        }
    }
}

/// docs/costs.md: half the sphere is worth a bit, by which the mean falls to the square root of a half.
#[test]
fn hemioct_is_worth_a_bit() {
    for bits in [16, 24, 32] {
        let [half, whole] = ["hemioct", "oct"].map(|family| of(&format!("{family}{bits}"), "direction").mean);
        assert!((half / whole / 0.5f64.sqrt() - 1.0).abs() < 0.02, "{bits}: {half} of {whole}");
    }
}

/// The chart's row of a codec.
fn row(codec: &'static AnyCodec) -> Row {
    let errors = of(codec.id, "direction");
    let (bound_mean, bound_max) = covering_bound_deg(codec.bits, codec.domain);
    Row {
        table: "docs",
        id: codec.id,
        survey_name: codec.survey_name.to_owned(),
        bits: codec.bits,
        mean_deg: errors.mean,
        max_deg: errors.max,
        least_mean_deg: Some(bound_mean),
        least_max_deg: Some(bound_max),
        ..Row::default()
    }
}

/// The chart shows the committed errors.
#[test]
fn the_chart_is_current() {
    let rows: Vec<Row> = vectors().iter().map(row).collect();
    compare(&repository().join("docs/errors.svg"), &chart::svg(&rows).unwrap());
}

/// The factor by which a codec's error is above that of the covering bound: mean and maximum.
pub fn over_bound(codec: &AnyCodec) -> [f64; 2] {
    let (mean, max) = covering_bound_deg(codec.bits, Domain::Sphere);
    let errors = of(codec.id, "direction");
    [errors.mean / mean, errors.max / max]
}
