//! Codecs as JSON: the rows of `unitvec codecs --json`.

use crate::{AnyCodec, Domain, Element, Operation};
use serde::{Serialize, Serializer};

/// A codec. What only vectors or only frames have is absent for the others.
#[derive(Serialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schemars", schemars(rename = "AnyCodec"))]
struct Row {
    /// What it encodes.
    element: Element,
    /// Identifier.
    id: &'static str,
    /// Type of the crate `unitvec`.
    rust_type: &'static str,
    /// The survey's name, or one like it; of vectors.
    #[serde(skip_serializing_if = "Option::is_none")]
    survey_name: Option<&'static str>,
    /// Significant bits of a code.
    bits: u32,
    /// Bytes of a stored code.
    bytes: usize,
    /// The VkFormat that has the code's layout; null where there is none.
    vk_format: Option<&'static str>,
    #[serde(flatten)]
    of_vectors: Option<OfVectors>,
    #[serde(flatten)]
    of_frames: Option<OfFrames>,
    /// The encoder's name in GLSL and as an entry point.
    encode_function: String,
    /// The decoder's name.
    decode_function: String,
}

/// What a codec of vectors promises.
#[derive(Serialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
struct OfVectors {
    /// The directions that it takes: `sphere`, or `hemisphere` for those with z >= 0.
    domain: &'static str,
    /// True where decoded vectors have unit length.
    is_unit: bool,
    /// True where the six directions along the axes come back exactly.
    exact_axes: bool,
    /// True where a code that one device decodes comes back as a code of the same vector on any other.
    stable_across_devices: bool,
    /// Upper bound of the error, degrees.
    bound_deg: f32,
    /// The family, which codecs of other widths share.
    family: &'static str,
    /// The code for vectors without a direction that `encode --null` writes; null where the codec has none.
    null_code: Option<u64>,
    /// True where the encoder reads a table.
    encodes_by_table: bool,
}

/// What a codec of frames promises.
#[derive(Serialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
struct OfFrames {
    /// Upper bound of the normal's error, degrees.
    normal_bound_deg: f32,
    /// Upper bound of the tangent's error, degrees.
    tangent_bound_deg: f32,
}

impl Row {
    fn new(codec: &AnyCodec) -> Self {
        let is_vector = codec.element == Element::Vector;
        let of_vectors = || OfVectors {
            domain: if codec.domain == Domain::Hemisphere { "hemisphere" } else { "sphere" },
            is_unit: codec.is_unit,
            exact_axes: codec.exact_axes,
            stable_across_devices: codec.stable_across_devices,
            bound_deg: codec.max_error_deg(),
            family: codec.family,
            null_code: codec.null().ok().map(|null| null.code),
            encodes_by_table: codec.encodes_by_table,
        };
        Self {
            element: codec.element,
            id: codec.id,
            rust_type: codec.rust_type,
            survey_name: is_vector.then_some(codec.survey_name),
            bits: codec.bits,
            bytes: codec.bytes,
            vk_format: codec.vk_format,
            of_vectors: is_vector.then(of_vectors),
            of_frames: match *codec.max_errors_deg {
                [normal_bound_deg, tangent_bound_deg] => {
                    Some(OfFrames { normal_bound_deg, tangent_bound_deg })
                }
                _ => None,
            },
            encode_function: codec.function(Operation::Encode),
            decode_function: codec.function(Operation::Decode),
        }
    }
}

impl Serialize for AnyCodec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Row::new(self).serialize(serializer)
    }
}

#[cfg(feature = "schemars")]
impl schemars::JsonSchema for AnyCodec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Row::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Row::json_schema(generator)
    }
}
