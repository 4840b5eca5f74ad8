use super::handle::Handle;
use super::{Device, Error, spirv};
use ash::vk;
use std::ffi::CString;
use std::sync::Arc;

/// A shader module, needed until the pipeline is made.
pub(super) struct Module {
    raw: Handle<vk::ShaderModule>,
    entry_point: CString,
}

impl Module {
    pub(super) fn new(device: &Arc<Device>, spirv: &[u8], entry_point: &str) -> Result<Self, Error> {
        let (words, entry_point) = spirv::checked(spirv, entry_point)?;
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the code is SPIR-V by its framing; that it is valid is checked where modules are built, and by their hash
        // where they are read. Pipelines do not need the modules that they were made of.
        let raw = unsafe {
            let created = device.raw.create_shader_module(&create, None);
            Handle::new(device, created, "vkCreateShaderModule", ash::Device::destroy_shader_module)?
        };
        Ok(Self { raw, entry_point })
    }

    pub(super) fn stage(&self, stage: vk::ShaderStageFlags) -> vk::PipelineShaderStageCreateInfo<'_> {
        vk::PipelineShaderStageCreateInfo::default().stage(stage).module(*self.raw).name(&self.entry_point)
    }
}
