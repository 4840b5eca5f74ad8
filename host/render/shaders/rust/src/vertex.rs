//! The vertex shaders of the geometry pass, whose vertices have stored normals, and that of the lighting pass.

use crate::RAW;
use crate::geometry::Geometry;
use crate::normals::{AttributeOf, Normals};
use crate::storage::Storage;
use spirv_std::glam::{Vec3, Vec4};
use spirv_std::spirv;

/// The normal that goes to the fragments.
fn world_normal<N: Normals>(stored: AttributeOf<N>, constants: &Geometry) -> Vec3 {
    let n = N::decode(N::In::code_of_attribute(stored));
    if constants.flags & RAW != 0 { n } else { constants.to_world(n) }
}

macro_rules! vertex {
    ($id:ident $name:ident $normals:path) => {
        #[doc = concat!("Takes normals that are stored as `", stringify!($id), "`.")]
        pub mod $id {
            use super::*;

            /// Places a vertex.
            #[spirv(vertex)]
            pub fn $name(
                position: Vec3,
                stored_normal: AttributeOf<$normals>,
                #[spirv(push_constant)] constants: &Geometry,
                #[spirv(position)] clip: &mut Vec4,
                #[spirv(point_size)] point_size: &mut f32,
                normal: &mut Vec3,
                object_position: &mut Vec3,
            ) {
                *normal = world_normal::<$normals>(stored_normal, constants);
                *object_position = position;
                *clip = constants.to_clip(position);
                *point_size = 1.0;
            }
        }
    };
}

crate::for_all_normals!($ vertex uint_vertex);

/// A triangle that covers the target, drawn without vertex buffers: three vertices.
pub mod fullscreen {
    use super::*;

    /// Places a vertex.
    #[spirv(vertex)]
    pub fn vertex(#[spirv(vertex_index)] index: u32, #[spirv(position)] clip: &mut Vec4) {
        let x = if index == 1 { 3.0 } else { -1.0 };
        let y = if index == 2 { 3.0 } else { -1.0 };
        *clip = Vec4::new(x, y, 0.0, 1.0);
    }
}
