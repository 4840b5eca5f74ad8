//! Whether codecs go through the graphics pipeline unchanged: what an attachment holds after the hardware's conversion is the
//! code that the CPU gives, and what texel and vertex fetch give is decoded as on the CPU; to the bit, with the shaders in Rust
//! and in GLSL.

mod points;
mod projected;
mod report;
mod texels;

pub use projected::{HardwareRounding, Projected};
pub use report::{Checks, Report, Row, Tally, Traits};

use super::renderer::{decoded, encoded};
use super::storage::{Storage, codes_of};
use super::variant::Variant;
use super::{Normals, Renderer, Shot, Size, View};
use crate::Result;
use crate::backend::BackendKind;
use crate::catalogue::{Format, formats};
use crate::render::Material;
use crate::sampling;
use crate::vulkan::{Device, DeviceChoice, FormatUse, ImageFormat};
use crate::workers;
use points::Points;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The scene's picture, whose codes are compared.
const SCENE: Size = Size { width: 192, height: 108 };

/// Codecs of at most this many bits go through texel and vertex fetch with all their codes.
const ALL_CODES_UP_TO: u32 = 16;

/// What to run.
#[derive(Clone, Copy)]
pub struct Options {
    /// Random directions for each codec, and random codes for those whose codes are not all fetched.
    pub count: usize,
    /// Their seed.
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
/// As [`Renderer::new`].
pub fn open(device: &Arc<Device>) -> Result<Renderers> {
    sources().map(|source| Ok((source, Renderer::new(device, source, SCENE, 1)?))).collect()
}

/// Runs codecs, on several threads. `each` is told the rows, in the codecs' order.
///
/// # Errors
/// The first error of a thread or of `each`. Differences are no error: they are in the rows.
pub fn run(
    formats: Vec<Format>,
    options: &Options,
    device: &Arc<Device>,
    traits: &Traits,
    each: &mut dyn FnMut(Row) -> Result<()>,
) -> Result<()> {
    let work = |format: Format, renderers: &mut Renderers, _: &mut dyn FnMut(u64)| {
        row(format, options, device, renderers, traits)
    };
    // Each thread has a device of its own: drivers that run on the CPU may compile for a queue while it is drawing.
    let choice = DeviceChoice::Named(device.info().index.to_string());
    let open = || open(&Device::open_for_graphics(device.instance(), &choice)?);
    workers::run(formats, open, work, &mut |_| {}, each)
}

/// What the device does besides codecs, with shaders of the first source.
///
/// # Errors
/// A failed call, or a shader that does not compile.
pub fn traits(device: &Arc<Device>, options: &Options) -> Result<Traits> {
    let renderers = open(device)?;
    let mut found = Traits::default();
    let Some(renderer) = renderers.values().next() else { return Ok(found) };
    found.rounding_8 = projected::rounding(renderer, Storage::Snorm8x2.texel(), 127)?;
    found.rounding_16 = projected::rounding(renderer, Storage::Snorm16x2.texel(), 32767)?;
    found.rounding_10 = projected::rounding(renderer, Storage::Snorm10x3.texel(), 511)?;
    // Any codec of the whole sphere.
    let sphere = formats().next().map_or_else(Vec::new, |format| directions(&format, options));
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

/// True unless both are the same number, or both no number.
fn is_changed(sent: f32, passed: f32) -> bool {
    sent != passed && !(sent.is_nan() && passed.is_nan())
}

/// Random directions of the codec's domain, and special vectors.
fn directions(format: &Format, options: &Options) -> Vec<[f32; 3]> {
    let random = sampling::random_directions(format.domain, options.seed).take(options.count);
    sampling::special_vectors().into_iter().chain(random).collect()
}

/// Codes as they are stored: all of them, or random ones and those whose fields are at the ends of their range.
fn codes(format: &Format, options: &Options) -> Vec<u8> {
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
    format: Format,
    options: &Options,
    device: &Arc<Device>,
    renderers: &mut Renderers,
    traits: &Traits,
) -> Result<Row> {
    let drawn = drawn(device, &format, traits);
    let own = Variant::codec(format, Storage::of(&format));
    let mut row = Row::new(device, &format, drawn);
    let (directions, codes) = (directions(&format, options), codes(&format, options));
    for (source, renderer) in renderers.iter_mut() {
        let mut checks = Checks::default();
        let variant = Variant::codec(format, drawn);
        if renderer.shaders.has(&variant) {
            checks.attachment = attachment(&mut row, *source, renderer, &variant, format, &directions)?;
            checks.scene = scene(&mut row, *source, renderer, format)?;
        } else {
            row.unsupported.push(format!("{source} shaders that write it to {:?}", drawn.texel()));
        }
        if device.supports(own.storage.texel(), FormatUse::Texture) {
            checks.texture = texels::check(&mut row, *source, renderer, &own, format, &codes)?;
        }
        if device.supports(own.storage.attribute(device), FormatUse::Vertex) {
            checks.vertex = vertex(&mut row, *source, renderer, &own, format, &codes)?;
        }
        row.checks.insert(*source, checks);
        if let Some(projected) = projected::check(renderer, format, &directions, traits)? {
            row.projected.insert(*source, projected);
        }
    }
    Ok(row)
}

/// What a codec's codes are drawn to: its own format where the device keeps codes in it.
fn drawn(device: &Device, format: &Format, traits: &Traits) -> Storage {
    let own = Storage::of(format);
    let keeps = own != Storage::Snorm10x3 || traits.rounding_10.is_some_and(HardwareRounding::keeps_codes);
    if keeps && device.supports(own.texel(), FormatUse::Attachment) { own } else { Storage::integers(format) }
}

/// Normals as points, encoded into an attachment.
fn attachment(
    row: &mut Row,
    source: BackendKind,
    renderer: &Renderer,
    variant: &Variant,
    format: Format,
    directions: &[[f32; 3]],
) -> Result<Tally> {
    let points = Points::of_normals(renderer, directions)?;
    let (texels, normals) = points.draw_codes(renderer, variant)?;
    compare_codes(row, &format!("{source} attachment"), format, variant.storage.texel(), &texels, &normals)
}

/// The scene's codes, where there is an object.
fn scene(row: &mut Row, source: BackendKind, renderer: &mut Renderer, format: Format) -> Result<Tally> {
    let shot = Shot { normals: Normals::Codec(format), view: View::Scene, ..Shot::new(Material::Mirror) };
    let layers = renderer.layers(&shot)?;
    let texel = renderer.storage(&format).texel();
    let size = layers.codes.len() / SCENE.pixels();
    let mut drawn = (Vec::new(), Vec::new());
    for (texel, [x, y, z, is_drawn]) in layers.codes.chunks_exact(size).zip(layers.normals) {
        if is_drawn != 0.0 {
            drawn.0.extend(texel);
            drawn.1.push([x, y, z]);
        }
    }
    compare_codes(row, &format!("{source} scene"), format, texel, &drawn.0, &drawn.1)
}

/// Texels against the CPU's codes of the normals beside them.
fn compare_codes(
    row: &mut Row,
    what: &str,
    format: Format,
    texel: ImageFormat,
    texels: &[u8],
    normals: &[[f32; 3]],
) -> Result<Tally> {
    let cpu = encoded(format, normals)?;
    let device = codes_of(texels, texel, format.bytes);
    Ok(row.compare(what, format.bytes, &cpu, &device, |at| shown(&normals[at])))
}

/// Codes as vertex attributes, against what the same pipeline makes of the CPU's vectors: what interpolation does to zeros is
/// no matter of codecs.
fn vertex(
    row: &mut Row,
    source: BackendKind,
    renderer: &Renderer,
    variant: &Variant,
    format: Format,
    codes: &[u8],
) -> Result<Tally> {
    let cpu = decoded(format, codes)?;
    let [_, expected] = Points::of_normals(renderer, &cpu)?.draw(renderer, &Variant::FLOAT)?;
    let [_, found] = Points::of_codes(renderer, variant, format, codes)?.draw(renderer, &Variant::FLOAT)?;
    Ok(compare_normals(row, &format!("{source} vertex"), format, codes, &expected, &found))
}

/// Decoded normals, of which all NaN are one.
fn compare_normals(
    row: &mut Row,
    what: &str,
    format: Format,
    codes: &[u8],
    cpu: &[[f32; 3]],
    device: &[[f32; 3]],
) -> Tally {
    let bytes = |normals: &[[f32; 3]]| -> Vec<u8> {
        let one_nan = |c: &f32| if c.is_nan() { f32::NAN } else { *c };
        normals.iter().flatten().flat_map(|c| one_nan(c).to_le_bytes()).collect()
    };
    row.compare(what, 12, &bytes(cpu), &bytes(device), |at| {
        format!("{:02x?}", &codes[at * format.bytes..][..format.bytes])
    })
}

fn shown(vector: &[f32; 3]) -> String {
    format!("{vector:?} (bits {:08x?})", vector.map(f32::to_bits))
}
