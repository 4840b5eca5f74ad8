//! The three components as they are, in few bits each.

pub mod best_fit;
pub mod float;
pub mod snorm;
pub mod unorm;
