//! Programs in C and C++ with the library.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use unitvec_tests::{program, repository};

/// The ways of linking a program.
#[derive(Clone, Copy, Debug)]
pub enum Library {
    Static,
    Shared,
}

/// The folder with the libraries, built first.
pub fn libraries() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| program::build(&["--package", "unitvec-c"]))
}

/// Compiles a source, `.c` as C99 and `.cpp` as C++17, without any warning, and links it.
pub fn compile(source: &Path, folder: &Path, library: Library) -> PathBuf {
    let is_c = source.extension().is_some_and(|extension| extension == "c");
    let (compiler, standard) = if is_c { ("cc", "-std=c99") } else { ("c++", "-std=c++17") };
    let program = folder.join(source.file_stem().unwrap());
    let libraries = libraries();
    let mut command = Command::new(compiler);
    command.args([standard, "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wconversion"]);
    command.arg("-I").arg(repository().join("c/include")).arg("-I").arg(folder);
    command.arg(source).arg("-o").arg(&program);
    match library {
        Library::Static => {
            // The libraries that `rustc --print native-static-libs` lists.
            command.arg(libraries.join("libunitvec.a")).args(["-lpthread", "-ldl", "-lm"])
        }
        Library::Shared => {
            command.arg(libraries.join("libunitvec.so")).arg(format!("-Wl,-rpath,{}", libraries.display()))
        }
    };
    let output = command.output().unwrap_or_else(|error| {
        panic!("{compiler} cannot be started: {error}; `cargo xtask setup` installs it")
    });
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{}: {said}", source.display());
    program
}
