//! What orders of codes are good for, as docs/open-problems.md has it: bytes of differences, and pages that a cone needs.

use super::markdown_table;
use unitvec::wrap::morton::to_morton;
use unitvec::{Codec, EaOct32, Oct32, angle_deg};
use unitvec_tests::directions::sphere;

/// Directions, and how many of them are in a page.
const COUNT: usize = 100_000;
const PAGE: usize = 100;
/// Half-angles of the cones, in degrees, and how many there are of each.
const HALF_ANGLES: [f32; 2] = [5.0, 20.0];
const CONES: usize = 20;

/// The bytes of a number in LEB128, seven bits to a byte.
fn leb128_bytes(number: u32) -> u32 {
    (38 - (number | 1).leading_zeros()) / 7
}

/// A row for each order: a name, and the number by which random directions are sorted.
pub fn table() -> String {
    type Order = (&'static str, fn([f32; 3]) -> u32);
    let orders: [Order; 3] = [
        ("`oct32`, by its codes", |v| Oct32::encode(v)),
        ("`eaoct32`, by its codes", |v| EaOct32::encode(v)),
        ("`eaoct32`, by Morton's order", |v| to_morton::<32>(EaOct32::encode(v))),
    ];
    let rows = orders.map(|(name, order)| {
        let mut sorted: Vec<(u32, [f32; 3])> =
            sphere(71, COUNT).map(|v| (order(v.to_array()), v.to_array())).collect();
        sorted.sort_by_key(|(code, _)| *code);
        let bytes: u32 = sorted.windows(2).map(|pair| leb128_bytes(pair[1].0 - pair[0].0)).sum();
        let pages = HALF_ANGLES.map(|half_angle| {
            let read = |axis: [f32; 3]| {
                let is_inside = |(_, v): &(u32, [f32; 3])| angle_deg(axis, *v) <= f64::from(half_angle);
                sorted.chunks(PAGE).filter(|page| page.iter().any(is_inside)).count()
            };
            let read: usize = sphere(73, CONES).map(|axis| read(axis.to_array())).sum();
            // All pages that the vectors in the cone would fill.
            let least = 0.5 * (1.0 - f64::from(half_angle).to_radians().cos()) * (COUNT / PAGE) as f64;
            let mean = read as f64 / CONES as f64;
            format!("{mean:.0} ({:.1})", mean / least)
        });
        format!("{name} | {:.2} | {}", f64::from(bytes) / COUNT as f64, pages.join(" | "))
    });
    let of_cones = HALF_ANGLES.map(|half_angle| format!("pages in a cone of {half_angle}°")).join(" | ");
    markdown_table(&format!("sorted | bytes of a difference | {of_cones}"), rows)
}
