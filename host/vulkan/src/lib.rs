//! The Vulkan layer: instances, devices, memory, compute kernels and graphics pipelines, each released when dropped.
//!
//! All of the program's `unsafe` is here, around ash calls. The rules that make those calls sound hold throughout:
//! handles are created and destroyed only by the type that owns them; whatever uses a device keeps it alive through
//! an `Arc`; a submission is waited for before the call that made it returns, so nothing is in use when dropped.

mod buffer;
mod device;
mod error;
mod format;
mod graphics;
mod handle;
mod instance;
mod kernel;
mod layout;
mod memory;
mod module;
mod runner;
mod spirv;
mod statistics;
mod submission;

pub use device::{Device, DeviceChoice, DeviceInfo, DeviceKind};
pub use error::Error;
pub use format::{FormatUse, ImageFormat, bytes_per_texel};
pub use graphics::{Draw, Graphics, Image, Mesh, Pipeline, PipelineOptions, Shader, Target};
pub use instance::Instance;
pub use kernel::{BufferPromise, Division, GROUP, Kernel, WORKGROUP};
pub use runner::{Runner, SENTINEL, Table};
pub use spirv::check_spirv;
pub use statistics::{Inspector, Statistics};

use ash::vk;

/// Names the call in the error.
trait Named<T> {
    fn named(self, call: &'static str) -> Result<T, Error>;
}

impl<T> Named<T> for Result<T, vk::Result> {
    fn named(self, call: &'static str) -> Result<T, Error> {
        self.map_err(|result| Error::Call { call, result })
    }
}
