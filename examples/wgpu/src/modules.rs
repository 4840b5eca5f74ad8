//! The same shader with the functions imported: by naga_oil, as in Bevy up to 0.19, and in WESL, as in Bevy from 0.20 on.

use crate::Result;
use naga::back::wgsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga_oil::compose::{ComposableModuleDescriptor, Composer, NagaModuleDescriptor};
use unitvec_shaders::Language;
use wesl::syntax::ModulePath;

/// The modules of these families, by name, from a folder that the crate `unitvec-shaders` makes.
pub fn of(language: Language, folder: &str, families: &[&str]) -> Result<Vec<(String, String)>> {
    let mut files = unitvec_shaders::folder(language)?;
    let module = |family: &&str| -> Result<(String, String)> {
        let text =
            files.remove(&format!("{folder}{family}.{}", language.extension())).ok_or("no such module")?;
        Ok(((*family).to_owned(), text))
    };
    families.iter().map(module).collect()
}

/// A shader that imports modules for naga_oil, composed, as WGSL. Each of the modules stands after those that it imports.
pub fn naga_oil(shader: &str, modules: &[(String, String)]) -> Result<String> {
    let mut composer = Composer::default();
    for (path, source) in modules {
        let module = ComposableModuleDescriptor { source, file_path: path, ..Default::default() };
        if let Err(error) = composer.add_composable_module(module) {
            return Err(error.emit_to_string(&composer).into());
        }
    }
    let shader = NagaModuleDescriptor { source: shader, file_path: "normals.wgsl", ..Default::default() };
    let module = match composer.make_naga_module(shader) {
        Ok(module) => module,
        Err(error) => return Err(error.emit_to_string(&composer).into()),
    };
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
    Ok(wgsl::write_string(&module, &info, wgsl::WriterFlags::empty())?)
}

/// A shader that imports modules of WESL, which lie in the package's folder `unitvec`, as WGSL.
pub fn wesl(shader: &str, modules: &[(String, String)]) -> Result<String> {
    let mut files = wesl::VirtualResolver::new();
    let path = |name: &str| name.parse::<ModulePath>().map_err(|error| error.to_string());
    for (name, text) in modules {
        files.add_module(path(&format!("package::unitvec::{name}"))?, text.as_str().into());
    }
    let main = path("package::normals")?;
    files.add_module(main.clone(), shader.into());
    let compiler = wesl::Wesl::new("").set_custom_resolver(files);
    Ok(compiler.compile(&main)?.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::Path;

    /// All modules of an edition, each after those that it imports.
    fn modules(language: Language, folder: &str) -> Vec<(String, String)> {
        let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let all = fs::read_to_string(repository.join("glsl/unitvec/unitvec.glsl")).unwrap();
        let names = all.lines().filter_map(|line| line.strip_prefix("#include \"")?.strip_suffix(".glsl\""));
        let names: Vec<&str> = names.collect();
        let modules = of(language, folder, &names).unwrap();
        assert_eq!(2 * modules.len(), unitvec_shaders::folder(language).unwrap().len());
        modules
    }

    /// The names and the parameters' types of a module's functions that are for users.
    fn functions<'a>(text: &'a str) -> Vec<(&'a str, Vec<&'a str>)> {
        let heads = text.lines().filter_map(|line| line.strip_prefix("fn ")?.split_once('('));
        let heads = heads.filter(|(name, _)| !name.starts_with("unitvec_"));
        let types = |(name, rest): (&'a str, &'a str)| {
            let parameters: &'a str = rest.split(')').next().unwrap_or_default();
            let ty = |part: &'a str| match part.find('>') {
                Some(end) => &part[..=end],
                None => part.split(',').next().unwrap_or_default(),
            };
            let types = parameters.split(": ").skip(1).map(ty);
            (name, types.collect())
        };
        heads.map(types).collect()
    }

    /// A shader that calls all these functions, below this import.
    fn caller(import: &str, functions: &[(&str, Vec<&str>)]) -> String {
        let mut text = format!("{import}\n@compute @workgroup_size(1)\nfn main() {{\n");
        for (name, types) in functions {
            let mut arguments = Vec::new();
            for ty in types {
                match ty.strip_prefix("ptr<function, ").and_then(|ty| ty.strip_suffix('>')) {
                    Some(ty) => {
                        let variable = format!("{name}_argument_{}", arguments.len());
                        text += &format!("    var {variable}: {ty};\n");
                        arguments.push(format!("&{variable}"));
                    }
                    None => arguments.push(format!("{ty}()")),
                }
            }
            let is_void = types.iter().any(|ty| ty.starts_with("ptr"));
            text += &format!("    {}{name}({});\n", if is_void { "" } else { "_ = " }, arguments.join(", "));
        }
        text + "}\n"
    }

    fn validate(text: &str) {
        let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module).unwrap();
    }

    /// A shader that imports and calls every function of every module. `import` makes the line that imports names from a
    /// module.
    fn caller_of_all(modules: &[(String, String)], import: impl Fn(&str, &str) -> String) -> String {
        let mut imports = String::new();
        let mut called = Vec::new();
        for (name, text) in &modules[1..] {
            let functions = functions(text);
            let names: Vec<&str> = functions.iter().map(|(name, _)| *name).collect();
            let is_for_codes =
                |name: &&str| ["_encode", "code_", "_to_"].iter().any(|part| name.contains(part));
            assert!(names.iter().any(is_for_codes), "{name}: no function for codes was read");
            imports += &import(name, &names.join(", "));
            called.extend(functions);
        }
        caller(&imports, &called)
    }

    #[test]
    fn naga_oil_composes_all_modules() {
        for folder in ["", "exact/"] {
            let modules = modules(Language::NagaOil, folder);
            let import = |name: &str, names: &str| format!("#import unitvec::{name}::{{{names}}}\n");
            validate(&naga_oil(&caller_of_all(&modules, import), &modules).unwrap());
        }
    }

    #[test]
    fn wesl_composes_all_modules() {
        for folder in ["", "exact/"] {
            let modules = modules(Language::Wesl, folder);
            let import = |name: &str, names: &str| format!("import package::unitvec::{name}::{{{names}}};\n");
            validate(&wesl(&caller_of_all(&modules, import), &modules).unwrap());
        }
    }

    /// What docs/engines.md says for Bevy and for WebGPU compiles.
    #[test]
    fn lines_of_the_docs_compile() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/engines.md");
        let docs = fs::read_to_string(path).unwrap();
        let blocks = docs.split("```wgsl\n").skip(1).filter_map(|rest| rest.split("```").next());
        let main = "@compute @workgroup_size(1)\nfn main() { _ = loaded(stored(vec3f())); }\n";
        let [in_wesl, in_naga_oil, plain]: [String; 3] =
            blocks.map(|block| format!("{block}{main}")).collect::<Vec<_>>().try_into().unwrap();
        let [wgsl, oil, files] =
            [Language::Wgsl, Language::NagaOil, Language::Wesl].map(|language| modules(language, ""));
        validate(&[wgsl[0].1.as_str(), &wgsl[1].1, &plain].concat());
        validate(&naga_oil(&in_naga_oil, &oil).unwrap());
        let in_wesl: String = in_wesl.replace("package::shaders::", "package::");
        validate(&wesl(&in_wesl, &files).unwrap());
    }
}
