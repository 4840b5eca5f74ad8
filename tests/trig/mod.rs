//! The crate's trigonometry: coefficients, and errors against float64.
//!
//! "All floats from a to b" are every 31st (a step that shares no pattern with powers of two), the ends apart.

mod values;

use glam::Vec2;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI};
use unitvec::arith;
use unitvec_tests::directions::Rng;
use unitvec_tests::remez::{Problem, assert_minimax};

/// A function under test.
type Function = fn(f32) -> f32;

const PI_F32: f64 = std::f32::consts::PI as f64;
const FRAC_1_PI_F32: f64 = std::f32::consts::FRAC_1_PI as f64;

/// 2^-12: from here to 1 floats are tried densely.
const SMALL: f32 = 1.0 / 4096.0;
/// 2^-100: smaller numbers count as 0.
const TINY: f32 = arith::NEGLIGIBLE;

/// Constants of `arith`.
macro_rules! constants {
    ($($name:ident)*) => { [$(arith::$name),*] };
}

const SIN: [f32; 4] = constants!(SIN_0 SIN_1 SIN_2 SIN_3);
const COS: [f32; 4] = constants!(COS_0 COS_1 COS_2 COS_3);
const ATAN: [f32; 9] = constants!(ATAN_0 ATAN_1 ATAN_2 ATAN_3 ATAN_4 ATAN_5 ATAN_6 ATAN_7 ATAN_8);
const TAN: [f32; 7] = constants!(TAN_0 TAN_1 TAN_2 TAN_3 TAN_4 TAN_5 TAN_6);
const DIAGONAL_COS: [f32; 4] = constants!(DIAGONAL_COS_0 DIAGONAL_COS_1 DIAGONAL_COS_2 DIAGONAL_COS_3);
const DIAGONAL_SIN: [f32; 3] = constants!(DIAGONAL_SIN_0 DIAGONAL_SIN_1 DIAGONAL_SIN_2);
const ASIN: [f32; 6] = constants!(ASIN_0 ASIN_1 ASIN_2 ASIN_3 ASIN_4 ASIN_5);
const TURN: [f32; 8] = constants!(TURN_0 TURN_1 TURN_2 TURN_3 TURN_4 TURN_5 TURN_6 TURN_7);

/// A function in float64.
type Exact = fn(f64) -> f64;

/// `r / f(r)` of `u = r^2`: by this the fits with least relative error are weighted.
const OVER_SIN: Exact = |u| u.sqrt() / (PI * u.sqrt()).sin();
const OVER_ATAN: Exact = |u| u.sqrt() / (u.sqrt().atan() / FRAC_PI_4);
const OVER_TAN: Exact = |u| u.sqrt() / (u.sqrt() * FRAC_PI_4).tan();
const OVER_ASIN: Exact = |u| u.sqrt() / (u.sqrt().asin() / PI);

/// The d of which `w` is 1/4 - d^2.
const FROM_MIDDLE: Exact = |w| (0.25 - w).sqrt();
const COS_FROM_DIAGONAL: Exact = |d| (FRAC_PI_2 * d).cos() * FRAC_1_SQRT_2;
const SIN_FROM_DIAGONAL: Exact = |d| (FRAC_PI_2 * d).sin() * FRAC_1_SQRT_2;

/// Each set of coefficients is what the Remez exchange gives, rounded to f32, and leaves the error the docs state.
#[test]
fn coefficients_are_minimax() {
    let sin = Problem { target: |u| 1.0 - PI_F32 * OVER_SIN(u), weight: OVER_SIN, end: 0.0625 };
    let cos = Problem {
        target: |u| (PI * u.sqrt()).cos() - (1.0 + f64::from(arith::COS_0) * u),
        weight: |u| u * u,
        end: 0.0625,
    };
    let atan = Problem { target: |u| 1.0 - OVER_ATAN(u), weight: |u| OVER_ATAN(u) * (1.0 - u), end: 1.0 };
    let tan = Problem { target: |u| 1.0 - OVER_TAN(u), weight: |u| OVER_TAN(u) * (1.0 - u), end: 1.0 };
    let asin = Problem { target: |u| 1.0 - FRAC_1_PI_F32 * OVER_ASIN(u), weight: OVER_ASIN, end: 0.25 };
    let diagonal_cos =
        Problem { target: |w| COS_FROM_DIAGONAL(FROM_MIDDLE(w)) - 0.5, weight: |w| w, end: 0.25 };
    // Short of the end, where both are 0.
    let diagonal_sin = Problem {
        target: |w| SIN_FROM_DIAGONAL(FROM_MIDDLE(w)) - FROM_MIDDLE(w),
        weight: |w| FROM_MIDDLE(w) * w,
        end: 0.25 - 1e-12,
    };
    let turn = Problem { target: |u| u.sqrt().atan() / FRAC_PI_2, weight: f64::sqrt, end: 1.0 };
    let cases: [(&str, Problem, &[f32], f64); 8] = [
        ("sin", sin, &SIN, 3.3e-9),
        ("cos", cos, &COS[1..], 4.1e-10),
        ("atan", atan, &ATAN, 2.5e-9),
        ("tan", tan, &TAN, 1.3e-9),
        ("asin", asin, &ASIN, 4.5e-9),
        ("diagonal_cos", diagonal_cos, &DIAGONAL_COS, 3.8e-11),
        ("diagonal_sin", diagonal_sin, &DIAGONAL_SIN, 9.8e-10),
        ("turn", turn, &TURN, 5.1e-8),
    ];
    assert_eq!(arith::COS_0, (-PI * PI / 2.0) as f32);
    for (name, problem, constants, bound) in cases {
        assert_minimax(name, &problem, constants, bound);
    }
}

/// The three parts of pi/2: the first two are its leading 8 and next 11 bits, the third is the rest rounded.
#[test]
fn half_pi_is_split() {
    let cut = |x: f64, bits: i32| (x * 2f64.powi(bits)).floor() / 2f64.powi(bits);
    let high = cut(FRAC_PI_2, 7);
    let middle = cut(FRAC_PI_2 - high, 22);
    assert_eq!(f64::from(arith::HALF_PI_HIGH), high);
    assert_eq!(f64::from(arith::HALF_PI_MIDDLE), middle);
    assert_eq!(arith::HALF_PI_LOW, (FRAC_PI_2 - high - middle) as f32);
}

/// The GLSL mirror has the same constants.
#[test]
fn glsl_constants_are_the_crates() {
    let text = include_str!("../../glsl/unitvec/arith.glsl");
    let numbered = |name: &str, values: &[f32]| -> Vec<(String, f32)> {
        values.iter().enumerate().map(|(i, &value)| (format!("{name}_{i}"), value)).collect()
    };
    let families = [
        ("SIN", &SIN[..]),
        ("COS", &COS),
        ("ATAN", &ATAN),
        ("TAN", &TAN),
        ("ASIN", &ASIN),
        ("TURN", &TURN),
        ("DIAGONAL_COS", &DIAGONAL_COS),
        ("DIAGONAL_SIN", &DIAGONAL_SIN),
        ("WARP", &[arith::WARP_0, arith::WARP_1, arith::WARP_2]),
        ("UNWARP", &[arith::UNWARP_0, arith::UNWARP_1, arith::UNWARP_2]),
    ];
    let mut constants: Vec<(String, f32)> =
        families.iter().flat_map(|(name, values)| numbered(name, values)).collect();
    let others = [
        ("HALF_PI_HIGH", arith::HALF_PI_HIGH),
        ("HALF_PI_MIDDLE", arith::HALF_PI_MIDDLE),
        ("HALF_PI_LOW", arith::HALF_PI_LOW),
        ("PI", std::f32::consts::PI),
        ("FRAC_1_PI", std::f32::consts::FRAC_1_PI),
        ("FRAC_2_PI", std::f32::consts::FRAC_2_PI),
        ("NEGLIGIBLE", arith::NEGLIGIBLE),
        ("ENORMOUS", arith::ENORMOUS),
        ("MAX_RADIANS", arith::MAX_RADIANS),
        ("MIN_NORM", unitvec::direction::MIN_NORM),
        ("MAX_NORM", unitvec::direction::MAX_NORM),
        ("MIN_POSITIVE", f32::MIN_POSITIVE),
        ("2_23", 8_388_608.0),
        ("ONE_AND_A_HALF_2_23", 1.5 * 8_388_608.0),
        ("ANGLES_LEAST_X", 2f32.powi(-40)),
        ("ANGLES_LEAST_Y", 2f32.powi(-61)),
    ];
    constants.extend(others.map(|(name, value)| (name.to_owned(), value)));

    let lines: Vec<&str> = text.lines().filter(|line| line.starts_with("const float")).collect();
    assert_eq!(lines.len(), constants.len(), "constants of arith.glsl");
    for (name, value) in constants {
        let start = format!("const float UNITVEC_{name} = ");
        let literal = lines.iter().find_map(|line| line.strip_prefix(&start)?.strip_suffix(';'));
        // Compilers may read a literal so: in float64, then rounded.
        let read = literal.and_then(|literal| literal.parse::<f64>().ok()).map(|number| number as f32);
        assert_eq!(read.map(f32::to_bits), Some(value.to_bits()), "{name}: {literal:?}");
    }
}

/// Every `step`-th float from `low` to `high`, both positive.
fn floats(low: f32, high: f32, step: usize) -> impl Iterator<Item = f32> {
    (low.to_bits()..=high.to_bits()).step_by(step).map(f32::from_bits)
}

/// Floats from 2^-100 to `high` (at least 2^-12): sparsely up to 2^-12, then every 31st.
fn positive(high: f32) -> impl Iterator<Item = f32> {
    floats(TINY, SMALL, 1009).chain(floats(SMALL, high, 31)).chain([high])
}

/// The greatest absolute and relative difference, and where they are.
#[derive(Debug, Default)]
struct Worst {
    absolute: f64,
    relative: f64,
    at: [f32; 2],
}

impl Worst {
    fn of(
        arguments: impl Iterator<Item = f32>,
        ours: impl Fn(f32) -> f32,
        exact: impl Fn(f64) -> f64,
    ) -> Self {
        let mut worst = Self::default();
        arguments.for_each(|t| worst.add(t, ours(t), exact(f64::from(t))));
        worst
    }

    fn add(&mut self, argument: f32, ours: f32, exact: f64) {
        let absolute = (f64::from(ours) - exact).abs();
        // NaN must not pass.
        assert!(absolute < f64::INFINITY, "{argument:e}: {ours}");
        if absolute > self.absolute {
            (self.absolute, self.at[0]) = (absolute, argument);
        }
        if absolute > self.relative * exact.abs() {
            (self.relative, self.at[1]) = (absolute / exact.abs(), argument);
        }
    }

    fn assert_within(&self, what: &str, absolute: f64, relative: f64) {
        println!("{what}: {:.4e} absolute, {:.4e} relative, at {:?}", self.absolute, self.relative, self.at);
        assert!(self.absolute <= absolute && self.relative <= relative, "{what}: {self:?}");
    }
}

/// sin(pi t) of t in [0, 1] without the rounding of a product with pi near 1.
const SIN_HALF_TURNS: Exact = |t| if t > 0.5 { (PI * (1.0 - t)).sin() } else { (PI * t).sin() };
const COS_HALF_TURNS: Exact = |t| (PI * (0.5 - t)).sin();

/// A function, its exact form, and its absolute and relative error at most.
type Row = (&'static str, Function, Exact, f64, f64);

/// Error over all floats from 2^-100 to 1.
#[test]
fn errors_are_as_stated() {
    let rows: [Row; 8] = [
        ("sin_half_turns", |t| arith::sin_cos_half_turns(t).y, SIN_HALF_TURNS, 7.4e-8, 1.2e-7),
        ("cos_half_turns", |t| arith::sin_cos_half_turns(t).x, COS_HALF_TURNS, 7.4e-8, 1.2e-7),
        ("atan_octant", arith::atan_octant, |r| r.atan() / FRAC_PI_4, 5.3e-8, 1.1e-7),
        ("tan_octant", arith::tan_octant, |t| (t * FRAC_PI_4).tan(), 5.1e-8, 1.1e-7),
        ("asin_half_turns", arith::asin_half_turns, |x| x.asin() / PI, 4.4e-8, 2.5e-7),
        ("asin", arith::asin, f64::asin, 2.1e-7, 3.3e-7),
        ("sin to 1", arith::sin, f64::sin, 1.3e-7, 2.0e-7),
        ("cos to 1", arith::cos, f64::cos, 1.3e-7, 2.0e-7),
    ];
    for (name, ours, exact, absolute, relative) in rows {
        Worst::of(positive(1.0), ours, exact).assert_within(name, absolute, relative);
    }
}

/// Error from -1 to 1, but for what is next to 0; near 1 relative to acos itself.
#[test]
fn acos_error() {
    let rows: [Row; 2] = [
        ("acos_half_turns", arith::acos_half_turns, |x| x.acos() / PI, 7.1e-8, 1.6e-7),
        ("acos", arith::acos, f64::acos, 3.9e-7, 2.3e-7),
    ];
    for (name, ours, exact, absolute, relative) in rows {
        let both = positive(1.0).flat_map(|x| [x, -x]);
        Worst::of(both, ours, exact).assert_within(name, absolute, relative);
    }
}

/// Error up to 2^13.
#[test]
fn radian_sin_cos_error() {
    let arguments = || floats(1.0, arith::MAX_RADIANS.next_down(), 17);
    Worst::of(arguments(), arith::sin, f64::sin).assert_within("sin to 2^13", 1.3e-7, f64::INFINITY);
    Worst::of(arguments(), arith::cos, f64::cos).assert_within("cos to 2^13", 1.3e-7, f64::INFINITY);
}

/// The pair has unit length to within 9.2e-8, less than 2 ULP, over all floats of the first quarter turn.
#[test]
fn sin_cos_half_turns_has_unit_length() {
    let length = |t| {
        let [x, y] = arith::sin_cos_half_turns(t).to_array().map(f64::from);
        x.hypot(y)
    };
    let worst = positive(0.5).map(|t| (length(t) - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst <= 9.2e-8, "{worst}");
}

/// Error, of the parts and of the cosine and sine they make up, and unit length to within 1.1e-7, over all floats from
/// -1/2 to 1/2; at the ends cosine and sine are exact.
#[test]
fn from_diagonal_error() {
    let both = || positive(0.5).chain(positive(0.5).map(|d| -d));
    let cos = |d| arith::from_diagonal(d).x - arith::from_diagonal(d).y;
    let sin = |d| arith::from_diagonal(d).x + arith::from_diagonal(d).y;
    let angle = |d: f64| FRAC_PI_2 * (d + 0.5);
    let any = f64::INFINITY;
    Worst::of(both(), |d| arith::from_diagonal(d).x, COS_FROM_DIAGONAL).assert_within(
        "diagonal cos",
        5.9e-8,
        any,
    );
    Worst::of(both(), |d| arith::from_diagonal(d).y, SIN_FROM_DIAGONAL).assert_within(
        "diagonal sin",
        2.0e-8,
        any,
    );
    Worst::of(both(), cos, |d| angle(d).cos()).assert_within("cos from diagonal", 9.9e-8, any);
    Worst::of(both(), sin, |d| angle(d).sin()).assert_within("sin from diagonal", 9.9e-8, any);

    let length = |d| f64::from(cos(d)).hypot(f64::from(sin(d)));
    let worst = both().map(|d| (length(d) - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst <= 1.1e-7, "{worst:e}");
    let end = arith::from_diagonal(0.5);
    assert_eq!((end, arith::from_diagonal(-0.5)), (Vec2::new(0.5, 0.5), Vec2::new(0.5, -0.5)));
}

/// The floats around every multiple of pi/4 up to 2^13, where the quadrant changes or a function is near 0: error
/// as elsewhere, never -0.
#[test]
fn radian_sin_cos_near_multiples_of_a_quarter_pi() {
    let around = |k: u32| {
        let nearest = (f64::from(k) * FRAC_PI_4) as f32;
        (nearest.to_bits() - 50..=nearest.to_bits() + 50).map(f32::from_bits)
    };
    let arguments = || (1..10_000).flat_map(around).filter(|x| *x < arith::MAX_RADIANS);
    Worst::of(arguments(), arith::sin, f64::sin).assert_within("sin", 1.3e-7, f64::INFINITY);
    Worst::of(arguments(), arith::cos, f64::cos).assert_within("cos", 1.3e-7, f64::INFINITY);
    for x in arguments().flat_map(|x| [x, -x]) {
        assert!(no_negative_zero(arith::sin_cos(x)), "{x}");
    }
}

fn no_negative_zero(v: Vec2) -> bool {
    [v.x, v.y].iter().all(|c| c.to_bits() != (-0f32).to_bits())
}

/// Vectors of all kinds: random angles, random lengths, near the axes by every power of two to 2^-60, and near the
/// diagonals.
fn vectors(count: usize) -> impl Iterator<Item = Vec2> {
    let mut rng = Rng::new(1);
    (0..count).map(move |i| {
        let angle = rng.range(-PI, PI);
        let length = rng.range(-90.0, 90.0).exp2();
        let [x, y] = [angle.cos(), angle.sin()];
        let small = rng.range(-60.0, 0.0).exp2();
        let [x, y] = match i % 5 {
            0 => [x, y],
            1 => [x * small, y],
            2 => [x, y * small],
            3 => [x, x.copysign(y) * (1.0 + small)],
            _ => [x * length, y * length],
        };
        Vec2::new(x as f32, y as f32)
    })
}

/// Error over 10^7 vectors of all kinds.
#[test]
fn atan2_error() {
    let (mut half_turns, mut radians, mut octants) = (Worst::default(), Worst::default(), Worst::default());
    for v in vectors(10_000_000) {
        let exact = f64::from(v.y).atan2(f64::from(v.x));
        half_turns.add(v.y, arith::atan2_half_turns(v.y, v.x), exact / PI);
        radians.add(v.y, arith::atan2(v.y, v.x), exact);
        if 0.0 <= v.y && v.y <= v.x {
            octants.add(v.y, arith::atan_octant_ratio(v.y, v.x), exact / FRAC_PI_4);
        }
    }
    half_turns.assert_within("atan2_half_turns", 5.0e-8, 1.5e-7);
    radians.assert_within("atan2", 3.4e-7, 2.3e-7);
    octants.assert_within("atan_octant_ratio", 7.9e-8, 1.5e-7);
}
