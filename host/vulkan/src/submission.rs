use super::handle::Handle;
use super::{Device, Error, Named};
use ash::vk;
use std::sync::{Arc, PoisonError};

/// All stages of the commands before or after.
pub(super) const ALL: vk::PipelineStageFlags = vk::PipelineStageFlags::ALL_COMMANDS;

/// A command buffer and the fence that its submissions are waited for with.
pub(super) struct Submission {
    fence: Handle<vk::Fence>,
    commands: vk::CommandBuffer,
    // Has the command buffer.
    _pool: Handle<vk::CommandPool>,
}

impl Submission {
    pub(super) fn new(device: &Arc<Device>) -> Result<Self, Error> {
        let raw = &device.raw;
        let pool = vk::CommandPoolCreateInfo::default()
            .queue_family_index(device.queue_family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        // SAFETY: the create infos are valid for this device, and each submission is waited for.
        unsafe {
            let pool = raw.create_command_pool(&pool, None);
            let destroy = ash::Device::destroy_command_pool;
            let pool = Handle::new(device, pool, "vkCreateCommandPool", destroy)?;
            let allocate =
                vk::CommandBufferAllocateInfo::default().command_pool(*pool).command_buffer_count(1);
            let commands = raw.allocate_command_buffers(&allocate).named("vkAllocateCommandBuffers")?[0];
            let fence = raw.create_fence(&vk::FenceCreateInfo::default(), None);
            let fence = Handle::new(device, fence, "vkCreateFence", ash::Device::destroy_fence)?;
            Ok(Self { fence, commands, _pool: pool })
        }
    }

    /// Records commands, submits them and waits for them. All memory accesses before the submission come before those in it,
    /// and the host sees what was written.
    ///
    /// # Safety
    /// The recorded commands are valid, and everything that they use lives until this returns.
    pub(super) unsafe fn run(
        &mut self,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<(), Error> {
        let owner = self.fence.device();
        let (device, commands) = (&owner.raw, self.commands);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        let buffers = [commands];
        let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: the command buffer and the fence are not in use, since each submission is waited for before this returns;
        // what is recorded is valid, as the caller promises. The queue is locked for the submission alone, so that others
        // may submit while this one waits.
        unsafe {
            device.begin_command_buffer(commands, &begin).named("vkBeginCommandBuffer")?;
            barrier(device, commands, ALL);
            record(device, commands);
            barrier(device, commands, vk::PipelineStageFlags::HOST);
            device.end_command_buffer(commands).named("vkEndCommandBuffer")?;
            {
                let queue = owner.queue.lock().unwrap_or_else(PoisonError::into_inner);
                device.queue_submit(*queue, &submit, *self.fence).named("vkQueueSubmit")?;
            }
            let waited = device.wait_for_fences(&[*self.fence], true, u64::MAX).named("vkWaitForFences");
            if waited.is_err() {
                // The submission may still run: the device is idled, and if even that fails it is lost and runs nothing.
                let _queue = owner.queue.lock().unwrap_or_else(PoisonError::into_inner);
                let _ = device.device_wait_idle();
            }
            waited.and(device.reset_fences(&[*self.fence]).named("vkResetFences"))
        }
    }
}

/// Records that all memory accesses before come before those of `stage` after.
///
/// # Safety
/// `commands` is being recorded, outside of render passes. `stage` is [`ALL`] or the host's.
pub(super) unsafe fn barrier(
    device: &ash::Device,
    commands: vk::CommandBuffer,
    stage: vk::PipelineStageFlags,
) {
    let access = if stage == vk::PipelineStageFlags::HOST {
        vk::AccessFlags::HOST_READ
    } else {
        vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE
    };
    let memory =
        [vk::MemoryBarrier::default().src_access_mask(vk::AccessFlags::MEMORY_WRITE).dst_access_mask(access)];
    let none = vk::DependencyFlags::empty();
    // SAFETY: as the caller promises; both stages have their access.
    unsafe { device.cmd_pipeline_barrier(commands, ALL, stage, none, &memory, &[], &[]) };
}
