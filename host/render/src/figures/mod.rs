//! The survey's figures, Meyer's third, and some that neither has: pictures with their numbers, from one run.

mod camera;
mod canvas;
mod caps;
mod compare;
mod dense;
pub mod detail;
mod dither;
mod earlier;
mod errors;
mod figure;
mod filtering;
mod flip;
mod latlong;
pub mod model;
mod paint;
mod pictures;
mod points;
mod ranks;
mod rotations;
mod rounding;
mod unfolding;

pub use camera::Camera;
pub use canvas::Theme;
pub(crate) use canvas::cut;
pub use compare::{Difference, Original, rank_correlation};
pub use figure::{Figure, Figures, Labelled, Number, Origin, Place, Shown, Subject};
pub use image::RgbImage;

use crate::{Error, Material, Result};
use clap::ValueEnum;
use figure::Content;
use unitvec_catalogue::{AnyCodec, find_vector};
use unitvec_choose::costs::{USUAL, find_generation};
use unitvec_lab::isa::pareto;

/// A figure, by the survey's number or by what it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// A mirror, an edge in it and a highlight with oct16p, snorm8x3, oct24p and floats.
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
    /// The survey's codecs with all materials.
    #[value(name = "8")]
    Eight,
    /// Meyer's figure 3: a highlight on a panel.
    Meyer,
    /// Plain and dithered normals.
    Dither,
    /// Error maps.
    Errors,
    /// Rotations in 32 bits: the way of a turning pointer, and error maps.
    Rotations,
    /// Error maps of caps.
    Caps,
    /// Errors of both halves of the sphere, of unequal precision.
    Dense,
    /// Errors of components that are filtered before they are decoded.
    Filtering,
    /// Error against cost.
    Front,
}

impl Part {
    /// The figure of an identifier in `--only` and figures.json; `None` for others.
    pub fn of_id(id: &str) -> Option<Self> {
        Self::from_str(id, false).ok()
    }

    /// True for figures that need a device that draws.
    pub fn is_rendered(self) -> bool {
        matches!(self, Self::One | Self::Six | Self::Seven | Self::Eight | Self::Meyer | Self::Dither)
    }
}

/// The figures to draw, and their options.
pub struct Options {
    /// Pictures for a page instead of a screen.
    pub small: bool,
    /// The colours around pictures.
    pub theme: Theme,
    /// Codecs in place of a figure's own; empty for its own.
    pub codecs: Vec<&'static AnyCodec>,
    /// Materials of figure 8.
    pub materials: Vec<Material>,
    /// True where figure 8 has each picture as a file of its own, besides its sheets.
    pub whole: bool,
}

impl Options {
    /// The codecs asked for, or else these, by their identifiers.
    fn codecs_or(&self, usual: &str) -> Result<Vec<&'static AnyCodec>> {
        let usual = || named(&usual.split(' ').collect::<Vec<_>>());
        if self.codecs.is_empty() { usual() } else { Ok(self.codecs.clone()) }
    }
}

/// A chart in black on white, in the theme's colours.
fn themed(svg: String, theme: Theme) -> Content {
    let [ink, paper] = [theme.ink, theme.paper].map(|[r, g, b]| format!("#{r:02X}{g:02X}{b:02X}"));
    Content::Svg(svg.replace("#000000", &ink).replace("#FFFFFF", &paper))
}

/// The front of error against cost, as [`pareto`] draws it.
fn front(theme: Theme) -> Result<Figure> {
    let failed = |error: String| Error::Chart(error);
    let generation =
        find_generation(USUAL).ok_or_else(|| failed(format!("no costs of {USUAL} ship with the program")))?;
    let report = generation.shipped()?;
    let svg = pareto::svg(&report).map_err(|error| failed(error.to_string()))?;
    let caption = format!(
        "The error's bound against cost on {}, decoding and encoding, in cycles. A codec with a name is on the front of its size: none that \
         takes as much room is both finer and cheaper.",
        report.subject()
    );
    let alt = "Chart of the error's bound over cost, with the front of each size as a line";
    let pictures = vec![Shown::new("front.svg", alt, themed(svg, theme))];
    Ok(Figure::new("front", "Error against cost", caption, pictures))
}

/// Draws one figure.
///
/// # Errors
/// Any error of rendering and measuring.
pub fn draw(part: Part, options: &Options, camera: &mut dyn Camera) -> Result<Figure> {
    let figure = drawn(part, options, camera)?;
    use Part::{Eight, Errors, Five, Meyer, One, Seven, Six};
    let takes_codecs = matches!(part, One | Five | Six | Seven | Eight | Meyer | Errors);
    if !takes_codecs || options.codecs.is_empty() {
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
        Part::Two => Ok(latlong::numbering(options)),
        Part::Three => Ok(unfolding::unfolding(options)),
        Part::Four => rounding::rounding(options),
        Part::Five => points::points(options),
        Part::Errors => errors::errors(options),
        Part::Rotations => rotations::rotations(options),
        Part::Caps => Ok(caps::caps(options)),
        Part::Dense => dense::trade(options),
        Part::Filtering => Ok(filtering::filtering(options)),
        Part::Front => front(options.theme),
    }
}

/// Codecs of vectors by their names.
///
/// # Errors
/// [`UnknownCodec`](unitvec_catalogue::UnknownCodec) for an unknown name, and for a codec of frames.
pub fn named(ids: &[impl AsRef<str>]) -> Result<Vec<&'static AnyCodec>> {
    ids.iter().map(|id| Ok(find_vector(id.as_ref())?)).collect()
}
