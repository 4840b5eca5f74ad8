//! The page of `unitvec compare`: a mesh of one's own with codecs. It is one file and loads nothing;
//! without scripts it lacks the slider between before and after.

use super::viewer::{Picture, Viewer};
use super::{data, render};
use crate::figures::model::{Compared, OfCodec, TIMES};
use crate::figures::{Shown, Subject};
use crate::{Error, Material, Result};
use image::RgbImage;
use minijinja::{Value, context};
use unitvec_vulkan::DeviceInfo;

/// The contents of a page.
pub struct Contents<'a> {
    /// The mesh file's name.
    pub file: String,
    /// The pictures.
    pub compared: &'a Compared,
    /// True where the view is the worst one.
    pub is_worst: bool,
    /// The device that rendered.
    pub device: &'a DeviceInfo,
    /// The errors of the file's vectors, a row for each codec: its name, bits and vectors, and mean, median, 99th percentile and
    /// maximum in degrees.
    pub errors: Vec<[String; 7]>,
    /// What else is to be said of the file, in sentences.
    pub notes: Vec<String>,
}

/// Makes the page.
///
/// # Errors
/// Any error of encoding pictures.
pub fn html(contents: &Contents<'_>) -> Result<String> {
    let Contents { file, compared, is_worst, device, errors, notes } = contents;
    let mut viewer = Viewer::whole();
    for (material, picture) in &compared.own {
        add(&mut viewer, "float", *material, picture, String::new())?;
    }
    for OfCodec { codec, pictures, .. } in &compared.codecs {
        for (material, picture, _, difference) in pictures {
            add(&mut viewer, codec.id, *material, picture, difference.in_words())?;
        }
    }
    let page = context! {
        version => env!("CARGO_PKG_VERSION"),
        file,
        device,
        view => compared.view.map(|axis| axis.to_string()).join(", "),
        is_worst,
        errors,
        notes,
        times => TIMES,
        viewer => viewer.finish(),
        codecs => compared.codecs.iter().map(of_codec).collect::<Result<Vec<Value>>>()?,
    };
    render("model.html", page).map_err(|error| Error::Page(error.to_string()))
}

fn add(
    viewer: &mut Viewer,
    codec: &str,
    material: Material,
    picture: &RgbImage,
    words: String,
) -> Result<()> {
    let of = Subject { codec: codec.to_owned(), material: material.name().to_owned() };
    let size = [picture.width(), picture.height()];
    viewer.add(&of, size, Picture { uri: uri(picture)?, words });
    Ok(())
}

fn of_codec(of: &OfCodec) -> Result<Value> {
    let difference =
        |(material, _, picture, difference): &(Material, _, RgbImage, crate::figures::Difference)| {
            Ok(context! { material => material.name(), uri => uri(picture)?, words => difference.in_words() })
        };
    Ok(context! {
        id => of.codec.id,
        heat => uri(&of.heat)?,
        greatest => of.greatest_deg,
        seen => of.seen_deg,
        size => [of.heat.width(), of.heat.height()],
        differences => of.pictures.iter().map(difference).collect::<Result<Vec<Value>>>()?,
    })
}

fn uri(picture: &RgbImage) -> Result<String> {
    Ok(data("image/png", &Shown::picture("a picture", "", picture.clone()).bytes()?))
}
