//! CPU, SPIR-V from Rust and SPIR-V from GLSL agree to the bit on lavapipe, and a disagreement would be noticed.

use std::path::Path;
use unitvec_host::backend::{Backend, Cpu, Gpu, KernelSource};
use unitvec_host::catalogue::{CATALOGUE, Coding, Direction, Domain, FRAMES, find};
use unitvec_host::conform::{self, Options};
use unitvec_host::manifest::sha256_hex;
use unitvec_host::modules::Modules;
use unitvec_host::vulkan::{Error, Runner};
use unitvec_host::{glsl, mesh, sampling};
use unitvec_tests::{assert_no_validation_messages, copy_modules, lavapipe, repository};

fn embedded() -> KernelSource {
    KernelSource::Spirv(Modules::open(None).unwrap())
}

fn from_glsl() -> KernelSource {
    KernelSource::Glsl(glsl::Compiler::new().unwrap())
}

fn options(count: usize) -> Options {
    let bunny = mesh::read(&repository().join("tests/data/bunny.obj")).unwrap();
    Options { count, seed: 7, normals: bunny.normals }
}

/// 10^6 random directions, the mesh, special and tied input, and all codes of up to 24 bits, for every codec.
#[test]
fn the_three_agree_to_the_bit() {
    let device = lavapipe();
    let mut spirv = Gpu::new(&device, embedded(), true).unwrap();
    let mut glsl = Gpu::new(&device, from_glsl(), true).unwrap();
    let options = options(1_000_000);
    assert!(options.normals.len() > 1000);
    for codec in CATALOGUE {
        let row = conform::run_codec(codec, &options, &mut spirv, &mut glsl, &mut |_| ()).unwrap();
        assert!(row.agrees(), "{row:#?}");
        assert!(row.codes >= if codec.bits <= 24 { 1 << codec.bits } else { 1_000_000 });
        assert!(row.max_deg <= f64::from(codec.max_error_deg), "{row:#?}");
    }
    for codec in FRAMES {
        let row = conform::run_frame(codec, &options, &mut spirv, &mut glsl, &mut |_| ()).unwrap();
        assert!(row.agrees(), "{row:#?}");
        assert!(row.codes >= 1_000_000);
        assert!(row.max_deg <= f64::from(codec.max_normal_error_deg), "{row:#?}");
        assert!(row.tangent_max_deg.unwrap() <= f64::from(codec.max_tangent_error_deg), "{row:#?}");
    }
    drop((spirv, glsl));
    assert_no_validation_messages(device);
}

/// The last invocation's group may be incomplete, and a dispatch's last workgroup: every count around those sizes.
#[test]
fn any_number_of_vectors_can_be_dispatched() {
    let device = lavapipe();
    let vectors: Vec<[f32; 3]> = sampling::random_directions(Domain::Sphere, 3).take(1030).collect();
    for source in [embedded(), from_glsl()] {
        let mut gpu = Gpu::new(&device, source, true).unwrap();
        for codec in ["oct16", "oct24p", "oct32", "oct48", "oct52p"].map(|id| find(id).unwrap()) {
            for count in (0..20).chain(250..260).chain(1020..1030) {
                let mut expected = vec![0; count * codec.bytes];
                let mut actual = expected.clone();
                Cpu.encode(codec, &vectors[..count], &mut expected).unwrap();
                gpu.encode(codec, &vectors[..count], &mut actual).unwrap();
                assert_eq!(actual, expected, "{count} vectors");

                let (mut expected_vectors, mut actual_vectors) =
                    (vec![[0.0; 3]; count], vec![[0.0; 3]; count]);
                Cpu.decode(codec, &expected, &mut expected_vectors).unwrap();
                gpu.decode(codec, &expected, &mut actual_vectors).unwrap();
                assert_eq!(actual_vectors, expected_vectors, "{count} codes");
            }
        }
    }
    assert_no_validation_messages(device);
}

/// A kernel that writes nothing leaves the fill pattern, not the last run's result.
#[test]
fn output_that_a_kernel_does_not_write_is_noticed() {
    let device = lavapipe();
    let compiler = glsl::Compiler::new().unwrap();
    let idle = "#version 450\nlayout(local_size_x = 64) in;\nvoid main() {}\n";
    let idle = compiler.compile("idle.comp", idle, &[]).unwrap();
    let codec = find("oct16").unwrap();
    let working = compiler.kernel(codec.format(), Direction::Decode).unwrap();

    let mut runner = Runner::new(&device, 8, true).unwrap();
    let (mut first, mut second) = ([0; 24], [0; 24]);
    let kernel = runner.kernel(&working, glsl::ENTRY_POINT, None).unwrap();
    runner.run(&kernel, 2, &[1, 2, 3, 4], &mut first).unwrap();
    let kernel = runner.kernel(&idle, glsl::ENTRY_POINT, None).unwrap();
    runner.run(&kernel, 2, &[1, 2, 3, 4], &mut second).unwrap();
    assert_ne!(first, second);
    assert!(f32::from_le_bytes([second[0], second[1], second[2], second[3]]).is_nan());
}

/// What would be undefined in Vulkan is an error here.
#[test]
fn runners_refuse_what_they_cannot_run() {
    let device = lavapipe();
    assert!(matches!(Runner::new(&device, 0, false), Err(Error::BadCount { .. })));
    assert!(matches!(Runner::new(&device, usize::MAX, false), Err(Error::BadCount { .. })));
    let (mut one, other) = (Runner::new(&device, 8, false).unwrap(), Runner::new(&device, 8, false).unwrap());
    let module =
        glsl::Compiler::new().unwrap().kernel(find("oct16").unwrap().format(), Direction::Decode).unwrap();
    let foreign = other.kernel(&module, glsl::ENTRY_POINT, None).unwrap();
    assert!(matches!(one.run(&foreign, 1, &[0; 2], &mut [0; 12]), Err(Error::ForeignKernel)));
    let kernel = one.kernel(&module, glsl::ENTRY_POINT, None).unwrap();
    assert!(matches!(one.run(&kernel, 9, &[0; 18], &mut [0; 108]), Err(Error::BadCount { .. })));
    assert!(matches!(one.kernel(&module, "absent", None), Err(Error::NotSpirv { .. })));
    drop((foreign, kernel, one, other));
    assert_no_validation_messages(device);
}

/// With the precise encoder's module in the place of the fast one's, conform counts thousands of mismatches.
#[test]
fn a_kernel_that_computes_something_else_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    swap_encoder(folder.path());
    let device = lavapipe();
    let source = KernelSource::Spirv(Modules::open(Some(folder.path())).unwrap());
    let mut spirv = Gpu::new(&device, source, true).unwrap();
    let mut glsl = Gpu::new(&device, from_glsl(), true).unwrap();
    let codec = find("oct16").unwrap();
    let row = conform::run_codec(codec, &options(10_000), &mut spirv, &mut glsl, &mut |_| ()).unwrap();
    assert!(!row.agrees());
    assert!(row.encode_mismatches.spirv > 1000);
    assert_eq!(row.encode_mismatches.glsl, 0);
    assert_eq!(row.decode_mismatches, conform::Mismatches::default());
    assert!(!row.examples.is_empty());
}

/// Copies the modules to `folder`, with oct16p_encode's code under the name of oct16_encode.
fn swap_encoder(folder: &Path) {
    let spirv = repository().join("spirv");
    copy_modules(folder);
    let mut manifest = Modules::open(None).unwrap().manifest().clone();
    let precise = std::fs::read(spirv.join("oct16p_encode.spv")).unwrap();
    // The entry point's name is the kernel's, so it has to change too: pad it with the NUL that ends SPIR-V strings.
    let renamed = rename(&precise, b"oct16p_encode\0\0\0", b"oct16_encode\0\0\0\0");
    let entry = manifest.modules.iter_mut().find(|module| module.entry_point == "oct16_encode").unwrap();
    entry.sha256 = sha256_hex(&renamed);
    std::fs::write(folder.join("oct16_encode.spv"), renamed).unwrap();
    std::fs::write(folder.join("manifest.json"), serde_json::to_vec(&manifest).unwrap()).unwrap();
}

fn rename(module: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = module.windows(from.len()).position(|window| window == from).unwrap();
    [&module[..at], to, &module[at + from.len()..]].concat()
}
