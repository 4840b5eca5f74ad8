use super::run::Live;
use super::summary::{Options, Summary};
use super::{OpenBackend, Vulkan, write_output};
use clap::Args;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, Element, find};
use unitvec_files::{Output, is_same_file};
use unitvec_host::input::{Elements, Input};
use unitvec_host::stream;
use unitvec_host::stream::{Counts, Named, Sink, to_bytes};
use unitvec_host::{Error, Result};
use unitvec_mesh as mesh;
use unitvec_mesh::{FileFormat, Frames};
use unitvec_run::backend::{Backend, BackendKind};

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
    /// Take the input as raw f32, or as codes to decode, whatever its name and first bytes say.
    #[arg(long)]
    raw: bool,
    #[command(flatten)]
    summary: Options,
    /// Input file, - for the standard input.
    ///
    /// To encode: a mesh, known by its first bytes (glTF, PLY) or its ending (.obj, .ply, .gltf, .glb), or raw f32: .bin,
    /// .f32, .raw, the standard input, pipes, and any file with --raw. A frame is normal, tangent and handedness. To
    /// decode: codes.
    r#in: PathBuf,
    /// Output file, - for the standard output. A file is replaced only once the new one is complete; a link stays, and the
    /// file that it leads to is replaced.
    out: PathBuf,
}

#[derive(Args)]
pub struct NormalsArguments {
    /// Export whole tangent frames, seven f32 each: normal, tangent and handedness. The mesh needs tangents.
    #[arg(long)]
    frames: bool,
    #[command(flatten)]
    summary: Options,
    /// Mesh file: .obj, .ply, .gltf, .glb, or any with the first bytes of glTF or PLY.
    mesh: PathBuf,
    /// Output file, - for the standard output.
    out: PathBuf,
}

pub fn encode(arguments: &Arguments) -> Result<ExitCode> {
    let format = find(&arguments.codec)?;
    let mut conversion = Conversion::start(arguments, format)?;
    let mut elements = Elements::open(&arguments.r#in, format.element, arguments.raw)?;
    let counts = conversion.run(&mut elements.floats, elements.count, stream::encode)?;
    conversion.finish(Summary::of_encoding(format, counts, elements.parts))
}

pub fn decode(arguments: &Arguments) -> Result<ExitCode> {
    let format = find(&arguments.codec)?;
    let mut conversion = Conversion::start(arguments, format)?;
    let mut input = Input::open(&arguments.r#in)?;
    if input.mesh().is_some() && !arguments.raw {
        return Err(Error::Usage(format!(
            "{} is a mesh, not codes; `unitvec encode` makes codes of it, and --raw takes it as codes",
            arguments.r#in.display()
        )));
    }
    let count = input.count(format.bytes, "codes")?;
    let count = conversion.run(&mut input, count, stream::decode)?;
    conversion.finish(Summary::of_decoding(format, count))
}

/// Exports the normals of a mesh, or its frames, as [`encode`] takes them; +Z where they were computed and have no direction.
pub fn normals(arguments: &NormalsArguments) -> Result<ExitCode> {
    let output = create_output(&arguments.mesh, &arguments.out)?;
    let to_stdout = output.is_stdout();
    let input = Input::open(&arguments.mesh)?;
    let (element, floats, parts, filled) = if arguments.frames {
        let Frames { frames, parts } = input.parse(mesh::parse_frames)?;
        (Element::Frame, frames.into_flattened(), parts, 0)
    } else {
        let mut mesh = input.parse(mesh::parse)?;
        let filled = mesh.fill_with_z();
        (Element::Vector, mesh.normals.into_flattened(), mesh.parts, filled as u64)
    };
    write_output(output, &to_bytes(&floats))?;
    let mut counts = Counts { no_direction: filled, ..Counts::default() };
    counts.add(element, &floats);
    let summary = Summary::of_export(element, counts, parts, filled);
    arguments.summary.print(summary, [&arguments.mesh, &arguments.out], to_stdout)?;
    Ok(ExitCode::SUCCESS)
}

/// The output, which replaces neither the input nor what is called a mesh: as where OUT was forgotten after `*.obj`.
fn create_output(input: &Path, out: &Path) -> Result<Output> {
    let is_input = input.is_file() && is_same_file(input, out);
    if is_input || FileFormat::of_ending(out).is_some() {
        let what = if is_input { "the input" } else { "the name of a mesh" };
        let message = format!("{} is {what}; give the output another name", out.display());
        return Err(Error::Usage(message));
    }
    Ok(Output::create_binary(out)?)
}

/// [`stream::encode`] or [`stream::decode`].
type Convert<T> =
    fn(&mut dyn Backend, &AnyCodec, stream::Input<'_>, Sink<'_>, &mut dyn FnMut(u64)) -> Result<T>;

/// A backend at work, and the file that it will have written.
struct Conversion<'a> {
    arguments: &'a Arguments,
    format: &'static AnyCodec,
    open: OpenBackend,
    output: Output,
}

impl<'a> Conversion<'a> {
    fn start(arguments: &'a Arguments, format: &'static AnyCodec) -> Result<Self> {
        let output = create_output(&arguments.r#in, &arguments.out)?;
        let open = OpenBackend::open(arguments.backend, &arguments.vulkan)?;
        Ok(Self { arguments, format, open, output })
    }

    /// Converts all of the input, of so many elements if that is known.
    fn run<T>(&mut self, input: &mut dyn Read, count: Option<u64>, convert: Convert<T>) -> Result<T> {
        let unit = self.format.element.plural();
        let template = match count {
            Some(_) => format!("{{wide_bar}} {{human_pos}} of {{human_len}} {unit}, {{eta}} left"),
            None => format!("{{spinner}} {{human_pos}} {unit}, {{elapsed}}"),
        };
        let live = Live::new(count, &template, true);
        let from: stream::Input<'_> = Named::new(&self.arguments.r#in, input);
        let to: Sink<'_> = Named::new(&self.arguments.out, &mut self.output);
        let backend = self.open.backend.as_mut();
        let converted = convert(backend, self.format, from, to, &mut |done| live.reach(done))?;
        live.finish();
        Ok(converted)
    }

    fn finish(self, summary: Summary) -> Result<ExitCode> {
        let to_stdout = self.output.is_stdout();
        self.output.finish()?;
        let Arguments { summary: options, r#in, out, .. } = self.arguments;
        options.print(summary, [r#in, out], to_stdout)?;
        Ok(self.open.close())
    }
}
