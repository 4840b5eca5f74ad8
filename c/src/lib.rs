//! The codecs of `unitvec` for C and C++. `include/unitvec.h` is made of this crate by cbindgen; the README says how to
//! build, install and link it.
//!
//! Functions of single vectors go by value and take any input: they cannot fail. Those of arrays give a [`Status`]. No panic
//! crosses the interface: functions that could unwind catch it.
//!
//! All that takes a pointer to the caller's memory, and so all `unsafe` code, is in `memory`.

mod codec;
mod codecs;
mod memory;
mod single;
mod status;

pub use codec::*;
pub use codecs::*;
pub use memory::*;
pub use single::{Frame, Vec3};
pub use status::*;
