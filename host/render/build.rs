//! Has cargo embed the renderer's shaders again when one is added: the compiler sees only changes of those it knows.

fn main() {
    for folder in ["shaders/glsl", "shaders/spirv"] {
        println!("cargo::rerun-if-changed={folder}");
    }
}
