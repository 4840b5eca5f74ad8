//! The codecs, a file for each family. `lib.rs` exports the families at the top of the crate.

/// Declares a family's functions for UNORM formats by its functions `project` and `unproject`, which are for SNORM formats.
macro_rules! unorm_projection {
    () => {
        /// [`project`] with values on \[0, 1\], for a UNORM format, which cannot hold the middle exactly.
        #[inline(always)]
        pub fn project_unorm(v: Vec3) -> Vec2 {
            crate::arith::biased(project(v))
        }

        /// [`unproject`] of a point on \[0, 1\]<sup>2</sup>, as a UNORM format gives it.
        #[inline(always)]
        pub fn unproject_unorm(e: Vec2) -> Vec3 {
            unproject(crate::arith::unbiased(e))
        }
    };
}

pub mod angles;
pub mod components;
pub mod lattices;
pub mod octahedral;
pub mod projections;
