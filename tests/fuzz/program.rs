//! Some hundreds of the fuzz inputs through the program itself.

use super::{
    CODES, COSTS, GLB, GLTF, MANIFEST, MODULE, OBJ, PLY_ASCII, PLY_BIG, PLY_LITTLE, RAW, SHADER, Target,
    keep, mutate, names, prepare,
};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngSeed, TestRunner};
use std::path::Path;
use std::process::{Command, Output};
use unitvec_tests::program::{command, stderr};

/// Inputs of each target.
const INPUTS: usize = 32;

/// Runs the program on inputs of a target; `arguments` get the input and where the output goes.
fn run(target: &Target, arguments: fn(&Path, &Path) -> Command) {
    let config = Config { rng_seed: RngSeed::Fixed(15), failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new(config);
    let inputs = mutate::inputs((target.seeds)());
    for _ in 0..INPUTS {
        let input = inputs.new_tree(&mut runner).unwrap().current();
        let folder = tempfile::tempdir().unwrap();
        let (path, out) = (folder.path().join(target.file), folder.path().join("out"));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        prepare(&path);
        std::fs::write(&path, &input).unwrap();
        let mut expected = names(folder.path());
        let output = arguments(&path, &out).output().unwrap();
        if output.status.success() && out.exists() {
            expected.push("out".into());
        }
        let mut left = names(folder.path());
        for names in [&mut expected, &mut left] {
            names.sort();
        }
        let fault = fault(&output).or_else(|| (left != expected).then(|| format!("left behind: {left:?}")));
        if let Some(fault) = fault {
            panic!("{fault}\nthe input is in {}", keep(target, &input).display());
        }
    }
}

/// The fault in the program's end, if any.
fn fault(output: &Output) -> Option<String> {
    let said = stderr(output);
    let is_one_line = said.starts_with("unitvec: ") && said.ends_with('\n') && said.lines().count() == 1;
    match output.status.code() {
        Some(0) => said.contains("panicked").then_some(said),
        Some(1 | 2) if is_one_line => None,
        code => Some(format!("status {code:?}: {said}")),
    }
}

#[test]
fn meshes() {
    for target in [OBJ, PLY_ASCII, PLY_LITTLE, PLY_BIG, GLTF, GLB] {
        run(&target, |mesh, out| {
            let mut encode = command(["encode", "--codec", "oct24p"]);
            encode.args([mesh, out]);
            encode
        });
        run(&target, |mesh, out| {
            let mut normals = command(["normals", "--frames", "--json", "-"]);
            normals.args([mesh, out]);
            normals
        });
    }
}

#[test]
fn raw_files() {
    run(&RAW, |file, _| {
        let mut error = command(["error", "--codec", "frame32"]);
        error.arg(file);
        error
    });
    run(&CODES, |file, out| {
        let mut decode = command(["decode", "--codec", "oct48p", "--raw"]);
        decode.args([file, out]);
        decode
    });
}

#[test]
fn costs() {
    run(&COSTS, |file, _| {
        let mut choose = command(["choose", "--max-error", "0.001", "--costs"]);
        choose.arg(file);
        choose
    });
}

/// The folder is not trusted: nothing of it reaches the driver but what is the program's own.
#[test]
fn spirv() {
    for target in [MANIFEST, MODULE] {
        run(&target, |file, out| {
            let folder = file.ancestors().find(|folder| folder.join(MANIFEST.file).exists()).unwrap();
            let mut encode = command(["encode", "--codec", "oct16", "--backend", "rust", "--spirv"]);
            encode.args([folder, &file.with_file_name("zeros.f32"), out]);
            encode
        });
    }
}

#[test]
fn shaders() {
    run(&SHADER, |file, out| {
        let mut link = command(["link"]);
        link.arg(file).arg("-o").arg(out);
        link
    });
}
