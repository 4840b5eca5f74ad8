//! Checks that codecs go through the graphics pipeline unchanged: an attachment holds, after the hardware's conversion,
//! the code that the CPU gives, and the result of texel and vertex fetch is decoded as on the CPU; to the bit, with the
//! shaders in Rust and in GLSL.

mod fields;
mod pairs;
mod points;
mod projected;
mod report;
mod rounding;
mod texels;

pub use pairs::{Pair, pairs};
pub use projected::Projected;
pub use report::{Checks, Report, Row, Tally, Traits};
pub use rounding::{Conversion, HardwareRounding};

use super::renderer::{decoded, encoded};
use super::storage::{Storage, codes_of, texels_of};
use super::variant::Variant;
use super::{Normals, Renderer, Shot, Size};
use crate::{Error, Material, Result};
use fields::Fields;
use points::Points;
use rounding::conversion;
use std::collections::BTreeMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain};
use unitvec_run::backend::BackendKind;
use unitvec_run::{sampling, workers};
use unitvec_vulkan::{Device, DeviceChoice, FormatUse, ImageFormat};

/// The scene's picture, whose codes are compared.
const SCENE: Size = Size { width: 192, height: 108 };

/// Codecs of at most this many bits go through texel and vertex fetch with all their codes.
const ALL_CODES_UP_TO: u32 = 16;

/// The extent of a run.
#[derive(Clone, Copy)]
pub struct Options {
    /// Random directions for each codec, and random codes for those whose codes are not all fetched.
    pub count: usize,
    /// The random elements' seed.
    pub seed: u64,
}

/// The renderers of a thread, one for the shaders of each source.
pub type Renderers = BTreeMap<BackendKind, Renderer>;

/// Sources of shaders that this build has.
pub fn sources() -> impl Iterator<Item = BackendKind> {
    BackendKind::of_devices().filter(|kind| matches!(kind, BackendKind::Rust | BackendKind::Glsl))
}

/// Opens the renderers of a thread, on a device of [`Device::open_for_graphics`].
///
/// # Errors
/// The errors of [`Renderer::new`].
pub fn open(device: &Arc<Device>) -> Result<Renderers> {
    sources().map(|source| Ok((source, Renderer::new(device, source, SCENE, 1)?))).collect()
}

/// Runs codecs, on several threads. `each` receives the rows, in the codecs' order.
///
/// # Errors
/// The first error of a thread or of `each`. Differences are no error: they are in the rows.
pub fn run<E: From<Error> + Send>(
    formats: Vec<&'static AnyCodec>,
    options: &Options,
    device: &Arc<Device>,
    traits: &Traits,
    each: &mut dyn FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let work = |format: &'static AnyCodec, renderers: &mut Renderers, _: &mut dyn FnMut(u64)| {
        Ok(row(format, options, device, renderers, traits)?)
    };
    workers::run(formats, open_on(device), work, &mut |_| {}, each)
}

/// Runs projections in formats, on several threads. `each` receives the rows, in the order of the pairs.
///
/// # Errors
/// The errors of [`run`].
pub fn run_pairs<E: From<Error> + Send>(
    pairs: Vec<Pair>,
    options: &Options,
    device: &Arc<Device>,
    traits: &Traits,
    each: &mut dyn FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let work = |pair: Pair, renderers: &mut Renderers, _: &mut dyn FnMut(u64)| {
        Ok(pairs::row(pair, options, device, renderers, traits)?)
    };
    workers::run(pairs, open_on(device), work, &mut |_| {}, each)
}

/// The function that opens the renderers of a thread, on a device of its own: drivers that run on the CPU may compile
/// for a queue while it is drawing.
fn open_on<E: From<Error>>(device: &Arc<Device>) -> impl Fn() -> Result<Renderers, E> + Sync {
    let choice = DeviceChoice::Named(device.info().index.to_string());
    let open = move || open(&Device::open_for_graphics(device.instance(), &choice)?);
    move || Ok(open()?)
}

/// The device's behaviour besides codecs, with shaders of the first source.
///
/// # Errors
/// A failed call, or a shader that does not compile.
pub fn traits(device: &Arc<Device>, options: &Options) -> Result<Traits> {
    let renderers = open(device)?;
    let mut found = Traits::default();
    let Some(renderer) = renderers.values().next() else { return Ok(found) };
    let converted = Fields::all().filter(|fields| !fields.has_alpha() || fields.bits() == 10);
    found.conversions = converted.map(|fields| conversion(renderer, fields)).collect::<Result<_>>()?;
    let sphere = directions_of(Domain::Sphere, options);
    let points = Points::of_normals(renderer, &sphere)?;
    let [_, passed] = points.draw(renderer, &Variant::FLOAT)?;
    found.interpolated = sphere.len() as u64;
    for (sent, passed) in sphere.iter().zip(&passed) {
        let changed = sent.iter().zip(passed).filter(|(sent, passed)| is_changed(**sent, **passed));
        let is_allowed = |sent: f32, passed: f32| {
            sent.is_subnormal() && passed == 0.0 || sent.is_infinite() && passed.is_nan()
        };
        let all_allowed = changed.clone().all(|(sent, passed)| is_allowed(*sent, *passed));
        found.flushed += u64::from(all_allowed && changed.count() > 0);
        found.changed += u64::from(!all_allowed);
    }
    Ok(found)
}

/// True unless both are the same number, or both NaN.
fn is_changed(sent: f32, passed: f32) -> bool {
    sent != passed && !(sent.is_nan() && passed.is_nan())
}

/// Random directions of a domain, and special vectors.
fn directions_of(domain: Domain, options: &Options) -> Vec<[f32; 3]> {
    let random = sampling::random_directions(domain, options.seed).take(options.count);
    sampling::special_vectors().into_iter().chain(random).collect()
}

/// Codes as they are stored: all of them, or random ones and those whose fields are at the ends of their range.
fn codes(format: &AnyCodec, options: &Options) -> Vec<u8> {
    let codes: Vec<u64> = if format.bits <= ALL_CODES_UP_TO {
        (0..1 << format.bits).collect()
    } else {
        let random = sampling::random_codes(options.seed).take(options.count);
        sampling::special_codes().into_iter().chain(random).collect()
    };
    let mask = u64::MAX >> (64 - format.bits);
    let is_number = |code: &u64| match Storage::of(format) {
        // Infinity and NaN of a half are numbers to no codec.
        Storage::Float16x2 | Storage::Float16x3 => {
            [0, 16, 32].iter().all(|at| (code >> at) & 0x7c00 != 0x7c00)
        }
        _ => true,
    };
    let codes: Vec<u64> = codes.into_iter().map(|code| code & mask).filter(is_number).collect();
    sampling::stored(&codes, format.bytes)
}

fn row(
    format: &'static AnyCodec,
    options: &Options,
    device: &Arc<Device>,
    renderers: &mut Renderers,
    traits: &Traits,
) -> Result<Row> {
    let keeps_10_bits =
        traits.rounding(Storage::Snorm10x3.texel()).is_some_and(HardwareRounding::keeps_codes);
    let drawn = Storage::drawn(format, device, keeps_10_bits);
    let own = Variant::codec(format, Storage::of(format));
    let mut row = Row::new(device, format, drawn);
    let (directions, codes) = (directions_of(format.domain, options), codes(format, options));
    for (source, renderer) in renderers.iter_mut() {
        let mut checks = Checks::default();
        let variant = Variant::codec(format, drawn);
        let mut one = One { source: *source, renderer, format };
        if one.renderer.shaders.has(&variant) {
            checks.attachment = one.attachment(&mut row, &variant, &directions)?;
            checks.scene = one.scene(&mut row)?;
        } else {
            row.unsupported.push(format!("{source} shaders that write it to {:?}", drawn.texel()));
        }
        if device.supports(own.storage.texel(), FormatUse::Texture) {
            checks.texture = one.texture(&mut row, &own, &codes)?;
        }
        if device.supports(own.storage.attribute(device), FormatUse::Vertex) {
            checks.vertex = one.vertex(&mut row, &own, &codes)?;
        }
        row.checks.insert(*source, checks);
        if let Some(projected) = projected::check(one.renderer, format, &directions, traits)? {
            row.projected.insert(*source, projected);
        }
    }
    Ok(row)
}

/// A codec with the shaders of one source.
struct One<'a> {
    source: BackendKind,
    renderer: &'a mut Renderer,
    format: &'static AnyCodec,
}

impl One<'_> {
    /// Normals as points, encoded into an attachment.
    fn attachment(&self, row: &mut Row, variant: &Variant, directions: &[[f32; 3]]) -> Result<Tally> {
        let (points, texel) = (Points::of_normals(self.renderer, directions)?, variant.storage.texel());
        let (texels, normals) = points.draw_texels(self.renderer, variant, texel)?;
        self.compare_codes(row, "attachment", texel, &texels, &normals)
    }

    /// The scene's codes, where there is an object.
    fn scene(&mut self, row: &mut Row) -> Result<Tally> {
        let shot = Shot { normals: Normals::Codec(self.format), ..Shot::new(Material::Mirror) };
        let layers = self.renderer.layers(&shot)?;
        let size = layers.codes.len() / SCENE.pixels();
        let mut drawn = (Vec::new(), Vec::new());
        for (texel, [x, y, z, is_drawn]) in layers.codes.chunks_exact(size).zip(layers.normals) {
            if is_drawn != 0.0 {
                drawn.0.extend(texel);
                drawn.1.push([x, y, z]);
            }
        }
        let texel = self.renderer.storage(self.format).texel();
        self.compare_codes(row, "scene", texel, &drawn.0, &drawn.1)
    }

    /// Texels against the CPU's codes of the normals beside them.
    fn compare_codes(
        &self,
        row: &mut Row,
        what: &str,
        texel: ImageFormat,
        texels: &[u8],
        normals: &[[f32; 3]],
    ) -> Result<Tally> {
        let (cpu, size) = (encoded(self.format, normals)?, self.format.bytes);
        let (what, device) = (format!("{} {what}", self.source), codes_of(texels, texel, size));
        Ok(row.compare(&what, size, &cpu, &device, |at| shown(&normals[at])))
    }

    /// Compares codes decoded on the CPU and by texel fetch.
    fn texture(&self, row: &mut Row, variant: &Variant, codes: &[u8]) -> Result<Tally> {
        let (texel, size) = (variant.storage.texel(), self.format.bytes);
        let found = texels::decoded(self.renderer, variant, texel, &texels_of(codes, texel, size))?;
        let cpu = decoded(self.format, codes)?;
        Ok(row.compare_normals(&format!("{} texture", self.source), codes, size, &cpu, &found))
    }

    /// Compares codes as vertex attributes with the results of the same pipeline for the CPU's vectors: the effect of
    /// interpolation on zeros is no matter of codecs.
    fn vertex(&self, row: &mut Row, variant: &Variant, codes: &[u8]) -> Result<Tally> {
        let cpu = Points::of_normals(self.renderer, &decoded(self.format, codes)?)?;
        let coded = Points::of_codes(self.renderer, variant, self.format, codes)?;
        let passed = |points: &Points| points.draw(self.renderer, &Variant::FLOAT);
        let ([_, expected], [_, found]) = (passed(&cpu)?, passed(&coded)?);
        let what = format!("{} vertex", self.source);
        Ok(row.compare_normals(&what, codes, self.format.bytes, &expected, &found))
    }
}

fn shown(vector: &[f32; 3]) -> String {
    format!("{vector:?} (bits {:08x?})", vector.map(f32::to_bits))
}
