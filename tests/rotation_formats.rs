//! Rotations in the formats of other software: nearest codes, published values and errors.

use unitvec::interop::{ROTATIONS, RotationFormat, UnknownFormat};
use unitvec::rotation_angle_deg;
use unitvec_catalogue::find_any;
use unitvec_oracle::Summary;
use unitvec_tests::directions::Rng;

/// A point of the 3-sphere, uniform, by the angles of two circles (Shoemake, Graphics Gems III).
fn rotation(rng: &mut Rng) -> [f32; 4] {
    let (part, [first, second]) = (rng.unit(), [(); 2].map(|()| rng.range(0.0, std::f64::consts::TAU)));
    let [inner, outer] = [(1.0 - part).sqrt(), part.sqrt()];
    [inner * first.sin(), inner * first.cos(), outer * second.sin(), outer * second.cos()].map(|c| c as f32)
}

/// Random rotations, among them some with components that are equal or near 0, where charts meet.
fn rotations(seed: u64, count: usize) -> impl Iterator<Item = [f32; 4]> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |i| {
        let (mut q, choice) = (rotation(&mut rng), rng.bits());
        let [from, to] = [choice >> 8, choice >> 16].map(|bits| bits as usize & 3);
        if i % 2 == 0 {
            q[to] = q[from] * [1.0, 1e-3][i / 2 % 2];
        }
        q
    })
}

fn named(name: &str) -> RotationFormat {
    RotationFormat::named(name).unwrap()
}

/// The rotation that comes back.
fn back(format: RotationFormat, q: [f32; 4]) -> [f32; 4] {
    format.decode(format.encode(q))
}

fn error(format: RotationFormat, q: [f32; 4]) -> f64 {
    rotation_angle_deg(q, back(format, q))
}

fn off_unit(q: &[f32; 4]) -> f64 {
    (q.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt() - 1.0).abs()
}

/// No code of unit length is nearer, in any chart, by trial of all codes of the least widths.
#[test]
fn no_code_is_nearer() {
    // Words from -7 to 7, and the largest with an index.
    let word = |i: u64, lane: u32| (i / 15u64.pow(lane) % 15).wrapping_sub(7) & 0xffff;
    let words = |i| word(i, 0) | word(i, 1) << 16 | word(i, 2) << 32 | (4 + i / 15u64.pow(3)) << 48;
    let lanes: Vec<u64> = (0..4 * 15u64.pow(3)).map(words).collect();
    for (name, codes) in [("smallest3:4", (0..1 << 14).collect()), ("meshopt-quat:4", lanes)] {
        let format = named(name);
        let all = codes.iter().map(|code| format.decode(*code));
        let all: Vec<[f32; 4]> = all.filter(|q| off_unit(q) < 4e-5).collect();
        for q in rotations(1, 300) {
            let best = all.iter().map(|other| rotation_angle_deg(q, *other)).fold(f64::INFINITY, f64::min);
            assert!(error(format, q) <= best + 1e-9, "{format}: {q:?}: {best}");
        }
    }
}

/// The error is within the bound, and no code of a rotation nearby is nearer, plain or not.
#[test]
fn the_nearest_is_within_its_bound_and_beats_those_around() {
    let mut rng = Rng::new(2);
    for format in RotationFormat::all() {
        let bound = f64::from(format.max_error_deg());
        for q in rotations(3, 400) {
            let [nearest, plain] = [format, format.plain()].map(|format| error(format, q));
            assert!(nearest <= bound && nearest <= plain + 1e-9, "{format}: {q:?}: {nearest} and {plain}");
        }
        for (i, q) in rotations(4, 20).flat_map(|q| std::iter::repeat_n(q, 200)).enumerate() {
            let beside = q.map(|c| c + rng.range(-1.0, 1.0) as f32 * bound.to_radians() as f32);
            let other = back(if i % 2 == 0 { format } else { format.plain() }, beside);
            // Plain codes of components may be too long for glTF's validator.
            let is_nearer =
                off_unit(&other) < 0.0076 && rotation_angle_deg(q, other) < error(format, q) - 1e-9;
            assert!(!is_nearer, "{format}: {q:?}: {beside:?}");
        }
    }
}

/// Codes come back; q and -q are one rotation, of any length; what is no rotation gets the code of the identity.
#[test]
fn all_inputs_have_codes_that_come_back() {
    // To the precision of f32, in which some neighbours are one.
    let are_same = |a, b| rotation_angle_deg(a, b) <= 2e-5;
    for format in RotationFormat::all() {
        for q in [[0.0; 4], [f32::NAN, 0.0, 0.0, 1.0], [f32::INFINITY; 4]] {
            for format in [format, format.plain()] {
                assert_eq!(format.encode(q), format.encode([0.0, 0.0, 0.0, 1.0]), "{format}: {q:?}");
            }
        }
        let all: Vec<_> = rotations(5, 60).collect();
        for q in all.iter().copied() {
            let (code, decoded) = (format.encode(q), back(format, q));
            assert!(format.bits() == 64 || code >> format.bits() == 0, "{format}: {code:x}");
            for scale in [-1.0, 2f32.powi(-120), 2f32.powi(120)] {
                let other = q.map(|c| c * scale);
                assert!(are_same(decoded, back(format, other)), "{format}: {q:?}");
                assert!(back(format.plain(), other).iter().all(|c| c.is_finite()), "{format}: {q:?}");
            }
            assert!(are_same(decoded, back(format, decoded)), "{format}: {q:?}");
        }
        let (mut codes, mut decoded) = (vec![0; all.len() * format.bytes()], vec![[0.0; 4]; all.len()]);
        format.encode_slice(&all, &mut codes).unwrap();
        format.decode_slice(&codes, &mut decoded).unwrap();
        assert!(all.iter().zip(&decoded).all(|(q, decoded)| *decoded == back(format, *q)));
        assert!(format.encode_slice(&all, &mut codes[1..]).is_err());
    }
}

/// Values of meshoptimizer's demo/tests.cpp; identities and quarter turns by the formulas of the others.
#[test]
fn published_values() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let encoded = [
        ("meshopt-quat:12", [1.0, 0.0, 0.0, 0.0], 0x07fc_0000_0000_0000),
        ("meshopt-quat:12", [0.0, -1.0, 0.0, 0.0], 0x07fd_0000_0000_0000),
        ("meshopt-quat:12", [half, 0.0, 0.0, 0.707_168], 0x07ff_0000_0000_07ff),
        ("meshopt-quat:12", [-half, 0.0, 0.0, -0.707_168], 0x07ff_0000_0000_07ff),
        ("spz", [0.0, 0.0, 0.0, 1.0], 0xc000_0000),
        ("spz", [0.0, -0.6, 0.0, -0.8], 3 << 30 | 512 << 20 | 434 << 10 | 512),
        ("spz2", [0.0, 0.0, 0.0, -1.0], 0x80_8080),
        ("sog", [0.0, 0.0, 0.0, 1.0], 0xfc7f_7f7f),
        ("playcanvas-ply", [0.0, 0.0, 0.0, 1.0], 512 << 20 | 512 << 10 | 512),
        ("quat10x3", [0.0, 0.0, 0.0, 1.0], 3 << 30 | 511 << 20 | 511 << 10 | 511),
        ("gltf-quat8", [0.0, 0.0, 0.0, -1.0], 0x8100_0000),
    ];
    for (name, q, code) in encoded {
        assert_eq!(named(name).plain().encode(q), code, "{name}: {q:?}");
    }
    let decoded = [
        (0x07fc_0000_0001_0000, [32767, 0, 11, 0]),
        (0x07fd_0000_074e_0000, [0, 25013, 0, 21166]),
        (0x07fe_0000_0001_07e1, [11, 0, 23504, 22830]),
        (0x07ff_0000_0514_000e, [158, 14715, 0, 29277]),
    ];
    for (code, q) in decoded {
        let found = named("meshopt-quat:12").decode(code);
        assert_eq!(found, q.map(|c: i32| c as f32 / 32_767.0), "{code:x}");
    }
}

/// Mean errors of uniform rotations. Rounding has those that others found, to 1 %, and no more than 2 sqrt(3) steps, where
/// all components are equal. SPZ's authors measured 1.8 million splats, whose rotations are not uniform. The nearest code of
/// all charts is nearer than the best corner of the cell, for `spz2` nearer than what a search of SPZ's found (spz#36).
#[test]
fn published_errors() {
    let mut rng = Rng::new(6);
    let all: Vec<_> = (0..1 << 18).map(|_| rotation(&mut rng)).collect();
    let published = [
        ("smallest3:8", 1 << 18, 0.338, 0.01, 0.332),
        ("smallest3:10", 1 << 18, 0.0844, 0.01, 0.0829),
        ("smallest3:12", 1 << 18, 0.0211, 0.01, 0.0207),
        ("spz", 1 << 18, 0.0824, 0.03, 0.0829),
        ("spz2", 1 << 14, 1.073, 0.06, 0.773),
    ];
    for (name, count, rounded, deviation, searched) in published {
        let format = named(name);
        let summary = |format| Summary::of(all[..count].iter().map(|q| error(format, *q)));
        let [plain, nearest] = [format.plain(), format].map(summary);
        assert!((plain.mean / rounded - 1.0).abs() < deviation, "{format}: {plain:?}");
        let step = 2f64.sqrt() / f64::from((1 << format.component_bits) - 2);
        let farthest = (2.0 * 3f64.sqrt() * step).to_degrees();
        assert!(plain.max <= farthest || name == "spz2", "{format}: {plain:?}");
        let bound = f64::from(format.max_error_deg());
        assert!(nearest.mean < 0.97 * searched && nearest.max <= bound, "{format}: {nearest:?}");
        assert!(nearest.mean < 0.95 * plain.mean && nearest.max < 0.7 * plain.max, "{format}: {nearest:?}");
    }
}

/// What the original makes of a snapped rotation is never farther off than what it makes of the rotation, and nearer in the mean:
/// half as far where it truncates.
#[test]
fn snapped_rotations_are_written_nearer() {
    let mut rng = Rng::new(46);
    for format in RotationFormat::all() {
        let (codec, mut sums) = (find_any(&format.to_string()).unwrap(), [0.0; 2]);
        for q in (0..1000).map(|_| rotation(&mut rng)) {
            let written = |from: [f32; 4]| back(format.plain(), from);
            let [before, after] = [q, codec.snapped(q)].map(|from| rotation_angle_deg(q, written(from)));
            assert!(after <= before, "{format}: {q:?}: {after} and {before}");
            sums = [sums[0] + before, sums[1] + after];
        }
        let part = if ["sog", "quat10x3"].contains(&format.name) { 0.55 } else { 0.99 };
        assert!(sums[1] < part * sums[0], "{format}: {sums:?}");
    }
}

#[test]
fn names_are_found_and_others_explained() {
    for format in RotationFormat::all() {
        assert_eq!(RotationFormat::named(&format.to_string()), Ok(format));
    }
    let width = |name| matches!(RotationFormat::named(name), Err(UnknownFormat::Bits { .. }));
    assert!(["smallest3", "smallest3:3", "meshopt-quat:17", "spz:10", "sog:"].into_iter().all(width));
    let unknown = RotationFormat::named("quat").unwrap_err().to_string();
    assert!(ROTATIONS.iter().all(|format| unknown.contains(format.name)), "{unknown}");
}
