//! Every codec of two coordinates takes any input and gives what the contract of [`unitvec::Codec`] says.

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use unitvec::Codec;
use unitvec::Listed;
use unitvec::azimuthal;
use unitvec_tests::oracle::azimuthal as papers;
use unitvec_tests::oracle::{
    self, Cylindrical, EaOct, Fib, HemiOct, LatLong, LatLongD, Oct, Oracle, Spherical, angle_deg, length,
    widen,
};
use unitvec_tests::sampling::{self, END_OF_NORMS, LEAST_NORM, special_inputs, sphere, usable};

/// A codec and the oracle of its mapping.
trait Checked: Codec<Code = u32> {
    type Oracle: Oracle;
}

impl<const BITS: u32> Checked for unitvec::oct::Oct<BITS> {
    type Oracle = Oct;
}

impl<const BITS: u32> Checked for unitvec::oct::OctPrecise<BITS> {
    type Oracle = Oct;
}

impl<const BITS: u32> Checked for unitvec::eaoct::EaOct<BITS> {
    type Oracle = EaOct;
}

impl<const BITS: u32> Checked for unitvec::eaoct::EaOctPrecise<BITS> {
    type Oracle = EaOct;
}

impl<const BITS: u32> Checked for unitvec::hemioct::HemiOct<BITS> {
    type Oracle = HemiOct;
}

impl<const BITS: u32> Checked for unitvec::cylindrical::Cylindrical<BITS> {
    type Oracle = Cylindrical;
}

impl<const BITS: u32> Checked for unitvec::fib::Fib<BITS> {
    type Oracle = Fib;
}

impl<const BITS: u32> Checked for unitvec::ico::Ico<BITS> {
    type Oracle = oracle::Ico;
}

impl<const BITS: u32> Checked for unitvec::latlong::LatLong<BITS> {
    type Oracle = LatLong;
}

impl<const BITS: u32> Checked for unitvec::latlong::LatLongD<BITS> {
    type Oracle = LatLongD;
}

impl<const BITS: u32> Checked for unitvec::spherical::Spherical<BITS> {
    type Oracle = Spherical;
}

/// For each pair of a projection and a map, the oracle's own.
macro_rules! check_azimuthal {
    ($($projection:ident $map:ident $papers_projection:ident $papers_map:ident;)*) => {$(
        impl<const BITS: u32> Checked for unitvec::azimuthal::Azimuthal<azimuthal::$projection, azimuthal::$map, BITS> {
            type Oracle = papers::Azimuthal<{ papers::$papers_projection }, { papers::$papers_map }>;
        }
    )*};
}

check_azimuthal! {
    Stereo Plain STEREO PLAIN;
    Stereo Concentric STEREO CONCENTRIC;
    Stereo Ellipse STEREO ELLIPSE;
    Eqarea Plain EQAREA PLAIN;
    Eqarea Concentric EQAREA CONCENTRIC;
    Eqarea Ellipse EQAREA ELLIPSE;
    Eqdist Plain EQDIST PLAIN;
    Eqdist Concentric EQDIST CONCENTRIC;
    Eqdist Ellipse EQDIST ELLIPSE;
}

/// Calls `check::<codec>(arguments)` for every codec.
macro_rules! for_every_codec {
    ($check:ident($($argument:expr),*)) => {
        for_every_codec!($check($($argument),*): Oct16 Oct20 Oct22 Oct24 Oct32
            OctPrecise16 OctPrecise20 OctPrecise22 OctPrecise24 OctPrecise32 HemiOct16 HemiOct24 HemiOct32
            EaOct16 EaOct20 EaOct22 EaOct24 EaOct32
            EaOctPrecise16 EaOctPrecise20 EaOctPrecise22 EaOctPrecise24 EaOctPrecise32
            Spherical16 Spherical20 Spherical22 Spherical24 Spherical32 Cylindrical16 Cylindrical24 Cylindrical32
            Fib16 Fib24 Fib32 Ico16 Ico24 Ico32 LatLong16 LatLong24 LatLong32 LatLongD16 LatLongD24 LatLongD32
            Stereo16 Stereo20 Stereo22 Stereo24 Stereo32
            StereoConcentric16 StereoConcentric20 StereoConcentric22 StereoConcentric24 StereoConcentric32
            StereoEllipse16 StereoEllipse20 StereoEllipse22 StereoEllipse24 StereoEllipse32
            Eqarea16 Eqarea20 Eqarea22 Eqarea24 Eqarea32
            EqareaConcentric16 EqareaConcentric20 EqareaConcentric22 EqareaConcentric24 EqareaConcentric32
            EqareaEllipse16 EqareaEllipse20 EqareaEllipse22 EqareaEllipse24 EqareaEllipse32
            Eqdist16 Eqdist20 Eqdist22 Eqdist24 Eqdist32
            EqdistConcentric16 EqdistConcentric20 EqdistConcentric22 EqdistConcentric24 EqdistConcentric32
            EqdistEllipse16 EqdistEllipse20 EqdistEllipse22 EqdistEllipse24 EqdistEllipse32);
    };
    ($check:ident $arguments:tt: $($codec:ident)*) => {
        $($check::<unitvec::$codec> $arguments;)*
    };
}

/// Asserts the contract of `encode`: a code of the codec's bits, that of +Z if `v` has no usable direction, and one
/// within the maximal error of the direction if it has.
fn check_encode<C: Checked + Listed>(v: [f32; 3]) {
    let code = C::encode(Vec3::from_array(v));
    assert!(u64::from(code) < 1 << C::BITS, "{}: {v:?} gives {code:#x}", C::NAME);
    let exact = v.map(f64::from);
    let plus_z = code == C::encode(Vec3::Z);
    let usable = usable(v);
    if usable == Some(false) {
        assert!(plus_z, "{}: {v:?} has no direction but the code {code:#x}", C::NAME);
        return;
    }
    let direction = C::Oracle::domain(exact);
    // By the codec's own decoder: at the border of what the plain azimuthal maps write, f32 may take a code in that
    // float64 leaves out. That decoders are the oracle's is the families' own tests' to show.
    let error = angle_deg(direction, widen(C::decode(code)));
    // What is left of a vector below the hemisphere may itself be too short to be a direction: the contract leaves
    // open whether it counts.
    let short = direction.iter().map(|t| t.abs()).sum::<f64>() < f64::from(LEAST_NORM);
    assert!(
        error <= f64::from(C::MAX_ERROR_DEG) || (plus_z && (short || usable.is_none())),
        "{}: {v:?} gets {code:#x}, {error} degrees off",
        C::NAME
    );
}

/// Asserts the contract of `decode`: a finite vector of unit length to 2 ULP, whatever the bits.
fn check_decode<C: Checked + Listed>(code: u32) {
    let v = C::decode(code);
    let off = (length(widen(v)) - 1.0).abs();
    assert!(v.is_finite() && off <= oracle::LENGTH_ROUNDING, "{}: {code:#x} gives {v:?}", C::NAME);
}

fn check_same_code<C: Checked + Listed>(a: Vec3, b: Vec3) {
    let [code_a, code_b] = [a, b].map(C::encode);
    assert_eq!(code_a, code_b, "{}: {a:?} and {b:?}", C::NAME);
}

/// Zeros, denormals, infinities, NaN, huge and tiny numbers in all combinations, and the fold lines.
#[test]
fn special_inputs_keep_the_contract() {
    for v in special_inputs() {
        for_every_codec!(check_encode(v));
    }
}

/// The range of usable L1 norms is exactly [2^-64, 2^100).
#[test]
fn usable_norms_end_where_the_contract_says() {
    for norm in [LEAST_NORM, END_OF_NORMS.next_down()] {
        for_every_codec!(check_same_code(Vec3::X * norm, Vec3::X));
        for_every_codec!(check_same_code(Vec3::NEG_Y * norm, Vec3::NEG_Y));
    }
    for norm in [LEAST_NORM.next_down(), END_OF_NORMS] {
        for_every_codec!(check_same_code(Vec3::X * norm, Vec3::Z));
        for_every_codec!(check_same_code(Vec3::NEG_Y * norm, Vec3::Z));
    }
}

/// Components that are -0 or a denormal count as +0: it is not left to the device's treatment of them.
#[test]
fn negative_zeros_and_denormals_count_as_zero() {
    for tiny in [-0.0, -1e-40, 1e-40, -f32::from_bits(1), -f32::MIN_POSITIVE.next_down()] {
        for (a, b) in
            [(0.6, 0.8), (0.6, -0.8), (-0.6, 0.8), (-0.6, -0.8), (0.0, -1.0), (-1.0, 0.0), (0.1, -0.1)]
        {
            for_every_codec!(check_same_code(Vec3::new(tiny, a, b), Vec3::new(0.0, a, b)));
            for_every_codec!(check_same_code(Vec3::new(a, tiny, b), Vec3::new(a, 0.0, b)));
            for_every_codec!(check_same_code(Vec3::new(a, b, tiny), Vec3::new(a, b, 0.0)));
            for_every_codec!(check_same_code(Vec3::new(tiny, tiny, b), Vec3::new(0.0, 0.0, b)));
        }
    }
}

/// The length does not matter: scaled by 2^-60 to 2^60, a vector keeps its code.
#[test]
fn scaling_keeps_the_code() {
    for v in sphere(1, 2000) {
        for exponent in -60..=60 {
            for_every_codec!(check_same_code(v * 2f32.powi(exponent), v));
        }
    }
}

/// Codes of 2^20 bit patterns, the bits above the codec's included.
#[test]
fn any_code_decodes_to_a_unit_vector() {
    for code in sampling::codes32(2, 1 << 19) {
        for_every_codec!(check_decode(code));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100_000, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    /// Any three bit patterns taken as floats: most directions lie close to an axis.
    #[test]
    fn any_bits_keep_the_contract(bits in any::<[u32; 3]>()) {
        for_every_codec!(check_encode(bits.map(f32::from_bits)));
    }

    /// Any three floats of exponents that are close together, so that the directions are all over the sphere.
    #[test]
    fn any_vector_keeps_the_contract(bits in any::<[u32; 3]>(), exponent in 20u32..232) {
        for_every_codec!(check_encode(bits.map(|b| f32::from_bits((b & 0x81ff_ffff) + (exponent << 23)))));
    }

    /// Any code.
    #[test]
    fn any_code_keeps_the_contract(code in any::<u32>()) {
        for_every_codec!(check_decode(code));
    }
}
