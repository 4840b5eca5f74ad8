//! The codecs, a file for each family. `lib.rs` exports the families at the top of the crate.

/// Declares a family's functions for UNORM formats by its functions `project` and `unproject`, which are for SNORM formats.
/// With the family's type parameters, points have a third number: 1 for z < 0, else 0.
macro_rules! unorm_projection {
    () => {
        /// [`project`] with values on \[0, 1\], for a UNORM format, which cannot hold the middle exactly.
        #[must_use]
        #[inline(always)]
        pub fn project_unorm(v: Vec3) -> Vec2 {
            crate::arith::biased(project(v))
        }

        /// [`unproject`] of a point on \[0, 1\]<sup>2</sup>, as a UNORM format gives it.
        #[must_use]
        #[inline(always)]
        pub fn unproject_unorm(e: Vec2) -> Vec3 {
            unproject(crate::arith::unbiased(e))
        }
    };
    (<$($parameter:ident: $bound:ident),*>) => {
        /// [`project`] with u and v on \[0, 1\], for a UNORM format such as VK_FORMAT_A2B10G10R10_UNORM_PACK32, with the
        /// hemisphere in alpha.
        #[must_use]
        #[inline(always)]
        pub fn project_unorm<$($parameter: $bound),*>(v: Vec3) -> Vec3 {
            let e = project::<$($parameter),*>(v);
            crate::arith::biased(Vec2::new(e.x, e.y)).extend(e.z)
        }

        /// [`unproject`] for a point whose u and v are on \[0, 1\], as a UNORM format gives it.
        #[must_use]
        #[inline(always)]
        pub fn unproject_unorm<$($parameter: $bound),*>(e: Vec3) -> Vec3 {
            unproject::<$($parameter),*>(crate::arith::unbiased(Vec2::new(e.x, e.y)).extend(e.z))
        }
    };
}

pub mod angles;
pub mod components;
pub mod lattices;
pub mod octahedral;
pub mod projections;
