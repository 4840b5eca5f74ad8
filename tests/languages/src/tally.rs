//! What came of a compiler's code on a driver.

use crate::cases::{COUNT, Case, RANDOM, SPECIAL, stored};
use crate::{Result, told};
use unitvec_host::catalogue::Operation;
use unitvec_host::imprecise::{Outcome, of_codes, of_elements};

/// What came of all cases.
#[derive(Default)]
pub struct Tally {
    /// Kernels that ran.
    pub kernels: usize,
    pub outcome: Outcome,
    /// What did not compile, was warned of or did not run.
    pub faults: Vec<String>,
    /// Names of the cases that differ, with the number.
    pub differing: Vec<(String, Outcome)>,
}

impl Tally {
    /// Takes in what a case gave.
    pub fn add(&mut self, case: &Case, result: Result<Vec<u32>>) -> Result<()> {
        match result {
            Ok(words) if words.len() == case.expected.len() => {
                self.kernels += 1;
                let outcome = outcome(case, &words)?;
                if words != case.expected {
                    self.differing.push((case.name(), outcome));
                }
                self.outcome.add(outcome);
            }
            Ok(words) => {
                self.faults.push(format!(
                    "{}: {} words, not {}",
                    case.name(),
                    words.len(),
                    case.expected.len()
                ));
            }
            Err(fault) => self.faults.push(format!("{}: {fault}", case.name())),
        }
        Ok(())
    }

    /// Codes and elements that differ.
    pub fn mismatches(&self) -> u64 {
        let Outcome { codes_differ, special_differ, elements_differ, .. } = self.outcome;
        codes_differ + special_differ + elements_differ
    }
}

/// How a case's results differ from those expected.
fn outcome(case: &Case, words: &[u32]) -> Result<Outcome> {
    if words == case.expected {
        return Ok(Outcome::default());
    }
    if case.operation == Operation::Decode {
        let [decoded, expected] = [words, &case.expected].map(bytemuck::cast_slice);
        return Ok(of_elements(case.format, decoded, expected));
    }
    let (read, written) = case.words();
    let (random, special) = words.split_at(RANDOM * written);
    let (expected, expected_special) = case.expected.split_at(RANDOM * written);
    let differ = |a: &[u32], b: &[u32]| {
        a.chunks_exact(written).zip(b.chunks_exact(written)).filter(|(a, b)| a != b).count() as u64
    };
    let elements = bytemuck::cast_slice(&case.input[..RANDOM * read]);
    let (codes, expected_codes) = (stored(&case.format, random), stored(&case.format, expected));
    let (_, error) = of_codes(case.format, elements, &codes, &expected_codes).map_err(told)?;
    Ok(Outcome {
        codes_differ: differ(random, expected),
        special_differ: differ(special, expected_special),
        error,
        ..Outcome::default()
    })
}

const _: () = assert!(RANDOM + SPECIAL == COUNT);
