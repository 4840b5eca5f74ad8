//! Vectors of any library, and among the other fields of vertices.

use bytemuck::{Pod, Zeroable};
use std::collections::HashSet;
use std::fmt::Debug;
use std::mem::{offset_of, size_of};
use unitvec::codec::RawCode;
use unitvec::slice::machine::Level;
use unitvec::slice::{
    Side, Stored, StrideError, Strided, Vector, decode_codes, decode_frames, decode_frames_strided,
    decode_slice, decode_slice_at, decode_strided, decode_strided_with, encode_codes, encode_frames,
    encode_frames_strided, encode_slice, encode_slice_at, encode_slice_with, encode_strided,
    encode_strided_with, par_decode_frames, par_encode_frames,
};
use unitvec::table::DecodeTable;
use unitvec::{
    Code, Codec, Frame, Frame32, Frame64, FrameCodec, HemiOct16, Oct8, Oct16, Oct24, Oct32, Oct48,
    OctPrecise16, OctPrecise48, OctPrecise52,
};
use unitvec_tests::directions::sphere;

/// Calls `$check::<codec>($arguments)` for a codec of each size of codes: 1, 2, 3, 4, 6 and 8 bytes.
macro_rules! for_each_size {
    ($check:ident($($argument:expr),*)) => {
        $check::<Oct8>($($argument),*);
        $check::<Oct16>($($argument),*);
        $check::<Oct24>($($argument),*);
        $check::<Oct32>($($argument),*);
        $check::<Oct48>($($argument),*);
        $check::<OctPrecise52>($($argument),*);
    };
}

fn arrays(count: usize) -> Vec<[f32; 3]> {
    sphere(12, count).map(|v| v.to_array()).collect()
}

/// Checks a codec's functions, with vectors of type `V` as with arrays.
fn check_codec<C: Codec, V: Vector>(arrays: &[[f32; 3]]) {
    let vectors: Vec<V> = arrays.iter().map(|&v| v.into()).collect();
    let codes: Vec<C::Code> = arrays.iter().map(|&v| C::encode(v)).collect();
    let decoded: Vec<[f32; 3]> = codes.iter().map(|&code| C::decode(code)).collect();
    assert_eq!(vectors.iter().map(|&v| C::encode(v)).collect::<Vec<_>>(), codes);
    assert_eq!(codes.iter().map(|&code| C::decode::<V>(code).into()).collect::<Vec<_>>(), decoded);

    let mut bytes = vec![0; arrays.len() * C::BYTES];
    let mut same = bytes.clone();
    encode_slice::<C>(arrays, &mut bytes).unwrap();
    encode_slice::<C>(&vectors, &mut same).unwrap();
    assert_eq!(same, bytes);
    same.fill(0);
    encode_slice_with::<C>(&vectors, &mut same, |v| C::encode(V::from(v))).unwrap();
    assert_eq!(same, bytes);
    let mut from_slice = vec![V::from([0.0; 3]); arrays.len()];
    decode_slice::<C>(&bytes, &mut from_slice).unwrap();
    assert_eq!(from_slice.into_iter().map(Into::into).collect::<Vec<_>>(), decoded);
}

/// Every function that takes or gives vectors, with those of type `V`.
fn check_library<V: Vector, V4: From<[f32; 4]> + Into<[f32; 4]>>() {
    let arrays = arrays(100);
    check_codec::<OctPrecise16, V>(&arrays);
    check_codec::<OctPrecise52, V>(&arrays);

    let mut memory = vec![[0.0; 3]; DecodeTable::<Oct8>::ENTRIES];
    let table = DecodeTable::<Oct8>::fill(&mut memory).unwrap();
    assert_eq!(table.decode::<V>(7).into(), Oct8::decode::<[f32; 3]>(7));

    let (normal, tangent) = ([0.0, 0.6, 0.8], [1.0, 0.0, 0.0]);
    let frame = Frame::new(V::from(normal), V::from(tangent), -1.0);
    assert_eq!(frame.to_array(), [0.0, 0.6, 0.8, 1.0, 0.0, 0.0, -1.0]);
    assert_eq!(Frame::from_gltf(V::from(normal), V4::from([1.0, 0.0, 0.0, -1.0])), frame);
    let (to_normal, to_tangent): (V, V4) = frame.to_gltf();
    assert_eq!((to_normal.into(), to_tangent.into()), (normal, [1.0, 0.0, 0.0, -1.0]));
    assert_eq!(Frame32::decode(Frame32::encode(frame)).handedness, -1.0);
}

/// The libraries, and versions of glam before, at and after the crate's own.
#[test]
fn vectors_of_any_library() {
    check_library::<[f32; 3], [f32; 4]>();
    check_library::<unitvec::glam::Vec3, unitvec::glam::Vec4>();
    check_library::<glam_029::Vec3, glam_029::Vec4>();
    check_library::<glam_029::Vec3A, glam_029::Vec4>();
    check_library::<glam_030::Vec3, glam_030::Vec4>();
    check_library::<glam_030::Vec3A, glam_030::Vec4>();
    check_library::<glam_032::Vec3, glam_032::Vec4>();
    check_library::<glam_032::Vec3A, glam_032::Vec4>();
    check_library::<glam_034::Vec3, glam_034::Vec4>();
    check_library::<glam_034::Vec3A, glam_034::Vec4>();
    check_library::<mint::Vector3<f32>, mint::Vector4<f32>>();
}

/// A type with all that code over any codec may rely on without stating it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Packed<C: Codec> {
    codec: C,
    code: C::Code,
}

/// The codes of some vectors, sent from another thread.
fn sent<T: RawCode>(encode: fn([f32; 3]) -> T) -> HashSet<T> {
    std::thread::spawn(move || arrays(50).into_iter().map(encode).collect()).join().unwrap()
}

fn check_generic<C: Codec>() {
    let codes = sent(C::encode);
    let packed: HashSet<_> = codes.iter().map(|&code| Packed { codec: C::default(), code }).collect();
    assert_eq!(packed.len(), codes.len());
    let first = *packed.iter().next().unwrap();
    assert_eq!(first, first.clone());
    assert!(format!("{first:?}").starts_with("Packed { codec: "), "{first:?}");
}

fn check_generic_frames<F: FrameCodec>() {
    let code =
        std::thread::spawn(|| F::encode(Frame::new([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 1.0))).join().unwrap();
    assert_eq!((F::default(), HashSet::from([code])), (F::default(), HashSet::from([F::Code::default()])));
}

/// Every codec of the list can be compared, hashed, printed, copied and sent to another thread, by code that knows no more
/// than that it is a codec.
#[test]
fn generic_code_over_codecs() {
    macro_rules! check_all {
        ($([$id:ident $codec:ident $($rest:tt)*])*) => { $(check_generic::<unitvec::$codec>();)* };
    }
    unitvec::for_each_codec!(check_all);
    check_generic_frames::<Frame32>();
    check_generic_frames::<Frame64>();
}

#[test]
fn codes_in_integers() {
    fn check<C: Codec, T: Stored + Debug + PartialEq>(zero: T, of: impl Fn(C::Code) -> T) {
        let mut vectors = arrays(600);
        let mut codes = vec![zero; vectors.len()];
        assert!(encode_codes::<C>(&vectors[1..], &mut codes).is_err());
        encode_codes::<C>(&vectors, &mut codes).unwrap();
        let expected: Vec<C::Code> = vectors.iter().map(|&v| C::encode(v)).collect();
        assert_eq!(codes, expected.iter().map(|&code| of(code)).collect::<Vec<T>>());
        decode_codes::<C>(&codes, &mut vectors).unwrap();
        assert!(vectors.iter().zip(&expected).all(|(&v, &code)| v == C::decode::<[f32; 3]>(code)));
    }
    check::<Oct8, _>(0u16, |code| code as u16);
    check::<Oct16, _>(0u16, |code| code as u16);
    check::<Oct24, _>(0u32, |code| code);
    check::<OctPrecise48, _>(0u64, |[low, high]| u64::from(high) << 32 | u64::from(low));
    check::<OctPrecise52, _>([0u32; 2], |code| code);
    check::<HemiOct16, _>([0i8; 2], |code| [code as i8, (code >> 8) as i8]);
    check::<Oct32, _>([0i16; 2], |code| [code as i16, (code >> 16) as i16]);
}

/// The features `serde` and `bytemuck`: codes are their integers, frames their seven floats.
#[test]
fn codes_and_frames_as_data() {
    let codes = [Code::<Oct24>::encode([0.0, 1.0, 0.0])];
    assert_eq!(serde_json::to_string(&codes).unwrap(), "[16711551]");
    assert_eq!(serde_json::from_str::<[Code<Oct24>; 1]>("[16711551]").unwrap(), codes);
    assert_eq!(bytemuck::cast_slice::<_, u32>(&codes), [0xfe_ff7f]);
    // Bits above the code's are not shown.
    assert_eq!(Code::<Oct24>::from_bits(0xff91_ecff).to_string(), "91ecff");
    let frame = Frame::new([1.0, 2.0, 3.0], [4.0, 5.0, 6.0], -1.0);
    let json = r#"{"normal":[1.0,2.0,3.0],"tangent":[4.0,5.0,6.0],"handedness":-1.0}"#;
    assert_eq!(serde_json::to_string(&frame).unwrap(), json);
    assert_eq!(serde_json::from_str::<Frame>(json).unwrap(), frame);
    assert_eq!(bytemuck::cast_slice::<_, f32>(&[frame]), frame.to_array());
}

/// A vertex as an engine has it.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
}

/// A vertex with a code in place of the normal.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct PackedVertex {
    position: [f32; 3],
    normal: u32,
    uv: [u16; 2],
}

const VERTEX: Vertex = Vertex { position: [1.0, 2.0, 3.0], normal: [0.0; 3], uv: [4.0, 5.0] };

/// The normals of vertices.
fn normals<B>(bytes: B) -> Strided<B> {
    Strided { bytes, offset: offset_of!(Vertex, normal), stride: size_of::<Vertex>() }
}

/// Structs to structs and back, without a copy: the other fields stay as they are.
#[test]
fn normals_of_vertices() {
    let vertices: Vec<_> = arrays(1000).into_iter().map(|normal| Vertex { normal, ..VERTEX }).collect();
    let empty = PackedVertex { position: [7.0; 3], normal: 0, uv: [8, 9] };
    let mut packed = vec![empty; vertices.len()];
    let (offset, stride) = (offset_of!(PackedVertex, normal), size_of::<PackedVertex>());
    let codes = Strided { bytes: bytemuck::cast_slice_mut(&mut packed), offset, stride };
    encode_strided::<Oct32>(normals(bytemuck::cast_slice(&vertices)), codes).unwrap();
    for (packed, vertex) in packed.iter().zip(&vertices) {
        // Codes are little endian in memory.
        assert_eq!(*packed, PackedVertex { normal: Oct32::encode(vertex.normal).to_le(), ..empty });
    }

    let mut decoded = vec![VERTEX; vertices.len()];
    let codes = Strided { bytes: bytemuck::cast_slice(&packed), offset, stride };
    decode_strided::<Oct32>(codes, normals(bytemuck::cast_slice_mut(&mut decoded))).unwrap();
    for (decoded, packed) in decoded.iter().zip(&packed) {
        assert_eq!(*decoded, Vertex { normal: Oct32::decode(packed.normal.to_le()), ..VERTEX });
    }
}

/// Bytes with `elements` of `SIZE` bytes among others that are 0xA5, as [`Strided`] describes them.
fn scattered(elements: &[u8], size: usize, offset: usize, stride: usize) -> Vec<u8> {
    let count = elements.len() / size;
    let mut bytes = vec![0xA5; if count == 0 { 0 } else { offset + (count - 1) * stride + size }];
    for (i, element) in elements.chunks_exact(size).enumerate() {
        bytes[offset + i * stride..][..size].copy_from_slice(element);
    }
    bytes
}

/// The bits of the slices, at every level, for counts around a block of 64 and a portion of 256, with fields at odd
/// offsets, and packed codes: slices that end with the last element as well as those that go on to the end of the stride.
fn check_strided<C: Codec>(arrays: &[[f32; 3]]) {
    let mut codes = vec![0; arrays.len() * C::BYTES];
    encode_slice::<C>(arrays, &mut codes).unwrap();
    let mut decoded = vec![[0.0; 3]; arrays.len()];
    decode_slice::<C>(&codes, &mut decoded).unwrap();
    let vectors: &[u8] = bytemuck::cast_slice(arrays);
    let decoded: &[u8] = bytemuck::cast_slice(&decoded);
    for count in [0, 1, 13, 63, 64, 65, 130, 255, 256, 257, 600] {
        for [offset, stride, of_codes] in
            [[0, 12, 12], [5, 37, 37], [24, 24, 24], [100, 12, 12], [3, 16, C::BYTES]]
        {
            let from = scattered(&vectors[..12 * count], 12, offset, stride);
            let expected = scattered(&codes[..C::BYTES * count], C::BYTES, offset, of_codes);
            let expected_vectors = scattered(&decoded[..12 * count], 12, offset, stride);
            for level in Level::available() {
                let mut to = scattered(&vec![0; C::BYTES * count], C::BYTES, offset, of_codes);
                // A field at the offset, with the rest of its struct after it.
                let rest =
                    if offset + 12 <= of_codes && count > 0 { of_codes - offset - C::BYTES } else { 0 };
                to.resize(to.len() + rest, 0xA5);
                let strided = Strided { bytes: &mut to[..], offset, stride: of_codes };
                let from = Strided { bytes: &from[..], offset, stride };
                encode_strided_with(level, from, strided, C::BYTES, encode_slice_at::<C>).unwrap();
                assert_eq!(to[..expected.len()], expected, "{level:?} {count} {offset} {stride}");
                assert!(to[expected.len()..].iter().all(|&byte| byte == 0xA5));

                let mut back = scattered(&vec![0; 12 * count], 12, offset, stride);
                let strided = Strided { bytes: &mut back[..], offset, stride };
                let from = Strided { bytes: &to[..], offset, stride: of_codes };
                decode_strided_with(level, from, strided, C::BYTES, decode_slice_at::<C>).unwrap();
                assert_eq!(back, expected_vectors, "{level:?} {count} {offset} {stride}");
            }
        }
    }
}

#[test]
fn strided_is_the_slice() {
    let arrays = arrays(600);
    for_each_size!(check_strided(&arrays));
}

/// A vertex with a frame between other fields.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct FrameVertex {
    position: [f32; 3],
    frame: [f32; 7],
    uv: [f32; 2],
}

/// Slices of frames, of either kind, on all cores and among other fields have the codes and the frames of single ones.
fn check_frames<F: FrameCodec>() {
    let floats = arrays(50_000);
    let floats: Vec<[f32; 7]> =
        floats.as_flattened().chunks_exact(7).map(|components| components.try_into().unwrap()).collect();
    let frames: Vec<Frame> = floats.iter().map(|&components| components.into()).collect();
    let words = |frame: &Frame| {
        F::encode(*frame).to_words().map(u32::to_le_bytes).as_flattened()[..F::BYTES].to_vec()
    };
    let codes: Vec<u8> = frames.iter().flat_map(words).collect();
    let mut encoded = [(); 3].map(|()| vec![0; codes.len()]);
    encode_frames::<F>(&floats, &mut encoded[0]).unwrap();
    encode_frames::<F>(&frames, &mut encoded[1]).unwrap();
    par_encode_frames::<F>(&frames, &mut encoded[2]).unwrap();
    assert!(encoded.iter().all(|encoded| *encoded == codes));

    let expected: Vec<Frame> = frames.iter().map(|frame| F::decode(F::encode(*frame))).collect();
    let mut decoded = [(); 2].map(|()| frames.clone());
    decode_frames::<F>(&codes, &mut decoded[0]).unwrap();
    par_decode_frames::<F>(&codes, &mut decoded[1]).unwrap();
    assert!(decoded.iter().all(|decoded| *decoded == expected));

    let vertex = |frame| FrameVertex { position: [1.0; 3], frame, uv: [2.0; 2] };
    fn fields<B>(bytes: B) -> Strided<B> {
        Strided { bytes, offset: offset_of!(FrameVertex, frame), stride: size_of::<FrameVertex>() }
    }
    let mut vertices: Vec<FrameVertex> = floats.iter().map(|&frame| vertex(frame)).collect();
    let mut strided = vec![0; codes.len()];
    let to = Strided { bytes: &mut strided[..], offset: 0, stride: F::BYTES };
    encode_frames_strided::<F>(fields(bytemuck::cast_slice(&vertices)), to).unwrap();
    assert_eq!(strided, codes);
    let from = Strided { bytes: &codes[..], offset: 0, stride: F::BYTES };
    decode_frames_strided::<F>(from, fields(bytemuck::cast_slice_mut(&mut vertices))).unwrap();
    assert!(vertices.iter().zip(&expected).all(|(actual, frame)| *actual == vertex(frame.to_array())));
}

#[test]
fn slices_of_frames_are_the_single_functions() {
    check_frames::<Frame32>();
    check_frames::<Frame64>();
}

/// The error of both functions for vectors and codes of Oct32 in so many bytes, with this layout. All stays as it was.
fn refused(vectors: [usize; 3], codes: [usize; 3]) -> StrideError {
    fn strided<B>(bytes: B, [_, offset, stride]: [usize; 3]) -> Strided<B> {
        Strided { bytes, offset, stride }
    }
    let (from, from_codes) = (vec![0xA5; vectors[0]], vec![0xA5; codes[0]]);
    let (mut to, mut to_codes) = (from.clone(), from_codes.clone());
    let encoded = encode_strided::<Oct32>(strided(&from, vectors), strided(&mut to_codes, codes));
    let decoded = decode_strided::<Oct32>(strided(&from_codes, codes), strided(&mut to, vectors));
    assert_eq!((to, &to_codes), (from, &from_codes));
    assert_eq!(encoded, decoded);
    encoded.unwrap_err()
}

/// Strides, offsets and lengths that do not fit are named, and nothing is written.
#[test]
fn strided_that_does_not_fit() {
    let good = [80, 0, 4];
    let length = |side, actual, expected| StrideError::Length { side, actual, expected };
    let stride = |side, stride, size| StrideError::Stride { side, stride, size };
    assert_eq!(refused([240, 0, 11], good), stride(Side::Elements, 11, 12));
    assert_eq!(refused([240, 0, 0], good), stride(Side::Elements, 0, 12));
    assert_eq!(refused([240, 0, 12], [80, 0, 3]), stride(Side::Codes, 3, 4));
    assert_eq!(refused([239, 0, 12], good), length(Side::Elements, 239, 240));
    assert_eq!(refused([240, 1, 12], good), length(Side::Elements, 240, 241));
    assert_eq!(refused([240, 240, 12], good), length(Side::Elements, 240, 252));
    assert_eq!(refused([240, usize::MAX, 12], good), length(Side::Elements, 240, usize::MAX));
    assert_eq!(refused([12, 0, usize::MAX], [3, 0, 4]), length(Side::Codes, 3, 4));
    assert_eq!(refused([240, 0, 12], [76, 0, 4]), StrideError::Count { elements: 20, codes: 19 });
    assert_eq!(refused([0, 0, 12], [4, 0, 4]), StrideError::Count { elements: 0, codes: 1 });
    let message = refused([240, 0, 11], good).to_string();
    assert_eq!(message, "the stride of the elements is 11 bytes: make it 12 at least");
}
