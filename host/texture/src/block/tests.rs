use super::*;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use unitvec::{hemioct, oct};

const PAIRS: [Pair; 3] = [Pair::Xy, Pair::Hemioct, Pair::Oct];
const BC5: [Compression; 2] = [Compression::Bc5Unorm, Compression::Bc5Snorm];

/// The angle by the chord, which is exact for small ones.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    2.0 * (0.5 * (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()).min(1.0).asin()
}

/// The bytes of a channel with these end points, whose first 8 texels have the indices 0 to 7, and the others 0.
fn counting(a: i32, b: i32) -> [u8; 8] {
    let [c, d, e, ..] = 0o76543210u32.to_le_bytes();
    [a as u8, b as u8, c, d, e, 0, 0, 0]
}

/// Values worked out from the specification, in both orders of end points and both signs: sixths of the way are sevenths of the
/// range, and fifths where the order is turned round.
#[test]
fn values_are_those_of_the_specification() {
    let unorm: fn(i32) -> f64 = |byte| f64::from(2 * byte) / 255.0 - 1.0;
    let snorm: fn(i32) -> f64 = |integer| f64::from(integer) / 127.0;
    let rows = [
        (Compression::Bc5Unorm, unorm, [200, 60, 180, 160, 140, 120, 100, 80]),
        (Compression::Bc5Unorm, unorm, [60, 200, 88, 116, 144, 172, 0, 255]),
        (Compression::Bc5Snorm, snorm, [100, -40, 80, 60, 40, 20, 0, -20]),
        (Compression::Bc5Snorm, snorm, [-40, 60, -20, 0, 20, 40, -127, 127]),
    ];
    for (compression, value, expected) in rows {
        let block = [counting(expected[0], expected[1]), counting(expected[1], expected[0])].concat();
        let decoded = points(&block, compression);
        for (texel, expected) in expected.map(value).into_iter().enumerate() {
            assert!((decoded[texel][0] - expected).abs() < 1e-15, "{compression:?}: {decoded:?}");
        }
        assert_eq!(decoded[8][0], decoded[0][0]);
        // Green has the ends in the other order.
        assert!((decoded[1][1] - value(expected[0])).abs() < 1e-15, "{compression:?}: {decoded:?}");
    }
    let lowest = [counting(-128, -127), counting(-127, -128)].concat();
    assert_eq!(points(&lowest, Compression::Bc5Snorm)[..6], [[-1.0; 2]; 6]);
}

/// Another crate decodes random blocks to the same values.
#[test]
fn another_decoder_agrees() {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    for _ in 0..2000 {
        let block: [u8; BYTES] = random.random();
        for compression in BC5 {
            let mut other = [0f32; 2 * TEXELS];
            bcdec_rs::bc5_float(&block, &mut other, 8, compression == Compression::Bc5Snorm);
            for (ours, other) in points(&block, compression).iter().flatten().zip(other) {
                let other = if compression == Compression::Bc5Snorm { other } else { 2.0 * other - 1.0 };
                assert!((ours - f64::from(other)).abs() < 1e-6, "{block:?}");
            }
        }
        let mut other = [[0; 4]; TEXELS];
        bcdec_rs::bc7(&block, other.as_flattened_mut(), 16);
        for (ours, other) in points(&block, Compression::Bc7).iter().zip(other) {
            assert!(
                (0..2).all(|at| (127.5 * (ours[at] + 1.0) - f64::from(other[at])).abs() < 1e-6),
                "{block:?}"
            );
        }
    }
}

/// Directions about a random one, `width` wide, in a map of 64 by 4.
fn scattered(width: f32, random: &mut Pcg64Mcg) -> Vec<[f32; 3]> {
    let mut part = || random.random_range(-1.0..=1.0f32);
    let middle = [part(), part(), part()];
    (0..256).map(|_| middle.map(|t| t + width * part())).collect()
}

/// No block has a greater error than the crate's, the sum of the angles to the power 5/4, and all together have less. Some
/// directions are below the equator or almost 0.
#[test]
fn no_block_is_worse_than_by_channel() {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    for width in [0.0, 0.01, 0.1, 1.0, 100.0] {
        let map = scattered(width, &mut random);
        for (pair, compression) in
            PAIRS.into_iter().flat_map(|pair| BC5.map(|compression| (pair, compression)))
        {
            let error = |column: usize, block: &[u8]| -> f64 {
                let off = points(block, compression).into_iter().enumerate().map(|(at, point)| {
                    let wanted = pair.point(map[4 * column + at % 4 + at / 4 * 64]);
                    angle(pair.vector(point), pair.vector(wanted)).powf(1.25)
                });
                off.sum()
            };
            let [ours, theirs] = [compress, compress_by_channel].map(|compress| {
                let blocks = compress(&map, 64, 4, pair, compression);
                (0..16).map(|column| error(column, &blocks[16 * column..][..16])).collect::<Vec<_>>()
            });
            let case = format!("{width} {pair:?} {compression:?}: {ours:?} {theirs:?}");
            assert!(ours.iter().zip(&theirs).all(|(ours, theirs)| *ours <= 1.0001 * theirs + 1e-7), "{case}");
            assert!(width == 0.0 || ours.iter().sum::<f64>() < 0.95 * theirs.iter().sum::<f64>(), "{case}");
        }
    }
}

/// A block of one direction is no farther off than its point rounded to end points, half a step of each; in BC7, two steps.
#[test]
fn constant_blocks_are_within_half_a_step() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    for (vector, pair) in (0..200).flat_map(|_| PAIRS.map(|pair| (scattered(0.0, &mut random)[0], pair))) {
        let wanted = pair.point(vector);
        let decoded =
            |compression| points(&compress(&[vector; TEXELS], 4, 4, pair, compression), compression);
        for (compression, most) in BC5.into_iter().zip([255.0, 254.0]) {
            let rounded = wanted.map(|t| ((t + 1.0) / 2.0 * most).round() / most * 2.0 - 1.0);
            let bound = angle(pair.vector(rounded), pair.vector(wanted)) + 1e-6;
            let is_near = |point: [f64; 2]| angle(pair.vector(point), pair.vector(wanted)) <= bound;
            assert!(decoded(compression).into_iter().all(is_near), "{vector:?} {pair:?} {compression:?}");
        }
        let is_near = |point: [f64; 2]| (0..2).all(|at| (point[at] - wanted[at]).abs() <= 4.0 / 255.0);
        assert!(decoded(Compression::Bc7).into_iter().all(is_near), "{vector:?} {pair:?}");
    }
}

/// Sizes that are no multiple of 4 repeat the last column and row. Bytes of another size are refused.
#[test]
fn odd_sizes_are_padded_and_wrong_ones_refused() {
    let map = scattered(1.0, &mut Pcg64Mcg::seed_from_u64(4));
    let padded: Vec<_> = (0..32).map(|at: usize| map[(at / 8).min(2) * 5 + (at % 8).min(4)]).collect();
    for compression in [Compression::Bc5Unorm, Compression::Bc5Snorm, Compression::Bc7] {
        let decode = |bytes: &[u8], width, height| decompress(bytes, width, height, Pair::Oct, compression);
        let bytes = compress(&map[..15], 5, 3, Pair::Oct, compression);
        assert_eq!(bytes, compress(&padded, 8, 4, Pair::Oct, compression));
        let whole = decode(&bytes, 8, 4).unwrap();
        let cut: Vec<_> = (0..15).map(|at| whole[at / 5 * 8 + at % 5]).collect();
        assert_eq!(decode(&bytes, 5, 3).unwrap(), cut);
        for (length, width, height) in
            [(31, 5, 3), (16, 5, 3), (32, 5, 5), (32, u32::MAX, u32::MAX), (32, 0, 4)]
        {
            assert_eq!(decode(&bytes[..length], width, height), None);
        }
        assert!(compress(&[], 0, 7, Pair::Oct, compression).is_empty());
        assert_eq!(decode(&[], 0, 7), Some(vec![]));
        // Texels without a direction, and those that are missing, are +Z.
        let none = compress(&[[f32::NAN; 3], [0.0; 3]], 3, 1, Pair::Oct, compression);
        assert_eq!(none, compress(&[[0.0, 0.0, 1.0]; 3], 3, 1, Pair::Oct, compression));
    }
}

/// A point's vector is the direction that it came from, and that of the codecs' functions.
#[test]
fn pairs_invert_and_match_the_codecs() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    for v in (0..10_000).flat_map(|_| scattered(0.0, &mut random).first().copied()) {
        let upper = [v[0], v[1], v[2].abs() + 0.05];
        for (pair, v) in [(Pair::Xy, upper), (Pair::Hemioct, upper), (Pair::Oct, v)] {
            let length = v.iter().map(|t| f64::from(*t).powi(2)).sum::<f64>().sqrt();
            let unit = v.map(|t| f64::from(t) / length);
            assert!(angle(pair.vector(pair.point(v)), unit) < 5e-6, "{pair:?} {v:?}");
        }
        let (e, point) = (unitvec::glam::Vec2::new(v[0], v[1]), [v[0], v[1]].map(f64::from));
        for (pair, unproject) in
            [(Pair::Oct, oct::unproject as fn(_) -> _), (Pair::Hemioct, hemioct::unproject)]
        {
            let vector: unitvec::glam::Vec3 = unproject(e);
            assert!(angle(pair.vector(point), vector.to_array().map(f64::from)) < 1e-6, "{pair:?} {point:?}");
        }
    }
    // Below the equator, the corner that is -Z, outside the rim, and no number.
    assert_eq!(Pair::Xy.point([0.0, 2.0, -3.0]), [0.0, 1.0]);
    assert_eq!(Pair::Oct.vector([1.0, -1.0]), [0.0, 0.0, -1.0]);
    assert_eq!(Pair::Xy.vector([-9.0, 0.0]), [-1.0, 0.0, 0.0]);
    assert_eq!(Pair::Hemioct.vector([f64::NAN, 0.0]), [0.0, 0.0, 1.0]);
}
