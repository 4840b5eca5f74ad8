//! The dithered functions: GLSL has Rust's bits, offset 0 is the plain codec, and the precise encoders take the nearest corner.

use super::floats::vectors;
use super::{assert_same_bits, assert_same_words};
use std::collections::BTreeSet;
use unitvec::dither::*;
use unitvec::glam::{UVec2, Vec2, Vec3};
use unitvec_catalogue::{CODECS, Dither};
use unitvec_oracle::{angle_deg, length, normalize};
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{Rng, near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// A codec's dithered functions. Codes are two words.
pub struct Case {
    pub id: &'static str,
    words: usize,
    pub encode: fn(Vec3, Vec2) -> [u32; 2],
    pub decode: fn([u32; 2], Vec2) -> Vec3,
}

/// The cases of all codecs that have them in the catalogue.
pub fn cases() -> Vec<Case> {
    let all = CODECS.iter().filter_map(|codec| codec.dither().ok());
    all.map(|Dither { codec, encode_one, decode_one }| Case {
        id: codec.id,
        words: if codec.bits > 32 { 2 } else { 1 },
        encode: encode_one,
        decode: decode_one,
    })
    .collect()
}

/// The names of the public functions of dither.glsl.
pub fn functions() -> Vec<String> {
    let keys = ["key", "pixel", "texel", "position"].map(|key| format!("dither_from_{key}"));
    let of_codecs = cases()
        .into_iter()
        .flat_map(|case| ["encode", "decode"].map(|half| format!("{}_{half}_dithered", case.id)));
    keys.into_iter().chain(of_codecs).collect()
}

/// No codec of these families lacks them.
#[test]
fn all_widths_are_dithered() {
    let files = ["oct.glsl", "hemioct.glsl", "soct.glsl", "eaoct.glsl"];
    let expected: BTreeSet<&str> = CODECS
        .iter()
        .filter(|codec| files.contains(&codec.glsl_file().as_str()))
        .map(|codec| codec.id)
        .collect();
    assert_eq!(cases().iter().map(|case| case.id).collect::<BTreeSet<_>>(), expected);
}

/// An offset from three words: for even ones a hash, for odd ones any floats. In GLSL:
const OFFSET: &str = "((w.x & 1u) == 0u ? dither_from_key(w.x ^ (w.y * 3u) ^ (w.z * 5u)) : v.zx)";

fn offset(w: [u32; 3]) -> Vec2 {
    if w[0] & 1 == 0 {
        dither_from_key(w[0] ^ w[1].wrapping_mul(3) ^ w[2].wrapping_mul(5))
    } else {
        Vec2::new(f32::from_bits(w[2]), f32::from_bits(w[0]))
    }
}

/// Dithered codes agree for any vectors and codes, with offsets of all kinds.
#[test]
fn dithered_codes_in_glsl_have_the_bits_of_rust() {
    let inputs: Vec<[u32; 3]> = vectors().iter().step_by(5).map(|v| v.map(f32::to_bits)).collect();
    let mut rng = Rng::new(51);
    let codes: Vec<[u32; 3]> = (0..30_000).map(|_| [(); 3].map(|()| rng.bits() as u32)).collect();
    for group in cases().chunks(8) {
        let encode = group.iter().map(|case| {
            let rest = if case.words == 1 { ", 0u, 0u" } else { ", 0u" };
            let in_rust = |w: [u32; 3]| {
                let [low, high] = (case.encode)(Vec3::from_array(w.map(f32::from_bits)), offset(w));
                [low, high, 0]
            };
            (format!("uvec3({}_encode_dithered(v, {OFFSET}){rest})", case.id), in_rust)
        });
        assert_same_words(&encode.collect::<Vec<_>>(), &inputs);
        let decode = group.iter().map(|case| {
            let code = if case.words == 1 { "w.x" } else { "w.xy" };
            let in_rust = |w: [u32; 3]| (case.decode)([w[0], w[1]], offset(w)).to_array().map(f32::to_bits);
            (format!("floatBitsToUint({}_decode_dithered({code}, {OFFSET}))", case.id), in_rust)
        });
        assert_same_words(&decode.collect::<Vec<_>>(), &codes);
    }
}

/// An offset of the bits of three floats.
type OfBits = fn([f32; 3]) -> Vec2;

/// The keys agree for any keys, texels and positions.
#[test]
fn offsets_in_glsl_have_the_bits_of_rust() {
    let any = vectors();
    let texels: Vec<[f32; 3]> = (0..256).map(|n| [n as f32 / 255.0, (255 - n) as f32 / 255.0, 0.0]).collect();
    let of_texel: OfBits = |v| dither_from_texel(Vec2::new(v[0], v[1]));
    let of_any: [(&str, OfBits); 3] = [
        ("key(w.x)", |v| dither_from_key(v[0].to_bits())),
        ("pixel(w.xy)", |v| dither_from_pixel(UVec2::new(v[0].to_bits(), v[1].to_bits()))),
        ("position(v)", |v| dither_from_position(v.into())),
    ];
    let beside = |(call, in_rust): (&str, OfBits)| {
        (format!("vec3(dither_from_{call}, 0.0)"), move |v: [f32; 3]| in_rust(v).extend(0.0))
    };
    assert_same_bits(&of_any.map(beside), &any);
    assert_same_bits(&[beside(("texel(v.xy)", of_texel))], &texels);
    for (v, (call, in_rust)) in any.iter().flat_map(|v| of_any.iter().map(move |function| (v, function))) {
        assert!(in_rust(*v).abs().max_element() <= 0.5, "{call} of {v:?}: {}", in_rust(*v));
    }
    for (n, texel) in texels.iter().enumerate() {
        // The middles of 256 intervals.
        let offset = of_texel(*texel);
        assert!((f64::from(offset.x) - ((n as f64 + 0.5) / 256.0 - 0.5)).abs() < 1e-7, "{n}: {offset}");
    }
}

/// Zeros of both signs, and numbers that some devices flush to zero, are one position.
#[test]
fn positions_that_devices_flush_are_one() {
    let of = |x: f32| dither_from_position(Vec3::new(x, 1.0, x));
    assert_eq!([of(-0.0), of(1e-40), of(-1e-40)], [of(0.0); 3]);
}

/// Offset 0: the fast encoder's code and the codec's vector, of all vectors and codes; others decode to unit vectors.
#[test]
fn offset_0_is_the_plain_codec() {
    let mut rng = Rng::new(52);
    for case in cases() {
        let codec = Tested::find(case.id);
        let inputs = vectors().into_iter().step_by(3).map(Vec3::from_array);
        for v in inputs.filter(|_| !codec.is_precise()) {
            let [low, high] = (case.encode)(v, Vec2::ZERO);
            assert_eq!(u64::from(low) | u64::from(high) << 32, codec.encode(v), "{} of {v}", case.id);
        }
        for n in 0..70_000u32 {
            let code = if n < 1 << 16 { [n, n & 1] } else { [rng.bits() as u32, rng.bits() as u32] };
            let plain = codec.decode(u64::from(code[0]) | u64::from(code[1]) << 32);
            assert_eq!((case.decode)(code, Vec2::ZERO), plain, "{} of {code:x?}", case.id);
            let decoded = widen((case.decode)(code, dither_from_key(n)));
            assert!(
                (length(decoded) - 1.0).abs() <= 1.5 * LENGTH_ROUNDING,
                "{} of {code:x?}: {decoded:?}",
                case.id
            );
        }
    }
}

/// Directions all over the codec's domain.
fn directions(id: &str) -> impl Iterator<Item = Vec3> {
    let upper = id.starts_with("hemi");
    let all = sphere(53, 10_000).chain(near_planes(54, 10_000));
    all.map(move |v| if upper { Vec3::new(v.x, v.y, v.z.abs()) } else { v })
}

/// The result is off by at most the fast codec's error: half a lattice step each way, however it is moved. Next to the
/// poles of `eaoct`, whose ring 1 has only a point every quarter turn, it is up to 2.003 / m where the bound is 1.5026
/// / m.
#[test]
fn dithered_directions_come_back() {
    for case in cases() {
        let fast = Tested::find(case.id.trim_end_matches('p'));
        let bound = f64::from(fast.max_error_deg());
        let mut most = 0f64;
        for (n, v) in directions(case.id).enumerate() {
            let offset = dither_from_key(n as u32);
            let code = (case.encode)(v, offset);
            assert_ne!(Some(code), fast.null, "{}: a null code", case.id);
            let back = (case.decode)(code, offset);
            most = most.max(angle_deg(widen(back), normalize(widen(v))) / bound);
        }
        let allowed = if case.id.starts_with("eaoct") { 1.34 } else { 1.02 };
        assert!(most <= allowed, "{}: {most} of the bound", case.id);
    }
}

/// The precise encoders of `oct`: none of the codes around is nearer, as the decoder sees it with this offset. Two
/// rounded vectors of 32 bits resolve less than a hundredth of a step.
#[test]
fn precise_dithered_codes_are_the_nearest_of_their_cell() {
    for case in cases()
        .into_iter()
        .filter(|case| ["oct8p", "oct12p", "oct16p", "oct20p", "oct32p"].contains(&case.id))
    {
        let bits = Tested::find(case.id).bits;
        let m = unitvec::arith::snorm_max(bits / 2);
        for (n, v) in directions(case.id).enumerate() {
            let offset = dither_from_key(n as u32);
            let norm = v.x.abs() + v.y.abs() + v.z.abs();
            let at = (unitvec::oct::position(v, norm, m) + offset).clamp(Vec2::splat(-m), Vec2::splat(m));
            let exact = normalize(widen(v));
            let off = |code: u32| angle_deg(widen((case.decode)([code, 0], offset)), exact);
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|corner| {
                let e = (at.floor() + Vec2::from_array(corner)).min(Vec2::splat(m));
                off(unitvec::arith::nearest_pair(e, bits / 2))
            });
            let best = corners.into_iter().fold(f64::INFINITY, f64::min);
            let taken = off((case.encode)(v, offset)[0]);
            let rounding = 4e-5;
            assert!(taken <= best + rounding, "{} of {v}: {taken} degrees, {best}", case.id);
        }
    }
}
