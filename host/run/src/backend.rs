//! The ways to run a codec: on the CPU, and on a Vulkan device with SPIR-V from Rust, GLSL, HLSL or WGSL.

use crate::{Error, Result, glsl, sampling, shader};
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Operation, best_fit_table};
use unitvec_languages::{Edition, Language};
use unitvec_manifest as manifest;
use unitvec_manifest::modules::Modules;
use unitvec_vulkan::{BufferPromise, Device, Division, Kernel, Runner, Table};

/// Vectors or frames that are processed at a time: 12 or 28 MiB, so that any amount of data streams through.
pub const CHUNK: usize = 1 << 20;

/// The runner of a codec.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, ValueEnum, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum BackendKind {
    /// The crate, on the CPU.
    Cpu,
    /// SPIR-V from Rust, on a Vulkan device.
    Rust,
    /// SPIR-V from GLSL, on a Vulkan device.
    Glsl,
    /// SPIR-V that glslang makes of HLSL, on a Vulkan device.
    Hlsl,
    /// SPIR-V that naga makes of WGSL, on a Vulkan device.
    Wgsl,
}

impl BackendKind {
    /// The backends of this build for Vulkan devices: GLSL and HLSL need the compiler that the feature `glsl` brings.
    pub fn of_devices() -> impl Iterator<Item = Self> {
        let has_glslang = cfg!(feature = "glsl");
        let kinds = [Self::Rust, Self::Glsl, Self::Hlsl, Self::Wgsl].into_iter();
        kinds.filter(move |kind| has_glslang || matches!(kind, Self::Rust | Self::Wgsl))
    }
}

impl fmt::Display for BackendKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Each has a name, since clap skips none.
        self.to_possible_value().map_or(Ok(()), |value| f.write_str(value.get_name()))
    }
}

/// Something that encodes and decodes. The floats of vectors or frames follow each other.
pub trait Backend {
    /// Encodes up to [`CHUNK`] elements into dense codes.
    ///
    /// # Errors
    /// Any error of the backend: a wrong size, a missing module, a failed Vulkan call.
    fn encode(&mut self, format: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> Result<()>;

    /// Decodes up to [`CHUNK`] dense codes.
    ///
    /// # Errors
    /// The errors of [`encode`](Self::encode).
    fn decode(&mut self, format: &AnyCodec, codes: &[u8], elements: &mut [f32]) -> Result<()>;
}

/// Encodes and decodes the first `count` of elements whose floats follow each other, and hands on each with its decoded
/// element.
///
/// # Errors
/// Any error of the backend.
pub fn round_trip(
    backend: &mut dyn Backend,
    codec: &AnyCodec,
    elements: impl Iterator<Item = f32>,
    count: usize,
    mut each: impl FnMut(&[f32], &[f32]),
) -> Result<()> {
    let floats = codec.element.floats();
    let mut codes = vec![0; CHUNK.min(count) * codec.bytes];
    let mut decoded = vec![0.0; CHUNK.min(count) * floats];
    sampling::in_chunks(elements, count * floats, CHUNK * floats, |elements| {
        let codes = &mut codes[..elements.len() / floats * codec.bytes];
        let decoded = &mut decoded[..elements.len()];
        backend.encode(codec, elements, codes)?;
        backend.decode(codec, codes, decoded)?;
        let pairs = elements.chunks_exact(floats).zip(decoded.chunks_exact(floats));
        pairs.for_each(|(element, decoded)| each(element, decoded));
        Ok(())
    })
}

/// The crate's functions on this machine's CPU.
pub struct Cpu;

impl Backend for Cpu {
    fn encode(&mut self, format: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> Result<()> {
        Ok(format.encode_cpu(elements, codes)?)
    }

    fn decode(&mut self, format: &AnyCodec, codes: &[u8], elements: &mut [f32]) -> Result<()> {
        Ok(format.decode_cpu(codes, elements)?)
    }
}

/// The source of a GPU backend's kernels.
pub enum KernelSource {
    /// SPIR-V that rust-gpu compiled from the crate, and the edition to specialize it to.
    Rust(Modules, Edition),
    /// SPIR-V that glslang compiles from the GLSL now, in the compiler's edition.
    Glsl(glsl::Compiler),
    /// SPIR-V that glslang makes of HLSL now, or naga of WGSL. Its kernels take and give codes as whole words.
    Language(Language, Edition),
}

impl KernelSource {
    /// The kernel of a codec.
    ///
    /// # Errors
    /// A module that is missing or does not compile, or a failed Vulkan call.
    pub fn kernel(
        &self,
        runner: &Runner,
        format: &AnyCodec,
        operation: Operation,
        table: Option<&Table>,
    ) -> Result<Kernel> {
        let name = format.function(operation);
        let (module, entry_point) = self.module(&name, Some((format, operation)))?;
        self.load(runner, &module, entry_point, table)
    }

    /// The module as a kernel of this source's edition.
    fn load(
        &self,
        runner: &Runner,
        module: &[u8],
        entry_point: &str,
        table: Option<&Table>,
    ) -> Result<Kernel> {
        let division = match self {
            Self::Rust(_, Edition::Plain) => Division::Device,
            Self::Rust(_, Edition::Exact) | Self::Glsl(_) | Self::Language(..) => Division::Exact,
        };
        Ok(runner.kernel_for(BufferPromise::ExactSize, division, module, entry_point, table)?)
    }

    /// The kernel that decodes two-byte codes by `table`, which holds the vectors of all codes.
    ///
    /// # Errors
    /// Any error of loading, compiling or Vulkan.
    pub fn decode_by_table(&self, runner: &Runner, table: &Table) -> Result<Kernel> {
        let (module, entry_point) = self.module(manifest::DECODE_BY_TABLE, None)?;
        Ok(runner.kernel(&module, entry_point, Some(table))?)
    }

    /// The module of the kernel with this name, among those shipped or as it is compiled now, and its entry point: a codec's,
    /// or without one that which decodes by a table.
    fn module<'a>(
        &self,
        name: &'a str,
        codec: Option<(&AnyCodec, Operation)>,
    ) -> Result<(Cow<'static, [u8]>, &'a str)> {
        let module = match (self, codec) {
            (Self::Rust(modules, _), _) => return Ok((modules.load(name)?, name)),
            (Self::Glsl(compiler), Some((format, operation))) => compiler.kernel(format, operation)?,
            (Self::Glsl(compiler), None) => compiler.decode_by_table()?,
            (Self::Language(language, edition), Some((format, operation))) => {
                shader::module(*language, *edition, format, operation)?
            }
            (Self::Language(language, _), None) => return Err(shader::Error::NoTable(*language).into()),
        };
        // Both compilers' kernels are named alike.
        Ok((Cow::Owned(module), glsl::ENTRY_POINT))
    }
}

/// A change to each kernel's module before it is loaded, such as arithmetic that rounds otherwise.
#[derive(Clone)]
pub struct Rewrite {
    /// The name of a rewrite, by which kernels of each are kept.
    pub key: u64,
    /// Rewrites a module, given the kernel's name and its entry point.
    pub module: RewriteModule,
}

/// The function of a [`Rewrite`].
pub type RewriteModule =
    Arc<dyn Fn(&[u8], &str, &str) -> Result<Vec<u8>, Box<dyn std::error::Error + Send + Sync>> + Send + Sync>;

/// A codec, an operation, and the key of a rewrite.
type Key = (&'static str, Operation, Option<u64>);

/// Kernels on a Vulkan device.
pub struct Gpu {
    runner: Runner,
    source: KernelSource,
    kernels: HashMap<Key, Kernel>,
    best_fit_table: Option<Table>,
    rewrite: Option<Rewrite>,
}

impl Gpu {
    /// A backend on `device`. With `fill_output`, missing output of a kernel cannot pass for its result: for tests.
    ///
    /// # Errors
    /// A failed Vulkan call.
    pub fn new(device: &Arc<Device>, source: KernelSource, fill_output: bool) -> Result<Self> {
        let runner = Runner::new(device, CHUNK, fill_output)?;
        Ok(Self { runner, source, kernels: HashMap::new(), best_fit_table: None, rewrite: None })
    }

    /// Runs kernels that this rewrite changed from here on; as they are, without one.
    pub fn rewrite_with(&mut self, rewrite: Option<Rewrite>) {
        self.rewrite = rewrite;
    }

    /// Frees the kernels, which are made again when they are needed.
    pub fn forget_kernels(&mut self) {
        self.kernels.clear();
    }

    fn run(
        &mut self,
        format: &AnyCodec,
        operation: Operation,
        count: usize,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<()> {
        if count == 0 {
            return Ok(());
        }
        let key = (format.id, operation, self.rewrite.as_ref().map(|rewrite| rewrite.key));
        if !self.kernels.contains_key(&key) {
            let takes_table = format.encodes_by_table && !matches!(self.source, KernelSource::Language(..));
            let by_table = operation == Operation::Encode && takes_table;
            let table = if by_table { Some(self.best_fit_table()?) } else { None };
            let (source, runner, table) = (&self.source, &self.runner, table.as_ref());
            let name = format.function(operation);
            let (mut module, entry_point) = source.module(&name, Some((format, operation)))?;
            if let Some(rewrite) = &self.rewrite {
                let rewritten = (rewrite.module)(&module, &name, entry_point);
                module = Cow::Owned(rewritten.map_err(Error::Rewrite)?);
            }
            self.kernels.insert(key, source.load(runner, &module, entry_point, table)?);
        }
        self.runner.run(&self.kernels[&key], count, input, output)?;
        Ok(())
    }

    /// The table of [`unitvec::best_fit`]: the one shipped beside the modules, or computed.
    fn best_fit_table(&mut self) -> Result<Table> {
        if let Some(table) = &self.best_fit_table {
            return Ok(table.clone());
        }
        let bytes = match &self.source {
            KernelSource::Rust(modules, _) => modules.table(manifest::BEST_FIT_TABLE)?,
            KernelSource::Glsl(_) | KernelSource::Language(..) => {
                Cow::Borrowed(bytemuck::cast_slice(best_fit_table()))
            }
        };
        let table = self.runner.table(&bytes)?;
        Ok(self.best_fit_table.insert(table).clone())
    }
}

impl Backend for Gpu {
    fn encode(&mut self, format: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        let input = bytemuck::cast_slice(elements);
        let KernelSource::Language(language, _) = self.source else {
            return self.run(format, Operation::Encode, count, input, codes);
        };
        let mut words = shader::words_of(format, codes);
        self.run(format, Operation::Encode, count, input, &mut words)?;
        shader::store_words(language, format, &words, codes)
    }

    fn decode(&mut self, format: &AnyCodec, codes: &[u8], elements: &mut [f32]) -> Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        let words = match self.source {
            KernelSource::Language(..) => Cow::Owned(shader::words_of(format, codes)),
            KernelSource::Rust(..) | KernelSource::Glsl(_) => Cow::Borrowed(codes),
        };
        self.run(format, Operation::Decode, count, &words, bytemuck::cast_slice_mut(elements))
    }
}

/// The vectors of all codes of a codec of two bytes.
///
/// # Errors
/// [`LengthMismatch`](unitvec::slice::LengthMismatch) for a codec of more bytes.
pub fn decode_table(codec: &AnyCodec) -> Result<Vec<[f32; 3]>> {
    let codes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    let mut vectors = vec![[0.0; 3]; codes.len() / 2];
    codec.decode_cpu(&codes, vectors.as_flattened_mut())?;
    Ok(vectors)
}
