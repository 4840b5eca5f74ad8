//! Hexagonal cube codes: a hexagonal lattice on each face of a cube, warped to be even on the sphere.
//!
//! Source: the cube's faces, as in [`cube`](crate::cube); the warp, the lattice, the choice of the nearest point and
//! the layout of the codes are ours.
//!
//! # The lattice
//!
//! The component of largest magnitude chooses the face, and the two others, divided by it, are X and Y, -1 to 1.
//! Equal steps of X are narrow at the face's edge. Equal steps of `u = 25 X / (17 + 8 |X|)`, whose inverse is
//! `X = 17 u / (25 - 8 |u|)`, are nearly even, for one division when encoding and none when decoding. A tangent,
//! `u = 4/pi atan(X)`, lowers mean and maximum by 0.25 %, and takes a long polynomial for each coordinate, both ways.
//!
//! A face's points stand in rows of equal v. The middle row has a point in the face's middle, and every other row is
//! moved by half a column. Each direction has a near point on its own face, so that none of another face need be
//! looked at: the edges u = -1 and 1 lie up to 1/80 of a column beyond the last points of every other row (1/25 at 16
//! bits), the edges v = -1 and 1 lie about half a row beyond the last row. This takes a few points more than a lattice that
//! goes on from face to face, which counts at 16 bits alone.
//!
//! | | rows | points of a row, every other has one less | points |
//! |---|---|---|---|
//! | `hexcube16` | 113 | 97 | 65,430 |
//! | `hexcube24` | 1,801 | 1,553 | 16,776,318 |
//! | `hexcube32` | 28,889 | 24,779 | 4,294,956,522 |
//!
//! <!-- generated: errors hexcube -->
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `hexcube16` | 0.304 | 0.546 | 0.547 |
//! | `hexcube24` | 0.0189 | 0.0335 | 0.0336 |
//! | `hexcube32` | 0.00118 | 0.00209 | 0.00211 |
//! <!-- end -->
//!
//! # Error
//!
//! Where a step is small, the map to the sphere is linear. A shift (dX, dY) turns the direction by the square root of
//! `((1 + Y^2) dX^2 - 2 X Y dX dY + (1 + X^2) dY^2) / (1 + X^2 + Y^2)^2`, where dX is `17/25 du / (1 - 8/25 |u|)^2`,
//! and dY alike: of `E du^2 + 2 F du dv + G dv^2`, for short.
//!
//! The directions that take a point's code make up a polygon, in u and v: so the farthest of them is one of its corners.
//! Inside a face the encoder, as the next section describes it, finds three points equally near there: two neighbours in
//! a row, and the point between them in the next row, for which `r = (s^2 + q - 1) / (4 q)` and `x = 1/2 + s r` from the
//! first. On an edge u = 1 there are two, the ends of neighbouring rows; on an edge v = 1, two neighbours in a row.
//! Distances in the metric follow from x and r. Inside, the largest are at u and v of 0.37 to 0.48, at 24 and 32 bits.
//! They are 1.089 times the radius of the hexagons that would cover the sphere with as many cells as the bits have
//! patterns, a bound that no code can beat; those on edges are up to 1.089 times. The mean is 1.011 times those hexagons'.
//! At 16 bits, where edges weigh more, the mean is 1.014 times, and the maximum, on the edges, 1.111 times.
//! [`ico`](crate::ico) has 1.0035 and 1.0125, and costs about twice as much.
//!
//! # Encoding
//!
//! Of two candidates, the nearest of the even row beside the direction and that of the odd one, the nearer is chosen.
//! In the metric above, divided by E, a point x columns and r pairs of rows away has the squared distance
//! `(x - s r)^2 + q r^2`, with `s = -F/E` and `q = (E G - F^2) / E^2`. So the nearest of a row is the one that is nearest
//! along the row to the direction, moved by s times its distance from the row. Products of two linear factors stand for
//! s and q. The chosen point can be farther off than the face's nearest by 10 % of the bound, where cells are small. This
//! adds 1.1e-4 to the mean, as a part of it. Beside an edge the next face can have a nearer point; at 16 bits this adds
//! 4e-4.
//!
//! * Layout: faces, +X, -X, +Y, -Y, +Z, -Z, take the same number of codes each, one after another. A face's rows
//!   follow from its least v, points within a row from the least u: (u, v) is (y, z), (x, z), (x, y) on the faces of
//!   x, y, z. Codes past the last, which `encode` never writes, decode like the last.
//! * The six axes round-trip exactly. A direction mirrored at a coordinate plane decodes to the mirrored vector,
//!   exactly, if it does not lie in the plane.
//! * Good for: little error at a low cost, in files and on GPUs: only [`ico`](crate::ico) has less, mean and maximum
//!   together. Weaknesses: neighbouring rows and faces are unrelated, so that codes must not be interpolated; edges
//!   and corners of the cube do not round-trip.

use crate::arith::{
    coefficients, is_negative, mask, max, min, nearest_whole, negate_if, normalize, reciprocal, small_floor,
    with_sign,
};
use crate::codec::{Codec, Width};
use crate::direction::{is_usable, l1_norm};
use glam::{Vec2, Vec3};

/// The warp's weight: `u = X / (WEIGHT + |X|)` is 8/25 of the docs' u, for which the lattice's numbers make up.
const WEIGHT: f32 = 2.125;

coefficients! {
    /// The shear, `s = SHEAR u v`, in columns for a pair of rows: fitted with the height so that errors are least.
    SHEAR = 9.19;
    /// Coefficients of `q = (HEIGHT_0 - u) (HEIGHT_1 + HEIGHT_2 v)`.
    HEIGHT_0 = 0.5332, HEIGHT_1 = 5.082, HEIGHT_2 = 17.14;
}

/// The lattice of a width.
#[derive(Clone, Copy)]
struct Lattice {
    /// Half columns from a face's first point to its last, even.
    columns: i32,
    /// Rows from a face's middle to its last row, even.
    rows: i32,
    /// Half columns from a face's middle to its edge, times 25/8.
    across: f32,
    /// Rows from a face's middle to its edge, times 25/8.
    along: f32,
}

impl Lattice {
    /// Half columns in two rows, which have together as many points.
    #[inline(always)]
    const fn line(self) -> i32 {
        2 * self.columns + 1
    }

    /// The number of the middle within a face's codes.
    #[inline(always)]
    const fn middle(self) -> i32 {
        (self.rows * self.line() + self.columns) / 2
    }

    /// Codes of a face.
    #[inline(always)]
    const fn face(self) -> u32 {
        (2 * self.middle() + 1) as u32
    }
}

/// The point of the quarter face u, v >= 0 for X and Y: `p` over `side`. Its column, from the middle on, and its row in
/// pairs: whole numbers, or both halves.
#[inline(always)]
fn nearest(p: Vec2, side: f32, lattice: Lattice) -> Vec2 {
    let weight = WEIGHT * side;
    let u = p.x * reciprocal(weight + p.x);
    let v = p.y * reciprocal(weight + p.y);
    let (x, y) = (u * (0.5 * lattice.across), v * (0.5 * lattice.along));
    let (last_x, last_y) = (0.5 * lattice.columns as f32, 0.5 * lattice.rows as f32);

    let whole_y = nearest_whole(y);
    let from_whole = y - whole_y;
    let half = with_sign(0.5, from_whole);
    let shear = (u * v) * SHEAR;
    let x_of_whole = x - shear * from_whole;
    let x_of_half = x_of_whole + shear * half;
    let whole_x = min(nearest_whole(x_of_whole), last_x);
    let half_x = min(small_floor(x_of_half) + 0.5, last_x - 0.5);
    let off_whole = x_of_whole - whole_x;
    let off_half = x_of_half - half_x;

    // The squares of the distances from the rows differ by `|from_whole| - 1/4`.
    let height = (HEIGHT_0 - u) * (HEIGHT_1 + HEIGHT_2 * v);
    let beyond = off_whole * off_whole + height * (from_whole.abs() - 0.25);
    // There is no row beyond the last.
    let is_half = (off_half * off_half < beyond) & (y < last_y);
    if is_half { Vec2::new(half_x, whole_y + half) } else { Vec2::new(whole_x, whole_y) }
}

/// A place of whole numbers or halves, with the sign of a coordinate, as a number of halves from the first, which is as
/// many before the middle.
#[inline(always)]
fn halves(place: f32, coordinate: f32, first: i32) -> u32 {
    /// 1.5 2^22: its sums with numbers of up to 2^20 count in halves.
    const COUNTING_HALVES: f32 = 6_291_456.0;
    (negate_if(is_negative(coordinate), place) + (COUNTING_HALVES + 0.5 * first as f32)).to_bits() & mask(16)
}

/// The code of the direction of `v`. Without a usable direction, all is computed and then dropped.
#[inline(always)]
fn encode(v: Vec3, lattice: Lattice) -> u32 {
    let usable = is_usable(l1_norm(v));
    let a = v.abs();
    let (is_z, y_above) = (a.z >= max(a.x, a.y), a.y >= a.x);
    let x_or_y = if y_above { v.y } else { v.x };
    let front = if is_z { v.z } else { x_or_y };
    let p = Vec2::new(if is_z | y_above { v.x } else { v.y }, if is_z { v.y } else { v.z });
    let point = nearest(p.abs(), front.abs(), lattice);
    let row = halves(point.y, p.y, lattice.rows);
    let number =
        row.wrapping_mul(lattice.line() as u32).wrapping_add(halves(point.x, p.x, lattice.columns)) >> 1;

    let first = if y_above { 2 * lattice.face() } else { 0 };
    let first = if is_z { 4 * lattice.face() } else { first };
    let code = number.wrapping_add(first).wrapping_add(if is_negative(front) { lattice.face() } else { 0 });
    if usable { code } else { 4 * lattice.face() + lattice.middle() as u32 }
}

/// The direction of the lattice point of a code: unit length to within 2 ULP.
#[inline(always)]
fn decode(code: u32, lattice: Lattice) -> Vec3 {
    let points = lattice.face();
    let last = 6 * points - 1;
    let code = if code < last { code } else { last };
    let (is_x, is_z) = (code < 2 * points, code >= 4 * points);
    // Comparisons, which take less than another division.
    let first = if is_z { 4 * points } else { 2 * points };
    let on_axis = code - if is_x { 0 } else { first };
    let is_back = on_axis >= points;
    let doubled = 2 * (on_axis - if is_back { points } else { 0 });
    let line = doubled / lattice.line() as u32;
    let column = (doubled - line * lattice.line() as u32) as i32 - lattice.columns;
    let (column, row) = (column as f32, (line as i32 - lattice.rows) as f32);

    // X and Y over a common denominator.
    let across = lattice.across - column.abs();
    let along = lattice.along - row.abs();
    let p = normalize(Vec3::new((WEIGHT * column) * along, (WEIGHT * row) * across, across * along));
    let front = negate_if(is_back, p.z);
    Vec3::new(
        if is_x { front } else { p.x },
        if is_x {
            p.x
        } else if is_z {
            p.y
        } else {
            front
        },
        if is_z { front } else { p.y },
    )
}

/// Hexagonal cube code of `BITS` bits (16, 24 or 32).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct HexCube<const BITS: u32>;

impl<const BITS: u32> HexCube<BITS> {
    const LATTICE: Lattice = match BITS {
        16 => Lattice { columns: 96, rows: 56, across: 300.25, along: 176.65625 },
        24 => Lattice { columns: 1552, rows: 900, across: 4850.0 + 1.0 / 64.0, along: 2814.0625 },
        32 => Lattice {
            columns: 24778,
            rows: 14444,
            across: 77431.0 + 21.0 / 64.0,
            along: 45139.0 + 1.0 / 16.0,
        },
        _ => panic!("no constants for this width"),
    };
}

impl<const BITS: u32> Codec for HexCube<BITS>
where
    Self: Width,
{
    const BITS: u32 = BITS;
    /// The largest error that the module's docs derive, 0.54675, 0.033486 and 0.0020943 degrees, and some rounding.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.547,
        24 => 0.0336,
        32 => 0.002_11,
        _ => panic!("no constants for this width"),
    };
    const NULL: Option<[u32; 2]> = Some([!0 >> (32 - BITS), 0]); // past the last point
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        encode(v, Self::LATTICE)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        decode(if BITS == 32 { code } else { code & mask(BITS % 32) }, Self::LATTICE)
    }
}
