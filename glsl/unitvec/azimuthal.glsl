// unitvec: azimuthal codes of 16, 20, 22, 24 and 32 bits: a hemisphere on a disk by a map projection, the disk on a
// square or as it is, and one bit for the hemisphere.
//
// Source: Cigolle et al. 2014, section 2; Snyder 1987; Shirley and Chiu 1997; the ellipse map is the elliptical grid
// map.
//
//   stereo16_encode(v), stereo16_decode(code)      stereographic; also eqarea (Lambert), eqdist (equidistant)
//   stereo_concentric16_encode(v), ...             the disk on the square by Shirley and Chiu's map
//   stereo_ellipse16_encode(v), ...                the disk on the square by the ellipse map
//   float32x3_to_stereo(v), stereo_to_float32x3(e)       u and v on [-1, 1], and 1 for z < 0, else 0; so for all nine
//   float32x3_to_stereo_unorm(v), stereo_unorm_to_float32x3(e)    the same with u and v on [0, 1]
//
// Each with 16, 20, 22, 24 and 32. Any v will do: length does not matter, and +Z stands in for vectors without a
// direction. Layout: u, snorm of half the bits in two's complement, lowest; v, one bit less, n, in steps of 2^-(n-1),
// above it; the hemisphere (1 for z < 0) highest. Both ends of v have the pattern of -2^(n-1): there, on the equator,
// the highest bit says which, 1 for +1. The docs of the Rust crate's module `azimuthal`, whose every operation these
// functions repeat, give the reasons.

#ifndef UNITVEC_AZIMUTHAL_GLSL
#define UNITVEC_AZIMUTHAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The projections, and the maps of the disk to the square.
const int UNITVEC_STEREO = 0;
const int UNITVEC_EQAREA = 1;
const int UNITVEC_EQDIST = 2;
const int UNITVEC_PLAIN = 0;
const int UNITVEC_CONCENTRIC = 1;
const int UNITVEC_ELLIPSE = 2;

// a / b of each component.
vec2 unitvec_signed_quotients(vec2 a, vec2 b) {
    return vec2(unitvec_signed_quotient(a.x, b.x), unitvec_signed_quotient(a.y, b.y));
}

// A point of the unit disk is (x, y, radius, rim) with x, y >= 0 and rim = 1 - radius^2; `*_to_square` take it so,
// `*_to_disk` of a square map leave the radius 0.

// Disk point of v, whose components are not negative and have the sum 1.
vec4 unitvec_stereo_to_disk(vec3 v) {
    UNITVEC_PRECISE float sum = unitvec_root(unitvec_dot(v, v)) + v.z;
    float scale = unitvec_reciprocal(sum);
    UNITVEC_PRECISE vec2 at = v.xy * scale;
    UNITVEC_PRECISE float radius = unitvec_horizontal_length(v) * scale;
    UNITVEC_PRECISE float rim = 2.0 * v.z * scale;
    return vec4(at, radius, rim);
}

vec3 unitvec_disk_to_stereo(vec2 at, float rim) {
    UNITVEC_PRECISE float half_rim = 0.5 * rim;
    UNITVEC_PRECISE float half_sum = 1.0 - half_rim;
    return vec3(unitvec_signed_quotients(at, vec2(half_sum)), unitvec_signed_quotient(half_rim, half_sum));
}

vec4 unitvec_eqarea_to_disk(vec3 v) {
    float norm = unitvec_root(unitvec_dot(v, v));
    UNITVEC_PRECISE float product = norm * (norm + v.z);
    float scale = unitvec_inverse_root(product);
    UNITVEC_PRECISE vec2 at = v.xy * scale;
    UNITVEC_PRECISE float radius = unitvec_horizontal_length(v) * scale;
    float rim = unitvec_signed_quotient(v.z, norm);
    return vec4(at, radius, rim);
}

vec3 unitvec_disk_to_eqarea(vec2 at, float rim) {
    UNITVEC_PRECISE float square = 1.0 + rim;
    float scale = unitvec_root(square);
    UNITVEC_PRECISE vec2 horizontal = at * scale;
    return vec3(horizontal, rim);
}

// The smaller of radius and 1 - radius is found first, so that both have a small relative error.
vec4 unitvec_eqdist_to_disk(vec3 v) {
    float rho = unitvec_horizontal_length(v);
    bool low = rho > v.z;
    float shorter = low ? v.z : rho;
    float longer = low ? rho : v.z;
    UNITVEC_PRECISE float part = 0.5 * unitvec_atan_octant_ratio(shorter, longer);
    UNITVEC_PRECISE float rest = 1.0 - part;
    float radius = low ? rest : part;
    float inside = low ? part : rest;
    float quotient = unitvec_quotient(radius, rho);
    float scale = rho > UNITVEC_NEGLIGIBLE ? quotient : 0.0;
    UNITVEC_PRECISE vec2 at = v.xy * scale;
    UNITVEC_PRECISE float rim = inside * (1.0 + radius);
    return vec4(at, radius, rim);
}

// Minimax polynomials of sin(pi r / 2) / r in c = 1 - r^2 and of cos(pi r / 2) / (1 - r^2) in w = r^2.
const float UNITVEC_SINC_0 = 0.49999976;
const float UNITVEC_SINC_1 = 0.066577174;
const float UNITVEC_SINC_2 = 0.0040679215;
const float UNITVEC_SINC_3 = 0.00015146394;

const float UNITVEC_COSC_0 = -0.23370051;
const float UNITVEC_COSC_1 = 0.019968653;
const float UNITVEC_COSC_2 = -0.0008935995;
const float UNITVEC_COSC_3 = 2.3629505e-5;

vec3 unitvec_disk_to_eqdist(vec2 at, float c) {
    UNITVEC_PRECISE float scale =
        1.0 + c * (UNITVEC_SINC_0 + c * (UNITVEC_SINC_1 + c * (UNITVEC_SINC_2 + c * UNITVEC_SINC_3)));
    UNITVEC_PRECISE float w = 1.0 - c;
    UNITVEC_PRECISE float low = UNITVEC_COSC_0 + w * (UNITVEC_COSC_1 + w * (UNITVEC_COSC_2 + w * UNITVEC_COSC_3));
    UNITVEC_PRECISE float z = c + c * (w * low);
    UNITVEC_PRECISE vec2 horizontal = at * scale;
    return vec3(horizontal, z);
}

// The most that lattice points beyond the rim are moved, in steps.
const float UNITVEC_AZIMUTHAL_REACH = 0.484375;

// Largest integers of u and v at `bits` bits.
vec2 unitvec_azimuthal_largest(uint bits) {
    return vec2(unitvec_snorm_max(bits / 2u), float(1u << (bits / 2u - 2u)));
}

// e over these largest integers, without a division, so that all devices agree on which points are inside the disk.
// Correctly rounded for whole e.
vec2 unitvec_azimuthal_parts(vec2 e, uint bits) {
    UNITVEC_PRECISE float v = e.y * unitvec_exp2(2 - int(bits / 2u));
    return vec2(unitvec_snorm_part(e.x, bits / 2u), v);
}

// p over the largest integers, rounded as the device divides; v's is a power of two.
vec2 unitvec_azimuthal_over_largest(vec2 p, uint bits) {
    UNITVEC_PRECISE float v = p.y * unitvec_exp2(2 - int(bits / 2u));
    return vec2(unitvec_signed_quotient(p.x, unitvec_azimuthal_largest(bits).x), v);
}

// True for lattice points e with cells of which the disk covers nothing, or next to nothing.
bool unitvec_plain_is_remote(vec2 e, uint bits) {
    UNITVEC_PRECISE vec2 nearest = e - UNITVEC_AZIMUTHAL_REACH;
    vec2 corner = unitvec_azimuthal_parts(nearest, bits);
    UNITVEC_PRECISE float square = corner.x * corner.x + corner.y * corner.y;
    return square > 1.0;
}

// Lattice point to write for the one that rounding gave: a remote one goes a step inward.
vec2 unitvec_plain_settle(vec2 e, uint bits) {
    vec2 slope = unitvec_azimuthal_over_largest(unitvec_azimuthal_parts(e, bits), bits);
    bool along_u = slope.x > slope.y;
    bool remote = unitvec_plain_is_remote(e, bits);
    UNITVEC_PRECISE vec2 settled = e - vec2(remote && along_u ? 1.0 : 0.0, remote && !along_u ? 1.0 : 0.0);
    return settled;
}

// Point on the rim for p beyond it, where excess is (|p|^2 - 1) / 2: within p's cell. Others stay.
vec2 unitvec_plain_move_to_rim(vec2 p, float excess, uint bits) {
    vec2 slope = unitvec_azimuthal_over_largest(p, bits);
    bool along_u = slope.x > slope.y;
    float steep = along_u ? slope.x : slope.y;
    float gentle = along_u ? slope.y : slope.x;
    float alone = unitvec_signed_quotient(excess, steep);
    UNITVEC_PRECISE float left = excess - UNITVEC_AZIMUTHAL_REACH * steep;
    float remainder = unitvec_signed_quotient(left, gentle);
    bool beyond = excess >= 0.0;
    float first = beyond ? min(alone, UNITVEC_AZIMUTHAL_REACH) : 0.0;
    float second = beyond && alone >= UNITVEC_AZIMUTHAL_REACH ? remainder : 0.0;
    vec2 moved = along_u ? vec2(first, second) : vec2(second, first);
    UNITVEC_PRECISE vec2 on_rim = p - unitvec_azimuthal_over_largest(moved, bits);
    return on_rim;
}

// Disk point of a lattice point of the disk as it is; remote points become the nearer axis.
vec4 unitvec_plain_to_disk(vec2 e, uint bits) {
    vec2 p = unitvec_azimuthal_parts(e, bits);
    UNITVEC_PRECISE float rim = 1.0 - (p.x * p.x + p.y * p.y);
    UNITVEC_PRECISE float excess = -0.5 * rim;
    vec2 moved = unitvec_plain_move_to_rim(p, excess, bits);
    vec2 axis = p.x > p.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 at = unitvec_plain_is_remote(e, bits) ? axis : moved;
    UNITVEC_PRECISE float rest = 1.0 - (at.x * at.x + at.y * at.y);
    return vec4(at, 0.0, rim > 0.0 ? rest : min(rest, 0.0));
}

// Disk point of a point on the square of the disk as it is; points beyond the rim are moved to it.
vec4 unitvec_plain_square_to_disk(vec2 s) {
    UNITVEC_PRECISE float square = s.x * s.x + s.y * s.y;
    UNITVEC_PRECISE vec2 on_rim = s * unitvec_inverse_root(square);
    UNITVEC_PRECISE float rim = 1.0 - square;
    return square < 1.0 ? vec4(s, 0.0, rim) : vec4(on_rim, 0.0, 0.0);
}

vec2 unitvec_concentric_to_square(vec4 disk) {
    bool steep = disk.y > disk.x;
    float shorter = steep ? disk.x : disk.y;
    float longer = steep ? disk.y : disk.x;
    UNITVEC_PRECISE float across = disk.z * unitvec_atan_octant_ratio(shorter, longer);
    return steep ? vec2(across, disk.z) : vec2(disk.z, across);
}

vec4 unitvec_concentric_to_disk(vec2 s) {
    bool steep = s.y > s.x;
    float shorter = steep ? s.x : s.y;
    float radius = steep ? s.y : s.x;
    float quotient = unitvec_quotient(shorter, radius);
    float octant = radius > 0.0 ? quotient : 0.0;
    UNITVEC_PRECISE float angle = 0.25 * octant;
    UNITVEC_PRECISE vec2 p = radius * unitvec_sin_cos_half_turns(angle);
    UNITVEC_PRECISE float rim = 1.0 - radius * radius;
    return vec4(steep ? p.yx : p, 0.0, rim);
}

// s^2 = 4 x^2 / (2 + d + root), t^2 = 4 y^2 / (2 - d + root), d = x^2 - y^2, root^2 = d^2 + 4 rim: nothing cancels.
vec2 unitvec_ellipse_to_square(vec4 disk) {
    UNITVEC_PRECISE float difference = (disk.x - disk.y) * (disk.x + disk.y);
    UNITVEC_PRECISE float square = difference * difference + 4.0 * disk.w;
    UNITVEC_PRECISE float sum = 2.0 + unitvec_root(square);
    UNITVEC_PRECISE vec2 squares = vec2(sum + difference, sum - difference);
    UNITVEC_PRECISE vec2 doubled = 2.0 * disk.xy;
    return unitvec_signed_quotients(doubled, vec2(unitvec_root(squares.x), unitvec_root(squares.y)));
}

vec4 unitvec_ellipse_to_disk(vec2 s) {
    UNITVEC_PRECISE vec2 squares = vec2(1.0 - 0.5 * s.y * s.y, 1.0 - 0.5 * s.x * s.x);
    vec2 root = vec2(unitvec_root(squares.x), unitvec_root(squares.y));
    UNITVEC_PRECISE vec2 at = s * root;
    // (1 - s^2) (1 - t^2), with one rounding less near the middle.
    UNITVEC_PRECISE float factor = 1.0 - s.x * s.x;
    UNITVEC_PRECISE float rim = factor - factor * (s.y * s.y);
    return vec4(at, 0.0, rim);
}

// -x where negative; 0 where x is not positive.
float unitvec_azimuthal_signed(bool negative, float x) {
    return x > 0.0 ? unitvec_negate_if(negative, x) : 0.0;
}

// The place of the direction of v on the square, without signs.
vec2 unitvec_azimuthal_to_square(vec3 v, int projection, int map) {
    UNITVEC_PRECISE vec3 octant = abs(v) * unitvec_reciprocal(unitvec_l1_norm(v));
    vec4 disk = projection == UNITVEC_STEREO ? unitvec_stereo_to_disk(octant)
        : (projection == UNITVEC_EQAREA ? unitvec_eqarea_to_disk(octant) : unitvec_eqdist_to_disk(octant));
    return map == UNITVEC_PLAIN ? disk.xy
        : (map == UNITVEC_CONCENTRIC ? unitvec_concentric_to_square(disk) : unitvec_ellipse_to_square(disk));
}

vec3 unitvec_azimuthal_from_disk(vec4 disk, int projection) {
    return projection == UNITVEC_STEREO ? unitvec_disk_to_stereo(disk.xy, disk.w)
        : (projection == UNITVEC_EQAREA ? unitvec_disk_to_eqarea(disk.xy, disk.w)
        : unitvec_disk_to_eqdist(disk.xy, disk.w));
}

// The projection, unquantised: u and v on [-1, 1], and 1 for z < 0, else 0.
vec3 unitvec_azimuthal_project(vec3 v, int projection, int map) {
    v = unitvec_or_z(v);
    vec2 s = unitvec_azimuthal_to_square(v, projection, map);
    return vec3(unitvec_azimuthal_signed(unitvec_is_negative(v.x), s.x),
        unitvec_azimuthal_signed(unitvec_is_negative(v.y), s.y), unitvec_is_negative(v.z) ? 1.0 : 0.0);
}

// The direction of u and v on [-1, 1], below the equator where e.z is 1/2 or more.
vec3 unitvec_azimuthal_unproject(vec3 e, int projection, int map) {
    vec2 s = unitvec_snorm_clamp(e.xy);
    vec4 disk = map == UNITVEC_PLAIN ? unitvec_plain_square_to_disk(abs(s))
        : (map == UNITVEC_CONCENTRIC ? unitvec_concentric_to_disk(abs(s)) : unitvec_ellipse_to_disk(abs(s)));
    vec3 n = unitvec_azimuthal_from_disk(disk, projection);
    return vec3(unitvec_azimuthal_signed(s.x < 0.0, n.x), unitvec_azimuthal_signed(s.y < 0.0, n.y),
        unitvec_azimuthal_signed(unitvec_is_set(e.z), n.z));
}

vec3 unitvec_azimuthal_biased(vec3 e) {
    return vec3(unitvec_biased(e.xy), e.z);
}

vec3 unitvec_azimuthal_unbiased(vec3 e) {
    return vec3(unitvec_unbiased(e.xy), e.z);
}

// Code of the direction of v at any width, for one of the projections and one of the maps.
uint unitvec_azimuthal_encode(vec3 v, int projection, int map, uint bits) {
    v = unitvec_or_z(v);
    vec2 s = unitvec_azimuthal_to_square(v, projection, map);
    vec2 m = unitvec_azimuthal_largest(bits);
    UNITVEC_PRECISE vec2 position = s * m + 0.5;
    vec2 e = floor(position);
    if (map == UNITVEC_PLAIN) e = unitvec_plain_settle(e, bits);

    bool back = unitvec_is_negative(v.y);
    bool flag = e.y < m.y ? unitvec_is_negative(v.z) : !back;
    uint u_code = unitvec_signed_code(unitvec_negate_if(unitvec_is_negative(v.x), e.x), bits / 2u);
    uint v_code = unitvec_signed_code(unitvec_negate_if(back, e.y), bits / 2u - 1u);
    return u_code | (v_code << (bits / 2u)) | (flag ? 1u << (bits - 1u) : 0u);
}

vec3 unitvec_azimuthal_decode(uint code, int projection, int map, uint bits) {
    // v without regard to the highest bit.
    vec2 e = vec2(unitvec_snorm_integer(code, bits / 2u), float(unitvec_signed_field(code, bits / 2u, bits / 2u - 1u)));
    bool flag = (code & (1u << (bits - 1u))) != 0u;
    vec2 s = unitvec_azimuthal_parts(abs(e), bits);
    vec4 disk = map == UNITVEC_PLAIN ? unitvec_plain_to_disk(abs(e), bits)
        : (map == UNITVEC_CONCENTRIC ? unitvec_concentric_to_disk(s) : unitvec_ellipse_to_disk(s));
    vec3 n = unitvec_azimuthal_from_disk(disk, projection);
    bool back = e.y < 0.0 && !(flag && e.y <= -unitvec_azimuthal_largest(bits).y);
    return vec3(unitvec_negate_positive(e.x < 0.0, n.x), unitvec_negate_positive(back, n.y),
        unitvec_azimuthal_signed(flag, n.z));
}

vec3 float32x3_to_stereo(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_STEREO, UNITVEC_PLAIN); }
vec3 stereo_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_STEREO, UNITVEC_PLAIN); }
vec3 float32x3_to_stereo_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_stereo(v)); }
vec3 stereo_unorm_to_float32x3(vec3 e) { return stereo_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_stereo_concentric(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC); }
vec3 stereo_concentric_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_STEREO, UNITVEC_CONCENTRIC); }
vec3 float32x3_to_stereo_concentric_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_stereo_concentric(v)); }
vec3 stereo_concentric_unorm_to_float32x3(vec3 e) { return stereo_concentric_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_stereo_ellipse(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_STEREO, UNITVEC_ELLIPSE); }
vec3 stereo_ellipse_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_STEREO, UNITVEC_ELLIPSE); }
vec3 float32x3_to_stereo_ellipse_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_stereo_ellipse(v)); }
vec3 stereo_ellipse_unorm_to_float32x3(vec3 e) { return stereo_ellipse_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqarea(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQAREA, UNITVEC_PLAIN); }
vec3 eqarea_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQAREA, UNITVEC_PLAIN); }
vec3 float32x3_to_eqarea_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqarea(v)); }
vec3 eqarea_unorm_to_float32x3(vec3 e) { return eqarea_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqarea_concentric(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC); }
vec3 eqarea_concentric_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQAREA, UNITVEC_CONCENTRIC); }
vec3 float32x3_to_eqarea_concentric_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqarea_concentric(v)); }
vec3 eqarea_concentric_unorm_to_float32x3(vec3 e) { return eqarea_concentric_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqarea_ellipse(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE); }
vec3 eqarea_ellipse_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQAREA, UNITVEC_ELLIPSE); }
vec3 float32x3_to_eqarea_ellipse_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqarea_ellipse(v)); }
vec3 eqarea_ellipse_unorm_to_float32x3(vec3 e) { return eqarea_ellipse_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqdist(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQDIST, UNITVEC_PLAIN); }
vec3 eqdist_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQDIST, UNITVEC_PLAIN); }
vec3 float32x3_to_eqdist_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqdist(v)); }
vec3 eqdist_unorm_to_float32x3(vec3 e) { return eqdist_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqdist_concentric(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC); }
vec3 eqdist_concentric_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQDIST, UNITVEC_CONCENTRIC); }
vec3 float32x3_to_eqdist_concentric_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqdist_concentric(v)); }
vec3 eqdist_concentric_unorm_to_float32x3(vec3 e) { return eqdist_concentric_to_float32x3(unitvec_azimuthal_unbiased(e)); }

vec3 float32x3_to_eqdist_ellipse(vec3 v) { return unitvec_azimuthal_project(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE); }
vec3 eqdist_ellipse_to_float32x3(vec3 e) { return unitvec_azimuthal_unproject(e, UNITVEC_EQDIST, UNITVEC_ELLIPSE); }
vec3 float32x3_to_eqdist_ellipse_unorm(vec3 v) { return unitvec_azimuthal_biased(float32x3_to_eqdist_ellipse(v)); }
vec3 eqdist_ellipse_unorm_to_float32x3(vec3 e) { return eqdist_ellipse_to_float32x3(unitvec_azimuthal_unbiased(e)); }

uint stereo16_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_PLAIN, 16u); }
uint stereo20_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_PLAIN, 20u); }
uint stereo22_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_PLAIN, 22u); }
uint stereo24_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_PLAIN, 24u); }
uint stereo32_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_PLAIN, 32u); }

vec3 stereo16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_PLAIN, 16u);
}
vec3 stereo20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_PLAIN, 20u);
}
vec3 stereo22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_PLAIN, 22u);
}
vec3 stereo24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_PLAIN, 24u);
}
vec3 stereo32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_PLAIN, 32u);
}

uint stereo_concentric16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 16u);
}
uint stereo_concentric20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 20u);
}
uint stereo_concentric22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 22u);
}
uint stereo_concentric24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 24u);
}
uint stereo_concentric32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 32u);
}

vec3 stereo_concentric16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 16u);
}
vec3 stereo_concentric20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 20u);
}
vec3 stereo_concentric22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 22u);
}
vec3 stereo_concentric24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 24u);
}
vec3 stereo_concentric32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_CONCENTRIC, 32u);
}

uint stereo_ellipse16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_ELLIPSE, 16u);
}
uint stereo_ellipse20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_ELLIPSE, 20u);
}
uint stereo_ellipse22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_ELLIPSE, 22u);
}
uint stereo_ellipse24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_ELLIPSE, 24u);
}
uint stereo_ellipse32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_STEREO, UNITVEC_ELLIPSE, 32u);
}

vec3 stereo_ellipse16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_ELLIPSE, 16u);
}
vec3 stereo_ellipse20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_ELLIPSE, 20u);
}
vec3 stereo_ellipse22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_ELLIPSE, 22u);
}
vec3 stereo_ellipse24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_ELLIPSE, 24u);
}
vec3 stereo_ellipse32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_STEREO, UNITVEC_ELLIPSE, 32u);
}

uint eqarea16_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_PLAIN, 16u); }
uint eqarea20_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_PLAIN, 20u); }
uint eqarea22_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_PLAIN, 22u); }
uint eqarea24_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_PLAIN, 24u); }
uint eqarea32_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_PLAIN, 32u); }

vec3 eqarea16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_PLAIN, 16u);
}
vec3 eqarea20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_PLAIN, 20u);
}
vec3 eqarea22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_PLAIN, 22u);
}
vec3 eqarea24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_PLAIN, 24u);
}
vec3 eqarea32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_PLAIN, 32u);
}

uint eqarea_concentric16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 16u);
}
uint eqarea_concentric20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 20u);
}
uint eqarea_concentric22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 22u);
}
uint eqarea_concentric24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 24u);
}
uint eqarea_concentric32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 32u);
}

vec3 eqarea_concentric16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 16u);
}
vec3 eqarea_concentric20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 20u);
}
vec3 eqarea_concentric22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 22u);
}
vec3 eqarea_concentric24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 24u);
}
vec3 eqarea_concentric32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_CONCENTRIC, 32u);
}

uint eqarea_ellipse16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 16u);
}
uint eqarea_ellipse20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 20u);
}
uint eqarea_ellipse22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 22u);
}
uint eqarea_ellipse24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 24u);
}
uint eqarea_ellipse32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 32u);
}

vec3 eqarea_ellipse16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 16u);
}
vec3 eqarea_ellipse20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 20u);
}
vec3 eqarea_ellipse22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 22u);
}
vec3 eqarea_ellipse24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 24u);
}
vec3 eqarea_ellipse32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQAREA, UNITVEC_ELLIPSE, 32u);
}

uint eqdist16_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_PLAIN, 16u); }
uint eqdist20_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_PLAIN, 20u); }
uint eqdist22_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_PLAIN, 22u); }
uint eqdist24_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_PLAIN, 24u); }
uint eqdist32_encode(vec3 v) { return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_PLAIN, 32u); }

vec3 eqdist16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_PLAIN, 16u);
}
vec3 eqdist20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_PLAIN, 20u);
}
vec3 eqdist22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_PLAIN, 22u);
}
vec3 eqdist24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_PLAIN, 24u);
}
vec3 eqdist32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_PLAIN, 32u);
}

uint eqdist_concentric16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 16u);
}
uint eqdist_concentric20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 20u);
}
uint eqdist_concentric22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 22u);
}
uint eqdist_concentric24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 24u);
}
uint eqdist_concentric32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 32u);
}

vec3 eqdist_concentric16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 16u);
}
vec3 eqdist_concentric20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 20u);
}
vec3 eqdist_concentric22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 22u);
}
vec3 eqdist_concentric24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 24u);
}
vec3 eqdist_concentric32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_CONCENTRIC, 32u);
}

uint eqdist_ellipse16_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 16u);
}
uint eqdist_ellipse20_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 20u);
}
uint eqdist_ellipse22_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 22u);
}
uint eqdist_ellipse24_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 24u);
}
uint eqdist_ellipse32_encode(vec3 v) {
    return unitvec_azimuthal_encode(v, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 32u);
}

vec3 eqdist_ellipse16_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 16u);
}
vec3 eqdist_ellipse20_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 20u);
}
vec3 eqdist_ellipse22_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 22u);
}
vec3 eqdist_ellipse24_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 24u);
}
vec3 eqdist_ellipse32_decode(uint code) {
    return unitvec_azimuthal_decode(code, UNITVEC_EQDIST, UNITVEC_ELLIPSE, 32u);
}

#endif
