//! `eaoct`, which rounds to rings and to points on them.

use super::{Candidate, Dithered, unit, usable};
use crate::arith::{
    SIGN_BIT, flip_sign, floor, is_negative, max, min, negate_if, signed_quotient, snorm_max, with_sign,
};
use crate::codec::Width;
use crate::direction::l1_norm;
use crate::eaoct::{self, EaOct, EaOctPrecise, Polar, Ring};
use crate::families::octahedral::{unpack, usable_code};
use glam::{Vec2, Vec3};

/// An offset of rings and of points in the sense of a half octant. Rings count from +Z to -Z and points from +X towards
/// +Y: so the octants' borders, where codes do not tell the octant, are like the inside. `e` has the octant's signs of
/// x and y.
#[inline(always)]
fn turned(offset: Vec2, e: Vec2, swapped: bool, below: bool) -> Vec2 {
    let swap = if swapped { SIGN_BIT } else { 0 };
    let backward = (e.x.to_bits() ^ e.y.to_bits() ^ swap) & SIGN_BIT;
    Vec2::new(negate_if(below, offset.x), flip_sign(offset.y, backward))
}

/// The offset in the sense of the half octant of `v`.
#[inline(always)]
fn turned_to(v: Vec3, p: Polar, offset: Vec2) -> Vec2 {
    turned(usable(offset), Vec2::new(v.x, v.y), p.swapped, is_negative(v.z))
}

/// The lattice point on a ring that is nearest to the direction of `v`, moved along the ring by a turned offset.
#[inline(always)]
fn point_on(ring: f32, v: Vec3, p: Polar, turned: Vec2, m: f32) -> Vec2 {
    let place = floor(p.turn * ring + turned.y + 0.5);
    eaoct::unfolded(v, p.swapped, ring, min(max(place, 0.0), ring), m)
}

/// A lattice point as in its code: without the sign of 0.
#[inline(always)]
fn as_stored(e: Vec2) -> Vec2 {
    Vec2::new(if e.x == 0.0 { 0.0 } else { e.x }, if e.y == 0.0 { 0.0 } else { e.y })
}

/// The direction of a lattice point, moved back.
#[inline(always)]
fn direction(e: Vec2, offset: Vec2, m: f32) -> Vec3 {
    let at = eaoct::ring_of(e, m);
    let turned = turned(usable(offset), e, at.swapped, at.above < 0.0);
    let ring = at.ring - turned.x;
    let past_equator = ring > m;
    let mirrored = if past_equator { 2.0 * m - ring } else { ring };
    let turn = signed_quotient(at.place - turned.y, max(at.ring, 1.0));
    // Before the octant's edge it is the neighbour's, and beyond the octant's middle x and y are the other way around.
    let flip = if turn < 0.0 { SIGN_BIT } else { 0 };
    let signs = Vec2::new(
        flip_sign(with_sign(1.0, e.x), if at.swapped { flip } else { 0 }),
        flip_sign(with_sign(1.0, e.y), if at.swapped { 0 } else { flip }),
    );
    let beyond = turn.abs() > 0.5;
    let moved = Ring {
        ring: if at.ring > 0.0 { mirrored } else { 0.0 },
        swapped: at.swapped != beyond,
        above: if past_equator { -1.0 } else { at.above },
        ..at
    };
    eaoct::from_ring(signs, moved, if beyond { 1.0 - turn.abs() } else { turn.abs() }, m)
}

impl<const BITS: u32> Dithered for EaOct<BITS>
where
    Self: Width,
{
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        let p = eaoct::polar(v, norm);
        let turned = turned_to(v, p, offset);
        let ring = min(floor(p.radius * m + turned.x + 0.5), m);
        usable_code::<BITS>(norm, point_on(ring, v, p, turned, m))
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        direction(unpack::<BITS>(code), offset, snorm_max(BITS / 2))
    }
}

impl<const BITS: u32> Dithered for EaOctPrecise<BITS>
where
    EaOct<BITS>: Width,
{
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        let (p, n) = (eaoct::polar(v, norm), unit(v, norm));
        let turned = turned_to(v, p, offset);
        let below = min(max(floor(p.radius * m + turned.x), 0.0), m - 1.0);
        let on = |ring: f32| {
            let point = point_on(ring, v, p, turned, m);
            Candidate::new(point, direction(as_stored(point), offset, m), n)
        };
        usable_code::<BITS>(norm, on(below).or_nearer(on(below + 1.0)).point)
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        EaOct::<BITS>::decode_dithered(code, offset)
    }
}
