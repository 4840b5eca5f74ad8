//! Tangent frames: a normal, the tangent perpendicular to it and a handedness, in 32 or 64 bits.
//!
//! Sources: for the normal, [`oct`](crate::oct); for the basis about it, Duff et al. 2017, "Building an Orthonormal
//! Basis, Revisited", after Frisvad 2012; for the tangent's place in that basis, Ong 2023, "Tangent Spaces and Diamond
//! Encoding".
//!
//! The normal is encoded first, with the precise octahedral encoder. The *decoded* normal, which both sides know, has a
//! basis of two more unit vectors around it, and of the tangent only its angle in their plane is stored. So the decoded
//! tangent is perpendicular whatever was encoded. The angle's place is found without trigonometry: the line
//! `|x| + |y| = 1` is a diamond, each side of it a quarter turn, and the place w along a side, -1 to 1, takes a
//! division. Steps of equal length along the side are unequal in angle, twice as wide in its middle as at its ends. So
//! the side is stretched by a polynomial, `w = v (A + B v^2 + C v^4)`, close to `tan(pi v / 4)`, and v is rounded.
//!
//! <!-- generated: errors frame -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `frame32`, normal | 0.0391 | 0.0787 | 0.0792 |
//! | `frame32`, tangent | 0.180 | 0.359 | 0.363 |
//! | `frame64`, normal | 3.81e-5 | 7.97e-5 | 8.41e-5 |
//! | `frame64`, tangent | 5.31e-5 | 1.21e-4 | 1.30e-4 |
//! <!-- end -->
//!
//! * Layout: the normal's x in the low 11 (21) bits, y in the next 11 (21), as in [`Oct22`]; above them the angle, 9
//!   (21) bits, whose upper two count quarter turns from the basis's first vector to the second; at the top the
//!   handedness, 1 for -1. A code of 64 bits is two words, low word first. Every pattern is a frame.
//! * Error of the normal: that of the octahedral code, at most `sqrt(2) / m` radians. Error of the tangent: the angle
//!   between the tangent that was encoded, perpendicular to the normal that was encoded, and the decoded one. It
//!   includes how far the normal's error tilts the plane, at most `d`, and how far the angle is off in it, at most `e`:
//!   `acos(cos d cos e) <= sqrt(d^2 + e^2)`. `e` is half a step, which the stretching leaves 0.26 % above
//!   `pi / 2^bits`.
//! * The bare diamond, without the polynomial, is finer near the basis's vectors: where a mesh's tangents gather there,
//!   its mean can be lower. Its maximum is a quarter higher.
//! * 64 bits are shared out so that the two errors are alike.
//! * Decoded normal and tangent have unit length to within 2 ULP, and `|normal . tangent|` is at most 4 ULP of 1: most
//!   of it is the normal's length, which turns the basis by twice its error. The basis is continuous but for the
//!   equator, z = 0, where that of the lower hemisphere takes over; its divisor is never less than 1.
//! * Exact: normals along the axes and, about those, tangents along the axes. Multiples of 45
//!   degrees have codes of their own.
//! * Good for: vertex attributes. The NORMAL and TANGENT of glTF take 4 or 8 bytes, not 28. Weaknesses: a tangent at 32
//!   bits has several times the normal's error; a frame's deviation from orthogonality is lost; codes cannot be
//!   interpolated.

use crate::arith::{
    SIGN_BIT, diamond_code, diamond_error, diamond_point, dot, flip_sign, hypotenuse_bound, nearest_code,
    nearest_pair, normalize, ratio, signed_quotient, snorm_integer, snorm_max, with_sign,
};
use crate::codec::{Codec, RawCode, storage_bytes};
use crate::direction::{is_usable, l1_norm};
use crate::oct::{from_lattice, lattice_precise};
use crate::{Oct22, OctPrecise22};
use core::fmt::Debug;
use core::hash::Hash;
use glam::{Vec2, Vec3};

/// A tangent frame: the axes that a normal map is applied in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Frame {
    /// The surface's normal, of this crate's [`glam`]. [`to_gltf`](Self::to_gltf) gives vectors of any library.
    pub normal: Vec3,
    /// The direction of increasing u, perpendicular to the normal. May be zero: see [`FrameCodec::encode`].
    pub tangent: Vec3,
    /// +1 or -1: the side on which the bitangent lies. It is the `w` of glTF's TANGENT.
    pub handedness: f32,
}

impl Frame {
    /// The frame of these vectors, of any library: as [`Codec::encode`] takes them.
    #[must_use]
    #[inline(always)]
    pub fn new(normal: impl Into<[f32; 3]>, tangent: impl Into<[f32; 3]>, handedness: f32) -> Self {
        let (normal, tangent) = (normal.into(), tangent.into());
        Self { normal: Vec3::from_array(normal), tangent: Vec3::from_array(tangent), handedness }
    }

    /// The frame of a vertex in glTF: NORMAL, and TANGENT with the handedness as its fourth component.
    ///
    /// ```
    /// use unitvec::{Frame, Frame32, FrameCodec};
    ///
    /// let code = Frame32::encode(Frame::from_gltf([0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0]));
    /// let (normal, tangent): ([f32; 3], [f32; 4]) = Frame32::decode(code).to_gltf();
    /// assert_eq!((normal, tangent), ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0]));
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn from_gltf(normal: impl Into<[f32; 3]>, tangent: impl Into<[f32; 4]>) -> Self {
        let [x, y, z, handedness] = tangent.into();
        Self::new(normal, [x, y, z], handedness)
    }

    /// NORMAL and TANGENT, as [`from_gltf`](Self::from_gltf) takes them.
    #[must_use]
    #[inline(always)]
    pub fn to_gltf<N: From<[f32; 3]>, T: From<[f32; 4]>>(self) -> (N, T) {
        let t = self.tangent;
        (self.normal.to_array().into(), [t.x, t.y, t.z, self.handedness].into())
    }

    /// The frame of seven components: normal, tangent, handedness.
    #[must_use]
    #[inline(always)]
    pub fn from_array([nx, ny, nz, tx, ty, tz, handedness]: [f32; 7]) -> Self {
        Self { normal: Vec3::new(nx, ny, nz), tangent: Vec3::new(tx, ty, tz), handedness }
    }

    /// Normal, tangent, handedness.
    #[must_use]
    #[inline(always)]
    pub fn to_array(self) -> [f32; 7] {
        let (n, t) = (self.normal, self.tangent);
        [n.x, n.y, n.z, t.x, t.y, t.z, self.handedness]
    }

    /// The third axis, `handedness * cross(normal, tangent)`, as in glTF.
    #[must_use]
    #[inline(always)]
    pub fn bitangent(self) -> Vec3 {
        self.normal.cross(self.tangent) * self.handedness
    }
}

impl From<[f32; 7]> for Frame {
    #[inline(always)]
    fn from(components: [f32; 7]) -> Self {
        Self::from_array(components)
    }
}

impl From<Frame> for [f32; 7] {
    #[inline(always)]
    fn from(frame: Frame) -> Self {
        frame.to_array()
    }
}

/// A way to store a [`Frame`] in [`BITS`](Self::BITS) bits: [`Codec`], for frames.
pub trait FrameCodec: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// Significant bits of a code.
    const BITS: u32;

    /// Bytes that a stored code takes.
    const BYTES: usize = storage_bytes(Self::BITS);

    /// An upper bound of the angle, in degrees, between a normal and its decoded code.
    const MAX_NORMAL_ERROR_DEG: f32;

    /// An upper bound of the angle, in degrees, between a tangent, perpendicular to its normal, and its decoded code.
    /// It includes the tilt that the normal's error brings.
    const MAX_TANGENT_ERROR_DEG: f32;

    /// The code as a value: `u32` up to 32 bits, `[u32; 2]` beyond, low word first.
    type Code: RawCode;

    /// The code of `frame`. Lengths do not matter.
    ///
    /// * A normal without a usable direction (see [`direction`](crate::direction)) counts as +Z.
    /// * The tangent is projected to the plane of the decoded normal. One without a usable direction, or parallel to
    ///   the normal, gets angle 0, the first vector of the basis: for the normal +Z that is +X. A tangent counts as
    ///   parallel within 0.16 degrees of the normal's line at 32 bits (up to 0.39, by direction), a thousandth of that
    ///   at 64: twice the greatest error of the decoded normal.
    /// * The handedness is -1 if below zero; zeros, denormals and NaN count as +1.
    #[must_use]
    fn encode(frame: Frame) -> Self::Code;

    /// The frame that `code` stands for: vectors of unit length to within 2 ULP and perpendicular to within 4 ULP, the
    /// handedness +1 or -1. Any bit pattern is valid.
    #[must_use]
    fn decode(code: Self::Code) -> Frame;
}

/// Two unit vectors that make an orthonormal basis with the unit vector `n`: right-handed, (first, second, `n`).
///
/// Frisvad's basis rotates the axes by the arc from +Z to `n`, which has no limit at -Z; Duff's does so from -Z where z
/// is negative.
#[inline(always)]
pub fn basis(n: Vec3) -> (Vec3, Vec3) {
    let sign = with_sign(1.0, n.z);
    let a = signed_quotient(-1.0, sign + n.z);
    let b = (n.x * n.y) * a;
    (
        Vec3::new(1.0 + sign * ((n.x * n.x) * a), sign * b, -(sign * n.x)),
        Vec3::new(b, sign + (n.y * n.y) * a, -n.y),
    )
}

/// The code of the angle of `tangent` about the decoded normal `n`.
///
/// A tangent must have more of its L1 norm left in the plane than the part `parallel`, along both axes together. For one
/// along the normal that was encoded this is up to `2 / m`, since the decoded one is off by `sqrt(2) / m`.
#[inline(always)]
fn angle_code<const ANGLE_BITS: u32>(n: Vec3, tangent: Vec3, parallel: f32) -> u32 {
    let (first, second) = basis(n);
    let (x, y) = (dot(tangent, first), dot(tangent, second));
    let norm = l1_norm(tangent);
    let sum = x.abs() + y.abs();
    let usable = is_usable(norm) && sum > parallel * norm;
    let code = diamond_code::<ANGLE_BITS>(x, y, sum);
    if usable { code } else { 0 }
}

/// The tangent of an angle's code, about the decoded normal `n`: of unit length to within 2 ULP.
#[inline(always)]
fn tangent<const ANGLE_BITS: u32>(n: Vec3, code: u32) -> Vec3 {
    let (first, second) = basis(n);
    let p = diamond_point::<ANGLE_BITS>(code);
    normalize(first * p.x + second * p.y)
}

/// 1 for a handedness below zero, 0 for any other, zeros, denormals and NaN included. The comparison is one of
/// integers, since a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
fn handedness_code(handedness: f32) -> u32 {
    const LEAST_NEGATIVE: u32 = (-f32::MIN_POSITIVE).to_bits();
    const END: u32 = f32::NEG_INFINITY.to_bits() + 1;
    if handedness.to_bits().wrapping_sub(LEAST_NEGATIVE) < END - LEAST_NEGATIVE { 1 } else { 0 }
}

/// -1 where bit 31 of a code is set, else +1.
#[inline(always)]
fn handedness(code: u32) -> f32 {
    flip_sign(1.0, code & SIGN_BIT)
}

/// An upper bound of the tangent's error, in degrees: the tilt, the angle's error in the plane, and 2^-22 radians for
/// the arithmetic of the basis, the products with it and the decoded tangent.
const fn tangent_error_bound(normal_error_deg: f32, angle_bits: u32) -> f32 {
    hypotenuse_bound(normal_error_deg, (diamond_error(angle_bits) + 1.0 / 4_194_304.0).to_degrees())
}

/// 32 bits: a normal of 22 ([`OctPrecise22`]), an angle of 9, the handedness.
///
#[doc = concat!("`frame32`: ", facts!(frame32), ".")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Frame32;

impl FrameCodec for Frame32 {
    const BITS: u32 = 32;
    const MAX_NORMAL_ERROR_DEG: f32 = OctPrecise22::MAX_ERROR_DEG;
    const MAX_TANGENT_ERROR_DEG: f32 = tangent_error_bound(Self::MAX_NORMAL_ERROR_DEG, 9);
    type Code = u32;

    #[inline(always)]
    fn encode(frame: Frame) -> u32 {
        let m = snorm_max(11);
        let e = lattice_precise(frame.normal, m);
        let angle = angle_code::<9>(from_lattice(e, m), frame.tangent, 1.0 / 256.0);
        nearest_pair(e, 11) | (angle << 22) | (handedness_code(frame.handedness) << 31)
    }

    #[inline(always)]
    fn decode(code: u32) -> Frame {
        let normal = Oct22::decode_vec3(code);
        Frame { normal, tangent: tangent::<9>(normal, code >> 22), handedness: handedness(code) }
    }
}

/// 64 bits: a normal of 42 (octahedral, two snorm21), an angle of 21, the handedness.
///
/// Positions of 21 bits a component are rounded to 2^-5 of a step in `f32`, which costs the normal 0.02 % of its mean
/// error and 1 % of its maximum: the two floats that [`oct_wide`](crate::oct_wide) takes for more bits would not pay.
///
#[doc = concat!("`frame64`: ", facts!(frame64), ".")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Frame64;

impl FrameCodec for Frame64 {
    const BITS: u32 = 64;
    /// Meyer's bound (eq. 11), and 2^-24 radians each for the rounding of the position and of the decoded vector.
    const MAX_NORMAL_ERROR_DEG: f32 =
        (ratio(core::f32::consts::SQRT_2, snorm_max(21)) + 1.0 / 8_388_608.0).to_degrees();
    const MAX_TANGENT_ERROR_DEG: f32 = tangent_error_bound(Self::MAX_NORMAL_ERROR_DEG, 21);
    type Code = [u32; 2];

    #[inline(always)]
    fn encode(frame: Frame) -> [u32; 2] {
        let m = snorm_max(21);
        let e = lattice_precise(frame.normal, m);
        let angle = angle_code::<21>(from_lattice(e, m), frame.tangent, 1.0 / 262_144.0);
        let (x, y) = (nearest_code(e.x, 21), nearest_code(e.y, 21));
        [x | (y << 21), (y >> 11) | (angle << 10) | (handedness_code(frame.handedness) << 31)]
    }

    #[inline(always)]
    fn decode([low, high]: [u32; 2]) -> Frame {
        let e = Vec2::new(snorm_integer(low, 21), snorm_integer((low >> 21) | (high << 11), 21));
        let normal = from_lattice(e, snorm_max(21));
        Frame { normal, tangent: tangent::<21>(normal, high >> 10), handedness: handedness(high) }
    }
}
