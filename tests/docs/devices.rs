//! The devices whose users sent what `unitvec conform --share` wrote, in `docs/data/devices/`.

use super::markdown_table;
use unitvec_run::conform::{Arithmetic, Shared};
use unitvec_tests::{files, repository};

fn devices() -> Vec<Shared> {
    let mut files = files(&repository().join("docs/data/devices"), &[".json"]);
    files.sort();
    files.iter().map(|file| serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()).collect()
}

pub fn table() -> String {
    let rows = devices().into_iter().map(|of| {
        let Arithmetic { quotient_ulp, root_ulp, flushes_denormals, .. } = of.arithmetic;
        let plain = of
            .plain
            .map_or_else(String::new, |plain| format!("{} / {}", plain.codes_differ, plain.elements_differ));
        format!(
            "{} | {:?} | {} | {} | {quotient_ulp:.1} | {root_ulp:.1} | {} | {} | {} | {} | {} | {} | {plain}",
            of.device,
            of.kind,
            of.driver,
            of.vulkan,
            if flushes_denormals { "flushed" } else { "kept" },
            match (of.agreed, of.glsl_compared) {
                (true, true) => "PASS",
                (true, false) => "PASS, of Rust and WGSL",
                (false, _) => "FAIL",
            },
            of.codecs,
            of.vectors,
            of.codes,
            of.mismatches,
        )
    });
    let titles = "device | kind | driver | Vulkan | quotients, ULP | roots, ULP | denormals | verdict | codecs | vectors encoded | codes decoded \
                  | mismatches | plain: codes / vectors";
    markdown_table(titles, rows)
}

/// The page's claim about denormals: devices that flush them pass, and devices that keep them.
#[test]
fn devices_agree_whether_they_flush_denormals_or_not() {
    for flushes in [false, true] {
        let mut alike = devices().into_iter().filter(|of| of.arithmetic.flushes_denormals == flushes);
        assert!(alike.any(|of| of.agreed && of.mismatches == 0), "{flushes}");
    }
}

/// The pages that say which GPUs have run it name each one that agreed.
#[test]
fn pages_name_the_gpus_that_ran() {
    let gpus: Vec<Shared> = devices()
        .into_iter()
        .filter(|of| of.kind != unitvec_vulkan::DeviceKind::Software && of.agreed)
        .collect();
    for page in ["README.md", "docs/agreement.md", "docs/conform-fails.md", "docs/devices.md"] {
        let text = std::fs::read_to_string(repository().join(page)).unwrap();
        for gpu in &gpus {
            assert!(text.contains(&gpu.device), "{page} does not name {}", gpu.device);
        }
    }
}
