use super::super::buffer::Buffer;
use super::super::handle::Handle;
use super::super::memory::{Memory, Place};
use super::super::{Error, FormatUse, ImageFormat, Named, bytes_per_texel};
use super::Graphics;
use ash::vk;
use std::sync::Arc;

/// The layout of textures, and of colour attachments that are not drawn to.
pub(super) const BETWEEN_PASSES: vk::ImageLayout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;

/// An image of one level and layer: a texture, or an attachment of a [`Target`](super::Target). It can be
/// read by shaders outside of passes that draw to it.
pub struct Image {
    pub(super) view: Handle<vk::ImageView>,
    raw: Handle<vk::Image>,
    // Freed after the image is destroyed.
    _memory: Memory,
    format: ImageFormat,
    width: u32,
    height: u32,
    pub(super) graphics: Arc<Graphics>,
}

impl Image {
    /// A texture with these texels, row by row from the top.
    ///
    /// # Errors
    /// [`Error::UnsupportedFormat`], [`Error::BadSize`], [`Error::BadDraw`] where the number of texels does not match
    /// the size, or a failed call.
    pub fn texture(
        graphics: &Arc<Graphics>,
        format: ImageFormat,
        (width, height): (u32, u32),
        texels: &[u8],
    ) -> Result<Self, Error> {
        let image = Self::new(graphics, format, (width, height), FormatUse::Texture)?;
        if bytes_per_texel(format).map(|bytes| bytes * width as usize * height as usize) != Some(texels.len())
        {
            return Err(Error::BadDraw { reason: "a texture's texels are not as many as its size says" });
        }
        let mut staging = Buffer::new(&graphics.device, texels.len(), Place::Host)?;
        staging.write(texels);
        let region = image.region();
        // SAFETY: the buffer holds all texels of the region, which is the whole image; both outlive the submission.
        unsafe {
            graphics.submit(|device, commands| {
                let copied = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
                image.transition(device, commands, vk::ImageLayout::UNDEFINED, copied);
                device.cmd_copy_buffer_to_image(commands, *staging.raw, *image.raw, copied, &[region]);
                image.transition(device, commands, copied, BETWEEN_PASSES);
            })?;
        }
        Ok(image)
    }

    /// An image in the undefined layout.
    pub(super) fn new(
        graphics: &Arc<Graphics>,
        format: ImageFormat,
        (width, height): (u32, u32),
        usage: FormatUse,
    ) -> Result<Self, Error> {
        let device = &graphics.device;
        device.expect(format, usage)?;
        // Texels are copied from and to buffers of as many bytes.
        if usage != FormatUse::Depth && bytes_per_texel(format).is_none() {
            return Err(Error::BadDraw { reason: "a format's texels are of a size that is not known here" });
        }
        let limits = &device.limits;
        let limit = limits
            .max_image_dimension2_d
            .min(limits.max_framebuffer_width)
            .min(limits.max_framebuffer_height)
            .min(limits.max_viewport_dimensions[0])
            .min(limits.max_viewport_dimensions[1]);
        if !(1..=limit).contains(&width) || !(1..=limit).contains(&height) {
            return Err(Error::BadSize { device: device.info().name.clone(), width, height, limit });
        }
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(image_usage(usage));
        // SAFETY: the size is within the limits and the format has these uses; each submission is waited for.
        let raw = unsafe {
            let created = device.raw.create_image(&create, None);
            Handle::new(device, created, "vkCreateImage", ash::Device::destroy_image)?
        };
        // SAFETY: a query of an image of the device.
        let requirements = unsafe { device.raw.get_image_memory_requirements(*raw) };
        let memory = Memory::new(device, requirements, Place::Image)?;
        let (bound, offset) = memory.binding();
        // SAFETY: the memory meets the image's requirements, and the image is bound once.
        unsafe { device.raw.bind_image_memory(*raw, bound, offset) }.named("vkBindImageMemory")?;
        let aspect = match usage {
            FormatUse::Depth => vk::ImageAspectFlags::DEPTH,
            _ => vk::ImageAspectFlags::COLOR,
        };
        let create = vk::ImageViewCreateInfo::default()
            .image(*raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(range(aspect));
        // SAFETY: the image has memory and this format; each submission is waited for.
        let view = unsafe {
            let created = device.raw.create_image_view(&create, None);
            Handle::new(device, created, "vkCreateImageView", ash::Device::destroy_image_view)?
        };
        Ok(Self { view, raw, _memory: memory, format, width, height, graphics: graphics.clone() })
    }

    /// The format of its texels.
    pub fn format(&self) -> ImageFormat {
        self.format
    }

    /// The texels of a colour attachment, row by row from the top.
    ///
    /// # Errors
    /// A failed call.
    pub(super) fn read(&self) -> Result<Vec<u8>, Error> {
        let texels = self.width as usize * self.height as usize;
        let mut bytes = vec![0; texels * bytes_per_texel(self.format).unwrap_or_default()];
        let mut staging = Buffer::new(&self.graphics.device, bytes.len(), Place::Host)?;
        let region = self.region();
        // SAFETY: the image is a colour attachment that was drawn to, so it is in the layout between passes; the buffer holds
        // all its texels; both outlive the submission.
        unsafe {
            self.graphics.submit(|device, commands| {
                let copied = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
                self.transition(device, commands, BETWEEN_PASSES, copied);
                device.cmd_copy_image_to_buffer(commands, *self.raw, copied, *staging.raw, &[region]);
                self.transition(device, commands, copied, BETWEEN_PASSES);
            })?;
        }
        staging.read(&mut bytes);
        Ok(bytes)
    }

    /// Records a change of layout, which comes between all accesses before and after.
    ///
    /// # Safety
    /// `commands` is being recorded outside of render passes, and the image is in the layout `from`.
    unsafe fn transition(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        from: vk::ImageLayout,
        to: vk::ImageLayout,
    ) {
        let barrier = [vk::ImageMemoryBarrier::default()
            .image(*self.raw)
            .subresource_range(range(vk::ImageAspectFlags::COLOR))
            .old_layout(from)
            .new_layout(to)
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)];
        let all = vk::PipelineStageFlags::ALL_COMMANDS;
        let flags = vk::DependencyFlags::empty();
        // SAFETY: as the caller promises.
        unsafe { device.cmd_pipeline_barrier(commands, all, all, flags, &[], &[], &barrier) };
    }

    /// The whole image, as the region of a copy.
    fn region(&self) -> vk::BufferImageCopy {
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let extent = vk::Extent3D { width: self.width, height: self.height, depth: 1 };
        vk::BufferImageCopy::default().image_subresource(layers).image_extent(extent)
    }
}

fn range(aspect: vk::ImageAspectFlags) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1)
}

fn image_usage(usage: FormatUse) -> vk::ImageUsageFlags {
    use vk::ImageUsageFlags as Flags;
    match usage {
        FormatUse::Attachment => Flags::COLOR_ATTACHMENT | Flags::SAMPLED | Flags::TRANSFER_SRC,
        FormatUse::Depth => Flags::DEPTH_STENCIL_ATTACHMENT,
        FormatUse::Texture | FormatUse::Vertex => Flags::SAMPLED | Flags::TRANSFER_DST,
    }
}
