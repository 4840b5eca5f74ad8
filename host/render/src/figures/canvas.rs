//! Pictures of bytes, with text, side by side.

use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_9X15};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::{DrawTarget, OriginDimensions, Pixel, Point, RgbColor, Size};
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageResult, Rgb, RgbImage};
use std::convert::Infallible;

/// Ink on paper.
pub const INK: [u8; 3] = [24, 24, 27];
const PAPER: [u8; 3] = [255, 255, 255];
const GAP: u32 = 6;

/// A picture that text is written on.
pub struct Canvas(pub RgbImage);

impl Canvas {
    /// A blank one.
    pub fn new(width: u32, height: u32) -> Self {
        Self(RgbImage::from_pixel(width, height, Rgb(PAPER)))
    }

    /// Writes a line about a point: its top left corner, or its middle.
    pub fn write(&mut self, text: &str, at: (i32, i32), small: bool, centred: bool, colour: [u8; 3]) {
        let style = MonoTextStyle::new(font(small), Rgb888::new(colour[0], colour[1], colour[2]));
        let (alignment, baseline) =
            if centred { (Alignment::Center, Baseline::Middle) } else { (Alignment::Left, Baseline::Top) };
        let place = TextStyleBuilder::new().alignment(alignment).baseline(baseline).build();
        let text = Text::with_text_style(text, Point::new(at.0, at.1), style, place);
        // A canvas has no way to fail.
        let _ = embedded_graphics::Drawable::draw(&text, self);
    }

    /// Puts a picture on it.
    pub fn put(&mut self, picture: &RgbImage, left: u32, top: u32) {
        image::imageops::replace(&mut self.0, picture, i64::from(left), i64::from(top));
    }
}

fn font(small: bool) -> &'static MonoFont<'static> {
    if small { &FONT_6X10 } else { &FONT_9X15 }
}

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            let place = u32::try_from(at.x).ok().zip(u32::try_from(at.y).ok());
            if let Some(pixel) = place.and_then(|(x, y)| self.0.get_pixel_mut_checked(x, y)) {
                *pixel = Rgb([colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

/// A picture with the lines below it.
pub struct Cell {
    pub picture: RgbImage,
    /// One line each; those that are too long for the picture are cut.
    pub lines: Vec<String>,
}

/// The layout of a sheet's cells.
struct Layout {
    /// Width and height of the largest picture.
    picture: (u32, u32),
    /// The size of a cell, with its lines and a gap.
    cell: (u32, u32),
    columns: u32,
    rows: u32,
}

impl Layout {
    fn of(cells: &[Cell], columns: u32) -> Self {
        let widest = cells.iter().map(|cell| cell.picture.width()).max().unwrap_or(1);
        let highest = cells.iter().map(|cell| cell.picture.height()).max().unwrap_or(1);
        let lines = cells.iter().map(|cell| cell.lines.len()).max().unwrap_or(0) as u32;
        let columns = columns.clamp(1, cells.len().max(1) as u32);
        let letter = font(Self::is_small(widest)).character_size;
        Self {
            picture: (widest, highest),
            cell: (widest + GAP, highest + lines * letter.height + 2 * GAP),
            columns,
            rows: (cells.len() as u32).div_ceil(columns),
        }
    }

    /// True where pictures are too narrow for large letters.
    fn is_small(widest: u32) -> bool {
        widest < 300
    }

    /// Left and top of a cell.
    fn corner(&self, at: u32) -> (u32, u32) {
        (GAP + at % self.columns * self.cell.0, GAP + at / self.columns * self.cell.1)
    }
}

/// Pictures of one size in rows, with their lines below them.
pub fn sheet(cells: &[Cell], columns: u32) -> RgbImage {
    let layout = Layout::of(cells, columns);
    let (widest, highest) = layout.picture;
    let small = Layout::is_small(widest);
    let letter = font(small).character_size;
    let mut canvas = Canvas::new(layout.columns * layout.cell.0 + GAP, layout.rows * layout.cell.1 + GAP);
    for (at, cell) in (0u32..).zip(cells) {
        let (left, top) = layout.corner(at);
        canvas.put(&cell.picture, left, top);
        for (line, text) in (0u32..).zip(&cell.lines) {
            let text: String = text.chars().take((widest / letter.width) as usize).collect();
            let below = top + highest + GAP / 2 + line * letter.height;
            canvas.write(&text, (left as i32, below as i32), small, false, INK);
        }
    }
    canvas.0
}

/// The rectangle where [`sheet`] puts each picture: left, top, width and height.
pub fn places(cells: &[Cell], columns: u32) -> Vec<[u32; 4]> {
    let layout = Layout::of(cells, columns);
    let place = |(at, cell): (u32, &Cell)| {
        let (left, top) = layout.corner(at);
        [left, top, cell.picture.width(), cell.picture.height()]
    };
    (0u32..).zip(cells).map(place).collect()
}

/// Encodes a picture as PNG: in grey where there is no colour.
///
/// # Errors
/// Any error of the PNG encoder.
pub fn png(picture: &RgbImage) -> ImageResult<Vec<u8>> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive);
    let is_grey = picture.pixels().all(|pixel| pixel[0] == pixel[1] && pixel[1] == pixel[2]);
    let (width, height) = picture.dimensions();
    if is_grey {
        let grey: Vec<u8> = picture.pixels().map(|pixel| pixel[0]).collect();
        encoder.write_image(&grey, width, height, ExtendedColorType::L8)?;
    } else {
        encoder.write_image(picture.as_raw(), width, height, ExtendedColorType::Rgb8)?;
    }
    Ok(bytes)
}

/// The part of a picture from a corner on.
pub fn crop(picture: &RgbImage, [left, top, width, height]: [u32; 4]) -> RgbImage {
    image::imageops::crop_imm(picture, left, top, width, height).to_image()
}

/// Cuts the parts at these places out of a PNG, as PNG.
///
/// # Errors
/// A message in words: bytes that are no picture, or a place that is not in it.
pub fn cut(sheet: &[u8], places: &[[u32; 4]]) -> Result<Vec<Vec<u8>>, String> {
    let sheet = image::load_from_memory(sheet).map_err(|error| error.to_string())?.to_rgb8();
    let part = |place: &[u32; 4]| {
        let [left, top, width, height] = place.map(u64::from);
        let is_in = left + width <= u64::from(sheet.width()) && top + height <= u64::from(sheet.height());
        if !is_in || width == 0 || height == 0 {
            return Err(format!(
                "there is no part {place:?} in its {} x {} pixels",
                sheet.width(),
                sheet.height()
            ));
        }
        png(&crop(&sheet, *place)).map_err(|error| error.to_string())
    };
    places.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures cut out of a sheet are those that went into it, and there is text beside them.
    #[test]
    fn cells_are_cut_out_of_their_sheet() {
        let cell = |shade| Cell {
            picture: RgbImage::from_fn(20, 10, |x, y| Rgb([shade, x as u8, y as u8])),
            lines: vec!["oct".to_owned()],
        };
        let cells = [1, 2, 3].map(cell);
        let sheet = sheet(&cells, 2);
        assert!(sheet.pixels().any(|pixel| pixel.0 == INK));
        let sheet = png(&sheet).unwrap();
        for (cut, cell) in cut(&sheet, &places(&cells, 2)).unwrap().iter().zip(&cells) {
            assert_eq!(image::load_from_memory(cut).unwrap().to_rgb8(), cell.picture);
        }
        for place in [[40, 0, 20, 10], [0, 0, 0, 10], [u32::MAX, 0, 2, 2]] {
            assert!(cut(&sheet, &[place]).unwrap_err().contains("no part"), "{place:?}");
        }
        assert!(cut(b"<svg", &[]).is_err());
    }

    /// A grey picture takes a byte a pixel, and reads back as it was.
    #[test]
    fn pictures_come_back_from_png() {
        for colour in [[9, 9, 9], [9, 8, 7]] {
            let picture = RgbImage::from_pixel(7, 5, Rgb(colour));
            let read = image::load_from_memory(&png(&picture).unwrap()).unwrap();
            assert_eq!(read.color().has_color(), colour[0] != colour[1]);
            assert_eq!(read.to_rgb8(), picture);
        }
    }
}
