//! What README and docs claim in words, held against the measurements.

use super::accuracy::{Errors, of, over_bound};
use super::{costs, slices};
use unitvec_catalogue::{AnyCodec, Domain, Operation, find, vectors};
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

/// True where the first codec costs less than the second both ways.
fn is_cheaper(id: &str, than: &str) -> bool {
    let ([encode, decode], [other_encode, other_decode]) = (costs_of(id), costs_of(than));
    encode < other_encode && decode < other_decode
}

/// True where mean and maximum of the first codec are below those of the second.
fn is_finer(id: &str, than: &str) -> bool {
    let (own, other) = (errors(id), errors(than));
    own.mean < other.mean && own.max < other.max
}

/// docs/kernels.md: what the least limits of Vulkan hold, and how vectors are shared out.
#[test]
fn limits_of_a_dispatch() {
    let text = std::fs::read_to_string(repository().join("docs/kernels.md")).unwrap();
    let grouped = |number: usize| {
        let digits = number.to_string();
        let groups =
            digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group).into_owned());
        groups.collect::<Vec<_>>().join(" ")
    };
    let taken = GROUP * WORKGROUP;
    for said in [
        format!("{WORKGROUP} invocations, which take {taken} vectors"),
        format!("{} vectors or {}\nframes", grouped((1 << 27) / 12), grouped((1 << 27) / 28)),
        format!("{}, which take {}", grouped(65_535), grouped(65_535 * taken)),
        format!("(count + {}) / {taken}", taken - 1),
    ] {
        assert!(text.contains(&said), "{said}");
    }
}

/// docs/costs.md, "Which to take".
#[test]
fn what_to_take() {
    // `oct32` is among the cheapest of unit vectors: only `hemioct` costs less.
    for codec in vectors().iter().filter(|codec| codec.is_unit && codec.bits <= 32) {
        let [encode, decode] = costs_of(codec.id);
        let least = if codec.family == "hemioct" { 0.85 } else { 1.0 };
        assert!(encode >= least && decode >= least, "{}", codec.id);
    }
    for bits in [16, 24, 32] {
        let id = |family: &str| family.replace('N', &bits.to_string());
        // The precise encoder: two and a half to four times the cost, a third off the maximum, the decoder the same.
        let [fast, precise] = [id("octN"), id("octNp")].map(|id| (costs_of(&id), errors(&id)));
        assert!((2.45..=4.0).contains(&(precise.0[0] / fast.0[0])) && precise.0[1] == fast.0[1]);
        assert!((0.63..0.7).contains(&(precise.1.max / fast.1.max)));
        // `hemioct` is finer than `oct…p` and costs less than `oct`.
        assert!(is_finer(&id("hemioctN"), &id("octNp")) && is_cheaper(&id("hemioctN"), &id("octN")));
        // `ico` has the least maximum of all; `fib` has a lower mean than `oct…p`, and is dearer to encode than `ico`.
        for other in vectors().iter().filter(|codec| codec.bits == bits && codec.domain == Domain::Sphere) {
            assert!(other.id == id("icoN") || errors(other.id).max > errors(&id("icoN")).max, "{}", other.id);
        }
        assert!(errors(&id("fibN")).mean < errors(&id("octNp")).mean);
        assert!(costs_of(&id("fibN"))[0] > costs_of(&id("icoN"))[0]);
        assert!(costs_of(&id("latlongNd"))[1] > costs_of(&id("icoN"))[1]);
        // `latlong…d` is between `oct…p` and `ico…`, and cheaper than the latter to encode.
        assert!(is_finer(&id("latlongNd"), &id("octNp")) && is_finer(&id("icoN"), &id("latlongNd")));
        assert!(costs_of(&id("latlongNd"))[0] < costs_of(&id("icoN"))[0]);
        // What is coarser than `oct…p` and dearer to decode; to encode too, but for two of 16 bits.
        for other in ["sphericalN", "stereoN", "eqareaN", "eqdistN", "warpedcubeN", "sppN"] {
            let ([encode, decode], [precise, oct]) = (costs_of(&id(other)), costs_of(&id("octNp")));
            assert!(is_finer(&id("octNp"), &id(other)) && (2.0..=4.3).contains(&(decode / oct)), "{other}");
            assert_eq!(encode < precise, bits == 16 && ["stereoN", "eqareaN"].contains(&other), "{other}");
        }
        let ([encode, decode], [precise, oct]) = (costs_of(&id("cubeN")), costs_of(&id("octNp")));
        assert!(is_finer(&id("octNp"), &id("cubeN")) && decode > oct && (encode < precise) == (bits <= 24));
    }
    assert!(is_finer("oct24p", "snorm8x3p"));
}

/// docs/costs.md: on lavapipe no codec decodes faster by table.
#[test]
fn tables_do_not_pay_on_lavapipe() {
    let found: Vec<f64> = vectors().iter().filter_map(|codec| costs::by_table(codec.id)).collect();
    assert!(found.len() > 20 && found.iter().all(|ratio| *ratio < 1.0));
}

/// docs/cpu-slices.md.
#[test]
fn slices_on_a_cpu() {
    let [first, _, last] = slices::ns("decode", "oct32");
    // 16M are limited by memory.
    assert!(last > 1.2 * first && slices::ns("decode", "memcpy12")[2] > 0.8 * last);
    // What precise encoders take; a table is nearly as fast as `oct16`, and much faster than `latlong16d`.
    for (fast, precise, times) in [("oct32", "oct32p", 1.8..3.2), ("oct16", "oct16p", 2.8..4.4)] {
        assert!(times.contains(&(slices::ns("encode", precise)[1] / slices::ns("encode", fast)[1])));
    }
    let table = slices::ns("decode", "latlong16d-table")[1];
    assert!((0.8..1.5).contains(&(table / slices::ns("decode", "oct16")[1])));
    assert!(slices::ns("decode", "latlong16d")[1] > 3.0 * table);
    // meshopt's and normal_pack's encoders profit from short slices.
    for name in ["meshopt8", "meshopt16", "normal_pack"] {
        let [short, longer, _] = slices::ns("encode", name);
        assert!(longer > 1.5 * short, "{name}");
    }
}

/// docs/codecs.md: `ico` beats every row of the survey's table 1 of as many bits.
#[test]
fn ico_beats_the_survey() {
    for bits in [16, 24, 32] {
        let ico = errors(&format!("ico{bits}"));
        for row in Table::One.published().iter().filter(|row| row.bits == bits) {
            // Means to what a sample leaves open, and half a unit of the last digit that the survey prints.
            let mean = 1.001 * row.mean_error_deg + 0.5e-5;
            assert!(ico.max < row.max_error_deg && ico.mean < mean, "{}", row.name);
        }
        let [mean, max] = over_bound(find(&format!("ico{bits}")).unwrap());
        assert!(mean < 1.02 && max < 1.04);
    }
}

/// docs/codecs.md: the survey finds cube codes a little worse than snorm; with as many bits ours are several times better.
#[test]
fn cube_is_better_than_snorm() {
    for (cube, snorm) in [("cube24", "snorm8x3"), ("cube32", "snorm11_11_10")] {
        assert!(errors(snorm).mean > 6.0 * errors(cube).mean && errors(snorm).max > 6.0 * errors(cube).max);
    }
}

/// docs/codecs.md: where errors are far below the published ones, and where codecs are named after other people's.
#[test]
fn differences_from_the_published() {
    let published = |codec: &AnyCodec| {
        let mut rows = [Table::One, Table::Three].into_iter().flat_map(Table::published);
        rows.find(|row| row.name == codec.survey_name)
    };
    let far_lower = vectors().iter().filter(|codec| {
        let own = errors(codec.id);
        published(codec)
            .is_some_and(|row| own.mean < 0.9 * row.mean_error_deg || own.max < 0.8 * row.max_error_deg)
    });
    let ids: Vec<&str> = far_lower.map(|codec| codec.id).collect();
    let expected = [
        "spherical32",
        "latlong32d",
        "snorm16x3p",
        "crytek_bfn24",
        "stereo32",
        "stereo_ellipse24",
        "stereo_ellipse32",
        "eqarea_ellipse32",
        "eqdist_ellipse32",
        "xyonly32f",
    ];
    assert_eq!(ids, expected);
}

/// docs/agreement.md: what a division that is 2.5 ULP off does to a position, in steps and in directions.
#[test]
fn a_division_moves_few_directions_to_other_codes() {
    for (m, steps, one_in) in [(127.0, 4e-5, 6000.0), (2047.0, 6e-4, 400.0), (32767.0, 1e-2, 25.0)] {
        let off = 2.5 * 2f64.powi(-23) * m;
        assert!(off / steps > 0.9 && off / steps < 1.1, "{off}");
        // Two coordinates, and both sides of a border.
        let directions = 1.0 / (4.0 * off);
        assert!(directions / one_in > 0.9 && directions / one_in < 1.15, "{directions}");
    }
}
