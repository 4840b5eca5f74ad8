//! The arithmetic that the codecs share. Results are the same on every target.

/// Declares the coefficients of polynomials, lowest power first: the first of each is documented, the others refer to it.
macro_rules! coefficients {
    ($($(#[$doc:meta])* $vis:vis $first:ident = $value:expr $(, $name:ident = $other:expr)*;)*) => { $(
        $(#[$doc])*
        #[doc(hidden)]
        $vis const $first: f32 = $value;
        $(
            #[doc(hidden)]
            $vis const $name: f32 = $other;
        )*
    )* };
}
pub(crate) use coefficients;

#[cfg(all(any(not(feature = "std"), test), not(target_arch = "spirv")))]
mod bare;
mod diamond;
mod divide;
mod elementary;
#[cfg(any(test, target_arch = "spirv"))]
mod exact;
mod face;
#[cfg(not(target_arch = "spirv"))]
mod four;
mod half;
mod pack;
mod round;
mod scale;
mod sign;
mod snorm;
mod trig;
mod two_float;
mod vector;

pub use diamond::{UNWARP_0, UNWARP_1, UNWARP_2, WARP_0, WARP_1, WARP_2};
pub(crate) use diamond::{diamond_code, diamond_error, diamond_point};
pub use divide::{inverse_root, over, quotient, ratio, reciprocal, root, signed_quotient};
pub(crate) use divide::{inverse_root_near, snorm_quotient};
use elementary::sqrt;
pub use elementary::{floor, max, min};
pub use face::{face_of, from_face, to_face};
#[cfg(not(target_arch = "spirv"))]
pub(crate) use four::Four;
#[cfg(target_arch = "spirv")]
pub(crate) use glam::Vec4 as Four;
pub use half::{HALF_MAX, HALF_ONE, half_decode, half_decode_magnitude, half_encode, half_encode_magnitude};
pub(crate) use pack::signed_integer_field;
pub use pack::{mask, nearest_code, nearest_pair, signed_code, signed_integer, signed_integer_at};
pub use round::whole_to_u32;
pub(crate) use round::{ONE_AND_A_HALF_2_23, TWO_23, integer_part, nearest_whole, small_floor, whole_to_i32};
pub use scale::{ENORMOUS, NEGLIGIBLE, is_within};
pub(crate) use scale::{
    LEAST_X, LEAST_Y, exp2, scale_to_one, scaled_to_one, without_denormal, without_denormals,
};
pub(crate) use sign::{SIGN_BIT, flip_sign};
pub use sign::{is_negative, negate_if, negate_positive, with_sign};
pub use snorm::{
    SnormDivision, snorm_code, snorm_decode, snorm_encode, snorm_integer, snorm_integers, snorm_max,
    unorm_code, unorm_decode, unorm_encode, unorm_max,
};
pub(crate) use snorm::{biased, is_nan, is_set, snorm_clamp, unbiased};
pub use trig::*;
pub(crate) use two_float::{Coordinate, coordinate, normalize_parts, product_rest, two_sum};
pub use vector::{dot, horizontal_length, normalize};
pub(crate) use vector::{hypotenuse_bound, normalize_octahedral};
