//! Formats of texels.

use ddsfile::DxgiFormat as Dxgi;
use half::f16;
use ktx2::Format as Vk;

/// The numbers that the bits of a channel stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// 0 to 1.
    Unorm,
    /// -1 to 1, both also by the least integer.
    Snorm,
    /// Integers.
    Integer,
    /// IEEE 754 floats of 16 or 32 bits.
    Float,
    /// Nothing by itself: the bits are those of a block of 4 by 4 texels.
    Block,
}

/// A format of texels, by its names in Vulkan and Direct3D. Channels lie from the low bit of the texel on.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Vulkan's format, which KTX2 files name.
    pub vulkan: Vk,
    /// The format of Direct3D, which DDS files name.
    pub dxgi: Option<Dxgi>,
    /// What a channel holds.
    pub numbers: Numbers,
    /// The bits of each channel.
    pub bits: &'static [u32],
}

macro_rules! formats {
    ($($vulkan:ident $dxgi:expr, $numbers:ident $bits:expr;)*) => {
        /// The formats that are read and written.
        pub const FORMATS: &[Format] = &[$(Format {
            vulkan: Vk::$vulkan,
            dxgi: $dxgi,
            numbers: Numbers::$numbers,
            bits: &$bits,
        }),*];
    };
}

formats! {
    R8_UNORM Some(Dxgi::R8_UNorm), Unorm [8];
    R8_UINT Some(Dxgi::R8_UInt), Integer [8];
    R8G8_UNORM Some(Dxgi::R8G8_UNorm), Unorm [8, 8];
    R8G8_SNORM Some(Dxgi::R8G8_SNorm), Snorm [8, 8];
    R8G8_SINT Some(Dxgi::R8G8_SInt), Integer [8, 8];
    R8G8B8_UNORM None, Unorm [8, 8, 8];
    R8G8B8A8_UNORM Some(Dxgi::R8G8B8A8_UNorm), Unorm [8, 8, 8, 8];
    R8G8B8A8_SNORM Some(Dxgi::R8G8B8A8_SNorm), Snorm [8, 8, 8, 8];
    B8G8R8A8_UNORM Some(Dxgi::B8G8R8A8_UNorm), Unorm [8, 8, 8, 8];
    A2B10G10R10_UNORM_PACK32 Some(Dxgi::R10G10B10A2_UNorm), Unorm [10, 10, 10, 2];
    A2B10G10R10_SNORM_PACK32 None, Snorm [10, 10, 10, 2];
    R16_UINT Some(Dxgi::R16_UInt), Integer [16];
    R16G16_UNORM Some(Dxgi::R16G16_UNorm), Unorm [16, 16];
    R16G16_SNORM Some(Dxgi::R16G16_SNorm), Snorm [16, 16];
    R16G16_SINT Some(Dxgi::R16G16_SInt), Integer [16, 16];
    R16G16_SFLOAT Some(Dxgi::R16G16_Float), Float [16, 16];
    R16G16B16A16_UNORM Some(Dxgi::R16G16B16A16_UNorm), Unorm [16, 16, 16, 16];
    R16G16B16A16_SNORM Some(Dxgi::R16G16B16A16_SNorm), Snorm [16, 16, 16, 16];
    R16G16B16A16_SFLOAT Some(Dxgi::R16G16B16A16_Float), Float [16, 16, 16, 16];
    R32_UINT Some(Dxgi::R32_UInt), Integer [32];
    R32G32_UINT Some(Dxgi::R32G32_UInt), Integer [32, 32];
    R32G32B32_SFLOAT Some(Dxgi::R32G32B32_Float), Float [32, 32, 32];
    R32G32B32A32_SFLOAT Some(Dxgi::R32G32B32A32_Float), Float [32, 32, 32, 32];
    BC5_UNORM_BLOCK Some(Dxgi::BC5_UNorm), Block [128];
    BC5_SNORM_BLOCK Some(Dxgi::BC5_SNorm), Block [128];
    BC7_UNORM_BLOCK Some(Dxgi::BC7_UNorm), Block [128];
}

/// The format of this name, after `VK_FORMAT_`.
pub fn named(name: &str) -> Option<&'static Format> {
    FORMATS.iter().find(|format| format.name() == name)
}

impl Format {
    /// The name, after `VK_FORMAT_`.
    pub fn name(&self) -> String {
        format!("{:?}", self.vulkan)
    }

    /// The bytes of a texel or block.
    pub fn bytes(&self) -> usize {
        self.bits.iter().sum::<u32>() as usize / 8
    }

    /// The bytes of an image of this size, or `None` beyond what the machine can address.
    pub fn bytes_of(&self, width: u32, height: u32) -> Option<usize> {
        let side = if self.numbers == Numbers::Block { 4 } else { 1 };
        let [columns, rows] = [width, height].map(|size| u64::from(size.div_ceil(side)));
        usize::try_from(columns * rows).ok()?.checked_mul(self.bytes())
    }

    /// True for a format whose channels can be the components of vectors.
    pub fn has_components(&self) -> bool {
        self.bits.len() > 2 && self.numbers != Numbers::Integer
    }

    /// The numbers of the channels of a texel in the order red, green, blue, alpha; those that lack are 0, and alpha 1.
    pub fn channels(&self, texel: &[u8]) -> [f32; 4] {
        let (mut channels, mut first) = ([0.0, 0.0, 0.0, 1.0], 0);
        for (channel, bits) in channels.iter_mut().zip(self.bits) {
            *channel = self.number(field(texel, first, *bits), *bits);
            first += bits;
        }
        if self.vulkan == Vk::B8G8R8A8_UNORM {
            channels.swap(0, 2);
        }
        channels
    }

    /// The number that the bits of a channel stand for: of integers, the UNORM that [`field_of`](Self::field_of) stores.
    pub fn number(&self, field: u32, bits: u32) -> f32 {
        match self.numbers {
            Numbers::Unorm | Numbers::Integer | Numbers::Block => (f64::from(field) / most(bits)) as f32,
            Numbers::Snorm => {
                let signed = ((field << (32 - bits)) as i32) >> (32 - bits);
                (f64::from(signed) / most(bits - 1)).max(-1.0) as f32
            }
            Numbers::Float if bits == 16 => f16::from_bits(field as u16).into(),
            Numbers::Float => f32::from_bits(field),
        }
    }

    /// The bits of a channel that come nearest to a number of 0 to 1. An integer channel holds it as a UNORM one does.
    pub fn field_of(&self, number: f32, bits: u32) -> u32 {
        let number = f64::from(number.clamp(0.0, 1.0));
        match self.numbers {
            Numbers::Unorm | Numbers::Integer | Numbers::Block => (number * most(bits)).round() as u32,
            Numbers::Snorm => (number * most(bits - 1)).round() as u32,
            Numbers::Float if bits == 16 => f16::from_f64(number).to_bits().into(),
            Numbers::Float => (number as f32).to_bits(),
        }
    }
}

/// The largest integer of so many bits.
fn most(bits: u32) -> f64 {
    ((1u64 << bits) - 1) as f64
}

/// Bits of a texel, of up to 32, that lie within eight bytes from the byte of the first.
pub fn field(texel: &[u8], first: u32, bits: u32) -> u32 {
    let from = first as usize / 8;
    let mut bytes = [0; 8];
    let there = texel.get(from..texel.len().min(from + 8)).unwrap_or_default();
    bytes[..there.len()].copy_from_slice(there);
    (u64::from_le_bytes(bytes) >> (first % 8) & ((1u64 << bits) - 1)) as u32
}
