//! The codecs in shading languages.

pub mod kernel;

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Language {
    /// GLSL of desktop GPUs and Vulkan.
    Glsl,
    /// HLSL.
    Hlsl,
    /// WGSL.
    Wgsl,
    /// Slang.
    Slang,
    /// Metal's.
    Msl,
    /// GLSL ES 3.00: WebGL 2.
    GlslEs,
}

impl Language {
    /// All.
    pub const ALL: [Self; 6] = [Self::Glsl, Self::Hlsl, Self::Wgsl, Self::Slang, Self::Msl, Self::GlslEs];
}
