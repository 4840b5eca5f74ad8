//! The library's functions: names and types.

use unitvec_catalogue::{AnyCodec, CODECS, Element, Operation};

/// A type of parameters and results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// A code of up to 32 bits.
    Uint,
    /// A code of more bits, the low word first.
    Uvec2,
    /// A vector.
    Vec3,
    /// A rotation, or a tangent with the handedness as its fourth component.
    Vec4,
    /// A struct of normal and tangent: [`Vec3`](Self::Vec3), [`Vec4`](Self::Vec4).
    Frame,
}

/// The parameters and the result of a function, all by value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// `unitvec_oct16_encode`.
    pub name: String,
    /// Names and types.
    pub parameters: Vec<(&'static str, Type)>,
    /// The result's type.
    pub result: Type,
}

impl Signature {
    /// The function of this operation of a codec.
    pub fn of(format: &AnyCodec, operation: Operation) -> Self {
        let name = format!("unitvec_{}", format.function(operation));
        let code = if format.bits > 32 { Type::Uvec2 } else { Type::Uint };
        let (parameters, result) = match (operation, format.element) {
            (Operation::Encode, Element::Vector) => (vec![("v", Type::Vec3)], code),
            (Operation::Encode, Element::Frame) => {
                (vec![("normal", Type::Vec3), ("tangent", Type::Vec4)], code)
            }
            (Operation::Encode, Element::Rotation) => (vec![("q", Type::Vec4)], code),
            (Operation::Decode, Element::Vector) => (vec![("code", code)], Type::Vec3),
            (Operation::Decode, Element::Rotation) => (vec![("code", code)], Type::Vec4),
            (Operation::Decode, Element::Frame) => (vec![("code", code)], Type::Frame),
        };
        Self { name, parameters, result }
    }

    /// All functions, codec by codec.
    pub fn all() -> impl Iterator<Item = Self> {
        CODECS.iter().flat_map(|format| Operation::ALL.map(|operation| Self::of(format, operation)))
    }
}

impl std::fmt::Display for Type {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Uint => "uint",
            Self::Uvec2 => "uvec2",
            Self::Vec3 => "vec3",
            Self::Vec4 => "vec4",
            Self::Frame => "UnitvecFrame",
        })
    }
}

/// Formats the signature as GLSL declares it.
impl std::fmt::Display for Signature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let parameters: Vec<String> =
            self.parameters.iter().map(|(name, of_type)| format!("{of_type} {name}")).collect();
        write!(f, "{} {}({})", self.result, self.name, parameters.join(", "))
    }
}
