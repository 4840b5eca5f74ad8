//! Rows of the list against each other.

use std::collections::BTreeSet;
use unitvec_oracle::Summary;
use unitvec_tests::directions::{hemisphere, sphere};
use unitvec_tests::tested::Tested;

/// Identifiers and the survey's names are unique.
#[test]
fn names_are_unique() {
    let names =
        |name: fn(&Tested) -> &'static str| Tested::all().iter().map(name).collect::<BTreeSet<_>>().len();
    assert_eq!(names(|codec| codec.id), Tested::all().len());
    assert_eq!(names(|codec| codec.survey_name), Tested::all().len());
}

/// A precise encoder's mean error is below that of the fast encoder of its format.
#[test]
fn precise_encoders_are_better_than_fast_ones() {
    let fast_of = |precise: &Tested| {
        let fast = precise.id.strip_suffix('p')?;
        Tested::all().iter().find(|codec| codec.id == fast)
    };
    let pairs: Vec<[&Tested; 2]> =
        Tested::all().iter().filter_map(|precise| Some([precise, fast_of(precise)?])).collect();
    assert!(pairs.len() >= 13, "{pairs:?}");
    for codecs in pairs {
        let directions = || sphere(3, 50_000).chain(hemisphere(4, 50_000));
        let [precise, fast] = codecs.map(|codec| Summary::of(directions().map(|v| codec.error_deg(v))).mean);
        assert!(precise < fast, "{}", codecs[0].id);
    }
}
