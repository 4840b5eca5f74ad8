//! Figures of the rendered scene: 1, 6, 7, 8 and Meyer's third.

use super::camera::{Camera, closer, shot, shrunk};
use super::canvas::{Cell, GAP, Type, crop, framed, places};
use super::compare::{Difference, Original, amplified, most_different};
use super::ranks::ranks;
use super::{Figure, Labelled, Number, Options, Place, Shown, Subject};
use crate::{Material, Normals, Result, View};
use image::RgbImage;
use unitvec_catalogue::AnyCodec;

/// The factor of differences, as in the survey.
pub const TIMES: u8 = 8;

/// The adjective of a material's surfaces in texts.
fn adjective(material: Material) -> &'static str {
    if material == Material::Ggx { "GGX" } else { material.name() }
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
        vec![
            self.label.clone(),
            self.difference.map_or_else(|| "96 bits".to_owned(), |difference| difference.in_words()),
        ]
    }

    fn id(&self) -> &'static str {
        self.codec.map_or("float", |codec| codec.id)
    }

    fn normals(&self) -> Normals {
        self.codec.map_or(Normals::Float, Normals::Codec)
    }

    fn subject(&self, material: Material) -> Subject {
        Subject { codec: self.id().to_owned(), material: material.name().to_owned() }
    }

    /// Describes this picture as a file of its own.
    fn shown(&self, figure: &str, material: Material) -> Shown {
        let alt = format!("{} surfaces, normals as {}", adjective(material), self.label);
        let file = format!("{figure}_{}_{}.png", material.name(), self.id());
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
    let original = Original::new(&float);
    let compared = codecs.iter().map(|codec| {
        let picture = take(camera, Normals::Codec(codec), material, view)?;
        let difference = Some(original.difference(&picture));
        Ok(Compared { label: codec.survey_name.to_owned(), codec: Some(*codec), picture, difference })
    });
    let compared = compared.collect::<Result<Vec<Compared>>>()?;
    let float = Compared { label: "float32x3".to_owned(), codec: None, picture: float, difference: None };
    Ok(std::iter::once(float).chain(compared).collect())
}

/// Widths of the parts of pictures that sheets show, for whole figures and for small ones.
pub const MANY: [u32; 2] = [320, 190];
const FEW: [u32; 2] = [480, 230];

/// Widths of cells.
const WIDE: [u32; 2] = [480, 320];
const HALF: [u32; 2] = [320, 172];

/// The part of pictures that a sheet shows: where the first codec's differs most from that of floats.
pub fn window(options: &Options, widths: [u32; 2], float: &RgbImage, coded: &RgbImage) -> [u32; 4] {
    let width = widths[usize::from(options.small)];
    most_different(float, coded, [width, width * float.height() / float.width().max(1)])
}

/// A part of a part, a third as wide and high, where pictures differ most.
fn closest(float: &RgbImage, coded: &RgbImage, part: [u32; 4]) -> [u32; 4] {
    let third = [part[2], part[3]].map(|side| (side / 3).max(1));
    let [left, top, width, height] = most_different(&crop(float, part), &crop(coded, part), third);
    [part[0] + left, part[1] + top, width, height]
}

/// The place of a part of a view in a picture of another part of it, this wide.
fn within(part: [u32; 4], view: [u32; 4], width: u32) -> [u32; 4] {
    let scaled = |length: u32| length * width / view[2].max(1);
    [part[0] - view[0], part[1] - view[1], part[2], part[3]].map(scaled)
}

/// A part of each picture, rendered larger, and beside it its difference to that of floats. Floats, which have none, have the
/// whole view there, in which the part is framed.
fn zoomed(
    camera: &mut dyn Camera,
    compared: &[Compared],
    material: Material,
    part: [u32; 4],
    width: u32,
) -> Result<Vec<[RgbImage; 2]>> {
    let float = &compared[0].picture;
    let view = [0, 0, float.width(), float.height()];
    let mut beside = framed(&shrunk(float, width), within(part, view, width));
    let mut zoomed: Vec<[RgbImage; 2]> = Vec::new();
    for shown in compared {
        let picture = closer(camera, &shot(shown.normals(), material, View::Scene), part, width)?;
        if let Some([float, _]) = zoomed.first() {
            beside = amplified(float, &picture, TIMES);
        }
        zoomed.push([picture, beside.clone()]);
    }
    Ok(zoomed)
}

const HEADLINE: &str = "96 bits \u{2192} 24 bits, and reflections hardly change";

/// Figure 1: mirror and glossy.
pub fn one(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let codecs = options.codecs_or("oct16p snorm8x3 oct24p")?;
    let width = WIDE[usize::from(options.small)];
    let mirror = compare(camera, &codecs, Material::Mirror, View::Scene)?;
    let glossy = compare(camera, &codecs, Material::Glossy, View::Scene)?;
    let part = |of: &[Compared]| window(options, FEW, &of[0].picture, &of[1].picture);
    let (wide, shine) = (part(&mirror), part(&glossy));
    let near = closest(&mirror[0].picture, &mirror[1].picture, wide);
    let highlights = zoomed(camera, &glossy, Material::Glossy, shine, width)?;
    let edges = zoomed(camera, &mirror, Material::Mirror, near, width)?;
    let reflections = zoomed(camera, &mirror, Material::Mirror, wide, width)?;
    let cells = reflections.iter().zip(&edges).zip(&highlights).zip(&mirror);
    let cells = cells.map(|((([reflection, beside], [edge, _]), [highlight, _]), shown)| Cell {
        picture: options.theme.stacked(&[
            &framed(reflection, within(near, wide, width)),
            edge,
            beside,
            highlight,
        ]),
        lines: vec![format!("{} bits", shown.codec.map_or(96, |codec| codec.bits)), shown.label.clone()],
    });
    let mut cells: Vec<Cell> = cells.collect();
    // Floats come last, as in the survey.
    cells.rotate_left(1);
    let columns = options.theme.headed_sheet(&cells, cells.len() as u32, 1.6);
    let words = format!(
        "From above: a panel that mirrors lamps; the framed edge, three times larger; the mirror's difference to floats \u{d7} \
         {TIMES}, and for floats the whole view; a highlight. snorm8x3 has a byte for each component."
    );
    let alt = "Normals as oct16P, snorm8x3, oct24P and floats: the mirrored lamps of a panel, an edge of one, the difference to \
               floats, and a highlight";
    let letters = Type { size: columns.width() as f32 / 38.0, is_bold: true };
    let mut head = options.theme.blank(columns.width(), GAP + letters.line() as u32);
    if options.codecs.is_empty() {
        head.write(HEADLINE, (GAP as f32, GAP as f32), letters, false, options.theme.ink);
    }
    let all = options.theme.captioned(&options.theme.stacked(&[&head.0, &columns]), &words);
    let shown = Shown::picture("figure1.png", alt, all);
    let (mut off, mut pictures) = (Vec::new(), Vec::new());
    for (compared, material) in [(&mirror, Material::Mirror), (&glossy, Material::Glossy)] {
        let named =
            |one: Labelled| Labelled { label: format!("{}, {}", adjective(material), one.label), ..one };
        off.extend(differences(compared).into_iter().map(named));
        pictures.extend(singles(options, compared, "figure1", material));
    }
    pictures.insert(0, Shown { differences: off, ..shown });
    let caption = "Mirror and glossy reflections with normals of a G-buffer in 16 bits, in 24 bits of snorm8x3, in 24 bits of \
                   oct24P, and as floats. The parts where the first differs most. Differences to floats are of the whole picture, \
                   in steps of 1/255.";
    Ok(Figure::new("1", "Mirror and glossy reflections", caption, pictures))
}

const FIGURE_7: &str = "The survey says that differences are far more apparent than on Lambertian surfaces, and that steps \
                        show where surfaces are nearly flat.";

/// Figures 6 and 7: the codec that the survey's figures show.
pub fn difference(camera: &mut dyn Camera, options: &Options, material: Material) -> Result<Figure> {
    let codecs = options.codecs_or("eqarea_ellipse16")?;
    let compared = compare(camera, &codecs, material, View::Scene)?;
    let (float, mut cells, mut numbers) = (&compared[0].picture, Vec::new(), Vec::new());
    let width = if options.small { 360 } else { 640 };
    for shown in &compared {
        cells.push(Cell { picture: shrunk(&shown.picture, width), lines: shown.lines() });
        let Some(difference) = shown.difference else { continue };
        let amplified = amplified(float, &shown.picture, TIMES);
        let black = amplified.pixels().filter(|pixel| pixel.0.iter().all(|value| *value <= TIMES)).count();
        let black = black as f64 / f64::from(float.width() * float.height());
        let words = format!("at most one step: {:.1} % of pixels", 100.0 * black);
        cells.push(Cell {
            picture: shrunk(&amplified, width),
            lines: vec![format!("difference \u{d7} {TIMES}"), words],
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
        capital(adjective(material))
    );
    let alt =
        format!("{} surfaces with floats, with a 16-bit codec, and the difference", adjective(material));
    let shown =
        Shown::picture(format!("figure{id}.png"), alt, options.theme.captioned_sheet(&cells, 3, &caption));
    let mut pictures = vec![Shown { differences: differences(&compared), ..shown }];
    pictures.extend(singles(options, &compared, &format!("figure{id}"), material));
    Ok(Figure::new(id, format!("{} surfaces", capital(adjective(material))), caption, pictures).with(numbers))
}

fn capital(word: &str) -> String {
    let (first, rest) = word.split_at(1.min(word.len()));
    first.to_uppercase() + rest
}

/// The codecs of figure 8 in columns by their bits, after floats, and the 32 bits that hold three components.
const EIGHT: &str = "snorm8x3 snorm10x3 oct16 oct24 oct32 oct16p oct24p oct32p eqarea_ellipse16 eqarea_ellipse24 \
    eqarea_ellipse32 spherical16 spherical24 spherical32 latlong16 latlong24 latlong32";

/// Columns of figure 8: 16, 24 and 32 bits.
const COLUMNS: u32 = 3;

/// Figure 8: its codecs with all materials.
pub fn eight(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let codecs = options.codecs_or(EIGHT)?;
    let width = HALF[usize::from(options.small)];
    let (mut sheets, mut pictures, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    for material in &options.materials {
        let compared = compare(camera, &codecs, *material, View::Scene)?;
        let float = &compared[0].picture;
        let coarsest = compared[1..].iter().min_by_key(|shown| shown.codec.map(|codec| codec.bits));
        let part = coarsest.map_or([0; 4], |shown| window(options, MANY, float, &shown.picture));
        let surfaces = adjective(*material);
        let alt = format!(
            "{surfaces} surfaces with the normals of all codecs of the figure, and their differences"
        );
        let zooms = zoomed(camera, &compared, *material, part, width)?;
        let cells = zooms.iter().zip(&compared);
        let cells = cells.map(|([zoom, other], shown)| Cell {
            picture: options.theme.beside(zoom, other),
            lines: shown.lines(),
        });
        let cells: Vec<Cell> = cells.collect();
        let words = format!(
            "Normals in 16, 24 and 32 bits, by columns; in the first row floats, and components of 8 and of 10 bits. Left a part of \
             the {surfaces} surfaces, right its difference to floats \u{d7} {TIMES}, or of floats the whole view. Numbers are of whole \
             views: the difference in steps of 1/255, the structural similarity, and FLIP."
        );
        let all = options.theme.captioned_sheet(&cells, COLUMNS, &words);
        let all = Shown::picture(format!("figure8_{}.png", material.name()), alt, all);
        let places = compared.iter().map(|shown| shown.subject(*material)).zip(places(&cells, COLUMNS));
        let places =
            places.map(|(of, [left, top, _, height])| Place { of, place: [left, top, width, height] });
        sheets.push(Shown { differences: differences(&compared), cells: places.collect(), ..all });
        if options.whole {
            pictures.extend(compared.iter().map(|shown| shown.shown("figure8", *material)));
        }
        if *material == Material::Mirror && options.codecs.is_empty() {
            numbers.extend(ranks(camera, float)?);
        }
    }
    sheets.extend(pictures);
    let mut caption = "The codecs of the survey's figure 8 and snorm10x3, by family and bits: the part where the first of the fewest \
                       bits differs most. The numbers are of whole pictures: the mean and the largest difference to floats, in \
                       steps of 1/255, the structural similarity, and FLIP (Andersson et al. 2020), 0 for equal pictures."
        .to_owned();
    if !numbers.is_empty() {
        caption += " The panel shows only a few cells of a 16-bit code, so chance decides which of these codecs looks worst on it. \
                    The numbers below therefore rank all 16-bit codecs on a bumpy mirror sphere, seen from all sides.";
    }
    Ok(Figure::new("8", "Codecs and materials", caption, sheets).with(numbers))
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
    let width = if options.small { 280 } else { 480 };
    let whole = |shown: &Compared| Cell { picture: shrunk(&shown.picture, width), lines: shown.lines() };
    let cells: Vec<Cell> = compared.iter().map(whole).collect();
    let caption = "Figure 3 of Meyer et al.: the Blinn-Phong highlight of a nearly flat panel, with normals in 16 bits. The \
                   points of fib16, on a spherical Fibonacci lattice, stand for their table.";
    let all = Shown::picture("meyer3.png", alt, options.theme.captioned_sheet(&cells, 4, caption));
    let mut pictures = vec![Shown { differences: differences(&compared), ..all }];
    pictures.extend(singles(options, &compared, "meyer3", Material::Glossy));
    Ok(Figure::new("meyer", "Meyer's figure 3: a highlight", caption, pictures))
}
