//! Single vectors and frames: the functions that `codecs.rs` calls, with the codecs that the catalogue has compiled.

use unitvec::{for_each_codec, for_each_frame};
use unitvec_catalogue::{frames, vectors};

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

impl Vec3 {
    fn to_array(self) -> [f32; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<[f32; 3]> for Vec3 {
    fn from([x, y, z]: [f32; 3]) -> Self {
        Self { x, y, z }
    }
}

/// Codecs by their places in the catalogue, named by their identifiers.
macro_rules! places {
    ($name:ident $([$id:ident $($rest:tt)*])*) => {
        #[derive(Clone, Copy)]
        #[allow(non_camel_case_types)]
        pub(crate) enum $name { $($id),* }
    };
}

macro_rules! vectors { ($($rows:tt)*) => { places!(Vectors $($rows)*); }; }
macro_rules! frames { ($($rows:tt)*) => { places!(Frames $($rows)*); }; }
for_each_codec!(vectors);
for_each_frame!(frames);

pub(crate) fn encode(codec: Vectors, vector: Vec3) -> u64 {
    joined(vectors()[codec as usize].encode_one(vector.to_array()))
}

pub(crate) fn decode(codec: Vectors, code: u64) -> Vec3 {
    vectors()[codec as usize].decode_one::<3>(words(code)).into()
}

pub(crate) fn encode_frame(codec: Frames, frame: Frame) -> u64 {
    let ([nx, ny, nz], [tx, ty, tz]) = (frame.normal.to_array(), frame.tangent.to_array());
    joined(frames()[codec as usize].encode_one([nx, ny, nz, tx, ty, tz, frame.handedness]))
}

pub(crate) fn decode_frame(codec: Frames, code: u64) -> Frame {
    let [nx, ny, nz, tx, ty, tz, handedness] = frames()[codec as usize].decode_one(words(code));
    Frame { normal: [nx, ny, nz].into(), tangent: [tx, ty, tz].into(), handedness }
}

/// A code as one number, from its two words.
fn joined([low, high]: [u32; 2]) -> u64 {
    u64::from(low) | (u64::from(high) << 32)
}

fn words(code: u64) -> [u32; 2] {
    [code as u32, (code >> 32) as u32]
}
