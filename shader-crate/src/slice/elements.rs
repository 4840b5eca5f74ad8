//! Slices of tangent frames and of rotations. Their codecs are worked through one element at a time, on any machine.

#[cfg(feature = "rayon")]
use super::expect_length;
use super::machine::Level;
use super::strided::{decode_strided_with, encode_strided_with};
use super::{LengthMismatch, StrideError, Strided, load_each, store_each};
use crate::codec::RawCode;
use crate::frame::{Frame, FrameCodec};
use crate::quat::RotationCodec;

/// A tangent frame: a [`Frame`](crate::Frame), or seven floats, those of normal, tangent and handedness.
pub trait AnyFrame: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]> {}

impl<T: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]>> AnyFrame for T {}

/// A rotation: a unit quaternion of any library, or four floats, x, y, z and w.
pub trait AnyRotation: Copy + Send + Sync + From<[f32; 4]> + Into<[f32; 4]> {}

impl<T: Copy + Send + Sync + From<[f32; 4]> + Into<[f32; 4]>> AnyRotation for T {}

/// Defines the six functions of elements of `$floats` floats.
macro_rules! functions {
    (
        $(#[$example:meta])*
        $elements:ident of $floats:literal floats, $any:ident, $codec:ident:
        $encode:ident $decode:ident $par_encode:ident $par_decode:ident $encode_strided:ident $decode_strided:ident,
        $encode_one:expr, $decode_one:expr
    ) => {
        #[doc = concat!("Encodes `", stringify!($elements), "` into `codes`: [`", stringify!($codec), "::BYTES`] little-endian")]
        /// bytes each, without gaps.
        ///
        $(#[$example])*
        ///
        /// # Errors
        #[doc = concat!("[`LengthMismatch`] unless `codes` has exactly `", stringify!($elements), ".len() * C::BYTES` bytes.")]
        /// Nothing is written then.
        pub fn $encode<C: $codec>($elements: &[impl $any], codes: &mut [u8]) -> Result<(), LengthMismatch> {
            let encode: fn([f32; $floats]) -> C::Code = $encode_one;
            store_each($elements, codes, C::BYTES, |element| encode((*element).into()).to_words())
        }

        #[doc = concat!("Decodes `codes`, packed as by [`", stringify!($encode), "`], into `", stringify!($elements), "`.")]
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        pub fn $decode<C: $codec>(codes: &[u8], $elements: &mut [impl $any]) -> Result<(), LengthMismatch> {
            let decode: fn(C::Code) -> [f32; $floats] = $decode_one;
            load_each(codes, $elements, C::BYTES, |[low, high]| decode(C::Code::from_low_high(low, high)).into())
        }

        #[doc = concat!("Encodes as [`", stringify!($encode), "`] does, with the same bits, in rayon's current thread pool; up")]
        /// to 16,384 elements on the calling thread.
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        #[cfg(feature = "rayon")]
        pub fn $par_encode<C: $codec>($elements: &[impl $any], codes: &mut [u8]) -> Result<(), LengthMismatch> {
            expect_length($elements.len() * C::BYTES, codes.len())?;
            super::par_encode_with($elements, codes, C::BYTES, |_, elements, codes| $encode::<C>(elements, codes))
        }

        #[doc = concat!("Decodes as [`", stringify!($decode), "`] does, with the same bits, in rayon's current thread pool; up")]
        /// to 16,384 elements on the calling thread.
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        #[cfg(feature = "rayon")]
        pub fn $par_decode<C: $codec>(codes: &[u8], $elements: &mut [impl $any]) -> Result<(), LengthMismatch> {
            expect_length(codes.len(), $elements.len() * C::BYTES)?;
            super::par_decode_with(codes, $elements, C::BYTES, |_, codes, elements| $decode::<C>(codes, elements))
        }

        #[doc = concat!("[`", stringify!($encode), "`] from elements among other fields to codes among other fields. The floats")]
        /// of an element follow each other.
        ///
        /// # Errors
        /// [`StrideError`] where the elements or the codes do not fit their bytes or are not equally many. Nothing is
        /// written then.
        pub fn $encode_strided<C: $codec>(
            $elements: Strided<&[u8]>,
            codes: Strided<&mut [u8]>,
        ) -> Result<(), StrideError> {
            encode_strided_with::<$floats>(Level::BASELINE, $elements, codes, C::BYTES, |_, elements, codes| {
                $encode::<C>(elements, codes)
            })
        }

        #[doc = concat!("[`", stringify!($decode), "`] from codes among other fields to elements among other fields: the reverse")]
        #[doc = concat!("of [`", stringify!($encode_strided), "`]. Bytes between the elements stay as they are.")]
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode_strided), "`].")]
        pub fn $decode_strided<C: $codec>(
            codes: Strided<&[u8]>,
            $elements: Strided<&mut [u8]>,
        ) -> Result<(), StrideError> {
            decode_strided_with::<$floats>(Level::BASELINE, codes, $elements, C::BYTES, |_, codes, elements| {
                $decode::<C>(codes, elements)
            })
        }
    };
}

functions! {
    /// ```
    /// use unitvec::slice::{decode_frames, encode_frames};
    /// use unitvec::{Frame, Frame32, FrameCodec};
    ///
    /// let frames = [Frame::new([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], -1.0); 2];
    /// let mut codes = [0; 2 * Frame32::BYTES];
    /// encode_frames::<Frame32>(&frames, &mut codes)?;
    /// let mut decoded = [[0.0; 7]; 2];
    /// decode_frames::<Frame32>(&codes, &mut decoded)?;
    /// assert_eq!(decoded[1], frames[1].to_array());
    /// # Ok::<(), unitvec::slice::LengthMismatch>(())
    /// ```
    frames of 7 floats, AnyFrame, FrameCodec:
    encode_frames decode_frames par_encode_frames par_decode_frames encode_frames_strided decode_frames_strided,
    |frame| C::encode(Frame::from_array(frame)), |code| C::decode(code).to_array()
}

functions! {
    /// ```
    /// use unitvec::slice::{decode_rotations, encode_rotations};
    /// use unitvec::{Quat32, RotationCodec};
    ///
    /// let rotations = [[0.5, 0.5, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]];
    /// let mut codes = [0; 2 * Quat32::BYTES];
    /// encode_rotations::<Quat32>(&rotations, &mut codes)?;
    /// let mut decoded = [[0.0; 4]; 2];
    /// decode_rotations::<Quat32>(&codes, &mut decoded)?;
    /// assert_eq!(decoded, rotations);
    /// # Ok::<(), unitvec::slice::LengthMismatch>(())
    /// ```
    rotations of 4 floats, AnyRotation, RotationCodec:
    encode_rotations decode_rotations par_encode_rotations par_decode_rotations
    encode_rotations_strided decode_rotations_strided,
    |q| C::encode(q), |code| C::decode(code)
}
