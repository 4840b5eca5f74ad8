//! The sphere or the hemisphere on an octahedron, unfolded into a square.

pub mod eaoct;
pub mod hemioct;
pub mod oct;
pub mod oct_wide;
pub mod soct;
