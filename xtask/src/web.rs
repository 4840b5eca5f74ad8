//! The page of `web/`: one file, `target/web/index.html`, of the npm package's module and the shading texts, and its tests in
//! Chromium.

use crate::{cache, cargo, npm, repository, run as run_command, take};
use std::process::Command;

/// `cargo xtask web [--build] [--record]`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let mut others = arguments.to_vec();
    let [build_alone, record] = ["--build", "--record"].map(|option| take(&mut others, option));
    if let Some(unknown) = others.first() {
        return Err(format!("web takes no {unknown}"));
    }
    npm::run(&["--build".to_owned()])?;
    let (sources, folder) = (repository().join("web"), cache("web")?);
    npm::install(&sources)?;
    let (data, page) = (folder.join("data"), folder.join("index.html"));
    let write = ["run", "--quiet", "--package", "unitvec-choose", "--example", "page", "--"];
    run_command(cargo(&write).arg(&data))?;
    let node = |script: &str| {
        let mut node = Command::new("node");
        node.arg(script).current_dir(&sources).env("UNITVEC_PAGE", &page);
        node
    };
    run_command(node("build.mjs").arg(&data).arg(&page))?;
    println!("xtask: {}", page.display());
    let chromium = npm::chromium()?;
    if build_alone || chromium.is_empty() {
        return Ok(());
    }
    let variables = || chromium.iter().map(|(name, value)| (name, value));
    run_command(
        node("--test")
            .args(["--test-concurrency=1", "tests/glb.test.js", "tests/page.test.js"])
            .envs(variables()),
    )?;
    if record {
        run_command(node("tests/screenshots.mjs").arg(repository().join("docs/web")).envs(variables()))?;
    }
    Ok(())
}
