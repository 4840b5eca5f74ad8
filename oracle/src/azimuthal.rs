//! The azimuthal projections of a hemisphere, on the disk or on the square.

use super::{Oracle, field, largest, length, snorm, twos_complement};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

/// Stereographic projection: the first parameter of [`Azimuthal`].
pub const STEREO: u32 = 0;
/// Lambert's equal-area projection.
pub const EQAREA: u32 = 1;
/// Equidistant projection.
pub const EQDIST: u32 = 2;

/// The disk as it is: the second parameter of [`Azimuthal`].
pub const PLAIN: u32 = 0;
/// Shirley and Chiu's concentric map.
pub const CONCENTRIC: u32 = 1;
/// The elliptical grid map.
pub const ELLIPSE: u32 = 2;

/// A projection and a map of the disk to the square, and the bits of their codes.
pub struct Azimuthal<const PROJECTION: u32, const MAP: u32>;

/// The parts of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The integer of u.
    pub u: i64,
    /// The integer of v; `2^(n-1)` where the pattern is that of `-2^(n-1)` and the highest bit is set.
    pub v: i64,
    /// The highest bit: the hemisphere's, except at the ends of v.
    pub flag: bool,
}

/// The parts of a code of `bits` bits, from the lowest: u (half of the bits), v (one less), and one bit.
pub fn parts(code: u64, bits: u32) -> Parts {
    let [m, n] = largest_of_both(bits);
    let u = twos_complement(code, bits / 2).max(-m as i64);
    let v = twos_complement(code >> (bits / 2), bits / 2 - 1);
    let flag = (code >> (bits - 1)) & 1 == 1;
    Parts { u, v: if flag && v == -n as i64 { -v } else { v }, flag }
}

/// The steps from 0 to +1: snorm's largest integer for u, a power of two for v.
pub fn largest_of_both(bits: u32) -> [f64; 2] {
    [largest(bits), 2f64.powi(bits as i32 / 2 - 2)]
}

/// The square of the distance from the middle of the corner, nearest to the middle, of a lattice point's cell
/// (all but a 64th of a step of it).
pub fn corner(p: Parts, bits: u32) -> f64 {
    let [m, n] = largest_of_both(bits);
    let reach = 0.5 - 1.0 / 64.0;
    let [x, y] = [(p.u.abs() as f64 - reach) / m, (p.v.abs() as f64 - reach) / n];
    x * x + y * y
}

/// False where the rounding in `f32` decides whether a lattice point off the disk is a code, without a map to the square.
pub fn is_settled(code: u64, bits: u32) -> bool {
    (corner(parts(code, bits), bits) - 1.0).abs() >= 1e-6
}

/// Distance from the middle of the disk at the angle `theta` from the pole (Snyder: k = 1 at the equator).
fn radius(projection: u32, theta: f64) -> f64 {
    match projection {
        STEREO => (theta / 2.0).tan(),
        EQAREA => SQRT_2 * (theta / 2.0).sin(),
        _ => theta / FRAC_PI_2,
    }
}

/// The inverse of [`radius`].
fn theta(projection: u32, radius: f64) -> f64 {
    match projection {
        STEREO => 2.0 * radius.atan(),
        EQAREA => 2.0 * (radius / SQRT_2).asin(),
        _ => radius * FRAC_PI_2,
    }
}

/// The point on the square of a point on the disk.
fn to_square(map: u32, [x, y]: [f64; 2]) -> [f64; 2] {
    match map {
        PLAIN => [x, y],
        CONCENTRIC => {
            // Shirley and Chiu, listing 2, without regard to their square's orientation.
            let r = x.hypot(y);
            if x.abs() > y.abs() {
                [r.copysign(x), r * (y / x.abs()).atan() / FRAC_PI_4]
            } else if y != 0.0 {
                [r * (x / y.abs()).atan() / FRAC_PI_4, r.copysign(y)]
            } else {
                [0.0, 0.0]
            }
        }
        _ => {
            let half = |a: f64, d: f64| {
                let root = |t: f64| (2.0 + d + t).max(0.0).sqrt() / 2.0;
                root(2.0 * SQRT_2 * a) - root(-2.0 * SQRT_2 * a)
            };
            [half(x, x * x - y * y), half(y, y * y - x * x)]
        }
    }
}

/// The point on the disk of a point on the square.
fn to_disk(map: u32, [s, t]: [f64; 2]) -> [f64; 2] {
    match map {
        PLAIN => [s, t],
        CONCENTRIC if s == 0.0 && t == 0.0 => [0.0, 0.0],
        CONCENTRIC => {
            let (r, phi) = if s.abs() > t.abs() {
                (s, FRAC_PI_4 * (t / s))
            } else {
                (t, FRAC_PI_2 - FRAC_PI_4 * (s / t))
            };
            [r * phi.cos(), r * phi.sin()]
        }
        _ => [s * (1.0 - t * t / 2.0).sqrt(), t * (1.0 - s * s / 2.0).sqrt()],
    }
}

/// The point on the rim that a lattice point beyond it stands for: as in the docs of `unitvec`'s module, but on the
/// circle itself. From (s, t) along the axis where a step is more in the direction of the rim's normal; then along the
/// other one.
fn onto_rim(s: [f64; 2], bits: u32) -> [f64; 2] {
    let steps = largest_of_both(bits).map(|m| 1.0 / m);
    let most = steps.map(|t| t * (0.5 - 1.0 / 64.0));
    let a = s.map(f64::abs);
    let first = if a[0] * steps[0] > a[1] * steps[1] { 0 } else { 1 };
    let second = 1 - first;
    let mut moved = a;
    moved[first] = (1.0 - a[second] * a[second]).max(0.0).sqrt();
    if a[second] >= 1.0 || a[first] - moved[first] > most[first] {
        moved[first] = a[first] - most[first];
        moved[second] = (1.0 - moved[first] * moved[first]).max(0.0).sqrt();
    }
    [moved[0].copysign(s[0]), moved[1].copysign(s[1])]
}

impl<const PROJECTION: u32, const MAP: u32> Oracle for Azimuthal<PROJECTION, MAP> {
    /// The position, the same for both hemispheres.
    fn position(v: [f64; 3]) -> [f64; 2] {
        let rho = v[0].hypot(v[1]);
        if rho == 0.0 {
            return [0.0, 0.0];
        }
        let r = radius(PROJECTION, rho.atan2(v[2].abs()));
        to_square(MAP, [v[0] / rho * r, v[1] / rho * r])
    }

    /// The direction in the hemisphere z >= 0.
    fn direction(e: [f64; 2]) -> [f64; 3] {
        let [x, y] = to_disk(MAP, e);
        let r = x.hypot(y);
        let angle = theta(PROJECTION, r.min(1.0));
        if r == 0.0 { [0.0, 0.0, 1.0] } else { [x / r * angle.sin(), y / r * angle.sin(), angle.cos()] }
    }

    fn unpack(code: u64, bits: u32) -> [i64; 2] {
        let p = parts(code, bits);
        [p.u, p.v]
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        let p = parts(code, bits);
        let [m, n] = largest_of_both(bits);
        let s = [snorm(p.u, m), snorm(p.v, n)];
        let beyond = MAP == PLAIN && s[0] * s[0] + s[1] * s[1] > 1.0;
        let [x, y, z] = if beyond && corner(p, bits) > 1.0 {
            if s[0].abs() > s[1].abs() { [s[0].signum(), 0.0, 0.0] } else { [0.0, s[1].signum(), 0.0] }
        } else {
            Self::direction(if beyond { onto_rim(s, bits) } else { s })
        };
        [x, y, if p.flag { -z } else { z }]
    }

    /// The nearest lattice point on the square or the disk, and the hemisphere. A lattice point off the disk whose cell
    /// has next to nothing of the disk is not a code; the one a step inwards is written.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let [m, n] = largest_of_both(bits);
        let [s, t] = Self::position(v);
        let mut p = Parts { u: (s * m).round() as i64, v: (t * n).round() as i64, flag: v[2] < 0.0 };
        if MAP == PLAIN && corner(p, bits) > 1.0 {
            if p.u.abs() as f64 / (m * m) > p.v.abs() as f64 / (n * n) {
                p.u -= p.u.signum();
            } else {
                p.v -= p.v.signum();
            }
        }
        // The ends of v share a pattern, and the highest bit tells them apart.
        if p.v.abs() as f64 == n {
            p.flag = p.v > 0;
        }
        let v_bits = bits / 2 - 1;
        field(p.u, bits / 2) | (field(p.v, v_bits) << (bits / 2)) | (u64::from(p.flag) << (bits - 1))
    }
}

/// The greatest length, on the sphere, of half a step of v with half a step of u, in steps of v: over the square, or
/// the disk where it is not mapped to one. `ratio` is u's step over v's.
pub fn stretch<const PROJECTION: u32, const MAP: u32>(ratio: f64) -> f64 {
    const GRID: i32 = 500;
    const H: f64 = 1e-6;
    let direction = |s, t| Azimuthal::<PROJECTION, MAP>::direction([s, t]);
    let half_difference = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| (a[i] - b[i]) / (4.0 * H));
    let mut greatest = 0f64;
    for i in 0..=GRID {
        for j in 0..=GRID {
            let [a, b] = [i, j].map(|i| 1e-4 + (1.0 - 2e-4) * f64::from(i) / f64::from(GRID));
            // Off the diagonal by more than H, to either side.
            let [s, t] = match MAP {
                PLAIN => [a * (b * FRAC_PI_2).cos(), a * (b * FRAC_PI_2).sin()],
                _ if i == j => [a, a + 3.0 * H],
                _ => [a, b],
            };
            let by_s: [f64; 3] = half_difference(direction(s + H, t), direction(s - H, t));
            let by_t: [f64; 3] = half_difference(direction(s, t + H), direction(s, t - H));
            for sign in [ratio, -ratio] {
                greatest = greatest.max(length(std::array::from_fn(|i| sign * by_s[i] + by_t[i])));
            }
        }
    }
    greatest
}
