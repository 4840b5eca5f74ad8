//! Examples at the end of `--help`.

/// Commands, each with a command line and what it does.
const EXAMPLES: &[(&str, &str, &str)] = &[
    ("encode", "encode --codec oct24p bunny.obj bunny.oct24", "normals of a mesh"),
    ("encode", "encode --codec frame32 bunny.glb bunny.frames", "normals and tangents"),
    ("encode", "encode --codec oct32p normals.npy normals.uvec", "with a header"),
    ("encode", "encode --codec oct16p a.obj meshes codes", "into a folder"),
    ("encode", "encode --codec oct16 --dtype f64 in.bin out", "raw doubles"),
    ("encode", "encode --codec oct16 --json - in.f32 out", "counts as JSON"),
    ("encode", "encode --null --codec oct24p points.ply p.uvec", "keeps zeros"),
    ("decode", "decode --codec oct24p bunny.oct24 normals.f32", "three floats each"),
    ("decode", "decode normals.uvec normals.npy", "as a NumPy array"),
    ("decode", "decode --codec frame32 bunny.frames frames.f32", "seven floats each"),
    ("decode", "decode --into a.glb a.uvec decoded.glb", "back into the mesh"),
    ("normals", "normals bunny.obj normals.f32", "also where the mesh has none"),
    ("normals", "normals --frames bunny.glb frames.f32", "with tangents"),
    ("snap", "snap --for oct16p bunny.glb snapped.glb", "for tools that round"),
    ("snap", "snap --for frame32 a.gltf b.glb snapped", "into a folder"),
    ("texture", "texture in.png --codec hemioct16 out.ktx2", "tangent space"),
    ("texture", "texture in.exr --codec oct32p --mips out.dds", "object space"),
    ("texture", "texture out.ktx2 decoded.png", "and back"),
    ("texture", "texture --codec hemioct16 a.png b.tga maps", "into a folder"),
    ("write", "write a.glb --normals normals.f32 out.glb", "normals of your own"),
    ("write", "write a.glb --frames frames.npy out.glb", "with tangents"),
    ("error", "error bunny.obj", "the recommended codecs"),
    ("error", "error --codec oct24p,ico24 a.glb b.glb", "two codecs over two meshes"),
    ("error", "error --json errors.json normals.f32", "as JSON as well"),
    ("accuracy", "accuracy --table 1", "the survey's table 1"),
    ("accuracy", "accuracy --table beyond --csv errors.csv", "all other codecs"),
    ("accuracy", "accuracy --table blocks", "normal maps in BC5 and BC7"),
    ("bench", "bench --codec oct16,oct32", "on the best device; or `bench device`"),
    ("bench", "bench compiler --gpu rdna2", "by Mesa's compiler, without a GPU"),
    ("bench device", "bench device --codec oct16 --json costs.json", "for `choose --costs`"),
    ("bench device", "bench device --device lavapipe --count 10000", "on the CPU"),
    ("bench compiler", "bench compiler --gpu rdna2 --codec oct16", "by Mesa's RADV"),
    ("bench compiler", "bench compiler --device 0 --chart costs.svg", "by the device's driver"),
    ("choose", "choose --max-error 0.05", "fewest bytes first"),
    ("choose", "choose --bits 24", "least bound first"),
    ("choose", "choose --max-error 0.05 --weights 0,1", "decoding counts alone"),
    ("choose", "choose --bits 16 --hemisphere --gpu rdna3", "costs on RDNA 3"),
    ("choose", "choose --color-depth 8 --roughness 0.3", "what is not seen"),
    ("choose", "choose --mirror --pixels 2160 --fov 40", "sharp reflections"),
    ("compare", "compare --codec oct16,oct24p bunny.glb", "from the worst view"),
    ("compare", "compare --codec oct16 --ply heat.ply a.obj", "a heat map"),
    ("compare", "compare --codec oct16 meshes -o pages", "a page for each"),
    ("figures", "figures --only 1,8 --small", "two figures, in figures/"),
    ("figures", "figures --codec oct16,ico16 -o compared", "with codecs of your own"),
    ("report", "report -o report.html", "all on one page"),
    ("report", "report --no-device --costs costs.json", "without Vulkan, by your costs"),
    ("shader", "shader --language hlsl --codec oct24p", "both halves"),
    ("shader", "shader --language glsl --function oct32_decode", "one function"),
    ("shader", "shader --language wesl --all -o wesl", "all in a folder"),
    ("shader", "shader --list", "what there is"),
    ("conform", "conform --widest", "a codec a series"),
    ("conform", "conform --device 1 --codec oct16 --validate", "one device"),
    ("conform", "conform --json report.json bunny.glb", "your normals"),
    ("conform kernels", "conform kernels --exhaustive --widest", "all codes of up to 24 bits"),
    ("conform pipeline", "conform pipeline --codec oct16,snorm8x3", "two codecs"),
    ("conform imprecise", "conform imprecise --model down --codec oct16", "one kind of device"),
    ("link", "link --stubs glsl", "what your shader includes"),
    ("link", "link shader.spv -o linked.spv", "the functions in place of the stubs"),
    ("schema", "schema choose", "the keys of `choose --json`"),
    ("schema", "schema conform pipeline", "those of a subcommand"),
];

/// The examples of a command, a line each.
pub fn of(command: &str) -> String {
    let of_command = || EXAMPLES.iter().filter(|(name, ..)| *name == command);
    let width = of_command().map(|(_, line, _)| line.len()).max().unwrap_or(0);
    let line = |(_, line, words): &(_, &str, &str)| format!("\n  unitvec {line:width$}  # {words}");
    "Examples:".to_owned() + &of_command().map(line).collect::<String>()
}

#[cfg(all(test, feature = "render"))]
mod tests {
    use super::*;
    use crate::cli::{Arguments, parsed};
    use clap::CommandFactory;

    #[test]
    fn every_example_is_a_command_line() {
        for (command, line, _) in EXAMPLES {
            let words = ["unitvec"].into_iter().chain(line.split(' ')).map(Into::into);
            let error = parsed(words).err().map(|error| error.to_string());
            assert_eq!(error, None, "{command}: {line}");
            assert!(line.starts_with(command) && of(command).lines().all(|line| line.len() <= 80), "{line}");
        }
    }

    /// The help of each command that takes arguments ends in its examples.
    #[test]
    fn every_choice_has_examples() {
        for command in Arguments::command().get_subcommands() {
            let name = command.get_name().to_owned();
            let modes = command.get_subcommands().map(|mode| (mode, format!("{name} {}", mode.get_name())));
            let all = std::iter::once((command, name.clone())).chain(modes);
            for (command, name) in all.filter(|(_, name)| !["codecs", "devices"].contains(&name.as_str())) {
                let shown = command.get_after_help().map(ToString::to_string).unwrap_or_default();
                assert!(shown == of(&name) && shown.contains("unitvec"), "{name}: {shown}");
            }
        }
    }
}
