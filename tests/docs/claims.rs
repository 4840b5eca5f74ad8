//! Claims of README and docs in words, held against the measurements.

use super::accuracy::{Errors, of};
use super::costs;
use unitvec_catalogue::Operation;
use unitvec_catalogue::{Domain, vectors};
use unitvec_lab::accuracy::Table;
use unitvec_tests::repository;
use unitvec_vulkan::{GROUP, WORKGROUP};

fn errors(id: &str) -> Errors {
    of(id, "direction")
}

/// Costs of encoding and decoding on RDNA 2.
fn costs_of(id: &str) -> [f64; 2] {
    Operation::ALL.map(|operation| costs::cost(id, operation))
}

/// True where mean and maximum of the first codec are below those of the second.
fn is_finer(id: &str, than: &str) -> bool {
    let (own, other) = (errors(id), errors(than));
    own.mean < other.mean && own.max < other.max
}

/// docs/kernels.md: how many vectors fit the least limits of Vulkan, and how they are shared out.
#[test]
fn limits_of_a_dispatch() {
    let text = std::fs::read_to_string(repository().join("docs/kernels.md")).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let grouped = |number: usize| {
        let digits = number.to_string();
        let groups =
            digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group).into_owned());
        groups.collect::<Vec<_>>().join(" ")
    };
    let taken = GROUP * WORKGROUP;
    for said in [
        format!("{WORKGROUP} invocations, which take {taken} vectors"),
        format!("{} vectors or {} frames", grouped((1 << 27) / 12), grouped((1 << 27) / 28)),
        format!("{}, which take {}", grouped(65_535), grouped(65_535 * taken)),
        format!("(count + {}) / {taken}", taken - 1),
    ] {
        assert!(text.contains(&said), "{said}");
    }
}

/// docs/costs.md, "Which to take".
#[test]
fn what_to_take() {
    // Only `hemioct` among unit vectors costs less than `oct32`, and not by much.
    for codec in vectors().iter().filter(|codec| codec.is_unit && codec.bits <= 32) {
        let least = if codec.family == "hemioct" { 0.85 } else { 1.0 };
        assert!(costs_of(codec.id).iter().all(|cost| *cost >= least), "{}", codec.id);
    }
    for bits in [16, 24, 32] {
        let id = |family: &str| family.replace('N', &bits.to_string());
        let [fast, precise, hemioct] = ["octN", "octNp", "hemioctN"].map(id);
        // The precise encoder takes a third off the maximum; the decoder is the same.
        assert!((0.63..0.7).contains(&(errors(&precise).max / errors(&fast).max)));
        assert_eq!(costs_of(&precise)[1], costs_of(&fast)[1]);
        assert!(is_finer(&hemioct, &precise));
        assert!((0..2).all(|operation| costs_of(&hemioct)[operation] < costs_of(&fast)[operation]));
        for codec in vectors().iter().filter(|codec| codec.bits == bits && codec.domain == Domain::Sphere) {
            let ico = id("icoN");
            assert!(codec.id == ico || errors(codec.id).max > errors(&ico).max, "{}", codec.id);
        }
        for other in ["sphericalN", "stereoN", "eqareaN", "eqdistN", "warpedcubeN", "sppN", "cubeN"].map(id) {
            assert!(is_finer(&precise, &other) && costs_of(&other)[1] > costs_of(&precise)[1], "{other}");
        }
    }
    assert!(is_finer("oct24p", "snorm8x3p"));
}

/// docs/costs.md: on lavapipe no codec decodes faster by table.
#[test]
fn tables_do_not_pay_on_lavapipe() {
    let found: Vec<f64> = vectors().iter().filter_map(|codec| costs::by_table(codec.id)).collect();
    assert!(found.len() > 20 && found.iter().all(|ratio| *ratio < 1.0));
}

/// docs/codecs.md: at 16, 24 and 32 bits `ico` beats every row of the survey's table 1.
#[test]
fn ico_beats_the_survey() {
    for bits in [16, 24, 32] {
        let ico = errors(&format!("ico{bits}"));
        for row in Table::One.published().iter().filter(|row| row.bits == bits) {
            // A sample leaves a thousandth of the mean open, the survey half a unit of the last digit that it prints.
            let mean = 1.001 * row.mean_error_deg + 0.5e-5;
            assert!(ico.max < row.max_error_deg && ico.mean < mean, "{}", row.name);
        }
    }
}
