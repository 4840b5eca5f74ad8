//! Formats of texels and vertices, and the uses that a device has for them.

use super::{Device, Error};
use ash::vk;

/// A format of Vulkan.
pub use ash::vk::Format as ImageFormat;

/// Uses of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormatUse {
    /// A colour attachment that is read as a texture afterwards.
    Attachment,
    /// A depth attachment.
    Depth,
    /// A texture.
    Texture,
    /// A vertex attribute.
    Vertex,
}

impl FormatUse {
    /// The words for this use in messages.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Attachment => "as a colour attachment",
            Self::Depth => "as a depth attachment",
            Self::Texture => "as a texture",
            Self::Vertex => "as a vertex attribute",
        }
    }

    /// True where a format with these properties can be used so.
    fn is_offered(self, properties: vk::FormatProperties) -> bool {
        use vk::FormatFeatureFlags as Features;
        let images = properties.optimal_tiling_features;
        match self {
            Self::Attachment => images.contains(Features::COLOR_ATTACHMENT | Features::SAMPLED_IMAGE),
            Self::Depth => images.contains(Features::DEPTH_STENCIL_ATTACHMENT),
            Self::Texture => images.contains(Features::SAMPLED_IMAGE),
            Self::Vertex => properties.buffer_features.contains(Features::VERTEX_BUFFER),
        }
    }
}

impl Device {
    /// True where the device takes this format for this use.
    pub fn supports(&self, format: ImageFormat, usage: FormatUse) -> bool {
        // SAFETY: a query of a physical device of the instance; the format is one of Vulkan 1.0.
        let properties =
            unsafe { self.instance.raw.get_physical_device_format_properties(self.physical, format) };
        usage.is_offered(properties)
    }

    /// Fails where the device does not take this format for this use.
    pub(super) fn expect(&self, format: ImageFormat, usage: FormatUse) -> Result<(), Error> {
        if self.supports(format, usage) {
            return Ok(());
        }
        Err(unsupported(&self.info().name, format, usage))
    }
}

fn unsupported(device: &str, format: ImageFormat, usage: FormatUse) -> Error {
    Error::UnsupportedFormat {
        device: device.to_owned(),
        format: format!("VK_FORMAT_{format:?}"),
        usage: usage.words(),
    }
}

/// Bytes of a texel or of a vertex attribute, for the formats that codecs and the renderer use.
pub const fn bytes_per_texel(format: ImageFormat) -> Option<usize> {
    use ImageFormat as F;
    Some(match format {
        F::R8G8_SNORM | F::R8G8_UNORM | F::R8G8_SINT => 2,
        F::R8G8B8_SNORM | F::R8G8B8_UNORM => 3,
        F::R8G8B8A8_SNORM | F::R8G8B8A8_UNORM | F::R32_UINT => 4,
        F::R16G16_SNORM | F::R16G16_UNORM | F::R16G16_SINT | F::R16G16_SFLOAT => 4,
        F::A2B10G10R10_SNORM_PACK32 | F::A2B10G10R10_UNORM_PACK32 => 4,
        F::R16G16B16_SNORM | F::R16G16B16_SFLOAT => 6,
        F::R16G16B16A16_SNORM | F::R16G16B16A16_UNORM | F::R16G16B16A16_SFLOAT | F::R32G32_UINT => 8,
        F::R32G32B32_SFLOAT => 12,
        F::R32G32B32A32_SFLOAT => 16,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each use asks for its own feature, in the place where Vulkan puts it.
    #[test]
    fn a_use_needs_its_features() {
        use vk::FormatFeatureFlags as Features;
        let images =
            |features| vk::FormatProperties { optimal_tiling_features: features, ..Default::default() };
        let sampled = images(Features::SAMPLED_IMAGE);
        let drawn = images(Features::SAMPLED_IMAGE | Features::COLOR_ATTACHMENT);
        let depth = images(Features::DEPTH_STENCIL_ATTACHMENT);
        let vertices =
            vk::FormatProperties { buffer_features: Features::VERTEX_BUFFER, ..Default::default() };
        let all = [FormatUse::Attachment, FormatUse::Depth, FormatUse::Texture, FormatUse::Vertex];
        let offered = |properties| all.map(|usage| usage.is_offered(properties));
        assert_eq!(offered(sampled), [false, false, true, false]);
        assert_eq!(offered(drawn), [true, false, true, false]);
        assert_eq!(offered(depth), [false, true, false, false]);
        assert_eq!(offered(vertices), [false, false, false, true]);
    }

    #[test]
    fn the_error_names_format_and_use() {
        let error = unsupported("GPU", ImageFormat::R8G8B8_SNORM, FormatUse::Attachment).to_string();
        let said = "device `GPU` does not take VK_FORMAT_R8G8B8_SNORM as a colour attachment";
        assert!(error.starts_with(said), "{error}");
    }
}
