//! Three ways to run a codec: on the CPU, and on a Vulkan device with SPIR-V from Rust or from GLSL.

use crate::Result;
use crate::catalogue::{CodecInfo, Direction};
use crate::glsl;
use crate::modules::Modules;
use crate::vulkan::{Device, Kernel, Runner};
use std::collections::HashMap;
use std::sync::Arc;

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
    fn kernel(&self, runner: &Runner, codec: &CodecInfo, direction: Direction) -> Result<Kernel> {
        Ok(match self {
            Self::Spirv(modules) => {
                runner.kernel(&modules.load(codec, direction)?, &codec.function(direction))?
            }
            Self::Glsl(compiler) => runner.kernel(&compiler.kernel(codec, direction)?, glsl::ENTRY_POINT)?,
        })
    }
}

/// Kernels on a Vulkan device.
pub struct Gpu {
    runner: Runner,
    source: KernelSource,
    kernels: HashMap<(&'static str, Direction), Kernel>,
}

impl Gpu {
    /// A backend on `device`. With `fill_output`, what a kernel fails to write cannot pass for its result: for tests.
    ///
    /// # Errors
    /// A failed Vulkan call.
    pub fn new(device: &Arc<Device>, source: KernelSource, fill_output: bool) -> Result<Self> {
        Ok(Self { runner: Runner::new(device, CHUNK, fill_output)?, source, kernels: HashMap::new() })
    }

    /// Compiles a kernel and runs it once, so that the next run's time is the kernel's alone.
    ///
    /// # Errors
    /// As [`Backend::encode`].
    pub fn warm_up(&mut self, codec: &'static CodecInfo) -> Result<()> {
        let mut codes = vec![0; 4 * codec.bytes];
        self.encode(codec, &[[0.0, 0.0, 1.0]; 4], &mut codes)?;
        self.decode(codec, &codes, &mut [[0.0; 3]; 4])?;
        Ok(())
    }

    fn run(
        &mut self,
        codec: &'static CodecInfo,
        direction: Direction,
        vectors: usize,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Option<f64>> {
        if vectors == 0 {
            return Ok(None);
        }
        let key = (codec.id, direction);
        if !self.kernels.contains_key(&key) {
            self.kernels.insert(key, self.source.kernel(&self.runner, codec, direction)?);
        }
        Ok(self.runner.run(&self.kernels[&key], vectors, input, output)?)
    }
}

impl Backend for Gpu {
    fn encode(
        &mut self,
        codec: &'static CodecInfo,
        vectors: &[[f32; 3]],
        codes: &mut [u8],
    ) -> Result<Option<f64>> {
        expect_length(vectors.len() * codec.bytes, codes.len())?;
        self.run(codec, Direction::Encode, vectors.len(), bytemuck::cast_slice(vectors), codes)
    }

    fn decode(
        &mut self,
        codec: &'static CodecInfo,
        codes: &[u8],
        vectors: &mut [[f32; 3]],
    ) -> Result<Option<f64>> {
        expect_length(codes.len(), vectors.len() * codec.bytes)?;
        self.run(codec, Direction::Decode, vectors.len(), codes, bytemuck::cast_slice_mut(vectors))
    }
}

fn expect_length(expected: usize, actual: usize) -> Result<(), unitvec::slice::LengthMismatch> {
    if expected == actual { Ok(()) } else { Err(unitvec::slice::LengthMismatch { expected, actual }) }
}
