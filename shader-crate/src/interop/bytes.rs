//! glTF's normals in bytes in slices: in f32, several at a time, and in float64 where that does not tell which is nearest.

use super::components::{VALID, code, decode, encode};
use super::turn::{Best, Turn, of_length};
use super::usable;
use crate::arith::dot;
use crate::direction::or_z;
use crate::slice::machine::Level;
use crate::slice::{Coder, LengthMismatch, Vector, encode_slice_by};
use glam::Vec3;

/// The nearest codes of each vector.
pub(super) fn encode_slice<V: Vector>(
    level: Level,
    vectors: &[V],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    encode_slice_by(Bytes, level, vectors, codes)?;
    for (v, code) in vectors.iter().zip(codes.chunks_exact_mut(4)).filter(|(_, code)| code[3] != 0) {
        code.copy_from_slice(&encode(usable((*v).into()), 8, false)[0].to_le_bytes());
    }
    Ok(())
}

/// The nearest code by f32. Where that does not tell which of some points is nearest, the unused lane is not 0.
#[derive(Clone, Copy)]
struct Bytes;

impl Coder<3> for Bytes {
    #[inline(always)]
    fn bytes(self) -> usize {
        4
    }

    /// Valid lengths span less than two steps, so that the nearest point is among the 3 by 3 by 3 around the rounded one.
    #[inline(always)]
    fn encode(self, v: [f32; 3]) -> [u32; 2] {
        let ray = of_length(or_z(v.into()).0, BYTE);
        let rounded = Vec3::new(ray.x.round_ties_even(), ray.y.round_ties_even(), ray.z.round_ties_even());
        let (best, is_unsure) = three!((Best::none(rounded), false), |found, x| {
            three!(found, |found, y| three!(found, |found, z| or_nearer(
                found,
                ray,
                rounded + Vec3::new(x, y, z)
            )))
        });
        let Vec3 { x, y, z } = best.point;
        [code([x as i32, y as i32, z as i32], 8)[0] | u32::from(is_unsure) << 24, 0]
    }

    fn decode(self, code: [u32; 2]) -> [f32; 3] {
        decode(code, 8).to_array()
    }
}

/// The largest number of a byte.
const BYTE: f32 = 127.0;

/// Angles may be rounded to the other order whose squared tangents, times `BYTE` to the eighth power, differ by less. The ray is
/// turned by up to 2^-23, which is 2^-16 steps: of two points 2 steps apart the squares of the distances, times `BYTE` to the
/// sixth power, change by 2^28 against each other. The sums are rounded by less.
const ABOUT: f32 = 536_870_912.0;

/// This point, if it is valid and nearer, and whether f32 tells.
#[inline(always)]
fn or_nearer((best, is_unsure): (Best<Vec3>, bool), ray: Vec3, point: Vec3) -> (Best<Vec3>, bool) {
    const SHORTEST: f32 = BYTE * (1.0 - VALID);
    const LONGEST: f32 = BYTE * (1.0 + VALID);
    let square = dot(point, point);
    // A number beyond the largest makes a vector too long.
    let is_valid = (square > SHORTEST * SHORTEST) & (square < LONGEST * LONGEST);
    let turn = Turn::by(ray, point - ray);
    let is_about = is_valid & turn.is_about(best.turn, ABOUT);
    (if is_valid { best.or(point, turn) } else { best }, is_unsure | is_about)
}
