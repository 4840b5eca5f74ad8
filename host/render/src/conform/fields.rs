//! The integers of a texel.

use unitvec_vulkan::{ImageFormat, bytes_per_texel};

/// The layout of a normalised format.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fields {
    pub(super) format: ImageFormat,
    /// Bits of red, green, blue and alpha, from the lowest bit of a texel's little-endian integer.
    bits: [u32; 4],
    /// True for SNORM.
    pub(super) is_signed: bool,
}

const fn fields(format: ImageFormat, bits: [u32; 4], is_signed: bool) -> Fields {
    Fields { format, bits, is_signed }
}

/// The layouts that hold two numbers, or two and a bit in alpha, of 8, 16 and 10 bits.
const LAYOUTS: [Fields; 10] = [
    fields(ImageFormat::R8G8_SNORM, [8, 8, 0, 0], true),
    fields(ImageFormat::R16G16_SNORM, [16, 16, 0, 0], true),
    fields(ImageFormat::A2B10G10R10_SNORM_PACK32, [10, 10, 10, 2], true),
    fields(ImageFormat::R8G8_UNORM, [8, 8, 0, 0], false),
    fields(ImageFormat::R16G16_UNORM, [16, 16, 0, 0], false),
    fields(ImageFormat::A2B10G10R10_UNORM_PACK32, [10, 10, 10, 2], false),
    fields(ImageFormat::R8G8B8A8_SNORM, [8, 8, 8, 8], true),
    fields(ImageFormat::R16G16B16A16_SNORM, [16, 16, 16, 16], true),
    fields(ImageFormat::R8G8B8A8_UNORM, [8, 8, 8, 8], false),
    fields(ImageFormat::R16G16B16A16_UNORM, [16, 16, 16, 16], false),
];

impl Fields {
    pub(super) fn all() -> impl Iterator<Item = Self> {
        LAYOUTS.into_iter()
    }

    /// The layout of a format; `None` for others.
    pub(super) fn of(format: ImageFormat) -> Option<Self> {
        Self::all().find(|fields| fields.format == format)
    }

    /// True where alpha has bits.
    pub(super) fn has_alpha(self) -> bool {
        self.bits[3] > 0
    }

    /// Bits of red.
    pub(super) fn bits(self) -> u32 {
        self.bits[0]
    }

    /// Bytes of a texel.
    pub(super) fn size(self) -> usize {
        bytes_per_texel(self.format).unwrap_or(1)
    }

    /// The integer that stands for 1, in this component.
    pub(super) fn most(self, at: usize) -> i32 {
        let bits = self.bits[at] - u32::from(self.is_signed);
        (1 << bits) - 1
    }

    fn shift(self, at: usize) -> u32 {
        self.bits[..at].iter().sum()
    }

    /// The integer of a component.
    pub(super) fn get(self, texel: &[u8], at: usize) -> i64 {
        let word = texel.iter().rev().fold(0, |word: u64, byte| word << 8 | u64::from(*byte));
        let unused = 64 - self.bits[at];
        let raised = word >> self.shift(at) << unused;
        if self.is_signed { raised as i64 >> unused } else { (raised >> unused) as i64 }
    }

    /// Appends the texel of red, green and alpha; blue is 0.
    pub(super) fn push(self, texels: &mut Vec<u8>, [red, green, alpha]: [i64; 3]) {
        let field = |at: usize, value: i64| match self.bits[at] {
            0 => 0,
            bits => (value as u64 & ((1 << bits) - 1)) << self.shift(at),
        };
        let word = field(0, red) | field(1, green) | field(3, alpha);
        texels.extend(&word.to_le_bytes()[..self.size()]);
    }

    /// The value that Vulkan gives a component's integer: the exact quotient, rounded once.
    pub(super) fn value(self, texel: &[u8], at: usize) -> f32 {
        (self.get(texel, at) as f32 / self.most(at) as f32).max(-1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_come_back() {
        for fields in Fields::all() {
            let most = [0, 1].map(|at| i64::from(fields.most(at)));
            let alpha = if fields.has_alpha() { i64::from(fields.most(3)) } else { 0 };
            let red = if fields.is_signed { -most[0] - 1 } else { 1 };
            let mut texel = Vec::new();
            fields.push(&mut texel, [red, most[1], alpha]);
            assert_eq!(texel.len(), fields.size());
            assert_eq!([0, 1].map(|at| fields.get(&texel, at)), [red, most[1]], "{:?}", fields.format);
            assert_eq!(fields.value(&texel, 1), 1.0);
            if fields.has_alpha() {
                assert_eq!([fields.get(&texel, 2), fields.get(&texel, 3)], [0, alpha]);
            }
            if fields.is_signed {
                // Two integers stand for -1.
                assert_eq!(fields.value(&texel, 0), -1.0);
            }
        }
    }
}
