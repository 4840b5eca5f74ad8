// unitvec: cube and warped cube codes of 16, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, section 2; Meyer et al. 2010, eq. 8.
//
//   cube16_encode(v), cube16_decode(code), warpedcube16_encode(v), warpedcube16_decode(code); also 24 and 32
//
// Any v: length does not matter, and +Z stands in for what has no direction. Layout: u in the low ceil((b - 3) / 2) bits,
// then v, two's complement, over (m + 1/2); the face in the high three: twice the axis, and 1 if negative. (u, v) is
// (y, z), (z, x), (x, y) on the faces of x, y, z. The warped cube stores 4/pi atan(u) in place of u.

#ifndef UNITVEC_CUBE_GLSL
#define UNITVEC_CUBE_GLSL

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif
#ifndef UNITVEC_MATH_GLSL
#include "math.glsl"
#endif

uint unitvec_face_of(vec3 v) {
    vec3 a = abs(v);
    bool z_above = a.z >= a.x && a.z >= a.y;
    bool y_above = a.y >= a.x;
    uint axis = z_above ? 2u : (y_above ? 1u : 0u);
    float component = z_above ? v.z : (y_above ? v.y : v.x);
    return 2u * axis + (unitvec_is_negative(component) ? 1u : 0u);
}

// Components in the order that the face has them: u, v, and that of its axis.
vec3 unitvec_to_face(vec3 v, uint face) {
    uint axis = face >> 1u;
    return axis >= 2u ? v : (axis == 0u ? v.yzx : v.zxy);
}

// The inverse. Faces 6 and 7 count as 4 and 5.
vec3 unitvec_from_face(vec3 p, uint face) {
    uint axis = face >> 1u;
    return axis >= 2u ? p : (axis == 0u ? p.zxy : p.yzx);
}

float cube_round(bool negative, float magnitude, float m) {
    UNITVEC_PRECISE float position = magnitude * (m + 0.5) + 0.5;
    float rounded = floor(position);
    return unitvec_negate_if(negative, rounded > m ? m : rounded);
}

uint cube_pack(vec2 e, uint face, uint n, uint k) {
    return unitvec_signed_code(e.x, n) | (unitvec_signed_code(e.y, k) << n) | (face << (n + k));
}

vec2 cube_unpack(uint code, uint n, uint k) {
    return vec2(unitvec_snorm_integer(code, n), unitvec_snorm_integer(code >> n, k));
}

uint cube_encode(vec3 v, uint n, uint k) {
    v = unitvec_or_z(v);
    uint face = unitvec_face_of(v);
    vec3 p = unitvec_to_face(v, face);
    UNITVEC_PRECISE float scale = 1.0 / abs(p.z);
    UNITVEC_PRECISE vec2 t = abs(p.xy) * scale;
    vec2 e = vec2(cube_round(unitvec_is_negative(p.x), t.x, snorm_max(n)),
        cube_round(unitvec_is_negative(p.y), t.y, snorm_max(k)));
    return cube_pack(e, face, n, k);
}

vec3 cube_decode(uint code, uint n, uint k) {
    uint face = (code >> (n + k)) & 7u;
    vec2 e = cube_unpack(code, n, k);
    // In steps of u, so that only v is rounded before the normalisation.
    UNITVEC_PRECISE float side = snorm_max(n) + 0.5;
    UNITVEC_PRECISE float v_step = side / (snorm_max(k) + 0.5);
    UNITVEC_PRECISE float y = e.y * v_step;
    return unitvec_from_face(unitvec_normalize(vec3(e.x, y, unitvec_negate_if((face & 1u) != 0u, side))), face);
}

uint warpedcube_encode(vec3 v, uint n, uint k) {
    v = unitvec_or_z(v);
    uint face = unitvec_face_of(v);
    vec3 p = unitvec_to_face(v, face);
    UNITVEC_PRECISE float scale = 1.0 / abs(p.z);
    UNITVEC_PRECISE vec2 t = abs(p.xy) * scale;
    vec2 e = vec2(cube_round(unitvec_is_negative(p.x), unitvec_atan_octant(t.x), snorm_max(n)),
        cube_round(unitvec_is_negative(p.y), unitvec_atan_octant(t.y), snorm_max(k)));
    return cube_pack(e, face, n, k);
}

vec3 warpedcube_decode(uint code, uint n, uint k) {
    uint face = (code >> (n + k)) & 7u;
    vec2 e = cube_unpack(code, n, k);
    UNITVEC_PRECISE float s = abs(e.x) / (snorm_max(n) + 0.5);
    UNITVEC_PRECISE float t = abs(e.y) / (snorm_max(k) + 0.5);
    vec3 p = vec3(unitvec_negate_if(unitvec_is_negative(e.x), unitvec_tan_octant(s)),
        unitvec_negate_if(unitvec_is_negative(e.y), unitvec_tan_octant(t)),
        unitvec_negate_if((face & 1u) != 0u, 1.0));
    return unitvec_from_face(unitvec_normalize(p), face);
}

uint cube16_encode(vec3 v) { return cube_encode(v, 7u, 6u); }
uint cube24_encode(vec3 v) { return cube_encode(v, 11u, 10u); }
uint cube32_encode(vec3 v) { return cube_encode(v, 15u, 14u); }

vec3 cube16_decode(uint code) { return cube_decode(code, 7u, 6u); }
vec3 cube24_decode(uint code) { return cube_decode(code, 11u, 10u); }
vec3 cube32_decode(uint code) { return cube_decode(code, 15u, 14u); }

uint warpedcube16_encode(vec3 v) { return warpedcube_encode(v, 7u, 6u); }
uint warpedcube24_encode(vec3 v) { return warpedcube_encode(v, 11u, 10u); }
uint warpedcube32_encode(vec3 v) { return warpedcube_encode(v, 15u, 14u); }

vec3 warpedcube16_decode(uint code) { return warpedcube_decode(code, 7u, 6u); }
vec3 warpedcube24_decode(uint code) { return warpedcube_decode(code, 11u, 10u); }
vec3 warpedcube32_decode(uint code) { return warpedcube_decode(code, 15u, 14u); }

#endif
