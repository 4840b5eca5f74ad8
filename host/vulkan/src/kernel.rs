use super::handle::Handle;
use super::layout::Layout;
use super::module::Module;
use super::{Device, Error, Table};
use ash::vk;
use std::sync::Arc;

/// Bytes of the largest element a buffer holds: a tangent frame of seven f32.
pub(super) const MAX_ELEMENT: usize = 28;

/// Vectors of one invocation, but for kernels that measure.
pub const GROUP: usize = 4;

/// Invocations of one workgroup.
pub const WORKGROUP: usize = 64;

/// Promises about buffers that a kernel can rely on: values of specialization constant 0 of the kernels with the interface
/// of `spirv/manifest.json`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum BufferPromise {
    /// Buffers hold no more than the vectors and codes, and maybe less than the push constant says.
    #[default]
    ExactSize = 0,
    /// Buffers hold whole groups of [`GROUP`] vectors, all that the push constant says. The last group's results beyond
    /// that number mean nothing.
    WholeGroups = 1,
}

/// The division and square root of a kernel: values of specialization constant 1 of the kernels that `spirv/manifest.json`
/// describes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Division {
    /// Rounded correctly, whatever the device does.
    #[default]
    Exact = 0,
    /// The device's own, which may be some last places off.
    Device = 1,
}

/// A compute kernel with the interface of `spirv/manifest.json`: binding 0 in, binding 1 out, binding 2 a table, the
/// number of vectors as push constant.
pub struct Kernel {
    pub(super) pipeline: Handle<vk::Pipeline>,
    pub(super) layout: Arc<Layout>,
    pub(super) table: Option<Table>,
    pub(super) promise: BufferPromise,
}

impl Layout {
    /// The interface that all kernels share.
    pub(super) fn of_kernels(device: &Arc<Device>) -> Result<Self, Error> {
        Self::new(device, vk::ShaderStageFlags::COMPUTE, vk::DescriptorType::STORAGE_BUFFER, None, 8)
    }

    /// Compiles a kernel to a pipeline. The device knows the flags.
    pub(super) fn compile(
        &self,
        (promise, division): (BufferPromise, Division),
        spirv: &[u8],
        entry_point: &str,
        flags: vk::PipelineCreateFlags,
    ) -> Result<Handle<vk::Pipeline>, Error> {
        let module = Module::new(&self.device, spirv, entry_point)?;
        let values = [promise as u32, division as u32];
        let constants = [0, 1].map(|id| {
            vk::SpecializationMapEntry::default().constant_id(id).offset(4 * id).size(size_of::<u32>())
        });
        let data = values.map(u32::to_ne_bytes);
        let specialization =
            vk::SpecializationInfo::default().map_entries(&constants).data(data.as_flattened());
        let stage = module.stage(vk::ShaderStageFlags::COMPUTE).specialization_info(&specialization);
        let create =
            [vk::ComputePipelineCreateInfo::default().flags(flags).stage(stage).layout(*self.pipeline)];
        // SAFETY: the module and the layout are of this device, as the extensions of the flags are; each submission is waited for.
        unsafe {
            let created = self.device.raw.create_compute_pipelines(vk::PipelineCache::null(), &create, None);
            let created = created.map(|pipelines| pipelines[0]).map_err(|(_, result)| result);
            let destroy = ash::Device::destroy_pipeline;
            Handle::new(&self.device, created, "vkCreateComputePipelines", destroy)
        }
    }
}
