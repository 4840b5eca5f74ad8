//! The simplest kernel of a codec in each shading language, which runs the functions as people call them: every float and
//! every word of a code is a whole u32, and nothing is packed.
//!
//! Compute kernels have the words of elements or codes in binding 0 and those of the results in binding 1. They count
//! by the size of the latter; 64 invocations of a workgroup take four elements each, as
//! [`Runner`](unitvec_vulkan::Runner) dispatches them. Metal's and those of C++ take one element an invocation and receive their
//! number.
//! GLSL ES has fragments instead, of one element each: its words are those of two texels in a row, and the results'
//! those of two targets.

use super::Language;
use unitvec_catalogue::{AnyCodec, Element, Operation};

/// The name of the entry point of all kernels but those of Metal and C++, whose names are those of [`own_name`].
pub const ENTRY_POINT: &str = "main";

/// The name of a kernel in Metal or C++, where all of them may stand in one file.
pub fn own_name(format: &AnyCodec, operation: Operation) -> String {
    format!("{}_kernel", format.function(operation))
}

/// The beginning of a kernel's text, before the functions; `None` where there is none.
pub const fn head(language: Language) -> Option<&'static str> {
    match language {
        Language::Glsl => Some("#version 450\n"),
        Language::GlslEs | Language::Godot => Some(
            "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp usampler2D;\n",
        ),
        _ => None,
    }
}

/// True for the languages whose kernels are fragment shaders. Godot's functions run as those of GLSL ES, of which they are a
/// part.
const fn is_fragment(language: Language) -> bool {
    matches!(language, Language::GlslEs | Language::Godot)
}

/// u32 words of a code in a kernel's buffers.
pub const fn code_words(format: &AnyCodec) -> usize {
    if format.bits > 32 { 2 } else { 1 }
}

/// u32 words of what an operation reads and of what it writes, for one element.
pub const fn words(format: &AnyCodec, operation: Operation) -> (usize, usize) {
    let (element, code) = (format.element.floats(), code_words(format));
    match operation {
        Operation::Encode => (element, code),
        Operation::Decode => (code, element),
    }
}

/// A kernel's entry point, to be written after the functions of the codec.
pub fn kernel(language: Language, format: &AnyCodec, operation: Operation) -> String {
    let syntax = Syntax::of(language);
    let (read, written) = words(format, operation);
    let inputs = (0..read).map(|word| syntax.input(read, word)).collect::<Vec<_>>();
    let (statements, values) = match operation {
        Operation::Encode => encode(&syntax, format, &inputs),
        Operation::Decode => decode(&syntax, format, &inputs),
    };
    let mut lines = statements;
    if is_fragment(language) {
        lines.push(targets(&values));
    } else {
        let store =
            |(word, value)| format!("results[{written}{0} * i + {word}{0}] = {value};", syntax.unsigned);
        lines.extend(values.iter().enumerate().map(store));
    }
    let text = entry(language).replace("WRITTEN", &written.to_string());
    let text = text.replace("NAME", &own_name(format, operation));
    let indent = text.lines().find_map(|line| line.strip_suffix("BODY")).unwrap_or_default();
    text.replace("BODY", &lines.join(&format!("\n{indent}")))
}

/// The statements that encode an element, and the words of its code.
fn encode(syntax: &Syntax, format: &AnyCodec, inputs: &[String]) -> (Vec<String>, Vec<String>) {
    let arguments = match format.element {
        Element::Vector | Element::Rotation => syntax.floats(inputs),
        Element::Frame => [&inputs[..3], &inputs[3..]].map(|words| syntax.floats(words)).join(", "),
    };
    let words = code_words(format);
    let call = format!("{}({arguments})", format.function(Operation::Encode));
    let values = if words == 1 { vec!["code".to_owned()] } else { components("code", words) };
    (vec![syntax.define(syntax.codes[words - 1], "code", &call)], values)
}

/// The statements that decode a code, and the words of the element.
fn decode(syntax: &Syntax, format: &AnyCodec, inputs: &[String]) -> (Vec<String>, Vec<String>) {
    let code_type = syntax.codes[inputs.len() - 1];
    let code =
        if inputs.len() == 1 { inputs[0].clone() } else { format!("{code_type}({})", inputs.join(", ")) };
    let mut statements = vec![syntax.define(code_type, "code", &code)];
    let function = format.function(Operation::Decode);
    let [vector, four] = syntax.vectors;
    let floats = match format.element {
        Element::Vector => {
            statements.push(syntax.define(vector, "v", &format!("{function}(code)")));
            components("v", 3)
        }
        Element::Rotation => {
            statements.push(syntax.define(four, "q", &format!("{function}(code)")));
            components("q", 4)
        }
        Element::Frame => {
            statements.push(syntax.declare(vector, "normal"));
            statements.push(syntax.declare(four, "tangent"));
            let reference = syntax.reference;
            statements.push(format!("{function}(code, {reference}normal, {reference}tangent);"));
            [components("normal", 3), components("tangent", 4)].concat()
        }
    };
    (statements, floats.iter().map(|float| format!("{}({float})", syntax.to_bits)).collect())
}

/// `v.x`, `v.y` and so on.
fn components(name: &str, count: usize) -> Vec<String> {
    ["x", "y", "z", "w"].iter().take(count).map(|component| format!("{name}.{component}")).collect()
}

/// Words as two texels.
fn targets(values: &[String]) -> String {
    let texel = |target: &str, values: &[String]| {
        let words = (0..4).map(|word| values.get(word).map_or("0u", String::as_str)).collect::<Vec<_>>();
        format!("{target} = uvec4({});", words.join(", "))
    };
    let (first, second) = values.split_at(values.len().min(4));
    format!("{} {}", texel("first", first), texel("second", second))
}

/// The parts that languages write in different ways.
struct Syntax {
    language: Language,
    /// Types of three and of four floats.
    vectors: [&'static str; 2],
    /// Types of one and of two words.
    codes: [&'static str; 2],
    /// The beginning of the reinterpretation of three and of four words as floats, up to the first word.
    from_bits: [&'static str; 2],
    /// The function that reinterprets a float as a word.
    to_bits: &'static str,
    /// The suffix of an unsigned literal.
    unsigned: &'static str,
    /// The prefix of an argument that the function writes to.
    reference: &'static str,
}

impl Syntax {
    fn of(language: Language) -> Self {
        let hlsl = Self {
            language,
            vectors: ["float3", "float4"],
            codes: ["uint", "uint2"],
            from_bits: ["asfloat(uint3", "asfloat(uint4"],
            to_bits: "asuint",
            unsigned: "",
            reference: "",
        };
        match language {
            Language::Hlsl | Language::Slang => hlsl,
            Language::Msl => Self {
                from_bits: ["as_type<float3>(uint3", "as_type<float4>(uint4"],
                to_bits: "as_type<uint>",
                ..hlsl
            },
            Language::Cpp => Self {
                from_bits: ["uintBitsToFloat(uint3", "uintBitsToFloat(uint4"],
                to_bits: "floatBitsToUint",
                ..hlsl
            },
            Language::Wgsl | Language::NagaOil | Language::Wesl => Self {
                vectors: ["vec3f", "vec4f"],
                codes: ["u32", "vec2u"],
                from_bits: ["bitcast<vec3f>(vec3u", "bitcast<vec4f>(vec4u"],
                to_bits: "bitcast<u32>",
                unsigned: "u",
                reference: "&",
                ..hlsl
            },
            Language::Glsl | Language::GlslEs | Language::Godot => Self {
                vectors: ["vec3", "vec4"],
                codes: ["uint", "uvec2"],
                from_bits: ["uintBitsToFloat(uvec3", "uintBitsToFloat(uvec4"],
                to_bits: "floatBitsToUint",
                unsigned: "u",
                ..hlsl
            },
        }
    }

    /// The n-th word of an element or code that has so many.
    fn input(&self, words: usize, word: usize) -> String {
        let u = self.unsigned;
        if is_fragment(self.language) {
            let texel = if word < 4 { "a" } else { "b" };
            return format!("{texel}.{}", ["x", "y", "z", "w"][word % 4]);
        }
        format!("words[{words}{u} * i + {word}{u}]")
    }

    /// A vector of the floats that these words are.
    fn floats(&self, words: &[String]) -> String {
        format!("{}({}))", self.from_bits[words.len() - 3], words.join(", "))
    }

    fn define(&self, r#type: &str, name: &str, value: &str) -> String {
        match self.language {
            Language::Wgsl | Language::NagaOil | Language::Wesl => format!("let {name} = {value};"),
            _ => format!("{type} {name} = {value};"),
        }
    }

    fn declare(&self, r#type: &str, name: &str) -> String {
        match self.language {
            Language::Wgsl | Language::NagaOil | Language::Wesl => format!("var {name}: {type};"),
            _ => format!("{type} {name};"),
        }
    }
}

/// A language's entry point, with placeholders.
fn entry(language: Language) -> &'static str {
    match language {
        Language::Glsl => GLSL,
        Language::Hlsl => HLSL,
        Language::Wgsl | Language::NagaOil | Language::Wesl => WGSL,
        Language::Slang => SLANG,
        Language::Msl => MSL,
        Language::Cpp => CPP,
        Language::GlslEs | Language::Godot => GLSL_ES,
    }
}

const GLSL: &str = "
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) writeonly buffer Results { uint results[]; };

void main() {
    uint first = 4u * gl_GlobalInvocationID.x;
    uint end = min(first + 4u, uint(results.length()) / WRITTENu);
    for (uint i = first; i < end; ++i) {
        BODY
    }
}
";

const HLSL: &str = "
StructuredBuffer<uint> words : register(t0);
RWStructuredBuffer<uint> results : register(u1);

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint size, stride;
    results.GetDimensions(size, stride);
    uint end = min(4 * id.x + 4, size / WRITTEN);
    for (uint i = 4 * id.x; i < end; ++i) {
        BODY
    }
}
";

const SLANG: &str = "
[[vk::binding(0)]] StructuredBuffer<uint> words;
[[vk::binding(1)]] RWStructuredBuffer<uint> results;

[shader(\"compute\")]
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint size, stride;
    results.GetDimensions(size, stride);
    uint end = min(4 * id.x + 4, size / WRITTEN);
    for (uint i = 4 * id.x; i < end; ++i) {
        BODY
    }
}
";

const WGSL: &str = "
@group(0) @binding(0) var<storage, read> words: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let end = min(4u * id.x + 4u, arrayLength(&results) / WRITTENu);
    for (var i = 4u * id.x; i < end; i++) {
        BODY
    }
}
";

const MSL: &str = "
kernel void NAME(device const uint* words [[buffer(0)]], device uint* results [[buffer(1)]],
    constant uint& count [[buffer(2)]], uint i [[thread_position_in_grid]]) {
    if (i < count) {
        BODY
    }
}
";

const CPP: &str = "
using namespace unitvec;

UNITVEC_FN void NAME(const uint* words, uint* results, const uint& count, uint i) {
    if (i < count) {
        BODY
    }
}
";

const GLSL_ES: &str = "
uniform usampler2D words;
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uvec4 a = texelFetch(words, ivec2(2 * at.x, at.y), 0);
    uvec4 b = texelFetch(words, ivec2(2 * at.x + 1, at.y), 0);
    BODY
}
";

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue::find;

    fn text(language: Language, id: &str, operation: Operation) -> String {
        kernel(language, find(id).unwrap(), operation)
    }

    #[test]
    fn a_kernel_calls_the_codec_with_the_words_of_an_element() {
        let encode = text(Language::Wgsl, "oct32", Operation::Encode);
        let call =
            "oct32_encode(bitcast<vec3f>(vec3u(words[3u * i + 0u], words[3u * i + 1u], words[3u * i + 2u])))";
        assert!(encode.contains(&format!("\n        let code = {call};\n")), "{encode}");
        assert!(encode.contains("\n        results[1u * i + 0u] = code;\n    }"), "{encode}");
        assert!(encode.contains("arrayLength(&results) / 1u"), "{encode}");
        let decode = text(Language::Hlsl, "oct48p", Operation::Decode);
        assert!(decode.contains("uint2 code = uint2(words[2 * i + 0], words[2 * i + 1]);"), "{decode}");
        assert!(decode.contains("results[3 * i + 2] = asuint(v.z);"), "{decode}");
    }

    #[test]
    fn frames_are_a_normal_and_a_tangent_of_four() {
        let encode = text(Language::Msl, "frame32", Operation::Encode);
        assert!(encode.contains("words[7 * i + 2])), as_type<float4>(uint4(words[7 * i + 3]"), "{encode}");
        assert!(encode.contains("kernel void frame32_encode_kernel("), "{encode}");
        let decode = text(Language::Wgsl, "frame64", Operation::Decode);
        assert!(decode.contains("frame64_decode(code, &normal, &tangent);"), "{decode}");
        assert!(decode.contains("results[7u * i + 6u] = bitcast<u32>(tangent.w);"), "{decode}");
        let decode = text(Language::GlslEs, "frame32", Operation::Decode);
        assert!(decode.contains("second = uvec4(floatBitsToUint(tangent.y),"), "{decode}");
        assert!(decode.contains("floatBitsToUint(tangent.w), 0u);"), "{decode}");
    }

    #[test]
    fn no_placeholder_is_left() {
        for language in Language::ALL {
            for id in ["oct32", "oct48p", "frame32", "frame64"] {
                for operation in Operation::ALL {
                    let text = text(language, id, operation);
                    assert!(!["BODY", "WRITTEN", "NAME"].iter().any(|word| text.contains(word)), "{text}");
                }
            }
        }
    }
}
