//! Octahedral lattices in the numberings and layouts of other software.

use super::turn::{Best, Turn, of_length};
use crate::arith::{ONE_AND_A_HALF_2_23, SIGN_BIT, dot, flip_sign, is_negative, mask, max, min, over};
use crate::codec::storage_bytes;
use crate::direction::{is_usable, l1_norm};
use crate::oct::lattice_precise;
use crate::slice::Coder;
use crate::uoct::from_lattice;
use glam::{Vec2, Vec3};

/// The square of an octahedral format: where its points lie, and how they are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lattice {
    /// From 0 to `2^b - 1`: no point in the middle.
    Unorm,
    /// From `1 - 2^(b-1)` to `2^(b-1) - 1`, in two's complement.
    Snorm,
    /// The points of [`Snorm`](Self::Snorm), numbered from 0.
    Biased,
    /// From -126 to 126.
    Of126,
}

impl Lattice {
    /// The largest coordinate, the middle (0, or 1/2 where there is no point), and the number of the coordinate 0.
    #[inline(always)]
    pub(super) fn sizes(self, bits: u32) -> (f32, f32, f32) {
        let (unorm, snorm) = (mask(bits) as f32 * 0.5, mask(bits - 1) as f32);
        match self {
            Self::Unorm => (unorm, 0.5, unorm),
            Self::Snorm => (snorm, 0.0, 0.0),
            Self::Biased => (snorm, 0.0, snorm),
            Self::Of126 => (126.0, 0.0, 0.0),
        }
    }

    /// The sign bit of a number, 0 without one.
    #[inline(always)]
    pub(super) fn sign(self, bits: u32) -> u32 {
        if self == Self::Snorm { 1 << (bits - 1) } else { 0 }
    }

    /// The bound of [`oct`](crate::oct)'s precise codes, for this lattice's steps, and the error of rounding positions in f32.
    pub(super) fn bound_deg(self, bits: u32) -> f32 {
        // Of 2 bits there are few points but the octahedron's vertices, acos(1 / sqrt(3)) from the middle of its faces.
        const OF_VERTICES_DEG: f32 = 54.74;
        let (m, ..) = self.sizes(bits);
        let bound = (core::f32::consts::SQRT_2 * (1.0 / m + 1.0 / 2_097_152.0)).to_degrees();
        if m < 2.0 { OF_VERTICES_DEG } else { bound }
    }

    /// The code of the point that is nearest to a usable direction, as the layout's decoder has it.
    #[inline(always)]
    pub(super) fn nearest_code(self, v: Vec3, bits: u32, pole_x: bool, layout: Layout) -> [u32; 2] {
        let (m, half, offset) = self.sizes(bits);
        let v = turned(v, pole_x);
        // As slices do: of one width, known to the compiler, `oct`'s search takes less.
        let is_oct = half == 0.0 && !pole_x && !layout.rounds();
        let at = if is_oct { lattice_precise(v, m).abs() } else { nearest(v, l1_norm(v), m, half) };
        // Of 2 bits, the nearest may be one beyond the square, which is the pole's opposite as well.
        let at = if at.x + at.y == 2.0 * m { Vec2::splat(m) } else { at };
        let at = if layout.rounds() { searched(v, at, m, layout.most()) } else { at };
        let e = signed(at, v, m, pole_x);
        // Of the corners, which are one direction, that of code 0 may stand for no vector.
        let e = if e == Vec2::splat(-m) { -e } else { e };
        layout.code([whole(e.x + offset), whole(e.y + offset)], bits)
    }

    /// The direction of a point, moved by `aim` steps.
    #[inline(always)]
    pub(super) fn direction(self, bits: u32, numbers: [i32; 2], pole_x: bool, aim: [f32; 2]) -> Vec3 {
        let (m, _, offset) = self.sizes(bits);
        turned_back(direction(numbers, m, offset, aim), pole_x)
    }
}

/// The direction of a point of the square up to m, by its numbers, moved by `aim` steps.
#[inline(always)]
fn direction([x, y]: [i32; 2], m: f32, offset: f32, aim: [f32; 2]) -> Vec3 {
    let (x, y) = ((x as f32 + aim[0]) - offset, (y as f32 + aim[1]) - offset);
    from_lattice(Vec2::new(min(max(x, -m), m), min(max(y, -m), m)), m)
}

/// The magnitudes of the point of [`crate::families::octahedral::nearest::nearest`], by the same sums, so that the codes of
/// formats are those of the codecs. Arranged for CPUs, where a selection of floats takes three instructions and one of masks or
/// signs takes one. Lattice points are exact, in whatever order they are summed.
#[inline(always)]
fn nearest(v: Vec3, norm: f32, m: f32, half: f32) -> Vec2 {
    let scale = over(m, norm);
    let p = Vec3::new(v.x.abs() * scale, v.y.abs() * scale, v.z * scale);
    let below = min(p.z, 0.0);
    let (x, y) = (p.x - below, p.y - below);
    let low = Vec2::new((x - half).trunc() + half, (y - half).trunc() + half);
    let sum = low.x + low.y;
    let z = (m - 1.0) - sum;
    let length = dot(p, p);

    let folded = min(z, 0.0);
    let d = Vec3::new((low.x + folded) - p.x, (low.y + folded) - p.y, z - p.z);
    let (square, part) = (dot(d, d), dot(d, p));
    let right = Turn::of(length, square + (2.0 * d.x + 1.0), part + p.x);
    let up = Turn::of(length, square + (2.0 * d.y + 1.0), part + p.y);

    let is_far = x + y >= sum + 1.0;
    let sign = if is_far { SIGN_BIT } else { 0 };
    let moved = (f32::from(is_far) - folded) - max(flip_sign(-1.0, sign) - z, 0.0);
    let square = square + 2.0 * ((moved * (d.x + d.y) + moved * moved) + flip_sign(d.z, sign)) + 1.0;
    let part = part + moved * (p.x + p.y) + flip_sign(p.z, sign);
    let at = Turn::of(length, square, part);

    let is_right = right.is_less(at);
    let is_up = up.is_less(if is_right { right } else { at });
    let (to_right, to_up) = ((is_right | is_far) & !is_up, (is_far & !is_right) | is_up);
    Vec2::new(low.x + f32::from(to_right), low.y + f32::from(to_up))
}

/// The point with the signs of a direction's x and y. Of several points for one direction Draco writes: those of the square's
/// border that have the sign of their side, and for all corners, which are the pole's opposite, (m, m).
#[inline(always)]
fn signed(at: Vec2, v: Vec3, m: f32, is_draco: bool) -> Vec2 {
    let (left, down) = (is_negative(v.x), is_negative(v.y));
    let (on_x, on_y) = (is_draco & (at.x == m), is_draco & (at.y == m));
    let (differ, is_inner) = (left ^ down, !(on_x & on_y));
    let (left, down) = ((left ^ (differ & on_y)) & is_inner, (down ^ (differ & on_x)) & is_inner);
    let negated = |is: bool, x: f32| flip_sign(x, if is { SIGN_BIT } else { 0 });
    Vec2::new(negated(left, at.x), negated(down, at.y))
}

/// 1.5 2^22: its sums with numbers of at most 2^21 have 1/2 as their last place.
const HALVES: f32 = 0.5 * ONE_AND_A_HALF_2_23;

/// A whole number as an integer.
#[inline(always)]
fn whole(x: f32) -> i32 {
    (x + HALVES).to_bits().wrapping_sub(HALVES.to_bits()) as i32 >> 1
}

/// The components with the pole last: Draco's is x, and its plane is (y, z).
#[inline(always)]
fn turned(v: Vec3, pole_x: bool) -> Vec3 {
    if pole_x { Vec3::new(v.y, v.z, v.x) } else { v }
}

#[inline(always)]
fn turned_back(v: Vec3, pole_x: bool) -> Vec3 {
    if pole_x { Vec3::new(v.z, v.x, v.y) } else { v }
}

/// The place of the numbers in a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// x in the low bits, y in the next.
    Pair,
    /// The low bytes of x and of y, then their high four bits, x low: three bytes.
    Bytes888,
    /// The magnitudes of x and y in 10 bits each, then a bit for each that is positive.
    Signs,
    /// OpenVDB's: the signs of the direction's x, y and z from bit 15 down, x in 6 bits, y in 7.
    Octant,
    /// x, y and m in three signed bytes, and a fourth.
    Lanes8,
    /// The same in words of 16 bits.
    Lanes16,
}

impl Layout {
    pub(super) fn bits(self, bits: u32) -> u32 {
        match self {
            Self::Pair | Self::Bytes888 => 2 * bits,
            Self::Signs => 22,
            Self::Octant => 16,
            Self::Lanes8 => 24,
            Self::Lanes16 => 48,
        }
    }

    pub(super) fn bytes(self, bits: u32) -> usize {
        match self {
            Self::Lanes8 => 4,
            Self::Lanes16 => 8,
            _ => storage_bytes(self.bits(bits)),
        }
    }

    /// True where decoders give integers, whose rounding counts.
    pub(super) fn rounds(self) -> bool {
        matches!(self, Self::Lanes8 | Self::Lanes16)
    }

    /// The error that the rounding of the decoder's result adds at most, half a step in each component.
    pub(super) fn rounding_deg(self) -> f32 {
        if self.rounds() { (0.5 * 3f32.sqrt() / (self.most() - 1.0)).to_degrees() } else { 0.0 }
    }

    /// The code of a point's numbers. This and what it calls have no closures, which would not get the instructions of a
    /// slice's level. Of a pair, bits of the numbers above their own do not matter.
    #[inline(always)]
    pub(super) fn code(self, [x, y]: [i32; 2], bits: u32) -> [u32; 2] {
        match self {
            Self::Pair => [(x as u32 & mask(bits)) | (y as u32 & mask(bits)) << bits, 0],
            Self::Bytes888 => [((x & 255 | (x & 0xf00) << 8) | (y & 255 | (y & 0xf00) << 4) << 8) as u32, 0],
            Self::Signs => {
                let positive = u32::from(x > 0) | u32::from(y > 0) << 1;
                [x.unsigned_abs() | y.unsigned_abs() << 10 | positive << 20, 0]
            }
            Self::Octant if x.abs() + y.abs() > 126 => {
                [octant(x.signum() * (126 - y.abs()), y.signum() * (126 - x.abs()), true), 0]
            }
            Self::Octant => [octant(x, y, false), 0],
            Self::Lanes8 => [(x as u32 & 255) | (y as u32 & 255) << 8 | mask(bits - 1) << 16, 0],
            Self::Lanes16 => [(x as u32 & 0xffff) | (y as u32) << 16, mask(bits - 1)],
        }
    }

    /// The numbers of the point of a code; `sign` is a pair's [`Lattice::sign`].
    #[inline(always)]
    pub(super) fn numbers(self, [low, _]: [u32; 2], sign: u32, bits: u32) -> [i32; 2] {
        match self {
            Self::Pair => {
                let (x, y) = (low & mask(bits), low >> bits & mask(bits));
                [(x ^ sign).wrapping_sub(sign) as i32, (y ^ sign).wrapping_sub(sign) as i32]
            }
            Self::Bytes888 => {
                [(low & 255 | (low >> 16 & 15) << 8) as i32, (low >> 8 & 255 | (low >> 20 & 15) << 8) as i32]
            }
            Self::Signs => {
                let (x, y) = ((low & mask(10)) as i32, (low >> 10 & mask(10)) as i32);
                [if low >> 20 & 1 == 1 { x } else { -x }, if low >> 21 & 1 == 1 { y } else { -y }]
            }
            Self::Octant => from_octant(low),
            Self::Lanes8 => [i32::from(low as i8), i32::from((low >> 8) as i8)],
            Self::Lanes16 => [i32::from(low as i16), i32::from((low >> 16) as i16)],
        }
    }

    /// The vector that the original's decoder makes of a code.
    #[inline(always)]
    pub(super) fn decode(self, code: [u32; 2], lattice: Lattice, pole_x: bool, bits: u32) -> Vec3 {
        let [x, y] = self.numbers(code, lattice.sign(bits), bits);
        let one = match self {
            Self::Lanes8 => (code[0] >> 16) as u8 as i8 as f32,
            Self::Lanes16 => code[1] as u16 as i16 as f32,
            _ => return lattice.direction(bits, [x, y], pole_x, [0.0; 2]),
        };
        let (x, y) = (x as f32, y as f32);
        let z = one - x.abs() - y.abs();
        let below = min(z, 0.0);
        let moved = |t: f32| t + if t >= 0.0 { below } else { -below };
        let v = Vec3::new(moved(x), moved(y), z);
        rounded(v.abs(), self.most()).copysign(v) / self.most()
    }

    /// The length of the integers that decoders give, where they do.
    #[inline(always)]
    fn most(self) -> f32 {
        if self == Self::Lanes8 { 127.0 } else { 32_767.0 }
    }
}

/// OpenVDB's code of (x, y, 126 - |x| - |y|), or of its mirror image `below` the equator. A component of 0 has no sign.
#[inline(always)]
fn octant(x: i32, y: i32, below: bool) -> u32 {
    let (a, b) = (x.abs(), y.abs());
    let below = below & (a + b < 126);
    let signs = u32::from(x < 0) << 15 | u32::from(y < 0) << 14 | u32::from(below) << 13;
    // Of x, 63 numbers have no room in 6 bits: they are mirrored into the other half of the triangle.
    let (a, b) = if a > 63 { (127 - a, 127 - b) } else { (a, b) };
    signs | (a << 7 | b) as u32
}

/// The reverse of [`octant`]. Patterns beyond the edge count as points of the edge.
#[inline(always)]
fn from_octant(code: u32) -> [i32; 2] {
    let (a, b) = ((code >> 7 & 63) as i32, (code & 127) as i32);
    let (a, b) = if a + b > 126 { (127 - a, 127 - b) } else { (a, b) };
    let b = b.min(126 - a);
    let (a, b) = if code >> 13 & 1 == 1 { (126 - b, 126 - a) } else { (a, b) };
    [if code >> 15 & 1 == 1 { -a } else { a }, if code >> 14 & 1 == 1 { -b } else { b }]
}

/// The magnitudes of the integers of meshoptimizer's filter, by those of a vector: of length `most`, rounded, ties up.
#[inline(always)]
fn rounded(v: Vec3, most: f32) -> Vec3 {
    // The greatest number below 1/2: what is below 1/2 stays below 1. As `round` of what is not negative, in fewer instructions.
    const ALMOST_HALF: f32 = 0.499_999_97;
    let length = (v.x * v.x + v.y * v.y + v.z * v.z).sqrt();
    let scale = if length > 0.0 { most / length } else { 0.0 };
    (v * scale + ALMOST_HALF).trunc()
}

/// Of a point `at` and those around it, by their magnitudes, that whose integers are nearest. Points of another octant are no
/// nearer than their mirror images.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn searched(v: Vec3, at: Vec2, m: f32, most: f32) -> Vec2 {
    let mirrored = |is: bool, p: Vec2| if is { Vec2::new(m - p.y, m - p.x) } else { p };
    let a = of_length(v.abs(), most);
    let p = mirrored(at.x + at.y > m, at);
    let p = p.extend(m - p.x - p.y);
    // The point itself comes first: of equals it stays.
    let best = Best { point: p, turn: Turn::by(a, rounded(p, most) - a) };
    let best = or_beside(best, a, p, Vec3::new(1.0, 0.0, -1.0), most);
    let best = or_beside(best, a, p, Vec3::new(0.0, 1.0, -1.0), most);
    let best = or_beside(best, a, p, Vec3::new(1.0, -1.0, 0.0), most);
    // Near a vertex two more are as near: those that are a step up or down in both of the smaller components.
    let (is_z, is_x) = (a.z >= max(a.x, a.y), a.x > a.y);
    let step = |is_largest: bool| if is_largest { -2.0 } else { 1.0 };
    let across = Vec3::new(step(is_x & !is_z), step(!(is_x | is_z)), step(is_z));
    mirrored(is_negative(v.z), or_beside(best, a, p, across, most).point.truncate())
}

/// A point a step beside another, in either direction, if it is one and its integers are nearer.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn or_beside(best: Best<Vec3>, v: Vec3, point: Vec3, step: Vec3, most: f32) -> Best<Vec3> {
    let or_nearer = |best: Best<Vec3>, point: Vec3| {
        let turn = Turn::by(v, rounded(point, most) - v);
        // One selection: with `Best::or` within another, slices take 3 % longer.
        let is_nearer = turn.is_less(best.turn) & (min(min(point.x, point.y), point.z) >= 0.0);
        if is_nearer { Best { point, turn } } else { best }
    };
    or_nearer(or_nearer(best, point + step), point - step)
}

/// A coder of slices for 3 bits or more, by the layout's number; `LARGEST` is the largest coordinate where it is fixed, or 0.
#[derive(Clone, Copy)]
pub(super) struct Fast<const LAYOUT: u8, const POLE_X: bool, const LARGEST: u16> {
    bits: u32,
    largest: f32,
    middle: f32,
    offset: f32,
    sign: u32,
    code_of_z: [u32; 2],
    /// The low word of the code of the corner (-m, -m), and what turns it into that of (m, m).
    corner: u32,
    to_other: u32,
}

impl<const LAYOUT: u8, const POLE_X: bool, const LARGEST: u16> Fast<LAYOUT, POLE_X, LARGEST> {
    const LAYOUT: Layout = match LAYOUT {
        0 => Layout::Pair,
        1 => Layout::Bytes888,
        2 => Layout::Signs,
        3 => Layout::Octant,
        4 => Layout::Lanes8,
        _ => Layout::Lanes16,
    };

    pub(super) fn new(lattice: Lattice, bits: u32) -> Self {
        let (largest, middle, offset) = lattice.sizes(bits);
        let code = |number: f32| Self::LAYOUT.code([whole(number); 2], bits)[0];
        let code_of_z = lattice.nearest_code(Vec3::Z, bits, POLE_X, Self::LAYOUT);
        let (corner, other) = (code(offset - largest), code(offset + largest));
        let sign = lattice.sign(bits);
        Self { bits, largest, middle, offset, sign, code_of_z, corner, to_other: corner ^ other }
    }
}

impl<const LAYOUT: u8, const POLE_X: bool, const LARGEST: u16> Coder<3> for Fast<LAYOUT, POLE_X, LARGEST> {
    #[inline(always)]
    fn bytes(self) -> usize {
        Self::LAYOUT.bytes(self.bits)
    }

    #[inline(always)]
    fn encode(self, v: [f32; 3]) -> [u32; 2] {
        let v = turned(Vec3::from_array(v), POLE_X);
        let norm = l1_norm(v);
        let m = if LARGEST > 0 { f32::from(LARGEST) } else { self.largest };
        // OpenVDB's codes have the sign of z: they need a point of the octant, not one that is folded out.
        let is_octant = matches!(Self::LAYOUT, Layout::Octant);
        let at = match LARGEST {
            0 => nearest(v, norm, m, self.middle),
            _ => lattice_precise(if is_octant { v.abs() } else { v }, m).abs(),
        };
        let at = if Self::LAYOUT.rounds() { searched(v, at, m, Self::LAYOUT.most()) } else { at };
        let e = signed(at, v, m, POLE_X);
        // The sum of halves of steps is exact; the number is above its last bit.
        let (x, y) = (e.x + (self.offset + HALVES), e.y + (self.offset + HALVES));
        let bits = if matches!(Self::LAYOUT, Layout::Pair | Layout::Bytes888) { 0 } else { HALVES.to_bits() };
        let (x, y) = (x.to_bits().wrapping_sub(bits) as i32 >> 1, y.to_bits().wrapping_sub(bits) as i32 >> 1);
        let [low, high] = match is_octant {
            true => [octant(x, y, is_negative(v.z)), 0],
            false => Self::LAYOUT.code([x, y], self.bits),
        };
        let low = low ^ if !POLE_X && low == self.corner { self.to_other } else { 0 };
        if is_usable(norm) { [low, high] } else { self.code_of_z }
    }

    #[inline(always)]
    fn decode(self, code: [u32; 2]) -> [f32; 3] {
        if Self::LAYOUT.rounds() {
            return Self::LAYOUT.decode(code, Lattice::Snorm, POLE_X, self.bits).to_array();
        }
        let numbers = Self::LAYOUT.numbers(code, self.sign, self.bits);
        turned_back(direction(numbers, self.largest, self.offset, [0.0; 2]), POLE_X).to_array()
    }
}

/// `$fast`, in which `$coder` is the coder of an octahedral format that has one, where `$is_wanted`; else `$other`. Web pages
/// fetch WebAssembly, so there only the layouts have one that most formats have.
macro_rules! with_lattice {
    ($format:expr, $is_wanted:expr, $coder:ident => $fast:expr, $other:expr) => {{
        use octahedral::{Fast, Lattice, Layout};
        let bits = $format.bits;
        let fast = match $format.row.mapping {
            Mapping::Octahedral { lattice, layout, pole_x, .. } if $is_wanted && bits > 2 => {
                Some((layout, pole_x, lattice))
            }
            _ => None,
        };
        with_lattice!(@each fast, bits, $coder => $fast, $other,
            Pair true Biased 0 any(), Pair false Snorm 32767 any(), Pair false Unorm 0 any(), Bytes888 false Unorm 0 any(),
            Signs false Snorm 1023 target_family = "wasm", Octant false Of126 126 target_family = "wasm",
            Lanes8 false Snorm 0 target_family = "wasm", Lanes16 false Snorm 0 target_family = "wasm")
    }};
    (@each $found:expr, $bits:expr, $coder:ident => $fast:expr, $other:expr,
        $($layout:ident $pole_x:literal $lattice:ident $largest:literal $unless:meta),*) => {
        match $found {
            $(#[cfg(not($unless))]
            Some((Layout::$layout, $pole_x, Lattice::$lattice)) => {
                let $coder = Fast::<{ Layout::$layout as u8 }, $pole_x, $largest>::new(Lattice::$lattice, $bits);
                $fast
            })*
            _ => $other,
        }
    };
}

pub(super) use with_lattice;
