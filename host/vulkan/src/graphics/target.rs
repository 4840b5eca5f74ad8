use super::super::handle::Handle;
use super::super::{Device, Error, FormatUse, ImageFormat};
use super::image::BETWEEN_PASSES;
use super::{Graphics, Image};
use ash::vk;
use std::sync::Arc;

/// Depth formats, best first. Every device takes the last one.
const DEPTH_FORMATS: [ImageFormat; 3] =
    [ImageFormat::D32_SFLOAT, ImageFormat::X8_D24_UNORM_PACK32, ImageFormat::D16_UNORM];

/// The attachments that a pass draws to: one or several colours, and maybe depth.
pub struct Target {
    pub(super) framebuffer: Handle<vk::Framebuffer>,
    pub(super) colours: Vec<Image>,
    // Kept for as long as the framebuffer refers to it.
    _depth: Option<Image>,
    pub(super) pass: RenderPass,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Target {
    /// Attachments of these formats. With `has_depth`, the nearest fragment of a pixel stays.
    ///
    /// # Errors
    /// [`Error::UnsupportedFormat`], [`Error::BadSize`], or a failed call.
    pub fn new(
        graphics: &Arc<Graphics>,
        (width, height): (u32, u32),
        colours: &[ImageFormat],
        has_depth: bool,
    ) -> Result<Self, Error> {
        let size = (width, height);
        let pass = RenderPass::new(graphics, colours, has_depth)?;
        let colours = colours
            .iter()
            .map(|format| Image::new(graphics, *format, size, FormatUse::Attachment))
            .collect::<Result<Vec<_>, _>>()?;
        let depth =
            pass.depth.map(|format| Image::new(graphics, format, size, FormatUse::Depth)).transpose()?;
        let views: Vec<_> = colours.iter().chain(&depth).map(|image| *image.view).collect();
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(*pass.raw)
            .attachments(&views)
            .width(width)
            .height(height)
            .layers(1);
        let device = &graphics.device;
        // SAFETY: the views have the pass's formats and this size; each submission is waited for.
        let framebuffer = unsafe {
            let created = device.raw.create_framebuffer(&create, None);
            Handle::new(device, created, "vkCreateFramebuffer", ash::Device::destroy_framebuffer)?
        };
        let target = Self { colours, _depth: depth, pass, framebuffer, width, height };
        // Each colour is from here on in the layout for reading.
        target.pass.graphics.draw(&target, &[], &[])?;
        Ok(target)
    }

    /// A colour attachment, to be read as a texture. `None` beyond the last.
    pub fn colour(&self, index: usize) -> Option<&Image> {
        self.colours.get(index)
    }

    /// The texels of a colour attachment, row by row from the top; none beyond the last attachment.
    ///
    /// # Errors
    /// A failed call.
    pub fn read(&self, index: usize) -> Result<Vec<u8>, Error> {
        self.colours.get(index).map_or_else(|| Ok(Vec::new()), Image::read)
    }
}

/// A render pass that clears its attachments to zero, depth to one, and keeps the colours.
pub(super) struct RenderPass {
    pub(super) raw: Handle<vk::RenderPass>,
    pub(super) colours: Vec<ImageFormat>,
    pub(super) depth: Option<ImageFormat>,
    pub(super) graphics: Arc<Graphics>,
}

impl RenderPass {
    pub(super) fn new(
        graphics: &Arc<Graphics>,
        colours: &[ImageFormat],
        has_depth: bool,
    ) -> Result<Self, Error> {
        let device = &graphics.device;
        let limit = device.limits.max_color_attachments.min(device.limits.max_fragment_output_attachments);
        if colours.len() > limit as usize {
            return Err(Error::BadDraw { reason: "it has more attachments than the device takes" });
        }
        let depth = DEPTH_FORMATS.into_iter().filter(|_| has_depth);
        let depth = depth.into_iter().find(|format| device.supports(*format, FormatUse::Depth));
        let attachments: Vec<_> = colours
            .iter()
            .map(|format| attachment(*format, BETWEEN_PASSES))
            .chain(depth.map(|format| attachment(format, vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL)))
            .collect();
        let raw = create(device, &attachments, colours.len())?;
        Ok(Self { raw, colours: colours.to_vec(), depth, graphics: graphics.clone() })
    }

    /// True where a pipeline of the other can draw in this.
    pub(super) fn is_compatible(&self, other: &Self) -> bool {
        self.colours == other.colours
            && self.depth == other.depth
            && Arc::ptr_eq(&self.graphics, &other.graphics)
    }
}

/// A pass over colours of these formats alone.
pub(super) fn colour_pass(
    device: &Arc<Device>,
    colours: &[ImageFormat],
) -> Result<Handle<vk::RenderPass>, Error> {
    let attachments: Vec<_> = colours.iter().map(|format| attachment(*format, BETWEEN_PASSES)).collect();
    create(device, &attachments, colours.len())
}

fn attachment(format: ImageFormat, after: vk::ImageLayout) -> vk::AttachmentDescription {
    vk::AttachmentDescription::default()
        .format(format)
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(vk::ImageLayout::UNDEFINED)
        .final_layout(after)
}

/// A pass of one subpass, whose last attachment is the depth where there are more than colours.
fn create(
    device: &Arc<Device>,
    attachments: &[vk::AttachmentDescription],
    colours: usize,
) -> Result<Handle<vk::RenderPass>, Error> {
    for colour in &attachments[..colours] {
        device.expect(colour.format, FormatUse::Attachment)?;
    }
    let references: Vec<_> = (0..attachments.len() as u32)
        .map(|index| {
            let layout = if (index as usize) < colours {
                vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL
            } else {
                vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL
            };
            vk::AttachmentReference { attachment: index, layout }
        })
        .collect();
    let mut subpass = vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&references[..colours]);
    if let Some(depth) = references.get(colours) {
        subpass = subpass.depth_stencil_attachment(depth);
    }
    let (all, inside) = (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::ALL_GRAPHICS);
    let everything = vk::SubpassDependency::default()
        .src_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)
        .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
    let dependencies = [
        everything
            .src_subpass(vk::SUBPASS_EXTERNAL)
            .src_stage_mask(all)
            .dst_subpass(0)
            .dst_stage_mask(inside),
        everything
            .src_subpass(0)
            .src_stage_mask(inside)
            .dst_subpass(vk::SUBPASS_EXTERNAL)
            .dst_stage_mask(all),
    ];
    let subpasses = [subpass];
    let create = vk::RenderPassCreateInfo::default()
        .attachments(attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: a valid create info: the references are to the attachments there are, whose formats the device takes.
    // Each submission is waited for.
    unsafe {
        let created = device.raw.create_render_pass(&create, None);
        Handle::new(device, created, "vkCreateRenderPass", ash::Device::destroy_render_pass)
    }
}
