//! Errors of normal maps in compressed blocks, as docs/textures.md has them.

use super::markdown_table;
use super::tables::degrees;
use serde::Deserialize;
use unitvec_lab::accuracy::blocks::{MAPS, Stored, measure};

/// What of a row of docs/data/blocks.csv is used.
#[derive(Debug, Deserialize)]
struct Row {
    map: String,
    codec: String,
    format: String,
    bits: u32,
    mean_deg: f64,
    max_deg: f64,
    by_channel_mean_deg: Option<f64>,
    by_channel_max_deg: Option<f64>,
}

/// The rows of each way to store a map, in the order of [`MAPS`].
fn recorded() -> Vec<Vec<Row>> {
    let mut ways: Vec<Vec<Row>> = Stored::all().iter().map(|_| Vec::new()).collect();
    let count = ways.len();
    for (at, row) in super::recorded("blocks.csv").into_iter().enumerate() {
        ways[at % count].push(row);
    }
    assert!(ways.iter().all(|rows| rows.iter().map(|row| &*row.map).eq(MAPS.iter().map(|map| map.name))));
    ways
}

/// A line for each of these ways, with a cell for each map.
fn table_of(titles: &str, ways: Vec<Vec<Row>>, cell: fn(&Row) -> String) -> String {
    let titles = format!("{titles} | {}", MAPS.map(|map| map.name).join(" | "));
    let lines = ways.into_iter().map(|rows| {
        let cells: Vec<_> = rows.iter().map(cell).collect();
        let format = if rows[0].format.is_empty() { String::new() } else { format!("`{}`", rows[0].format) };
        format!("`{}` | {format} | {} | {}", rows[0].codec, rows[0].bits, cells.join(" | "))
    });
    markdown_table(&titles, lines)
}

/// Mean and maximum of everything.
pub fn table() -> String {
    let cell = |row: &Row| format!("{} / {}", degrees(row.mean_deg), degrees(row.max_deg));
    table_of("codec or pair | format | bits", recorded(), cell)
}

/// The crate's own blocks beside ours.
pub fn gains() -> String {
    let mut ways = recorded();
    ways.retain(|rows| rows[0].by_channel_mean_deg.is_some());
    table_of("pair | format | bits", ways, |row| {
        let [mean, max] = [row.by_channel_mean_deg, row.by_channel_max_deg].map(Option::unwrap);
        let less = 100.0 * (1.0 - row.mean_deg / mean);
        format!("{} / {}; mean {less:.0} % less by angle", degrees(mean), degrees(max))
    })
}

/// The maps, and the angle to +Z of their steepest texels.
pub fn maps() -> String {
    let line = |map: &unitvec_lab::accuracy::blocks::Spectrum| {
        format!("{} | {} | {}°", map.name, map.exponent, map.steepest_deg)
    };
    markdown_table("map | exponent | steepest", MAPS.iter().map(line))
}

/// The mean errors of a way to store maps, map by map.
fn means(codec: &str, format: &str) -> Vec<f64> {
    let is_it = |rows: &Vec<Row>| rows[0].codec == codec && rows[0].format == format;
    recorded().into_iter().find(is_it).unwrap().iter().map(|row| row.mean_deg).collect()
}

/// docs/textures.md: by angle, BC5 has a mean that is at least 15 % below the crate's on every map; it has a lower one than BC7 and
/// than codes of as many bits; codes of twice the bits have a lower one where the map is rough, not where it is smooth; xy
/// is the best pair.
#[test]
fn blocks_are_as_the_docs_say() {
    for row in recorded().iter().flatten() {
        assert!(row.by_channel_mean_deg.is_none_or(|mean| row.mean_deg <= 0.85 * mean), "{row:?}");
    }
    let each =
        |a: &[f64], is_less: fn(f64, f64) -> bool, b: &[f64]| a.iter().zip(b).all(|(a, b)| is_less(*a, *b));
    for (pair, codec) in [("xy", "xyonly16"), ("hemioct", "hemioct16p"), ("oct", "oct16p")] {
        let bc5 = means(pair, "BC5_SNORM");
        assert!(each(&bc5, |a, b| a < b, &means(pair, "BC7_UNORM")), "{pair}: {bc5:?}");
        assert!(each(&bc5, |a, b| a < 0.6 * b, &means("oct8p", "")), "{pair}: {bc5:?}");
        assert!(each(&means("xy", "BC5_SNORM"), |a, b| a <= b, &bc5), "{pair}: {bc5:?}");
        let codes = means(codec, "");
        assert!(bc5[0] < 0.6 * codes[0] && bc5[2] > 5.0 * codes[2], "{pair}: {bc5:?}, {codes:?}");
        let unorm = means(pair, "BC5_UNORM");
        assert!(each(&unorm, |a, b| (a / b - 1.0).abs() < 0.01, &bc5), "{pair}: {bc5:?}, {unorm:?}");
    }
}

/// Some rows, measured again.
#[test]
fn block_errors_are_as_recorded() {
    let (ways, normals) = (recorded(), MAPS[2].normals(1));
    for (at, stored) in Stored::all().into_iter().enumerate().filter(|(at, _)| [1, 2, 9, 10].contains(at)) {
        let (fresh, committed) = (measure(&MAPS[2], &normals, stored), &ways[at][2]);
        assert_eq!((fresh.codec, fresh.format), (&*committed.codec, &*committed.format));
        let agrees = |a: f64, b: f64| (a / b - 1.0).abs() < 0.001;
        assert!(
            agrees(fresh.mean_deg, committed.mean_deg) && agrees(fresh.max_deg, committed.max_deg),
            "{fresh:?}"
        );
    }
}
