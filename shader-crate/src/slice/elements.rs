//! Slices of vectors, of tangent frames and of rotations.

#[cfg(feature = "rayon")]
use super::expect_length;
use super::machine::Level;
use super::strided::{decode_strided_with, encode_strided_with};
use super::{LengthMismatch, StrideError, Strided, Vector, decode_slice_by, encode_slice_by};
use crate::codec::Codec;
use crate::frame::FrameCodec;
use crate::quat::RotationCodec;
use core::marker::PhantomData;

/// A tangent frame: a [`Frame`](crate::Frame), or seven floats, those of normal, tangent and handedness.
pub trait AnyFrame: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]> {}

impl<T: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]>> AnyFrame for T {}

/// A rotation: a unit quaternion of any library, or four floats, x, y, z and w.
pub trait AnyRotation: Copy + Send + Sync + From<[f32; 4]> + Into<[f32; 4]> {}

impl<T: Copy + Send + Sync + From<[f32; 4]> + Into<[f32; 4]>> AnyRotation for T {}

/// Defines the functions of elements of `$floats` floats.
macro_rules! functions {
    (
        $(#[$example:meta])*
        $elements:ident of $floats:literal floats, $any:ident, $codec:ident:
        $encode:ident $decode:ident $encode_at:ident $decode_at:ident $par_encode:ident $par_decode:ident
        $encode_strided:ident $decode_strided:ident
        $(#[$strided_example:meta])*
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
            $encode_at::<C>(Level::best(), $elements, codes)
        }

        #[doc = concat!("Decodes `codes`, packed as by [`", stringify!($encode), "`], into `", stringify!($elements), "`.")]
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        pub fn $decode<C: $codec>(codes: &[u8], $elements: &mut [impl $any]) -> Result<(), LengthMismatch> {
            $decode_at::<C>(Level::best(), codes, $elements)
        }

        #[doc = concat!("[`", stringify!($encode), "`] with the instructions of a given level.")]
        #[doc(hidden)]
        pub fn $encode_at<C: $codec>(
            level: Level,
            $elements: &[impl $any],
            codes: &mut [u8],
        ) -> Result<(), LengthMismatch> {
            encode_slice_by::<$floats>(PhantomData::<C>, level, $elements, codes)
        }

        #[doc = concat!("[`", stringify!($decode), "`] with the instructions of a given level.")]
        #[doc(hidden)]
        pub fn $decode_at<C: $codec>(
            level: Level,
            codes: &[u8],
            $elements: &mut [impl $any],
        ) -> Result<(), LengthMismatch> {
            decode_slice_by::<$floats>(PhantomData::<C>, level, codes, $elements)
        }

        #[doc = concat!("Encodes as [`", stringify!($encode), "`] does, with the same bits, in rayon's current thread pool; up")]
        /// to 16,384 elements on the calling thread.
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        #[cfg(feature = "rayon")]
        pub fn $par_encode<C: $codec>($elements: &[impl $any], codes: &mut [u8]) -> Result<(), LengthMismatch> {
            expect_length($elements.len() * C::BYTES, codes.len())?;
            super::par_encode_with($elements, codes, C::BYTES, $encode_at::<C>)
        }

        #[doc = concat!("Decodes as [`", stringify!($decode), "`] does, with the same bits, in rayon's current thread pool; up")]
        /// to 16,384 elements on the calling thread.
        ///
        /// # Errors
        #[doc = concat!("The errors of [`", stringify!($encode), "`].")]
        #[cfg(feature = "rayon")]
        pub fn $par_decode<C: $codec>(codes: &[u8], $elements: &mut [impl $any]) -> Result<(), LengthMismatch> {
            expect_length(codes.len(), $elements.len() * C::BYTES)?;
            super::par_decode_with(codes, $elements, C::BYTES, $decode_at::<C>)
        }

        #[doc = concat!("[`", stringify!($encode), "`] from elements among other fields to codes among other fields. The floats")]
        /// of an element follow each other. Bytes between the codes stay as they are.
        ///
        $(#[$strided_example])*
        ///
        /// # Errors
        /// [`StrideError`] where the elements or the codes do not fit their bytes or are not equally many. Nothing is
        /// written then.
        pub fn $encode_strided<C: $codec>(
            $elements: Strided<&[u8]>,
            codes: Strided<&mut [u8]>,
        ) -> Result<(), StrideError> {
            encode_strided_with::<$floats>(Level::best(), $elements, codes, C::BYTES, $encode_at::<C>)
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
            decode_strided_with::<$floats>(Level::best(), codes, $elements, C::BYTES, $decode_at::<C>)
        }
    };
}

functions! {
    vectors of 3 floats, Vector, Codec:
    encode_slice decode_slice encode_slice_at decode_slice_at par_encode_slice par_decode_slice
    encode_strided decode_strided
    /// ```
    /// use core::mem::{offset_of, size_of};
    /// use unitvec::slice::{Strided, encode_strided};
    /// use unitvec::{Codec, Oct32};
    ///
    /// #[derive(Clone, Copy, bytemuck::NoUninit)]
    /// #[repr(C)]
    /// struct Vertex {
    ///     position: [f32; 3],
    ///     normal: [f32; 3],
    ///     uv: [f32; 2],
    /// }
    ///
    /// let vertex = Vertex { position: [1.0, 2.0, 3.0], normal: [0.0, 1.0, 0.0], uv: [0.5, 0.5] };
    /// let vertices = [vertex; 100];
    /// let mut codes = [0; 100 * Oct32::BYTES];
    /// encode_strided::<Oct32>(
    ///     Strided {
    ///         bytes: bytemuck::cast_slice(&vertices),
    ///         offset: offset_of!(Vertex, normal),
    ///         stride: size_of::<Vertex>(),
    ///     },
    ///     Strided { bytes: &mut codes, offset: 0, stride: Oct32::BYTES },
    /// )?;
    /// # assert_eq!(codes[396..], Oct32::encode(vertex.normal).to_le_bytes());
    /// # Ok::<(), unitvec::slice::StrideError>(())
    /// ```
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
    encode_frames decode_frames encode_frames_at decode_frames_at par_encode_frames par_decode_frames
    encode_frames_strided decode_frames_strided
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
    encode_rotations decode_rotations encode_rotations_at decode_rotations_at par_encode_rotations par_decode_rotations
    encode_rotations_strided decode_rotations_strided
}
