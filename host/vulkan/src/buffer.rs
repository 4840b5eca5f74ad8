use super::{Device, Error, Named};
use ash::vk;
use std::sync::Arc;

/// A buffer of storage, vertices or indices with memory of its own, mapped where the host can see it.
pub(super) struct Buffer {
    pub(super) raw: vk::Buffer,
    memory: vk::DeviceMemory,
    mapped: Option<*mut u8>,
    /// In bytes, whole words.
    pub(super) size: usize,
    device: Arc<Device>,
}

/// Where a buffer's memory is.
#[derive(Clone, Copy)]
pub(super) enum Place {
    /// On the device; visible to the host as well where the device's memory is.
    Device,
    /// Visible to the host, for staging.
    Host,
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
        // SAFETY: `create` is valid: a nonzero size and no queue sharing.
        let raw = unsafe { device.raw.create_buffer(&create, None) }.named("vkCreateBuffer")?;
        let mut buffer =
            Self { raw, memory: vk::DeviceMemory::null(), mapped: None, size, device: device.clone() };
        buffer.allocate(place)?;
        Ok(buffer)
    }

    /// On failure the buffer is dropped by the caller, and what was made so far with it.
    fn allocate(&mut self, place: Place) -> Result<(), Error> {
        let device = &self.device;
        // SAFETY: a query of a buffer of the device.
        let requirements = unsafe { device.raw.get_buffer_memory_requirements(self.raw) };
        let (index, host_visible) = memory_type(&device.memory, requirements.memory_type_bits, place)
            .ok_or_else(|| Error::MissingFeature {
                device: device.info().name.clone(),
                feature: "a suitable memory type",
            })?;
        let allocate =
            vk::MemoryAllocateInfo::default().allocation_size(requirements.size).memory_type_index(index);
        // SAFETY: the size and memory type are those that the device named for this buffer; it is bound once, before
        // any use, and the map covers the whole allocation.
        unsafe {
            self.memory = device.raw.allocate_memory(&allocate, None).named("vkAllocateMemory")?;
            device.raw.bind_buffer_memory(self.raw, self.memory, 0).named("vkBindBufferMemory")?;
            if host_visible {
                let map = device.raw.map_memory(self.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty());
                self.mapped = Some(map.named("vkMapMemory")?.cast());
            }
        }
        Ok(())
    }

    /// True where [`write`](Self::write) and [`read`](Self::read) work.
    pub(super) fn is_mapped(&self) -> bool {
        self.mapped.is_some()
    }

    /// Copies as much of `bytes` as fits to the start of a mapped buffer.
    pub(super) fn write(&mut self, bytes: &[u8]) {
        if let Some(mapped) = self.mapped {
            let count = bytes.len().min(self.size);
            // SAFETY: the map covers `size` bytes, is coherent, and no submission is running; `bytes` is not part of
            // it, since it is a Rust slice.
            unsafe { std::ptr::copy_nonoverlapping(bytes.as_ptr(), mapped, count) };
        }
    }

    /// Copies the start of a mapped buffer to `bytes`, as much as there is.
    pub(super) fn read(&self, bytes: &mut [u8]) {
        if let Some(mapped) = self.mapped {
            let count = bytes.len().min(self.size);
            // SAFETY: as in `write`, the other way.
            unsafe { std::ptr::copy_nonoverlapping(mapped, bytes.as_mut_ptr(), count) };
        }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: both are this buffer's own and no submission is running; null memory is ignored. Freeing unmaps.
        unsafe {
            self.device.raw.destroy_buffer(self.raw, None);
            self.device.raw.free_memory(self.memory, None);
        }
    }
}

/// Index of the best memory type among `allowed`, and whether the host sees it (coherently).
fn memory_type(
    memory: &vk::PhysicalDeviceMemoryProperties,
    allowed: u32,
    place: Place,
) -> Option<(u32, bool)> {
    let host = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
    let unified = vk::MemoryPropertyFlags::DEVICE_LOCAL | host | vk::MemoryPropertyFlags::HOST_CACHED;
    // Uncached device-local memory is slow to read from the host, so it only counts as device memory.
    let preferences = match place {
        Place::Device => [unified, vk::MemoryPropertyFlags::DEVICE_LOCAL, vk::MemoryPropertyFlags::empty()],
        Place::Host => [host | vk::MemoryPropertyFlags::HOST_CACHED, host, host],
    };
    preferences.into_iter().find_map(|wanted| {
        let types = memory.memory_types_as_slice().iter().zip(0..);
        types
            .filter(|(_, index)| allowed & (1 << index) != 0)
            .find(|(kind, _)| kind.property_flags.contains(wanted))
            .map(|(_, index)| (index, wanted.contains(host)))
    })
}
