//! Prints the C header, made of the sources of `unitvec-c` by cbindgen. `tests/c_abi` compares it with the committed one,
//! and renews that.
//!
//! A program of its own, since cbindgen takes longer to compile than all that uses it.

use std::error::Error;
use std::path::Path;

/// The files of `c/src` that have exported functions, in the order of the header.
const FILES: [&str; 6] = ["single", "status", "codec", "elements", "memory", "codecs"];

fn main() -> Result<(), Box<dyn Error>> {
    let c = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../c");
    let config = cbindgen::Config::from_file(c.join("cbindgen.toml"))?;
    let sources = FILES.map(|file| c.join("src").join(file).with_extension("rs"));
    let builder = cbindgen::Builder::new().with_config(config);
    let bindings = sources.iter().fold(builder, cbindgen::Builder::with_src).generate()?;
    bindings.write(std::io::stdout().lock());
    Ok(())
}
