//! The sphere on planes: on disks, on the faces of a cube, and in parallel to an axis.

pub mod azimuthal;
pub mod cube;
pub mod parallel;
