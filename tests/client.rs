//! `tests/clients/kernels.py`, a client in another language, written from README, docs and the manifest: buffers of exact
//! size, no feature, and the same bits as the CPU's.

use std::io::Write;
use std::process::{Command, Output};
use unitvec_catalogue::{Domain, Operation, find};
use unitvec_run::backend::{Backend, Cpu};
use unitvec_run::sampling;
use unitvec_tests::program::raw;
use unitvec_tests::repository;

/// Runs a kernel on lavapipe, with validation.
fn run(kernel: &str, count: usize, input: &[u8]) -> Output {
    let mut file = tempfile::tempfile().unwrap();
    file.write_all(input).unwrap();
    std::io::Seek::rewind(&mut file).unwrap();
    Command::new("python3")
        .arg(repository().join("tests/clients/kernels.py"))
        .arg(repository().join("spirv"))
        .args([kernel, &count.to_string(), "--device", "llvmpipe"])
        .env("UNITVEC_VALIDATE", "1")
        .stdin(file)
        .output()
        .expect("python3 is missing: `cargo xtask setup` installs it")
}

fn output(kernel: &str, count: usize, input: &[u8]) -> Vec<u8> {
    let output = run(kernel, count, input);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{kernel}: {said}");
    output.stdout
}

/// Codes of each number of bytes, frames, and an encoder by table; a number of them that leaves a group of four, and most
/// codes' last word, incomplete.
#[test]
fn a_client_in_python_gets_the_cpus_bits() {
    const COUNT: usize = 1003;
    for id in ["oct8", "oct16", "fib24", "oct32p", "oct48", "oct52p", "snorm8x3p", "frame32", "frame64"] {
        let format = find(id).unwrap();
        let random = sampling::random_elements(format.element, Domain::Sphere, 12);
        let mut elements: Vec<f32> = random.take(COUNT * format.element.floats()).collect();
        let mut codes = vec![0; COUNT * format.bytes];
        Cpu.encode(format, &elements, &mut codes).unwrap();
        assert_eq!(output(&format.function(Operation::Encode), COUNT, &raw(&elements)), codes, "{id}");
        Cpu.decode(format, &codes, &mut elements).unwrap();
        assert_eq!(output(&format.function(Operation::Decode), COUNT, &codes), raw(&elements), "{id}");
    }
}

/// A kernel that is not there, and input whose length does not match the count.
#[test]
fn the_client_fails_with_one_line() {
    for (kernel, count, input) in [("oct15_encode", 1, &[0u8; 12][..]), ("oct16_encode", 2, &[0; 12])] {
        let output = run(kernel, count, input);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), said.lines().count()), (Some(1), 1), "{said}");
    }
}
