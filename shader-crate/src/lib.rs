//! Unit-vector codecs: normals, tangents and light directions in 8 to 52 bits, tangent frames in 32 or 64, rotations in 24 to
//! 64.
//!
//! Every codec is a type with two total functions, [`Codec::encode`] and [`Codec::decode`]. The same source runs on the
//! CPU and, compiled to SPIR-V by rust-gpu, on the GPU. There integers put the device's division and square roots right.
//! So the results are the CPU's, to the bit, where sums and products are rounded to nearest and none are fused; the modules
//! in the repository's folder `spirv/` forbid fusing. `docs/agreement.md` there states the rules.
//!
//! ```
//! use unitvec::{Codec, Oct16, Oct32, OctPrecise16, angle_deg};
//!
//! let normal = [0.6, 0.0, -0.8];
//! # for i in 0..10_000 {
//! # let (z, turn) = (i as f32 / 5_000.0 - 1.0, i as f32 * 2.4);
//! # let r = (1.0 - z * z).sqrt();
//! # let normal = if i == 0 { normal } else { [r * turn.cos(), r * turn.sin(), z] };
//! let code: u32 = Oct32::encode(normal);
//! let decoded: [f32; 3] = Oct32::decode(code);
//! assert!(angle_deg(normal, decoded) < Oct32::MAX_ERROR_DEG.into());
//!
//! // A precise encoder writes the format of its fast one: decode with either.
//! let code = OctPrecise16::encode(normal);
//! let decoded: [f32; 3] = Oct16::decode(code);
//! assert!(angle_deg(normal, decoded) < OctPrecise16::MAX_ERROR_DEG.into());
//! # }
//! ```
//!
//! Vectors may be those of any library: every type that converts from and to `[f32; 3]` will do, such as `Vec3` and
//! `Vec3A` of any version of glam, and the vectors of nalgebra, mint and cgmath. This crate's own glam is
//! [`unitvec::glam`](glam).
//!
//! # Which codec
//!
//! <!-- generated: which-type -->
//! | for | codec | why | Vulkan format | bits | mean / max, degrees | on a mirror | cost: encode / decode |
//! |---|---|---|---|---|---|---|---|
//! | encoded often: G-buffers | [`Oct32`] | the usual choice | `R16G16_SNORM`, `R32_UINT` | 32 | 0.00131 / 0.00373 | nothing | 1.0 / 1.0 |
//! |  | [`Oct24`] | leaves 8 bits for something else | `R32_UINT` | 24 | 0.0209 / 0.0594 | traces | 1.3 / 1.3 |
//! |  | [`Oct16`] | where memory counts most | `R8G8_SNORM`, `R16_UINT` | 16 | 0.337 / 0.957 | bands | 1.0 / 1.0 |
//! | encoded once: vertices | [`OctPrecise32`] | the usual choice | `R16G16_SNORM` | 32 | 0.00122 / 0.00247 | nothing | 2.7 / 1.0 |
//! |  | [`OctPrecise24`] | leaves 8 bits for something else | `R32_UINT` | 24 | 0.0195 / 0.0396 | traces | 3.2 / 1.3 |
//! |  | [`OctPrecise16`] | where memory counts most | `R8G8_SNORM` | 16 | 0.315 / 0.638 | bands | 4.1 / 1.0 |
//! | z >= 0: tangent-space normal maps | [`HemiOct16`] | less error than oct16p, at less cost | `R8G8_SNORM` | 16 | 0.240 / 0.553 | bands | 1.0 / 0.9 |
//! |  | [`HemiOct24`] | less error than oct24p, at less cost | `R32_UINT` | 24 | 0.0149 / 0.0343 | traces | 1.1 / 1.0 |
//! | two snorms and a sign bit | [`SOct17`] | hemioct16's error over the whole sphere | `R32_UINT` | 17 | 0.240 / 0.553 | bands | 1.0 / 1.1 |
//! |  | [`SOct25`] | hemioct24's error over the whole sphere | `R32_UINT` | 25 | 0.0149 / 0.0343 | traces | 1.1 / 1.1 |
//! | files: least maximum error for the bytes | [`Ico16`] | in 2 bytes | `R16_UINT` | 16 | 0.304 / 0.509 | bands | 9.5 / 3.6 |
//! |  | [`Ico24`] | in 3 bytes | `R32_UINT` | 24 | 0.0188 / 0.0312 | traces | 9.6 / 3.7 |
//! |  | [`Ico32`] | in 4 bytes | `R32_UINT` | 32 | 0.00117 / 0.00195 | nothing | 9.5 / 3.6 |
//! | near the least error, at half of ico's cost | [`HexCube32`] | in 4 bytes | `R32_UINT` | 32 | 0.00118 / 0.00209 | nothing | 3.8 / 2.0 |
//! |  | [`HexCube24`] | in 3 bytes | `R32_UINT` | 24 | 0.0189 / 0.0335 | traces | 3.9 / 2.1 |
//! |  | [`HexCube16`] | in 2 bytes | `R16_UINT` | 16 | 0.304 / 0.546 | bands | 3.8 / 2.1 |
//! | very few bits | [`OctPrecise8`] | in 1 byte | `R8_UINT` | 8 | 5.67 / 11.4 | bands | 6.9 / 1.1 |
//! |  | [`OctPrecise12`] | leaves 4 bits of 2 bytes | `R16_UINT` | 12 | 1.29 / 2.61 | bands | 6.9 / 1.1 |
//! | finer than 32 bits | [`OctPrecise48`] | leaves 16 bits of 8 bytes | `R32G32_UINT` | 48 | 4.80e-6 / 1.15e-5 | nothing | 9.0 / 4.5 |
//! |  | [`OctPrecise52`] | as fine as floats | `R32G32_UINT` | 52 | 1.08e-6 / 4.09e-6 | nothing | 24.0 / 4.5 |
//! | a normal with its tangent | [`Frame32`] | 4 bytes instead of 28 | `R32_UINT` | 32 | normal 0.0391 / 0.0787, tangent 0.180 / 0.359 | traces | 7.2 / 3.5 |
//! |  | [`Frame64`] | finer tangents | `R32G32_UINT` | 64 | normal 3.81e-5 / 7.97e-5, tangent 5.31e-5 / 1.21e-4 | nothing | 8.5 / 3.6 |
//! <!-- end -->
//!
//! Of two formats every Vulkan device has the second. *On a mirror*: what a picture of one shows of the error, bands,
//! traces that a close look finds, or nothing. Cost is the inverse throughput of the code that a compiler for RDNA 2 GPUs
//! makes, as a multiple of `oct32`'s. Types named `…Precise…`, elsewhere `oct32p`, write the format of the fast ones: their
//! encoder takes longer and finds the nearest code.
//! The [types](#types) below are all codecs, with bits, bytes, the bound of the error, and the format if there is one;
//! `docs/costs.md` of the repository says more on the choice.
//!
//! A tangent frame (normal, tangent, handedness) takes 32 bits as [`Frame32`] or 64 as [`Frame64`]: see [`frame`]. A rotation,
//! a unit quaternion, takes 24 to 64 as [`Quat24`] to [`Quat64`]: see [`quat`]. Whole slices and vertex buffers: see
//! [`mod@slice`]. To choose a codec by its name at run time, take the crate `unitvec-catalogue`.
//!
//! The families, each with a module that says what it is good for:
//!
//! * octahedral: [`oct`]; [`uoct`], in two unorms; [`oct_wide`], finer than `f32`; [`eaoct`], with equal areas; [`soct`], with the sign of z
//!   apart; [`hemioct`], for a hemisphere;
//! * numbered points: [`ico`], the lattice of an icosahedron; [`hexcube`], hexagonal ones on a cube, cheaper; [`fib`], spherical Fibonacci points;
//! * angles: [`spherical`]; [`spherical_wide`], finer than `f32`; [`cylindrical`]; [`latlong`];
//! * projections: [`azimuthal`] (stereographic, equal-area, equidistant), [`cube`], [`parallel`];
//! * components: [`snorm`], [`unorm`], [`float`](mod@float), [`best_fit`];
//! * for axes [`axial`](wrap::axial), for the plane [`angle`](wrap::angle), for vectors of any length
//!   [`with_length`](wrap::with_length).
//!
//! For textures, render targets and vertex attributes: [`formats`] has the values of codes in Vulkan's formats, and the
//! octahedral, spherical, cylindrical and azimuthal families have `project` and `unproject` for formats to which the
//! hardware rounds. Where few bits show as bands, see [`dither`].
//!
//! # The promises of every codec
//!
//! * `encode` takes a vector of any length. Raw component formats other than best fit store the components as given:
//!   `snorm…` and `unorm…` clamp them to [-1, 1], [`float`](mod@float) to ±65504. A vector without a usable direction gets
//!   the code of +Z: zero, infinite, NaN, or with an L1 norm outside [2^-64, 2^100). [`OrNull`] tells it apart.
//! * `decode` takes any bit pattern and gives a vector of unit length to within 2 ULP; bits above [`Codec::BITS`] are
//!   ignored. Raw component formats ([`Codec::IS_UNIT`] is false) leave normalising to the caller; best fit formats decode
//!   code 0, which no encoder writes, to (0, 0, 0).
//! * Decode, encode and decode again: the second vector equals the first, exactly. With [`best_fit`], its direction is
//!   within the codec's error.
//! * Codes are stored little endian and tightly packed in [`Codec::BYTES`] bytes: see [`mod@slice`].
//! * A code is a file format: its bits never change.
//!
//! # Features
//!
//! `std` (default) takes square root and floor from the standard library, and picks the instruction set of slices at run
//! time; without it, turn on `libm`. `rayon` adds slice functions that use all cores. `serde` and `bytemuck` implement
//! these crates' traits for [`Frame`] and [`Code`]. `kernels`, `cost-kernels` and `library` are internal, for the SPIR-V
//! build. For rust-gpu shaders take `default-features = false, features = ["libm"]`; slices and tables are for the CPU
//! only. `examples/rust-gpu` of the repository is a whole shader.
//!
//! # Sources
//!
//! *The survey*: Cigolle, Donow, Evangelakos, Mara, McGuire and Meyer, "A Survey of Efficient Representations for
//! Independent Unit Vectors", JCGT 3(2), 2014. *Meyer et al. 2010*: Meyer, Süßmuth, Sußner, Stamminger and Greiner, "On
//! Floating-Point Normal Vectors", EGSR 2010. Each family's page names their sections and equations.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![deny(unsafe_code)]

include!("../facts.rs");

#[cfg(not(target_arch = "spirv"))]
mod angle;
#[doc(hidden)]
pub mod arith;
pub mod codec;
mod coded;
pub mod direction;
pub mod dither;
mod families;
pub mod formats;
pub mod frame;
#[cfg(feature = "std")]
pub mod interop;
#[cfg(any(feature = "kernels", feature = "cost-kernels", feature = "library"))]
#[doc(hidden)]
pub mod kernels;
mod list;
pub mod quat;
#[cfg(not(target_arch = "spirv"))]
pub mod slice;
#[cfg(not(target_arch = "spirv"))]
pub mod table;
pub mod wrap;

#[cfg(not(target_arch = "spirv"))]
pub use angle::{angle_deg, rotation_angle_deg};
pub use codec::{Codec, Domain, OrNull};
pub use coded::Code;
pub use families::{angles::*, components::*, lattices::*, octahedral::*, projections::*};
#[doc(inline)]
pub use frame::{Frame, Frame32, Frame64, FrameCodec};
pub use glam;
pub use list::*;
#[doc(inline)]
pub use quat::RotationCodec;
pub use wrap::angle::{Angle, Angle8, Angle16, EqualAngle8, EqualAngle16};
pub use wrap::axial::{Axial, Axial16, Axial24, Axial32};
pub use wrap::with_length::{Vector32, Vector48, WithLength};

/// The traits, frames, and the types of all codecs. Unlike the crate itself it has no modules, and no [`glam`]: with
/// `use unitvec::*` the name is ambiguous in programs that use a glam of their own.
///
/// ```
/// use glam::Vec3;
/// use unitvec::prelude::*;
///
/// let code = Oct32::encode(Vec3::X);
/// assert_eq!(Oct32::decode::<Vec3>(code), Vec3::X);
/// ```
pub mod prelude {
    #[doc(no_inline)]
    pub use crate::{Code, Codec, Frame, Frame32, Frame64, FrameCodec, OrNull, RotationCodec, list::*};
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
