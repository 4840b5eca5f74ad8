//! Interfaces of pipelines, and the descriptors for them.

use super::handle::Handle;
use super::{Device, Error, Named};
use ash::vk;
use std::sync::Arc;

/// Descriptors of a pipeline, bindings 0 and up of set 0.
pub(super) const BINDINGS: u32 = 3;

/// The interface that all kernels share, or all graphics pipelines: [`BINDINGS`] descriptors, maybe a sampler in the binding
/// after them, and push constants.
pub(super) struct Layout {
    pub(super) pipeline: Handle<vk::PipelineLayout>,
    set: Handle<vk::DescriptorSetLayout>,
    // Kept for as long as the set's layout refers to it.
    _sampler: Option<Handle<vk::Sampler>>,
    descriptors: vk::DescriptorType,
    pub(super) device: Arc<Device>,
}

impl Layout {
    /// An interface of these descriptors, a sampler or none, and `constants` bytes of push constants, which these stages see.
    pub(super) fn new(
        device: &Arc<Device>,
        stages: vk::ShaderStageFlags,
        descriptors: vk::DescriptorType,
        sampler: Option<Handle<vk::Sampler>>,
        constants: u32,
    ) -> Result<Self, Error> {
        let binding = vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(descriptors)
            .descriptor_count(1)
            .stage_flags(stages);
        let mut bindings: Vec<_> = (0..BINDINGS).map(|index| binding.binding(index)).collect();
        let samplers: Vec<_> = sampler.as_deref().copied().into_iter().collect();
        if sampler.is_some() {
            let binding = binding.binding(BINDINGS).descriptor_type(vk::DescriptorType::SAMPLER);
            bindings.push(binding.immutable_samplers(&samplers));
        }
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: a valid create info; pipelines and whatever runs them keep an Arc to the layout.
        let set = unsafe {
            let created = device.raw.create_descriptor_set_layout(&create, None);
            let destroy = ash::Device::destroy_descriptor_set_layout;
            Handle::new(device, created, "vkCreateDescriptorSetLayout", destroy)?
        };
        let sets = [*set];
        let constants = [vk::PushConstantRange::default().stage_flags(stages).size(constants)];
        let create =
            vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&constants);
        // SAFETY: as above.
        let pipeline = unsafe {
            let created = device.raw.create_pipeline_layout(&create, None);
            Handle::new(device, created, "vkCreatePipelineLayout", ash::Device::destroy_pipeline_layout)?
        };
        Ok(Self { pipeline, set, _sampler: sampler, descriptors, device: device.clone() })
    }
}

/// The descriptor set of one submission at a time.
pub(super) struct Descriptors {
    pool: Handle<vk::DescriptorPool>,
    layout: Arc<Layout>,
}

impl Descriptors {
    pub(super) fn new(layout: &Arc<Layout>) -> Result<Self, Error> {
        let sizes = [(layout.descriptors, BINDINGS), (vk::DescriptorType::SAMPLER, 1)]
            .map(|(ty, count)| vk::DescriptorPoolSize::default().ty(ty).descriptor_count(count));
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let (device, destroy) = (&layout.device, ash::Device::destroy_descriptor_pool);
        // SAFETY: a valid create info; each submission is waited for.
        let pool = unsafe {
            let created = device.raw.create_descriptor_pool(&create, None);
            Handle::new(device, created, "vkCreateDescriptorPool", destroy)?
        };
        Ok(Self { pool, layout: layout.clone() })
    }

    /// A new set in place of the last one, for the next submission: in an old one, textures or tables that are gone would be
    /// left at the numbers that this one does not have, and drivers may look at them.
    ///
    /// # Safety
    /// No submission that uses the last set is running.
    pub(super) unsafe fn renew(&mut self) -> Result<vk::DescriptorSet, Error> {
        let device = &self.layout.device.raw;
        let layouts = [*self.layout.set];
        let allocate =
            vk::DescriptorSetAllocateInfo::default().descriptor_pool(*self.pool).set_layouts(&layouts);
        // SAFETY: no set of the pool is in use, as the caller promises; the pool has room for one.
        unsafe {
            let reset = vk::DescriptorPoolResetFlags::empty();
            device.reset_descriptor_pool(*self.pool, reset).named("vkResetDescriptorPool")?;
            Ok(device.allocate_descriptor_sets(&allocate).named("vkAllocateDescriptorSets")?[0])
        }
    }
}
