//! Prints a line for each codec and each way of running it: the way, the codec's row of `vectors/digests.csv` as this
//! processor computes it, and digests of more input. Ways are `values`, the functions of single vectors, and the levels
//! of the slice functions that this processor has. An argument gives the number of vectors and codes, instead of the
//! number in the released digests.

use unitvec::codec::RawCode;
use unitvec::slice::machine::Level;
use unitvec::slice::{
    decode_frames_at, decode_rotations_at, decode_slice_at, encode_frames_at, encode_rotations_at,
    encode_slice_at,
};
use unitvec::{
    Frame, Listed, ListedFrame, ListedRotation, for_each_codec, for_each_frame, for_each_rotation,
};
use unitvec_processors::{COUNT, Coder, Decode, Encode, special_frames, special_rotations, special_vectors};

fn main() {
    let (vectors, frames) = (special_vectors(), special_frames());
    macro_rules! vectors {
        ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => {
            $(report_codec::<unitvec::$codec>(count(&[$(stringify!($by))?]), &vectors);)*
        };
    }
    for_each_codec!(vectors);
    macro_rules! frames {
        ($([$id:ident $codec:ident, $($rest:tt)*])*) => { $(report_frames::<unitvec::$codec>(&frames);)* };
    }
    for_each_frame!(frames);
    let rotations = special_rotations();
    macro_rules! rotations {
        ($([$id:ident $codec:ident = $($rest:tt)*])*) => { $(report_rotations::<unitvec::$codec>(&rotations);)* };
    }
    for_each_rotation!(rotations);
}

/// The number of vectors and codes that the argument asks for. If not all, a sixteenth of that for codecs that are made
/// to encode by a table: without it, as here, two of them would take an emulator as long as all others.
fn count(table: &[&str]) -> usize {
    let argument = std::env::args().nth(1).and_then(|count| count.parse().ok());
    match argument.unwrap_or(COUNT).clamp(1, COUNT) {
        COUNT => COUNT,
        some if table.is_empty() => some,
        some => some.div_ceil(16),
    }
}

fn report_codec<C: Listed>(count: usize, special: &[[f32; 3]]) {
    let encode =
        |vectors: &[_], codes: &mut [_]| store(vectors, codes, C::BYTES, |v| C::encode(v).to_words());
    let decode = |codes: &[_], vectors: &mut [_]| {
        load(codes, vectors, C::BYTES, |words| C::decode(C::Code::from_words(words)));
    };
    let coder = (C::NAME, C::BITS, C::BYTES);
    report("values", coder, &encode, &decode, count, special);
    for level in Level::available() {
        let encode =
            |vectors: &[_], codes: &mut [_]| encode_slice_at::<C>(level, vectors, codes).expect(SAME);
        let decode =
            |codes: &[_], vectors: &mut [_]| decode_slice_at::<C>(level, codes, vectors).expect(SAME);
        report(&format!("{level:?}"), coder, &encode, &decode, count, special);
    }
}

fn report_frames<F: ListedFrame>(special: &[[f32; 7]]) {
    let encode = |frames: &[_], codes: &mut [_]| {
        store(frames, codes, F::BYTES, |frame| F::encode(Frame::from_array(frame)).to_words());
    };
    let decode = |codes: &[_], frames: &mut [_]| {
        load(codes, frames, F::BYTES, |words| F::decode(F::Code::from_words(words)).to_array());
    };
    let (coder, count) = ((F::NAME, F::BITS, F::BYTES), count(&[]));
    report("values", coder, &encode, &decode, count, special);
    for level in Level::available() {
        let encode = |frames: &[_], codes: &mut [_]| encode_frames_at::<F>(level, frames, codes).expect(SAME);
        let decode = |codes: &[_], frames: &mut [_]| decode_frames_at::<F>(level, codes, frames).expect(SAME);
        report(&format!("{level:?}"), coder, &encode, &decode, count, special);
    }
}

fn report_rotations<C: ListedRotation>(special: &[[f32; 4]]) {
    let encode =
        |rotations: &[_], codes: &mut [_]| store(rotations, codes, C::BYTES, |q| C::encode(q).to_words());
    let decode = |codes: &[_], rotations: &mut [_]| {
        load(codes, rotations, C::BYTES, |words| C::decode(C::Code::from_words(words)));
    };
    let (coder, count) = ((C::NAME, C::BITS, C::BYTES), count(&[]));
    report("values", coder, &encode, &decode, count, special);
    for level in Level::available() {
        let encode =
            |rotations: &[_], codes: &mut [_]| encode_rotations_at::<C>(level, rotations, codes).expect(SAME);
        let decode =
            |codes: &[_], rotations: &mut [_]| decode_rotations_at::<C>(level, codes, rotations).expect(SAME);
        report(&format!("{level:?}"), coder, &encode, &decode, count, special);
    }
}

const SAME: &str = "slices of the same number";

/// Prints a line: a way of running a codec of this name, bits and bytes, and the digests.
fn report<const N: usize>(
    way: &str,
    (id, bits, bytes): (&str, u32, usize),
    encode: Encode<N>,
    decode: Decode<N>,
    count: usize,
    special: &[[f32; N]],
) {
    let coder = Coder { id, bits, bytes, encode, decode };
    print(&format!("{way},{},{}\n", coder.released(count), coder.more(count, special)));
}

/// Codes as they are stored, one by one: the low bytes of both words.
fn store<E: Copy>(elements: &[E], codes: &mut [u8], size: usize, encode: impl Fn(E) -> [u32; 2]) {
    for (element, code) in elements.iter().zip(codes.chunks_exact_mut(size)) {
        let [low, high] = encode(*element);
        let word = u64::from(high) << 32 | u64::from(low);
        code.copy_from_slice(&word.to_le_bytes()[..size]);
    }
}

/// The reverse of [`store`].
fn load<E>(codes: &[u8], elements: &mut [E], size: usize, decode: impl Fn([u32; 2]) -> E) {
    for (code, element) in codes.chunks_exact(size).zip(elements) {
        let word = code.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte));
        *element = decode([word as u32, (word >> 32) as u32]);
    }
}

/// Prints, on WebAssembly through a function of the program that runs this.
fn print(text: &str) {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    text.bytes().for_each(|byte| put(u32::from(byte)));
    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    print!("{text}");
}

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
#[link(wasm_import_module = "host")]
unsafe extern "C" {
    safe fn put(byte: u32);
}
