//! Every codec takes any input: the assertion of [`unitvec_tests::suite::takes_anything`], with inputs that proptest
//! makes and, where one fails, makes simple.

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use unitvec_tests::checks::{assert_total, assert_unit};
use unitvec_tests::tested::Tested;

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100_000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// Any three bit patterns taken as floats: most directions lie close to an axis.
    #[test]
    fn any_bits_keep_the_contract(bits in any::<[u32; 3]>()) {
        Tested::all().iter().for_each(|codec| assert_total(codec, Vec3::from_array(bits.map(f32::from_bits))));
    }

    /// Any three floats of exponents that are close together, so that the directions are all over the sphere.
    #[test]
    fn any_vector_keeps_the_contract(bits in any::<[u32; 3]>(), exponent in 20u32..232) {
        let v = bits.map(|b| f32::from_bits((b & 0x81ff_ffff) + (exponent << 23)));
        Tested::all().iter().for_each(|codec| assert_total(codec, Vec3::from_array(v)));
    }

    /// Any code, with any bits above it.
    #[test]
    fn any_code_keeps_the_contract(code in any::<u64>()) {
        Tested::all().iter().for_each(|codec| assert_unit(codec, code, codec.decode(code)));
    }
}
