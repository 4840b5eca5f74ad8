//! Results of codecs on devices that round as badly as Vulkan allows: docs/data/imprecise.csv, which `cargo xtask renew
//! imprecise` writes.

use super::tables::is_shown;
use super::{markdown_table, recorded};
use unitvec_catalogue::{CODECS, find};
use unitvec_lab::imprecise::{Bounds, Summary};

/// Random elements of a codec: eight seeds.
const ELEMENTS: u64 = 8 << 16;

fn summaries() -> Vec<Summary> {
    recorded("imprecise.csv")
}

/// The table of all codecs, or of those that are recommended.
pub fn table(rows: &str) -> String {
    let rows = summaries().into_iter().filter(|row| is_shown(rows, &row.id)).map(|row| {
        let most = row.codes_differ_at_most.map_or_else(|| "none".to_owned(), |most| most.to_string());
        let [angle, angle_most] = [row.angle_deg, row.angle_deg_at_most].map(|angle| match angle {
            0.0 => "0".to_owned(),
            angle => format!("{angle:.1e}"),
        });
        let lost =
            if row.is_stable { String::from("0") } else { format!("{} of {}", row.codes_lost, row.codes) };
        let Summary { id, codes_differ, component_ulp, component_ulp_at_most, .. } = row;
        format!(
            "`{id}` | {codes_differ} | {most} | {component_ulp:.0} | {component_ulp_at_most:.0} | {angle} | {angle_most} | \
             {lost}"
        )
    });
    let titles = "codec | codes that differ | at most | components, 2^-24 | at most | angle, degrees | at most | codes lost";
    markdown_table(titles, rows)
}

/// All codecs but those that are newer than the record, of eight seeds; every count below the bound that is derived today; no
/// code lost where none may be.
#[test]
fn the_record_is_within_the_bounds() {
    let recorded = summaries();
    let ids: Vec<&str> = recorded.iter().map(|row| row.id.as_str()).collect();
    let known = CODECS.iter().map(|format| format.id).filter(|id| ids.contains(id));
    assert_eq!(ids, known.collect::<Vec<_>>());
    for row in &recorded {
        let bounds = Bounds::of(find(&row.id).unwrap());
        assert_eq!(row.elements, ELEMENTS, "{}", row.id);
        assert_eq!(row.codes_differ_at_most, bounds.codes_differ(row.elements), "{}", row.id);
        assert!(row.codes_differ_at_most.is_none_or(|most| row.codes_differ <= most), "{row:?}");
        let (component, angle) = bounds.decoded();
        assert!(row.component_ulp <= component && row.angle_deg <= angle, "{row:?}");
        assert_eq!(row.is_stable, bounds.is_stable, "{}", row.id);
        assert!(!row.is_stable || row.codes_lost == 0, "{row:?}");
    }
}
