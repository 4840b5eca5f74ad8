//! A mesh of one's own: with its normals, and with those that codecs decode to.

use super::compare::{Difference, Original, amplified, mean};
use super::detail::{Detail, NormalMap};
use super::errors::heat;
use super::paint::to_srgb;
use crate::renderer::{decoded, encoded};
use crate::shapes::{self, Body};
use crate::{Material, Renderer, Result, Seen, Shot, Size, View};
use image::RgbImage;
use std::rc::Rc;
use std::sync::Arc;
use unitvec_catalogue::AnyCodec;
use unitvec_mesh::{Shape, has_direction};
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::Device;

/// How a model is compared.
pub struct Options {
    /// The codecs, of vectors or of frames, whose tangents do not matter here.
    pub codecs: Vec<&'static AnyCodec>,
    /// The direction from the mesh to the eye; the worst of 26 where there is none.
    pub view: Option<[f32; 3]>,
    /// The width and the height of a picture in pixels.
    pub side: u32,
    /// Samples of a pixel, in a row and in a column.
    pub samples: u32,
    /// The language of the shaders: Rust or GLSL.
    pub source: BackendKind,
    /// The normal map of each shape that has one.
    pub maps: Vec<Option<Rc<NormalMap>>>,
}

/// A model beside itself.
pub struct Compared {
    /// The direction from the mesh to the eye.
    pub view: [f32; 3],
    /// The density of the vertices that show normal maps beside that of texels: 1, or less where they would be too many; 0
    /// where they are the mesh's own. 1 without maps.
    pub fineness: f32,
    /// The pictures with the mesh's own normals.
    pub own: Vec<(Material, RgbImage)>,
    /// The codecs.
    pub codecs: Vec<OfCodec>,
}

/// A model with the normals of a codec.
pub struct OfCodec {
    /// The codec.
    pub codec: &'static AnyCodec,
    /// The error at each vertex of the shapes in turn, in degrees; 0 where the normal has no direction.
    pub errors_deg: Vec<f64>,
    /// The greatest of them, which has the last colour of the heat map.
    pub greatest_deg: f64,
    /// The mean error at the pixels that show the mesh, whose normals are blended between vertices, in degrees.
    pub seen_deg: f64,
    /// The errors at these pixels, by colour.
    pub heat: RgbImage,
    /// For each material the picture, the difference to that of the own normals [`TIMES`] over, and its size.
    pub pictures: Vec<(Material, RgbImage, RgbImage, Difference)>,
}

/// The factor of shown differences.
pub const TIMES: u8 = 8;

/// Pixels across a picture from which the worst view is found.
const SCOUT: u32 = 160;

/// Directions to the middles of a cube's faces, edges and corners.
fn views() -> impl Iterator<Item = [f32; 3]> {
    let axis = || [-1.0f32, 0.0, 1.0].into_iter();
    let all = axis().flat_map(move |x| axis().flat_map(move |y| axis().map(move |z| [x, y, z])));
    all.filter(|v| *v != [0.0; 3])
}

/// Draws a model with its own normals and with those of codecs.
///
/// # Errors
/// Any error of encoding and of rendering.
pub fn compare(device: &Arc<Device>, shapes: &[Shape], options: &Options) -> Result<Compared> {
    let raw: Vec<[f32; 3]> = shapes.iter().flat_map(|shape| &shape.normals).copied().collect();
    let coded = options.codecs.iter().map(|codec| decoded(codec, &encoded(codec, &raw)?));
    let coded = coded.collect::<Result<Vec<_>>>()?;
    let detail = options.maps.iter().any(Option::is_some).then(|| Detail::new(shapes, &options.maps));
    let bare = shapes::of_shapes(shapes);
    let bodies: Vec<Body> =
        coded.iter().map(|normals| Body { normals: normals.clone(), ..bare.clone() }).collect();
    let view = match options.view {
        Some(view) => view,
        // Without the maps, whose vectors are not coded, and which take a thousand times the triangles.
        None => worst_view(device, options.source, &bare, &bodies)?,
    };
    let own = match &detail {
        Some(detail) => Body { normals: detail.normals(&raw), ..shapes::of_shapes(&detail.shapes) },
        None => bare,
    };
    let mapped = |body: Body| match &detail {
        Some(detail) => Body { normals: detail.normals(&body.normals), ..own.clone() },
        None => body,
    };
    let size = Size { width: options.side, height: options.side };
    let mut renderer = Renderer::new(device, options.source, size, options.samples)?;
    let (pictures, normals) = drawn(&mut renderer, own.clone(), view)?;
    let originals: Vec<Original<'_>> = pictures.iter().map(|(_, own)| Original::new(own)).collect();
    let mut codecs = Vec::new();
    for ((codec, decoded), body) in options.codecs.iter().zip(&coded).zip(bodies) {
        let (coded, coded_normals) = drawn(&mut renderer, mapped(body), view)?;
        let errors_deg: Vec<f64> =
            raw.iter().zip(decoded).map(|(own, coded)| error_deg(*own, *coded)).collect();
        let greatest_deg = errors_deg.iter().copied().fold(0.0, f64::max);
        let errors = errors_at_pixels(&normals, &coded_normals);
        let pairs = pictures.iter().zip(&originals).zip(coded);
        let pairs = pairs.map(|(((_, own), original), (material, coded))| {
            let (by, difference) = (amplified(own, &coded, TIMES), original.difference(&coded));
            (material, coded, by, difference)
        });
        codecs.push(OfCodec {
            codec,
            greatest_deg,
            seen_deg: mean(errors.iter().flatten().copied()),
            heat: heat_map(size, &errors, greatest_deg),
            pictures: pairs.collect(),
            errors_deg,
        });
    }
    let fineness = detail.map_or(1.0, |detail| detail.fineness);
    Ok(Compared { view, fineness, own: pictures, codecs })
}

/// The surface that each pixel shows.
type Surface = Vec<Option<Seen>>;

/// The pictures of a body in all materials, and its surface at the pixels' centres.
fn drawn(
    renderer: &mut Renderer,
    body: Body,
    view: [f32; 3],
) -> Result<(Vec<(Material, RgbImage)>, Surface)> {
    renderer.show(body);
    let shot = |material| Shot { view: View::Model(view), ..Shot::new(material) };
    let picture = |material| Ok((material, super::Camera::picture(renderer, &shot(material))?));
    let pictures = Material::ALL.into_iter().map(picture).collect::<Result<Vec<_>>>()?;
    Ok((pictures, renderer.seen(&shot(Material::Lambertian))?))
}

/// The view with the largest mean error at its pixels, summed over the codecs.
fn worst_view(device: &Arc<Device>, source: BackendKind, own: &Body, coded: &[Body]) -> Result<[f32; 3]> {
    let mut scout = Renderer::new(device, source, Size { width: SCOUT, height: SCOUT }, 1)?;
    let mut all = |body: &Body| {
        scout.show(body.clone());
        let seen = |view| scout.seen(&Shot { view: View::Model(view), ..Shot::new(Material::Lambertian) });
        views().map(seen).collect::<Result<Vec<Surface>>>()
    };
    let own = all(own)?;
    let mut sums = vec![0.0; own.len()];
    for body in coded {
        for ((sum, own), coded) in sums.iter_mut().zip(&own).zip(all(body)?) {
            *sum += mean(errors_at_pixels(own, &coded).into_iter().flatten());
        }
    }
    let worst = views().zip(sums).max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(worst.map_or([0.0, 0.0, 1.0], |(view, _)| view))
}

/// The angles between the normals of pixels that show a body in both, in degrees.
fn errors_at_pixels(own: &Surface, coded: &Surface) -> Vec<Option<f64>> {
    let error = |(own, coded): (&Option<Seen>, &Option<Seen>)| {
        own.zip(*coded).map(|(own, coded)| error_deg(own.normal.into(), coded.normal.into()))
    };
    own.iter().zip(coded).map(error).collect()
}

/// The angle between two normals, 0 where one has no direction.
fn error_deg(own: [f32; 3], coded: [f32; 3]) -> f64 {
    if has_direction(own) && has_direction(coded) { unitvec::angle_deg(own, coded) } else { 0.0 }
}

/// The colour of an error, of which the greatest has the last colour.
fn colour(error_deg: f64, greatest_deg: f64) -> [u8; 3] {
    to_srgb(heat(error_deg / greatest_deg.max(f64::MIN_POSITIVE)))
}

/// Errors by colour; light grey around the mesh.
fn heat_map(size: Size, errors: &[Option<f64>], greatest_deg: f64) -> RgbImage {
    let pixels = errors.iter().flat_map(|error| error.map_or([225; 3], |error| colour(error, greatest_deg)));
    // There are as many pixels as the size asks for.
    RgbImage::from_raw(size.width, size.height, pixels.collect()).unwrap_or_default()
}

/// A binary PLY of shapes: positions, normals, the colours of the heat map, and as `quality` the errors in degrees.
pub fn ply(shapes: &[Shape], of: &OfCodec) -> Vec<u8> {
    let [vertices, triangles] = [
        shapes.iter().map(|shape| shape.positions.len()).sum(),
        shapes.iter().map(|shape| shape.triangles.len()).sum::<usize>(),
    ];
    let floats: String =
        ["x", "y", "z", "nx", "ny", "nz", "quality"].map(|name| format!("property float {name}\n")).concat();
    let colours = ["red", "green", "blue"].map(|name| format!("property uchar {name}\n")).concat();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment angle between normals and {} in degrees, as quality\n\
         element vertex {vertices}\n{floats}{colours}element face {triangles}\nproperty list uchar uint vertex_indices\nend_header\n",
        of.codec.id
    )
    .into_bytes();
    let corners = shapes.iter().flat_map(|shape| shape.positions.iter().zip(&shape.normals));
    for ((position, normal), error) in corners.zip(&of.errors_deg) {
        let floats = position.iter().chain(normal).copied().chain([*error as f32]);
        bytes.extend(floats.flat_map(f32::to_le_bytes));
        bytes.extend(colour(*error, of.greatest_deg));
    }
    let mut before = 0;
    for shape in shapes {
        for corners in &shape.triangles {
            bytes.push(3);
            bytes.extend(corners.iter().flat_map(|corner| (before + corner).to_le_bytes()));
        }
        before += shape.positions.len() as u32;
    }
    bytes
}
