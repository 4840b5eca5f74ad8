//! Statistics of a device's compiler about kernels and graphics stages, by VK_KHR_pipeline_executable_properties. Nothing is run.

use super::device::Purpose;
use super::graphics::inspected;
use super::handle::Handle;
use super::layout::Layout;
use super::{
    BufferPromise, Device, DeviceChoice, Division, Error, ImageFormat, Instance, Named, PipelineOptions,
};
use ash::{khr, vk};
use std::collections::HashMap;
use std::sync::Arc;

/// A compiler's statistics of a shader, by the names that the driver gives: `Instructions`.
pub type Statistics = HashMap<String, u64>;

/// Compiles shaders and reports statistics of the result.
pub struct Inspector {
    functions: khr::pipeline_executable_properties::Device,
    layout: Layout,
    graphics: Layout,
}

impl Inspector {
    /// Opens a device for inspection.
    ///
    /// # Errors
    /// The errors of [`Device::open`]; [`Error::NoStatistics`] for a device that reports none.
    pub fn open(instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Self, Error> {
        let device = Device::open_with(instance, choice, Purpose::Statistics)?;
        let functions = khr::pipeline_executable_properties::Device::new(&instance.raw, &device.raw);
        let (layout, graphics) = (Layout::of_kernels(&device)?, Layout::of_graphics(&device)?);
        Ok(Self { functions, layout, graphics })
    }

    /// The device whose compiler this asks.
    pub fn device(&self) -> &Arc<Device> {
        &self.layout.device
    }

    /// Compiles a kernel, for [`BufferPromise::WholeGroups`] and this division.
    ///
    /// The module is trusted as in [`Runner::kernel`](super::Runner::kernel).
    ///
    /// # Errors
    /// [`Error::NotSpirv`] or a failed call.
    pub fn statistics(
        &self,
        division: Division,
        module: &[u8],
        entry_point: &str,
    ) -> Result<Statistics, Error> {
        let flags = vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR;
        let pipeline =
            self.layout.compile((BufferPromise::WholeGroups, division), module, entry_point, flags)?;
        self.executable(&pipeline, 0)
    }

    /// Compiles a graphics pipeline that draws to these formats: the statistics of its vertex shader and of its fragment
    /// shader.
    ///
    /// The modules are trusted as in [`Shader`](super::Shader).
    ///
    /// # Errors
    /// The errors of [`Pipeline::new`](super::Pipeline::new).
    pub fn stages(
        &self,
        colours: &[ImageFormat],
        options: &PipelineOptions<'_>,
    ) -> Result<[Statistics; 2], Error> {
        let pipeline = inspected(&self.graphics, colours, options)?;
        let info = vk::PipelineInfoKHR::default().pipeline(*pipeline);
        // SAFETY: the pipeline is of this device, which was opened with the extension.
        let parts = unsafe { self.functions.get_pipeline_executable_properties(&info) }
            .named("vkGetPipelineExecutablePropertiesKHR")?;
        let of = |stage| {
            let index = parts.iter().zip(0..).find(|(part, _)| part.stages.contains(stage));
            index.map_or_else(|| Ok(Statistics::new()), |(_, index)| self.executable(&pipeline, index))
        };
        Ok([of(vk::ShaderStageFlags::VERTEX)?, of(vk::ShaderStageFlags::FRAGMENT)?])
    }

    /// The statistics of one executable of a pipeline that was made to capture them.
    fn executable(&self, pipeline: &Handle<vk::Pipeline>, index: u32) -> Result<Statistics, Error> {
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(**pipeline).executable_index(index);
        // SAFETY: the pipeline captured statistics, and has an executable of this index; every pipeline has one of index 0.
        let statistics = unsafe { self.functions.get_pipeline_executable_statistics(&info) }
            .named("vkGetPipelineExecutableStatisticsKHR")?;
        Ok(statistics.iter().filter_map(integer).collect())
    }
}

/// A statistic that is an unsigned integer, as all that RADV has are.
fn integer(statistic: &vk::PipelineExecutableStatisticKHR<'_>) -> Option<(String, u64)> {
    if statistic.format != vk::PipelineExecutableStatisticFormatKHR::UINT64 {
        return None;
    }
    // SAFETY: the format names this member of the union as the one that was written.
    let value = unsafe { statistic.value.u64 };
    let name = statistic.name_as_c_str().ok()?.to_string_lossy().into_owned();
    Some((name, value))
}
