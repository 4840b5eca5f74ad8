//! Dithered normals: the pictures of plain ones beside them, and a turning object.

use super::camera::{Camera, shot};
use super::canvas::{Cell, crop, enlarged};
use super::compare::{Original, mean};
use super::pictures::{MANY, take, window};
use super::{Figure, Labelled, Number, Options, Shown, named};
use crate::{Key, Material, Normals, Result, Seen, Shot, View};
use glam::{IVec3, Vec3};
use image::RgbImage;
use std::collections::HashMap;
use unitvec_catalogue::{AnyCodec, find};

/// The codecs that are shown dithered.
const CODECS: [&str; 2] = ["oct16", "oct16p"];

const KEYS: [(Key, &str); 3] =
    [(Key::Pixel, "pixel"), (Key::BlueNoise, "blue noise"), (Key::Position, "position")];

/// Plain and dithered normals of a codec, with their names.
fn variants(codec: &'static AnyCodec) -> impl Iterator<Item = (Normals, String)> {
    let dithered = KEYS
        .into_iter()
        .map(move |(key, name)| (Normals::Dithered(codec, key), format!("{} by {name}", codec.id)));
    std::iter::once((Normals::Codec(codec), format!("{} plain", codec.id))).chain(dithered)
}

/// The errors of a picture's brightness, in steps of 1/255.
fn errors(picture: &RgbImage, float: &RgbImage) -> Vec<f64> {
    let brightness =
        |pixel: &image::Rgb<u8>| pixel.0.iter().map(|value| f64::from(*value)).sum::<f64>() / 3.0;
    picture.pixels().zip(float.pixels()).map(|(a, b)| brightness(a) - brightness(b)).collect()
}

/// The part of a pixel's error that its right neighbour shares: 1 in bands, 0 in white noise.
fn autocorrelation(errors: &[f64], width: usize) -> f64 {
    let mean = mean(errors.iter().copied());
    let (mut product, mut square, mut pairs) = (0.0, 0.0, 0usize);
    for row in errors.chunks(width) {
        square += row.iter().map(|error| (error - mean).powi(2)).sum::<f64>();
        product += row.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum::<f64>();
        pairs += row.len().saturating_sub(1);
    }
    (product / pairs.max(1) as f64) / (square / errors.len().max(1) as f64)
}

/// The mirror and the highlight, plain and dithered, and the turning object.
pub fn dither(camera: &mut dyn Camera, options: &Options) -> Result<Figure> {
    let (mut pictures, mut numbers) = (Vec::new(), Vec::new());
    for (material, view, name) in
        [(Material::Mirror, View::Scene, "mirror"), (Material::Glossy, View::Panel, "highlight")]
    {
        let float = take(camera, Normals::Float, material, view)?;
        let original = Original::new(&float);
        let first = take(camera, Normals::Codec(find(CODECS[0])?), material, view)?;
        let window = window(options, MANY, &float, &first);
        let (mut cells, mut differences) = (Vec::new(), Vec::new());
        for (normals, label) in named(&CODECS)?.into_iter().flat_map(variants) {
            let picture = take(camera, normals, material, view)?;
            let difference = original.difference(&picture);
            let part = crop(&picture, window);
            let shared = autocorrelation(&errors(&part, &crop(&float, window)), window[2] as usize);
            numbers.push(Number::new(
                format!("{name}, {label}, autocorrelation of the difference in the part shown"),
                shared,
            ));
            differences.push(Labelled { label: label.clone(), difference });
            cells.push(Cell {
                picture: enlarged(&part, options.small),
                lines: vec![label, difference.in_words()],
            });
        }
        let words = format!(
            "A {name} with normals in 16 bits, plain and dithered by three kinds of offset: pixels of the part where \
             oct16 differs most from floats. Numbers are of the whole picture's difference, in steps of 1/255."
        );
        let alt = format!("The {name} with plain normals and with dithered ones");
        let shown = Shown::picture(
            format!("dither_{name}.png"),
            &alt,
            options.theme.captioned_sheet(&cells, 4, &words),
        );
        pictures.push(Shown { differences, ..shown });
    }
    let (strip, of_turning) = turning(camera, options)?;
    pictures.push(strip);
    numbers.extend(of_turning);
    let caption = format!(
        "Normals in 16 bits, plain and by subtractive dither keyed by the pixel, by a blue-noise tile and by the position on the \
         surface: first the mirror and the highlight, then {FRAMES} frames of a turning sphere, which moves by about a pixel from \
         one to the next. SSIM falls, since it counts noise; FLIP, which blurs as an eye does, improves, and so does how much \
         neighbouring pixels share of their error, and what crawls when the panel turns as far. For that we average {BLOCK} x \
         {BLOCK} pixels, as an eye at a distance does, and take the variance over the frames, in steps of 1/255, squared: bands \
         survive the average, noise does not. The \
         numbers of the sphere follow the points of its surface: the variance of the error of a point's normal over the frames, \
         and its change from one frame to the next. They cannot tell bands from noise, so dither does not lower them."
    );
    Ok(Figure::new("dither", "Dither", caption, pictures).with(numbers))
}

/// Frames of the turning object.
const FRAMES: u16 = 30;
/// Pixels along the side of a block, over which an eye from afar takes the mean: white noise is gone in it, and bands are not.
const BLOCK: usize = 8;
/// Degrees from one frame to the next, in a picture of so many pixels across: the surface moves by about a pixel.
const STEP: (f32, f32) = (0.2, 1280.0);
/// The step between followed points: one of so many in the first frame.
const EVERY: usize = 11;
/// Frames of the strip, and of a small one.
const STRIP: [u16; 2] = [6, 5];

/// The mean over the points that are seen in all frames of the variance of their errors, and of the change of an error from one
/// frame to the next.
fn variance_and_change(frames: &[Vec<Option<Vec3>>]) -> [f64; 2] {
    let points = frames.first().map_or(0, Vec::len);
    let tracks = (0..points).filter_map(|point| frames.iter().map(|frame| frame[point]).collect());
    let (mut variance, mut change, mut count) = (0.0, 0.0, 0usize);
    for track in tracks {
        let track: Vec<Vec3> = track;
        let middle = track.iter().sum::<Vec3>() / track.len() as f32;
        variance += mean(track.iter().map(|error| f64::from((*error - middle).length_squared())));
        change += mean(track.windows(2).map(|pair| f64::from(pair[0].distance(pair[1]))));
        count += 1;
    }
    [variance, change].map(|sum| sum / count.max(1) as f64)
}

/// The means of errors over blocks.
fn block_means(errors: &[f64], width: usize) -> Vec<f64> {
    let rows = errors.chunks_exact(BLOCK * width);
    let mean = |rows: &[f64], left: usize| {
        rows.chunks_exact(width).flat_map(|row| &row[left..left + BLOCK]).sum::<f64>()
            / (BLOCK * BLOCK) as f64
    };
    rows.flat_map(|rows| (0..width / BLOCK).map(move |column| mean(rows, column * BLOCK))).collect()
}

/// The mean over blocks of the variance of a block over the frames.
fn variance_over_time(frames: &[Vec<f64>]) -> f64 {
    let variance = |block: usize| {
        let values = || frames.iter().map(move |frame| frame[block]);
        let middle = mean(values());
        mean(values().map(|value| (value - middle).powi(2)))
    };
    mean((0..frames.first().map_or(0, Vec::len)).map(variance))
}

/// The surface seen in a picture, by its place on the object.
struct Surface<'a> {
    cells: HashMap<IVec3, Vec<&'a Seen>>,
    cell: f32,
}

impl<'a> Surface<'a> {
    fn new(seen: &'a [Option<Seen>], cell: f32) -> Self {
        let mut cells: HashMap<IVec3, Vec<&Seen>> = HashMap::new();
        for one in seen.iter().flatten() {
            cells.entry(cell_of(one.position, cell)).or_default().push(one);
        }
        Self { cells, cell }
    }

    /// The error of the pixel nearest to a point, in degrees along and across; none where it is not seen.
    fn error(&self, at: Vec3) -> Option<Vec3> {
        let middle = cell_of(at, self.cell);
        let around = (0..27).map(|n| middle + IVec3::new(n % 3, n / 3 % 3, n / 9) - 1);
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        let nearest = near.min_by(|a, b| a.position.distance(at).total_cmp(&b.position.distance(at)))?;
        let off = (nearest.decoded - nearest.normal) * 1f32.to_degrees();
        (nearest.position.distance(at) < self.cell).then_some(off)
    }
}

fn cell_of(position: Vec3, cell: f32) -> IVec3 {
    (position / cell).floor().as_ivec3()
}

/// The median distance of neighbouring pixels' positions.
fn spacing(seen: &[Option<Seen>]) -> f32 {
    let pairs = seen.windows(2).filter_map(|pair| Some((pair[0].as_ref()?, pair[1].as_ref()?)));
    let mut distances: Vec<f32> = pairs.map(|(a, b)| a.position.distance(b.position)).collect();
    let middle = distances.len() / 2;
    if distances.is_empty() { 1.0 } else { *distances.select_nth_unstable_by(middle, f32::total_cmp).1 }
}

/// A strip of frames, and the numbers for all.
fn turning(camera: &mut dyn Camera, options: &Options) -> Result<(Shown, Vec<Number>)> {
    let codec = find(CODECS[0])?;
    let (mut cells, mut numbers) = (Vec::new(), Vec::new());
    let mut part = None;
    let strip = STRIP[usize::from(options.small)];
    let still = camera.picture(&shot(Normals::Float, Material::Mirror, View::Turning))?;
    let step = STEP.0 * STEP.1 / still.width() as f32;
    let at = |normals, material, view, frame: u16| Shot {
        turn_degrees: f32::from(frame) * step,
        ..shot(normals, material, view)
    };
    let highlight = |normals, frame| at(normals, Material::Glossy, View::Panel, frame);
    let floats = (0..FRAMES).map(|frame| camera.picture(&highlight(Normals::Float, frame)));
    let floats: Vec<RgbImage> = floats.collect::<Result<_>>()?;
    for (normals, label) in variants(codec) {
        let (mut errors_of_points, mut points) = (Vec::new(), None);
        let mut blocks = Vec::new();
        for frame in 0..FRAMES {
            let glossy = camera.picture(&highlight(normals, frame))?;
            let errors = errors(&glossy, &floats[usize::from(frame)]);
            blocks.push(block_means(&errors, glossy.width() as usize));
            let shot = at(normals, Material::Mirror, View::Turning, frame);
            let seen = camera.surface(&shot)?;
            let (cell, points) = points.get_or_insert_with(|| {
                let all = seen.iter().flatten().map(|seen| seen.position);
                let points: Vec<Vec3> = all.step_by(EVERY).collect();
                (1.5 * spacing(&seen), points)
            });
            let surface = Surface::new(&seen, *cell);
            errors_of_points.push(points.iter().map(|point| surface.error(*point)).collect());
            if frame % (FRAMES / strip) == 0 {
                let picture = camera.picture(&shot)?;
                let [left, top, width, height] = match part {
                    Some(part) => part,
                    // The first frame has not turned.
                    None => *part.insert(window(options, MANY, &still, &picture)),
                };
                let middle = [left + width / 5, top, width * 3 / 5, height];
                cells.push(Cell {
                    picture: enlarged(&crop(&picture, middle), options.small),
                    lines: vec![label.clone(), format!("frame {frame}")],
                });
            }
        }
        let name = format!(
            "turning panel, {label}, temporal variance of the highlight, means of {BLOCK} x {BLOCK} pixels"
        );
        numbers.push(Number::new(name, variance_over_time(&blocks)));
        let names = ["temporal variance, degrees squared", "change from frame to frame, degrees"];
        for (name, value) in names.into_iter().zip(variance_and_change(&errors_of_points)) {
            numbers.push(Number::new(format!("turning sphere, {label}, {name}"), value));
        }
    }
    let alt = "Frames of a turning mirror, with plain and with dithered normals";
    let words = "A mirroring sphere that turns, about a pixel a frame: below each other, plain normals, and normals dithered by \
                 three kinds of offset.";
    Ok((
        Shown::picture(
            "dither_turning.png",
            alt,
            options.theme.captioned_sheet(&cells, u32::from(strip), words),
        ),
        numbers,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows that go up and down in turns share nothing but the sign; slow waves share nearly all.
    #[test]
    fn bands_share_their_errors() {
        let errors = |period: f64| -> Vec<f64> {
            (0..4000).map(|n| (std::f64::consts::TAU * f64::from(n % 400) / period).cos()).collect()
        };
        assert!((autocorrelation(&errors(2.0), 400) + 1.0).abs() < 1e-9);
        // A row of four waves has a pair less than pixels: the one across its ends, which shares as much as the best.
        let shared = (std::f64::consts::TAU / 100.0).cos() * 398.0 / 399.0;
        assert!((autocorrelation(&errors(100.0), 400) - shared).abs() < 1e-9);
    }

    /// An error that is 0 and 2 in turns has the variance 1 and changes by 2; a point that is not always seen does not count.
    #[test]
    fn variance_is_over_time() {
        let frame =
            |n: u32| vec![Some(2.0 * Vec3::X * (n % 2) as f32), Some(Vec3::Y), (n > 0).then_some(Vec3::ONE)];
        assert_eq!(variance_and_change(&(0..10).map(frame).collect::<Vec<_>>()), [0.5, 1.0]);
    }

    /// Errors that are 1 and -1 in turns vanish in the mean, those of a whole block do not; 1 and -1 in turns has the variance 1.
    #[test]
    fn blocks_keep_bands_and_lose_noise() {
        let noise: Vec<f64> = (0..256).map(|n| if n % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert_eq!(block_means(&noise, 16), [0.0; 4]);
        let bands: Vec<f64> = (0..256).map(|n| if n % 16 < 8 { 1.0 } else { -1.0 }).collect();
        let means = block_means(&bands, 16);
        assert_eq!(means, [1.0, -1.0, 1.0, -1.0]);
        let moved: Vec<f64> = means.iter().map(|mean| -mean).collect();
        assert_eq!(variance_over_time(&[means, moved]), 1.0);
    }

    /// Points are found where they are, and not where nothing is near.
    #[test]
    fn surfaces_are_looked_up() {
        let seen = |x: f32| {
            Some(Seen {
                object: 1,
                position: Vec3::X * x,
                normal: Vec3::Z,
                decoded: Vec3::Z + 0.01 * x * Vec3::X,
            })
        };
        let all = [seen(-0.5), None, seen(0.5), seen(1.0)];
        let surface = Surface::new(&all, 0.4);
        let error = surface.error(Vec3::new(0.6, 0.0, 0.0)).unwrap();
        assert!((error.x - 0.005f32.to_degrees()).abs() < 1e-3);
        assert!(surface.error(Vec3::Y).is_none());
        assert_eq!(spacing(&all), 0.5);
    }
}
