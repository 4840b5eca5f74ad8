//! `cargo bench -p unitvec-bench`: whole slices of vectors, to codes and back, beside the octahedral filters of meshopt,
//! the crate normal_pack, a loop of scalar calls, and memcpy, all on the same vectors. Then
//! `cargo run -p unitvec-bench --bin summary` prints the table.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use meshopt::ffi::{meshopt_decodeFilterOct, meshopt_encodeFilterOct};
use normal_pack::EncodedUnitVector3U8;
use std::hint::black_box;
use std::time::Duration;
use unitvec::Listed;
use unitvec::interop::{Format, ROWS};
use unitvec::slice::machine::{Level, Stream};
use unitvec::slice::{
    Strided, decode_slice, decode_slice_i16x4, decode_strided, encode_slice, encode_strided,
    par_decode_slice, par_encode_slice,
};
use unitvec::table::DecodeTable;
use unitvec::{
    Codec, Float16x3, HemiOct32, LatLongD16, LatLongD32, Oct16, Oct24, Oct32, OctPrecise16, OctPrecise32,
    Snorm10x3,
};
use unitvec_bench::{COUNTS, group};

/// Unit vectors in random directions, by a generator that is the same everywhere (Knuth's MMIX).
fn directions(count: usize) -> Vec<[f32; 3]> {
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / 8_388_608.0 - 1.0
    };
    std::iter::repeat_with(|| Vec3::new(random(), random(), random()))
        .filter(|v| v.length_squared() < 1.0 && v.length_squared() > 1e-4)
        .map(|v| v.normalize().to_array())
        .take(count)
        .collect()
}

/// A group with samples so few and short that the whole benchmark takes three minutes.
fn open<'a>(criterion: &'a mut Criterion, direction: &str, count: usize) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(group(direction, count));
    group
        .throughput(Throughput::Elements(count as u64))
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(600));
    if count > 1 << 20 {
        group.sample_size(10);
    }
    group
}

fn encode_with<C: Listed>(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    encode_as::<C>(group, C::NAME, vectors);
}

fn encode_as<C: Codec>(group: &mut BenchmarkGroup<WallTime>, name: &str, vectors: &[[f32; 3]]) {
    let mut codes = vec![0; vectors.len() * C::BYTES];
    group.bench_function(name, |b| b.iter(|| encode_slice::<C>(black_box(vectors), black_box(&mut codes))));
}

/// A scalar function for each item.
fn one_by_one<A: Copy, B>(
    group: &mut BenchmarkGroup<WallTime>,
    name: &str,
    from: &[A],
    mut to: Vec<B>,
    function: impl Fn(A) -> B,
) {
    group.bench_function(name, |b| {
        b.iter(|| {
            for (to, from) in black_box(&mut to).iter_mut().zip(black_box(from)) {
                *to = function(*from);
            }
        });
    });
}

fn encode_plain<C: Listed<Code = u32>>(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    one_by_one(group, &format!("{}-plain", C::NAME), vectors, vec![0; vectors.len()], C::encode);
}

/// The bytes of the codes.
fn encoded<C: Codec>(vectors: &[[f32; 3]]) -> Vec<u8> {
    let mut codes = vec![0; vectors.len() * C::BYTES];
    encode_slice::<C>(vectors, &mut codes).expect("the slices fit");
    codes
}

fn decode_with<C: Listed>(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    let codes = encoded::<C>(vectors);
    let mut decoded = vectors.to_vec();
    group.bench_function(C::NAME, |b| {
        b.iter(|| decode_slice::<C>(black_box(&codes), black_box(&mut decoded)))
    });
}

fn decode_plain<C: Listed<Code = u32>>(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    let codes: Vec<u32> = vectors.iter().map(|v| C::encode(*v)).collect();
    one_by_one(group, &format!("{}-plain", C::NAME), &codes, vectors.to_vec(), C::decode::<[f32; 3]>);
}

fn decode_by_table<C: Listed>(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    let mut memory = vec![[0.0; 3]; DecodeTable::<C>::ENTRIES];
    let table = DecodeTable::<C>::fill(&mut memory).expect("the memory is of that size");
    let codes = encoded::<C>(vectors);
    let mut decoded = vectors.to_vec();
    group.bench_function(format!("{}-table", C::NAME), |b| {
        b.iter(|| table.decode_slice(black_box(&codes), black_box(&mut decoded)));
    });
}

/// A vertex: position, normal, texture coordinates.
type Vertex = [f32; 8];

/// Where a vertex has its normal, in floats.
const NORMAL: usize = 3;

fn normals<B>(bytes: B) -> Strided<B> {
    Strided { bytes, offset: NORMAL * size_of::<f32>(), stride: size_of::<Vertex>() }
}

fn packed<B>(bytes: B) -> Strided<B> {
    Strided { bytes, offset: 0, stride: Oct32::BYTES }
}

fn vertices(vectors: &[[f32; 3]]) -> Vec<Vertex> {
    vectors.iter().map(|&[x, y, z]| [0.0, 0.0, 0.0, x, y, z, 0.0, 0.0]).collect()
}

/// The normals of vertices to codes, by the function and by a loop over the vertices.
fn encode_vertices(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    let (vertices, mut codes) = (vertices(vectors), vec![0; vectors.len() * Oct32::BYTES]);
    group.bench_function("oct32-vertices", |b| {
        b.iter(|| {
            let from = normals(bytemuck::cast_slice(black_box(&vertices)));
            encode_strided::<Oct32>(from, packed(black_box(&mut codes)))
        });
    });
    let encode = |vertex: Vertex| Oct32::encode([vertex[NORMAL], vertex[NORMAL + 1], vertex[NORMAL + 2]]);
    one_by_one(group, "oct32-vertices-plain", &vertices, vec![0; vectors.len()], encode);
}

/// Codes to the normals of vertices, by the function and by a loop over the vertices.
fn decode_vertices(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]]) {
    let (mut vertices, codes) = (vertices(vectors), encoded::<Oct32>(vectors));
    group.bench_function("oct32-vertices", |b| {
        b.iter(|| {
            let to = normals(bytemuck::cast_slice_mut(black_box(&mut vertices)));
            decode_strided::<Oct32>(packed(black_box(&codes)), to)
        });
    });
    let codes: Vec<u32> = vectors.iter().map(|v| Oct32::encode(*v)).collect();
    group.bench_function("oct32-vertices-plain", |b| {
        b.iter(|| {
            for (vertex, code) in black_box(&mut vertices).iter_mut().zip(black_box(&codes)) {
                vertex[NORMAL..NORMAL + 3].copy_from_slice(&Oct32::decode::<[f32; 3]>(*code));
            }
        });
    });
}

/// A memcpy of as many bytes as `items` have.
fn copy<T: Copy>(group: &mut BenchmarkGroup<WallTime>, name: &str, items: &[T]) {
    let mut copied = items.to_vec();
    group.bench_function(name, |b| b.iter(|| black_box(&mut copied).copy_from_slice(black_box(items))));
}

/// Streaming stores of 12 bytes for each 4 that are read: what decoding moves.
fn stream(group: &mut BenchmarkGroup<WallTime>, codes: &[u8], vectors: &[[f32; 3]]) {
    let level = Level::best().for_output(usize::MAX);
    let mut copied = vectors.to_vec();
    let at_line = level.before_line(&copied, size_of::<[f32; 3]>());
    group.bench_function("stream12", |b| {
        b.iter(|| {
            let copied = &mut black_box(&mut copied)[at_line..];
            let Some(mut stream) = Stream::<_, 64>::to(level, copied) else { return };
            for (to, from) in copied.chunks_exact_mut(64).zip(black_box(codes).chunks_exact(256)) {
                for (to, from) in stream.lines.iter_mut().zip(from.chunks_exact(4)) {
                    *to = [f32::from_ne_bytes([from[0], from[1], from[2], from[3]]); 3];
                }
                stream.store(to);
            }
        });
    });
}

/// meshopt's filter writes four components of `size / 4` bytes; the fourth is ours to choose.
fn encode_meshopt(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]], size: usize) {
    let four: Vec<[f32; 4]> = vectors.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
    let mut codes = vec![0u64; vectors.len() * size / 8];
    let bits = 2 * size as i32;
    group.bench_function(format!("meshopt{bits}"), |b| {
        b.iter(|| {
            let (to, from) = (black_box(&mut codes).as_mut_ptr(), black_box(&four).as_ptr());
            // SAFETY: `codes` has `size` bytes for each of the vectors of four floats in `four`.
            unsafe { meshopt_encodeFilterOct(to.cast(), vectors.len(), size, bits, from.cast()) }
        });
    });
}

/// meshopt decodes in place. From the second time on it decodes what it wrote, in the same time: its code has no
/// branches.
fn decode_meshopt(group: &mut BenchmarkGroup<WallTime>, vectors: &[[f32; 3]], size: usize) {
    let four: Vec<[f32; 4]> = vectors.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
    let mut codes = vec![0u64; vectors.len() * size / 8];
    let bits = 2 * size as i32;
    // SAFETY: `codes` has `size` bytes for each of the vectors of four floats in `four`.
    unsafe {
        meshopt_encodeFilterOct(codes.as_mut_ptr().cast(), vectors.len(), size, bits, four.as_ptr().cast());
    }
    group.bench_function(format!("meshopt{bits}"), |b| {
        b.iter(|| {
            let codes = black_box(&mut codes).as_mut_ptr();
            // SAFETY: `codes` has `size` bytes for each vector.
            unsafe { meshopt_decodeFilterOct(codes.cast(), vectors.len(), size) }
        });
    });
}

fn encode(criterion: &mut Criterion) {
    let all = directions(COUNTS[2]);
    for count in COUNTS {
        let vectors = &all[..count];
        let mut group = open(criterion, "encode", count);
        encode_with::<Oct16>(&mut group, vectors);
        encode_with::<OctPrecise16>(&mut group, vectors);
        encode_with::<Oct24>(&mut group, vectors);
        encode_meshopt(&mut group, vectors, 4);
        encode_with::<Oct32>(&mut group, vectors);
        encode_meshopt(&mut group, vectors, 8);
        encode_with::<OctPrecise32>(&mut group, vectors);
        copy(&mut group, "memcpy12", vectors);
        encode_with::<HemiOct32>(&mut group, vectors);
        encode_with::<LatLongD32>(&mut group, vectors);
        encode_with::<Snorm10x3>(&mut group, vectors);
        encode_with::<Float16x3>(&mut group, vectors);
        encode_plain::<Oct16>(&mut group, vectors);
        encode_plain::<Oct32>(&mut group, vectors);
        encode_plain::<OctPrecise32>(&mut group, vectors);
        encode_vertices(&mut group, vectors);
        let codes: Vec<_> = vectors.iter().map(|v| EncodedUnitVector3U8::encode(*v)).collect();
        one_by_one(&mut group, "normal_pack", vectors, codes, EncodedUnitVector3U8::encode);
        let mut codes = vec![0; vectors.len() * Oct32::BYTES];
        group.bench_function("oct32-parallel", |b| {
            b.iter(|| par_encode_slice::<Oct32>(black_box(vectors), black_box(&mut codes)));
        });
    }
}

fn decode(criterion: &mut Criterion) {
    let all = directions(COUNTS[2]);
    for count in COUNTS {
        let vectors = &all[..count];
        let mut group = open(criterion, "decode", count);
        decode_with::<Oct16>(&mut group, vectors);
        copy(&mut group, "memcpy12", vectors);
        decode_by_table::<Oct16>(&mut group, vectors);
        decode_with::<Oct24>(&mut group, vectors);
        decode_meshopt(&mut group, vectors, 4);
        decode_with::<Oct32>(&mut group, vectors);
        decode_meshopt(&mut group, vectors, 8);
        let codes = encoded::<Oct32>(vectors);
        stream(&mut group, &codes, vectors);
        let mut decoded = vec![[0i16; 4]; count];
        group.bench_function("oct32-i16x4", |b| {
            b.iter(|| decode_slice_i16x4::<Oct32>(black_box(&codes), black_box(&mut decoded)));
        });
        copy(&mut group, "memcpy8", &decoded);
        decode_with::<HemiOct32>(&mut group, vectors);
        decode_with::<LatLongD16>(&mut group, vectors);
        decode_by_table::<LatLongD16>(&mut group, vectors);
        decode_with::<LatLongD32>(&mut group, vectors);
        decode_with::<Snorm10x3>(&mut group, vectors);
        decode_with::<Float16x3>(&mut group, vectors);
        decode_plain::<Oct16>(&mut group, vectors);
        decode_plain::<Oct32>(&mut group, vectors);
        decode_vertices(&mut group, vectors);
        let packed: Vec<_> = vectors.iter().map(|v| EncodedUnitVector3U8::encode(*v)).collect();
        one_by_one(&mut group, "normal_pack", &packed, vectors.to_vec(), |code| code.decode());
        let mut decoded = vectors.to_vec();
        group.bench_function("oct32-parallel", |b| {
            b.iter(|| par_decode_slice::<Oct32>(black_box(&codes), black_box(&mut decoded)));
        });
    }
}

/// The formats of other software, one width of each, since it does not count. Before each, `oct16p`: over all of them a
/// machine's speed may change.
fn formats(criterion: &mut Criterion) {
    let vectors = &directions(COUNTS[0])[..];
    let mut group = open(criterion, "formats", COUNTS[0]);
    for row in &ROWS {
        encode_as::<OctPrecise16>(&mut group, &format!("{}-oct16p", row.name), vectors);
        let format = Format::all().filter(|format| format.row().name == row.name).last();
        let format = format.expect("a format has a width");
        let mut codes = vec![0; vectors.len() * format.bytes()];
        group.bench_function(row.name, |b| {
            b.iter(|| format.encode_slice(black_box(vectors), black_box(&mut codes)));
        });
    }
}

criterion_group!(benches, encode, decode, formats);
criterion_main!(benches);
