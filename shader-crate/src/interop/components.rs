//! glTF's quantised normals: x, y and z in signed bytes or words, beside an unused lane.

use super::distance;
use super::plain::{most, snorm};
use glam::Vec3;

/// The deviation from unit length that glTF's validator lets pass: ACCESSOR_VECTOR3_NON_UNIT of glTF-Validator 434283be.
pub(super) const VALID: f32 = 0.006_74;

/// Rounding is among the trials: half the diagonal of a cell.
pub(super) fn bound_deg(bits: u32) -> f32 {
    (0.866_025_4 / (most(bits - 1) * (1.0 - VALID))).to_degrees()
}

fn code([x, y, z]: [i32; 3], bits: u32) -> [u32; 2] {
    match bits {
        8 => [u32::from_le_bytes([x as u8, y as u8, z as u8, 0]), 0],
        _ => [u32::from(x as u16) | u32::from(y as u16) << 16, u32::from(z as u16)],
    }
}

/// The vector of a code as glTF defines it: each component divided by the largest, the lowest counting as -1. Not of unit
/// length.
pub(super) fn decode([low, high]: [u32; 2], bits: u32) -> Vec3 {
    let [x, y, z, _] = low.to_le_bytes().map(|byte| f32::from(byte as i8));
    let v = match bits {
        8 => Vec3::new(x, y, z),
        _ => Vec3::from_array([low as i16, (low >> 16) as i16, high as i16].map(f32::from)),
    };
    v.to_array().map(|c| (c / most(bits - 1)).max(-1.0)).into()
}

/// The 3 by 3 by 3 points around one, which comes first.
fn cube([x, y, z]: [i32; 3]) -> [[i32; 3]; 27] {
    const STEPS: [i32; 3] = [0, 1, -1];
    core::array::from_fn(|n| [x + STEPS[n / 9], y + STEPS[n / 3 % 3], z + STEPS[n % 3]])
}

/// The vectors of the 3 by 3 by 3 points around the rounded one that encoders write alike whether they normalise first or not.
pub(super) fn neighbours(v: Vec3, bits: u32) -> impl Iterator<Item = Vec3> {
    let rounded = move |v: Vec3| v.normalize().to_array().map(|t| snorm(t, bits));
    let vectors = cube(rounded(v))
        .into_iter()
        .map(move |point| (point, Vec3::from_array(point.map(|c| c as f32 / most(bits - 1)))));
    vectors.filter(move |(point, vector)| rounded(*vector) == *point).map(|(_, vector)| vector)
}

/// The code of a usable direction: rounded, or the nearest that the validator takes for a unit vector.
pub(super) fn encode(v: Vec3, bits: u32, is_plain: bool) -> [u32; 2] {
    let plain = v.normalize().to_array().map(|t| snorm(t, bits));
    if is_plain {
        return code(plain, bits);
    }
    // Not normalised, which in f32 would turn the ray by a part of what codes of 16 bits are off.
    let mut nearest =
        Nearest { v, most: f64::from(most(bits - 1)), tangent_squared: f64::INFINITY, found: plain };
    // The points of about unit length come first: they are taken of those that are equally near.
    nearest.offer(cube(plain));
    // Of 8 bits that is all: valid lengths span less than two steps.
    if bits > 8 {
        nearest.offer_planes::<1>();
        // Those were all points less than `0.5 / sqrt(3)` steps off the ray. One is that near but for few vectors.
        if nearest.tangent_squared * nearest.most * nearest.most >= 1.0 / 12.0 {
            nearest.offer_planes::<4>();
        }
    }
    code(nearest.found, bits)
}

/// The nearest point to a ray so far, of those that the validator takes for unit vectors.
struct Nearest {
    v: Vec3,
    /// The largest component of a point.
    most: f64,
    /// Of the angle to the ray.
    tangent_squared: f64,
    found: [i32; 3],
}

impl Nearest {
    /// The lengths between which points are valid.
    fn lengths(&self) -> [f64; 2] {
        [-VALID, VALID].map(|part| self.most * (1.0 + f64::from(part)))
    }

    fn is_valid(&self, [x, y, z]: [f64; 3]) -> bool {
        let ([shortest, longest], square) = (self.lengths(), x * x + y * y + z * z);
        let fits = x.abs().max(y.abs()).max(z.abs()) <= self.most;
        fits && shortest * shortest < square && square < longest * longest
    }

    fn offer<const N: usize>(&mut self, points: [[i32; 3]; N]) {
        // An array, for which the compiler makes vector instructions.
        let distances = points.map(|point| {
            let distance = distance(self.v, Vec3::from_array(point.map(|c| c as f32)));
            if self.is_valid(point.map(f64::from)) { distance } else { f64::INFINITY }
        });
        for (distance, point) in distances.into_iter().zip(points) {
            if distance < self.tangent_squared {
                (self.tangent_squared, self.found) = (distance, point);
            }
        }
    }

    /// Offers, in each plane of the largest component, the point next to the ray, or the four around it.
    fn offer_planes<const CORNERS: u32>(&mut self) {
        let v = self.v.to_array().map(f64::from);
        let axis = (1..3).fold(0, |best, axis| if v[axis].abs() > v[best].abs() { axis } else { best });
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let square = v[i] * v[i] + v[j] * v[j] + v[axis] * v[axis];
        // In f32, which is off by less than the plane more on either side.
        let [shortest, longest] =
            self.lengths().map(|length| length * f64::from(self.v.normalize()[axis].abs()));
        for k in shortest as i32..=(longest + 1.0).min(self.most) as i32 {
            let along = f64::from(k) * v[axis].signum();
            let (x, y) = (along * (v[i] / v[axis]), along * (v[j] / v[axis]));
            for corner in 0..CORNERS {
                let (to_x, to_y) = (beside(x, corner & 1 == 1), beside(y, corner & 2 == 2));
                let (off_x, off_y) = (to_x - x, to_y - y);
                let along_ray = off_x * v[i] + off_y * v[j];
                let off = (off_x * off_x + off_y * off_y - along_ray * along_ray / square)
                    * (v[axis] * v[axis] / square);
                // As if the point lay as far along the ray as the plane: it is off by less than 1e-4 of that.
                if off < 1.001 * self.tangent_squared * (along * along) {
                    let mut point = [along as i32; 3];
                    (point[i], point[j]) = (to_x as i32, to_y as i32);
                    self.offer([point]);
                }
            }
        }
    }
}

/// The nearest whole number, or the one on the other side.
fn beside(x: f64, other: bool) -> f64 {
    // Its sums with numbers below 2^51 are whole.
    const ONE_AND_A_HALF_2_52: f64 = 6_755_399_441_055_744.0;
    let nearest = (x + ONE_AND_A_HALF_2_52) - ONE_AND_A_HALF_2_52;
    nearest + if other { (x - nearest).signum() } else { 0.0 }
}
