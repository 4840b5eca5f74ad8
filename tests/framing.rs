//! SPIR-V is checked before a driver sees it.

use unitvec_manifest::modules::Modules;
use unitvec_vulkan::{Error, check_spirv};

fn module(kernel: &str) -> Vec<u8> {
    Modules::open(None).unwrap().load(kernel).unwrap().into()
}

fn objection(spirv: &[u8], entry_point: &str) -> Option<String> {
    check_spirv(spirv, entry_point).err().map(|error| match error {
        Error::NotSpirv { reason, .. } => reason,
        other => panic!("{other}"),
    })
}

/// Whole modules pass; cut at any word they do not.
#[test]
fn a_cut_at_any_word_is_found() {
    for kernel in ["oct16_encode", "oct16_decode", "snorm8x3p_encode"] {
        let module = module(kernel);
        assert_eq!(objection(&module, kernel), None);
        for length in (0..module.len()).step_by(4) {
            assert!(objection(&module[..length], kernel).is_some(), "{kernel} cut at byte {length}");
        }
    }
}

/// Versions of SPIR-V 1, a bound that drivers take, and nothing in the reserved word.
#[test]
fn headers_are_checked() {
    let whole = module("oct16_decode");
    for (word, bad) in
        [(1, 0), (1, 0x0002_0000), (1, 0x0001_0301), (3, 0), (3, u32::MAX), (3, 1 << 22), (4, 1u32)]
    {
        let mut module = whole.clone();
        module[4 * word..][..4].copy_from_slice(&bad.to_le_bytes());
        let objection = objection(&module, "oct16_decode");
        assert_eq!(objection.as_deref(), Some("its header is none of SPIR-V 1"), "{word}: {bad}");
    }
}

/// A reader would never pass an instruction of no words.
#[test]
fn an_instruction_of_no_words_is_found() {
    let mut module = module("oct16_decode");
    module[22..24].fill(0);
    assert_eq!(objection(&module, "oct16_decode").as_deref(), Some("it is cut short"));
}

#[test]
fn another_entry_point_is_found() {
    let module = module("oct16_decode");
    for name in ["oct32_decode", "oct16_decod", "oct16_decode2", ""] {
        assert_eq!(objection(&module, name).as_deref(), Some("it has no such entry point"), "{name:?}");
    }
}
