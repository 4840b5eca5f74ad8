//! The codecs of `unitvec` for C and C++. `include/unitvec.h` is generated from this crate by cbindgen; the README says
//! how to build, install and link it.
//!
//! Functions for single vectors pass values and accept any input: they cannot fail. Functions for arrays return a
//! [`Status`]. No panic crosses the interface: functions that could unwind catch it.
//!
//! All functions that take pointers to the caller's memory, and so all `unsafe` code, are in `memory`.

mod codec;
mod codecs;
mod elements;
mod memory;
mod single;
mod status;

pub use codec::*;
pub use elements::{Elements, UNITVEC_FLOAT32, UNITVEC_FLOAT64};
pub use memory::*;
pub use single::{Frame, Quat, Vec3};
pub use status::*;
