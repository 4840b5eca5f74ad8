//! The fragment shaders of the geometry pass: they write the normal's code, the normal and the position.

use crate::RAW;
use crate::geometry::Geometry;
use crate::key::Key;
use crate::normals::{AsIntegers, Normals, ValueOf};
use crate::storage::Storage;
use spirv_std::glam::{Vec3, Vec4};
use spirv_std::image::Image2d;
use spirv_std::spirv;
use unitvec::arith::normalize;
use unitvec::dither::Dithered;

/// The normal to encode.
fn normal_of(world_normal: Vec3, constants: &Geometry) -> Vec3 {
    if constants.flags & RAW != 0 { world_normal } else { normalize(world_normal) }
}

macro_rules! gbuffer {
    ($id:ident $name:ident $normals:path) => {
        #[doc = concat!("Stores normals as `", stringify!($id), "`.")]
        pub mod $id {
            use super::*;

            /// Writes a fragment.
            #[spirv(fragment)]
            pub fn $name(
                world_normal: Vec3,
                object_position: Vec3,
                #[spirv(push_constant)] constants: &Geometry,
                stored: &mut ValueOf<$normals>,
                normal: &mut Vec4,
                surface: &mut Vec4,
            ) {
                let n = normal_of(world_normal, constants);
                *stored = <$normals as Normals>::In::value_of(<$normals as Normals>::encode(n));
                *normal = n.extend(1.0);
                // The position is in object space, with the object's number as the fourth component.
                *surface = object_position.extend(constants.object as f32);
            }
        }
    };
}

crate::for_all_normals!($ gbuffer uint_gbuffer);

macro_rules! dithered_gbuffer {
    ($id:ident $codec:path) => {
        #[doc = concat!("Stores normals as `", stringify!($id), "`.")]
        pub mod $id {
            use super::*;

            /// Writes a fragment.
            #[spirv(fragment)]
            pub fn gbuffer(
                world_normal: Vec3,
                object_position: Vec3,
                #[spirv(frag_coord)] centre: Vec4,
                #[spirv(push_constant)] constants: &Geometry,
                #[spirv(descriptor_set = 0, binding = 2)] blue_noise: &Image2d,
                stored: &mut ValueOf<AsIntegers<$codec>>,
                normal: &mut Vec4,
                surface: &mut Vec4,
            ) {
                let n = normal_of(world_normal, constants);
                let Geometry { key: kind, seed, .. } = *constants;
                let offset = Key { kind, seed, centre, position: object_position }.offset(blue_noise);
                let code = <$codec as Dithered>::encode_dithered(n, offset);
                *stored = <AsIntegers<$codec> as Normals>::In::value_of(code);
                *normal = n.extend(1.0);
                *surface = object_position.extend(constants.object as f32);
            }
        }
    };
}

crate::for_all_dithered!(dithered_gbuffer);
