//! The sphere or the hemisphere on an octahedron, unfolded into a square.

pub mod eaoct;
pub mod hemioct;
pub(crate) mod nearest;
pub mod oct;
pub mod oct_wide;
pub mod soct;
pub mod uoct;

use crate::arith::{is_negative, nearest_pair, snorm_integers};
use crate::direction::is_usable;
use glam::Vec2;
use oct::{pack_bytes, unpack_bytes};

/// Moves a point of the positive octant, scaled to `x + y + z = m`, to where the lower half of the octahedron is
/// folded out if `z` is negative.
#[inline(always)]
fn fold(z: f32, x: f32, y: f32, m: f32) -> (f32, f32) {
    if is_negative(z) { (m - y, m - x) } else { (x, y) }
}

/// The code of the lattice point nearest to `e`, with ties to even components (odd for 24 bits).
#[inline(always)]
pub(crate) fn pack<const BITS: u32>(e: Vec2) -> u32 {
    if BITS == 24 { pack_bytes(e) } else { nearest_pair(e, BITS / 2) }
}

/// [`pack`] of `e`, or the code of +Z where a vector of this L1 norm has no direction: selecting here takes the fewest
/// operations.
#[inline(always)]
pub(crate) fn usable_code<const BITS: u32>(norm: f32, e: Vec2) -> u32 {
    let code = pack::<BITS>(e);
    if is_usable(norm) { code } else { pack::<BITS>(Vec2::ZERO) }
}

/// The lattice point of a code.
#[inline(always)]
pub(crate) fn unpack<const BITS: u32>(code: u32) -> Vec2 {
    if BITS == 24 { unpack_bytes(code) } else { snorm_integers(code, BITS / 2) }
}
