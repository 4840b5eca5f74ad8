//! The codecs that round on a square: `oct`, `hemioct`, `soct`.

use super::{Candidate, Dithered, unit, usable};
use crate::arith::{floor, max, min, nearest_pair, snorm_integers, snorm_max};
use crate::codec::{RawCode, Width};
use crate::direction::l1_norm;
use crate::families::octahedral::{unpack, usable_code};
use crate::hemioct::{self, HemiOct, HemiOctPrecise};
use crate::oct::{self, Oct, OctPrecise};
use crate::soct::{self, SOct};
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

/// The corner of the cell around `at`, on the square `[-m, m]^2`, that decodes nearest to `n`.
#[inline(always)]
fn nearest_corner(at: Vec2, n: Vec3, m: f32, decode: impl Fn(Vec2) -> Vec3) -> Vec2 {
    let (x, y) = (min(floor(at.x), m - 1.0), min(floor(at.y), m - 1.0));
    let corner = |x: f32, y: f32| Candidate::new(Vec2::new(x, y), decode(Vec2::new(x, y)), n);
    let lower = corner(x, y).or_nearer(corner(x + 1.0, y));
    lower.or_nearer(corner(x, y + 1.0)).or_nearer(corner(x + 1.0, y + 1.0)).point
}

impl<const BITS: u32> Dithered for Oct<BITS>
where
    Self: Width,
{
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

impl<const BITS: u32> Dithered for OctPrecise<BITS>
where
    Oct<BITS>: Width,
{
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        let nearest = nearest_corner(moved(oct::position(v, norm, m), offset, m), unit(v, norm), m, |e| {
            oct::from_lattice(moved_back(e, offset, m), m)
        });
        usable_code::<BITS>(norm, nearest)
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        Oct::<BITS>::decode_dithered(code, offset)
    }
}

impl<const BITS: u32> Dithered for HemiOct<BITS>
where
    Self: Width,
{
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

impl<const BITS: u32> Dithered for HemiOctPrecise<BITS>
where
    HemiOct<BITS>: Width,
{
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> u32 {
        let m = snorm_max(BITS / 2);
        let (whole, upper) = hemioct::norms(v);
        let up = Vec3::new(v.x, v.y, max(v.z, 0.0));
        let nearest =
            nearest_corner(moved(hemioct::position(v, upper, m), offset, m), unit(up, upper), m, |e| {
                hemioct::from_lattice(moved_back(e, offset, m), m)
            });
        if hemioct::is_usable(whole, upper) { nearest_pair(nearest, BITS / 2) } else { 0 }
    }

    #[inline(always)]
    fn decode_dithered(code: u32, offset: Vec2) -> Vec3 {
        HemiOct::<BITS>::decode_dithered(code, offset)
    }
}

impl<const BITS: u32, C: RawCode> Dithered for SOct<BITS, C>
where
    Self: Width,
{
    #[inline(always)]
    fn encode_dithered(v: Vec3, offset: Vec2) -> C {
        let (norm, m) = (l1_norm(v), snorm_max(BITS / 2));
        let uv = nearest_pair(moved(hemioct::position(v, norm, m), offset, m), BITS / 2);
        soct::code(v, norm, uv, BITS)
    }

    #[inline(always)]
    fn decode_dithered(code: C, offset: Vec2) -> Vec3 {
        let (words, m) = (code.to_words(), snorm_max(BITS / 2));
        let e = moved_back(snorm_integers(words[0], BITS / 2), offset, m);
        soct::from_lattice(e, soct::sign_bit(words, BITS), m)
    }
}
