use super::super::handle::Handle;
use super::super::layout::Layout;
use super::super::module::Module;
use super::super::{Error, FormatUse, ImageFormat, bytes_per_texel};
use super::Target;
use super::mesh::stride;
use super::target::{RenderPass, colour_pass};
use ash::vk;

/// A shader: a module and its entry point. The module is trusted to be valid, as modules of kernels are.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    /// SPIR-V.
    pub spirv: &'a [u8],
    /// Entry point of the stage.
    pub entry_point: &'a str,
}

/// Parts that a pipeline is made of.
#[derive(Clone, Copy)]
pub struct PipelineOptions<'a> {
    /// The vertex shader, of the attributes.
    pub vertex: Shader<'a>,
    /// The fragment shader, whose outputs are the colour attachments.
    pub fragment: Shader<'a>,
    /// Formats of the vertices' attributes, by location.
    pub attributes: &'a [ImageFormat],
    /// Draws a point a vertex instead of a triangle every three.
    pub points: bool,
}

/// A graphics pipeline. Triangles are drawn whichever side they show; push constants and up to three textures are its
/// input besides vertices.
pub struct Pipeline {
    pub(super) raw: Handle<vk::Pipeline>,
    pub(super) attributes: Vec<ImageFormat>,
    // Made apart from the target's, which may go before the pipeline does.
    pub(super) pass: RenderPass,
}

impl Pipeline {
    /// A pipeline for this target and others with the same formats.
    ///
    /// # Errors
    /// [`Error::NotSpirv`], [`Error::UnsupportedFormat`], or a failed call.
    pub fn new(target: &Target, options: &PipelineOptions<'_>) -> Result<Self, Error> {
        let graphics = &target.pass.graphics;
        let pass = RenderPass::new(graphics, &target.pass.colours, target.pass.depth.is_some())?;
        let attachments = (*pass.raw, pass.colours.len(), pass.depth.is_some());
        let raw = create(&graphics.layout, options, attachments, vk::PipelineCreateFlags::empty())?;
        Ok(Self { raw, attributes: options.attributes.to_vec(), pass })
    }
}

/// Compiles a pipeline that draws to these formats, to inspect the compiler's result. It cannot draw: a [`Target`] needs a
/// queue that works, which a driver without its GPU does not have.
pub(crate) fn inspected(
    layout: &Layout,
    colours: &[ImageFormat],
    options: &PipelineOptions<'_>,
) -> Result<Handle<vk::Pipeline>, Error> {
    let pass = colour_pass(&layout.device, colours)?;
    create(layout, options, (*pass, colours.len(), false), vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
}

/// Compiles a pipeline for a pass of so many colours, with depth or without. The device knows the flags.
fn create(
    layout: &Layout,
    options: &PipelineOptions<'_>,
    (pass, colours, has_depth): (vk::RenderPass, usize, bool),
    flags: vk::PipelineCreateFlags,
) -> Result<Handle<vk::Pipeline>, Error> {
    let device = &layout.device;
    for format in options.attributes {
        device.expect(*format, FormatUse::Vertex)?;
    }
    let vertex = Module::new(device, options.vertex.spirv, options.vertex.entry_point)?;
    let fragment = Module::new(device, options.fragment.spirv, options.fragment.entry_point)?;
    let stages = [vertex.stage(vk::ShaderStageFlags::VERTEX), fragment.stage(vk::ShaderStageFlags::FRAGMENT)];
    let (bindings, attributes) = vertex_input(options.attributes);
    let input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&bindings)
        .vertex_attribute_descriptions(&attributes);
    let topology =
        if options.points { vk::PrimitiveTopology::POINT_LIST } else { vk::PrimitiveTopology::TRIANGLE_LIST };
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(topology);
    let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    let raster = vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(vk::CullModeFlags::NONE)
        .line_width(1.0);
    let samples =
        vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let depth = vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(has_depth)
        .depth_write_enable(has_depth)
        .depth_compare_op(vk::CompareOp::LESS);
    let blend = vec![
        vk::PipelineColorBlendAttachmentState::default()
            .color_write_mask(vk::ColorComponentFlags::RGBA);
        colours
    ];
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blend);
    let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
    let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
    let create = [vk::GraphicsPipelineCreateInfo::default()
        .flags(flags)
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&samples)
        .depth_stencil_state(&depth)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(*layout.pipeline)
        .render_pass(pass)];
    // SAFETY: modules, layout and pass are of this device, as the extensions of the flags are; all that is pointed to outlives the
    // call; each submission is waited for.
    unsafe {
        let created = device.raw.create_graphics_pipelines(vk::PipelineCache::null(), &create, None);
        let created = created.map(|pipelines| pipelines[0]).map_err(|(_, result)| result);
        Handle::new(device, created, "vkCreateGraphicsPipelines", ash::Device::destroy_pipeline)
    }
}

/// Descriptions of the attributes, each in a binding of its own.
fn vertex_input(
    formats: &[ImageFormat],
) -> (Vec<vk::VertexInputBindingDescription>, Vec<vk::VertexInputAttributeDescription>) {
    let binding = |(format, binding)| {
        let stride = stride(bytes_per_texel(format).unwrap_or_default()) as u32;
        vk::VertexInputBindingDescription { binding, stride, input_rate: vk::VertexInputRate::VERTEX }
    };
    let attribute = |(format, location)| vk::VertexInputAttributeDescription {
        location,
        binding: location,
        format,
        offset: 0,
    };
    let formats = formats.iter().copied().zip(0..);
    (formats.clone().map(binding).collect(), formats.map(attribute).collect())
}
