//! Errors of normal maps in compressed blocks, as docs/textures.md has them.

use super::markdown_table;
use super::tables::degrees;
use unitvec_lab::accuracy::blocks::{MAPS, Stored, measure};

/// Map, codec or pair, format, bits, mean and maximum, and these by channel.
type Row = (String, String, String, u32, f64, f64, Option<f64>, Option<f64>);

/// The rows of each way to store a map, in the order of [`MAPS`].
fn recorded() -> Vec<Vec<Row>> {
    let (mut ways, rows) = (vec![Vec::new(); Stored::all().len()], super::recorded::<Row>("blocks.csv"));
    let count = ways.len();
    rows.into_iter().enumerate().for_each(|(at, row)| ways[at % count].push(row));
    ways
}

/// The table of this name: mean and maximum of everything, or the crate's own blocks beside ours.
pub fn table(name: &str) -> String {
    let cell = |row: &Row| match (name, row.6, row.7) {
        ("gains", Some(mean), Some(max)) => {
            let less = 100.0 * (1.0 - row.4 / mean);
            Some(format!("{} / {}, mean {less:.0} % less by angle", degrees(mean), degrees(max)))
        }
        ("gains", ..) => None,
        _ => Some(format!("{} / {}", degrees(row.4), degrees(row.5))),
    };
    let lines = recorded().into_iter().filter_map(|rows| {
        let cells = rows.iter().map(cell).collect::<Option<Vec<_>>>()?.join(" | ");
        let (_, codec, format, bits, ..) = &rows[0];
        Some(format!("`{codec}` | {} | {bits} | {cells}", if format.is_empty() { "codes" } else { format }))
    });
    let maps = MAPS.map(|map| format!("{}, k^-{}, up to {}°", map.name, map.exponent, map.steepest_deg));
    markdown_table(&format!("pair or codec | format | bits | {}", maps.join(" | ")), lines)
}

/// docs/textures.md: by angle, the mean of BC5 is at least 15 % below the crate's on every map. It is below that of BC7 and of
/// codes of as many bits; also of twice the bits on the smooth map, not on the others. No pair is better than xy.
#[test]
fn blocks_are_as_the_docs_say() {
    let ways = recorded();
    for row in ways.iter().flatten() {
        assert!(row.6.is_none_or(|mean| row.4 <= 0.85 * mean), "{row:?}");
    }
    let mean = |codec: &str, format: &str, map: usize| {
        ways.iter().find(|rows| rows[0].1 == codec && rows[0].2 == format).unwrap()[map].4
    };
    for (pair, codec) in [("xy", "xyonly16"), ("hemioct", "hemioct16p"), ("oct", "oct16p")] {
        for map in 0..MAPS.len() {
            let bc5 = mean(pair, "BC5_SNORM", map);
            assert!(
                bc5 < 0.61 * mean(pair, "BC7_UNORM", map) && bc5 < 0.51 * mean("oct8p", "", map),
                "{pair}"
            );
            assert!(
                (bc5 < mean(codec, "", map)) == (map == 0) && mean("xy", "BC5_SNORM", map) <= bc5,
                "{pair}"
            );
            assert!((mean(pair, "BC5_UNORM", map) / bc5 - 1.0).abs() < 0.005, "{pair}");
        }
    }
}

/// Some rows, measured again.
#[test]
fn block_errors_are_as_recorded() {
    let (ways, all, normals) = (recorded(), Stored::all(), MAPS[2].normals(1));
    for at in [1, 2, 9, 10] {
        let (fresh, row) = (measure(&MAPS[2], &normals, all[at]), &ways[at][2]);
        assert_eq!((fresh.map, fresh.codec, fresh.format), (&*row.0, &*row.1, &*row.2));
        for (fresh, committed) in [(fresh.mean_deg, row.4), (fresh.max_deg, row.5)] {
            assert!((fresh / committed - 1.0).abs() < 0.001, "{row:?}: {fresh}");
        }
    }
}
