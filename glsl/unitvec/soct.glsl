// unitvec: signed octahedral codes of 17, 25 and 33 bits.
//
// Source: White 2017, "Signed Octahedron Normal Encoding"; Cigolle et al. 2014, listing 6.
//
//   soct17_encode(v), soct17_decode(code)        also soct25, and soct33, whose codes are a uvec2
//   float32x3_to_soct(v), soct_to_float32x3(e)   u and v on [-1, 1], for an snorm format that the hardware converts, and
//                                                1 for z < 0, else 0
//   float32x3_to_soct_unorm(v), soct_unorm_to_float32x3(e)    the same with u and v on [0, 1], for a unorm format
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction or with NaN. u
// and v are clamped, 0 where one is NaN, and below the equator is where the third is 1/2 or more. Layout: u = x + y and
// v = x - y of (x, y, |z|) in two's complement snorm as in hemioct.glsl, u lowest, and above them 1 for z < 0. Of the
// 33 bits the sign is bit 0 of the second word.

#ifndef UNITVEC_SOCT_GLSL
#define UNITVEC_SOCT_GLSL

#ifndef UNITVEC_HEMIOCT_GLSL
#include "hemioct.glsl"
#endif

precision highp float;
precision highp int;

// The code of u and v, of `bits` bits each, of the direction of v of this L1 norm.
uint unitvec_soct_pair(vec3 v, float norm, uint bits) {
    return unitvec_nearest_pair(unitvec_hemioct_position(v, norm, unitvec_snorm_max(bits)), bits);
}

// The direction of a point of [-m, m]^2 and the sign, in bit 31: unit length to within 2 ULP. z is the difference of two
// numbers that both have the sign, since a sum of them may be 0, which has none.
vec3 unitvec_soct_from_lattice(vec2 e, uint sign_bit, float m) {
    uint below = sign_bit & UNITVEC_SIGN_BIT;
    float across = 2.0 * max(abs(e.x), abs(e.y));
    UNITVEC_PRECISE vec3 v =
        vec3(e.x + e.y, e.x - e.y, unitvec_flip_sign(2.0 * m, below) - unitvec_flip_sign(across, below));
    return unitvec_normalize_octahedral(v, m, m + 1.0);
}

// The direction of the code of u and v, of `bits` bits each, and the sign, in bit 31.
vec3 unitvec_soct_from_parts(uint code, uint sign_bit, uint bits) {
    return unitvec_soct_from_lattice(unitvec_snorm_integers(code, bits), sign_bit, unitvec_snorm_max(bits));
}

// The unquantised projection: u and v on [-1, 1], and 1 for z < 0, else 0.
vec3 float32x3_to_soct(vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec3 e = vec3(unitvec_hemioct_position(v, norm, 1.0), unitvec_is_negative(v.z) ? 1.0 : 0.0);
    return unitvec_is_usable(norm) ? e : vec3(0.0);
}

// The direction of u and v on [-1, 1], below the equator where e.z is 1/2 or more.
vec3 soct_to_float32x3(vec3 e) {
    uint sign_bit = unitvec_is_set(e.z) ? UNITVEC_SIGN_BIT : 0u;
    return unitvec_soct_from_lattice(unitvec_snorm_clamp(e.xy), sign_bit, 1.0);
}

// Variants with u and v on [0, 1], for a UNORM format.
vec3 float32x3_to_soct_unorm(vec3 v) {
    vec3 e = float32x3_to_soct(v);
    return vec3(unitvec_biased(e.xy), e.z);
}
vec3 soct_unorm_to_float32x3(vec3 e) { return soct_to_float32x3(vec3(unitvec_unbiased(e.xy), e.z)); }

uint unitvec_soct_encode(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    uint code = unitvec_soct_pair(v, norm, bits / 2u) | (unitvec_is_negative(v.z) ? 1u << (bits - 1u) : 0u);
    return unitvec_is_usable(norm) ? code : 0u;
}

vec3 unitvec_soct_decode(uint code, uint bits) {
    return unitvec_soct_from_parts(code, code << (32u - bits), bits / 2u);
}

uint soct17_encode(vec3 v) { return unitvec_soct_encode(v, 17u); }
uint soct25_encode(vec3 v) { return unitvec_soct_encode(v, 25u); }

uvec2 soct33_encode(vec3 v) {
    float norm = unitvec_l1_norm(v);
    uvec2 code = uvec2(unitvec_soct_pair(v, norm, 16u), unitvec_is_negative(v.z) ? 1u : 0u);
    return unitvec_is_usable(norm) ? code : uvec2(0u);
}

vec3 soct17_decode(uint code) { return unitvec_soct_decode(code, 17u); }
vec3 soct25_decode(uint code) { return unitvec_soct_decode(code, 25u); }
vec3 soct33_decode(uvec2 code) {
    return unitvec_soct_from_parts(code.x, code.y << 31u, 16u);
}

#endif
