//! Checks of codecs with codes of any width, up to 64 bits.

use super::{LENGTH_ROUNDING, Summary, angle_deg, length, widen};
use crate::sampling::{Rng, special_inputs, usable};
use glam::Vec3;
use unitvec::Listed;
use unitvec::codec::Code;

/// The direction whose error is measured, for a direction that is encoded: itself, or that of the codec's domain.
pub type Domain = fn([f64; 3]) -> [f64; 3];

/// The whole sphere.
pub fn sphere(v: [f64; 3]) -> [f64; 3] {
    v
}

/// The hemisphere z >= 0: below the equator the horizontal part, or +Z.
pub fn upper(v: [f64; 3]) -> [f64; 3] {
    match v {
        [0.0, 0.0, _] => [0.0, 0.0, 1.0],
        [x, y, z] => [x, y, z.max(0.0)],
    }
}

/// Every pattern of `C`'s bits if there are at most 2^16, else 2^18 at even distances; then 2^19 random ones, with
/// anything in the bits above.
pub fn patterns<C: Listed>(seed: u64) -> impl Iterator<Item = u64> {
    let mut rng = Rng::new(seed);
    let (stride, count) =
        if C::BITS <= 16 { (1, 1 << C::BITS) } else { ((1 << (C::BITS - 18)) + 1, 1 << 18) };
    (0..count).map(move |i: u64| i.wrapping_mul(stride)).chain((0..1 << 19).map(move |_| rng.bits()))
}

/// The code of a pattern.
pub fn code<C: Listed>(bits: u64) -> C::Code {
    C::Code::from_words([bits as u32, (bits >> 32) as u32])
}

/// The pattern of a code.
pub fn bits<C: Listed>(code: C::Code) -> u64 {
    let [low, high] = code.to_words();
    u64::from(low) | (u64::from(high) << 32)
}

/// What comes back of `v`.
pub fn round_trip<C: Listed>(v: Vec3) -> Vec3 {
    C::decode(C::encode(v))
}

/// The angle in degrees between a direction and what comes back.
pub fn error_deg<C: Listed>(v: Vec3) -> f64 {
    angle_deg(widen(v), widen(round_trip::<C>(v)))
}

/// Asserts that every pattern, decoded, encoded and decoded, gives the first vector, that encoding leaves the unused
/// bits 0, and that decoding ignores them.
pub fn assert_stable<C: Listed>(patterns: impl Iterator<Item = u64>) {
    for pattern in patterns {
        let once = C::decode(code::<C>(pattern));
        let again = C::encode(once);
        assert!(once.is_finite() && bits::<C>(again) >> C::BITS == 0, "{}: {pattern:#x}", C::NAME);
        let twice = C::decode(again);
        assert_eq!(twice, once, "{}: {pattern:#x} comes back as {:#x}", C::NAME, bits::<C>(again));
        let clean = pattern & ((1 << C::BITS) - 1);
        assert_eq!(C::decode(code::<C>(clean)), once, "{}: {pattern:#x}", C::NAME);
    }
}

/// Asserts that every pattern decodes to a vector of unit length to 2 ULP.
pub fn assert_unit<C: Listed>(patterns: impl Iterator<Item = u64>) {
    let off = patterns.map(|pattern| {
        let off = (length(widen(C::decode(code::<C>(pattern)))) - 1.0).abs();
        assert!(off <= LENGTH_ROUNDING, "{}: {pattern:#x} is {off:e} off", C::NAME);
        off
    });
    println!("{}: {:e} off unit length", C::NAME, Summary::of(off).max);
}

/// Asserts that `C` decodes each pattern to the oracle's vector, to `tolerance` in each component.
pub fn assert_decodes<C: Listed>(
    patterns: impl Iterator<Item = u64>,
    oracle: impl Fn(u64) -> [f64; 3],
    tolerance: f64,
) {
    for pattern in patterns {
        let (actual, expected) = (widen(C::decode(code::<C>(pattern))), oracle(pattern));
        let off = (0..3).map(|i| (actual[i] - expected[i]).abs()).fold(0.0, f64::max);
        assert!(off <= tolerance, "{}: {pattern:#x} gives {actual:?} for {expected:?}", C::NAME);
    }
}

/// Measures the errors of `directions` and asserts that their mean is within 5 % below and 1 % above the published one,
/// their maximum at most 4 % above it (to half a unit of the fifth digit), and that none exceeds
/// [`Codec::MAX_ERROR_DEG`].
pub fn assert_published<C: Listed>(directions: impl Iterator<Item = Vec3>, published: Summary) {
    let half_digit = 0.000_005;
    let ours = Summary::of(directions.map(error_deg::<C>));
    println!("{} error: mean {:.6} max {:.6}, published {published:?}", C::NAME, ours.mean, ours.max);
    assert!(ours.mean <= (published.mean + half_digit) * 1.01, "{}: {ours:?}", C::NAME);
    assert!(ours.mean >= (published.mean - half_digit) * 0.95, "{}: {ours:?}", C::NAME);
    assert!(ours.max <= (published.max + half_digit) * 1.04, "{}: {ours:?}", C::NAME);
    assert!(ours.max <= f64::from(C::MAX_ERROR_DEG), "{}: {ours:?}", C::NAME);
}

/// Asserts that the largest error of `directions` is within 95 and 100 % of `bound_deg`, but for `slack_deg` of higher
/// order or rounding, and at most [`Codec::MAX_ERROR_DEG`].
pub fn assert_attains<C: Listed>(directions: impl Iterator<Item = Vec3>, bound_deg: f64, slack_deg: f64) {
    let worst = Summary::of(directions.map(error_deg::<C>)).max;
    println!("{} worst: {worst:.8}, {:.3} % of {bound_deg:.8}", C::NAME, worst / bound_deg * 100.0);
    assert!(worst >= 0.95 * bound_deg, "{}: {worst} of {bound_deg}", C::NAME);
    assert!(worst <= bound_deg + slack_deg, "{}: {worst} exceeds {bound_deg}", C::NAME);
    assert!(worst <= f64::from(C::MAX_ERROR_DEG), "{}: {worst} exceeds MAX_ERROR_DEG", C::NAME);
}

/// Asserts the contract of `encode` for special inputs and `more`: a code of the codec's bits; +Z's without a usable
/// direction; with one, unless the codec stores raw components, an error within the bound.
pub fn assert_total<C: Listed>(more: impl Iterator<Item = [f32; 3]>, domain: Option<Domain>) {
    let z = bits::<C>(C::encode(Vec3::Z));
    for v in special_inputs().into_iter().chain(more) {
        let vector = Vec3::from_array(v);
        let code = bits::<C>(C::encode(vector));
        assert!(code >> C::BITS == 0, "{}: {v:?} gives {code:#x}", C::NAME);
        let decoded = round_trip::<C>(vector);
        assert!(decoded.is_finite() && decoded != Vec3::ZERO, "{}: {v:?} gives {decoded:?}", C::NAME);
        match (usable(v), domain) {
            (Some(false), _) => assert_eq!(code, z, "{}: {v:?}", C::NAME),
            (Some(true), Some(domain)) => {
                let direction = domain(v.map(f64::from));
                let error = angle_deg(direction, widen(decoded));
                let short = direction.iter().map(|t| t.abs()).sum::<f64>() < 2f64.powi(-99);
                let fits = error <= f64::from(C::MAX_ERROR_DEG) || (short && code == z);
                assert!(fits, "{}: {v:?} comes back {error} degrees off", C::NAME);
            }
            _ => {}
        }
    }
}

/// Asserts that `C` decodes the image of each direction under `f` to the image of the decoded vector.
pub fn assert_commutes<C: Listed>(directions: impl Iterator<Item = Vec3>, f: fn(Vec3) -> Vec3) {
    for v in directions {
        assert_eq!(round_trip::<C>(f(v)), f(round_trip::<C>(v)), "{}: {v:?}", C::NAME);
    }
}

/// Unit vectors within `radius` of `centre` along each axis.
pub fn around(seed: u64, count: usize, centre: [f64; 3], radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let v = centre.map(|t| t + rng.range(-radius, radius));
        let l = length(v);
        Vec3::from_array(v.map(|t| (t / l) as f32))
    })
}
