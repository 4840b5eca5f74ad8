//! Entry points that the SPIR-V build turns into functions of a library to link with: their inputs become parameters,
//! their outputs the result. They are vertex shaders because these read and write values as they are, integers too.
//! (rust-gpu compiles entry points only: it has no linkage.)

use crate::codec::{Codec, RawCode};
use crate::frame::{Frame, FrameCodec};
use crate::quat::RotationCodec;
use crate::{for_each_codec, for_each_frame, for_each_rotation};
use glam::{UVec2, Vec3, Vec4};
use spirv_std::spirv;

/// A code as shaders pass it.
pub trait Passed: RawCode {
    /// `u32`, or a vector of two.
    type As: Copy + From<Self> + Into<Self>;
}

impl Passed for u32 {
    type As = u32;
}

impl Passed for [u32; 2] {
    type As = UVec2;
}

/// A module of functions for each codec, named after it.
macro_rules! functions {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => { $(
        #[doc = concat!("Functions of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            /// The code as it is passed.
            type PassedCode = <<crate::$codec as Codec>::Code as Passed>::As;

            /// The code of a vector.
            #[spirv(vertex)]
            pub fn encode(v: Vec3, code: &mut PassedCode) {
                *code = crate::$codec::encode_vec3(v).into();
            }

            /// The vector of a code.
            #[spirv(vertex)]
            pub fn decode(code: PassedCode, v: &mut Vec3) {
                *v = crate::$codec::decode_vec3(code.into());
            }
        }
    )* };
}

for_each_codec!(functions);

/// A module of functions for each codec of rotations, named after it.
macro_rules! rotation_functions {
    ($([$id:ident $codec:ident = $($rest:tt)*])*) => { $(
        #[doc = concat!("Functions of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            /// The code as it is passed.
            type PassedCode = <<crate::$codec as RotationCodec>::Code as Passed>::As;

            /// The code of a rotation.
            #[spirv(vertex)]
            pub fn encode(q: Vec4, code: &mut PassedCode) {
                *code = crate::$codec::encode_vec4(q).into();
            }

            /// The rotation of a code.
            #[spirv(vertex)]
            pub fn decode(code: PassedCode, q: &mut Vec4) {
                *q = crate::$codec::decode_vec4(code.into());
            }
        }
    )* };
}

for_each_rotation!(rotation_functions);

/// A module of functions for each codec of frames, named after it.
macro_rules! frame_functions {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => { $(
        #[doc = concat!("Functions of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            /// The code as it is passed.
            type PassedCode = <<crate::$codec as FrameCodec>::Code as Passed>::As;

            /// The code of a frame; the tangent's w is the handedness.
            #[spirv(vertex)]
            pub fn encode(normal: Vec3, tangent: Vec4, code: &mut PassedCode) {
                let frame = Frame { normal, tangent: tangent.truncate(), handedness: tangent.w };
                *code = crate::$codec::encode(frame).into();
            }

            /// The frame of a code.
            #[spirv(vertex)]
            pub fn decode(code: PassedCode, normal: &mut Vec3, tangent: &mut Vec4) {
                let frame = crate::$codec::decode(code.into());
                *normal = frame.normal;
                *tangent = frame.tangent.extend(frame.handedness);
            }
        }
    )* };
}

for_each_frame!(frame_functions);
