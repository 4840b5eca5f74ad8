//! Checks of SPIR-V before a driver sees it.

use super::Error;
use std::ffi::CString;

const HEADER_WORDS: usize = 5;
/// The largest bound that all implementations have to take; drivers allocate this much and more.
const MAX_BOUND: u32 = 0x003f_ffff;
const OP_ENTRY_POINT: u16 = 15;
const OP_FUNCTION: u16 = 54;
const OP_FUNCTION_END: u16 = 56;
const OP_FUNCTION_CALL: u16 = 57;

/// Checks the framing of a module, as is done before a driver sees it.
///
/// # Errors
/// [`Error::NotSpirv`].
pub fn check_spirv(spirv: &[u8], entry_point: &str) -> Result<(), Error> {
    checked(spirv, entry_point).map(drop)
}

/// The words of a module, and the name of its entry point for Vulkan.
///
/// # Errors
/// [`Error::NotSpirv`].
pub(super) fn checked(spirv: &[u8], entry_point: &str) -> Result<(Vec<u32>, CString), Error> {
    let not_spirv =
        |reason: &str| Error::NotSpirv { entry_point: entry_point.to_owned(), reason: reason.to_owned() };
    let words = ash::util::read_spv(&mut std::io::Cursor::new(spirv))
        .map_err(|error| not_spirv(&error.to_string()))?;
    if let Some(reason) = objection(&words, entry_point) {
        return Err(not_spirv(reason));
    }
    let name = CString::new(entry_point).map_err(|_| not_spirv("the entry point's name contains a NUL"))?;
    Ok((words, name))
}

/// The reason why these words cannot be a whole module with this entry point; `None` if nothing speaks against it.
///
/// This is no validation of the instructions. It finds a module cut short at any word, and an entry point that is not
/// there: drivers need not notice either, and one may crash.
fn objection(words: &[u32], entry_point: &str) -> Option<&'static str> {
    const CUT_SHORT: Option<&str> = Some("it is cut short");
    match words {
        [_, version, _, bound, schema, ..]
            if version & 0xff00_00ff == 0
                && version >> 16 == 1
                && (1..=MAX_BOUND).contains(bound)
                && *schema == 0 => {}
        [_, _, _, _, _, ..] => return Some("its header is none of SPIR-V 1"),
        _ => return CUT_SHORT,
    }
    let mut is_there = false;
    let mut defined = Vec::new();
    let mut called = Vec::new();
    let mut last_opcode = None;
    let mut rest = words.get(HEADER_WORDS..).unwrap_or_default();
    while let Some(first) = rest.first() {
        let (length, opcode) = ((first >> 16) as usize, *first as u16);
        let Some(operands) = rest.get(1..length) else { return CUT_SHORT };
        match (opcode, operands) {
            (OP_ENTRY_POINT, [_, function, name @ ..]) => {
                is_there |= is_literal(name, entry_point);
                called.push(*function);
            }
            (OP_FUNCTION, [_, function, ..]) => defined.push(*function),
            (OP_FUNCTION_CALL, [_, _, function, ..]) => called.push(*function),
            _ => {}
        }
        last_opcode = Some(opcode);
        rest = &rest[length..];
    }
    if !is_there {
        return Some("it has no such entry point");
    }
    let is_whole =
        last_opcode == Some(OP_FUNCTION_END) && called.iter().all(|function| defined.contains(function));
    if is_whole { None } else { CUT_SHORT }
}

/// True if a literal string that ends in NUL begins at these words and is this text.
fn is_literal(words: &[u32], text: &str) -> bool {
    let mut bytes = words.iter().flat_map(|word| word.to_le_bytes());
    text.bytes().chain([0]).all(|byte| bytes.next() == Some(byte))
}
