//! Codes as values that know their codec.

use crate::codec::{Codec, RawCode};
use core::fmt;

/// A code of the codec `C`: the bare integer of [`Codec::encode`], which cannot be taken for one of another codec.
///
/// ```
/// use unitvec::{Code, Oct24};
///
/// let code = Code::<Oct24>::encode([0.0, 1.0, 0.0]);
/// assert_eq!(code.to_string(), "feff7f");
/// assert_eq!(code.decode::<[f32; 3]>(), [0.0, 1.0, 0.0]);
/// assert_eq!(Code::from_bits(code.bits()), code);
/// ```
///
/// With the feature `bytemuck` slices of codes can be cast from and to those of integers, with `serde` a code is
/// serialised as its integer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        transparent,
        bound(serialize = "C::Code: serde::Serialize", deserialize = "C::Code: serde::Deserialize<'de>")
    )
)]
#[repr(transparent)]
pub struct Code<C: Codec>(C::Code);

impl<C: Codec> Code<C> {
    /// [`Codec::encode`].
    #[must_use]
    #[inline(always)]
    pub fn encode<V: Into<[f32; 3]>>(v: V) -> Self {
        Self(C::encode(v))
    }

    /// [`Codec::decode`].
    #[must_use]
    #[inline(always)]
    pub fn decode<V: From<[f32; 3]>>(self) -> V {
        C::decode(self.0)
    }

    /// The code of these bits. Any will do, but those above [`Codec::BITS`], which decoding ignores, count in `==`.
    #[must_use]
    #[inline(always)]
    pub const fn from_bits(bits: C::Code) -> Self {
        Self(bits)
    }

    /// The bare integer.
    #[must_use]
    #[inline(always)]
    pub const fn bits(self) -> C::Code {
        self.0
    }
}

/// Hexadecimal, with as many digits as the codec's bits take.
impl<C: Codec> fmt::Display for Code<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.0.to_words().map(u64::from);
        let bits = (low | (high << 32)) & (u64::MAX >> (64 - C::BITS));
        write!(f, "{bits:0$x}", C::BITS.div_ceil(4) as usize)
    }
}

#[cfg(feature = "bytemuck")]
#[allow(unsafe_code)]
mod plain {
    use super::{Code, Codec};
    use crate::Frame;
    use bytemuck::{Pod, Zeroable};

    // SAFETY: a code is transparent, and its integer is plain data.
    unsafe impl<C: Codec<Code: Zeroable>> Zeroable for Code<C> {}
    // SAFETY: as above.
    unsafe impl<C: Codec<Code: Pod>> Pod for Code<C> {}
    // SAFETY: seven `f32` in the order of C, without padding.
    unsafe impl Zeroable for Frame {}
    // SAFETY: as above.
    unsafe impl Pod for Frame {}
}
