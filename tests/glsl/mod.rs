//! The GLSL: the includes compile, and all functions give the crate's bits.

mod caps;
pub mod dither;
mod examples;
mod floats;
mod formats;
mod names;
mod opengl;
mod projections;
pub mod versions;

use unitvec::arith;
use unitvec::direction::{is_usable, l1_norm};
use unitvec::glam::Vec3;
use unitvec_catalogue::{Domain, frames, rotations, vectors};
use unitvec_run::glsl;
use unitvec_run::glsl::Compiler;
use unitvec_run::sampling::{random_directions, special_vectors};
use unitvec_tests::{assert_no_validation_messages, glsl_families, lavapipe};
use unitvec_vulkan::Runner;

/// A call of every function of a family's codecs, where `v` is a vec3.
fn calls(file: &str) -> String {
    let vectors = vectors().iter().filter(|codec| codec.glsl_file() == file);
    let frames = frames().iter().filter(|codec| codec.glsl_file() == file);
    let of_frames = frames.map(|codec| {
        let id = codec.id;
        format!("{{ vec3 n; vec4 t; {id}_decode({id}_encode(v, v.xyzx), n, t); v += n + t.xyz * t.w; }}\n")
    });
    let rotations = rotations().iter().filter(|codec| codec.glsl_file() == file);
    let of_rotations =
        rotations.map(|codec| format!("v += {id}_decode({id}_encode(v.xyzx)).xyz;\n", id = codec.id));
    vectors
        .map(|codec| format!("v += {id}_decode({id}_encode(v));\n", id = codec.id))
        .chain(of_frames)
        .chain(of_rotations)
        .collect()
}

#[test]
fn every_family_compiles_by_include() {
    let compiler = Compiler::new().unwrap();
    for file in glsl_families().into_iter().chain(["unitvec.glsl".to_owned()]) {
        let shader = format!(
            "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"unitvec/{file}\"\n\
             layout(local_size_x = 1) in;\nlayout(binding = 0) buffer B {{ vec3 v; }};\nvoid main() {{\n{}}}\n",
            calls(&file)
        );
        compiler.compile("user.comp", &shader, &[]).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
}

/// Fails where one of these functions, each a call of GLSL and the same in Rust, gives other bits in GLSL. The call is a vec3
/// of the vec3 `v`.
fn assert_same_bits<R: Into<[f32; 3]>>(functions: &[(String, impl Fn([f32; 3]) -> R)], inputs: &[[f32; 3]]) {
    let of_words = functions.iter().map(|(call, function)| {
        let in_rust = move |w: [u32; 3]| function(w.map(f32::from_bits)).into().map(f32::to_bits);
        (format!("floatBitsToUint({call})"), in_rust)
    });
    let inputs: Vec<[u32; 3]> = inputs.iter().map(|v| v.map(f32::to_bits)).collect();
    assert_same_words(&of_words.collect::<Vec<_>>(), &inputs);
}

/// Fails where one of these functions gives other words in GLSL. The call is a uvec3 of the uvec3 `w` and of the vec3 `v` of the
/// same bits. A shader has all calls, and gives a digest of their results: 31 times the digest before, and the next.
pub fn assert_same_words(functions: &[(String, impl Fn([u32; 3]) -> [u32; 3])], inputs: &[[u32; 3]]) {
    let calls: Vec<&str> = functions.iter().map(|(call, _)| call.as_str()).collect();
    let digest = calls.iter().fold("uvec3(0u)".to_owned(), |all, call| format!("({all} * 31u + {call})"));
    for (input, result) in inputs.iter().zip(evaluate_words(&digest, inputs)) {
        let in_rust = functions.iter().fold([0; 3], |all: [u32; 3], (_, function)| {
            let next = function(*input);
            [0, 1, 2].map(|i| all[i].wrapping_mul(31).wrapping_add(next[i]))
        });
        assert_eq!(result, in_rust, "one of {calls:?} of {input:x?}, {:?}", input.map(f32::from_bits));
    }
}

/// Runs `expression`, a uvec3 of the uvec3 `w` and of the vec3 `v` of the same bits, on lavapipe.
fn evaluate_words(expression: &str, inputs: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let shader = format!(
        "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"unitvec/unitvec.glsl\"\n\
         layout(local_size_x = 64) in;\nlayout(push_constant) uniform Count {{ uint vectors; }};\n\
         layout(binding = 0) readonly buffer Input {{ uint a[]; }};\n\
         layout(binding = 1) writeonly buffer Output {{ uint b[]; }};\n\
         void main() {{\n\
             for (uint i = 4u * gl_GlobalInvocationID.x; i < min(vectors, 4u * gl_GlobalInvocationID.x + 4u); ++i) {{\n\
                 uvec3 w = uvec3(a[3u * i], a[3u * i + 1u], a[3u * i + 2u]);\n\
                 vec3 v = uintBitsToFloat(w);\n\
                 uvec3 r = {expression};\n\
                 b[3u * i] = r.x; b[3u * i + 1u] = r.y; b[3u * i + 2u] = r.z;\n\
             }}\n\
         }}\n"
    );
    let module = Compiler::new().unwrap().compile("user.comp", &shader, &[]).unwrap();
    let device = lavapipe();
    let mut runner = Runner::new(&device, inputs.len(), true).unwrap();
    let kernel = runner.kernel(&module, glsl::ENTRY_POINT, None).unwrap();
    let input: Vec<u8> = inputs.iter().flatten().flat_map(|word| word.to_ne_bytes()).collect();
    let mut output = vec![0; input.len()];
    runner.run(&kernel, inputs.len(), &input, &mut output).unwrap();
    drop((kernel, runner));
    assert_no_validation_messages(device);
    let words: Vec<u32> =
        output.chunks_exact(4).map(|bytes| u32::from_ne_bytes(bytes.try_into().unwrap())).collect();
    words.chunks_exact(3).map(|vector| vector.try_into().unwrap()).collect()
}

/// snorm and unorm codes of the scalar functions are the crate's.
#[test]
fn scalar_functions_are_the_crates() {
    let inputs: Vec<[f32; 3]> = (-3000..3000).map(|n| [n as f32 / 2500.0, 0.0, 0.0]).collect();
    let functions = [2, 5, 8, 10, 16, 22].map(|bits| {
        let call = ["unorm", "snorm"].map(|kind| format!("float(unitvec_{kind}_encode(v.x, {bits}u))"));
        let in_rust = move |[x, ..]: [f32; 3]| {
            [arith::unorm_encode(x, bits) as f32, arith::snorm_encode(x, bits) as f32, 0.0]
        };
        (format!("vec3({}, 0.0)", call.join(", ")), in_rust)
    });
    assert_same_bits(&functions, &inputs);
}

/// Vectors without a direction get the null code, and it gives zeros.
#[test]
fn null_codes_stand_for_no_direction() {
    let is_lacking = |w: [u32; 3]| !is_usable(l1_norm(Vec3::from_array(w.map(f32::from_bits))));
    let inputs: Vec<[u32; 3]> = special_vectors().into_iter().map(|v| v.map(f32::to_bits)).collect();
    let codes = "uvec3(code_or_null_wide(v, w.xy, uvec2(7u, 8u)), code_or_null(v, w.z, 9u))".to_owned();
    assert_same_words(&[(codes, |w| if is_lacking(w) { [7, 8, 9] } else { w })], &inputs);
    let one = "vector_or_zero_wide(vec3(1.0), w.xy, uvec2(0u, 0x3f800000u)).x";
    let vectors = format!("uvec3(vector_or_zero(vec3(1.0), w.x, 0u).x, {one}, 1.0)");
    let of_codes = |[x, y, _]: [u32; 3]| [x != 0, x != 0 || y != 0x3f80_0000, true].map(u32::from);
    assert_same_words(&[(vectors, of_codes)], &inputs);
}

/// The trigonometry gives the crate's bits, over directions and angles of all sizes.
#[test]
fn trigonometry_is_the_crates_to_the_bit() {
    let mut inputs: Vec<[f32; 3]> = random_directions(Domain::Sphere, 6).take(20_000).collect();
    let scaled = random_directions(Domain::Sphere, 7).zip(-60..60);
    inputs.extend(scaled.map(|(v, exponent)| v.map(|c| c * 2f32.powi(exponent))));
    inputs.extend(special_vectors().into_iter().filter(|v| v.iter().all(|c| c.is_finite())));
    type Reference = fn([f32; 3]) -> [f32; 3];
    let functions: [(&str, Reference); 4] = [
        ("vec3(unitvec_sin_cos_half_turns(v.x), unitvec_atan2_half_turns(v.y, v.x))", |[x, y, _]| {
            [arith::sin_cos_half_turns(x).x, arith::sin_cos_half_turns(x).y, arith::atan2_half_turns(y, x)]
        }),
        ("vec3(unitvec_from_diagonal(0.5 - min(abs(v.x), 1.0)), 0.0)", |[x, ..]| {
            let of_x = arith::from_diagonal(0.5 - x.abs().min(1.0));
            [of_x.x, of_x.y, 0.0]
        }),
        ("vec3(unitvec_sin_cos(v.x), unitvec_asin_half_turns(v.y))", |[x, y, _]| {
            [arith::sin_cos(x).x, arith::sin_cos(x).y, arith::asin_half_turns(y)]
        }),
        (
            "vec3(unitvec_acos_half_turns(v.x), unitvec_atan_octant(abs(v.y)), unitvec_tan_octant(min(abs(v.x), 1.0)))",
            |[x, y, _]| {
                [arith::acos_half_turns(x), arith::atan_octant(y.abs()), arith::tan_octant(x.abs().min(1.0))]
            },
        ),
    ];
    assert_same_bits(&functions.map(|(call, reference)| (call.to_owned(), reference)), &inputs);
}
