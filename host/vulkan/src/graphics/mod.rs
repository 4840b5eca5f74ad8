//! Drawing into images: render passes, graphics pipelines and textures, with one submission at a time, waited for.

mod draw;
mod image;
mod mesh;
mod pipeline;
mod target;

pub use draw::Draw;
pub use image::Image;
pub use mesh::Mesh;
pub use pipeline::{Pipeline, PipelineOptions, Shader};
pub use target::Target;

use super::{Device, Error, Named};
use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use gpu_allocator::{AllocationError, AllocationSizes};
use std::sync::{Arc, Mutex, PoisonError};

/// Textures of a pipeline, bindings 0 and up of set 0.
const TEXTURES: u32 = 3;

/// Bytes of push constants that every device takes.
const PUSH_CONSTANTS: u32 = 128;

/// The least that the memory of images grows by.
const BLOCK: u64 = 16 << 20;

/// The stages that see textures and push constants.
const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw() | vk::ShaderStageFlags::FRAGMENT.as_raw(),
);

/// What draws on a device: memory of images, a command buffer, and the interface that all pipelines share.
pub struct Graphics {
    // Dropped before the device, whose memory it frees.
    allocator: Mutex<Allocator>,
    commands: Mutex<Commands>,
    layout: vk::PipelineLayout,
    set_layout: vk::DescriptorSetLayout,
    device: Arc<Device>,
}

/// Used by one submission at a time.
#[derive(Default)]
struct Commands {
    pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    fence: vk::Fence,
    descriptors: vk::DescriptorPool,
}

impl Graphics {
    /// Prepares a device of [`Device::open_for_graphics`] for drawing.
    ///
    /// # Errors
    /// [`Error::MissingFeature`] for another device, or a failed call.
    pub fn new(device: &Arc<Device>) -> Result<Arc<Self>, Error> {
        if !device.work.contains(vk::QueueFlags::GRAPHICS) {
            let device = device.info().name.clone();
            return Err(Error::MissingFeature { device, feature: "a graphics queue" });
        }
        let create = AllocatorCreateDesc {
            instance: device.instance.raw.clone(),
            device: device.raw.clone(),
            physical_device: device.physical,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::new(BLOCK, BLOCK),
        };
        let allocator = Allocator::new(&create).map_err(|error| allocation_failed(device, &error))?;
        let mut graphics = Self {
            allocator: Mutex::new(allocator),
            commands: Mutex::default(),
            layout: vk::PipelineLayout::null(),
            set_layout: vk::DescriptorSetLayout::null(),
            device: device.clone(),
        };
        graphics.create_layout()?;
        graphics.create_commands()?;
        Ok(Arc::new(graphics))
    }

    /// The device it draws on.
    pub fn device(&self) -> &Arc<Device> {
        &self.device
    }

    fn create_layout(&mut self) -> Result<(), Error> {
        let device = &self.device.raw;
        let bindings: Vec<_> = (0..TEXTURES)
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                    .descriptor_count(1)
                    .stage_flags(STAGES)
            })
            .collect();
        let set = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let constants = [vk::PushConstantRange::default().stage_flags(STAGES).size(PUSH_CONSTANTS)];
        // SAFETY: valid create infos; both are destroyed in `drop`.
        unsafe {
            self.set_layout =
                device.create_descriptor_set_layout(&set, None).named("vkCreateDescriptorSetLayout")?;
            let sets = [self.set_layout];
            let layout =
                vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&constants);
            self.layout = device.create_pipeline_layout(&layout, None).named("vkCreatePipelineLayout")?;
        }
        Ok(())
    }

    fn create_commands(&mut self) -> Result<(), Error> {
        let device = &self.device.raw;
        let commands = self.commands.get_mut().unwrap_or_else(PoisonError::into_inner);
        let pool = vk::CommandPoolCreateInfo::default()
            .queue_family_index(self.device.queue_family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        let sizes = [vk::DescriptorPoolSize::default()
            .ty(vk::DescriptorType::SAMPLED_IMAGE)
            .descriptor_count(TEXTURES)];
        let descriptors = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: valid create infos; what is created is destroyed in `drop`.
        unsafe {
            commands.pool = device.create_command_pool(&pool, None).named("vkCreateCommandPool")?;
            let allocate =
                vk::CommandBufferAllocateInfo::default().command_pool(commands.pool).command_buffer_count(1);
            commands.buffer =
                device.allocate_command_buffers(&allocate).named("vkAllocateCommandBuffers")?[0];
            commands.fence =
                device.create_fence(&vk::FenceCreateInfo::default(), None).named("vkCreateFence")?;
            commands.descriptors =
                device.create_descriptor_pool(&descriptors, None).named("vkCreateDescriptorPool")?;
        }
        Ok(())
    }

    /// Records commands, submits them and waits for them. All memory accesses before the submission come before those in it,
    /// and the host sees what was written.
    ///
    /// # Safety
    /// What is recorded has to be valid and to live until this returns.
    unsafe fn submit(
        &self,
        commands: &Commands,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<(), Error> {
        let device = &self.device.raw;
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        let buffers = [commands.buffer];
        let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: the caller's lock keeps other submissions from the command buffer and the fence, and each is waited for; what
        // is recorded is valid, as the caller promises.
        unsafe {
            device.begin_command_buffer(commands.buffer, &begin).named("vkBeginCommandBuffer")?;
            barrier(device, commands.buffer, vk::PipelineStageFlags::ALL_COMMANDS);
            record(device, commands.buffer);
            barrier(device, commands.buffer, vk::PipelineStageFlags::HOST);
            device.end_command_buffer(commands.buffer).named("vkEndCommandBuffer")?;
            {
                let queue = self.device.queue.lock().unwrap_or_else(PoisonError::into_inner);
                device.queue_submit(*queue, &submit, commands.fence).named("vkQueueSubmit")?;
            }
            device.wait_for_fences(&[commands.fence], true, u64::MAX).named("vkWaitForFences")?;
            device.reset_fences(&[commands.fence]).named("vkResetFences")
        }
    }
}

impl Drop for Graphics {
    fn drop(&mut self) {
        let commands = self.commands.get_mut().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: images, pipelines and meshes keep an Arc to this, so nothing uses these; null is ignored.
        unsafe {
            let device = &self.device.raw;
            device.destroy_fence(commands.fence, None);
            device.destroy_command_pool(commands.pool, None);
            device.destroy_descriptor_pool(commands.descriptors, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// Records that all memory accesses before come before those of `stage` after.
///
/// # Safety
/// `commands` is being recorded, outside of render passes.
unsafe fn barrier(device: &ash::Device, commands: vk::CommandBuffer, stage: vk::PipelineStageFlags) {
    let access = if stage == vk::PipelineStageFlags::HOST {
        vk::AccessFlags::HOST_READ
    } else {
        vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE
    };
    let memory =
        [vk::MemoryBarrier::default().src_access_mask(vk::AccessFlags::MEMORY_WRITE).dst_access_mask(access)];
    // SAFETY: as the caller promises.
    unsafe {
        device.cmd_pipeline_barrier(
            commands,
            vk::PipelineStageFlags::ALL_COMMANDS,
            stage,
            vk::DependencyFlags::empty(),
            &memory,
            &[],
            &[],
        );
    }
}

/// What the allocator says, as the call that it stands for.
fn allocation_failed(device: &Device, error: &AllocationError) -> Error {
    match error {
        AllocationError::NoCompatibleMemoryTypeFound => {
            Error::MissingFeature { device: device.info().name.clone(), feature: "a suitable memory type" }
        }
        AllocationError::OutOfMemory => {
            Error::Call { call: "vkAllocateMemory", result: vk::Result::ERROR_OUT_OF_DEVICE_MEMORY }
        }
        _ => Error::Call { call: "vkAllocateMemory", result: vk::Result::ERROR_UNKNOWN },
    }
}
