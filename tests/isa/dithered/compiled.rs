//! The kernels compiled again, by the RADV that is installed here.

use super::{CODECS, FILE, GIVEN, KEYED, KEYS, row_id};
use crate::isa::{apart, rdna2};
use unitvec_catalogue::{Operation, find};
use unitvec_choose::costs::{Row, Source};
use unitvec_lab::isa::Asked;
use unitvec_run::glsl::{Compiler, ENTRY_POINT};
use unitvec_vulkan::Division;

const KERNEL: &str = include_str!("kernel.comp");

const COMPILE: &str = "isa::dithered::compiled::compile";

/// Compiles the kernels for the device of this process.
#[test]
#[ignore = "other tests run it with the environment of a driver"]
fn compile() {
    let of_library =
        ["arith", "oct", "hemioct", "soct", "eaoct", "dither"].map(|name| format!("unitvec/{name}.glsl"));
    let of_kernels = ["group", "words"].map(|name| format!("kernels/{name}.glsl"));
    let files: Vec<&str> = of_library.iter().chain(&of_kernels).map(String::as_str).collect();
    apart::compile(&files, &[("tests/isa/dithered/kernel.comp", KERNEL)], |asked, compiler| {
        let given = CODECS.map(|codec| (codec, GIVEN));
        let kernels = given.into_iter().chain(KEYS.map(|key| (KEYED, key)));
        let rows = kernels.flat_map(|(codec, key)| {
            Operation::ALL.map(|operation| row(asked, compiler, codec, operation, key))
        });
        rows.collect()
    });
}

fn row(asked: &Asked<'_>, compiler: &Compiler, codec: &str, operation: Operation, key: &str) -> Row {
    let format = find(codec).unwrap();
    let macros = [
        (operation.to_string().to_uppercase(), format!("{codec}_{operation}_dithered")),
        ("BYTES".to_owned(), format.bytes.to_string()),
        ("KEY".to_owned(), key.to_owned()),
    ];
    let module = compiler.compile("kernels/dithered.comp", KERNEL, &macros).unwrap();
    let statistics = asked.statistics(Division::Device, &module, ENTRY_POINT).unwrap();
    unitvec_lab::isa::row(&row_id(codec, key), operation, Source::Glsl, None, &statistics, asked.device())
}

/// Each function is compiled again, and its cost matches the record.
#[test]
fn dithered_functions_cost_what_is_recorded() {
    apart::assert_as_recorded(FILE, COMPILE, rdna2().gpu);
}

/// Compiles all again.
#[test]
#[ignore = "`cargo xtask renew costs` runs it"]
fn renew() {
    apart::renew(FILE, COMPILE, rdna2().gpu);
}
