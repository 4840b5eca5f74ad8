//! Drawing into images: render passes, graphics pipelines and textures, with one submission at a time, waited for.

mod draw;
mod image;
mod mesh;
mod pipeline;
mod target;

pub use draw::Draw;
pub use image::Image;
pub use mesh::Mesh;
pub(super) use pipeline::inspected;
pub use pipeline::{Pipeline, PipelineOptions, Shader};
pub use target::Target;

use super::handle::Handle;
use super::layout::{Descriptors, Layout};
use super::submission::Submission;
use super::{Device, Error};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes of push constants that every device takes.
const PUSH_CONSTANTS: u32 = 128;

/// The stages that see textures and push constants.
const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw() | vk::ShaderStageFlags::FRAGMENT.as_raw(),
);

/// A device that draws: its commands, and the interface that all pipelines share.
pub struct Graphics {
    commands: Mutex<Commands>,
    layout: Arc<Layout>,
    device: Arc<Device>,
}

impl Layout {
    /// The interface that all graphics pipelines share.
    pub(super) fn of_graphics(device: &Arc<Device>) -> Result<Self, Error> {
        let linear = vk::Filter::LINEAR;
        let create = vk::SamplerCreateInfo::default().mag_filter(linear).min_filter(linear);
        // SAFETY: a valid create info; the interface keeps the sampler, and each submission is waited for.
        let sampler = unsafe {
            let created = device.raw.create_sampler(&create, None);
            Handle::new(device, created, "vkCreateSampler", ash::Device::destroy_sampler)?
        };
        Self::new(device, STAGES, vk::DescriptorType::SAMPLED_IMAGE, Some(sampler), PUSH_CONSTANTS)
    }
}

/// Commands and descriptors, used by one submission at a time.
struct Commands {
    submission: Submission,
    descriptors: Descriptors,
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
        let layout = Arc::new(Layout::of_graphics(device)?);
        let descriptors = Descriptors::new(&layout)?;
        let commands = Mutex::new(Commands { submission: Submission::new(device)?, descriptors });
        Ok(Arc::new(Self { commands, layout, device: device.clone() }))
    }

    /// Bits of the fractions by which its samplers blend texels, at least: `subTexelPrecisionBits`.
    pub fn fraction_bits(&self) -> u32 {
        self.device.limits.sub_texel_precision_bits
    }

    /// The device it draws on.
    pub fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// Runs a submission of its own, as [`Submission::run`] does.
    ///
    /// # Safety
    /// The recorded commands are valid, and everything that they use lives until this returns.
    unsafe fn submit(&self, record: impl FnOnce(&ash::Device, vk::CommandBuffer)) -> Result<(), Error> {
        let mut commands = self.commands.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: as the caller promises.
        unsafe { commands.submission.run(record) }
    }
}
