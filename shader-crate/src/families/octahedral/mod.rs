//! The sphere or the hemisphere on an octahedron, unfolded into a square.

pub mod eaoct;
pub mod hemioct;
pub mod oct;
pub mod oct_wide;
pub mod soct;

use crate::arith::{is_negative, mask, signed_code, snorm_integer};
use glam::Vec2;
use oct::{snorm12x2_to_unorm8x3, unorm8x3_to_snorm12x2};

/// Moves a point of the positive octant, scaled to `x + y + z = m`, to where the lower half of the octahedron is
/// folded out if `z` is negative.
#[inline(always)]
fn fold(z: f32, x: f32, y: f32, m: f32) -> (f32, f32) {
    if is_negative(z) { (m - y, m - x) } else { (x, y) }
}

/// The code of a lattice point.
#[inline(always)]
fn pack<const BITS: u32>(e: Vec2) -> u32 {
    if BITS == 24 {
        return snorm12x2_to_unorm8x3(e);
    }
    signed_code(e.x, BITS / 2) | (signed_code(e.y, BITS / 2) << (BITS / 2))
}

/// The lattice point of a code.
#[inline(always)]
fn unpack<const BITS: u32>(code: u32) -> Vec2 {
    if BITS == 24 {
        return unorm8x3_to_snorm12x2(code);
    }
    Vec2::new(snorm_integer(code & mask(BITS / 2), BITS / 2), snorm_integer(code >> (BITS / 2), BITS / 2))
}
