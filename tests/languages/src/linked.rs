//! Kernels that call the stubs of `shaders/stubs/`, and are linked with the library's SPIR-V.

use crate::cases::Case;
use crate::job::Job;
use unitvec_catalogue::{Element, Operation};
use unitvec_link::stubs;
use unitvec_run::shader::Language;
use unitvec_run::shader::kernel::{code_words, kernel};

/// Whole shaders that call stubs, one of each case.
pub fn jobs(cases: &[Case], language: Language) -> Vec<Job<'_>> {
    let stubs = match language {
        Language::Slang => stubs::text(stubs::Language::Slang),
        _ => stubs::text(stubs::Language::Hlsl),
    };
    let whole = |case| format!("{stubs}{}{}", function(case), kernel(language, case.format, case.operation));
    cases.iter().filter(|case| !case.has_all_files).map(|case| Job { case, text: whole(case) }).collect()
}

/// The function that a kernel calls, by its stub.
fn function(case: &Case) -> String {
    let name = case.name();
    let code = if code_words(case.format) == 1 { "uint" } else { "uint2" };
    match (case.operation, case.format.element) {
        (Operation::Encode, Element::Vector) => {
            format!("{code} {name}(float3 v) {{ return unitvec_{name}(v); }}\n")
        }
        (Operation::Decode, Element::Vector) => {
            format!("float3 {name}({code} c) {{ return unitvec_{name}(c); }}\n")
        }
        (Operation::Encode, Element::Rotation) => {
            format!("{code} {name}(float4 q) {{ return unitvec_{name}(q); }}\n")
        }
        (Operation::Decode, Element::Rotation) => {
            format!("float4 {name}({code} c) {{ return unitvec_{name}(c); }}\n")
        }
        (Operation::Encode, Element::Frame) => {
            format!("{code} {name}(float3 n, float4 t) {{ return unitvec_{name}(n, t); }}\n")
        }
        (Operation::Decode, Element::Frame) => format!(
            "void {name}({code} c, out float3 n, out float4 t) {{
    UnitvecFrame frame = unitvec_{name}(c);
    n = frame.normal;
    t = frame.tangent;
}}\n"
        ),
    }
}
