//! The octahedral codecs of unorms, and the nearest codes of hemi-oct.

use glam::Vec3;
use unitvec::uoct::{UOctPrecise, project_precise};
use unitvec::{Codec, HemiOct16, HemiOctPrecise16, UOctPrecise16, UOctPrecise20, UOctPrecise32, oct};
use unitvec_oracle::{HemiOct, Oracle, angle_deg, hemioct, turn_deg, uoct};
use unitvec_tests::checks::{POSITION_ROUNDING, assert_nearest};
use unitvec_tests::directions::{hemisphere, near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// The rounding of the position in `f32` may favour a code by so much.
fn slack() -> f64 {
    2.0 * turn_deg(POSITION_ROUNDING)
}

/// The encoders give 10^5 directions and those near the coordinate planes the code of the oracle's search.
#[test]
fn encodes_to_the_nearest() {
    for codec in Tested::family("uoct") {
        let error = |v, code| angle_deg(v, uoct::decode(code, codec.bits));
        for directions in [sphere(10, 100_000).collect::<Vec<_>>(), near_planes(11, 50_000).collect()] {
            assert_nearest(&codec, directions.into_iter(), |v| uoct::nearest(v, codec.bits), error, slack());
        }
    }
}

/// At 16 bits no code is nearer than the oracle's, on whose shorter search `encodes_to_the_nearest` relies.
#[test]
fn the_neighbourhood_has_the_nearest() {
    let all: Vec<_> = (0..1 << 16).map(|code| uoct::decode(code, 16)).collect();
    for v in sphere(12, 300).chain(near_planes(13, 300)).map(widen) {
        let best = all.iter().map(|other| angle_deg(v, *other)).fold(f64::INFINITY, f64::min);
        let near = angle_deg(v, uoct::decode(uoct::nearest(v, 16), 16));
        assert!(near - best < 1e-9, "{v:?}: {near} and {best}");
    }
}

/// The same for hemi-oct, whose nearest codes are no further off than its rounded ones.
#[test]
fn hemioct_encodes_to_the_nearest() {
    for codec in Tested::family("hemioct").into_iter().filter(Tested::is_precise) {
        let nearest = |v| hemioct::nearest_in_neighbourhood(v, codec.bits);
        let error = |v, code| angle_deg(HemiOct::domain(v), HemiOct::decode(code, codec.bits));
        let up = |v: Vec3| Vec3::new(v.x, v.y, v.z.abs());
        assert_nearest(&codec, hemisphere(14, 100_000), nearest, error, slack());
        assert_nearest(&codec, near_planes(15, 50_000).map(up), nearest, error, slack());
    }
    let errors = hemisphere(16, 200_000).map(|v| {
        let decoded = [
            HemiOctPrecise16::decode::<Vec3>(HemiOctPrecise16::encode(v)),
            HemiOct16::decode(HemiOct16::encode(v)),
        ];
        decoded.map(|decoded| unitvec::angle_deg(v, decoded))
    });
    let (mut sums, mut most) = ([0.0; 2], [0f64; 2]);
    for [precise, fast] in errors {
        assert!(precise <= fast + slack());
        sums = [sums[0] + precise, sums[1] + fast];
        most = [most[0].max(precise), most[1].max(fast)];
    }
    // Rounding misses the nearest code in less than one of ten, and not by much.
    assert!(sums[0] < 0.998 * sums[1], "{sums:?}");
    assert!((most[0] / most[1] - 1.0).abs() < 0.01, "{most:?}");
}

/// +Z is between four points, as far as the closed form says; X and Y are half a step from theirs; -Z is exact, and has one code
/// of four.
#[test]
fn axes() {
    for codec in Tested::family("uoct") {
        let of = |v: Vec3| {
            let code = codec.encode(v);
            (code, angle_deg(widen(v), uoct::decode(code, codec.bits)))
        };
        let expected = uoct::error_of_z_deg(codec.bits);
        assert!((of(Vec3::Z).1 / expected - 1.0).abs() < 1e-6, "{}", codec.id);
        let last = u64::MAX >> (64 - codec.bits);
        for v in [-Vec3::Z, Vec3::new(-0.0, 0.0, -1.0), Vec3::new(-1e-20, -1e-20, -1.0)] {
            let (code, error) = of(v);
            assert!(error < 1e-9 && code != 0, "{}: {v:?}", codec.id);
        }
        assert_eq!(of(-Vec3::Z).0 | of(Vec3::new(-0.0, -0.0, -1.0)).0, last);
        assert!(of(Vec3::X).1 > 0.0 && of(Vec3::X).1 < expected, "{}", codec.id);
    }
}

/// The values that CesiumGS publishes (Specs/Core/AttributeCompressionSpec.js, and the texts of 3D Tiles) for the same
/// format, and the layout: x in the low half.
#[test]
fn published_values_and_layout() {
    assert_eq!([Vec3::Z, -Vec3::Z, Vec3::Y].map(UOctPrecise16::encode), [0x8080, 0xffff, 0xff80]);
    assert_eq!(UOctPrecise16::decode::<Vec3>(0), -Vec3::Z);
    assert_eq!([Vec3::Y, Vec3::X].map(UOctPrecise32::encode), [0xffff_8000, 0x8000_ffff]);
    assert_eq!(UOctPrecise20::encode(Vec3::X), 1023 | 512 << 10);
}

/// A UNORM format stores `project_precise` exactly: the code's integers over the largest. `oct::to_unorm` stores the points of
/// `oct` in it, whose axes come back.
#[test]
fn unorm_values() {
    fn check<const BITS: u32>()
    where
        UOctPrecise<BITS>: Codec<Code = u32> + unitvec::codec::Width,
        unitvec::oct::OctPrecise<BITS>: Codec<Code = u32>,
        unitvec::oct::Oct<BITS>: unitvec::codec::Width,
    {
        let most = ((1u32 << (BITS / 2)) - 1) as f32;
        for v in sphere(17, 2000).chain([Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y]) {
            let code = UOctPrecise::<BITS>::encode(v);
            let [x, y] = [code & most as u32, code >> (BITS / 2)].map(|i| i as f32 / most);
            assert_eq!(project_precise::<BITS>(v).to_array(), [x, y]);
            let e = oct::project_precise::<BITS>(v);
            let stored = oct::to_unorm::<BITS>(e);
            assert!(
                (stored * most).to_array().iter().all(|i| (i - i.round()).abs() < 1e-3 && *i < most - 0.5)
            );
            assert_eq!(oct::from_unorm::<BITS>(stored), e, "{v:?}");
        }
        assert_eq!(oct::from_unorm::<BITS>(glam::Vec2::splat(1.0)), glam::Vec2::splat(1.0));
    }
    check::<16>();
    check::<20>();
    check::<24>();
    check::<32>();
}
