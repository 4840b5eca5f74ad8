//! Error against cost as a chart. A codec on the front has a name: none of its size has less of one without more of the
//! other.

use super::{KernelKind, Report, Source};
use crate::accuracy::chart::degrees;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;
use std::ops::RangeInclusive;
use unitvec_catalogue::{AnyCodec, Domain, Operation, vectors};

/// Codecs that take about as much room: their bytes, a label and a colour.
type Size = (RangeInclusive<usize>, &'static str, RGBColor);

const SIZES: [Size; 4] = [
    (1..=2, "up to 16 bits", RGBColor(213, 94, 0)),
    (3..=3, "up to 24 bits", RGBColor(0, 158, 115)),
    (4..=4, "up to 32 bits", RGBColor(0, 114, 178)),
    (5..=8, "up to 64 bits", RGBColor(204, 121, 167)),
];

/// A codec in the chart.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// The codec.
    pub codec: &'static AnyCodec,
    /// The codec's [cost](Report::cost).
    pub cost: f64,
    /// Upper bound of the codec's error, degrees.
    pub error_deg: f64,
}

/// The codecs of any direction that decode to unit vectors, by cost; those that the report has, from GLSL.
pub fn points(report: &Report, operation: Operation) -> Vec<Point> {
    let codecs = vectors().iter().filter(|codec| codec.is_unit && codec.domain == Domain::Sphere);
    let point = |codec: &'static AnyCodec| {
        let cost = report.cost(report.row(codec.id, operation, Source::Glsl)?)?;
        Some(Point { codec, cost, error_deg: f64::from(codec.max_error_deg()) })
    };
    let mut points: Vec<Point> = codecs.filter_map(point).collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.error_deg.total_cmp(&b.error_deg)));
    points
}

/// The Pareto front of points that are sorted by cost: no point that costs less is as fine.
pub fn front(points: &[Point]) -> Vec<Point> {
    let mut front: Vec<Point> = Vec::new();
    for point in points {
        if front.last().is_none_or(|last| point.error_deg < last.error_deg) {
            front.push(*point);
        }
    }
    front
}

const SIZE: (u32, u32) = (900, 1000);

/// Degrees from the lower end to the upper.
const DEGREES: std::ops::Range<f64> = 2e-6..30.0;

/// Costs with a number below them.
const COST_LABELS: [f64; 17] = [
    10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0, 100.0, 150.0, 200.0, 300.0, 400.0, 600.0, 800.0, 1200.0,
    1600.0, 2400.0,
];

/// Draws an SVG of two panels, decoding and encoding.
///
/// # Errors
/// Any error of the plotting library.
pub fn svg(report: &Report) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (decode, encode) = root.split_vertically(SIZE.1 / 2);
        let gpu = report.subject();
        for (area, operation, name) in
            [(&decode, Operation::Decode, "Decoding"), (&encode, Operation::Encode, "Encoding")]
        {
            let caption = format!("{name}: bound of the error over cost on {gpu}");
            let cost = match report.kernel {
                KernelKind::Four => "inverse throughput: cycles for 64 invocations of four vectors",
                KernelKind::One => "instructions of one vector",
                KernelKind::Measured => "nanoseconds of one vector",
            };
            draw(area, (&caption, cost), &points(report, operation))?;
        }
        root.present()?;
    }
    Ok(text)
}

fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    (caption, cost): (&str, &str),
    points: &[Point],
) -> Result<(), Box<dyn Error>> {
    let range = costs(points);
    let labels: Vec<f64> = COST_LABELS.into_iter().filter(|cost| range.contains(cost)).collect();
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(60)
        .build_cartesian_2d(range.log_scale().with_key_points(labels), DEGREES.log_scale())?;
    chart
        .configure_mesh()
        .x_labels(COST_LABELS.len())
        .x_label_formatter(&|cost| format!("{cost:.0}"))
        .x_desc(cost)
        .y_label_formatter(&degrees)
        .y_desc("degrees")
        .light_line_style(WHITE)
        .draw()?;
    let mut labels = Vec::new();
    for (bytes, size, colour) in SIZES {
        let members: Vec<Point> =
            points.iter().filter(|point| bytes.contains(&point.codec.bytes)).copied().collect();
        let front = front(&members);
        chart.draw_series(
            members.iter().map(|point| Circle::new(place(point), 2, colour.mix(0.4).filled())),
        )?;
        chart.draw_series(LineSeries::new(steps(&front), colour))?;
        chart
            .draw_series(front.iter().map(|point| Circle::new(place(point), 4, colour.filled())))?
            .label(size)
            .legend(move |(x, y)| Circle::new((x + 8, y), 4, colour.filled()));
        labels.extend(front.iter().map(|point| (chart.backend_coord(&place(point)), point.codec.id, colour)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE)
        .border_style(BLACK.mix(0.3))
        .draw()?;
    write(area, labels)
}

fn place(point: &Point) -> (f64, f64) {
    (point.cost, point.error_deg)
}

/// The line of a front: along it, anything above and to the right of a point is worse.
fn steps(front: &[Point]) -> Vec<(f64, f64)> {
    let corners = front.windows(2).flat_map(|pair| [place(&pair[0]), (pair[1].cost, pair[0].error_deg)]);
    corners.chain(front.last().map(place)).collect()
}

/// A range with room around the points' costs.
fn costs(points: &[Point]) -> std::ops::Range<f64> {
    let all = points.iter().map(|point| point.cost);
    let (least, most) =
        all.fold((f64::INFINITY, 1.0f64), |(least, most), cost| (least.min(cost), most.max(cost)));
    0.8 * least.min(most)..1.4 * most
}

const LETTER: (i32, i32) = (7, 12);

/// A rectangle: left, top, right, bottom.
type Area = [i32; 4];

/// Writes names beside their points, each at the first of some places where it covers no other and no point.
fn write(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    labels: Vec<((i32, i32), &'static str, RGBColor)>,
) -> Result<(), Box<dyn Error>> {
    let (left, top) = area.get_base_pixel();
    let mut taken: Vec<Area> = labels.iter().map(|((x, y), ..)| [x - 4, y - 4, x + 4, y + 4]).collect();
    for ((x, y), name, colour) in labels {
        let width = LETTER.0 * name.len() as i32;
        let around = |(dx, dy): (i32, i32)| {
            let from = if dx < 0 { x + dx - width } else { x + dx };
            [from, y + dy - LETTER.1 / 2, from + width, y + dy + LETTER.1 / 2]
        };
        let places = [-9, 9, -18, 18, -27, 27, -36, 36].map(|dy| [(4, dy), (-4, dy)]);
        let is_free = |place: &Area| !taken.iter().any(|other| overlap(place, other));
        let found = places.as_flattened().iter().map(|place| around(*place)).find(is_free);
        let place = found.unwrap_or_else(|| around((4, -9)));
        taken.push(place);
        let style = ("sans-serif", 12).into_font().color(&colour).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(name, (place[0] - left, (place[1] + place[3]) / 2 - top), style))?;
    }
    Ok(())
}

fn overlap(a: &Area, b: &Area) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A front leaves out points that are coarser than one that costs no more.
    #[test]
    fn fronts_fall() {
        let point = |cost, error_deg| Point { codec: &vectors()[0], cost, error_deg };
        let points = [point(1.0, 5.0), point(1.0, 6.0), point(2.0, 5.0), point(3.0, 1.0), point(4.0, 2.0)];
        let costs: Vec<f64> = front(&points).iter().map(|point| point.cost).collect();
        assert_eq!(costs, [1.0, 3.0]);
    }
}
