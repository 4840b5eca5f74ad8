//! Rows that no published table has: our own families, other codecs, tangent frames, and rotations.

use super::{Published, Row, Table, meyer};
use crate::Result;
use unitvec_catalogue::{AnyCodec, vectors};
use unitvec_run::backend::Backend;
use unitvec_run::measure::{ErrorStats, measure};

/// The codecs that are in neither the survey's tables nor Meyer's.
pub fn codecs() -> impl Iterator<Item = &'static AnyCodec> {
    let survey: Vec<Published> = [Table::One, Table::Three].into_iter().flat_map(Table::published).collect();
    vectors().iter().filter(move |codec| {
        let mut methods = meyer::METHODS.iter();
        let is_meyers = meyer::WIDTHS.contains(&codec.bits)
            && methods.any(|method| method.codec(codec.bits).is_some_and(|other| other.id == codec.id));
        !is_meyers && survey.iter().all(|row| row.name != codec.survey_name)
    })
}

/// The least mean and the least maximum, perhaps in different rows, of the survey's table 1 at this many bits.
fn best_published(bits: u32) -> Option<(f64, f64)> {
    let rows = Table::One.published().into_iter().filter(|row| row.bits == bits);
    rows.map(|row| (row.mean_error_deg, row.max_error_deg))
        .reduce(|(mean, max), (other_mean, other_max)| (mean.min(other_mean), max.min(other_max)))
}

/// Measures a codec: mean over `count` random directions, maximum by search as for Meyer's table. Published are the
/// least mean and the least maximum of the survey's table 1 with as many bits.
///
/// # Errors
/// Any error of the backend.
pub fn measure_row(backend: &mut dyn Backend, codec: &AnyCodec, count: usize, seed: u64) -> Result<Row> {
    let errors = measure(backend, codec, codec.domain, count, seed)?.normal;
    let (worst, _) = meyer::worst_error(backend, codec, count, seed)?;
    let max_deg = errors.max_deg().max(worst);
    Ok(Row::new("beyond", "best of table 1", codec, &errors, max_deg, best_published(codec.bits).unzip()))
}

/// Errors published for a 32-bit frame, fast oct22 and diamond of 9 bits, over a mesh: mean and maximum of the normal,
/// then of the tangent.
const PUBLISHED_FRAME: [(f64, f64); 2] = [(0.0272, 0.1136), (0.1691, 0.4485)];

/// Measures a codec of frames over `count` random ones: a row for the normals and one for the tangents.
///
/// # Errors
/// Any error of the backend.
pub fn measure_frame(
    backend: &mut dyn Backend,
    codec: &AnyCodec,
    count: usize,
    seed: u64,
) -> Result<[Row; 2]> {
    let errors = measure(backend, codec, codec.domain, count, seed)?;
    let row = |part: &str, errors: &ErrorStats, published: (f64, f64)| {
        let published = (codec.bits == 32).then_some(published).unzip();
        let row = Row::new("frames", part, codec, errors, errors.max_deg(), published);
        Row { least_mean_deg: None, least_max_deg: None, wasted_bits: None, ..row }
    };
    let [normal, tangent] = PUBLISHED_FRAME;
    Ok([row("normal", &errors.normal, normal), row("tangent", &errors.tangent, tangent)])
}

/// Errors of the smallest three components in 32 bits, of 9 bits and a sign each, as the SPZ format has them, over the
/// rotations of 1,803,818 splats: mean and maximum (nianticlabs/spz, pull request 41).
const PUBLISHED_ROTATION: (f64, f64) = (0.0824, 0.2564);

/// The least mean and maximum error known of as many rotations as `bits` bits have codes, in degrees of rotation, as if their space
/// were flat: those of the body-centred cubic lattice, of which no lattice has a lower maximum (Bambah 1954). Rotations are
/// half of the sphere of unit quaternions, of volume pi^2, and turn by twice the angle between quaternions. A cell of volume V
/// reaches sqrt(5) / 4 (2 V)^(1/3); its points are 0.46913 V^(1/3) from its middle on average, which a numerical integral gives.
pub fn rotation_bound_deg(bits: u32) -> (f64, f64) {
    let side = (std::f64::consts::PI.powi(2) / 2f64.powi(bits as i32)).cbrt();
    let (mean, max) = (0.469_13 * side, 5f64.sqrt() / 4.0 * 2f64.cbrt() * side);
    ((2.0 * mean).to_degrees(), (2.0 * max).to_degrees())
}

/// Measures a codec of rotations over `count` random ones.
///
/// # Errors
/// Any error of the backend.
pub fn measure_rotation(backend: &mut dyn Backend, codec: &AnyCodec, count: usize, seed: u64) -> Result<Row> {
    let errors = measure(backend, codec, codec.domain, count, seed)?.normal;
    let published = (codec.bits == 32).then_some(PUBLISHED_ROTATION).unzip();
    let row = Row::new("rotations", "SPZ v3", codec, &errors, errors.max_deg(), published);
    let (mean, max) = rotation_bound_deg(codec.bits);
    let wasted_bits = Some(3.0 * (row.mean_deg / mean).log2());
    Ok(Row { least_mean_deg: Some(mean), least_max_deg: Some(max), wasted_bits, ..row })
}

/// Of the rows measured, the codec of this many bits with a lower maximum than any row of the survey's table 1, as
/// published and as measured here, and a mean no higher, to three standard errors. Of several, the one with the least
/// mean. `None` unless the rows hold both tables.
pub fn beats_the_survey(rows: &[Row], bits: u32) -> Option<&Row> {
    let survey: Vec<&Row> = rows.iter().filter(|row| row.table == "1" && row.bits == bits).collect();
    let published = Table::One.published().into_iter().filter(|row| row.bits == bits);
    let published: Vec<Published> = published.collect();
    if survey.len() < published.len() {
        return None;
    }
    let beats = |row: &&Row| {
        let slack = |other: f64| 3.0 * row.mean_standard_error_deg.hypot(other);
        survey.iter().all(|other| {
            row.max_deg < other.max_deg
                && row.mean_deg <= other.mean_deg + slack(other.mean_standard_error_deg)
        }) && published.iter().all(|other| {
            row.max_deg < other.max_error_deg
                && row.mean_deg <= other.mean_error_deg + slack(row.mean_standard_error_deg)
        })
    };
    let candidates = rows.iter().filter(|row| row.table == "beyond" && row.bits == bits).filter(beats);
    candidates.min_by(|a, b| a.mean_deg.total_cmp(&b.mean_deg))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_codecs_are_not_there() {
        assert!(codecs().all(|codec| !["oct16", "hemioct16", "float16x3", "pp48"].contains(&codec.id)));
    }

    #[test]
    fn the_survey_has_its_best_with_16_bits_in_latlong() {
        assert_eq!(best_published(16), Some((0.30351, 0.56178)));
        assert_eq!(best_published(17), None);
    }
}
