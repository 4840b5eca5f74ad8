//! Readers under fire: mutated files of each format end in a result or in one line that names the file, without a panic, in
//! bounded memory, and leave nothing behind.
//!
//! The ordinary tests take [`ORDINARY`] inputs in all; `cargo xtask test --fuzz` takes 10^6. `UNITVEC_FUZZ` and
//! `UNITVEC_FUZZ_SEED` give other numbers. Each target prints its seed; an input that fails is kept in a file.

mod memory;
mod mutate;
mod program;
pub mod seeds;
mod shapes;

use image::ImageFormat;
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Instant;
use unitvec_catalogue::{Element, find};
use unitvec_choose::Costs;
use unitvec_host::input::{Elements, Input, Kind};
use unitvec_host::stream::{self, Named};
use unitvec_link as link;
use unitvec_manifest::modules;
use unitvec_manifest::modules::Modules;
use unitvec_mesh as mesh;
use unitvec_mesh::edit::{Change, edit};
use unitvec_mesh::{FileFormat, Reach};
use unitvec_run::backend::Cpu;
use unitvec_texture::{dds, ktx2};
use unitvec_vulkan::check_spirv;

/// Inputs of the ordinary tests.
const ORDINARY: u64 = 10_000;

/// A reader of a file: an error's text, or the number of vectors.
type Read = fn(&Path, &[u8]) -> Result<usize, String>;

/// A format, and its reader.
struct Target {
    /// Name of the file, which errors have to contain.
    file: &'static str,
    seeds: fn() -> Vec<Vec<u8>>,
    read: Read,
    /// The target's share in a hundred inputs.
    share: f64,
    /// Bytes beyond four times the file's: chunks, and the parser's fixed memory.
    slack: usize,
}

/// The memory that a parser takes for any file, however small.
const FIXED: usize = 1 << 16;

/// Positions and sums of as many vertices, of three bytes each, as a file of the largest size can hold that is refused in the
/// end: its vectors are not counted.
const REFUSED: usize = (12 + 24) * (mutate::MOST / 3);

/// The memory that the parser of PLY prepares for a list, whatever the list then holds.
const LIST: usize = 8 << 16;

/// Triangles of the shortest lines of a file of the largest size, in MikkTSpace and in the lists around it.
const TANGENTS: usize = 1024 * (mutate::MOST / 8);

/// The zeros where glTF gives no bytes for an accessor: positions, sums and normals of 2^16 vertices.
const ZEROS: usize = (12 + 24 + 12) << 16;

/// The instructions of a module of the largest size that mutations make, twice, and the names of all functions.
const INSTRUCTIONS: usize = 1 << 21;

/// The pixels, twice, that a picture of the largest size can hold before it is refused: a byte stands for 1032 at most.
const PICTURE: usize = 2 * 1032 * mutate::MOST;

/// The stream's buffers, which are of fixed size: elements, and codes twice.
const CHUNKS: usize = 40 << 20;

/// The targets, and a test of each. No target is forgotten where the shares are given.
macro_rules! targets {
    ($($test:ident: $target:ident = $file:expr, $seeds:expr, $read:ident, $share:literal, $slack:expr;)*) => {
        $(
            const $target: Target =
                Target { file: $file, seeds: $seeds, read: $read, share: $share, slack: $slack };

            #[test]
            fn $test() {
                fuzz(&$target);
            }
        )*

        #[test]
        fn the_shares_are_a_hundred() {
            assert_eq!([$($target.share),*].iter().sum::<f64>(), 100.0);
        }
    };
}

targets! {
    obj: OBJ = "a.obj", seeds::obj, read_mesh, 12.0, FIXED + REFUSED + TANGENTS;
    ply_ascii: PLY_ASCII = "ascii.ply", || seeds::ply(seeds::PLY_FORMATS[0]), read_mesh, 12.0, FIXED + LIST + REFUSED + TANGENTS;
    ply_little_endian: PLY_LITTLE = "little.ply", || seeds::ply(seeds::PLY_FORMATS[1]), read_mesh, 12.0, FIXED + LIST + REFUSED + TANGENTS;
    ply_big_endian: PLY_BIG = "big.ply", || seeds::ply(seeds::PLY_FORMATS[2]), read_mesh, 12.0, FIXED + LIST + REFUSED + TANGENTS;
    gltf: GLTF = "a.gltf", seeds::gltf, read_mesh, 12.0, FIXED + ZEROS + TANGENTS;
    glb: GLB = "a.glb", seeds::glb, read_mesh, 12.0, FIXED + ZEROS + TANGENTS;
    png: PNG = "a.png", || seeds::picture(ImageFormat::Png), read_texture, 2.0, FIXED + PICTURE;
    jpeg: JPEG = "a.jpg", || seeds::picture(ImageFormat::Jpeg), read_texture, 2.0, FIXED + PICTURE;
    tga: TGA = "a.tga", || seeds::picture(ImageFormat::Tga), read_texture, 2.0, FIXED + PICTURE;
    exr: EXR = "a.exr", || seeds::picture(ImageFormat::OpenExr), read_texture, 2.0, FIXED + PICTURE;
    ktx2: KTX2 = "a.ktx2", || seeds::textures(|texture| Ok(ktx2::write(texture))), read_texture, 2.0, FIXED;
    dds: DDS = "a.dds", || seeds::textures(dds::write), read_texture, 2.0, FIXED;
    raw: RAW = "a.f32", seeds::raw, encode_raw, 0.5, FIXED + CHUNKS;
    codes: CODES = "a.codes", seeds::raw, decode_codes, 0.5, FIXED + CHUNKS;
    costs: COSTS = "costs.json", seeds::costs, read_costs, 2.5, FIXED;
    // Lists of modules are copied when they grow.
    manifest: MANIFEST = "manifest.json", seeds::manifest, read_manifest, 2.5, 2 * FIXED;
    // The manifest lies beside the module.
    module: MODULE = seeds::MODULE_FILE, seeds::module, read_module, 5.0, 2 * FIXED;
    shader: SHADER = "shader.spv", seeds::shader, read_shader, 5.0, FIXED + INSTRUCTIONS;
}

/// Seconds of the processor for any input, which has 64 kB at most: a thousand times what most of them take.
const SLOWEST: f64 = 2.0;

/// Seconds that this thread has had of a processor: other programs do not count.
fn cpu_seconds() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

fn number(variable: &str, default: u64) -> u64 {
    std::env::var(variable)
        .map_or(default, |value| value.parse().unwrap_or_else(|_| panic!("{variable}={value}")))
}

/// The results of a target's inputs so far.
#[derive(Default)]
struct Tally {
    done: u64,
    read: u64,
    /// The most memory, in bytes.
    peak: usize,
}

/// Runs all inputs of a target. The first that fails is made as simple as it gets, and kept.
fn fuzz(target: &Target) {
    let count = (number("UNITVEC_FUZZ", ORDINARY) as f64 * target.share / 100.0).ceil() as u32;
    let seed = number("UNITVEC_FUZZ_SEED", 14);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(target.file);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    prepare(&path);
    // Memory that is allocated once, such as the program's own manifest, is no input's.
    (target.read)(&path, &(target.seeds)()[0]).unwrap_or_else(|error| panic!("the first seed: {error}"));
    std::fs::write(&path, b"").unwrap();
    let before = names(folder.path());
    let (started, tally) = (Instant::now(), RefCell::new(Tally::default()));
    println!("fuzz: {}: {count} inputs, seed {seed}", target.file);
    let config = Config {
        cases: count,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        max_shrink_iters: 10_000,
        ..Config::default()
    };
    let result = TestRunner::new(config).run(&mutate::inputs((target.seeds)()), |input| {
        let mut tally = tally.borrow_mut();
        judge(target, &path, &input, &mut tally).map_err(TestCaseError::fail)?;
        tally.done += 1;
        if tally.done % u64::from(count / 10 + 1) == 0 {
            println!("fuzz: {}: {} of {count}, {} s", target.file, tally.done, started.elapsed().as_secs());
        }
        Ok(())
    });
    match result {
        Ok(()) => {}
        Err(TestError::Fail(reason, input)) => {
            let kept = keep(target, &input);
            panic!("{reason}\nthe input, of {} bytes, is in {}; seed {seed}", input.len(), kept.display());
        }
        Err(error) => panic!("{error}"),
    }
    let left: Vec<_> = names(folder.path()).into_iter().filter(|name| !before.contains(name)).collect();
    assert!(left.is_empty(), "left behind: {left:?}");
    let Tally { done, read, peak } = tally.into_inner();
    println!(
        "fuzz: {}: {done} inputs in {:.1} s, seed {seed}: {read} were read, the others refused, in {peak} bytes of memory at \
         most",
        target.file,
        started.elapsed().as_secs_f64(),
    );
}

/// Writes the files beside the input.
fn prepare(path: &Path) {
    std::fs::write(path.with_file_name("zeros.f32"), [0; 24]).unwrap();
    std::fs::write(path.with_file_name(seeds::BUFFER_FILE), seeds::buffer_file()).unwrap();
    if path.ends_with(MODULE.file) {
        let manifest = path.ancestors().nth(2).unwrap().join(MANIFEST.file);
        std::fs::write(manifest, &seeds::manifest()[0]).unwrap();
    } else {
        let module = path.with_file_name(seeds::MODULE_FILE);
        std::fs::create_dir_all(module.parent().unwrap()).unwrap();
        std::fs::write(module, &seeds::module()[0]).unwrap();
    }
}

/// The files below a folder, by their paths in it.
fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| PathBuf::from(entry.unwrap().file_name()));
    let below = |name: PathBuf| match folder.join(&name) {
        path if path.is_dir() => names(&path).into_iter().map(|inner| name.join(inner)).collect(),
        _ => vec![name],
    };
    entries.flat_map(below).collect()
}

/// Keeps an input where the next `cargo clean` finds it.
fn keep(target: &Target, input: &[u8]) -> PathBuf {
    let name = Path::new(target.file).file_name().unwrap().to_str().unwrap();
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}"));
    std::fs::write(&kept, input).unwrap();
    kept
}

/// The reason why an input is not read as it should be.
fn judge(target: &Target, path: &Path, input: &[u8], tally: &mut Tally) -> Result<(), String> {
    let (mut result, before) = (Ok(Ok(0)), cpu_seconds());
    // Panics are caught inside: the counter of memory does not expect to be left by one.
    let memory = allocation_counter::measure(|| {
        result = catch_unwind(AssertUnwindSafe(|| (target.read)(path, input)));
    });
    let seconds = cpu_seconds() - before;
    if seconds > SLOWEST {
        return Err(format!("it takes {seconds} s"));
    }
    let result = result.map_err(|_| "it panics".to_owned())?;
    if let Err(message) = &result {
        check_message(message, path)?;
    }
    let peak = input.len() + memory.bytes_max as usize;
    let vectors = *result.as_ref().unwrap_or(&0);
    tally.read += u64::from(result.is_ok());
    tally.peak = tally.peak.max(peak);
    memory::check(peak, input.len(), vectors, target.slack)
}

/// One line that names the file, and no more than a terminal shows.
fn check_message(message: &str, path: &Path) -> Result<(), String> {
    // The folder of a manifest stands for it.
    let name = path.file_name().unwrap().to_str().unwrap();
    let folder = path.parent().unwrap().to_str().unwrap();
    let is_named = message.contains(name) || message.contains(folder) || message.contains("oct16");
    match message.chars().any(char::is_control) || !is_named || message.chars().count() > 600 {
        true => Err(format!("the error is not one line that names the file: {message:?}")),
        false => Ok(()),
    }
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// Normals, frames, shapes and rotations, read; the normals turned round. The number is that of the normals.
fn read_mesh(path: &Path, input: &[u8]) -> Result<usize, String> {
    let Some(format) = FileFormat::of(path, input) else {
        return Err(format!("{} lost its format", path.display()));
    };
    if let Err(error) = mesh::parse_frames(path, format, input, Reach::Folder) {
        check_message(&error.to_string(), path)?;
    }
    if let Err(error) = mesh::parse_shapes(path, format, input, Reach::Folder) {
        check_message(&error.to_string(), path)?;
    }
    match mesh::parse_rotations(path, format, input, Reach::Folder) {
        Ok(read) => assert!(read.parts.iter().all(|part| part.first + part.count <= read.rotations.len())),
        Err(error) => check_message(&error.to_string(), path)?,
    }
    let mut turn = |_, _, vectors: &mut [[f32; 3]]| vectors.iter_mut().for_each(|v| *v = v.map(|c| -c));
    let edited = edit(path, format, input, Reach::Folder, Change::Vectors(&mut turn));
    let turned = edited.map(|edited| mesh::parse(path, format, &edited.bytes, Reach::Folder));
    let mut turn = |_, rotations: &mut [[f32; 4]]| rotations.iter_mut().for_each(|q| *q = q.map(|c| -c));
    if let Err(error) = edit(path, format, input, Reach::Folder, Change::Rotations(&mut turn)) {
        check_message(&error.to_string(), path)?;
    }
    let mesh = mesh::parse(path, format, input, Reach::Folder).map_err(text)?;
    match turned {
        Ok(turned) => assert_eq!(turned.map_err(text)?.normals.len(), mesh.normals.len()),
        Err(error) => check_message(&error.to_string(), path)?,
    }
    assert!(mesh.parts.iter().all(|part| part.first + part.count <= mesh.normals.len()));
    Ok(mesh.normals.len())
}

fn read_texture(path: &Path, input: &[u8]) -> Result<usize, String> {
    let map = unitvec_texture::read(path, input, None).map_err(text)?.map;
    assert_eq!(map.vectors.len(), map.width as usize * map.height as usize);
    Ok(map.vectors.len())
}

fn encode_raw(path: &Path, input: &[u8]) -> Result<usize, String> {
    std::fs::write(path, input).unwrap();
    let format = find("oct32").unwrap();
    let mut elements = Elements::open(path, Element::Vector, Kind::default()).map_err(text)?;
    let mut codes = Vec::new();
    let (from, to): (stream::Input<'_>, stream::Sink<'_>) =
        (Named::new(path, &mut elements.floats), Named::new(path, &mut codes));
    let counts = stream::encode(&mut Cpu, format, None, from, to, &mut |_| ()).map_err(text)?;
    assert_eq!(codes.len() as u64, counts.elements * 4);
    Ok(counts.elements as usize)
}

fn decode_codes(path: &Path, input: &[u8]) -> Result<usize, String> {
    std::fs::write(path, input).unwrap();
    let format = find("frame64").unwrap();
    let (mut input, mut floats) = (Input::open(path).map_err(text)?, Vec::new());
    match (input.header().map_err(text)?, input.array().map_err(text)?) {
        (Some(header), _) => input.expect(header.count, format.bytes, "codes").map_err(text)?,
        (_, Some(array)) => Some(array.codes(format.bytes).map_err(|error| text(input.error(error)))?),
        _ => input.count(format.bytes, "codes").map_err(text)?,
    };
    let (from, to): (stream::Input<'_>, stream::Sink<'_>) =
        (Named::new(path, &mut input), Named::new(path, &mut floats));
    let count = stream::decode(&mut Cpu, format, None, from, to, &mut |_| ()).map_err(text)?;
    assert_eq!(floats.len() as u64, count * 28);
    // Each frame is 28 bytes, of which `vectors` counts 12.
    Ok(count as usize * 28 / 12 + 1)
}

fn read_costs(path: &Path, input: &[u8]) -> Result<usize, String> {
    Costs::parse(path, input).map(|_| 0).map_err(text)
}

/// A manifest over a correct module. Whatever it says, the program's own modules are loaded.
fn read_manifest(path: &Path, input: &[u8]) -> Result<usize, String> {
    std::fs::write(path, input).unwrap();
    load_from(path.parent().unwrap()).map_err(text)?;
    Ok(0)
}

/// A module under a correct manifest. Any that passes as SPIR-V of that kernel is made of whole instructions.
fn read_module(path: &Path, input: &[u8]) -> Result<usize, String> {
    std::fs::write(path, input).unwrap();
    let folder = path.ancestors().nth(2).unwrap();
    let trusted = Modules::open_trusted(folder).and_then(|modules| modules.load(seeds::KERNEL).map(|_| ()));
    trusted.map_err(text)?;
    if check_spirv(input, seeds::KERNEL).is_ok() {
        assert_whole_instructions(input);
    }
    load_from(folder).map_err(text)?;
    Ok(0)
}

/// A shader to be linked, as far as this program reads it. The result is whole instructions again.
fn read_shader(path: &Path, input: &[u8]) -> Result<usize, String> {
    let link = |error| unitvec_host::Error::Link { path: path.to_owned(), error };
    let (importing, names) = link::imports(input).map_err(link).map_err(text)?;
    assert!(!names.is_empty());
    assert_whole_instructions(&importing);
    Ok(0)
}

/// Each instruction has its length in the upper half of its first word, after a header of five words.
fn assert_whole_instructions(spirv: &[u8]) {
    let mut words = spirv.chunks(4).skip(5);
    while let Some(first) = words.next() {
        let length = usize::from(u16::from_le_bytes([first[2], first[3]]));
        assert!(length > 0 && (1..length).all(|_| words.next().is_some_and(|word| word.len() == 4)));
    }
}

/// Loads the kernel, as the program does without `--trust`.
fn load_from(folder: &Path) -> Result<(), modules::Error> {
    let loaded = Modules::open(Some(folder))?.load(seeds::KERNEL)?;
    static PROGRAM: OnceLock<Vec<u8>> = OnceLock::new();
    let program = PROGRAM.get_or_init(|| seeds::module().swap_remove(0));
    assert!(*loaded == **program, "SPIR-V that the program does not know");
    Ok(())
}
