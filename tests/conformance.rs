//! CPU, SPIR-V from Rust and SPIR-V from GLSL agree to the bit on lavapipe, and a disagreement would be noticed.

use std::path::Path;
use std::sync::Arc;
use unitvec_host::backend::{Backend, Cpu, Gpu, KernelSource};
use unitvec_host::catalogue::{self, CATALOGUE, Coding, Direction, Domain, FRAMES, find};
use unitvec_host::conform::{self, Gpus, Options, Subject};
use unitvec_host::manifest::sha256_hex;
use unitvec_host::modules::Modules;
use unitvec_host::vulkan::{Device, Error, Runner};
use unitvec_host::{glsl, mesh, sampling};
use unitvec_tests::{assert_no_validation_messages, copy_modules, lavapipe, repository};

fn embedded() -> KernelSource {
    KernelSource::Spirv(Modules::open(None).unwrap())
}

fn from_glsl() -> KernelSource {
    KernelSource::Glsl(glsl::Compiler::new().unwrap())
}

fn gpus(device: &Arc<Device>, spirv: KernelSource) -> unitvec_host::Result<Gpus> {
    Ok(Gpus { spirv: Gpu::new(device, spirv, true)?, glsl: Some(Gpu::new(device, from_glsl(), true)?) })
}

fn options(count: usize) -> Options {
    let bunny = mesh::read(&repository().join("host/data/bunny.obj")).unwrap();
    Options { count, seed: 7, normals: bunny.normals, all_codes_up_to: 16 }
}

/// 2^18 random directions, the mesh, special and tied input, and all codes of up to 16 bits, for every codec.
/// `cargo xtask conform --exhaustive` does the same with more.
#[test]
fn the_three_agree_to_the_bit() {
    let device = lavapipe();
    let options = options(1 << 18);
    assert!(options.normals.len() > 1000);
    let frames = FRAMES.iter().map(Subject::Frame);
    let subjects: Vec<Subject> = CATALOGUE.iter().map(Subject::Codec).chain(frames).collect();
    let work: u64 = subjects.iter().map(|subject| subject.work(&options)).sum();
    let (mut done, mut rows) = (0, Vec::new());
    let open = || gpus(&device, embedded());
    conform::run(&subjects, &options, open, &mut |more| done += more, &mut |row| {
        rows.push(row);
        Ok(())
    })
    .unwrap();
    assert_eq!(done, work);
    let ids: Vec<&str> = rows.iter().map(|row| row.id).collect();
    assert_eq!(ids, subjects.iter().map(|subject| subject.id()).collect::<Vec<_>>());
    for row in &rows {
        assert!(row.agrees(), "{row:#?}");
        assert!(row.codes >= if row.bits <= 16 { 1 << row.bits } else { 1 << 18 }, "{row:#?}");
        let bounds = match catalogue::find_frame(row.id) {
            Some(frame) => (frame.max_normal_error_deg, Some(frame.max_tangent_error_deg)),
            None => (find(row.id).unwrap().max_error_deg, None),
        };
        assert!(row.max_deg <= f64::from(bounds.0), "{row:#?}");
        assert_eq!(row.tangent_max_deg.is_some(), bounds.1.is_some(), "{row:#?}");
        assert!(row.tangent_max_deg <= bounds.1.map(f64::from), "{row:#?}");
    }
    assert_no_validation_messages(device);
}

/// A backend that cannot be opened ends the run with its error.
#[test]
fn conform_ends_where_a_backend_does_not_open() {
    let subjects = [Subject::Codec(find("oct16").unwrap())];
    let open = || Err(unitvec_host::Error::Usage("no such backend".to_owned()));
    let error = conform::run(&subjects, &options(1), open, &mut |_| (), &mut |_| Ok(())).unwrap_err();
    assert_eq!(error.to_string(), "no such backend");
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
    let mut gpus = gpus(&device, source).unwrap();
    let codec = find("oct16").unwrap();
    let row = conform::run_codec(codec, &options(10_000), &mut gpus, &mut |_| ()).unwrap();
    assert!(!row.agrees());
    assert!(row.encode_mismatches.spirv > 1000);
    assert_eq!(row.encode_mismatches.glsl, Some(0));
    assert_eq!(row.decode_mismatches, conform::Mismatches { spirv: 0, glsl: Some(0) });
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
