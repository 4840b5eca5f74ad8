//! The command line.

#[cfg(feature = "lab")]
mod accuracy;
#[cfg(feature = "lab")]
mod bench;
mod beside;
mod choose;
mod codecs;
#[cfg(feature = "render")]
mod compare;
#[cfg(feature = "lab")]
mod compiler;
mod conform;
mod convert;
mod devices;
mod error;
mod examples;
#[cfg(feature = "render")]
mod figures;
#[cfg(feature = "lab")]
mod imprecise;
mod link;
mod many;
#[cfg(feature = "render")]
mod pipeline;
#[cfg(feature = "render")]
mod report;
mod run;
mod schema;
mod shader;
mod snap;
mod summary;
mod table;
mod texture;
mod words;
mod write;

#[cfg(feature = "render")]
use clap::Arg;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, CODECS, find};
use unitvec_files::{Output, shown, shown_lines};
use unitvec_host::raw::{DTYPES, Dtype};
use unitvec_host::{Error, Result};
#[cfg(feature = "lab")]
use unitvec_lab::imprecise::Gpus;
use unitvec_manifest::modules::Modules;
use unitvec_mesh::{FileFormat, Reach};
use unitvec_run::backend::{Backend, BackendKind, Cpu, Gpu, KernelSource};
use unitvec_run::conform::Backends;
use unitvec_run::glsl;
use unitvec_run::shader::{Edition, Language};
use unitvec_vulkan::{Device, DeviceChoice, Instance};

/// Unit-vector codecs on the CPU and on Vulkan: convert files, and show that all agree.
///
/// Of commands that take IN... OUT, the last file is the output; `-o OUT` anywhere says the same. A folder
/// OUT exists or ends with a slash: then it is made, as by `--out-dir OUT`.
///
/// Exit status: 0 if all went well, 1 if something failed or disagreed, 2 if the command line is at fault, 130
/// if interrupted.
#[derive(Parser)]
#[command(name = "unitvec", version)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

// One value a run: its size does not matter.
#[allow(clippy::large_enum_variant)]
#[derive(Subcommand)]
enum Command {
    /// List the codecs, of vectors, tangent frames and rotations, and the formats of other software.
    Codecs(codecs::Arguments),
    /// List the Vulkan devices, and which one would be used.
    Devices(Vulkan),
    /// Encode the normals of meshes (obj, ply, gltf, glb), or their normals and tangents, NumPy arrays, or raw floats: three a
    /// vector, seven a tangent frame, four a rotation: x, y, z, w.
    ///
    /// A codec of rotations takes those of the animations and Gaussian splats of a glTF, and of the splats of a PLY.
    ///
    /// A mesh's codes lie in this order. OBJ: the `vn` lines, once each; where normals are computed, the `v` lines. PLY: the
    /// vertices. glTF: mesh by mesh in file order, then primitive by primitive, then vertex by vertex; what several
    /// primitives share comes once, at the first of them. --json says where each primitive begins, as does the header of a
    /// .uvec file; where OUT is the standard output, `--json -` goes to the standard error.
    ///
    /// A mesh without tangents gets those of MikkTSpace, where it has texture coordinates: of glTF the first set, of PLY `s t`,
    /// `u v` or `texture_u texture_v` of the vertices. The frames of OBJ are those of the different corners v/vt/vn, in the
    /// order in which faces first use them. A vertex whose corners get different tangents keeps that of the first, and one of
    /// a primitive without texture coordinates, beside others that have them, gets zeros; the warning counts both.
    ///
    /// A vertex without a face to compute its normal from gets +Z. Vectors that seem to be something else (f64 or big endian
    /// without --dtype, 0..1, lengths far from 1; of up to a million also all x before all y) are encoded as they are, with a
    /// warning. With several inputs, one that fails does not stop the others.
    #[command(after_help = examples::of("encode"))]
    Encode(convert::Encode),
    /// Decode codes into raw little-endian f32: three a vector, seven a tangent frame.
    #[command(after_help = examples::of("decode"))]
    Decode(convert::Decode),
    /// Export the normals of meshes as raw little-endian f32, which `encode` takes, or their tangent frames; in the order
    /// of `encode --help`.
    #[command(after_help = examples::of("normals"))]
    Normals(convert::Normals),
    /// Move the normals and tangents of meshes (obj, ply, gltf, glb) to vectors that a codec decodes to, and write the same
    /// meshes otherwise.
    ///
    /// A program that then writes the codec's format by plain rounding, as tools for glTF do, writes the codes that the
    /// codec's encoder finds: with oct16p the nearest ones.
    ///
    /// Of all else in the file every byte stays, but for `min` and `max` of what was moved. The buffers of a .gltf, and
    /// images that are not there yet, are written to the folder of OUT under their own names. Vectors without a direction
    /// (zero, infinite, NaN), handedness and morph targets stay as they are. A codec of vectors moves normals and tangents
    /// each by themselves; a codec of frames moves them together; one of rotations, such as sog, moves those of Gaussian
    /// splats (ply, gltf, glb).
    #[command(after_help = examples::of("snap"))]
    Snap(snap::Arguments),
    /// Convert normal maps (png, jpeg, tga, exr, ktx2, dds) to textures of codes (ktx2, dds), and back (png).
    ///
    /// Vectors are normalised; texels without a direction become +Z. Pngs, tgas and UNORM formats are taken as biased, -1 to 1
    /// by 0 to 1; exrs, float and SNORM formats are not. The summary says whether the map is of tangent or of object space,
    /// whether y points up or down, and how far the vectors that were written are from those that were read.
    #[command(after_help = examples::of("texture"))]
    Texture(texture::Arguments),
    /// Write normals, or frames, into a copy of the mesh (obj, ply, gltf, glb) that they were read from.
    ///
    /// They are as many as the mesh has, in the order of `encode --help`, and get there as they are. Of all else in the file
    /// every byte stays, as with `snap`. `decode --into` does the same from codes.
    #[command(after_help = examples::of("write"))]
    Write(write::Arguments),
    /// Measure the errors of codecs over the vectors or frames of your own meshes, normal maps and raw files.
    ///
    /// For each file and codec, and for all files together: mean, median, 99th percentile and maximum of the angles
    /// between the vectors and what they are decoded to, in degrees, and the vector with the largest, counted from 0:
    /// in glTF over all primitives, whose offsets `encode --json` prints. Half (99 %) of the errors are at most the median
    /// (percentile), to within 0.03 %. Vectors without a usable direction are counted and left out. A frame's normal and
    /// tangent are measured apart; a tangent that is not perpendicular to its normal comes back perpendicular, and the turn
    /// counts as error. With several files, one that fails does not stop the others.
    #[command(after_help = examples::of("error"))]
    Error(error::Arguments),
    /// Measure the errors of all codecs, beside the figures that the survey publishes.
    #[cfg(feature = "lab")]
    #[command(after_help = examples::of("accuracy"))]
    Accuracy(accuracy::Arguments),
    /// Measure the cost of encoding and decoding: `device` beside the survey's figures, `compiler` by a GPU's compiler.
    #[cfg(feature = "lab")]
    #[command(after_help = examples::of("bench"))]
    Bench(bench::Arguments),
    /// Find the cheapest codecs of vectors that meet a demand: --max-error, --bits or both.
    #[command(after_help = examples::of("choose"))]
    Choose(choose::Arguments),
    /// Show your own mesh with its normals and with those that codecs decode to, on one page.
    ///
    /// For a mirror, a gloss and a matt surface: before and after, to slide between, the difference, and the error over the
    /// surface as a heat map; with the errors of `unitvec error`. Normal maps of glTF materials are shown, as the file has them; node
    /// transforms and skins are not applied. With several meshes, one that fails does not stop the others.
    #[cfg(feature = "render")]
    #[command(after_help = examples::of("compare"), mut_args = hide_modules, mut_arg("samples", |one| one.default_value("3")))]
    Compare(compare::Arguments),
    /// Draw the figures of the survey and of Meyer et al., error maps and charts, with their numbers.
    #[cfg(feature = "render")]
    #[command(after_help = examples::of("figures"), mut_args = hide_modules)]
    Figures(figures::Arguments),
    /// Write a page to decide from: what to take, the published tables, the figures, and whether this device agrees.
    #[cfg(feature = "render")]
    #[command(after_help = examples::of("report"))]
    Report(report::Arguments),
    /// Write functions in a shading language, ready to paste, with all that they need.
    ///
    /// Texts of one edition may stand in one shader, whatever functions they share: each function counts once. WGSL has no
    /// preprocessor for this, nor have its modules: write one text with all the functions that you need.
    #[command(after_help = examples::of("shader"))]
    Shader(shader::Arguments),
    /// Show that the backends agree to the bit: cpu, rust, wgsl and, in a build with a GLSL compiler, glsl and hlsl.
    #[command(after_help = examples::of("conform"))]
    Conform(conform::Arguments),
    /// Link a shader's SPIR-V with the codecs' functions.
    ///
    /// The shader includes stubs, which --stubs prints, and calls them: `unitvec_oct16_encode(v)`. Linking puts the functions of
    /// the library spirv/unitvec.spv in their place, removes what is not used, optimises and validates, by spirv-link,
    /// spirv-opt and spirv-val of the Vulkan SDK or of Debian's package spirv-tools. The compiler has to leave the stubs' names
    /// and calls in place: glslangValidator -V, glslc, dxc -spirv -fcgl, slangc -target spirv. docs/linking.md says more.
    #[command(after_help = examples::of("link"))]
    Link(link::Arguments),
    /// Print the JSON schema of what a command writes with --json: its keys, with their meaning and units.
    #[command(after_help = examples::of("schema"))]
    Schema(schema::Arguments),
}

impl Arguments {
    fn run(self) -> Result<ExitCode> {
        match self.command {
            Command::Codecs(arguments) => codecs::run(&arguments),
            Command::Devices(vulkan) => devices::run(&vulkan),
            Command::Encode(arguments) => convert::encode(&arguments),
            Command::Decode(arguments) => convert::decode(&arguments),
            Command::Normals(arguments) => convert::normals(&arguments),
            Command::Snap(arguments) => snap::run(&arguments),
            Command::Texture(arguments) => texture::run(&arguments),
            Command::Write(arguments) => write::run(&arguments),
            Command::Error(arguments) => error::run(&arguments),
            #[cfg(feature = "lab")]
            Command::Accuracy(arguments) => accuracy::run(&arguments),
            #[cfg(feature = "lab")]
            Command::Bench(arguments) => bench::run(&arguments),
            Command::Choose(arguments) => choose::run(&arguments),
            #[cfg(feature = "render")]
            Command::Compare(arguments) => compare::run(&arguments),
            #[cfg(feature = "render")]
            Command::Figures(arguments) => figures::run(&arguments),
            #[cfg(feature = "render")]
            Command::Report(arguments) => report::run(&arguments),
            Command::Shader(arguments) => shader::run(&arguments),
            Command::Conform(arguments) => conform::run(&arguments),
            Command::Link(arguments) => link::run(&arguments),
            Command::Schema(arguments) => schema::run(&arguments),
        }
    }
}

/// Which device, and how to open it.
#[derive(Args)]
pub struct Vulkan {
    /// Device, by part of its name or by its index in `unitvec devices`; else the first of the best kind, real GPUs
    /// before software.
    #[arg(long, value_name = "NAME|INDEX", env = "UNITVEC_DEVICE", hide_env_values = true)]
    device: Option<String>,
    /// Run with the Vulkan validation layer; any message of it is a failure.
    #[arg(long)]
    validate: bool,
    /// Folder of SPIR-V modules with a manifest, instead of those inside the program; or the variable UNITVEC_SPIRV.
    /// A module that differs from the program's, by its SHA-256, does not run without --trust.
    #[arg(long, value_name = "FOLDER")]
    spirv: Option<PathBuf>,
    /// Run the modules of --spirv whatever they are. Only their framing is checked: a driver may crash on an invalid one.
    #[arg(long)]
    trust: bool,
}

impl Vulkan {
    fn instance(&self) -> Result<Arc<Instance>, unitvec_vulkan::Error> {
        Ok(Arc::new(Instance::new(variable("UNITVEC_VULKAN_LOADER").as_deref(), self.validate)?))
    }

    /// The device that `--device` or `UNITVEC_DEVICE` names; an empty name is none.
    fn choice(&self) -> DeviceChoice {
        let name = self.device.clone().filter(|name| !name.is_empty());
        name.map_or(DeviceChoice::Best, DeviceChoice::Named)
    }

    fn device(&self) -> Result<Arc<Device>, unitvec_vulkan::Error> {
        Device::open(&self.instance()?, &self.choice())
    }

    /// Fails where the command line names modules that a command does not take; its help [hides](hide_modules) them.
    #[cfg(feature = "render")]
    fn refuse_modules(&self) -> Result<()> {
        if self.spirv.is_some() || self.trust {
            let options = "--spirv and --trust apply to the kernels; the renderer's shaders are built in";
            return Err(Error::Usage(options.to_owned()));
        }
        Ok(())
    }

    /// A device that draws.
    #[cfg(feature = "render")]
    fn device_for_graphics(&self) -> Result<Arc<Device>, unitvec_vulkan::Error> {
        Device::open_for_graphics(&self.instance()?, &self.choice())
    }

    fn folder(&self) -> Option<PathBuf> {
        let variable = || std::env::var_os("UNITVEC_SPIRV").filter(|folder| !folder.is_empty());
        self.spirv.clone().or_else(|| variable().map(PathBuf::from))
    }

    fn modules(&self) -> Result<Modules> {
        match (self.folder(), self.trust) {
            (Some(folder), true) => Ok(Modules::open_trusted(&folder)?),
            (None, true) => {
                Err(Error::Usage("--trust applies to the modules of --spirv; name their folder".to_owned()))
            }
            (folder, false) => Ok(Modules::open(folder.as_deref())?),
        }
    }

    /// The kernels of a backend; `None` for the CPU.
    fn source(&self, kind: BackendKind, edition: Edition) -> Result<Option<KernelSource>> {
        Ok(match kind {
            BackendKind::Rust => Some(KernelSource::Rust(self.modules()?, edition)),
            BackendKind::Glsl => Some(KernelSource::Glsl(glsl::Compiler::of(edition)?)),
            BackendKind::Hlsl => Some(KernelSource::Language(Language::Hlsl, edition)),
            BackendKind::Wgsl => Some(KernelSource::Language(Language::Wgsl, edition)),
            BackendKind::Cpu => None,
        })
    }

    /// Kernels of these editions from all sources that this build has, plain ones from Rust and GLSL alone; what they fail to
    /// write cannot pass for their results.
    #[cfg(feature = "lab")]
    fn gpus(&self, device: &Arc<Device>, editions: &[Edition]) -> Result<Gpus> {
        let mut gpus = Gpus::new();
        for (kind, edition) in
            BackendKind::of_devices().flat_map(|kind| editions.iter().map(move |edition| (kind, *edition)))
        {
            // Compilers of WGSL may round plain text as they like, which no bound covers.
            let is_plain_text =
                edition == Edition::Plain && matches!(kind, BackendKind::Hlsl | BackendKind::Wgsl);
            if let Some(source) = self.source(kind, edition)?.filter(|_| !is_plain_text) {
                gpus.insert((edition, kind), Gpu::new(device, source, true)?);
            }
        }
        Ok(gpus)
    }

    /// A backend on a device. With `fill_output`, what a kernel fails to write cannot pass for its result.
    fn backend(
        &self,
        kind: BackendKind,
        device: &Arc<Device>,
        fill_output: bool,
    ) -> Result<Box<dyn Backend>> {
        Ok(match self.source(kind, Edition::Exact)? {
            Some(source) => Box::new(Gpu::new(device, source, fill_output)?),
            None => Box::new(Cpu),
        })
    }

    /// All backends that this build has on a device, but the CPU.
    fn backends(&self, device: &Arc<Device>) -> Result<Backends> {
        BackendKind::of_devices().map(|kind| Ok((kind, self.backend(kind, device, true)?))).collect()
    }

    /// True where the command line, not the environment, names a device.
    fn names_device(&self) -> bool {
        self.device.is_some() && self.device.as_deref() != std::env::var("UNITVEC_DEVICE").ok().as_deref()
    }

    /// Fails where the command line, not the environment, asks for what the CPU backend does not have.
    fn refuse_for_cpu(&self) -> Result<()> {
        if self.names_device() || self.validate || self.spirv.is_some() || self.trust {
            let options =
                "--device, --validate, --spirv and --trust need a Vulkan backend; add --backend rust";
            return Err(Error::Usage(options.to_owned()));
        }
        Ok(())
    }
}

/// Where the buffers of a glTF file may lie.
#[derive(Args)]
struct Buffers {
    /// Read the buffers of a .gltf file also from outside its folder (`../`), for files that you trust.
    #[arg(long)]
    buffers_anywhere: bool,
}

impl Buffers {
    fn reach(&self) -> Reach {
        if self.buffers_anywhere { Reach::Anywhere } else { Reach::Folder }
    }
}

/// Hides the options of modules in the help of a command that takes none.
#[cfg(feature = "render")]
fn hide_modules(option: Arg) -> Arg {
    let is_of_modules = ["spirv", "trust"].contains(&option.get_id().as_str());
    if is_of_modules { option.hide(true) } else { option }
}

/// An environment variable; `None` where it is unset or empty.
fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

/// A backend and, where it has one, its device.
struct OpenBackend {
    backend: Box<dyn Backend>,
    device: Option<Arc<Device>>,
}

impl OpenBackend {
    fn open(kind: BackendKind, vulkan: &Vulkan) -> Result<Self> {
        if kind == BackendKind::Cpu {
            vulkan.refuse_for_cpu()?;
            return Ok(Self { backend: Box::new(Cpu), device: None });
        }
        let device = vulkan.device()?;
        Ok(Self { backend: vulkan.backend(kind, &device, false)?, device: Some(device) })
    }

    /// Closes both; the exit status tells of validation messages, those of closing too.
    fn close(self) -> ExitCode {
        drop(self.backend);
        status_after_validation(&self.device.map_or_else(Vec::new, |device| run::close(device).1))
    }
}

/// Writes the whole of an output.
fn write_output(mut output: Output, bytes: &[u8]) -> Result<()> {
    let path = output.path().to_owned();
    output.write_all(bytes).map_err(|source| unitvec_files::Error::writing(&path, source))?;
    Ok(output.finish()?)
}

/// The arguments of a command line.
fn parsed(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, clap::Error> {
    let mut command = Arguments::command();
    let words = words::options_first(&command, words);
    let mut matches = command.try_get_matches_from_mut(words).map_err(words::with_output)?;
    Arguments::from_arg_matches_mut(&mut matches)
}

/// Runs what the command line says.
pub fn run() -> Result<ExitCode> {
    match parsed(std::env::args_os()) {
        Ok(arguments) => arguments.run(),
        // Help and the version, which clap would print to a full disk without a word.
        Err(text) if !text.use_stderr() => {
            let printed = text.print().and_then(|()| io::stdout().flush());
            printed.map_err(|source| unitvec_files::Error::writing(Path::new("-"), source))?;
            Ok(ExitCode::SUCCESS)
        }
        Err(error) if std::env::args_os().all(|argument| is_tame(&argument.to_string_lossy())) => {
            error.exit()
        }
        // It quotes arguments.
        Err(error) => {
            let _ = io::stderr().write_all(shown_lines(error.render()).as_bytes());
            Ok(ExitCode::from(2))
        }
    }
}

/// True for text without control characters.
fn is_tame(text: &str) -> bool {
    !text.contains(char::is_control)
}

/// Prints lines to the standard output.
fn print(text: &str) -> Result<ExitCode> {
    let mut stdout = io::stdout().lock();
    let written = unitvec_files::check_unused(Path::new("-"))
        .and_then(|()| stdout.write_all(shown_lines(text).as_bytes()))
        .and_then(|()| stdout.flush());
    written.map_err(|source| unitvec_files::Error::writing(Path::new("-"), source))?;
    Ok(ExitCode::SUCCESS)
}

/// Tells one line on the standard error. Where that is closed, the exit status has to do.
pub fn tell(words: impl Display) {
    let _ = writeln!(io::stderr(), "unitvec: {}", shown(words));
}

/// The exit status after a run with these validation messages, which go to the standard error.
fn status_after_validation(messages: &[String]) -> ExitCode {
    for message in messages {
        tell(format_args!("validation: {message}"));
    }
    if messages.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn is_mesh(path: &Path) -> bool {
    FileFormat::of_ending(path).is_some()
}

/// The files, and in place of folders those in them, and in folders below them, that are wanted.
fn files_of(paths: &[PathBuf], is_wanted: fn(&Path) -> bool) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        let before = files.len();
        match path.is_dir() {
            true => unitvec_files::add_below(path, &is_wanted, &mut files)?,
            false => files.push(path.clone()),
        }
        if files.len() == before {
            return Err(Error::Usage(format!(
                "no file in the folder {} can be taken; name files",
                path.display()
            )));
        }
    }
    Ok(files)
}

/// Fails unless as many elements were read as a header promised.
fn expect(path: &Path, promised: Option<u64>, read: u64) -> Result<()> {
    match promised {
        Some(promised) if promised != read => {
            let words = format!("it ends after {read} of {promised}; copy it again");
            Err(unitvec_files::Error::reading(path, io::Error::other(words)).into())
        }
        _ => Ok(()),
    }
}

/// The names of kinds of raw floats.
fn dtype() -> impl TypedValueParser<Value = Dtype> {
    PossibleValuesParser::new(DTYPES.map(|(name, ..)| name)).try_map(|name| name.parse::<Dtype>())
}

/// The codecs, of vectors and of frames, with these identifiers; all if there are none.
fn chosen_formats(ids: &[String]) -> Result<Vec<&'static AnyCodec>> {
    if ids.is_empty() {
        return Ok(CODECS.iter().collect());
    }
    let mut chosen: Vec<&'static AnyCodec> = Vec::new();
    for id in ids {
        let format = find(id)?;
        if chosen.iter().all(|other| other.id != format.id) {
            chosen.push(format);
        }
    }
    Ok(chosen)
}

/// Refuses a format of other software, or a wrapped codec, on a GPU.
fn check_backend(format: &AnyCodec, backend: BackendKind) -> Result<()> {
    if !CODECS.contains(format) && backend != BackendKind::Cpu {
        return Err(Error::Usage(format!("the CPU alone encodes {}; leave --backend out", format.id)));
    }
    Ok(())
}

/// Counts of random directions: at least one, and what a day's run could use.
fn counts() -> clap::builder::RangedU64ValueParser<u64> {
    clap::value_parser!(u64).range(1..=1 << 40)
}

/// Writes rows below the names of their fields.
fn write_separated<T: serde::Serialize>(path: &Path, rows: &[T], separator: u8) -> Result<()> {
    let failed = |error: String| unitvec_files::Error::writing(path, io::Error::other(error));
    let mut writer = csv::WriterBuilder::new().delimiter(separator).from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).map_err(|error| failed(error.to_string()))?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.to_string()))?;
    Ok(unitvec_files::write_file(path, &bytes)?)
}

/// Degrees with six decimals, or four digits of what they would not show.
fn degrees(error: f64) -> String {
    if error < 0.0001 { format!("{error:.3e}") } else { format!("{error:.6}") }
}

/// `1 vector`, `2 meshes`.
fn counted(count: u64, plural: &str) -> String {
    let singular = plural.strip_suffix("es").filter(|word| word.ends_with("sh"));
    let singular = singular.or(plural.strip_suffix('s')).unwrap_or(plural);
    format!("{count} {}", if count == 1 { singular } else { plural })
}

/// A number with so many decimals; - for none.
#[cfg(feature = "lab")]
fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
}

/// Writes a chart, as SVG.
#[cfg(feature = "lab")]
fn write_chart(path: &Path, svg: Result<String, Box<dyn std::error::Error>>) -> Result<()> {
    let failed = |error: Box<dyn std::error::Error>| {
        unitvec_files::Error::writing(path, io::Error::other(error.to_string()))
    };
    Ok(unitvec_files::write_file(path, svg.map_err(failed)?.as_bytes())?)
}

/// JSON with a final newline.
fn to_json<T: serde::Serialize>(value: &T) -> String {
    // Serialising plain structs and strings to memory has no way to fail.
    let json = serde_json::to_string_pretty(value).unwrap_or_default() + "\n";
    // JSON leaves these as they are, which stand in strings only.
    let is_left = |c: char| c.is_control() && c >= '\u{7f}';
    match json.contains(is_left) {
        true => {
            let escaped = |c: char| if is_left(c) { format!("\\u{:04x}", u32::from(c)) } else { c.into() };
            json.chars().map(escaped).collect()
        }
        false => json,
    }
}
