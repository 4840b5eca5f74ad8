//! The octahedral codecs of up to 32 bits: ties, nearest codes of the precise encoders, layout.

use glam::Vec3;
use unitvec::oct::OctPrecise;
use unitvec::{Codec, Oct16, Oct20, Oct22, Oct24, Oct32};
use unitvec_oracle::{Oct, Oracle, angle_deg, largest, oct, turn_deg};
use unitvec_tests::checks::{POSITION_ROUNDING, assert_commutes, assert_nearest};
use unitvec_tests::directions::{near_planes, sphere};
use unitvec_tests::expected::MIRROR_Z;
use unitvec_tests::tested::{Tested, narrow, widen};

/// The codecs of the fast or the precise encoder.
fn codecs(precise: bool) -> impl Iterator<Item = Tested> {
    Tested::family("oct").into_iter().filter(move |codec| codec.is_precise() == precise)
}

/// A direction mirrored at z = 0 comes back from the fast encoders as the image, except within 2^-21 of a tie: ties
/// round away from the middle of the square, +Z, on both halves of the octahedron.
#[test]
fn symmetric_in_z_up_to_ties() {
    for codec in codecs(false) {
        let directions = sphere(7, 200_000).chain(near_planes(8, 50_000));
        assert_commutes(&codec, directions.filter(|&v| !is_tie(v, codec.bits)), &[MIRROR_Z]);
    }
}

/// The precise encoders give 10^5 directions and those near the coordinate planes the code of the oracle's search.
#[test]
fn encodes_to_the_nearest() {
    for codec in codecs(true) {
        let nearest = |v| oct::nearest_in_neighbourhood(v, codec.bits);
        let error = |v, code| error_deg(v, code, codec.bits);
        for directions in [sphere(10, 100_000).collect::<Vec<_>>(), near_planes(11, 50_000).collect()] {
            assert_nearest(&codec, directions.into_iter(), nearest, error, encoder_rounding_deg());
        }
    }
}

/// True where a coordinate of `v` on the lattice is within `f32` rounding of a half.
fn is_tie(v: Vec3, bits: u32) -> bool {
    let m = largest(bits);
    Oct::position(widen(v)).iter().any(|t| ((t * m).abs().fract() - 0.5).abs() <= m * POSITION_ROUNDING)
}

/// The error that the rounding of the position in `f32` can add to a precise encoder's choice over any other: the
/// chosen code is the best one for a direction that much off, so it adds to the one's angle and takes from the other's.
fn encoder_rounding_deg() -> f64 {
    2.0 * turn_deg(POSITION_ROUNDING)
}

/// The angle in degrees between `v` and the oracle's direction of `code`: the error of the encoder's choice alone.
fn error_deg(v: [f64; 3], code: u64, bits: u32) -> f64 {
    angle_deg(v, Oct::decode(code, bits))
}

/// Precise is the nearest of all codes at 16 bits and below, listed or not, for 8000 directions, half of them near coordinate
/// planes. The oracle's shorter search, on which `encodes_to_the_nearest` relies for more directions, finds as near a one.
#[test]
fn precise_is_the_nearest_of_all() {
    fn check<const BITS: u32>()
    where
        OctPrecise<BITS>: Codec<Code = u32>,
    {
        let all = oct::all_directions(BITS);
        for v in sphere(19, 4000).chain(near_planes(20, 4000)).map(widen) {
            let ours = u64::from(OctPrecise::<BITS>::encode(narrow(v)));
            let codes = [ours, oct::nearest_of_all(v, &all), oct::nearest_in_neighbourhood(v, BITS)];
            let [ours, best, near] = codes.map(|code| error_deg(v, code, BITS));
            let is_nearest = ours - best <= encoder_rounding_deg() && (near - best).abs() < 1e-9;
            assert!(is_nearest, "{BITS} bits: {v:?}: {codes:x?}, {ours}, {best} and {near}");
        }
    }
    check::<4>();
    check::<6>();
    check::<8>();
    check::<10>();
    check::<12>();
    check::<14>();
    check::<16>();
}

/// A pair of snorm12 integers is packed in three bytes as listings 4 and 5 both do, and unpacked as they do: all 4095^2
/// pairs, encoded from their directions. Pairs on the square's border can come back as their mirror image.
#[test]
fn oct24_has_the_bytes_of_listings_4_and_5() {
    for x in -2047i64..=2047 {
        for y in -2047i64..=2047 {
            let values = [x, y].map(|i| (i as f64 / 2047.0) as f32);
            let bytes = oct::snorm12x2_to_unorm8x3_slow([x, y]);
            assert_eq!(oct::snorm12x2_to_unorm8x3(values), bytes.map(f32::from), "listing 5, {x} {y}");

            let listing5 = oct::unorm8x3_to_snorm12x2(bytes.map(f32::from));
            assert!((0..2).all(|i| (listing5[i] - values[i]).abs() <= f32::EPSILON), "listing 5, {bytes:?}");

            let code = oct::code(bytes);
            let encoded = Oct24::encode(narrow(Oct::decode(code, 24)));
            if x.abs().max(y.abs()) < 2047 {
                assert_eq!(oct::bytes(encoded.into()), bytes, "{x} {y}");
            } else {
                assert_eq!(Oct24::decode_vec3(encoded), Oct24::decode_vec3(code as u32), "{x} {y}");
            }
        }
    }
}

/// The patterns that encoding never writes: a snorm's least integer is -1, and the biased 4095 of oct24 is +1.
#[test]
fn spare_patterns_are_ones() {
    assert_eq!(Oct16::decode_vec3(0x0080), Vec3::NEG_X);
    assert_eq!(Oct16::decode_vec3(0x8000), Vec3::NEG_Y);
    assert_eq!(Oct20::decode_vec3(1 << 9), Vec3::NEG_X);
    assert_eq!(Oct22::decode_vec3(1 << 21), Vec3::NEG_Y);
    assert_eq!(Oct32::decode_vec3(0x8000), Vec3::NEG_X);
    assert_eq!(Oct32::decode_vec3(0x8000_8000), Vec3::NEG_Z);
    // The digits of u and v in hexadecimal, 7ff for 0 and fff for the spare pattern of +1, come one after the other.
    assert_eq!(Oct24::decode_vec3(oct::code([0xff, 0xf7, 0xff]) as u32), Vec3::X);
    assert_eq!(Oct24::decode_vec3(oct::code([0x7f, 0xff, 0xff]) as u32), Vec3::Y);
}
