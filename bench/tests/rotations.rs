//! `meshopt-quat` beside meshoptimizer itself: `cargo test -p unitvec-bench`.

use meshopt::{decode_filter_quat, encode_filter_quat};
use unitvec::interop::RotationFormat;

/// The plain encoder writes meshoptimizer's words, and the decoder gives its words, or with its SIMD, which rounds ties and
/// scales another way, words beside them.
#[test]
fn meshoptimizer_writes_and_reads_the_same() {
    let rotation = |i: u32| {
        let q = [1.3, 2.9, 4.7, 7.1].map(|rate| (rate * f64::from(i)).sin());
        let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        q.map(|c| (c / length) as f32)
    };
    let all: Vec<[f32; 4]> = (1..100_000).map(rotation).collect();
    for format in RotationFormat::all().filter(|format| format.name == "meshopt-quat") {
        let mut theirs = encode_filter_quat(&all, format.component_bits as i32);
        let codes: Vec<u64> = all.iter().map(|q| format.plain().encode(*q)).collect();
        let word = |code: u64| [0, 16, 32, 48].map(|first| (code >> first) as i16);
        assert!(codes.iter().zip(&theirs).all(|(code, words)| word(*code) == *words), "{format}");
        decode_filter_quat(&mut theirs);
        let ours = codes.iter().map(|code| format.decode(*code).map(|c| (c * 32_767.0).round() as i16));
        let is_beside = |(a, b): (&i16, &i16)| (a - b).abs() <= 1;
        assert!(ours.zip(&theirs).all(|(ours, words)| ours.iter().zip(words).all(is_beside)), "{format}");
    }
}
