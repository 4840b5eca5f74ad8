//! The scene: as the survey's, curved, polygonal and bumpy bodies, and a nearly flat panel in front of them, over the sky.

use super::camera::Camera;
use super::picture::Size;
use super::shapes::{self, Body};
use super::{Shot, View};
use glam::{DMat3, DMat4, DVec3};
use unitvec_mesh::MeshError;

/// The objects by their numbers, which begin with 1: 0 is where nothing is drawn.
pub const OBJECTS: [&str; 5] = ["bunny", "teapot", "faceted body", "bumpy sphere", "panel"];

const BUNNY: u32 = 1;
const TEAPOT: u32 = 2;
const FACETED: u32 = 3;
const BUMPY: u32 = 4;
const PANEL: u32 = 5;

/// The bodies, in the order of their numbers.
pub(super) fn bodies() -> Result<Vec<Body>, MeshError> {
    Ok(vec![
        shapes::of_obj("bunny.obj", unitvec_mesh::BUNNY)?,
        shapes::of_obj("teapot.obj", unitvec_mesh::TEAPOT)?,
        shapes::faceted(),
        shapes::bumpy_sphere(),
        shapes::panel(),
    ])
}

/// An object where it stands.
pub(super) struct Placed {
    pub(super) object: u32,
    pub(super) rotation: DMat3,
    scale: f64,
    middle: DVec3,
}

impl Placed {
    pub(super) fn world_from_object(&self) -> DMat4 {
        let scaled = DMat4::from_mat3(self.rotation) * DMat4::from_scale(DVec3::splat(self.scale));
        DMat4::from_translation(self.middle) * scaled
    }
}

/// The directions over the ground to the camera's right and from the scene to the camera. The camera is 140 degrees around from
/// the sun, which shines from behind the scene and from the left, and is seen on the panel.
fn sides() -> (DVec3, DVec3) {
    let sun = DVec3::new(0.6, 0.0, 0.8);
    let across = DVec3::new(0.8, 0.0, -0.6);
    let (sine, cosine) = 140f64.to_radians().sin_cos();
    let toward = cosine * sun + sine * across;
    (DVec3::Y.cross(toward), toward)
}

/// The camera of a shot, and the objects that it sees.
pub(super) fn arrange(shot: &Shot, size: Size) -> (Camera, Vec<Placed>) {
    let (right, toward) = sides();
    let place = |along: f64, up: f64, near: f64| right * along + DVec3::Y * up + toward * near;
    let camera = |eye, at, degrees| {
        let whole = Camera::new(eye, at, degrees, size);
        shot.part.map_or(whole, |part| whole.closer(part))
    };
    let turn_degrees = f64::from(shot.turn_degrees);
    match shot.view {
        View::Scene => (camera(place(0.0, 1.5, 11.0), place(0.0, 0.45, 0.0), 31.0), all(place, 0.0)),
        View::Panel => {
            (camera(place(0.0, 1.5, 11.0), place(-0.9, -1.2, 1.6), 18.0), all(place, turn_degrees))
        }
        View::Turning => {
            let turn = DMat3::from_rotation_y(turn_degrees.to_radians());
            (
                camera(place(0.0, 2.0, 8.0), DVec3::ZERO, 17.0),
                vec![Placed { rotation: facing(0.0) * turn, ..single(BUMPY) }],
            )
        }
        View::Model(front) => {
            let placed = Placed { rotation: facing(0.0) * to_front(front), ..single(BUNNY) };
            // A sphere of radius 1 fills 15 degrees but for a margin.
            (camera(toward * 8.0, DVec3::ZERO, 15.0), vec![placed])
        }
        View::Side(side) => (camera(corner(side) * 5.0, DVec3::ZERO, 17.0), vec![single(BUMPY)]),
    }
}

/// An object by itself.
fn single(object: u32) -> Placed {
    Placed { object, rotation: DMat3::IDENTITY, scale: 1.0, middle: DVec3::ZERO }
}

/// Turns a direction to +Z, and +Y as far upwards as that allows; of a direction along Y, Z.
fn to_front(direction: [f32; 3]) -> DMat3 {
    let front = glam::Vec3::from(direction).as_dvec3().try_normalize().unwrap_or(DVec3::Z);
    let up = if front.y.abs() < 0.999 { DVec3::Y } else { DVec3::Z };
    let right = up.cross(front).normalize();
    DMat3::from_cols(right, front.cross(right), front).transpose()
}

/// A corner of a tetrahedron: (1, 1, 1) with the signs of two components changed, or of none.
fn corner(side: u8) -> DVec3 {
    let sign = |changed: bool| if changed { -1.0 } else { 1.0 };
    let (x, y) = (side & 1 != 0, side & 2 != 0);
    DVec3::new(sign(x), sign(y), sign(x != y))
}

/// Turns an object whose front is +Z to the camera, and then so many degrees on, to the right.
fn facing(degrees: f64) -> DMat3 {
    let (right, toward) = sides();
    DMat3::from_cols(right, DVec3::Y, toward) * DMat3::from_rotation_y(degrees.to_radians())
}

/// All objects, the panel turned by so many degrees about the upright.
fn all(place: impl Fn(f64, f64, f64) -> DVec3, panel_degrees: f64) -> Vec<Placed> {
    let put = |object, scale, degrees, middle| Placed { object, rotation: facing(degrees), scale, middle };
    let tilt = DMat3::from_rotation_z(12f64.to_radians()) * DMat3::from_rotation_x(26f64.to_radians());
    vec![
        put(BUNNY, 1.3, 20.0, place(-3.3, 1.0, -0.6)),
        put(TEAPOT, 0.85, 25.0, place(3.2, 1.6, -0.6)),
        put(FACETED, 1.0, 10.0, place(0.85, 1.5, -1.4)),
        put(BUMPY, 1.05, 0.0, place(-1.25, 1.2, -1.2)),
        Placed {
            object: PANEL,
            rotation: facing(panel_degrees) * tilt,
            scale: 3.7,
            middle: place(0.0, -1.25, 1.6),
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Material, SIDES};

    #[test]
    fn objects_are_placed_by_rotations() {
        for view in
            [View::Scene, View::Panel, View::Side(1), View::Model([0.0, -2.0, 0.0]), View::Model([1.0; 3])]
        {
            let shot = Shot { view, turn_degrees: 33.0, ..Shot::new(Material::Mirror) };
            let (_, objects) = arrange(&shot, Size { width: 160, height: 90 });
            for placed in objects {
                let (rotation, number) = (placed.rotation, placed.object);
                let error = rotation * rotation.transpose() - DMat3::IDENTITY;
                assert!(error.to_cols_array().iter().all(|value| value.abs() < 1e-12), "{number}");
                assert!(rotation.determinant() > 0.0, "{number}");
            }
        }
    }

    #[test]
    fn sides_are_the_corners_of_a_tetrahedron() {
        for (a, b) in (0..SIDES).flat_map(|a| (0..a).map(move |b| (a, b))) {
            assert_eq!(corner(a).dot(corner(b)), -1.0, "{a} {b}");
        }
    }
}
