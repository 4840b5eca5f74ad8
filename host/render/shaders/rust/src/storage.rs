//! Storage of a code: a vertex attribute, a component of a colour attachment, a texel.

use spirv_std::Image;
use spirv_std::glam::{IVec2, IVec4, UVec2, UVec4, Vec2, Vec3, Vec4};
use spirv_std::image::Image2d;
use unitvec::formats::*;

/// A texture of signed integers.
pub type Image2dI = Image!(2D, type=i32, sampled);

/// A texture of unsigned integers.
pub type Image2dU = Image!(2D, type=u32, sampled);

/// A way to hold codes. The components of a value that it does not need are 0.
pub trait Storage {
    /// The type of code held.
    type Code;
    /// Type of a vertex attribute.
    type Attribute;
    /// Type of a texel, and of the value written to an attachment.
    type Value: Copy;
    /// Type of a texture.
    type Texture;

    /// The value of a code.
    fn value_of(code: Self::Code) -> Self::Value;

    /// The code of a value.
    fn code_of(value: Self::Value) -> Self::Code;

    /// The code of a vertex attribute.
    fn code_of_attribute(attribute: Self::Attribute) -> Self::Code;

    /// A texel of a texture.
    fn fetch(texture: &Self::Texture, pixel: UVec2) -> Self::Value;
}

/// Storages of floats: of the name of each, its code and the functions that convert, `xy` or `xyz` of the value.
macro_rules! float_storages {
    (@value $value:expr, xy) => { $value.extend(0.0).extend(0.0) };
    (@value $value:expr, xyz) => { $value.extend(0.0) };
    (@part $value:expr, xy) => { Vec2::new($value.x, $value.y) };
    (@part $value:expr, xyz) => { $value.truncate() };
    ($($(#[$doc:meta])* $name:ident $code:ty: $value_of:ident $code_of:ident $part:ident;)*) => { $(
        $(#[$doc])*
        pub struct $name;

        impl Storage for $name {
            type Code = $code;
            type Attribute = Vec4;
            type Value = Vec4;
            type Texture = Image2d;

            fn value_of(code: $code) -> Vec4 {
                float_storages!(@value $value_of(code), $part)
            }

            fn code_of(value: Vec4) -> $code {
                $code_of(float_storages!(@part value, $part))
            }

            fn code_of_attribute(attribute: Vec4) -> $code {
                Self::code_of(attribute)
            }

            fn fetch(texture: &Image2d, pixel: UVec2) -> Vec4 {
                texture.fetch(pixel)
            }
        }
    )* };
}

float_storages! {
    /// R8G8_SNORM.
    Snorm8x2 u32: code_to_snorm8x2 snorm8x2_to_code xy;
    /// R16G16_SNORM.
    Snorm16x2 u32: code_to_snorm16x2 snorm16x2_to_code xy;
    /// R8G8B8A8_SNORM, or with three components.
    Snorm8x3 u32: code_to_snorm8x3 snorm8x3_to_code xyz;
    /// A2B10G10R10_SNORM_PACK32.
    Snorm10x3 u32: code_to_snorm10x3 snorm10x3_to_code xyz;
    /// R16G16B16A16_SNORM, or with three components.
    Snorm16x3 [u32; 2]: code_to_snorm16x3 snorm16x3_to_code xyz;
    /// R8G8B8A8_UNORM, or with three components.
    Unorm8x3 u32: code_to_unorm8x3 unorm8x3_to_code xyz;
    /// R16G16_SFLOAT.
    Float16x2 u32: code_to_float16x2 float16x2_to_code xy;
    /// R16G16B16A16_SFLOAT, or with three components.
    Float16x3 [u32; 2]: code_to_float16x3 float16x3_to_code xyz;
}

/// Storages of two signed integers.
macro_rules! sint_storages {
    ($($(#[$doc:meta])* $name:ident: $value_of:ident $code_of:ident;)*) => { $(
        $(#[$doc])*
        pub struct $name;

        impl Storage for $name {
            type Code = u32;
            type Attribute = IVec2;
            type Value = IVec4;
            type Texture = Image2dI;

            fn value_of(code: u32) -> IVec4 {
                $value_of(code).extend(0).extend(0)
            }

            fn code_of(value: IVec4) -> u32 {
                $code_of(IVec2::new(value.x, value.y))
            }

            fn code_of_attribute(attribute: IVec2) -> u32 {
                $code_of(attribute)
            }

            fn fetch(texture: &Image2dI, pixel: UVec2) -> IVec4 {
                texture.fetch(pixel)
            }
        }
    )* };
}

sint_storages! {
    /// R8G8_SINT.
    Sint8x2: code_to_sint8x2 sint8x2_to_code;
    /// R16G16_SINT.
    Sint16x2: code_to_sint16x2 sint16x2_to_code;
}

/// R32_UINT.
pub struct Uint;

impl Storage for Uint {
    type Code = u32;
    type Attribute = u32;
    type Value = UVec4;
    type Texture = Image2dU;

    fn value_of(code: u32) -> UVec4 {
        UVec4::new(code, 0, 0, 0)
    }

    fn code_of(value: UVec4) -> u32 {
        value.x
    }

    fn code_of_attribute(attribute: u32) -> u32 {
        attribute
    }

    fn fetch(texture: &Image2dU, pixel: UVec2) -> UVec4 {
        texture.fetch(pixel)
    }
}

/// R32G32_UINT.
pub struct Uint2;

impl Storage for Uint2 {
    type Code = [u32; 2];
    type Attribute = UVec2;
    type Value = UVec4;
    type Texture = Image2dU;

    fn value_of([low, high]: [u32; 2]) -> UVec4 {
        UVec4::new(low, high, 0, 0)
    }

    fn code_of(value: UVec4) -> [u32; 2] {
        [value.x, value.y]
    }

    fn code_of_attribute(attribute: UVec2) -> [u32; 2] {
        [attribute.x, attribute.y]
    }

    fn fetch(texture: &Image2dU, pixel: UVec2) -> UVec4 {
        texture.fetch(pixel)
    }
}

/// Two numbers that the hardware rounds, in any format of floats, SNORM or UNORM.
pub struct Pair;

impl Storage for Pair {
    type Code = Vec2;
    type Attribute = Vec4;
    type Value = Vec4;
    type Texture = Image2d;

    fn value_of(code: Vec2) -> Vec4 {
        code.extend(0.0).extend(0.0)
    }

    fn code_of(value: Vec4) -> Vec2 {
        Vec2::new(value.x, value.y)
    }

    fn code_of_attribute(attribute: Vec4) -> Vec2 {
        Self::code_of(attribute)
    }

    fn fetch(texture: &Image2d, pixel: UVec2) -> Vec4 {
        texture.fetch(pixel)
    }
}

/// Two numbers that the hardware rounds, and 0 or 1 in alpha, which may have few bits.
pub struct PairAndBit;

impl Storage for PairAndBit {
    type Code = Vec3;
    type Attribute = Vec4;
    type Value = Vec4;
    type Texture = Image2d;

    fn value_of(code: Vec3) -> Vec4 {
        Vec4::new(code.x, code.y, 0.0, code.z)
    }

    fn code_of(value: Vec4) -> Vec3 {
        Vec3::new(value.x, value.y, value.w)
    }

    fn code_of_attribute(attribute: Vec4) -> Vec3 {
        Self::code_of(attribute)
    }

    fn fetch(texture: &Image2d, pixel: UVec2) -> Vec4 {
        texture.fetch(pixel)
    }
}

/// R32G32B32A32_SFLOAT: the normal itself.
pub struct Float32x3;

impl Storage for Float32x3 {
    type Code = Vec3;
    type Attribute = Vec4;
    type Value = Vec4;
    type Texture = Image2d;

    fn value_of(code: Vec3) -> Vec4 {
        code.extend(0.0)
    }

    fn code_of(value: Vec4) -> Vec3 {
        value.truncate()
    }

    fn code_of_attribute(attribute: Vec4) -> Vec3 {
        attribute.truncate()
    }

    fn fetch(texture: &Image2d, pixel: UVec2) -> Vec4 {
        texture.fetch(pixel)
    }
}
