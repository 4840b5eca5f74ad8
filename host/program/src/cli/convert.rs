use super::beside::write_beside;
use super::many::{each, pairs};
use super::run::Live;
use super::summary::{Options, Summary};
use super::write::{Source, Written, pairs_into, put};
use super::{Buffers, OpenBackend, Vulkan, dtype, expect, is_mesh};
use clap::Args;
use sha2::{Digest, Sha256};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, Element, Null, find_any};
use unitvec_files::Output;
use unitvec_host::container::{Hashed, Header};
use unitvec_host::input::{Elements, Input, Kind, RAW_ENDINGS, has_ending};
use unitvec_host::raw::{Dtype, Npy, to_bytes};
use unitvec_host::stream;
use unitvec_host::stream::{Counts, Named, Sink};
use unitvec_host::{Error, Result};
use unitvec_mesh as mesh;
use unitvec_mesh::{Frames, Reach};
use unitvec_run::backend::{Backend, BackendKind, Cpu};

#[derive(Args)]
pub struct Encode {
    /// Codec, or format of other software such as tiles3d-oct16 or draco:10, as `unitvec codecs` lists them.
    #[arg(long, visible_alias = "format", value_name = "ID")]
    codec: String,
    /// Encode as the format's own software does, bit for bit, and not to the nearest code.
    #[arg(long)]
    plain: bool,
    /// Give vectors without a direction the codec's null code, not that of +Z.
    #[arg(long)]
    null: bool,
    /// Kind of raw floats: f64, f16, or a big-endian one such as f32be; f32 if not given.
    #[arg(long, value_name = "KIND", value_parser = dtype())]
    dtype: Option<Dtype>,
    /// Take the input as raw floats, whatever its name and first bytes say.
    #[arg(long)]
    raw: bool,
    #[command(flatten)]
    buffers: Buffers,
    #[command(flatten)]
    work: Work,
    /// Input file, - for the standard input, or a folder, whose meshes are taken, also from folders below it.
    ///
    /// A mesh, known by its first bytes (glTF, PLY) or its ending (.obj, .ply, .gltf, .glb); a NumPy array (.npy); or raw
    /// floats: .bin, .f32, .raw, the standard input, pipes, and any file with --raw. A frame is normal, tangent and
    /// handedness.
    #[arg(required = true, num_args = 1..)]
    r#in: Vec<PathBuf>,
    /// Output file, - for the standard output; or a folder that exists, which gets NAME.uvec for each input. A file is
    /// replaced only once the new one is complete; a link stays, and the file that it leads to is replaced.
    ///
    /// Codes without gaps, which do not tell their codec. If it ends in .uvec, codes behind a header, by which `decode`
    /// knows their codec, number and SHA-256; if it ends in .npy, a NumPy array.
    out: PathBuf,
}

#[derive(Args)]
pub struct Decode {
    /// Codec or format that the codes are of, as `unitvec codecs` lists them; .uvec files tell it themselves.
    #[arg(long, visible_alias = "format", value_name = "ID")]
    codec: Option<String>,
    /// Decode the codec's null code to zeros, as `encode --null` writes it; .uvec files tell it themselves.
    #[arg(long)]
    null: bool,
    /// Take the input as codes without a header, whatever its first bytes say.
    #[arg(long)]
    raw: bool,
    /// Write the decoded normals or frames, or rotations of splats, into a copy of this mesh, which becomes OUT: of all else
    /// every byte stays. The codes are as many, in the order in which `encode` read them.
    #[arg(long, value_name = "MESH")]
    into: Option<PathBuf>,
    #[command(flatten)]
    buffers: Buffers,
    #[command(flatten)]
    work: Work,
    /// Input file, - for the standard input, or a folder, whose .uvec files are taken, also from folders below it.
    #[arg(required = true, num_args = 1..)]
    r#in: Vec<PathBuf>,
    /// Output file of raw f32, - for the standard output, a NumPy array if it ends in .npy; or a folder that exists, which
    /// gets NAME.f32 for each input. With --into, a mesh.
    out: PathBuf,
}

#[derive(Args)]
struct Work {
    /// What runs the codec.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendKind,
    #[command(flatten)]
    vulkan: Vulkan,
    #[command(flatten)]
    summary: Options,
}

/// The meshes of a command that reads no other files.
#[derive(Args)]
pub struct Meshes {
    #[command(flatten)]
    pub buffers: Buffers,
    #[command(flatten)]
    pub summary: Options,
    /// Mesh file: .obj, .ply, .gltf, .glb, or any with the first bytes of glTF or PLY; or a folder, whose meshes are taken.
    #[arg(value_name = "MESH", required = true, num_args = 1..)]
    pub r#in: Vec<PathBuf>,
}

#[derive(Args)]
pub struct Normals {
    /// Export whole tangent frames, seven f32 each: normal, tangent and handedness. The mesh needs tangents, or texture
    /// coordinates to generate them from: see `encode --help`.
    #[arg(long)]
    frames: bool,
    #[command(flatten)]
    meshes: Meshes,
    /// Output file, - for the standard output, a NumPy array if it ends in .npy; or a folder that exists, which gets
    /// NAME.f32 for each mesh.
    out: PathBuf,
}

pub fn encode(arguments: &Encode) -> Result<ExitCode> {
    let format = find_any(&arguments.codec)?;
    let format = if arguments.plain { plain_of(format)? } else { format };
    arguments.work.check(format)?;
    let null = null_of(format, arguments.null)?;
    let kind = Kind { raw: arguments.raw, dtype: arguments.dtype, reach: arguments.buffers.reach() };
    let pairs = pairs(&arguments.r#in, &arguments.out, is_mesh, Some("uvec"))?;
    if let Some((_, out)) = pairs.iter().find(|(_, out)| has_ending(out, &RAW_ENDINGS)) {
        let words = format!("{} has the name of raw floats; give the codes another, as .uvec", out.display());
        return Err(Error::Usage(words));
    }
    arguments.work.each(&pairs, &arguments.out, |conversion| {
        let mut elements = Elements::open(conversion.input, format.element, kind)?;
        conversion.null = null;
        let is_null = null.is_some();
        let header = has_ending(conversion.out, &["uvec"])
            .then(|| Header::new(format, is_null, elements.parts.clone()));
        conversion.begin_array(
            elements.count,
            match format.bytes {
                2 => ("<u2", 1),
                4 => ("<u4", 1),
                8 => ("<u8", 1),
                bytes => ("|u1", bytes),
            },
        )?;
        let mut counts = match header {
            None => conversion.run(format, &mut elements.floats, elements.count, stream::encode)?,
            Some(header) => conversion.encode_behind(header, format, &mut elements)?,
        };
        expect(conversion.input, elements.count, counts.elements)?;
        counts.suspicion = counts.suspicion.filter(|found| found.applies(elements.is_guess));
        Ok(Summary::of_encoding(format, counts, elements.parts).noting(elements.note))
    })
}

pub fn decode(arguments: &Decode) -> Result<ExitCode> {
    let named = arguments.codec.as_deref().map(find_any).transpose()?;
    let is_container = |path: &Path| has_ending(path, &["uvec"]);
    let pairs = match (&arguments.into, &arguments.r#in[..]) {
        (None, inputs) => pairs(inputs, &arguments.out, is_container, Some("f32"))?,
        (Some(mesh), [codes]) => pairs_into(codes, mesh, &arguments.out)?,
        (Some(_), _) => {
            return Err(Error::Usage("--into takes the codes of one mesh; name one input".into()));
        }
    };
    if let Some((_, out)) = pairs.iter().find(|(_, out)| is_container(out)) {
        let words = format!("{} has the name of codes; give the decoded floats another", out.display());
        return Err(Error::Usage(words));
    }
    arguments.work.each(&pairs, &arguments.out, |conversion| {
        let path = conversion.input;
        let mut input = Input::open(path)?;
        if input.mesh().is_some() && !arguments.raw {
            return Err(Error::Usage(format!(
                "{} is a mesh, not codes; `unitvec encode` makes codes of it, and --raw takes it as codes",
                path.display()
            )));
        }
        let (header, array) = if arguments.raw { (None, None) } else { (input.header()?, input.array()?) };
        if header.is_none() && is_container(path) && !arguments.raw {
            let words =
                format!("{} has no header of a .uvec file; encode again, or add --raw", path.display());
            return Err(Error::Usage(words));
        }
        let format = codec_of(path, named, header.as_ref())?;
        arguments.work.check(format)?;
        let is_null = arguments.null || header.as_ref().is_some_and(|header| header.null);
        conversion.null = null_of(format, is_null)?;
        let count = match (&header, array) {
            (Some(header), _) => input.expect(header.count, format.bytes, "codes")?,
            (None, Some(array)) => {
                let count = array.codes(format.bytes).map_err(|error| input.error(error))?;
                input.expect(count, format.bytes, "codes")?
            }
            (None, None) => input.count(format.bytes, "codes")?,
        };
        let mut input = Hashed::new(input, header.is_some());
        let (decoded, warnings) = match &arguments.into {
            None => {
                conversion.begin_array(count, ("<f4", format.element.floats()))?;
                (conversion.run(format, &mut input, count, stream::decode)?, Vec::new())
            }
            Some(mesh) => {
                let reach = arguments.buffers.reach();
                conversion.decode_into(mesh, reach, format, &mut input, count)?
            }
        };
        expect(path, count, decoded)?;
        if let (Some(header), Some(hash)) = (header, input.hash) {
            header.check(path, hash)?;
        }
        Ok(Summary::of_writing(Some(format), format.element, decoded, warnings))
    })
}

/// The same format with the encoder of its own software.
pub fn plain_of(format: &AnyCodec) -> Result<&'static AnyCodec> {
    format.plain().ok_or_else(|| {
        let words =
            format!("--plain is for vectors in formats of other software; {} has one encoder", format.id);
        Error::Usage(words)
    })
}

/// The codec that the command line names, and the header, if there is one.
fn codec_of(
    path: &Path,
    named: Option<&'static AnyCodec>,
    header: Option<&Header>,
) -> Result<&'static AnyCodec> {
    let told = header.map(|header| find_any(&header.codec)).transpose()?;
    // The plain encoder's codes have the same decoder.
    let decoder = |codec: &'static AnyCodec| codec.plain().unwrap_or(codec);
    match (named, told) {
        (Some(named), Some(told)) if decoder(named) != decoder(told) => Err(Error::Usage(format!(
            "{} has codes of {}, not of {}; leave --codec out",
            path.display(),
            told.id,
            named.id
        ))),
        (Some(format), _) | (None, Some(format)) => Ok(format),
        (None, None) => {
            Err(Error::Usage(format!("{} does not tell its codec; name it: --codec ID", path.display())))
        }
    }
}

/// The codec's null code, where it is wanted.
fn null_of(format: &AnyCodec, is_wanted: bool) -> Result<Option<Null<'_>>> {
    is_wanted.then(|| format.null()).transpose().map_err(|error| Error::Usage(format!("--null: {error}")))
}

/// Exports the normals of a mesh, or its frames, as [`encode`] takes them; +Z where they were computed and have no direction.
pub fn normals(arguments: &Normals) -> Result<ExitCode> {
    let pairs = pairs(&arguments.meshes.r#in, &arguments.out, is_mesh, Some("f32"))?;
    let reach = arguments.meshes.buffers.reach();
    let export = |conversion: &mut Conversion<'_>| {
        let input = Input::open(conversion.input)?;
        let mut counts = Counts::default();
        let mut note = None;
        let (element, floats, parts, filled) = if arguments.frames {
            let Frames { frames, parts, generated } = input.parse(mesh::parse_frames, reach)?;
            note = generated.in_words();
            counts.add(Element::Frame, frames.as_flattened());
            (Element::Frame, frames.into_flattened(), parts, 0)
        } else {
            let mut mesh = input.parse(mesh::parse, reach)?;
            counts.add(Element::Vector, mesh.normals.as_flattened());
            let filled = mesh.fill_with_z() as u64;
            (Element::Vector, mesh.normals.into_flattened(), mesh.parts, filled)
        };
        conversion.begin_array(Some(counts.elements), ("<f4", element.floats()))?;
        floats.chunks(1 << 16).try_for_each(|floats| conversion.write(&to_bytes(floats)))?;
        Ok(Summary::of_export(element, counts, parts, filled).noting(note))
    };
    each(&arguments.meshes.summary, &pairs, &arguments.out, |input, out| one(input, out, &mut Cpu, export))?;
    Ok(ExitCode::SUCCESS)
}

/// [`stream::encode`] or [`stream::decode`].
type Convert<T> = fn(
    &mut dyn Backend,
    &AnyCodec,
    Option<Null<'_>>,
    stream::Input<'_>,
    Sink<'_>,
    &mut dyn FnMut(u64),
) -> Result<T>;

impl Work {
    /// Refuses what no GPU encodes.
    fn check(&self, format: &AnyCodec) -> Result<()> {
        super::check_backend(format, self.backend)
    }

    fn each(
        &self,
        pairs: &[(PathBuf, PathBuf)],
        out: &Path,
        convert: impl Fn(&mut Conversion<'_>) -> Result<Summary>,
    ) -> Result<ExitCode> {
        let mut open = OpenBackend::open(self.backend, &self.vulkan)?;
        let converted =
            each(&self.summary, pairs, out, |input, out| one(input, out, open.backend.as_mut(), &convert));
        let status = open.close();
        converted.map(|()| status)
    }
}

/// Converts an input. Returns what is told of it, and whether it went to the standard output.
fn one(
    input: &Path,
    out: &Path,
    backend: &mut dyn Backend,
    convert: impl Fn(&mut Conversion<'_>) -> Result<Summary>,
) -> Result<(Summary, bool)> {
    let output = Hashed::new(Output::create_binary(out)?, false);
    let mut conversion = Conversion { input, out, output, backend, null: None };
    let summary = convert(&mut conversion)?;
    let to_stdout = conversion.output.stream.is_stdout();
    conversion.output.stream.finish()?;
    Ok((summary, to_stdout))
}

/// A file on its way through a backend.
struct Conversion<'a> {
    input: &'a Path,
    out: &'a Path,
    output: Hashed<Output>,
    backend: &'a mut dyn Backend,
    null: Option<Null<'static>>,
}

impl Conversion<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<()> {
        self.output.write_all(bytes).map_err(|source| unitvec_files::Error::writing(self.out, source))?;
        Ok(())
    }

    /// Begins a NumPy array, where the output is one: of so many elements, of this kind and number each.
    fn begin_array(&mut self, count: Option<u64>, (descr, each): (&str, usize)) -> Result<()> {
        match count {
            _ if !has_ending(self.out, &["npy"]) => Ok(()),
            Some(count) => self.write(&Npy::new(descr, count, each).to_bytes()),
            None => Err(Error::Usage(
                "a .npy file begins with its length, which a stream does not tell; read a file, or write another"
                    .to_owned(),
            )),
        }
    }

    /// Converts all of the input, of so many elements if that is known.
    fn run<T>(
        &mut self,
        format: &AnyCodec,
        input: &mut dyn Read,
        count: Option<u64>,
        convert: Convert<T>,
    ) -> Result<T> {
        let unit = format.element.plural();
        let template = match count {
            Some(_) => format!("{{wide_bar}} {{human_pos}} of {{human_len}} {unit}, {{eta}} left"),
            None => format!("{{spinner}} {{human_pos}} {unit}, {{elapsed}}"),
        };
        let live = Live::new(count, &template, true);
        let from: stream::Input<'_> = Named::new(self.input, input);
        let to: Sink<'_> = Named::new(self.out, &mut self.output);
        let converted = convert(self.backend, format, self.null, from, to, &mut |done| live.reach(done))?;
        live.finish();
        Ok(converted)
    }

    /// Decodes into a mesh. Returns the number of elements, and warnings.
    fn decode_into(
        &mut self,
        mesh: &Path,
        reach: Reach,
        format: &AnyCodec,
        input: &mut dyn Read,
        count: Option<u64>,
    ) -> Result<(u64, Vec<String>)> {
        let (path, null) = (self.input, self.null);
        let (mut input, mut codes): (stream::Input<'_>, _) = (Named::new(path, input), Vec::new());
        let mut fill = |elements: &mut [f32], before| {
            stream::decode_next(self.backend, (format, null), &mut input, &mut codes, elements, before)
        };
        let source = Source { path, count, fill: &mut fill };
        let (Written { count, mut warnings }, edited) = put(mesh, format.element, reach, source)?;
        write_beside(&edited.files, mesh, self.out, &mut warnings)?;
        self.write(&edited.bytes)?;
        Ok((count, warnings))
    }

    /// Encodes behind a header, which is known once all codes are.
    fn encode_behind(
        &mut self,
        header: Header,
        format: &AnyCodec,
        elements: &mut Elements,
    ) -> Result<Counts> {
        let start = header.to_bytes(0);
        if start.len() > Header::MOST {
            let words = format!(
                "{} has too many primitives for the header of a .uvec file; give OUT another ending, for bare codes",
                self.input.display()
            );
            return Err(Error::Usage(words));
        }
        self.write(&start)?;
        let length = start.len();
        drop(start);
        self.output.hash = Some(Sha256::new());
        let counts = self.run(format, &mut elements.floats, elements.count, stream::encode)?;
        let hash = self.output.hash.take().unwrap_or_default();
        self.output.stream.rewrite_start(&header.finish(length, counts.elements, hash))?;
        Ok(counts)
    }
}
