//! `unitvec figures`: whole files with what they say, or none.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use unitvec_tests::program::{command, stderr};

fn figures(folder: &Path, arguments: &[&str]) -> Output {
    command(["figures", "--small"]).args(arguments).arg("--out").arg(folder).output().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = folder.read_dir().unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Every picture of figures.json is a file of its kind, figures.md shows it, and nothing else is there.
#[test]
fn figures_without_a_device() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("figures");
    // None of these takes a device.
    let mut run = command(["figures", "--small", "--only", "2,3,5,front", "--codec", "oct16", "--out"]);
    let output = run.arg(&folder).env("UNITVEC_VULKAN_LOADER", "libno-such-loader.so").output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let json: Value = serde_json::from_slice(&std::fs::read(folder.join("figures.json")).unwrap()).unwrap();
    let page = std::fs::read_to_string(folder.join("figures.md")).unwrap();
    let mut expected = vec!["figures.json".to_owned(), "figures.md".to_owned()];
    for figure in json["figures"].as_array().unwrap() {
        for shown in figure["pictures"].as_array().unwrap() {
            let file = shown["file"].as_str().unwrap();
            let content = std::fs::read(folder.join(file)).unwrap();
            let begins: &[u8] = if file.ends_with(".svg") { b"<svg" } else { b"\x89PNG" };
            assert!(content.starts_with(begins), "{file}");
            assert!(page.contains(&format!("]({file})")), "{file}");
            expected.push(file.to_owned());
        }
    }
    expected.sort();
    assert_eq!(names(&folder), expected);
    let ids: Vec<&str> =
        json["figures"].as_array().unwrap().iter().map(|one| one["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["2", "3", "5", "front"]);
}

/// The figures of a run with rendered pictures, small.
fn rendered(folder: &Path, arguments: &[&str]) -> Value {
    let output = figures(folder, arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&std::fs::read(folder.join("figures.json")).unwrap()).unwrap()
}

/// A number of a figure by the beginning of its name.
fn number(figure: &Value, name: &str) -> f64 {
    let numbers = figure["numbers"].as_array().unwrap();
    let found = numbers.iter().find(|number| number["name"].as_str().unwrap().starts_with(name));
    found.unwrap_or_else(|| panic!("no {name}"))["value"].as_f64().unwrap()
}

/// The mean difference to floats of what has this label in a figure's first picture.
fn difference(figure: &Value, label: &str) -> f64 {
    let differences = figure["pictures"][0]["differences"].as_array().unwrap();
    let found = differences.iter().find(|one| one["label"] == label);
    found.unwrap_or_else(|| panic!("no {label}"))["mean"].as_f64().unwrap()
}

/// What the survey says of its figures 6 and 8: Lambertian surfaces hardly differ, and mirrors differ in the order of the errors.
#[test]
fn pictures_bear_the_survey_out() {
    let place = tempfile::tempdir().unwrap();
    let json = rendered(place.path(), &["--only", "6,8", "--material", "mirror", "--validate"]);
    let [six, eight] = [0, 1].map(|at| &json["figures"][at]);
    assert!(number(six, "eqarea_ellipse16, pixels off by one step") > 0.9);
    let [precise, finer, plain] = ["oct16P", "oct24P", "snorm8x3"].map(|label| difference(eight, label));
    assert!(finer < plain && plain < precise, "{finer} {plain} {precise}");
    let [precise, fast] =
        ["oct16p", "oct16"].map(|id| number(eight, &format!("{id}, mirror, mean difference of a sphere")));
    assert!(precise < fast, "{precise} {fast}");
    for of in [
        "of a sphere from all sides with the mean error over the sphere",
        "on the scene's curved bodies with the mean error of their normals",
    ] {
        let name = format!("rank correlation of the mirror's mean difference {of}");
        assert!(number(eight, &name) > 0.9, "{name}: {}", number(eight, &name));
    }
}

/// Shaders from Rust and from GLSL make the same files.
#[cfg(feature = "glsl")]
#[test]
fn both_languages_draw_the_same() {
    let place = tempfile::tempdir().unwrap();
    let [rust, glsl] = ["rust", "glsl"].map(|source| {
        let folder = place.path().join(source);
        rendered(&folder, &["--only", "1,meyer", "--size", "320x180", "--source", source]);
        folder
    });
    assert_eq!(names(&rust), names(&glsl));
    for name in names(&rust) {
        assert_eq!(
            std::fs::read(rust.join(&name)).unwrap(),
            std::fs::read(glsl.join(&name)).unwrap(),
            "{name}"
        );
    }
}

/// What cannot be done is said in one line, and no folder is left behind.
#[test]
fn faults_leave_nothing() {
    let place = tempfile::tempdir().unwrap();
    let none = place.path().join("none/figures");
    let output = figures(&none, &["--only", "2"]);
    assert_eq!((output.status.code(), stderr(&output).lines().count()), (Some(1), 1), "{}", stderr(&output));

    let folder = place.path().join("figures");
    for (arguments, word) in [
        (["--only", "9"], "9"),
        (["--size", "0x720"], "1280x720"),
        (["--size", "1280"], "1280x720"),
        (["--codec", "oct17"], "oct17"),
        (["--material", "wood"], "mirror"),
    ] {
        let output = figures(&folder, &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(word), "{}", stderr(&output));
        assert!(!folder.exists());
    }
    let output = command(["figures", "--only", "1", "--out"])
        .arg(&folder)
        .env("UNITVEC_VULKAN_LOADER", "libno-such-loader.so")
        .output()
        .unwrap();
    assert_eq!((output.status.code(), stderr(&output).lines().count()), (Some(1), 1), "{}", stderr(&output));
    assert!(!folder.exists());
}

/// Where files may have 4 KiB only, as on a disk that is full, no picture is left, and earlier ones are as before.
#[cfg(unix)]
#[test]
fn no_room_for_pictures() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("figures");
    let run = |program: &Command| {
        let mut shell = Command::new("sh");
        shell.args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\""]).arg(program.get_program());
        shell.args(["figures", "--small", "--only", "3,2", "--out"]).arg(&folder).output().unwrap()
    };
    let output = run(&command(["figures"]));
    assert_eq!((output.status.code(), stderr(&output).lines().count()), (Some(1), 1), "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot write"), "{}", stderr(&output));
    assert!(!folder.exists());

    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("figure3.png"), b"earlier").unwrap();
    assert_eq!(run(&command(["figures"])).status.code(), Some(1));
    assert_eq!(names(&folder), ["figure3.png"]);
    assert_eq!(std::fs::read(folder.join("figure3.png")).unwrap(), b"earlier");
}
