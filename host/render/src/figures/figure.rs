//! A figure: its pictures and their descriptions.

use super::canvas;
use super::compare::Difference;
use crate::Result;
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use unitvec_vulkan::DeviceInfo;

/// A figure.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Figure {
    /// The figure's number in the survey, or its name.
    pub id: String,
    /// The figure's title.
    pub title: String,
    /// The figure's caption.
    pub caption: String,
    /// The figure's pictures.
    pub pictures: Vec<Shown>,
    /// Counts and measurements for the figure, besides the pictures' differences.
    pub numbers: Vec<Number>,
    /// The figure's origin, where it differs from that of the others in its folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earlier: Option<Origin>,
}

/// A picture of a figure.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Shown {
    /// Name of its file.
    pub file: String,
    /// A description in words, for those who do not see the picture.
    pub alt: String,
    /// The one codec and material that it shows, if it does not show several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<Subject>,
    /// The differences between the picture and the same with floats.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differences: Vec<Labelled>,
    /// The subjects of a sheet's places, where its cells can be slid between.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cells: Vec<Place>,
    /// Width and height, of those that have pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
    #[serde(skip)]
    pub(super) content: Content,
}

/// A picture's subject.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Subject {
    /// Identifier of the codec, or `float`.
    pub codec: String,
    /// The material of the surfaces.
    pub material: String,
}

/// A cell of a sheet.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Place {
    /// The subject.
    #[serde(flatten)]
    pub of: Subject,
    /// Left, top, width and height in the sheet, in pixels.
    pub place: [u32; 4],
}

/// A difference with a name.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Labelled {
    /// The name of the compared pictures.
    pub label: String,
    /// The difference of the whole picture to that of floats.
    #[serde(flatten)]
    pub difference: Difference,
}

#[derive(Debug, Default)]
pub(super) enum Content {
    /// Pixels that are in the picture's file.
    #[default]
    File,
    Pixels(RgbImage),
    Svg(String),
}

impl Shown {
    pub(super) fn new(file: impl Into<String>, alt: impl Into<String>, content: Content) -> Self {
        let size = match &content {
            Content::Pixels(picture) => Some([picture.width(), picture.height()]),
            Content::File | Content::Svg(_) => None,
        };
        Self { file: file.into(), alt: alt.into(), size, content, ..Self::default() }
    }

    pub(crate) fn picture(file: impl Into<String>, alt: impl Into<String>, picture: RgbImage) -> Self {
        Self::new(file, alt, Content::Pixels(picture))
    }

    /// The file's bytes; `None` for a picture that this run did not draw.
    ///
    /// # Errors
    /// [`unitvec_files::Error::Write`] where a picture cannot be encoded.
    pub fn bytes(&self) -> Result<Vec<u8>> {
        match &self.content {
            Content::File => Ok(Vec::new()),
            Content::Svg(text) => Ok(text.clone().into_bytes()),
            Content::Pixels(picture) => canvas::png(picture).map_err(|error| {
                unitvec_files::Error::writing(self.file.as_ref(), std::io::Error::other(error.to_string()))
                    .into()
            }),
        }
    }
}

/// A number with its name.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Number {
    /// The name of the number.
    pub name: String,
    /// The number's value.
    pub value: f64,
}

impl Number {
    pub(super) fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value }
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
    pub(super) fn new(
        id: &str,
        title: impl Into<String>,
        caption: impl Into<String>,
        pictures: Vec<Shown>,
    ) -> Self {
        let (id, title, caption) = (id.to_owned(), title.into(), caption.into());
        Self { id, title, caption, pictures, ..Self::default() }
    }

    pub(super) fn with(self, numbers: Vec<Number>) -> Self {
        Self { numbers, ..self }
    }
}

/// The origin of figures.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The device that rendered; `None` where nothing was rendered.
    pub device: Option<DeviceInfo>,
    /// Version of the program.
    pub version: String,
}

/// The figures of a run, or of a folder.
#[derive(Debug, Serialize, Deserialize)]
pub struct Figures {
    /// The origin of all figures that state no other.
    #[serde(flatten)]
    pub origin: Origin,
    /// The figures.
    pub figures: Vec<Figure>,
}

impl Figures {
    /// A page in Markdown with all pictures, their captions and numbers.
    pub fn to_markdown(&self) -> String {
        let mut text = "# Figures\n\nMade by `unitvec figures`".to_owned();
        // Writing to a String cannot fail.
        if let Some(device) = &self.origin.device {
            let _ = write!(text, " on {} ({})", device.name, device.driver);
        }
        text += ". The numbers of a figure are of the run that drew it.\n";
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
        if let Some(origin) = self.earlier_in_words() {
            let _ = write!(text, "\n{origin}\n");
        }
        for shown in self.pictures.iter().filter(|shown| shown.of.is_none()) {
            let _ = write!(text, "\n![{}]({})\n", shown.alt, shown.file);
            if !shown.differences.is_empty() {
                *text += "\n| picture | mean difference | largest | SSIM | FLIP |\n|---|---|---|---|---|\n";
            }
            for Labelled { label, difference } in &shown.differences {
                let _ = writeln!(text, "| {label} | {} |", difference.cells().join(" | "));
            }
        }
        if !self.numbers.is_empty() {
            *text += "\n| number | value |\n|---|---|\n";
        }
        for number in &self.numbers {
            let _ = writeln!(text, "| {} | {} |", number.name, number.in_words());
        }
    }

    /// The figure's own origin in words, where it differs from that of the others.
    pub fn earlier_in_words(&self) -> Option<String> {
        let Origin { device, version } = self.earlier.as_ref()?;
        let on = device.as_ref().map(|device| format!(" on {} ({})", device.name, device.driver));
        Some(format!(
            "Made by unitvec {version}{}, in another run than the other figures.",
            on.unwrap_or_default()
        ))
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

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [(3.0, "3"), (0.123_456, "0.1235"), (12.3456, "12.35"), (1.5e-5, "0.00001500")] {
            assert_eq!(Number::new("", value).in_words(), text);
        }
    }
}
