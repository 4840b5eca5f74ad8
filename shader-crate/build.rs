//! Tells the crate whether it is compiled without optimisation: slices then go one vector at a time. Refuses to build
//! without square root and floor: in the crate itself, errors about the missing glam would hide the message.

fn main() {
    if ["STD", "LIBM"].iter().all(|feature| std::env::var_os(format!("CARGO_FEATURE_{feature}")).is_none()) {
        println!(
            "cargo::error=unitvec needs one of its features `std` and `libm`, for square root and floor"
        );
    }
    println!("cargo::rustc-check-cfg=cfg(unoptimised)");
    println!("cargo::rerun-if-changed=build.rs");
    // Cargo runs the script again where this changes.
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimised");
    }
}
