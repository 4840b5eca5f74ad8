//! The directions of the precise encoder's rounding in oct (figure 4).

use super::canvas::Cell;
use super::paint::{self, Colour};
use super::{Figure, Number, Options, Shown};
use crate::Result;
use glam::DVec2;
use image::RgbImage;
use rayon::prelude::*;
use unitvec_catalogue::{AnyCodec, find};
use unitvec_oracle::{Oct, Oracle};

/// The codec of the survey's picture, then others by their bits.
const MAIN: &str = "oct24p";
const OTHERS: [&str; 8] = ["oct8p", "oct12p", "oct16p", "oct18p", "oct20p", "oct22p", "oct24p", "oct32p"];

/// The vector of a place of the square, and by how much of the square's height encoding moves it up.
fn rise(codec: &AnyCodec, place: DVec2) -> f64 {
    let v = Oct::direction(place.to_array()).map(|c| c as f32);
    let y = |v: [f32; 3]| Oct::position(v.map(f64::from))[1];
    y(codec.decode_one(codec.encode_one(v))) - y(v)
}

/// Black where y is rounded down, white where it is rounded up, at the middle of each pixel.
fn map(codec: &AnyCodec, side: u32) -> RgbImage {
    paint::square(side, 1, |place| if rise(codec, place) > 0.0 { Colour::ONE } else { Colour::ZERO })
}

/// The share of vectors, spread evenly over the square, that the precise encoder gives another code than the nearest.
fn moved(precise: &AnyCodec, fast: &AnyCodec) -> f64 {
    const SIDE: u32 = 500;
    let differs = |n: &u32| {
        // Off the pixels' middles, which lie on lattice points of some widths.
        let place = DVec2::new(f64::from(n % SIDE) + 0.382, f64::from(n / SIDE) + 0.618);
        let v = Oct::direction((2.0 / f64::from(SIDE) * place - 1.0).to_array()).map(|c| c as f32);
        precise.encode_one(v) != fast.encode_one(v)
    };
    let differing = (0..SIDE * SIDE).into_par_iter().filter(differs).count();
    differing as f64 / f64::from(SIDE * SIDE)
}

/// Figure 4: the rounding of y over the square, and as a function of bits.
///
/// # Errors
/// [`UnknownCodec`](unitvec_catalogue::UnknownCodec), which would be a fault of this crate.
pub fn rounding(options: &Options) -> Result<Figure> {
    // Sides that cells almost divide show the structure by moire; with 1024 pixels it would be that of two bits.
    let (side, small_side) = if options.small { (500, 340) } else { (1000, 360) };
    let (mut cells, mut numbers) = (Vec::new(), Vec::new());
    for id in OTHERS {
        let (codec, fast) = (find(id)?, find(&id.replace('p', ""))?);
        let moved = moved(codec, fast);
        let lines = vec![
            format!("{}: {} bits each", codec.survey_name, codec.bits / 2),
            format!("moved: {:.1} %", 100.0 * moved),
        ];
        cells.push(Cell { picture: map(codec, small_side), lines });
        numbers.push(Number::new(format!("{id}, share of codes that are not the nearest point's"), moved));
    }
    let words = "Where the precise encoder of oct rounds y, over the square: black is down, white is up.";
    let moved = "Moved are vectors that get another code than that of the nearest point on the square.";
    let bits = options.theme.captioned_sheet(&cells, 4, &format!("{words} {moved}"));
    let main = find(MAIN)?;
    let lines = vec![format!("{}: {} bits each", main.survey_name, main.bits / 2)];
    let main = [Cell { picture: map(main, side), lines }];
    let alt = "Black and white moire pattern of rounding directions over a square";
    let pictures = vec![
        Shown::picture("figure4.png", alt, options.theme.captioned_sheet(&main, 1, words)),
        Shown::picture("figure4_bits.png", "The same pattern for several numbers of bits", bits),
    ];
    let caption = "Where the precise encoder of oct rounds y: black is down, white is up, over the square, sampled at the \
                   middle of each pixel; first at 12 bits each for x and y, then at other widths. Moved are the vectors that \
                   get another code than that of the nearest point on the square.";
    Ok(Figure::new("4", "Precise rounding", caption, pictures).with(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding moves a place by less than one step, up or down.
    #[test]
    fn places_move_by_less_than_a_step() {
        let codec = find("oct16p").unwrap();
        for n in 0..1000u32 {
            let place = DVec2::new(f64::from(n * 7919 % 1000), f64::from(n)) / 1000.0 * 0.9;
            // Above the fold, where a step is not mirrored.
            if place.element_sum() < 0.95 {
                assert!(rise(codec, place).abs() < 1.0 / 127.0 + 1e-6, "{place}");
            }
        }
    }

    /// Some codes of the precise encoder are not the nearest, and most are.
    #[test]
    fn the_precise_encoder_moves_some() {
        let moved = moved(find("oct16p").unwrap(), find("oct16").unwrap());
        assert!((0.02..0.5).contains(&moved), "{moved}");
    }
}
