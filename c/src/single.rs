//! Single vectors, frames and rotations: the functions that `codecs.rs` calls.
//!
//! They name the codec's type and are inlined with all that they call. So an object file of a codec needs nothing of
//! Rust's libraries: one call that could panic, as far as the compiler knows, would bring 300 KB of them to a program.

use unitvec::codec::RawCode;
use unitvec::direction::{is_usable, l1_norm};
use unitvec::{Codec, FrameCodec, RotationCodec};

/// A vector of three floats, laid out as three floats of an array.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Vec3 {
    /// The first component.
    pub x: f32,
    /// The second component.
    pub y: f32,
    /// The third component.
    pub z: f32,
}

/// A tangent frame, laid out as seven floats of an array.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The normal of the surface.
    pub normal: Vec3,
    /// The direction of increasing u, perpendicular to the normal. Zero, or one along the normal, is encoded as angle 0:
    /// +X where the normal is +Z.
    pub tangent: Vec3,
    /// +1 or -1: the bitangent is handedness * cross(normal, tangent), as with glTF's TANGENT.
    pub handedness: f32,
}

/// A rotation as a unit quaternion, laid out as four floats of an array. Length and sign do not matter.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Quat {
    /// The first component of the imaginary part.
    pub x: f32,
    /// The second component of the imaginary part.
    pub y: f32,
    /// The third component of the imaginary part.
    pub z: f32,
    /// The real part.
    pub w: f32,
}

/// The code of a vector, or the null code where the vector has no direction: zeros, infinities, NaN.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_code_or_null(vector: Vec3, code: u64, null_code: u64) -> u64 {
    if is_usable(l1_norm([vector.x, vector.y, vector.z].into())) { code } else { null_code }
}

/// The decoded vector of a code, or (0, 0, 0) where the code is the null code. Higher bits of codes must be 0.
#[unsafe(no_mangle)]
pub extern "C" fn unitvec_vector_or_zero(decoded: Vec3, code: u64, null_code: u64) -> Vec3 {
    if code == null_code { Vec3 { x: 0.0, y: 0.0, z: 0.0 } } else { decoded }
}

#[inline(always)]
pub(crate) fn encode<C: Codec>(Vec3 { x, y, z }: Vec3) -> u64 {
    joined(C::encode([x, y, z]).to_words())
}

#[inline(always)]
pub(crate) fn decode<C: Codec>(code: u64) -> Vec3 {
    let [x, y, z] = C::decode(C::Code::from_words(words(code)));
    Vec3 { x, y, z }
}

#[inline(always)]
pub(crate) fn encode_frame<F: FrameCodec>(Frame { normal: n, tangent: t, handedness }: Frame) -> u64 {
    let frame = unitvec::Frame::from_array([n.x, n.y, n.z, t.x, t.y, t.z, handedness]);
    joined(F::encode(frame).to_words())
}

#[inline(always)]
pub(crate) fn decode_frame<F: FrameCodec>(code: u64) -> Frame {
    let unitvec::Frame { normal: n, tangent: t, handedness } = F::decode(F::Code::from_words(words(code)));
    Frame { normal: Vec3 { x: n.x, y: n.y, z: n.z }, tangent: Vec3 { x: t.x, y: t.y, z: t.z }, handedness }
}

#[inline(always)]
pub(crate) fn encode_rotation<C: RotationCodec>(Quat { x, y, z, w }: Quat) -> u64 {
    joined(C::encode([x, y, z, w]).to_words())
}

#[inline(always)]
pub(crate) fn decode_rotation<C: RotationCodec>(code: u64) -> Quat {
    let [x, y, z, w] = C::decode(C::Code::from_words(words(code)));
    Quat { x, y, z, w }
}

/// A code as one number, from its two words.
#[inline(always)]
fn joined([low, high]: [u32; 2]) -> u64 {
    u64::from(low) | (u64::from(high) << 32)
}

#[inline(always)]
fn words(code: u64) -> [u32; 2] {
    [code as u32, (code >> 32) as u32]
}
