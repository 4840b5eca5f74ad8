//! A surface's colours under a procedural sky. The world's up is +Y; colours are linear. `shading.glsl` has the same
//! functions.
//!
//! Cheap values are computed on both sides of a condition and one is chosen, as a GPU's lanes do it: rust-gpu makes
//! long work of early returns and of `&&`.

use unitvec::arith::{dot, floor, max, min, normalize, whole_to_u32};
use unitvec::glam::Vec3;

const SUN_DIRECTION: Vec3 = Vec3::new(0.48, 0.6, 0.64);
/// The cosine of the disc's radius, 2.5 degrees: some ten times the real one's, to be seen in reflections.
const SUN_COSINE: f32 = 0.99905;
const SUN_COLOUR: Vec3 = Vec3::new(24.0, 22.0, 18.0);
/// The light that falls on a surface facing the sun, over pi.
const SUN_LIGHT: Vec3 = Vec3::new(1.1, 1.0, 0.85);

/// The sky above the horizon, and its increase at the zenith.
const HORIZON: Vec3 = Vec3::new(0.72, 0.82, 0.92);
const TO_ZENITH: Vec3 = Vec3::new(-0.6, -0.54, -0.26);
/// Light from all around on a surface that faces the ground, and its increase where the surface faces the zenith.
const LIGHT_FROM_BELOW: Vec3 = Vec3::new(0.09, 0.08, 0.06);
const LIGHT_TO_ZENITH: Vec3 = Vec3::new(0.13, 0.2, 0.32);
const GROUND: Vec3 = Vec3::new(0.22, 0.19, 0.16);
const LAMP: Vec3 = Vec3::new(5.0, 5.0, 4.8);

/// Materials; 0 is Lambertian.
const GLOSSY: u32 = 1;
const MIRROR: u32 = 2;
const GGX: u32 = 3;

fn fraction(x: f32) -> f32 {
    x - floor(x)
}

/// Well-mixed bits of a small number.
fn mixed(n: u32) -> u32 {
    let h = n.wrapping_mul(0x9e37_79b9);
    let h = (h ^ (h >> 15)).wrapping_mul(0x85eb_ca6b);
    h ^ (h >> 13)
}

/// A plain of tiles, a unit below the eye. Their contrast fades towards the horizon, where they are less than a pixel.
fn ground(d: Vec3) -> Vec3 {
    let depth = max(-d.y, 0.01);
    let (x, z) = (floor(d.x / depth), floor(d.z / depth));
    let is_dark = 2.0 * fraction((x + z) * 0.5);
    let contrast = min(2.0 * depth, 0.7);
    GROUND * (1.0 - contrast * is_dark)
}

/// Lamps in a row, a unit above the eye: bars that a curved surface bends.
fn is_lamp(d: Vec3) -> bool {
    let height = max(d.y, 0.5);
    let (x, z) = (d.x / height, d.z / height);
    (x.abs() < 0.75) & (z.abs() < 0.75) & (fraction(x * 4.0) < 0.3)
}

fn clear_sky(d: Vec3) -> Vec3 {
    let below = 1.0 - d.y;
    let air = HORIZON + TO_ZENITH * (1.0 - below * below);
    let lit = if is_lamp(d) { LAMP } else { air };
    if dot(d, SUN_DIRECTION) > SUN_COSINE { SUN_COLOUR } else { lit }
}

/// A town all around, on the four sides of a square: 16 buildings a side, of two columns of windows.
#[derive(Clone, Copy)]
struct Town {
    /// The direction's height above the ground, a side being 2 wide, and the height of the building there.
    height: f32,
    roof: f32,
    /// The place in a window with its frame, 0 to 1 each way, and bits that each window has of its own.
    place: [f32; 2],
    bits: u32,
}

fn town(d: Vec3) -> Town {
    let on_x = d.x.abs() > d.z.abs();
    // Directions that are nearly upright see no building; any distance will do for them.
    let distance = max(max(d.x.abs(), d.z.abs()), 0.01);
    let along = (if on_x { d.z } else { d.x }) / distance;
    let height = d.y / distance;
    let is_behind = (if on_x { d.x } else { d.z }) < 0.0;
    let side = (if on_x { 1 } else { 0 }) + if is_behind { 2 } else { 0 };
    let window_x = (along + 1.0) * 16.0;
    let window_y = min(max(height, 0.0), 1.0) * 18.0;
    let column = whole_to_u32(floor(window_x));
    let building = mixed((column >> 1) + 64 * side);
    let roof = (building >> 27) as f32 * 0.008 + 0.06;
    let bits = mixed(column + 64 * side + 1024 * whole_to_u32(floor(window_y)));
    Town { height, roof, place: [fraction(window_x), fraction(window_y)], bits }
}

/// Walls, and windows, a quarter of them lit.
fn facade(t: Town) -> Vec3 {
    let [x, y] = t.place;
    let is_wall = (x < 0.25) | (x > 0.75) | (y < 0.3) | (y > 0.8);
    let window = if t.bits & 3 == 0 { Vec3::new(1.6, 1.2, 0.7) } else { Vec3::new(0.03, 0.04, 0.06) };
    if is_wall { Vec3::new(0.16, 0.13, 0.12) } else { window }
}

/// The sky's colour in the direction `d`, a unit vector.
fn sky(d: Vec3) -> Vec3 {
    let t = town(d);
    let above = if t.height < t.roof { facade(t) } else { clear_sky(d) };
    if d.y < 0.0 { ground(d) } else { above }
}

/// The colour of an object's surface.
fn albedo(object: f32) -> Vec3 {
    let [clay, water, sand, leaf, lacquer] = [
        Vec3::new(0.72, 0.45, 0.32),
        Vec3::new(0.28, 0.52, 0.62),
        Vec3::new(0.66, 0.58, 0.3),
        Vec3::new(0.42, 0.58, 0.36),
        Vec3::new(0.62, 0.12, 0.12),
    ];
    let last = if object < 4.5 { leaf } else { lacquer };
    let first = if object < 1.5 { clay } else { water };
    let third = if object < 3.5 { sand } else { last };
    if object < 2.5 { first } else { third }
}

/// The cosine of an angle, 0 beyond the right angle.
fn facing(a: Vec3, b: Vec3) -> f32 {
    max(dot(a, b), 0.0)
}

/// Sunlight and light from sky and ground, as a smooth surface without a direction of its own sends it back.
fn diffuse(n: Vec3) -> Vec3 {
    let above = n.y * 0.5 + 0.5;
    let from_around = LIGHT_FROM_BELOW + LIGHT_TO_ZENITH * above;
    SUN_LIGHT * facing(n, SUN_DIRECTION) + from_around
}

fn square(x: f32) -> f32 {
    x * x
}

/// `x^256`. Values below 0.75 count as 0.75, 2^-106: some devices flush denormal powers.
fn power_256(x: f32) -> f32 {
    let power_16 = square(square(square(square(max(x, 0.75)))));
    square(square(square(square(power_16))))
}

/// Normalised Blinn-Phong with the exponent 256: `(e + 8) / 8`, since [`SUN_LIGHT`] is over pi.
fn blinn_phong(cosine: f32) -> f32 {
    33.0 * power_256(cosine)
}

/// GGX (Walter et al. 2007, eq. 33) with a roughness of 0.3, `a = roughness^2`: `pi D / 4`, which is
/// `1 / (4 a^2 q^2)`, where `q = 1 + k (1 - cos^2)` and `k = 1 / a^2 - 1`.
fn ggx(cosine: f32) -> f32 {
    let q = 122.46 * (1.0 - square(cosine)) + 1.0;
    30.86 / square(q)
}

/// A highlight on a surface that is matt below.
fn glossy(matt: Vec3, material: u32, n: Vec3, ray: Vec3) -> Vec3 {
    let cosine = facing(n, normalize(SUN_DIRECTION - ray));
    let highlight = if material == GGX { ggx(cosine) } else { blinn_phong(cosine) };
    let specular = 0.05 * (highlight * facing(n, SUN_DIRECTION));
    matt * 0.35 + SUN_LIGHT * specular
}

/// `r = d - 2 (d . n) n`
fn mirrored(ray: Vec3, n: Vec3) -> Vec3 {
    normalize(ray - n * (2.0 * dot(ray, n)))
}

/// The colour seen along a ray that hits an object's surface with the normal `n`, or nothing, object 0; both vectors
/// have unit length.
pub fn seen(material: u32, object: f32, n: Vec3, ray: Vec3) -> Vec3 {
    let is_sky = object < 0.5;
    // The sky is computed in one place, since compilers repeat it wherever it is called.
    let around = sky(if is_sky { ray } else { mirrored(ray, n) });
    let matt = albedo(object) * diffuse(n);
    let is_glossy = (material == GLOSSY) | (material == GGX);
    let lit = if is_glossy { glossy(matt, material, n, ray) } else { matt };
    if is_sky | (material == MIRROR) { around } else { lit }
}
