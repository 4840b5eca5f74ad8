//! Devices that round as badly as Vulkan allows: rewritten kernels do what their model says, held against float64, and the
//! codecs keep within their bounds on them.

use std::collections::BTreeMap;
use std::sync::Arc;
use unitvec_catalogue::{self as catalogue, find};
use unitvec_lab::imprecise;
use unitvec_lab::imprecise::{Bounds, Error, Gpus, Model, Options, Row, rewrite};
use unitvec_manifest::modules::Modules;
use unitvec_run::backend::{BackendKind, Gpu, KernelSource};
use unitvec_run::conform::Shared;
use unitvec_run::glsl::Compiler;
use unitvec_run::shader::{Edition, Language};
use unitvec_tests::directions::Rng;
use unitvec_tests::program::{command, stdout};
use unitvec_tests::{assert_no_validation_messages, copy_modules, lavapipe, replace_module};
use unitvec_vulkan::{Device, Runner};

/// Results for `a`, `b` and the integer `c`: `a / b` and `b / a`, the root of `a`, the difference, the product, and `c`
/// as float, taken as signed and as unsigned. Quotients, product and the signed integer are those of vectors.
const ARITHMETIC: &str = include_str!("imprecise.comp");

/// The result of an operation of [`ARITHMETIC`], and the exact result.
struct Computed {
    found: f32,
    exact: f64,
}

impl Computed {
    /// The error in ULP: the distance between the floats on either side of the exact result.
    fn ulp(&self) -> f64 {
        (f64::from(self.found) - self.exact) / 2f64.powi(self.exact.abs().log2().floor() as i32 - 23)
    }

    /// The exact result, rounded toward zero.
    fn truncated(&self) -> f32 {
        let near = self.exact as f32;
        if f64::from(near.abs()) > self.exact.abs() { f32::from_bits(near.to_bits() - 1) } else { near }
    }

    /// True where the found result is a power of two, at which a result that is moved up stops.
    fn is_power_of_two(&self) -> bool {
        self.found.to_bits() & 0x7f_ffff == 0
    }
}

/// Inputs from 2^-20 to 2^20, so that float64 holds sums and products exactly.
fn inputs() -> Vec<[u32; 3]> {
    let mut random = Rng::new(14);
    let mut input = || {
        let [a, b, c] = [(); 3].map(|()| random.bits() as u32);
        let float = |word: u32| (word & 0x807f_ffff) | ((107 + (word >> 23) % 41) << 23);
        [float(a) & 0x7fff_ffff, float(b), c >> (c % 32)]
    };
    (0..20_000).map(|_| input()).collect()
}

/// The results of a device of this model for inputs, seven each.
fn computed(device: &Arc<Device>, model: Model, seed: u32, inputs: &[[u32; 3]]) -> Vec<[f32; 7]> {
    computed_by(ARITHMETIC, device, model, seed, inputs)
}

/// [`computed`], by a kernel of this text.
fn computed_by(
    text: &str,
    device: &Arc<Device>,
    model: Model,
    seed: u32,
    inputs: &[[u32; 3]],
) -> Vec<[f32; 7]> {
    let spirv = Compiler::new().unwrap().compile("arithmetic.comp", text, &[]).unwrap();
    let rewritten = rewrite(&spirv, ("arithmetic", "main"), model, seed).unwrap();
    let mut runner = Runner::new(device, inputs.len(), true).unwrap();
    let kernel = runner.kernel(&rewritten, "main", None).unwrap();
    let mut results = vec![[0.0; 7]; inputs.len()];
    let bytes = bytemuck::cast_slice_mut(results.as_flattened_mut());
    runner.run(&kernel, inputs.len(), bytemuck::cast_slice(inputs.as_flattened()), bytes).unwrap();
    results
}

/// Results beside the exact ones: two quotients, the root, the difference, the product, two integers.
fn beside_exact(input: [u32; 3], results: [f32; 7]) -> [Computed; 7] {
    let [a, b] = [input[0], input[1]].map(|bits| f64::from(f32::from_bits(bits)));
    let exact = [a / b, b / a, a.sqrt(), a - b, a * b, f64::from(input[2] as i32), f64::from(input[2])];
    let mut pairs = results.into_iter().zip(exact);
    std::array::from_fn(|_| {
        let (found, exact) = pairs.next().unwrap();
        Computed { found, exact }
    })
}

/// Quotients are off by 1.5 to 2.5 ULP to the model's side, and roots by as much as `1 / inversesqrt` may be; the rest is
/// rounded to nearest.
#[test]
fn quotients_and_roots_are_off_by_what_vulkan_allows() {
    let device = lavapipe();
    let inputs = inputs();
    for (model, [quotients, roots]) in [
        (Model::Up, [1.0, 1.0]),
        (Model::Down, [-1.0, -1.0]),
        (Model::UpDown, [1.0, -1.0]),
        (Model::DownUp, [-1.0, 1.0]),
    ] {
        for (input, results) in inputs.iter().zip(computed(&device, model, 0, &inputs)) {
            let [first, second, root, rest @ ..] = beside_exact(*input, results);
            for quotient in [first, second] {
                // Up is away from zero.
                let ulp = quotients * quotient.ulp() * quotient.exact.signum();
                let least = if quotient.is_power_of_two() { 0.0 } else { 1.5 };
                // A ULP below a power of two is half of one above it.
                let least = if quotients < 0.0 && least > 0.0 { 0.5 } else { least };
                assert!(least <= ulp && ulp <= 2.5, "{model} {input:x?}: {ulp}");
            }
            let significand = root.exact / 2f64.powi(root.exact.log2().floor() as i32);
            let ulp = roots * root.ulp();
            assert!(ulp <= significand * significand + 2.5, "{model} {input:x?}: {ulp}");
            // The number of whole ULP, less the half that rounding may have taken; half as many below a power of two.
            let least = (significand * significand + 2.0).floor() - 0.5;
            assert!(
                ulp >= if roots < 0.0 { least / 2.0 - 0.5 } else { least } || root.is_power_of_two(),
                "{model} {input:x?}: {ulp}"
            );
            assert!(
                rest.iter().all(|computed| computed.found == computed.exact as f32),
                "{model} {input:x?}"
            );
        }
    }
    assert_no_validation_messages(device);
}

/// Inverse roots, with which exact text starts, go where quotients go; beside the move are the roundings of a root and a quotient.
#[test]
fn inverse_roots_are_off_as_quotients_are() {
    let (device, inputs) = (lavapipe(), inputs());
    let text = ARITHMETIC.replace("sqrt(a)", "inversesqrt(a)");
    // From a power of two down, a ULP is half of one above it.
    let (up, down) = (0.5..=3.5, -3.5..=0.0);
    let inverse = |input: &[u32; 3], results: [f32; 7]| {
        let exact = 1.0 / f64::from(f32::from_bits(input[0])).sqrt();
        Computed { found: results[2], exact }
    };
    for (model, ulp) in [(Model::Up, &up), (Model::UpDown, &up), (Model::Down, &down), (Model::DownUp, &down)]
    {
        for (input, results) in inputs.iter().zip(computed_by(&text, &device, model, 0, &inputs)) {
            let inverse = inverse(input, results);
            assert!(ulp.contains(&inverse.ulp()) || inverse.is_power_of_two(), "{model} {input:x?}");
        }
    }
    // The operands choose the side.
    let mut sides = [0; 2];
    for (input, results) in inputs.iter().zip(computed_by(&text, &device, Model::Far, 0, &inputs)) {
        let inverse = inverse(input, results);
        sides[usize::from(inverse.ulp() < 0.0)] += 1;
        assert!((5.0..=13.5).contains(&inverse.ulp().abs()) || inverse.is_power_of_two(), "{input:x?}");
    }
    assert!(sides.iter().all(|count| *count > inputs.len() / 3), "{sides:?}");
    assert_no_validation_messages(device);
}

/// Every distance from -2 to 2 ULP is chosen equally often, by the operands and the seed.
#[test]
fn the_bits_choose_where_quotients_go() {
    let device = lavapipe();
    let inputs = inputs();
    let [one, other] = [1, 2].map(|seed| computed(&device, Model::Bits, seed, &inputs));
    let mut counts = BTreeMap::new();
    for (input, results) in inputs.iter().zip(&one) {
        let [quotient, ..] = beside_exact(*input, *results);
        assert!(quotient.ulp().abs() <= 2.5, "{input:x?}");
        let steps = quotient.found.to_bits().wrapping_sub((quotient.exact as f32).to_bits()) as i32;
        *counts.entry(steps).or_insert(0) += 1;
    }
    let (keys, values): (Vec<i32>, Vec<i32>) = counts.into_iter().unzip();
    assert_eq!(keys, [-2, -1, 0, 1, 2]);
    // Six standard deviations of one in five.
    let (mean, deviation) = (inputs.len() as f64 / 5.0, (inputs.len() as f64 * 0.16).sqrt());
    assert!(values.iter().all(|count| (f64::from(*count) - mean).abs() < 6.0 * deviation), "{values:?}");
    let same = one.iter().zip(&other).filter(|(one, other)| one[0] == other[0]).count();
    assert!((same as f64 - mean).abs() < 6.0 * deviation, "{same}");
}

#[test]
fn truncated_results_are_the_exact_ones_rounded_toward_zero() {
    let device = lavapipe();
    let inputs = inputs();
    let mut moved = [0; 7];
    for (input, results) in inputs.iter().zip(computed(&device, Model::Truncate, 0, &inputs)) {
        let all = beside_exact(*input, results);
        for (index, computed) in all.iter().enumerate() {
            let expected = if index < 3 { computed.exact as f32 } else { computed.truncated() };
            assert_eq!(computed.found, expected, "{input:x?}, result {index}");
            moved[index] += usize::from(computed.found != computed.exact as f32);
        }
    }
    assert!(moved[..3] == [0; 3] && moved[3..].iter().all(|count| *count > 1000), "{moved:?}");
}

/// Denormals count as zero, of their sign, and come out as zero; the rest is as on the CPU.
#[test]
fn denormals_are_flushed_before_and_after_operations() {
    let device = lavapipe();
    let (small, least) = (f32::from_bits(0x40_0000), f32::MIN_POSITIVE);
    let cases = [
        ([small, 2.0], [0.0, f32::INFINITY, 0.0, -2.0, 0.0]),
        ([2.0, -small], [f32::NEG_INFINITY, -0.0, 2f32.sqrt(), 2.0, -0.0]),
        ([least, 3.0], [0.0, 3.0 / least, least.sqrt(), -3.0, 3.0 * least]),
        ([1.5 * least, least], [1.5, least / (1.5 * least), (1.5 * least).sqrt(), 0.0, 0.0]),
        ([3.0, 4.0], [0.75, 4.0 / 3.0, 3f32.sqrt(), -1.0, 12.0]),
    ];
    let inputs: Vec<[u32; 3]> = cases.iter().map(|([a, b], _)| [a.to_bits(), b.to_bits(), 5]).collect();
    for ((input, expected), results) in cases.iter().zip(computed(&device, Model::Flush, 0, &inputs)) {
        let bits = |of: &[f32]| of.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&results[..5]), bits(expected), "{input:?}: {results:?}");
    }
}

/// Drivers may fold what is not decorated, SwiftShader a quotient by a constant: flushed operations stay decorated.
#[test]
fn flushed_operations_may_not_be_contracted() {
    let spirv = Modules::open(None).unwrap().load("snorm8x3_decode").unwrap();
    let flushed = rewrite(&spirv, ("snorm8x3_decode", "snorm8x3_decode"), Model::Flush, 0).unwrap();
    let decorated = |spirv: &[u8]| {
        let words: Vec<u32> = spirv.chunks_exact(4).map(bytemuck::pod_read_unaligned).collect();
        // OpDecorate, of three words, with NoContraction.
        words.windows(3).filter(|words| words[0] == 3 << 16 | 71 && words[2] == 42).count()
    };
    assert_eq!(decorated(&flushed), decorated(&spirv));
    assert!(decorated(&spirv) > 3);
}

/// An operation whose error no model knows is an error.
#[test]
fn unknown_operations_are_refused() {
    let other = ARITHMETIC.replace("sqrt(a)", "sin(a)");
    let spirv = Compiler::new().unwrap().compile("arithmetic.comp", &other, &[]).unwrap();
    let error = rewrite(&spirv, ("arithmetic", "main"), Model::Up, 0).unwrap_err();
    assert!(matches!(&error, Error::NotModelled { operation, .. } if operation.contains("Sin")), "{error}");
    let error = rewrite(&spirv[..52], ("arithmetic", "main"), Model::Up, 0).unwrap_err();
    assert!(matches!(error, Error::NotSpirv { .. }), "{error}");
}

/// A codec of each kind of arithmetic; `unitvec conform imprecise` takes all.
const CODECS: &str = "oct16 eaoct16p ico16 frame32 oct48p spherical16 fib16 stereo16 cube16 spp48 \
    snorm8x3_nearest";

/// Models for these: the command takes those too that move all down, or quotients and roots to different sides.
const MODELS: [Model; 5] = [Model::Up, Model::Bits, Model::Flush, Model::Truncate, Model::Far];

/// Codecs whose exact kernels in other languages run too: of a quotient, roots, and by table. Their arithmetic is that of the GLSL.
const IN_ALL_LANGUAGES: [&str; 3] = ["oct16", "stereo16", "snorm8x3_nearest"];

fn rows(ids: &[&str], kernels: &[(Edition, BackendKind)]) -> Vec<Row> {
    let device = lavapipe();
    let formats = ids.iter().map(|id| find(id).unwrap()).collect::<Vec<_>>();
    let options = Options { count: 4096, seeds: vec![3], models: MODELS.to_vec(), all_codes_up_to: 12 };
    let open = || {
        let of = |&(edition, kind)| {
            let source = match kind {
                BackendKind::Rust => KernelSource::Rust(Modules::open(None).unwrap(), edition),
                BackendKind::Hlsl => KernelSource::Language(Language::Hlsl, edition),
                BackendKind::Wgsl => KernelSource::Language(Language::Wgsl, edition),
                _ => KernelSource::Glsl(Compiler::of(edition).unwrap()),
            };
            ((edition, kind), Gpu::new(&device, source, true).unwrap())
        };
        Ok(kernels.iter().map(of).collect::<Gpus>())
    };
    let (mut work, mut rows) = (0, Vec::new());
    imprecise::run(formats.clone(), &options, open, &mut |done| work += done, &mut |row| {
        rows.push(row);
        Ok::<(), unitvec_lab::Error>(())
    })
    .unwrap();
    assert_eq!(rows.iter().map(|row| row.id.as_str()).collect::<Vec<_>>(), ids);
    assert_eq!(work, formats.iter().map(|format| options.work(format)).sum::<u64>());
    for (row, format) in rows.iter().zip(&formats) {
        assert_eq!(row.objections(&Bounds::of(format)), [""; 0], "{}", row.id);
        assert_eq!(row.exact.len(), MODELS.len());
        assert!(row.codes > row.elements, "{row:?}");
    }
    assert_no_validation_messages(device);
    rows
}

/// Plain kernels keep within their bounds; exact ones have the CPU's bits, of special input too, but where sums are truncated.
#[test]
fn codecs_keep_within_their_bounds_on_every_device() {
    let of = |edition| [(edition, BackendKind::Rust), (edition, BackendKind::Glsl)];
    let rows =
        rows(&CODECS.split(' ').collect::<Vec<_>>(), &[of(Edition::Plain), of(Edition::Exact)].concat());
    assert!(rows.iter().all(|row| row.models.len() == MODELS.len() - 1));
    // Best fit loses codes, which shows that loss is counted.
    assert!(rows.last().is_some_and(|row| !row.unstable.is_empty()));
    // The models have effects: quotients show in decoded vectors, truncated sums in codes.
    let oct: &Row = &rows[0];
    assert!(oct.models[&Model::Up].component_ulp > 0.0 && oct.models[&Model::Flush].component_ulp == 0.0);
    assert!(oct.models[&Model::Truncate].codes_differ > oct.elements / 2, "{oct:?}");
    assert!(oct.exact[&Model::Truncate].differs(), "{oct:?}");
}

/// Exact kernels of HLSL and WGSL have the CPU's bits as well, but where sums are truncated.
#[test]
fn exact_kernels_of_other_languages_have_the_cpus_bits() {
    let kernels = [BackendKind::Hlsl, BackendKind::Wgsl].map(|kind| (Edition::Exact, kind));
    rows(&IN_ALL_LANGUAGES, &kernels);
}

/// The verdict of `conform` on a device whose own division is as loose as Vulkan allows, and on one that no kernel can put right:
/// modules rewritten with these models, one after the other; and whether it flushes denormals.
fn verdict(models: &[Model]) -> (bool, String, bool) {
    let folder = tempfile::tempdir().unwrap();
    copy_modules(folder.path());
    for (file, entry_point) in
        [("kernels/oct32.spv", "oct32_encode"), ("kernels/arithmetic.spv", "arithmetic")]
    {
        let mut module = std::fs::read(folder.path().join(file)).unwrap();
        for model in models {
            module = rewrite(&module, (entry_point, entry_point), *model, 5).unwrap();
        }
        replace_module(folder.path(), file, &module);
    }
    let share = folder.path().join("device.json");
    let mut command = command(["conform", "--codec", "oct32", "--count", "65536", "--trust", "--spirv"]);
    let output = command.arg(folder.path()).arg("--share").arg(&share).output().unwrap();
    let shared: Shared = serde_json::from_slice(&std::fs::read(share).unwrap()).unwrap();
    (output.status.success(), stdout(&output), shared.arithmetic.flushes_denormals)
}

/// Exact kernels pass on a loose device, plain ones within their bounds; a far device fails, with its reason.
#[test]
fn conform_tells_loose_devices_from_wrong_ones() {
    let (passes, text, flushes) = verdict(&[Model::Bits]);
    assert!(passes && !flushes && text.contains("quotients: the device's own are within 2.5 ULP"), "{text}");
    assert!(text.contains("plain functions keep within their bounds on this device"), "{text}");
    assert!(matches!(verdict(&[Model::Flush]), (true, _, true)));
    let (passes, text, _) = verdict(&[Model::Far, Model::Far]);
    assert!(!passes && text.contains("ULP off, more than 14 that can be put right"), "{text}");
}

/// Numbers above a bound are objections that name the model and the number.
#[test]
fn what_exceeds_a_bound_is_told() {
    let bounds = Bounds::of(find("oct16").unwrap());
    let most = bounds.codes_differ(65_536).unwrap();
    let outcome = |codes_differ| imprecise::Outcome { codes_differ, ..Default::default() };
    let row = |model, outcome| Row {
        id: "oct16".into(),
        elements: 65_536,
        codes: 65_536,
        models: BTreeMap::from([(model, outcome)]),
        ..Row::default()
    };
    let objections = |model, outcome| row(model, outcome).objections(&bounds);
    assert_eq!(objections(Model::Up, outcome(most)), [""; 0]);
    assert_eq!(
        objections(Model::Up, outcome(most + 1)),
        [format!("up: codes that differ: {}, more than {most}", most + 1)]
    );
    assert_eq!(objections(Model::Flush, outcome(1)), ["flush: codes that differ: 1, more than 0"]);
    assert_eq!(objections(Model::Truncate, outcome(65_536)), [""; 0]);
    let far = imprecise::Outcome { angle_deg: 1e-5, ..Default::default() };
    assert_eq!(objections(Model::Bits, far).len(), 1);
    let lost =
        Row { unstable: BTreeMap::from([("from up to exact".into(), 3)]), ..row(Model::Up, outcome(0)) };
    let told = "codes that do not come back, of 1 pairs of devices: 3 from up to exact, the worst";
    assert_eq!(lost.objections(&bounds), [told]);
    // NaN and zeros of the other sign count.
    let zero = imprecise::Outcome { elements_differ: 1, ..Default::default() };
    assert_eq!(objections(Model::Flush, zero), ["flush: decoded elements that differ: 1"]);
    assert_eq!(objections(Model::Up, zero), [""; 0]);
}

/// Every family has limits of its own: without them it would have to match to the bit.
#[test]
fn every_family_has_limits() {
    for format in catalogue::CODECS.iter().filter(|format| format.id != "float16x3") {
        let (component, angle) = Bounds::of(format).decoded();
        assert!(component > 1.0 && angle > 6e-6 || component > 10.0 && angle > 5e-6, "{}", format.id);
    }
}
