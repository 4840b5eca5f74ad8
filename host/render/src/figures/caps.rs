//! Error maps of caps.

use super::canvas::{Cell, Theme};
use super::errors::{LAST_COLOUR, ends, explained, heat, last_colour, scale_deg};
use super::paint::{self, Colour, SAMPLES};
use super::points::{in_words, numbers};
use super::{Figure, Number, Options, Shown};
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};
use unitvec::wrap::Cap;
use unitvec::{Domain, HemiOctPrecise16, Listed, OctPrecise16};
use unitvec_run::measure::ErrorStats;
use unitvec_run::sampling::random_directions;

/// The half-angles of the caps, in degrees; before them, the codec without a cap.
const ANGLES: [Option<f64>; 4] = [None, Some(60.0), Some(30.0), Some(10.0)];

/// Bits of the codes.
const BITS: u32 = 16;

/// Outside of a cap.
const OUTSIDE: Colour = Colour::splat(0.8);

/// A codec without a cap or in one about +Z.
struct Tried<C> {
    cap: Option<Cap<C>>,
    /// The half-angle of what is encoded, radians.
    angle: f64,
}

impl<C: Listed> Tried<C> {
    fn new(degrees: Option<f64>) -> Self {
        let whole = if C::DOMAIN == Domain::Hemisphere { FRAC_PI_2 } else { PI };
        let angle = degrees.map_or(whole, f64::to_radians);
        Self { cap: degrees.map(|_| Cap::new([0.0, 0.0, 1.0], angle as f32)), angle }
    }

    fn error_deg(&self, v: DVec3) -> f64 {
        let v = v.as_vec3();
        let decoded: Vec3 = match self.cap {
            Some(cap) => cap.decode(cap.encode(v)),
            None => C::decode(C::encode(v)),
        };
        unitvec::angle_deg(v, decoded)
    }

    /// A direction of the hemisphere, moved to what is encoded: its height above the lowest in proportion, which keeps areas.
    fn within(&self, v: DVec3) -> DVec3 {
        let below = (1.0 - v.z) * (1.0 - self.angle.cos());
        let around = v.truncate().normalize_or_zero() * (below * (2.0 - below)).sqrt();
        around.extend(1.0 - below)
    }

    /// Errors over random directions.
    fn errors(&self) -> ErrorStats {
        let directions = random_directions(Domain::Hemisphere, 1).take(100_000);
        directions.map(|v| self.error_deg(self.within(Vec3::from_array(v).as_dvec3()))).collect()
    }
}

/// The map of a codec, seen along the axis, with its numbers.
fn map<C: Listed>(theme: Theme, side: u32, degrees: Option<f64>) -> (Cell, [Number; 2]) {
    let tried = Tried::<C>::new(degrees);
    let (scale, rim) = (scale_deg(BITS), tried.angle.cos());
    let colour = |v: DVec3| if v.z < rim { OUTSIDE } else { heat(tried.error_deg(v) / scale) };
    let picture = paint::coarse(paint::disc(theme, side, SAMPLES, DMat3::IDENTITY, colour));
    let what = degrees.map_or_else(|| "without a cap".to_owned(), |degrees| format!("cap of {degrees} deg"));
    let (name, errors) = (format!("{}, {what}", C::NAME), tried.errors());
    (Cell { picture, lines: vec![name.clone(), in_words(&errors)] }, numbers(&name, &errors))
}

/// Error maps of a codec of the sphere and one of the hemisphere, in caps.
pub fn caps(options: &Options) -> Figure {
    let side = if options.small { 220 } else { 360 };
    let sphere = ANGLES.map(|degrees| map::<OctPrecise16>(options.theme, side, degrees));
    let hemisphere = ANGLES.map(|degrees| map::<HemiOctPrecise16>(options.theme, side, degrees));
    let (cells, of_cells): (Vec<Cell>, Vec<_>) = sphere.into_iter().chain(hemisphere).unzip();
    let numbers = std::iter::once(last_colour(BITS, scale_deg(BITS))).chain(of_cells.into_iter().flatten());
    let caption = format!(
        "The error of {BITS} bits without a cap, and in caps of several half-angles about an axis, which is in the middle; grey is \
         outside. Above a codec of the sphere, below one of the hemisphere, which fills a cap better: its whole domain is a \
         cap of 90 degrees. All maps share one scale, that of the error maps: dark is none, yellow is {LAST_COLOUR} times \
         the least possible maximum over the sphere, or more. Means and maxima are of the whole domain or cap."
    );
    let alt = "Discs coloured by the error of a codec at each direction, darker the smaller the cap";
    let pictures = vec![Shown::picture(
        "caps.png",
        alt,
        explained(
            options.theme,
            (&cells, ANGLES.len() as u32),
            ends(&[(BITS, scale_deg(BITS))].into()),
            &caption,
        ),
    )];
    Figure::new("caps", "Caps", caption, pictures).with(numbers.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use unitvec::Codec;

    /// The map's lengths, across the radius the circles' and along it the area's rest, turn the codec's own errors into
    /// those of its caps, but for their curvature.
    #[test]
    fn errors_in_caps_follow_from_the_codecs() {
        for degrees in ANGLES.into_iter().flatten() {
            let tried = Tried::<HemiOctPrecise16>::new(Some(degrees));
            let (area, mut derived, mut shown) = (1.0 - tried.angle.cos(), 0.0, 0.0);
            for v in random_directions(Domain::Hemisphere, 3).take(20_000).map(Vec3::from_array) {
                let decoded: Vec3 = HemiOctPrecise16::decode(HemiOctPrecise16::encode(v));
                let (off, from) = ((decoded - v).as_dvec3(), v.as_dvec3());
                let to = tried.within(from);
                let across = DVec3::Z.cross(from).normalize();
                let length = to.truncate().length() / from.truncate().length();
                let moved = DVec2::new(length * off.dot(across), area / length * off.dot(across.cross(from)));
                derived += moved.length().to_degrees();
                shown += tried.error_deg(to);
            }
            assert!((shown / derived - 1.0).abs() < 0.01, "{degrees}: {shown} {derived}");
        }
    }
}
