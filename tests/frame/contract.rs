//! The tangent frames take any input, and keep their promises.

use super::*;
use proptest::prelude::{ProptestConfig, any, proptest};
use proptest::test_runner::RngSeed;
use unitvec::direction::MIN_NORM;
use unitvec_run::sampling::special_vectors;
use unitvec_tests::directions::{AXES, near_planes, sphere, usable};

for_both! {
    round_trip_is_stable handedness_is_never_zero unusable_tangents_have_angle_0 scaling_keeps_the_code
    negative_zeros_and_denormals_count_as_zero denormals_break_no_ties_of_normals keeps_the_axes
    special_inputs_keep_the_contract
}

mod check {
    use super::*;

    /// The same codes, decoded, encoded and decoded, give the first frame, exactly.
    pub fn round_trip_is_stable<F: Checked>() {
        for code in codes::<F>(2) {
            let once = decode::<F>(code);
            let again = number::<F>(once);
            assert_eq!(decode::<F>(again), once, "{code:#x} comes back as {again:#x}");
        }
    }

    /// Handedness is -1 below zero, and +1 otherwise: of zeros, denormals and NaN too.
    pub fn handedness_is_never_zero<F: Checked>() {
        let tiny = f32::MIN_POSITIVE;
        let positive =
            [1.0, 0.0, -0.0, tiny, -tiny.next_down(), -1e-40, f32::INFINITY, f32::NAN, -f32::NAN, 7.0];
        let negative = [-1.0, -tiny, -1e-30, -5.0, f32::MIN, f32::NEG_INFINITY];
        let frame = |handedness| Frame { normal: Vec3::Z, tangent: Vec3::X, handedness };
        for (values, expected) in [(&positive[..], 1.0), (&negative[..], -1.0)] {
            for &value in values {
                let code = number::<F>(frame(value));
                assert_eq!(decode::<F>(code).handedness, expected, "{value}");
                assert_eq!(code >> (F::BITS - 1), u64::from(expected < 0.0), "{value}");
            }
        }
        for patterns in [0, u64::MAX, 1 << 31, 1 << 63, !(1 << 31), !(1 << 63)] {
            assert_eq!(decode::<F>(patterns).handedness.abs(), 1.0);
        }
    }

    /// Tangents without a direction and those parallel to the normal, of either sign, have angle 0.
    pub fn unusable_tangents_have_angle_0<F: Checked>() {
        let angle = |frame| (number::<F>(frame) >> F::FORMAT.normal_bits) & ((1 << F::FORMAT.angle_bits) - 1);
        let odd = [0.0, -0.0, 1e-40, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MAX];
        for normal in sphere(10, 20_000).chain(near_planes(11, 20_000)).chain(AXES) {
            for along in [1.0, -1.0, 3e-7, -5e8] {
                let parallel = Frame { normal, tangent: normal * along, handedness: 1.0 };
                assert_eq!(angle(parallel), 0, "{parallel:?}");
            }
        }
        for x in odd {
            for y in odd {
                for z in odd {
                    let frame = Frame {
                        normal: Vec3::new(0.1, -0.5, -0.3),
                        tangent: Vec3::new(x, y, z),
                        handedness: 1.0,
                    };
                    assert_eq!(angle(frame), 0, "{frame:?}");
                }
            }
        }
        let up = Frame { normal: Vec3::Z, tangent: Vec3::NAN, handedness: 1.0 };
        assert_eq!(F::decode(F::encode(up)).tangent, Vec3::X);
    }

    /// Lengths do not matter: scaled by powers of two, normal and tangent keep their code.
    pub fn scaling_keeps_the_code<F: Checked>() {
        for frame in frames(15, sphere(16, 1000)) {
            let code = number::<F>(frame);
            for exponent in (-60..=96).step_by(4) {
                let scale = 2f32.powi(exponent);
                let scaled =
                    Frame { tangent: frame.tangent * scale, handedness: frame.handedness * scale, ..frame };
                assert_eq!(number::<F>(scaled), code, "{frame:?} 2^{exponent}");
                let scaled = Frame { normal: frame.normal * scale.clamp(1e-18, 1e18), ..frame };
                assert_eq!(
                    number::<F>(Frame { normal: frame.normal * 2f32.powi(exponent / 2), ..scaled }),
                    code
                );
            }
        }
    }

    /// Components that are -0 or a denormal count as +0, in tangents of any length.
    pub fn negative_zeros_and_denormals_count_as_zero<F: Checked>() {
        let check = |with: Vec3, without: Vec3| {
            for normal in AXES.into_iter().chain([Vec3::new(0.3, -0.4, -0.5), Vec3::new(0.6, 0.8, 0.0)]) {
                let [a, b] =
                    [with, without].map(|tangent| number::<F>(Frame { normal, tangent, handedness: 1.0 }));
                assert_eq!(a, b, "{normal:?} {with:?}");
            }
        };
        for tiny in [-0.0, -1e-40, 1e-40, f32::from_bits(1), -f32::MIN_POSITIVE.next_down()] {
            for (a, b) in [(0.6, 0.8), (-0.6, 0.8), (0.0, -1.0), (-1.0, 0.0), (0.5, 0.5), (-0.5, 0.5)] {
                for scale in [1.0, 2.0 * MIN_NORM] {
                    let (a, b) = (a * scale, b * scale);
                    check(Vec3::new(tiny, a, b), Vec3::new(0.0, a, b));
                    check(Vec3::new(a, tiny, b), Vec3::new(a, 0.0, b));
                    check(Vec3::new(a, b, tiny), Vec3::new(a, b, 0.0));
                    check(Vec3::new(tiny, tiny, b), Vec3::new(0.0, 0.0, b));
                }
            }
        }
    }

    /// Denormals and -0 count as +0 in normals too, which lie between two lattice points.
    pub fn denormals_break_no_ties_of_normals<F: Checked>() {
        let m = ((1u32 << (F::FORMAT.normal_bits / 2 - 1)) - 1) as f32;
        let code = |normal| number::<F>(Frame { normal, tangent: Vec3::Y, handedness: 1.0 });
        for k in (0..m as u32).step_by(m as usize / 1000 + 1) {
            let (a, b) = ((k as f32 + 0.5) / m, (m - k as f32 - 0.5) / m);
            for tiny in [-0.0, -1e-40, 1e-40, f32::from_bits(1), -f32::MIN_POSITIVE.next_down()] {
                for scale in [1.0, 10.0 / 3.0, 2.0 * MIN_NORM] {
                    let of = |t: f32| [Vec3::new(a, b, t), Vec3::new(a, t, b), Vec3::new(t, a, b)];
                    for (with, without) in of(tiny / scale).into_iter().zip(of(0.0)) {
                        assert_eq!(code(with * scale), code(without * scale), "{with:?} {scale}");
                    }
                }
            }
        }
    }

    /// Frames along the axes come back exactly, all 48 of them. That of +Z, +X and +1 is code 0.
    pub fn keeps_the_axes<F: Checked>() {
        let Format { normal_bits, angle_bits, .. } = F::FORMAT;
        assert_eq!(number::<F>(Frame { normal: Vec3::Z, tangent: Vec3::X, handedness: 1.0 }), 0);
        let quarter_turn = 1 << (normal_bits + angle_bits - 2);
        let mirrored = Frame { normal: Vec3::Z, tangent: Vec3::Y, handedness: -1.0 };
        assert_eq!(number::<F>(mirrored), quarter_turn | (1 << (F::BITS - 1)));
        for normal in AXES {
            for tangent in AXES.into_iter().filter(|t| t.dot(normal) == 0.0) {
                for handedness in [1.0, -1.0] {
                    let frame = Frame { normal, tangent, handedness };
                    assert_eq!(F::decode(F::encode(frame)), frame);
                }
            }
        }
    }

    /// Zeros, denormals, infinities, NaN, huge and tiny numbers in all combinations, as normals and as tangents.
    pub fn special_inputs_keep_the_contract<F: Checked>() {
        let mut rng = Rng::new(17);
        let inputs = special_vectors();
        let handedness = [1.0, -1.0, 0.0, -0.0, f32::NAN, -1e-40, f32::INFINITY, f32::NEG_INFINITY];
        for &[x, y, z] in &inputs {
            let any = |rng: &mut Rng, modulus: usize| (rng.bits() % modulus as u64) as usize;
            let h = handedness[any(&mut rng, 8)];
            let [a, b, c] = inputs[any(&mut rng, inputs.len())];
            for components in [
                [x, y, z, 1.0, 0.0, 0.0, h],
                [0.0, 0.6, -0.8, x, y, z, h],
                [x, y, z, x, y, z, h],
                [x, y, z, a, b, c, h],
            ] {
                assert_total::<F>(components);
            }
        }
    }
}

/// Asserts the contract of `encode` for any input: the normal within its bound where it has a direction; a frame.
fn assert_total<F: Checked>(components: [f32; 7]) {
    let code = number::<F>(Frame::from_array(components));
    let [nx, ny, nz, .., handedness] = components;
    let decoded = decode::<F>(code);
    assert_frame(decoded, code, &mut [0.0; 2]);
    assert_eq!(
        decoded.handedness,
        if handedness <= -f32::MIN_POSITIVE { -1.0 } else { 1.0 },
        "{components:?}"
    );
    let usable = usable(Vec3::new(nx, ny, nz));
    let error = angle_deg([nx, ny, nz].map(f64::from), widen(decoded.normal));
    let is_z = decoded.normal == Vec3::Z;
    assert!(
        (usable != Some(false) && error <= f64::from(F::MAX_NORMAL_ERROR_DEG))
            || (is_z && usable != Some(true)),
        "{}: {components:?} gets {code:#x}, {error} degrees off",
        F::NAME
    );
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1), cases: 100_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Any seven bit patterns taken as floats.
    #[test]
    fn any_bits_keep_the_contract(bits in any::<[u32; 7]>()) {
        assert_total::<Frame32>(bits.map(f32::from_bits));
        assert_total::<Frame64>(bits.map(f32::from_bits));
    }

    /// Any seven floats of exponents that are close together.
    #[test]
    fn any_frame_keeps_the_contract(bits in any::<[u32; 7]>(), exponent in 20u32..232) {
        let components = bits.map(|b| f32::from_bits((b & 0x81ff_ffff) + (exponent << 23)));
        assert_total::<Frame32>(components);
        assert_total::<Frame64>(components);
    }

    /// Any code.
    #[test]
    fn any_code_keeps_the_contract(code in any::<u64>()) {
        assert_frame(decode::<Frame32>(code), code, &mut [0.0; 2]);
        assert_frame(decode::<Frame64>(code), code, &mut [0.0; 2]);
    }
}
