//! The maps of caps and of unequal precision: GLSL has Rust's bits.

use super::assert_same_bits;
use super::floats::vectors;
use unitvec::glam::{Vec3, Vec3Swizzles};
use unitvec::wrap::{Cap, Dense};
use unitvec::{Codec, HemiOct32, HemiOctPrecise16, Oct32, OctPrecise16};

type Upper = Cap<HemiOctPrecise16>;
type Whole = Cap<OctPrecise16>;
type Uneven = Dense<OctPrecise16>;

fn part_first([x, y, _, part]: [f32; 4]) -> Vec3 {
    Vec3::new(part, x, y)
}

/// An axis less than 2 degrees from `v`.
fn beside(v: Vec3) -> Vec3 {
    Vec3::new(v.x, v.y * 1.03125, v.z)
}

fn upper(v: Vec3) -> Vec3 {
    HemiOct32::decode_vec3(v.z.to_bits())
}

fn whole(v: Vec3) -> Vec3 {
    Oct32::decode_vec3(v.z.to_bits())
}

/// Calls of the functions of cap.glsl, where `beside`, `upper` and `whole` are the above, and the same in Rust.
type Function = (&'static str, fn(Vec3) -> Vec3);
const FUNCTIONS: [Function; 14] = [
    ("cap_about(v.yzx, v.x).wxy", |v| part_first(Upper::new(v.yzx(), v.x).to_array())),
    ("cap_to_hemisphere(v, cap_about(v.yzx, v.x))", |v| Upper::new(v.yzx(), v.x).image(v)),
    ("cap_to_hemisphere(v, cap_about(beside, 0.02))", |v| Upper::new(beside(v), 0.02).image(v)),
    ("hemisphere_to_cap(upper, cap_about(v.yzx, v.x))", |v| Upper::new(v.yzx(), v.x).of_image(upper(v))),
    ("hemisphere_to_cap(upper, cap_about(v.yzx, 3.0))", |v| Upper::new(v.yzx(), 3.0).of_image(upper(v))),
    ("cap_to_sphere(v, cap_about(v.yzx, v.x))", |v| Whole::new(v.yzx(), v.x).image(v)),
    ("cap_to_sphere(v, cap_about(v.yzx, 3.0))", |v| Whole::new(v.yzx(), 3.0).image(v)),
    ("sphere_to_cap(whole, cap_about(v.yzx, v.x))", |v| Whole::new(v.yzx(), v.x).of_image(whole(v))),
    ("sphere_to_cap(whole, cap_about(v.yzx, 3.0))", |v| Whole::new(v.yzx(), 3.0).of_image(whole(v))),
    ("dense_about(v.yzx, v.x).wxy", |v| part_first(Uneven::new(v.yzx(), v.x).to_array())),
    ("dense_to_sphere(v, dense_about(v.yzx, 4.0))", |v| Uneven::new(v.yzx(), 4.0).image(v)),
    ("dense_to_sphere(v, dense_about(v.yzx, v.x))", |v| Uneven::new(v.yzx(), v.x).image(v)),
    ("sphere_to_dense(whole, dense_about(v.yzx, 4.0))", |v| Uneven::new(v.yzx(), 4.0).of_image(whole(v))),
    ("sphere_to_dense(whole, dense_about(v.yzx, v.x))", |v| Uneven::new(v.yzx(), v.x).of_image(whole(v))),
];

/// Values, and both ways through the maps, agree for any vectors, axes, angles and ratios.
#[test]
fn caps_in_glsl_have_the_bits_of_rust() {
    let inputs = vectors();
    let functions = FUNCTIONS.map(|(call, in_rust)| {
        let call = call
            .replace("beside", "v * vec3(1.0, 1.03125, 1.0)")
            .replace("upper", "hemioct32_decode(floatBitsToUint(v.z))")
            .replace("whole", "oct32_decode(floatBitsToUint(v.z))");
        (call, move |v: [f32; 3]| in_rust(v.into()))
    });
    for group in functions.chunks(5) {
        assert_same_bits(group, &inputs);
    }
}
