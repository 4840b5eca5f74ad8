//! Needs of callers from other languages: doubles, codes as integers of the machine, errors of arrays, and processes that fork.

use crate::cpu::{AnyFunctions, resized};
use crate::{AnyCodec, Dither, Element, Measure, Null, has_direction, integer};
use std::borrow::Cow;
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};
use unitvec::interop::RotationFormat;
use unitvec::rotation_angle_deg;
use unitvec::slice::{LengthMismatch, expect_length};

impl Element {
    /// Rounds elements of doubles to floats. A part whose direction floats would not hold is divided by its largest component
    /// first.
    ///
    /// ```
    /// let mut floats = [0.0; 3];
    /// unitvec_catalogue::Element::Vector.round(&[1e300, 0.0, -1e300], &mut floats);
    /// assert_eq!(floats, [1.0, 0.0, -1.0]);
    /// ```
    pub fn round(self, doubles: &[f64], floats: &mut [f32]) {
        // Handedness, the last number of frames, is a part by itself.
        for (from, to) in doubles.chunks(self.floats()).zip(floats.chunks_mut(self.floats())) {
            from.chunks(self.part_floats()).zip(to.chunks_mut(self.part_floats())).for_each(round_part);
        }
    }
}

fn round_part((from, to): (&[f64], &mut [f32])) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from as f32);
    if has_direction(to) {
        return;
    }
    let largest = from.iter().fold(0.0, |largest: f64, component| largest.max(component.abs()));
    if largest > 0.0 && largest.is_finite() {
        to.iter_mut().zip(from).for_each(|(to, from)| *to = (from / largest) as f32);
    }
}

/// What to do besides coding each vector: nothing, unless said.
#[derive(Clone, Copy, Debug, Default)]
pub struct Manner<'a> {
    /// The code that vectors without a usable direction get, and that is decoded to zeros.
    pub null: Option<Null<'a>>,
    /// Dithered functions, and an offset of two floats for each vector.
    pub dither: Option<(Dither<'a>, &'a [f32])>,
}

/// A codec keeps axes, or vectors with a length, where directions are asked for.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{id} is not for directions; take another codec, as oct16p")]
pub struct NotForDirections {
    /// The codec.
    pub id: &'static str,
}

impl AnyCodec {
    /// Bytes of the smallest integer that holds a code: 1, 2, 4 or 8.
    pub const fn integer_bytes(&self) -> usize {
        self.bytes.next_power_of_two()
    }

    /// Encodes elements to little-endian integers of [`integer_bytes`](Self::integer_bytes) each, on the calling thread. Their
    /// bits above the codes are 0.
    ///
    /// ```
    /// # use unitvec_catalogue::{Manner, find};
    /// let codec = find("oct24p")?;
    /// let null = codec.null()?;
    /// let mut integers = [0xff; 4];
    /// codec.encode_integers(&[0.0, 0.0, 0.0], &mut integers, Manner { null: Some(null), dither: None })?;
    /// assert_eq!(u64::from(u32::from_le_bytes(integers)), null.code);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The slices hold different numbers of elements.
    pub fn encode_integers(
        &self,
        elements: &[f32],
        integers: &mut [u8],
        manner: Manner<'_>,
    ) -> Result<(), LengthMismatch> {
        let encode = |codes: &mut [u8]| {
            match manner.dither {
                Some((dither, offsets)) => dither.encode(elements, offsets, codes)?,
                None => self.encode_here(elements, codes)?,
            }
            manner.null.map_or(Ok(0), |null| null.put(elements, codes)).map(drop)
        };
        let size = self.integer_bytes();
        if size == self.bytes {
            return encode(integers);
        }
        let mut codes = vec![0; integers.len() / size * self.bytes];
        encode(&mut codes)?;
        integers.fill(0);
        copy_each((&codes, self.bytes), (integers, size));
        Ok(())
    }

    /// The first of some little-endian integers that is no code: one with a bit above [`bits`](Self::bits).
    pub fn first_beyond(&self, integers: &[u8]) -> Option<u64> {
        let size = self.integer_bytes();
        if self.bits == 8 * size as u32 {
            return None;
        }
        integers.chunks_exact(size).map(integer).find(|integer| integer >> self.bits > 0)
    }

    /// Decodes integers as [`encode_integers`](Self::encode_integers) makes them, on the calling thread.
    ///
    /// # Errors
    /// The slices hold different numbers of elements.
    pub fn decode_integers(
        &self,
        integers: &[u8],
        elements: &mut [f32],
        manner: Manner<'_>,
    ) -> Result<(), LengthMismatch> {
        let size = self.integer_bytes();
        let mut codes = Cow::Borrowed(integers);
        if size != self.bytes {
            let mut packed = vec![0; integers.len() / size * self.bytes];
            copy_each((integers, size), (&mut packed, self.bytes));
            codes = Cow::Owned(packed);
        }
        match manner.dither {
            Some((dither, offsets)) => dither.decode(&codes, offsets, elements)?,
            None => self.decode_here(&codes, elements)?,
        }
        manner.null.map_or(Ok(()), |null| null.clear(&codes, elements))
    }

    /// The error of each part of each element after encoding and decoding, as [`measure`](Self::measure) defines it; NaN where
    /// there is none.
    ///
    /// # Errors
    /// There are not as many errors as parts.
    pub fn errors(&self, elements: &[f32], errors: &mut [f64]) -> Result<(), LengthMismatch> {
        let (width, parts) = (self.element.floats(), self.element.directions().len());
        let mut codes = vec![0; elements.len() / width * self.bytes];
        let mut decoded = vec![0.0; elements.len()];
        expect_length(elements.len() / width * parts, errors.len())?;
        self.encode_here(elements, &mut codes)?;
        self.decode_here(&codes, &mut decoded)?;
        let pairs = elements.chunks_exact(width).zip(decoded.chunks_exact(width));
        for ((original, decoded), errors) in pairs.zip(errors.chunks_exact_mut(parts)) {
            for (part, error) in errors.iter_mut().enumerate() {
                let measured = self.measure().error_of_part(self.element, part, original, decoded);
                *error = measured.unwrap_or(f64::NAN);
            }
        }
        Ok(())
    }

    /// Checks that it keeps directions or rotations, which [`snapped`](Self::snapped) moves.
    ///
    /// # Errors
    /// [`NotForDirections`] of codecs of axes and of vectors with a length.
    pub fn expect_directions(&self) -> Result<(), NotForDirections> {
        let has_directions = self.element == Element::Rotation || self.measure() == Measure::Angle;
        if has_directions { Ok(()) } else { Err(NotForDirections { id: self.id }) }
    }

    /// Moves flat elements, each to what [`snapped`](Self::snapped) makes of it, on the calling thread.
    pub fn snap(&self, elements: &mut [f32]) {
        fn each<const N: usize>(codec: &AnyCodec, elements: &mut [f32]) {
            let elements = elements.chunks_exact_mut(N).filter_map(|element| element.first_chunk_mut::<N>());
            elements.for_each(|element| *element = codec.snapped(*element));
        }
        match self.element {
            Element::Vector => each::<3>(self, elements),
            Element::Rotation => each::<4>(self, elements),
            Element::Frame => each::<7>(self, elements),
        }
    }

    /// An element with its directions moved to those that it is decoded to or, of a format, to those that the format's own software
    /// encodes alike. What has no usable direction stays, and so do tangents of such normals and all else. `N` is as in
    /// [`encode_one`](Self::encode_one).
    pub fn snapped<const N: usize>(&self, element: [f32; N]) -> [f32; N] {
        let to = match (self.functions, element.first_chunk(), <[f32; 4]>::try_from(&element[..])) {
            (AnyFunctions::Format(format), Some(vector), _) => resized(format.snap::<[f32; 3]>(*vector)),
            (AnyFunctions::RotationFormat(format), _, Ok(q)) => resized(snapped_rotation(format, q)),
            _ => self.decode_one::<N>(self.encode_one(element)),
        };
        let mut snapped = element;
        let floats = self.element.part_floats();
        let parts = snapped.chunks_exact_mut(floats).zip(to.chunks_exact(floats));
        for (part, to) in parts.take(self.element.directions().len()) {
            if !has_direction(part) {
                break;
            }
            part.copy_from_slice(to);
        }
        snapped
    }
}

/// The quaternion to give to the format's plain encoder, so that it writes the nearest code that it can: of the nearest code's and
/// `q`, and of those that make up for what the encoder rounds or truncates of them, the first that comes out best.
fn snapped_rotation(format: RotationFormat, q: [f32; 4]) -> [f32; 4] {
    /// Of ten, the mean error would be 2 % less in `gltf-quat8`, and 0.2 % in the others.
    const ATTEMPTS: u32 = 4;
    let (plain, dot) = (format.plain(), |a: [f32; 4], b: [f32; 4]| (0..4).map(|i| a[i] * b[i]).sum::<f32>());
    let mut best = (f64::INFINITY, q);
    for target in [format.decode(format.encode(q)), q] {
        let mut attempt = target;
        for _ in 0..ATTEMPTS {
            let written = plain.decode(plain.encode(attempt));
            let off = rotation_angle_deg(q, written);
            if off < best.0 {
                best = (off, attempt);
            }
            // Of the target's length and sign.
            let scale = dot(target, target).sqrt().copysign(dot(target, written));
            attempt = core::array::from_fn(|i| attempt[i] + 0.5 * (target[i] - scale * written[i]));
        }
    }
    best.1
}

/// Copies the first bytes of each value to those of another array, whose values are of another size.
fn copy_each((from, from_size): (&[u8], usize), (to, to_size): (&mut [u8], usize)) {
    let copy = |size, to: &mut [u8]| {
        let pairs = from.chunks_exact(from_size).zip(to.chunks_exact_mut(to_size));
        pairs.for_each(|(from, to)| to[..size].copy_from_slice(&from[..size]));
    };
    // Copies of known size are single instructions.
    match from_size.min(to_size) {
        3 => copy(3, to),
        6 => copy(6, to),
        size => copy(size, to),
    }
}

/// True in the process whose first question this is. A caller that asks before each parallel call learns so whether the
/// threads are there: the first call starts them, a process that was forked after it has none, and would wait for ever.
pub fn has_threads() -> bool {
    static STARTED_IN: AtomicU32 = AtomicU32::new(0);
    // Only Unix forks, and not every other system has numbers for processes.
    let own = if cfg!(unix) { process::id() } else { 1 };
    let before = STARTED_IN.compare_exchange(0, own, Ordering::Relaxed, Ordering::Relaxed);
    before.map_or_else(|process| process == own, |_| true)
}
