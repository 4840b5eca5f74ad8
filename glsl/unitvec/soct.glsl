// unitvec: signed octahedral codes of 17, 25 and 33 bits.
//
// Source: White 2017, "Signed Octahedron Normal Encoding"; Cigolle et al. 2014, listing 6.
//
//   soct17_encode(v), soct17_decode(code)      also soct25, and soct33, whose codes are a uvec2
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Layout: u = x + y
// and v = x - y of (x, y, |z|) in two's complement snorm as in hemioct.glsl, u lowest, and above them 1 for z < 0. Of
// the 33 bits the sign is bit 0 of the second word.

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

// The direction of the code of u and v, of `bits` bits each, and the sign, in bit 31: unit length to within 2 ULP. z is the
// difference of two numbers that both have the sign, since a sum of them may be 0, which has none.
vec3 unitvec_soct_from_parts(uint code, uint sign_bit, uint bits) {
    vec2 e = unitvec_snorm_integers(code, bits);
    float below = uintBitsToFloat(sign_bit & UNITVEC_SIGN_BIT);
    float across = 2.0 * max(abs(e.x), abs(e.y));
    UNITVEC_PRECISE vec3 v = vec3(e.x + e.y, e.x - e.y,
        unitvec_with_sign(2.0 * unitvec_snorm_max(bits), below) - unitvec_with_sign(across, below));
    return unitvec_normalize(v);
}

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
