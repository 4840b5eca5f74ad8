//! The languages, and how each writes the same thing.

use crate::syntax::{Branch, Condition, Scalar, Type};
use std::fmt;
use std::str::FromStr;

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Language {
    /// GLSL 3.30 and later, and GLSL ES 3.00 and later, by `#include`.
    Glsl,
    /// HLSL, shader model 5 and later.
    Hlsl,
    /// WGSL.
    Wgsl,
    /// Slang.
    Slang,
    /// The Metal Shading Language.
    Msl,
    /// GLSL ES 3.00, for WebGL 2.
    GlslEs,
    /// Godot 4's shading language.
    Godot,
    /// C++11, for CPUs, CUDA and HIP.
    Cpp,
    /// WGSL in modules that naga_oil composes, as Bevy up to 0.19 does.
    NagaOil,
    /// WGSL with imports, for Bevy from 0.20 on.
    Wesl,
}

/// The macro that makes the text of GLSL, HLSL and C++ the exact edition.
pub const EXACT: &str = "UNITVEC_EXACT";

/// Ways to keep compilers from fusing and reordering, and devices from dividing in their own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Edition {
    /// The language's own means, where it has any, and the device's division and square root.
    Plain,
    /// Quotients and roots are put right. Where there is no `precise`, barriers: each rounded result passes through `min` with a
    /// number that none exceeds, which no compiler folds.
    Exact,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 10] = [
        Self::Glsl,
        Self::Hlsl,
        Self::Wgsl,
        Self::Slang,
        Self::Msl,
        Self::GlslEs,
        Self::Godot,
        Self::Cpp,
        Self::NagaOil,
        Self::Wesl,
    ];

    /// The names on a command line and in sentences, and the extension of its files.
    const fn names(self) -> [&'static str; 3] {
        match self {
            Self::Glsl => ["glsl", "GLSL", "glsl"],
            Self::Hlsl => ["hlsl", "HLSL", "hlsl"],
            Self::Wgsl => ["wgsl", "WGSL", "wgsl"],
            Self::Slang => ["slang", "Slang", "slang"],
            Self::Msl => ["msl", "MSL", "metal"],
            Self::GlslEs => ["glsl-es", "GLSL ES", "glsl"],
            Self::Godot => ["godot", "Godot's shading language", "gdshaderinc"],
            Self::Cpp => ["cpp", "C++", "hpp"],
            Self::NagaOil => ["naga-oil", "WGSL for naga_oil", "wgsl"],
            Self::Wesl => ["wesl", "WESL", "wesl"],
        }
    }

    /// The name on a command line and of the folder of its files: `glsl-es`.
    pub const fn id(self) -> &'static str {
        self.names()[0]
    }

    /// True for the languages whose files are committed, in `shaders/`. GLSL is the source, and WGSL's modules differ from its
    /// files in a few lines: those are made on demand.
    pub const fn is_committed(self) -> bool {
        !matches!(self, Self::Glsl | Self::NagaOil | Self::Wesl)
    }

    /// Its name in sentences.
    pub const fn name(self) -> &'static str {
        self.names()[1]
    }

    /// The extension of its files, without the point.
    pub const fn extension(self) -> &'static str {
        self.names()[2]
    }

    /// The editions of its files. In GLSL, HLSL and C++ the macro [`EXACT`] chooses between both.
    pub const fn editions(self) -> &'static [Edition] {
        if self.has_precise() { &[Edition::Plain] } else { &[Edition::Plain, Edition::Exact] }
    }

    /// True for the languages whose compilers take `#include`.
    pub(crate) const fn has_include(self) -> bool {
        matches!(self, Self::Glsl | Self::Hlsl | Self::Msl | Self::Godot | Self::Cpp)
    }

    /// True for the languages with `#ifdef`.
    pub(crate) const fn has_preprocessor(self) -> bool {
        !matches!(self.written(), Self::Wgsl)
    }

    /// The language in which its functions are written.
    pub(crate) const fn written(self) -> Self {
        if matches!(self, Self::NagaOil | Self::Wesl) { Self::Wgsl } else { self }
    }

    /// True for GLSL, and for languages that take its types and functions.
    pub(crate) const fn is_glsl(self) -> bool {
        matches!(self, Self::Glsl | Self::GlslEs | Self::Godot)
    }

    /// True for the languages with `precise`, and for C++, whose barrier stands for it. In these a macro of the user's chooses the
    /// exact edition.
    pub(crate) const fn has_precise(self) -> bool {
        matches!(self, Self::Glsl | Self::Hlsl | Self::Cpp)
    }

    /// The part of an alternative that belongs to its text. Both parts stay where a macro of the user's decides; where
    /// the version of GLSL decides, the part for the oldest stays.
    pub(crate) fn branch(self, edition: Edition, condition: &Condition) -> Branch {
        match condition {
            _ if self == Self::Glsl => Branch::Both,
            Condition::Macro(_) if self.has_preprocessor() => Branch::Both,
            Condition::Exact(_) if self.has_precise() => Branch::Both,
            Condition::Exact(_) if edition == Edition::Exact => Branch::Then,
            _ => Branch::Otherwise,
        }
    }

    /// A type's name.
    pub(crate) fn type_name(self, ty: &Type) -> String {
        let (scalar, size) = match ty {
            Type::Void => return "void".to_owned(),
            Type::Struct(name) => return name.clone(),
            Type::Value(scalar, size) => (*scalar, *size),
            Type::Array(scalar, length) if self.written() == Self::Wgsl => {
                return format!("array<{}, {length}>", self.type_name(&Type::Value(*scalar, 1)));
            }
            Type::Array(scalar, _) => (*scalar, 1),
        };
        let (in_wgsl, suffix, in_c, prefix) = match scalar {
            Scalar::Float => ("f32", "f", "float", ""),
            Scalar::Uint => ("u32", "u", "uint", "u"),
            Scalar::Int => ("i32", "i", "int", "i"),
            Scalar::Bool => ("bool", "<bool>", "bool", "b"),
        };
        match (self.written(), size) {
            (Self::Wgsl, 1) => in_wgsl.to_owned(),
            (Self::Wgsl, _) => format!("vec{size}{suffix}"),
            (_, 1) => in_c.to_owned(),
            _ if self.is_glsl() => format!("{prefix}vec{size}"),
            _ => format!("{in_c}{size}"),
        }
    }

    /// Its reserved words, and the names of its functions that the text calls.
    pub(crate) fn is_reserved(self, name: &str) -> bool {
        let words = match self {
            Self::Glsl | Self::GlslEs | Self::Godot => OF_GLSL,
            Self::Hlsl => OF_HLSL,
            Self::Wgsl | Self::NagaOil | Self::Wesl => OF_WGSL,
            Self::Slang => OF_SLANG,
            Self::Msl => OF_MSL,
            Self::Cpp => OF_CPP,
        };
        words.split_whitespace().any(|word| word == name)
    }
}

impl Edition {
    /// The folder of its files in a language's folder, with a slash; none for the plain one.
    pub const fn folder(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Exact => "exact/",
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name of a language.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no language `{0}`; there are {ids}", ids = Language::ALL.map(Language::id).join(", "))]
pub struct UnknownLanguage(String);

impl FromStr for Language {
    type Err = UnknownLanguage;

    fn from_str(id: &str) -> Result<Self, UnknownLanguage> {
        let found = Self::ALL.into_iter().find(|language| language.id() == id);
        found.ok_or_else(|| UnknownLanguage(id.to_owned()))
    }
}

/// Keywords and reserved words (GLSL 4.60, section 3.6; GLSL ES 3.00, section 3.7; Godot 4's shading language).
const OF_GLSL: &str = "active asm atomic_uint attribute bool break buffer case cast centroid class coherent common const \
    continue default discard do double else enum extern external false filter fixed flat float for global goto group_uniforms \
    half highp hint_range if in inline inout input instance int interface invariant layout long lowp mediump namespace \
    noinline noperspective out output packed partition patch precise precision public readonly render_mode resource \
    restrict return row_major sample sampler shader_type shared short sizeof smooth static struct subroutine superp \
    switch template this true typedef uint uniform union unsigned using varying void volatile while writeonly";

/// Keywords and reserved words (the DirectX HLSL reference, "Keywords" and "Reserved words").
const OF_HLSL: &str = "AppendStructuredBuffer asm asm_fragment auto BlendState bool break Buffer ByteAddressBuffer case \
    catch cbuffer centroid char class column_major compile compile_fragment const const_cast continue ComputeShader \
    ConsumeStructuredBuffer default delete discard do double dynamic_cast else enum explicit export extern false float \
    for friend fxgroup GeometryShader goto groupshared half if in inline inout InputPatch int interface line lineadj \
    linear LineStream long matrix min16float min16int min16uint mutable namespace new nointerpolation noperspective NULL \
    operator out OutputPatch packoffset pass pixelfragment PixelShader point PointStream precise private protected public \
    register reinterpret_cast return row_major sample sampler shared short signed sizeof snorm static static_cast string \
    struct switch technique template tbuffer texture this throw triangle triangleadj TriangleStream true try typedef \
    typename uint uniform union unorm unsigned using vector vertexfragment VertexShader virtual void volatile while";

/// Keywords and reserved words (WGSL, sections 15.1 and 15.2).
const OF_WGSL: &str = "alias break case const const_assert continue continuing default diagnostic discard else enable false \
    fn for if let loop override requires return struct switch true var while \
    NULL Self abstract active alignas alignof as asm asm_fragment async attribute auto await become cast catch class \
    co_await co_return co_yield coherent column_major common compile compile_fragment concept const_cast consteval \
    constexpr constinit crate debugger decltype delete demote demote_to_helper do dynamic_cast enum explicit export \
    extends extern external fallthrough filter final finally friend from fxgroup get goto groupshared highp impl \
    implements import inline instanceof interface layout lowp macro macro_rules match mediump meta mod module move mut \
    mutable namespace new nil noexcept noinline nointerpolation non_coherent noncoherent noperspective null nullptr of \
    operator package packoffset partition pass patch pixelfragment precise precision premerge priv protected pub public \
    readonly ref regardless register reinterpret_cast require resource restrict self set shared sizeof smooth snorm \
    static static_assert static_cast std subroutine super target template this thread_local throw trait try type \
    typedef typeid typename typeof union unless unorm unsafe unsized use using varying virtual volatile wgsl where with \
    writeonly yield select bitcast";

/// Reserved words of HLSL that Slang has, and its own.
const OF_SLANG: &str = "__generic __include __init associatedtype break case cbuffer centroid class const continue default \
    defer discard do double dyn each else enum expand export extension extern false float for func functype get \
    groupshared half if implementing import in inline inout int interface internal is as let line linear module \
    namespace new no_diff none nonuniform nullptr out override point precise private property public register \
    require return sample set shared snorm spirv_asm static struct subscript switch tbuffer this throw throws triangle \
    true try typealias typedef typename uint uniform unorm using var vector matrix void where while asuint asfloat";

/// Reserved words of C++14, and Metal's own.
const OF_MSL: &str = "alignas alignof and and_eq asm auto bitand bitor bool break case catch char class compl const \
    constant constexpr const_cast continue decltype default delete device do double dynamic_cast else enum explicit \
    export extern false float for fragment friend goto half if inline int kernel long metal mutable namespace new \
    noexcept not not_eq nullptr object_data operator or or_eq packed_float2 packed_float3 private protected public \
    ray_data register reinterpret_cast return sampler short signed sizeof static static_assert static_cast struct \
    switch template texture this thread thread_local threadgroup throw true try typedef typeid typename uint union \
    unsigned using vec vertex virtual void volatile while xor xor_eq as_type";

/// Keywords of C++ up to C++20, and what the headers beside the functions define.
const OF_CPP: &str = "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t \
    class co_await co_return co_yield compl concept const consteval constexpr constinit const_cast continue decltype default \
    delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline int long mutable \
    namespace new noexcept not not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires \
    return short signed sizeof static static_assert static_cast struct switch template this thread_local throw true try \
    typedef typeid typename uint union unsigned using virtual void volatile wchar_t while xor xor_eq unitvec unitvec_rounded \
    vec2 vec3 vec4";
