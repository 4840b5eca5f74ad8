//! The integration tests: they call what users call.

mod accuracy;
mod azimuthal;
mod best_fit;
mod c_abi;
mod caps;
mod cli;
mod client;
mod compare;
mod components;
#[cfg(feature = "glsl")]
mod conformance;
mod convert;
mod cube;
mod cylindrical;
mod digests;
mod docs;
mod eaoct;
mod exhaustive;
mod faults;
mod fib;
mod figures;
mod floats;
mod frame;
mod framing;
mod fuzz;
#[cfg(feature = "glsl")]
mod glsl;
mod harm;
mod hemioct;
mod hexcube;
mod house;
mod ico;
#[cfg(feature = "glsl")]
mod imprecise;
mod interop;
mod isa;
mod latlong;
mod lattices;
mod link;
mod list;
mod loss;
mod modules;
mod oct;
mod oct_wide;
mod parallel;
mod porting;
mod quat;
mod recommended;
#[cfg(feature = "glsl")]
mod render;
mod report;
mod rotation_formats;
#[cfg(feature = "glsl")]
mod shaders;
mod slices;
mod snap;
mod soct;
mod spherical;
mod streams;
mod suite;
mod terminal;
#[cfg(feature = "glsl")]
mod textbook;
mod texture;
mod trig;
mod unoptimised;
mod uoct;
mod vectors;
mod widths;
mod wrappers;
mod write;

/// Shown as ignored where the tests of the GLSL are not compiled.
#[cfg(not(feature = "glsl"))]
#[test]
#[ignore = "needs a GLSL compiler: `cargo xtask test`, or `cargo test --features unitvec-tests/glsl`"]
fn glsl_and_conformance() {
    panic!("built without a GLSL compiler: add --features unitvec-tests/glsl");
}
