//! Minimax fits by the Remez exchange, in `f64`: the origin of the coefficients of the crate's trigonometry.

use std::f64::consts::PI;

/// A weighted approximation problem: `target(u)` by `weight(u) (c0 + c1 u + c2 u^2 + ...)` for `u` in
/// `(0, end]`, the greatest absolute difference to be least.
pub struct Problem {
    /// The function to approximate.
    pub target: fn(f64) -> f64,
    /// The factor of the polynomial; without zeros inside the interval.
    pub weight: fn(f64) -> f64,
    /// The interval's end.
    pub end: f64,
}

/// The solution of a [`Problem`]: the coefficients from the constant term up, and the greatest absolute difference from
/// the target.
struct Fit {
    coefficients: Vec<f64>,
    error: f64,
}

/// The start of the interval, in place of 0, at which the targets are quotients of zeros.
const START: f64 = 1e-12;

/// Points at which an error curve is looked at. They crowd towards the ends, as its extrema do.
const GRID: usize = 4000;

/// More exchanges than any problem here takes; each squares the distance to the solution.
const EXCHANGES: usize = 12;

/// Asserts that these constants are the minimax coefficients of a problem, rounded to `f32`, with at most this error.
///
/// # Panics
/// If they are not.
pub fn assert_minimax(name: &str, problem: &Problem, constants: &[f32], bound: f64) {
    let fit = problem.solve(constants.len());
    let rounded: Vec<f32> = fit.coefficients.iter().map(|&c| c as f32).collect();
    println!("{name}: error {:.3e}, {rounded:?}", fit.error);
    assert_eq!(rounded, constants, "{name}");
    assert!(fit.error <= bound, "{name}: {}", fit.error);
}

/// The polynomial with these coefficients at `u`.
fn polynomial(coefficients: &[f64], u: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * u + c)
}

impl Problem {
    /// The minimax polynomial with `terms` coefficients.
    fn solve(&self, terms: usize) -> Fit {
        let inner = |i| (i as f64 + 0.5) / (terms + 1) as f64;
        let mut reference: Vec<f64> = (0..=terms).map(|i| self.crowded(inner(i))).collect();
        let mut fit = self.interpolate(&reference);
        for _ in 0..EXCHANGES {
            reference = self.extrema(&fit.coefficients, terms + 1);
            fit = self.interpolate(&reference);
        }
        fit
    }

    /// The point at `part` (0 to 1) of the interval, by a map that crowds even parts towards the ends as the roots of
    /// Chebyshev polynomials do.
    fn crowded(&self, part: f64) -> f64 {
        START + (self.end - START) * (0.5 - 0.5 * (PI * part).cos())
    }

    fn difference(&self, coefficients: &[f64], u: f64) -> f64 {
        (self.target)(u) - (self.weight)(u) * polynomial(coefficients, u)
    }

    /// The coefficients with differences of one size and alternating sign at the points of `reference`.
    fn interpolate(&self, reference: &[f64]) -> Fit {
        let terms = reference.len() - 1;
        let equations = reference.iter().enumerate().map(|(i, &u)| {
            let powers = (0..terms).map(|k| (self.weight)(u) * u.powi(k as i32));
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            powers.chain([sign, (self.target)(u)]).collect()
        });
        let mut coefficients = eliminate(equations.collect());
        let error = coefficients.pop().unwrap_or(0.0).abs();
        Fit { coefficients, error }
    }

    /// The `count` greatest extrema of alternating sign of the error curve.
    fn extrema(&self, coefficients: &[f64], count: usize) -> Vec<f64> {
        let mut found: Vec<(f64, f64)> = Vec::new();
        for u in (0..=GRID).map(|i| self.crowded(i as f64 / GRID as f64)) {
            let value = self.difference(coefficients, u);
            match found.last_mut() {
                Some(last) if (last.1 > 0.0) == (value > 0.0) => {
                    if value.abs() > last.1.abs() {
                        *last = (u, value);
                    }
                }
                _ => found.push((u, value)),
            }
        }
        while found.len() > count {
            let [first, last] = [found[0].1.abs(), found[found.len() - 1].1.abs()];
            found.remove(if first < last { 0 } else { found.len() - 1 });
        }
        assert_eq!(found.len(), count, "the error curve has too few extrema");
        found.into_iter().map(|(u, _)| u).collect()
    }
}

/// Solves a linear system by elimination with row pivots. Rows hold an equation's factors and its right side.
fn eliminate(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let count = rows.len();
    for column in 0..count {
        let pivot = (column..count).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        rows.swap(column, pivot.unwrap_or(column));
        let top = rows[column].clone();
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / top[column];
            row.iter_mut().zip(&top).for_each(|(a, b)| *a -= factor * b);
        }
    }
    let mut solution = vec![0.0; count];
    for i in (0..count).rev() {
        let known: f64 = (i + 1..count).map(|k| rows[i][k] * solution[k]).sum();
        solution[i] = (rows[i][count] - known) / rows[i][i];
    }
    solution
}
