//! The command line.

mod accuracy;
mod codecs;
mod conform;
mod convert;
mod devices;

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_host::backend::{Backend, Cpu, Gpu, KernelSource};
use unitvec_host::glsl;
use unitvec_host::modules::Modules;
use unitvec_host::vulkan::{Device, DeviceChoice, Instance};
use unitvec_host::{Error, Result};

/// Unit-vector codecs on the CPU and on Vulkan: convert files, and show that all agree.
///
/// Exit status: 0 if all went well, 1 if something failed or disagreed, 2 if the command line is at fault.
#[derive(Parser)]
#[command(name = "unitvec", version)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// List the codecs.
    Codecs(codecs::Arguments),
    /// List the Vulkan devices, and which one would be used.
    Devices(Vulkan),
    /// Encode vectors: raw little-endian f32 triples, or the normals of a mesh (obj, ply, gltf, glb).
    Encode(convert::Arguments),
    /// Decode dense codes into raw little-endian f32 triples.
    Decode(convert::Arguments),
    /// Measure the survey's error tables again, beside the published figures.
    Accuracy(accuracy::Arguments),
    /// Show that the CPU, the SPIR-V from Rust and the SPIR-V from GLSL agree to the bit.
    Conform(conform::Arguments),
}

impl Arguments {
    /// Runs the command.
    pub fn run(self) -> Result<ExitCode> {
        match self.command {
            Command::Codecs(arguments) => codecs::run(&arguments),
            Command::Devices(vulkan) => devices::run(&vulkan),
            Command::Encode(arguments) => convert::encode(&arguments),
            Command::Decode(arguments) => convert::decode(&arguments),
            Command::Accuracy(arguments) => accuracy::run(&arguments),
            Command::Conform(arguments) => conform::run(&arguments),
        }
    }
}

/// Which device, and how to open it.
#[derive(Args)]
pub struct Vulkan {
    /// Device, by part of its name or by its index in `unitvec devices`; else the first of the best kind, real GPUs
    /// before software.
    #[arg(long, value_name = "NAME|INDEX", env = "UNITVEC_DEVICE")]
    device: Option<String>,
    /// Vulkan loader library, if not the system's.
    #[arg(long, value_name = "LIBRARY", env = "UNITVEC_VULKAN_LOADER", hide = true)]
    loader: Option<String>,
    /// Run with the Vulkan validation layer; any message of it is a failure.
    #[arg(long)]
    validate: bool,
    /// Folder of SPIR-V modules with a manifest, instead of those inside the program.
    #[arg(long, value_name = "FOLDER", env = "UNITVEC_SPIRV")]
    spirv: Option<PathBuf>,
}

impl Vulkan {
    fn instance(&self) -> Result<Arc<Instance>> {
        Ok(Arc::new(Instance::new(self.loader.as_deref(), self.validate)?))
    }

    fn choice(&self) -> DeviceChoice {
        DeviceChoice::from_option(self.device.clone())
    }

    fn device(&self) -> Result<Arc<Device>> {
        Ok(Device::open(&self.instance()?, &self.choice())?)
    }

    fn modules(&self) -> Result<Modules> {
        Ok(Modules::open(self.spirv.as_deref())?)
    }
}

/// What runs a codec.
#[derive(Clone, Copy, ValueEnum)]
pub enum BackendName {
    /// The crate, on the CPU.
    Cpu,
    /// SPIR-V from Rust, on a Vulkan device.
    Spirv,
    /// SPIR-V from GLSL, on a Vulkan device.
    Glsl,
}

impl BackendName {
    fn open(self, vulkan: &Vulkan) -> Result<OpenBackend> {
        let source = match self {
            Self::Cpu => return Ok(OpenBackend { backend: Box::new(Cpu), device: None }),
            Self::Spirv => KernelSource::Spirv(vulkan.modules()?),
            Self::Glsl => KernelSource::Glsl(glsl::Compiler::new()?),
        };
        let device = vulkan.device()?;
        Ok(OpenBackend { backend: Box::new(Gpu::new(&device, source, false)?), device: Some(device) })
    }
}

/// A backend and, where it has one, its device.
struct OpenBackend {
    backend: Box<dyn Backend>,
    device: Option<Arc<Device>>,
}

/// Prints to the standard output; a reader that has gone away ends the program quietly with success.
fn print(text: &str) -> Result<ExitCode> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Write { path: Path::new("-").to_owned(), source: error })
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// The exit status after a run that may have had validation messages, which go to the standard error.
fn status_after_validation(device: Option<&Arc<Device>>, success: bool) -> ExitCode {
    let messages = device.map_or_else(Vec::new, |device| device.instance().validation_messages());
    for message in &messages {
        eprintln!("unitvec: validation: {message}");
    }
    if success && messages.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// JSON with a final newline.
fn to_json<T: serde::Serialize>(value: &T) -> String {
    // Serialising plain structs and strings to memory has no way to fail.
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}
