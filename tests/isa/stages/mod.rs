//! Functions in pixel and vertex shaders, by the compilers of Mesa's drivers: `docs/data/stages/*.json`, which docs/costs.md
//! shows. Hardware converts between the formats and the numbers of the shader.

#[cfg(feature = "glsl")]
mod compiled;

use super::gpus::SHOWN;
use super::recorded;
use unitvec_choose::costs::{Gpu, Line, Report, Row, find_gpu};
use unitvec_vulkan::ImageFormat;

/// Those of [`SHOWN`] but NVIDIA's, whose compiler takes compute kernels alone.
pub fn gpus() -> impl Iterator<Item = &'static Gpu> {
    SHOWN.iter().filter_map(|name| find_gpu(name)).filter(|gpu| gpu.line != Line::Nvidia)
}

fn file(gpu: &str) -> String {
    format!("stages/{gpu}.json")
}

/// Places of expressions: of the normal `n` that a pixel shader writes, of a texel `x`, of an attribute `x`.
const WRITTEN: &str = "pixel shader, writes";
const FETCHED: &str = "pixel shader, fetches";
const ATTRIBUTE: &str = "vertex shader, attribute";

/// A format, and what shaders have for it.
pub struct Format {
    pub raw: ImageFormat,
    /// The types of what is written and of what is read, and of the texture.
    #[cfg_attr(not(feature = "glsl"), allow(dead_code))]
    types: [&'static str; 3],
    /// Expressions of `n` and of `x` that cost nothing.
    idle: [&'static str; 2],
}

const SNORM: Format =
    Format { raw: ImageFormat::R16G16_SNORM, types: ["vec2", "vec4", "texture2D"], idle: ["n.xy", "x.xyx"] };
const UINT: Format = Format {
    raw: ImageFormat::R32_UINT,
    types: ["uint", "uvec4", "utexture2D"],
    idle: ["floatBitsToUint(n.x)", "vec3(uintBitsToFloat(x.x))"],
};
const UNORM: Format =
    Format { raw: ImageFormat::R8G8B8A8_UNORM, types: ["vec3", "vec4", "texture2D"], idle: ["n", "x.xyz"] };

/// A normal's way through a shader: the place, and expressions of unitvec and of the textbook that do the same.
pub struct Way(pub &'static str, pub Format, pub &'static str, pub Option<&'static str>);

pub const WAYS: [Way; 14] = [
    Way(WRITTEN, SNORM, "float32x3_to_oct(n)", Some("textbook_oct(n)")),
    Way(WRITTEN, SNORM, "float32x3_to_octn_precise(n, 32)", Some("textbook_oct_precise(n, 32767.0)")),
    Way(WRITTEN, UINT, "oct32_encode(n)", Some("textbook_oct32_encode(n)")),
    Way(WRITTEN, UINT, "oct24_encode(n)", Some("textbook_oct24_encode(n)")),
    Way(WRITTEN, UNORM, "code_to_unorm8x3(oct24_encode(n))", None),
    Way(FETCHED, SNORM, "oct_to_float32x3(x.xy)", Some("textbook_from_oct(x.xy)")),
    Way(FETCHED, UINT, "oct32_decode(x.x)", Some("textbook_oct32_decode(x.x)")),
    Way(FETCHED, UINT, "oct24_decode(x.x)", Some("textbook_oct24_decode(x.x)")),
    Way(FETCHED, UNORM, "oct24_decode(unorm8x3_to_code(x.xyz))", None),
    Way(ATTRIBUTE, SNORM, "oct_to_float32x3(x.xy)", Some("textbook_from_oct(x.xy)")),
    Way(ATTRIBUTE, UINT, "oct32_decode(x.x)", Some("textbook_oct32_decode(x.x)")),
    Way(ATTRIBUTE, UINT, "oct24_decode(x.x)", Some("textbook_oct24_decode(x.x)")),
    Way(ATTRIBUTE, UINT, "frame32_sum(x.x)", Some("textbook_frame32_sum(x.x)")),
    Way(ATTRIBUTE, UNORM, "oct24_decode(unorm8x3_to_code(x.xyz))", None),
];

impl Way {
    /// The expression that costs nothing.
    fn idle(&self) -> &'static str {
        self.1.idle[usize::from(self.0 != WRITTEN)]
    }

    fn row_id(&self, expression: &str) -> String {
        format!("{} {:?}: {expression}", self.0, self.1.raw)
    }

    /// A figure of an expression, beyond a shader that does nothing in its place: `None` where the GPU does not draw to the
    /// format.
    pub fn beyond_idle(
        &self,
        report: &Report,
        expression: &str,
        figure: fn(&Row) -> Option<u64>,
    ) -> Option<i64> {
        let of = |expression| {
            let id = self.row_id(expression);
            report.rows.iter().find(|row| row.id == id).and_then(figure).map(|figure| figure as i64)
        };
        Some(of(expression)? - of(self.idle())?)
    }
}

/// The committed figures of a GPU.
pub fn committed(gpu: &str) -> Report {
    recorded(&file(gpu))
}

/// The way that most take costs at most two instructions more than the survey's listing, which takes no NaN.
#[test]
fn an_snorm_target_costs_what_the_listing_costs() {
    let (report, way) = (committed(SHOWN[0]), &WAYS[0]);
    let cost = |expression| way.beyond_idle(&report, expression, |row| row.instructions).unwrap();
    let (ours, listing) = (cost(way.2), cost(way.3.unwrap()));
    assert!((1..=listing + 2).contains(&ours), "{ours} instructions, the listing has {listing}");
}
