//! Pictures of codecs over those of floats, to slide between.

use super::{Files, bytes, data, uri};
use crate::figures::{Figures, Place, Shown, Subject, cut};
use crate::{Error, Result};
use serde::Serialize;
use std::collections::BTreeMap;
use unitvec_catalogue::find;

/// The figure whose pictures the page slides between.
pub const VIEWED: &str = "8";

#[derive(Default, Serialize)]
pub struct Viewer {
    materials: Vec<String>,
    codecs: Vec<String>,
    /// The codec and the material of the first look.
    first: [String; 2],
    width: u32,
    height: u32,
    /// Pixels of the page across a pixel of a picture.
    scale: u32,
    pictures: BTreeMap<String, Picture>,
}

#[derive(Serialize)]
pub struct Picture {
    pub uri: String,
    pub words: String,
}

/// Parts of a sheet are shown about as wide as this.
const WIDTH: u32 = 640;

/// A viewer of single pictures; of the cells of sheets where there are none; `None` where the sheets do not list cells.
///
/// # Errors
/// A picture that `files` lacks, or that does not match the figures.
pub fn of(single: &[&Shown], sheets: &[&Shown], files: &Files) -> Result<Option<Viewer>> {
    let mut viewer = Viewer::whole();
    for shown in single {
        let (Some(of), Some(size)) = (&shown.of, shown.size) else { continue };
        let words = shown.differences.first().map_or_else(String::new, |one| one.difference.in_words());
        viewer.add(of, size, Picture { uri: uri(&shown.file, files)?, words });
    }
    if viewer.pictures.is_empty() {
        for sheet in sheets.iter().filter(|sheet| !sheet.cells.is_empty()) {
            let places: Vec<[u32; 4]> = sheet.cells.iter().map(|cell| cell.place).collect();
            let wrong = |reason| Error::Unlike { file: sheet.file.clone(), reason };
            let pictures = cut(bytes(&sheet.file, files)?, &places).map_err(wrong)?;
            for (Place { of, place: [.., width, height] }, png) in sheet.cells.iter().zip(pictures) {
                let words = words(sheet, &of.codec);
                viewer.add(of, [*width, *height], Picture { uri: data("image/png", &png), words });
            }
        }
        viewer.scale = (WIDTH / viewer.width.max(1)).max(1);
    }
    Ok(viewer.finish())
}

/// A sheet's words about a codec's difference to floats.
fn words(sheet: &Shown, codec: &str) -> String {
    let name = find(codec).map_or(codec, |codec| codec.survey_name);
    let found = sheet.differences.iter().find(|one| one.label == name);
    found.map_or_else(String::new, |one| one.difference.in_words())
}

impl Viewer {
    /// A viewer of whole pictures, none so far.
    pub fn whole() -> Self {
        Self { scale: 1, ..Self::default() }
    }

    /// Adds a picture. The first one's size is that of all.
    pub fn add(&mut self, of: &Subject, [width, height]: [u32; 2], picture: Picture) {
        let Subject { codec, material } = of;
        for (list, name) in [(&mut self.materials, material), (&mut self.codecs, codec)] {
            if !list.contains(name) {
                list.push(name.clone());
            }
        }
        if self.pictures.is_empty() {
            (self.width, self.height) = (width, height);
        }
        self.pictures.insert(format!("{material}/{codec}"), picture);
    }

    /// `None` unless there are floats and all codecs with every material.
    pub fn finish(mut self) -> Option<Self> {
        let mut names = self
            .materials
            .iter()
            .flat_map(|material| self.codecs.iter().map(move |codec| format!("{material}/{codec}")));
        let is_whole = names.all(|name| self.pictures.contains_key(&name));
        let has_float = self.codecs.iter().any(|codec| codec == "float");
        self.codecs.retain(|codec| codec != "float");
        self.first = [self.codecs.first()?.clone(), self.materials.last()?.clone()];
        (is_whole && has_float).then_some(self)
    }
}

/// The reason why the page has nothing to slide between, and the command to run.
pub fn note(figures: &Figures, not_rendered: Option<&str>) -> String {
    if let Some(reason) = not_rendered {
        return format!(
            "{reason} The rendered figures are left out, and with them the slider between floats and codecs. `unitvec report` on a \
             machine with lavapipe or a GPU has them, and so has `--figures DIR` with a folder that `unitvec figures` made there."
        );
    }
    let has_figure = figures.figures.iter().any(|figure| figure.id == VIEWED);
    let reason = if has_figure { "has no pictures of this kind" } else { "is not among these figures" };
    format!(
        "There is no slider between floats and codecs, since figure {VIEWED} {reason}: `unitvec figures --only {VIEWED} --out DIR` adds it."
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_codec(codec: &str, place: [u32; 4]) -> Place {
        Place { of: Subject { codec: codec.to_owned(), material: "mirror".to_owned() }, place }
    }

    /// Sheets are cut where they list cells; otherwise the page shows the command to run.
    #[test]
    fn sheets_are_cut() {
        let json = r#"{"device": null, "version": "1", "figures": [{"id": "8", "title": "", "caption": "", "numbers": [],
            "pictures": [{"file": "a.png", "alt": "", "differences": [{"label": "oct16P", "mean": 1.0, "max": 2, "ssim": 0.5, "flip": 0.25}]}]}]}"#;
        let mut figures: Figures = serde_json::from_str(json).unwrap();
        let mut png = std::io::Cursor::new(Vec::new());
        image::RgbImage::new(20, 10).write_to(&mut png, image::ImageFormat::Png).unwrap();
        let files = Files::from([("a.png".to_owned(), png.into_inner())]);
        let of_figures = |figures: &Figures| of(&[], &[&figures.figures[0].pictures[0]], &files);
        assert!(of_figures(&figures).unwrap().is_none());
        assert!(note(&figures, None).contains("unitvec figures --only 8"));
        assert!(note(&figures, Some("No device.")).starts_with("No device. "));

        let sheet = &mut figures.figures[0].pictures[0];
        sheet.cells = vec![of_codec("float", [0, 0, 10, 10]), of_codec("oct16p", [10, 0, 10, 10])];
        let viewer = of_figures(&figures).unwrap().unwrap();
        assert_eq!((viewer.width, viewer.height, viewer.scale), (10, 10, 64));
        assert_eq!(viewer.codecs, ["oct16p"]);
        assert_eq!(viewer.pictures["mirror/oct16p"].words, "mean 1.00 max 2 SSIM 0.500 FLIP 0.250");
        figures.figures[0].pictures[0].cells[1].place[0] = 11;
        assert!(of_figures(&figures).is_err_and(|error| error.to_string().contains("no part")));
    }
}
