//! The fragment shaders of the lighting pass: they decode the normal of a pixel and light it.

use crate::RAW;
use crate::key::{Key, pixel_at};
use crate::normals::{AsIntegers, CodeOf, Normals, TextureOf, ValueOf};
use crate::shading::seen;
use crate::storage::{Storage, Value};
use spirv_std::glam::{Vec3, Vec4};
use spirv_std::image::Image2d;
use spirv_std::spirv;
use unitvec::arith::normalize;
use unitvec::dither::Dithered;

/// The push constants.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Lighting {
    /// A pixel's ray is `forward + right x + up y`.
    pub right: Vec4,
    /// See `right`.
    pub up: Vec4,
    /// See `right`.
    pub forward: Vec4,
    /// `(x, y)` is the pixel's centre times this one's xy, plus its zw.
    pub viewport: Vec4,
    /// Number of the material.
    pub material: u32,
    /// [`RAW`] or 0.
    pub flags: u32,
    /// The source of a dithered code's offset.
    pub key: u32,
    /// Moves the keys that belong to the screen.
    pub seed: u32,
}

/// The direction in which a pixel looks.
fn view_ray(centre: Vec4, constants: &Lighting) -> Vec3 {
    let viewport = constants.viewport;
    let x = centre.x * viewport.x + viewport.z;
    let y = centre.y * viewport.y + viewport.w;
    let ray = (constants.forward.truncate() + constants.right.truncate() * x) + constants.up.truncate() * y;
    normalize(ray)
}

/// The colour of a pixel where this point of an object has this normal.
fn colour_of(n: Vec3, surface: Vec4, centre: Vec4, constants: &Lighting) -> Vec3 {
    if constants.flags & RAW != 0 {
        return Vec3::ZERO;
    }
    seen(constants.material, surface.w, normalize(n), view_ray(centre, constants))
}

/// The code that a pixel stores.
fn code_of<N: Normals>(stored: &TextureOf<N>, centre: Vec4) -> CodeOf<N> {
    N::In::code_of(ValueOf::<N>::fetch(stored, pixel_at(centre)))
}

/// A point of an object, with the object's number as the fourth component.
fn surface_of(surfaces: &Image2d, centre: Vec4) -> Vec4 {
    surfaces.fetch(pixel_at(centre))
}

macro_rules! light {
    ($id:ident $name:ident $normals:path) => {
        #[doc = concat!("Reads normals that are stored as `", stringify!($id), "`.")]
        pub mod $id {
            use super::*;

            /// Lights a pixel.
            #[spirv(fragment)]
            pub fn $name(
                #[spirv(frag_coord)] centre: Vec4,
                #[spirv(push_constant)] constants: &Lighting,
                #[spirv(descriptor_set = 0, binding = 0)] stored: &TextureOf<$normals>,
                #[spirv(descriptor_set = 0, binding = 1)] surfaces: &Image2d,
                colour: &mut Vec4,
                normal: &mut Vec4,
            ) {
                let surface = surface_of(surfaces, centre);
                let n = <$normals as Normals>::decode(code_of::<$normals>(stored, centre));
                *colour = colour_of(n, surface, centre, constants).extend(1.0);
                *normal = n.extend(1.0);
            }
        }
    };
}

crate::for_all_normals!($ light uint_light);

macro_rules! dithered_light {
    ($id:ident $codec:path) => {
        #[doc = concat!("Reads normals that are stored as `", stringify!($id), "`.")]
        pub mod $id {
            use super::*;

            /// Lights a pixel.
            #[spirv(fragment)]
            pub fn light(
                #[spirv(frag_coord)] centre: Vec4,
                #[spirv(push_constant)] constants: &Lighting,
                #[spirv(descriptor_set = 0, binding = 0)] stored: &TextureOf<AsIntegers<$codec>>,
                #[spirv(descriptor_set = 0, binding = 1)] surfaces: &Image2d,
                #[spirv(descriptor_set = 0, binding = 2)] blue_noise: &Image2d,
                colour: &mut Vec4,
                normal: &mut Vec4,
            ) {
                let surface = surface_of(surfaces, centre);
                let Lighting { key: kind, seed, .. } = *constants;
                let offset = Key { kind, seed, centre, position: surface.truncate() }.offset(blue_noise);
                let code = code_of::<AsIntegers<$codec>>(stored, centre);
                let n = <$codec as Dithered>::decode_dithered(code, offset);
                *colour = colour_of(n, surface, centre, constants).extend(1.0);
                *normal = n.extend(1.0);
            }
        }
    };
}

crate::for_all_dithered!(dithered_light);
