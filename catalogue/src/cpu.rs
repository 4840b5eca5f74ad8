//! The CPU functions of a codec, as pointers: all codecs have the same type.

use crate::{RECOMMENDED, integer};
use std::sync::OnceLock;
use unitvec::best_fit::{EncodeByTable, TABLE_WORDS, fill_table};
use unitvec::codec::RawCode;
use unitvec::interop::{Format, FrameFormat, RotationFormat};
use unitvec::slice::machine::Level;
use unitvec::slice::{
    DecodeAt, EncodeAt, LengthMismatch, decode_frames_at, decode_rotations_at, decode_slice_at,
    encode_frames_at, encode_rotations_at, encode_slice_at, encode_slice_with, expect_length,
};
use unitvec::{Codec, Frame, FrameCodec, RotationCodec};

/// The functions of a codec of elements of `N` floats.
#[derive(Clone, Copy, Debug)]
pub struct Functions<const N: usize> {
    pub encode_one: fn([f32; N]) -> [u32; 2],
    pub decode_one: fn([u32; 2]) -> [f32; N],
    pub encode_at: EncodeAt<[f32; N]>,
    pub decode_at: DecodeAt<[f32; N]>,
    /// Slice encoder: `encode_at`, or an encoder by table.
    pub encode: EncodeAt<[f32; N]>,
}

/// The functions of a codec of vectors, frames or rotations.
#[derive(Clone, Copy, Debug)]
pub enum AnyFunctions {
    Vector(Functions<3>),
    Frame(Functions<7>),
    Rotation(Functions<4>),
    /// A value, whose functions need it.
    Format(Format),
    FrameFormat(FrameFormat),
    RotationFormat(RotationFormat),
}

impl Functions<3> {
    /// The functions of the codec of this identifier.
    pub const fn of_vectors<C: Codec>(id: &str) -> Self {
        let (encode, decode): (EncodeAt<[f32; 3]>, DecodeAt<[f32; 3]>) = match has_blocks(id) {
            true => (encode_slice_at::<C>, decode_slice_at::<C>),
            false => (encode_each::<C>, decode_each::<C>),
        };
        Self {
            encode_one: encode_one::<C>,
            decode_one: decode_one::<C>,
            encode_at: encode,
            decode_at: decode,
            encode,
        }
    }
}

/// True where slices are encoded and decoded in blocks, by wide instructions. With the feature `compact` those of recommended
/// codecs are.
const fn has_blocks(id: &str) -> bool {
    let (mut use_, mut choice) = (0, 0);
    while cfg!(feature = "compact") && use_ < RECOMMENDED.len() {
        let choices = RECOMMENDED[use_].choices;
        if choice == choices.len() {
            (use_, choice) = (use_ + 1, 0);
        } else if is_same(choices[choice].id, id) {
            return true;
        } else {
            choice += 1;
        }
    }
    !cfg!(feature = "compact")
}

const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

#[inline(never)]
fn encode_one<C: Codec>(vector: [f32; 3]) -> [u32; 2] {
    C::encode(vector).to_words()
}

#[inline(never)]
fn decode_one<C: Codec>(code: [u32; 2]) -> [f32; 3] {
    C::decode(C::Code::from_words(code))
}

/// Encodes a slice by [`encode_one`].
fn encode_each<C: Codec>(_: Level, vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
    encode_slice_with::<C>(vectors, codes, |vector| C::Code::from_words(encode_one::<C>(vector)))
}

/// Decodes a slice by [`decode_one`].
fn decode_each<C: Codec>(_: Level, codes: &[u8], vectors: &mut [[f32; 3]]) -> Result<(), LengthMismatch> {
    expect_length(vectors.len() * C::BYTES, codes.len())?;
    for (code, vector) in codes.chunks_exact(C::BYTES).zip(vectors) {
        let code = integer(code);
        *vector = decode_one::<C>([code as u32, (code >> 32) as u32]);
    }
    Ok(())
}

impl Functions<7> {
    pub const fn of_frames<F: FrameCodec>() -> Self {
        Self {
            encode_one: |frame| F::encode(Frame::from_array(frame)).to_words(),
            decode_one: |code| F::decode(F::Code::from_words(code)).to_array(),
            encode_at: encode_frames_at::<F>,
            decode_at: decode_frames_at::<F>,
            encode: encode_frames_at::<F>,
        }
    }
}

impl Functions<4> {
    pub const fn of_rotations<C: RotationCodec>() -> Self {
        Self {
            encode_one: |q| C::encode(q).to_words(),
            decode_one: |code| C::decode(C::Code::from_words(code)),
            encode_at: encode_rotations_at::<C>,
            decode_at: decode_rotations_at::<C>,
            encode: encode_rotations_at::<C>,
        }
    }
}

/// [`Functions`] that hold a value: the closures of a format of other software.
pub struct OfValue<A, B, C, D> {
    pub encode_one: A,
    pub decode_one: B,
    pub encode: C,
    pub encode_at: C,
    pub decode_at: D,
}

/// The functions of a format, from its value and the closures for its slices.
macro_rules! of_value {
    ($format:ident, $encode:expr, $decode:expr) => {{
        let encode = $encode;
        $crate::cpu::OfValue {
            encode_one: |element| $format.encode_words(element),
            decode_one: |code| $format.decode_words(code),
            encode,
            encode_at: encode,
            decode_at: $decode,
        }
    }};
}
pub(crate) use of_value;

/// Evaluates an expression with the [`Functions`] of a codec, whatever its elements are.
macro_rules! with_functions {
    ($codec:expr, $functions:ident => $result:expr) => {
        match &$codec.functions {
            AnyFunctions::Vector($functions) => $result,
            AnyFunctions::Frame($functions) => $result,
            AnyFunctions::Rotation($functions) => $result,
            AnyFunctions::Format(format) => {
                let $functions = $crate::cpu::of_value!(
                    format,
                    |level, vectors: &[[f32; 3]], codes: &mut [u8]| format
                        .encode_slice_at(level, vectors, codes),
                    |level, codes: &[u8], vectors: &mut [[f32; 3]]| format
                        .decode_slice_at(level, codes, vectors)
                );
                $result
            }
            AnyFunctions::RotationFormat(format) => {
                let $functions = $crate::cpu::of_value!(
                    format,
                    |_: Level, rotations: &[[f32; 4]], codes: &mut [u8]| format
                        .encode_slice(rotations, codes),
                    |_: Level, codes: &[u8], rotations: &mut [[f32; 4]]| format
                        .decode_slice(codes, rotations)
                );
                $result
            }
            AnyFunctions::FrameFormat(format) => {
                let $functions = $crate::cpu::of_value!(
                    format,
                    |_: Level, frames: &[[f32; 7]], codes: &mut [u8]| format.encode_slice(frames, codes),
                    |_: Level, codes: &[u8], frames: &mut [[f32; 7]]| format.decode_slice(codes, frames)
                );
                $result
            }
        }
    };
}
pub(crate) use with_functions;

/// The first floats of a slice, and zeros after them.
pub fn resized<const FROM: usize, const TO: usize>(floats: [f32; FROM]) -> [f32; TO] {
    std::array::from_fn(|i| floats.get(i).copied().unwrap_or_default())
}

/// The table of [`unitvec::best_fit`], computed once.
pub fn best_fit_table() -> &'static [u32] {
    static TABLE: OnceLock<Vec<u32>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = vec![0; TABLE_WORDS];
        fill_table(&mut table);
        table
    })
}

/// Encodes a slice by the table of [`unitvec::best_fit`].
pub fn encode_by_table<C: EncodeByTable>(
    _: Level,
    vectors: &[[f32; 3]],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    let table = best_fit_table();
    encode_slice_with::<C>(vectors, codes, |v| C::encode_by_table(v, table))
}
