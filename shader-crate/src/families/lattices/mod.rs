//! Points that are spread evenly over the sphere: the number of a point is the code.

pub mod fib;
pub mod hexcube;
pub mod ico;
