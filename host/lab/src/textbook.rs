//! Functions in common use, in `glsl/textbook/`, plainly from the formulas: only to measure the codecs against.

use crate::Result;
use rayon::prelude::*;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Operation, UnknownCodec, find};
use unitvec_run::backend::{Backend, CHUNK};
use unitvec_run::glsl;
use unitvec_run::glsl::Compiler;
use unitvec_vulkan::{Device, Kernel, Runner};

/// Two functions of `glsl/textbook/`, an encoder and its decoder.
#[derive(Clone, Copy, Debug)]
pub struct Textbook {
    /// Identifier; the functions are `textbook_<id>_encode` and `textbook_<id>_decode`.
    pub id: &'static str,
    /// Identifier of the codec that replaces it: of as many bytes, and in the same format where there is one.
    pub codec: &'static str,
    /// Identifier of a finer codec of as many bytes, for those who may change the format or the encoder.
    pub finer: Option<&'static str>,
    /// The usual name, and the origin.
    pub title: &'static str,
}

impl Textbook {
    /// Name of the GLSL function of this operation: `textbook_oct16_encode`.
    pub fn function(&self, operation: Operation) -> String {
        format!("textbook_{}_{operation}", self.id)
    }

    /// The format of the codec: the element, and the size of a code.
    ///
    /// # Errors
    /// [`UnknownCodec`] where the catalogue lacks it.
    pub fn format(&self) -> Result<&'static AnyCodec, UnknownCodec> {
        find(self.codec)
    }
}

/// Rows of [`TEXTBOOK`]: identifier, codec, finer codec, title.
macro_rules! textbooks {
    ($($id:literal $codec:literal $finer:expr => $title:expr;)*) => {
        &[$(Textbook { id: $id, codec: $codec, finer: $finer, title: $title }),*]
    };
}

const BIASED: &str = "octahedral, `* 0.5 + 0.5`, two unorm: Narkowicz 2014";
const SPHERE_MAP: &str = "sphere map, Lambert's projection, two unorm: CryEngine 3, 2009";
const QTANGENT: &str = "tangent frame, a quaternion in four snorm: Frey and Herzberg 2011";

/// All textbook functions, similar ones together.
pub const TEXTBOOK: &[Textbook] = textbooks! {
    "oct16" "oct16" Some("oct16p") => "octahedral, two snorm: Cigolle et al. 2014, listings 1 and 2";
    "oct24" "oct24" Some("oct24p") => "octahedral, three bytes: listings 1, 2 and 5";
    "oct32" "oct32" Some("oct32p") => "octahedral, two snorm: listings 1 and 2";
    "oct_biased16" "oct16" Some("oct16p") => BIASED;
    "oct_biased20" "oct20" Some("oct20p") => BIASED;
    "oct_biased32" "oct32" Some("oct32p") => BIASED;
    "oct_sign32" "oct32" Some("oct32p") => "octahedral, two snorm: listings 1 and 2 with `sign()` for `signNotZero()`";
    "oct16p" "oct16p" None => "octahedral, best of four: listings 3 and 2";
    "oct24p" "oct24p" None => "octahedral, best of four, three bytes: listings 3, 2 and 5";
    "oct32p" "oct32p" None => "octahedral, best of four: listings 3 and 2";
    "hemioct16" "hemioct16" None => "hemi-oct, two snorm: listing 6";
    "hemioct32" "hemioct32" None => "hemi-oct, two snorm: listing 6";
    "soct17" "soct17" None => "signed octahedral: White 2017";
    "soct33" "soct33" None => "signed octahedral: White 2017";
    "spheremap16" "oct16" Some("oct16p") => SPHERE_MAP;
    "spheremap32" "oct32" Some("oct32p") => SPHERE_MAP;
    "spherical16" "spherical16" Some("oct16p") => "two angles by `acos` and `atan`, two snorm";
    "spherical32" "spherical32" Some("oct32p") => "two angles by `acos` and `atan`, two snorm";
    "cylindrical16" "cylindrical16" Some("oct16p") => "an angle by `atan`, and z, two snorm";
    "cylindrical32" "cylindrical32" Some("oct32p") => "an angle by `atan`, and z, two snorm";
    "snorm8x3" "snorm8x3" Some("oct24p") => "x, y, z as snorm, normalised when read";
    "unorm8x3" "unorm8x3" Some("oct24p") => "x, y, z as unorm, `v * 0.5 + 0.5`, normalised when read";
    "snorm10x3" "snorm10x3" Some("oct32p") => "x, y, z as snorm of 10 bits, normalised when read";
    "snorm16x3" "snorm16x3" Some("oct48p") => "x, y, z as snorm, normalised when read";
    "crytek_bfn24" "snorm8x3p" Some("oct24p") => "best fit normals by a table of 1024 x 1024: CryEngine 3, 2010";
    "xyonly16" "xyonly16" Some("hemioct16") => "x and y of normal maps, z by a square root, two snorm";
    "xyonly32" "xyonly32" Some("hemioct32") => "x and y of normal maps, z by a square root, two snorm";
    "frame32" "frame32" None => "tangent frame, octahedral and diamond: Ong 2023";
    "qtangent32" "frame32" None => QTANGENT;
    "qtangent64" "frame64" None => QTANGENT;
};

/// The SPIR-V of the kernel of a function of `glsl/textbook/`, optimised. An encoder by table, where the
/// [format](Textbook::format) says so, reads the [`best_fit_table`].
///
/// # Errors
/// GLSL that does not compile, or an unknown codec.
pub fn kernel(compiler: &Compiler, textbook: &Textbook, operation: Operation) -> Result<Vec<u8>> {
    let function = textbook.function(operation);
    Ok(compiler.function_kernel(textbook.format()?, operation, &function, &[("TEXTBOOK", "1")])?)
}

/// A textbook's kernels on a Vulkan device, in the place of its codec's.
pub struct TextbookGpu {
    runner: Runner,
    encode: Kernel,
    decode: Kernel,
}

impl TextbookGpu {
    /// Compiles both kernels. With `fill_output`, output that a kernel fails to write cannot pass for its result.
    ///
    /// # Errors
    /// GLSL that does not compile, or a failed Vulkan call.
    pub fn new(
        device: &Arc<Device>,
        compiler: &Compiler,
        textbook: &Textbook,
        fill_output: bool,
    ) -> Result<Self> {
        let mut runner = Runner::new(device, CHUNK, fill_output)?;
        let by_table = textbook.format()?.encodes_by_table;
        let table = if by_table { Some(runner.table(&best_fit_table())?) } else { None };
        let [encode, decode] = Operation::ALL.map(|operation| kernel(compiler, textbook, operation));
        let encode = runner.kernel(&encode?, glsl::ENTRY_POINT, table.as_ref())?;
        let decode = runner.kernel(&decode?, glsl::ENTRY_POINT, None)?;
        Ok(Self { runner, encode, decode })
    }
}

impl Backend for TextbookGpu {
    fn encode(&mut self, format: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> unitvec_run::Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        self.runner.run(&self.encode, count, bytemuck::cast_slice(elements), codes)?;
        Ok(())
    }

    fn decode(&mut self, format: &AnyCodec, codes: &[u8], elements: &mut [f32]) -> unitvec_run::Result<()> {
        let count = format.count(elements.len(), codes.len())?;
        self.runner.run(&self.decode, count, codes, bytemuck::cast_slice_mut(elements))?;
        Ok(())
    }
}

/// Texels of a row and of a column of [`best_fit_table`].
const TEXELS: usize = 1024;

/// The table of `glsl/textbook/best_fit.glsl`: for the direction (1, x, x y), x along rows and y along columns from 0 to
/// 1, the largest component, of 1 to 127, of the whole vector that points nearest.
pub fn best_fit_table() -> Vec<u8> {
    let middle = |texel: usize| (texel as f64 + 0.5) / TEXELS as f64;
    let rows = (0..TEXELS).into_par_iter().map(middle);
    rows.flat_map_iter(|y| (0..TEXELS).map(middle).map(move |x| best_length([1.0, x, x * y]))).collect()
}

/// The length at which the rounded vector points nearest to u.
fn best_length(u: [f64; 3]) -> u8 {
    let mut best = (0.0, 0);
    for length in 1..=127u8 {
        let rounded = u.map(|c| (c * f64::from(length)).round());
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let cosine_squared = dot(u, rounded).powi(2) / dot(rounded, rounded);
        if cosine_squared > best.0 {
            best = (cosine_squared, length);
        }
    }
    best.1
}
