//! Code that depends on the machine: the choice of the instruction set, at run time where the standard library can
//! detect it; prefetching; and slices seen as slices of arrays. In a build for CPUs, all of the crate's `unsafe` is
//! here and in the square root that stands in for the standard library's. The SPIR-V build has some more, in `kernels`
//! and in [`arith`](crate::arith).
//!
//! The loops over slices are written once, without intrinsics, in functions that are always inlined. Here they are
//! inlined once more for each [`Level`], in a function for which the compiler may use that level's instructions. No
//! level has fused multiplication, and the compiler never makes it of a product and a sum: all give the same bits.

#![allow(unsafe_code)]

/// A loop over slices, to be compiled for each level.
pub trait Task {
    /// Runs the loop. Implementations are always inlined, with all that they call.
    fn run(self);
}

/// An instruction set that this machine has: there is no way to get one that it lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Baseline,
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Sse41,
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx2,
}

impl Level {
    /// The level that the crate was compiled for: SSE2 on x86-64, NEON on AArch64, unless target features say more.
    pub const BASELINE: Self = Self(Kind::Baseline);

    /// All that this machine has, the best first. The standard library looks once and remembers.
    #[inline]
    pub fn available() -> impl Iterator<Item = Self> {
        [
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            std::arch::is_x86_feature_detected!("avx2").then_some(Self(Kind::Avx2)),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            std::arch::is_x86_feature_detected!("sse4.1").then_some(Self(Kind::Sse41)),
            Some(Self::BASELINE),
        ]
        .into_iter()
        .flatten()
    }

    /// The best of this machine.
    #[inline]
    pub fn best() -> Self {
        Self::available().next().unwrap_or(Self::BASELINE)
    }

    /// Runs `task` as compiled for this level.
    #[inline]
    pub fn run(self, task: impl Task) {
        match self.0 {
            Kind::Baseline => task.run(),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            // SAFETY: a `Level` of this kind comes from `available` alone, which found that the machine has SSE4.1.
            Kind::Sse41 => unsafe { run_sse41(task) },
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            // SAFETY: a `Level` of this kind comes from `available` alone, which found that the machine has AVX2.
            Kind::Avx2 => unsafe { run_avx2(task) },
        }
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "sse4.1")]
// Not a safe function with a target feature: Rust has those from 1.86 on. To be called where the machine has SSE4.1.
unsafe fn run_sse41(task: impl Task) {
    task.run();
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
// As above, where the machine has AVX2.
unsafe fn run_avx2(task: impl Task) {
    task.run();
}

/// Asks for the memory of `slice` to be brought near, which changes nothing but the time that using it takes. On
/// x86-64; elsewhere it does nothing.
#[inline(always)]
pub fn prefetch<T>(slice: &[T]) {
    #[cfg(target_arch = "x86_64")]
    for offset in (0..size_of_val(slice)).step_by(64) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let line = slice.as_ptr().cast::<i8>().wrapping_add(offset);
        // SAFETY: SSE, which the instruction belongs to, is part of x86-64; it reads and writes nothing that a program
        // can see, and takes any address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(line) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = slice;
}

/// `slice::as_chunks`, which the standard library has from Rust 1.88 on.
#[inline(always)]
pub fn as_chunks<T, const N: usize>(slice: &[T]) -> (&[[T; N]], &[T]) {
    const { assert!(N > 0) };
    let (whole, rest) = slice.split_at(slice.len() - slice.len() % N);
    // SAFETY: `whole` holds a whole number of N elements in a row, which is what arrays of N elements are in memory.
    (unsafe { core::slice::from_raw_parts(whole.as_ptr().cast(), whole.len() / N) }, rest)
}

/// [`as_chunks`] of a mutable slice.
#[inline(always)]
pub fn as_chunks_mut<T, const N: usize>(slice: &mut [T]) -> (&mut [[T; N]], &mut [T]) {
    const { assert!(N > 0) };
    let (whole, rest) = slice.split_at_mut(slice.len() - slice.len() % N);
    // SAFETY: as in `as_chunks`; `whole` is borrowed for writing, and nothing else refers to it.
    (unsafe { core::slice::from_raw_parts_mut(whole.as_mut_ptr().cast(), whole.len() / N) }, rest)
}
