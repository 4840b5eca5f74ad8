//! The numbering of `latlong`'s patches (figure 2).

use super::canvas::{Canvas, Cell, Theme, Type};
use super::paint::{self, Colour, SAMPLES, from_srgb};
use super::{Figure, Number, Options, Shown};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The largest error of figure 2, degrees.
const PATCH_ERROR: f64 = 10.0;

/// Patches in rings between circles of latitude, so that none has a point further than some angle from its middle.
struct Patches {
    /// Number of the first patch of each ring, and then the number of all.
    first: Vec<usize>,
}

impl Patches {
    /// The fewest with rings of equal height.
    fn fewest(max_deg: f64) -> Self {
        let counted = (1..=180)
            .map(|rings| Self::with_rings(rings, max_deg))
            .filter(|patches| !patches.first.is_empty());
        counted.min_by_key(Self::count).unwrap_or(Self { first: vec![0] })
    }

    /// The patches of this many rings; without any where the rings are too high for the error.
    fn with_rings(rings: usize, max_deg: f64) -> Self {
        let mut first = vec![0];
        for ring in 0..rings {
            let mut counts = 1..=720;
            let Some(count) = counts.find(|count| Self::error_deg(ring, rings, *count) <= max_deg) else {
                return Self { first: Vec::new() };
            };
            first.push(first[ring] + count);
        }
        Self { first }
    }

    fn count(&self) -> usize {
        self.first.last().copied().unwrap_or(0)
    }

    fn rings(&self) -> usize {
        self.first.len() - 1
    }

    /// The angle from a patch's middle to its furthest corner. A cap that is one patch has the pole as its middle.
    fn error_deg(ring: usize, rings: usize, count: usize) -> f64 {
        let height = PI / rings as f64;
        if count == 1 {
            return if ring == 0 || ring + 1 == rings { height.to_degrees() } else { 180.0 };
        }
        let (top, middle) = (ring as f64 * height, (ring as f64 + 0.5) * height);
        let corner = |theta: f64| polar(theta, PI / count as f64).angle_between(polar(middle, 0.0));
        corner(top).max(corner(top + height)).to_degrees()
    }

    /// Ring and place in it, both with the rest: (ring, its fraction, patch, its fraction, patches).
    fn locate(&self, v: DVec3) -> (usize, f64, usize, f64, usize) {
        let rings = self.rings();
        let height = v.z.clamp(-1.0, 1.0).acos() / PI * rings as f64;
        let ring = (height as usize).min(rings - 1);
        let count = self.first[ring + 1] - self.first[ring];
        let around = v.y.atan2(v.x).rem_euclid(TAU) / TAU * count as f64;
        (ring, height - ring as f64, (around as usize).min(count - 1), around.fract(), count)
    }

    /// Pale, in turns, with a line around each patch.
    fn colour(&self, v: DVec3) -> Colour {
        const LINE: f64 = 0.008;
        let (ring, down, patch, along, count) = self.locate(v);
        let height = PI / self.rings() as f64;
        let width = TAU / count as f64 * v.truncate().length();
        let near = |part: f64, size: f64| part.min(1.0 - part) * size < LINE;
        if near(down, height) || (count > 1 && near(along, width)) {
            return from_srgb(Theme::LIGHT.ink);
        }
        from_srgb([[222, 235, 247], [253, 231, 203], [229, 245, 224]][(patch + 2 * ring) % 3])
    }
}

fn polar(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// Figure 2: `latlong`'s patches and their numbers.
pub fn numbering(options: &Options) -> Figure {
    let side = if options.small { 640 } else { 960 };
    let letters = Type { size: side as f32 / 40.0, is_bold: false };
    let patches = Patches::fewest(PATCH_ERROR);
    let view = paint::from_the_side();
    let mut canvas = Canvas(paint::disc(options.theme, side, SAMPLES, view, |v| patches.colour(v)));
    for ring in 0..patches.rings() {
        let count = patches.first[ring + 1] - patches.first[ring];
        for patch in 0..count {
            let theta =
                if count == 1 && ring == 0 { 0.0 } else { (ring as f64 + 0.5) * PI / patches.rings() as f64 };
            let middle = polar(theta, (patch as f64 + 0.5) * TAU / count as f64);
            // Numbers nearer to the rim would not fit their patches.
            if (view * middle).z < 0.45 {
                continue;
            }
            if let Some(place) = paint::place(middle, view) {
                let at = paint::pixel(place, side);
                let number = (patches.first[ring] + patch).to_string();
                canvas.write(&number, (at.x as f32, at.y as f32), letters, true, Theme::LIGHT.ink);
            }
        }
    }
    let caption = format!(
        "How latlong numbers its patches, for a largest error of {PATCH_ERROR} degrees: {} patches in {} rings, from the pole \
         downwards. A code is the number of a patch.",
        patches.count(),
        patches.rings()
    );
    let alt = "A sphere divided into numbered patches between circles of latitude";
    let shown = Shown::picture(
        "figure2.png",
        alt,
        options.theme.captioned_sheet(&[Cell { picture: canvas.0, lines: Vec::new() }], 1, &caption),
    );
    Figure::new("2", "latlong's patches", caption, vec![shown]).with(vec![
        Number::new("patches", patches.count() as f64),
        Number::new("rings", patches.rings() as f64),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;
    use unitvec_catalogue::Domain;
    use unitvec_run::sampling::random_directions;

    /// No direction is further than the limit from the middle of its patch, and the numbers are all there.
    #[test]
    fn patches_keep_to_their_error() {
        let patches = Patches::fewest(PATCH_ERROR);
        let mut used = HashSet::new();
        for v in random_directions(Domain::Sphere, 1).take(20_000) {
            let v = DVec3::from_array(v.map(f64::from));
            let (ring, _, patch, _, count) = patches.locate(v);
            used.insert(patches.first[ring] + patch);
            let theta = (ring as f64 + 0.5) * PI / patches.rings() as f64;
            if count > 1 {
                let middle = polar(theta, (patch as f64 + 0.5) * TAU / count as f64);
                assert!(v.angle_between(middle).to_degrees() < PATCH_ERROR + 1e-3);
            }
        }
        assert_eq!(used.len(), patches.count());
        // The caps of that radius have more area than the sphere, or they could not cover it.
        assert!(patches.count() as f64 > 2.0 / (1.0 - PATCH_ERROR.to_radians().cos()));
    }
}
