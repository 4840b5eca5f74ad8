//! What a device's compiler makes of kernels, by VK_KHR_pipeline_executable_properties. Nothing is run.

use super::kernel::Layout;
use super::{Device, DeviceChoice, Error, Instance, Named, spirv};
use ash::{khr, vk};
use std::collections::HashMap;
use std::sync::Arc;

/// The number of the specialisation constant by which kernels leave out what incomplete groups need, and its value.
const WHOLE_GROUPS: (u32, u32) = (0, 1);

/// What a compiler tells of a kernel, by the names that the driver gives: `Instructions`.
pub type Statistics = HashMap<String, u64>;

/// Compiles kernels and tells what became of them.
pub struct Inspector {
    functions: khr::pipeline_executable_properties::Device,
    layout: Layout,
}

impl Inspector {
    /// Opens a device for this.
    ///
    /// # Errors
    /// As [`Device::open`]; [`Error::NoStatistics`] for a device that does not tell.
    pub fn open(instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Self, Error> {
        let device = Device::open_for_statistics(instance, choice)?;
        let functions = khr::pipeline_executable_properties::Device::new(&instance.raw, &device.raw);
        Ok(Self { functions, layout: Layout::new(&device)? })
    }

    /// The device.
    pub fn device(&self) -> &Arc<Device> {
        &self.layout.device
    }

    /// Compiles a kernel for buffers of whole groups, where it knows that constant.
    ///
    /// The module is trusted as in [`Runner::kernel`](super::Runner::kernel).
    ///
    /// # Errors
    /// [`Error::NotSpirv`] or a failed call.
    pub fn statistics(&self, module: &[u8], entry_point: &str) -> Result<Statistics, Error> {
        let pipeline = self.compile(module, entry_point)?;
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline);
        // SAFETY: the pipeline was made to capture statistics and has one executable at least; nothing else knows it.
        let statistics = unsafe {
            let statistics = self.functions.get_pipeline_executable_statistics(&info);
            self.layout.device.raw.destroy_pipeline(pipeline, None);
            statistics
        }
        .named("vkGetPipelineExecutableStatisticsKHR")?;
        Ok(statistics.iter().filter_map(integer).collect())
    }

    fn compile(&self, module: &[u8], entry_point: &str) -> Result<vk::Pipeline, Error> {
        let (words, name) = spirv::checked(module, entry_point)?;
        let device = &self.layout.device.raw;
        let (id, value) = WHOLE_GROUPS;
        let entries = [vk::SpecializationMapEntry::default().constant_id(id).size(size_of::<u32>())];
        let data = value.to_ne_bytes();
        let constants = vk::SpecializationInfo::default().map_entries(&entries).data(&data);
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: as in `Kernel::new`.
        let module = unsafe { device.create_shader_module(&create, None) }.named("vkCreateShaderModule")?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(&name)
            .specialization_info(&constants);
        let create = [vk::ComputePipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .stage(stage)
            .layout(self.layout.pipeline)];
        // SAFETY: the module and the layout are of this device, which has the extension that the flag needs; the module may
        // go once the pipeline is made.
        let result = unsafe {
            let result = device.create_compute_pipelines(vk::PipelineCache::null(), &create, None);
            device.destroy_shader_module(module, None);
            result
        };
        let pipelines =
            result.map_err(|(_, result)| Error::Call { call: "vkCreateComputePipelines", result })?;
        Ok(pipelines[0])
    }
}

/// A statistic that is an unsigned integer, as all that RADV has are.
fn integer(statistic: &vk::PipelineExecutableStatisticKHR<'_>) -> Option<(String, u64)> {
    if statistic.format != vk::PipelineExecutableStatisticFormatKHR::UINT64 {
        return None;
    }
    // SAFETY: the format says that this member of the union is the one that was written.
    let value = unsafe { statistic.value.u64 };
    let name = statistic.name_as_c_str().ok()?.to_string_lossy().into_owned();
    Some((name, value))
}
