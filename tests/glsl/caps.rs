//! The maps of caps and of unequal precision: GLSL has Rust's bits.

use super::assert_same_bits;
use super::floats::vectors;
use unitvec::glam::Vec3;
use unitvec::wrap::{Cap, Dense};
use unitvec::{Codec, HemiOct32, HemiOctPrecise16, Oct32, OctPrecise16};

/// The value of a wrapper in GLSL and in Rust, made from three floats.
type Value<W> = (&'static str, fn(Vec3) -> W);

const HEMISPHERE_CAPS: [Value<Cap<HemiOctPrecise16>>; 2] = [
    ("cap_about(v.yzx, v.x)", |v| Cap::new(around(v), v.x)),
    ("cap_about(beside(v), 0.02)", |v| Cap::new(beside(v), 0.02)),
];

const SPHERE_CAPS: [Value<Cap<OctPrecise16>>; 3] = [
    ("cap_about(v.yzx, v.x)", |v| Cap::new(around(v), v.x)),
    ("cap_about(v.yzx, 3.0)", |v| Cap::new(around(v), 3.0)),
    ("cap_about(beside(v), 0.02)", |v| Cap::new(beside(v), 0.02)),
];

const DENSE: [Value<Dense<OctPrecise16>>; 2] = [
    ("dense_about(v.yzx, 4.0)", |v| Dense::new(around(v), 4.0)),
    ("dense_about(v.yzx, v.x)", |v| Dense::new(around(v), v.x)),
];

fn around(v: Vec3) -> Vec3 {
    Vec3::new(v.y, v.z, v.x)
}

/// An axis less than 2 degrees from `v`: it has one component more by a 32nd part.
fn beside(v: Vec3) -> Vec3 {
    Vec3::new(v.x, v.y * 1.03125, v.z)
}

/// The calls with the function `beside` written out.
fn written(call: &str) -> String {
    call.replace("beside(v)", "v * vec3(1.0, 1.03125, 1.0)")
}

/// Values, and both ways through the maps, agree for any vectors, axes, angles and ratios.
#[test]
fn caps_in_glsl_have_the_bits_of_rust() {
    type OfFloats = Box<dyn Fn([f32; 3]) -> Vec3>;
    let mut functions: Vec<(String, OfFloats)> = Vec::new();
    let of_array = |[x, y, _, part]: [f32; 4]| Vec3::new(part, x, y);
    for (value, of) in HEMISPHERE_CAPS {
        functions
            .push((written(&format!("{value}.wxy")), Box::new(move |v| of_array(of(v.into()).to_array()))));
        functions.push((
            written(&format!("cap_to_hemisphere(v, {value})")),
            Box::new(move |v| of(v.into()).image(v.into())),
        ));
        functions.push((
            written(&format!("hemisphere_to_cap(hemioct32_decode(floatBitsToUint(v.z)), {value})")),
            Box::new(move |v| of(v.into()).of_image(HemiOct32::decode_vec3(v[2].to_bits()))),
        ));
    }
    for (value, of) in SPHERE_CAPS {
        functions.push((
            written(&format!("cap_to_sphere(v, {value})")),
            Box::new(move |v| of(v.into()).image(v.into())),
        ));
        functions.push((
            written(&format!("sphere_to_cap(oct32_decode(floatBitsToUint(v.z)), {value})")),
            Box::new(move |v| of(v.into()).of_image(Oct32::decode_vec3(v[2].to_bits()))),
        ));
    }
    for (value, of) in DENSE {
        functions.push((format!("{value}.wxy"), Box::new(move |v| of_array(of(v.into()).to_array()))));
        functions
            .push((format!("dense_to_sphere(v, {value})"), Box::new(move |v| of(v.into()).image(v.into()))));
        functions.push((
            format!("sphere_to_dense(oct32_decode(floatBitsToUint(v.z)), {value})"),
            Box::new(move |v| of(v.into()).of_image(Oct32::decode_vec3(v[2].to_bits()))),
        ));
    }
    let inputs = vectors();
    for group in functions.chunks(4) {
        assert_same_bits(group, &inputs);
    }
}
