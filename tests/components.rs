//! The codecs of raw components, snorm, unorm and half float: rounding, layout.

use glam::Vec3;
use unitvec::arith::{half_decode, half_encode};
use unitvec::{Codec, Float16x3, Snorm5x3, Snorm8x3, Snorm10x3, Snorm11x11x10, Snorm16x3, Unorm8x3};
use unitvec_oracle::raw;
use unitvec_tests::directions::{AXES, near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

fn round_trip<C: Codec>(v: Vec3) -> Vec3 {
    C::decode(C::encode(v))
}

/// No component is off by more than half a step and the rounding of `f32`.
#[test]
fn rounds_to_nearest() {
    let half_step = |b: i32| 0.5 / (2f64.powi(b - 1) - 1.0);
    let half_steps = [
        ("snorm5x3", [5; 3].map(half_step)),
        ("snorm8x3", [8; 3].map(half_step)),
        ("snorm10x3", [10; 3].map(half_step)),
        ("snorm11_11_10", [11, 11, 10].map(half_step)),
        ("snorm16x3", [16; 3].map(half_step)),
        ("unorm8x3", [1.0 / 255.0; 3]),
        ("float16x3", [1.0 / 4096.0; 3]),
    ];
    for (id, half) in half_steps {
        let codec = Tested::find(id);
        for v in sphere(4, 300_000).chain(near_planes(5, 50_000).map(Vec3::normalize)) {
            let (exact, decoded) = (widen(v), widen(codec.round_trip(v)));
            let off = (0..3).all(|i| (decoded[i] - exact[i]).abs() <= half[i] + 1.0 / (1 << 22) as f64);
            assert!(off, "{id}: {v:?} gives {decoded:?}");
        }
    }
}

/// An axis in unorm8 is off by 1/255 in each other component.
#[test]
fn axes_of_unorm() {
    for v in AXES {
        assert_eq!(round_trip::<Unorm8x3>(v), v + (Vec3::ONE - v.abs()) / 255.0);
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
    assert_eq!(Float16x3::decode_vec3([0xfc00_7e00, 0xffff]), Vec3::new(65504.0, -65504.0, -65504.0));
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
