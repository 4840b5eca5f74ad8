//! The model of docs/filtering.md beside lavapipe's sampler.

use super::device;
use glam::DVec3;
use unitvec_lab::accuracy::filtering::bilinear;
use unitvec_oracle::{HemiOct, Oracle, angle_deg};
use unitvec_run::glsl::{Compiler, ENTRY_POINT, Shader, Stage};
use unitvec_run::sampling::random_codes;
use unitvec_tests::assert_no_validation_messages;
use unitvec_texture::format::named;
use unitvec_vulkan::{self as vulkan, Draw, Graphics, Image, ImageFormat, Pipeline, PipelineOptions, Target};

const VERTEX: &str = include_str!("../../host/render/shaders/glsl/fullscreen.vert");

/// Blends two by two texels, by fractions that grow with x and y.
const PIXEL: &str = "#version 450
layout(binding = 0) uniform texture2D texels;
layout(binding = 3) uniform sampler linear;
layout(push_constant) uniform Constants { float parts; };
layout(location = 0) out vec4 blend;
void main() {
    vec2 fractions = floor(gl_FragCoord.xy) / parts;
    blend = textureLod(sampler2D(texels, linear), (0.5 + fractions) / 2.0, 0.0);
}";

/// At fractions of 8 bits lavapipe's blends are the model's, to eight roundings of floats up to 1, and at finer ones they are
/// those of fractions that are not rounded. Of UNORM of 8 bits they are such numbers again, up to a step off. A direction of
/// hemi-oct, both of whose numbers are off by d, turns by up to 3 d radians: its point of the octahedron, which is at least
/// 1 / sqrt(3) from the middle, moves by up to sqrt(3) d.
#[test]
fn samples_are_the_models_blends() {
    const ROUNDING: f64 = 8.0 / 16_777_216.0;
    let device = device();
    let graphics = Graphics::new(&device).unwrap();
    assert!(graphics.fraction_bits() >= 8, "the model's fractions have 8 bits");
    let compiler = Compiler::new().unwrap();
    let shaders = [(Stage::Vertex, VERTEX), (Stage::Fragment, PIXEL)].map(|(stage, text)| {
        compiler.compile_shader(Shader { stage, file: "filtering", text, beside: &|_| None }, &[]).unwrap()
    });
    let mut random = random_codes(11).flat_map(u64::to_le_bytes);
    use ImageFormat as F;
    let formats =
        [F::R8G8_UNORM, F::R8G8_SNORM, F::R16G16_UNORM, F::R16G16_SNORM, F::A2B10G10R10_UNORM_PACK32];
    let cases = formats.iter().flat_map(|format| [(256, 256), (4096, 1)].map(|size| (*format, size)));
    for (format, size) in cases {
        let name = format!("{format:?}");
        let layout = named(&name).unwrap();
        // UNORM holds (e + 1) / 2.
        let scale = if name.contains("SNORM") { 1.0 } else { 2.0 };
        let pair = |[x, y, ..]: [f32; 4]| scale * DVec3::new(x.into(), y.into(), 0.0) - (scale - 1.0);
        let texels: Vec<u8> = random.by_ref().take(4 * layout.bytes()).collect();
        let texel =
            |i: f64, j: f64| pair(layout.channels(&texels[layout.bytes() * (i + 2.0 * j) as usize..]));
        let texture = Image::texture(&graphics, format, (2, 2), &texels).unwrap();
        let target = Target::new(&graphics, size, &[F::R32G32B32A32_SFLOAT], false).unwrap();
        let [vertex, fragment] =
            shaders.each_ref().map(|spirv| vulkan::Shader { spirv, entry_point: ENTRY_POINT });
        let options = PipelineOptions { vertex, fragment, attributes: &[], points: false };
        let pipeline = &Pipeline::new(&target, &options).unwrap();
        let draw = Draw { pipeline, mesh: None, constants: &(size.0 as f32).to_ne_bytes() };
        graphics.draw(&target, &[(0, &texture)], &[draw]).unwrap();
        let blends: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&target.read(0).unwrap());
        for (n, found) in (0u32..).zip(blends.into_iter().map(pair)) {
            let [x, y] = [n % size.0, n / size.0].map(|part| f64::from(part) / f64::from(size.0));
            let model = match size.1 {
                1 => texel(0.0, 0.0).lerp(texel(1.0, 0.0), x),
                _ => bilinear([x, y], 1.0, texel).into_iter().map(|(v, weight)| weight * v).sum(),
            };
            let mut most = scale * ROUNDING;
            if format == F::R8G8_UNORM {
                most += 2.0 / 255.0;
                let steps = 127.5 * (found + 1.0);
                assert!(steps.abs_diff_eq(steps.round(), 1e-4), "{name}: {found}");
            }
            assert!(found.abs_diff_eq(model, most), "{name}: {found} for {model}");
            let [found, model] = [found, model].map(|v| HemiOct::direction([v.x, v.y]));
            let turn = angle_deg(found, model).to_radians();
            assert!(turn <= 3.0 * most, "{name}: {found:?} for {model:?}");
        }
    }
    drop(graphics);
    assert_no_validation_messages(device);
}
