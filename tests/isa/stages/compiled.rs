//! The shaders compiled again, by the RADV that is installed here.

use super::{ATTRIBUTE, WAYS, WRITTEN, Way, file, gpus};
use crate::isa::apart;
use crate::isa::gpus::SHOWN;
use unitvec_catalogue::Operation;
use unitvec_choose::costs::{Row, Source};
use unitvec_lab::Error;
use unitvec_lab::isa::{Asked, counted};
use unitvec_run::glsl::{Compiler, ENTRY_POINT, Shader, Stage};
use unitvec_vulkan::{Error as VulkanError, ImageFormat, PipelineOptions};

const COMPILE: &str = "isa::stages::compiled::compile";

const HEAD: &str = r#"#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "unitvec/oct.glsl"
#include "unitvec/formats.glsl"
#include "unitvec/frame.glsl"
#include "textbook/oct.glsl"
#include "textbook/frame.glsl"
vec3 frame32_sum(uint code) { vec3 n; vec4 t; frame32_decode(code, n, t); return n + t.xyz * t.w; }
vec3 textbook_frame32_sum(uint code) { vec3 n; vec4 t; textbook_frame32_decode(code, n, t); return n + t.xyz * t.w; }
"#;

const VERTEX: &str = "layout(location = 0) in vec3 p;
layout(location = 1) in READ x;
layout(location = 0) out vec3 n;
void main() { gl_Position = vec4(p, 1.0); n = EXPRESSION; }
";

const PIXEL: &str = "layout(binding = 0) uniform TEXTURE t;
layout(location = 0) in vec3 n;
layout(location = 0) out WRITTEN c;
void main() { READ x = texelFetch(t, ivec2(gl_FragCoord.xy), 0); c = EXPRESSION; }
";

/// Compiles the shaders for the device of this process.
#[test]
#[ignore = "other tests run it with the environment of a driver"]
fn compile() {
    let files = ["arith", "oct", "formats", "frame"].map(|name| format!("unitvec/{name}.glsl"));
    let files = files.iter().map(String::as_str).chain(["textbook/oct.glsl", "textbook/frame.glsl"]);
    apart::compile(&files.collect::<Vec<_>>(), &[], |asked, compiler| {
        let mut rows: Vec<Row> = Vec::new();
        for way in &WAYS {
            for expression in [way.idle(), way.2].into_iter().chain(way.3) {
                if !rows.iter().any(|row| row.id == way.row_id(expression)) {
                    rows.extend(row(asked, compiler, way, expression));
                }
            }
        }
        rows
    });
}

/// `None` where the GPU does not draw to the format.
fn row(asked: &Asked<'_>, compiler: &Compiler, way: &Way, expression: &str) -> Option<Row> {
    let Way(place, format, ..) = way;
    let (is_vertex, is_written) = (*place == ATTRIBUTE, *place == WRITTEN);
    let [written, read, texture] = format.types;
    let written = if is_written { written } else { "vec3" };
    let module = |stage, text, expression: &str| {
        let macros = [("WRITTEN", written), ("READ", read), ("TEXTURE", texture), ("EXPRESSION", expression)];
        let macros = macros.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let shader = Shader { stage, file: "stage", text: &format!("{HEAD}{text}"), beside: &|_| None };
        compiler.compile_shader(shader, &macros).unwrap()
    };
    let vertex = module(Stage::Vertex, VERTEX, if is_vertex { expression } else { "p" });
    let pixel = module(Stage::Fragment, PIXEL, if is_vertex { "n" } else { expression });
    let shader = |spirv| unitvec_vulkan::Shader { spirv, entry_point: ENTRY_POINT };
    let attributes = &[ImageFormat::R32G32B32_SFLOAT, format.raw];
    let options =
        PipelineOptions { vertex: shader(&vertex), fragment: shader(&pixel), attributes, points: false };
    let target = if is_written { format.raw } else { ImageFormat::R32G32B32A32_SFLOAT };
    let [of_vertex, of_pixel] = match asked.stages(&[target], &options) {
        Err(Error::Run(unitvec_run::Error::Vulkan(VulkanError::UnsupportedFormat { .. }))) => return None,
        found => found.unwrap(),
    };
    let statistics = if is_vertex { of_vertex } else { of_pixel };
    let operation = if is_written { Operation::Encode } else { Operation::Decode };
    Some(counted(Row::new(&way.row_id(expression), operation, Source::Glsl), &statistics))
}

/// Each expression is compiled again for the GPU whose driver most have, and its cost matches the record.
#[test]
fn stages_cost_what_is_recorded() {
    apart::assert_as_recorded(&file(SHOWN[0]), COMPILE, SHOWN[0]);
}

/// Compiles all again.
#[test]
#[ignore = "`cargo xtask renew costs` runs it"]
fn renew() {
    gpus().for_each(|gpu| apart::renew(&file(gpu.name), COMPILE, gpu.name));
}
