//! What is drawn on the sphere: the numbering of `latlong` (figure 2), the octants (3), the points (5), and errors.

use super::canvas::{Canvas, Cell, INK, sheet};
use super::paint::{self, Colour, Dots, from_srgb};
use super::{Figure, Number, Options, Shown};
use crate::Result;
use crate::accuracy::{covering_bound_deg, measure};
use crate::backend::Cpu;
use crate::catalogue::{CodecInfo, Coding, Domain, find};
use glam::{DMat3, DVec2, DVec3};
use image::RgbImage;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use std::collections::{BTreeMap, HashSet};
use std::f64::consts::{PI, TAU};
use unitvec_oracle::{Oct, Oracle};

/// Samples of a pixel in a row.
const SAMPLES: u32 = 4;

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

    /// None where so few rings are too high for the error.
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

    /// Ring and place in it, both with what is behind the point: (ring, its fraction, patch, its fraction, patches).
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
            return from_srgb(INK);
        }
        from_srgb([[222, 235, 247], [253, 231, 203], [229, 245, 224]][(patch + 2 * ring) % 3])
    }
}

fn polar(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// Figure 2: `latlong`'s patches and their numbers.
pub fn numbering(options: &Options) -> Figure {
    let side = if options.small { 420 } else { 720 };
    let patches = Patches::fewest(PATCH_ERROR);
    let view = paint::from_the_side();
    let mut canvas = Canvas(paint::disc(side, SAMPLES, view, |v| patches.colour(v)));
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
                canvas.write(&number, (at.x as i32, at.y as i32), side < 500, true, INK);
            }
        }
    }
    let caption = format!(
        "How latlong numbers its patches, for a largest error of {PATCH_ERROR} degrees: {} patches in {} rings, from the pole \
         downwards. A code is the number of a patch.",
        patches.count(),
        patches.rings()
    );
    let shown = Shown::picture(
        "figure2.png",
        "A sphere divided into numbered patches between circles of latitude",
        canvas.0,
    );
    Figure::new("2", "latlong's patches", caption, vec![shown]).with(vec![
        Number::new("patches", patches.count() as f64),
        Number::new("rings", patches.rings() as f64),
    ])
}

/// A colour for each octant, the brighter ones above.
fn octant_colour(v: DVec3) -> Colour {
    const COLOURS: [[u8; 3]; 4] = [[230, 159, 0], [86, 180, 233], [0, 158, 115], [204, 121, 167]];
    let colour = from_srgb(COLOURS[usize::from(v.x < 0.0) + 2 * usize::from(v.y < 0.0)]);
    if v.z >= 0.0 { colour } else { 0.42 * colour }
}

/// The octant's colour, with lines where the square has its grid.
fn unfolded_colour(v: DVec3) -> Colour {
    const LINES: f64 = 4.0;
    let grid = Oct::position(v.to_array()).map(|t| {
        let t = (t + 1.0) * LINES;
        (t - t.round()).abs() < 0.06
    });
    if grid.contains(&true) { 0.35 * octant_colour(v) } else { octant_colour(v) }
}

/// The point of the octahedron that is seen at a place, as far as it is hit.
fn on_octahedron(place: DVec2, view: DMat3) -> Option<(DVec3, DVec3)> {
    let back = view.transpose();
    let (from, toward) = (back * (place * 1.03).extend(3.0), back * DVec3::NEG_Z);
    let faces =
        (0..8).map(|n| DVec3::from_array([0, 1, 2].map(|bit| if n >> bit & 1 == 0 { 1.0 } else { -1.0 })));
    let hits = faces.filter(|face| face.dot(toward) < 0.0).filter_map(|face| {
        let point = from + (1.0 - face.dot(from)) / face.dot(toward) * toward;
        (point * face).cmpge(DVec3::splat(-1e-9)).all().then_some((point, face.normalize()))
    });
    hits.into_iter().next()
}

/// Figure 3: how the octants of a sphere become a square.
pub fn unfolding(options: &Options) -> Figure {
    let side = if options.small { 220 } else { 480 };
    let view = paint::from_the_side();
    let sphere = paint::disc(side, SAMPLES, view, |v| unfolded_colour(v) * (0.55 + 0.45 * (view * v).z));
    let octahedron = paint::square(side, SAMPLES, |place| {
        let lit =
            |(point, normal): (DVec3, DVec3)| unfolded_colour(point) * (0.45 + 0.55 * (view * normal).z);
        on_octahedron(place, view).map_or(Colour::ONE, lit)
    });
    let square = paint::square(side, SAMPLES, |place| {
        unfolded_colour(DVec3::from_array(Oct::direction(place.to_array())))
    });
    let cells = [(sphere, "sphere"), (octahedron, "octahedron"), (square, "square")]
        .map(|(picture, name)| Cell { picture, lines: vec![name.to_owned()] });
    let caption = "How oct maps the octants of the sphere to the faces of an octahedron, projects these to the plane, and \
                   unfolds the lower four outwards, which fills the square. The lines are those of a grid on the square."
        .to_owned();
    let alt = "The same eight coloured octants on a sphere, on an octahedron and on a square";
    Figure::new(
        "3",
        "oct unfolds the sphere",
        caption,
        vec![Shown::picture("figure3.png", alt, sheet(&cells, 3))],
    )
}

/// The panels of figure 5, in its order, and three that came after the survey.
const DISTRIBUTIONS: [&str; 18] = [
    "stereo_concentric16",
    "eqdist_concentric16",
    "eqarea_concentric16",
    "stereo_ellipse16",
    "stereo16",
    "eqarea16",
    "oct16",
    "eqarea_ellipse16",
    "eqdist_ellipse16",
    "eqdist16",
    "latlong16",
    "spherical16",
    "oct16p",
    "latlong16d",
    "snorm8x3",
    "ico16",
    "fib16",
    "eaoct16",
];

/// Codes of so many bits are all decoded.
const ALL_CODES_UP_TO: u32 = 16;
/// Directions whose codes stand for all where there are more.
const DIRECTIONS: usize = 1 << 22;
/// Directions that errors are measured over.
const MEASURED: usize = 100_000;

/// The directions that encoded vectors can have, each once.
fn representable(codec: &'static CodecInfo) -> Result<Vec<DVec3>> {
    let vectors: Vec<[f32; 3]> = if codec.bits <= ALL_CODES_UP_TO {
        (0..1u32 << codec.bits).map(|code| codec.decode_one([code, 0])).collect()
    } else {
        let mut decoded = Vec::new();
        let directions = crate::sampling::random_directions(codec.domain, 1);
        crate::backend::round_trip(&mut Cpu, codec.format(), directions, DIRECTIONS, |_, v| decoded.push(v))?;
        decoded
    };
    let mut known = HashSet::new();
    // Adding 0 makes -0 the same as 0.
    let new = vectors.into_iter().filter(|v| known.insert(v.map(|c| (c + 0.0).to_bits())));
    Ok(new.map(|v| DVec3::from_array(v.map(f64::from)).normalize_or_zero()).collect())
}

fn view_of(codec: &CodecInfo) -> DMat3 {
    if codec.domain == Domain::Hemisphere { paint::from_above() } else { paint::from_the_side() }
}

/// Figure 5: where the representable points lie.
///
/// # Errors
/// As [`measure`], which would be a fault of this crate.
pub fn points(options: &Options) -> Result<Figure> {
    let side = if options.small { 150 } else { 360 };
    let (mut cells, mut numbers) = (Vec::new(), Vec::new());
    for codec in options.codecs_or(&DISTRIBUTIONS)? {
        let directions = representable(codec)?;
        let view = view_of(codec);
        let mut dots = Dots::new(side);
        // Dots of smaller pictures lie closer.
        let ink = 2.2 * (f64::from(side) / 360.0).powf(1.5);
        directions.iter().filter_map(|v| paint::place(*v, view)).for_each(|place| dots.add(place, ink));
        let errors = measure(&mut Cpu, codec, codec.domain, MEASURED, 1)?;
        let lines = vec![
            codec.survey_name.to_owned(),
            format!("mean {:.3} max {:.3} deg", errors.mean_deg(), errors.max_deg()),
        ];
        cells.push(Cell { picture: dots.picture(), lines });
        numbers.push(Number::new(&format!("{}, points", codec.id), directions.len() as f64));
    }
    let caption = "The unit vectors that a code can stand for. An even grey is best: where points are dense, and the picture \
                   dark, errors are small at the cost of others. All codes have 16 bits but those of snorm8x3. ico16, fib16 \
                   and eaoct16 are not in the survey."
        .to_owned();
    let alt = "Spheres covered with dots, one for each codec";
    let shown = Shown::picture("figure5.png", alt, sheet(&cells, 6));
    Ok(Figure::new("5", "Representable unit vectors", caption, vec![shown]).with(numbers))
}

/// What error maps show if nothing else is asked for.
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

fn error_map(codec: &'static CodecInfo, side: u32) -> RgbImage {
    let scale = scale_deg(codec.bits);
    let view = view_of(codec);
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
        let errors = measure(&mut Cpu, codec, codec.domain, MEASURED, 1)?;
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

/// Codecs of vectors by identifier.
pub fn named(ids: &[&str]) -> Result<Vec<&'static CodecInfo>> {
    ids.iter().map(|id| Ok(find(id)?)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random_directions;

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
        // As many caps of that radius have less area than the sphere, or they could not cover it.
        assert!(patches.count() as f64 > 2.0 / (1.0 - PATCH_ERROR.to_radians().cos()));
    }

    /// oct16's lattice has 255 x 255 points, the border's edges are folded in the middle, and its corners are one.
    #[test]
    fn representable_points_are_counted_once() {
        let count = |id: &str| representable(find(id).unwrap()).unwrap().len();
        assert_eq!(count("oct16"), 253 * 253 + 4 * 127 + 1);
        assert_eq!(count("fib16"), 1 << 16);
    }

    #[test]
    fn the_octahedron_is_hit_in_its_middle() {
        let (point, _) = on_octahedron(DVec2::ZERO, paint::from_the_side()).unwrap();
        assert!((point.abs().element_sum() - 1.0).abs() < 1e-9);
        assert!(on_octahedron(DVec2::ONE, paint::from_the_side()).is_none());
    }
}
