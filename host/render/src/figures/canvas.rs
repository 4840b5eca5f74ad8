//! Pictures of bytes, with text, side by side.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageResult, Rgb, RgbImage};
use std::sync::LazyLock;

/// The frame of a part that is shown larger.
const FRAME: [u8; 3] = [220, 38, 38];
/// The space between pictures, and around them.
pub const GAP: u32 = 14;
/// The space between pictures of one cell.
const JOINT: u32 = 4;

/// Inter, regular and semi-bold, as far as its letters are used; its licence lies beside it. It is in the program, so that
/// pictures are the same on all machines.
static INTER: LazyLock<[Option<FontRef<'static>>; 2]> = LazyLock::new(|| {
    let files: [&[u8]; 2] =
        [include_bytes!("../../data/Inter-Regular.ttf"), include_bytes!("../../data/Inter-SemiBold.ttf")];
    files.map(|file| FontRef::try_from_slice(file).ok())
});

/// The colours of a sheet around its pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Theme {
    pub(super) ink: [u8; 3],
    /// Ink of what is read second.
    pale: [u8; 3],
    pub(super) paper: [u8; 3],
}

impl Theme {
    /// Black on white.
    pub const LIGHT: Self = Self { ink: [24, 24, 27], pale: [82, 82, 91], paper: [255; 3] };
    /// White on nearly the black of GitHub's dark pages: in steps of 5, as error maps are coarsened to.
    pub const DARK: Self = Self { ink: [240, 246, 252], pale: [145, 152, 161], paper: [15, 20, 25] };
}

/// Letters of a size, in pixels an em, and a weight.
#[derive(Clone, Copy)]
pub struct Type {
    pub size: f32,
    pub is_bold: bool,
}

impl Type {
    /// Letters for a picture of this width: of one size once it is as wide as a page.
    pub fn of_width(width: u32) -> Self {
        Self { size: (width as f32 / 64.0).clamp(18.0, 36.0), is_bold: false }
    }

    /// The space from a line to the next.
    pub fn line(self) -> f32 {
        (1.3 * self.size).ceil()
    }

    /// The font, with its scale.
    fn font(self) -> Option<(&'static FontRef<'static>, PxScale)> {
        let font = INTER[usize::from(self.is_bold)].as_ref()?;
        Some((font, PxScale::from(self.size * font.height_unscaled() / font.units_per_em()?)))
    }

    /// The letters of a line that begins at 0 on its baseline, and where it ends.
    fn set(self, text: &str) -> (Vec<Glyph>, f32) {
        let Some((font, scale)) = self.font() else { return (Vec::new(), 0.0) };
        let (scaled, mut end) = (font.as_scaled(scale), 0.0);
        let glyphs = text.chars().map(|letter| {
            let glyph = font.glyph_id(letter).with_scale_and_position(scale, point(end, 0.0));
            end += scaled.h_advance(glyph.id);
            glyph
        });
        (glyphs.collect(), end)
    }

    /// The width of a line, whole pixels.
    pub fn width(self, text: &str) -> u32 {
        self.set(text).1.ceil() as u32
    }

    /// A text in lines that are no wider than this, unless a word is.
    fn wrapped(self, text: &str, width: u32) -> Vec<String> {
        let mut lines = vec![String::new()];
        for word in text.split(' ') {
            let last = lines.len() - 1;
            let longer =
                if lines[last].is_empty() { word.to_owned() } else { format!("{} {word}", lines[last]) };
            if lines[last].is_empty() || self.width(&longer) <= width {
                lines[last] = longer;
            } else {
                lines.push(word.to_owned());
            }
        }
        lines
    }
}

/// A picture that text is written on.
pub struct Canvas(pub RgbImage);

impl Canvas {
    /// Writes a line about a point: its top left corner, or its middle.
    pub fn write(&mut self, text: &str, at: (f32, f32), letters: Type, centred: bool, colour: [u8; 3]) {
        let Some((font, _)) = letters.font() else { return };
        let (glyphs, width) = letters.set(text);
        // Inter's capitals are 0.73 em high, and fill the middle of a line.
        let (left, base) = if centred {
            (at.0 - 0.5 * width, at.1 + 0.365 * letters.size)
        } else {
            (at.0, at.1 + 0.5 * letters.line() + 0.365 * letters.size)
        };
        for mut glyph in glyphs {
            glyph.position += point(left, base.round());
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, ink| {
                let place = [corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y)];
                let [Ok(x), Ok(y)] = place.map(u32::try_from) else { return };
                let Some(pixel) = self.0.get_pixel_mut_checked(x, y) else { return };
                for (channel, colour) in pixel.0.iter_mut().zip(colour) {
                    let paper = f32::from(*channel);
                    *channel = (paper + (f32::from(colour) - paper) * ink.clamp(0.0, 1.0)).round() as u8;
                }
            });
        }
    }

    /// Puts a picture on it.
    pub fn put(&mut self, picture: &RgbImage, left: u32, top: u32) {
        image::imageops::replace(&mut self.0, picture, i64::from(left), i64::from(top));
    }
}

/// A picture with the lines above it, the first of which is its name.
pub struct Cell {
    pub picture: RgbImage,
    /// One line each.
    pub lines: Vec<String>,
}

/// The layout of a sheet's cells.
struct Layout {
    /// The width of a cell, which is that of its picture or of a line.
    width: u32,
    /// Where each row begins, and how high its lines are; then the sheet's end.
    rows: Vec<(u32, u32)>,
    columns: u32,
    /// The letters of a first line, and of others.
    letters: [Type; 2],
}

impl Layout {
    /// `larger`: the size of names, in that of other lines.
    fn of(cells: &[Cell], columns: u32, larger: f32) -> Self {
        let columns = columns.clamp(1, cells.len().max(1) as u32);
        let widest = cells.iter().map(|cell| cell.picture.width()).max().unwrap_or(1);
        let text = Type::of_width(columns * (widest + GAP));
        let letters = [Type { size: larger * text.size, is_bold: true }, text];
        let lines = |cell: &Cell| -> Vec<u32> {
            cell.lines.iter().enumerate().map(|(at, line)| letters[at.min(1)].width(line)).collect()
        };
        let width = cells.iter().flat_map(lines).fold(widest, u32::max);
        let (mut rows, mut top) = (Vec::new(), GAP);
        for row in cells.chunks(columns as usize) {
            let lines = row.iter().map(|cell| cell.lines.len()).max().unwrap_or(0);
            let lines = (0..lines).map(|at| letters[at.min(1)].line() as u32).sum();
            rows.push((top, lines));
            top += lines + row.iter().map(|cell| cell.picture.height()).max().unwrap_or(0) + GAP;
        }
        rows.push((top, 0));
        Self { width, rows, columns, letters }
    }

    /// Left and top of a cell, and the height of its lines.
    fn corner(&self, at: u32) -> (u32, u32, u32) {
        let (top, lines) = self.rows[(at / self.columns) as usize];
        (GAP + at % self.columns * (self.width + GAP), top, lines)
    }
}

impl Theme {
    /// A blank canvas.
    pub fn blank(self, width: u32, height: u32) -> Canvas {
        Canvas(RgbImage::from_pixel(width, height, Rgb(self.paper)))
    }

    /// Pictures in rows, with their lines above them.
    pub fn sheet(self, cells: &[Cell], columns: u32) -> RgbImage {
        self.headed_sheet(cells, columns, 1.0)
    }

    /// A [`sheet`](Self::sheet) with names in letters so much larger than other lines.
    pub fn headed_sheet(self, cells: &[Cell], columns: u32, larger: f32) -> RgbImage {
        let layout = Layout::of(cells, columns, larger);
        let width = GAP + layout.columns * (layout.width + GAP);
        let mut canvas = self.blank(width, layout.rows.last().map_or(GAP, |end| end.0));
        for (at, cell) in (0u32..).zip(cells) {
            let (left, top, lines) = layout.corner(at);
            canvas.put(&cell.picture, left, top + lines);
            let mut below = top as f32;
            for (at, text) in cell.lines.iter().enumerate() {
                let (letters, colour) =
                    (layout.letters[at.min(1)], if at == 0 { self.ink } else { self.pale });
                canvas.write(text, (left as f32, below), letters, false, colour);
                below += letters.line();
            }
        }
        canvas.0
    }

    /// A [`sheet`](Self::sheet) with a caption.
    pub fn captioned_sheet(self, cells: &[Cell], columns: u32, caption: &str) -> RgbImage {
        self.captioned(&self.sheet(cells, columns), caption)
    }

    /// A sheet with a caption below it, which says how to read it. Places stay what they are.
    pub fn captioned(self, sheet: &RgbImage, caption: &str) -> RgbImage {
        let letters = Type::of_width(sheet.width());
        let lines = letters.wrapped(caption, sheet.width().saturating_sub(2 * GAP));
        let height = lines.len() as u32 * letters.line() as u32 + GAP;
        let mut canvas = self.blank(sheet.width(), sheet.height() + height);
        canvas.put(sheet, 0, 0);
        for (line, text) in (0u8..).zip(&lines) {
            let top = sheet.height() as f32 + f32::from(line) * letters.line();
            canvas.write(text, (GAP as f32, top), letters, false, self.ink);
        }
        canvas.0
    }

    /// Two pictures of one height beside each other.
    pub fn beside(self, left: &RgbImage, right: &RgbImage) -> RgbImage {
        let mut canvas = self.blank(left.width() + JOINT + right.width(), left.height());
        canvas.put(left, 0, 0);
        canvas.put(right, left.width() + JOINT, 0);
        canvas.0
    }

    /// Pictures below each other.
    pub fn stacked(self, pictures: &[&RgbImage]) -> RgbImage {
        let width = pictures.iter().map(|picture| picture.width()).max().unwrap_or(1);
        let height: u32 = pictures.iter().map(|picture| picture.height() + JOINT).sum();
        let (mut canvas, mut top) = (self.blank(width, height.saturating_sub(JOINT)), 0);
        for picture in pictures {
            canvas.put(picture, 0, top);
            top += picture.height() + JOINT;
        }
        canvas.0
    }
}

/// The rectangle where [`Theme::sheet`] puts each picture: left, top, width and height.
pub fn places(cells: &[Cell], columns: u32) -> Vec<[u32; 4]> {
    let layout = Layout::of(cells, columns, 1.0);
    let place = |(at, cell): (u32, &Cell)| {
        let (left, top, lines) = layout.corner(at);
        [left, top + lines, cell.picture.width(), cell.picture.height()]
    };
    (0u32..).zip(cells).map(place).collect()
}

/// A picture for a page, twice as large with the same pixels; others as they are.
pub fn enlarged(picture: &RgbImage, small: bool) -> RgbImage {
    let times = 1 + u32::from(small);
    RgbImage::from_fn(times * picture.width(), times * picture.height(), |x, y| {
        *picture.get_pixel(x / times, y / times)
    })
}

/// A picture with a frame around a part of it.
pub fn framed(picture: &RgbImage, [left, top, width, height]: [u32; 4]) -> RgbImage {
    const LINE: u32 = 3;
    let is_within = |x: u32, y: u32, line: u32| {
        (left..left + width + 2 * line).contains(&(x + line))
            && (top..top + height + 2 * line).contains(&(y + line))
    };
    RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let is_frame = is_within(x, y, LINE) && !is_within(x, y, 0);
        if is_frame { Rgb(FRAME) } else { *picture.get_pixel(x, y) }
    })
}

/// Encodes a picture as PNG: in grey where there is no colour.
///
/// # Errors
/// Any error of the PNG encoder.
pub fn png(picture: &RgbImage) -> ImageResult<Vec<u8>> {
    // Few colours take least without a filter.
    let [plain, adaptive] =
        [FilterType::NoFilter, FilterType::Adaptive].map(|filter| filtered(picture, filter));
    let (plain, adaptive) = (plain?, adaptive?);
    Ok(if plain.len() < adaptive.len() { plain } else { adaptive })
}

fn filtered(picture: &RgbImage, filter: FilterType) -> ImageResult<Vec<u8>> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, filter);
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
        let sheet = Theme::DARK.sheet(&cells, 2);
        assert!(sheet.pixels().any(|pixel| pixel.0 == Theme::DARK.ink));
        let sheet = png(&sheet).unwrap();
        for (cut, cell) in cut(&sheet, &places(&cells, 2)).unwrap().iter().zip(&cells) {
            assert_eq!(image::load_from_memory(cut).unwrap().to_rgb8(), cell.picture);
        }
        for place in [[4000, 0, 20, 10], [0, 0, 0, 10], [u32::MAX, 0, 2, 2]] {
            assert!(cut(&sheet, &[place]).unwrap_err().contains("no part"), "{place:?}");
        }
        assert!(cut(b"<svg", &[]).is_err());
    }

    /// Both weights have all letters that captions use, and a wrapped caption has all its words in lines that are no wider than
    /// the sheet.
    #[test]
    fn captions_are_set() {
        for font in INTER.iter() {
            let font = font.as_ref().unwrap();
            for letter in (' '..='~').chain("\u{b0}\u{d7}\u{2192}".chars()) {
                assert_ne!(font.glyph_id(letter).0, 0, "{letter}");
            }
        }
        let (letters, caption) = (Type::of_width(640), "mirror, glossy and matt surfaces ".repeat(9));
        let lines = letters.wrapped(caption.trim(), 300);
        assert_eq!(lines.join(" "), caption.trim());
        assert!(lines.len() > 3 && lines.iter().all(|line| letters.width(line) <= 300), "{lines:?}");
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
