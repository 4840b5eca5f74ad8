//! Icosahedral codes: a triangular lattice on the faces of an icosahedron, warped to be even on the sphere.
//!
//! Source: dividing an icosahedron's faces so, into `10 n^2 + 2` points, is the oldest way to geodesic domes and grids
//! (Coxeter 1971, "Virus macromolecules and geodesic domes", class I). The warp, its inverse and the layout of the
//! codes are this library's own.
//!
//! # The lattice
//!
//! The icosahedron has its vertices at (0, +-1, +-p), (+-p, 0, +-1) and (+-1, +-p, 0), p the golden ratio: it is symmetric
//! about the coordinate planes, and the axes go through the middles of six edges. A lattice point has a whole number i
//! for each vertex V of a face, of the sum n, and stands for the direction of the sum of `w(i) V`, `w(i) = i (N - i)`.
//!
//! With `w(i) = i` this would be the flat lattice, which seen from the centre is coarsest in the middle of the faces.
//! The warp evens that out. `N = n / 0.215` has the least maximum: there the largest circumcircles of the triangles
//! between neighbours, in a face's middle and at its vertices, are equal to 0.1 %. All of these triangles are acute, so
//! that no direction is further from all lattice points than the radius of the largest circumcircle. At 16 bits N
//! is n / 0.2, for a lesser mean: no more than the best that the survey has, which took a table.
//!
//! | degrees | n | N | points | mean error | of the bound's | max error | of the bound's | with arithmetic |
//! |---|---|---|---|---|---|---|---|---|
//! | `ico16` | 80 | 400 | 64,002 | 0.30349 | 1.0141 | 0.50853 | 1.0331 | 0.50876 |
//! | `ico24` | 1294 | 6019 | 16,744,362 | 0.018761 | 1.0030 | 0.031216 | 1.0147 | 0.031222 |
//! | `ico32` | 20724 | 96391 | 4,294,841,762 | 0.0011715 | 1.0021 | 0.0019490 | 1.0136 | 0.0019568 |
//!
//! The bound is that of the plane, of equal hexagonal cells as many as the bits have patterns: mean and maximum of no
//! code are less by more than the sphere's curvature makes up. Of the distance from it at 16 bits 1.2 % are because n = 81
//! takes more than 16 bits. n is even for the sake of the axes, which costs `ico24` 0.1 % (n = 1295).
//!
//! # Layout
//!
//! Eight faces lie in an octant each. Twelve straddle a coordinate plane: with one side across it at right angles, their
//! base, and the opposite vertex, their apex, in it. Two of them share each base. The points of a base belong to the
//! one whose apex has a positive coordinate; the points of the other sides belong to the face that straddles, but an
//! apex to the base that it is an end of.
//!
//! * From code 0: six blocks, of n rows of n + 2 codes. Block `2 c + s` has the two faces with the same base, which
//!   straddle y = 0, z = 0 or x = 0 (c = 0, 1, 2); their base is on the side of z, x or y, positive for s = 0 and
//!   negative for s = 1, and their apices point towards +-x, +-y or +-z. Row r begins with the n + 1 - r points at r
//!   steps from the base on the face with the positive apex, then come the r + 1 points at n - r steps from it on the
//!   other, both in the direction from the straddled coordinate's negative side to its positive one.
//! * From code `6 n (n + 2)`: four blocks, of n - 2 rows of n - 1 codes, with the points within the octants. Block
//!   `s + 2 t` has two octants, whose signs of y and z are s and t (1 is negative). Let a, b and c be the numbers of
//!   the vertices in the planes x = 0, z = 0 and y = 0. Row r begins with the n - 2 - r points of c = r + 1 and
//!   x > 0, then come the r + 1 points of c = n - 2 - r and x < 0, both from a = 1 upwards.
//! * The last code of row 0 of the six blocks is a second one for the negative apex. Patterns past the last code, `10
//!   n^2 + 7`, decode as that does. Neither is ever written: each point has one code.
//!
//! # Encoding
//!
//! Signs bring a direction to the positive octant, where three linear forms tell its face and are its flat coordinates on
//! the octant's face; those on one of the three others follow by reflection. The warp is inverted by a cubic that is
//! good to 1e-4 of an edge (0.002 at 16 bits), and one step of Newton's method from the whole numbers next to that,
//! which leaves less than 0.002 steps at 16 bits and 0.0001 at the others. Of the triangle's three corners the
//! nearest is chosen, by the distances between neighbours around there: at 16 bits, where these change from point to
//! point, a corner is taken that is up to 0.4 % of the maximum further off than the nearest. (Rounding the three
//! coordinates instead would give cells that reach 7 % beyond the bound.)
//!
//! What Newton's step takes from each other at 32 bits differs by few steps, so that the difference is exact; rounded
//! are the weights `w(i)` and the direction's coordinates, all relative to themselves. That, the golden ratio as a float
//! and the decoder's rounding, of at most 1.2e-7 radians, make the error of a direction at most 6.4e-6 degrees greater
//! than the nearest lattice point's: 0.4 % of the maximum and 0.0002 % of the mean. At 24 bits it is 5.4e-6.
//!
//! * The six axes round-trip exactly. Mirrored at a coordinate plane, a direction decodes to the decoded vector's image,
//!   exactly, if it does not lie in the plane; with the axes cyclically exchanged, within rounding.
//! * Good for: the least error that 16, 24 and 32 bits can have, to 4 %, without a table. Weak: the cost. To encode
//!   takes six times as many operations as [`oct`](crate::oct), to decode three times as many; kernels on lavapipe take 3
//!   and 1.5 times as long. Codes next to each other in neighbouring rows are unrelated, so that they must not be
//!   interpolated.

use crate::codec::Codec;
use crate::direction::or_z;
use crate::math::{dot, floor, is_negative, negate_if, normalize};
use crate::scalar::{mask, whole_to_u32};
use glam::Vec3;

/// The golden ratio: 1e-8 above it.
const GOLDEN: f32 = 1.618_034;

/// The reciprocal of the golden ratio.
const GOLDEN_LESS_1: f32 = 0.618_034;

/// Of the cubic that the inverse of the warp starts from: fitted to N = n / 0.215 so that its greatest error is least.
const INVERSE_0: f32 = 0.214316;
/// See [`INVERSE_0`].
const INVERSE_1: f32 = -0.121124;
/// See [`INVERSE_0`].
const INVERSE_2: f32 = 0.117389;

/// Stands for the faces in octants where a number tells what plane a face straddles: 0 is y = 0, 1 is z = 0, 2 is x = 0.
const OCTANT: u32 = 3;

/// The lattice of a width.
#[derive(Clone, Copy)]
pub struct Lattice {
    /// Steps along an edge of the icosahedron, even.
    pub n: u32,
    /// N, where the weight of a vertex is `i (N - i)`.
    pub warp: f32,
}

/// The lattice of the format of 16 bits.
pub const LATTICE_16: Lattice = Lattice { n: 80, warp: 400.0 };

/// The lattice of the format of 24 bits.
pub const LATTICE_24: Lattice = Lattice { n: 1294, warp: 6019.0 };

/// The lattice of the format of 32 bits.
pub const LATTICE_32: Lattice = Lattice { n: 20724, warp: 96391.0 };

// Below, a vector of three numbers that belong to a face's vertices has: in z that of the apex, in x that of the base's
// end on the straddled coordinate's positive side, in y that of the other end. On the face of the positive octant
// they are (0, 1, p), (1, p, 0) and (p, 0, 1) for x, y and z; the face that straddles y = 0 has (0, -1, p) for y.
impl Lattice {
    /// The first code of the faces in octants.
    #[inline(always)]
    const fn octants(self) -> u32 {
        6 * self.n * (self.n + 2)
    }

    /// The last code that encoding writes.
    #[inline(always)]
    const fn last(self) -> u32 {
        self.octants() + 4 * (self.n - 2) * (self.n - 1) - 1
    }

    /// The lattice point of the numbers x and z.
    #[inline(always)]
    fn point(self, x: f32, z: f32) -> Vec3 {
        Vec3::new(x, (self.n as f32 - x) - z, z)
    }

    /// The weights of a lattice point.
    #[inline(always)]
    fn weights(self, i: Vec3) -> Vec3 {
        Vec3::new(i.x * (self.warp - i.x), i.y * (self.warp - i.y), i.z * (self.warp - i.z))
    }

    /// The derivatives of the weights.
    #[inline(always)]
    fn slopes(self, i: Vec3) -> Vec3 {
        Vec3::new(self.warp - 2.0 * i.x, self.warp - 2.0 * i.y, self.warp - 2.0 * i.z)
    }
}

/// The components in cyclic order so that those of the face that straddles y = 0 come to stand for those of the face
/// that straddles `plane`; as they are for [`OCTANT`].
#[inline(always)]
fn turn(v: Vec3, plane: u32) -> Vec3 {
    if plane == 1 {
        Vec3::new(v.z, v.x, v.y)
    } else if plane == 2 {
        Vec3::new(v.y, v.z, v.x)
    } else {
        v
    }
}

/// The plane that the neighbour of the positive octant's face straddles on the side opposite to the first vertex that is
/// marked; [`OCTANT`] if none is.
#[inline(always)]
fn neighbour(x: bool, y: bool, z: bool) -> u32 {
    if y {
        0
    } else if x {
        1
    } else if z {
        2
    } else {
        OCTANT
    }
}

#[inline(always)]
fn sum(v: Vec3) -> f32 {
    (v.x + v.y) + v.z
}

/// The inverse of the warp, for a coordinate `t` on the flat face and the sums of all three's squares and cubes: good to
/// 1e-4.
#[inline(always)]
fn unwarped(t: f32, squares: f32, cubes: f32) -> f32 {
    t + t * ((t - squares) * (INVERSE_0 + INVERSE_1 * squares) + INVERSE_2 * (t * t - cubes))
}

/// The lattice point nearest in angle to the direction of the weights `p`, which may be of any sum.
#[inline(always)]
fn nearest(p: Vec3, lattice: Lattice) -> Vec3 {
    let n = lattice.n as f32;
    let t = p * (1.0 / sum(p));
    let t_squared = t * t;
    let (squares, cubes) = (sum(t_squared), dot(t_squared, t));
    let start = lattice.point(
        floor(unwarped(t.x, squares, cubes) * n + 0.5),
        floor(unwarped(t.z, squares, cubes) * n + 0.5),
    );

    // Newton's method for i and the factor of p, where the i keep their sum; with one division for those by the slopes
    // and by their sum.
    let w = lattice.weights(start);
    let q = t * sum(w);
    let r = q - w;
    let d = lattice.slopes(start);
    let others = Vec3::new(d.y * d.z, d.z * d.x, d.x * d.y);
    let (r_sum, q_sum) = (dot(r, others), dot(q, others));
    let per_all = 1.0 / (q_sum * (d.x * others.x));
    let off_x = (r.x * q_sum - q.x * r_sum) * (others.x * per_all);
    let off_z = (r.z * q_sum - q.z * r_sum) * (others.z * per_all);

    // Two triangles share the cell between whole x and z: one has the lower corner, the other, turned by half, the upper.
    let (whole_x, whole_z) = (floor(off_x), floor(off_z));
    let (in_x, in_z) = (off_x - whole_x, off_z - whole_z);
    let is_upper = in_x + in_z > 1.0;
    let (to_corner, step) = if is_upper { (1.0, -1.0) } else { (0.0, 1.0) };
    let (corner_x, corner_z) = (start.x + (whole_x + to_corner), start.z + (whole_z + to_corner));
    let (in_x, in_z) = if is_upper { (1.0 - in_x, 1.0 - in_z) } else { (in_x, in_z) };

    // The products of a step along x and one along z, with themselves, each other and q, then without their parts
    // along q: vertices have the products 2 + p with themselves and p with each other.
    let (sum_x, sum_z, y_squared) = (d.x - d.y, d.z - d.y, d.y * d.y);
    let sum_q = GOLDEN * sum(q);
    let along_x = 2.0 * (d.x * q.x - d.y * q.y) + sum_x * sum_q;
    let along_z = 2.0 * (d.z * q.z - d.y * q.y) + sum_z * sum_q;
    let per_square = 1.0 / (2.0 * dot(q, q) + sum(q) * sum_q);
    let (part_x, part_z) = (along_x * per_square, along_z * per_square);
    let xx = (2.0 * (d.x * d.x + y_squared) + GOLDEN * (sum_x * sum_x)) - along_x * part_x;
    let zz = (2.0 * (d.z * d.z + y_squared) + GOLDEN * (sum_z * sum_z)) - along_z * part_z;
    let xz = (2.0 * y_squared + GOLDEN * (sum_x * sum_z)) - along_x * part_z;

    // By how much the square of the distance grows from the corner to the ends of both steps.
    let growth_x = xx - 2.0 * (in_x * xx + in_z * xz);
    let growth_z = zz - 2.0 * (in_x * xz + in_z * zz);
    let is_x = growth_x < 0.0;
    let is_z = growth_z < if is_x { growth_x } else { 0.0 };
    let x = if is_x && !is_z { corner_x + step } else { corner_x };
    let z = if is_z { corner_z + step } else { corner_z };
    lattice.point(x, z)
}

/// The code of the lattice point that is nearest to the direction of `v`.
#[inline(always)]
pub fn encode(v: Vec3, lattice: Lattice) -> u32 {
    let (v, _) = or_z(v);
    let n = lattice.n as f32;
    let a = v.abs();
    // Scaled so that a vertex such as (0, 1, p) has the coordinate 2 p.
    let flat = Vec3::new(
        GOLDEN_LESS_1 * (a.y + a.z) + (a.z - a.x),
        GOLDEN_LESS_1 * (a.x + a.y) + (a.y - a.z),
        GOLDEN_LESS_1 * (a.z + a.x) + (a.x - a.y),
    );
    let plane = neighbour(is_negative(flat.x), is_negative(flat.y), is_negative(flat.z));
    // By reflection: the vertices across a side have the sum of the side's two, divided by p.
    let p = turn(flat, plane);
    let shared = if is_negative(p.y) { GOLDEN_LESS_1 * p.y } else { 0.0 };
    let i = nearest(Vec3::new(p.x + shared, p.y.abs(), p.z + shared), lattice);

    // The sides of octants' faces are their neighbours', and apices are of the next plane's base.
    let side = neighbour(i.x < 0.5, i.y < 0.5, i.z < 0.5);
    let owner = if plane == OCTANT { side } else { plane };
    let i = if plane == OCTANT { turn(i, side) } else { i };
    let is_apex = i.z > n - 0.5;
    let next = if owner == 2 { 0 } else { owner + 1 };
    let plane = if is_apex { next } else { owner };
    let i = if is_apex { Vec3::new(n, 0.0, 0.0) } else { i };

    let (x, y, z) = (is_negative(v.x), is_negative(v.y), is_negative(v.z));
    let (apex_side, straddled_side, base_side) = if plane == 1 {
        (y, z, x)
    } else if plane == 2 {
        (z, x, y)
    } else {
        (x, y, z)
    };
    let is_octant = plane == OCTANT;
    let across = if !is_octant && straddled_side { i.y } else { i.x };
    let is_second = apex_side && i.z > 0.5;
    let (row, column) = if is_octant {
        let (row, column) = (i.z - 1.0, across - 1.0);
        if is_second { ((n - 3.0) - row, (row + 1.0) + column) } else { (row, column) }
    } else if is_second {
        (n - i.z, (i.z + 1.0) + across)
    } else {
        (i.z, across)
    };

    let (straddled_bit, base_bit) = (if straddled_side { 1 } else { 0 }, if base_side { 1 } else { 0 });
    let block = if is_octant { straddled_bit + 2 * base_bit } else { 2 * plane + base_bit };
    let (first, rows, length) = if is_octant {
        (lattice.octants(), lattice.n - 2, lattice.n - 1)
    } else {
        (0, lattice.n, lattice.n + 2)
    };
    first + (block * rows + whole_to_u32(row)) * length + whole_to_u32(column)
}

/// The direction of the lattice point of a code: unit length to within 2 ULP. Past the last code, that of the last.
#[inline(always)]
pub fn decode(code: u32, lattice: Lattice) -> Vec3 {
    let n = lattice.n as f32;
    let code = if code < lattice.last() { code } else { lattice.last() };
    let is_octant = code >= lattice.octants();
    let (first, length) = if is_octant { (lattice.octants(), lattice.n - 1) } else { (0, lattice.n + 2) };
    let (per_length, rows, per_rows) =
        if is_octant { (2.0 / (n - 1.0), n - 2.0, 1.0 / (n - 2.0)) } else { (2.0 / (n + 2.0), n, 1.0 / n) };

    // `index / 2` fits a signed integer, which processors convert faster. The quotient is between 0.04 less and 0.03 more
    // than the exact one: so `line` is it or the next, and then the remainder wraps.
    let index = code - first;
    let line = floor((index >> 1) as i32 as f32 * per_length + 0.05);
    let rest = index.wrapping_sub(whole_to_u32(line) * length);
    let is_next = rest >= length;
    let line = if is_next { line - 1.0 } else { line };
    let column = (if is_next { rest.wrapping_add(length) } else { rest }) as i32 as f32;
    let block = floor((line + 0.5) * per_rows);
    let row = line - block * rows;

    let is_second = column > (rows - row) - if is_octant { 1.0 } else { 0.0 };
    let (x, z) = if is_octant {
        if is_second { ((column + row) - (n - 3.0), (n - 2.0) - row) } else { (column + 1.0, row + 1.0) }
    } else if is_second {
        ((column + row) - (n + 1.0), n - row)
    } else {
        (column, row)
    };
    let w = lattice.weights(lattice.point(x, z));
    let (to_x, to_y, to_z) = if is_octant { (w.y, GOLDEN * w.y, 0.0) } else { (0.0, -w.y, w.y) };
    let v = Vec3::new(GOLDEN * w.z + to_x, w.x + to_y, GOLDEN * (w.x + to_z) + w.z);
    let block = whole_to_u32(block);
    let (plane, base_bit) = if is_octant { (OCTANT, block >> 1) } else { (block >> 1, block & 1) };
    let v = Vec3::new(
        negate_if(is_second, v.x),
        negate_if(is_octant && block & 1 != 0, v.y),
        negate_if(base_bit != 0, v.z),
    );
    turn(normalize(v), plane)
}

/// Icosahedral code of `BITS` bits (16, 24 or 32).
pub struct Ico<const BITS: u32>;

impl<const BITS: u32> Ico<BITS> {
    const LATTICE: Lattice = match BITS {
        16 => LATTICE_16,
        24 => LATTICE_24,
        _ => LATTICE_32,
    };
}

impl<const BITS: u32> Codec for Ico<BITS> {
    const NAME: &'static str = match BITS {
        16 => "ico16",
        24 => "ico24",
        32 => "ico32",
        _ => panic!("Ico has 16, 24 or 32 bits"),
    };
    const BITS: u32 = BITS;
    /// The radius of the largest circumcircle of neighbouring lattice points, 0.508532, 0.0312163 and 0.0019490 degrees,
    /// and what encoding and arithmetic add: at most 2.3e-4, 5.5e-6 and 7.8e-6 over millions of directions at the
    /// largest circumcentres, which half as much again stands for here.
    const MAX_ERROR_DEG: f32 = match BITS {
        16 => 0.508533 + 3.4e-4,
        24 => 0.0312164 + 8e-6,
        _ => 0.00194902 + 1.17e-5,
    };
    type Code = u32;

    #[inline(always)]
    fn encode(v: Vec3) -> u32 {
        encode(v, Self::LATTICE)
    }

    #[inline(always)]
    fn decode(code: u32) -> Vec3 {
        decode(if BITS == 32 { code } else { code & mask(BITS % 32) }, Self::LATTICE)
    }
}

/// 16 bits: 64,002 directions.
pub type Ico16 = Ico<16>;
/// 24 bits: 16,744,362 directions.
pub type Ico24 = Ico<24>;
/// 32 bits: 4,294,841,762 directions.
pub type Ico32 = Ico<32>;
