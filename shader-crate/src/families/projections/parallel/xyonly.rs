//! x and y alone, for the hemisphere z >= 0.

use super::plane::{INSET, Plane, onto_border};
use super::{from_plane, pack, third, unit, unpack};
use crate::arith::{half_decode_magnitude, half_encode_magnitude, is_negative, min, negate_positive};
use crate::codec::{Codec, Width};
use crate::direction::upper;
use glam::{Vec2, Vec3};

/// x and y as snorm in `BITS` bits (16, 24 or 32), for directions with z >= 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct XyOnly<const BITS: u32>;

impl<const BITS: u32> XyOnly<BITS> {
    const PLANE: Plane = Plane::disk(BITS / 2, BITS / 2);
}

impl<const BITS: u32> Codec for XyOnly<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The bound for directions with z >= 0: `arccos(1 - 1/(sqrt(2) m))` and the rounding of `f32`, in degrees.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 6.1,
        24 => 1.52,
        32 => 0.39,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([1 << (BITS / 2 - 1), 0]);
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let (v, norm, usable) = upper(v);
        let n = unit(v, norm);
        let e = Self::PLANE.round(Vec2::new(n.x.abs(), n.y.abs()));
        let code = pack(Self::PLANE, n, e, 0)[0];
        if usable { code } else { 0 }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        from_plane(Self::PLANE, unpack(Self::PLANE, [code, 0]).0, false)
    }
}

/// x and y as half floats, for directions with z >= 0: a VK_FORMAT_R16G16_SFLOAT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct XyOnly32F;

/// The numbers of two halves without signs.
#[inline(always)]
fn halves(a: u32, b: u32) -> Vec2 {
    Vec2::new(half_decode_magnitude(a), half_decode_magnitude(b))
}

#[inline(always)]
fn is_off_disk(p: Vec2) -> bool {
    p.x * p.x + p.y * p.y > 1.0
}

/// The numbers of two halves without signs, the larger one moved towards the next smaller half by [`INSET`].
#[inline(always)]
fn halves_inset(a: u32, b: u32) -> Vec2 {
    let p = halves(a, b);
    // Only used off the disk, where the larger is not 0.
    let inner = halves(if a > 0 { a - 1 } else { 0 }, if b > 0 { b - 1 } else { 0 });
    let x = p.x - INSET * (p.x - inner.x);
    let y = p.y - INSET * (p.y - inner.y);
    if p.x >= p.y { Vec2::new(x, p.y) } else { Vec2::new(p.x, y) }
}

/// A half not above `x`: the next one, or 0 in place of those below 2^-14.
#[inline(always)]
fn half_below(x: f32) -> f32 {
    let bits = x.to_bits();
    f32::from_bits(if bits < 0x3880_0000 { 0 } else { bits & 0xffff_e000 })
}

impl Codec for XyOnly32F {
    const BITS: u32 = 32;
    /// The bound for directions with z >= 0. `arccos(1 - sqrt(2) 2^-12)`, from the halves' steps of 2^-11 below 1, is
    /// 1.506.
    const MAX_ERROR_DEG: f32 = 1.53;
    const NULL: Option<[u32; 2]> = Some([0x8000, 0]); // -0
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        let (v, norm, usable) = upper(v);
        let n = unit(v, norm);
        let (a, b) = (half_encode_magnitude(n.x), half_encode_magnitude(n.y));
        let unwritten = is_off_disk(halves(a, b)) && is_off_disk(halves_inset(a, b));
        let x = a - if unwritten && a >= b { 1 } else { 0 };
        let y = b - if unwritten && a < b { 1 } else { 0 };
        let x_sign = if is_negative(n.x) && x != 0 { 0x8000 } else { 0 };
        let y_sign = if is_negative(n.y) && y != 0 { 0x8000 } else { 0 };
        if usable { (x | x_sign) | ((y | y_sign) << 16) } else { 0 }
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        let (a, b) = (code & 0x7fff, (code >> 16) & 0x7fff);
        let p = halves(a, b);
        let inset = if is_off_disk(p) { halves_inset(a, b) } else { p };
        let unit = Vec2::new(min(p.x, 1.0), min(p.y, 1.0));
        let onto_border = onto_border(unit.x * unit.x + unit.y * unit.y, 0.5);
        let below = Vec2::new(half_below(unit.x * onto_border), half_below(unit.y * onto_border));
        let q = if is_off_disk(inset) { below } else { inset };
        Vec3::new(
            negate_positive((code & 0x8000) != 0, q.x),
            negate_positive((code >> 31) != 0, q.y),
            third(q),
        )
    }
}
