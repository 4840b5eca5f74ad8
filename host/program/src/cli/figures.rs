use super::run::{Live, close};
use super::{Vulkan, print, status_after_validation, to_json};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_files::Folder;
use unitvec_host::Result;
use unitvec_render::figures::{Camera, Figures, Options, Origin, Part, RgbImage, Theme, draw, named};
use unitvec_render::{MAX_SAMPLES, Material, Renderer, Seen, Shot, Size};
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::{Device, DeviceInfo};

#[derive(Args)]
pub struct Arguments {
    /// Figures to make, by the survey's numbers or by name; all if not given. The others that the folder has of earlier runs stay,
    /// in figures.json and figures.md too. A figure that is made again replaces all its pictures.
    #[arg(long, value_name = "FIGURE", value_delimiter = ',')]
    only: Vec<Part>,
    /// Folder for the pictures, figures.md and figures.json; made if it is not there.
    #[arg(short, long, value_name = "DIR", alias = "out", default_value = "figures")]
    output: PathBuf,
    /// Codec to show in place of those that figures 1, 5, 6, 7, 8, meyer and errors have; may be given again.
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    codec: Vec<String>,
    /// Material of figure 8; may be given again. All if not given.
    #[arg(long, value_name = "NAME")]
    material: Vec<Material>,
    /// Small sheets only, without the single pictures.
    #[arg(long)]
    small: bool,
    /// White letters on black, for dark pages.
    #[arg(long)]
    dark: bool,
    /// Size of rendered pictures; 1280x720 if not given, 640x360 with --small.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
    #[command(flatten)]
    rendering: Rendering,
}

/// How pictures are rendered.
#[derive(Args)]
pub struct Rendering {
    /// Samples of a pixel, in a row and in a column.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    pub samples: u32,
    /// What the shaders are written in: rust or glsl.
    #[arg(long, value_name = "LANGUAGE", default_value = "rust", value_parser = source)]
    pub source: BackendKind,
    #[command(flatten)]
    pub vulkan: Vulkan,
}

fn source(text: &str) -> std::result::Result<BackendKind, String> {
    match BackendKind::from_str(text, true) {
        Ok(kind @ (BackendKind::Rust | BackendKind::Glsl)) => Ok(kind),
        _ => Err("take rust or glsl".to_owned()),
    }
}

/// The size of rendered pictures, and of those for a page.
const SIZES: [Size; 2] = [Size { width: 1280, height: 720 }, Size { width: 640, height: 360 }];

fn size(text: &str) -> std::result::Result<Size, String> {
    const SIDES: std::ops::RangeInclusive<u32> = 64..=4096;
    let side = |text: &str| text.parse().ok().filter(|side| SIDES.contains(side));
    let size = |(width, height)| Some(Size { width: side(width)?, height: side(height)? });
    text.split_once('x').and_then(size).ok_or_else(|| {
        format!("not a size as 1280x720, with sides from {} to {}", SIDES.start(), SIDES.end())
    })
}

/// A camera whose device is opened with the first picture.
pub struct Studio<'a> {
    rendering: &'a Rendering,
    size: Size,
    opened: Option<(Renderer, Arc<Device>)>,
}

impl<'a> Studio<'a> {
    pub fn new(rendering: &'a Rendering, size: Option<Size>, small: bool) -> Self {
        Self { rendering, size: size.unwrap_or(SIZES[usize::from(small)]), opened: None }
    }

    fn renderer(&mut self) -> unitvec_render::Result<&mut Renderer> {
        let opened = match self.opened.take() {
            Some(opened) => opened,
            None => {
                let Rendering { samples, source, vulkan } = self.rendering;
                let device = vulkan.device_for_graphics()?;
                (Renderer::new(&device, *source, self.size, *samples)?, device)
            }
        };
        Ok(&mut self.opened.insert(opened).0)
    }

    /// The device, where a picture was taken.
    fn device(&self) -> Option<DeviceInfo> {
        self.opened.as_ref().map(|(_, device)| device.info().clone())
    }

    /// Closes the device; what the validation layer said, of closing too.
    pub fn close(self) -> Vec<String> {
        let Some((renderer, device)) = self.opened else { return Vec::new() };
        drop(renderer);
        close(device).1
    }
}

impl Camera for Studio<'_> {
    fn picture(&mut self, shot: &Shot) -> unitvec_render::Result<RgbImage> {
        self.renderer()?.picture(shot)
    }

    fn surface(&mut self, shot: &Shot) -> unitvec_render::Result<Vec<Option<Seen>>> {
        self.renderer()?.surface(shot)
    }
}

pub fn draw_all(
    parts: &[Part],
    options: &Options,
    studio: &mut Studio<'_>,
    mut each: impl FnMut(&str, Vec<u8>) -> Result<()>,
) -> Result<Figures> {
    let live = Live::new(Some(parts.len() as u64), "figure {msg:<8} {wide_bar} {pos} of {len}", true);
    let mut figures = Vec::new();
    for part in parts {
        live.name(part.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned()));
        let figure = draw(*part, options, studio)?;
        for shown in &figure.pictures {
            each(&shown.file, shown.bytes()?)?;
        }
        figures.push(figure);
        live.advance(1);
    }
    live.finish();
    let origin = Origin { device: studio.device(), version: env!("CARGO_PKG_VERSION").to_owned() };
    Ok(Figures { origin, figures })
}

/// A list without what it has before.
fn each_once<T>(list: Vec<T>, is_same: impl Fn(&T, &T) -> bool) -> Vec<T> {
    let mut kept: Vec<T> = Vec::new();
    for one in list {
        if !kept.iter().any(|other| is_same(other, &one)) {
            kept.push(one);
        }
    }
    kept
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let Arguments { only, output: out, small, dark, size, rendering, .. } = arguments;
    rendering.vulkan.refuse_modules()?;
    let codecs = each_once(named(&arguments.codec)?, |a, b| a == b);
    let materials = if arguments.material.is_empty() { &Material::ALL } else { &arguments.material[..] };
    let materials = each_once(materials.to_vec(), |a, b| a == b);
    let theme = if *dark { Theme::DARK } else { Theme::LIGHT };
    let options = Options { small: *small, theme, codecs, materials, whole: !small };
    let parts =
        if only.is_empty() { Part::value_variants() } else { &each_once(only.clone(), |a, b| a == b) };
    let mut studio = Studio::new(rendering, *size, *small);
    let mut folder = Folder::create(out)?;
    // What cannot be kept is told before the work.
    let earlier = Figures::read_if_there(out)?;
    let mut figures = draw_all(parts, &options, &mut studio, |file, bytes| Ok(folder.write(file, &bytes)?))?;
    let count: usize = figures.figures.iter().map(|figure| figure.pictures.len()).sum();
    let drawn = figures.figures.len();
    if let Some(earlier) = earlier {
        folder.remove(figures.keep(earlier, out));
    }
    folder.write("figures.json", to_json(&figures).as_bytes())?;
    folder.write("figures.md", figures.to_markdown().as_bytes())?;
    folder.finish()?;
    let pictures = if count == 1 { "picture" } else { "pictures" };
    let kept = match figures.figures.len() - drawn {
        0 => String::new(),
        1 => "; 1 earlier figure stays".to_owned(),
        kept => format!("; {kept} earlier figures stay"),
    };
    print(&format!("figures: {count} {pictures}, figures.md and figures.json in {}{kept}\n", out.display()))?;
    Ok(status_after_validation(&studio.close()))
}
