use super::{OpenBackend, Vulkan};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_host::backend::{Backend, BackendKind};
use unitvec_host::catalogue::{Element, Format, find_format};
use unitvec_host::output::{Output, open_input};
use unitvec_host::stream::{self, Input, Named, Sink};
use unitvec_host::{Error, Result, mesh};

#[derive(Args)]
pub struct Arguments {
    /// Codec, as `unitvec codecs` lists them.
    #[arg(long, value_name = "ID")]
    codec: String,
    /// What runs the codec.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendKind,
    #[command(flatten)]
    vulkan: Vulkan,
    /// Input file, - for the standard input. To encode: raw f32, or a mesh, known by its ending (obj, ply, gltf, glb). A
    /// frame is normal, tangent and handedness. To decode: codes.
    r#in: PathBuf,
    /// Output file, - for the standard output. A file is replaced only once the new one is complete.
    out: PathBuf,
}

pub fn encode(arguments: &Arguments) -> Result<ExitCode> {
    let format = find_format(&arguments.codec)?;
    let (path, size) = (arguments.r#in.as_path(), format.element.bytes());
    if !mesh::is_mesh(path) {
        return convert(arguments, format, open_input(path)?, elements(path, size), stream::encode);
    }
    let floats = match format.element {
        Element::Vector => mesh::read(path)?.normals.into_flattened(),
        Element::Frame => mesh::read_frames(path)?.into_flattened(),
    };
    let bytes: Vec<u8> = floats.into_iter().flat_map(f32::to_le_bytes).collect();
    let count = (bytes.len() / size) as u64;
    convert(arguments, format, Box::new(Cursor::new(bytes)), Some(count), stream::encode)
}

pub fn decode(arguments: &Arguments) -> Result<ExitCode> {
    let path = arguments.r#in.as_path();
    if mesh::is_mesh(path) {
        let path = path.display();
        return Err(Error::Usage(format!("{path} is a mesh, not codes; `unitvec encode` makes codes of it")));
    }
    let format = find_format(&arguments.codec)?;
    convert(arguments, format, open_input(path)?, elements(path, format.bytes), stream::decode)
}

/// [`stream::encode`] or [`stream::decode`].
type Conversion = fn(&mut dyn Backend, Format, Input<'_>, Sink<'_>, &mut dyn FnMut(u64)) -> Result<u64>;

fn convert(
    arguments: &Arguments,
    format: Format,
    mut input: Box<dyn Read>,
    count: Option<u64>,
    conversion: Conversion,
) -> Result<ExitCode> {
    let mut open = OpenBackend::open(arguments.backend, &arguments.vulkan)?;
    let bar = progress_bar(count, format.element.plural());
    let mut output = Output::create(&arguments.out)?;
    let from: Input<'_> = Named::new(&arguments.r#in, &mut input);
    let to: Sink<'_> = Named::new(&arguments.out, &mut output);
    conversion(open.backend.as_mut(), format, from, to, &mut |done| bar.set_position(done))?;
    output.finish()?;
    bar.finish_and_clear();
    Ok(open.close())
}

/// Elements of `size` bytes in a file; `None` where the length is unknown.
fn elements(path: &Path, size: usize) -> Option<u64> {
    path.metadata().ok().filter(|file| file.is_file()).map(|file| file.len() / size as u64)
}

/// A bar on a terminal.
fn progress_bar(count: Option<u64>, unit: &str) -> ProgressBar {
    let style = |template: &str| {
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
    };
    match count {
        Some(count) => ProgressBar::new(count)
            .with_style(style(&format!("{{wide_bar}} {{human_pos}} of {{human_len}} {unit}, {{per_sec}}"))),
        None => ProgressBar::no_length()
            .with_style(style(&format!("{{spinner}} {{human_pos}} {unit}, {{per_sec}}"))),
    }
}
