//! Three ways to run a codec: on the CPU, and on a Vulkan device with SPIR-V from Rust or from GLSL.

use crate::Result;
use crate::catalogue::{CodecInfo, Coding, Direction, Format, best_fit_table};
use crate::modules::Modules;
use crate::vulkan::{Device, Kernel, Runner, Table};
use crate::{glsl, manifest};
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;
use unitvec::slice::expect_length;

/// Vectors that are processed at a time: 12 MiB of them, so that any amount of data streams through.
pub const CHUNK: usize = 1 << 20;

/// Something that encodes and decodes.
pub trait Backend {
    /// Encodes up to [`CHUNK`] vectors into dense codes. Returns the device's nanoseconds where it tells them.
    ///
    /// # Errors
    /// What the backend meets: a wrong size, a missing module, a failed Vulkan call.
    fn encode(
        &mut self,
        codec: &'static CodecInfo,
        vectors: &[[f32; 3]],
        codes: &mut [u8],
    ) -> Result<Option<f64>>;

    /// Decodes up to [`CHUNK`] dense codes. Returns the device's nanoseconds where it tells them.
    ///
    /// # Errors
    /// As [`encode`](Self::encode).
    fn decode(
        &mut self,
        codec: &'static CodecInfo,
        codes: &[u8],
        vectors: &mut [[f32; 3]],
    ) -> Result<Option<f64>>;
}

/// The crate's functions on this machine's CPU.
pub struct Cpu;

impl Backend for Cpu {
    fn encode(
        &mut self,
        codec: &'static CodecInfo,
        vectors: &[[f32; 3]],
        codes: &mut [u8],
    ) -> Result<Option<f64>> {
        codec.encode_cpu(vectors, codes)?;
        Ok(None)
    }

    fn decode(
        &mut self,
        codec: &'static CodecInfo,
        codes: &[u8],
        vectors: &mut [[f32; 3]],
    ) -> Result<Option<f64>> {
        codec.decode_cpu(codes, vectors)?;
        Ok(None)
    }
}

/// Where a GPU backend's kernels come from.
pub enum KernelSource {
    /// SPIR-V that rust-gpu compiled from the crate.
    Spirv(Modules),
    /// SPIR-V that glslang compiles from the GLSL now.
    Glsl(glsl::Compiler),
}

impl KernelSource {
    pub(crate) fn kernel(
        &self,
        runner: &Runner,
        format: Format,
        direction: Direction,
        table: Option<&Table>,
    ) -> Result<Kernel> {
        Ok(match self {
            Self::Spirv(modules) => {
                let (module, entry_point) = modules.load(&format.function(direction))?;
                runner.kernel(&module, entry_point, table)?
            }
            Self::Glsl(compiler) => {
                runner.kernel(&compiler.kernel(format, direction)?, glsl::ENTRY_POINT, table)?
            }
        })
    }

    pub(crate) fn decode_by_table(&self, runner: &Runner, table: &Table) -> Result<Kernel> {
        Ok(match self {
            Self::Spirv(modules) => {
                let (module, entry_point) = modules.load(manifest::DECODE_BY_TABLE)?;
                runner.kernel(&module, entry_point, Some(table))?
            }
            Self::Glsl(compiler) => {
                runner.kernel(&compiler.decode_by_table()?, glsl::ENTRY_POINT, Some(table))?
            }
        })
    }

    /// The bytes of the table of [`unitvec::best_fit`]: those shipped beside the modules, or computed.
    fn best_fit_table(&self) -> Result<Cow<'static, [u8]>> {
        Ok(match self {
            Self::Spirv(modules) => modules.table(manifest::BEST_FIT_TABLE)?,
            Self::Glsl(_) => Cow::Borrowed(bytemuck::cast_slice(best_fit_table())),
        })
    }
}

/// Kernels on a Vulkan device.
pub struct Gpu {
    runner: Runner,
    source: KernelSource,
    kernels: HashMap<(&'static str, Direction), Kernel>,
    decoders_by_table: HashMap<&'static str, Kernel>,
    best_fit_table: Option<Table>,
}

impl Gpu {
    /// A backend on `device`. With `fill_output`, what a kernel fails to write cannot pass for its result: for tests.
    ///
    /// # Errors
    /// A failed Vulkan call.
    pub fn new(device: &Arc<Device>, source: KernelSource, fill_output: bool) -> Result<Self> {
        Ok(Self {
            runner: Runner::new(device, CHUNK, fill_output)?,
            source,
            kernels: HashMap::new(),
            decoders_by_table: HashMap::new(),
            best_fit_table: None,
        })
    }

    /// As [`Backend::encode`], of vectors or frames.
    ///
    /// # Errors
    /// As [`Backend::encode`].
    pub fn encode_elements<const N: usize>(
        &mut self,
        codec: &impl Coding<N>,
        elements: &[[f32; N]],
        codes: &mut [u8],
    ) -> Result<Option<f64>> {
        let format = codec.format();
        expect_length(elements.len() * format.bytes, codes.len())?;
        self.run(
            format,
            Direction::Encode,
            elements.len(),
            bytemuck::cast_slice(elements.as_flattened()),
            codes,
        )
    }

    /// As [`Backend::decode`], of vectors or frames.
    ///
    /// # Errors
    /// As [`Backend::encode`].
    pub fn decode_elements<const N: usize>(
        &mut self,
        codec: &impl Coding<N>,
        codes: &[u8],
        elements: &mut [[f32; N]],
    ) -> Result<Option<f64>> {
        let format = codec.format();
        expect_length(codes.len(), elements.len() * format.bytes)?;
        self.run(
            format,
            Direction::Decode,
            elements.len(),
            codes,
            bytemuck::cast_slice_mut(elements.as_flattened_mut()),
        )
    }

    fn run(
        &mut self,
        format: Format,
        direction: Direction,
        elements: usize,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Option<f64>> {
        if elements == 0 {
            return Ok(None);
        }
        let key = (format.id, direction);
        if !self.kernels.contains_key(&key) {
            let table = if direction == Direction::Encode && format.encodes_by_table {
                Some(self.best_fit_table()?)
            } else {
                None
            };
            let kernel = self.source.kernel(&self.runner, format, direction, table.as_ref())?;
            self.kernels.insert(key, kernel);
        }
        Ok(self.runner.run(&self.kernels[&key], elements, input, output)?)
    }

    fn best_fit_table(&mut self) -> Result<Table> {
        if let Some(table) = &self.best_fit_table {
            return Ok(table.clone());
        }
        let table = self.runner.table(&self.source.best_fit_table()?)?;
        Ok(self.best_fit_table.insert(table).clone())
    }

    /// Decodes by looking up the vectors of all codes, which the CPU decodes once. For codecs of two-byte codes.
    ///
    /// # Errors
    /// As [`Backend::decode`]; [`LengthMismatch`](unitvec::slice::LengthMismatch) for codecs of more bytes.
    pub fn decode_by_table(
        &mut self,
        codec: &'static CodecInfo,
        codes: &[u8],
        vectors: &mut [[f32; 3]],
    ) -> Result<Option<f64>> {
        expect_length(vectors.len() * 2, codes.len())?;
        if vectors.is_empty() {
            return Ok(None);
        }
        if !self.decoders_by_table.contains_key(codec.id) {
            let table = self.runner.table(bytemuck::cast_slice(&decode_table(codec)?))?;
            let kernel = self.source.decode_by_table(&self.runner, &table)?;
            self.decoders_by_table.insert(codec.id, kernel);
        }
        let kernel = &self.decoders_by_table[codec.id];
        Ok(self.runner.run(kernel, vectors.len(), codes, bytemuck::cast_slice_mut(vectors))?)
    }
}

impl Backend for Gpu {
    fn encode(
        &mut self,
        codec: &'static CodecInfo,
        vectors: &[[f32; 3]],
        codes: &mut [u8],
    ) -> Result<Option<f64>> {
        self.encode_elements(codec, vectors, codes)
    }

    fn decode(
        &mut self,
        codec: &'static CodecInfo,
        codes: &[u8],
        vectors: &mut [[f32; 3]],
    ) -> Result<Option<f64>> {
        self.decode_elements(codec, codes, vectors)
    }
}

/// The vectors of all codes of two bytes.
pub(crate) fn decode_table(codec: &CodecInfo) -> Result<Vec<[f32; 3]>> {
    let codes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    let mut vectors = vec![[0.0; 3]; codes.len() / 2];
    codec.decode_cpu(&codes, &mut vectors)?;
    Ok(vectors)
}
