//! The renderer's shaders, inside the program: SPIR-V modules made of `shaders/rust`, and GLSL.

use include_dir::{Dir, include_dir};
use unitvec_run::glsl::{Compiler, Shader, Stage};

static SPIRV: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders/spirv");
static GLSL: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders/glsl");

/// A SPIR-V module. That of a codec, `oct16.spv`, has the entry points `oct16_vertex`, `oct16_gbuffer` and `oct16_light`;
/// `oct16_uint.spv` has those that store its codes as integers, `float.spv` those that store normals as they are, and
/// `fullscreen.spv` the vertex shader `fullscreen_vertex`. `oct16_dithered.spv`, of integers too, has no vertices of its own;
/// `oct_snorm.spv` and `oct_unorm.spv` have those of projections, which the hardware rounds.
pub fn module(name: &str) -> Option<&'static [u8]> {
    Some(SPIRV.get_file(name)?.contents())
}

/// A GLSL file: `vertex.vert`, `gbuffer.frag`, `light.frag`, `fullscreen.vert`, and their includes besides the codecs.
pub fn glsl(name: &str) -> Option<&'static str> {
    GLSL.get_file(name)?.contents_utf8()
}

/// The names of all modules.
pub fn modules() -> impl Iterator<Item = &'static str> {
    SPIRV.files().filter_map(|file| file.path().to_str()).filter(|name| name.ends_with(".spv"))
}

/// The codecs whose dithered functions have modules.
pub fn dithered() -> impl Iterator<Item = &'static str> {
    modules().filter_map(|name| name.strip_suffix("_dithered.spv"))
}

/// The hash of the sources that the modules were compiled from.
pub fn sources_sha256() -> Option<&'static str> {
    SPIRV.get_file(unitvec_manifest::RENDER_SOURCES)?.contents_utf8().map(str::trim_end)
}

/// Compiles a shader of [`glsl`](fn@glsl), `vertex.vert`, for a variant of this name, optimised.
pub(crate) fn compile_glsl(
    compiler: &Compiler,
    file: &str,
    variant: &str,
    macros: &[(String, String)],
) -> Result<Vec<u8>, unitvec_run::glsl::Error> {
    let path = || format!("host/render/shaders/glsl/{file}");
    let text = glsl(file).ok_or_else(|| unitvec_run::glsl::Error::NoSource { file: path() })?;
    let stage = if file.ends_with(".vert") { Stage::Vertex } else { Stage::Fragment };
    let shader = Shader { stage, file, text, beside: glsl };
    compiler.compile_shader(shader, macros).map_err(|error| unitvec_run::glsl::Error::Rejected {
        file: path(),
        kernel: variant.to_owned(),
        error,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rspirv::dr::{Instruction, Module, Operand, load_bytes};
    use rspirv::spirv::{Decoration, ExecutionModel, Op, StorageClass, Word};
    use std::collections::{BTreeMap, BTreeSet};
    use unitvec_catalogue::{AnyCodec, CODECS, find};

    /// The interface of an entry point: types by location, textures by binding in set 0, bytes of push constants.
    #[derive(Debug, Default, PartialEq)]
    struct Interface {
        is_vertex: bool,
        inputs: BTreeMap<u32, String>,
        outputs: BTreeMap<u32, String>,
        textures: BTreeMap<u32, String>,
        push_constants: u32,
    }

    /// The types that a codec's values have: attribute, value, texture.
    fn types(format: &AnyCodec, as_integers: bool) -> [&'static str; 3] {
        match format.vk_format.filter(|_| !as_integers) {
            Some(name) if name.ends_with("SINT") => ["ivec2", "ivec4", "itexture2D"],
            Some(name) if !name.ends_with("UINT") => ["vec4", "vec4", "texture2D"],
            _ if format.bits > 32 => ["uvec2", "uvec4", "utexture2D"],
            _ => ["uint", "uvec4", "utexture2D"],
        }
    }

    fn by_number(types: &[(u32, &str)]) -> BTreeMap<u32, String> {
        types.iter().map(|(number, name)| (*number, (*name).to_owned())).collect()
    }

    /// The passes of a module of this name, with their interfaces.
    fn expected(name: &str) -> BTreeMap<String, Interface> {
        if name == "fullscreen" {
            let vertex = Interface { is_vertex: true, ..Default::default() };
            return BTreeMap::from([("fullscreen_vertex".to_owned(), vertex)]);
        }
        let plain = name.trim_end_matches("_dithered");
        let is_dithered = name.ends_with("_dithered");
        let [attribute, value, texture] = match plain.trim_end_matches("_uint") {
            "float" => ["vec4", "vec4", "texture2D"],
            projected if crate::Projection::find(projected).is_some() => ["vec4", "vec4", "texture2D"],
            id => {
                let format = find(id).unwrap_or_else(|_| panic!("{name} is of no codec"));
                types(format, is_dithered || plain.ends_with("_uint"))
            }
        };
        let varying = by_number(&[(0, "vec3"), (1, "vec3")]);
        let tile: &[(u32, &str)] = if is_dithered { &[(2, "texture2D")] } else { &[] };
        let vertex = Interface {
            is_vertex: true,
            inputs: by_number(&[(0, "vec3"), (1, attribute)]),
            outputs: varying.clone(),
            push_constants: 128,
            ..Default::default()
        };
        let gbuffer = Interface {
            inputs: varying,
            outputs: by_number(&[(0, value), (1, "vec4"), (2, "vec4")]),
            textures: by_number(tile),
            push_constants: 128,
            ..Default::default()
        };
        let light = Interface {
            outputs: by_number(&[(0, "vec4"), (1, "vec4")]),
            textures: by_number(&[&[(0, texture), (1, "texture2D")], tile].concat()),
            push_constants: 80,
            ..Default::default()
        };
        let passes = [("vertex", vertex), ("gbuffer", gbuffer), ("light", light)].into_iter();
        let passes = passes.filter(|(pass, _)| !(is_dithered && *pass == "vertex"));
        passes.map(|(pass, of)| (format!("{name}_{pass}"), of)).collect()
    }

    #[test]
    fn every_codec_has_a_module() {
        let names: BTreeSet<&str> = modules().collect();
        let others = ["float", "fullscreen"];
        for name in CODECS.iter().map(|format| format.id).chain(others) {
            assert!(names.contains(format!("{name}.spv").as_str()), "{name}");
        }
    }

    #[test]
    fn entry_points_have_the_interfaces_of_their_passes() {
        for file in modules() {
            let name = file.trim_end_matches(".spv");
            assert_eq!(interfaces(module(file).unwrap()), expected(name), "{name}");
        }
    }

    /// The entry points of a module.
    fn interfaces(spirv: &[u8]) -> BTreeMap<String, Interface> {
        let module = load_bytes(spirv).unwrap();
        let entry_points = module.entry_points.iter();
        entry_points
            .map(|entry| (entry.operands[2].unwrap_literal_string().to_owned(), interface(&module, entry)))
            .collect()
    }

    fn interface(module: &Module, entry: &Instruction) -> Interface {
        let is_vertex = entry.operands[0] == Operand::ExecutionModel(ExecutionModel::Vertex);
        let mut interface = Interface { is_vertex, ..Default::default() };
        let used = used(module, entry.operands[1].unwrap_id_ref());
        for variable in &module.types_global_values {
            let id = variable.result_id.unwrap_or(0);
            if variable.class.opcode != Op::Variable || !used.contains(&id) {
                continue;
            }
            let pointee = global(module, variable.result_type.unwrap()).operands[1].unwrap_id_ref();
            let mut put = |by: Decoration, to: fn(&mut Interface) -> &mut BTreeMap<u32, String>| {
                if let Some(number) = decoration(module, id, by) {
                    to(&mut interface).insert(number, type_name(module, pointee));
                }
            };
            match variable.operands[0].unwrap_storage_class() {
                StorageClass::Input => put(Decoration::Location, |of| &mut of.inputs),
                StorageClass::Output => put(Decoration::Location, |of| &mut of.outputs),
                StorageClass::UniformConstant => {
                    assert_eq!(decoration(module, id, Decoration::DescriptorSet), Some(0));
                    put(Decoration::Binding, |of| &mut of.textures);
                }
                StorageClass::PushConstant => interface.push_constants = size(module, pointee),
                other => panic!("{other:?}"),
            }
        }
        interface
    }

    /// The ids that a function and its callees refer to.
    fn used(module: &Module, function: Word) -> BTreeSet<Word> {
        let body = module.functions.iter().find(|each| each.def_id() == Some(function)).unwrap();
        let ids = body.all_inst_iter().flat_map(|instruction| &instruction.operands);
        let mut used: BTreeSet<Word> = ids.filter_map(Operand::id_ref_any).collect();
        let called = module.functions.iter().filter_map(|each| each.def_id()).filter(|id| used.contains(id));
        for other in called.collect::<Vec<_>>() {
            used.extend(self::used(module, other));
        }
        used
    }

    fn global(module: &Module, id: Word) -> &Instruction {
        module.types_global_values.iter().find(|global| global.result_id == Some(id)).unwrap()
    }

    fn decoration(module: &Module, id: Word, decoration: Decoration) -> Option<u32> {
        let of_id = [Operand::IdRef(id), Operand::Decoration(decoration)];
        let found = module.annotations.iter().find(|annotation| annotation.operands.starts_with(&of_id))?;
        Some(found.operands[2].unwrap_literal_bit32())
    }

    fn type_name(module: &Module, id: Word) -> String {
        let of = global(module, id);
        let first = |prefix: &str| match type_name(module, of.operands[0].unwrap_id_ref()).as_str() {
            "float" => prefix.to_owned(),
            scalar => format!("{}{prefix}", &scalar[..1]),
        };
        match of.class.opcode {
            Op::TypeFloat => "float".to_owned(),
            Op::TypeInt if of.operands[1] == Operand::LiteralBit32(0) => "uint".to_owned(),
            Op::TypeInt => "int".to_owned(),
            Op::TypeVector => first(&format!("vec{}", of.operands[1].unwrap_literal_bit32())),
            Op::TypeImage => first("texture2D"),
            other => panic!("{other:?}"),
        }
    }

    /// Bytes of a type of push constants, whose arrays are of vectors of four.
    fn size(module: &Module, id: Word) -> u32 {
        let of = global(module, id);
        let size_of = |operand: usize| size(module, of.operands[operand].unwrap_id_ref());
        match of.class.opcode {
            Op::TypeVector | Op::TypeMatrix => size_of(0) * of.operands[1].unwrap_literal_bit32(),
            Op::TypeArray => {
                let length = global(module, of.operands[1].unwrap_id_ref());
                size_of(0) * length.operands[0].unwrap_literal_bit32()
            }
            Op::TypeStruct => (0..of.operands.len()).map(size_of).sum(),
            _ => 4,
        }
    }
}
