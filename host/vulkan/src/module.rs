use super::{Device, Error, Named, spirv};
use ash::vk;
use std::ffi::CString;
use std::sync::Arc;

/// A shader module, needed until the pipeline is made.
pub(super) struct Module {
    raw: vk::ShaderModule,
    entry_point: CString,
    device: Arc<Device>,
}

impl Module {
    pub(super) fn new(device: &Arc<Device>, spirv: &[u8], entry_point: &str) -> Result<Self, Error> {
        let (words, entry_point) = spirv::checked(spirv, entry_point)?;
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the code is SPIR-V by its framing; that it is valid is checked where modules are built, and by their hash
        // where they are read.
        let raw = unsafe { device.raw.create_shader_module(&create, None) }.named("vkCreateShaderModule")?;
        Ok(Self { raw, entry_point, device: device.clone() })
    }

    pub(super) fn stage(&self, stage: vk::ShaderStageFlags) -> vk::PipelineShaderStageCreateInfo<'_> {
        vk::PipelineShaderStageCreateInfo::default().stage(stage).module(self.raw).name(&self.entry_point)
    }
}

impl Drop for Module {
    fn drop(&mut self) {
        // SAFETY: pipelines do not need the modules that they were made of.
        unsafe { self.device.raw.destroy_shader_module(self.raw, None) };
    }
}
