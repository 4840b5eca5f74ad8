//! `xtask-npm MODULE FOLDER`: makes the files of the npm package that are built. These are the WebAssembly module and the functions
//! that call it, by wasm-bindgen, and modules of the shading texts.
//!
//! A program of its own, since wasm-bindgen's tool takes longer to compile than all that uses it.

mod texts;

use std::error::Error;
use std::path::Path;
use std::{env, fs};
use unitvec_languages::{Language, Library};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let [module, folder] = &env::args().skip(1).collect::<Vec<_>>()[..] else {
        return Err("usage: xtask-npm MODULE FOLDER".into());
    };
    let folder = Path::new(folder);
    bind(Path::new(module), folder)?;
    let library = Library::parse(unitvec_shaders::glsl)?;
    for language in [Language::GlslEs, Language::Wgsl] {
        for edition in language.editions() {
            let name = format!("{}{}", edition.folder(), language.id()).replace('/', "-");
            let [module, types] = texts::module(&library, language, *edition)?;
            fs::write(folder.join(format!("{name}.js")), module)?;
            fs::write(folder.join(format!("{name}.d.ts")), types)?;
        }
    }
    Ok(())
}

fn bind(module: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut bindgen = Bindgen::new();
    bindgen.typescript(true).remove_name_section(true).remove_producers_section(true);
    bindgen.web(true)?.omit_default_module_path(true);
    bindgen.input_path(module).out_name("unitvec").generate(folder)?;
    fs::rename(folder.join("unitvec_bg.wasm"), folder.join("unitvec.wasm"))?;
    Ok(fs::remove_file(folder.join("unitvec_bg.wasm.d.ts"))?)
}
