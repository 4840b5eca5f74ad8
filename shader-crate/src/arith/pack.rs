//! Integers in the low bits of words.

use super::whole_to_i32;

/// The low `bits` bits set. `bits` is 1 to 31.
#[inline(always)]
pub const fn mask(bits: u32) -> u32 {
    (1 << bits) - 1
}

/// The two's complement, in `bits` bits (at most 22), of a whole number from -2^21 to 2^21 - 1.
#[inline(always)]
pub fn signed_code(whole: f32, bits: u32) -> u32 {
    whole_to_i32(whole) as u32 & mask(bits)
}

/// The integer of the low `bits` bits (2 to 25) of a code, in two's complement.
#[inline(always)]
pub fn signed_integer(code: u32, bits: u32) -> f32 {
    ((code << (32 - bits)) as i32 >> (32 - bits)) as f32
}
