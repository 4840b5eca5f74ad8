//! Builds without optimisation.

use std::process::Command;
use unitvec_tests::repository;

/// `unitvec` compiled without optimisation calls a codec once for each vector of a slice: its unit test checks this,
/// which only such a build has.
#[test]
fn slices_go_one_vector_at_a_time() {
    let output = Command::new(env!("CARGO"))
        .args([
            "test",
            "--package",
            "unitvec",
            "--lib",
            "--config",
            "profile.dev.package.unitvec.opt-level=0",
        ])
        .args(["--", "--exact", "slice::tests::unoptimised_is_one_at_a_time"])
        .current_dir(repository())
        .output()
        .unwrap();
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success() && stdout.contains("1 passed"), "{stdout}\n{stderr}");
}
