//! Error maps over the sphere.

use super::canvas::{Cell, GAP, Theme, Type};
use super::paint::{self, Colour, SAMPLES, from_srgb};
use super::points;
use super::{Figure, Number, Options, Shown};
use crate::Result;
use image::RgbImage;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Domain};
use unitvec_lab::accuracy::covering_bound_deg;

/// The codecs of error maps if no others are asked for.
const MAPPED: &str = "oct16 oct16p eaoct16p ico16 latlong16d spherical16 fib16 oct24 oct24p eaoct24p ico24 latlong24d \
    spherical24 snorm8x3";

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

fn error_map(theme: Theme, codec: &'static AnyCodec, side: u32) -> RgbImage {
    let scale = scale_deg(codec.bits);
    let view = paint::of_domain(codec.domain);
    paint::coarse(paint::disc(theme, side, SAMPLES, view, |v| {
        let v = v.as_vec3().to_array();
        heat(unitvec::angle_deg(v, codec.decode_one(codec.encode_one(v))) / scale)
    }))
}

/// Error maps of codecs over the sphere.
///
/// # Errors
/// An unknown codec.
pub fn errors(options: &Options) -> Result<Figure> {
    let side = if options.small { 165 } else { 360 };
    let (mut cells, mut scales) = (Vec::new(), BTreeMap::new());
    for codec in options.codecs_or(MAPPED)? {
        let lines = points::named_lines(codec, &points::errors(codec)?);
        cells.push(Cell { picture: error_map(options.theme, codec, side), lines });
        scales.insert(codec.bits, scale_deg(codec.bits));
    }
    let numbers = scales.iter().map(|(bits, scale)| last_colour(*bits, *scale));
    let caption = format!(
        "The error over the sphere, by colour, of codecs of 16 bits above and 24 below: dark is none, yellow is {LAST_COLOUR} times the least possible maximum at that \
         number of bits, or more. Codecs of as many bits share one scale."
    );
    let alt = "Spheres coloured by the error of a codec at each direction";
    let pictures = vec![Shown::picture(
        "errors.png",
        alt,
        explained(options.theme, (&cells, 7), ends(&scales), &caption),
    )];
    Ok(Figure::new("errors", "Error maps", caption, pictures).with(numbers.collect()))
}

/// The error of the last colour as a number of a figure.
pub fn last_colour(bits: u32, scale_deg: f64) -> Number {
    Number::new(format!("last colour, {bits} bits, degrees"), scale_deg)
}

/// The errors of the first colour and, by bits, of the last one, as [`explained`] takes them.
pub fn ends(scales: &BTreeMap<u32, f64>) -> [String; 2] {
    let last = scales.iter().map(|(bits, scale)| format!("{bits} bits: {scale:.3}\u{b0}"));
    ["0".to_owned(), last.collect::<Vec<_>>().join(", ")]
}

/// A sheet of maps with their colours between the errors of the first and the last one, and a caption below it.
pub fn explained(
    theme: Theme,
    (cells, columns): (&[Cell], u32),
    [first, last]: [String; 2],
    caption: &str,
) -> RgbImage {
    let sheet = theme.sheet(cells, columns);
    let letters = Type::of_width(sheet.width());
    let (height, width) = (letters.line() as u32, sheet.width() / 3);
    let mut canvas = theme.blank(sheet.width(), height + GAP);
    let left = 2 * GAP + letters.width(&first);
    canvas.put(&paint::strip(width, height, heat), left, 0);
    for (text, left) in [(first, GAP), (last, left + width + GAP)] {
        canvas.write(&text, (left as f32, 0.0), letters, false, theme.ink);
    }
    theme.captioned(&theme.stacked(&[&sheet, &canvas.0]), caption)
}
