//! Best fit codes against searches in `f64`: [`unitvec_oracle::best_fit`].

use glam::Vec3;
use unitvec::best_fit::{EncodeByTable, TABLE_COLUMNS, TABLE_WORDS, fill_table, table_word};
use unitvec::{Codec, CrytekBfn24, SnormBest8, SnormBest16, SnormNearest8};
use unitvec_oracle::{Summary, angle_deg, best_fit, normalize};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::directions::{Rng, near_octant_middles, near_planes, sphere, usable};
use unitvec_tests::tested::{Tested, widen};

/// The angle in degrees by which the rounding in `f32` may make a choice of 8 bits worse than the best: positions are
/// off by 2^-17 of a step, of one part in 64 at least, in both candidates.
const CHOICE_ROUNDING_8: f64 = 4e-5;

/// The rounding of the choice at 16 bits: 2^-8 of a step of one part in 18918 at least (a unit vector's largest
/// component), in both candidates.
const CHOICE_ROUNDING_16: f64 = 2.4e-5;

fn table() -> Vec<u32> {
    let mut table = vec![0; TABLE_WORDS];
    fill_table(&mut table);
    table
}

/// The angle in degrees between a direction and a code of 8 bits a component.
fn code_error(v: Vec3, code: u32) -> f64 {
    angle_deg(widen(v), widen(SnormBest8::decode_vec3(code)))
}

/// The integers of every code of small ones, which the sampled codes of the suite hardly have, are what decoding gives over
/// the largest; and the zero vector comes back as +Z.
#[test]
fn small_integers() {
    for codec in Tested::family("best_fit") {
        let bits = codec.bits / 3;
        let m = (1 << (bits - 1)) - 1;
        for i in 0..16 * 16 * 16 {
            let integers = [i % 16, i / 16 % 16, i / 256].map(|t| t - 8);
            let code = (0..3).map(|c| ((integers[c] as u64) & ((1 << bits) - 1)) << (c as u32 * bits)).sum();
            let expected = integers.map(|t| (t as f64 / f64::from(m)) as f32);
            let decoded = codec.decode(code);
            assert_eq!(decoded.to_array(), expected, "{}: {code:#x}", codec.id);
            let direction = if decoded == Vec3::ZERO { Vec3::Z } else { decoded };
            let error = angle_deg(widen(direction), widen(codec.round_trip(decoded)));
            assert!(error <= f64::from(codec.max_error_deg()), "{}: {code:#x}: {error}", codec.id);
        }
    }
}

/// The directions of components 0, 1 and -1, axes and diagonals, come back exactly but for length.
#[test]
fn keeps_axes_and_diagonals() {
    for codec in Tested::family("best_fit") {
        for i in (0..27).filter(|&i| i != 13) {
            let v = Vec3::new((i % 3 - 1) as f32, (i / 3 % 3 - 1) as f32, (i / 9 - 1) as f32);
            for v in [v, v.normalize()] {
                let decoded = codec.round_trip(v);
                let back = decoded / decoded.abs().max_element();
                assert_eq!(back, v / v.abs().max_element(), "{}: {v:?}", codec.id);
            }
        }
    }
}

/// No whole vector at all points nearer than the nearest of 8 bits, but for the rounding of `f32`, for 120 directions: the
/// trial of all 2^21 of an octant. The oracle's two searches agree.
#[test]
fn nearest_of_all() {
    let (codec, all) = (Tested::find("snorm8x3_nearest"), best_fit::all_directions(127));
    for v in sphere(8, 80).chain(near_planes(9, 40)) {
        let best = best_fit::least_error_of_all(widen(v), &all);
        let around_rays = best_fit::least_error(widen(v), 127);
        assert!((best - around_rays).abs() < 1e-6, "{v:?}: {best} {around_rays}");
        let ours = codec.error_deg(v);
        assert!(ours <= best + CHOICE_ROUNDING_8, "{v:?}: {ours} {best}");
    }
}

/// Nor for 110 000 directions, by the oracle's shorter search; the means are the same to five digits.
#[test]
fn nearest_around_the_ray() {
    let codec = Tested::find("snorm8x3_nearest");
    let errors: Vec<[f64; 2]> = sphere(10, 60_000)
        .chain(near_octant_middles(22, 30_000, 0.1))
        .chain(near_planes(11, 20_000))
        .map(|v| [codec.error_deg(v), best_fit::least_error(widen(v), 127)])
        .collect();
    let excess = Summary::of(errors.iter().map(|[ours, best]| ours - best));
    let mean = Summary::of(errors.iter().map(|e| e[1])).mean;
    println!("snorm8x3_nearest over the best: {excess:?}");
    assert!(excess.max <= CHOICE_ROUNDING_8 && excess.mean <= 1e-5 * mean, "{excess:?} {mean}");
}

/// The nearest of 8 bits keeps every code's direction exactly: the decoded vector is parallel. Checks a ninth of all.
#[test]
fn nearest_keeps_the_direction_of_every_code() {
    let codec = Tested::find("snorm8x3_nearest");
    for code in codec.codes(12, 22) {
        let again = codec.encode(codec.decode(code));
        let [[ax, ay, az], [bx, by, bz]] = [code, again].map(|code| best_fit::integers(code, 8));
        let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        assert_eq!(cross, [0; 3], "{code:#x} {again:#x}");
    }
}

/// Plain snorm16x3 is never better than snorm16x3p, but for the rounding of `f32`; directions of which it may round the
/// plain vector otherwise (within 2^-7 of a tie) are left out.
#[test]
fn snorm16x3p_is_never_worse_than_plain() {
    let codec = Tested::find("snorm16x3p");
    let is_tie = |v: &Vec3| {
        let plain = normalize(widen(*v)).map(|t| t.abs() * 32767.0);
        plain.iter().any(|t| (t.fract() - 0.5).abs() < 1.0 / 128.0)
    };
    let directions = sphere(13, 300_000).chain(near_planes(14, 100_000)).filter(|v| !is_tie(v));
    let excess = Summary::of(directions.map(|v| {
        let [ours, plain] = [codec.error_deg(v), best_fit::plain_error(widen(v), 32767.0)];
        assert!(ours <= plain + CHOICE_ROUNDING_16, "{v:?}: {ours} {plain}");
        ours - plain
    }));
    println!("snorm16x3p over plain: {excess:?}");
}

/// snorm16x3p is no worse than the best of the 64 longest lengths in `f64`, but for the rounding of `f32`.
#[test]
fn snorm16x3p_is_the_best_of_the_longest() {
    let codec = Tested::find("snorm16x3p");
    let excess = Summary::of(sphere(15, 30_000).map(|v| {
        let ours = codec.error_deg(v);
        let best = (32704..=32767)
            .map(|k| best_fit::error_at_length(widen(v), f64::from(k)))
            .fold(f64::INFINITY, f64::min);
        assert!(ours <= best + CHOICE_ROUNDING_16, "{v:?}: {ours} {best}");
        ours - best
    }));
    println!("snorm16x3p over the best of 64: {excess:?}");
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

/// No direction, of 64 in each cell, is further off than [`SnormBest8::MAX_ERROR_DEG`] allows, by 5 %: the most that
/// half a diagonal at a length of 127 can be. Cells around the axes have 32 times as many along each side.
#[test]
fn largest_error_over_all_cells() {
    let table = table();
    let limit = (0.5f64.sqrt() / 127.0).to_degrees() + CHOICE_ROUNDING_8;
    assert!(f64::from(SnormBest8::MAX_ERROR_DEG) > 1.05 * limit);
    let check = |parts: [u32; 2], steps: f64| {
        let [y, z] = parts.map(|t| ((f64::from(t) + 0.5) / (steps * CELLS)) as f32);
        let v = Vec3::new(y, z, 1.0);
        let error = code_error(v, SnormBest8::encode_by_table(v, &table));
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
        let [bfn, best4] = by_table.map(|code| code_error(v, code));
        let nearest = code_error(v, SnormNearest8::encode(v));
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
    let vectors = special_vectors().into_iter().map(Vec3::from_array).chain(sphere(21, 20_000));
    for v in vectors {
        for table in [&table[..], &random, &table[..1000], &[]] {
            check_code(v, SnormBest8::encode_by_table(v, table), bound);
            check_code(v, CrytekBfn24::encode_by_table(v, table), bound);
        }
    }
}

/// Asserts the contract of encoding for a code of 8 bits a component: three integers of which not all are 0, with the least
/// pattern not written, within `max_error` degrees; +Z's without a usable direction.
fn check_code(v: Vec3, code: u32, max_error: f64) {
    let integers = best_fit::integers(code.into(), 8);
    assert!(
        code >> 24 == 0 && integers != [0; 3] && integers.iter().all(|&t| t.abs() <= 127),
        "{v:?}: {integers:?}"
    );
    let (is_z, error) = (integers[0] == 0 && integers[1] == 0 && integers[2] > 0, code_error(v, code));
    match usable(v) {
        Some(false) => assert!(is_z, "{v:?} has no direction but {integers:?}"),
        Some(true) => assert!(error <= max_error, "{v:?} gets {integers:?}, {error} degrees off"),
        None => assert!(is_z || error <= max_error, "{v:?} gets {integers:?}, {error} degrees off"),
    }
}

/// Layout: x lowest, two's complement; the pattern that encoding never writes counts as -1.
#[test]
fn layout() {
    assert_eq!(SnormNearest8::encode(Vec3::new(127.0, -1.0, 2.0)), 0x02_ff_7f);
    assert_eq!(SnormBest8::encode(Vec3::NAN), 0x7f_00_00);
    assert_eq!(SnormBest16::encode(Vec3::NEG_Y), [0x8001_0000, 0]);
    assert_eq!(SnormBest16::encode(Vec3::ZERO), [0, 0x7fff]);
    assert_eq!(SnormBest8::decode_vec3(0x80_81_80), Vec3::NEG_ONE);
    assert_eq!(SnormBest16::decode_vec3([0x8000_8001, 0x8000]), Vec3::NEG_ONE);
    assert_eq!(SnormBest8::decode_vec3(0), Vec3::ZERO);
}
