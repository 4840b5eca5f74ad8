//! The tests of one codec.

use super::{Backends, Comparison, Options, Row};
use crate::backend::CHUNK;
use crate::{Error, Result, sampling};
use unitvec_catalogue::{AnyCodec, Element};

/// Directions halfway between lattice points, where rounding breaks ties.
const HALFWAY: usize = 50_000;

/// The inputs of one codec, which are made while it runs.
pub struct Plan<'a> {
    format: &'static AnyCodec,
    steps: Vec<Step<'a>>,
}

/// Inputs of one kind, and their number.
struct Step<'a> {
    count: usize,
    input: Input<'a>,
}

enum Input<'a> {
    /// The floats of elements. Errors are measured only where all have a direction.
    Elements { floats: Box<dyn Iterator<Item = f32> + Send + 'a>, measured: bool },
    /// Codes, of which the low bits count.
    Codes(Box<dyn Iterator<Item = u64> + Send + 'a>),
}

impl<'a> Step<'a> {
    fn elements(count: usize, floats: impl Iterator<Item = f32> + Send + 'a) -> Self {
        Self { count, input: Input::Elements { floats: Box::new(floats), measured: false } }
    }

    fn codes(count: usize, codes: impl Iterator<Item = u64> + Send + 'a) -> Self {
        Self { count, input: Input::Codes(Box::new(codes)) }
    }
}

impl<'a> Plan<'a> {
    /// Random elements, special ones, and codes, special ones too; for vectors also the normals of meshes and ties.
    pub fn new(format: &'static AnyCodec, options: &'a Options) -> Self {
        let Options { count, seed, normals, all_codes_up_to } = options;
        let random = sampling::random_elements(format.element, format.domain, *seed);
        let mut steps =
            vec![Step { count: *count, input: Input::Elements { floats: random, measured: true } }];

        let special = sampling::special_elements(format.element);
        steps.push(Step::elements(special.len() / format.element.floats(), special.iter().copied()));
        if format.element == Element::Vector {
            steps.push(Step::elements(normals.len(), normals.as_flattened().iter().copied()));
            // The largest integer of a coordinate's snorm, up to where f32 still has halves.
            let m = (1 << (format.bits / 2 - 1).min(22)) - 1;
            let ties = sampling::halfway_vectors(m, *seed).flatten();
            steps.push(Step::elements(HALFWAY, ties));
        }

        let runs = sampling::special_codes();
        steps.push(Step::codes(runs.len(), runs.into_iter()));
        steps.push(if format.bits <= *all_codes_up_to {
            Step::codes(1 << format.bits, 0..)
        } else {
            Step::codes(*count, sampling::random_codes(*seed))
        });
        Self { format, steps }
    }

    /// Elements and codes that [`run`](Self::run) passes through each backend.
    pub fn work(&self) -> u64 {
        self.steps.iter().map(|step| step.count as u64).sum()
    }

    /// Runs the codec. `progress` receives the number of elements and codes done since the last call.
    ///
    /// # Errors
    /// Any error of the backends. Mismatches are no error: they are in the row.
    pub fn run(self, backends: &mut Backends, progress: &mut dyn FnMut(u64)) -> Result<Row> {
        let floats = self.format.element.floats();
        let mut comparison = Comparison::new(self.format, backends);
        for Step { count, input } in self.steps {
            match input {
                Input::Elements { floats: elements, measured } => {
                    sampling::in_chunks(elements, count * floats, CHUNK * floats, |chunk| {
                        comparison.elements(chunk, measured)?;
                        progress((chunk.len() / floats) as u64);
                        Ok::<(), Error>(())
                    })?;
                }
                Input::Codes(codes) => sampling::in_chunks(codes, count, CHUNK, |chunk| {
                    comparison.codes(chunk)?;
                    progress(chunk.len() as u64);
                    Ok::<(), Error>(())
                })?,
            }
        }
        Ok(comparison.into_row())
    }
}
