//! The places of the representable unit vectors (figure 5).

use super::canvas::Cell;
use super::paint::{self, Dots};
use super::{Figure, Number, Options, Shown};
use crate::Result;
use glam::DVec3;
use std::collections::HashSet;
use unitvec_catalogue::AnyCodec;
use unitvec_run::backend::Cpu;
use unitvec_run::measure::{ErrorStats, measure};

/// The panels of figure 5, in its order, and three that came after the survey.
const DISTRIBUTIONS: &str = "stereo_concentric16 eqdist_concentric16 eqarea_concentric16 stereo_ellipse16 \
    stereo16 eqarea16 oct16 eqarea_ellipse16 eqdist_ellipse16 eqdist16 latlong16 spherical16 oct16p latlong16d \
    snorm8x3 ico16 fib16 eaoct16";

/// Codes of so many bits are all decoded.
const ALL_CODES_UP_TO: u32 = 16;
/// Directions whose codes stand for all where there are more.
const DIRECTIONS: usize = 1 << 22;

/// A codec's errors, measured over random directions or rotations.
pub fn errors(codec: &AnyCodec) -> Result<ErrorStats> {
    Ok(measure(&mut Cpu, codec, codec.domain, 100_000, 1)?.normal)
}

/// Errors in a line.
pub fn in_words(errors: &ErrorStats) -> String {
    format!("mean {:.3}\u{b0}, max {:.3}\u{b0}", errors.mean_deg(), errors.max_deg())
}

/// A codec's name, and its errors below it.
pub fn named_lines(codec: &AnyCodec, errors: &ErrorStats) -> Vec<String> {
    let [mean, max] = [("mean", errors.mean_deg()), ("max", errors.max_deg())]
        .map(|(what, value)| format!("{what} {value:.3}\u{b0}"));
    vec![codec.survey_name.to_owned(), mean, max]
}

/// Mean and maximum as numbers of a figure.
pub fn numbers(of: &str, errors: &ErrorStats) -> [Number; 2] {
    [("mean", errors.mean_deg()), ("largest", errors.max_deg())]
        .map(|(what, value)| Number::new(format!("{of}, {what} error, degrees"), value))
}

/// The directions that encoded vectors can have, each once.
fn representable(codec: &AnyCodec) -> Result<Vec<DVec3>> {
    let vectors: Vec<[f32; 3]> = if codec.bits <= ALL_CODES_UP_TO {
        (0..1u32 << codec.bits).map(|code| codec.decode_one([code, 0])).collect()
    } else {
        let mut decoded = Vec::new();
        let directions = unitvec_run::sampling::random_directions(codec.domain, 1);
        unitvec_run::backend::round_trip(&mut Cpu, codec, directions.flatten(), DIRECTIONS, |_, v| {
            decoded.push([v[0], v[1], v[2]]);
        })?;
        decoded
    };
    let mut known = HashSet::new();
    // Adding 0 makes -0 the same as 0.
    let new = vectors.into_iter().filter(|v| known.insert(v.map(|c| (c + 0.0).to_bits())));
    Ok(new.map(|v| DVec3::from_array(v.map(f64::from)).normalize_or_zero()).collect())
}

/// Figure 5: where the representable points lie.
///
/// # Errors
/// The errors of [`measure`], which would be a fault of this crate.
pub fn points(options: &Options) -> Result<Figure> {
    let side = if options.small { 160 } else { 360 };
    let (mut cells, mut numbers) = (Vec::new(), Vec::new());
    for codec in options.codecs_or(DISTRIBUTIONS)? {
        let directions = representable(codec)?;
        let view = paint::of_domain(codec.domain);
        let mut dots = Dots::new(side);
        // Dots of smaller pictures lie closer. More points than 16 bits have share the ink of those, or all would be black.
        let share = (f64::from(1u32 << ALL_CODES_UP_TO) / directions.len() as f64).min(1.0);
        let ink = share * 2.2 * (f64::from(side) / 360.0).powf(1.5);
        directions.iter().filter_map(|v| paint::place(*v, view)).for_each(|place| dots.add(place, ink));
        let lines = named_lines(codec, &errors(codec)?);
        cells.push(Cell { picture: dots.picture(options.theme), lines });
        numbers.push(Number::new(format!("{}, points", codec.id), directions.len() as f64));
    }
    let caption = "The unit vectors that a code can stand for. The more even the grey the better: where points are dense, and \
                   the picture dark, errors are small at the cost of others. All codes have 16 bits but those of snorm8x3, \
                   whose dots are fainter: together they have the ink of 2^16. ico16, fib16 and eaoct16 are not in the survey.";
    let alt = "Spheres covered with dots, one for each codec";
    let shown = Shown::picture("figure5.png", alt, options.theme.captioned_sheet(&cells, 6, caption));
    Ok(Figure::new("5", "Representable unit vectors", caption, vec![shown]).with(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue::find;

    /// oct16's lattice has 255 x 255 points, the border's edges are folded in the middle, and its corners are one.
    #[test]
    fn representable_points_are_counted_once() {
        let count = |id: &str| representable(find(id).unwrap()).unwrap().len();
        assert_eq!(count("oct16"), 253 * 253 + 4 * 127 + 1);
        assert_eq!(count("fib16"), 1 << 16);
    }
}
