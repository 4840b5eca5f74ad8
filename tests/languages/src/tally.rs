//! What came of a compiler's code on a driver.

use crate::cases::{Case, RANDOM, stored};
use crate::{Result, told};
use unitvec_host::catalogue::{Format, Operation, find, find_frame};
use unitvec_host::imprecise::{Outcome, of_codes, of_elements};

/// What came of all cases.
#[derive(Default)]
pub struct Tally {
    /// Kernels of codecs that ran.
    pub kernels: usize,
    pub outcome: Outcome,
    /// Largest angle between a decoded element and the CPU's, as a part of the codec's error bound.
    pub angle: f64,
    /// What did not compile, was warned of or did not run.
    pub faults: Vec<String>,
    /// The cases that differ, in words.
    pub differing: Vec<String>,
    /// Those that differ by more than [`Bounds`] allow, in words.
    pub out_of_bounds: Vec<String>,
}

/// By how much the plain editions of languages without `precise` may differ, as parts of a codec's error bound. A compiler may
/// leave out roundings, or add some: a position moves by a few ULP, and only codes of positions that near to a border change.
/// What the arithmetic is off by is far below the bound of codecs of up to 32 bits. Wider ones are as fine as floats, and compute
/// with two floats, of which a compiler may drop the second.
pub struct Bounds {
    /// The error of an element whose code differs.
    pub error: f64,
    /// The angle between a decoded element and the CPU's.
    pub angle: f64,
}

impl Bounds {
    pub fn of(format: Format) -> Self {
        if format.bits <= 32 { Self { error: 1.0, angle: 0.05 } } else { Self { error: 2.0, angle: 1.0 } }
    }
}

impl Tally {
    /// Takes in what a case gave.
    pub fn add(&mut self, case: &Case, result: Result<Vec<u32>>) -> Result<()> {
        let name = case.name();
        let words = match result {
            Ok(words) if words.len() == case.expected.len() => words,
            Ok(words) => {
                self.faults.push(format!("{name}: {} words, not {}", words.len(), case.expected.len()));
                return Ok(());
            }
            Err(fault) => {
                self.faults.push(format!("{name}: {fault}"));
                return Ok(());
            }
        };
        self.kernels += usize::from(!case.has_all_files);
        if words == case.expected {
            return Ok(());
        }
        let outcome = outcome(case, &words)?;
        let angle = outcome.angle_deg / error_bound(case.format);
        let Outcome { codes_differ, special_differ, error, elements_differ, .. } = outcome;
        let described = format!(
            "{name}: {codes_differ} + {special_differ} codes differ, error {error:.3} of the bound; {elements_differ} vectors \
             differ, angle {angle:.3} of the bound"
        );
        let bounds = Bounds::of(case.format);
        if error > bounds.error || angle > bounds.angle {
            self.out_of_bounds.push(described.clone());
        }
        self.differing.push(described);
        self.outcome.add(outcome);
        self.angle = self.angle.max(angle);
        Ok(())
    }
}

/// A codec's error bound in degrees: of frames that of the normal or of the tangent, whichever is less.
fn error_bound(format: Format) -> f64 {
    let frame = |id| find_frame(id).map(|codec| codec.max_normal_error_deg.min(codec.max_tangent_error_deg));
    let bound = find(format.id).ok().map(|codec| codec.max_error_deg).or_else(|| frame(format.id));
    f64::from(bound.unwrap_or_default())
}

/// How a case's results differ from those expected.
fn outcome(case: &Case, words: &[u32]) -> Result<Outcome> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::cases;
    use unitvec_host::catalogue::find_format;

    fn tally_of(id: &str, operation: Operation, change: impl FnOnce(&mut Vec<u32>)) -> Tally {
        let cases = cases(&[find_format(id).unwrap()]).unwrap();
        let case = cases.iter().find(|case| case.operation == operation).unwrap();
        let mut words = case.expected.clone();
        change(&mut words);
        let mut tally = Tally::default();
        tally.add(case, Ok(words)).unwrap();
        tally
    }

    #[test]
    fn equal_words_are_no_difference() {
        let tally = tally_of("oct32", Operation::Encode, |_| {});
        assert_eq!((tally.kernels, tally.outcome.codes_differ, tally.differing.len()), (1, 0, 0));
        assert!(tally.faults.is_empty());
    }

    /// A neighbouring code and a special one; the neighbour's error is beyond the bound.
    #[test]
    fn codes_that_differ_are_counted() {
        let tally = tally_of("oct32", Operation::Encode, |words| {
            words[5] ^= 2;
            words[RANDOM + 1] ^= 1;
        });
        assert_eq!((tally.outcome.codes_differ, tally.outcome.special_differ), (1, 1));
        assert!(tally.outcome.error > 1.0);
        assert_eq!((tally.differing.len(), tally.out_of_bounds.len()), (1, 1));
    }

    #[test]
    fn a_component_in_its_last_bit_is_within_the_bound() {
        let tally = tally_of("oct32", Operation::Decode, |words| words[7] ^= 1);
        assert_eq!(tally.outcome.elements_differ, 1);
        assert!(tally.angle > 0.0 && tally.out_of_bounds.is_empty());
    }

    #[test]
    fn words_that_are_missing_are_a_fault() {
        let tally = tally_of("frame64", Operation::Encode, |words| words.truncate(9));
        assert_eq!((tally.kernels, tally.faults.len()), (0, 1));
    }
}
