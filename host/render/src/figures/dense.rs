//! The trade of unequal precision: what one half of the sphere gains and the other loses.

use super::{Figure, Number, Options, Shown, themed};
use crate::{Error, Result};
use glam::Vec3;
use plotters::coord::Shift;
use plotters::prelude::*;
use rayon::prelude::*;
use unitvec::wrap::Dense;
use unitvec::wrap::dense::DEFAULT_RATIO;
use unitvec::{Codec, Domain, HemiOctPrecise16, OctPrecise16};
use unitvec_run::measure::ErrorStats;
use unitvec_run::sampling::random_directions;

/// Codes in front for each one behind.
const RATIOS: [f32; 13] = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, DEFAULT_RATIO, 8.0, 10.0, 13.0, 16.0];
const LABELS: [f64; 6] = [1.0, 2.0, 4.0, 6.0, 8.0, 16.0];

const SIZE: (u32, u32) = (900, 420);

/// 16 bits over a half of the sphere.
struct Half {
    name: &'static str,
    colour: RGBColor,
    /// Mean errors over random directions, degrees, for each of [`RATIOS`].
    means: Vec<f64>,
    /// Upper bounds of the errors; in front, of directions away from the border.
    bounds: Vec<f64>,
}

/// The mean error over random directions of the half around +Z, or of the other.
fn mean_deg(is_behind: bool, round_trip: impl Fn(Vec3) -> Vec3) -> f64 {
    let directions = random_directions(Domain::Hemisphere, 1).take(100_000).map(Vec3::from_array);
    let directions = directions.map(|v| if is_behind { -v } else { v });
    directions.map(|v| unitvec::angle_deg(v, round_trip(v))).collect::<ErrorStats>().mean_deg()
}

fn halves() -> [Half; 4] {
    let dense = RATIOS.map(|ratio| Dense::<OctPrecise16>::new([0.0, 0.0, 1.0], ratio));
    let means = |is_behind| {
        let mean = |dense: &Dense<OctPrecise16>| mean_deg(is_behind, |v| dense.decode(dense.encode(v)));
        dense.par_iter().map(mean).collect()
    };
    let bounds = |bound: fn(Dense<OctPrecise16>) -> f32| dense.map(bound).map(f64::from).to_vec();
    let flat = |name, colour, mean: f64, bound: f32| {
        let [means, bounds] = [mean, f64::from(bound)].map(|degrees| vec![degrees; RATIOS.len()]);
        Half { name, colour, means, bounds }
    };
    let sphere = mean_deg(false, |v| OctPrecise16::decode(OctPrecise16::encode(v)));
    let hemisphere = mean_deg(false, |v| HemiOctPrecise16::decode(HemiOctPrecise16::encode(v)));
    let [front, behind] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0)];
    let [grey, green] = [RGBColor(150, 150, 150), RGBColor(0, 158, 115)];
    [
        Half {
            name: "in front",
            colour: front,
            means: means(false),
            bounds: bounds(Dense::max_front_error_deg),
        },
        Half { name: "behind", colour: behind, means: means(true), bounds: bounds(Dense::max_error_deg) },
        flat("oct16p", grey, sphere, OctPrecise16::MAX_ERROR_DEG),
        flat("hemioct16p", green, hemisphere, HemiOctPrecise16::MAX_ERROR_DEG),
    ]
}

fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    (caption, degrees): (&str, fn(&Half) -> &[f64]),
    halves: &[Half],
) -> std::result::Result<(), Box<dyn std::error::Error>> {
    let most = halves.iter().flat_map(degrees).fold(0.0, |a, b| f64::max(a, *b));
    let ratios = (1.0..16.0f64).log_scale().with_key_points(LABELS.to_vec());
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(45)
        .build_cartesian_2d(ratios, 0.0..1.1 * most)?;
    chart
        .configure_mesh()
        .x_label_formatter(&|ratio| format!("{ratio:.0}"))
        .x_desc("codes in front for each one behind")
        .light_line_style(WHITE)
        .draw()?;
    for half in halves {
        let (colour, degrees) = (half.colour, degrees(half).iter().copied());
        let points = RATIOS.into_iter().map(f64::from).zip(degrees);
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
            .label(half.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE)
        .border_style(BLACK)
        .draw()?;
    Ok(())
}

fn svg(halves: &[Half]) -> std::result::Result<String, Box<dyn std::error::Error>> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (mean, max) = root.split_horizontally(SIZE.0 / 2);
        panel(&mean, ("Mean error in degrees", |half| &half.means), halves)?;
        panel(&max, ("Bound of the error in degrees", |half| &half.bounds), halves)?;
        root.present()?;
    }
    Ok(text)
}

/// Both halves of the sphere by how many codes the one in front has, beside codecs without a density.
///
/// # Errors
/// [`Error::Chart`] of the plotting library.
pub fn trade(options: &Options) -> Result<Figure> {
    let halves = halves();
    let svg = svg(&halves).map_err(|error| Error::Chart(error.to_string()))?;
    let usual = RATIOS.iter().position(|ratio| *ratio == DEFAULT_RATIO).unwrap_or(0);
    let number = |half: &Half| {
        let of = |what, value| Number::new(format!("{}, {what}, degrees", half.name), value);
        [of("mean error", half.means[usual]), of("bound", half.bounds[usual])]
    };
    let numbers = halves.iter().flat_map(number).collect();
    let caption = format!(
        "oct16p with more codes in front of an axis than behind. The mean in front falls until about 8 codes for one; the bound there \
         rises, and it is of directions away from the border of the halves: at the border it is that behind. hemioct16p has the \
         front alone, soct17 its error everywhere by a bit for the half, which is better where there is one. Numbers are of \
         {DEFAULT_RATIO} codes for one."
    );
    let alt = "Charts of mean error and bound in front and behind, over the ratio of codes";
    let pictures = vec![Shown::new("dense.svg", alt, themed(svg, options.theme))];
    Ok(Figure::new("dense", "Unequal precision", caption, pictures).with(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The map stretches each half's share of oct's sphere, and so its errors, by its lengths from the pole to the border; the
    /// bounds are of the largest.
    #[test]
    fn curves_follow_from_the_map() {
        let [front, behind, sphere, _] = halves();
        for (n, r) in RATIOS.map(f64::from).into_iter().enumerate() {
            let [near, all] = [front.bounds[n], behind.bounds[n]].map(|bound| bound / sphere.bounds[n]);
            assert!((near / ((r + 1.0) / (2.0 * r.sqrt())) - 1.0).abs() < 1e-4, "{r}: {near}");
            assert!((all / r.sqrt() - 1.0).abs() < 1e-4, "{r}: {all}");
            let border = (1.0 - r) / (1.0 + r);
            let share = |is_behind| {
                let directions = random_directions(Domain::Sphere, 2).take(400_000).map(Vec3::from_array);
                let share = directions.filter(|v| (f64::from(v.z) < border) == is_behind);
                let error = |v| unitvec::angle_deg(v, OctPrecise16::decode::<Vec3>(OctPrecise16::encode(v)));
                share.map(error).collect::<ErrorStats>().mean_deg()
            };
            let [gained, lost] = [front.means[n] / share(false), behind.means[n] / share(true)];
            let pole = ((r + 1.0) / 2.0).sqrt();
            assert!(gained > 0.99 * pole / r.sqrt() && gained < 1.01 * near, "{r}: {gained}");
            assert!(lost > 0.99 * pole && lost < 1.01 * all, "{r}: {lost}");
        }
    }
}
