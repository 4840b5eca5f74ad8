//! Storage of normals: the codes of each codec, by the storage of its Vulkan format.

use crate::storage::*;
use core::marker::PhantomData;
use spirv_std::glam::Vec3;
use unitvec::azimuthal::{self, Ellipse, Eqarea};
use unitvec::{Codec, Frame, FrameCodec, for_each_codec, for_each_frame};
use unitvec::{cylindrical, eaoct, hemioct, oct, soct, spherical};

/// A way to store normals.
pub trait Normals {
    /// The storage of a code.
    type In: Storage;

    /// The code of a normal.
    fn encode(n: Vec3) -> CodeOf<Self>;

    /// The normal of a code.
    fn decode(code: CodeOf<Self>) -> Vec3;
}

/// The code of a normal.
pub type CodeOf<N> = <<N as Normals>::In as Storage>::Code;

/// The value written to an attachment.
pub type ValueOf<N> = <<N as Normals>::In as Storage>::Value;

/// The attribute of a vertex.
pub type AttributeOf<N> = <<N as Normals>::In as Storage>::Attribute;

/// The texture that holds codes.
pub type TextureOf<N> = <ValueOf<N> as Value>::Texture;

/// The storage of integers that holds a code of this type.
pub trait Integers {
    /// The storage.
    type In: Storage<Code = Self>;
}

impl Integers for u32 {
    type In = Uint;
}

impl Integers for [u32; 2] {
    type In = Uint2;
}

/// The storage of a row of the list, by its Vulkan format; integers for a code that has none.
macro_rules! storage {
    ($code:ty, None) => {
        <$code as Integers>::In
    };
    ($code:ty, Some("VK_FORMAT_R8G8_SNORM")) => {
        Snorm8x2
    };
    ($code:ty, Some("VK_FORMAT_R16G16_SNORM")) => {
        Snorm16x2
    };
    ($code:ty, Some("VK_FORMAT_R8G8B8_SNORM")) => {
        Snorm8x3
    };
    ($code:ty, Some("VK_FORMAT_A2B10G10R10_SNORM_PACK32")) => {
        Snorm10x3
    };
    ($code:ty, Some("VK_FORMAT_R16G16B16_SNORM")) => {
        Snorm16x3
    };
    ($code:ty, Some("VK_FORMAT_R8G8_UNORM")) => {
        Unorm8x2
    };
    ($code:ty, Some("VK_FORMAT_R16G16_UNORM")) => {
        Unorm16x2
    };
    ($code:ty, Some("VK_FORMAT_R8G8B8_UNORM")) => {
        Unorm8x3
    };
    ($code:ty, Some("VK_FORMAT_R8G8_SINT")) => {
        Sint8x2
    };
    ($code:ty, Some("VK_FORMAT_R16G16_SINT")) => {
        Sint16x2
    };
    ($code:ty, Some("VK_FORMAT_R16G16_SFLOAT")) => {
        Float16x2
    };
    ($code:ty, Some("VK_FORMAT_R16G16B16_SFLOAT")) => {
        Float16x3
    };
}

macro_rules! codecs {
    ($([
        $id:ident $codec:ident $(($by:ident))? = $family:ident::$type:ident $(<$($parameter:tt),*>)?,
        $survey_name:literal, $domain:ident, $format:ident $(($vk_format:tt))?
    ])*) => { $(
        impl Normals for unitvec::$codec {
            type In = storage!(<Self as Codec>::Code, $format $(($vk_format))?);

            fn encode(n: Vec3) -> CodeOf<Self> {
                Self::encode_vec3(n)
            }

            fn decode(code: CodeOf<Self>) -> Vec3 {
                Self::decode_vec3(code)
            }
        }
    )* };
}

for_each_codec!(codecs);

macro_rules! frames {
    ($([$id:ident $codec:ident, $vk_format:literal])*) => { $(
        impl Normals for unitvec::$codec {
            type In = <<Self as FrameCodec>::Code as Integers>::In;

            /// The tangent, the normal's components in another order, is as arbitrary as any.
            fn encode(n: Vec3) -> CodeOf<Self> {
                <Self as FrameCodec>::encode(Frame { normal: n, tangent: Vec3::new(n.y, n.z, n.x), handedness: 1.0 })
            }

            fn decode(code: CodeOf<Self>) -> Vec3 {
                <Self as FrameCodec>::decode(code).normal
            }
        }
    )* };
}

for_each_frame!(frames);

/// The normal itself.
pub struct Float;

impl Normals for Float {
    type In = Float32x3;

    fn encode(n: Vec3) -> Vec3 {
        n
    }

    fn decode(code: Vec3) -> Vec3 {
        code
    }
}

macro_rules! projections {
    ($([$name:ident $storage:ident = $project:expr, $unproject:expr])*) => { $(
        #[doc = concat!("`", stringify!($project), "`, rounded by the hardware.")]
        // Its name is that of its shaders.
        #[allow(non_camel_case_types)]
        pub struct $name;

        impl Normals for $name {
            type In = $storage;

            fn encode(n: Vec3) -> CodeOf<Self> {
                $project(n)
            }

            fn decode(code: CodeOf<Self>) -> Vec3 {
                $unproject(code)
            }
        }
    )* };
}

crate::for_each_projection!(projections);

/// A codec whose codes are stored as integers, though there is a format with their layout. Vulkan promises no device that draws
/// to snorm.
pub struct AsIntegers<C>(PhantomData<C>);

impl<C: Codec<Code: Integers>> Normals for AsIntegers<C> {
    type In = <C::Code as Integers>::In;

    fn encode(n: Vec3) -> C::Code {
        C::encode_vec3(n)
    }

    fn decode(code: C::Code) -> Vec3 {
        C::decode_vec3(code)
    }
}
