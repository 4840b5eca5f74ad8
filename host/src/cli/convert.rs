use super::{BackendName, Vulkan};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_host::output::{Output, open_input};
use unitvec_host::stream::{self, Input, Named, Sink};
use unitvec_host::{Error, Result, catalogue, mesh};

#[derive(Args)]
pub struct Arguments {
    /// Codec, as `unitvec codecs` lists them.
    #[arg(long, value_name = "ID")]
    codec: String,
    /// What runs it.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendName,
    #[command(flatten)]
    vulkan: Vulkan,
    /// Input file, - for the standard input. To encode: raw f32 triples, or a mesh, known by its ending (obj, ply, gltf,
    /// glb). To decode: codes.
    r#in: PathBuf,
    /// Output file, - for the standard output. A file is replaced only once the new one is complete.
    out: PathBuf,
}

pub fn encode(arguments: &Arguments) -> Result<ExitCode> {
    let codec = catalogue::find(&arguments.codec)?;
    let mut open = arguments.backend.open(&arguments.vulkan)?;
    let path = arguments.r#in.as_path();
    let bar = progress_bar(path, stream::VECTOR_BYTES);
    let mut progress = |done| bar.set_position(done);
    if mesh::is_mesh(path) {
        let mesh = mesh::read(path)?;
        bar.set_length(mesh.normals.len() as u64);
        let mut output = Output::create(&arguments.out)?;
        let to = writer(&arguments.out, &mut output);
        stream::encode_vectors(open.backend.as_mut(), codec, &mesh.normals, to, &mut progress)?;
        output.finish()?;
    } else {
        let mut input = open_input(path)?;
        let mut output = Output::create(&arguments.out)?;
        let (from, to) = (reader(path, &mut input), writer(&arguments.out, &mut output));
        stream::encode(open.backend.as_mut(), codec, from, to, &mut progress)?;
        output.finish()?;
    }
    bar.finish_and_clear();
    Ok(open.close())
}

pub fn decode(arguments: &Arguments) -> Result<ExitCode> {
    if mesh::is_mesh(&arguments.r#in) {
        let path = arguments.r#in.display();
        return Err(Error::Usage(format!("{path} is a mesh, not codes; `unitvec encode` makes codes of it")));
    }
    let codec = catalogue::find(&arguments.codec)?;
    let mut open = arguments.backend.open(&arguments.vulkan)?;
    let path = arguments.r#in.as_path();
    let bar = progress_bar(path, codec.bytes);
    let mut input = open_input(path)?;
    let mut output = Output::create(&arguments.out)?;
    let (from, to) = (reader(path, &mut input), writer(&arguments.out, &mut output));
    stream::decode(open.backend.as_mut(), codec, from, to, &mut |done| bar.set_position(done))?;
    output.finish()?;
    bar.finish_and_clear();
    Ok(open.close())
}

fn reader<'a>(path: &'a Path, input: &'a mut Box<dyn Read>) -> Input<'a> {
    Named::new(path, input.as_mut())
}

fn writer<'a>(path: &'a Path, output: &'a mut Output) -> Sink<'a> {
    Named::new(path, output)
}

/// A bar on a terminal; its length is the file's elements, or unknown.
fn progress_bar(input: &Path, element_bytes: usize) -> ProgressBar {
    let elements =
        input.metadata().ok().filter(|file| file.is_file()).map(|file| file.len() / element_bytes as u64);
    match elements {
        Some(elements) => ProgressBar::new(elements)
            .with_style(style("{wide_bar} {human_pos} of {human_len} vectors, {per_sec}")),
        None => ProgressBar::no_length().with_style(style("{spinner} {human_pos} vectors, {per_sec}")),
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}
