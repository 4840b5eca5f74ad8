//! The native part of the npm package: portions of flat arrays in, portions of flat arrays out. `unitvec/core.js` checks and
//! divides what users pass.

use js_sys::{Array, RangeError};
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Manner, Operation, WRAPPED, find_any, formats};
use wasm_bindgen::prelude::*;

type Result<T> = std::result::Result<T, JsValue>;

fn invalid(error: impl ToString) -> JsValue {
    RangeError::new(&error.to_string()).into()
}

fn find(name: &str) -> Result<&'static AnyCodec> {
    find_any(name).map_err(invalid)
}

/// Coding with the codec's null code where it is asked for.
fn manner(codec: &AnyCodec, null: bool) -> Result<Manner<'_>> {
    let null = null.then(|| codec.null().map_err(invalid)).transpose()?;
    Ok(Manner { null, ..Manner::default() })
}

/// The version of the package.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// The facts of the codec or format of this name, in the order of the fields of `Codec`.
#[wasm_bindgen]
pub fn codec(name: &str) -> Result<Array> {
    let codec = find(name)?;
    let domain = if codec.domain == Domain::Sphere { "sphere" } else { "hemisphere" };
    let null = codec.null().map_or(JsValue::NULL, |null| match codec.integer_bytes() {
        8 => null.code.into(),
        _ => (null.code as u32).into(),
    });
    let measured = codec.element.directions().first().and_then(|part| codec.measured(part));
    let (mean, max) = measured.map_or((f64::NAN, f64::NAN), |errors| (errors.mean_deg, errors.max_deg));
    let bounds: Array = codec.max_errors_deg.iter().map(|&bound| JsValue::from(bound)).collect();
    let cost = |operation| JsValue::from(codec.cost(operation).unwrap_or(f64::NAN));
    let costs: Array = Operation::ALL.into_iter().map(cost).collect();
    let [bits, bytes, floats] = [codec.bits, codec.bytes as u32, codec.element.floats() as u32];
    Ok([
        codec.id.into(),
        codec.element.plural().into(),
        bits.into(),
        bytes.into(),
        floats.into(),
        domain.into(),
        bounds.into(),
        null,
        mean.into(),
        max.into(),
        costs.into(),
        codec.is_unit.into(),
    ]
    .into_iter()
    .collect::<Array<JsValue>>())
}

/// The identifiers of all codecs, or of all formats of other software.
#[wasm_bindgen]
pub fn names(of_formats: bool) -> Vec<String> {
    let codecs = CODECS.iter().chain(&WRAPPED);
    let all: Vec<_> = if of_formats { formats().iter().collect() } else { codecs.collect() };
    all.iter().map(|codec| codec.id.to_owned()).collect()
}

/// Doubles of elements as floats.
#[wasm_bindgen]
pub fn round(name: &str, doubles: &[f64]) -> Result<Vec<f32>> {
    let mut floats = vec![0.0; doubles.len()];
    find(name)?.element.round(doubles, &mut floats);
    Ok(floats)
}

/// Encodes elements to integers.
#[wasm_bindgen]
pub fn encode(name: &str, elements: &[f32], integers: &mut [u8], null: bool) -> Result<()> {
    let codec = find(name)?;
    codec.encode_integers(elements, integers, manner(codec, null)?).map_err(invalid)
}

/// Decodes integers.
#[wasm_bindgen]
pub fn decode(name: &str, integers: &[u8], elements: &mut [f32], null: bool) -> Result<()> {
    let codec = find(name)?;
    if let Some(beyond) = codec.first_beyond(integers) {
        let (id, bits) = (codec.id, codec.bits);
        return Err(invalid(format!("{beyond} is no code of {id}, which has {bits} bits")));
    }
    codec.decode_integers(integers, elements, manner(codec, null)?).map_err(invalid)
}

/// The error of each part of each element after encoding and decoding; NaN where there is none.
#[wasm_bindgen]
pub fn error(name: &str, elements: &[f32], errors: &mut [f64]) -> Result<()> {
    find(name)?.errors(elements, errors).map_err(invalid)
}

/// Moves elements as [`AnyCodec::snapped`] does.
#[wasm_bindgen]
pub fn snap(name: &str, elements: &mut [f32]) -> Result<()> {
    let codec = find(name)?;
    codec.expect_directions().map_err(invalid)?;
    codec.snap(elements);
    Ok(())
}
