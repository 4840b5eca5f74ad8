//! The tangent frames against the papers: [`unitvec_oracle::frame`].

use super::*;
use std::f64::consts::{FRAC_PI_2, PI};
use unitvec::{Codec, FrameCodec, OctPrecise22};
use unitvec_oracle::frame::tangent_bound;
use unitvec_oracle::{Summary, cross};
use unitvec_tests::directions::{near_planes, sphere};

for_both! {
    decodes_as_the_oracle errors_keep_to_the_bounds encodes_as_the_oracle angles_wrap tangents_are_projected
}

mod check {
    use super::*;

    /// All 2^22 normals of frame32 and 2^20 of frame64, each with some angle, 512 angles with 1144 normals (those on and
    /// near axes, poles and the equator too), and 2^20 random codes decode as the oracle has it, to unit length to 2 ULP,
    /// perpendicular to 4.
    pub fn decodes_as_the_oracle<F: Checked>() {
        let (mut worst, mut worst_turn) = ([0.0; 2], 0f64);
        for code in codes::<F>(1) {
            let (decoded, expected) = (decode::<F>(code), F::FORMAT.decode(code));
            assert_frame(decoded, code, &mut worst);
            let [normal, tangent] = [(decoded.normal, expected.normal), (decoded.tangent, expected.tangent)]
                .map(|(a, b)| angle_deg(widen(a), b).to_radians());
            assert!(
                normal <= DECODE_NORMAL && tangent <= DECODE_TANGENT,
                "{code:#x}: {decoded:?} for {expected:?}: {normal:e} {tangent:e}"
            );
            assert_eq!(f64::from(decoded.handedness), expected.handedness, "{code:#x}");
            worst_turn = worst_turn.max(tangent);
        }
        let [cosine, off] = worst.map(|t| t / f64::from(f32::EPSILON));
        println!(
            "{} decode: tangent {:.3} of 2^-21, |n.t| {cosine:.3} ULP, length {off:.3} ULP",
            F::NAME,
            worst_turn / DECODE_TANGENT
        );
    }

    /// Over 10^6 random frames the errors keep to the bounds, and come to 90 % of them.
    pub fn errors_keep_to_the_bounds<F: Checked>() {
        let all: Vec<[f64; 2]> = frames(3, sphere(4, 1_000_000)).map(errors::<F>).collect();
        let [normal, tangent] = [0, 1].map(|i| Summary::of(all.iter().map(|e| e[i].to_degrees())));
        let bounds = [F::MAX_NORMAL_ERROR_DEG, F::MAX_TANGENT_ERROR_DEG].map(f64::from);
        for (of, errors, bound) in [("normal", normal, bounds[0]), ("tangent", tangent, bounds[1])] {
            let Summary { mean, max } = errors;
            println!("{} {of}: mean {mean:.6e} max {max:.6e} bound {bound:.6e}", F::NAME);
            assert!(max <= bound && max >= 0.9 * bound, "{} {of}: {errors:?} for {bound}", F::NAME);
        }

        // The bound of the tangent's error is the sum of the two parts', and not much more.
        let step = TAU / (1u64 << F::FORMAT.angle_bits) as f64;
        let exact = tangent_bound(bounds[0].to_radians(), 0.5 * step * 1.0026).to_degrees();
        assert!(bounds[1] >= exact && bounds[1] <= 1.1 * exact, "{}: {bounds:?} for {exact}", F::NAME);
    }

    /// 2 * 10^5 frames of all kinds get the nearest code of the normal and of the angle about it, but for rounding.
    pub fn encodes_as_the_oracle<F: Checked>() {
        let half_step = PI / (1u64 << F::FORMAT.angle_bits) as f64;
        let mut excess = [f64::NEG_INFINITY; 2];
        for frame in frames(5, sphere(6, 100_000).chain(near_planes(7, 100_000))) {
            let code = number::<F>(frame);
            let exact = widen(frame.normal);
            let normal = code % (1 << F::FORMAT.normal_bits);
            let decoded = F::FORMAT.normal(normal);
            let [ours, least] = [decoded, F::FORMAT.normal(F::FORMAT.nearest_normal(exact))]
                .map(|n| angle_deg(exact, n).to_radians());
            excess[0] = excess[0].max((ours - least) / F::NORMAL_SLACK);
            assert!(ours - least <= F::NORMAL_SLACK, "{frame:?}: {code:#x} {ours:e} {least:e}");

            // The angle is about the decoded normal, whichever it is.
            let angle = frame::angle_of(decoded, widen(frame.tangent));
            let place = (code >> F::FORMAT.normal_bits) % (1 << F::FORMAT.angle_bits);
            let [ours, least] = [place, F::FORMAT.nearest_angle(angle)].map(|code| {
                let off = (F::FORMAT.angle(code) - angle).rem_euclid(TAU);
                off.min(TAU - off)
            });
            let slack = 2.0 * (half_step * F::ANGLE_SLACK + ENCODE_TANGENT);
            excess[1] = excess[1].max((ours - least) / slack);
            assert!(ours - least <= slack, "{frame:?}: {code:#x} {ours:e} {least:e}");
        }
        println!("{} encode over nearest, of what rounding may: {excess:.3?}", F::NAME);
    }

    /// The angle wraps: tangents next to the basis's first vector, on both sides, are as near to their codes as others.
    pub fn angles_wrap<F: Checked>() {
        let bound = f64::from(F::MAX_TANGENT_ERROR_DEG).to_radians();
        let step = TAU / (1u64 << F::FORMAT.angle_bits) as f64;
        let mut rng = Rng::new(8);
        for normal in sphere(9, 100_000) {
            let n = F::FORMAT.normal(F::FORMAT.nearest_normal(widen(normal)));
            let angle = FRAC_PI_2 * (rng.bits() % 4) as f64 + rng.range(-step, step);
            let [normal, tangent] =
                [n, frame::at_angle(n, angle)].map(|v| Vec3::from_array(v.map(|t| t as f32)));
            let off = errors::<F>(Frame { normal, tangent, handedness: 1.0 });
            assert!(off[1] <= bound, "{normal:?} {angle}: {off:?}");
        }
    }

    /// Tangents that are not perpendicular count as their part that is perpendicular to the decoded normal.
    pub fn tangents_are_projected<F: Checked>() {
        let (slack, mut rng) = (2.0 * ENCODE_TANGENT, Rng::new(12));
        let half_step = PI / (1u64 << F::FORMAT.angle_bits) as f64 * 1.0026 * (1.0 + F::ANGLE_SLACK);
        for frame in frames(13, sphere(14, 200_000)) {
            let tangent = frame.tangent + frame.normal * rng.range(-1.0, 1.0) as f32;
            let decoded = F::decode(F::encode(Frame { tangent, ..frame }));
            let n = normalize(widen(decoded.normal));
            let error =
                angle_deg(frame::perpendicular(n, widen(tangent)), widen(decoded.tangent)).to_radians();
            assert!(error <= half_step + slack, "{frame:?} {error:e}");
        }
    }
}

/// The normal of frame32 is oct22p's: its code is the low 22 bits, and the high ones do not count.
#[test]
fn normals_of_frame32_are_oct22p() {
    for frame in frames(20, sphere(21, 100_000)) {
        let code = Frame32::encode(frame);
        assert_eq!(code & 0x3f_ffff, OctPrecise22::encode(frame.normal));
        assert_eq!(Frame32::decode(code).normal, OctPrecise22::decode_vec3(code));
    }
}

/// The third axis has unit length, is perpendicular to the others, and lies on the side that the handedness gives.
#[test]
fn bitangents_complete_the_frame() {
    for frame in frames(22, sphere(23, 100_000)) {
        let decoded = Frame32::decode(Frame32::encode(frame));
        let [n, t, b] = [decoded.normal, decoded.tangent, decoded.bitangent()].map(widen);
        assert!((length(b) - 1.0).abs() < 1e-6 && dot(b, n).abs() < 1e-6 && dot(b, t).abs() < 1e-6);
        assert!((dot(cross(n, t), b) * f64::from(frame.handedness) - 1.0).abs() < 1e-6);
    }
}
