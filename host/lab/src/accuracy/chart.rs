//! The errors of `unitvec accuracy` as a chart: against bits, beside the covering bound.

use super::{Row, covering_bound_deg};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use unitvec_catalogue::Domain;

/// Families with a colour; the others are grey.
const COLOURED: [(&str, &str, RGBColor); 8] = [
    ("oct", "oct", RGBColor(230, 159, 0)),
    ("octp", "oct, precise", RGBColor(213, 94, 0)),
    ("latlongd", "latlong, precise decode", RGBColor(86, 180, 233)),
    ("eaoctp", "equal-area oct, precise", RGBColor(204, 121, 167)),
    ("fib", "Fibonacci", RGBColor(0, 158, 115)),
    ("hexcube", "hexagons on a cube", RGBColor(120, 60, 20)),
    ("ico", "icosahedron", RGBColor(0, 114, 178)),
    ("hemioct", "hemi-oct (z >= 0, against the hemisphere's bound)", RGBColor(170, 150, 50)),
];

const SIZE: (u32, u32) = (900, 1100);

/// Bits from the left end to the right.
const BITS: std::ops::Range<f64> = 7.0..53.0;

/// The usual bits where errors are multiples of the bound's: wider codes have f32's errors besides their own.
const USUAL_BITS: std::ops::Range<f64> = 7.0..34.0;

/// The value that a panel shows of a row.
type Value = fn(&Row) -> Option<f64>;

/// An SVG of three panels: the maximum error in degrees, and the mean and maximum error as multiples of the bound's.
///
/// # Errors
/// Any error of the plotting library.
pub fn svg(rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let families = families(rows);
        let (top, rest) = root.split_vertically(420);
        let (mean, max) = rest.split_vertically(340);
        draw_degrees(&top, &families)?;
        let ratio = "as a multiple of the covering bound";
        draw_ratio(&mean, &format!("Mean error, {ratio}"), &families, |row| {
            Some(row.mean_deg / row.least_mean_deg?)
        })?;
        draw_ratio(&max, &format!("Maximum error, {ratio}"), &families, |row| {
            Some(row.max_deg / row.least_max_deg?)
        })?;
        root.present()?;
    }
    Ok(text)
}

/// A power of ten at an axis. The plotting library computes it with the system's `powf`, which is inexact on Windows.
pub(crate) fn degrees(value: &f64) -> String {
    format!("{:?}", format!("{value:.6e}").parse().unwrap_or(*value))
}

/// Rows by family, which is the identifier without its digits; by bits, each codec once.
fn families(rows: &[Row]) -> BTreeMap<String, Vec<&Row>> {
    let mut families: BTreeMap<String, Vec<&Row>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.least_max_deg.is_some()) {
        let family = row.id.replace(|c: char| c.is_ascii_digit(), "");
        let members = families.entry(family).or_default();
        if members.iter().all(|other| other.id != row.id) {
            members.push(row);
        }
    }
    for members in families.values_mut() {
        members.sort_by_key(|row| row.bits);
    }
    families
}

fn draw_degrees(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    families: &BTreeMap<String, Vec<&Row>>,
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption("Maximum error in degrees over bits", ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(35)
        .y_label_area_size(60)
        .build_cartesian_2d(BITS, (1e-6..100.0).log_scale())?;
    chart
        .configure_mesh()
        .x_label_formatter(&|bits| format!("{bits:.0}"))
        .x_desc("bits")
        .y_label_formatter(&degrees)
        .y_desc("degrees")
        .light_line_style(WHITE)
        .draw()?;
    let bound = (7..=52).map(|bits| (f64::from(bits), covering_bound_deg(bits, Domain::Sphere).1));
    chart
        .draw_series(LineSeries::new(bound, BLACK.stroke_width(2)))?
        .label("covering bound")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 16, y)], BLACK.stroke_width(2)));
    for (family, members) in drawn_last_if_coloured(families) {
        let points: Vec<(f64, f64)> = members.iter().map(|row| (f64::from(row.bits), row.max_deg)).collect();
        let colour = colour_of(family);
        chart.draw_series(LineSeries::new(points.iter().copied(), colour.1))?;
        let series =
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 3, colour.1.filled())))?;
        if let Some(label) = colour.0 {
            series.label(label).legend(move |(x, y)| Circle::new((x + 8, y), 3, colour.1.filled()));
        }
    }
    chart
        .draw_series(std::iter::empty::<Circle<(f64, f64), i32>>())?
        .label("the survey's other families")
        .legend(|(x, y)| Circle::new((x + 8, y), 3, OTHERS.filled()));
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE)
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}

fn draw_ratio(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    caption: &str,
    families: &BTreeMap<String, Vec<&Row>>,
    value: Value,
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(35)
        .y_label_area_size(60)
        .build_cartesian_2d(USUAL_BITS, 0.95..2.25)?;
    chart
        .configure_mesh()
        .x_label_formatter(&|bits| format!("{bits:.0}"))
        .x_desc("bits")
        .light_line_style(WHITE)
        .draw()?;
    chart.draw_series(LineSeries::new(
        [(USUAL_BITS.start, 1.0), (USUAL_BITS.end, 1.0)],
        BLACK.stroke_width(2),
    ))?;
    for (family, members) in drawn_last_if_coloured(families) {
        let points = members.iter().filter_map(|row| Some((f64::from(row.bits), value(row)?)));
        let points: Vec<(f64, f64)> =
            points.filter(|(bits, ratio)| USUAL_BITS.contains(bits) && *ratio < 2.25).collect();
        let (_, colour) = colour_of(family);
        chart.draw_series(LineSeries::new(points.iter().copied(), colour))?;
        chart.draw_series(points.iter().map(|point| Circle::new(*point, 3, colour.filled())))?;
    }
    Ok(())
}

const OTHERS: RGBColor = RGBColor(200, 200, 200);

/// The label, of families that have one, and the colour.
fn colour_of(family: &str) -> (Option<&'static str>, RGBColor) {
    let found = COLOURED.iter().find(|(name, ..)| *name == family);
    found.map_or((None, OTHERS), |(_, label, colour)| (Some(*label), *colour))
}

/// The grey ones first, so that they hide nothing.
fn drawn_last_if_coloured<'a>(
    families: &'a BTreeMap<String, Vec<&'a Row>>,
) -> impl Iterator<Item = (&'a String, &'a Vec<&'a Row>)> {
    let grey = families.iter().filter(|(family, _)| colour_of(family).0.is_none());
    grey.chain(families.iter().filter(|(family, _)| colour_of(family).0.is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_round_numbers() {
        let labels = [1.0000000000000006e-5, 1e-4, 0.1, 10.000000000000007].map(|value| degrees(&value));
        assert_eq!(labels, ["1e-5", "0.0001", "0.1", "10.0"]);
    }
}
