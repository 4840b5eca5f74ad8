//! The tables of the survey as published, as CSV with a head line.

use crate::Summary;

/// Table 1: errors over the sphere in degrees, by decreasing maximum.
pub const TABLE_1: &str = include_str!("../data/survey_table1.csv");

/// Table 2: nanoseconds a vector on a GeForce GTX 680.
pub const TABLE_2: &str = include_str!("../data/survey_table2.csv");

/// Table 3: errors over the hemisphere in degrees.
pub const TABLE_3: &str = include_str!("../data/survey_table3.csv");

/// The rows of [`TABLE_1`] or [`TABLE_3`]: the survey's name, and the published errors in degrees.
pub fn rows(table: &str) -> impl Iterator<Item = (&str, Summary)> {
    table.lines().skip(1).filter_map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |i: usize| fields.get(i)?.parse().ok();
        Some((*fields.first()?, Summary { mean: number(2)?, max: number(3)? }))
    })
}

/// The published errors of a codec, by the survey's name: those of table 1, or else of table 3.
pub fn published(name: &str) -> Option<Summary> {
    [TABLE_1, TABLE_3].into_iter().flat_map(rows).find(|row| row.0 == name).map(|row| row.1)
}
