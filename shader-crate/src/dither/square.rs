//! The codecs that round on a square: `oct`, `hemioct`, `soct`.

use super::{Candidate, Dithered, unit, usable};
use crate::arith::{floor, is_negative, max, min, nearest_pair, snorm_integers, snorm_max};
use crate::codec::Codec;
use crate::direction::{is_usable, l1_norm};
use crate::families::octahedral::{unpack, usable_code};
use crate::hemioct::{self, HemiOct};
use crate::oct::{self, Oct, OctPrecise};
use crate::soct::{self, SOct, SOct33};
use glam::{Vec2, Vec3};

/// The point of the square `[-m, m]^2` nearest to `e`.
#[inline(always)]
fn within(e: Vec2, m: f32) -> Vec2 {
    Vec2::new(min(max(e.x, -m), m), min(max(e.y, -m), m))
}

/// `position`, moved by an offset.
#[inline(always)]
fn moved(position: Vec2, offset: Vec2, m: f32) -> Vec2 {
    within(position + usable(offset), m)
}

/// A lattice point, moved back.
#[inline(always)]
fn moved_back(point: Vec2, offset: Vec2, m: f32) -> Vec2 {
    within(point - usable(offset), m)
}

impl<const BITS: u32> Dithered for Oct<BITS> {
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        usable_code::<BITS>(norm, moved(oct::position(v, norm, m), offset, m))
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        let m = snorm_max(BITS / 2);
        oct::from_lattice(moved_back(unpack::<BITS>(code), offset, m), m)
    }
}

impl<const BITS: u32> Dithered for OctPrecise<BITS> {
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        let at = moved(oct::position(v, norm, m), offset, m);
        let (x, y, n) = (min(floor(at.x), m - 1.0), min(floor(at.y), m - 1.0), unit(v, norm));
        let corner = |x: f32, y: f32| {
            let point = Vec2::new(x, y);
            Candidate::new(point, oct::from_lattice(moved_back(point, offset, m), m), n)
        };
        let lower = corner(x, y).or_nearer(corner(x + 1.0, y));
        let nearest = lower.or_nearer(corner(x, y + 1.0)).or_nearer(corner(x + 1.0, y + 1.0));
        usable_code::<BITS>(norm, nearest.point)
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        Oct::<BITS>::decode_dithered(code, offset)
    }
}

impl<const BITS: u32> Dithered for HemiOct<BITS> {
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let m = snorm_max(BITS / 2);
        let (whole, upper) = hemioct::norms(v);
        let code = nearest_pair(moved(hemioct::position(v, upper, m), offset, m), BITS / 2);
        if hemioct::is_usable(whole, upper) { code } else { 0 }
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        let m = snorm_max(BITS / 2);
        hemioct::from_lattice(moved_back(snorm_integers(code, BITS / 2), offset, m), m)
    }
}

/// The code of u and v of `bits` bits each, and 1 below the equator, else 0. The code of +Z where `v` has no direction.
#[inline(always)]
fn soct_parts(v: Vec3, offset: Vec2, bits: u32) -> (u32, u32) {
    let (norm, m) = (l1_norm(v), snorm_max(bits));
    let code = nearest_pair(moved(hemioct::position(v, norm, m), offset, m), bits);
    if is_usable(norm) { (code, if is_negative(v.z) { 1 } else { 0 }) } else { (0, 0) }
}

/// The direction of the code of u and v, of `bits` bits each, and the sign, in bit 31.
#[inline(always)]
fn soct_direction(code: u32, sign_bit: u32, offset: Vec2, bits: u32) -> Vec3 {
    let m = snorm_max(bits);
    soct::from_lattice(moved_back(snorm_integers(code, bits), offset, m), sign_bit, m)
}

impl<const BITS: u32> Dithered for SOct<BITS> {
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (code, below) = soct_parts(v, offset, BITS / 2);
        code | (below << (BITS - 1))
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        soct_direction(code, code << (32 - BITS), offset, BITS / 2)
    }
}

impl Dithered for SOct33 {
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> [u32; 2] {
        let (code, below) = soct_parts(v, offset, SOct33::BITS / 2);
        [code, below]
    }

    #[inline(always)]
    fn decode_dithered([low, high]: [u32; 2], offset: Vec2) -> Vec3 {
        soct_direction(low, high << 31, offset, SOct33::BITS / 2)
    }
}
