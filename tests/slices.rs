//! The slice functions are the scalar ones, bit for bit: for every codec of the list, every instruction set of this
//! machine, every length up to a block and more, and whatever lies in each lane; also snorm with a fourth component and
//! tables. All cores are tested with one codec of each size of codes; `vectors.rs` has slices of other vectors.

use glam::Vec3;
use std::marker::PhantomData;
use unitvec::arith::snorm_encode;
use unitvec::codec::RawCode;
use unitvec::slice::machine::Level;
use unitvec::slice::{
    LengthMismatch, decode_slice, decode_slice_at, decode_slice_i16x4, decode_slice_i16x4_at, encode_slice,
    encode_slice_at, par_decode_slice, par_encode_slice,
};
use unitvec::table::DecodeTable;
use unitvec::{Codec, Listed, Oct16, Oct24, Oct48, OctPrecise32, OctPrecise52, OrNull, for_each_codec};
use unitvec_catalogue::{self as catalogue, AnyCodec, CODECS};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::directions::{Rng, sphere};

/// Up to a block of the slice functions and more than a group of the next.
const LENGTHS: std::ops::RangeInclusive<usize> = 0..=85;

/// Directions, and among them vectors without a direction and some that are hard to round.
fn vectors(count: usize) -> Vec<[f32; 3]> {
    let special = special_vectors();
    let mut rng = Rng::new(7);
    sphere(8, count)
        .map(|v| match rng.bits() % 4 {
            0 => special[rng.bits() as usize % special.len()],
            1 => std::array::from_fn(|_| f32::from_bits(rng.bits() as u32)),
            _ => v.to_array(),
        })
        .collect()
}

/// Any bytes.
fn bytes(count: usize) -> Vec<u8> {
    let mut rng = Rng::new(9);
    (0..count).map(|_| rng.bits() as u8).collect()
}

/// The code's bytes, by the scalar function.
fn encode_scalar<const N: usize>(codec: &AnyCodec, element: [f32; N]) -> Vec<u8> {
    let [low, high] = codec.encode_one(element);
    [low.to_le_bytes(), high.to_le_bytes()].concat()[..codec.bytes].to_vec()
}

/// A code's bytes as two words.
fn words(code: &[u8]) -> [u32; 2] {
    let mut bytes = [0; 8];
    bytes[..code.len()].copy_from_slice(code);
    [0, 4].map(|i| u32::from_le_bytes(std::array::from_fn(|j| bytes[i + j])))
}

fn bits<const N: usize>(elements: &[[f32; N]]) -> Vec<[u32; N]> {
    elements.iter().map(|v| v.map(f32::to_bits)).collect()
}

/// Every instruction set of this machine, with ordinary and with streaming stores.
fn levels() -> impl Iterator<Item = Level> {
    Level::available().flat_map(|level| [level, level.for_output(usize::MAX)])
}

/// Slices of these lengths, at every level and in all places of a cache line, hold the scalar functions' results.
fn check_levels<const N: usize>(
    codec: &AnyCodec,
    lengths: impl Iterator<Item = usize>,
    elements: &[[f32; N]],
    bytes: &[u8],
) {
    let codes: Vec<u8> = elements.iter().flat_map(|&v| encode_scalar(codec, v)).collect();
    let decoded: Vec<[f32; N]> =
        bytes.chunks_exact(codec.bytes).map(|code| codec.decode_one(words(code))).collect();
    for count in lengths {
        let (size, start) = (count * codec.bytes, count % 16);
        for level in levels() {
            let mut actual = vec![0xA5; start + size];
            codec.encode_at(level, elements[..count].as_flattened(), &mut actual[start..]).unwrap();
            assert_eq!(
                actual,
                [&[0xA5; 16][..start], &codes[..size]].concat(),
                "{} {level:?} {count}",
                codec.id
            );

            let mut actual = vec![[f32::NAN; N]; start + count];
            codec.decode_at(level, &bytes[..size], actual[start..].as_flattened_mut()).unwrap();
            assert_eq!(bits(&actual[start..]), bits(&decoded[..count]), "{} {level:?} {count}", codec.id);
        }
    }
}

/// Every codec at every length.
#[test]
fn every_codec_at_every_length() {
    let (vectors, bytes) = (vectors(*LENGTHS.end()), bytes(8 * LENGTHS.end()));
    for codec in catalogue::vectors() {
        check_levels(codec, LENGTHS, &vectors, &bytes);
    }
}

/// Every special input: all combinations of zeros, denormals, infinities, NaN, huge and tiny numbers.
#[test]
fn every_special_input() {
    let vectors = special_vectors();
    let bytes = bytes(8 * vectors.len());
    for codec in catalogue::vectors() {
        check_levels(codec, std::iter::once(vectors.len()), &vectors, &bytes);
    }
}

/// Frames of every length, of two vectors and a number between them.
#[test]
fn frames_at_every_length() {
    let vectors = vectors(3 * LENGTHS.end());
    let frames: Vec<[f32; 7]> = vectors
        .chunks_exact(3)
        .map(|v| [v[0][0], v[0][1], v[0][2], v[1][0], v[1][1], v[1][2], v[2][0]])
        .collect();
    let bytes = bytes(8 * LENGTHS.end());
    for codec in catalogue::frames() {
        check_levels(codec, LENGTHS, &frames, &bytes);
    }
}

/// Rotations of every length, of a vector and a number of another.
#[test]
fn rotations_at_every_length() {
    let vectors = vectors(2 * LENGTHS.end());
    let rotations: Vec<[f32; 4]> =
        vectors.chunks_exact(2).map(|v| [v[0][0], v[0][1], v[0][2], v[1][0]]).collect();
    let bytes = bytes(8 * LENGTHS.end());
    for codec in catalogue::rotations() {
        check_levels(codec, LENGTHS, &rotations, &bytes);
    }
}

/// An output that is one element short or long is an error and stays as it was, and so are bytes that are no whole number
/// of codes.
fn check_wrong_lengths(codec: &AnyCodec, count: usize) {
    let (id, size, floats) = (codec.id, codec.bytes, codec.element.floats());
    let elements = vec![1.0; floats * count];
    for bytes in [Some(count * size + 1), (count * size).checked_sub(1)].into_iter().flatten() {
        let mut codes = vec![0xA5; bytes];
        let mut decoded = vec![7.0; floats * count];
        assert!(codec.encode_cpu(&elements, &mut codes).is_err(), "{id}");
        assert!(codec.decode_cpu(&codes, &mut decoded).is_err(), "{id}");
        for level in Level::available() {
            assert!(codec.encode_at(level, &elements, &mut codes).is_err(), "{id} {level:?}");
            assert!(codec.decode_at(level, &codes, &mut decoded).is_err(), "{id} {level:?}");
        }
        assert!(codes.iter().all(|&byte| byte == 0xA5), "{id}");
        assert!(decoded.iter().all(|&v| v == 7.0), "{id}");
    }
    let codes = vec![0; count * size];
    for other in [Some(count + 1), count.checked_sub(1)].into_iter().flatten() {
        let mut decoded = vec![7.0; floats * other];
        assert!(codec.decode_cpu(&codes, &mut decoded).is_err(), "{id}");
        for level in Level::available() {
            assert!(codec.decode_at(level, &codes, &mut decoded).is_err(), "{id} {level:?}");
        }
        assert!(decoded.iter().all(|&v| v == 7.0), "{id}");
    }
}

/// Slices that do not fit each other are refused, by every function and at every length.
#[test]
fn slices_of_wrong_lengths_are_left_alone() {
    for count in LENGTHS {
        CODECS.iter().for_each(|codec| check_wrong_lengths(codec, count));
    }
}

/// [`Codec::decode`] of a code's bytes.
fn decode_generic<C: Codec>(code: &[u8]) -> [f32; 3] {
    C::decode(C::Code::from_words(words(code)))
}

/// Every level's form of snorm with a fourth component, at every length.
fn check_i16x4<C: Listed>(bytes: &[u8]) {
    let decoded = bytes.chunks_exact(C::BYTES).map(decode_generic::<C>);
    let expected: Vec<[i16; 4]> =
        decoded.map(|[x, y, z]| [x, y, z, 0.0].map(|t| snorm_encode(t, 16) as i16)).collect();
    for count in LENGTHS {
        for level in levels() {
            let mut actual = vec![[1; 4]; count];
            decode_slice_i16x4_at::<C>(level, &bytes[..count * C::BYTES], &mut actual).unwrap();
            assert_eq!(actual, expected[..count], "{} {level:?} {count}", C::NAME);
        }
    }
}

/// Snorm with a fourth component, of every codec.
#[test]
fn i16x4_at_every_length() {
    let bytes = bytes(8 * LENGTHS.end());
    macro_rules! check_all {
        ($([$id:ident $codec:ident $($rest:tt)*])*) => { $(check_i16x4::<unitvec::$codec>(&bytes);)* };
    }
    for_each_codec!(check_all);
}

/// [`encode_slice`] with streaming stores.
fn stream_codes<C: Codec>(vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
    encode_slice_at::<C>(Level::best().for_output(usize::MAX), vectors, codes)
}

/// [`decode_slice`] with streaming stores.
fn stream_vectors<C: Codec>(codes: &[u8], vectors: &mut [[f32; 3]]) -> Result<(), LengthMismatch> {
    decode_slice_at::<C>(Level::best().for_output(usize::MAX), codes, vectors)
}

/// All cores, over several portions and a rest, and a slice so large that memory is asked for ahead.
fn check_parallel<C: Listed>(vectors: &[[f32; 3]]) {
    let code = |v: &[f32; 3]| C::encode(*v).to_words();
    let bytes = |[low, high]: [u32; 2]| [low.to_le_bytes(), high.to_le_bytes()].concat();
    let expected: Vec<u8> = vectors.iter().flat_map(|v| bytes(code(v)).into_iter().take(C::BYTES)).collect();
    for encode in [encode_slice::<C>, par_encode_slice::<C>, stream_codes::<C>] {
        let mut codes = vec![0xA5; expected.len()];
        encode(vectors, &mut codes).unwrap();
        assert!(codes == expected, "{}", C::NAME);
        assert!(encode(&vectors[1..], &mut codes).is_err(), "{}", C::NAME);
    }
    let decoded: Vec<[f32; 3]> = expected.chunks_exact(C::BYTES).map(decode_generic::<C>).collect();
    for decode in [decode_slice::<C>, par_decode_slice::<C>, stream_vectors::<C>] {
        let mut actual = vec![[f32::NAN; 3]; vectors.len()];
        decode(&expected, &mut actual).unwrap();
        assert!(bits(&actual) == bits(&decoded), "{}", C::NAME);
        assert!(decode(&expected[1..], &mut actual).is_err(), "{}", C::NAME);
    }
}

/// Large slices, on one core and on all.
#[test]
fn large_and_parallel_slices() {
    let vectors = vectors(100_003);
    check_parallel::<Oct16>(&vectors);
    check_parallel::<Oct24>(&vectors);
    check_parallel::<OctPrecise32>(&vectors);
    check_parallel::<Oct48>(&vectors);
    check_parallel::<OctPrecise52>(&vectors);
}

/// A decode table gives the scalar function's results, for every code and for bits above the codec's.
fn check_table<C: Codec>(id: &str) {
    let entries = DecodeTable::<C>::ENTRIES;
    let mut memory = vec![[f32::NAN; 3]; entries + 1];
    let error = DecodeTable::<C>::fill(&mut memory).err().unwrap();
    assert_eq!([error.expected, error.actual], [entries, entries + 1]);
    let table = DecodeTable::<C>::fill(&mut memory[..entries]).unwrap();

    let bytes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    let decoded: Vec<[f32; 3]> = bytes.chunks_exact(C::BYTES).map(decode_generic::<C>).collect();
    let mut actual = vec![[f32::NAN; 3]; decoded.len()];
    table.decode_slice(&bytes, &mut actual).unwrap();
    assert!(bits(&actual) == bits(&decoded), "{id}");
    for count in LENGTHS {
        let mut actual = vec![[f32::NAN; 3]; count];
        table.decode_slice(&bytes[..C::BYTES * count], &mut actual).unwrap();
        assert_eq!(bits(&actual), bits(&decoded[..count]), "{id}");
        assert!(table.decode_slice(&bytes[..C::BYTES * count + 1], &mut actual).is_err());
    }
    let code = C::Code::from_words([0x1234, 0]);
    assert_eq!(bits(&[table.decode(code)]), bits(&[C::decode(code)]), "{id}");
}

/// A codec of at most 16 bits as it is; of one with more, which has no table, the low 16. The compiler refuses a table of
/// more bits even where it is never made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
struct AtMost16<C>(PhantomData<C>);

impl<C: Codec> Codec for AtMost16<C> {
    const BITS: u32 = if C::BITS < 16 { C::BITS } else { 16 };
    const MAX_ERROR_DEG: f32 = C::MAX_ERROR_DEG;
    type Code = C::Code;

    fn encode_vec3(v: Vec3) -> C::Code {
        C::encode_vec3(v)
    }

    fn decode_vec3(code: C::Code) -> Vec3 {
        C::decode_vec3(C::Code::from_words([code.to_words()[0] & 0xffff, 0]))
    }
}

/// Tables of all codecs of at most 16 bits.
#[test]
fn tables_are_the_scalar_functions() {
    let mut count = 0;
    macro_rules! check_all {
        ($([$id:ident $codec:ident $($rest:tt)*])*) => {
            $(if unitvec::$codec::BITS <= 16 {
                check_table::<AtMost16<unitvec::$codec>>(stringify!($id));
                count += 1;
            })*
        };
    }
    for_each_codec!(check_all);
    assert_eq!(count, catalogue::vectors().iter().filter(|codec| codec.bits <= 16).count());
}

/// The i16 x 4 form refuses slices of different lengths and leaves them alone.
#[test]
fn i16x4_of_a_wrong_length() {
    let mut vectors = [[7; 4]; 3];
    assert!(decode_slice_i16x4::<unitvec::Oct32>(&[0; 11], &mut vectors).is_err());
    assert!(decode_slice_i16x4::<unitvec::Oct32>(&[0; 16], &mut vectors).is_err());
    assert_eq!(vectors, [[7; 4]; 3]);
    decode_slice_i16x4::<unitvec::Oct32>(&[0; 12], &mut vectors).unwrap();
    assert_eq!(vectors, [[0, 0, 32767, 0]; 3]);
}

/// With null codes, slices have the catalogue's codes and vectors.
fn check_nulls<C: Listed>() {
    let codec = catalogue::find(C::NAME).unwrap();
    let (null, vectors) = (codec.null().unwrap(), vectors(1000));
    let (mut codes, mut expected) = (bytes(1000 * C::BYTES), bytes(1000 * C::BYTES));
    encode_slice::<OrNull<C>>(&vectors, &mut codes).unwrap();
    codec.encode_here(vectors.as_flattened(), &mut expected).unwrap();
    null.put(vectors.as_flattened(), &mut expected).unwrap();
    assert_eq!(codes, expected, "{}", C::NAME);
    let (mut decoded, mut expected) = ([[1.0; 3]; 1000], [[1.0; 3]; 1000]);
    decode_slice::<OrNull<C>>(&codes, &mut decoded).unwrap();
    codec.decode_here(&codes, expected.as_flattened_mut()).unwrap();
    null.clear(&codes, expected.as_flattened_mut()).unwrap();
    assert_eq!(bits(&decoded), bits(&expected), "{}", C::NAME);
}

#[test]
fn null_codes_in_slices() {
    check_nulls::<Oct24>();
    check_nulls::<OctPrecise52>();
    check_nulls::<unitvec::SOct17>();
    check_nulls::<unitvec::Snorm16x3>();
}
