//! What counts as a direction: the one rule behind every codec's handling of bad input.

use glam::Vec3;

/// Least L1 norm that a direction is taken from: 2^-100.
///
/// Far enough above the denormals (under 2^-126) that whether a device flushes them to zero changes no code, and
/// far below anything that arithmetic on geometry leaves.
pub const MIN_NORM: f32 = f32::from_bits((127 - 100) << 23);

/// L1 norms from here on do not give a direction: 2^100. Below it `1 / norm` is a normal number.
pub const MAX_NORM: f32 = f32::from_bits((127 + 100) << 23);

/// `|x| + |y| + |z|`.
#[inline(always)]
pub fn l1_norm(v: Vec3) -> f32 {
    (v.x.abs() + v.y.abs()) + v.z.abs()
}

/// True where a vector of this L1 norm has a usable direction: [`MIN_NORM`] to [`MAX_NORM`]. False for zero,
/// infinity and NaN.
///
/// The comparison is one of integers, since a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
pub fn is_usable(l1_norm: f32) -> bool {
    l1_norm.to_bits().wrapping_sub(MIN_NORM.to_bits()) < MAX_NORM.to_bits() - MIN_NORM.to_bits()
}

/// The power of two that brings a usable L1 norm to 1 to 2, exactly. Of other norms, anything.
#[inline(always)]
pub(crate) fn scale_to_one(l1_norm: f32) -> f32 {
    f32::from_bits((254u32 << 23).wrapping_sub(l1_norm.to_bits() & 0x7f80_0000))
}

/// `v` and its L1 norm, or +Z and 1 where `v` has no usable direction.
#[inline(always)]
pub fn or_z(v: Vec3) -> (Vec3, f32) {
    let norm = l1_norm(v);
    if is_usable(norm) { (v, norm) } else { (Vec3::Z, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_of_the_usable_norms() {
        assert_eq!(MIN_NORM, 2f32.powi(-100));
        assert_eq!(MAX_NORM, 2f32.powi(100));
        assert!(is_usable(MIN_NORM));
        assert!(!is_usable(MIN_NORM.next_down()));
        assert!(is_usable(MAX_NORM.next_down()));
        assert!(!is_usable(MAX_NORM));
    }

    #[test]
    fn vectors_without_a_direction_become_z() {
        let odd = [0.0, -0.0, 1e-40, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN, f32::MAX];
        for a in odd {
            for b in odd {
                for c in odd {
                    assert_eq!(or_z(Vec3::new(a, b, c)), (Vec3::Z, 1.0), "{a} {b} {c}");
                }
            }
        }
    }
}
