//! The native part of the Python package: flat NumPy arrays in, flat NumPy arrays out. `unitvec/__init__.py` checks and shapes
//! what users pass.

mod portions;

use numpy::{PyReadonlyArray1, PyReadwriteArray1};
use portions::{Floats, Pool};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Null, WRAPPED, find_any, formats};

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

/// The fields of `unitvec.Codec`, in their order, but for the type of codes.
type Facts = (&'static str, &'static str, u32, usize, usize, &'static str, Vec<f32>, Option<u64>, f64, f64);

fn invalid(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn find(name: &str) -> PyResult<&'static AnyCodec> {
    find_any(name).map_err(invalid)
}

/// The null code, where it is asked for.
fn null_of(codec: &AnyCodec, is_asked: bool) -> PyResult<Option<Null<'_>>> {
    is_asked.then(|| codec.null().map_err(invalid)).transpose()
}

fn pool(threads: Option<usize>) -> PyResult<Pool> {
    Pool::of(threads).map_err(|error| PyRuntimeError::new_err(format!("threads cannot be started: {error}")))
}

fn facts(codec: &AnyCodec) -> Facts {
    let element = codec.element.plural();
    let domain = if codec.domain == Domain::Sphere { "sphere" } else { "hemisphere" };
    let null = codec.null().ok().map(|null| null.code);
    let measured = codec.element.directions().first().and_then(|part| codec.measured(part));
    let (mean, max) = measured.map_or((f64::NAN, f64::NAN), |errors| (errors.mean_deg, errors.max_deg));
    let (floats, bounds) = (codec.element.floats(), codec.max_errors_deg.to_vec());
    (codec.id, element, codec.bits, codec.bytes, floats, domain, bounds, null, mean, max)
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
        null: bool,
        threads: Option<usize>,
    ) -> PyResult<()> {
        let codec = find(name)?;
        let (null, pool) = (null_of(codec, null)?, pool(threads)?);
        let (floats, codes) = (elements.floats()?, codes.as_slice_mut()?);
        py.detach(|| portions::encode(codec, floats, codes, null, &pool)).map_err(invalid)
    }

    /// Decodes integers.
    #[pyfunction]
    fn decode(
        py: Python<'_>,
        name: &str,
        codes: PyReadonlyArray1<'_, u8>,
        mut elements: PyReadwriteArray1<'_, f32>,
        null: bool,
        threads: Option<usize>,
    ) -> PyResult<()> {
        let codec = find(name)?;
        let (null, pool) = (null_of(codec, null)?, pool(threads)?);
        let (codes, elements) = (codes.as_slice()?, elements.as_slice_mut()?);
        py.detach(|| portions::decode(codec, codes, elements, null, &pool)).map_err(invalid)
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
}
