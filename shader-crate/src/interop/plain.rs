//! The plain encoders of the originals, in their precision and their order of operations: from a usable direction to the
//! numbers of a point.

use glam::Vec3;

/// A plain encoder: from a direction and the number of bits.
pub(super) type Plain = fn(Vec3, u32) -> [i32; 2];

/// The original's x and y, folded where `below`: in 1 - |y| and 1 - |x|, with -0 as positive.
macro_rules! folded {
    ($x:expr, $y:expr, $below:expr) => {{
        let (x, y) = ($x, $y);
        let sign = |t| if t >= 0.0 { 1.0 } else { -1.0 };
        if $below { ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y)) } else { (x, y) }
    }};
}

fn l1(v: Vec3) -> f32 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// The usual projection in f32, by three divisions.
fn projected(v: Vec3) -> (f32, f32) {
    let v = v / l1(v);
    folded!(v.x, v.y, v.z < 0.0)
}

/// `2^bits - 1`.
pub(super) fn most(bits: u32) -> f32 {
    ((1u32 << bits) - 1) as f32
}

/// CesiumGS/cesium 09a719b8, Core/AttributeCompression.js: float64, rounded half up.
pub(super) fn cesium(v: Vec3, bits: u32) -> [i32; 2] {
    let [x, y, z] = v.to_array().map(f64::from);
    let norm = x.abs() + y.abs() + z.abs();
    let (x, y) = folded!(x / norm, y / norm, z < 0.0);
    let number = |t: f64| ((t.clamp(-1.0, 1.0) * 0.5 + 0.5) * f64::from(most(bits)) + 0.5).floor() as i32;
    [number(x), number(y)]
}

/// godotengine/godot 0208728e, core/math/vector3.cpp and servers/rendering_server.cpp: f32, truncated.
pub(super) fn godot(v: Vec3, bits: u32) -> [i32; 2] {
    let (x, y) = projected(v);
    let number = |t: f32| ((t * 0.5 + 0.5) * most(bits)).clamp(0.0, most(bits)) as i32;
    [number(x), number(y)]
}

/// bevy_mesh 0.20.1, vertex.rs and mesh.rs: normalised first, f32, rounded half away from 0.
pub(super) fn bevy(v: Vec3, bits: u32) -> [i32; 2] {
    let (x, y) = projected(v * (1.0 / (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()));
    let number = |t: f32| (t.clamp(-1.0, 1.0) * most(bits - 1)).round() as i32;
    [number(x), number(y)]
}

/// Unreal Engine 5, NaniteBuilder's NaniteEncodeGeometryData.cpp: the best of the four corners of the cell, by a cosine in
/// f32 whose last two bits number the corners.
pub(super) fn nanite(v: Vec3, bits: u32) -> [i32; 2] {
    let (x, y) = projected(v);
    let (most, half) = (most(bits), 0.5 * most(bits));
    let [x, y] = [x, y].map(|t| (t * half + half) as i32);
    let score = |lane: u32| {
        let f = [x + (lane & 1) as i32, y + (lane >> 1) as i32].map(|i| i as f32 * (2.0 / most) - 1.0);
        let z = 1.0 - f[0].abs() - f[1].abs();
        let below = z.min(0.0);
        let [x, y] = f.map(|t| t + if t.is_sign_negative() { -below } else { below });
        let cosine = (x * v.x + y * v.y + z * v.z) / (x * x + y * y + z * z).sqrt();
        f32::from_bits(cosine.to_bits() & !3 | lane)
    };
    let best = (1..4).fold(0, |best, lane| if score(lane) > score(best) { lane } else { best });
    [x + (best & 1) as i32, y + (best >> 1) as i32].map(|i| i.clamp(0, most as i32))
}

/// Unity's HDRP, NormalBuffer.hlsl and Packing.hlsl (Graphics 0279aa47): z kept 1/1024 away from 0, then truncated after half
/// a step at most. Exact quotients stand in for the GPU's reciprocals.
pub(super) fn hdrp(v: Vec3, bits: u32) -> [i32; 2] {
    let v = v.normalize();
    let v = v.with_z(v.z.abs().max(1.0 / 1024.0).copysign(v.z));
    let v = v / l1(v).max(1e-6);
    let below = (-v.z).clamp(0.0, 1.0);
    let number = |t: f32| {
        let moved = t + if t >= 0.0 { below } else { -below };
        ((moved * 0.5 + 0.5).clamp(0.0, 1.0) * (most(bits) + 0.5)) as i32
    };
    [number(v.x), number(v.y)]
}

/// Unity's HDRP of 2017, Lit.hlsl: magnitudes of 10 bits, rounded by the render target, and signs.
pub(super) fn hdrp_2017(v: Vec3, bits: u32) -> [i32; 2] {
    let (x, y) = projected(v);
    let number = |t: f32| (t * most(bits - 1)).round_ties_even() as i32;
    [number(x), number(y)]
}

/// Blender Cycles, util/octahedral_normal.h of a branch (b9e87623): f32, rounded half away from 0.
pub(super) fn cycles(v: Vec3, bits: u32) -> [i32; 2] {
    let half = most(bits) * 0.5;
    let (x, y) = projected(v);
    [x, y].map(|t| (half + t * half).round() as i32)
}

/// Blender Cycles, util/types_normal.h (9b8810a3): an L1 norm 1e-6 larger, rounded half up; -0 is negative.
pub(super) fn cycles_packed(v: Vec3, bits: u32) -> [i32; 2] {
    let (inverse, half) = (1.0 / (l1(v) + 1e-6), most(bits) * 0.5);
    let (x, y) = (v.x * inverse, v.y * inverse);
    let wrapped = ((1.0 - y.abs()) * 1f32.copysign(x), (1.0 - x.abs()) * 1f32.copysign(y));
    let (x, y) = if v.z >= 0.0 { (x, y) } else { wrapped };
    [x, y].map(|t| (t * half + (half + 0.5)).clamp(0.0, most(bits)) as i32)
}

/// google/draco 47238930, normal_compression_utils.h: float64; x and y rounded half up, z the rest; the border's points
/// in one form.
pub(super) fn draco(v: Vec3, bits: u32) -> [i32; 2] {
    let [x, y, z] = v.to_array().map(f64::from);
    let middle = (1 << (bits - 1)) - 1;
    let norm = x.abs() + y.abs() + z.abs();
    let scale = 1.0 / norm;
    let [x, y, z] = if norm > 1e-6 { [x * scale, y * scale, z * scale] } else { [1.0, 0.0, 0.0] };
    let [x, mut y] = [x, y].map(|t| (t * f64::from(middle) + 0.5).floor() as i32);
    let mut rest = middle - x.abs() - y.abs();
    if rest < 0 {
        y += if y > 0 { rest } else { -rest };
        rest = 0;
    }
    let (z, last) = (if z < 0.0 { -rest } else { rest }, 2 * middle);
    let (s, t) = if x >= 0 {
        (y + middle, z + middle)
    } else {
        (if y < 0 { z.abs() } else { last - z.abs() }, if z < 0 { y.abs() } else { last - y.abs() })
    };
    let is_corner = |i: i32| i == 0 || i == last;
    match (s, t) {
        _ if is_corner(s) && is_corner(t) => [last, last],
        _ if s == 0 && t > middle || s == last && t < middle => [s, last - t],
        _ if t == last && s < middle || t == 0 && s > middle => [last - s, t],
        _ => [s, t],
    }
}

/// zeux/meshoptimizer b5b2c439, src/vertexfilter.cpp: f32 by a reciprocal, rounded half away from 0.
pub(super) fn meshopt(v: Vec3, bits: u32) -> [i32; 2] {
    let scale = 1.0 / l1(v);
    let (x, y) = folded!(v.x * scale, v.y * scale, v.z < 0.0);
    [x, y].map(|t| snorm(t, bits))
}

/// meshoptimizer's rounding of a component: half away from 0, by an f32 sum.
pub(super) fn snorm(t: f32, bits: u32) -> i32 {
    (t.clamp(-1.0, 1.0) * most(bits - 1) + if t >= 0.0 { 0.5 } else { -0.5 }) as i32
}

/// AcademySoftwareFoundation/openvdb 568538e9, math/QuantizedUnitVec.h: f32, truncated in the octant.
pub(super) fn openvdb(v: Vec3, _: u32) -> [i32; 2] {
    let a = v.abs();
    let scale = 126.0 / (a.x + a.y + a.z);
    let [x, y] = [a.x, a.y].map(|t| (t * scale) as i32);
    let (x, y) = if v.z < 0.0 { (126 - y, 126 - x) } else { (x, y) };
    let signed = |number: i32, c: f32| if c < 0.0 { -number } else { number };
    [signed(x, v.x), signed(y, v.y)]
}
