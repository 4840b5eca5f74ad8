//! The functions of floats take any floats: their results in an snorm format decode to the direction, or to +Z.

use super::evaluate;
use super::names::OF_FLOATS;
use glam::Vec3;
use unitvec::arith::snorm_max;
use unitvec_oracle::{join_halves, length};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::checks::{LENGTH_ROUNDING, assert_is_code_of};
use unitvec_tests::directions::{Rng, any_vector, near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// The integers that hardware may store for a float in an snorm format: clamped and scaled, as a float or exactly, it
/// is rounded to nearest, and nothing specifies how ties are broken.
fn stored(x: f32, bits: u32) -> [i64; 4] {
    let m = snorm_max(bits);
    let clamped = if x.is_nan() { 0.0 } else { x.clamp(-1.0, 1.0) };
    let (rounded, exact) = (f64::from(clamped * m), f64::from(clamped) * f64::from(m));
    [rounded.round(), rounded.round_ties_even(), exact.round(), exact.round_ties_even()].map(|x| x as i64)
}

/// The code of two components of half of `bits`, rounded in one of the ways of [`stored`].
fn stored_codes([x, y, _]: [f32; 3], bits: u32) -> [u64; 4] {
    let (x, y) = (stored(x, bits / 2), stored(y, bits / 2));
    [0, 1, 2, 3].map(|way| join_halves([x[way], y[way]], bits))
}

/// Vectors of all kinds: special ones, any bits, and directions all over the sphere.
pub fn vectors() -> Vec<[f32; 3]> {
    let mut rng = Rng::new(5);
    let any = (0..60_000).map(|n| any_vector(&mut rng, n % 2 == 0).to_array()).collect();
    let directions = sphere(6, 20_000).chain(near_planes(7, 20_000)).map(|v| v.to_array()).collect();
    [special_vectors(), any, directions].concat()
}

/// Clarberg's map, rounded in both components, by up to a ring and half a place: most at the equator and next to x = 0
/// or y = 0, `sqrt(4 + pi^2 / 16) / m`. The codec's bound has 1.5026.
const EAOCT: f64 = 2.1488 / 1.5026;

/// A function that encodes, the codec whose decoder takes the result, and its error as a part of the codec's bound.
const ENCODERS: [(&str, &str, f64); 10] = [
    ("float32x3_to_oct(v)", "oct16", 1.0),
    ("float32x3_to_oct(v)", "oct32", 1.0),
    ("float32x3_to_octn_precise(v, 16)", "oct16p", 1.0),
    ("float32x3_to_octn_precise(v, 32)", "oct32p", 1.0),
    ("float32x3_to_hemioct(v)", "hemioct16", 1.0),
    ("float32x3_to_hemioct(v)", "hemioct32", 1.0),
    ("float32x3_to_eaoct(v)", "eaoct16", EAOCT),
    ("float32x3_to_eaoct(v)", "eaoct32", EAOCT),
    ("float32x3_to_eaoctn_precise(v, 16)", "eaoct16p", 1.0),
    ("float32x3_to_eaoctn_precise(v, 32)", "eaoct32p", 1.0),
];

/// Functions do as the codecs do: +Z's code without a direction, an error within the bound with one.
#[test]
fn any_vector_is_stored_as_its_direction() {
    let inputs = vectors();
    for (function, id, part) in ENCODERS {
        let codec = Tested::find(id);
        let bound = part * f64::from(codec.max_error_deg());
        for (input, pair) in inputs.iter().zip(evaluate(&format!("vec3({function}, 0.0)"), &inputs)) {
            assert!(
                pair.iter().all(|c| c.abs() <= 1.0 + 2.0 * f32::EPSILON),
                "{function} of {input:?}: {pair:?}"
            );
            for code in stored_codes(pair, codec.bits) {
                assert_is_code_of(&codec, Vec3::from_array(*input), code, bound);
            }
        }
    }
}

/// A pair, as the decoders take it: clamped to the square, or its middle where a component is NaN.
fn clamped([x, y, _]: [f32; 3]) -> [f64; 2] {
    if x.is_nan() || y.is_nan() { [0.0; 2] } else { [x, y].map(|c| f64::from(c).clamp(-1.0, 1.0)) }
}

/// Pairs of all kinds: of special floats, of any bits, from all over the square and from next to its border, as linear
/// filtering gives them.
pub fn pairs() -> Vec<[f32; 3]> {
    let above_1 = 1.0 + f32::EPSILON;
    let tiny = [0.0, f32::from_bits(1), 1e-40, f32::MIN_POSITIVE, 1e-20, 6e-8];
    let large =
        [1.0 / 3.0, 0.5, 1.0 - f32::EPSILON, 1.0, above_1, 2.0, 1e20, f32::MAX, f32::INFINITY, f32::NAN];
    let special: Vec<f32> = tiny.into_iter().chain(large).flat_map(|x| [x, -x]).collect();
    let mut pairs: Vec<[f32; 3]> =
        special.iter().flat_map(|&x| special.iter().map(move |&y| [x, y, 0.0])).collect();
    let mut rng = Rng::new(8);
    for _ in 0..40_000 {
        let [x, y] = [(); 2].map(|()| rng.range(-1.0, 1.0) as f32);
        let side = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
        pairs.extend([[x, y, 0.0], [x, side, 0.0], [side, y, 0.0], [x, side - side * x.abs(), 0.0]]);
        pairs.push([(); 3].map(|()| f32::from_bits(rng.bits() as u32)));
    }
    pairs
}

/// Listing 2 in `f64`.
fn listing_2(e: [f64; 2]) -> [f64; 3] {
    let [u, v] = e;
    let z = 1.0 - u.abs() - v.abs();
    let fold = |a: f64, b: f64| if z < 0.0 { (1.0 - b.abs()).copysign(a) } else { a };
    [fold(u, v), fold(v, u), z]
}

/// Listing 6 in `f64`.
fn listing_6([u, v]: [f64; 2]) -> [f64; 3] {
    [u + v, u - v, 2.0 - (u + v).abs() - (u - v).abs()]
}

/// Clarberg's map in `f64`: r and the angle are linear in the octant.
fn clarberg([u, v]: [f64; 2]) -> [f64; 3] {
    let (a, b) = (u.abs(), v.abs());
    let below = a + b > 1.0;
    let r = if below { 2.0 - a - b } else { a + b };
    let along = if below { 1.0 - a } else { b };
    let angle = if r > 0.0 { along / r * std::f64::consts::FRAC_PI_2 } else { 0.0 };
    let (z, horizontal) = (1.0 - r * r, r * (2.0 - r * r).sqrt());
    let (x, y) = (horizontal * angle.cos(), horizontal * angle.sin());
    [x.copysign(u), y.copysign(v), if below { -z } else { z }]
}

/// A decoder in `f64`, before the normalisation.
type Listing = fn([f64; 2]) -> [f64; 3];

/// A function that decodes, and its listing.
const DECODERS: [(&str, Listing); 3] = [
    ("oct_to_float32x3(v.xy)", listing_2),
    ("hemioct_to_float32x3(v.xy)", listing_6),
    ("eaoct_to_float32x3(v.xy)", clarberg),
];

/// A unit vector, that of [`clamped`].
#[test]
fn any_pair_decodes_to_a_unit_vector() {
    let inputs = pairs();
    for (function, reference) in DECODERS {
        for (input, decoded) in inputs.iter().zip(evaluate(function, &inputs)) {
            let expected = unitvec_oracle::normalize(reference(clamped(*input)));
            let decoded = widen(Vec3::from_array(decoded));
            let is_unit = (length(decoded) - 1.0).abs() <= LENGTH_ROUNDING;
            let is_near = expected.iter().zip(decoded).all(|(a, b)| (a - b).abs() <= 1e-6);
            assert!(is_unit && is_near, "{function} of {input:?}: {decoded:?}, expected {expected:?}");
            assert!(
                !function.starts_with("hemioct") || decoded[2] >= 0.0,
                "{function} of {input:?}: {decoded:?}"
            );
        }
    }
}

const TO_BYTES: &str = "snorm12x2_to_unorm8x3(v.xy) * 255.0";
const FROM_BYTES: &str = "vec3(unorm8x3_to_snorm12x2(v), 0.0)";

/// Listing 5 of any floats: bytes of the clamped pair, and the pair of clamped bytes, +Z's for NaN.
#[test]
fn any_floats_are_packed_in_bytes() {
    let inputs = pairs();
    for (input, bytes) in inputs.iter().zip(evaluate(TO_BYTES, &inputs)) {
        let [u, v] = clamped(*input).map(|x| x * 2047.0 + 2047.0);
        let packed = f64::from(bytes[0]) * 65536.0 + f64::from(bytes[1]) * 256.0 + f64::from(bytes[2]);
        let near = [(packed / 4096.0).floor() - u, packed.rem_euclid(4096.0) - v];
        let are_bytes =
            bytes.iter().all(|byte| (byte - byte.round()).abs() < 1e-3 && (0.0..255.5).contains(byte));
        assert!(are_bytes && near.iter().all(|off| off.abs() <= 0.501), "{input:?}: {bytes:?}");
    }
    for (input, pair) in inputs.iter().zip(evaluate(FROM_BYTES, &inputs)) {
        let byte = |x: f32| (f64::from(x).clamp(0.0, 1.0) * 255.0 + 0.5).floor();
        let packed = byte(input[0]) * 65536.0 + byte(input[1]) * 256.0 + byte(input[2]);
        let pair_of_bytes = [(packed / 4096.0).floor(), packed.rem_euclid(4096.0)];
        let has_nan = input.iter().any(|c| c.is_nan());
        let expected =
            if has_nan { [0.0; 2] } else { pair_of_bytes.map(|u| ((u - 2047.0) / 2047.0).min(1.0)) };
        let is_near = [0, 1].iter().all(|&i| (f64::from(pair[i]) - expected[i]).abs() < 1e-6);
        assert!(is_near, "{input:?}: {pair:?}, expected {expected:?}");
    }
}

/// The number of codes in an attachment of `codec`'s format that differ from the codec's, however the hardware rounds,
/// and whether all that do are a step off.
fn differing(function: &str, codec: &Tested, inputs: &[[f32; 3]]) -> (usize, bool) {
    let (mut count, mut is_a_step) = (0, true);
    for (input, pair) in inputs.iter().zip(evaluate(&format!("vec3({function}, 0.0)"), inputs)) {
        let code = codec.encode(Vec3::from_array(*input));
        let off: Vec<u64> = stored_codes(pair, codec.bits).into_iter().filter(|c| *c != code).collect();
        count += usize::from(!off.is_empty());
        is_a_step &= off.iter().all(|other| steps_between(code, *other, codec.bits) == 1);
    }
    (count, is_a_step)
}

/// The most steps that two codes are apart in a component.
fn steps_between(a: u64, b: u64, bits: u32) -> i64 {
    let [a, b] = [a, b].map(|code| unitvec_oracle::split_halves(code, bits));
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// The claim at the head of oct.glsl: the precise function stores the precise code, exactly. All codes of 16 bits, and
/// 2^18 directions in 32.
#[test]
fn float32x3_to_octn_precise_is_exact_through_an_attachment() {
    let codec = Tested::find("oct16p");
    let decoded: Vec<[f32; 3]> = (0..1 << 16).map(|code| codec.decode(code).to_array()).collect();
    assert_eq!(differing("float32x3_to_octn_precise(v, 16)", &codec, &decoded).0, 0);
    let directions: Vec<[f32; 3]> = sphere(9, 1 << 18).map(|v| v.to_array()).collect();
    for (function, id) in [
        ("float32x3_to_octn_precise(v, 16)", "oct16p"),
        ("float32x3_to_octn_precise(v, 32)", "oct32p"),
        ("float32x3_to_eaoctn_precise(v, 16)", "eaoct16p"),
        ("float32x3_to_eaoctn_precise(v, 32)", "eaoct32p"),
    ] {
        assert_eq!(differing(function, &Tested::find(id), &directions).0, 0, "{function}");
    }
}

/// The fast one rounds twice, in the projection and in the hardware: 3 codes in 1000 of 32 bits are a step off, if each is
/// rounded in the worst way.
#[test]
fn float32x3_to_oct_is_a_step_off_at_most() {
    let directions: Vec<[f32; 3]> = sphere(10, 1 << 18).map(|v| v.to_array()).collect();
    let (count, is_a_step) = differing("float32x3_to_oct(v)", &Tested::find("oct32"), &directions);
    let in_1000 = 1000.0 * count as f64 / directions.len() as f64;
    assert!(
        is_a_step && (2.5..3.5).contains(&in_1000),
        "{count} codes differ, by more than a step: {}",
        !is_a_step
    );
}

/// No public function of floats goes untested here.
#[test]
fn every_function_of_floats_is_tested() {
    let encoders = ENCODERS.iter().map(|(call, _, _)| *call);
    let tested: Vec<&str> =
        encoders.chain(DECODERS.map(|(call, _)| call)).chain([TO_BYTES, FROM_BYTES]).collect();
    // projections.rs has the bytes as integers.
    for (file, name) in OF_FLOATS.iter().filter(|(_, name)| !name.contains("uint8")) {
        assert!(tested.iter().any(|call| call.contains(&format!("{name}("))), "{name} of {file}");
    }
}
