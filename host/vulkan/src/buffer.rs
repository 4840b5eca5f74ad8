use super::handle::Handle;
use super::memory::{Memory, Place};
use super::{Device, Error, Named};
use ash::vk;
use std::sync::Arc;

/// A buffer of storage, vertices or indices.
pub(super) struct Buffer {
    pub(super) raw: Handle<vk::Buffer>,
    /// Bytes, whole words.
    pub(super) size: usize,
    // Freed after the buffer is destroyed.
    pub(super) memory: Memory,
}

impl Buffer {
    pub(super) fn new(device: &Arc<Device>, size: usize, place: Place) -> Result<Self, Error> {
        let size = size.next_multiple_of(4);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::VERTEX_BUFFER
            | vk::BufferUsageFlags::INDEX_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let create = vk::BufferCreateInfo::default().size(size as u64).usage(usage);
        // SAFETY: `create` is valid: a nonzero size and no queue sharing; whatever uses the buffer waits.
        let raw = unsafe {
            let created = device.raw.create_buffer(&create, None);
            Handle::new(device, created, "vkCreateBuffer", ash::Device::destroy_buffer)?
        };
        // SAFETY: a query of a buffer of the device.
        let requirements = unsafe { device.raw.get_buffer_memory_requirements(*raw) };
        let memory = Memory::new(device, requirements, place)?;
        let (bound, offset) = memory.binding();
        // SAFETY: the memory meets the buffer's requirements, and the buffer is bound once, before any use.
        unsafe { device.raw.bind_buffer_memory(*raw, bound, offset) }.named("vkBindBufferMemory")?;
        Ok(Self { raw, size, memory })
    }

    /// Copies as much of `bytes` as fits to the start of the buffer, if the host sees it.
    pub(super) fn write(&mut self, bytes: &[u8]) {
        if let Some(mapped) = self.memory.bytes() {
            let count = bytes.len().min(self.size);
            mapped[..count].copy_from_slice(&bytes[..count]);
        }
    }

    /// Copies the start of the buffer to `bytes`, as much as there is, if the host sees it.
    pub(super) fn read(&mut self, bytes: &mut [u8]) {
        if let Some(mapped) = self.memory.bytes() {
            let count = bytes.len().min(self.size);
            bytes[..count].copy_from_slice(&mapped[..count]);
        }
    }

    /// Records a copy of the first `bytes` bytes.
    ///
    /// # Safety
    /// `commands` is being recorded; both buffers have at least `bytes` bytes.
    pub(super) unsafe fn copy_to(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        to: &Self,
        bytes: usize,
    ) {
        let region = [vk::BufferCopy::default().size(bytes as u64)];
        // SAFETY: as the caller promises.
        unsafe { device.cmd_copy_buffer(commands, *self.raw, *to.raw, &region) };
    }
}
