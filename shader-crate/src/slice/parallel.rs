//! Slices on all cores. A codec comes as a function pointer, so that rayon's machinery is compiled once for each type of
//! element and not for each codec: in a program with all codecs that was a third of the build. A format of other software
//! comes as a closure.

use super::LengthMismatch;
use super::machine::Level;
use rayon::prelude::*;

/// The least number of elements that one core takes at a time: some ten microseconds.
const PORTION: usize = 1 << 14;

/// Elements that one core takes at a time: of long slices enough for memory to be prefetched, unless cores would idle.
fn portion(elements: usize) -> usize {
    (elements / (8 * rayon::current_num_threads())).clamp(PORTION, 8 * PORTION)
}

/// Encodes portions of `elements` into codes of `size` bytes. The slices fit each other.
///
/// # Errors
/// The errors of `encode`.
pub fn par_encode_with<T: Sync>(
    elements: &[T],
    codes: &mut [u8],
    size: usize,
    encode: impl Fn(Level, &[T], &mut [u8]) -> Result<(), LengthMismatch> + Sync,
) -> Result<(), LengthMismatch> {
    let level = Level::best().for_output(codes.len());
    if elements.len() <= PORTION {
        return encode(level, elements, codes);
    }
    let portion = portion(elements.len());
    (elements.par_chunks(portion), codes.par_chunks_mut(portion * size))
        .into_par_iter()
        .try_for_each(|(elements, codes)| encode(level, elements, codes))
}

/// Decodes portions of codes of `size` bytes into `elements`. The slices fit each other.
///
/// # Errors
/// The errors of `decode`.
pub fn par_decode_with<T: Send>(
    codes: &[u8],
    elements: &mut [T],
    size: usize,
    decode: impl Fn(Level, &[u8], &mut [T]) -> Result<(), LengthMismatch> + Sync,
) -> Result<(), LengthMismatch> {
    let level = Level::best().for_output(size_of_val(elements));
    if elements.len() <= PORTION {
        return decode(level, codes, elements);
    }
    let portion = portion(elements.len());
    (codes.par_chunks(portion * size), elements.par_chunks_mut(portion))
        .into_par_iter()
        .try_for_each(|(codes, elements)| decode(level, codes, elements))
}
