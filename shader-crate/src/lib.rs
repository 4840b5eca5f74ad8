//! Unit-vector codecs: normals, tangents and light directions in 15 to 52 bits.
//!
//! Every codec is a type with two total functions, [`Codec::encode`] and [`Codec::decode`]. The same source runs
//! on the CPU and, compiled to SPIR-V by rust-gpu, on the GPU, and gives the same bits on both: codec code keeps
//! to operations that IEEE 754 and Vulkan define alike (`+ - * /`, square root, floor, comparison, integers).
//!
//! ```
//! use glam::Vec3;
//! use unitvec::{Codec, Oct32, OctPrecise16};
//!
//! let normal = Vec3::new(0.6, 0.0, -0.8);
//! let code: u32 = Oct32::encode(normal);
//! assert!(Oct32::decode(code).angle_between(normal) < Oct32::MAX_ERROR_DEG.to_radians());
//!
//! // A precise encoder writes the format of its fast one: decode with either.
//! let code = OctPrecise16::encode(normal);
//! assert_eq!(OctPrecise16::decode(code), unitvec::Oct16::decode(code));
//! ```
//!
//! # Which codec
//!
//! | type | bits | mean error (degrees) | max error (degrees) | for |
//! |---|---|---|---|---|
//! | [`Oct16`] / [`OctPrecise16`] | 16 | 0.337 / 0.315 | 0.958 / 0.639 | vertex attributes, thin G-buffers |
//! | [`Oct20`] / [`OctPrecise20`] | 20 | 0.0837 / 0.0782 | 0.238 / 0.159 | with 12 bits left for material flags |
//! | [`Oct22`] / [`OctPrecise22`] | 22 | 0.0418 / 0.0390 | 0.119 / 0.0793 | with 10 bits left |
//! | [`Oct24`] / [`OctPrecise24`] | 24 | 0.0209 / 0.0195 | 0.0595 / 0.0397 | three bytes of an RGB8 target |
//! | [`Oct32`] / [`OctPrecise32`] | 32 | 0.00131 / 0.00122 | 0.00377 / 0.00252 | almost anything |
//! | [`OctPrecise52`] | 52 | 1.1e-6 | 5.4e-6 | what must be as exact as three floats |
//! | [`HemiOct16`], [`HemiOct24`], [`HemiOct32`] | 16, 24, 32 | 0.240, 0.0149, 0.000930 | 0.553, 0.0344, 0.00218 | directions with z >= 0 |
//! | [`EaOct16`] / [`EaOctPrecise16`] | 16 | 0.310 / 0.306 | 0.678 / 0.595 | less error than [`Oct16`], at 2 to 3 times the cost |
//! | [`EaOct24`] / [`EaOctPrecise24`] | 24 | 0.0192 / 0.0190 | 0.0422 / 0.0370 | the same of [`Oct24`] |
//! | [`EaOct32`] / [`EaOctPrecise32`] | 32 | 0.00120 / 0.00119 | 0.00272 / 0.00240 | the same of [`Oct32`] |
//! | [`SOct17`], [`SOct25`], [`SOct33`] | 17, 25, 33 | 0.240, 0.0149, 0.000930 | 0.553, 0.0344, 0.00218 | formats with a bit to spare beside two components |
//! | [`LatLongD16`], [`LatLongD24`], [`LatLongD32`] | 16, 24, 32 | 0.305, 0.0190, 0.00119 | 0.567, 0.0352, 0.00224 | less error than [`OctPrecise32`], cheaper than the next to encode |
//! | [`Ico16`], [`Ico24`], [`Ico32`] | 16, 24, 32 | 0.304, 0.0188, 0.00117 | 0.509, 0.0313, 0.00197 | least error of all, at several times the cost |
//! | [`Fib16`], [`Fib24`], [`Fib32`] | 16, 24, 32 | 0.303, 0.0189, 0.00118 | 0.611, 0.0382, 0.00239 | sets of points to sample or search by |
//!
//! Means are measured over uniform directions; maxima are [`Codec::MAX_ERROR_DEG`], rounded up.
//!
//! A tangent frame (normal, tangent, handedness) takes 32 bits as [`Frame32`] or 64 as [`Frame64`]: see [`frame`].
//!
//! The other families are there to compare with and to read what others wrote: [`spherical`], [`cylindrical`],
//! [`latlong`], [`azimuthal`] (stereographic, equal-area and equidistant), [`cube`], [`projection`], and the raw
//! components of [`snorm`], [`unorm`], [`float`](mod@float) and [`best_fit`]. Each module says what its family is good for.
//!
//! # What every codec promises
//!
//! * `encode` takes any vector: the length does not matter, save to raw component formats, which store the components
//!   they are given, clamped to [-1, 1]. A vector without a usable direction (zero, infinite,
//!   NaN, or of an L1 norm outside [2^-64, 2^100)) gets the code of +Z.
//! * `decode` takes any bit pattern and gives a vector of unit length to within 2 ULP; bits above
//!   [`Codec::BITS`] are ignored. Raw component formats ([`Codec::IS_UNIT`] is false) leave normalising to the caller.
//! * Decoding, encoding and decoding again gives the first vector back, exactly; with [`best_fit`], its direction to
//!   within the codec's error.
//! * Codes are stored little endian and tightly packed in [`Codec::BYTES`] bytes: see [`mod@slice`].
//!
//! # Features
//!
//! `std` (default) takes square root and floor from the standard library; without it, turn on `libm`. `kernels` is
//! for the SPIR-V build alone. `rayon` adds slice functions that use all cores.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![deny(unsafe_code)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("unitvec needs one of its features `std` and `libm` for square root and floor");

pub mod arith;
pub mod codec;
pub mod direction;
mod families;
pub mod frame;
#[cfg(feature = "kernels")]
pub mod kernels;
pub mod list;
#[cfg(not(target_arch = "spirv"))]
pub mod slice;
#[cfg(not(target_arch = "spirv"))]
pub mod table;

pub use codec::{Codec, Domain};
pub use families::angles::{cylindrical, latlong, spherical};
pub use families::components::{best_fit, float, snorm, unorm};
pub use families::lattices::{fib, ico};
pub use families::octahedral::{eaoct, hemioct, oct, oct_wide, soct};
pub use families::projections::{azimuthal, cube, parallel};
pub use frame::{Frame, Frame32, Frame64, FrameCodec};
pub use list::*;
