//! Rotations in 32 bits: the way of a pointer that turns slowly, and the error over rotations.

use super::canvas::{Cell, Theme};
use super::errors::{LAST_COLOUR, ends, explained, heat, last_colour};
use super::paint::{self, Dots, MARGIN, SAMPLES, from_srgb};
use super::points::{errors, in_words, numbers};
use super::{Figure, Number, Options, Shown};
use crate::Result;
use glam::{DQuat, DVec2, DVec3};
use image::RgbImage;
use std::f64::consts::{PI, TAU};
use unitvec_catalogue::{AnyCodec, find_any};
use unitvec_lab::accuracy::beyond::rotation_bound_deg;
use unitvec_run::measure::ErrorStats;

/// Smallest three by rounding, the nearest code of the same format, and ours: each with its name in the picture.
const CODECS: [(&str, &str); 3] = [
    ("smallest3:10 plain", "smallest three, rounded"),
    ("smallest3:10", "the same, nearest code"),
    ("quat32", "quat32"),
];

/// Bits of their codes.
const BITS: u32 = 32;

/// The middle of the part: a third of a turn about (1, 1, 1), where all components are alike, and rounding is worst.
const MIDDLE: DQuat = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5);

/// Half the width of the part.
const REACH_DEG: f64 = 0.5;

/// Frames of the pointer's way.
const FRAMES: u32 = 120;

/// The rotation of the part that tips the pointer to this place of its square.
fn tipped(place: DVec2) -> DQuat {
    DQuat::from_scaled_axis(REACH_DEG.to_radians() * DVec3::new(-place.y, place.x, 0.0)) * MIDDLE
}

/// The place of the pointer's tip, which `MIDDLE` turns to +Z.
fn tip(q: DQuat) -> DVec2 {
    (q * MIDDLE.inverse() * DVec3::Z).truncate() / REACH_DEG.to_radians()
}

/// The turn about an axis in the plane of x and y that stands at this place of a disc: 180 degrees at its rim.
fn turn(place: DVec2) -> Option<DQuat> {
    let place = MARGIN * place;
    (place.length() <= 1.0).then(|| DQuat::from_scaled_axis(PI * place.extend(0.0)))
}

fn decoded(codec: &AnyCodec, q: DQuat) -> DQuat {
    let decoded: [f32; 4] = codec.decode_one(codec.encode_one(q.as_quat().to_array()));
    DQuat::from_array(decoded.map(f64::from))
}

fn error_deg(codec: &AnyCodec, q: DQuat) -> f64 {
    unitvec::rotation_angle_deg(q.as_quat(), decoded(codec, q).as_quat())
}

/// Where a pointer's tip is seen as it goes around a circle, frame by frame, over the circle.
fn way(theme: Theme, side: u32, seen: impl Fn(DQuat) -> DQuat) -> RgbImage {
    let mut dots = Dots::new(side);
    let mut line = |from: DVec2, to: DVec2, ink: f64| {
        let steps = (from.distance(to) * f64::from(side)).ceil();
        (0..steps as u32).for_each(|n| dots.add(from.lerp(to, f64::from(n) / steps), ink));
    };
    let circle = |frame: u32| 0.75 * DVec2::from_angle(TAU * f64::from(frame) / f64::from(FRAMES));
    let mark = 3.0 / f64::from(side);
    let mut last = tip(seen(tipped(circle(0))));
    for frame in 1..=FRAMES {
        let place = tip(seen(tipped(circle(frame))));
        line(circle(frame - 1), circle(frame), 0.08);
        line(last, place, 0.3);
        for across in [DVec2::X, DVec2::Y] {
            line(place - mark * across, place + mark * across, 0.8);
        }
        last = place;
    }
    dots.picture(theme)
}

fn map(
    theme: Theme,
    codec: &AnyCodec,
    side: u32,
    rotation: impl Fn(DVec2) -> Option<DQuat> + Sync,
) -> RgbImage {
    let (scale, paper) = (scale_deg(), from_srgb(theme.paper));
    paint::coarse(paint::square(side, SAMPLES, |place| {
        rotation(place).map_or(paper, |q| heat(error_deg(codec, q) / scale))
    }))
}

/// The error of the last colour, degrees.
fn scale_deg() -> f64 {
    LAST_COLOUR * rotation_bound_deg(BITS).1
}

/// A codec, its name in the picture, and its errors over all rotations and over the part.
struct Measured(&'static AnyCodec, &'static str, ErrorStats, ErrorStats);

impl Measured {
    fn new((id, name): (&str, &'static str)) -> Result<Self> {
        const SIDE: u32 = 200;
        let codec = find_any(id)?;
        let at = |n: u32| (2.0 * f64::from(n) + 1.0) / f64::from(SIDE) - 1.0;
        let places = (0..SIDE * SIDE).map(|n| DVec2::new(at(n % SIDE), at(n / SIDE)));
        Ok(Self(codec, name, errors(codec)?, places.map(|place| error_deg(codec, tipped(place))).collect()))
    }

    fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self(AnyCodec { id, .. }, _, everywhere, part) = self;
        let everywhere = numbers(&format!("{id}, all rotations"), everywhere);
        everywhere.into_iter().chain(numbers(&format!("{id}, the part"), part))
    }
}

/// The way of a pointer, and error maps.
///
/// # Errors
/// An error of measuring, which would be a fault of this crate.
pub fn rotations(options: &Options) -> Result<Figure> {
    let side = if options.small { 260 } else { 360 };
    let all = CODECS.into_iter().map(Measured::new).collect::<Result<Vec<_>>>()?;
    let cell = |picture, lines: [&str; 2]| Cell { picture, lines: lines.map(str::to_owned).to_vec() };
    let pointers = all.iter().map(|Measured(codec, name, ..)| {
        cell(way(options.theme, side, |q| decoded(codec, q)), [name, "a pointer goes around"])
    });
    let mut cells: Vec<Cell> = pointers.collect();
    cells.extend(all.iter().map(|Measured(codec, _, everywhere, _)| {
        cell(map(options.theme, codec, side, turn), ["all rotations", &in_words(everywhere)])
    }));
    cells.extend(all.iter().map(|Measured(codec, _, _, part)| {
        cell(
            map(options.theme, codec, side, |place| Some(tipped(place))),
            ["the first row's part", &in_words(part)],
        )
    }));
    let numbers =
        std::iter::once(last_colour(BITS, scale_deg())).chain(all.iter().flat_map(Measured::numbers));
    let caption = format!(
        "Rotations in {BITS} bits: the smallest three components in 10 bits each, by rounding and by the nearest code of the same \
         format, and quat32. Above, the tip of a long pointer goes around a circle, three quarters of a degree wide, in \
         {FRAMES} frames: crosses are where it is seen, joined in order. In the middle, the error of turns about all axes of \
         a plane, by 0 degrees in the middle to 180 at the rim; a pixel spans many cells of a code, and is the mean of {} \
         samples. Below, the error of the rotations of the first row, which tip the pointer within a square of one \
         degree, where all four components are alike and rounding does worst. Dark is no error, yellow is {LAST_COLOUR} \
         times the least known maximum at that number of bits, or more.",
        SAMPLES * SAMPLES
    );
    let alt = "The way of a pointer, and maps of the error over rotations, by two encoders of the smallest three and by quat32";
    let pictures = vec![Shown::picture(
        "rotations.png",
        alt,
        explained(options.theme, (&cells, 3), ends(&[(BITS, scale_deg())].into()), &caption),
    )];
    Ok(Figure::new("rotations", "Rotations", caption, pictures).with(numbers.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_oracle::quat;

    /// The pointer's tip is seen where the rotation of a place takes it; the edge is half a degree away.
    #[test]
    fn the_tip_is_at_its_place() {
        for place in [DVec2::ZERO, DVec2::new(0.3, -0.8), DVec2::Y] {
            assert!(tip(tipped(place)).distance(place) < 1e-4, "{place}");
        }
        let edge = 2.0 * tipped(DVec2::X).dot(MIDDLE).acos();
        assert!((edge.to_degrees() - 0.5).abs() < 1e-6, "{edge}");
        assert!(turn(DVec2::new(0.9, 0.9)).is_none());
    }

    /// The maps show the oracle's error of quat32, and of rounding what a second derivation gives.
    #[test]
    fn maps_show_the_errors() {
        let round = |c: f64| ((c * 2f64.sqrt() + 1.0) * 511.5).round() / 511.5 - 1.0;
        let rounded = |q: [f64; 4]| {
            let at = (0..4).max_by(|&a, &b| q[a].abs().total_cmp(&q[b].abs())).unwrap();
            let mut kept = q.map(|c| round(c * q[at].signum()) / 2f64.sqrt());
            kept[at] = 0.0;
            kept[at] = (1.0 - kept.iter().map(|c| c * c).sum::<f64>()).sqrt();
            kept
        };
        let [plain, _, ours] = CODECS.map(|(id, _)| find_any(id).unwrap());
        let (mut of_plain, mut of_ours) = ([0.0; 2], [0.0; 2]);
        for n in 0..2000u32 {
            let place = DVec2::new(f64::from(n * 7919 % 2000), f64::from(n)) / 1000.0 - 1.0;
            for q in [Some(tipped(place)), turn(place)].into_iter().flatten() {
                let exact = quat::unit(q.as_quat().to_array().map(f64::from));
                of_plain[0] += error_deg(plain, q);
                of_plain[1] += quat::angle_deg(exact, rounded(exact));
                of_ours[0] += error_deg(ours, q);
                of_ours[1] += quat::nearest(exact, BITS).1;
            }
        }
        for [shown, derived] in [of_plain, of_ours] {
            assert!((shown / derived - 1.0).abs() < 2e-3, "{shown} {derived}");
        }
    }
}
