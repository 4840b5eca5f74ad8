//! Some hundreds of the fuzz inputs through the program itself.

use super::{
    CODES, COSTS, DDS, EXR, GLB, GLTF, KTX2, MANIFEST, MODULE, OBJ, PLY_ASCII, PLY_BIG, PLY_LITTLE, PNG, RAW,
    SHADER, TGA, Target, keep, mutate, names, prepare,
};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngSeed, TestRunner};
use std::process::Output;
use unitvec_tests::program::{command, stderr};

/// Inputs of each target.
const INPUTS: usize = 32;

/// Runs the program on inputs of a target, by a line in which IN is the input, OUT the output, FOLDER the place of both
/// and ZEROS a file that can be encoded.
fn run(target: &Target, line: &str) {
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
        let mut program = command(line.split(' ').map(|word| match word {
            "IN" => path.clone(),
            "OUT" => out.clone(),
            "FOLDER" => folder.path().to_owned(),
            "ZEROS" => path.with_file_name("zeros.f32"),
            word => word.into(),
        }));
        let output = program.output().unwrap();
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
        run(&target, "encode --codec oct24p IN OUT");
        run(&target, "normals --frames --json - IN OUT");
        run(&target, "snap --for oct16 IN OUT");
    }
}

#[test]
fn textures() {
    [PNG, TGA, EXR, KTX2, DDS].iter().for_each(|target| run(target, "error --codec oct16 IN"));
}

#[test]
fn other_files() {
    run(&RAW, "error --codec frame32 IN");
    run(&CODES, "decode --codec oct48p --raw IN OUT");
    run(&COSTS, "choose --max-error 0.001 --costs IN");
    run(&SHADER, "link IN -o OUT");
}

/// The folder is not trusted: nothing of it reaches the driver but what is the program's own.
#[test]
fn spirv() {
    for target in [MANIFEST, MODULE] {
        run(&target, "encode --codec oct16 --backend rust --spirv FOLDER ZEROS OUT");
    }
}
