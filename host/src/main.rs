//! The program `unitvec`.
fn main() {}
