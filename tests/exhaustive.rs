//! All codes of the codecs of which the suite takes a part, up to the 2^32 of 32 bits: `cargo xtask test --exhaustive`
//! runs these, minutes a codec of 32 bits on 2 cores.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use unitvec_catalogue::{AnyCodec, vectors};
use unitvec_tests::checks::{assert_decodes, assert_stable};
use unitvec_tests::expected;
use unitvec_tests::tested::Tested;

const CHUNK: u64 = 1 << 16;

/// Each code decodes to a finite vector, of unit length to within 2 ULP where the codec promises that; decoded, encoded
/// and decoded again it gives the same vector.
#[test]
#[ignore = "minutes a codec; cargo xtask test --exhaustive"]
fn every_code_of_32_bits_keeps_the_contract() {
    for codec in vectors().iter().filter(|codec| codec.bits == 32) {
        let started = Instant::now();
        let next = AtomicU64::new(0);
        let threads = std::thread::available_parallelism().map_or(1, |count| count.get());
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    loop {
                        let start = next.fetch_add(CHUNK, Ordering::Relaxed);
                        if start >= 1 << 32 {
                            break;
                        }
                        check(codec, start as u32);
                    }
                });
            }
        });
        println!("{}: 2^32 codes in {} s", codec.id, started.elapsed().as_secs());
    }
}

/// Each code of up to 24 bits decodes to the reference's vector and comes back as the same one: as far as
/// [`expected::every_code_decoded`] and [`expected::every_code_returned`] go.
#[test]
#[ignore = "a minute; cargo xtask test --exhaustive"]
fn every_code_of_up_to_24_bits_is_the_oracles() {
    for codec in Tested::all() {
        let [decoded, returned] = [expected::every_code_decoded(codec), expected::every_code_returned(codec)];
        std::thread::scope(|scope| {
            if codec.bits <= decoded {
                scope
                    .spawn(|| assert_decodes(codec, codec.codes(1, decoded), expected::settled_share(codec)));
            }
            if codec.bits <= returned && expected::is_stable(codec) {
                assert_stable(codec, codec.codes(2, returned));
            }
        });
    }
}

fn check(codec: &AnyCodec, start: u32) {
    let codes: Vec<u8> = (0..CHUNK as u32).flat_map(|n| (start + n).to_le_bytes()).collect();
    let (mut once, mut twice) = (vec![[0.0; 3]; CHUNK as usize], vec![[0.0; 3]; CHUNK as usize]);
    let mut again = codes.clone();
    codec.decode_cpu(&codes, once.as_flattened_mut()).unwrap();
    codec.encode_cpu(once.as_flattened(), &mut again).unwrap();
    codec.decode_cpu(&again, twice.as_flattened_mut()).unwrap();
    for (n, (first, second)) in once.iter().zip(&twice).enumerate() {
        let length = first.iter().map(|c| f64::from(*c) * f64::from(*c)).sum::<f64>().sqrt();
        let unit = (length - 1.0).abs() <= 2.0 * f64::from(f32::EPSILON);
        assert!(
            unit || !codec.is_unit && length.is_finite(),
            "{}: {:#x} has length {length}",
            codec.id,
            start as usize + n
        );
        assert_eq!(first, second, "{}: {:#x}", codec.id, start as usize + n);
    }
}
