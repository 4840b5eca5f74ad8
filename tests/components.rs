//! The codecs of raw components, snorm, unorm and half float, against [`unitvec_tests::oracle::raw`] and the survey.

use glam::Vec3;
use unitvec::arith::{half_decode, half_encode};
use unitvec::{Codec, Float16x3, Snorm5x3, Snorm8x3, Snorm10x3, Snorm11x11x10, Snorm16x3, Unorm8x3};
use unitvec_tests::oracle::codes::{self, bits, round_trip};
use unitvec_tests::oracle::{Summary, raw, widen};
use unitvec_tests::sampling::{AXES, Rng, near_planes, sphere};

/// Modules of tests, one for each codec: its type, its oracle, the survey's errors, and the components' half steps.
macro_rules! raw_codecs {
    ($($module:ident: $codec:ty, $oracle:expr, $mean:literal, $max:literal, $half:expr;)*) => {$(
        mod $module {
            use super::*;

            /// Codes decode to the oracle's components, exactly but for one rounding.
            #[test]
            fn decodes_as_the_oracle() {
                codes::assert_decodes::<$codec>(codes::patterns::<$codec>(1), $oracle, 1.0 / (1 << 24) as f64);
            }

            /// Codes, decoded, encoded and decoded, give the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                codes::assert_stable::<$codec>(codes::patterns::<$codec>(2));
            }

            /// Mean and maximum over 10^6 directions are the survey's.
            #[test]
            fn errors_are_the_published_ones() {
                let published = Summary { mean: $mean, max: $max };
                codes::assert_published::<$codec>(sphere(3, 1_000_000), published);
            }

            /// No component is off by more than half a step and what `f32` rounds.
            #[test]
            fn rounds_to_nearest() {
                let half: [f64; 3] = $half;
                for v in sphere(4, 300_000).chain(near_planes(5, 50_000).map(Vec3::normalize)) {
                    let (exact, decoded) = (widen(v), widen(round_trip::<$codec>(v)));
                    let off = (0..3).all(|i| (decoded[i] - exact[i]).abs() <= half[i] + 1.0 / (1 << 22) as f64);
                    assert!(off, "{v:?} gives {decoded:?}");
                }
            }

            /// Special inputs and random bits give codes of the codec's bits, unusable vectors +Z's.
            #[test]
            fn takes_anything() {
                let mut rng = Rng::new(6);
                let any = (0..200_000).map(move |_| [(); 3].map(|()| f32::from_bits(rng.bits() as u32)));
                codes::assert_total::<$codec>(any, None);
            }
        }
    )*};
}

fn snorm_half_steps(widths: [i32; 3]) -> [f64; 3] {
    widths.map(|b| 0.5 / (2f64.powi(b - 1) - 1.0))
}

raw_codecs! {
    snorm5x3: Snorm5x3, |c| raw::snorm3(c, [5; 3]), 1.45262, 3.26743, snorm_half_steps([5; 3]);
    snorm8x3: Snorm8x3, |c| raw::snorm3(c, [8; 3]), 0.17015, 0.38588, snorm_half_steps([8; 3]);
    snorm10x3: Snorm10x3, |c| raw::snorm3(c, [10; 3]), 0.04228, 0.09598, snorm_half_steps([10; 3]);
    snorm11_11_10: Snorm11x11x10, |c| raw::snorm3(c, [11, 11, 10]), 0.02937, 0.06776, snorm_half_steps([11, 11, 10]);
    snorm16x3: Snorm16x3, |c| raw::snorm3(c, [16; 3]), 0.00066, 0.00149, snorm_half_steps([16; 3]);
    // Not in the survey: what it has for snorm8x3, times 127 / 127.5, the ratio of the steps.
    unorm8x3: Unorm8x3, raw::unorm8x3, 0.16948, 0.38437, [1.0 / 255.0; 3];
    // The survey's converter truncates: rounding to nearest has 5 % less error in the mean.
    float16x3: Float16x3, raw::half3, 0.00635, 0.02635, [1.0 / 4096.0; 3];
}

/// The six axes come back exactly from snorm and half floats; unorm8 is off by 1/255 in each other component.
#[test]
fn axes() {
    for v in AXES {
        assert_eq!(round_trip::<Snorm5x3>(v), v);
        assert_eq!(round_trip::<Snorm8x3>(v), v);
        assert_eq!(round_trip::<Snorm10x3>(v), v);
        assert_eq!(round_trip::<Snorm11x11x10>(v), v);
        assert_eq!(round_trip::<Snorm16x3>(v), v);
        assert_eq!(round_trip::<Float16x3>(v), v);
        let expected = v + (Vec3::ONE - v.abs()) / 255.0;
        assert_eq!(round_trip::<Unorm8x3>(v), expected);
    }
}

/// The first component is in the low bits, as the formats of Vulkan have it.
#[test]
fn layouts() {
    let v = Vec3::new(1.0, -1.0, 0.5);
    assert_eq!(Snorm5x3::encode(v), 0b01000_10001_01111);
    assert_eq!(Snorm8x3::encode(v), 0x40_81_7f);
    assert_eq!(Snorm10x3::encode(v), 0x100 << 20 | 0x201 << 10 | 0x1ff);
    assert_eq!(Snorm11x11x10::encode(v), 0x100 << 22 | 0x401 << 11 | 0x3ff);
    assert_eq!(Snorm16x3::encode(v), [0x8001_7fff, 0x4000]);
    assert_eq!(Unorm8x3::encode(v), 0xbf_00_ff);
    assert_eq!(Float16x3::encode(v), [0xbc00_3c00, 0x3800]);
}

/// Components are kept as they are, not normalised, and clamped; nothing left of a vector gives +Z.
#[test]
fn components_are_raw() {
    assert_eq!(round_trip::<Snorm8x3>(Vec3::new(3.0, -1e20, 0.0)), Vec3::new(1.0, -1.0, 0.0));
    assert_eq!(round_trip::<Snorm8x3>(Vec3::splat(1e-3)), Vec3::Z);
    assert_eq!(round_trip::<Unorm8x3>(Vec3::new(3.0, -1e20, 1.0)), Vec3::new(1.0, -1.0, 1.0));
    assert_eq!(round_trip::<Float16x3>(Vec3::new(3.0, -1e20, 0.25)), Vec3::new(3.0, -65504.0, 0.25));
    assert_eq!(round_trip::<Float16x3>(Vec3::splat(1e-9)), Vec3::Z);
    assert_eq!(bits::<Float16x3>([0x7c00_7e00, 0xffff]), 0xffff_7c00_7e00);
    assert_eq!(Float16x3::decode([0xfc00_7e00, 0xffff]), Vec3::new(65504.0, -65504.0, -65504.0));
}

/// Every half decodes to its number, and every number between two neighbours to the nearer one, ties to the even one.
#[test]
fn halves_round_to_nearest_even() {
    for code in 0..0x7bffu32 {
        let [a, b] = [code, code + 1].map(|code| raw::half(u64::from(code)));
        assert_eq!(f64::from(half_decode(code)), a, "{code:#x}");
        let middle = ((a + b) / 2.0) as f32;
        let even = code + (code & 1);
        for (x, expected) in [(middle.next_down(), code), (middle, even), (middle.next_up(), code + 1)] {
            let negative = if expected == 0 { 0 } else { expected | 0x8000 };
            assert_eq!([half_encode(x), half_encode(-x)], [expected, negative], "{x:e}");
        }
        assert_eq!([half_encode(a as f32), half_encode(b as f32)], [code, code + 1]);
    }
    for x in [65504.0, 65520.0, 1e30, f32::INFINITY, f32::NAN] {
        assert_eq!(half_encode(x), 0x7bff);
    }
    for x in [0.0, -0.0, 1e-40, -1e-40, 2f32.powi(-25), -2f32.powi(-25)] {
        assert_eq!(half_encode(x), 0);
    }
}
