//! What is seen, as docs/open-problems.md has it: the widths that keep colours within half a step, and the next smaller ones, in
//! rendered normals. Each claim is checked as the table is made.

use super::markdown_table;
use super::tables::degrees;
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain, vectors};
use unitvec_choose::seen::{Colour, Lobe, mirror_error_deg};
use unitvec_render::visible::{Pixel, largest_change, largest_shift, sphere};
use unitvec_render::{Renderer, Size};
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::{Device, DeviceChoice, Instance};

/// What errors show up on, and in which unit half of one is allowed.
enum Case {
    /// A lobe, white at its peak, and colours.
    Lobe(Lobe, Colour),
    /// A mirror: the picture's pixels from top to bottom, and the field of view over them.
    Mirror(u32, f64),
}

const LINEAR_8: Colour = Colour { bits: 8, is_linear: true };
const LINEAR_10: Colour = Colour { bits: 10, is_linear: true };
const SRGB_6: Colour = Colour { bits: 6, is_linear: false };
const SRGB_8: Colour = Colour { bits: 8, is_linear: false };
const SRGB_10: Colour = Colour { bits: 10, is_linear: false };

const fn ggx(roughness: f64, light_degrees: f64, colour: Colour) -> Case {
    Case::Lobe(Lobe::Ggx { roughness, light_degrees }, colour)
}

const CASES: [Case; 20] = [
    Case::Lobe(Lobe::Lambert, LINEAR_8),
    Case::Lobe(Lobe::Lambert, LINEAR_10),
    Case::Lobe(Lobe::Lambert, SRGB_8),
    Case::Lobe(Lobe::Lambert, SRGB_10),
    Case::Lobe(Lobe::BlinnPhong { exponent: 16.0 }, LINEAR_8),
    Case::Lobe(Lobe::BlinnPhong { exponent: 256.0 }, SRGB_8),
    ggx(0.8, 0.0, LINEAR_8),
    ggx(0.6, 0.0, SRGB_8),
    ggx(0.5, 0.0, LINEAR_8),
    ggx(0.4, 0.0, SRGB_8),
    ggx(0.8, 0.0, SRGB_6),
    ggx(0.3, 20.0, SRGB_8),
    ggx(0.2, 0.0, SRGB_10),
    ggx(0.2, 0.5, SRGB_8),
    ggx(0.1, 0.5, SRGB_8),
    ggx(0.1, 5.0, SRGB_8),
    Case::Mirror(540, 60.0),
    Case::Mirror(1080, 60.0),
    Case::Mirror(2160, 60.0),
    Case::Mirror(4320, 20.0),
];

impl Case {
    fn name(&self) -> String {
        match self {
            Self::Lobe(lobe, Colour { bits, is_linear }) => {
                let surface = match lobe {
                    Lobe::Lambert => "Lambert".to_owned(),
                    Lobe::BlinnPhong { exponent } => format!("Blinn-Phong, exponent {exponent}"),
                    Lobe::Ggx { roughness, light_degrees: 0.0 } => format!("GGX, roughness {roughness}"),
                    Lobe::Ggx { roughness, light_degrees } => {
                        format!("GGX, roughness {roughness}, light of {light_degrees}°")
                    }
                };
                format!("{surface} | {bits}, {}", if *is_linear { "linear" } else { "sRGB" })
            }
            Self::Mirror(pixels, fov) => format!("mirror, {pixels} pixels over {fov}° | "),
        }
    }

    fn allowed_deg(&self) -> f64 {
        match *self {
            Self::Lobe(lobe, colour) => lobe.max_error_deg(1.0, colour),
            Self::Mirror(pixels, fov) => mirror_error_deg(pixels, fov),
        }
    }

    /// The largest change in steps, or shift in pixels.
    fn found(&self, pixels: &[Pixel]) -> f64 {
        match *self {
            Self::Lobe(lobe, colour) => largest_change(pixels, lobe, 1.0, colour),
            Self::Mirror(height, fov) => largest_shift(pixels, height, fov),
        }
    }
}

/// Renders the sphere with each codec once.
struct Studio {
    renderer: Renderer,
    taken: HashMap<&'static str, Vec<Pixel>>,
}

impl Studio {
    fn found(&mut self, case: &Case, codec: &'static AnyCodec) -> f64 {
        let taken = self.taken.entry(codec.id);
        case.found(taken.or_insert_with(|| sphere(&mut self.renderer, codec).unwrap()))
    }
}

/// A row for each case: the narrowest `octNp` whose bound is allowed, and the next narrower one.
pub fn table() -> String {
    let instance = Arc::new(Instance::new(None, false).unwrap());
    let device = Device::open_for_graphics(&instance, &DeviceChoice::Named("lavapipe".into())).unwrap();
    let size = Size { width: 160, height: 160 };
    let renderer = Renderer::new(&device, BackendKind::Rust, size, 1).unwrap();
    let mut studio = Studio { renderer, taken: HashMap::new() };
    let is_of_series = |codec: &&AnyCodec| codec.id.starts_with("oct") && codec.id.ends_with('p');
    let mut series: Vec<_> = vectors().iter().filter(is_of_series).collect();
    series.sort_by_key(|codec| codec.bits);
    assert!(series.iter().all(|codec| codec.domain == Domain::Sphere));
    let rows = CASES.iter().map(|case| {
        let allowed = case.allowed_deg();
        let fits = series.iter().position(|codec| f64::from(codec.max_error_deg()) <= allowed).unwrap();
        let [smaller, taken] = [fits - 1, fits].map(|at| (series[at], studio.found(case, series[at])));
        assert!(taken.1 < 0.5, "{}: {}", case.name(), taken.1);
        let times = f64::from(smaller.0.max_error_deg()) / allowed;
        let why = if smaller.1 > 0.5 {
            String::new()
        } else {
            format!(": its bound is {times:.2} of what is allowed")
        };
        format!(
            "{} | {} | `{}` | {:.2} | `{}` | {:.2}{why}",
            case.name(),
            degrees(allowed),
            taken.0.id,
            taken.1,
            smaller.0.id,
            smaller.1
        )
    });
    markdown_table(
        "surface | bits of a colour | allowed, degrees | take | shows | next narrower | shows",
        rows,
    )
}
