//! The tables of docs/filtering.md: errors of components that are blended before they are decoded.

use super::markdown_table;
use super::tables::degrees;
use unitvec_lab::accuracy::filtering::Channel::Exact;
use unitvec_lab::accuracy::filtering::{Case, MAPS, Map, Region, Row, Sample};

/// As many samples as give the digits of the tables.
fn measured(case: Case<'_>) -> Row {
    Row::measure(case, 20_000, 1)
}

fn mean_and_max(mean: f64, max: f64) -> String {
    if max == 0.0 { "0".to_owned() } else { format!("{} / {}", degrees(mean), degrees(max)) }
}

fn blended(case: Case<'_>) -> String {
    let Row { mean_deg, max_deg, .. } = measured(case);
    mean_and_max(mean_deg, max_deg)
}

/// The shares of torn midpoints of exact components, and their errors.
pub fn of_maps() -> String {
    let rows = MAPS.iter().map(|map| {
        let midpoint = |region, apart| (map, Exact, region, Sample::Midpoint, apart);
        let torn = 100.0 * measured(midpoint(Region::Domain, 1.0)).torn;
        let errors = [0.1, 1.0, 10.0].map(|apart| blended(midpoint(Region::Domain, apart))).join(" | ");
        let [edges, cap] = [Region::Edges, Region::Cap].map(|region| blended(midpoint(region, 1.0)));
        format!("`{}` | {torn:.2} % | {errors} | {edges} | {cap}", map.name)
    });
    markdown_table("map | torn, 1° | 0.1° apart | 1° | 10° | 1°, at edges | 1°, z ≥ 0.3", rows)
}

/// Bilinear samples of what channels hold, beside texels decoded first; and trilinear ones.
pub fn of_channels() -> String {
    let maps = ["xyz", "xyonly", "hemioct", "oct"].map(|name| Map::find(name).unwrap());
    let cases = maps.iter().flat_map(|map| map.channels.iter().map(move |channel| (*map, *channel)));
    let rows = cases.map(|(map, channel)| {
        let case = |sample, apart| (map, channel, Region::Cap, sample, apart);
        let one = measured(case(Sample::Bilinear, 1.0));
        let decoded = mean_and_max(one.decoded_mean_deg, one.decoded_max_deg);
        let filtered = [(Sample::Bilinear, 1.0), (Sample::Trilinear, 1.0), (Sample::Bilinear, 10.0)];
        let filtered = filtered.map(|(sample, apart)| blended(case(sample, apart))).join(" | ");
        format!("`{}` | {} | {decoded} | {filtered}", map.name, channel.name())
    });
    markdown_table("map | channels | decoded first, 1° | bilinear, 1° | trilinear, 1° | bilinear, 10°", rows)
}
