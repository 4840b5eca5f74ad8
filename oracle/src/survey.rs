//! The tables of the survey as published, as CSV with a head line.

/// Table 1: errors over the sphere in degrees, by decreasing maximum.
pub const TABLE_1: &str = include_str!("../data/survey_table1.csv");

/// Table 2: nanoseconds a vector on a GeForce GTX 680.
pub const TABLE_2: &str = include_str!("../data/survey_table2.csv");

/// Table 3: errors over the hemisphere in degrees.
pub const TABLE_3: &str = include_str!("../data/survey_table3.csv");
