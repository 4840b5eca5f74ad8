//! The shaders of the deferred renderer, over every codec: a geometry pass that stores normals as codes and a lighting pass that
//! reads them. `../glsl` has the same in GLSL. Both keep to operations that round the same everywhere, in the same order, so
//! that their pictures are equal to the bit.
//!
//! Entry points are functions `vertex`, `gbuffer` and `light` in a module of the codec's identifier, as in `unitvec`'s own
//! kernels: the build names them `oct16_vertex` and so on. Those that store codes as integers are `uint_vertex` and so on.

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
#[cfg(feature = "light")]
pub mod shading;
pub mod storage;
#[cfg(feature = "vertex")]
pub mod vertex;

/// A flag of both passes: normals are the points of a conformance run, not to be rotated, normalised or lit.
pub const RAW: u32 = 1;

/// Calls a macro with a row for each projection, whose numbers the hardware rounds: the name of its shaders, its storage and its
/// functions, which are those of [`normals`]'s imports.
macro_rules! for_each_projection {
    ($callback:ident) => {
        $callback! {
            [oct_snorm Pair = oct::project, oct::unproject]
            [oct_unorm Pair = oct::project_unorm, oct::unproject_unorm]
            [oct16p_snorm Pair = oct::project_precise::<16>, oct::unproject]
            [oct32p_snorm Pair = oct::project_precise::<32>, oct::unproject]
            [hemioct_snorm Pair = hemioct::project, hemioct::unproject]
            [hemioct_unorm Pair = hemioct::project_unorm, hemioct::unproject_unorm]
            [hemioct16p_snorm Pair = hemioct::project_precise::<16>, hemioct::unproject]
            [hemioct32p_snorm Pair = hemioct::project_precise::<32>, hemioct::unproject]
            [eaoct_snorm Pair = eaoct::project, eaoct::unproject]
            [eaoct_unorm Pair = eaoct::project_unorm, eaoct::unproject_unorm]
            [eaoct16p_snorm Pair = eaoct::project_precise::<16>, eaoct::unproject]
            [eaoct32p_snorm Pair = eaoct::project_precise::<32>, eaoct::unproject]
            [spherical_snorm Pair = spherical::project, spherical::unproject]
            [spherical_unorm Pair = spherical::project_unorm, spherical::unproject_unorm]
            [cylindrical_snorm Pair = cylindrical::project, cylindrical::unproject]
            [cylindrical_unorm Pair = cylindrical::project_unorm, cylindrical::unproject_unorm]
            [soct_snorm PairAndBit = soct::project, soct::unproject]
            [soct_unorm PairAndBit = soct::project_unorm, soct::unproject_unorm]
            [eqarea_ellipse_snorm PairAndBit = azimuthal::project::<Eqarea, Ellipse>, azimuthal::unproject::<Eqarea, Ellipse>]
            [eqarea_ellipse_unorm PairAndBit = azimuthal::project_unorm::<Eqarea, Ellipse>, azimuthal::unproject_unorm::<Eqarea, Ellipse>]
        }
    };
}
use for_each_projection;

/// Expands to its items for a row of the list whose format is SNORM, or UNORM of 16 bits: Vulkan promises no device that draws
/// to one, so that such a codec has shaders that store its codes as integers as well.
macro_rules! if_snorm {
    (Some("VK_FORMAT_R8G8_SNORM") $($item:tt)*) => { $($item)* };
    (Some("VK_FORMAT_R16G16_SNORM") $($item:tt)*) => { $($item)* };
    (Some("VK_FORMAT_R16G16_UNORM") $($item:tt)*) => { $($item)* };
    (Some("VK_FORMAT_R8G8B8_SNORM") $($item:tt)*) => { $($item)* };
    (Some("VK_FORMAT_R16G16B16_SNORM") $($item:tt)*) => { $($item)* };
    (Some("VK_FORMAT_A2B10G10R10_SNORM_PACK32") $($item:tt)*) => { $($item)* };
    ($other:ident $(($vk_format:tt))? $callback:ident!$arguments:tt;) => {};
}
use if_snorm;

/// Calls a macro of this crate for all normals, with the module and the name of the shader, and an implementation of
/// [`Normals`](normals::Normals). `$uint` is the shader's name where codes are integers. The first argument is a dollar sign,
/// which one macro cannot write for another.
macro_rules! for_all_normals {
    ($d:tt $callback:ident $uint:ident) => {
        macro_rules! rows {
            ($d([$d id:ident $d codec:ident $d($d rest:tt)*])*) => {
                $d($callback!($d id $callback unitvec::$d codec);)*
            };
        }
        unitvec::for_each_codec!(rows);
        unitvec::for_each_frame!(rows);
        macro_rules! projected {
            ($d([$d id:ident $d($d rest:tt)*])*) => { $d($callback!($d id $callback crate::normals::$d id);)* };
        }
        crate::for_each_projection!(projected);
        $callback!(float $callback crate::normals::Float);

        /// The codecs whose codes are stored as integers though they have a format.
        pub mod integers {
            use super::*;

            macro_rules! rows {
                ($d([
                    $d id:ident $d codec:ident $d(($d by:ident))? = $d family:ident::$d type:ident $d(<$d($d parameter:tt),*>)?,
                    $d name:literal, $d domain:ident, $d format:ident $d(($d vk_format:tt))?
                ])*) => { $d(
                    crate::if_snorm! {
                        $d format $d(($d vk_format))?
                        $callback!($d id $uint crate::normals::AsIntegers<unitvec::$d codec>);
                    }
                )* };
            }
            unitvec::for_each_codec!(rows);
        }
    };
}
use for_all_normals;

/// Calls a macro of this crate for the codecs whose dithered functions have shaders.
#[cfg(any(feature = "gbuffer", feature = "light"))]
macro_rules! for_all_dithered {
    ($callback:ident) => {
        $callback!(oct16_dithered unitvec::Oct16);
        $callback!(oct16p_dithered unitvec::OctPrecise16);
        $callback!(oct24_dithered unitvec::Oct24);
        $callback!(oct24p_dithered unitvec::OctPrecise24);
        $callback!(hemioct16_dithered unitvec::HemiOct16);
        $callback!(soct17_dithered unitvec::SOct17);
        $callback!(eaoct16_dithered unitvec::EaOct16);
        $callback!(eaoct16p_dithered unitvec::EaOctPrecise16);
    };
}
#[cfg(any(feature = "gbuffer", feature = "light"))]
use for_all_dithered;
