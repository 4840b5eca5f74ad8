//! The surfaces that pixels show.

use super::storage::float_texels;
use glam::Vec3;

/// The surface that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Number of the object, from 1: its place in [`OBJECTS`](super::OBJECTS).
    pub object: u32,
    /// The point on the object.
    pub position: Vec3,
    /// The normal that was encoded.
    pub normal: Vec3,
    /// The decoded normal.
    pub decoded: Vec3,
}

/// The pixels of attachments of four floats: `None` where no object is, whose number stands behind the position.
pub(super) fn seen(positions: &[u8], normals: &[u8], decoded: &[u8]) -> Vec<Option<Seen>> {
    let [positions, normals, decoded] = [positions, normals, decoded].map(float_texels);
    let vector = |[x, y, z, _]: [f32; 4]| Vec3::new(x, y, z);
    let all = positions.zip(normals).zip(decoded);
    all.map(|((position, normal), decoded)| {
        let object = position[3] as u32;
        let seen =
            Seen { object, position: vector(position), normal: vector(normal), decoded: vector(decoded) };
        (object > 0).then_some(seen)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_without_an_object_show_nothing() {
        let texels = |values: [[f32; 4]; 2]| bytemuck::cast_slice::<[f32; 4], u8>(&values).to_vec();
        let positions = texels([[9.0, 9.0, 9.0, 0.0], [1.0, 2.0, 3.0, 4.0]]);
        let all = seen(&positions, &texels([[0.0, 0.0, 1.0, 1.0]; 2]), &texels([[0.0, 1.0, 0.0, 1.0]; 2]));
        let shown = Seen { object: 4, position: Vec3::new(1.0, 2.0, 3.0), normal: Vec3::Z, decoded: Vec3::Y };
        assert_eq!(all, [None, Some(shown)]);
    }
}
