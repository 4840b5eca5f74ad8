//! Tests of the commands, and helpers of the modules' tests.

use std::fs;
use std::path::PathBuf;

/// Arguments of a command line.
pub fn strings(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

/// An empty folder for a test.
pub fn folder(test: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("unitvec-xtask-{}-{test}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Where Debian's packages are not installed, `conform` goes on with what there is.
#[test]
fn conform_goes_without_what_is_missing() {
    let lavapipe = |_: &[&str]| Ok("* 0: llvmpipe".to_owned());
    assert_eq!(crate::options(false, lavapipe), ["--validate", "--device", "lavapipe"]);
    assert_eq!(crate::options(true, lavapipe), ["--validate"]);
    let gpu = |validate: &[&str]| match validate {
        [] => Ok("* 0: Apple M4".to_owned()),
        _ => Err("the validation layer VK_LAYER_KHRONOS_validation is not installed".to_owned()),
    };
    assert!(crate::options(false, gpu).is_empty());
    let without_loader = |_: &[&str]| Err("no Vulkan device".to_owned());
    assert_eq!(crate::options(false, without_loader), ["--validate", "--device", "lavapipe"]);
}
