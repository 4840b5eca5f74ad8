//! Tells the crate whether it is compiled without optimisation: slices then go one vector at a time. Refuses to build
//! without square root and floor: in the crate itself, errors about the missing glam would hide the message.

fn main() {
    if ["STD", "LIBM"].iter().all(|feature| std::env::var_os(format!("CARGO_FEATURE_{feature}")).is_none()) {
        println!(
            "cargo::error=unitvec needs one of its features `std` and `libm`, for square root and floor"
        );
    }
    println!("cargo::rustc-check-cfg=cfg(unoptimised, avx512)");
    println!("cargo::rerun-if-changed=build.rs");
    // Cargo runs the script again where this changes.
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimised");
    }
    let is_x86_64 = std::env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "x86_64");
    if is_x86_64 && std::env::var_os("CARGO_FEATURE_AVX512").is_some() && has_avx512() {
        println!("cargo::rustc-cfg=avx512");
    }
}

/// True for compilers with the target features of AVX-512: from Rust 1.89 on.
fn has_avx512() -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = std::process::Command::new(rustc).arg("--version").output();
    let version =
        version.map(|output| String::from_utf8_lossy(&output.stdout).into_owned()).unwrap_or_default();
    let minor = version.split('.').nth(1).and_then(|minor| minor.parse::<u32>().ok());
    minor.is_some_and(|minor| minor >= 89)
}
