//! The survey's figures, Meyer's third, and some that neither has: pictures with their numbers, from one run.

mod camera;
mod canvas;
mod compare;
mod dither;
mod folder;
mod paint;
mod pictures;
mod rounding;
mod sphere;

pub use camera::Camera;
pub use compare::{Difference, rank_correlation};
pub use folder::Folder;

use crate::catalogue::CodecInfo;
use crate::isa::{USUAL, find_generation, pareto};
use crate::render::Material;
use crate::vulkan::DeviceInfo;
use crate::{Error, Result};
use clap::ValueEnum;
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// A figure, by the survey's number or by what it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// Mirror and glossy surfaces with oct16p, snorm8x3, oct24p and floats.
    #[value(name = "1")]
    One,
    /// How latlong numbers its patches.
    #[value(name = "2")]
    Two,
    /// How oct unfolds the sphere.
    #[value(name = "3")]
    Three,
    /// Where precise rounding goes.
    #[value(name = "4")]
    Four,
    /// Representable unit vectors.
    #[value(name = "5")]
    Five,
    /// Lambertian surfaces.
    #[value(name = "6")]
    Six,
    /// Glossy surfaces.
    #[value(name = "7")]
    Seven,
    /// The survey's codecs with three materials.
    #[value(name = "8")]
    Eight,
    /// Meyer's figure 3: a highlight on a panel.
    Meyer,
    /// Plain and dithered normals.
    Dither,
    /// Error maps.
    Errors,
    /// Error against cost.
    Front,
}

impl Part {
    /// True of what takes a device that draws.
    pub fn is_rendered(self) -> bool {
        match self {
            Self::One | Self::Six | Self::Seven | Self::Eight | Self::Meyer | Self::Dither => true,
            Self::Two | Self::Three | Self::Four | Self::Five | Self::Errors | Self::Front => false,
        }
    }
}

/// What to draw, and how.
pub struct Options {
    /// Pictures for a page instead of a screen.
    pub small: bool,
    /// Codecs in place of those that a figure has; none for those.
    pub codecs: Vec<&'static CodecInfo>,
    /// Materials of figure 8.
    pub materials: Vec<Material>,
    /// True where figure 8 has each picture as a file of its own, besides its sheets.
    pub whole: bool,
}

impl Options {
    fn codecs_or(&self, usual: &[&str]) -> Result<Vec<&'static CodecInfo>> {
        if self.codecs.is_empty() { sphere::named(usual) } else { Ok(self.codecs.clone()) }
    }
}

/// A figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct Figure {
    /// Its number in the survey, or its name.
    pub id: String,
    /// Its title.
    pub title: String,
    /// What it shows.
    pub caption: String,
    /// Its pictures.
    pub pictures: Vec<Shown>,
    /// What was counted and measured for it, besides the pictures' differences.
    pub numbers: Vec<Number>,
}

/// A picture of a figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct Shown {
    /// Name of its file.
    pub file: String,
    /// What it shows, in words, for those who do not see it.
    pub alt: String,
    /// The one codec and material that it shows, if it does not show several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<Subject>,
    /// How far what it shows is from the same with floats.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differences: Vec<Labelled>,
    /// Width and height, of those that have pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
    #[serde(skip)]
    content: Content,
}

/// What a picture is of.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Subject {
    /// Identifier of the codec, or `float`.
    pub codec: String,
    /// The material of the surfaces.
    pub material: String,
}

/// A difference with a name.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Labelled {
    /// Of what.
    pub label: String,
    /// The difference of the whole picture to that of floats.
    #[serde(flatten)]
    pub difference: Difference,
}

#[derive(Debug, Default)]
enum Content {
    /// In its file.
    #[default]
    File,
    Pixels(RgbImage),
    Svg(String),
}

impl Shown {
    fn new(file: &str, alt: &str, content: Content) -> Self {
        let size = match &content {
            Content::Pixels(picture) => Some([picture.width(), picture.height()]),
            Content::File | Content::Svg(_) => None,
        };
        let (file, alt) = (file.to_owned(), alt.to_owned());
        Self { file, alt, of: None, differences: Vec::new(), size, content }
    }

    fn picture(file: &str, alt: &str, picture: RgbImage) -> Self {
        Self::new(file, alt, Content::Pixels(picture))
    }

    /// The file's bytes; none of a picture that was not drawn by this run.
    ///
    /// # Errors
    /// [`Error::Write`] where a picture cannot be encoded.
    pub fn bytes(&self) -> Result<Vec<u8>> {
        match &self.content {
            Content::File => Ok(Vec::new()),
            Content::Svg(text) => Ok(text.clone().into_bytes()),
            Content::Pixels(picture) => canvas::png(picture).map_err(|error| {
                Error::writing(self.file.as_ref(), std::io::Error::other(error.to_string()))
            }),
        }
    }
}

/// A number with its name.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Number {
    /// Of what.
    pub name: String,
    /// How much.
    pub value: f64,
}

impl Number {
    fn new(name: &str, value: f64) -> Self {
        Self { name: name.to_owned(), value }
    }

    /// Whole numbers as they are, others with four digits.
    pub fn in_words(&self) -> String {
        let Self { value, .. } = self;
        if value.fract() == 0.0 {
            return format!("{value:.0}");
        }
        let digits = (3 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
        format!("{value:.digits$}")
    }
}

impl Figure {
    fn new(id: &str, title: &str, caption: String, pictures: Vec<Shown>) -> Self {
        Self { id: id.to_owned(), title: title.to_owned(), caption, pictures, numbers: Vec::new() }
    }

    fn with(self, numbers: Vec<Number>) -> Self {
        Self { numbers, ..self }
    }
}

/// The figures of a run.
#[derive(Debug, Serialize, Deserialize)]
pub struct Figures {
    /// What rendered; none where nothing was.
    pub device: Option<DeviceInfo>,
    /// Version of the program.
    pub version: String,
    /// The figures.
    pub figures: Vec<Figure>,
}

/// The front of error against cost, as [`pareto`] draws it.
fn front() -> Result<Figure> {
    let failed = |error: String| Error::Usage(format!("the front cannot be drawn: {error}"));
    let generation =
        find_generation(USUAL).ok_or_else(|| failed(format!("no costs of {USUAL} ship with the program")))?;
    let report = generation.shipped()?;
    let svg = pareto::svg(&report).map_err(|error| failed(error.to_string()))?;
    let caption = format!(
        "Largest error against cost on {}, decoding and encoding, in cycles. A codec with a name is on the front of its size: none that \
         takes as much room is both finer and cheaper.",
        report.subject()
    );
    let alt = "Chart of error over cost, with the front of each size as a line";
    Ok(Figure::new(
        "front",
        "Error against cost",
        caption,
        vec![Shown::new("front.svg", alt, Content::Svg(svg))],
    ))
}

/// Draws one figure.
///
/// # Errors
/// What rendering and measuring meet.
pub fn draw(part: Part, options: &Options, camera: &mut dyn Camera) -> Result<Figure> {
    let figure = drawn(part, options, camera)?;
    let ignores = matches!(part, Part::Two | Part::Three | Part::Four | Part::Dither | Part::Front);
    if ignores || options.codecs.is_empty() {
        return Ok(figure);
    }
    let asked: Vec<&str> = options.codecs.iter().map(|codec| codec.id).collect();
    let caption =
        format!("Of {}, in place of the codecs that this speaks of: {}", asked.join(", "), figure.caption);
    Ok(Figure { caption, ..figure })
}

fn drawn(part: Part, options: &Options, camera: &mut dyn Camera) -> Result<Figure> {
    match part {
        Part::One => pictures::one(camera, options),
        Part::Six => pictures::difference(camera, options, Material::Lambertian),
        Part::Seven => pictures::difference(camera, options, Material::Glossy),
        Part::Eight => pictures::eight(camera, options),
        Part::Meyer => pictures::meyer(camera, options),
        Part::Dither => dither::dither(camera, options),
        Part::Two => Ok(sphere::numbering(options)),
        Part::Three => Ok(sphere::unfolding(options)),
        Part::Four => rounding::rounding(options),
        Part::Five => sphere::points(options),
        Part::Errors => sphere::errors(options),
        Part::Front => front(),
    }
}

impl Figures {
    /// A page in Markdown with all pictures, their captions and numbers.
    pub fn to_markdown(&self) -> String {
        let mut text = "# Figures\n\nMade by `unitvec figures`".to_owned();
        // Writing to a String cannot fail.
        if let Some(device) = &self.device {
            let _ = write!(text, " on {} ({})", device.name, device.driver);
        }
        text += ". The numbers are of the same run.\n";
        for figure in &self.figures {
            figure.write_markdown(&mut text);
        }
        text
    }
}

impl Figure {
    fn write_markdown(&self, text: &mut String) {
        // Writing to a String cannot fail.
        let _ = write!(text, "\n## {}\n\n{}\n", self.heading(), self.caption);
        for shown in self.pictures.iter().filter(|shown| shown.of.is_none()) {
            let _ = write!(text, "\n![{}]({})\n", shown.alt, shown.file);
            if !shown.differences.is_empty() {
                *text += "\n| picture | mean difference | largest | SSIM |\n|---|---|---|---|\n";
            }
            for Labelled { label, difference: Difference { mean, max, ssim } } in &shown.differences {
                let _ = writeln!(text, "| {label} | {mean:.3} | {max} | {ssim:.4} |");
            }
        }
        if !self.numbers.is_empty() {
            *text += "\n| number | value |\n|---|---|\n";
        }
        for number in &self.numbers {
            let _ = writeln!(text, "| {} | {} |", number.name, number.in_words());
        }
    }

    /// `Figure 5. Representable unit vectors`.
    pub fn heading(&self) -> String {
        let is_survey = self.id.starts_with(|c: char| c.is_ascii_digit());
        if is_survey { format!("Figure {}. {}", self.id, self.title) } else { self.title.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Seen, Shot};

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [(3.0, "3"), (0.123_456, "0.1235"), (12.3456, "12.35"), (1.5e-5, "0.00001500")] {
            assert_eq!(Number::new("", value).in_words(), text);
        }
    }

    /// No device to render on.
    struct Blind;

    impl Camera for Blind {
        fn picture(&mut self, _: &Shot) -> Result<RgbImage> {
            Err(Error::Usage("blind".to_owned()))
        }

        fn surface(&mut self, _: &Shot) -> Result<Vec<Option<Seen>>> {
            Err(Error::Usage("blind".to_owned()))
        }
    }

    #[test]
    fn figures_without_a_device_have_files_of_their_kind() {
        let codecs = sphere::named(&["oct16"]).unwrap();
        let options = Options { small: true, codecs, materials: vec![Material::Mirror], whole: false };
        for part in Part::value_variants().iter().copied().filter(|part| !part.is_rendered()) {
            let figure = draw(part, &options, &mut Blind).unwrap();
            for shown in &figure.pictures {
                let is_png = shown.bytes().unwrap().starts_with(b"\x89PNG");
                assert_eq!(is_png, shown.file.ends_with(".png"), "{}", shown.file);
                assert!(!shown.alt.is_empty());
            }
        }
    }
}
