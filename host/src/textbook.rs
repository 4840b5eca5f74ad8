//! What people write today, in `glsl/textbook/`, plainly from the formulas: only to measure the codecs against.

use crate::catalogue::{Format, Operation, UnknownCodec, find_format};

/// Two functions of `glsl/textbook/`, an encoder and its decoder.
#[derive(Clone, Copy, Debug)]
pub struct Textbook {
    /// Identifier; the functions are `textbook_<id>_encode` and `textbook_<id>_decode`.
    pub id: &'static str,
    /// Identifier of the codec to put in its place: of as many bytes, and in the same format where there is one.
    pub codec: &'static str,
    /// Identifier of a finer codec of as many bytes, for those who may change the format or the encoder.
    pub finer: Option<&'static str>,
    /// What people call it, and where it is from.
    pub title: &'static str,
}

impl Textbook {
    /// Name of the GLSL function of this operation: `textbook_oct16_encode`.
    pub fn function(&self, operation: Operation) -> String {
        format!("textbook_{}_{operation}", self.id)
    }

    /// The format of its codec: what is encoded, and the size of a code.
    ///
    /// # Errors
    /// [`UnknownCodec`] where the catalogue lacks it.
    pub fn format(&self) -> Result<Format, UnknownCodec> {
        find_format(self.codec)
    }
}

/// All of them, those that are alike together.
pub const TEXTBOOK: &[Textbook] = &[
    named_alike("oct16", Some("oct16p"), "octahedral, two snorm: Cigolle et al. 2014, listings 1 and 2"),
    named_alike("oct24", Some("oct24p"), "octahedral, three bytes: listings 1, 2 and 5"),
    named_alike("oct32", Some("oct32p"), "octahedral, two snorm: listings 1 and 2"),
    named_alike("oct16p", None, "octahedral, best of four: listings 3 and 2"),
    named_alike("oct24p", None, "octahedral, best of four, three bytes: listings 3, 2 and 5"),
    named_alike("oct32p", None, "octahedral, best of four: listings 3 and 2"),
    named_alike("hemioct16", None, "hemi-oct, two snorm: listing 6"),
    named_alike("hemioct32", None, "hemi-oct, two snorm: listing 6"),
    named_alike("soct17", None, "signed octahedral: White 2017"),
    named_alike("soct33", None, "signed octahedral: White 2017"),
    Textbook {
        id: "spheremap16",
        codec: "oct16",
        finer: Some("oct16p"),
        title: "sphere map, Lambert's projection, two unorm: CryEngine 3, 2009",
    },
    Textbook {
        id: "spheremap32",
        codec: "oct32",
        finer: Some("oct32p"),
        title: "sphere map, Lambert's projection, two unorm: CryEngine 3, 2009",
    },
    named_alike("spherical16", Some("oct16p"), "two angles by `acos` and `atan`, two snorm"),
    named_alike("spherical32", Some("oct32p"), "two angles by `acos` and `atan`, two snorm"),
    named_alike("cylindrical16", Some("oct16p"), "an angle by `atan`, and z, two snorm"),
    named_alike("cylindrical32", Some("oct32p"), "an angle by `atan`, and z, two snorm"),
    named_alike("snorm8x3", Some("oct24p"), "x, y, z as snorm, normalised when read"),
    named_alike("unorm8x3", Some("oct24p"), "x, y, z as unorm, `v * 0.5 + 0.5`, normalised when read"),
    named_alike("snorm10x3", Some("oct32p"), "x, y, z as snorm of 10 bits, normalised when read"),
    named_alike("snorm16x3", Some("oct48p"), "x, y, z as snorm, normalised when read"),
    named_alike(
        "crytek_bfn24",
        Some("oct24p"),
        "best fit normals by a table of 1024 x 1024: CryEngine 3, 2010",
    ),
    named_alike("xyonly16", Some("hemioct16"), "x and y of normal maps, z by a square root, two snorm"),
    named_alike("xyonly32", Some("hemioct32"), "x and y of normal maps, z by a square root, two snorm"),
    named_alike("frame32", None, "tangent frame, octahedral and diamond: Ong 2023"),
];

/// One that has the identifier of its codec.
const fn named_alike(id: &'static str, finer: Option<&'static str>, title: &'static str) -> Textbook {
    Textbook { id, codec: id, finer, title }
}
