//! Tangent frames: an octahedral normal, an angle about it, a handedness.
//!
//! The basis is Frisvad's: the axes, turned by the arc that takes the pole to the normal (Duff et al. 2017 take the
//! pole of the normal's hemisphere). The angle is Ong's diamond coordinate (2023), stretched.

use super::oct::{Oct, nearest_in_neighbourhood};
use super::{Oracle, cross, dot, length, normalize};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// A normal, a tangent and a handedness.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The normal, of unit length.
    pub normal: [f64; 3],
    /// The tangent, of unit length, perpendicular to the normal.
    pub tangent: [f64; 3],
    /// The handedness, +1 or -1.
    pub handedness: f64,
}

/// The shares of a code's bits.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Bits of the normal: even.
    pub normal_bits: u32,
    /// Bits of the angle: those between the normal and the handedness.
    pub angle_bits: u32,
    /// The place on a side of the diamond, -1 to 1, of the number that is rounded, -1 to 1: increasing.
    pub warp: fn(f64) -> f64,
}

/// frame32.
pub const FRAME32: Format = Format { normal_bits: 22, angle_bits: 9, warp: stretched };

/// frame64.
pub const FRAME64: Format = Format { normal_bits: 42, angle_bits: 21, warp: stretched };

/// The sides of the diamond as they are: Ong's coordinate.
pub fn plain(v: f64) -> f64 {
    v
}

/// The stretched sides of frame32 and frame64: the format's constants.
pub fn stretched(v: f64) -> f64 {
    (3225.0 * v + 624.0 * v.powi(3) + 247.0 * v.powi(5)) / 4096.0
}

/// Two unit vectors perpendicular to the unit vector `n` and each other: what X, and Y or -Y, become in the rotation
/// that takes the pole of `n`'s hemisphere, +Z or -Z, to `n` by the shortest way.
pub fn basis(n: [f64; 3]) -> [[f64; 3]; 2] {
    let s = if n[2] < 0.0 { -1.0 } else { 1.0 };
    let pole = [0.0, 0.0, s];
    let turned = |v: [f64; 3]| {
        let half = [n[0] + pole[0], n[1] + pole[1], n[2] + pole[2]];
        let part = dot(half, v) / (1.0 + dot(pole, n));
        [v[0] - part * half[0], v[1] - part * half[1], v[2] - part * half[2]]
    };
    [turned([1.0, 0.0, 0.0]), turned([0.0, s, 0.0])]
}

impl Format {
    /// The format with an identifier.
    pub fn find(id: &str) -> Option<Self> {
        match id {
            "frame32" => Some(FRAME32),
            "frame64" => Some(FRAME64),
            _ => None,
        }
    }

    /// Significant bits of a code.
    pub fn bits(self) -> u32 {
        self.normal_bits + self.angle_bits + 1
    }

    /// The frame that a code stands for.
    pub fn decode(self, code: u64) -> Frame {
        let normal = self.normal(code % (1 << self.normal_bits));
        let angle = self.angle((code >> self.normal_bits) % (1 << self.angle_bits));
        let negative = (code >> (self.normal_bits + self.angle_bits)) % 2 == 1;
        Frame { normal, tangent: at_angle(normal, angle), handedness: if negative { -1.0 } else { 1.0 } }
    }

    /// The code nearest to a frame: nearest to the normal in angle, and to the tangent in angle about the decoded
    /// normal.
    pub fn encode(self, frame: Frame) -> u64 {
        let normal = self.nearest_normal(frame.normal);
        let angle = self.nearest_angle(angle_of(self.normal(normal), frame.tangent));
        let negative = u64::from(frame.handedness < 0.0);
        normal | (angle << self.normal_bits) | (negative << (self.normal_bits + self.angle_bits))
    }

    /// The frame of the nearest code.
    pub fn round_trip(self, frame: Frame) -> Frame {
        self.decode(self.encode(frame))
    }

    /// The unit vector of a normal's code.
    pub fn normal(self, code: u64) -> [f64; 3] {
        Oct::decode(code, self.normal_bits)
    }

    /// The code of the unit vector nearest to `v`.
    pub fn nearest_normal(self, v: [f64; 3]) -> u64 {
        nearest_in_neighbourhood(v, self.normal_bits)
    }

    /// The angle in radians, 0 to a whole turn, of its code: the quarter turn, and the place in that.
    pub fn angle(self, code: u64) -> f64 {
        let places = self.places();
        self.angle_in_quarter(code % places) + FRAC_PI_2 * (code / places) as f64
    }

    /// The code whose angle is nearest to `angle`, on the circle.
    pub fn nearest_angle(self, angle: f64) -> u64 {
        let quarter = (angle / FRAC_PI_2).floor();
        let rest = angle - quarter * FRAC_PI_2;
        let (mut below, mut above) = (0, self.places());
        while above - below > 1 {
            let middle = (below + above) / 2;
            if self.angle_in_quarter(middle) <= rest { below = middle } else { above = middle }
        }
        let is_lower = rest - self.angle_in_quarter(below) < self.angle_in_quarter(above) - rest;
        let place = if is_lower { below } else { above };
        let code = quarter as i64 * self.places() as i64 + place as i64;
        code.rem_euclid(1 << self.angle_bits) as u64
    }

    /// Codes in a quarter turn.
    fn places(self) -> u64 {
        1 << (self.angle_bits - 2)
    }

    /// The angle of a place in a quarter turn, from 0 to the first one of the next quarter.
    fn angle_in_quarter(self, place: u64) -> f64 {
        let w = (self.warp)(2.0 * place as f64 / self.places() as f64 - 1.0);
        FRAC_PI_4 + w.atan()
    }
}

/// The unit vector perpendicular to `n` at an angle in radians from the basis's first vector to the second.
pub fn at_angle(n: [f64; 3], angle: f64) -> [f64; 3] {
    let ([first, second], (sine, cosine)) = (basis(n), angle.sin_cos());
    std::array::from_fn(|i| cosine * first[i] + sine * second[i])
}

/// The angle in radians of the part of `tangent` that is perpendicular to `n`.
pub fn angle_of(n: [f64; 3], tangent: [f64; 3]) -> f64 {
    let [first, second] = basis(n);
    dot(tangent, second).atan2(dot(tangent, first))
}

/// The unit vector along the part of `v` that is perpendicular to the unit vector `n`.
pub fn perpendicular(n: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    normalize(cross(cross(n, v), n))
}

/// The angle in radians between unit vectors of which one is turned by `d`, out of a plane, and by `e` in it: the
/// tangent's error, where `d` is the normal's.
pub fn tangent_bound(d: f64, e: f64) -> f64 {
    let cosine = d.cos() * e.cos();
    // The sine from both, so that small angles are exact.
    let sine = length([d.sin(), d.cos() * e.sin(), 0.0]);
    sine.atan2(cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normals() -> impl Iterator<Item = [f64; 3]> {
        (0..1 << 16).map(|code| Oct::decode(code, 16))
    }

    /// The basis is orthonormal and right-handed.
    #[test]
    fn basis_is_orthonormal() {
        for n in normals() {
            let [a, b] = basis(n);
            for off in [dot(a, a) - 1.0, dot(b, b) - 1.0, dot(a, b), dot(a, n), dot(b, n)] {
                assert!(off.abs() < 1e-14, "{n:?}: {a:?} {b:?}");
            }
            assert!((dot(cross(a, b), n) - 1.0).abs() < 1e-14, "{n:?}");
        }
    }

    /// Every angle is the nearest to itself, and angles in between to their neighbours.
    #[test]
    fn angles_find_their_codes() {
        for format in [FRAME32, Format { warp: plain, ..FRAME32 }] {
            for code in 0..1 << format.angle_bits {
                let (angle, next) = (format.angle(code), format.angle(code + 1));
                assert!(angle < next);
                let (near, far) = (angle * 0.51 + next * 0.49, angle * 0.49 + next * 0.51);
                assert_eq!(format.nearest_angle(near), code);
                assert_eq!(format.nearest_angle(far), (code + 1) % (1 << format.angle_bits));
                assert_eq!(format.nearest_angle(angle - 1e-9 - 2.0 * std::f64::consts::PI), code);
            }
        }
    }

    /// A code's frame has that code, but where codes have the same normal.
    #[test]
    fn round_trip_is_stable() {
        for format in [FRAME32, FRAME64] {
            for i in 0..20_000u64 {
                let code =
                    i.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (63 - format.normal_bits - format.angle_bits);
                let frame = format.decode(code);
                let again = format.round_trip(frame);
                assert!(dot(frame.normal, again.normal) > 1.0 - 1e-15, "{code:x}");
                assert!(dot(frame.tangent, again.tangent) > 1.0 - 1e-15, "{code:x}");
                assert!(frame.handedness == again.handedness);
            }
        }
    }
}
