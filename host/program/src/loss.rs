//! Losses of files' vectors and frames to codecs: the angles between them and the decoded ones, or relative errors.

use crate::fit::Fit;
use crate::input::FileName;
use crate::raw::{Suspicion, swap_if_big_endian};
use crate::stream::{self, Input};
use crate::{Error, Result};
use rayon::prelude::*;
use serde::Serialize;
use std::path::Path;
use unitvec_catalogue::{AnyCodec, Element, Measure};
use unitvec_run::backend::{Backend, CHUNK};

/// The errors of one codec over one file, or over all of them.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Row {
    /// The file; `None` for all of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<FileName>,
    /// Codec; `as it is` for a file beside its original.
    pub id: &'static str,
    /// The part that the errors are of: `vector`, `axis`, `rotation`, or `normal` and `tangent` of frames.
    pub part: &'static str,
    /// Bits of a code; those of its floats for a file beside its original.
    pub bits: u32,
    /// Vectors measured.
    pub count: u64,
    /// Vectors left out, since they have no usable direction: zero, infinite, NaN; tangents of such a normal, too. Relative
    /// errors leave out those that are infinite or NaN, and zero where it does not come back as zero.
    pub left_out: u64,
    /// The errors; none where nothing was measured.
    #[serde(flatten)]
    pub errors: Option<Errors>,
}

/// Errors: angles, or relative ones.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Errors {
    /// Mean, median, 99 % and maximum.
    #[serde(skip)]
    pub sizes: [f64; 4],
    #[serde(flatten)]
    degrees: Option<Degrees>,
    #[serde(flatten)]
    relative: Option<Relative>,
    /// The first vector with the maximum.
    pub worst: Worst,
}

/// Errors in degrees.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
struct Degrees {
    /// Mean.
    mean_deg: f64,
    /// The least error that half of all do not exceed, to within a 4096th.
    median_deg: f64,
    /// The least error that 99 % of all do not exceed, to within a 4096th.
    p99_deg: f64,
    /// Maximum.
    max_deg: f64,
}

/// Errors `|d - v| / |v|` of vectors with a length, v, and the decoded ones, d.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
struct Relative {
    /// Mean of `|d - v| / |v|`.
    mean_relative: f64,
    /// The least relative error that half of all do not exceed, to within a 4096th.
    median_relative: f64,
    /// The least relative error that 99 % of all do not exceed, to within a 4096th.
    p99_relative: f64,
    /// Maximum of `|d - v| / |v|`.
    max_relative: f64,
}

/// A vector and its decoded one.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Worst {
    /// The file of the vector.
    pub file: FileName,
    /// The vector's place in the file, counted from 0.
    pub index: u64,
    /// The vector, or the rotation x, y, z, w.
    pub original: Vec<f32>,
    /// The decoded one.
    pub decoded: Vec<f32>,
}

/// The errors of all files.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct Report {
    /// A row for each file, codec and part.
    pub rows: Vec<Row>,
    /// A row for each codec and part, over all files.
    pub totals: Vec<Row>,
    /// Files that have no normals, or not all, so that these were computed from the faces.
    pub computed: Vec<FileName>,
    /// Files whose vectors are already in a format of other software.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub quantised: Vec<Quantised>,
    /// What raw floats seem to be instead, and the remedy, and that tangents were generated: a line for each such file.
    pub warnings: Vec<String>,
}

/// A file whose vectors are in a format of other software.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct Quantised {
    /// The file.
    pub file: FileName,
    /// The formats that decode to these vectors, those of the fewest bits first.
    pub formats: Vec<String>,
}

/// The name, in place of a codec's, of the row of a file beside its original.
pub const AS_IT_IS: &str = "as it is";

/// Measures codecs over one file after the other, in bounded memory.
pub struct Meter {
    formats: Vec<&'static AnyCodec>,
    element: Element,
    measure: Measure,
    rows: Vec<Row>,
    /// The tallies for each format and each part.
    totals: Vec<Tally>,
    quantised: Vec<Quantised>,
}

impl Meter {
    /// Prepares to measure the losses to these codecs.
    ///
    /// # Errors
    /// [`Error::Usage`] if some are of vectors and some of frames, if some are of axes and some of vectors with a length, or if
    /// there are none.
    pub fn new(formats: Vec<&'static AnyCodec>) -> Result<Self> {
        let refused = |words: &str| Error::Usage(format!("{words}; measure them one after the other"));
        let element = formats.first().map(|format| format.element);
        let element = element.filter(|element| formats.iter().all(|format| format.element == *element));
        let element =
            element.ok_or_else(|| refused("codecs of vectors and of frames read different inputs"))?;
        // Beside one of axes, a codec of directions is measured as if of axes.
        let mut special = formats.iter().map(|format| format.measure()).filter(|m| *m != Measure::Angle);
        let measure = special.next().unwrap_or_default();
        if special.any(|other| other != measure) {
            return Err(refused("axes and vectors with a length have errors of different kinds"));
        }
        let totals = vec![Tally::default(); formats.len() * measure.parts(element).len()];
        Ok(Self { formats, element, measure, rows: Vec::new(), totals, quantised: Vec::new() })
    }

    /// The kind of the errors measured.
    pub fn kind(&self) -> Measure {
        self.measure
    }

    /// The kind of element that the codecs encode.
    pub fn element(&self) -> Element {
        self.element
    }

    /// Measures the raw vectors or frames of a file. `progress` receives the number done so far. Returns what
    /// [`stream::for_each_chunk`] suspects.
    ///
    /// # Errors
    /// [`Error::Truncated`] if the input ends within an element, [`Error::NotFinite`] if the backend decodes to NaN,
    /// and any error of reading and of the backend.
    pub fn measure(
        &mut self,
        backend: &mut dyn Backend,
        input: Input<'_>,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Option<Suspicion>> {
        let (element, measure, file) = (self.element, self.measure, input.path);
        let parts = measure.parts(element);
        let mut tallies = vec![Tally::default(); self.totals.len()];
        let bytes = self.formats.iter().map(|format| format.bytes).max().unwrap_or(0);
        let mut codes = vec![0; CHUNK * bytes];
        let mut decoded = vec![0.0; CHUNK * element.floats()];
        let mut fit = Fit::default();
        let suspicion = stream::for_each_chunk(input, element, &mut |elements, before| {
            if element == Element::Vector {
                fit.see(elements);
            }
            let decoded = &mut decoded[..elements.len()];
            for (format, tallies) in self.formats.iter().zip(tallies.chunks_mut(parts.len())) {
                let codes = &mut codes[..elements.len() / element.floats() * format.bytes];
                backend.encode(format, elements, codes)?;
                backend.decode(format, codes, decoded)?;
                for (part, tally) in tallies.iter_mut().enumerate() {
                    tally.add_all(&Chunk {
                        file,
                        id: format.id,
                        before,
                        element,
                        measure,
                        part,
                        elements,
                        decoded,
                    })?;
                }
            }
            progress(before + (elements.len() / element.floats()) as u64);
            Ok(())
        })?;
        self.rows.extend(rows(names(&self.formats, parts), &tallies, measure, Some(file)));
        self.totals.iter_mut().zip(tallies).for_each(|(total, tally)| total.merge(tally));
        self.note(file, &fit);
        Ok(suspicion.filter(|_| measure != Measure::Relative))
    }

    fn note(&mut self, file: &Path, fit: &Fit) {
        let formats = fit.names();
        if !formats.is_empty() {
            self.quantised.push(Quantised { file: file.into(), formats });
        }
    }

    /// Measures how far the vectors of a file are from those of its original, of which there are as many, in the same order.
    /// Vectors that cannot be measured in one of them are left out. Returns the mean error, of frames that of normals.
    ///
    /// # Errors
    /// [`Error::Truncated`] if the original ends within an element, and any error of reading, such as that the file ends
    /// before the original.
    pub fn compare(&mut self, original: Input<'_>, made: Input<'_>) -> Result<Option<f64>> {
        let (element, measure, file) = (self.element, self.measure, made.path);
        let parts = measure.parts(element);
        let mut tallies = vec![Tally::default(); parts.len()];
        let (mut fit, mut decoded) = (Fit::default(), vec![0.0; CHUNK * element.floats()]);
        stream::for_each_chunk(original, element, &mut |originals, before| {
            let decoded = &mut decoded[..originals.len()];
            let bytes = bytemuck::cast_slice_mut(decoded);
            made.stream.read_exact(bytes).map_err(|source| unitvec_files::Error::reading(file, source))?;
            swap_if_big_endian(decoded);
            if element == Element::Vector {
                fit.see(decoded);
            }
            for (part, tally) in tallies.iter_mut().enumerate() {
                // What became of a direction that is lost is no error of a format.
                let mut elements = originals.to_vec();
                let pairs = elements.chunks_exact_mut(element.floats()).zip(decoded.chunks(element.floats()));
                pairs
                    .filter(|(_, made)| !measure.takes(element.part(made, part)))
                    .for_each(|(original, _)| original.fill(f32::NAN));
                let elements = &elements;
                let id = AS_IT_IS;
                tally.add_all(&Chunk { file, id, before, element, measure, part, elements, decoded })?;
            }
            Ok(())
        })?;
        let names = parts.iter().map(|part| (AS_IT_IS, 32 * element.floats() as u32, *part));
        self.rows.extend(rows(names, &tallies, measure, Some(file)));
        self.note(file, &fit);
        Ok(tallies[0].errors(measure).map(|errors| errors.sizes[0]))
    }

    /// The errors measured.
    pub fn report(self) -> Report {
        let names = names(&self.formats, self.measure.parts(self.element));
        let totals = rows(names, &self.totals, self.measure, None).collect();
        let (rows, quantised) = (self.rows, self.quantised);
        Report { rows, totals, computed: Vec::new(), quantised, warnings: Vec::new() }
    }
}

/// The name, the bits and the part of each row.
fn names(
    formats: &[&'static AnyCodec],
    parts: &'static [&'static str],
) -> impl Iterator<Item = (&'static str, u32, &'static str)> {
    formats.iter().flat_map(move |format| parts.iter().map(|part| (format.id, format.bits, *part)))
}

fn rows(
    names: impl Iterator<Item = (&'static str, u32, &'static str)>,
    tallies: &[Tally],
    measure: Measure,
    file: Option<&Path>,
) -> impl Iterator<Item = Row> {
    names.zip(tallies).map(move |((id, bits, part), tally)| Row {
        file: file.map(FileName::from),
        id,
        part,
        bits,
        count: tally.count,
        left_out: tally.left_out,
        errors: tally.errors(measure),
    })
}

/// A part of the elements of a file, and their decoded ones.
struct Chunk<'a> {
    file: &'a Path,
    id: &'static str,
    before: u64,
    element: Element,
    measure: Measure,
    part: usize,
    elements: &'a [f32],
    decoded: &'a [f32],
}

impl Chunk<'_> {
    /// The error of each element's vector; `None` where it, or the normal of a tangent, cannot be measured.
    fn errors(&self) -> Vec<Option<f64>> {
        let floats = self.element.floats();
        let pairs = self.elements.par_chunks_exact(floats).zip(self.decoded.par_chunks_exact(floats));
        let error =
            |(original, decoded)| self.measure.error_of_part(self.element, self.part, original, decoded);
        pairs.map(error).collect()
    }

    fn worst(&self, at: usize) -> Worst {
        let of =
            |elements: &[f32]| self.element.part(&elements[at * self.element.floats()..], self.part).to_vec();
        Worst {
            file: self.file.into(),
            index: self.before + at as u64,
            original: of(self.elements),
            decoded: of(self.decoded),
        }
    }
}

/// Low bits of an error, as f32, that its bin disregards: the bins are 2^-11 of their errors wide, so that their middles
/// are no more than 2^-12 off.
const BIN_SHIFT: u32 = 12;

#[derive(Clone, Default)]
struct Tally {
    count: u64,
    left_out: u64,
    sum: f64,
    max: f64,
    worst: Option<Worst>,
    /// Up to that of the greatest error.
    bins: Vec<u64>,
}

impl Tally {
    fn add_all(&mut self, chunk: &Chunk<'_>) -> Result<()> {
        for (at, error) in chunk.errors().into_iter().enumerate() {
            let Some(error) = error else {
                self.left_out += 1;
                continue;
            };
            if error.is_nan() {
                return Err(Error::NotFinite {
                    id: chunk.id,
                    index: chunk.before + at as u64,
                    path: chunk.file.into(),
                });
            }
            self.count += 1;
            self.sum += error;
            let bin = ((error as f32).to_bits() >> BIN_SHIFT) as usize;
            if bin >= self.bins.len() {
                self.bins.resize(bin + 1, 0);
            }
            self.bins[bin] += 1;
            if self.worst.is_none() || error > self.max {
                self.max = error;
                self.worst = Some(chunk.worst(at));
            }
        }
        Ok(())
    }

    fn merge(&mut self, other: Self) {
        self.count += other.count;
        self.left_out += other.left_out;
        self.sum += other.sum;
        if self.worst.is_none() || other.max > self.max {
            (self.max, self.worst) = (other.max, other.worst);
        }
        self.bins.resize(self.bins.len().max(other.bins.len()), 0);
        self.bins.iter_mut().zip(other.bins).for_each(|(bin, other)| *bin += other);
    }

    fn errors(&self, measure: Measure) -> Option<Errors> {
        let mean = self.sum / self.count as f64;
        let sizes @ [mean, median, p99, max] = [mean, self.quantile(0.5), self.quantile(0.99), self.max];
        let degrees = Degrees { mean_deg: mean, median_deg: median, p99_deg: p99, max_deg: max };
        let relative =
            Relative { mean_relative: mean, median_relative: median, p99_relative: p99, max_relative: max };
        let is_relative = measure == Measure::Relative;
        Some(Errors {
            sizes,
            degrees: (!is_relative).then_some(degrees),
            relative: is_relative.then_some(relative),
            worst: self.worst.clone()?,
        })
    }

    /// The middle of the bin of the least error that this part of all do not exceed.
    fn quantile(&self, part: f64) -> f64 {
        let rank = (part * self.count as f64).ceil() as u64;
        let mut up_to = 0;
        let is_reached = |bin: &u64| {
            up_to += bin;
            up_to >= rank
        };
        match self.bins.iter().position(is_reached) {
            // Zero, but for errors that are far below what f32 vectors can have.
            None | Some(0) => 0.0,
            Some(bin) => {
                let middle = ((bin as u32) << BIN_SHIFT) | (1 << (BIN_SHIFT - 1));
                f64::from(f32::from_bits(middle)).min(self.max)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::Named;
    use unitvec_catalogue::find;

    /// Decodes the last element to NaN.
    struct Broken;

    impl Backend for Broken {
        fn encode(&mut self, _: &AnyCodec, _: &[f32], _: &mut [u8]) -> unitvec_run::Result<()> {
            Ok(())
        }

        fn decode(&mut self, _: &AnyCodec, _: &[u8], elements: &mut [f32]) -> unitvec_run::Result<()> {
            elements.fill(1.0);
            elements[elements.len() - 1] = f32::NAN;
            Ok(())
        }
    }

    #[test]
    fn a_decoder_that_gives_nan_is_an_error() {
        let mut meter = Meter::new(vec![find("oct16").unwrap()]).unwrap();
        let mut bytes: &[u8] = bytemuck::cast_slice(&[1.0f32; 9]);
        let input: Input<'_> = Named::new(Path::new("in.bin"), &mut bytes);
        let error = meter.measure(&mut Broken, input, &mut |_| ()).unwrap_err();
        assert!(matches!(error, Error::NotFinite { id: "oct16", index: 2, .. }), "{error}");
    }
}
