//! Storage of codes on the graphics pipeline: attachments, textures and vertex attributes.

use unitvec_catalogue::AnyCodec;
use unitvec_vulkan::{Device, FormatUse, ImageFormat, bytes_per_texel};

/// The form of a code in the value of a texel or an attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Storage {
    /// The normal itself, without a codec.
    Float,
    /// A code of up to 32 bits as an integer.
    Uint,
    /// A code of up to 64 bits as two integers.
    Uint2,
    /// Two snorm of 8 bits.
    Snorm8x2,
    /// Two snorm of 16 bits.
    Snorm16x2,
    /// Three snorm of 8 bits.
    Snorm8x3,
    /// Three snorm of 16 bits.
    Snorm16x3,
    /// Three snorm of 10 bits.
    Snorm10x3,
    /// Two unorm of 8 bits.
    Unorm8x2,
    /// Two unorm of 16 bits.
    Unorm16x2,
    /// Three bytes as unorm.
    Unorm8x3,
    /// Two signed integers of 8 bits.
    Sint8x2,
    /// Two signed integers of 16 bits.
    Sint16x2,
    /// Three half floats.
    Float16x3,
    /// Two half floats.
    Float16x2,
    /// Two numbers that the hardware rounds, in a format to choose.
    Pair,
    /// A pair, and 0 or 1 in alpha.
    PairAndBit,
}

/// The storages of codecs' formats.
const OF_FORMATS: [Storage; 13] = {
    use Storage::*;
    [
        Snorm8x2, Snorm16x2, Snorm8x3, Snorm16x3, Snorm10x3, Unorm8x2, Unorm16x2, Unorm8x3, Sint8x2,
        Sint16x2, Float16x3, Float16x2, Uint,
    ]
};

impl Storage {
    /// The storage of a codec by its Vulkan format; integers where it has none.
    pub fn of(format: &AnyCodec) -> Self {
        let is_of = |name: &str, storage: &Self| name == format!("VK_FORMAT_{:?}", storage.own());
        let named = format.vk_format.and_then(|name| OF_FORMATS.into_iter().find(|one| is_of(name, one)));
        named.unwrap_or(Self::integers(format))
    }

    /// Integers for the codes of this codec.
    pub fn integers(format: &AnyCodec) -> Self {
        if format.bits > 32 { Self::Uint2 } else { Self::Uint }
    }

    /// The storage that a codec's codes are drawn to: its own format, or integers where the device does not draw to
    /// that. `keeps_10_bits`: A2B10G10R10_SNORM_PACK32 keeps codes, which software devices round wrong.
    pub fn drawn(format: &AnyCodec, device: &Device, keeps_10_bits: bool) -> Self {
        let own = Self::of(format);
        let keeps = own != Self::Snorm10x3 || keeps_10_bits;
        let is_drawn = keeps && device.supports(own.texel(), FormatUse::Attachment);
        if is_drawn || own.is_drawn_everywhere() { own } else { Self::integers(format) }
    }

    /// True where Vulkan promises that devices draw to [`texel`](Self::texel): they need not draw to any snorm, nor to unorm of
    /// 16 bits.
    pub const fn is_drawn_everywhere(self) -> bool {
        use Storage::{Snorm8x2, Snorm8x3, Snorm10x3, Snorm16x2, Snorm16x3, Unorm16x2};
        !matches!(self, Snorm8x2 | Snorm8x3 | Snorm10x3 | Snorm16x2 | Snorm16x3 | Unorm16x2)
    }

    /// The format of attachments and textures. Formats of three components are seldom attachments, so that their siblings of
    /// four stand in for them; the fourth is 0.
    pub const fn texel(self) -> ImageFormat {
        self.formats().0
    }

    /// The format of a vertex attribute on this device: of three components where it takes that.
    pub fn attribute(self, device: &Device) -> ImageFormat {
        self.three().filter(|three| device.supports(*three, FormatUse::Vertex)).unwrap_or(self.texel())
    }

    /// The format of three components that [`texel`](Self::texel) stands in for.
    pub const fn three(self) -> Option<ImageFormat> {
        self.formats().1
    }

    /// The format of the codes themselves: of three components where they have as many.
    pub fn own(self) -> ImageFormat {
        self.three().unwrap_or(self.texel())
    }

    const fn formats(self) -> (ImageFormat, Option<ImageFormat>) {
        use ImageFormat as F;
        match self {
            Self::Float => (F::R32G32B32A32_SFLOAT, Some(F::R32G32B32_SFLOAT)),
            Self::Pair | Self::PairAndBit => (F::R32G32B32A32_SFLOAT, None),
            Self::Uint => (F::R32_UINT, None),
            Self::Uint2 => (F::R32G32_UINT, None),
            Self::Snorm8x2 => (F::R8G8_SNORM, None),
            Self::Snorm16x2 => (F::R16G16_SNORM, None),
            Self::Snorm8x3 => (F::R8G8B8A8_SNORM, Some(F::R8G8B8_SNORM)),
            Self::Snorm16x3 => (F::R16G16B16A16_SNORM, Some(F::R16G16B16_SNORM)),
            Self::Snorm10x3 => (F::A2B10G10R10_SNORM_PACK32, None),
            Self::Unorm8x2 => (F::R8G8_UNORM, None),
            Self::Unorm16x2 => (F::R16G16_UNORM, None),
            Self::Unorm8x3 => (F::R8G8B8A8_UNORM, Some(F::R8G8B8_UNORM)),
            Self::Sint8x2 => (F::R8G8_SINT, None),
            Self::Sint16x2 => (F::R16G16_SINT, None),
            Self::Float16x3 => (F::R16G16B16A16_SFLOAT, Some(F::R16G16B16_SFLOAT)),
            Self::Float16x2 => (F::R16G16_SFLOAT, None),
        }
    }
}

/// The codes of texels or attributes of this format: their first bytes.
pub fn codes_of(texels: &[u8], format: ImageFormat, code_bytes: usize) -> Vec<u8> {
    let size = bytes_per_texel(format).unwrap_or(code_bytes).max(1);
    texels.chunks_exact(size).flat_map(|texel| &texel[..code_bytes.min(size)]).copied().collect()
}

/// The texels of R32G32B32A32_SFLOAT.
pub(super) fn float_texels(bytes: &[u8]) -> impl Iterator<Item = [f32; 4]> {
    bytes.chunks_exact(16).map(bytemuck::pod_read_unaligned)
}

/// Texels or attributes of this format that hold these codes: the rest of each is 0.
pub fn texels_of(codes: &[u8], format: ImageFormat, code_bytes: usize) -> Vec<u8> {
    let size = bytes_per_texel(format).unwrap_or(code_bytes);
    let mut texels = Vec::with_capacity(codes.len() / code_bytes.max(1) * size);
    for code in codes.chunks_exact(code_bytes.max(1)) {
        let end = texels.len() + size;
        texels.extend(code.iter().take(size));
        texels.resize(end, 0);
    }
    texels
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue::directions;

    /// A codec's format is known, and a texel has room for its code.
    #[test]
    fn every_codec_has_storage() {
        for format in directions() {
            let storage = Storage::of(format);
            let is_integer = matches!(storage, Storage::Uint | Storage::Uint2);
            let names_integer = format.vk_format.is_none_or(|name| name.ends_with("32_UINT"));
            assert_eq!(is_integer, names_integer, "{}", format.id);
            let room = bytes_per_texel(storage.texel()).unwrap();
            assert!(room >= format.bytes, "{}", format.id);
        }
    }

    #[test]
    fn codes_lie_at_the_start_of_texels() {
        let texels = texels_of(&[1, 2, 3, 4, 5, 6], ImageFormat::R8G8B8A8_SNORM, 3);
        assert_eq!(texels, [1, 2, 3, 0, 4, 5, 6, 0]);
        assert_eq!(codes_of(&texels, ImageFormat::R8G8B8A8_SNORM, 3), [1, 2, 3, 4, 5, 6]);
    }
}
