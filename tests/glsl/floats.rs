//! The functions of floats take any floats: their results in an snorm format decode to the direction, or to +Z. The
//! functions here are Rust's; `projections.rs` shows that GLSL gives the same bits.

use unitvec::arith::snorm_max;
use unitvec::glam::{Vec2, Vec3};
use unitvec::{eaoct, hemioct, oct};
use unitvec_oracle::join_halves;
use unitvec_run::sampling::special_vectors;
use unitvec_tests::checks::assert_is_code_of;
use unitvec_tests::directions::{Rng, any_vector, near_planes, sphere};
use unitvec_tests::tested::Tested;

/// The integers that hardware may store for a float in an snorm format: clamped and scaled, as a float or exactly, it
/// is rounded to nearest, and nothing specifies how ties are broken.
fn stored(x: f32, bits: u32) -> [i64; 4] {
    let m = snorm_max(bits);
    let clamped = if x.is_nan() { 0.0 } else { x.clamp(-1.0, 1.0) };
    let (rounded, exact) = (f64::from(clamped * m), f64::from(clamped) * f64::from(m));
    [rounded.round(), rounded.round_ties_even(), exact.round(), exact.round_ties_even()].map(|x| x as i64)
}

/// The code of two components of half of `bits`, rounded in one of the ways of [`stored`].
fn stored_codes(pair: Vec2, bits: u32) -> [u64; 4] {
    let (x, y) = (stored(pair.x, bits / 2), stored(pair.y, bits / 2));
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

/// A function that encodes.
pub type Project = fn(Vec3) -> Vec2;

/// A function that encodes, the codec whose decoder takes the result, and its error as a part of the codec's bound.
const ENCODERS: [(Project, &str, f64); 12] = [
    (oct::project, "oct16", 1.0),
    (oct::project, "oct32", 1.0),
    (oct::project_precise::<16>, "oct16p", 1.0),
    (oct::project_precise::<32>, "oct32p", 1.0),
    (hemioct::project, "hemioct16", 1.0),
    (hemioct::project, "hemioct32", 1.0),
    (hemioct::project_precise::<16>, "hemioct16p", 1.0),
    (hemioct::project_precise::<32>, "hemioct32p", 1.0),
    (eaoct::project, "eaoct16", EAOCT),
    (eaoct::project, "eaoct32", EAOCT),
    (eaoct::project_precise::<16>, "eaoct16p", 1.0),
    (eaoct::project_precise::<32>, "eaoct32p", 1.0),
];

/// Functions do as the codecs do: +Z's code without a direction, an error within the bound with one.
#[test]
fn any_vector_is_stored_as_its_direction() {
    for (function, id, part) in ENCODERS {
        let codec = Tested::find(id);
        let bound = part * f64::from(codec.max_error_deg());
        for v in vectors().into_iter().map(Vec3::from_array) {
            let pair = function(v);
            let is_inside = pair.abs().max_element() <= 1.0 + 2.0 * f32::EPSILON;
            assert!(is_inside, "the function for {id} of {v}: {pair}");
            for code in stored_codes(pair, codec.bits) {
                assert_is_code_of(&codec, v, code, bound);
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

/// Listing 5 of any floats: bytes of the clamped pair, and the pair of clamped bytes, +Z's for NaN.
#[test]
fn any_floats_are_packed_in_bytes() {
    for input in pairs() {
        let bytes = oct::snorm12x2_to_unorm8x3(Vec2::new(input[0], input[1])).to_array().map(|x| x * 255.0);
        let [u, v] = clamped(input).map(|x| x * 2047.0 + 2047.0);
        let packed = f64::from(bytes[0]) * 65536.0 + f64::from(bytes[1]) * 256.0 + f64::from(bytes[2]);
        let near = [(packed / 4096.0).floor() - u, packed.rem_euclid(4096.0) - v];
        let are_bytes =
            bytes.iter().all(|byte| (byte - byte.round()).abs() < 1e-3 && (0.0..255.5).contains(byte));
        assert!(are_bytes && near.iter().all(|off| off.abs() <= 0.501), "{input:?}: {bytes:?}");

        let pair = oct::unorm8x3_to_snorm12x2(input.into());
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
fn differing(
    function: fn(Vec3) -> Vec2,
    codec: &Tested,
    inputs: impl Iterator<Item = Vec3>,
) -> (usize, bool) {
    let (mut count, mut is_a_step) = (0, true);
    for v in inputs {
        let code = codec.encode(v);
        let stored = stored_codes(function(v), codec.bits);
        count += usize::from(stored != [code; 4]);
        is_a_step &= stored.iter().all(|other| steps_between(code, *other, codec.bits) <= 1);
    }
    (count, is_a_step)
}

/// The most steps that two codes are apart in a component.
fn steps_between(a: u64, b: u64, bits: u32) -> i64 {
    let [a, b] = [a, b].map(|code| unitvec_oracle::split_halves(code, bits));
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// The claim at the head of oct.glsl: the precise function stores the precise code, exactly. All codes of 16 bits, and
/// 2^18 directions.
#[test]
fn float32x3_to_octn_precise_is_exact_through_an_attachment() {
    let codec = Tested::find("oct16p");
    let decoded = (0..1 << 16).map(|code| codec.decode(code));
    assert_eq!(differing(oct::project_precise::<16>, &codec, decoded).0, 0);
    for (function, id, _) in ENCODERS.into_iter().filter(|(_, id, _)| id.ends_with('p')) {
        assert_eq!(differing(function, &Tested::find(id), sphere(9, 1 << 18)).0, 0, "{id}");
    }
}

/// The fast one rounds twice, in the projection and in the hardware: 3 codes in 1000 of 32 bits are a step off, if each is
/// rounded in the worst way.
#[test]
fn float32x3_to_oct_is_a_step_off_at_most() {
    let (count, is_a_step) = differing(oct::project, &Tested::find("oct32"), sphere(10, 1 << 18));
    let in_1000 = 1000.0 * count as f64 / f64::from(1 << 18);
    assert!(is_a_step && (2.5..3.5).contains(&in_1000), "{count} codes differ, by a step: {is_a_step}");
}
