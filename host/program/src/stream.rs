//! Files of elements, which are little-endian f32, and of codes, converted chunk by chunk.

use crate::raw::{Suspicion, read_until_full, suspicion, swap_if_big_endian};
use crate::{Error, Result};
use std::io::{Read, Write};
use std::path::Path;
use unitvec_catalogue::{AnyCodec, Domain, Element, Measure, Null, has_direction};
use unitvec_run::backend::{Backend, CHUNK};

/// An input or an output with the path that its errors name.
pub struct Named<'a, S: ?Sized> {
    /// Path, `-` for a standard stream.
    pub path: &'a Path,
    /// The source or the destination of the bytes.
    pub stream: &'a mut S,
}

impl<'a, S: ?Sized> Named<'a, S> {
    /// Names a stream.
    pub fn new(path: &'a Path, stream: &'a mut S) -> Self {
        Self { path, stream }
    }
}

/// A source of bytes.
pub type Input<'a> = Named<'a, dyn Read + 'a>;

/// A destination of bytes.
pub type Sink<'a> = Named<'a, dyn Write + 'a>;

/// A number of elements, and the place of the first of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Places {
    /// How many there are.
    pub count: u64,
    /// The place of the first, counted from 0.
    pub first: Option<u64>,
}

impl Places {
    fn add(&mut self, at: u64) {
        self.count += 1;
        self.first = Some(self.first.map_or(at, |first| first.min(at)));
    }
}

/// Counts of the elements encoded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counts {
    /// Vectors, frames or rotations.
    pub elements: u64,
    /// Vectors, rotations, or normals of frames, without a direction that codecs can use (see [`has_direction`]); in codes also
    /// those with nothing to store: -Z for a codec of the hemisphere, components or lengths that round to 0. Stored as +Z,
    /// rotations as the identity, vectors with a length as 0 unless they are infinite.
    pub no_direction: Places,
    /// Vectors without a direction that were stored as the null code.
    pub nulls: u64,
    /// Tangents of frames without one; in codes also those with none in the plane of the decoded normal. Any perpendicular
    /// to the normal is stored.
    pub no_tangent: Places,
    /// Vectors below the equator that a codec of the hemisphere cannot store.
    pub below: u64,
    /// The least and the greatest length of vectors, or normals of frames, that have a direction.
    pub lengths: Option<[f64; 2]>,
    /// What the floats seem to be instead: see [`suspicion`].
    pub suspicion: Option<Suspicion>,
}

impl Counts {
    /// Counts elements that lie one after the other.
    pub fn add(&mut self, element: Element, floats: &[f32]) {
        let before = self.add_normals(element, floats);
        if element == Element::Frame {
            let tangents = (before..).zip(vectors(element, floats, 3));
            tangents.filter(|(_, vector)| !has_direction(vector)).for_each(|(at, _)| self.no_tangent.add(at));
        }
    }

    /// Returns the number of elements before these.
    fn add_normals(&mut self, element: Element, floats: &[f32]) -> u64 {
        let before = self.elements;
        self.elements += (floats.len() / element.floats()) as u64;
        let parts = floats.chunks_exact(element.floats()).map(|floats| &floats[..element.part_floats()]);
        for (at, part) in (before..).zip(parts) {
            if has_direction(part) {
                let length = part.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
                let [least, most] = self.lengths.unwrap_or([length; 2]);
                self.lengths = Some([least.min(length), most.max(length)]);
            } else {
                self.no_direction.add(at);
            }
        }
        before
    }

    /// Counts vectors and their codes. `no_code` is that of a vector without a direction.
    fn add_vectors(&mut self, format: &AnyCodec, no_code: &[u8], floats: &[f32], codes: &[u8]) {
        let before = self.add_normals(Element::Vector, floats);
        let is_raw = keeps_lengths(format);
        let with_direction = vectors(Element::Vector, floats, 0)
            .zip(codes.chunks_exact(format.bytes))
            .zip(before..)
            .filter(|((vector, _), _)| has_direction(vector));
        for ((vector, code), at) in with_direction {
            let is_below = format.domain == Domain::Hemisphere && vector[2] < 0.0;
            // A vector along +Z has raw components of 1/2 at least where its code is +Z's.
            let is_small = is_raw && vector.iter().all(|component| component.abs() < 0.5);
            if code == no_code && (is_below || is_small) {
                self.no_direction.add(at);
            } else if is_below {
                self.below += 1;
            }
        }
    }

    /// Counts frames by their codes and those with the tangents turned round. Only where a codec finds no tangent are the
    /// two alike.
    fn add_frames(&mut self, format: &AnyCodec, floats: &[f32], codes: &[u8], turned: &[u8]) {
        let before = self.add_normals(Element::Frame, floats);
        let pairs = codes.chunks_exact(format.bytes).zip(turned.chunks_exact(format.bytes)).zip(before..);
        pairs.filter(|((code, turned), _)| code == turned).for_each(|(_, at)| self.no_tangent.add(at));
    }
}

/// The vectors that begin at this float of each element.
fn vectors(element: Element, floats: &[f32], at: usize) -> impl Iterator<Item = [f32; 3]> {
    floats.chunks_exact(element.floats()).map(move |e| [e[at], e[at + 1], e[at + 2]])
}

/// True for codecs that store a length, or components as given, so that small vectors are lost.
pub fn keeps_lengths(format: &AnyCodec) -> bool {
    !format.is_unit && format.family != "best_fit" && !format.is_format()
}

/// Frames with their tangents turned round.
fn turned(frames: &[f32]) -> Vec<f32> {
    let mut turned = frames.to_vec();
    for frame in turned.chunks_exact_mut(Element::Frame.floats()) {
        frame[3..6].iter_mut().for_each(|component| *component = -*component);
    }
    turned
}

/// Encodes raw vectors or frames until the input ends, in bounded memory, with null codes where one is given. `progress`
/// receives the number done so far.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within an element, and any error of reading, encoding or writing.
pub fn encode(
    backend: &mut dyn Backend,
    format: &AnyCodec,
    null: Option<Null<'_>>,
    input: Input<'_>,
    mut output: Sink<'_>,
    progress: &mut dyn FnMut(u64),
) -> Result<Counts> {
    let mut codes = vec![0; CHUNK * format.bytes];
    let mut turned_codes = codes.clone();
    let mut no_code = vec![0; format.bytes];
    if format.element == Element::Vector {
        format.encode_cpu(&[0.0; 3], &mut no_code)?;
    }
    let mut done = Counts::default();
    let suspicion = for_each_chunk(input, format.element, &mut |elements, _| {
        let codes = &mut codes[..elements.len() / format.element.floats() * format.bytes];
        backend.encode(format, elements, codes)?;
        done.nulls += null.map_or(Ok(0), |null| null.put(elements, codes))?;
        write(&mut output, codes)?;
        match format.element {
            Element::Vector => done.add_vectors(format, &no_code, elements, codes),
            Element::Rotation => done.add(Element::Rotation, elements),
            Element::Frame => {
                let turned_codes = &mut turned_codes[..codes.len()];
                backend.encode(format, &turned(elements), turned_codes)?;
                done.add_frames(format, elements, codes, turned_codes);
            }
        }
        progress(done.elements);
        Ok(())
    })?;
    Ok(Counts { suspicion: suspicion.filter(|_| format.measure() != Measure::Relative), ..done })
}

/// Reads raw vectors or frames until the input ends, and hands on at most [`CHUNK`] of them at a time, with the number
/// of those before. Returns the [`suspicion`] that the first of them raise.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within an element, and any error of reading or of `each`.
pub fn for_each_chunk(
    mut input: Input<'_>,
    element: Element,
    each: &mut dyn FnMut(&[f32], u64) -> Result<()>,
) -> Result<Option<Suspicion>> {
    let mut elements = vec![0.0; CHUNK * element.floats()];
    let (mut done, mut found) = (0, None);
    loop {
        let count = read_next(&mut input, element, &mut elements, done)?;
        if count == 0 {
            return Ok(found);
        }
        let elements = &mut elements[..count * element.floats()];
        if done == 0 {
            found = suspicion(element, elements, count < CHUNK);
        }
        each(elements, done)?;
        done += count as u64;
    }
}

/// Fills a buffer with as many of the next raw vectors or frames as there are, after so many `before`. Returns their number.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within an element, and any error of reading.
pub fn read_next(
    input: &mut Input<'_>,
    element: Element,
    elements: &mut [f32],
    before: u64,
) -> Result<usize> {
    let bytes = bytemuck::cast_slice_mut(elements);
    let count = read_elements(input, bytes, element.bytes(), element.plural(), before)?;
    swap_if_big_endian(&mut elements[..count * element.floats()]);
    Ok(count)
}

/// Decodes dense codes into raw vectors or frames until the input ends, in bounded memory, with null codes where one is
/// given. `progress` receives the number done so far. Returns their number.
///
/// # Errors
/// [`Error::Truncated`] if the input ends within a code, and any error of reading, decoding or writing.
pub fn decode(
    backend: &mut dyn Backend,
    format: &AnyCodec,
    null: Option<Null<'_>>,
    mut input: Input<'_>,
    mut output: Sink<'_>,
    progress: &mut dyn FnMut(u64),
) -> Result<u64> {
    let floats = format.element.floats();
    let (mut codes, mut elements) = (Vec::new(), vec![0.0; CHUNK * floats]);
    let mut done = 0;
    loop {
        let count = decode_next(backend, (format, null), &mut input, &mut codes, &mut elements, done)?;
        if count == 0 {
            return Ok(done);
        }
        let elements = &mut elements[..count * floats];
        swap_if_big_endian(elements);
        write(&mut output, bytemuck::cast_slice(elements))?;
        done += count as u64;
        progress(done);
    }
}

/// Fills a buffer with as many of the next elements as there are codes of, after so many `before`. Returns their number. `codes`
/// keeps its room from call to call.
///
/// # Errors
/// The errors of [`decode`], but for those of writing.
pub fn decode_next(
    backend: &mut dyn Backend,
    (format, null): (&AnyCodec, Option<Null<'_>>),
    input: &mut Input<'_>,
    codes: &mut Vec<u8>,
    elements: &mut [f32],
    before: u64,
) -> Result<usize> {
    let floats = format.element.floats();
    codes.resize(elements.len() / floats * format.bytes, 0);
    let count = read_elements(input, codes, format.bytes, "codes", before)?;
    let (codes, elements) = (&codes[..count * format.bytes], &mut elements[..count * floats]);
    backend.decode(format, codes, elements)?;
    null.map_or(Ok(()), |null| null.clear(codes, elements))?;
    Ok(count)
}

fn write(output: &mut Sink<'_>, bytes: &[u8]) -> Result<()> {
    output.stream.write_all(bytes).map_err(|source| unitvec_files::Error::writing(output.path, source))?;
    Ok(())
}

/// Fills `buffer` with as many whole elements as there are; 0 at the end of the input. `before` elements were read
/// already.
fn read_elements(
    input: &mut Input<'_>,
    buffer: &mut [u8],
    size: usize,
    unit: &str,
    before: u64,
) -> Result<usize> {
    let filled = read_until_full(input.stream, buffer)
        .map_err(|source| unitvec_files::Error::reading(input.path, source))?;
    let (count, left) = (filled / size, filled % size);
    if left == 0 {
        return Ok(count);
    }
    Err(Error::truncated(input.path, before + count as u64, unit, size, left))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw::to_bytes;
    use std::io;
    use unitvec_catalogue::find;
    use unitvec_run::backend::Cpu;

    /// Hands out its bytes a few at a time, as a pipe may.
    struct Trickle<'a>(&'a [u8]);

    impl Read for Trickle<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = buffer.len().min(self.0.len()).min(7);
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    struct FullDisk;

    impl Write for FullDisk {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn run_encode(codec: &str, elements: &[f32], output: &mut dyn Write) -> Result<Counts> {
        let (codec, input) = (find(codec).unwrap(), to_bytes(elements));
        let (from, to) = (Path::new("in"), Path::new("out"));
        encode(
            &mut Cpu,
            codec,
            None,
            Named::new(from, &mut Trickle(&input)),
            Named::new(to, output),
            &mut |_| (),
        )
    }

    #[test]
    fn short_reads_do_not_cut_the_input() {
        let mut codes = Vec::new();
        assert_eq!(run_encode("oct24", &[0.0, 0.0, 1.0].repeat(100), &mut codes).unwrap().elements, 100);
        assert_eq!(codes.len(), 300);
    }

    fn count(codec: &str, elements: &[f32]) -> Counts {
        run_encode(codec, elements, &mut io::sink()).unwrap()
    }

    /// Vectors without a direction are counted, normals and tangents of frames apart.
    #[test]
    fn vectors_without_a_direction_are_counted() {
        let [zero, nan, tiny, huge, x] =
            [[0.0; 3], [f32::NAN, 0.0, 1.0], [1e-30; 3], [f32::INFINITY, 0.0, 0.0], [1.0, 0.0, 0.0]];
        let vectors = [zero, nan, tiny, huge, x, [0.0, 5.0, 0.0], [0.0, -0.0, -0.0]].concat();
        let no_direction = Places { count: 5, first: Some(0) };
        let expected = Counts { elements: 7, no_direction, lengths: Some([1.0, 5.0]), ..Counts::default() };
        assert_eq!(count("oct32", &vectors), expected);
        let frame = |normal: [f32; 3], tangent: [f32; 3]| [&normal[..], &tangent, &[1.0]].concat();
        let frames = [frame(zero, zero), frame(x, nan), frame(zero, x), frame(x, x), frame(x, huge)].concat();
        // The tangent (x, x) is parallel to its normal.
        let expected = (5, Places { count: 2, first: Some(0) }, Places { count: 4, first: Some(0) });
        let counts = count("frame32", &frames);
        assert_eq!((counts.elements, counts.no_direction, counts.no_tangent), expected);
    }

    /// A tangent along its normal, or along the +Z that stands for a missing one, is lost; one that is a degree off is not.
    #[test]
    fn tangents_along_their_normals_are_counted() {
        let frame = |normal: [f32; 3], tangent: [f32; 3]| [&normal[..], &tangent, &[-1.0]].concat();
        let n = [3.0, -4.0, 5.0];
        let frames = [
            frame(n, n),
            frame(n, n.map(|c| c * -0.01)),
            frame([0.0; 3], [0.0, 0.0, 2.0]),
            frame(n, [3.1, -4.0, 5.0]),
            frame([0.0; 3], [1.0, 0.0, 2.0]),
        ];
        for codec in ["frame32", "frame64"] {
            let counts = count(codec, &frames.concat());
            assert_eq!((counts.no_direction.count, counts.no_tangent.count), (2, 3), "{codec}");
        }
    }

    /// A codec of the hemisphere stores nothing of -Z; raw formats store nothing of components that round to 0.
    #[test]
    fn vectors_that_leave_nothing_are_counted() {
        let vectors = [0.0, 0.0, -1.0, 0.0, -0.0, -3.0, 0.0, 0.0, 1.0, 0.1, 0.0, -1.0];
        for codec in ["hemioct16", "xyonly16", "xyonly32f"] {
            let counts = count(codec, &vectors);
            assert_eq!((counts.no_direction.count, counts.below), (2, 1), "{codec}");
        }
        let vectors = [1e-3, 0.0, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.5, 0.0];
        for (codec, expected) in [("snorm8x3", 2), ("snorm5x3", 2), ("float16x3", 0), ("oct16", 0)] {
            assert_eq!(count(codec, &vectors).no_direction.count, expected, "{codec}");
        }
        assert_eq!(count("float16x3", &[1e-9, 0.0, 0.0]).no_direction.count, 1);
        let kept =
            ["snorm8x3", "unorm8x3", "float16x3", "snorm8x3p", "snorm8x3_nearest", "crytek_bfn24", "oct16"]
                .map(|codec| keeps_lengths(find(codec).unwrap()));
        assert_eq!(kept, [true, true, true, false, false, false, false]);
    }

    /// Elements below the equator are counted for codecs of the hemisphere alone.
    #[test]
    fn vectors_below_the_equator_are_counted() {
        let vectors = [0.0, 0.6, -0.8, 0.0, 1.0, -0.0, 0.0, f32::NAN, -1.0, 0.0, 0.0, 1.0];
        assert_eq!((count("hemioct16", &vectors).below, count("oct16", &vectors).below), (1, 0));
    }

    #[test]
    fn a_full_disk_is_an_error_that_names_the_file() {
        let error = run_encode("oct24", &[0.0; 6], &mut FullDisk).unwrap_err();
        assert!(
            matches!(&error, Error::Files(unitvec_files::Error::Write { path, .. }) if path == Path::new("out")),
            "{error}"
        );
    }
}
