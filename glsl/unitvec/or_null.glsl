// unitvec: null codes, for vectors without a direction, of any codec that has one.
//
//   code_or_null(v, code, null_code)         code, or null_code where v has no direction: zero, infinite, NaN
//   vector_or_zero(v, code, null_code)       the decoded vector v, or (0, 0, 0) where the code is null_code
//   code_or_null_wide, vector_or_zero_wide   the same for codes of two words, uvec2
//
// docs/codecs.md lists the null codes; that of oct32 is 0x8000u:
//
//   uint code = code_or_null(v, oct32_encode(v), 0x8000u);
//   vec3 back = vector_or_zero(oct32_decode(code), code, 0x8000u);
//
// Bits above the code must be 0. Through an SNORM format most null codes do not come back: take an integer format.

#ifndef UNITVEC_OR_NULL_GLSL
#define UNITVEC_OR_NULL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

uint code_or_null(vec3 v, uint code, uint null_code) {
    return unitvec_is_usable(unitvec_l1_norm(v)) ? code : null_code;
}

vec3 vector_or_zero(vec3 v, uint code, uint null_code) {
    return code == null_code ? vec3(0.0) : v;
}

uvec2 code_or_null_wide(vec3 v, uvec2 code, uvec2 null_code) {
    return unitvec_is_usable(unitvec_l1_norm(v)) ? code : null_code;
}

vec3 vector_or_zero_wide(vec3 v, uvec2 code, uvec2 null_code) {
    return code.x == null_code.x && code.y == null_code.y ? vec3(0.0) : v;
}

#endif
