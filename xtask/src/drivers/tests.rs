use super::*;
use crate::tests::{folder, strings};

fn ran(mismatches: &str, passed: bool) -> Row {
    let names = "device\tdriver\tcodecs\tvectors\tcodes\tmismatches";
    let summary = format!("{names}\nd, e\tv 1\t3\t10\t20\t{mismatches}\n");
    Row { origin: "lvp_icd.json".to_owned(), outcome: Outcome::Ran { summary, passed } }
}

fn not_run(is_failure: bool) -> Row {
    let outcome = Outcome::NotRun { word: "not run", reason: "no network".to_owned(), is_failure };
    Row { origin: "lavapipe of trixie-backports".to_owned(), outcome }
}

#[test]
fn other_arguments_are_those_of_conform() {
    let options = Options::of(&strings(&["--count", "9", "--drivers", "--fetch", "x.obj"])).unwrap().unwrap();
    assert!(options.fetch && !options.record);
    assert_eq!(options.others, strings(&["--count", "9", "x.obj"]));
    assert!(Options::of(&strings(&["--device", "lavapipe"])).unwrap().is_none());
    assert!(Options::of(&strings(&["--drivers", "--codec"])).unwrap().is_some());
    for refused in ["--device", "--device=0", "imprecise", "--json", "--summary=x", "--codec"] {
        let error = Options::of(&strings(&["--drivers", "--record", refused])).err().unwrap();
        assert!(error.contains(refused), "{error}");
    }
}

/// Files of all folders and those named, each once, links to the same file too; folders may be missing.
#[cfg(unix)]
#[test]
fn drivers_are_found_once() {
    let folder = folder("found");
    let [first, second, missing] = ["first", "second", "missing"].map(|name| folder.join(name));
    fs::create_dir(&first).unwrap();
    fs::create_dir(&second).unwrap();
    let [a, b, c] = [first.join("a.json"), first.join("b.json"), second.join("c.json")];
    for path in [&a, &b, &c, &first.join("readme.txt")] {
        fs::write(path, "{}").unwrap();
    }
    std::os::unix::fs::symlink(&a, second.join("link.json")).unwrap();
    let gone = folder.join("gone.json");
    let folders = [first, missing, second];
    assert_eq!(found(&folders, vec![c.clone(), gone.clone()]), [a, b, c, gone]);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_reason_is_the_loaders() {
    let said = "ERROR:            loader_get_json: Failed to open JSON file x.json\n\
                ERROR:            vkCreateInstance: Found no drivers!\nunitvec: no Vulkan device\n";
    assert_eq!(reason(said), "Failed to open JSON file x.json");
    assert_eq!(reason("[Vulkan Loader] ERROR:  libx.so: cannot open\n"), "cannot open");
    assert_eq!(reason("unitvec: no Vulkan device: none was found\n"), "no Vulkan device: none was found");
    assert_eq!(reason(""), "");
}

/// A program in the place of `unitvec`: the driver's file decides whether it has a device, and differs from the CPU.
#[cfg(unix)]
const STAND_IN: &str = include_str!("stand_in.sh");

/// Each kind of driver with each duty: one that agrees, one that differs, one without a device, one that ends the program.
#[cfg(unix)]
#[test]
fn what_becomes_of_a_driver() {
    let folder = folder("run");
    let unitvec = folder.join("unitvec");
    fs::write(&unitvec, STAND_IN).unwrap();
    let run = |device: &str, duty| {
        let icd = folder.join(device);
        fs::write(&icd, device).unwrap();
        // The shell stands for the linker that starts a driver with its own libraries.
        let launcher = vec!["sh".into()];
        let driver = Driver { origin: device.to_owned(), icd, launcher, duty };
        driver.run(&unitvec, &strings(&["--count", "9"]), &folder)
    };
    for duty in [Duty::OfDevice, Duty::Always, Duty::Never] {
        for (device, expected, differing) in [("good", true, "0"), ("bad", false, "7")] {
            let Outcome::Ran { summary, passed } = run(device, duty) else { panic!("{device} did not run") };
            assert_eq!((passed, value(&summary, "mismatches")), (expected, differing));
            assert_eq!(value(&summary, "device"), device);
        }
        let none = run("none", duty);
        let is_failure = duty == Duty::Always;
        assert_eq!(none, Outcome::NotRun { word: "no device", reason: "no GPUs".to_owned(), is_failure });
        let Outcome::NotRun { word, reason, is_failure } = run("crash", duty) else { panic!("it ran") };
        assert_eq!((word, is_failure), ("not run", duty != Duty::Never));
        assert!(reason.contains("signal: 9"), "{reason}");
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_mismatch_or_a_missing_driver_fails() {
    assert_eq!(verdict(&[ran("0", true), not_run(false)]), Ok(()));
    assert!(verdict(&[ran("0", true), ran("7", false)]).unwrap_err().contains("fails on lvp_icd.json"));
    assert!(verdict(&[ran("0", true), not_run(true)]).unwrap_err().contains("not run: lavapipe of trixie"));
    assert!(verdict(&[not_run(false)]).unwrap_err().contains("no driver ran"));
}

/// Drivers that did not run show no figure, no PASS and the reason; nor are they recorded.
#[test]
fn what_did_not_run_is_not_green() {
    let rows = [ran("0", true), ran("7", false), not_run(false)];
    let table = table(&rows);
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[1].starts_with("PASS ") && lines[1].ends_with("0  v 1; d, e; lvp_icd.json"), "{table}");
    assert!(lines[2].starts_with("FAIL ") && lines[2].contains(" 7  v 1;"), "{table}");
    let words: Vec<&str> = lines[3].split_whitespace().collect();
    assert_eq!(words[..6], ["not", "run", "-", "-", "-", "-"]);
    assert!(lines[3].ends_with("lavapipe of trixie-backports: no network"), "{table}");
    let record = record(&rows);
    assert_eq!(record.lines().next(), Some("origin\tdevice\tdriver\tcodecs\tvectors\tcodes\tmismatches"));
    assert_eq!(record.lines().count(), 3);
    assert!(record.lines().nth(2).unwrap().ends_with("\t7"));
}
