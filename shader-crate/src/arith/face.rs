//! The faces of a cube: the one in a direction, and the components in its order.

use super::is_negative;
use glam::Vec3;

/// The face of the direction of `v`: twice the axis of the component of largest magnitude, the last one if several are
/// equal, and 1 if it is negative.
#[inline(always)]
pub fn face_of(v: Vec3) -> u32 {
    let (x, y, z) = (v.x.abs(), v.y.abs(), v.z.abs());
    let z_above = z >= x && z >= y;
    let y_above = y >= x;
    let axis = if z_above {
        2
    } else if y_above {
        1
    } else {
        0
    };
    let component = if z_above {
        v.z
    } else if y_above {
        v.y
    } else {
        v.x
    };
    2 * axis + if is_negative(component) { 1 } else { 0 }
}

/// The components in the order that `face` has them: u, v, and that of the face's axis.
#[inline(always)]
pub fn to_face(v: Vec3, face: u32) -> Vec3 {
    let axis = face >> 1;
    let xy = if axis == 0 { Vec3::new(v.y, v.z, v.x) } else { Vec3::new(v.z, v.x, v.y) };
    if axis >= 2 { v } else { xy }
}

/// The inverse of [`to_face`]. Faces 6 and 7 count as 4 and 5.
#[inline(always)]
pub fn from_face(uvw: Vec3, face: u32) -> Vec3 {
    let axis = face >> 1;
    let xy = if axis == 0 { Vec3::new(uvw.z, uvw.x, uvw.y) } else { Vec3::new(uvw.y, uvw.z, uvw.x) };
    if axis >= 2 { uvw } else { xy }
}
