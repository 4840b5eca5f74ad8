//! The shaders of the deferred renderer, over every codec: a geometry pass that stores normals as codes and a lighting pass that
//! reads them. `../glsl` has the same in GLSL. Both keep to operations that round the same everywhere, in the same order, so
//! that their pictures are equal to the bit.
//!
//! Entry points are functions `vertex`, `gbuffer` and `light` in a module of the codec's identifier, as in `unitvec`'s own
//! kernels: the build names them `oct16_vertex` and so on.

#![no_std]

#[cfg(feature = "gbuffer")]
pub mod gbuffer;
#[cfg(any(feature = "vertex", feature = "gbuffer"))]
pub mod geometry;
#[cfg(any(feature = "gbuffer", feature = "light"))]
pub mod key;
#[cfg(feature = "light")]
pub mod light;
pub mod normals;
#[cfg(any(feature = "gbuffer", feature = "light"))]
pub mod pixel;
#[cfg(feature = "light")]
pub mod shading;
pub mod storage;
#[cfg(feature = "vertex")]
pub mod vertex;

/// A flag of both passes: normals are the points of a conformance run, not to be rotated, normalised or lit.
pub const RAW: u32 = 1;

/// Calls a macro of this crate, which takes an identifier and an implementation of [`Normals`](normals::Normals), for
/// each. The first argument is a dollar sign, which one macro cannot write for another.
macro_rules! for_all_normals {
    ($d:tt $callback:ident) => {
        macro_rules! rows {
            ($d([$d id:ident $d codec:ident $d($d rest:tt)*])*) => { $d($callback!($d id unitvec::$d codec);)* };
        }
        unitvec::for_each_codec!(rows);
        unitvec::for_each_frame!(rows);
        $callback!(float crate::normals::Float);
        $callback!(oct_snorm crate::normals::OctSnorm);
        $callback!(oct_unorm crate::normals::OctUnorm);
        $callback!(oct16p_snorm crate::normals::OctPrecise16Snorm);
        $callback!(oct32p_snorm crate::normals::OctPrecise32Snorm);
        $callback!(hemioct_snorm crate::normals::HemiOctSnorm);
        $callback!(hemioct_unorm crate::normals::HemiOctUnorm);
        $callback!(eaoct_snorm crate::normals::EaOctSnorm);
        $callback!(eaoct_unorm crate::normals::EaOctUnorm);
        $callback!(eaoct16p_snorm crate::normals::EaOctPrecise16Snorm);
        $callback!(eaoct32p_snorm crate::normals::EaOctPrecise32Snorm);
        $callback!(spherical_snorm crate::normals::SphericalSnorm);
        $callback!(spherical_unorm crate::normals::SphericalUnorm);
        $callback!(cylindrical_snorm crate::normals::CylindricalSnorm);
        $callback!(cylindrical_unorm crate::normals::CylindricalUnorm);
        $callback!(soct_snorm crate::normals::SOctSnorm);
        $callback!(soct_unorm crate::normals::SOctUnorm);
        $callback!(eqarea_ellipse_snorm crate::normals::EqareaEllipseSnorm);
        $callback!(eqarea_ellipse_unorm crate::normals::EqareaEllipseUnorm);
        // Codecs with an snorm format, as integers.
        $callback!(oct16_uint crate::normals::AsIntegers<unitvec::Oct16>);
        $callback!(oct16p_uint crate::normals::AsIntegers<unitvec::OctPrecise16>);
        $callback!(oct32_uint crate::normals::AsIntegers<unitvec::Oct32>);
        $callback!(oct32p_uint crate::normals::AsIntegers<unitvec::OctPrecise32>);
        $callback!(hemioct16_uint crate::normals::AsIntegers<unitvec::HemiOct16>);
        $callback!(hemioct32_uint crate::normals::AsIntegers<unitvec::HemiOct32>);
        $callback!(eaoct16_uint crate::normals::AsIntegers<unitvec::EaOct16>);
        $callback!(eaoct16p_uint crate::normals::AsIntegers<unitvec::EaOctPrecise16>);
        $callback!(eaoct32_uint crate::normals::AsIntegers<unitvec::EaOct32>);
        $callback!(eaoct32p_uint crate::normals::AsIntegers<unitvec::EaOctPrecise32>);
        $callback!(cylindrical16_uint crate::normals::AsIntegers<unitvec::Cylindrical16>);
        $callback!(cylindrical32_uint crate::normals::AsIntegers<unitvec::Cylindrical32>);
        $callback!(snorm8x3p_uint crate::normals::AsIntegers<unitvec::SnormBest8>);
        $callback!(snorm8x3_nearest_uint crate::normals::AsIntegers<unitvec::SnormNearest8>);
        $callback!(snorm16x3p_uint crate::normals::AsIntegers<unitvec::SnormBest16>);
        $callback!(crytek_bfn24_uint crate::normals::AsIntegers<unitvec::CrytekBfn24>);
        $callback!(snorm8x3_uint crate::normals::AsIntegers<unitvec::Snorm8x3>);
        $callback!(snorm10x3_uint crate::normals::AsIntegers<unitvec::Snorm10x3>);
        $callback!(snorm16x3_uint crate::normals::AsIntegers<unitvec::Snorm16x3>);
        $callback!(xyonly16_uint crate::normals::AsIntegers<unitvec::XyOnly16>);
        $callback!(xyonly32_uint crate::normals::AsIntegers<unitvec::XyOnly32>);
    };
}
use for_all_normals;

/// Calls a macro of this crate for the codecs whose dithered functions have shaders.
#[cfg(any(feature = "gbuffer", feature = "light"))]
macro_rules! for_all_dithered {
    ($callback:ident) => {
        $callback!(oct16_dithered crate::normals::AsIntegers<unitvec::Oct16>);
        $callback!(oct16p_dithered crate::normals::AsIntegers<unitvec::OctPrecise16>);
        $callback!(oct24_dithered crate::normals::AsIntegers<unitvec::Oct24>);
        $callback!(oct24p_dithered crate::normals::AsIntegers<unitvec::OctPrecise24>);
        $callback!(hemioct16_dithered crate::normals::AsIntegers<unitvec::HemiOct16>);
        $callback!(soct17_dithered crate::normals::AsIntegers<unitvec::SOct17>);
        $callback!(eaoct16_dithered crate::normals::AsIntegers<unitvec::EaOct16>);
        $callback!(eaoct16p_dithered crate::normals::AsIntegers<unitvec::EaOctPrecise16>);
    };
}
#[cfg(any(feature = "gbuffer", feature = "light"))]
use for_all_dithered;
