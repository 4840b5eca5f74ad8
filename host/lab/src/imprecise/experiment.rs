//! The experiment on one codec with devices of each model.

use super::difference::{bits_differ, of_codes, of_elements};
use super::{Model, Options, Outcome, Row, merged};
use crate::{Error, Result};
use std::collections::BTreeMap;
use unitvec_catalogue::AnyCodec;
use unitvec_run::backend::{Backend, BackendKind, CHUNK, Cpu, Gpu};
use unitvec_run::sampling;
use unitvec_run::shader::Edition;

/// Kernels on a device, by their edition and source.
pub type Gpus = BTreeMap<(Edition, BackendKind), Gpu>;

/// Runs one codec with all seeds.
///
/// # Errors
/// Any error of the devices.
pub fn run(
    format: &'static AnyCodec,
    options: &Options,
    gpus: &mut Gpus,
    progress: &mut dyn FnMut(u64),
) -> Result<Row> {
    let mut rows = BTreeMap::new();
    let sources = gpus.len() as u64;
    for (index, (&(edition, kind), gpu)) in (0..).zip(gpus) {
        let is_exact = edition == Edition::Exact;
        let models: Vec<Model> =
            options.models.iter().copied().filter(|model| is_exact || model.is_conformant()).collect();
        let mut row = Row { id: format.id.to_owned(), ..Row::default() };
        for seed in &options.seeds {
            let (models, row) = (&*models, &mut row);
            let mut run = Run { format, options, models, is_exact, seed: *seed, gpu, row };
            run.special_elements()?;
            let random = sampling::random_elements(format.element, format.domain, *seed);
            let floats = format.element.floats();
            sampling::in_chunks(random, options.count * floats, CHUNK * floats, |elements| {
                run.random_elements(elements)
            })?;
            let count = options.codes(format) as usize;
            let codes: Box<dyn Iterator<Item = u64>> = if format.bits <= options.all_codes_up_to {
                Box::new(0..)
            } else {
                Box::new(sampling::random_codes(*seed))
            };
            sampling::in_chunks(codes, count, CHUNK, |codes| run.codes(codes))?;
        }
        let done = |sources_done: u64| options.work(format) * sources_done / sources;
        progress(done(index + 1) - done(index));
        gpu.forget_kernels();
        if is_exact {
            row.exact = std::mem::take(&mut row.models);
        }
        rows.insert((edition, kind), row);
    }
    merged(rows).ok_or(Error::NoKernels)
}

/// One codec, seed and source of kernels.
struct Run<'a> {
    format: &'static AnyCodec,
    options: &'a Options,
    models: &'a [Model],
    is_exact: bool,
    seed: u64,
    gpu: &'a mut Gpu,
    row: &'a mut Row,
}

impl Run<'_> {
    fn random_elements(&mut self, elements: &[f32]) -> Result<()> {
        self.row.elements += (elements.len() / self.format.element.floats()) as u64;
        let outcome = |codes_differ, error| Outcome { codes_differ, error, ..Outcome::default() };
        let codes = self.encode_on_all(elements, outcome)?;
        self.decode_on_all(&codes, false)
    }

    fn special_elements(&mut self) -> Result<()> {
        let special = sampling::special_elements(self.format.element);
        let outcome = |special_differ, _| Outcome { special_differ, ..Outcome::default() };
        self.encode_on_all(special, outcome).map(drop)
    }

    fn codes(&mut self, codes: &[u64]) -> Result<()> {
        let codes = sampling::stored(codes, self.format.bytes);
        // The first seed decodes all codes where they are few enough; other seeds would repeat it.
        let is_first = self.options.seeds.first() == Some(&self.seed);
        self.decode_on_all(&codes, !is_first && self.format.bits <= self.options.all_codes_up_to)
    }

    /// Encodes elements on each device, and notes the number of codes that differ from the CPU's, which it returns, and
    /// the largest error of these, as a part of the bound.
    fn encode_on_all(&mut self, elements: &[f32], outcome: impl Fn(u64, f64) -> Outcome) -> Result<Vec<u8>> {
        let format = self.format;
        let mut expected = vec![0; elements.len() / format.element.floats() * format.bytes];
        Cpu.encode(format, elements, &mut expected)?;
        let mut codes = expected.clone();
        for model in self.models {
            self.device(Some(*model), &mut Cpu).encode(format, elements, &mut codes)?;
            let (differ, error) = of_codes(format, elements, &codes, &expected)?;
            self.row.models.entry(*model).or_default().add(outcome(differ, error));
        }
        Ok(expected)
    }

    /// Decodes codes on each device, and encodes each result on every device. Codes that another seed had are encoded again
    /// only where the result depends on the seed.
    fn decode_on_all(&mut self, codes: &[u8], are_repeated: bool) -> Result<()> {
        let format = self.format;
        self.row.codes += (codes.len() / format.bytes) as u64;
        let floats = format.element.floats();
        let mut expected = vec![0.0; codes.len() / format.bytes * floats];
        Cpu.decode(format, codes, &mut expected)?;
        let mut devices = vec![(None, expected.clone())];
        for model in self.models {
            let mut decoded = vec![0.0; expected.len()];
            self.device(Some(*model), &mut Cpu).decode(format, codes, &mut decoded)?;
            self.row.models.entry(*model).or_default().add(of_elements(format, &decoded, &expected));
            if model.rounds_to_nearest() {
                devices.push((Some(*model), decoded));
            }
        }
        if self.is_exact {
            // Equal codes come back from anywhere.
            return Ok(());
        }
        self.stability(&devices, &expected, codes.len(), are_repeated)
    }

    /// Encodes each device's results on every device, and notes the codes that do not come back as `expected`. Codes
    /// that do not come back from the CPU alone do not count.
    fn stability(
        &mut self,
        devices: &[(Option<Model>, Vec<f32>)],
        expected: &[f32],
        bytes: usize,
        are_repeated: bool,
    ) -> Result<()> {
        let format = self.format;
        let floats = format.element.floats();
        let mut codes = vec![0; bytes];
        let mut again = vec![0.0; expected.len()];
        let mut comes_back = vec![true; expected.len() / floats];
        for (encoder, _) in devices {
            for (decoder, decoded) in devices {
                let is_exact = encoder.is_none() && decoder.is_none();
                if are_repeated && !is_exact && ![encoder, decoder].contains(&&Some(Model::Bits)) {
                    continue;
                }
                self.device(*encoder, &mut Cpu).encode(format, decoded, &mut codes)?;
                Cpu.decode(format, &codes, &mut again)?;
                let pairs = again.chunks_exact(floats).zip(expected.chunks_exact(floats));
                let equal = pairs.map(|(again, expected)| !bits_differ(again, expected));
                if is_exact {
                    comes_back = equal.collect();
                    continue;
                }
                let lost =
                    equal.zip(&comes_back).filter(|(equal, comes_back)| **comes_back && !equal).count();
                if lost > 0 {
                    let pair = format!("from {} to {}", name(*decoder), name(*encoder));
                    *self.row.unstable.entry(pair).or_default() += lost as u64;
                }
            }
        }
        Ok(())
    }

    /// A device of this model; the CPU without one.
    fn device<'a>(&'a mut self, model: Option<Model>, cpu: &'a mut Cpu) -> &'a mut dyn Backend {
        let Some(model) = model else { return cpu };
        // Kernels of other models serve all seeds.
        let seed = if model == Model::Bits { self.seed as u32 } else { 0 };
        self.gpu.rewrite_with((model != Model::Own).then(|| model.rewrite(seed)));
        self.gpu
    }
}

fn name(model: Option<Model>) -> String {
    model.map_or_else(|| "exact".to_owned(), |model| model.to_string())
}
