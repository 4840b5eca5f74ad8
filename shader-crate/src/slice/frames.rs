//! Slices of tangent frames. Their codecs are worked through one frame at a time, on any machine.

#[cfg(feature = "rayon")]
use super::expect_length;
use super::machine::Level;
use super::strided::{decode_strided_with, encode_strided_with};
use super::{LengthMismatch, StrideError, Strided, load_each, store_each};
use crate::codec::RawCode;
use crate::frame::FrameCodec;

/// A tangent frame: a [`Frame`](crate::Frame), or seven floats, those of normal, tangent and handedness.
pub trait AnyFrame: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]> {}

impl<T: Copy + Send + Sync + From<[f32; 7]> + Into<[f32; 7]>> AnyFrame for T {}

/// Encodes `frames` into `codes`: [`FrameCodec::BYTES`] little-endian bytes each, without gaps.
///
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
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `frames.len() * F::BYTES` bytes. Nothing is written then.
pub fn encode_frames<F: FrameCodec>(
    frames: &[impl AnyFrame],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    store_each(frames, codes, F::BYTES, |frame| F::encode((*frame).into().into()).to_words())
}

/// Decodes `codes`, packed as by [`encode_frames`], into `frames`.
///
/// # Errors
/// The errors of [`encode_frames`].
pub fn decode_frames<F: FrameCodec>(
    codes: &[u8],
    frames: &mut [impl AnyFrame],
) -> Result<(), LengthMismatch> {
    load_each(codes, frames, F::BYTES, |[low, high]| {
        F::decode(F::Code::from_low_high(low, high)).to_array().into()
    })
}

/// Encodes as [`encode_frames`] does, with the same bits, in rayon's current thread pool; up to 16,384 frames on the
/// calling thread.
///
/// # Errors
/// The errors of [`encode_frames`].
#[cfg(feature = "rayon")]
pub fn par_encode_frames<F: FrameCodec>(
    frames: &[impl AnyFrame],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    expect_length(frames.len() * F::BYTES, codes.len())?;
    super::par_encode_with(frames, codes, F::BYTES, |_, frames, codes| encode_frames::<F>(frames, codes))
}

/// Decodes as [`decode_frames`] does, with the same bits, in rayon's current thread pool; up to 16,384 frames on the
/// calling thread.
///
/// # Errors
/// The errors of [`encode_frames`].
#[cfg(feature = "rayon")]
pub fn par_decode_frames<F: FrameCodec>(
    codes: &[u8],
    frames: &mut [impl AnyFrame],
) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), frames.len() * F::BYTES)?;
    super::par_decode_with(codes, frames, F::BYTES, |_, codes, frames| decode_frames::<F>(codes, frames))
}

/// [`encode_frames`] from frames among other fields to codes among other fields. The seven floats of a frame follow each
/// other, as glTF's NORMAL and TANGENT do in a vertex that has them in this order.
///
/// # Errors
/// [`StrideError`] where the frames or the codes do not fit their bytes or are not equally many. Nothing is written then.
pub fn encode_frames_strided<F: FrameCodec>(
    frames: Strided<&[u8]>,
    codes: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    encode_strided_with::<7>(Level::BASELINE, frames, codes, F::BYTES, |_, frames, codes| {
        encode_frames::<F>(frames, codes)
    })
}

/// [`decode_frames`] from codes among other fields to frames among other fields: the reverse of
/// [`encode_frames_strided`]. Bytes between the frames stay as they are.
///
/// # Errors
/// The errors of [`encode_frames_strided`].
pub fn decode_frames_strided<F: FrameCodec>(
    codes: Strided<&[u8]>,
    frames: Strided<&mut [u8]>,
) -> Result<(), StrideError> {
    decode_strided_with::<7>(Level::BASELINE, codes, frames, F::BYTES, |_, codes, frames| {
        decode_frames::<F>(codes, frames)
    })
}
