//! Storage of a code: a vertex attribute, a component of a colour attachment, a texel.

use spirv_std::Image;
use spirv_std::glam::{IVec2, IVec4, UVec2, UVec4, Vec2, Vec3, Vec4};
use spirv_std::image::Image2d;
use unitvec::formats::*;

/// A texture of signed integers.
pub type Image2dI = Image!(2D, type=i32, sampled);

/// A texture of unsigned integers.
pub type Image2dU = Image!(2D, type=u32, sampled);

/// A texel, and the value written to an attachment.
pub trait Value: Copy {
    /// Type of a texture.
    type Texture;

    /// A texel of a texture.
    fn fetch(texture: &Self::Texture, pixel: UVec2) -> Self;
}

macro_rules! values {
    ($($value:ident of $texture:ident;)*) => { $(
        impl Value for $value {
            type Texture = $texture;

            fn fetch(texture: &$texture, pixel: UVec2) -> $value {
                texture.fetch(pixel)
            }
        }
    )* };
}

values! {
    Vec4 of Image2d;
    IVec4 of Image2dI;
    UVec4 of Image2dU;
}

/// A way to hold codes. The components of a value that it does not need are 0.
pub trait Storage {
    /// The type of code held.
    type Code;
    /// Type of a vertex attribute.
    type Attribute;
    /// Type of a texel, and of the value written to an attachment.
    type Value: Value;

    /// The value of a code.
    fn value_of(code: Self::Code) -> Self::Value;

    /// The code of a value.
    fn code_of(value: Self::Value) -> Self::Code;

    /// The code of a vertex attribute.
    fn code_of_attribute(attribute: Self::Attribute) -> Self::Code;
}

/// Storages: the type of a code, of its value and of an attribute, and the conversions between them.
macro_rules! storages {
    ($(
        $(#[$doc:meta])*
        $name:ident $code_type:ty, $value_type:ty, $attribute_type:ty:
            $code:ident => $value_of:expr, $value:ident => $code_of:expr, $attribute:ident => $code_of_attribute:expr;
    )*) => { $(
        $(#[$doc])*
        pub struct $name;

        impl Storage for $name {
            type Code = $code_type;
            type Attribute = $attribute_type;
            type Value = $value_type;

            fn value_of($code: $code_type) -> $value_type {
                $value_of
            }

            fn code_of($value: $value_type) -> $code_type {
                $code_of
            }

            fn code_of_attribute($attribute: $attribute_type) -> $code_type {
                $code_of_attribute
            }
        }
    )* };
}

/// Storages of floats: the type of a code, and the conversions between it and a value, which an attribute is as well.
macro_rules! float_storages {
    ($($(#[$doc:meta])* $name:ident $type:ty: $code:ident => $value_of:expr, $value:ident => $code_of:expr;)*) => {
        storages! { $(
            $(#[$doc])*
            $name $type, Vec4, Vec4: $code => $value_of, $value => $code_of, attribute => Self::code_of(attribute);
        )* }
    };
}

fn xy(value: Vec4) -> Vec2 {
    Vec2::new(value.x, value.y)
}

float_storages! {
    /// R8G8_SNORM.
    Snorm8x2 u32: code => code_to_snorm8x2(code).extend(0.0).extend(0.0), value => snorm8x2_to_code(xy(value));
    /// R16G16_SNORM.
    Snorm16x2 u32: code => code_to_snorm16x2(code).extend(0.0).extend(0.0), value => snorm16x2_to_code(xy(value));
    /// R8G8B8A8_SNORM, or with three components.
    Snorm8x3 u32: code => code_to_snorm8x3(code).extend(0.0), value => snorm8x3_to_code(value.truncate());
    /// A2B10G10R10_SNORM_PACK32.
    Snorm10x3 u32: code => code_to_snorm10x3(code).extend(0.0), value => snorm10x3_to_code(value.truncate());
    /// R16G16B16A16_SNORM, or with three components.
    Snorm16x3 [u32; 2]: code => code_to_snorm16x3(code).extend(0.0), value => snorm16x3_to_code(value.truncate());
    /// R8G8_UNORM.
    Unorm8x2 u32: code => code_to_unorm8x2(code).extend(0.0).extend(0.0), value => unorm8x2_to_code(xy(value));
    /// R16G16_UNORM.
    Unorm16x2 u32: code => code_to_unorm16x2(code).extend(0.0).extend(0.0), value => unorm16x2_to_code(xy(value));
    /// R8G8B8A8_UNORM, or with three components.
    Unorm8x3 u32: code => code_to_unorm8x3(code).extend(0.0), value => unorm8x3_to_code(value.truncate());
    /// R16G16_SFLOAT.
    Float16x2 u32: code => code_to_float16x2(code).extend(0.0).extend(0.0), value => float16x2_to_code(xy(value));
    /// R16G16B16A16_SFLOAT, or with three components.
    Float16x3 [u32; 2]: code => code_to_float16x3(code).extend(0.0), value => float16x3_to_code(value.truncate());
    /// Two numbers that the hardware rounds, in any format of floats, SNORM or UNORM.
    Pair Vec2: code => code.extend(0.0).extend(0.0), value => xy(value);
    /// Two numbers that the hardware rounds, and 0 or 1 in alpha, which may have few bits.
    PairAndBit Vec3:
        code => Vec4::new(code.x, code.y, 0.0, code.z), value => Vec3::new(value.x, value.y, value.w);
    /// R32G32B32A32_SFLOAT: the normal itself.
    Float32x3 Vec3: code => code.extend(0.0), value => value.truncate();
}

storages! {
    /// R8G8_SINT.
    Sint8x2 u32, IVec4, IVec2:
        code => code_to_sint8x2(code).extend(0).extend(0), value => sint8x2_to_code(IVec2::new(value.x, value.y)),
        attribute => sint8x2_to_code(attribute);
    /// R16G16_SINT.
    Sint16x2 u32, IVec4, IVec2:
        code => code_to_sint16x2(code).extend(0).extend(0), value => sint16x2_to_code(IVec2::new(value.x, value.y)),
        attribute => sint16x2_to_code(attribute);
    /// R32_UINT.
    Uint u32, UVec4, u32:
        code => UVec4::new(code, 0, 0, 0), value => value.x, attribute => attribute;
    /// R32G32_UINT.
    Uint2 [u32; 2], UVec4, UVec2:
        code => UVec4::new(code[0], code[1], 0, 0), value => [value.x, value.y], attribute => [attribute.x, attribute.y];
}
