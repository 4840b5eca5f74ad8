//! The native part of the Python package: flat NumPy arrays in, flat NumPy arrays out. `unitvec/__init__.py` checks and shapes
//! what users pass.

mod portions;

use numpy::{PyReadonlyArray1, PyReadwriteArray1};
use portions::{Floats, Pool};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use unitvec::dither::{dither_from_key, dither_from_pixel, dither_from_position};
use unitvec::glam::{UVec2, Vec2, Vec3};
use unitvec_catalogue::{
    AnyCodec, CODECS, Dither, Domain, Manner, Null, Operation, WRAPPED, find_any, formats,
};

/// Elements as they lie in an array without gaps.
#[derive(FromPyObject)]
enum Elements<'py> {
    Single(PyReadonlyArray1<'py, f32>),
    Double(PyReadonlyArray1<'py, f64>),
}

impl Elements<'_> {
    fn floats(&self) -> PyResult<Floats<'_>> {
        Ok(match self {
            Self::Single(array) => Floats::Single(array.as_slice()?),
            Self::Double(array) => Floats::Double(array.as_slice()?),
        })
    }
}

type Name = &'static str;

/// The fields of `unitvec.Codec`, in their order, but for the type of codes.
type Facts = (Name, Name, u32, usize, usize, Name, Vec<f32>, Option<u64>, f64, f64, [f64; 2], bool);

fn invalid(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn find(name: &str) -> PyResult<&'static AnyCodec> {
    find_any(name).map_err(invalid)
}

/// Whether null codes are asked for, the offsets of dithered codes, and the number of threads.
type Options<'py> = (bool, Option<PyReadonlyArray1<'py, f32>>, Option<usize>);

fn manner<'a>(
    codec: &'a AnyCodec,
    (null, offsets, threads): &'a Options<'_>,
) -> PyResult<(Manner<'a>, Pool)> {
    let null: Option<Null<'_>> = null.then(|| codec.null().map_err(invalid)).transpose()?;
    let with = |offsets: &'a PyReadonlyArray1<'_, f32>| -> PyResult<(Dither<'_>, &[f32])> {
        Ok((codec.dither().map_err(invalid)?, offsets.as_slice()?))
    };
    Ok((Manner { null, dither: offsets.as_ref().map(with).transpose()? }, pool(*threads)?))
}

/// Keys of dithered codes.
#[derive(FromPyObject)]
enum Keys<'py> {
    Numbers(PyReadonlyArray1<'py, u32>),
    Positions(PyReadonlyArray1<'py, f32>),
}

/// Writes the offset of each key.
fn put<'a, K>(
    keys: impl Iterator<Item = K>,
    rows: impl Iterator<Item = &'a mut [f32]>,
    offset: impl Fn(K) -> Vec2,
) {
    keys.zip(rows).for_each(|(key, row)| row.copy_from_slice(&offset(key).to_array()));
}

fn pool(threads: Option<usize>) -> PyResult<Pool> {
    Pool::of(threads).map_err(|error| PyRuntimeError::new_err(format!("threads cannot be started: {error}")))
}

fn facts(codec: &AnyCodec) -> Facts {
    let &AnyCodec { id, bits, bytes, is_unit, .. } = codec;
    let (element, floats) = (codec.element.plural(), codec.element.floats());
    let domain = if codec.domain == Domain::Sphere { "sphere" } else { "hemisphere" };
    let null = codec.null().ok().map(|null| null.code);
    let measured = codec.element.directions().first().and_then(|part| codec.measured(part));
    let (mean, max) = measured.map_or((f64::NAN, f64::NAN), |errors| (errors.mean_deg, errors.max_deg));
    let costs = Operation::ALL.map(|operation| codec.cost(operation).unwrap_or(f64::NAN));
    let bounds = codec.max_errors_deg.to_vec();
    (id, element, bits, bytes, floats, domain, bounds, null, mean, max, costs, is_unit)
}

#[pymodule]
mod _native {
    use super::*;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// The facts of the codec or format of this name.
    #[pyfunction]
    fn codec(name: &str) -> PyResult<Facts> {
        find(name).map(facts)
    }

    /// The identifiers of all codecs, and of all formats of other software.
    #[pyfunction]
    fn names() -> [Vec<&'static str>; 2] {
        let codecs = CODECS.iter().chain(&WRAPPED).map(|codec| codec.id);
        [codecs.collect(), formats().iter().map(|format| format.id).collect()]
    }

    /// Encodes elements to integers.
    #[pyfunction]
    fn encode(
        py: Python<'_>,
        name: &str,
        elements: Elements<'_>,
        mut codes: PyReadwriteArray1<'_, u8>,
        options: Options<'_>,
    ) -> PyResult<()> {
        let codec = find(name)?;
        let (manner, pool) = manner(codec, &options)?;
        let (floats, codes) = (elements.floats()?, codes.as_slice_mut()?);
        py.detach(|| portions::encode(codec, floats, codes, &manner, &pool)).map_err(invalid)
    }

    /// Decodes integers.
    #[pyfunction]
    fn decode(
        py: Python<'_>,
        name: &str,
        codes: PyReadonlyArray1<'_, u8>,
        mut elements: PyReadwriteArray1<'_, f32>,
        options: Options<'_>,
    ) -> PyResult<()> {
        let codec = find(name)?;
        let (manner, pool) = manner(codec, &options)?;
        let (codes, elements) = (codes.as_slice()?, elements.as_slice_mut()?);
        py.detach(|| portions::decode(codec, codes, elements, &manner, &pool)).map_err(invalid)
    }

    /// The offsets of dithered codes, two floats each: by numbers, of `width` 1, by pixels, of 2, or by positions, of 3.
    #[pyfunction]
    fn offsets(keys: Keys<'_>, width: usize, mut offsets: PyReadwriteArray1<'_, f32>) -> PyResult<()> {
        let rows = offsets.as_slice_mut()?.chunks_exact_mut(2);
        match (&keys, width) {
            (Keys::Numbers(keys), 1) => put(keys.as_slice()?.iter(), rows, |key| dither_from_key(*key)),
            (Keys::Numbers(keys), _) => put(keys.as_slice()?.chunks_exact(2), rows, |pixel| {
                dither_from_pixel(UVec2::from_slice(pixel))
            }),
            (Keys::Positions(keys), _) => put(keys.as_slice()?.chunks_exact(3), rows, |position| {
                dither_from_position(Vec3::from_slice(position))
            }),
        }
        Ok(())
    }

    /// The error of each part of each element after encoding and decoding; NaN where there is none.
    #[pyfunction]
    fn error(
        py: Python<'_>,
        name: &str,
        elements: Elements<'_>,
        mut errors: PyReadwriteArray1<'_, f64>,
        threads: Option<usize>,
    ) -> PyResult<()> {
        let (codec, pool) = (find(name)?, pool(threads)?);
        let (floats, errors) = (elements.floats()?, errors.as_slice_mut()?);
        py.detach(|| portions::error(codec, floats, errors, &pool)).map_err(invalid)
    }

    /// Moves elements to those that plain encoders write nearest.
    #[pyfunction]
    fn snap(
        py: Python<'_>,
        name: &str,
        elements: Elements<'_>,
        mut snapped: PyReadwriteArray1<'_, f32>,
        threads: Option<usize>,
    ) -> PyResult<()> {
        let (codec, pool) = (find(name)?, pool(threads)?);
        codec.expect_directions().map_err(invalid)?;
        let (floats, snapped) = (elements.floats()?, snapped.as_slice_mut()?);
        py.detach(|| portions::snap(codec, floats, snapped, &pool)).map_err(invalid)
    }
}
