//! Error maps over the sphere.

use super::canvas::{Canvas, Cell, INK, sheet};
use super::paint::{self, Colour, SAMPLES, from_srgb};
use super::points::MEASURED;
use super::{Figure, Number, Options, Shown};
use crate::Result;
use image::RgbImage;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Domain};
use unitvec_lab::accuracy::covering_bound_deg;
use unitvec_run::backend::Cpu;
use unitvec_run::measure::measure;

/// The codecs of error maps if no others are asked for.
const MAPPED: [&str; 14] = [
    "oct16",
    "oct16p",
    "eaoct16p",
    "ico16",
    "fib16",
    "latlong16d",
    "spherical16",
    "eqarea_ellipse16",
    "oct24",
    "oct24p",
    "eaoct24p",
    "ico24",
    "latlong24d",
    "snorm8x3",
];

/// The error that has the last colour, as a multiple of the largest that any code of as many bits must have.
const LAST_COLOUR: f64 = 1.5;

fn heat(part: f64) -> Colour {
    let colour = ViridisRGB.get_color(part.clamp(0.0, 1.0) as f32);
    from_srgb([colour.0, colour.1, colour.2])
}

/// The largest error of the scale for codes of so many bits, degrees.
fn scale_deg(bits: u32) -> f64 {
    LAST_COLOUR * covering_bound_deg(bits, Domain::Sphere).1
}

fn error_map(codec: &'static AnyCodec, side: u32) -> RgbImage {
    let scale = scale_deg(codec.bits);
    let view = paint::of_domain(codec.domain);
    paint::disc(side, SAMPLES, view, |v| {
        let v = v.as_vec3().to_array();
        heat(unitvec::angle_deg(v, codec.decode_one(codec.encode_one(v))) / scale)
    })
}

/// Error maps of codecs over the sphere.
///
/// # Errors
/// An unknown codec.
pub fn errors(options: &Options) -> Result<Figure> {
    let side = if options.small { 150 } else { 360 };
    let (mut cells, mut scales) = (Vec::new(), BTreeMap::new());
    for codec in options.codecs_or(&MAPPED)? {
        let errors = measure(&mut Cpu, codec, codec.domain, MEASURED, 1)?.normal;
        let lines = vec![
            format!("{}, {} bits", codec.survey_name, codec.bits),
            format!("mean {:.3} max {:.3} deg", errors.mean_deg(), errors.max_deg()),
        ];
        cells.push(Cell { picture: error_map(codec, side), lines });
        scales.insert(codec.bits, scale_deg(codec.bits));
    }
    let shown: Vec<String> =
        scales.iter().map(|(bits, scale)| format!("{bits} bits: {scale:.3} deg")).collect();
    let bar = Canvas({
        let mut bar = Canvas::new(side, side);
        let top = side / 4;
        bar.put(&paint::strip(side - 20, 24, heat), 10, top - 12);
        let small = side < 300;
        let mut write =
            |text: &str, below: u32| bar.write(text, (10, (top + below) as i32), small, false, INK);
        write("0", 18);
        write("yellow is", 40);
        for (line, text) in (0..).zip(&shown) {
            write(text, 58 + 18 * line);
        }
        bar.0
    });
    cells.push(Cell { picture: bar.0, lines: Vec::new() });
    let numbers =
        scales.iter().map(|(bits, scale)| Number::new(&format!("last colour, {bits} bits, degrees"), *scale));
    let numbers: Vec<Number> = numbers.collect();
    let caption = format!(
        "The error over the sphere, by colour: dark is none, yellow is {LAST_COLOUR} times the least possible maximum at that \
         number of bits, or more. Codecs of as many bits share one scale."
    );
    let alt = "Spheres coloured by the error of a codec at each direction";
    Ok(Figure::new(
        "errors",
        "Error maps",
        caption,
        vec![Shown::picture("errors.png", alt, sheet(&cells, 5))],
    )
    .with(numbers))
}
