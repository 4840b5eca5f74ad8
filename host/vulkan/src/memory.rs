use super::{Device, Error};
use ash::vk;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};
use gpu_allocator::{AllocationError, AllocationSizes, MemoryLocation};
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes that a device's memory grows by at least.
const BLOCK: u64 = 16 << 20;

/// Properties of memory that the device and the host both use at full speed. Uncached memory is slow to read from the host.
const UNIFIED: vk::MemoryPropertyFlags = vk::MemoryPropertyFlags::from_raw(
    vk::MemoryPropertyFlags::DEVICE_LOCAL.as_raw()
        | vk::MemoryPropertyFlags::HOST_VISIBLE.as_raw()
        | vk::MemoryPropertyFlags::HOST_COHERENT.as_raw()
        | vk::MemoryPropertyFlags::HOST_CACHED.as_raw(),
);

/// Memory of one buffer or image, freed when dropped.
pub(super) struct Memory {
    allocation: Allocation,
    device: Arc<Device>,
}

/// Kinds of memory.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Memory of the device for a buffer; visible to the host as well where the device's memory is unified.
    Device,
    /// Memory that the host sees, for a buffer.
    Host,
    /// Memory of the device for an image.
    Image,
}

impl Memory {
    pub(super) fn new(
        device: &Arc<Device>,
        mut requirements: vk::MemoryRequirements,
        place: Place,
    ) -> Result<Self, Error> {
        let unified = device.unified_memory_types & requirements.memory_type_bits;
        if place == Place::Device && unified != 0 {
            requirements.memory_type_bits = unified;
        }
        let create = AllocationCreateDesc {
            name: "",
            requirements,
            // Cached where it can be, and coherent.
            location: if place == Place::Host { MemoryLocation::GpuToCpu } else { MemoryLocation::GpuOnly },
            linear: place != Place::Image,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        let mut allocator = device.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        let allocation = allocator.allocate(&create).map_err(allocation_failed)?;
        Ok(Self { allocation, device: device.clone() })
    }

    /// The memory and the offset in it, to bind a buffer or an image to.
    pub(super) fn binding(&self) -> (vk::DeviceMemory, u64) {
        // SAFETY: the caller binds what it drops before this.
        (unsafe { self.allocation.memory() }, self.allocation.offset())
    }

    /// True where the device and the host both use it at full speed.
    pub(super) fn is_unified(&self) -> bool {
        self.allocation.memory_properties().contains(UNIFIED)
    }

    /// The bytes to read and write, where the host sees them.
    pub(super) fn bytes(&mut self) -> Option<&mut [u8]> {
        self.allocation.mapped_slice_mut()
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        let mut allocator = self.device.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        // Fails only for what another allocator made.
        let _ = allocator.free(std::mem::take(&mut self.allocation));
    }
}

/// Prepares the allocation of a device's memory.
pub(super) fn allocator(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    device: &ash::Device,
) -> Result<Mutex<Allocator>, Error> {
    let create = AllocatorCreateDesc {
        instance: instance.clone(),
        device: device.clone(),
        physical_device: physical,
        debug_settings: Default::default(),
        buffer_device_address: false,
        allocation_sizes: AllocationSizes::new(BLOCK, BLOCK),
    };
    Allocator::new(&create).map(Mutex::new).map_err(allocation_failed)
}

/// The types of unified memory, a bit each.
pub(super) fn unified_types(memory: &vk::PhysicalDeviceMemoryProperties) -> u32 {
    let types = memory.memory_types_as_slice().iter().zip(0..);
    types.map(|(kind, index)| u32::from(kind.property_flags.contains(UNIFIED)) << index).sum()
}

/// The failure of an allocator as the call that it stands for. A suitable type of memory is never missing: for any buffer or
/// image, Vulkan promises one of the device, and for any buffer one that the host sees.
fn allocation_failed(error: AllocationError) -> Error {
    let result = match error {
        AllocationError::OutOfMemory => vk::Result::ERROR_OUT_OF_DEVICE_MEMORY,
        _ => vk::Result::ERROR_UNKNOWN,
    };
    Error::Call { call: "vkAllocateMemory", result }
}
