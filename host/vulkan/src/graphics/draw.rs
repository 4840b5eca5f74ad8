use super::super::Error;
use super::super::layout::{BINDINGS, Descriptors};
use super::image::BETWEEN_PASSES;
use super::{Graphics, Image, Mesh, PUSH_CONSTANTS, Pipeline, STAGES, Target};
use ash::vk;
use std::sync::{Arc, PoisonError};

/// Something to draw.
#[derive(Clone, Copy)]
pub struct Draw<'a> {
    /// Pipeline to draw with.
    pub pipeline: &'a Pipeline,
    /// Mesh to draw; without one, three vertices without attributes.
    pub mesh: Option<&'a Mesh>,
    /// Push constants.
    pub constants: &'a [u8],
}

impl Graphics {
    /// Clears the target and draws to it, one after the other, and waits. Textures are bound by their numbers, and then comes
    /// a sampler that blends texels.
    ///
    /// Shaders are trusted to read no texture that is not bound, nor one of another type, and no texel outside of it, and to
    /// blend only formats that the device does.
    ///
    /// # Errors
    /// [`Error::BadDraw`] for parts that do not fit together, or a failed call.
    pub fn draw(
        self: &Arc<Self>,
        target: &Target,
        textures: &[(u32, &Image)],
        draws: &[Draw<'_>],
    ) -> Result<(), Error> {
        self.check_textures(target, textures)?;
        draws.iter().try_for_each(|draw| check(target, draw))?;
        let mut commands = self.commands.lock().unwrap_or_else(PoisonError::into_inner);
        let set = if textures.is_empty() {
            None
        } else {
            Some(self.textures(&mut commands.descriptors, textures)?)
        };
        // SAFETY: all that is drawn was checked to fit and is borrowed until the submission has ended.
        unsafe {
            commands.submission.run(|device, commands| self.record(device, commands, set, target, draws))
        }
    }

    fn check_textures(self: &Arc<Self>, target: &Target, textures: &[(u32, &Image)]) -> Result<(), Error> {
        let bad = |reason| Err(Error::BadDraw { reason });
        if !Arc::ptr_eq(self, &target.pass.graphics)
            || textures.iter().any(|(_, texture)| !Arc::ptr_eq(self, &texture.graphics))
        {
            return bad("the target or a texture was made elsewhere");
        }
        if textures.iter().any(|(binding, _)| *binding >= BINDINGS) {
            return bad("a texture's number is too large");
        }
        let is_drawn_to = |texture: &Image| target.colours.iter().any(|colour| std::ptr::eq(colour, texture));
        if textures.iter().any(|(_, texture)| is_drawn_to(texture)) {
            return bad("a texture is drawn to as well");
        }
        Ok(())
    }

    /// A new set of these textures.
    fn textures(
        &self,
        descriptors: &mut Descriptors,
        textures: &[(u32, &Image)],
    ) -> Result<vk::DescriptorSet, Error> {
        // SAFETY: the set is not in use, since each submission is waited for under the lock that the caller holds.
        let set = unsafe { descriptors.renew()? };
        for (binding, texture) in textures {
            let image =
                [vk::DescriptorImageInfo::default().image_view(*texture.view).image_layout(BETWEEN_PASSES)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(*binding)
                .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                .image_info(&image);
            // SAFETY: the set is new, has this binding, and the texture outlives its use.
            unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
        }
        Ok(set)
    }

    /// # Safety
    /// `commands` is being recorded, and all that is drawn fits together.
    unsafe fn record(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        set: Option<vk::DescriptorSet>,
        target: &Target,
        draws: &[Draw<'_>],
    ) {
        let graphics = vk::PipelineBindPoint::GRAPHICS;
        let extent = vk::Extent2D { width: target.width, height: target.height };
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent };
        let viewport = vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: extent.width as f32,
            height: extent.height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // Zero of floats and of integers alike.
        let mut clear = vec![vk::ClearValue::default(); target.colours.len()];
        clear.push(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 1.0, stencil: 0 } });
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(*target.pass.raw)
            .framebuffer(*target.framebuffer)
            .render_area(area)
            .clear_values(&clear);
        // SAFETY: as the caller promises; there is a clear value for each attachment.
        unsafe {
            device.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE);
            device.cmd_set_viewport(commands, 0, &[viewport]);
            device.cmd_set_scissor(commands, 0, &[area]);
            if let Some(set) = set {
                device.cmd_bind_descriptor_sets(commands, graphics, *self.layout.pipeline, 0, &[set], &[]);
            }
            for draw in draws {
                device.cmd_bind_pipeline(commands, graphics, *draw.pipeline.raw);
                if !draw.constants.is_empty() {
                    device.cmd_push_constants(commands, *self.layout.pipeline, STAGES, 0, draw.constants);
                }
                draw_mesh(device, commands, draw.mesh);
            }
            device.cmd_end_render_pass(commands);
        }
    }
}

/// Fails where the parts of a draw do not fit each other or the target.
fn check(target: &Target, draw: &Draw<'_>) -> Result<(), Error> {
    let bad = |reason| Err(Error::BadDraw { reason });
    if !target.pass.is_compatible(&draw.pipeline.pass) {
        return bad("a pipeline was made for other attachments");
    }
    let attributes = draw.mesh.into_iter().flat_map(Mesh::formats);
    if !attributes.eq(draw.pipeline.attributes.iter().copied()) {
        return bad("a pipeline was made for other attributes than the mesh has");
    }
    if draw.mesh.is_some_and(|mesh| !Arc::ptr_eq(&mesh.graphics, &target.pass.graphics)) {
        return bad("a mesh was made elsewhere");
    }
    if draw.constants.len() > PUSH_CONSTANTS as usize || !draw.constants.len().is_multiple_of(4) {
        return bad("push constants are not up to 128 bytes in words");
    }
    Ok(())
}

/// # Safety
/// `commands` is being recorded in a render pass, with a pipeline for the mesh's attributes.
unsafe fn draw_mesh(device: &ash::Device, commands: vk::CommandBuffer, mesh: Option<&Mesh>) {
    // SAFETY: as the caller promises; the mesh's indices are below its vertices.
    unsafe {
        let Some(mesh) = mesh else {
            device.cmd_draw(commands, 3, 1, 0, 0);
            return;
        };
        let buffers: Vec<_> = mesh.attributes.iter().map(|(_, buffer)| *buffer.raw).collect();
        device.cmd_bind_vertex_buffers(commands, 0, &buffers, &vec![0; buffers.len()]);
        match &mesh.indices {
            None => device.cmd_draw(commands, mesh.count, 1, 0, 0),
            Some(indices) => {
                device.cmd_bind_index_buffer(commands, *indices.raw, 0, vk::IndexType::UINT32);
                device.cmd_draw_indexed(commands, mesh.count, 1, 0, 0, 0);
            }
        }
    }
}
