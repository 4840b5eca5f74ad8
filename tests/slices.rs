//! The slice functions are the scalar ones, bit for bit: for every codec, every instruction set of this machine, every
//! length up to a block and more, and whatever lies in each lane.

use glam::Vec3;
use unitvec::Codec;
use unitvec::codec::Code;
use unitvec::scalar::snorm_encode;
use unitvec::slice::machine::Level;
use unitvec::slice::{
    decode_slice, decode_slice_at, decode_slice_i16x4, decode_slice_i16x4_at, encode_slice, encode_slice_at,
    par_decode_slice, par_encode_slice,
};
use unitvec::table::{DecodeTable, TableSize};
use unitvec_tests::sampling::{Rng, special_inputs, sphere};

/// Calls `check::<codec>(arguments)` for every codec.
macro_rules! for_every_codec {
    ($check:ident($($argument:expr),*)) => {
        for_every_codec!($check($($argument),*): Oct16 Oct20 Oct22 Oct24 Oct32
            OctPrecise16 OctPrecise20 OctPrecise22 OctPrecise24 OctPrecise32 HemiOct16 HemiOct24 HemiOct32
            Oct48 OctPrecise48 OctPrecise52
            Spherical16 Spherical20 Spherical22 Spherical24 Spherical32 Cylindrical16 Cylindrical24 Cylindrical32
            LatLong16 LatLong24 LatLong32 LatLongD16 LatLongD24 LatLongD32
            Stereo16 Stereo24 Stereo32 StereoConcentric16 StereoConcentric24 StereoConcentric32
            StereoEllipse16 StereoEllipse24 StereoEllipse32 Eqarea16 Eqarea24 Eqarea32
            EqareaConcentric16 EqareaConcentric24 EqareaConcentric32 EqareaEllipse16 EqareaEllipse24
            EqareaEllipse32 Eqdist16 Eqdist24 Eqdist32 EqdistConcentric16 EqdistConcentric24 EqdistConcentric32
            EqdistEllipse16 EqdistEllipse20 EqdistEllipse22 EqdistEllipse24 EqdistEllipse32
            Cube16 Cube24 Cube32 WarpedCube16 WarpedCube24 WarpedCube32
            Pp16 Pp24 Pp32 Pp48 Spp16 Spp24 Spp32 Spp48 XyOnly16 XyOnly24 XyOnly32 XyOnly32F
            Snorm5x3 Snorm8x3 Snorm10x3 Snorm11x11x10 Snorm16x3 SnormBest8 SnormNearest8 SnormBest16 CrytekBfn24
            Unorm8x3 Float16x3);
    };
    ($check:ident $arguments:tt: $($codec:ident)*) => {
        $($check::<unitvec::$codec> $arguments;)*
    };
}

/// Longer than a block of the slice functions and a group of the next.
const LENGTHS: std::ops::RangeInclusive<usize> = 0..=85;

/// Directions, and among them what has none or is hard to round.
fn vectors(count: usize) -> Vec<[f32; 3]> {
    let special = special_inputs();
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
fn encode_scalar<C: Codec>(v: Vec3) -> Vec<u8> {
    let [low, high] = C::encode(v).to_words();
    [low.to_le_bytes(), high.to_le_bytes()].concat()[..C::BYTES].to_vec()
}

/// The vector of a code's bytes, by the scalar function.
fn decode_scalar<C: Codec>(code: &[u8]) -> [f32; 3] {
    let mut bytes = [0; 8];
    bytes[..C::BYTES].copy_from_slice(code);
    let [low, high] = [0, 4].map(|i| u32::from_le_bytes(std::array::from_fn(|j| bytes[i + j])));
    C::decode(C::Code::from_words([low, high])).to_array()
}

fn bits(vectors: &[[f32; 3]]) -> Vec<[u32; 3]> {
    vectors.iter().map(|v| v.map(f32::to_bits)).collect()
}

fn check_levels<C: Codec>(lengths: impl Iterator<Item = usize>, vectors: &[[f32; 3]], bytes: &[u8]) {
    let codes: Vec<u8> = vectors.iter().flat_map(|&v| encode_scalar::<C>(Vec3::from_array(v))).collect();
    let decoded: Vec<[f32; 3]> = bytes.chunks_exact(C::BYTES).map(decode_scalar::<C>).collect();
    let snorms: Vec<[i16; 4]> =
        decoded.iter().map(|v| [v[0], v[1], v[2], 0.0].map(|t| snorm_encode(t, 16) as i16)).collect();
    for count in lengths {
        let size = count * C::BYTES;
        for level in Level::available() {
            let mut actual = vec![0xA5; size];
            encode_slice_at::<C>(level, &vectors[..count], &mut actual).unwrap();
            assert_eq!(actual, codes[..size], "{} {level:?} {count}", C::NAME);

            let mut actual = vec![[f32::NAN; 3]; count];
            decode_slice_at::<C>(level, &bytes[..size], &mut actual).unwrap();
            assert_eq!(bits(&actual), bits(&decoded[..count]), "{} {level:?} {count}", C::NAME);

            let mut actual = vec![[1; 4]; count];
            decode_slice_i16x4_at::<C>(level, &bytes[..size], &mut actual).unwrap();
            assert_eq!(actual, snorms[..count], "{} {level:?} {count}", C::NAME);
        }
    }
}

/// Every codec at every length.
#[test]
fn every_codec_at_every_length() {
    let (vectors, bytes) = (vectors(*LENGTHS.end()), bytes(8 * LENGTHS.end()));
    for_every_codec!(check_levels(LENGTHS, &vectors, &bytes));
}

/// Every special input: all combinations of zeros, denormals, infinities, NaN, huge and tiny numbers.
#[test]
fn every_special_input() {
    let vectors = special_inputs();
    let bytes = bytes(8 * vectors.len());
    for_every_codec!(check_levels(std::iter::once(vectors.len()), &vectors, &bytes));
}

/// Slices of `Vec3` are slices of `[f32; 3]`, and the level chosen by itself gives the same bits.
fn check_vec3<C: Codec>(arrays: &[[f32; 3]]) {
    let vectors: Vec<Vec3> = arrays.iter().copied().map(Vec3::from_array).collect();
    let mut expected = vec![0; arrays.len() * C::BYTES];
    let mut codes = expected.clone();
    encode_slice::<C>(arrays, &mut expected).unwrap();
    encode_slice::<C>(&vectors, &mut codes).unwrap();
    assert_eq!(codes, expected, "{}", C::NAME);

    let mut expected = arrays.to_vec();
    let mut decoded = vectors;
    decode_slice::<C>(&codes, &mut expected).unwrap();
    decode_slice::<C>(&codes, &mut decoded).unwrap();
    let decoded: Vec<[f32; 3]> = decoded.iter().map(Vec3::to_array).collect();
    assert_eq!(bits(&decoded), bits(&expected), "{}", C::NAME);
}

/// `Vec3` as well as `[f32; 3]`, for each size of codes.
#[test]
fn slices_of_vec3() {
    let vectors = vectors(1000);
    for_every_codec!(check_vec3(&vectors): Oct16 Oct24 OctPrecise32 Oct48 OctPrecise52);
}

/// All cores, over several portions and a rest, and a slice so large that memory is asked for ahead.
fn check_parallel<C: Codec>(vectors: &[[f32; 3]]) {
    let expected: Vec<u8> = vectors.iter().flat_map(|&v| encode_scalar::<C>(Vec3::from_array(v))).collect();
    for encode in [encode_slice::<C>, par_encode_slice::<C>] {
        let mut codes = vec![0xA5; expected.len()];
        encode(vectors, &mut codes).unwrap();
        assert!(codes == expected, "{}", C::NAME);
        assert!(encode(&vectors[1..], &mut codes).is_err(), "{}", C::NAME);
    }
    let decoded: Vec<[f32; 3]> = expected.chunks_exact(C::BYTES).map(decode_scalar::<C>).collect();
    for decode in [decode_slice::<C>, par_decode_slice::<C>] {
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
    for_every_codec!(check_parallel(&vectors): Oct16 Oct24 OctPrecise32 Oct48 OctPrecise52);
}

/// A decode table gives what the scalar function gives, for every code and for bits above the codec's.
fn check_table<C: Codec>() {
    let entries = DecodeTable::<C>::ENTRIES;
    let mut memory = vec![[f32::NAN; 3]; entries + 1];
    let expected = Some(TableSize { expected: entries, actual: entries + 1 });
    assert_eq!(DecodeTable::<C>::fill(&mut memory).err(), expected);
    let table = DecodeTable::<C>::fill(&mut memory[..entries]).unwrap();

    let bytes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    let decoded: Vec<[f32; 3]> = bytes.chunks_exact(2).map(decode_scalar::<C>).collect();
    let mut actual = vec![[f32::NAN; 3]; decoded.len()];
    table.decode_slice(&bytes, &mut actual).unwrap();
    assert!(bits(&actual) == bits(&decoded), "{}", C::NAME);
    for count in LENGTHS {
        let mut actual = vec![[f32::NAN; 3]; count];
        table.decode_slice(&bytes[..2 * count], &mut actual).unwrap();
        assert_eq!(bits(&actual), bits(&decoded[..count]), "{}", C::NAME);
        assert!(table.decode_slice(&bytes[..2 * count + 1], &mut actual).is_err());
    }
    let single = table.decode(C::Code::from_words([0x1234, 0])).to_array();
    assert_eq!(bits(&[single]), bits(&[decoded[0x1234]]), "{}", C::NAME);
}

/// Tables of all codecs of at most 16 bits.
#[test]
fn tables_are_the_scalar_functions() {
    for_every_codec!(check_table(): Oct16 OctPrecise16 HemiOct16 Spherical16 Cylindrical16 LatLong16 LatLongD16 Stereo16
        StereoConcentric16 StereoEllipse16 Eqarea16 EqareaConcentric16 EqareaEllipse16 Eqdist16 EqdistConcentric16
        EqdistEllipse16 Cube16 WarpedCube16 Pp16 Spp16 XyOnly16 Snorm5x3);
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
