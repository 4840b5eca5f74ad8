//! The list of all codecs: one row a codec. Kernels, the catalogue, the oracle's dispatch, benches and tests are made from
//! it, or compared with it by a test.
//!
//! A row is
//!
//! ```text
//! [oct16p OctPrecise16 = oct::OctPrecise<16>, "oct16P", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
//! ```
//!
//! * the identifier, as in the `unitvec` program, the SPIR-V entry points (`oct16p_encode`) and the GLSL functions;
//! * the name of the Rust type that this module defines as the one on the right of `=`;
//! * the module of the codec's family, which is also the name of its GLSL file, and the codec's type in it;
//! * the survey's name, or a name in the same style for codecs that are not in the survey;
//! * the [`Domain`];
//! * the Vulkan format that has the code's layout, if there is one.
//!
//! `(by_table)` after the name marks codecs that implement [`EncodeByTable`](crate::best_fit::EncodeByTable).

use crate::azimuthal::{Concentric, Ellipse, Eqarea, Eqdist, Plain, Stereo};
use crate::codec::{Codec, Domain, Width};
use crate::frame::FrameCodec;
use crate::quat::RotationCodec;

/// Calls the macro `callback` with the rows of all codecs of vectors, by family and width.
///
/// A callback that needs the first names only matches
/// `$([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*`.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_codec {
    ($callback:ident) => {
        $callback! {
            [oct8 Oct8 = oct::Oct<8>, "oct8", Sphere, None]
            [oct8p OctPrecise8 = oct::OctPrecise<8>, "oct8P", Sphere, None]
            [oct12 Oct12 = oct::Oct<12>, "oct12", Sphere, None]
            [oct12p OctPrecise12 = oct::OctPrecise<12>, "oct12P", Sphere, None]
            [oct16 Oct16 = oct::Oct<16>, "oct16", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
            [oct16p OctPrecise16 = oct::OctPrecise<16>, "oct16P", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
            [oct18 Oct18 = oct::Oct<18>, "oct18", Sphere, None]
            [oct18p OctPrecise18 = oct::OctPrecise<18>, "oct18P", Sphere, None]
            [oct20 Oct20 = oct::Oct<20>, "oct20", Sphere, None]
            [oct20p OctPrecise20 = oct::OctPrecise<20>, "oct20P", Sphere, None]
            [oct22 Oct22 = oct::Oct<22>, "oct22", Sphere, None]
            [oct22p OctPrecise22 = oct::OctPrecise<22>, "oct22P", Sphere, None]
            [oct24 Oct24 = oct::Oct<24>, "oct24", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")]
            [oct24p OctPrecise24 = oct::OctPrecise<24>, "oct24P", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")]
            [oct32 Oct32 = oct::Oct<32>, "oct32", Sphere, Some("VK_FORMAT_R16G16_SNORM")]
            [oct32p OctPrecise32 = oct::OctPrecise<32>, "oct32P", Sphere, Some("VK_FORMAT_R16G16_SNORM")]
            [hemioct16 HemiOct16 = hemioct::HemiOct<16>, "HemiOct16", Hemisphere, Some("VK_FORMAT_R8G8_SNORM")]
            [hemioct16p HemiOctPrecise16 = hemioct::HemiOctPrecise<16>, "HemiOct16P", Hemisphere, Some("VK_FORMAT_R8G8_SNORM")]
            [hemioct24 HemiOct24 = hemioct::HemiOct<24>, "HemiOct24", Hemisphere, None]
            [hemioct24p HemiOctPrecise24 = hemioct::HemiOctPrecise<24>, "HemiOct24P", Hemisphere, None]
            [hemioct32 HemiOct32 = hemioct::HemiOct<32>, "HemiOct32", Hemisphere, Some("VK_FORMAT_R16G16_SNORM")]
            [hemioct32p HemiOctPrecise32 = hemioct::HemiOctPrecise<32>, "HemiOct32P", Hemisphere, Some("VK_FORMAT_R16G16_SNORM")]
            [uoct16p UOctPrecise16 = uoct::UOctPrecise<16>, "uoct16P", Sphere, Some("VK_FORMAT_R8G8_UNORM")]
            [uoct20p UOctPrecise20 = uoct::UOctPrecise<20>, "uoct20P", Sphere, None]
            [uoct24p UOctPrecise24 = uoct::UOctPrecise<24>, "uoct24P", Sphere, None]
            [uoct32p UOctPrecise32 = uoct::UOctPrecise<32>, "uoct32P", Sphere, Some("VK_FORMAT_R16G16_UNORM")]
            [eaoct16 EaOct16 = eaoct::EaOct<16>, "eaoct16", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
            [eaoct16p EaOctPrecise16 = eaoct::EaOctPrecise<16>, "eaoct16P", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
            [eaoct20 EaOct20 = eaoct::EaOct<20>, "eaoct20", Sphere, None]
            [eaoct20p EaOctPrecise20 = eaoct::EaOctPrecise<20>, "eaoct20P", Sphere, None]
            [eaoct22 EaOct22 = eaoct::EaOct<22>, "eaoct22", Sphere, None]
            [eaoct22p EaOctPrecise22 = eaoct::EaOctPrecise<22>, "eaoct22P", Sphere, None]
            [eaoct24 EaOct24 = eaoct::EaOct<24>, "eaoct24", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")]
            [eaoct24p EaOctPrecise24 = eaoct::EaOctPrecise<24>, "eaoct24P", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")]
            [eaoct32 EaOct32 = eaoct::EaOct<32>, "eaoct32", Sphere, Some("VK_FORMAT_R16G16_SNORM")]
            [eaoct32p EaOctPrecise32 = eaoct::EaOctPrecise<32>, "eaoct32P", Sphere, Some("VK_FORMAT_R16G16_SNORM")]
            [soct17 SOct17 = soct::SOct<17>, "soct17", Sphere, None]
            [soct25 SOct25 = soct::SOct<25>, "soct25", Sphere, None]
            [soct33 SOct33 = soct::SOct<33, [u32; 2]>, "soct33", Sphere, None]
            [oct48 Oct48 = oct_wide::OctWide<48>, "oct48", Sphere, None]
            [oct48p OctPrecise48 = oct_wide::OctWidePrecise<48>, "oct48P", Sphere, None]
            [oct52p OctPrecise52 = oct_wide::OctWidePrecise<52>, "oct52P", Sphere, None]
            [spherical16 Spherical16 = spherical::Spherical<16>, "spherical16", Sphere, Some("VK_FORMAT_R8G8_SINT")]
            [spherical20 Spherical20 = spherical::Spherical<20>, "spherical20", Sphere, None]
            [spherical22 Spherical22 = spherical::Spherical<22>, "spherical22", Sphere, None]
            [spherical24 Spherical24 = spherical::Spherical<24>, "spherical24", Sphere, None]
            [spherical32 Spherical32 = spherical::Spherical<32>, "spherical32", Sphere, Some("VK_FORMAT_R16G16_SINT")]
            [spherical48 Spherical48 = spherical_wide::SphericalWide, "spherical48", Sphere, None]
            [cylindrical16 Cylindrical16 = cylindrical::Cylindrical<16>, "cylindrical16", Sphere, Some("VK_FORMAT_R8G8_SNORM")]
            [cylindrical24 Cylindrical24 = cylindrical::Cylindrical<24>, "cylindrical24", Sphere, None]
            [cylindrical32 Cylindrical32 = cylindrical::Cylindrical<32>, "cylindrical32", Sphere, Some("VK_FORMAT_R16G16_SNORM")]
            [latlong16 LatLong16 = latlong::LatLong<16>, "latlong16", Sphere, None]
            [latlong24 LatLong24 = latlong::LatLong<24>, "latlong24", Sphere, None]
            [latlong32 LatLong32 = latlong::LatLong<32>, "latlong32", Sphere, None]
            [latlong16d LatLongD16 = latlong::LatLongD<16>, "latlong16D", Sphere, None]
            [latlong24d LatLongD24 = latlong::LatLongD<24>, "latlong24D", Sphere, None]
            [latlong32d LatLongD32 = latlong::LatLongD<32>, "latlong32D", Sphere, None]
            [fib16 Fib16 = fib::Fib<16>, "fib16", Sphere, None]
            [fib24 Fib24 = fib::Fib<24>, "fib24", Sphere, None]
            [fib32 Fib32 = fib::Fib<32>, "fib32", Sphere, None]
            [hexcube16 HexCube16 = hexcube::HexCube<16>, "hexcube16", Sphere, None]
            [hexcube24 HexCube24 = hexcube::HexCube<24>, "hexcube24", Sphere, None]
            [hexcube32 HexCube32 = hexcube::HexCube<32>, "hexcube32", Sphere, None]
            [ico16 Ico16 = ico::Ico<16>, "ico16", Sphere, None]
            [ico24 Ico24 = ico::Ico<24>, "ico24", Sphere, None]
            [ico32 Ico32 = ico::Ico<32>, "ico32", Sphere, None]
            [snorm8x3p SnormBest8 (by_table) = best_fit::SnormBest8, "snorm8x3P", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")]
            [snorm8x3_nearest SnormNearest8 = best_fit::SnormNearest8, "snorm8x3Nearest", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")]
            [snorm16x3p SnormBest16 = best_fit::SnormBest16, "snorm16x3P", Sphere, Some("VK_FORMAT_R16G16B16_SNORM")]
            [crytek_bfn24 CrytekBfn24 (by_table) = best_fit::CrytekBfn24, "CrytekBFN24", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")]
            [stereo16 Stereo16 = azimuthal::Azimuthal<Stereo, Plain, 16>, "stereo16", Sphere, None]
            [stereo20 Stereo20 = azimuthal::Azimuthal<Stereo, Plain, 20>, "stereo20", Sphere, None]
            [stereo22 Stereo22 = azimuthal::Azimuthal<Stereo, Plain, 22>, "stereo22", Sphere, None]
            [stereo24 Stereo24 = azimuthal::Azimuthal<Stereo, Plain, 24>, "stereo24", Sphere, None]
            [stereo32 Stereo32 = azimuthal::Azimuthal<Stereo, Plain, 32>, "stereo32", Sphere, None]
            [stereo_concentric16 StereoConcentric16 = azimuthal::Azimuthal<Stereo, Concentric, 16>, "stereo+concentric16", Sphere, None]
            [stereo_concentric20 StereoConcentric20 = azimuthal::Azimuthal<Stereo, Concentric, 20>, "stereo+concentric20", Sphere, None]
            [stereo_concentric22 StereoConcentric22 = azimuthal::Azimuthal<Stereo, Concentric, 22>, "stereo+concentric22", Sphere, None]
            [stereo_concentric24 StereoConcentric24 = azimuthal::Azimuthal<Stereo, Concentric, 24>, "stereo+concentric24", Sphere, None]
            [stereo_concentric32 StereoConcentric32 = azimuthal::Azimuthal<Stereo, Concentric, 32>, "stereo+concentric32", Sphere, None]
            [stereo_ellipse16 StereoEllipse16 = azimuthal::Azimuthal<Stereo, Ellipse, 16>, "stereo+ellipse16", Sphere, None]
            [stereo_ellipse20 StereoEllipse20 = azimuthal::Azimuthal<Stereo, Ellipse, 20>, "stereo+ellipse20", Sphere, None]
            [stereo_ellipse22 StereoEllipse22 = azimuthal::Azimuthal<Stereo, Ellipse, 22>, "stereo+ellipse22", Sphere, None]
            [stereo_ellipse24 StereoEllipse24 = azimuthal::Azimuthal<Stereo, Ellipse, 24>, "stereo+ellipse24", Sphere, None]
            [stereo_ellipse32 StereoEllipse32 = azimuthal::Azimuthal<Stereo, Ellipse, 32>, "stereo+ellipse32", Sphere, None]
            [eqarea16 Eqarea16 = azimuthal::Azimuthal<Eqarea, Plain, 16>, "eqarea16", Sphere, None]
            [eqarea20 Eqarea20 = azimuthal::Azimuthal<Eqarea, Plain, 20>, "eqarea20", Sphere, None]
            [eqarea22 Eqarea22 = azimuthal::Azimuthal<Eqarea, Plain, 22>, "eqarea22", Sphere, None]
            [eqarea24 Eqarea24 = azimuthal::Azimuthal<Eqarea, Plain, 24>, "eqarea24", Sphere, None]
            [eqarea32 Eqarea32 = azimuthal::Azimuthal<Eqarea, Plain, 32>, "eqarea32", Sphere, None]
            [eqarea_concentric16 EqareaConcentric16 = azimuthal::Azimuthal<Eqarea, Concentric, 16>, "eqarea+concentric16", Sphere, None]
            [eqarea_concentric20 EqareaConcentric20 = azimuthal::Azimuthal<Eqarea, Concentric, 20>, "eqarea+concentric20", Sphere, None]
            [eqarea_concentric22 EqareaConcentric22 = azimuthal::Azimuthal<Eqarea, Concentric, 22>, "eqarea+concentric22", Sphere, None]
            [eqarea_concentric24 EqareaConcentric24 = azimuthal::Azimuthal<Eqarea, Concentric, 24>, "eqarea+concentric24", Sphere, None]
            [eqarea_concentric32 EqareaConcentric32 = azimuthal::Azimuthal<Eqarea, Concentric, 32>, "eqarea+concentric32", Sphere, None]
            [eqarea_ellipse16 EqareaEllipse16 = azimuthal::Azimuthal<Eqarea, Ellipse, 16>, "eqarea+ellipse16", Sphere, None]
            [eqarea_ellipse20 EqareaEllipse20 = azimuthal::Azimuthal<Eqarea, Ellipse, 20>, "eqarea+ellipse20", Sphere, None]
            [eqarea_ellipse22 EqareaEllipse22 = azimuthal::Azimuthal<Eqarea, Ellipse, 22>, "eqarea+ellipse22", Sphere, None]
            [eqarea_ellipse24 EqareaEllipse24 = azimuthal::Azimuthal<Eqarea, Ellipse, 24>, "eqarea+ellipse24", Sphere, None]
            [eqarea_ellipse32 EqareaEllipse32 = azimuthal::Azimuthal<Eqarea, Ellipse, 32>, "eqarea+ellipse32", Sphere, None]
            [eqdist16 Eqdist16 = azimuthal::Azimuthal<Eqdist, Plain, 16>, "eqdist16", Sphere, None]
            [eqdist20 Eqdist20 = azimuthal::Azimuthal<Eqdist, Plain, 20>, "eqdist20", Sphere, None]
            [eqdist22 Eqdist22 = azimuthal::Azimuthal<Eqdist, Plain, 22>, "eqdist22", Sphere, None]
            [eqdist24 Eqdist24 = azimuthal::Azimuthal<Eqdist, Plain, 24>, "eqdist24", Sphere, None]
            [eqdist32 Eqdist32 = azimuthal::Azimuthal<Eqdist, Plain, 32>, "eqdist32", Sphere, None]
            [eqdist_concentric16 EqdistConcentric16 = azimuthal::Azimuthal<Eqdist, Concentric, 16>, "eqdist+concentric16", Sphere, None]
            [eqdist_concentric20 EqdistConcentric20 = azimuthal::Azimuthal<Eqdist, Concentric, 20>, "eqdist+concentric20", Sphere, None]
            [eqdist_concentric22 EqdistConcentric22 = azimuthal::Azimuthal<Eqdist, Concentric, 22>, "eqdist+concentric22", Sphere, None]
            [eqdist_concentric24 EqdistConcentric24 = azimuthal::Azimuthal<Eqdist, Concentric, 24>, "eqdist+concentric24", Sphere, None]
            [eqdist_concentric32 EqdistConcentric32 = azimuthal::Azimuthal<Eqdist, Concentric, 32>, "eqdist+concentric32", Sphere, None]
            [eqdist_ellipse16 EqdistEllipse16 = azimuthal::Azimuthal<Eqdist, Ellipse, 16>, "eqdist+ellipse16", Sphere, None]
            [eqdist_ellipse20 EqdistEllipse20 = azimuthal::Azimuthal<Eqdist, Ellipse, 20>, "eqdist+ellipse20", Sphere, None]
            [eqdist_ellipse22 EqdistEllipse22 = azimuthal::Azimuthal<Eqdist, Ellipse, 22>, "eqdist+ellipse22", Sphere, None]
            [eqdist_ellipse24 EqdistEllipse24 = azimuthal::Azimuthal<Eqdist, Ellipse, 24>, "eqdist+ellipse24", Sphere, None]
            [eqdist_ellipse32 EqdistEllipse32 = azimuthal::Azimuthal<Eqdist, Ellipse, 32>, "eqdist+ellipse32", Sphere, None]
            [snorm5x3 Snorm5x3 = snorm::Snorm3<15>, "snorm5x3", Sphere, None]
            [snorm8x3 Snorm8x3 = snorm::Snorm3<24>, "snorm8x3", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")]
            [snorm10x3 Snorm10x3 = snorm::Snorm3<30>, "snorm10x3", Sphere, Some("VK_FORMAT_A2B10G10R10_SNORM_PACK32")]
            [snorm11_11_10 Snorm11x11x10 = snorm::Snorm3<32>, "snorm11-11-10", Sphere, None]
            [snorm16x3 Snorm16x3 = snorm::Snorm16x3, "snorm16x3", Sphere, Some("VK_FORMAT_R16G16B16_SNORM")]
            [unorm8x3 Unorm8x3 = unorm::Unorm8x3, "unorm8x3", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")]
            [float16x3 Float16x3 = float::Float16x3, "float16x3", Sphere, Some("VK_FORMAT_R16G16B16_SFLOAT")]
            [cube16 Cube16 = cube::Cube<16>, "cube16", Sphere, None]
            [cube24 Cube24 = cube::Cube<24>, "cube24", Sphere, None]
            [cube32 Cube32 = cube::Cube<32>, "cube32", Sphere, None]
            [cube48 Cube48 = cube::CubeWide, "cube48", Sphere, None]
            [warpedcube16 WarpedCube16 = cube::WarpedCube<16>, "warpedcube16", Sphere, None]
            [warpedcube24 WarpedCube24 = cube::WarpedCube<24>, "warpedcube24", Sphere, None]
            [warpedcube32 WarpedCube32 = cube::WarpedCube<32>, "warpedcube32", Sphere, None]
            [xyonly16 XyOnly16 = parallel::XyOnly<16>, "XYOnly16", Hemisphere, Some("VK_FORMAT_R8G8_SNORM")]
            [xyonly24 XyOnly24 = parallel::XyOnly<24>, "XYOnly24", Hemisphere, None]
            [xyonly32 XyOnly32 = parallel::XyOnly<32>, "XYOnly32", Hemisphere, Some("VK_FORMAT_R16G16_SNORM")]
            [xyonly32f XyOnly32F = parallel::XyOnly32F, "XYOnly32F", Hemisphere, Some("VK_FORMAT_R16G16_SFLOAT")]
            [pp16 Pp16 = parallel::Pp<16>, "PP16", Sphere, None]
            [pp24 Pp24 = parallel::Pp<24>, "PP24", Sphere, None]
            [pp32 Pp32 = parallel::Pp<32>, "PP32", Sphere, None]
            [pp48 Pp48 = parallel::Pp<48, [u32; 2]>, "PP48", Sphere, None]
            [spp16 Spp16 = parallel::Spp<16>, "SPP16", Sphere, None]
            [spp24 Spp24 = parallel::Spp<24>, "SPP24", Sphere, None]
            [spp32 Spp32 = parallel::Spp<32>, "SPP32", Sphere, None]
            [spp48 Spp48 = parallel::Spp<48, [u32; 2]>, "SPP48", Sphere, None]
        }
    };
}

/// Calls the macro `callback` with the rows of all codecs of tangent frames: identifier, type, Vulkan format.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_frame {
    ($callback:ident) => {
        $callback! {
            [frame32 Frame32, "VK_FORMAT_R32_UINT"]
            [frame64 Frame64, "VK_FORMAT_R32G32_UINT"]
        }
    };
}

/// Calls the macro `callback` with the rows of all codecs of rotations: identifier, type, Vulkan format.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_rotation {
    ($callback:ident) => {
        $callback! {
            [quat24 Quat24 = quat::Quat<24>, None]
            [quat32 Quat32 = quat::Quat<32>, Some("VK_FORMAT_R32_UINT")]
            [quat48 Quat48 = quat::Quat<48, [u32; 2]>, None]
            [quat64 Quat64 = quat::Quat<64, [u32; 2]>, Some("VK_FORMAT_R32G32_UINT")]
        }
    };
}

/// A codec of the list, with the data of its row.
pub trait Listed: Codec {
    /// Identifier, such as `oct16p`.
    const NAME: &'static str;

    /// Name of the type in this crate: `OctPrecise16`.
    const RUST_TYPE: &'static str;

    /// The survey's name, or one in the same style: `oct16P`.
    const SURVEY_NAME: &'static str;

    /// The family's module and, with `.glsl`, the GLSL file: `oct`.
    const FAMILY: &'static str;

    /// The directions that the codec is made for.
    const DOMAIN: Domain;

    /// The Vulkan format that has the code's layout, if there is one.
    const VK_FORMAT: Option<&'static str>;
}

/// A codec of frames of the list, with the data of its row.
pub trait ListedFrame: FrameCodec {
    /// Identifier, such as `frame32`.
    const NAME: &'static str;

    /// Name of the type in this crate: `Frame32`.
    const RUST_TYPE: &'static str;

    /// The Vulkan format that holds a code.
    const VK_FORMAT: &'static str;
}

/// A codec of rotations of the list, with the data of its row.
pub trait ListedRotation: RotationCodec {
    /// Identifier, such as `quat32`.
    const NAME: &'static str;

    /// Name of the type in this crate: `Quat32`.
    const RUST_TYPE: &'static str;

    /// The Vulkan format that holds a code, if there is one.
    const VK_FORMAT: Option<&'static str>;
}

/// Defines each row's type and implements [`Listed`] for it.
macro_rules! define {
    ($([
        $id:ident $codec:ident $(($by:ident))? = $family:ident::$type:ident $(<$($parameter:tt),*>)?,
        $survey_name:literal, $domain:ident, $vk_format:expr
    ])*) => {$(
        #[doc = concat!("`", stringify!($id), "`: ", facts!($id), ".")]
        ///
        #[doc = concat!("For directions of the [`Domain::", stringify!($domain), "`]; the bound of its error is ",
            "[`Codec::MAX_ERROR_DEG`]. Layout, errors and use: [`", stringify!($family), "`](mod@crate::",
            stringify!($family), ").")]
        pub type $codec = $crate::$family::$type$(<$($parameter),*>)?;

        impl Width for $codec {}

        impl Listed for $codec {
            const NAME: &'static str = stringify!($id);
            const RUST_TYPE: &'static str = stringify!($codec);
            const SURVEY_NAME: &'static str = $survey_name;
            const FAMILY: &'static str = stringify!($family);
            const DOMAIN: Domain = Domain::$domain;
            const VK_FORMAT: Option<&'static str> = $vk_format;
        }
    )*};
}

for_each_codec!(define);

/// Implements [`ListedFrame`] for each row's type.
macro_rules! define_frames {
    ($([$id:ident $codec:ident, $vk_format:literal])*) => {$(
        impl ListedFrame for crate::frame::$codec {
            const NAME: &'static str = stringify!($id);
            const RUST_TYPE: &'static str = stringify!($codec);
            const VK_FORMAT: &'static str = $vk_format;
        }
    )*};
}

for_each_frame!(define_frames);

/// Defines each row's type and implements [`ListedRotation`] for it.
macro_rules! define_rotations {
    ($([$id:ident $codec:ident = quat::$type:ident<$($parameter:tt),*>, $vk_format:expr])*) => {$(
        #[doc = concat!("`", stringify!($id), "`: ", facts!($id), ".")]
        ///
        /// Layout, errors and use: [`quat`](crate::quat).
        pub type $codec = crate::quat::$type<$($parameter),*>;

        impl Width for $codec {}

        impl ListedRotation for $codec {
            const NAME: &'static str = stringify!($id);
            const RUST_TYPE: &'static str = stringify!($codec);
            const VK_FORMAT: Option<&'static str> = $vk_format;
        }
    )*};
}

for_each_rotation!(define_rotations);
