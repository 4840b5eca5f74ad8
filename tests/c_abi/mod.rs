//! The C interface: its header and the header's sources, and the functions, called from C.

mod examples;
mod program;
mod text;

use program::{Library, compile, libraries};
use std::io::Write;
use std::process::{Command, Stdio};
use unitvec_catalogue::{AnyCodec, CODECS, Domain};
use unitvec_run::sampling;
use unitvec_tests::repository;

/// Random vectors or frames for each codec, and as many codes.
const RANDOM: usize = 20_000;

/// All functions of each codec, called from C, give the bits of the catalogue's, of random inputs and the special ones:
/// those of single elements, of arrays, and of arrays on all cores, which are long enough to be cut.
#[test]
fn every_codec_gives_the_cpus_bits() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("codecs.inc"), text::calls()).unwrap();
    let source = repository().join("tests/c_abi/codecs.c");
    let program = compile(&source, folder.path(), Library::Static);
    let wrong: Vec<String> = CODECS
        .iter()
        .filter_map(|format| {
            let (input, all) = input_and_output(format);
            let count = all.len() / 3 / (format.bytes + format.element.bytes());
            let mut child = Command::new(&program)
                .args([format.id, &count.to_string()])
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .spawn()
                .unwrap();
            let mut stdin = child.stdin.take().unwrap();
            let output = std::thread::scope(|scope| {
                scope.spawn(move || stdin.write_all(&input));
                child.wait_with_output().unwrap()
            });
            assert!(output.status.success(), "{} ended with {}", format.id, output.status);
            assert_eq!(output.stdout.len(), all.len(), "{}", format.id);
            let differing = output.stdout.iter().zip(&all).filter(|(a, b)| a != b).count();
            (differing > 0).then(|| format!("{}: {differing} bytes of {}", format.id, all.len()))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Elements and as many codes; and what the program writes of them: the catalogue's results one at a time, of an array,
/// and of an array on all cores.
fn input_and_output(format: &AnyCodec) -> (Vec<u8>, Vec<u8>) {
    let floats = format.element.floats();
    let random = sampling::random_elements(format.element, Domain::Sphere, 31).take(RANDOM * floats);
    let special = sampling::special_elements(format.element).iter().copied();
    let elements: Vec<f32> = random.chain(special).collect();
    let count = elements.len() / floats;
    let numbers: Vec<u64> =
        sampling::special_codes().into_iter().chain(sampling::random_codes(32)).take(count).collect();
    let codes = sampling::stored(&numbers, format.bytes);
    let (mut encoded, mut decoded) = (vec![0; codes.len()], vec![0.0; elements.len()]);
    format.encode_cpu(&elements, &mut encoded).unwrap();
    format.decode_cpu(&codes, &mut decoded).unwrap();
    let bytes = |floats: Vec<f32>| floats.into_iter().flat_map(|f| f.to_bits().to_ne_bytes());
    (
        bytes(elements).chain(codes).collect(),
        encoded.into_iter().chain(bytes(decoded)).collect::<Vec<_>>().repeat(3),
    )
}

/// Wrong arguments return the error that the header names, write nothing, and never end the program; strided elements
/// give the codes of arrays; a process that was forked after a parallel call does not hang.
#[test]
fn programs_succeed() {
    for (name, library) in
        [("errors.c", Library::Shared), ("strided.c", Library::Static), ("fork.c", Library::Static)]
    {
        let folder = tempfile::tempdir().unwrap();
        let program = compile(&repository().join("tests/c_abi").join(name), folder.path(), library);
        let output = Command::new(program).arg(env!("CARGO_PKG_VERSION")).output().unwrap();
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

/// The CMake package is installed and found, and adds little to a program. Cargo has built the library for these tests.
#[test]
#[cfg_attr(not(feature = "glsl"), ignore = "needs CMake: `cargo xtask test` installs it")]
fn the_cmake_package_works() {
    let (folder, script) = (tempfile::tempdir().unwrap(), "tests/c_abi/package/test.cmake");
    let mut cmake = Command::new("cmake");
    cmake.arg(format!("-DROOT={}", repository().display())).arg(format!("-DBUILT={}", libraries().display()));
    cmake.args([concat!("-DCARGO=", env!("CARGO")), concat!("-DVERSION=", env!("CARGO_PKG_VERSION"))]);
    let output = cmake.arg("-P").arg(repository().join(script)).current_dir(&folder).output();
    let output = output.unwrap_or_else(|error| panic!("cmake cannot be started: {error}"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
