// unitvec: azimuthal codes of 16, 20, 22, 24 and 32 bits: a hemisphere on a disk by a map projection, the disk on a
// square or as it is, and one bit for the hemisphere.
//
// Source: Cigolle et al. 2014, section 2; Snyder 1987; Shirley and Chiu 1997; the ellipse map is the elliptical grid
// map.
//
//   stereo16_encode(v), stereo16_decode(code)      stereographic; also eqarea (Lambert), eqdist (equidistant)
//   stereo_concentric16_encode(v), ...             the disk on the square by Shirley and Chiu's map
//   stereo_ellipse16_encode(v), ...                the disk on the square by the ellipse map
//
// Each with 16, 20, 22, 24 and 32. Any v will do: length does not matter, and +Z stands in for what has no direction.
// Layout: u, snorm of half the bits in two's complement, lowest; v, one bit less, n, in steps of 2^-(n-1), above it;
// the hemisphere (1 for z < 0) highest. Both ends of v have the pattern of -2^(n-1): there, on the equator, the
// highest bit says which, 1 for +1. Why, and what else is to be known, is in the docs of the Rust crate's module
// `azimuthal`, whose every operation these functions repeat.

#ifndef UNITVEC_AZIMUTHAL_GLSL
#define UNITVEC_AZIMUTHAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

// The projections, and the maps of the disk to the square.
const int AZIMUTHAL_STEREO = 0;
const int AZIMUTHAL_EQAREA = 1;
const int AZIMUTHAL_EQDIST = 2;
const int AZIMUTHAL_PLAIN = 0;
const int AZIMUTHAL_CONCENTRIC = 1;
const int AZIMUTHAL_ELLIPSE = 2;

// A point of the unit disk is (x, y, radius, rim) with x, y >= 0 and rim = 1 - radius^2; `*_to_square` take it so,
// `*_to_disk` of a square map leave the radius 0.

// Disk point of v, whose components are not negative and have the sum 1.
vec4 stereo_to_disk(vec3 v) {
    UNITVEC_PRECISE float scale = 1.0 / (sqrt(unitvec_dot(v, v)) + v.z);
    UNITVEC_PRECISE vec2 point = v.xy * scale;
    UNITVEC_PRECISE float radius = unitvec_horizontal_length(v) * scale;
    UNITVEC_PRECISE float rim = 2.0 * v.z * scale;
    return vec4(point, radius, rim);
}

vec3 disk_to_stereo(vec2 point, float rim) {
    UNITVEC_PRECISE float sum = 2.0 - rim;
    UNITVEC_PRECISE vec2 horizontal = 2.0 * point / sum;
    UNITVEC_PRECISE float z = rim / sum;
    return vec3(horizontal, z);
}

vec4 eqarea_to_disk(vec3 v) {
    UNITVEC_PRECISE float norm = sqrt(unitvec_dot(v, v));
    UNITVEC_PRECISE float scale = 1.0 / sqrt(norm * (norm + v.z));
    UNITVEC_PRECISE vec2 point = v.xy * scale;
    UNITVEC_PRECISE float radius = unitvec_horizontal_length(v) * scale;
    UNITVEC_PRECISE float rim = v.z / norm;
    return vec4(point, radius, rim);
}

vec3 disk_to_eqarea(vec2 point, float rim) {
    UNITVEC_PRECISE float scale = sqrt(1.0 + rim);
    UNITVEC_PRECISE vec2 horizontal = point * scale;
    return vec3(horizontal, rim);
}

// The smaller of radius and 1 - radius is found first, so that both have a small relative error.
vec4 eqdist_to_disk(vec3 v) {
    float rho = unitvec_horizontal_length(v);
    bool low = rho > v.z;
    float shorter = low ? v.z : rho;
    float longer = low ? rho : v.z;
    UNITVEC_PRECISE float part = 0.5 * unitvec_atan_octant_ratio(shorter, longer);
    UNITVEC_PRECISE float rest = 1.0 - part;
    float radius = low ? rest : part;
    float inside = low ? part : rest;
    UNITVEC_PRECISE float quotient = radius / rho;
    float scale = rho > UNITVEC_NEGLIGIBLE ? quotient : 0.0;
    UNITVEC_PRECISE vec2 point = v.xy * scale;
    UNITVEC_PRECISE float rim = inside * (1.0 + radius);
    return vec4(point, radius, rim);
}

// Minimax polynomials of sin(pi r / 2) / r in c = 1 - r^2 and of cos(pi r / 2) / (1 - r^2) in w = r^2.
const float AZIMUTHAL_SINC_0 = 0.49999976;
const float AZIMUTHAL_SINC_1 = 0.066577174;
const float AZIMUTHAL_SINC_2 = 0.0040679215;
const float AZIMUTHAL_SINC_3 = 0.00015146394;

const float AZIMUTHAL_COSC_0 = -0.23370051;
const float AZIMUTHAL_COSC_1 = 0.019968653;
const float AZIMUTHAL_COSC_2 = -0.0008935995;
const float AZIMUTHAL_COSC_3 = 2.3629505e-5;

vec3 disk_to_eqdist(vec2 point, float c) {
    UNITVEC_PRECISE float scale =
        1.0 + c * (AZIMUTHAL_SINC_0 + c * (AZIMUTHAL_SINC_1 + c * (AZIMUTHAL_SINC_2 + c * AZIMUTHAL_SINC_3)));
    UNITVEC_PRECISE float w = 1.0 - c;
    UNITVEC_PRECISE float low = AZIMUTHAL_COSC_0 + w * (AZIMUTHAL_COSC_1 + w * (AZIMUTHAL_COSC_2 + w * AZIMUTHAL_COSC_3));
    UNITVEC_PRECISE float z = c + c * (w * low);
    UNITVEC_PRECISE vec2 horizontal = point * scale;
    return vec3(horizontal, z);
}

// How far, in steps, lattice points beyond the rim are moved at most.
const float AZIMUTHAL_REACH = 0.484375;

// True for lattice points e of whose cell the disk covers nothing, or next to nothing. m has the largest integers.
bool plain_is_remote(vec2 e, vec2 m) {
    UNITVEC_PRECISE vec2 corner = (e - AZIMUTHAL_REACH) / m;
    UNITVEC_PRECISE float square = corner.x * corner.x + corner.y * corner.y;
    return square > 1.0;
}

// Lattice point to write for the one that rounding gave: a remote one goes a step inward.
vec2 plain_settle(vec2 e, vec2 m) {
    UNITVEC_PRECISE vec2 slope = e / m / m;
    UNITVEC_PRECISE vec2 settled = e - (slope.x > slope.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
    return plain_is_remote(e, m) ? settled : e;
}

// Point on the rim for p beyond it, where excess is (|p|^2 - 1) / 2: within p's cell.
vec2 plain_move_to_rim(vec2 p, vec2 m, float excess) {
    UNITVEC_PRECISE vec2 slope = p / m;
    bool along_u = slope.x > slope.y;
    float steep = along_u ? slope.x : slope.y;
    float gentle = along_u ? slope.y : slope.x;
    UNITVEC_PRECISE float alone = excess / steep;
    UNITVEC_PRECISE float remainder = (excess - AZIMUTHAL_REACH * steep) / gentle;
    float first = alone < AZIMUTHAL_REACH ? alone : AZIMUTHAL_REACH;
    float second = alone < AZIMUTHAL_REACH ? 0.0 : remainder;
    vec2 moved = along_u ? vec2(first, second) : vec2(second, first);
    UNITVEC_PRECISE vec2 on_rim = p - moved / m;
    return on_rim;
}

// Disk point of a lattice point of the disk as it is; remote ones are the nearer axis.
vec4 plain_to_disk(vec2 e, vec2 m) {
    UNITVEC_PRECISE vec2 p = e / m;
    UNITVEC_PRECISE float rim = 1.0 - (p.x * p.x + p.y * p.y);
    UNITVEC_PRECISE float excess = -0.5 * rim;
    vec2 moved = plain_move_to_rim(p, m, excess);
    vec2 axis = p.x > p.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 on_rim = plain_is_remote(e, m) ? axis : moved;
    UNITVEC_PRECISE float rest = 1.0 - (on_rim.x * on_rim.x + on_rim.y * on_rim.y);
    return rim > 0.0 ? vec4(p, 0.0, rim) : vec4(on_rim, 0.0, rest < 0.0 ? rest : 0.0);
}

vec2 concentric_to_square(vec4 disk) {
    bool steep = disk.y > disk.x;
    float shorter = steep ? disk.x : disk.y;
    float longer = steep ? disk.y : disk.x;
    UNITVEC_PRECISE float across = disk.z * unitvec_atan_octant_ratio(shorter, longer);
    return steep ? vec2(across, disk.z) : vec2(disk.z, across);
}

vec4 concentric_to_disk(vec2 e, vec2 m) {
    UNITVEC_PRECISE vec2 s = e / m;
    bool steep = s.y > s.x;
    float shorter = steep ? s.x : s.y;
    float radius = steep ? s.y : s.x;
    UNITVEC_PRECISE float quotient = shorter / radius;
    float octant = radius > 0.0 ? quotient : 0.0;
    UNITVEC_PRECISE float angle = 0.25 * octant;
    UNITVEC_PRECISE vec2 p = radius * unitvec_sin_cos_half_turns(angle);
    UNITVEC_PRECISE float rim = 1.0 - radius * radius;
    return vec4(steep ? p.yx : p, 0.0, rim);
}

// s^2 = 4 x^2 / (2 + d + root), t^2 = 4 y^2 / (2 - d + root), d = x^2 - y^2, root^2 = d^2 + 4 rim: nothing cancels.
vec2 ellipse_to_square(vec4 disk) {
    UNITVEC_PRECISE float difference = (disk.x - disk.y) * (disk.x + disk.y);
    UNITVEC_PRECISE float sum = 2.0 + sqrt(difference * difference + 4.0 * disk.w);
    UNITVEC_PRECISE vec2 s = 2.0 * disk.xy / vec2(sqrt(sum + difference), sqrt(sum - difference));
    return s;
}

vec4 ellipse_to_disk(vec2 e, vec2 m) {
    UNITVEC_PRECISE vec2 s = e / m;
    UNITVEC_PRECISE vec2 root = vec2(sqrt(1.0 - 0.5 * s.y * s.y), sqrt(1.0 - 0.5 * s.x * s.x));
    UNITVEC_PRECISE vec2 point = s * root;
    // (1 - s^2) (1 - t^2), with one rounding less near the middle.
    UNITVEC_PRECISE float factor = 1.0 - s.x * s.x;
    UNITVEC_PRECISE float rim = factor - factor * (s.y * s.y);
    return vec4(point, 0.0, rim);
}

// Largest integers of u and v at `bits` bits.
vec2 azimuthal_largest(uint bits) {
    return vec2(snorm_max(bits / 2u), float(1u << (bits / 2u - 2u)));
}

// -x where negative; 0 where x is not positive.
float azimuthal_signed(bool negative, float x) {
    return x > 0.0 ? unitvec_negate_if(negative, x) : 0.0;
}

// Code of the direction of v at any width, for one of the projections and one of the maps.
uint azimuthal_encode(vec3 v, int projection, int map, uint bits) {
    v = unitvec_or_z(v);
    UNITVEC_PRECISE vec3 octant = abs(v) * (1.0 / unitvec_l1_norm(v));
    vec4 disk = projection == AZIMUTHAL_STEREO ? stereo_to_disk(octant)
        : (projection == AZIMUTHAL_EQAREA ? eqarea_to_disk(octant) : eqdist_to_disk(octant));
    vec2 s = map == AZIMUTHAL_PLAIN ? disk.xy
        : (map == AZIMUTHAL_CONCENTRIC ? concentric_to_square(disk) : ellipse_to_square(disk));
    vec2 m = azimuthal_largest(bits);
    UNITVEC_PRECISE vec2 position = s * m + 0.5;
    vec2 e = floor(position);
    if (map == AZIMUTHAL_PLAIN) e = plain_settle(e, m);

    bool back = unitvec_is_negative(v.y);
    bool flag = e.y < m.y ? unitvec_is_negative(v.z) : !back;
    uint u_code = unitvec_signed_code(unitvec_negate_if(unitvec_is_negative(v.x), e.x), bits / 2u);
    uint v_code = unitvec_signed_code(unitvec_negate_if(back, e.y), bits / 2u - 1u);
    return u_code | (v_code << (bits / 2u)) | (flag ? 1u << (bits - 1u) : 0u);
}

vec3 azimuthal_decode(uint code, int projection, int map, uint bits) {
    // v without regard to the highest bit.
    vec2 e = vec2(unitvec_snorm_integer(code, bits / 2u), unitvec_signed_integer(code >> (bits / 2u), bits / 2u - 1u));
    bool flag = ((code >> (bits - 1u)) & 1u) != 0u;
    vec2 m = azimuthal_largest(bits);
    vec4 disk = map == AZIMUTHAL_PLAIN ? plain_to_disk(abs(e), m)
        : (map == AZIMUTHAL_CONCENTRIC ? concentric_to_disk(abs(e), m) : ellipse_to_disk(abs(e), m));
    vec3 n = projection == AZIMUTHAL_STEREO ? disk_to_stereo(disk.xy, disk.w)
        : (projection == AZIMUTHAL_EQAREA ? disk_to_eqarea(disk.xy, disk.w) : disk_to_eqdist(disk.xy, disk.w));
    bool back = e.y < 0.0 && !(flag && e.y <= -m.y);
    return vec3(azimuthal_signed(e.x < 0.0, n.x), azimuthal_signed(back, n.y), azimuthal_signed(flag, n.z));
}

// GLSL ES 3.00 cannot join names in a macro: hence both.
#define AZIMUTHAL_CODEC(encode, decode, projection, map, bits) \
    uint encode(vec3 v) { return azimuthal_encode(v, projection, map, bits); } \
    vec3 decode(uint code) { return azimuthal_decode(code, projection, map, bits); }

AZIMUTHAL_CODEC(stereo16_encode, stereo16_decode, AZIMUTHAL_STEREO, AZIMUTHAL_PLAIN, 16u)
AZIMUTHAL_CODEC(stereo20_encode, stereo20_decode, AZIMUTHAL_STEREO, AZIMUTHAL_PLAIN, 20u)
AZIMUTHAL_CODEC(stereo22_encode, stereo22_decode, AZIMUTHAL_STEREO, AZIMUTHAL_PLAIN, 22u)
AZIMUTHAL_CODEC(stereo24_encode, stereo24_decode, AZIMUTHAL_STEREO, AZIMUTHAL_PLAIN, 24u)
AZIMUTHAL_CODEC(stereo32_encode, stereo32_decode, AZIMUTHAL_STEREO, AZIMUTHAL_PLAIN, 32u)

AZIMUTHAL_CODEC(stereo_concentric16_encode, stereo_concentric16_decode, AZIMUTHAL_STEREO, AZIMUTHAL_CONCENTRIC, 16u)
AZIMUTHAL_CODEC(stereo_concentric20_encode, stereo_concentric20_decode, AZIMUTHAL_STEREO, AZIMUTHAL_CONCENTRIC, 20u)
AZIMUTHAL_CODEC(stereo_concentric22_encode, stereo_concentric22_decode, AZIMUTHAL_STEREO, AZIMUTHAL_CONCENTRIC, 22u)
AZIMUTHAL_CODEC(stereo_concentric24_encode, stereo_concentric24_decode, AZIMUTHAL_STEREO, AZIMUTHAL_CONCENTRIC, 24u)
AZIMUTHAL_CODEC(stereo_concentric32_encode, stereo_concentric32_decode, AZIMUTHAL_STEREO, AZIMUTHAL_CONCENTRIC, 32u)

AZIMUTHAL_CODEC(stereo_ellipse16_encode, stereo_ellipse16_decode, AZIMUTHAL_STEREO, AZIMUTHAL_ELLIPSE, 16u)
AZIMUTHAL_CODEC(stereo_ellipse20_encode, stereo_ellipse20_decode, AZIMUTHAL_STEREO, AZIMUTHAL_ELLIPSE, 20u)
AZIMUTHAL_CODEC(stereo_ellipse22_encode, stereo_ellipse22_decode, AZIMUTHAL_STEREO, AZIMUTHAL_ELLIPSE, 22u)
AZIMUTHAL_CODEC(stereo_ellipse24_encode, stereo_ellipse24_decode, AZIMUTHAL_STEREO, AZIMUTHAL_ELLIPSE, 24u)
AZIMUTHAL_CODEC(stereo_ellipse32_encode, stereo_ellipse32_decode, AZIMUTHAL_STEREO, AZIMUTHAL_ELLIPSE, 32u)

AZIMUTHAL_CODEC(eqarea16_encode, eqarea16_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_PLAIN, 16u)
AZIMUTHAL_CODEC(eqarea20_encode, eqarea20_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_PLAIN, 20u)
AZIMUTHAL_CODEC(eqarea22_encode, eqarea22_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_PLAIN, 22u)
AZIMUTHAL_CODEC(eqarea24_encode, eqarea24_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_PLAIN, 24u)
AZIMUTHAL_CODEC(eqarea32_encode, eqarea32_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_PLAIN, 32u)

AZIMUTHAL_CODEC(eqarea_concentric16_encode, eqarea_concentric16_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_CONCENTRIC, 16u)
AZIMUTHAL_CODEC(eqarea_concentric20_encode, eqarea_concentric20_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_CONCENTRIC, 20u)
AZIMUTHAL_CODEC(eqarea_concentric22_encode, eqarea_concentric22_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_CONCENTRIC, 22u)
AZIMUTHAL_CODEC(eqarea_concentric24_encode, eqarea_concentric24_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_CONCENTRIC, 24u)
AZIMUTHAL_CODEC(eqarea_concentric32_encode, eqarea_concentric32_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_CONCENTRIC, 32u)

AZIMUTHAL_CODEC(eqarea_ellipse16_encode, eqarea_ellipse16_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_ELLIPSE, 16u)
AZIMUTHAL_CODEC(eqarea_ellipse20_encode, eqarea_ellipse20_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_ELLIPSE, 20u)
AZIMUTHAL_CODEC(eqarea_ellipse22_encode, eqarea_ellipse22_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_ELLIPSE, 22u)
AZIMUTHAL_CODEC(eqarea_ellipse24_encode, eqarea_ellipse24_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_ELLIPSE, 24u)
AZIMUTHAL_CODEC(eqarea_ellipse32_encode, eqarea_ellipse32_decode, AZIMUTHAL_EQAREA, AZIMUTHAL_ELLIPSE, 32u)

AZIMUTHAL_CODEC(eqdist16_encode, eqdist16_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_PLAIN, 16u)
AZIMUTHAL_CODEC(eqdist20_encode, eqdist20_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_PLAIN, 20u)
AZIMUTHAL_CODEC(eqdist22_encode, eqdist22_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_PLAIN, 22u)
AZIMUTHAL_CODEC(eqdist24_encode, eqdist24_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_PLAIN, 24u)
AZIMUTHAL_CODEC(eqdist32_encode, eqdist32_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_PLAIN, 32u)

AZIMUTHAL_CODEC(eqdist_concentric16_encode, eqdist_concentric16_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_CONCENTRIC, 16u)
AZIMUTHAL_CODEC(eqdist_concentric20_encode, eqdist_concentric20_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_CONCENTRIC, 20u)
AZIMUTHAL_CODEC(eqdist_concentric22_encode, eqdist_concentric22_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_CONCENTRIC, 22u)
AZIMUTHAL_CODEC(eqdist_concentric24_encode, eqdist_concentric24_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_CONCENTRIC, 24u)
AZIMUTHAL_CODEC(eqdist_concentric32_encode, eqdist_concentric32_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_CONCENTRIC, 32u)

AZIMUTHAL_CODEC(eqdist_ellipse16_encode, eqdist_ellipse16_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_ELLIPSE, 16u)
AZIMUTHAL_CODEC(eqdist_ellipse20_encode, eqdist_ellipse20_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_ELLIPSE, 20u)
AZIMUTHAL_CODEC(eqdist_ellipse22_encode, eqdist_ellipse22_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_ELLIPSE, 22u)
AZIMUTHAL_CODEC(eqdist_ellipse24_encode, eqdist_ellipse24_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_ELLIPSE, 24u)
AZIMUTHAL_CODEC(eqdist_ellipse32_encode, eqdist_ellipse32_decode, AZIMUTHAL_EQDIST, AZIMUTHAL_ELLIPSE, 32u)

#undef AZIMUTHAL_CODEC

#endif
