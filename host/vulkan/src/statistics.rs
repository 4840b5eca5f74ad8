//! Statistics of a device's compiler about kernels, by VK_KHR_pipeline_executable_properties. Nothing is run.

use super::device::Purpose;
use super::layout::Layout;
use super::{BufferPromise, Device, DeviceChoice, Division, Error, Instance, Named};
use ash::{khr, vk};
use std::collections::HashMap;
use std::sync::Arc;

/// A compiler's statistics of a kernel, by the names that the driver gives: `Instructions`.
pub type Statistics = HashMap<String, u64>;

/// Compiles kernels and reports statistics of the result.
pub struct Inspector {
    functions: khr::pipeline_executable_properties::Device,
    layout: Layout,
}

impl Inspector {
    /// Opens a device for inspection.
    ///
    /// # Errors
    /// The errors of [`Device::open`]; [`Error::NoStatistics`] for a device that reports none.
    pub fn open(instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Self, Error> {
        let device = Device::open_with(instance, choice, Purpose::Statistics)?;
        let functions = khr::pipeline_executable_properties::Device::new(&instance.raw, &device.raw);
        Ok(Self { functions, layout: Layout::of_kernels(&device)? })
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
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(*pipeline);
        // SAFETY: the pipeline was made to capture statistics and has one executable at least.
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
