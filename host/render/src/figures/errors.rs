//! Error maps over the sphere.

use super::canvas::{Canvas, Cell, INK, sheet};
use super::paint::{self, Colour, SAMPLES, from_srgb};
use super::points::{self, in_words};
use super::{Figure, Number, Options, Shown};
use crate::Result;
use image::RgbImage;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Domain};
use unitvec_lab::accuracy::covering_bound_deg;

/// The codecs of error maps if no others are asked for.
const MAPPED: &str = "oct16 oct16p eaoct16p ico16 fib16 latlong16d spherical16 eqarea_ellipse16 oct24 oct24p \
    eaoct24p ico24 latlong24d snorm8x3";

/// The error that has the last colour, as a multiple of the largest that any code of as many bits must have.
pub const LAST_COLOUR: f64 = 1.5;

pub fn heat(part: f64) -> Colour {
    let colour = ViridisRGB.get_color(part.clamp(0.0, 1.0) as f32);
    from_srgb([colour.0, colour.1, colour.2])
}

/// The largest error of the scale for codes of so many bits, degrees.
pub fn scale_deg(bits: u32) -> f64 {
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
    for codec in options.codecs_or(MAPPED)? {
        let lines =
            vec![format!("{}, {} bits", codec.survey_name, codec.bits), in_words(&points::errors(codec)?)];
        cells.push(Cell { picture: error_map(codec, side), lines });
        scales.insert(codec.bits, scale_deg(codec.bits));
    }
    cells.push(Cell { picture: legend(side, &scales), lines: Vec::new() });
    let numbers = scales.iter().map(|(bits, scale)| last_colour(*bits, *scale));
    let caption = format!(
        "The error over the sphere, by colour: dark is none, yellow is {LAST_COLOUR} times the least possible maximum at that \
         number of bits, or more. Codecs of as many bits share one scale."
    );
    let alt = "Spheres coloured by the error of a codec at each direction";
    let pictures = vec![Shown::picture("errors.png", alt, sheet(&cells, 5))];
    Ok(Figure::new("errors", "Error maps", caption, pictures).with(numbers.collect()))
}

/// The error of the last colour as a number of a figure.
pub fn last_colour(bits: u32, scale_deg: f64) -> Number {
    Number::new(format!("last colour, {bits} bits, degrees"), scale_deg)
}

/// The colours, and the errors of the last one by bits.
pub fn legend(side: u32, scales: &BTreeMap<u32, f64>) -> RgbImage {
    let mut canvas = Canvas::new(side, side);
    let top = side / 4;
    canvas.put(&paint::strip(side - 20, 24, heat), 10, top - 12);
    let mut write =
        |text: &str, below: u32| canvas.write(text, (10, (top + below) as i32), side < 300, false, INK);
    write("0", 18);
    write("yellow is", 40);
    for (line, (bits, scale)) in (0..).zip(scales) {
        write(&format!("{bits} bits: {scale:.3} deg"), 58 + 18 * line);
    }
    canvas.0
}
