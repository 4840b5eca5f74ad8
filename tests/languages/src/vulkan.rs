//! SPIR-V on a Vulkan device.

use crate::cases::{COUNT, Case};
use crate::{Result, told};
use std::sync::Arc;
use unitvec_run::shader::kernel::ENTRY_POINT;
use unitvec_vulkan::{Device, DeviceChoice, Instance, Runner};

/// A device that runs kernels.
pub struct Vulkan {
    runner: Runner,
}

impl Vulkan {
    pub fn new(device: &DeviceChoice) -> Result<Self> {
        let instance = Arc::new(Instance::new(None, false).map_err(told)?);
        let device = Device::open(&instance, device).map_err(told)?;
        Ok(Self { runner: Runner::new(&device, COUNT, true).map_err(told)? })
    }

    /// Name and version of its driver.
    pub fn driver(&self) -> String {
        self.runner.device().info().driver.clone()
    }

    /// The words that a module's kernel writes.
    pub fn run(&mut self, spirv: &[u8], case: &Case) -> Result<Vec<u32>> {
        let mut output = vec![0; case.expected.len()];
        let mut run = || {
            let kernel = self.runner.kernel(spirv, ENTRY_POINT, None)?;
            let (input, output) = (bytemuck::cast_slice(&case.input), bytemuck::cast_slice_mut(&mut output));
            self.runner.run(&kernel, COUNT, input, output)
        };
        run().map_err(|error: unitvec_vulkan::Error| error.to_string())?;
        Ok(output)
    }
}
