//! Encodes normals and decodes the codes with wgpu, from each text that an engine on wgpu can take, and compares the bits
//! with those of the crate `unitvec` on the CPU.
//!
//! `cargo run -p unitvec-example-wgpu [DEVICE]`, with a part of the device's name; lavapipe if not given.

mod gpu;
mod modules;

use gpu::{Binding, Gpu};
use std::borrow::Cow;
use std::process::ExitCode;
use unitvec::{Codec, Oct32};
use unitvec_shaders::Language;
use wgpu::ShaderSource;

type Result<T, E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

/// The exact edition: no compiler fuses or reorders its operations, and its quotients and roots are put right, so that all
/// devices give the same bits.
const WGSL: [&str; 2] = [
    include_str!("../../../shaders/wgsl/exact/arith.wgsl"),
    include_str!("../../../shaders/wgsl/exact/oct.wgsl"),
];
const SPIRV: &[u8] = include_bytes!("../../../spirv/kernels/oct32.spv");
const SHADER: &str = include_str!("normals.wgsl");

const COUNT: u32 = 10_000;

/// What a device or the CPU made of the normals.
#[derive(PartialEq)]
struct Outcome {
    codes: Vec<u32>,
    /// The floats' bits.
    decoded: Vec<u32>,
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("unitvec-example-wgpu: {error}");
            ExitCode::FAILURE
        }
    }
}

/// True if all outcomes are those of the CPU.
fn run() -> Result<bool> {
    let gpu = Gpu::new(&std::env::args().nth(1).unwrap_or_else(|| "llvmpipe".to_owned()))?;
    println!("{COUNT} normals as oct32 on {}", gpu.name);
    let normals = normals();
    let expected = on_cpu(&normals);
    let import = "unitvec::oct::{oct32_encode, oct32_decode}";
    let families = ["arith", "oct"];
    let [oil, wesl] =
        [Language::NagaOil, Language::Wesl].map(|language| modules::of(language, "exact/", &families));
    let texts = [
        ("WGSL", [WGSL[0], WGSL[1], SHADER].concat()),
        ("naga_oil", modules::naga_oil(&format!("#import {import}\n{SHADER}"), &oil?)?),
        ("WESL", modules::wesl(&format!("import package::{import};\n{SHADER}"), &wesl?)?),
    ];
    let mut agree = true;
    for (name, text) in texts {
        agree &= report(name, &by_wgsl(&gpu, text, &normals)?, &expected);
    }
    agree &= report("SPIR-V", &by_kernels(&gpu, &normals)?, &expected);
    Ok(agree)
}

fn report(name: &str, outcome: &Outcome, expected: &Outcome) -> bool {
    let differ = |a: &[u32], b: &[u32]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    let codes = differ(&outcome.codes, &expected.codes);
    let floats = differ(&outcome.decoded, &expected.decoded);
    println!("{name:<9} {codes} codes and {floats} decoded floats differ from the CPU's");
    outcome == expected
}

/// Directions all over the sphere, of lengths that are not 1, as a mesh may have them; and some that have none.
fn normals() -> Vec<[f32; 3]> {
    let mut normals = vec![[0.0; 3], [f32::NAN, 1.0, 0.0], [f32::INFINITY, 0.0, 0.0], [0.0, 0.0, -1.0]];
    for i in normals.len() as u32..COUNT {
        let part = (i as f32 + 0.5) / COUNT as f32;
        let (sin, cos) = (i as f32 * 2.399_963_1).sin_cos();
        let z = 1.0 - 2.0 * part;
        let radius = (1.0 - z * z).sqrt();
        let length = 0.5 + part;
        normals.push([radius * cos, radius * sin, z].map(|component| component * length));
    }
    normals
}

fn on_cpu(normals: &[[f32; 3]]) -> Outcome {
    let codes: Vec<u32> = normals.iter().map(|normal| Oct32::encode(*normal)).collect();
    let decode = |code: &u32| Oct32::decode::<[f32; 3]>(*code).map(f32::to_bits);
    let decoded = codes.iter().flat_map(decode).collect();
    Outcome { codes, decoded }
}

/// By the shader that calls the functions.
fn by_wgsl(gpu: &Gpu, text: String, normals: &[[f32; 3]]) -> Result<Outcome> {
    let bindings = [
        Binding::Input(bytemuck::cast_slice(normals)),
        Binding::Output(4 * normals.len()),
        Binding::Output(12 * normals.len()),
    ];
    let outputs = gpu.run(ShaderSource::Wgsl(text.into()), "main", &bindings, None, COUNT.div_ceil(64))?;
    Ok(Outcome { codes: words(&outputs[0]), decoded: words(&outputs[1]) })
}

/// By the kernels, which whole buffers go through: `docs/kernels.md`.
fn by_kernels(gpu: &Gpu, normals: &[[f32; 3]]) -> Result<Outcome> {
    let module = words(SPIRV);
    let run = |entry: &str, input: &[u8], size: usize| {
        let bindings = [Binding::Input(input), Binding::Output(size)];
        let source = ShaderSource::SpirV(Cow::Borrowed(&module));
        gpu.run(source, entry, &bindings, Some(COUNT), COUNT.div_ceil(256))
    };
    let codes = run("oct32_encode", bytemuck::cast_slice(normals), 4 * normals.len())?.remove(0);
    let decoded = run("oct32_decode", &codes, 12 * normals.len())?.remove(0);
    Ok(Outcome { codes: words(&codes), decoded: words(&decoded) })
}

fn words(bytes: &[u8]) -> Vec<u32> {
    bytemuck::pod_collect_to_vec(bytes)
}
