//! Best fit codes: three snorm components of a vector whose length is chosen so that it points as it should.
//!
//! Source: Kaplanyan 2010, "CryENGINE 3: Reaching the speed of light" (best fit normals); Cigolle et al. 2014, section
//! 2.2.
//!
//! Rounded unit vectors are only a shell of the cube of whole vectors `[-m, m]^3`. As the decoder's caller normalises,
//! any whole vector will do, and one of them points nearest. Its largest component, the whole number `k`, tells its
//! length: with `u = |v| / max`, the candidates are the `round(k u)`. A vector and its double point alike, so that only
//! the `k` above `m / 2` need trying: 64 for `m` = 127.
//!
//! * [`CrytekBfn24`] takes one length for all directions of a cell of a table, as CryEngine does. Its table and its
//!   components differ: CryEngine's is a texture of lengths and its code is biased unorm; this one is snorm, and has
//!   lengths of 64 and more only.
//! * [`SnormBest8`] (snorm8x3P) takes the best of a cell's four lengths. The survey's takes the lengths of the four
//!   closest texels, and the vector as it is. For one direction in eleven there is a still better length.
//! * [`SnormNearest8`] tries the 64, and a few scales in between: no whole vector points nearer.
//! * [`SnormBest16`] (snorm16x3P) tries the 64 longest of the 16384 lengths, and the unit vector. The survey's tries
//!   four, and the vector as it is.
//!
//! The first two work out the lengths of cells; [`EncodeByTable`] looks them up. Their codes are the same. The compute
//! kernels and the `unitvec` program take the table.
//!
//! <!-- generated: errors best_fit -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `snorm8x3p` | 0.0309 | 0.319 | 0.338 |
//! | `snorm8x3_nearest` | 0.0305 | 0.319 | 0.319 |
//! | `snorm16x3p` | 8.82e-5 | 0.00111 | 0.00125 |
//! | `crytek_bfn24` | 0.0402 | 0.319 | 0.633 |
//! <!-- end -->
//!
//! The table ([`fill_table`], 805 KiB): a direction's column and row are `mid / max` and `min / max` of its magnitudes
//! in order of size, times 640. By symmetry this covers the sphere, and a row is at most its column. A cell is a word,
//! the bytes of which are four of the lengths 64 to 127; to a shader, a texel of VK_FORMAT_R8G8B8A8_UINT. The low byte
//! has the length that fits nine directions of the cell, three by three, best in the mean. Each byte above it has the
//! one that helps most where the ones before may be taken too. The word of a cell is number
//! `4 (g (2 g + 1) + row) + column`, `g = column / 4` rounded down: four columns side by side have their rows one after
//! the other, so that a line of a cache has 4 x 4 cells, and half a square is not stored.
//!
//! * Layout: x in the low component, then y, z, in two's complement, as in VK_FORMAT_R8G8B8_SNORM and
//!   VK_FORMAT_R16G16B16_SNORM. A component's pattern of `-2^(b-1)`, never written, counts as -1. The zero vector,
//!   never written either, decodes to (0, 0, 0).
//! * Decoding gives the components as stored, **not normalised**: the longest is at least 0.5. The format is that of
//!   plain snorm components, so that best fit and plain codes can be mixed.
//! * The survey's CrytekBFN24 has a maximum of several degrees. A table of 512 x 512 lengths for biased codes has its
//!   mean, and such a maximum in one texel, that of (1, 1, 1): there short lengths fit as well as long ones, and where
//!   the shortest is taken, one direction in a million is off by a step of it. Here no length is under 64, since short
//!   ones gain nothing over their multiples.
//! * Why that table: an encoder by table waits for the table half of its time, the longer the more of it is in use.
//!   Four lengths that together fit a cell do as well as those of the four closest texels of 1024 x 1024, the size in
//!   use, and one read has them all.
//! * Weakness: around the axes nothing is gained. However long, whole vectors there are a step apart, and the error is
//!   that of plain components, ten times the mean.
//! * Cost: trying 64 lengths takes many times the operations of an octahedral encoder; by table it takes several times
//!   as many, and one read. Decoding is next to free.
//! * Not stable, on one device or across devices: a code's vector comes back within the codec's error. Many candidates lie
//!   in nearly the same direction, and rounding decides which is nearest.
//! * Axes and diagonals (components of 0 and one magnitude) round-trip exactly, but for length; the axes have length 1
//!   with snorm8x3P and snorm16x3P. A mirrored or permuted vector gets the mirrored or permuted code.

mod scan;
#[cfg(any(target_arch = "spirv", test))]
mod shader;
mod table;

#[cfg(not(target_arch = "spirv"))]
pub use table::fill_table;
pub use table::{TABLE_COLUMNS, TABLE_WORDS, table_word};

use crate::arith::{quotient, ratio, root, signed_code, snorm_decode, snorm_max};
use crate::codec::Codec;
use crate::direction::or_z;
use glam::Vec3;
use scan::{Fit, at_scale, best_scale, by_size, on_cube, pack8};
#[cfg(target_arch = "spirv")]
use shader::cell_lengths;
#[cfg(not(target_arch = "spirv"))]
use table::cell_lengths;
use table::{best_of, cell_of, code_at_length, lengths_in, parts_and_reciprocal, table_index};

/// A codec whose encoder can look lengths up in the table of [`fill_table`]: a few operations in place of many, for the
/// same codes.
pub trait EncodeByTable: Codec {
    /// [`Codec::encode_vec3`], with `word` to look up a word of the table: its index is below [`TABLE_WORDS`].
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> Self::Code;

    /// [`Codec::encode`] by the table of [`fill_table`]. Another table, or one that is too short, costs accuracy only: its
    /// error may exceed [`Codec::MAX_ERROR_DEG`].
    #[inline(always)]
    fn encode_by_table<V: Into<[f32; 3]>>(v: V, table: &[u32]) -> Self::Code {
        Self::encode_by(Vec3::from_array(v.into()), |index| {
            let index = index as usize;
            // 0 stands for lengths of 64.
            if index < table.len() { table[index] } else { 0 }
        })
    }
}

impl EncodeByTable for SnormBest8 {
    #[inline(always)]
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        code_at_length(v, reciprocal, best_of(parts, lengths_in(word(table_index(cell_of(parts))))))
    }
}

impl EncodeByTable for CrytekBfn24 {
    #[inline(always)]
    fn encode_by(v: Vec3, word: impl Fn(u32) -> u32) -> u32 {
        let (v, _) = or_z(v);
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let [length, ..] = lengths_in(word(table_index(cell_of(parts))));
        code_at_length(v, reciprocal, length)
    }
}

/// The largest angle, in degrees, that rounding at this length leaves: half the diagonal of a square of whole points in
/// the plane where the largest component is `length`. The angle is at most the distance over `length`. `rounding` is
/// the distance that `f32` adds.
const fn error_bound(length: f32, rounding: f32) -> f32 {
    ratio(core::f32::consts::FRAC_1_SQRT_2 + rounding, length).to_degrees()
}

/// Declares the codecs of three snorm8, each by the length whose bound it has and its encoder.
macro_rules! codecs_of_24_bits {
    ($(
        $(#[$doc:meta])* $codec:ident,
        $(#[$bound_doc:meta])* $length:literal,
        |$v:ident| $encode:expr;
    )*) => { $(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $codec;

        impl Codec for $codec {
            const BITS: u32 = 24;
            const IS_UNIT: bool = false;
            const STABLE_ACROSS_DEVICES: bool = false;
            $(#[$bound_doc])*
            const MAX_ERROR_DEG: f32 = error_bound($length, 1.0 / 16_384.0);
            const NULL: Option<[u32; 2]> = Some([0; 2]);
            type Code = u32;

            #[inline(always)]
            fn encode_vec3(v: Vec3) -> u32 {
                let ($v, _) = or_z(v);
                $encode
            }

            #[inline(always)]
            fn decode_vec3(code: u32) -> Vec3 {
                Vec3::new(snorm_decode(code, 8), snorm_decode(code >> 8, 8), snorm_decode(code >> 16, 8))
            }
        }
    )* };
}

codecs_of_24_bits! {
    /// snorm8x3P, 24 bits: the best of a cell's four lengths. A VK_FORMAT_R8G8B8_SNORM.
    ///
    /// This works the lengths out, 576 trials: with more than a few vectors to encode, take [`EncodeByTable`].
    /// Keeps the axes. Decodes to a vector that is not normalised.
    SnormBest8,
    /// The bound for a length of 120. 127, which leaves 0.319 at most, need not be among a cell's lengths: found by
    /// trial of the cells, in directions 1/8 of a cell apart, that none leaves more. The rest is for directions in
    /// between.
    120.0,
    |v| {
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let (column, row) = cell_of(parts);
        code_at_length(v, reciprocal, best_of(parts, cell_lengths(column, row)))
    };

    /// The format of [`SnormBest8`], 24 bits, with an encoder that misses nothing: of all whole vectors the one that points
    /// nearest.
    ///
    /// Keeps the direction of any code. Decodes to a vector that is not normalised.
    SnormNearest8,
    /// The bound for a length of 127, which is among those tried. Positions are off by 2^-17 at most.
    127.0,
    |v| {
        let u = on_cube(v);
        pack8(at_scale(v, u, best_scale(by_size(u))))
    };

    /// CrytekBFN24, 24 bits: Kaplanyan's method, one length for all directions of a cell. A VK_FORMAT_R8G8B8_SNORM.
    ///
    /// This works the length out; with a table at hand, take [`EncodeByTable`].
    /// Decodes to a vector that is not normalised.
    CrytekBfn24,
    /// No length is below 64. The largest error measured is 0.319, about half.
    64.0,
    |v| {
        let (parts, reciprocal) = parts_and_reciprocal(v);
        let (column, row) = cell_of(parts);
        let [length, ..] = cell_lengths(column, row);
        code_at_length(v, reciprocal, length)
    };
}

/// snorm16x3P, 48 bits: the best of the lengths 32704 to 32767 and of the unit vector. A VK_FORMAT_R16G16B16_SNORM.
///
/// Never further off than plain snorm16x3, but by the rounding of `f32`: where it does not turn the rounding of the
/// unit vector, by less than 0.00003 degrees. Decodes to a vector that is not normalised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SnormBest16;

impl Codec for SnormBest16 {
    const BITS: u32 = 48;
    const IS_UNIT: bool = false;
    const STABLE_ACROSS_DEVICES: bool = false;
    /// The bound for a length of 32767, which is among those tried. Positions are off by 2^-9 at most along each axis,
    /// both in the choice and in the vector chosen.
    const MAX_ERROR_DEG: f32 = error_bound(snorm_max(16), 1.0 / 128.0);
    const NULL: Option<[u32; 2]> = Some([0; 2]);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> [u32; 2] {
        let (v, _) = or_z(v);
        let u = on_cube(v);
        let parts = by_size(u);
        let longest = snorm_max(16);
        let unit = quotient(longest, root((1.0 + parts.mid * parts.mid) + parts.min * parts.min));
        let best = Fit::of_scale(parts, unit).or_scanned(parts, longest);
        let q = at_scale(v, u, best.scale);
        [signed_code(q.x, 16) | (signed_code(q.y, 16) << 16), signed_code(q.z, 16)]
    }

    #[inline(always)]
    fn decode_vec3([low, high]: [u32; 2]) -> Vec3 {
        Vec3::new(snorm_decode(low, 16), snorm_decode(low >> 16, 16), snorm_decode(high, 16))
    }
}
