use super::{Device, Error, Named};
use ash::prelude::VkResult;
use ash::vk;
use std::ops::Deref;
use std::sync::Arc;

/// A function that destroys an object of a device.
type Destroy<T> = unsafe fn(&ash::Device, T, Option<&vk::AllocationCallbacks<'_>>);

/// An object of a device, which is destroyed when this is dropped.
pub(super) struct Handle<T: Copy> {
    raw: T,
    destroy: Destroy<T>,
    device: Arc<Device>,
}

impl<T: Copy> Handle<T> {
    /// The object that a call of this name has created.
    ///
    /// # Safety
    /// It is the device's, `destroy` is of its kind, and nothing else destroys it. When this is dropped, all submissions that
    /// use it were waited for.
    pub(super) unsafe fn new(
        device: &Arc<Device>,
        created: VkResult<T>,
        call: &'static str,
        destroy: Destroy<T>,
    ) -> Result<Self, Error> {
        Ok(Self { raw: created.named(call)?, destroy, device: device.clone() })
    }

    pub(super) fn device(&self) -> &Arc<Device> {
        &self.device
    }
}

impl<T: Copy> Deref for Handle<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.raw
    }
}

impl<T: Copy> Drop for Handle<T> {
    fn drop(&mut self) {
        // SAFETY: as the caller of `new` promises.
        unsafe { (self.destroy)(&self.device.raw, self.raw, None) };
    }
}
