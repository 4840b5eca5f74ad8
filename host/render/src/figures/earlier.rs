//! A folder's contents from earlier runs.

use super::{Figures, Origin, Part};
use crate::{Error, Result};
use clap::ValueEnum;
use std::collections::BTreeSet;
use std::path::Path;
use unitvec_files::{one_line, read_small};

/// The file that lists a folder's figures.
pub const LIST: &str = "figures.json";

impl Figures {
    /// The figures that a folder lists, without their pictures' bytes.
    ///
    /// # Errors
    /// [`unitvec_files::Error::Read`]; [`Error::Earlier`] if the file is no list, or names files outside the folder.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(LIST);
        let json = read_small(&path)?;
        let not_one = |reason| Error::Earlier { path: path.clone(), reason };
        let figures: Self = serde_json::from_slice(&json).map_err(|error| not_one(one_line(error)))?;
        let outside = figures.files().find(|file| Path::new(file).file_name() != Some(file.as_ref()));
        match outside {
            Some(file) => Err(not_one(one_line(format!("{file} is not the name of a file in its folder")))),
            None => Ok(figures),
        }
    }

    /// Reads a list as [`read`](Self::read) does; `None` where the folder has none.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    pub fn read_if_there(folder: &Path) -> Result<Option<Self>> {
        let is_there = folder.join(LIST).symlink_metadata().is_ok();
        is_there.then(|| Self::read(folder)).transpose()
    }

    /// The names of all pictures' files.
    fn files(&self) -> impl Iterator<Item = &str> {
        self.figures.iter().flat_map(|figure| &figure.pictures).map(|shown| shown.file.as_str())
    }

    /// Adds those figures of earlier runs that this one did not draw, with the pictures that are still in the folder, and puts all
    /// into the usual order. Gives the names of the earlier pictures that no figure has any more.
    pub fn keep(&mut self, earlier: Self, folder: &Path) -> Vec<String> {
        // Only pictures are removed, whatever a list has.
        let is_picture = |file: &&str| [".png", ".svg"].iter().any(|ending| file.ends_with(ending));
        let had: BTreeSet<String> = earlier.files().filter(is_picture).map(str::to_owned).collect();
        let Self { origin, figures } = earlier;
        if self.origin.device.is_none() && self.origin.version == origin.version {
            self.origin.device.clone_from(&origin.device);
        }
        for mut figure in figures {
            figure.pictures.retain(|shown| folder.join(&shown.file).is_file());
            if figure.pictures.is_empty() || self.figures.iter().any(|drawn| drawn.id == figure.id) {
                continue;
            }
            let Origin { mut device, version } = figure.earlier.take().unwrap_or_else(|| origin.clone());
            if Part::of_id(&figure.id).is_some_and(|part| !part.is_rendered()) {
                device = None;
            }
            let is_alike = device.is_none() || device == self.origin.device;
            if version != self.origin.version || !is_alike {
                figure.earlier = Some(Origin { device, version });
            }
            self.figures.push(figure);
        }
        let parts = Part::value_variants();
        let place = |id: &str| Part::of_id(id).and_then(|part| parts.iter().position(|other| *other == part));
        self.figures.sort_by_key(|figure| place(&figure.id).unwrap_or(parts.len()));
        let has: BTreeSet<&str> = self.files().collect();
        had.iter().filter(|file| !has.contains(file.as_str())).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Figure, Shown};
    use super::*;
    use image::RgbImage;
    use unitvec_vulkan::{DeviceInfo, DeviceKind};

    fn origin(device: Option<&str>, version: &str) -> Origin {
        let device = device.map(|name| DeviceInfo {
            index: 0,
            name: name.to_owned(),
            kind: DeviceKind::Software,
            driver: String::new(),
            api_version: String::new(),
        });
        Origin { device, version: version.to_owned() }
    }

    fn figures(origin: Origin, ids: &[(&str, &[&str])]) -> Figures {
        let shown = |file: &&str| Shown::picture(*file, "alt", RgbImage::new(1, 1));
        let figure =
            |(id, files): &(&str, &[&str])| Figure::new(id, *id, "", files.iter().map(shown).collect());
        Figures { origin, figures: ids.iter().map(figure).collect() }
    }

    /// Figures that were not drawn again stay, each with its origin; replaced pictures are to be removed.
    #[test]
    fn figures_of_earlier_runs_stay() {
        let folder = tempfile::tempdir().unwrap();
        for file in ["1.png", "1_more.png", "2.png", "6.png"] {
            std::fs::write(folder.path().join(file), b"").unwrap();
        }
        let earlier = || {
            let ids: [(&str, &[&str]); 4] = [
                ("1", &["1.png", "1_more.png"]),
                ("2", &["2.png"]),
                ("6", &["6.png", "gone.png"]),
                ("7", &["7.png"]),
            ];
            figures(origin(Some("old"), "1"), &ids)
        };
        let mut drawn = figures(origin(Some("new"), "1"), &[("5", &["5.png"]), ("1", &["1.png"])]);
        assert_eq!(drawn.keep(earlier(), folder.path()), ["1_more.png", "7.png", "gone.png"]);
        let ids: Vec<&str> = drawn.figures.iter().map(|figure| figure.id.as_str()).collect();
        assert_eq!(ids, ["1", "2", "5", "6"]);
        let others: Vec<bool> = drawn.figures.iter().map(|figure| figure.earlier.is_some()).collect();
        // Figure 2 takes no device.
        assert_eq!(others, [false, false, false, true]);
        assert!(drawn.figures[3].earlier_in_words().unwrap().contains("on old"));

        // A run that rendered nothing leaves the device as it was.
        let mut drawn = figures(origin(None, "1"), &[("5", &["5.png"])]);
        drawn.keep(earlier(), folder.path());
        assert_eq!(drawn.origin, origin(Some("old"), "1"));
        assert!(drawn.figures.iter().all(|figure| figure.earlier.is_none()));
        // Every figure of another version names it.
        let mut drawn = figures(origin(None, "2"), &[("5", &["5.png"])]);
        drawn.keep(earlier(), folder.path());
        assert_eq!(drawn.figures.iter().filter(|figure| figure.earlier.is_some()).count(), 3);
    }

    #[test]
    fn lists_of_other_kinds_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Figures::read_if_there(folder.path()).unwrap().is_none());
        let outside = r#"{"device": null, "version": "1", "figures": [{"id": "1", "title": "", "caption": "", "numbers": [],
            "pictures": [{"file": "../1.png", "alt": ""}]}]}"#;
        for (json, word) in [("{}", "not of `unitvec figures`"), (outside, "../1.png")] {
            std::fs::write(folder.path().join(LIST), json).unwrap();
            let error = Figures::read_if_there(folder.path()).unwrap_err().to_string();
            assert!(error.contains(word) && error.lines().count() == 1, "{error}");
        }
    }
}
