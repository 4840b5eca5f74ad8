//! The contract that every codec keeps.

use crate::direction::{is_usable, l1_norm};
use core::fmt::Debug;
use core::hash::Hash;
use core::marker::PhantomData;
use glam::Vec3;

/// A way to store a direction in [`BITS`](Self::BITS) bits.
///
/// A codec is a type that holds nothing, and its functions are called on the type: `Oct32::encode(v)`.
///
/// [`encode`](Self::encode) and [`decode`](Self::decode) accept and return the vectors of any library: every type that
/// converts from and to `[f32; 3]`, such as the vectors of every version of glam, of mint, nalgebra and cgmath, and the
/// array itself.
///
/// ```
/// use unitvec::{Codec, Oct32};
///
/// let code = Oct32::encode([0.0, 2.0, 0.0]);
/// let decoded: [f32; 3] = Oct32::decode(code);
/// assert_eq!(decoded, [0.0, 1.0, 0.0]);
/// ```
///
/// To add a codec, implement [`encode_vec3`](Self::encode_vec3) and [`decode_vec3`](Self::decode_vec3). Their vectors are
/// those of this crate's [`glam`]. GPU kernels and slices call these two.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a codec: if it is a type of this crate, its family has no such width"
)]
pub trait Codec: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// Significant bits of a code. Bits above them are 0 on encode and ignored on decode.
    const BITS: u32;

    /// Bytes that a stored code takes: the least of 1, 2, 3, 4, 6, 8 that holds [`BITS`](Self::BITS).
    const BYTES: usize = storage_bytes(Self::BITS);

    /// An upper bound of the angle, in degrees, between a direction of the codec's domain and its decoded code; for raw
    /// component formats, between a unit vector and its decoded code.
    const MAX_ERROR_DEG: f32;

    /// True where decoded vectors have unit length, to within 2 ULP. Raw component formats leave normalising to the
    /// caller.
    const IS_UNIT: bool = true;

    /// True where the directions of the axes (those of the codec's domain) come back exactly.
    const EXACT_AXES: bool = true;

    /// True where a vector decoded on any device encodes on any other to a code of the same vector, to the bit, even by
    /// plain shaders, for which Vulkan lets devices divide and take square roots inexactly. The family's docs say why
    /// where it is false.
    const STABLE_ACROSS_DEVICES: bool = true;

    /// The null code, low word first: one that `encode` never writes, for [`OrNull`]. In two's complement the lowest
    /// pattern of the first component, with zeros above it. `None` where every code is written.
    const NULL: Option<[u32; 2]> = None;

    /// The code as a value: `u32` up to 32 bits, `[u32; 2]` beyond, low word first.
    type Code: RawCode;

    /// The code of the direction of `v`. The length of `v` does not matter; a vector without a usable direction
    /// (see [`direction`](crate::direction)) gets the code of +Z.
    ///
    /// Raw component formats ([`IS_UNIT`](Self::IS_UNIT) is false), best fit apart, store the components, clamped to
    /// [-1, 1] (half floats to ±65504): normalise first. Vectors that round to zero there get the code of +Z.
    #[must_use]
    #[inline(always)]
    fn encode<V: Into<[f32; 3]>>(v: V) -> Self::Code {
        Self::encode_vec3(Vec3::from_array(v.into()))
    }

    /// The direction that `code` stands for, of unit length to within 2 ULP where [`IS_UNIT`](Self::IS_UNIT). Any bit
    /// pattern is valid.
    ///
    /// The result's type must be known: `let v: [f32; 3] = C::decode(code)`, or `C::decode::<[f32; 3]>(code)`.
    #[must_use]
    #[inline(always)]
    fn decode<V: From<[f32; 3]>>(code: Self::Code) -> V {
        Self::decode_vec3(code).to_array().into()
    }

    /// [`encode`](Self::encode) for this crate's vector.
    #[must_use]
    fn encode_vec3(v: Vec3) -> Self::Code;

    /// [`decode`](Self::decode) for this crate's vector.
    #[must_use]
    fn decode_vec3(code: Self::Code) -> Vec3;
}

/// A type of codecs at a number of bits that it has. Only there it is a [`Codec`]: other numbers do not compile.
///
/// ```compile_fail,E0599
/// use unitvec::Codec;
/// unitvec::oct::Oct::<40>::encode([0.6, 0.0, -0.8]);
/// ```
///
/// Every type on the [crate's page](crate#types) has it. So do [`Oct`](crate::oct::Oct) and
/// [`OctPrecise`](crate::oct::OctPrecise) of all even numbers from 4 to 32.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a codec: its family has no such width",
    label = "choose a width that it has, as in `unitvec::Oct32`"
)]
pub trait Width {}

/// The directions that a codec is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Domain {
    /// All directions.
    Sphere,
    /// Directions with z >= 0. Others encode as (x, y, 0), and -Z as +Z; [`Codec::MAX_ERROR_DEG`] does not hold for them.
    Hemisphere,
}

/// The codec `C`, with a null code: vectors without a usable direction (see [`direction`](crate::direction)) get
/// [`Codec::NULL`], which decodes to (0, 0, 0). All else is as with `C`. Without a null code it does not compile.
///
/// ```
/// use unitvec::{Codec, Oct32, OrNull};
///
/// let decoded: [f32; 3] = OrNull::<Oct32>::decode(OrNull::<Oct32>::encode([f32::NAN, 0.0, 0.0]));
/// assert_eq!(decoded, [0.0; 3]);
/// ```
///
/// ```compile_fail,E0080
/// <unitvec::OrNull<unitvec::Fib16> as unitvec::Codec>::encode([0.0; 3]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OrNull<C>(PhantomData<C>);

impl<C: Codec> Codec for OrNull<C> {
    const BITS: u32 = C::BITS;
    const MAX_ERROR_DEG: f32 = C::MAX_ERROR_DEG;
    const IS_UNIT: bool = C::IS_UNIT;
    const EXACT_AXES: bool = C::EXACT_AXES;
    const STABLE_ACROSS_DEVICES: bool = C::STABLE_ACROSS_DEVICES;
    const NULL: Option<[u32; 2]> = Some(C::NULL.expect("a codec with a null code"));
    type Code = C::Code;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> C::Code {
        let (code, [low, high]) = (C::encode_vec3(v), const { Self::NULL.unwrap() });
        if is_usable(l1_norm(v)) { code } else { C::Code::from_low_high(low, high) }
    }

    #[inline(always)]
    fn decode_vec3(code: C::Code) -> Vec3 {
        let (v, [low, high], null) = (C::decode_vec3(code), code.to_words(), const { Self::NULL.unwrap() });
        let is_null = if C::BITS <= 32 {
            (low ^ null[0]) << (32 - C::BITS) == 0
        } else {
            (low == null[0]) & ((high ^ null[1]) << (64 - C::BITS) == 0)
        };
        if is_null { Vec3::ZERO } else { v }
    }
}

/// A code as a value, made of one or two 32-bit words.
pub trait RawCode: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// The low and the high word; the latter is 0 for one-word codes.
    fn to_words(self) -> [u32; 2];

    /// The code of these words; one-word codes ignore the high one.
    fn from_words(words: [u32; 2]) -> Self;

    /// [`from_words`](Self::from_words) without an array, which costs time in builds without optimisation.
    #[doc(hidden)]
    #[inline(always)]
    fn from_low_high(low: u32, high: u32) -> Self {
        Self::from_words([low, high])
    }
}

impl RawCode for u32 {
    #[inline(always)]
    fn to_words(self) -> [u32; 2] {
        [self, 0]
    }

    #[inline(always)]
    fn from_words(words: [u32; 2]) -> Self {
        words[0]
    }

    #[inline(always)]
    fn from_low_high(low: u32, _: u32) -> Self {
        low
    }
}

impl RawCode for [u32; 2] {
    #[inline(always)]
    fn to_words(self) -> [u32; 2] {
        self
    }

    #[inline(always)]
    fn from_words(words: [u32; 2]) -> Self {
        words
    }
}

/// The least of 1, 2, 3, 4, 6, 8 bytes that holds `bits` bits; 8 for more than 64.
pub const fn storage_bytes(bits: u32) -> usize {
    match bits.div_ceil(8) {
        0 | 1 => 1,
        2 => 2,
        3 => 3,
        4 => 4,
        5 | 6 => 6,
        _ => 8,
    }
}
