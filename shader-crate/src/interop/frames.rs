//! Tangent frames: those of other software, and splits of the bits besides [`Frame32`](crate::Frame32)'s and
//! [`Frame64`](crate::Frame64)'s.
//!
//! ```
//! use unitvec::Frame;
//! use unitvec::interop::FrameFormat;
//!
//! let format = FrameFormat::named("godot4-frame")?;
//! let frame = Frame::new([0.0, 0.6, 0.8], [1.0, 0.0, 0.0], -1.0);
//! assert_eq!(format.decode(format.encode(frame)).handedness, -1.0);
//! # Ok::<(), unitvec::interop::UnknownFormat>(())
//! ```

use super::octahedral::{Lattice, Layout};
use super::quaternion::largest;
use super::{UnknownFormat, around, joined, nearest_of, parted, usable};
use crate::Frame;
use crate::arith::{atan2_half_turns, is_negative, mask, nearest_pair, sin_cos_half_turns, snorm_max};
use crate::codec::storage_bytes;
use crate::direction::{is_usable, l1_norm, or_z};
use crate::frame::basis;
use crate::slice::{AnyFrame, LengthMismatch, load_each, store_each};
use crate::{hemioct, oct, soct};
use glam::Vec3;

/// A format of tangent frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameFormat {
    /// The name.
    pub name: &'static str,
    /// The source, and the bits of a code, the low ones first.
    pub source: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    normal: Normal,
    tangent: Tangent,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Normal {
    /// A pair of numbers, of so many bits each.
    Pair(Lattice, u32),
    /// Two snorms and the sign of z: [`soct`].
    Signed(u32),
    /// The two smaller components in 9 bits each, and the place and sign of the largest in 3.
    Smaller,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Tangent {
    /// As a pair, whose second number has its sign from the handedness, and its magnitude from y.
    Folded,
    /// An angle of so many bits about the decoded normal, from this direction on, then the handedness.
    Angle(u32, Start),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Start {
    /// The first vector of [`basis`].
    Basis,
    /// The same; the last code is a tangent of length 0, and the others are as many equal angles.
    OrZero,
    /// Unreal's: (-y, x, 0), with x and z exchanged where |z| is the larger.
    Nanite,
    /// An axis for each place of the largest component; 255 steps in a quarter turn.
    Frostbite,
}

/// All formats of frames.
pub static FRAMES: [FrameFormat; 8] = {
    use Lattice::{Snorm, Unorm};
    use Normal::{Pair, Signed, Smaller};
    use Start::{Basis, Frostbite, Nanite, OrZero};
    use Tangent::{Angle, Folded};
    type Text = &'static str;
    const fn of(name: Text, source: Text, bits: u32, normal: Normal, tangent: Tangent) -> FrameFormat {
        FrameFormat { name, source, bits, normal, tangent }
    }
    [
        of("godot4-frame", "Godot 4: pairs, as `godot4`", 64, Pair(Unorm, 16), Folded),
        of("bevy-frame", "Bevy: pairs, as `bevy`", 64, Pair(Snorm, 16), Folded),
        of("nanite-frame", "Nanite: 8 + 8, angle 7, sign", 24, Pair(Unorm, 8), Angle(7, Nanite)),
        of("frostbite", "frostbite-formats 0.3.0, src/tangent.rs", 32, Smaller, Angle(10, Frostbite)),
        of("frame24", "8 + 8, angle 7, sign", 24, Pair(Snorm, 8), Angle(7, Basis)),
        of("frame32-signed", "10 + 10 and sign of z, angle 10, sign", 32, Signed(10), Angle(10, Basis)),
        of("frame32-or-zero", "11 + 11, angle 9 or no tangent, sign", 32, Pair(Snorm, 11), Angle(9, OrZero)),
        of("frame48", "16 + 16, angle 15, sign", 48, Pair(Snorm, 16), Angle(15, Basis)),
    ]
};

impl FrameFormat {
    /// The format of this name.
    ///
    /// # Errors
    /// [`UnknownFormat::Name`].
    pub fn named(name: &str) -> Result<Self, UnknownFormat> {
        let found = FRAMES.iter().find(|format| format.name.eq_ignore_ascii_case(name));
        found.copied().ok_or_else(|| UnknownFormat::Name { name: name.to_owned() })
    }

    /// Bytes of a stored code.
    pub fn bytes(self) -> usize {
        storage_bytes(self.bits)
    }

    /// Upper bounds of the errors in degrees, of the normal and of the tangent, the normal's tilt included.
    pub fn max_errors_deg(self) -> [f32; 2] {
        let normal = match self.normal {
            Normal::Pair(lattice, bits) => lattice.bound_deg(bits),
            Normal::Signed(bits) => (1.224_744_9 / snorm_max(bits)).to_degrees() * 1.01,
            // Half a cell's diagonal, where z is 1 / sqrt(3) at the least.
            Normal::Smaller => (1.224_744_9 / STEPS).to_degrees(),
        };
        let tangent = match self.tangent {
            // A step of y is twice as long.
            Tangent::Folded => 2.0 * normal,
            Tangent::Angle(bits, start) => (180.0 / start.steps(bits) as f32).hypot(normal) * 1.001,
        };
        [normal, tangent]
    }

    /// [`encode`](Self::encode) of each frame, into [`bytes`](Self::bytes) little-endian bytes each, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `codes` is as long as the frames' codes. Nothing is written then.
    pub fn encode_slice(self, frames: &[impl AnyFrame], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        store_each(frames, codes, self.bytes(), |frame| self.encode_words((*frame).into()))
    }

    /// The reverse of [`encode_slice`](Self::encode_slice).
    ///
    /// # Errors
    /// The errors of [`encode_slice`](Self::encode_slice).
    pub fn decode_slice(self, codes: &[u8], frames: &mut [impl AnyFrame]) -> Result<(), LengthMismatch> {
        load_each(codes, frames, self.bytes(), |code| self.decode_words(code).into())
    }

    /// [`encode`](Self::encode), to the low and the high word.
    #[doc(hidden)]
    pub fn encode_words(self, frame: [f32; 7]) -> [u32; 2] {
        parted(self.encode(frame.into()))
    }

    /// [`decode`](Self::decode), of the low and the high word.
    #[doc(hidden)]
    pub fn decode_words(self, code: [u32; 2]) -> [f32; 7] {
        self.decode(joined(code)).to_array()
    }

    /// The code of a frame, in the low [`bits`](Self::bits): the nearest normal, and the tangent that is nearest about it.
    /// Without a usable normal that of +Z, without a tangent the first angle, or none where the format has that.
    #[must_use]
    pub fn encode(self, frame: Frame) -> u64 {
        let normal = self.normal.encode(usable(frame.normal.into()));
        let is_left = is_negative(frame.handedness);
        let tangent = match self.tangent {
            Tangent::Folded => self.normal.folded(frame.tangent, is_left),
            Tangent::Angle(bits, start) => {
                let angle = start.encode(self.normal.decode(normal), frame.tangent, bits);
                angle | u32::from(is_left) << bits
            }
        };
        let code = u64::from(normal) | u64::from(tangent) << self.normal.bits();
        if self.normal == Normal::Smaller { moved(code, FROSTBITE) } else { code }
    }

    /// The frame of a code. The tangent is perpendicular to the normal where it is an angle.
    #[must_use]
    pub fn decode(self, code: u64) -> Frame {
        let back = FROSTBITE.map(|[from, to, bits]| [to, from, bits]);
        let code = if self.normal == Normal::Smaller { moved(code, back) } else { code };
        let normal = self.normal.decode(code as u32);
        let code = (code >> self.normal.bits()) as u32;
        let (tangent, is_left) = match self.tangent {
            Tangent::Folded => self.normal.unfolded(code),
            Tangent::Angle(bits, start) => {
                (start.decode(normal, code & mask(bits), bits), code >> bits & 1 == 1)
            }
        };
        Frame { normal, tangent, handedness: if is_left { -1.0 } else { 1.0 } }
    }
}

/// Ranges of bits of Frostbite's codes: from, to, and how many. Four bytes: two numbers, the angle in its quarter, and place,
/// sign, the numbers' ninth bits and the quarter.
const FROSTBITE: [[u32; 3]; 8] =
    [[0, 0, 8], [9, 8, 8], [21, 16, 8], [18, 24, 3], [31, 27, 1], [8, 28, 1], [17, 29, 1], [29, 30, 2]];

fn moved(code: u64, ranges: [[u32; 3]; 8]) -> u64 {
    ranges.iter().fold(0, |sum, [from, to, bits]| sum | (code >> from & u64::from(mask(*bits))) << to)
}

impl Normal {
    fn bits(self) -> u32 {
        match self {
            Self::Pair(_, bits) => 2 * bits,
            Self::Signed(bits) => 2 * bits + 1,
            Self::Smaller => 21,
        }
    }

    fn encode(self, v: Vec3) -> u32 {
        match self {
            Self::Pair(lattice, bits) => lattice.nearest_code(v, bits, false, Layout::Pair)[0],
            Self::Signed(bits) => {
                let (norm, m) = (l1_norm(v), snorm_max(bits));
                soct::code(v, norm, nearest_pair(hemioct::position(v, norm, m), bits), 2 * bits + 1)
            }
            Self::Smaller => smaller(v),
        }
    }

    fn decode(self, code: u32) -> Vec3 {
        match self {
            Self::Pair(lattice, bits) => Layout::Pair.decode([code, 0], lattice, false, bits),
            Self::Signed(bits) => {
                let sign = soct::sign_bit([code, 0], 2 * bits + 1);
                soct::from_lattice(crate::arith::snorm_integers(code, bits), sign, snorm_max(bits))
            }
            Self::Smaller => of_smaller(code),
        }
    }

    /// Of the codes around a tangent's place, the nearest with this handedness.
    fn folded(self, tangent: Vec3, is_left: bool) -> u32 {
        let Self::Pair(lattice, bits) = self else { return 0 };
        // Without -0: the corner of -0 and -0 has no room for -Z.
        let tangent = or_z(tangent).0 + Vec3::ZERO;
        let place = oct::project(tangent);
        let side = if is_left { -1.0 } else { 1.0 };
        let (m, _, offset) = lattice.sizes(bits);
        let [x, y] = [place.x, (place.y * 0.5 + 0.5) * side].map(|t| (t * m + offset).round() as i32);
        let is_inside = |point: &[i32; 2]| point.iter().all(|i| (*i as f32 - offset).abs() <= m);
        let inside = around([x, y], [-1, 0, 1]).filter(is_inside);
        let codes = inside.map(|point| Layout::Pair.code(point, bits)[0]);
        let of_side = codes.filter(|code| self.unfolded(*code).1 == is_left);
        nearest_of(tangent, of_side, |code| self.unfolded(*code).0).unwrap_or_default()
    }

    /// The tangent of a code, and whether it is left-handed. 0, which no encoder writes, counts as right-handed.
    fn unfolded(self, code: u32) -> (Vec3, bool) {
        let Self::Pair(lattice, bits) = self else { return (Vec3::X, false) };
        let (m, _, offset) = lattice.sizes(bits);
        let numbers = Layout::Pair.numbers([code, 0], lattice.sign(bits), bits);
        let [x, y] = numbers.map(|i| ((i as f32 - offset) / m).max(-1.0));
        (oct::unproject(glam::Vec2::new(x, y.abs() * 2.0 - 1.0)), y < 0.0)
    }
}

/// The code, of `bits` bits (1 to 16), of a tangent about a normal that is stored elsewhere, given as it will be decoded: the
/// angle from the first vector of [`Frame32`](crate::Frame32)'s basis on, in equal steps. Without a usable tangent 0.
#[must_use]
pub fn encode_angle<V: Into<[f32; 3]>>(normal: V, tangent: V, bits: u32) -> u32 {
    let [normal, tangent] = [normal, tangent].map(|v| Vec3::from_array(v.into()));
    Start::Basis.encode(usable(normal.into()).normalize(), tangent, bits.clamp(1, 16))
}

/// The tangent of a code of [`encode_angle`], perpendicular to the normal.
#[must_use]
pub fn decode_angle<V: Into<[f32; 3]> + From<[f32; 3]>>(normal: V, code: u32, bits: u32) -> V {
    let (normal, bits) = (usable(normal.into()).normalize(), bits.clamp(1, 16));
    Start::Basis.decode(normal, code & mask(bits), bits).to_array().into()
}

impl Start {
    /// The directions of the angles 0 and a quarter turn about a normal.
    fn plane(self, n: Vec3) -> (Vec3, Vec3) {
        match self {
            Self::Basis | Self::OrZero => basis(n),
            Self::Nanite => {
                let exchanged = |v: Vec3| if n.z.abs() > n.x.abs() { Vec3::new(v.z, v.y, v.x) } else { v };
                let z = exchanged(n);
                let first = Vec3::new(-z.y, z.x, 0.0).normalize();
                (exchanged(first), exchanged(z.cross(first)))
            }
            Self::Frostbite => {
                let axis = largest(n.to_array().map(f64::from), &[0, 1, 2]);
                let sign = if n[axis] < 0.0 { -1.0 } else { 1.0 };
                let along = [Vec3::Z * sign, Vec3::X * sign, Vec3::X * -sign][axis];
                let first = (along - n * n.dot(along)).normalize();
                (first, n.cross(first))
            }
        }
    }

    /// The number of equal angles in a turn.
    fn steps(self, bits: u32) -> u32 {
        match self {
            Self::Basis | Self::Nanite => 1 << bits,
            Self::OrZero => mask(bits),
            Self::Frostbite => 4 * 255,
        }
    }

    fn encode(self, n: Vec3, tangent: Vec3, bits: u32) -> u32 {
        let (first, second) = self.plane(n);
        let (x, y) = (tangent.dot(first), tangent.dot(second));
        // Along the normal what is left of a tangent is rounding.
        let is_usable = is_usable(l1_norm(tangent)) && x.abs() + y.abs() > 1e-3 * l1_norm(tangent);
        let steps = self.steps(bits);
        let turns = if is_usable { atan2_half_turns(y, x) * 0.5 } else { 0.0 };
        let angle = (turns * steps as f32).round().rem_euclid(steps as f32) as u32;
        match self {
            Self::OrZero if !is_usable => mask(bits),
            // The place in a quarter comes first, and then the quarter.
            Self::Frostbite => (angle % 255) | ((angle / 255) << 8),
            _ => angle,
        }
    }

    fn decode(self, n: Vec3, code: u32, bits: u32) -> Vec3 {
        let angle = match self {
            Self::OrZero if code == mask(bits) => return Vec3::ZERO,
            Self::Frostbite => (code & 255) + 255 * (code >> 8),
            _ => code,
        };
        let (first, second) = self.plane(n);
        let turn = sin_cos_half_turns(2.0 * angle as f32 / self.steps(bits) as f32);
        (first * turn.x + second * turn.y).normalize()
    }
}

/// The two smaller components by the place of the largest, in the order of their numbers.
const SMALLER: [[usize; 2]; 3] = [[2, 1], [0, 2], [0, 1]];

/// The numbers of the smaller components, then twice the place of the largest and its sign: the nearest of 3 by 3 codes for
/// each component that may count as the largest.
fn smaller(v: Vec3) -> u32 {
    let v = v.normalize();
    let codes = (0..3).filter(|axis| v[*axis].abs() > 0.5).flat_map(|axis| {
        let place = (2 * axis) as u32 | u32::from(v[axis] < 0.0);
        let numbers = SMALLER[axis].map(|c| (v[c] * STEPS + 256.0).round() as i32);
        let inside = around(numbers, [-1, 0, 1]).map(|point| point.map(|i| i.clamp(0, 511) as u32));
        inside.map(move |[i, j]| i | j << 9 | place << 18)
    });
    nearest_of(v, codes, |code| of_smaller(*code)).unwrap_or_default()
}

/// Steps of a component: it is at most `1 / sqrt(2)`.
const STEPS: f32 = 255.0 * core::f32::consts::SQRT_2;

fn of_smaller(code: u32) -> Vec3 {
    let place = (code >> 18 & 7).min(5);
    let axis = (place / 2) as usize;
    let [i, j] = [code & 511, code >> 9 & 511].map(|number| (number as f32 - 256.0) / STEPS);
    let mut v = Vec3::ZERO;
    [v[SMALLER[axis][0]], v[SMALLER[axis][1]]] = [i, j];
    v[axis] = (1.0 - i * i - j * j).max(0.0).sqrt() * if place & 1 == 1 { -1.0 } else { 1.0 };
    v.normalize()
}
