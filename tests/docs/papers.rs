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
use unitvec_lab::textbook::best_fit_table;
use unitvec_oracle::{Summary, angle_deg, best_fit, cube, neighbourhood};
use unitvec_tests::directions::{around, sphere};
use unitvec_tests::tested::widen;

/// The table of all that numbers decide: the place, what stands there, and what the numbers say.
pub fn table() -> String {
    let rows = [maps(), cubes(), listing_3(), fastest(), spherical(), best_fits(), sc(), cube_in_the_range()]
        .concat();
    markdown_table("where | what it says | what the numbers say", rows)
}

/// Meyer's table 1 at two widths: the spacing of samples, the bound to first order and by the equation, and the largest
/// error of our codec, in degrees.
pub fn meyer() -> String {
    let rows = METHODS.iter().map(|method| {
        let at = [16u32, 24].map(|bits| {
            let b = f64::from(bits);
            let in_degrees = |radians: f64| degrees(radians.to_degrees());
            let exact = method.exact_bound(b).map_or_else(String::new, in_degrees);
            let found = method.codec(bits).map_or_else(String::new, |codec| degrees(ours(codec.id).max));
            format!("{:.3e} | {} | {exact} | {found}", (method.spacing)(b), in_degrees(method.bound(b)))
        });
        format!("{} | {}", method.name.replace('_', ", "), at.join(" | "))
    });
    let of_width = |bits| format!("ε, {bits} bits | first order | equation | ours");
    markdown_table(&format!("method | {} | {}", of_width(16), of_width(24)), rows)
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
    found.unwrap_or_else(|| panic!("no {method}")).bound(bits)
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

/// Directions of the comparisons below.
const COUNT: usize = 200_000;

/// Best fit normals of 8 bits as the survey describes them, by the table of `glsl/textbook/best_fit.glsl`: with the
/// length of one texel, and with the best of those of the four closest texels and of the vector as it is.
fn best_fits() -> Vec<String> {
    let table = best_fit_table();
    let side = table.len().isqrt();
    let errors = sphere(15, COUNT).map(|v| {
        let v = widen(v);
        let mut sizes = v.map(f64::abs);
        sizes.sort_by(f64::total_cmp);
        let [least, middle, largest] = sizes;
        let place = [middle / largest, least / middle].map(|t| t * side as f64);
        let texel = |x: f64, y: f64| {
            let [x, y] = [x, y].map(|t| (t.max(0.0) as usize).min(side - 1));
            best_fit::error_at_length(v, f64::from(table[y * side + x]))
        };
        let [x, y] = place.map(|t| t - 0.5);
        let closest = [texel(x, y), texel(x + 1.0, y), texel(x, y + 1.0), texel(x + 1.0, y + 1.0)];
        let best = closest.into_iter().fold(best_fit::plain_error(v, 127.0), f64::min);
        [texel(place[0], place[1]), best]
    });
    let errors: Vec<[f64; 2]> = errors.collect();
    let of = |i: usize| {
        let Summary { mean, max } = Summary::of(errors.iter().map(|e| e[i]));
        Errors { mean, max }
    };
    let [one, four, ours] = [of(0), of(1), ours("snorm8x3p")];
    for other in [published("snorm8x3P"), ours] {
        assert!((four.mean / other.mean - 1.0).abs() < 0.04, "{four:?} {other:?}");
    }
    vec![format!(
        "survey, table 1, best fit | CrytekBFN24 {}, snorm8x3P {} | by a table of {side} x {side} lengths for snorm codes \
         {} and {}; our snorm8x3p {}. Biased codes, and the shortest length where several fit in the texel of (1, 1, 1), give \
         the survey's CrytekBFN24",
        mean_and_max(published("CrytekBFN24")),
        mean_and_max(published("snorm8x3P")),
        mean_and_max(one),
        mean_and_max(four),
        mean_and_max(ours)
    )]
}

/// `cube24` with the nearest of the nine codes around a direction's, those of its face.
fn cube_in_the_range() -> Vec<String> {
    let bits = 24;
    let widths = cube::widths(bits);
    let nearest = |v: [f64; 3]| {
        let code = cube::encode(v, bits, false);
        let face = code >> (bits - 3) << (bits - 3);
        let around = neighbourhood(cube::integers(code, bits), 1)
            .filter(|integers| (0..2).all(|i| integers[i].abs() < 1 << (widths[i] - 1)));
        let codes = around.map(|[x, y]| {
            let [x, y] = [(x, widths[0]), (y, widths[1])].map(|(t, bits)| t as u64 & ((1 << bits) - 1));
            x | (y << widths[0]) | face
        });
        codes.map(|code| angle_deg(v, cube::decode(code, bits, false))).fold(f64::INFINITY, f64::min)
    };
    let middle = around(16, COUNT, [0.0, 0.0, 1.0], 0.02).map(widen);
    let max = Summary::of(middle.map(nearest)).max;
    let mean = Summary::of(sphere(17, COUNT).map(widen).map(nearest)).mean;
    let domain = ours("cube24");
    assert!(mean < 0.99 * domain.mean && max > 0.99 * domain.max && max < 1.01 * domain.max);
    vec![format!(
        "Meyer, section 6 | quantised in the range, CM has a lower mean error and the same maximum | so it is: `cube24` by the \
         nearest of the codes around {}, by rounding in the domain {}",
        mean_and_max(Errors { mean, max }),
        mean_and_max(domain)
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
