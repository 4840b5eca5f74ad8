//! The tangent frames against the papers: [`unitvec_oracle::frame`].

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use unitvec::ListedFrame;
use unitvec::codec::Code;
use unitvec::frame::{decode_frames, encode_frames};
use unitvec::{Codec, Frame, Frame32, Frame64, FrameCodec, OctPrecise22};
use unitvec_host::sampling::special_vectors;
use unitvec_oracle::frame::{self, Format, tangent_bound};
use unitvec_oracle::{Summary, angle_deg, cross, dot, length, normalize};
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{AXES, Rng, near_planes, sphere, usable};
use unitvec_tests::tested::widen;

/// What `normal . tangent` of a decoded frame may be off by: 4 ULP of 1.
const PERPENDICULAR: f64 = 4.0 * f32::EPSILON as f64;

/// What the rounding in `f32` turns a decoded normal by, in radians: 1 ULP, as of oct.
const DECODE_NORMAL: f64 = f32::EPSILON as f64;

/// What the rounding in `f32` turns a decoded tangent by, in radians: of the decoded normal, the basis, its two
/// products and the sum, and the scaling to unit length.
const DECODE_TANGENT: f64 = 1.0 / (1 << 21) as f64;

/// What the rounding in `f32` can make of a tangent's angle when it is encoded, in radians.
const ENCODE_TANGENT: f64 = 1.0 / (1 << 21) as f64;

/// A frame codec, the oracle's format, and what its encoder adds to the errors of the nearest codes.
trait Checked: ListedFrame {
    const FORMAT: Format;

    /// The part of half a step by which the angle's place is found less than exactly.
    const ANGLE_SLACK: f64;

    /// In radians, to the normal's error, by the rounding of the position in `f32`.
    const NORMAL_SLACK: f64;
}

impl Checked for Frame32 {
    const FORMAT: Format = frame::FRAME32;
    const ANGLE_SLACK: f64 = 0.004;
    /// And by what `oct22p` leaves of the denominators: 2e-4 of a step of the position, of which the difference between
    /// two normals as near takes about a third.
    const NORMAL_SLACK: f64 = 1.0 / (1 << 22) as f64 + 0.7e-4 / 1023.0;
}

impl Checked for Frame64 {
    const FORMAT: Format = frame::FRAME64;
    const ANGLE_SLACK: f64 = 0.0;
    const NORMAL_SLACK: f64 = 1.0 / (1 << 22) as f64;
}

/// Runs `$check::<codec>()` for both.
macro_rules! tests {
    ($($(#[$doc:meta])* $name:ident)*) => {
        $(
            $(#[$doc])*
            #[test]
            fn $name() {
                check::$name::<Frame32>();
                check::$name::<Frame64>();
            }
        )*
    };
}

tests! {
    /// All 2^22 normals of frame32 and 2^20 of frame64, each with some angle, 512 angles with 1144 normals (those on and
    /// near axes, poles and the equator too), and 2^20 random codes decode as the oracle has it, to unit length to 2 ULP,
    /// perpendicular to 4.
    decodes_as_the_oracle

    /// The same codes, decoded, encoded and decoded, give the first frame, exactly.
    round_trip_is_stable

    /// Over 10^6 random frames the errors keep to the bounds, and come to 90 % of them.
    errors_keep_to_the_bounds

    /// 2 * 10^5 frames of all kinds get the nearest code of the normal and of the angle about it, but for rounding.
    encodes_as_the_oracle

    /// The angle wraps: tangents next to the basis's first vector, on both sides, are as near to their codes as others.
    angles_wrap

    /// Handedness is -1 below zero, and +1 otherwise: of zeros, denormals and NaN too.
    handedness_is_never_zero

    /// Tangents without a direction and those parallel to the normal, of either sign, have angle 0.
    unusable_tangents_have_angle_0

    /// Tangents that are not perpendicular count as what of them is perpendicular to the decoded normal.
    tangents_are_projected

    /// Lengths do not matter: scaled by powers of two, normal and tangent keep their code.
    scaling_keeps_the_code

    /// Components that are -0 or a denormal count as +0, in tangents of any length.
    negative_zeros_and_denormals_count_as_zero

    /// Frames along the axes come back exactly, all 48 of them. That of +Z, +X and +1 is code 0.
    keeps_the_axes

    /// Zeros, denormals, infinities, NaN, huge and tiny numbers in all combinations, as normals and as tangents.
    special_inputs_keep_the_contract

    /// Slices of 0 to 20 frames hold what the scalar functions give; those of a wrong length are left alone.
    slices_are_the_scalar_functions
}

/// The code as one number.
fn number<F: ListedFrame>(frame: Frame) -> u64 {
    let [low, high] = F::encode(frame).to_words();
    u64::from(low) | (u64::from(high) << 32)
}

fn decode<F: ListedFrame>(code: u64) -> Frame {
    F::decode(F::Code::from_words([code as u32, (code >> 32) as u32]))
}

/// Normals' codes on and around the poles, the axes and the equator, and at random.
fn normal_codes<F: Checked>(seed: u64, count: usize) -> Vec<u64> {
    let half = F::FORMAT.normal_bits / 2;
    let m = (1i64 << (half - 1)) - 1;
    let code = |x: i64, y: i64| {
        let [x, y] = [x, y].map(|t| t.rem_euclid(1 << half) as u64);
        x | (y << half)
    };
    let near = [-m - 1, -m, 1 - m, 2 - m, -2, -1, 0, 1, 2, m - 2, m - 1, m];
    let mut codes: Vec<u64> = near.iter().flat_map(|&x| near.iter().map(move |&y| code(x, y))).collect();
    let mut rng = Rng::new(seed);
    for _ in 0..count / 4 {
        let along = rng.range(-m as f64, m as f64) as i64;
        let across = m - along.abs();
        codes.extend(
            [[along, across], [along, -across], [along, across - 1], [along, m]].map(|[x, y]| code(x, y)),
        );
    }
    codes.extend((0..count).map(|_| rng.bits() >> (64 - F::FORMAT.normal_bits)));
    codes
}

/// Codes of frames: every normal of 22 bits, or 2^20 of more bits, with some angle; 512 angles (all of 9 bits) with 1144
/// normals; 2^20 random ones.
fn codes<F: Checked>(seed: u64) -> impl Iterator<Item = u64> {
    let Format { normal_bits, angle_bits, .. } = F::FORMAT;
    let top = move |normal: u64, rest: u64| {
        normal | ((rest & (u64::MAX >> (64 - F::BITS + normal_bits))) << normal_bits)
    };
    let mut rng = Rng::new(seed);
    let (stride, count) = if normal_bits == 22 { (1, 1 << 22) } else { ((1 << 22) + 1, 1 << 20) };
    let each_normal = (0..count).map(move |i| top(i * stride, rng.bits()));

    let normals = normal_codes::<F>(seed + 1, 500);
    let angle_stride = 1 << (angle_bits - 9);
    let each_angle = (0..512).flat_map(move |i| {
        let offset = [0, 1, angle_stride - 1][i as usize % 3] % angle_stride;
        let rest = (i * angle_stride + offset) | ((i % 2) << angle_bits);
        normals.clone().into_iter().map(move |normal| top(normal, rest))
    });

    let mut rng = Rng::new(seed + 2);
    let random = (0..1 << 20).map(move |_| rng.bits() >> (64 - F::BITS));
    each_normal.chain(each_angle).chain(random)
}

/// Any unit vector perpendicular to `n`: its angle is uniform.
fn random_tangent(rng: &mut Rng, n: Vec3) -> Vec3 {
    let angle = rng.range(0.0, TAU);
    let n = normalize(widen(n));
    Vec3::from_array(frame::at_angle(n, angle).map(|t| t as f32))
}

/// Frames with these normals and random tangents and handedness.
fn frames(seed: u64, normals: impl Iterator<Item = Vec3>) -> impl Iterator<Item = Frame> {
    let mut rng = Rng::new(seed);
    normals.map(move |normal| Frame {
        normal,
        tangent: random_tangent(&mut rng, normal),
        handedness: if rng.unit() < 0.5 { -1.0 } else { 1.0 },
    })
}

/// The angles in radians of normal and tangent from those of the decoded code.
fn errors<F: ListedFrame>(frame: Frame) -> [f64; 2] {
    let decoded = F::decode(F::encode(frame));
    assert_eq!(decoded.handedness, frame.handedness, "{frame:?}");
    [(frame.normal, decoded.normal), (frame.tangent, decoded.tangent)]
        .map(|(a, b)| angle_deg(widen(a), widen(b)).to_radians())
}

/// Asserts that a decoded frame is one: unit vectors, perpendicular, of handedness +1 or -1. The greatest
/// `|normal . tangent|` and difference of a length from 1 are put in `worst`.
fn assert_frame(decoded: Frame, code: u64, worst: &mut [f64; 2]) {
    let (n, t) = (widen(decoded.normal), widen(decoded.tangent));
    let off = (length(n) - 1.0).abs().max((length(t) - 1.0).abs());
    let cosine = dot(n, t).abs();
    assert!(off <= LENGTH_ROUNDING && cosine <= PERPENDICULAR, "{code:#x}: {decoded:?} {off:e} {cosine:e}");
    assert!(decoded.handedness.abs() == 1.0, "{code:#x}: {decoded:?}");
    *worst = [worst[0].max(cosine), worst[1].max(off)];
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

mod check {
    use super::*;

    pub fn decodes_as_the_oracle<F: Checked>() {
        let (mut worst, mut worst_turn) = ([0.0; 2], 0f64);
        for code in codes::<F>(1) {
            let (decoded, expected) = (decode::<F>(code), F::FORMAT.decode(code));
            assert_frame(decoded, code, &mut worst);
            let [normal, tangent] = [(decoded.normal, expected.normal), (decoded.tangent, expected.tangent)]
                .map(|(a, b)| angle_deg(widen(a), b).to_radians());
            assert!(
                normal <= DECODE_NORMAL && tangent <= DECODE_TANGENT,
                "{code:#x}: {decoded:?} for {expected:?}: {normal:e} {tangent:e}"
            );
            assert_eq!(f64::from(decoded.handedness), expected.handedness, "{code:#x}");
            worst_turn = worst_turn.max(tangent);
        }
        let [cosine, off] = worst.map(|t| t / f64::from(f32::EPSILON));
        println!(
            "{} decode: tangent {:.3} of 2^-21, |n.t| {cosine:.3} ULP, length {off:.3} ULP",
            F::NAME,
            worst_turn / DECODE_TANGENT
        );
    }

    pub fn round_trip_is_stable<F: Checked>() {
        for code in codes::<F>(2) {
            let once = decode::<F>(code);
            let again = number::<F>(once);
            assert_eq!(decode::<F>(again), once, "{code:#x} comes back as {again:#x}");
        }
    }

    pub fn errors_keep_to_the_bounds<F: Checked>() {
        let all: Vec<[f64; 2]> = frames(3, sphere(4, 1_000_000)).map(errors::<F>).collect();
        let [normal, tangent] = [0, 1].map(|i| Summary::of(all.iter().map(|e| e[i].to_degrees())));
        let bounds = [F::MAX_NORMAL_ERROR_DEG, F::MAX_TANGENT_ERROR_DEG].map(f64::from);
        for (of, errors, bound) in [("normal", normal, bounds[0]), ("tangent", tangent, bounds[1])] {
            let Summary { mean, max } = errors;
            println!("{} {of}: mean {mean:.6e} max {max:.6e} bound {bound:.6e}", F::NAME);
            assert!(max <= bound && max >= 0.9 * bound, "{} {of}: {errors:?} for {bound}", F::NAME);
        }

        // The bound of the tangent's error is that of the two parts, and not much more.
        let step = TAU / (1u64 << F::FORMAT.angle_bits) as f64;
        let exact = tangent_bound(bounds[0].to_radians(), 0.5 * step * 1.0026).to_degrees();
        assert!(bounds[1] >= exact && bounds[1] <= 1.1 * exact, "{}: {bounds:?} for {exact}", F::NAME);
    }

    pub fn encodes_as_the_oracle<F: Checked>() {
        let half_step = PI / (1u64 << F::FORMAT.angle_bits) as f64;
        let mut excess = [f64::NEG_INFINITY; 2];
        for frame in frames(5, sphere(6, 100_000).chain(near_planes(7, 100_000))) {
            let code = number::<F>(frame);
            let exact = widen(frame.normal);
            let normal = code % (1 << F::FORMAT.normal_bits);
            let decoded = F::FORMAT.normal(normal);
            let [ours, least] = [decoded, F::FORMAT.normal(F::FORMAT.nearest_normal(exact))]
                .map(|n| angle_deg(exact, n).to_radians());
            excess[0] = excess[0].max((ours - least) / F::NORMAL_SLACK);
            assert!(ours - least <= F::NORMAL_SLACK, "{frame:?}: {code:#x} {ours:e} {least:e}");

            // About the normal that was decoded, whichever it is.
            let angle = frame::angle_of(decoded, widen(frame.tangent));
            let place = (code >> F::FORMAT.normal_bits) % (1 << F::FORMAT.angle_bits);
            let [ours, least] = [place, F::FORMAT.nearest_angle(angle)].map(|code| {
                let off = (F::FORMAT.angle(code) - angle).rem_euclid(TAU);
                off.min(TAU - off)
            });
            let slack = 2.0 * (half_step * F::ANGLE_SLACK + ENCODE_TANGENT);
            excess[1] = excess[1].max((ours - least) / slack);
            assert!(ours - least <= slack, "{frame:?}: {code:#x} {ours:e} {least:e}");
        }
        println!("{} encode over nearest, of what rounding may: {excess:.3?}", F::NAME);
    }

    pub fn angles_wrap<F: Checked>() {
        let bound = f64::from(F::MAX_TANGENT_ERROR_DEG).to_radians();
        let step = TAU / (1u64 << F::FORMAT.angle_bits) as f64;
        let mut rng = Rng::new(8);
        for normal in sphere(9, 100_000) {
            let n = F::FORMAT.normal(F::FORMAT.nearest_normal(widen(normal)));
            let angle = FRAC_PI_2 * (rng.bits() % 4) as f64 + rng.range(-step, step);
            let [normal, tangent] =
                [n, frame::at_angle(n, angle)].map(|v| Vec3::from_array(v.map(|t| t as f32)));
            let off = errors::<F>(Frame { normal, tangent, handedness: 1.0 });
            assert!(off[1] <= bound, "{normal:?} {angle}: {off:?}");
        }
    }

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

    pub fn tangents_are_projected<F: Checked>() {
        let (slack, mut rng) = (2.0 * ENCODE_TANGENT, Rng::new(12));
        let half_step = PI / (1u64 << F::FORMAT.angle_bits) as f64 * 1.0026 * (1.0 + F::ANGLE_SLACK);
        for frame in frames(13, sphere(14, 200_000)) {
            let tangent = frame.tangent + frame.normal * rng.range(-1.0, 1.0) as f32;
            let decoded = F::decode(F::encode(Frame { tangent, ..frame }));
            let n = normalize(widen(decoded.normal));
            let error =
                angle_deg(frame::perpendicular(n, widen(tangent)), widen(decoded.tangent)).to_radians();
            assert!(error <= half_step + slack, "{frame:?} {error:e}");
        }
    }

    pub fn scaling_keeps_the_code<F: Checked>() {
        for frame in frames(15, sphere(16, 1000)) {
            let code = number::<F>(frame);
            for exponent in (-90..=98).step_by(4) {
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
                for scale in [1.0, 2f32.powi(-99)] {
                    let (a, b) = (a * scale, b * scale);
                    check(Vec3::new(tiny, a, b), Vec3::new(0.0, a, b));
                    check(Vec3::new(a, tiny, b), Vec3::new(a, 0.0, b));
                    check(Vec3::new(a, b, tiny), Vec3::new(a, b, 0.0));
                    check(Vec3::new(tiny, tiny, b), Vec3::new(0.0, 0.0, b));
                }
            }
        }
    }

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

    pub fn slices_are_the_scalar_functions<F: Checked>() {
        for count in 0..=20 {
            let all: Vec<[f32; 7]> = frames(18, sphere(19, count)).map(Frame::to_array).collect();
            let codes: Vec<u64> = all.iter().map(|&f| number::<F>(Frame::from_array(f))).collect();
            let expected: Vec<u8> =
                codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(F::BYTES)).collect();
            let mut bytes = vec![0xA5; count * F::BYTES];
            assert_eq!(encode_frames::<F>(&all, &mut bytes), Ok(()));
            assert_eq!(bytes, expected);

            let expected: Vec<[f32; 7]> = codes.iter().map(|&code| decode::<F>(code).to_array()).collect();
            let mut decoded = vec![[f32::NAN; 7]; count];
            assert_eq!(decode_frames::<F>(&bytes, &mut decoded), Ok(()));
            assert_eq!(decoded, expected);

            let mut longer = vec![0xA5; bytes.len() + 1];
            assert!(encode_frames::<F>(&all, &mut longer).is_err());
            assert!(longer.iter().all(|&byte| byte == 0xA5));
            let mut decoded = vec![[7.0; 7]; count + 1];
            assert!(decode_frames::<F>(&bytes, &mut decoded).is_err());
            assert!(decoded.iter().all(|&f| f == [7.0; 7]));
            assert!(decode_frames::<F>(&longer, &mut decoded[..count]).is_err());
        }
    }
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

/// The normal of frame32 is oct22p's: its code is the low 22 bits, and the high ones do not count.
#[test]
fn normals_of_frame32_are_oct22p() {
    for frame in frames(20, sphere(21, 100_000)) {
        let code = Frame32::encode(frame);
        assert_eq!(code & 0x3f_ffff, OctPrecise22::encode(frame.normal));
        assert_eq!(Frame32::decode(code).normal, OctPrecise22::decode(code));
    }
}

/// The third axis: of unit length, perpendicular to the others, on the side that the handedness says.
#[test]
fn bitangents_complete_the_frame() {
    for frame in frames(22, sphere(23, 100_000)) {
        let decoded = Frame32::decode(Frame32::encode(frame));
        let [n, t, b] = [decoded.normal, decoded.tangent, decoded.bitangent()].map(widen);
        assert!((length(b) - 1.0).abs() < 1e-6 && dot(b, n).abs() < 1e-6 && dot(b, t).abs() < 1e-6);
        assert!((dot(cross(n, t), b) * f64::from(frame.handedness) - 1.0).abs() < 1e-6);
    }
}

/// What the stretching of the diamond gains: against the bare one, the tangent's error of frame32 is a fifth less at
/// most, and 3 % less in the mean; equal steps of the angle would gain less than 0.5 % more.
#[test]
fn stretching_the_diamond_pays() {
    let angle_error = |format: Format| {
        let angles = (0..200_000).map(|i| f64::from(i) / 200_000.0 * TAU);
        Summary::of(angles.map(|angle| {
            let off = (format.angle(format.nearest_angle(angle)) - angle).abs();
            off.min(TAU - off).to_degrees()
        }))
    };
    let [ours, bare] =
        [frame::stretched, frame::plain].map(|warp| angle_error(Format { warp, ..frame::FRAME32 }));
    let equal = 180.0 / 512.0;
    println!("angle: ours {ours:?}, diamond {bare:?}, equal steps {} {equal}", equal / 2.0);
    assert!(ours.max <= 0.79 * bare.max && ours.mean <= 0.97 * bare.mean);
    assert!(ours.max <= 1.005 * equal && ours.mean <= 1.005 * equal / 2.0);
}
