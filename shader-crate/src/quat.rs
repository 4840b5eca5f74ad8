//! Rotations: unit quaternions up to their sign, in 24, 32, 48 or 64 bits.
//!
//! Source: the layout and its arithmetic are ours. That a body-centred cubic lattice covers space with the fewest points is
//! due to Bambah 1954, "On Lattice Coverings by Spheres". Section 5 of the survey asks for such a code.
//!
//! # The lattice
//!
//! The component of largest magnitude chooses one of four charts. The other three, divided by it, are a point x of the cube
//! `[-1, 1]^3`: a face of the four-dimensional cube, seen from its centre, and q and -q are the same point. (It is what
//! [`cube`](crate::cube) does for directions.) Seen from the centre, steps near the faces' edges would be finer than in their
//! middles. A cubic for each component evens them out: `x = u (23 + 9 u^2) / 32`. The cube of u has a body-centred lattice:
//! the grid of n + 1 points a side, with points on the cube's faces, and the grid of the n middles a side of its cells.
//!
//! Two charts share each face of their cubes. The grids have the same points on it, and one is the other's mirror image, which
//! a body-centred lattice is too: the lattice goes on from chart to chart.
//!
//! <!-- generated: errors quat -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `quat24`, rotation | 0.465 | 0.753 | 0.770 |
//! | `quat32`, rotation | 0.0723 | 0.117 | 0.119 |
//! | `quat48`, rotation | 0.00179 | 0.00290 | 0.00296 |
//! | `quat64`, rotation | 4.48e-5 | 7.99e-5 | 8.80e-5 |
//! <!-- end -->
//!
//! Errors are angles of rotation, twice those between quaternions. To compare them with: the body-centred lattice in flat
//! space, with as many points as the bits have patterns, has at 32 bits a mean of 0.0709 and a maximum of 0.1065 degrees.
//! No lattice has a lower maximum, and no code a mean below 0.0704, that of as many balls. The cubic's factor 9/32 has about
//! the least mean at a maximum of 1.12 times this; a tangent in its place has a higher maximum.
//!
//! # Layout
//!
//! | | n | values of a coordinate | low bits of each | above them |
//! |---|---|---|---|---|
//! | `quat24` | 126 | 127 | 7 | chart and grid |
//! | `quat32` | 810 | 811 | 2 | 203 values of each, chart and grid |
//! | `quat48` | 32,766 | 32,767 | 15 | chart and grid |
//! | `quat64` | 1,310,718 | 1,310,719 | 18 | 5 values of each, chart and grid |
//!
//! * The chart is 0 to 3 for x, y, z, w; of equal components w goes before x, y, z. Its coordinates are those of the three
//!   components that follow, in cyclic order. A coordinate i of the grid with points on the faces, 0 to n, stands for
//!   `u = 2 i / n - 1`; of the other, 0 to n - 1, for `u = (2 i + 1) / n - 1`.
//! * From bit 0: the low bits of the three coordinates; then `a + r (b + r (c + r (2 chart + grid)))`, where a, b and c are
//!   what is above the low bits of each, below r, which is 1, 203 or 5. The grid is 0 for that with points on the faces.
//! * Points on the faces have several codes. Patterns that are no lattice point count as the nearest that is one.
//!
//! # Use
//!
//! * The 24 rotations that turn a cube into itself, the identity among them, come back exactly.
//! * q and -q have the same code. The decoded quaternion has unit length to within 2 ULP, and its largest component is
//!   positive: compare rotations, or turn signs alike before blending.
//! * Decode, encode and decode again: the same rotation; on the border of a chart perhaps with the other sign.
//! * The encoder compares three points in the metric of the sphere: the nearest of the grid on the faces, and two of the other.
//!   Its mean error is less than 0.1 % above that of the nearest of all, 0.5 % at 64 bits.
//! * Good for: animation, splats, instances. Components in 10 + 10 + 10 + 2 bits (*smallest three*) are off by up to 0.24
//!   degrees where `quat32` is by 0.119. Weaknesses: the cost; codes cannot be interpolated.
//!
//! A tangent frame is a rotation and a mirror image or none: [`frame`](crate::frame) stores that.

use crate::arith::{
    Four, NEGLIGIBLE, coefficients, dot, floor, inverse_root, is_negative, mask, max, min, negate_if,
    quotient, ratio, reciprocal, scale_to_one, signed_quotient, whole_to_u32, without_denormal,
    without_denormals,
};
use crate::codec::{RawCode, Width, storage_bytes};
use crate::direction::is_usable;
use core::fmt::Debug;
use core::hash::Hash;
use glam::{Vec3, Vec4};

/// A way to store a rotation, a unit quaternion `[x, y, z, w]` up to its sign, in [`BITS`](Self::BITS) bits:
/// [`Codec`](crate::Codec), for rotations.
///
/// ```
/// use unitvec::{Quat32, RotationCodec};
///
/// let quarter_turn = [0.0, 0.70710677, 0.0, 0.70710677];
/// assert_eq!(Quat32::decode::<[f32; 4]>(Quat32::encode(quarter_turn)), quarter_turn);
/// ```
pub trait RotationCodec: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// Significant bits of a code.
    const BITS: u32;

    /// Bytes that a stored code takes.
    const BYTES: usize = storage_bytes(Self::BITS);

    /// An upper bound of the angle, in degrees, of the rotation between one and its decoded code.
    const MAX_ERROR_DEG: f32;

    /// The code as a value: `u32` up to 32 bits, `[u32; 2]` beyond, low word first.
    type Code: RawCode;

    /// The code of the rotation `[x, y, z, w]`, w being the real part, of any library, such as glam's `Quat`. Length and
    /// sign do not matter. A quaternion without a usable direction counts as the identity: zero, infinite, NaN, or with a
    /// sum of magnitudes outside [2^-64, 2^100).
    #[must_use]
    #[inline(always)]
    fn encode(q: impl Into<[f32; 4]>) -> Self::Code {
        Self::encode_vec4(Vec4::from_array(q.into()))
    }

    /// The rotation that `code` stands for, as `[x, y, z, w]` of unit length to within 2 ULP. Any bit pattern is valid. For
    /// glam: `Quat::from_array(C::decode(code))`.
    #[must_use]
    #[inline(always)]
    fn decode<Q: From<[f32; 4]>>(code: Self::Code) -> Q {
        Self::decode_vec4(code).to_array().into()
    }

    /// [`encode`](Self::encode) for this crate's vector of x, y, z, w.
    #[must_use]
    fn encode_vec4(q: Vec4) -> Self::Code;

    /// [`decode`](Self::decode) for this crate's vector of x, y, z, w.
    #[must_use]
    fn decode_vec4(code: Self::Code) -> Vec4;
}

coefficients! {
    /// `x = u (WARP_0 + WARP_1 u^2)`: their sum is 1, so that the cube's faces are exact.
    WARP_0 = 23.0 / 32.0, WARP_1 = 9.0 / 32.0;

    /// The inverse, `u = x (UNWARP_0 + z (UNWARP_1 + z UNWARP_2)) / (1 + z (UNDER_1 + z UNDER_2))` with `z = x^2`: fitted so
    /// that its greatest error, 1.4e-5, is least. That is 0.006 steps at 32 bits.
    UNWARP_0 = 1.391_072_3, UNWARP_1 = 3.382_253_2, UNWARP_2 = 0.698_092_3;
    UNDER_1 = 3.180_98, UNDER_2 = 1.290_437_7;
}

/// `x = u (23 + 9 u^2) / 32` for u of -1 to 1.
#[inline(always)]
fn warp(u: f32) -> f32 {
    u * (WARP_0 + (u * u) * WARP_1)
}

/// The inverse of [`warp`], to within 1.4e-5. For more than 32 bits a step of Newton's method follows and leaves only rounding.
#[inline(always)]
fn unwarp<const BITS: u32>(x: f32) -> f32 {
    let z = x * x;
    let over = UNWARP_0 + z * (UNWARP_1 + z * UNWARP_2);
    let u = x * quotient(over, 1.0 + z * (UNDER_1 + z * UNDER_2));
    if BITS <= 32 {
        return u;
    }
    let slope = WARP_0 + (u * u) * (3.0 * WARP_1);
    u + signed_quotient(x - warp(u), slope)
}

/// The low bits of a coordinate, and the number of values above them.
const fn layout(bits: u32) -> (u32, u32) {
    match bits {
        24 => (7, 1),
        32 => (2, 203),
        48 => (15, 1),
        64 => (18, 5),
        _ => panic!("no lattice for this width"),
    }
}

/// Half the number n of steps from face to face: n + 1 points take an even number of values but one.
const fn half_steps(bits: u32) -> f32 {
    let (low, radix) = layout(bits);
    ((radix << (low - 1)) - 1) as f32
}

/// `q`, each component in the place of the one `by` places before, 0 to 3.
#[inline(always)]
fn turn(q: Four, by: u32) -> Four {
    let q = if (by & 1) != 0 { Four::new(q.y, q.z, q.w, q.x) } else { q };
    if (by & 2) != 0 { Four::new(q.z, q.w, q.x, q.y) } else { q }
}

/// The number of the component of largest magnitude; of equal ones the last, and then the first.
#[inline(always)]
fn chart_of(q: Four) -> u32 {
    let (chart, largest) = (3, q.w.abs());
    let (chart, largest) = if q.x.abs() > largest { (0, q.x.abs()) } else { (chart, largest) };
    let (chart, largest) = if q.y.abs() > largest { (1, q.y.abs()) } else { (chart, largest) };
    if q.z.abs() > largest { 2 } else { chart }
}

/// `q`, scaled to a sum of magnitudes from 1 to 2, or the identity where it has no usable direction. Denormal components
/// are 0, since devices may flush them.
#[inline(always)]
fn or_identity(q: Four) -> Four {
    let norm = (q.x.abs() + q.y.abs()) + (q.z.abs() + q.w.abs());
    let scaled =
        Four::from(without_denormals(q.truncate()).extend(without_denormal(q.w))) * scale_to_one(norm);
    if is_usable(norm) { scaled } else { Four::W }
}

/// The square of the length, on the sphere, of a short way `e` from the point x of a chart, times `(1 + x . x)^2`.
#[inline(always)]
fn square_on_sphere(x: Vec3, e: Vec3) -> f32 {
    let along = dot(x, e);
    (1.0 + dot(x, x)) * dot(e, e) - along * along
}

#[inline(always)]
fn each(v: Vec3, f: impl Fn(f32) -> f32) -> Vec3 {
    Vec3::new(f(v.x), f(v.y), f(v.z))
}

/// The point of a chart that is at these coordinates, in steps from the middle. Both ends are exact.
#[inline(always)]
fn in_chart<const BITS: u32>(steps: Vec3) -> Vec3 {
    each(steps * const { ratio(1.0, half_steps(BITS)) }, warp)
}

/// `v`, with the component in the place of the one of least magnitude in `d` from `w`.
#[inline(always)]
fn replace_at_least(v: Vec3, d: Vec3, w: Vec3) -> Vec3 {
    let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
    let is_x = x < y && x < z;
    let is_y = !is_x && y < z;
    let is_z = !is_x && !is_y;
    Vec3::new(if is_x { w.x } else { v.x }, if is_y { w.y } else { v.y }, if is_z { w.z } else { v.z })
}

/// The lattice point nearest to the point x of a chart: its coordinates, and 1 where it is a middle of cells.
///
/// It is the nearest of three: the corner of cells that rounding gives, the middle of the cell about x, and the middle of the
/// cell beyond the face at that corner that x is closest to.
#[inline(always)]
fn nearest<const BITS: u32>(x: Vec3) -> (Vec3, u32) {
    let half = const { half_steps(BITS) };
    let in_cube = |cell| max(min(cell, half - 1.0), -half);
    let place = each(x, unwarp::<BITS>) * half;
    let corner = each(place, |p| floor(p + 0.5));
    let cell = each(place, |p| in_cube(floor(p)));
    let beyond = each(corner + corner - Vec3::ONE - cell, in_cube);
    let next = replace_at_least(cell, place - corner, beyond);

    let square_to = |point| square_on_sphere(x, x - in_chart::<BITS>(point));
    let (to_cell, to_next) = (square_to(cell + Vec3::splat(0.5)), square_to(next + Vec3::splat(0.5)));
    let (cell, to_cell) = if to_next < to_cell { (next, to_next) } else { (cell, to_cell) };
    let is_cell = to_cell < square_to(corner);
    ((if is_cell { cell } else { corner }) + Vec3::splat(half), if is_cell { 1 } else { 0 })
}

/// Adds a field from bit `at` on to a code of one or two words.
#[inline(always)]
fn place([low, high]: [u32; 2], field: u32, at: u32) -> [u32; 2] {
    if at == 0 {
        [low | field, high]
    } else if at < 32 {
        [low | (field << at), high | (field >> (32 - at))]
    } else {
        [low, high | (field << (at - 32))]
    }
}

/// The field of `bits` bits from bit `at` on.
#[inline(always)]
fn field([low, high]: [u32; 2], at: u32, bits: u32) -> u32 {
    let word = if at == 0 {
        low
    } else if at < 32 {
        (low >> at) | (high << (32 - at))
    } else {
        high >> (at - 32)
    };
    word & mask(bits)
}

/// Quaternion code of `BITS` bits (24, 32, 48 or 64), whose values are `C`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Quat<const BITS: u32, C = u32>(core::marker::PhantomData<C>);

impl<const BITS: u32, C: RawCode> RotationCodec for Quat<BITS, C>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// 1.108 times the largest error of a body-centred lattice with as many points in flat space: the largest of the cells, which
    /// a test derives from the metric. To this come what the metric changes within a step, the error of the places that are
    /// rounded, 0.006 steps at 32 bits, and the rounding of `f32`, a tenth of a step at 64.
    const MAX_ERROR_DEG: f32 = match BITS {
        24 => 0.77,
        32 => 0.119,
        48 => 0.002_96,
        64 => 8.8e-5,
        _ => panic!("no constants for this width"),
    };
    type Code = C;

    #[inline(always)]
    fn encode_vec4(q: Vec4) -> C {
        let (low, radix) = const { layout(BITS) };
        let q = or_identity(q.into());
        let chart = chart_of(q);
        let turned = turn(q, chart);
        let scale = negate_if(is_negative(turned.x), reciprocal(turned.x.abs()));
        // No denormals, which devices may flush, tell one side of a cell from the other.
        let kept = |c: f32| if c.abs() < NEGLIGIBLE { 0.0 } else { c };
        let (point, grid) = nearest::<BITS>(each(Vec3::new(turned.y, turned.z, turned.w) * scale, kept));

        let (a, b, c) = (whole_to_u32(point.x), whole_to_u32(point.y), whole_to_u32(point.z));
        let above = (a >> low) + radix * ((b >> low) + radix * ((c >> low) + radix * (2 * chart + grid)));
        let code = place([a & mask(low), 0], b & mask(low), low);
        let [low_word, high_word] = place(place(code, c & mask(low), 2 * low), above, 3 * low);
        C::from_low_high(low_word, high_word)
    }

    #[inline(always)]
    fn decode_vec4(code: C) -> Vec4 {
        let (low, radix) = const { layout(BITS) };
        let half = const { half_steps(BITS) };
        let words = code.to_words();
        let above = field(words, 3 * low, BITS - 3 * low);
        let (above_b, above_c, of_chart) =
            (above / radix, above / (radix * radix), above / (radix * radix * radix));
        let of_chart = if of_chart > 7 { 7 } else { of_chart };
        let grid = of_chart & 1;

        // From the middle: n / 2, or half a step less, is the last.
        let middle = 0.5 * grid as f32;
        let along = |above: u32, at: u32| {
            let whole = ((above % radix) << low) | field(words, at, low);
            min(whole as f32 - half + middle, half - middle)
        };
        let x = in_chart::<BITS>(Vec3::new(along(above, 0), along(above_b, low), along(above_c, 2 * low)));
        let q = turn(Four::new(1.0, x.x, x.y, x.z), 4 - (of_chart >> 1));
        // After turning back, so that a point of two charts is the same from both.
        (q * inverse_root((q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w))).into()
    }
}
