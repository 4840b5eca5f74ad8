//! The catalogue is whole and says what is so.

use std::collections::BTreeSet;
use unitvec_host::catalogue::{CATALOGUE, CodecInfo, Coding, Domain};
use unitvec_host::measure::angle_deg;
use unitvec_tests::repository;

fn round_trip(codec: &CodecInfo, vector: [f32; 3]) -> [f32; 3] {
    let mut code = vec![0; codec.bytes];
    let mut decoded = [[0.0; 3]];
    codec.encode_cpu(&[vector], &mut code).unwrap();
    codec.decode_cpu(&code, &mut decoded).unwrap();
    decoded[0]
}

/// Identifiers are unique, sizes fit the bits, and each codec's GLSL file is there and has its functions.
#[test]
fn rows_are_consistent() {
    let ids: BTreeSet<&str> = CATALOGUE.iter().map(|codec| codec.id).collect();
    assert_eq!(ids.len(), CATALOGUE.len());
    for codec in CATALOGUE {
        assert!(codec.bytes * 8 >= codec.bits as usize, "{}", codec.id);
        assert!([1, 2, 3, 4, 6, 8].contains(&codec.bytes), "{}", codec.id);
        let glsl =
            std::fs::read_to_string(repository().join("glsl/unitvec").join(codec.glsl_file())).unwrap();
        // Azimuthal and similar families stamp their functions out by macro: the compiler's tests call them all.
        assert!(glsl.contains(codec.id.trim_end_matches(char::is_numeric)), "{}", codec.id);
    }
}

/// The axes come back exactly, as directions, where the row says so, and not all of them where it says they do not.
#[test]
fn axes_are_exact_where_the_row_says_so() {
    let axes = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    for codec in CATALOGUE {
        let of_domain = if codec.domain == Domain::Sphere { &axes[..] } else { &axes[..5] };
        let exact = of_domain.iter().all(|axis| angle_deg(*axis, round_trip(codec, *axis)) == 0.0);
        assert_eq!(exact, codec.exact_axes, "{}", codec.id);
    }
}

/// A precise encoder's mean error is below that of the fast encoder of its format.
#[test]
fn precise_encoders_are_better_than_fast_ones() {
    let mut pairs = 0;
    for precise in CATALOGUE {
        let Some(fast) = CATALOGUE.iter().find(|codec| format!("{}p", codec.id) == precise.id) else {
            continue;
        };
        pairs += 1;
        let directions: Vec<[f32; 3]> =
            unitvec_host::sampling::random_directions(precise.domain, 3).take(50_000).collect();
        let mean = |codec: &CodecInfo| {
            directions.iter().map(|v| angle_deg(*v, round_trip(codec, *v))).sum::<f64>()
                / directions.len() as f64
        };
        assert!(mean(precise) < mean(fast), "{}", precise.id);
    }
    assert_eq!(pairs, 13);
}

/// Denormal components count as zero, however small the vector: a device that flushes them gets the same codes.
#[test]
fn denormals_count_as_zero() {
    let flush = |c: f32| if c.is_subnormal() { 0.0f32.copysign(c) } else { c };
    let vectors = unitvec_host::sampling::special_vectors();
    let flushed: Vec<[f32; 3]> = vectors.iter().map(|v| v.map(flush)).collect();
    assert!(vectors.iter().zip(&flushed).filter(|(a, b)| a != b).count() > 1000);
    for codec in CATALOGUE {
        let mut codes = vec![0; vectors.len() * codec.bytes];
        let mut flushed_codes = codes.clone();
        codec.encode_cpu(&vectors, &mut codes).unwrap();
        codec.encode_cpu(&flushed, &mut flushed_codes).unwrap();
        let both = codes.chunks_exact(codec.bytes).zip(flushed_codes.chunks_exact(codec.bytes));
        for ((code, flushed), vector) in both.zip(&vectors) {
            assert_eq!(code, flushed, "{}: {vector:?}", codec.id);
        }
    }
}
