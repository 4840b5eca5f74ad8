//! docs/papers.md: where the papers contradict their own tables or our measurements, and the finest codes of others. Each
//! claim is checked as it is made.

use super::accuracy::{self, Errors};
use super::costs::rdna2;
use super::markdown_table;
use super::tables::{degrees, mean_and_max};
use super::textbook::{number, throughput};
use unitvec_catalogue::Operation::Decode;
use unitvec_choose::costs::Source;
use unitvec_lab::accuracy::Table;
use unitvec_lab::accuracy::meyer::METHODS;
use unitvec_lab::bench::survey_ns;

/// The table of all that numbers decide: the place, what stands there, and what the numbers say.
pub fn table() -> String {
    let rows = [maps(), cubes(), listing_3(), fastest(), spherical(), sc()].concat();
    markdown_table("where | what it says | what the numbers say", rows)
}

/// Mean and maximum of a row of the survey's table 1.
fn published(name: &str) -> Errors {
    let row = Table::One.published().into_iter().find(|row| row.name == name);
    let row = row.unwrap_or_else(|| panic!("table 1 has no {name}"));
    Errors { mean: row.mean_error_deg, max: row.max_error_deg }
}

/// A bound of Meyer's in radians.
fn bound(method: &str, bits: f64) -> f64 {
    let found = METHODS.iter().find(|other| other.name == method);
    (found.unwrap_or_else(|| panic!("no {method}")).bound)(bits)
}

fn ours(id: &str) -> Errors {
    accuracy::of(id, "direction")
}

fn maps() -> Vec<String> {
    let [equal_area, equal_distance, plain, spherical, latlong] =
        ["eqarea+ellipse16", "eqdist+ellipse16", "eqdist16", "spherical16", "latlong16"].map(published);
    assert!(equal_area.mean < equal_distance.mean && plain.max < equal_distance.max);
    assert!(equal_area.mean < spherical.mean && spherical.mean < latlong.mean);
    vec![
        format!(
            "survey, section 2 | of the hemisphere maps, eqdist with the ellipse has the lowest error | 16 bits: eqarea \
             with it has the lower mean ({} against {}), eqdist alone the lower maximum ({} against {})",
            degrees(equal_area.mean),
            degrees(equal_distance.mean),
            degrees(plain.max),
            degrees(equal_distance.max)
        ),
        format!(
            "survey, figure 6 | eqarea+ellipse16 has the highest mean of what runs on the GPU | it has {}; spherical16 \
             has {}, latlong16 {}",
            degrees(equal_area.mean),
            degrees(spherical.mean),
            degrees(latlong.mean)
        ),
    ]
}

fn cubes() -> Vec<String> {
    let [cube, snorm] = ["cube24", "snorm8x3"].map(ours);
    assert!(6.0 * cube.mean < snorm.mean && 6.0 * cube.max < snorm.max);
    let pairs = [16, 24, 32].map(|bits| {
        let [cube, oct] = ["cube", "oct"].map(|family| ours(&format!("{family}{bits}")).max);
        assert!(cube > oct);
        format!("{} against {}", degrees(cube), degrees(oct))
    });
    vec![
        format!(
            "survey, section 2 | cube is slightly worse than snorm of as many bits | 24 bits: {} against {}; the maximum \
             by Meyer's eq. 8 is {}",
            mean_and_max(cube),
            mean_and_max(snorm),
            degrees(bound("CM", 24.0).to_degrees())
        ),
        format!(
            "Meyer, section 6 | rounded in the domain, cube maps beat octahedra | not with whole bits, where b - 3 is odd: \
             at 16, 24 and 32 bits the maxima are {}",
            pairs.join(", ")
        ),
    ]
}

fn listing_3() -> Vec<String> {
    let float32 = |id: &str| Errors { mean: number(id, "mean_deg"), max: number(id, "max_deg") };
    let said = [("oct24p", "oct24P"), ("oct32p", "oct32P")].map(|(id, name)| {
        assert!(float32(id).mean > 1.03 * published(name).mean, "{id}");
        format!("{} against {}", mean_and_max(float32(id)), mean_and_max(published(name)))
    });
    vec![format!(
        "survey, section 4.1 | the errors of listing 3 are those of float32 | in float32 it has more than table 1 at 24 and \
         32 bits: {}. We infer that cosines were compared in more",
        said.join(", ")
    )]
}

fn fastest() -> Vec<String> {
    let [timed, faster] = ["spherical32", "spherical16"].map(|id| survey_ns(id, Decode).unwrap());
    assert!(faster < timed && timed < 0.5 * 0.003680);
    vec![format!(
        "survey, section 4.2 | the fastest decoder, spherical32, takes 0.003680 ns, or 5.5 multiplications | table 2: \
         {timed:.6} ns, or {:.1}; spherical16 takes {faster:.6}",
        timed / 0.003680 * 5.5
    )]
}

fn spherical() -> Vec<String> {
    let own = |id| rdna2().row(id, Decode, Source::Glsl).unwrap().inverse_throughput.unwrap();
    let [theirs, listing_2] = ["spherical32", "oct32"].map(|id| throughput(id, Decode).unwrap());
    assert!(theirs < listing_2 && own("spherical32") > own("oct32"));
    vec![format!(
        "survey, conclusions | spherical decodes faster than oct, which has slightly better quality | true with the hardware's \
         sines, whose maximum at 32 bits is {} in table 1 and {} on lavapipe: T is {theirs} against {listing_2} on RDNA 2. \
         With sines good enough for {} it is {} against {}",
        degrees(published("spherical32").max),
        degrees(number("spherical32", "max_deg")),
        degrees(ours("spherical32").max),
        own("spherical32"),
        own("oct32")
    )]
}

fn sc() -> Vec<String> {
    let [printed, derived] = ["SC", "SC_eq5"].map(|method| bound(method, 48.0));
    let over = ours("spherical24").max.to_radians() / bound("SC_eq5", 24.0);
    assert!((printed / derived - 2.0).abs() < 1e-9 && (over / (5f64.sqrt() / 2.0) - 1.0).abs() < 5e-3);
    vec![format!(
        "Meyer, table 1, SC | {printed:.2e} radians at 48 bits | eq. 5, with the table's sample spacing, gives half: \
         {derived:.2e}. Ours have {over:.2} times the equation's at 24 bits, since a step of phi is twice one of theta"
    )]
}

/// The largest error of the 48-bit codes of Griffith et al. in radians, as Meyer et al. quote it in section 6.
const GRIFFITH: f64 = 1.38e-7;

/// The finest codes of others beside ours, in a sentence.
pub fn related() -> String {
    let found = ours("oct48p").max.to_radians();
    let (bound, rounding) = (bound("ONV_range", 48.0), 3f64.sqrt() * 2f64.powi(-25));
    assert!(GRIFFITH < bound && bound < found && found < bound + rounding);
    format!(
        "At 48 bits Meyer et al. quote {GRIFFITH:.2e} radians for Griffith's codes, with 21 subdivisions or a table of a \
         petabyte, and derive {bound:.2e} for octahedral ones. `oct48p` has {found:.2e}, of which the rounding of vectors to \
         `f32` is up to {rounding:.2e}.\n"
    )
}
