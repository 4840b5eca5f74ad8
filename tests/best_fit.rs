//! Best fit codes against searches in `f64` ([`unitvec_tests::oracle::best_fit`]) and the survey's table 1.

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use unitvec::Listed;
use unitvec::best_fit::{EncodeByTable, TABLE_COLUMNS, TABLE_WORDS, fill_table, table_word};
use unitvec::codec::Code;
use unitvec::{Codec, CrytekBfn24, SnormBest8, SnormBest16, SnormNearest8};
use unitvec_tests::oracle::{Summary, angle_deg, best_fit, normalize, widen};
use unitvec_tests::sampling::{
    self, END_OF_NORMS, LEAST_NORM, Rng, near_octant_middles, near_planes, special_inputs, sphere, usable,
};

/// The angle in degrees by which the rounding in `f32` may make a choice of 8 bits worse than the best: positions are
/// off by 2^-17 of a step, of one part in 64 at least, in both candidates.
const CHOICE_ROUNDING_8: f64 = 4e-5;

/// As much at 16 bits: 2^-8 of a step of one part in 18918 at least (a unit vector's largest component), in both
/// candidates.
const CHOICE_ROUNDING_16: f64 = 2.4e-5;

fn table() -> Vec<u32> {
    let mut table = vec![0; TABLE_WORDS];
    fill_table(&mut table);
    table
}

fn word<C: Listed>(code: C::Code) -> u64 {
    let [low, high] = code.to_words();
    u64::from(high) << 32 | u64::from(low)
}

fn error_deg<C: Listed>(v: Vec3, code: C::Code) -> f64 {
    angle_deg(widen(v), widen(C::decode(code)))
}

fn round_trip_error_deg<C: Listed>(v: Vec3) -> f64 {
    error_deg::<C>(v, C::encode(v))
}

/// Asserts that mean and maximum are no worse than the survey's (5 decimals), and that the mean is `ours`, to 1 %.
fn assert_published(name: &str, errors: impl Iterator<Item = f64>, published: Summary, ours: f64) -> Summary {
    let half_digit = 0.000_005;
    let measured = Summary::of(errors);
    println!("{name}: mean {:.7} max {:.7}", measured.mean, measured.max);
    assert!(measured.mean <= (published.mean + half_digit) * 1.01, "{name}: {measured:?}");
    assert!(measured.max <= (published.max + half_digit) * 1.04, "{name}: {measured:?}");
    assert!((measured.mean / ours - 1.0).abs() < 0.01, "{name}: {measured:?}, not {ours}");
    measured
}

/// Codes as `C` has them: 2^20 random ones, and those of small integers.
fn codes<C: Listed>(seed: u64) -> impl Iterator<Item = C::Code> {
    let mut rng = Rng::new(seed);
    let bits = C::BITS / 3;
    let small = (0..16u64 * 16 * 16).map(move |i| {
        [0, 1, 2]
            .map(|c| ((i >> (4 * c) & 15).wrapping_sub(8) & ((1 << bits) - 1)) << (c as u32 * bits))
            .iter()
            .sum()
    });
    (0..1 << 20)
        .map(move |_| rng.bits() & ((1 << C::BITS) - 1))
        .chain(small)
        .map(|code| C::Code::from_words([code as u32, (code >> 32) as u32]))
}

/// Asserts the contract of `encode` for any input.
fn check_encode<C: Listed>(v: [f32; 3], encode: impl Fn(Vec3) -> C::Code, max_error: f64) {
    let code = encode(Vec3::from_array(v));
    let word = word::<C>(code);
    let m = (1 << (C::BITS / 3 - 1)) - 1;
    assert!(word >> C::BITS == 0, "{}: {v:?} gives {word:#x}", C::NAME);
    let usable = usable(v);
    if usable != Some(true) && code == encode(Vec3::Z) {
        return;
    }
    assert!(usable != Some(false), "{}: {v:?} has no direction but the code {word:#x}", C::NAME);
    let q = best_fit::integers(word, C::BITS / 3);
    assert!(q.iter().any(|&t| t != 0) && q.iter().all(|&t| t.abs() <= m), "{}: {v:?} gives {q:?}", C::NAME);
    let error = angle_deg(v.map(f64::from), q.map(f64::from));
    assert!(error <= max_error, "{}: {v:?} gets {q:?}, {error} degrees off", C::NAME);
}

macro_rules! common_tests {
    ($codec:ty, $mean:literal, $max:literal, ours $ours:literal) => {
        use super::*;

        const MAX_ERROR_DEG: f64 = <$codec>::MAX_ERROR_DEG as f64;

        /// 2^20 codes decode to their integers over the largest one, `f32`'s nearest; bits above the code's do not
        /// count.
        #[test]
        fn decodes_as_the_oracle() {
            let bits = <$codec>::BITS / 3;
            let m = f64::from((1 << (bits - 1)) - 1);
            for code in codes::<$codec>(1) {
                let expected =
                    best_fit::integers(word::<$codec>(code), bits).map(|i| (f64::from(i) / m) as f32);
                assert_eq!(<$codec>::decode(code).to_array(), expected, "{:#x}", word::<$codec>(code));
                let [low, high] = code.to_words();
                let dirty = word::<$codec>(code) | !0 << <$codec>::BITS;
                let dirty = <$codec as Codec>::Code::from_words([dirty as u32, (dirty >> 32) as u32]);
                assert_eq!(<$codec>::decode(dirty).to_array(), expected, "{high:x} {low:x}, dirty");
            }
        }

        /// Mean and maximum over 10^6 directions are not above the survey's, and not above the bound.
        #[test]
        fn errors_are_at_most_the_published_ones() {
            let published = Summary { mean: $mean, max: $max };
            let errors = sphere(2, 1_000_000).map(round_trip_error_deg::<$codec>);
            assert!(assert_published(<$codec>::NAME, errors, published, $ours).max <= MAX_ERROR_DEG);
            let around_axes = Summary::of(near_planes(3, 200_000).map(round_trip_error_deg::<$codec>)).max;
            assert!(around_axes <= MAX_ERROR_DEG, "{around_axes}");
        }

        /// 2^20 codes, decoded, encoded and decoded, give a direction within the codec's error; the zero vector
        /// gives +Z.
        #[test]
        fn round_trip_is_stable() {
            for code in codes::<$codec>(4) {
                let once = <$codec>::decode(code);
                let expected = if once == Vec3::ZERO { Vec3::Z } else { once };
                let error = error_deg::<$codec>(expected, <$codec>::encode(once));
                assert!(error <= MAX_ERROR_DEG, "{once:?}: {error}");
            }
        }

        /// The directions of components 0, 1 and -1, axes and diagonals, come back exactly but for length.
        #[test]
        fn keeps_axes_and_diagonals() {
            for i in (0..27).filter(|&i| i != 13) {
                let v = Vec3::new((i % 3 - 1) as f32, (i / 3 % 3 - 1) as f32, (i / 9 - 1) as f32);
                for v in [v, v.normalize()] {
                    let decoded = <$codec>::decode(<$codec>::encode(v));
                    let back = decoded / decoded.abs().max_element();
                    assert_eq!(back, v / v.abs().max_element(), "{v:?}");
                }
            }
        }

        /// Mirrored or permuted, a direction decodes to the decoded vector's image, exactly.
        #[test]
        fn symmetric() {
            let images: [fn(Vec3) -> Vec3; 5] = [
                |v| Vec3::new(-v.x, v.y, v.z),
                |v| Vec3::new(v.x, -v.y, v.z),
                |v| Vec3::new(v.x, v.y, -v.z),
                |v| Vec3::new(v.y, v.x, v.z),
                |v| Vec3::new(v.y, v.z, v.x),
            ];
            for v in sphere(5, 50_000).chain(near_planes(6, 20_000)) {
                let decoded = <$codec>::decode(<$codec>::encode(v));
                for image in images {
                    assert_eq!(<$codec>::decode(<$codec>::encode(image(v))), image(decoded), "{v:?}");
                }
            }
        }

        /// Zeros, denormals, infinities, NaN, huge and tiny numbers; the ends of the usable norms; any length.
        #[test]
        fn special_inputs_keep_the_contract() {
            for v in special_inputs() {
                check_encode::<$codec>(v, <$codec>::encode, MAX_ERROR_DEG);
            }
            let [x, z] = [Vec3::X, Vec3::Z].map(<$codec>::encode);
            for norm in [LEAST_NORM, END_OF_NORMS.next_down()] {
                assert!(<$codec>::encode(Vec3::X * norm) == x);
            }
            for norm in [LEAST_NORM.next_down(), END_OF_NORMS] {
                assert!(<$codec>::encode(Vec3::X * norm) == z);
            }
            for v in sphere(7, 500) {
                for exponent in -60..=60 {
                    assert!(<$codec>::encode(v * 2f32.powi(exponent)) == <$codec>::encode(v), "{v:?}");
                }
            }
        }

        /// Components that are -0 or a denormal count as +0, whatever a device makes of them.
        #[test]
        fn negative_zeros_and_denormals_count_as_zero() {
            for tiny in [-0.0, -1e-40, 1e-40, f32::MIN_POSITIVE.next_down(), -f32::MIN_POSITIVE.next_down()] {
                for scale in [1.0, LEAST_NORM] {
                    for (a, b) in [(0.6, 0.8), (-0.6, 0.8), (0.0, -1.0), (0.1, -0.95)] {
                        let (a, b) = (a * scale, b * scale);
                        for i in 0..3 {
                            let [v, zero] = [tiny, 0.0].map(|t| {
                                let v = [[t, a, b], [a, t, b], [a, b, t]][i];
                                Vec3::from_array(v)
                            });
                            assert!(<$codec>::encode(v) == <$codec>::encode(zero), "{v:?}");
                        }
                    }
                }
            }
        }

        proptest! {
            #![proptest_config(ProptestConfig {
                rng_seed: RngSeed::Fixed(1), cases: 50_000,
                failure_persistence: None,
                ..ProptestConfig::default()
            })]

            /// Any three bit patterns as floats, and ones of exponents that are close together.
            #[test]
            fn any_vector_keeps_the_contract(bits in any::<[u32; 3]>(), exponent in 20u32..232) {
                check_encode::<$codec>(bits.map(f32::from_bits), <$codec>::encode, MAX_ERROR_DEG);
                let close = bits.map(|b| f32::from_bits((b & 0x81ff_ffff) + (exponent << 23)));
                check_encode::<$codec>(close, <$codec>::encode, MAX_ERROR_DEG);
            }
        }
    };
}

mod snorm8x3p {
    common_tests!(SnormBest8, 0.03164, 0.33443, ours 0.030_89);

    /// The axes come back at length 1.
    #[test]
    fn keeps_the_axes() {
        for axis in sampling::AXES {
            assert_eq!(SnormBest8::decode(SnormBest8::encode(axis)), axis);
        }
    }
}

mod snorm8x3_nearest {
    common_tests!(SnormNearest8, 0.03164, 0.33443, ours 0.030_50);

    /// No whole vector at all points nearer, but for the rounding of `f32`, for 300 directions: the trial of all 2^21
    /// of an octant. The oracle's two searches agree.
    #[test]
    fn nearest_of_all() {
        let all = best_fit::all_directions(127);
        for v in sphere(8, 200).chain(near_planes(9, 100)) {
            let best = best_fit::least_error_of_all(widen(v), &all);
            let around_rays = best_fit::least_error(widen(v), 127);
            assert!((best - around_rays).abs() < 1e-6, "{v:?}: {best} {around_rays}");
            let ours = round_trip_error_deg::<SnormNearest8>(v);
            assert!(ours <= best + CHOICE_ROUNDING_8, "{v:?}: {ours} {best}");
        }
    }

    /// Nor for 110 000 directions, by the oracle's shorter search; the means are the same to five digits.
    #[test]
    fn nearest_around_the_ray() {
        let errors: Vec<[f64; 2]> = sphere(10, 60_000)
            .chain(near_octant_middles(22, 30_000, 0.1))
            .chain(near_planes(11, 20_000))
            .map(|v| [round_trip_error_deg::<SnormNearest8>(v), best_fit::least_error(widen(v), 127)])
            .collect();
        let excess = Summary::of(errors.iter().map(|[ours, best]| ours - best));
        let rate =
            errors.iter().filter(|[ours, best]| ours - best > 1e-5).count() as f64 / errors.len() as f64;
        let mean = Summary::of(errors.iter().map(|e| e[1])).mean;
        println!("snorm8x3_nearest over the best: {excess:?}, {rate} by more than 1e-5");
        assert!(excess.max <= CHOICE_ROUNDING_8 && excess.mean <= 1e-5 * mean, "{excess:?} {mean}");
    }

    /// Every code's direction is kept exactly: what comes back is parallel. Of 2^20 codes.
    #[test]
    fn keeps_the_direction_of_every_code() {
        for code in codes::<SnormNearest8>(12) {
            let again = SnormNearest8::encode(SnormNearest8::decode(code));
            let ([ax, ay, az], [bx, by, bz]) =
                (best_fit::integers(code.into(), 8), best_fit::integers(again.into(), 8));
            let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
            assert_eq!(cross, [0; 3], "{code:#x} {again:#x}");
        }
    }

    /// The axes come back at length 1.
    #[test]
    fn keeps_the_axes() {
        for axis in sampling::AXES {
            assert_eq!(SnormNearest8::decode(SnormNearest8::encode(axis)), axis);
        }
    }

    /// Plain snorm8x3 is never better.
    #[test]
    fn never_worse_than_plain() {
        for v in sphere(13, 300_000).chain(near_planes(14, 100_000)) {
            let [ours, plain] =
                [round_trip_error_deg::<SnormNearest8>(v), best_fit::plain_error(widen(v), 127.0)];
            assert!(ours <= plain + CHOICE_ROUNDING_8, "{v:?}: {ours} {plain}");
        }
    }
}

mod crytek_bfn24 {
    common_tests!(CrytekBfn24, 0.04027, 4.78260, ours 0.040_20);
}

mod snorm16x3p {
    common_tests!(SnormBest16, 0.00060, 0.00149, ours 0.000_088);

    /// The axes come back at length 1.
    #[test]
    fn keeps_the_axes() {
        for axis in sampling::AXES {
            assert_eq!(SnormBest16::decode(SnormBest16::encode(axis)), axis);
        }
    }

    /// Plain snorm16x3 is never better, but for the rounding of `f32`; directions of which it may round the plain
    /// vector otherwise (within 2^-7 of a tie) are left out.
    #[test]
    fn never_worse_than_plain() {
        let is_tie = |v: &Vec3| {
            let plain = normalize(widen(*v)).map(|t| t.abs() * 32767.0);
            plain.iter().any(|t| (t.fract() - 0.5).abs() < 1.0 / 128.0)
        };
        let directions = sphere(13, 300_000).chain(near_planes(14, 100_000)).filter(|v| !is_tie(v));
        let excess = Summary::of(directions.map(|v| {
            let [ours, plain] =
                [round_trip_error_deg::<SnormBest16>(v), best_fit::plain_error(widen(v), 32767.0)];
            assert!(ours <= plain + CHOICE_ROUNDING_16, "{v:?}: {ours} {plain}");
            ours - plain
        }));
        println!("snorm16x3p over plain: {excess:?}");
    }

    /// No worse than the best of the 64 longest lengths in `f64`, but for the rounding of `f32`.
    #[test]
    fn best_of_the_longest() {
        let excess = Summary::of(sphere(15, 30_000).map(|v| {
            let ours = round_trip_error_deg::<SnormBest16>(v);
            let best = (32704..=32767)
                .map(|k| best_fit::error_at_length(widen(v), f64::from(k)))
                .fold(f64::INFINITY, f64::min);
            assert!(ours <= best + CHOICE_ROUNDING_16, "{v:?}: {ours} {best}");
            ours - best
        }));
        println!("snorm16x3p over the best of 64: {excess:?}");
    }
}

/// Cells from 0 to 1.
const CELLS: f64 = TABLE_COLUMNS as f64 - 1.0 / 1024.0;

/// Number of a cell's word.
fn table_index(column: u32, row: u32) -> usize {
    let words_before: u32 = (0..column / 4).map(|group| 4 * (4 * group + 4)).sum();
    (words_before + 4 * row + column % 4) as usize
}

/// Each of a cell's lengths leaves no more of the mean error over nine directions, beside those before it, than any
/// other from 64 to 127, but for two in 10 000: 2^11 cells and the table's edges. Lengths that do not help are the
/// longest.
#[test]
fn table_holds_the_best_lengths() {
    let table = table();
    let last = TABLE_COLUMNS - 1;
    let edges = (0..TABLE_COLUMNS).step_by(3).flat_map(|i| [[i, 0], [i, i], [last, i]]);
    let mut rng = Rng::new(16);
    let inner = (0..1 << 11).map(|_| {
        let [a, b] = [(); 2].map(|()| rng.bits() as u32 % TABLE_COLUMNS);
        [a.max(b), a.min(b)]
    });
    for [column, row] in inner.chain(edges) {
        let lengths = table[table_index(column, row)].to_le_bytes();
        let directions = best_fit::cell_directions(column, row, CELLS);
        let errors: Vec<[f64; 9]> = (0..128)
            .map(|length| directions.map(|v| best_fit::error_at_length(v, f64::from(length))))
            .collect();
        let mut left = [f64::INFINITY; 9];
        for length in lengths {
            assert!((64..=127).contains(&length), "{column} {row}: {lengths:?}");
            let with = |other: usize| -> [f64; 9] { std::array::from_fn(|i| errors[other][i].min(left[i])) };
            let total = |other: usize| with(other).iter().sum::<f64>();
            let ours = total(length.into());
            for other in 64..=127 {
                assert!(
                    ours <= total(other) * 1.0002 + 9.0 * CHOICE_ROUNDING_8,
                    "{column} {row}: {lengths:?}, {length} leaves {ours}, {other} {}",
                    total(other)
                );
            }
            left = with(length.into());
        }
    }
    assert_eq!(table[0], 0x7f7f_7f7f);
}

/// Over all cells, in 64 directions of each, nothing is further off than [`SnormBest8::MAX_ERROR_DEG`] says, by 5 %:
/// the most that half a diagonal at a length of 127 can be. Around the axes in 32 times as many along each side.
#[test]
fn largest_error_over_all_cells() {
    let table = table();
    let limit = (0.5f64.sqrt() / 127.0).to_degrees() + CHOICE_ROUNDING_8;
    assert!(f64::from(SnormBest8::MAX_ERROR_DEG) > 1.05 * limit);
    let check = |parts: [u32; 2], steps: f64| {
        let [y, z] = parts.map(|t| ((f64::from(t) + 0.5) / (steps * CELLS)) as f32);
        let v = Vec3::new(y, z, 1.0);
        let error = error_deg::<SnormBest8>(v, SnormBest8::encode_by_table(v, &table));
        assert!(error <= limit, "{v:?}: {error}");
    };
    for column in 0..TABLE_COLUMNS * 8 {
        for row in 0..=column {
            check([column, row], 8.0);
        }
    }
    for column in 0..8 * 256 {
        for row in 0..=column {
            check([column, row], 256.0);
        }
    }
}

/// The whole table is that of [`table_word`]; a short slice gets its beginning, and what is beyond the table stays.
#[test]
fn fills_the_table() {
    let mut long = vec![7; TABLE_WORDS + 3];
    fill_table(&mut long);
    assert_eq!(long[TABLE_WORDS..], [7; 3]);
    for index in (0..TABLE_WORDS).step_by(97).chain([TABLE_WORDS - 1]) {
        assert_eq!(long[index], table_word(index as u32));
    }
    let mut short = [7; 100];
    fill_table(&mut short);
    assert_eq!(short, long[..100]);
    fill_table(&mut []);
}

/// Looked up or worked out, the codes are the same; snorm8x3P is hardly worse than CrytekBFN24 anywhere, never better
/// than the nearest of all.
#[test]
fn encoders_by_table() {
    let table = table();
    for v in sphere(17, 60_000).chain(near_planes(18, 20_000)) {
        let by_table = [CrytekBfn24::encode_by_table(v, &table), SnormBest8::encode_by_table(v, &table)];
        assert_eq!(by_table, [CrytekBfn24::encode(v), SnormBest8::encode(v)], "{v:?}");
        let [bfn, best4] = by_table.map(|code| error_deg::<SnormBest8>(v, code));
        let nearest = round_trip_error_deg::<SnormNearest8>(v);
        // 14 % by the choice's simpler measure of errors.
        assert!(
            best4 <= bfn * 1.14 + CHOICE_ROUNDING_8 && nearest <= best4 + CHOICE_ROUNDING_8,
            "{v:?}: {bfn} {best4} {nearest}"
        );
    }
}

/// The encoders by table take any vector, and any table: one too short, empty or of wrong contents costs accuracy only.
#[test]
fn any_table_will_do() {
    let table = table();
    let mut rng = Rng::new(20);
    let random: Vec<u32> = (0..TABLE_WORDS).map(|_| rng.bits() as u32).collect();
    let bound = f64::from(CrytekBfn24::MAX_ERROR_DEG);
    let vectors = special_inputs().into_iter().chain(sphere(21, 20_000).map(|v| v.to_array()));
    for v in vectors {
        for table in [&table[..], &random, &table[..1000], &[]] {
            check_encode::<SnormBest8>(v, |v| SnormBest8::encode_by_table(v, table), bound);
            check_encode::<SnormBest8>(v, |v| CrytekBfn24::encode_by_table(v, table), bound);
        }
    }
}

/// Layout: x lowest, two's complement; the pattern that encoding never writes counts as -1.
#[test]
fn layout() {
    assert_eq!(SnormNearest8::encode(Vec3::new(127.0, -1.0, 2.0)), 0x02_ff_7f);
    assert_eq!(SnormBest8::encode(Vec3::NAN), 0x7f_00_00);
    assert_eq!(SnormBest16::encode(Vec3::NEG_Y), [0x8001_0000, 0]);
    assert_eq!(SnormBest16::encode(Vec3::ZERO), [0, 0x7fff]);
    assert_eq!(SnormBest8::decode(0x80_81_80), Vec3::NEG_ONE);
    assert_eq!(SnormBest16::decode([0x8000_8001, 0x8000]), Vec3::NEG_ONE);
    assert_eq!(SnormBest8::decode(0), Vec3::ZERO);
}
