//! The C interface: its header and the header's sources, and the functions, called from C.

mod examples;
mod program;
mod text;

use program::{Library, compile};
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
            let (input, expected) = input_and_output(format);
            let mut child = Command::new(&program)
                .args([format.id, &(expected.codes.len() / format.bytes).to_string()])
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
            let all = expected.all();
            assert_eq!(output.stdout.len(), all.len(), "{}", format.id);
            let differing = output.stdout.iter().zip(&all).filter(|(a, b)| a != b).count();
            (differing > 0).then(|| format!("{}: {differing} bytes of {}", format.id, all.len()))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The catalogue's results for the inputs of a codec.
struct Expected {
    codes: Vec<u8>,
    decoded: Vec<u8>,
}

impl Expected {
    /// The program's output: the results one at a time, of an array, and of an array on all cores.
    fn all(&self) -> Vec<u8> {
        [&*self.codes, &*self.decoded].concat().repeat(3)
    }
}

/// Elements and as many codes, and their encoded and decoded values.
fn input_and_output(format: &AnyCodec) -> (Vec<u8>, Expected) {
    let floats = format.element.floats();
    let random = sampling::random_elements(format.element, Domain::Sphere, 31).take(RANDOM * floats);
    let special = sampling::special_elements(format.element).iter().copied();
    let elements: Vec<f32> = random.chain(special).collect();
    let count = elements.len() / floats;
    let numbers: Vec<u64> =
        sampling::special_codes().into_iter().chain(sampling::random_codes(32)).take(count).collect();
    let codes = sampling::stored(&numbers, format.bytes);
    let mut expected =
        Expected { codes: vec![0; codes.len()], decoded: Vec::with_capacity(4 * elements.len()) };
    format.encode_cpu(&elements, &mut expected.codes).unwrap();
    let mut decoded = vec![0.0; elements.len()];
    format.decode_cpu(&codes, &mut decoded).unwrap();
    expected.decoded.extend(decoded.iter().flat_map(|f| f.to_bits().to_ne_bytes()));
    let input = elements.iter().flat_map(|f| f.to_bits().to_ne_bytes()).chain(codes).collect();
    (input, expected)
}

/// Wrong arguments return the error that the header names, write nothing, and never end the program.
#[test]
fn wrong_arguments_give_errors() {
    let folder = tempfile::tempdir().unwrap();
    let program = compile(&repository().join("tests/c_abi/errors.c"), folder.path(), Library::Shared);
    let output = Command::new(program).arg(env!("CARGO_PKG_VERSION")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
