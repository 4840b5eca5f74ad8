//! Compute kernels, as [`convert`] or [`cost`] of each codec: functions `encode` and `decode`, or `encode_cost` and
//! `decode_cost`, in a module of the codec's identifier. The SPIR-V build names the entry points after both. (rust-gpu's
//! attribute takes only a literal name, which a macro over the list cannot write.)
//!
//! [`library`] has the functions of the library to link with, as entry points.
//!
//! The features `kernels`, `cost-kernels` and `library` turn them on. They are compiled apart, since rust-gpu holds a copy of
//! all that it compiles for each entry point.

#[cfg(feature = "kernels")]
pub mod convert;
#[cfg(feature = "cost-kernels")]
pub mod cost;
#[cfg(feature = "library")]
pub mod library;
#[cfg(feature = "kernels")]
mod words;

#[cfg(any(feature = "kernels", feature = "cost-kernels"))]
use spirv_std::arch::IndexUnchecked;

/// Low and high word of a code.
pub type CodeWords = [u32; 2];

/// An element of a table, without a test: one for each vector costs a sixth of an encoder by table.
///
/// # Safety
/// The table has more than `index` elements.
#[cfg(any(feature = "kernels", feature = "cost-kernels"))]
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn element<T: Copy>(table: &[T], index: u32) -> T {
    // SAFETY: as the caller promises.
    unsafe { *table.index_unchecked(index as usize) }
}
