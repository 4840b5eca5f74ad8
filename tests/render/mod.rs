//! The renderer on lavapipe, with validation: codecs go through the pipeline unchanged, and pictures of both languages are
//! equal.

#[cfg(feature = "glsl")]
mod filtering;

use glam::Vec3;
use std::sync::Arc;
use unitvec::OctPrecise16;
use unitvec::wrap::{Dense, dense::DEFAULT_RATIO};
use unitvec_catalogue::{AnyCodec, find};
use unitvec_lab::Error as LabError;
use unitvec_render::conform::{HardwareRounding, Options, Row};
use unitvec_render::{Error, conform, shaders};
use unitvec_render::{
    Key, Layers, Material, Normals, OBJECTS, Picture, Renderer, SIDES, Shot, Size, Vertices, View,
};
use unitvec_run::Error as RunError;
use unitvec_run::backend::BackendKind;
use unitvec_tests::assert_no_validation_messages;
use unitvec_vulkan::{self as vulkan, Device, DeviceChoice, Graphics, Image, ImageFormat, Instance, Mesh};

const SIZE: Size = Size { width: 160, height: 90 };

/// lavapipe with a queue that draws.
fn device() -> Arc<Device> {
    let instance = Arc::new(Instance::new(None, true).unwrap());
    Device::open_for_graphics(&instance, &DeviceChoice::Named("lavapipe".into())).unwrap()
}

fn format(id: &str) -> &'static AnyCodec {
    find(id).unwrap()
}

fn renderer(device: &Arc<Device>, source: BackendKind) -> Renderer {
    Renderer::new(device, source, SIZE, 1).unwrap()
}

fn bits(picture: &Picture) -> Vec<u32> {
    picture.pixels.as_flattened().iter().map(|component| component.to_bits()).collect()
}

/// A codec of each kind of storage, one whose format the device rounds wrong, and frames.
#[test]
fn codecs_go_through_the_pipeline() {
    const IDS: &str = "oct16 oct16p oct24p oct32 hemioct16 cylindrical16 soct33 spherical16 spherical32 \
        snorm8x3p snorm10x3 snorm16x3 float16x3 xyonly32f frame32 frame64";
    let device = device();
    let options = Options { count: 2000, seed: 3 };
    let traits = conform::traits(&device, &options).unwrap();
    assert_eq!(traits.changed, 0);
    for format in [ImageFormat::R8G8_SNORM, ImageFormat::R16G16_SNORM, ImageFormat::R8G8_UNORM] {
        assert_eq!(traits.rounding(format), Some(HardwareRounding::NearestEven), "{format:?}");
    }
    let mut rows: Vec<Row> = Vec::new();
    conform::run(IDS.split(' ').map(format).collect(), &options, &device, &traits, &mut |row| {
        rows.push(row);
        Ok::<(), Error>(())
    })
    .unwrap();
    assert_eq!(rows.iter().map(|row| row.id.as_str()).collect::<Vec<_>>().join(" "), IDS);
    for row in &rows {
        assert!(row.agrees(), "{row:#?}");
        for source in [BackendKind::Rust, BackendKind::Glsl] {
            let checks = row.checks[&source];
            assert!(checks.all().iter().all(|tally| tally.compared > 1000), "{row:#?}");
        }
    }
    let projected: Vec<&str> =
        rows.iter().filter(|row| !row.projected.is_empty()).map(|row| row.id.as_str()).collect();
    assert_eq!(projected, ["oct16", "oct16p", "oct32", "hemioct16", "cylindrical16"]);
    let precise = &rows.iter().find(|row| row.id == "oct16p").unwrap().projected;
    assert!(precise.values().all(|projected| projected.differing == 0), "{precise:?}");
    assert_no_validation_messages(device);
}

/// Projections are stored as the CPU's numbers, rounded, and come back as the CPU's normals, in a third of all
/// pairs of projection and format: `cargo xtask conform pipeline` takes all.
#[test]
fn projections_go_through_the_pipeline() {
    let device = device();
    let options = Options { count: 1000, seed: 4 };
    let traits = conform::traits(&device, &options).unwrap();
    let pairs: Vec<_> = conform::pairs().into_iter().step_by(3).collect();
    let (count, mut rows) = (pairs.len(), Vec::new());
    conform::run_pairs(pairs, &options, &device, &traits, &mut |row: Row| {
        rows.push(row);
        Ok::<(), Error>(())
    })
    .unwrap();
    assert_eq!(rows.len(), count);
    for row in &rows {
        assert!(row.agrees(), "{row:#?}");
        for source in [BackendKind::Rust, BackendKind::Glsl] {
            let [attachment, texture, vertex, _] = row.checks[&source].all();
            let compared = [attachment, texture, vertex].map(|tally| tally.compared);
            assert!(compared.iter().all(|count| *count > 1000), "{row:#?}");
        }
    }
    assert_no_validation_messages(device);
}

/// Each material, of normals as floats and of codes; and each key and codec of dithered ones.
#[test]
fn pictures_of_both_languages_are_equal() {
    let device = device();
    let mut renderers = [BackendKind::Rust, BackendKind::Glsl].map(|source| renderer(&device, source));
    let (oct, table) = (format("oct16"), format("snorm8x3"));
    let mut shots: Vec<Shot> = Material::ALL.map(Shot::new).to_vec();
    shots.extend(Material::ALL.map(|material| Shot { normals: Normals::Codec(oct), ..Shot::new(material) }));
    shots.push(Shot { vertices: Vertices::Codec(table), ..Shot::new(Material::Mirror) });
    let keys = [Key::Pixel, Key::BlueNoise, Key::Position].map(|key| (oct, key));
    let others = shaders::dithered().filter(|id| *id != oct.id).map(|id| (format(id), Key::Pixel));
    for (codec, key) in keys.into_iter().chain(others) {
        shots.push(Shot { normals: Normals::Dithered(codec, key), seed: 5, ..Shot::new(Material::Glossy) });
    }
    let mut pictures: Vec<Vec<u32>> = Vec::new();
    for shot in &shots {
        let [rust, glsl] = [0, 1].map(|at| renderers[at].render(shot).unwrap());
        assert!(bits(&rust) == bits(&glsl), "{shot:?}");
        pictures.push(bits(&rust));
    }
    for (at, picture) in pictures.iter().enumerate() {
        assert!(!pictures[..at].contains(picture), "{:?} is no other picture", shots[at]);
    }
    drop(renderers);
    assert_no_validation_messages(device);
}

/// A second renderer gives the same picture, and so does the first once more.
#[test]
fn a_picture_is_deterministic() {
    let device = device();
    let shot = Shot { view: View::Turning, turn_degrees: 20.0, ..Shot::new(Material::Mirror) };
    let mut first = Renderer::new(&device, BackendKind::Rust, SIZE, 2).unwrap();
    let once = first.render(&shot).unwrap();
    first.render(&Shot::new(Material::Glossy)).unwrap();
    assert!(bits(&once) == bits(&first.render(&shot).unwrap()));
    let other = Renderer::new(&device, BackendKind::Rust, SIZE, 2).unwrap().render(&shot).unwrap();
    assert!(bits(&once) == bits(&other));
    let turned = first.render(&Shot { turn_degrees: 21.0, ..shot }).unwrap();
    assert!(bits(&once) != bits(&turned));
    drop(first);
    assert_no_validation_messages(device);
}

fn layers(device: &Arc<Device>, shot: &Shot) -> Layers {
    renderer(device, BackendKind::Rust).layers(shot).unwrap()
}

/// Each object takes a hundredth of the picture at least, the panel a fifth, and their normals have unit length.
#[test]
fn every_object_is_seen() {
    let device = device();
    let seen = layers(&device, &Shot::new(Material::Mirror));
    let pixels = |object: usize| seen.surfaces.iter().filter(|surface| surface[3] == object as f32).count();
    for object in 1..=OBJECTS.len() {
        assert!(pixels(object) * 100 > SIZE.pixels(), "{}: {} pixels", OBJECTS[object - 1], pixels(object));
    }
    assert!(pixels(OBJECTS.len()) * 5 > SIZE.pixels());
    assert!(pixels(0) * 5 > SIZE.pixels(), "there is sky");
    for ([x, y, z, drawn], surface) in seen.normals.iter().zip(&seen.surfaces) {
        assert_eq!(*drawn, if surface[3] == 0.0 { 0.0 } else { 1.0 });
        let length = f64::from(x * x + y * y + z * z).sqrt();
        assert!((length - f64::from(*drawn)).abs() < 1e-6, "{length}");
    }
    assert_no_validation_messages(device);
}

/// Vertices whose normals are codes give the normals that floats give, but for the codec's error.
#[test]
fn vertices_may_be_codes() {
    let device = device();
    let shot = Shot::new(Material::Mirror);
    let floats = layers(&device, &shot);
    for id in ["oct32p", "snorm16x3", "snorm10x3", "fib32", "frame32"] {
        let codes = layers(&device, &Shot { vertices: Vertices::Codec(format(id)), ..shot });
        let mut largest = 0.0f64;
        for (a, b) in floats.normals.iter().zip(&codes.normals) {
            let distance = (0..3).map(|at| f64::from(a[at] - b[at]).powi(2)).sum::<f64>().sqrt();
            largest = largest.max(distance);
        }
        assert!(largest > 0.0 && largest < 0.01, "{id}: {largest}");
    }
    assert_no_validation_messages(device);
}

/// Scenes that cannot be drawn end in one line.
#[test]
fn what_cannot_be_rendered_is_an_error() {
    let device = device();
    let open = |source, width, samples| {
        Renderer::new(&device, source, Size { width, height: 90 }, samples).map(drop).unwrap_err()
    };
    assert!(matches!(open(BackendKind::Wgsl, 160, 1), Error::NoSuchShaders(BackendKind::Wgsl)));
    assert!(matches!(open(BackendKind::Rust, 160, 0), Error::BadSamples(0)));
    for width in [0, 1 << 20] {
        let error = open(BackendKind::Rust, width, 1);
        assert!(
            matches!(error, Error::Lab(LabError::Run(RunError::Vulkan(vulkan::Error::BadSize { .. })))),
            "{error}"
        );
        assert_eq!(error.to_string().lines().count(), 1);
    }
    let shot =
        Shot { normals: Normals::Dithered(format("fib16"), Key::Pixel), ..Shot::new(Material::Mirror) };
    let error = renderer(&device, BackendKind::Rust).render(&shot).unwrap_err();
    assert!(matches!(error, Error::NotDithered { id: "fib16" }), "{error}");
    assert_no_validation_messages(device);
}

/// Drawing takes a device that was opened for it; the number of texels and vertices has to match the stated one.
#[test]
fn what_does_not_fit_is_an_error() {
    let computing = unitvec_tests::lavapipe();
    let error = Graphics::new(&computing).map(drop).unwrap_err();
    // lavapipe's only queue does both, so the error depends on what the device was opened for.
    assert!(error.to_string().contains("lacks a graphics queue"), "{error}");
    assert_no_validation_messages(computing);

    let device = device();
    let graphics = Graphics::new(&device).unwrap();
    let texture = Image::texture(&graphics, ImageFormat::R8G8_SNORM, (2, 2), &[0; 7]).map(drop);
    assert!(matches!(texture, Err(vulkan::Error::BadDraw { .. })));
    let texture = Image::texture(&graphics, ImageFormat::R8G8B8_SNORM, (1, 1), &[0; 3]).map(drop);
    assert!(matches!(texture, Err(vulkan::Error::UnsupportedFormat { .. })));
    let positions = (ImageFormat::R32G32B32_SFLOAT, &[0; 24][..]);
    let beyond = Mesh::new(&graphics, &[positions], Some(&[0, 1, 2])).map(drop);
    assert!(matches!(beyond, Err(vulkan::Error::BadDraw { .. })));
    assert_eq!(Mesh::new(&graphics, &[positions], Some(&[0, 1, 1])).unwrap().vertices(), 2);
    drop(graphics);
    assert_no_validation_messages(device);
}

/// The default density is the greatest even ratio that leaves the 99.9th percentile of the error over what cameras see below
/// that without a density: over the pixels of the scene and of the bumpy sphere from all its sides, with the axis towards
/// the camera. It lowers the mean by more than a quarter there, as its docs say.
#[test]
fn the_default_density_is_best_for_what_cameras_see() {
    let mut renderer = renderer(&device(), BackendKind::Rust);
    let views = (0..SIDES).map(View::Side).chain([View::Scene; 4]);
    let mut seen = Vec::new();
    for shot in views.map(|view| Shot { view, ..Shot::new(Material::Lambertian) }) {
        let pixels = renderer.seen(&shot).unwrap().into_iter().flatten();
        seen.extend(pixels.map(|pixel| (shot.toward_camera(), pixel.normal)));
    }
    let errors = |ratio: f32| {
        let error = |(axis, normal): &([f32; 3], Vec3)| {
            let dense = Dense::<OctPrecise16>::new(*axis, ratio);
            unitvec::angle_deg(*normal, dense.decode::<Vec3>(dense.encode(*normal)))
        };
        let mut errors: Vec<f64> = seen.iter().map(error).collect();
        errors.sort_by(f64::total_cmp);
        (errors.iter().sum::<f64>() / errors.len() as f64, errors[errors.len() * 999 / 1000])
    };
    let ((plain, rare), (mean, _)) = (errors(1.0), errors(DEFAULT_RATIO));
    let is_below = |ratio: &f32| errors(*ratio).1 < rare;
    assert_eq!((1..=8).map(|half| 2.0 * half as f32).rfind(is_below), Some(DEFAULT_RATIO));
    assert!(mean < 0.75 * plain, "{mean} {plain}");
}
