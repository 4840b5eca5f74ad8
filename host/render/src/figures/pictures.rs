//! Figures of the rendered scene: 1, 6, 7, 8 and Meyer's third.

use super::camera::{Camera, shot};
use super::canvas::{Cell, crop, places, sheet};
use super::compare::{Difference, amplified, mean, mean_where, most_different, rank_correlation};
use super::{Figure, Labelled, Number, Options, Place, Shown, Subject};
use crate::{Material, Normals, OBJECTS, Result, SIDES, Seen, View};
use image::RgbImage;
use image::imageops::{FilterType, resize};
use unitvec_catalogue::{AnyCodec, Domain, vectors};
use unitvec_run::backend::Cpu;
use unitvec_run::measure::measure;

/// The factor of differences, as in the survey.
pub const TIMES: u8 = 8;

/// Directions that mean errors are measured over.
const MEASURED: usize = 200_000;

/// A material's name in files and captions.
fn name(material: Material) -> &'static str {
    match material {
        Material::Lambertian => "lambertian",
        Material::Glossy => "glossy",
        Material::Mirror => "mirror",
    }
}

/// A picture with its difference to that of floats.
pub struct Compared {
    /// The name of the codec that the normals went through.
    pub label: String,
    /// The codec, unless it is floats.
    pub codec: Option<&'static AnyCodec>,
    pub picture: RgbImage,
    /// The picture's difference; `None` for floats.
    pub difference: Option<Difference>,
}

impl Compared {
    pub fn lines(&self) -> Vec<String> {
        vec![self.label.clone(), self.difference.map_or_else(String::new, |difference| difference.in_words())]
    }

    fn id(&self) -> &'static str {
        self.codec.map_or("float", |codec| codec.id)
    }

    fn subject(&self, material: Material) -> Subject {
        Subject { codec: self.id().to_owned(), material: name(material).to_owned() }
    }

    /// Describes this picture as a file of its own.
    fn shown(&self, figure: &str, material: Material) -> Shown {
        let alt = format!("{} surfaces, normals as {}", name(material), self.label);
        let file = format!("{figure}_{}_{}.png", name(material), self.id());
        let shown = Shown::picture(file, alt, self.picture.clone());
        Shown { of: Some(self.subject(material)), differences: differences([self]), ..shown }
    }
}

/// A file for each picture, unless figures are small.
fn singles(options: &Options, compared: &[Compared], figure: &str, material: Material) -> Vec<Shown> {
    let shown: &[Compared] = if options.small { &[] } else { compared };
    shown.iter().map(|shown| shown.shown(figure, material)).collect()
}

fn differences<'a>(pictures: impl IntoIterator<Item = &'a Compared>) -> Vec<Labelled> {
    let of = |shown: &Compared| Some(Labelled { label: shown.label.clone(), difference: shown.difference? });
    pictures.into_iter().filter_map(of).collect()
}

/// The picture of some normals.
pub fn take(camera: &mut dyn Camera, normals: Normals, material: Material, view: View) -> Result<RgbImage> {
    camera.picture(&shot(normals, material, view))
}

/// The picture of floats, and then those of codecs.
fn compare(
    camera: &mut dyn Camera,
    codecs: &[&'static AnyCodec],
    material: Material,
    view: View,
) -> Result<Vec<Compared>> {
    let float = take(camera, Normals::Float, material, view)?;
    let mut all =
        vec![Compared { label: "float32x3".to_owned(), codec: None, picture: float, difference: None }];
    for codec in codecs {
        let picture = take(camera, Normals::Codec(codec), material, view)?;
        let difference = Some(Difference::of(&all[0].picture, &picture));
        all.push(Compared { label: codec.survey_name.to_owned(), codec: Some(codec), picture, difference });
    }
    Ok(all)
}

/// Widths of cells in sheets of many pictures, and of few: for whole figures and for small ones.
pub const MANY: [u32; 2] = [320, 190];
const FEW: [u32; 2] = [480, 230];

/// The part of pictures that a sheet shows, at their own size: where the first codec's differs most from that of floats.
pub fn window(options: &Options, widths: [u32; 2], float: &RgbImage, coded: &RgbImage) -> [u32; 4] {
    let width = widths[usize::from(options.small)];
    most_different(float, coded, [width, width * 9 / 16])
}

fn cells<'a>(pictures: impl Iterator<Item = &'a Compared>, window: [u32; 4]) -> Vec<Cell> {
    pictures.map(|shown| Cell { picture: crop(&shown.picture, window), lines: shown.lines() }).collect()
}

/// Figure 1: mirror and glossy.
pub fn one(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let codecs = options.codecs_or("oct16p snorm8x3 oct24p")?;
    let (mut all, mut off, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for material in [Material::Mirror, Material::Glossy] {
        let mut compared = compare(camera, &codecs, material, View::Scene)?;
        let window = window(options, FEW, &compared[0].picture, &compared[1].picture);
        // Floats come last, as in the survey.
        compared.rotate_left(1);
        all.extend(cells(compared.iter(), window));
        let named = |one: Labelled| Labelled { label: format!("{}, {}", name(material), one.label), ..one };
        off.extend(differences(&compared).into_iter().map(named));
        pictures.extend(singles(options, &compared, "figure1", material));
    }
    let alt = "Mirroring and glossy surfaces, with normals of several codecs";
    let all = Shown::picture("figure1.png", alt, sheet(&all, codecs.len() as u32 + 1));
    pictures.insert(0, Shown { differences: off, ..all });
    let caption = "Mirror (above) and glossy reflections (below) with normals of a G-buffer in 16 bits, in 24 bits of \
                   snorm8x3, in 24 bits of oct24P, and as floats. The part where the first differs most. Differences to \
                   floats are of the whole picture, in steps of 1/255.";
    Ok(Figure::new("1", "Mirror and glossy reflections", caption, pictures))
}

/// A whole picture, this wide.
fn shrunk(picture: &RgbImage, width: u32) -> RgbImage {
    let height = (picture.height() * width).div_ceil(picture.width());
    resize(picture, width, height, FilterType::Triangle)
}

const FIGURE_7: &str = "The survey says that differences are far more apparent than on Lambertian surfaces, and that steps \
                        show where surfaces are nearly flat.";

/// Figures 6 and 7: the codec that the survey's figures show.
pub fn difference(camera: &mut dyn Camera, options: &Options, material: Material) -> Result<Figure> {
    let codecs = options.codecs_or("eqarea_ellipse16")?;
    let compared = compare(camera, &codecs, material, View::Scene)?;
    let (float, mut cells, mut numbers) = (&compared[0].picture, Vec::new(), Vec::new());
    let width = if options.small { 320 } else { 640 };
    for shown in &compared {
        cells.push(Cell { picture: shrunk(&shown.picture, width), lines: shown.lines() });
        let Some(difference) = shown.difference else { continue };
        let amplified = amplified(float, &shown.picture, TIMES);
        let black = amplified.pixels().filter(|pixel| pixel.0.iter().all(|value| *value <= TIMES)).count();
        let black = black as f64 / f64::from(float.width() * float.height());
        let words = format!("at most one step: {:.1} % of pixels", 100.0 * black);
        cells.push(Cell {
            picture: shrunk(&amplified, width),
            lines: vec![format!("difference x {TIMES}"), words],
        });
        let brightness = f64::from(TIMES) * difference.mean / 255.0;
        numbers.push(Number::new(
            format!("{}, pixels off by one step of 255 at most, share", shown.id()),
            black,
        ));
        numbers.push(Number::new(
            format!("{}, brightness of the difference x {TIMES}, 1 is white", shown.id()),
            brightness,
        ));
    }
    let (id, words) = match material {
        Material::Lambertian => ("6", "The survey says of this one that the differences are minimal."),
        _ => ("7", FIGURE_7),
    };
    let caption = format!(
        "{} surfaces with float32x3 and with eqarea+ellipse16, which the survey's figure shows, and their difference {TIMES} times \
         over. {words}",
        capital(name(material))
    );
    let alt = format!("{} surfaces with floats, with a 16-bit codec, and the difference", name(material));
    let shown = Shown::picture(format!("figure{id}.png"), alt, sheet(&cells, 3));
    let mut pictures = vec![Shown { differences: differences(&compared), ..shown }];
    pictures.extend(singles(options, &compared, &format!("figure{id}"), material));
    Ok(Figure::new(id, format!("{} surfaces", capital(name(material))), caption, pictures).with(numbers))
}

fn capital(word: &str) -> String {
    let (first, rest) = word.split_at(1.min(word.len()));
    first.to_uppercase() + rest
}

/// The codecs of figure 8, in its order, which begins with floats.
const EIGHT: &str = "oct16 eqarea_ellipse16 spherical16 oct16p latlong16 snorm8x3 eqarea_ellipse24 oct24 \
    spherical24 oct24p latlong24 eqarea_ellipse32 spherical32 oct32 latlong32 oct32p";

/// Figure 8: its codecs with all materials.
pub fn eight(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let codecs = options.codecs_or(EIGHT)?;
    let columns = if options.small { 4 } else { 5 };
    let (mut sheets, mut pictures, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    for material in &options.materials {
        let compared = compare(camera, &codecs, *material, View::Scene)?;
        let float = &compared[0].picture;
        let window = window(options, MANY, float, &compared[1].picture);
        let name = name(*material);
        let alt = format!("{name} surfaces with the normals of all codecs of the figure");
        let cells = cells(compared.iter(), window);
        let all = Shown::picture(format!("figure8_{name}.png"), alt, sheet(&cells, columns));
        let of = compared.iter().map(|shown| shown.subject(*material));
        let places = of.zip(places(&cells, columns)).map(|(of, place)| Place { of, place });
        sheets.push(Shown { differences: differences(&compared), cells: places.collect(), ..all });
        if !options.small {
            let amplified = compared[1..].iter().map(|shown| Cell {
                picture: amplified(&crop(float, window), &crop(&shown.picture, window), TIMES),
                lines: vec![format!("{} x {TIMES}", shown.label)],
            });
            let alt = format!("differences to floats, {TIMES} times over, on {name} surfaces");
            let amplified = sheet(&amplified.collect::<Vec<_>>(), columns);
            sheets.push(Shown::picture(format!("figure8_{name}_difference.png"), alt, amplified));
        }
        if options.whole {
            pictures.extend(compared.iter().map(|shown| shown.shown("figure8", *material)));
        }
        if *material == Material::Mirror && options.codecs.is_empty() {
            numbers.extend(ranks(camera, float)?);
        }
    }
    sheets.extend(pictures);
    let mut caption = "The codecs of the survey's figure 8, in its order: the part where the first differs most. The numbers are of \
                       whole pictures: the mean and the largest difference to floats, in steps of 1/255, and the structural \
                       similarity."
        .to_owned();
    if !options.small {
        caption += &format!(" Differences are shown {TIMES} times over.");
    }
    if !numbers.is_empty() {
        caption += " The panel shows only a few cells of a 16-bit code, so chance decides which of these codecs looks worst on it. \
                    The numbers below therefore rank all 16-bit codecs on a bumpy mirror sphere, seen from all sides.";
    }
    Ok(Figure::new("8", "Codecs and materials", caption, sheets).with(numbers))
}

/// The objects that turn in all directions: each shows so many normals that chance evens out. The panel and the faceted body
/// show a few cells of a code each.
const CURVED: [&str; 3] = ["bunny", "teapot", "bumpy sphere"];

fn is_curved(seen: &Option<Seen>) -> bool {
    let name = seen.and_then(|seen| OBJECTS.get(seen.object as usize - 1));
    name.is_some_and(|name| CURVED.contains(name))
}

/// The mean error of the normals of some pixels, degrees.
fn error_shown<'a>(seen: impl Iterator<Item = &'a Option<Seen>>) -> f64 {
    let seen = seen.flatten();
    mean(seen.map(|seen| unitvec::angle_deg(seen.normal.to_array(), seen.decoded.to_array())))
}

/// The bumpy sphere as a mirror, from all sides.
fn sides(camera: &mut dyn Camera, normals: Normals) -> Result<Vec<RgbImage>> {
    (0..SIDES).map(|side| camera.picture(&shot(normals, Material::Mirror, View::Side(side)))).collect()
}

/// The rank correlation of the mirror's differences with the errors, for all codecs of 16 bits: on a sphere that is
/// seen from all sides, and in the scene, whose normals are spread otherwise than the sphere's.
fn ranks(camera: &mut dyn Camera, float: &RgbImage) -> Result<Vec<Number>> {
    const BITS: u32 = 16;
    let taken = |normals| shot(normals, Material::Mirror, View::Scene);
    let curved: Vec<bool> = camera.surface(&taken(Normals::Float))?.iter().map(is_curved).collect();
    let all = vec![true; curved.len()];
    let float_sides = sides(camera, Normals::Float)?;
    let is_asked = |codec: &&AnyCodec| codec.bits == BITS && codec.domain == Domain::Sphere && codec.is_unit;
    let (mut numbers, mut pairs) = (Vec::new(), [const { Vec::new() }; 4]);
    for codec in vectors().iter().filter(is_asked) {
        let error = measure(&mut Cpu, codec, Domain::Sphere, MEASURED, 1)?.normal.mean_deg();
        let coded_sides = sides(camera, Normals::Codec(codec))?;
        // The sky around the sphere does not differ.
        let around =
            mean(float_sides.iter().zip(&coded_sides).map(|(float, coded)| mean_where(&all, float, coded)));
        let picture = camera.picture(&taken(Normals::Codec(codec)))?;
        let (whole, on_curved) = (mean_where(&all, float, &picture), mean_where(&curved, float, &picture));
        let seen = camera.surface(&taken(Normals::Codec(codec)))?;
        let error_seen = error_shown(seen.iter().filter(|seen| is_curved(seen)));
        let found = [(error, around), (error_seen, on_curved), (error, on_curved), (error, whole)];
        pairs.iter_mut().zip(found).for_each(|(pairs, pair)| pairs.push(pair));
        for (what, value) in [("of a sphere", around), ("on the scene's curved bodies", on_curved)] {
            numbers.push(Number::new(format!("{}, mirror, mean difference {what}", codec.id), value));
        }
    }
    let names = [
        "of a sphere from all sides with the mean error over the sphere",
        "on the scene's curved bodies with the mean error of their normals",
        "on the scene's curved bodies with the mean error over the sphere",
        "of the whole scene with the mean error over the sphere",
    ];
    let correlation = |(name, pairs): (&str, &Vec<(f64, f64)>)| {
        let name = format!(
            "rank correlation of the mirror's mean difference {name}, {} codecs of {BITS} bits",
            pairs.len()
        );
        Number::new(name, rank_correlation(pairs))
    };
    numbers.extend(names.into_iter().zip(&pairs).map(correlation));
    Ok(numbers)
}

/// The parameterizations of Meyer's figure 3, by the names that it has for them.
const MEYER: [(&str, &str); 7] = [
    ("pp16", "PP"),
    ("spp16", "SPP"),
    ("spherical16", "SC"),
    ("cube16", "CM"),
    ("oct16", "ONV, domain"),
    ("oct16p", "ONV, range"),
    ("fib16", "table of 2^16 points"),
];

/// Meyer's figure 3: a highlight on the panel at 16 bits.
pub fn meyer(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let codecs = options.codecs_or(&MEYER.map(|(id, _)| id).join(" "))?;
    let mut compared = compare(camera, &codecs, Material::Glossy, View::Panel)?;
    for shown in &mut compared {
        let meyers = MEYER.iter().find(|(id, _)| *id == shown.id());
        shown.label = meyers.map_or_else(|| shown.label.clone(), |(id, name)| format!("{name} ({id})"));
    }
    compared[0].label = "FPNV (float32x3)".to_owned();
    let alt = "A highlight on a nearly flat panel, with normals in 16 bits by several codecs";
    let width = FEW[usize::from(options.small)];
    let whole = |shown: &Compared| Cell { picture: shrunk(&shown.picture, width), lines: shown.lines() };
    let cells: Vec<Cell> = compared.iter().map(whole).collect();
    let all = Shown::picture("meyer3.png", alt, sheet(&cells, 4));
    let mut pictures = vec![Shown { differences: differences(&compared), ..all }];
    pictures.extend(singles(options, &compared, "meyer3", Material::Glossy));
    let caption = "Figure 3 of Meyer et al.: the Blinn-Phong highlight of a nearly flat panel, with normals in 16 bits. The \
                   points of fib16, on a spherical Fibonacci lattice, stand for their table.";
    Ok(Figure::new("meyer", "Meyer's figure 3: a highlight", caption, pictures))
}
