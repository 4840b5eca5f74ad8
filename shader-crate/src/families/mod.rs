//! The codecs, a file for each family. `lib.rs` exports the families at the top of the crate.

pub mod angles;
pub mod components;
pub mod lattices;
pub mod octahedral;
pub mod projections;
