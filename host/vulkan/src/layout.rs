//! Interfaces of pipelines, and the descriptors for them.

use super::{Device, Error, Named};
use ash::vk;
use std::sync::Arc;

/// Descriptors of a pipeline, bindings 0 and up of set 0.
pub(super) const BINDINGS: u32 = 3;

/// The interface that all kernels share, or all graphics pipelines: [`BINDINGS`] descriptors and push constants.
pub(super) struct Layout {
    set: vk::DescriptorSetLayout,
    pub(super) pipeline: vk::PipelineLayout,
    descriptors: vk::DescriptorType,
    pub(super) device: Arc<Device>,
}

impl Layout {
    /// An interface of these descriptors and of `constants` bytes of push constants, which these stages see.
    pub(super) fn new(
        device: &Arc<Device>,
        stages: vk::ShaderStageFlags,
        descriptors: vk::DescriptorType,
        constants: u32,
    ) -> Result<Self, Error> {
        let binding = vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(descriptors)
            .descriptor_count(1)
            .stage_flags(stages);
        let bindings: Vec<_> = (0..BINDINGS).map(|index| binding.binding(index)).collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: a valid create info; destroyed in `drop`.
        let set = unsafe { device.raw.create_descriptor_set_layout(&create, None) }
            .named("vkCreateDescriptorSetLayout")?;
        let pipeline = vk::PipelineLayout::null();
        let mut layout = Self { set, pipeline, descriptors, device: device.clone() };

        let sets = [set];
        let constants = [vk::PushConstantRange::default().stage_flags(stages).size(constants)];
        let create =
            vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&constants);
        // SAFETY: as above.
        layout.pipeline =
            unsafe { device.raw.create_pipeline_layout(&create, None) }.named("vkCreatePipelineLayout")?;
        Ok(layout)
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        // SAFETY: pipelines and whatever runs them keep an Arc to the layout, so nothing uses it; null is ignored.
        unsafe {
            self.device.raw.destroy_pipeline_layout(self.pipeline, None);
            self.device.raw.destroy_descriptor_set_layout(self.set, None);
        }
    }
}

/// The descriptor set of one submission at a time.
pub(super) struct Descriptors {
    pool: vk::DescriptorPool,
    layout: Arc<Layout>,
}

impl Descriptors {
    pub(super) fn new(layout: &Arc<Layout>) -> Result<Self, Error> {
        let sizes = [vk::DescriptorPoolSize::default().ty(layout.descriptors).descriptor_count(BINDINGS)];
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: a valid create info; destroyed in `drop`.
        let pool = unsafe { layout.device.raw.create_descriptor_pool(&create, None) }
            .named("vkCreateDescriptorPool")?;
        Ok(Self { pool, layout: layout.clone() })
    }

    /// A new set in place of the last one, for the next submission: in an old one, textures or tables that are gone would be
    /// left at the numbers that this one does not have, and drivers may look at them.
    ///
    /// # Safety
    /// No submission that uses the last set is running.
    pub(super) unsafe fn renew(&mut self) -> Result<vk::DescriptorSet, Error> {
        let device = &self.layout.device.raw;
        let layouts = [self.layout.set];
        let allocate =
            vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.pool).set_layouts(&layouts);
        // SAFETY: no set of the pool is in use, as the caller promises; the pool has room for one.
        unsafe {
            let reset = vk::DescriptorPoolResetFlags::empty();
            device.reset_descriptor_pool(self.pool, reset).named("vkResetDescriptorPool")?;
            Ok(device.allocate_descriptor_sets(&allocate).named("vkAllocateDescriptorSets")?[0])
        }
    }
}

impl Drop for Descriptors {
    fn drop(&mut self) {
        // SAFETY: it is this one's own and no submission is running.
        unsafe { self.layout.device.raw.destroy_descriptor_pool(self.pool, None) };
    }
}
