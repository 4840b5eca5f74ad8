//! CPU, SPIR-V from Rust and SPIR-V from GLSL agree to the bit on lavapipe, and a disagreement would be noticed.

use std::path::Path;
use std::sync::Arc;
use unitvec_catalogue::{Domain, Operation, find};
use unitvec_manifest::modules::Modules;
use unitvec_mesh as mesh;
use unitvec_run::backend::{Backend, BackendKind, Cpu, Gpu, KernelSource, decode_table};
use unitvec_run::conform::{Backends, Mismatches, Options, Plan, widest_of_each_series};
use unitvec_run::shader::{Edition, Language};
use unitvec_run::{conform, glsl, sampling};
use unitvec_tests::program::raw;
use unitvec_tests::{assert_no_validation_messages, copy_modules, lavapipe, replace_module, repository};
use unitvec_vulkan::{BufferPromise, Device, Division, Error, GROUP, Runner, SENTINEL};

fn embedded() -> KernelSource {
    KernelSource::Rust(Modules::open(None).unwrap(), Edition::Exact)
}

fn from_glsl() -> KernelSource {
    KernelSource::Glsl(glsl::Compiler::of(Edition::Exact).unwrap())
}

fn backends(device: &Arc<Device>, rust: KernelSource) -> Backends {
    let gpu = |source| -> Box<dyn Backend> { Box::new(Gpu::new(device, source, true).unwrap()) };
    Backends::from([(BackendKind::Rust, gpu(rust)), (BackendKind::Glsl, gpu(from_glsl()))])
}

/// A codec of each size of codes.
const SIZES: [&str; 8] = ["oct8", "oct16", "oct24", "oct32", "oct48", "oct52p", "frame32", "frame64"];

fn options(count: usize) -> Options {
    let bunny = mesh::read(&repository().join("host/mesh/data/bunny.obj")).unwrap();
    Options { count, seed: 7, normals: bunny.normals, all_codes_up_to: 16 }
}

/// 2^13 random directions, the mesh, special and tied input, and all codes of up to 16 bits, for a codec of each series.
/// `cargo xtask conform` does the same with more, for every codec.
#[test]
fn the_three_agree_to_the_bit() {
    let device = lavapipe();
    let options = options(1 << 13);
    assert!(options.normals.len() > 1000);
    let formats = widest_of_each_series();
    let plans: Vec<Plan<'_>> = formats.iter().map(|format| Plan::new(format, &options)).collect();
    let work: u64 = plans.iter().map(Plan::work).sum();
    let (mut done, mut rows) = (0, Vec::new());
    let open = || Ok(backends(&device, embedded()));
    conform::run(plans, open, &mut |more| done += more, &mut |row| {
        rows.push(row);
        Ok::<(), unitvec_run::Error>(())
    })
    .unwrap();
    assert_eq!(done, work);
    let ids: Vec<&str> = rows.iter().map(|row| row.id.as_str()).collect();
    assert_eq!(ids, formats.iter().map(|format| format.id).collect::<Vec<_>>());
    for row in &rows {
        assert!(row.agrees(), "{row:#?}");
        assert!(row.codes >= if row.bits <= 16 { 1 << row.bits } else { 1 << 13 }, "{row:#?}");
        let errors: Vec<f64> = [row.max_deg].into_iter().chain(row.tangent_max_deg).collect();
        let bounds = find(&row.id).unwrap().max_errors_deg;
        assert_eq!(errors.len(), bounds.len(), "{row:#?}");
        assert!(errors.iter().zip(bounds).all(|(error, bound)| *error <= f64::from(*bound)), "{row:#?}");
    }
    assert_no_validation_messages(device);
}

/// The kernels that measure too are ones that a device without features takes.
#[test]
fn every_kernel_becomes_a_pipeline_of_a_device_without_features() {
    let device = lavapipe();
    let runner = Runner::new(&device, 4, false).unwrap();
    let modules = Modules::open(None).unwrap();
    for entry in modules.manifest().modules.iter().flat_map(|module| &module.entry_points) {
        runner.kernel(&modules.load(&entry.name).unwrap(), &entry.name, None).unwrap();
    }
    drop(runner);
    assert_no_validation_messages(device);
}

/// A backend that cannot be opened ends the run with its error.
#[test]
fn conform_ends_where_a_backend_does_not_open() {
    let options = options(1);
    let plans = vec![Plan::new(find("oct16").unwrap(), &options)];
    let open = || Err(unitvec_host::Error::Usage("no such backend".to_owned()));
    let error = conform::run(plans, open, &mut |_| (), &mut |_| Ok(())).unwrap_err();
    assert_eq!(error.to_string(), "no such backend");
}

/// The last invocation's group may be incomplete, and a dispatch's last workgroup: every count around those sizes, in buffers
/// that hold no more than so many elements, rounded up to words.
#[test]
fn any_number_of_elements_can_be_dispatched() {
    let device = lavapipe();
    for source in [embedded(), from_glsl()] {
        let mut gpu = Gpu::new(&device, source, true).unwrap();
        for id in SIZES {
            let format = find(id).unwrap();
            let floats = format.element.floats();
            let random = sampling::random_elements(format.element, Domain::Sphere, 3);
            let elements: Vec<f32> = random.take(1030 * floats).collect();
            for count in (0..20).chain(250..260).chain(1020..1030) {
                let elements = &elements[..count * floats];
                let mut expected = vec![0; count * format.bytes];
                let mut actual = expected.clone();
                Cpu.encode(format, elements, &mut expected).unwrap();
                gpu.encode(format, elements, &mut actual).unwrap();
                assert_eq!(actual, expected, "{count} elements");

                let mut expected_elements = vec![0.0; count * floats];
                let mut actual_elements = expected_elements.clone();
                Cpu.decode(format, &expected, &mut expected_elements).unwrap();
                gpu.decode(format, &expected, &mut actual_elements).unwrap();
                assert_eq!(actual_elements, expected_elements, "{count} codes");
            }
        }
    }
    assert_no_validation_messages(device);
}

/// Kernels write what the count asks for and both buffers hold, and 0 to the rest of the last word; nothing more.
#[test]
fn kernels_keep_to_the_count_and_to_both_buffers() {
    let device = lavapipe();
    let mut runner = Runner::new(&device, 16, true).unwrap();
    let (modules, compiler) = (Modules::open(None).unwrap(), glsl::Compiler::new().unwrap());
    for id in SIZES {
        let format = find(id).unwrap();
        let random = sampling::random_elements(format.element, Domain::Sphere, 9);
        let mut elements: Vec<f32> = random.take(12 * format.element.floats()).collect();
        let mut codes = vec![0; 12 * format.bytes];
        Cpu.encode(format, &elements, &mut codes).unwrap();
        Cpu.decode(format, &codes, &mut elements).unwrap();
        Cpu.encode(format, &elements, &mut codes).unwrap();
        let elements = raw(&elements);
        for (operation, read, written) in
            [(Operation::Encode, &elements, &codes), (Operation::Decode, &codes, &elements)]
        {
            let name = format.function(operation);
            let from_rust = runner.kernel(&modules.load(&name).unwrap(), &name, None).unwrap();
            let from_glsl = compiler.kernel(format, operation).unwrap();
            let from_glsl = runner.kernel(&from_glsl, glsl::ENTRY_POINT, None).unwrap();
            for kernel in [from_rust, from_glsl] {
                for (count, input, output) in
                    [(5, 12, 12), (12, 5, 12), (12, 7, 12), (12, 12, 5), (12, 12, 7)]
                {
                    // Whole words, whose rest holds the beginning of the next code.
                    let [input, output] = [(read, input), (written, output)]
                        .map(|(bytes, count)| (bytes.len() / 12 * count).next_multiple_of(4));
                    let mut actual = vec![0; output];
                    runner.run(&kernel, count, &read[..input], &mut actual).unwrap();
                    let held = (12 * input / read.len()).min(12 * output / written.len());
                    let mut expected = written[..count.min(held) * written.len() / 12].to_vec();
                    expected.resize(expected.len().next_multiple_of(4), 0);
                    let untouched = SENTINEL.to_le_bytes().into_iter().cycle();
                    expected.extend(untouched.take(actual.len() - expected.len()));
                    assert_eq!(actual, expected, "{name}: {count}, {input}, {output}");
                }
            }
        }
    }
    drop(runner);
    assert_no_validation_messages(device);
}

/// Kernels for buffers of whole groups write the groups that the others write when they are asked for all of them, and
/// nothing behind.
#[test]
fn kernels_of_whole_groups_write_the_same() {
    const COUNTS: [usize; 3] = [4, 1000, 4099];
    const MOST: usize = 4100;
    let device = lavapipe();
    let mut runner = Runner::new(&device, MOST + GROUP, true).unwrap();
    let (modules, compiler) = (Modules::open(None).unwrap(), glsl::Compiler::new().unwrap());
    for id in SIZES {
        let format = find(id).unwrap();
        let random = sampling::random_elements(format.element, Domain::Sphere, 11);
        let floats = MOST * format.element.floats();
        let elements: Vec<u8> = random.take(floats).flat_map(f32::to_le_bytes).collect();
        let mut codes = vec![0; MOST * format.bytes];
        for operation in Operation::ALL {
            let name = format.function(operation);
            let from_rust = modules.load(&name).unwrap();
            let from_glsl = compiler.kernel(format, operation).unwrap();
            for (spirv, entry_point) in [(&from_rust[..], name.as_str()), (&from_glsl[..], glsl::ENTRY_POINT)]
            {
                let [exact, whole] = [BufferPromise::ExactSize, BufferPromise::WholeGroups].map(|buffers| {
                    runner.kernel_for(buffers, Division::Exact, spirv, entry_point, None).unwrap()
                });
                let (read, written) = match operation {
                    Operation::Encode => (&elements, format.bytes),
                    Operation::Decode => (&codes, format.element.bytes()),
                };
                for count in COUNTS {
                    let groups = count.next_multiple_of(GROUP);
                    let input = &read[..groups * (read.len() / MOST)];
                    let [mut expected, mut actual] = [(); 2].map(|()| vec![0; groups * written + 16]);
                    runner.run(&exact, groups, input, &mut expected).unwrap();
                    runner.run(&whole, count, input, &mut actual).unwrap();
                    assert!(actual == expected, "{entry_point} of {name}: {count}");
                    let behind = actual[groups * written..].chunks(4);
                    assert!(behind.into_iter().all(|word| word == SENTINEL.to_le_bytes()), "{name}");
                }
                if operation == Operation::Encode {
                    runner.run(&exact, MOST, &elements, &mut codes).unwrap();
                }
            }
        }
    }
    drop(runner);
    assert_no_validation_messages(device);
}

/// Nothing is written where a table is a word too short, whatever is promised about the other buffers.
#[test]
fn kernels_write_nothing_by_a_short_table() {
    let device = lavapipe();
    let mut runner = Runner::new(&device, 4, true).unwrap();
    let (modules, compiler) = (Modules::open(None).unwrap(), glsl::Compiler::new().unwrap());
    let encoder = |id| compiler.kernel(find(id).unwrap(), Operation::Encode).unwrap();
    for (name, from_glsl, whole) in [
        ("snorm8x3p_encode", encoder("snorm8x3p"), 4 * unitvec::best_fit::TABLE_WORDS),
        ("crytek_bfn24_encode", encoder("crytek_bfn24"), 4 * unitvec::best_fit::TABLE_WORDS),
        ("decode_by_table", compiler.decode_by_table().unwrap(), 12 << 16),
    ] {
        let short = runner.table(&vec![0x11; whole - 4]).unwrap();
        let whole = runner.table(&vec![0x11; whole]).unwrap();
        let from_rust = modules.load(name).unwrap();
        for (spirv, entry_point) in [(&from_rust[..], name), (&from_glsl[..], glsl::ENTRY_POINT)] {
            for (table, is_written) in [(&short, false), (&whole, true)] {
                for buffers in [BufferPromise::ExactSize, BufferPromise::WholeGroups] {
                    let kernel =
                        runner.kernel_for(buffers, Division::Exact, spirv, entry_point, Some(table)).unwrap();
                    let mut output = [0; 12];
                    runner.run(&kernel, 1, &[0x22; 12], &mut output).unwrap();
                    let untouched = output.chunks(4).all(|word| word == SENTINEL.to_le_bytes());
                    assert_eq!(untouched, !is_written, "{entry_point} of {name}, {buffers:?}");
                }
            }
        }
    }
    drop(runner);
    assert_no_validation_messages(device);
}

/// Slices of different numbers of elements, or that end within one, are an error on every backend; empty ones are not.
#[test]
fn backends_refuse_wrong_lengths() {
    let device = lavapipe();
    let gpu = |source| -> Box<dyn Backend> { Box::new(Gpu::new(&device, source, true).unwrap()) };
    let translated = |language| gpu(KernelSource::Language(language, Edition::Plain));
    let [hlsl, wgsl] = [Language::Hlsl, Language::Wgsl].map(translated);
    for mut backend in [Box::new(Cpu), gpu(embedded()), gpu(from_glsl()), hlsl, wgsl] {
        let none = find("oct48p").unwrap();
        backend.encode(none, &[], &mut []).unwrap();
        backend.decode(none, &[], &mut []).unwrap();
        for (id, floats, bytes) in [("oct24", 6, 3), ("oct24", 5, 6), ("oct24", 6, 7), ("frame64", 6, 8)] {
            let format = find(id).unwrap();
            let (mut elements, mut codes) = (vec![0.0; floats], vec![0; bytes]);
            let encoded = backend.encode(format, &elements, &mut codes);
            let decoded = backend.decode(format, &codes, &mut elements);
            for result in [encoded, decoded] {
                assert!(
                    matches!(result, Err(unitvec_run::Error::LengthMismatch(_))),
                    "{id} {floats} {bytes}"
                );
            }
        }
    }
}

/// The kernels that decode by a table give the CPU's results, for all codes.
#[test]
fn decoding_by_table_agrees() {
    let device = lavapipe();
    let codes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    for source in [embedded(), from_glsl()] {
        let mut runner = Runner::new(&device, 1 << 16, true).unwrap();
        for id in ["oct16", "fib16", "hemioct16"] {
            let expected: Vec<u8> = decode_table(find(id).unwrap())
                .unwrap()
                .iter()
                .flatten()
                .flat_map(|c| c.to_ne_bytes())
                .collect();
            let table = runner.table(&expected).unwrap();
            let kernel = source.decode_by_table(&runner, &table).unwrap();
            let mut actual = vec![0; expected.len()];
            runner.run(&kernel, 1 << 16, &codes, &mut actual).unwrap();
            assert!(actual == expected, "{id}");
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
    let working = compiler.kernel(find("oct16").unwrap(), Operation::Decode).unwrap();

    let mut runner = Runner::new(&device, 8, true).unwrap();
    let (mut first, mut second) = ([0; 24], [0; 24]);
    let kernel = runner.kernel(&working, glsl::ENTRY_POINT, None).unwrap();
    runner.run(&kernel, 2, &[1, 2, 3, 4], &mut first).unwrap();
    let kernel = runner.kernel(&idle, glsl::ENTRY_POINT, None).unwrap();
    runner.run(&kernel, 2, &[1, 2, 3, 4], &mut second).unwrap();
    assert_ne!(first, second);
    assert!(f32::from_le_bytes([second[0], second[1], second[2], second[3]]).is_nan());
}

/// Calls that would be undefined in Vulkan are errors here.
#[test]
fn runners_refuse_what_they_cannot_run() {
    let device = lavapipe();
    assert!(matches!(Runner::new(&device, 0, false), Err(Error::BadCount { .. })));
    assert!(matches!(Runner::new(&device, usize::MAX, false), Err(Error::BadCount { .. })));
    let (mut one, other) = (Runner::new(&device, 8, false).unwrap(), Runner::new(&device, 8, false).unwrap());
    let compiler = glsl::Compiler::new().unwrap();
    let module = compiler.kernel(find("oct16").unwrap(), Operation::Decode).unwrap();
    let foreign = other.kernel(&module, glsl::ENTRY_POINT, None).unwrap();
    assert!(matches!(one.run(&foreign, 1, &[0; 2], &mut [0; 12]), Err(Error::ForeignKernel)));
    let kernel = one.kernel(&module, glsl::ENTRY_POINT, None).unwrap();
    assert!(matches!(one.run(&kernel, 9, &[0; 18], &mut [0; 108]), Err(Error::BadCount { .. })));
    assert!(matches!(one.kernel(&module, "absent", None), Err(Error::NotSpirv { .. })));
    drop((foreign, kernel, one, other));
    assert_no_validation_messages(device);
}

/// Conform counts thousands of mismatches with the precise encoder's module in the place of the fast one's.
#[test]
fn a_kernel_that_computes_something_else_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    swap_kernels(folder.path());
    let device = lavapipe();
    let source = KernelSource::Rust(Modules::open_trusted(folder.path()).unwrap(), Edition::Exact);
    let options = options(10_000);
    let plan = Plan::new(find("oct16").unwrap(), &options);
    let row = plan.run(&mut backends(&device, source), &mut |_| ()).unwrap();
    assert!(!row.agrees());
    assert!(row.encode_mismatches[&BackendKind::Rust] > 1000);
    assert_eq!(row.encode_mismatches[&BackendKind::Glsl], 0);
    let none = Mismatches::from([(BackendKind::Rust, 0), (BackendKind::Glsl, 0)]);
    assert_eq!(row.decode_mismatches, none);
    assert!(row.examples[0].contains("cpu [") && row.examples[0].contains("rust ["), "{:?}", row.examples);
}

/// Copies the modules to `folder`, with oct16p's kernels in the place of oct16's. Their decoders are the same.
fn swap_kernels(folder: &Path) {
    copy_modules(folder);
    let mut module = std::fs::read(folder.join("kernels/oct16p.spv")).unwrap();
    for operation in Operation::ALL {
        // NUL ends a name in SPIR-V and fills its last word.
        let [from, to] = ["oct16p", "oct16"].map(|id| format!("{:\0<16}", format!("{id}_{operation}")));
        module = rename(&module, from.as_bytes(), to.as_bytes());
    }
    replace_module(folder, "kernels/oct16.spv", &module);
}

fn rename(module: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = module.windows(from.len()).position(|window| window == from).unwrap();
    [&module[..at], to, &module[at + from.len()..]].concat()
}
