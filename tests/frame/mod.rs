//! The tangent frames: parts that their tests share.

mod contract;
mod oracle;

use glam::Vec3;
use std::f64::consts::TAU;
use unitvec::codec::RawCode;
use unitvec::{Frame, Frame32, Frame64, ListedFrame};
use unitvec_oracle::frame::{self, Format};
use unitvec_oracle::{angle_deg, dot, length, normalize};
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::Rng;
use unitvec_tests::tested::{narrow, widen};

/// The error of `normal . tangent` of a decoded frame at most: 4 ULP of 1.
const PERPENDICULAR: f64 = 4.0 * f32::EPSILON as f64;

/// The angle by which the rounding in `f32` turns a decoded normal, in radians: 1 ULP, as for oct.
const DECODE_NORMAL: f64 = f32::EPSILON as f64;

/// The angle by which the rounding in `f32` turns a decoded tangent, in radians: of the decoded normal, the basis, its
/// two products and the sum, and the scaling to unit length.
const DECODE_TANGENT: f64 = 1.0 / (1 << 21) as f64;

/// The effect of the rounding in `f32` on a tangent's angle when it is encoded, in radians.
const ENCODE_TANGENT: f64 = 1.0 / (1 << 21) as f64;

/// A frame codec, the oracle's format, and the encoder's addition to the errors of the nearest codes.
trait Checked: ListedFrame {
    const FORMAT: Format;

    /// The part of half a step by which the angle's place is found less than exactly.
    const ANGLE_SLACK: f64;

    /// The angle that the rounding of the position in `f32` adds to the normal's error, in radians.
    const NORMAL_SLACK: f64;
}

impl Checked for Frame32 {
    const FORMAT: Format = frame::FRAME32;
    const ANGLE_SLACK: f64 = 0.004;
    /// The slack also has the error of `oct22p`'s denominators: 2e-4 of a step of the position, of which the difference
    /// between two normals as near takes about a third.
    const NORMAL_SLACK: f64 = 1.0 / (1 << 22) as f64 + 0.7e-4 / 1023.0;
}

impl Checked for Frame64 {
    const FORMAT: Format = frame::FRAME64;
    const ANGLE_SLACK: f64 = 0.0;
    const NORMAL_SLACK: f64 = 1.0 / (1 << 22) as f64;
}

/// Tests that run `check::<name>::<codec>()` for both codecs.
macro_rules! for_both {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            check::$name::<Frame32>();
            check::$name::<Frame64>();
        }
    )*};
}
use for_both;

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
    narrow(frame::at_angle(n, angle))
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
