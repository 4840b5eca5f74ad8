//! Maps of what blending components does, over the sphere.

use super::canvas::{Cell, Theme};
use super::errors::{explained, heat};
use super::{Figure, Options, Shown, paint};
use glam::DVec3;
use unitvec_lab::accuracy::filtering::{MAPS, Map};

/// Degrees between neighbours.
const APART: f64 = 1.0;

/// Lines through a middle, of which the mean is taken.
const LINES: u32 = 12;

/// The errors of the first and the last colour, degrees.
const SCALE: [f64; 2] = [1e-4, 1.0];

fn colour(degrees: f64) -> paint::Colour {
    heat((degrees / SCALE[0]).log10() / (SCALE[1] / SCALE[0]).log10())
}

fn cell(theme: Theme, map: &Map, side: u32) -> Cell {
    let view = paint::of_domain(map.domain);
    let colour = |v: DVec3| colour(map.midpoint_deg(v, APART, LINES));
    let picture = paint::coarse(paint::disc(theme, side, 2, view, colour));
    Cell { picture, lines: vec![map.name.to_owned()] }
}

/// Maps of the error of the midpoint of two neighbours, for each map of directions.
pub fn filtering(options: &Options) -> Figure {
    let side = if options.small { 130 } else { 360 };
    let blended = MAPS.iter().filter(|map| map.name != "xyz").map(|map| cell(options.theme, map, side));
    let cells: Vec<Cell> = blended.collect();
    let caption = format!(
        "The error of the midpoint of two directions {APART} degree apart whose components are blended and then decoded, to that of \
         the vectors: by the place of the midpoint, the mean over {LINES} lines through it, with components of unbounded precision. \
         Colours go by the logarithm, from {} degrees to {}: yellow lines are where a map tears, green ones where it bends or a \
         sign changes. Maps of the hemisphere are seen along z, others from the side. The components x, y and z have no error.",
        SCALE[0], SCALE[1]
    );
    let alt = "Spheres coloured by the error of blended components at each direction";
    let picture =
        explained(options.theme, (&cells, 6), SCALE.map(|error| format!("{error}\u{b0}")), &caption);
    let pictures = vec![Shown::picture("filtering.png", alt, picture)];
    Figure::new("filtering", "What filtering does to components", caption, pictures)
}
