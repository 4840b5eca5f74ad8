//! The survey's error tables, measured again beside the published figures and the bound that no code can beat.

pub mod beyond;
pub mod blocks;
pub mod chart;
pub mod filtering;
pub mod meyer;

use crate::Result;
use serde::{Deserialize, Serialize};
use unitvec_catalogue::{AnyCodec, Domain, vectors};
use unitvec_oracle::survey;
use unitvec_run::backend::Backend;
use unitvec_run::measure::{ErrorStats, measure};
use unitvec_run::sampling;

/// A table of the survey (Cigolle et al. 2014).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Table 1: all representations, over the sphere.
    One,
    /// Table 3: hemi-oct and its rivals, over the hemisphere z >= 0.
    Three,
}

impl Table {
    /// The table's name in reports, the directions its errors are measured over, and its rows as CSV.
    fn parts(self) -> (&'static str, Domain, &'static str) {
        match self {
            Self::One => ("1", Domain::Sphere, survey::TABLE_1),
            Self::Three => ("3", Domain::Hemisphere, survey::TABLE_3),
        }
    }

    /// The directions its errors are measured over.
    pub fn domain(self) -> Domain {
        self.parts().1
    }

    /// The table's rows as published, in the survey's order: by decreasing maximum error.
    pub fn published(self) -> Vec<Published> {
        let (.., text) = self.parts();
        // The files are part of the program, and a test reads them whole.
        csv::Reader::from_reader(text.as_bytes()).deserialize().filter_map(|row| row.ok()).collect()
    }
}

/// A row of the survey's tables 1 and 3.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Published {
    /// The survey's name of the representation.
    pub name: String,
    /// Bits.
    pub bits: u32,
    /// Mean error, degrees.
    pub mean_error_deg: f64,
    /// Maximum error, degrees.
    pub max_error_deg: f64,
    /// `±` where float64 intermediates or other compiler flags gave the survey a substantially lower mean.
    #[serde(default)]
    pub mean_flag: String,
    /// `±` where they gave a substantially lower maximum.
    #[serde(default)]
    pub max_flag: String,
}

impl Published {
    /// The codec of this row, if it is in the catalogue.
    pub fn codec(&self) -> Option<&'static AnyCodec> {
        vectors().iter().find(|codec| codec.survey_name == self.name)
    }
}

/// A row measured.
#[derive(Clone, Debug, Default, Serialize, schemars::JsonSchema)]
pub struct Row {
    /// Table it belongs to.
    pub table: &'static str,
    /// Codec identifier.
    pub id: &'static str,
    /// The published name.
    pub survey_name: String,
    /// Bits.
    pub bits: u32,
    /// Mean error, degrees.
    pub mean_deg: f64,
    /// Maximum error, degrees.
    pub max_deg: f64,
    /// The published mean error, degrees; Meyer et al. give none.
    pub survey_mean_deg: Option<f64>,
    /// The published maximum error, degrees; Meyer's bound; `None` at bits without a published figure.
    pub survey_max_deg: Option<f64>,
    /// The least mean error of as many codes, that of a hexagonal covering, of rotations a body-centred one, degrees; none for
    /// frames.
    pub least_mean_deg: Option<f64>,
    /// The least maximum error of as many codes, degrees.
    pub least_max_deg: Option<f64>,
    /// Mean error with float64 intermediates, degrees, where that was asked for.
    pub float64_mean_deg: Option<f64>,
    /// Maximum error with float64 intermediates, degrees, where that was asked for.
    pub float64_max_deg: Option<f64>,
    /// Bits wasted: with so many fewer the covering has this mean error.
    pub wasted_bits: Option<f64>,
    /// Standard error of the mean, degrees.
    pub mean_standard_error_deg: f64,
    /// `±` where the survey marks its mean error, or empty.
    pub survey_mean_flag: String,
    /// `±` where the survey marks its maximum error, or empty.
    pub survey_max_flag: String,
}

/// Mean and maximum error in degrees that no code of `bits` bits for the domain can beat.
///
/// In the plane the best covering is hexagonal: each code takes a hexagon of area A = (area of the domain) / 2^bits,
/// whose corners are R = sqrt(2 A / (3 sqrt 3)) from its middle and whose points are R (1/3 + ln 3 / 4) away on
/// average. On the sphere hexagons alone do not close, so the bound is approached and not reached.
pub fn covering_bound_deg(bits: u32, domain: Domain) -> (f64, f64) {
    let area = match domain {
        Domain::Sphere => 4.0,
        Domain::Hemisphere => 2.0,
    } * std::f64::consts::PI;
    let cell = area / 2f64.powi(bits as i32);
    let radius = (2.0 * cell / (3.0 * 3f64.sqrt())).sqrt();
    let mean = radius * (1.0 / 3.0 + 3f64.ln() / 4.0);
    (mean.to_degrees(), radius.to_degrees())
}

/// The survey's second measurement: like [`measure`], with float64 from the f32 input to the angle. The derivation is
/// the one that the tests hold the codecs against, and shares no code with them. `None` for a codec without one.
pub fn measure_float64(codec: &AnyCodec, domain: Domain, count: usize, seed: u64) -> Option<(f64, f64)> {
    let round_trip = unitvec_oracle::round_trip(codec.id)?;
    let (mut sum, mut max) = (0.0, 0.0f64);
    for vector in sampling::random_directions(domain, seed).take(count) {
        let vector = vector.map(f64::from);
        let error = unitvec_oracle::angle_deg(vector, round_trip(vector));
        sum += error;
        max = max.max(error);
    }
    Some((sum / count.max(1) as f64, max))
}

/// Measures a row of a table.
///
/// # Errors
/// Any error of the backend.
pub fn measure_row(
    backend: &mut dyn Backend,
    table: Table,
    published: &Published,
    codec: &AnyCodec,
    count: usize,
    seed: u64,
) -> Result<Row> {
    let (name, domain, _) = table.parts();
    let errors = measure(backend, codec, domain, count, seed)?.normal;
    let published_errors = (Some(published.mean_error_deg), Some(published.max_error_deg));
    let row = Row::new(name, &published.name, codec, &errors, errors.max_deg(), published_errors);
    let (survey_mean_flag, survey_max_flag) = (published.mean_flag.clone(), published.max_flag.clone());
    Ok(Row { survey_mean_flag, survey_max_flag, ..row })
}

/// Measures a row of Meyer's table: mean over `count` random directions, maximum by search.
///
/// # Errors
/// Any error of the backend.
pub fn measure_meyer_row(
    backend: &mut dyn Backend,
    method: &meyer::Method,
    codec: &AnyCodec,
    count: usize,
    seed: u64,
) -> Result<Row> {
    let bound = method.bound(f64::from(codec.bits)).to_degrees();
    let row = beyond::measure_row(backend, codec, count, seed)?;
    let (survey_mean_deg, survey_max_deg) = (None, Some(bound));
    Ok(Row { table: "meyer", survey_name: method.name.to_owned(), survey_mean_deg, survey_max_deg, ..row })
}

impl Row {
    fn new(
        table: &'static str,
        name: &str,
        codec: &AnyCodec,
        errors: &ErrorStats,
        max_deg: f64,
        (survey_mean_deg, survey_max_deg): (Option<f64>, Option<f64>),
    ) -> Self {
        let mean_deg = errors.mean_deg();
        let (least_mean_deg, least_max_deg) = covering_bound_deg(codec.bits, codec.domain);
        Self {
            table,
            id: codec.id,
            survey_name: name.to_owned(),
            bits: codec.bits,
            mean_deg,
            max_deg,
            mean_standard_error_deg: errors.standard_error_deg(),
            survey_mean_deg,
            survey_max_deg,
            least_mean_deg: Some(least_mean_deg),
            least_max_deg: Some(least_max_deg),
            // The bound's errors go as 2^(-bits / 2).
            wasted_bits: Some(2.0 * (mean_deg / least_mean_deg).log2()),
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The figures of the bound at 16, 24 and 32 bits, worked out by hand.
    #[test]
    fn the_bound_at_the_usual_widths() {
        for (bits, mean, max) in
            [(16, 0.29926, 0.49222), (24, 0.018704, 0.030764), (32, 0.0011690, 0.0019228)]
        {
            let (bound_mean, bound_max) = covering_bound_deg(bits, Domain::Sphere);
            assert!((bound_mean / mean - 1.0).abs() < 5e-5, "{bound_mean}");
            assert!((bound_max / max - 1.0).abs() < 5e-5, "{bound_max}");
        }
    }

    /// All rows are read, 75 and 10, and the marks of table 1.
    #[test]
    fn the_published_tables_are_whole() {
        assert_eq!(Table::One.published().len(), 75);
        assert_eq!(Table::Three.published().len(), 10);
        let has_mark = |flag: fn(&Published) -> &String| {
            Table::One.published().iter().filter(|row| flag(row) == "±").count()
        };
        assert_eq!([has_mark(|row| &row.mean_flag), has_mark(|row| &row.max_flag)], [2, 11]);
        let first = &Table::One.published()[0];
        assert_eq!((first.name.as_str(), first.bits, first.max_error_deg), ("CrytekBFN24", 24, 4.7826));
    }
}
