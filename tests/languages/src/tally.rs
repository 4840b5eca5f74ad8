//! Results of a compiler's code on a driver.

use crate::cases::{Case, stored};
use crate::{Result, told};
use unitvec::direction::{MAX_NORM, MIN_NORM};
use unitvec_catalogue::{AnyCodec, Operation};
use unitvec_lab::imprecise::{Outcome, error_bound, of_codes, of_elements};

/// The results of all cases.
#[derive(Default)]
pub struct Tally {
    /// Kernels of codecs that ran, or were compiled where none runs.
    pub kernels: usize,
    /// Random inputs of each kernel; 0 where none runs.
    pub random: usize,
    pub outcome: Outcome,
    /// Largest angle between a decoded element and the CPU's, as a part of the codec's error bound.
    pub angle: f64,
    /// Cases that did not compile, caused a warning or did not run.
    pub faults: Vec<String>,
    /// The cases that differ, in words.
    pub differing: Vec<String>,
    /// Cases that differ by more than [`Bounds`] allow, in words.
    pub out_of_bounds: Vec<String>,
}

/// The difference allowed in plain editions of languages without `precise`, as parts of a codec's error bound. A
/// compiler may leave out roundings, or add some: a position moves by a few ULP, and only codes of positions that near
/// to a border change. The error of the arithmetic is far below the bound of codecs of up to 32 bits. Wider ones are as
/// fine as floats, and compute with two floats, of which a compiler may drop the second.
pub struct Bounds {
    /// The error of a random element whose code differs. The code of a special one may stand for a direction that is one bound
    /// farther from the CPU's, which is itself off by up to one; without a direction it has to be the CPU's.
    pub error: f64,
    /// The angle between a decoded element and the CPU's.
    pub angle: f64,
}

impl Bounds {
    pub fn of(format: &AnyCodec) -> Self {
        if format.bits <= 32 { Self { error: 1.0, angle: 0.05 } } else { Self { error: 2.0, angle: 1.0 } }
    }
}

impl Tally {
    /// Adds a module that is not run.
    pub fn add_compiled(&mut self, case: &Case, module: Result<Vec<u8>>) {
        match module {
            Ok(_) => self.kernels += usize::from(!case.has_all_files),
            Err(fault) => self.faults.push(format!("{}: {fault}", case.name())),
        }
    }

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
        self.random = case.random;
        if words == case.expected {
            return Ok(());
        }
        let (outcome, special) = (outcome(case, &words)?, special_part(case, &words)?);
        let angle = outcome.angle_deg / error_bound(case.format);
        let Outcome { codes_differ, special_differ, error, elements_differ, .. } = outcome;
        let described = format!(
            "{name}: {codes_differ} + {special_differ} codes differ, error {error:.3} of the bound, of special ones {special:.3}; {elements_differ} vectors \
             differ, angle {angle:.3} of the bound"
        );
        let bounds = Bounds::of(case.format);
        // The CPU's own error is within one bound.
        if error > bounds.error || special > bounds.error + 1.0 || angle > bounds.angle {
            self.out_of_bounds.push(described.clone());
        }
        self.differing.push(described);
        self.outcome.add(outcome);
        self.angle = self.angle.max(angle);
        Ok(())
    }
}

/// The differences of a case's results from those expected.
fn outcome(case: &Case, words: &[u32]) -> Result<Outcome> {
    if case.operation == Operation::Decode {
        let [decoded, expected] = [words, &case.expected].map(bytemuck::cast_slice);
        return Ok(of_elements(case.format, decoded, expected));
    }
    let (read, written) = case.words();
    let (random, special) = words.split_at(case.random * written);
    let (expected, expected_special) = case.expected.split_at(case.random * written);
    let differ = |a: &[u32], b: &[u32]| {
        a.chunks_exact(written).zip(b.chunks_exact(written)).filter(|(a, b)| a != b).count() as u64
    };
    let elements = bytemuck::cast_slice(&case.input[..case.random * read]);
    let (codes, expected_codes) = (stored(case.format, random), stored(case.format, expected));
    let (_, error) = of_codes(case.format, elements, &codes, &expected_codes).map_err(told)?;
    Ok(Outcome {
        codes_differ: differ(random, expected),
        special_differ: differ(special, expected_special),
        error,
        ..Outcome::default()
    })
}

/// The largest angle between the vectors of special elements' codes and the CPU's, as a part of the codec's error
/// bound; infinite where an element without a direction has another code than the CPU's, which is +Z's.
fn special_part(case: &Case, words: &[u32]) -> Result<f64> {
    if case.operation == Operation::Decode {
        return Ok(0.0);
    }
    let (read, written) = case.words();
    let elements = case.input.chunks_exact(read).map(bytemuck::cast_slice::<u32, f32>);
    let codes = words.chunks_exact(written).zip(case.expected.chunks_exact(written));
    let mut part = 0f64;
    for (element, (code, expected)) in elements.zip(codes).skip(case.random).filter(|(_, (a, b))| a != b) {
        match has_direction(element) {
            Some(true) => {
                let [code, expected] = [decoded(case.format, code)?, decoded(case.format, expected)?];
                let angle = of_elements(case.format, &code, &expected).angle_deg;
                part = part.max(angle / error_bound(case.format));
            }
            Some(false) => part = f64::INFINITY,
            None => {}
        }
    }
    Ok(part)
}

/// True if any vector of an element has a direction; `None` where the rounding of a norm decides.
fn has_direction(element: &[f32]) -> Option<bool> {
    let limits = [MIN_NORM, MAX_NORM].map(f64::from);
    let norm = |vector: &[f32]| vector.iter().map(|x| f64::from(*x).abs()).sum::<f64>();
    // The fourth component of a tangent is the handedness.
    let norms: Vec<f64> = element.chunks(3).filter(|vector| vector.len() == 3).map(norm).collect();
    let is_open = |norm: &f64| limits.iter().any(|limit| (norm / limit - 1.0).abs() < 1e-6);
    let is_usable = |norm: &f64| (limits[0]..limits[1]).contains(norm);
    (!norms.iter().any(is_open)).then(|| norms.iter().any(is_usable))
}

/// The CPU's vector of one code.
fn decoded(format: &AnyCodec, code: &[u32]) -> Result<Vec<f32>> {
    let mut element = vec![0.0; format.element.floats()];
    format.decode_cpu(&stored(format, code), &mut element).map_err(told)?;
    Ok(element)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::{RANDOM, cases};
    use unitvec_catalogue::find;

    fn tally_of(id: &str, operation: Operation, change: impl FnOnce(&mut Vec<u32>)) -> Tally {
        let cases = cases(&[find(id).unwrap()]).unwrap();
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

    /// A code far away, of the first special element that has a direction, or has none.
    #[test]
    fn codes_of_special_elements_are_bounded() {
        let cases = cases(&[find("oct32").unwrap()]).unwrap();
        let floats = bytemuck::cast_slice::<u32, f32>(&cases[0].input).chunks_exact(3);
        for is_usable in [true, false] {
            let is_such = |element: &[f32]| has_direction(element) == Some(is_usable);
            let at = floats.clone().skip(RANDOM).position(is_such).unwrap();
            let tally = tally_of("oct32", Operation::Encode, |words| words[RANDOM + at] ^= 1 << 6);
            assert_eq!((tally.outcome.special_differ, tally.outcome.error), (1, 0.0));
            assert_eq!(tally.out_of_bounds.len(), 1, "{is_usable}");
        }
        let unclear = [MIN_NORM, 0.0, 0.0];
        assert_eq!(has_direction(&unclear), None);
        // Either vector of a frame will do.
        assert_eq!(has_direction(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, f32::NAN]), Some(true));
        assert_eq!(has_direction(&[f32::NAN, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]), Some(false));
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
