//! Code that depends on the machine: the choice of the instruction set, at run time where the standard library can
//! detect it; prefetching and streaming stores; and slices seen as slices of arrays. In a build for CPUs, all of the
//! crate's `unsafe` is here and in the square root that stands in for the standard library's. The SPIR-V build has some
//! more, in `kernels` and in [`arith`](crate::arith).
//!
//! The loops over slices are written once, without intrinsics, in functions that are always inlined. Here they are
//! inlined once more for each [`Level`], in a function for which the compiler may use that level's instructions. No
//! level has fused multiplication, and the compiler never makes it of a product and a sum: all give the same bits.

#![allow(unsafe_code)]

use core::fmt;

/// A loop over slices, to be compiled for each level.
pub trait Task {
    /// Runs the loop, here compiled for `level`. Implementations are always inlined, with all that they call.
    fn run(self, level: Level);
}

/// An instruction set that this machine has: there is no way to get one that it lacks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Level {
    kind: Kind,
    /// True where the output does not stay in the caches: see [`Stream`].
    streams: bool,
}

impl fmt::Debug for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Baseline,
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Sse41,
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx2,
    #[cfg(avx512)]
    Avx512,
}

impl Level {
    /// The level that the crate was compiled for: SSE2 on x86-64, NEON on AArch64, unless target features say more.
    pub const BASELINE: Self = Self::of(Kind::Baseline);

    const fn of(kind: Kind) -> Self {
        Self { kind, streams: false }
    }

    /// All that this machine has, the best first. The standard library looks once and remembers.
    #[inline]
    pub fn available() -> impl Iterator<Item = Self> {
        [
            // Processors with VBMI, unlike the first ones with AVX-512, do not slow down for long vectors.
            #[cfg(avx512)]
            (std::arch::is_x86_feature_detected!("avx512bw")
                && std::arch::is_x86_feature_detected!("avx512dq")
                && std::arch::is_x86_feature_detected!("avx512vl")
                && std::arch::is_x86_feature_detected!("avx512vbmi"))
            .then_some(Self::of(Kind::Avx512)),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            std::arch::is_x86_feature_detected!("avx2").then_some(Self::of(Kind::Avx2)),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            std::arch::is_x86_feature_detected!("sse4.1").then_some(Self::of(Kind::Sse41)),
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

    /// This level, with streaming stores if an output of so many bytes, of which a task may write a part, asks for them.
    #[inline]
    pub fn for_output(self, bytes: usize) -> Self {
        Self { streams: self.streams || bytes >= BEYOND_CACHES, ..self }
    }

    /// The number of elements of `size` bytes before the first at the beginning of a cache line, if stores are to be
    /// streaming ones: they write whole lines. It may be more than there are, and is 0 where no element begins with a line.
    #[inline]
    pub fn before_line<T>(self, output: &[T], size: usize) -> usize {
        let at_line = |index: &usize| (output.as_ptr().addr() + index * size) % LINE == 0;
        if self.streams { (0..LINE).find(at_line).unwrap_or(0) } else { 0 }
    }

    /// Runs `task` as compiled for this level.
    #[inline]
    pub fn run(self, task: impl Task) {
        match self.kind {
            Kind::Baseline => run_baseline(task, self.streams),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            // SAFETY: a `Level` of this kind comes from `available` alone, which found that the machine has SSE4.1.
            Kind::Sse41 => unsafe { run_sse41(task, self.streams) },
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            // SAFETY: a `Level` of this kind comes from `available` alone, which found that the machine has AVX2.
            Kind::Avx2 => unsafe { run_avx2(task, self.streams) },
            #[cfg(avx512)]
            // SAFETY: a `Level` of this kind comes from `available` alone, which found that the machine has all of these.
            Kind::Avx512 => unsafe { run_avx512(task, self.streams) },
        }
    }
}

/// A function of its own, so that it is compiled once, as those of the other levels are.
#[inline(never)]
fn run_baseline(task: impl Task, streams: bool) {
    task.run(Level { kind: Kind::Baseline, streams });
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "sse4.1")]
// Not a safe function with a target feature: Rust has those from 1.86 on. To be called where the machine has SSE4.1.
unsafe fn run_sse41(task: impl Task, streams: bool) {
    task.run(Level { kind: Kind::Sse41, streams });
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
// As above, where the machine has AVX2.
unsafe fn run_avx2(task: impl Task, streams: bool) {
    task.run(Level { kind: Kind::Avx2, streams });
}

#[cfg(avx512)]
#[target_feature(enable = "avx512bw,avx512dq,avx512vl,avx512vbmi")]
// As above, where the machine has these.
unsafe fn run_avx512(task: impl Task, streams: bool) {
    task.run(Level { kind: Kind::Avx512, streams });
}

/// Bytes of an output that does not stay in the caches. Below it a core writes as fast with ordinary stores, and who reads
/// the output next finds it in the caches: with 480 MB of shared cache both ways cost the same from 25 MB on.
const BEYOND_CACHES: usize = 1 << 25;

/// Bytes of a cache line.
const LINE: usize = 64;

/// Stores that go past the caches, in whole lines, so that the memory they write need not be read first. On x86-64.
/// Dropping it ends them: no other thread may see the memory before, since Rust's synchronisation does not order such
/// stores.
#[repr(align(64))]
pub struct Stream<T, const N: usize> {
    /// What is to be stored next.
    pub lines: [T; N],
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
    kind: Kind,
}

impl<T: Copy, const N: usize> Stream<T, N> {
    /// For this output, if it begins with a line and the level asks for streaming stores.
    #[inline(always)]
    pub fn to(level: Level, output: &[T]) -> Option<Self> {
        match output {
            #[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
            [any, ..] if level.streams && is_at_line(output) => {
                Some(Self { lines: [*any; N], kind: level.kind })
            }
            _ => {
                let _ = level;
                None
            }
        }
    }

    /// Stores the first of [`lines`](Self::lines) to the whole of `output`.
    #[inline(always)]
    pub fn store(&self, output: &mut [T]) {
        let lines = &self.lines[..output.len()];
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
        if size_of_val(lines) % LINE == 0 && is_at_line(output) {
            // SAFETY: both have that number of lines, `output` begins with one, and the machine has the level's instructions.
            return unsafe {
                stream_lines(
                    self.kind,
                    lines.as_ptr().cast(),
                    output.as_mut_ptr().cast(),
                    size_of_val(lines) / LINE,
                )
            };
        }
        output.copy_from_slice(lines);
    }
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
impl<T, const N: usize> Drop for Stream<T, N> {
    #[inline(always)]
    fn drop(&mut self) {
        // SAFETY: SSE is part of x86-64.
        unsafe { core::arch::x86_64::_mm_sfence() };
    }
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
#[inline(always)]
fn is_at_line<T>(slice: &[T]) -> bool {
    slice.as_ptr().addr() % LINE == 0
}

/// Copies lines, whose bytes may be any, padding included: the reason for assembly in place of intrinsics.
///
/// # Safety
/// `count` lines can be read from `from` and be written to `to`, which is aligned to them; the machine has the kind's
/// instructions.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(miri)))]
#[inline(never)]
unsafe fn stream_lines(kind: Kind, from: *const u8, to: *mut u8, count: usize) {
    /// Assembly that copies a line by parts, through a register.
    macro_rules! copy {
        ($from:ident $to:ident, $load:literal $store:literal $register:tt $($offset:literal)*) => {
            core::arch::asm!(
                $(
                    concat!($load, " ", $register, ", [{from} + ", $offset, "]"),
                    concat!($store, " [{to} + ", $offset, "], ", $register),
                )*
                from = in(reg) $from,
                to = in(reg) $to,
                out($register) _,
                options(nostack, preserves_flags),
            )
        };
    }
    for offset in (0..count * LINE).step_by(LINE) {
        let (from, to) = (from.wrapping_add(offset), to.wrapping_add(offset));
        // SAFETY: the line is one of those that the caller vouches for.
        unsafe {
            match kind {
                #[cfg(avx512)]
                Kind::Avx512 => copy!(from to, "vmovups" "vmovntps" "zmm0" 0),
                #[cfg(feature = "std")]
                Kind::Avx2 => copy!(from to, "vmovups" "vmovntps" "ymm0" 0 32),
                _ => copy!(from to, "movups" "movntps" "xmm0" 0 16 32 48),
            }
        }
    }
}

/// Asks for the memory of `slice` to be brought near, which changes nothing but the time that using it takes. On
/// x86-64; elsewhere it does nothing.
#[inline(always)]
pub fn prefetch<T>(slice: &[T]) {
    prefetch_bytes(slice.as_ptr().cast(), size_of_val(slice));
}

// Not generic and not inlined, so that it is compiled once, and not for each codec.
#[inline(never)]
fn prefetch_bytes(bytes: *const i8, count: usize) {
    #[cfg(target_arch = "x86_64")]
    for offset in (0..count).step_by(LINE) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: SSE, which the instruction belongs to, is part of x86-64; it reads and writes nothing that a program
        // can see, and takes any address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(bytes.wrapping_add(offset)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (bytes, count);
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
