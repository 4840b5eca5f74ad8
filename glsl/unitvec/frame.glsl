// unitvec: tangent frames, a normal, a tangent and a handedness, in 32 and 64 bits.
//
// Sources: Duff et al. 2017 for the basis about the normal, Ong 2023 for the tangent's place in it; the normal is that
// of oct.glsl.
//
//   frame32_encode(normal, tangent)                  code as uint; tangent.w is the handedness
//   frame32_decode(code, out normal, out tangent)    tangent.w is +1 or -1
//   frame64_encode(normal, tangent), ...             codes as uvec2, low word first
//
// The bitangent is tangent.w * cross(normal, tangent.xyz), as in glTF. Any vectors will do: lengths do not matter; +Z
// stands in for a normal that has no direction, the first vector of the basis for a tangent that has none in the plane
// of the decoded normal. Layout: the normal's x in the low 11 (21) bits, y in the next, two's complement snorm; then 9
// (21) bits of the tangent's angle about the decoded normal; at the top 1 for a handedness of -1.

#ifndef UNITVEC_FRAME_GLSL
#define UNITVEC_FRAME_GLSL

#ifndef UNITVEC_OCT_GLSL
#include "oct.glsl"
#endif

precision highp float;
precision highp int;

// Two unit vectors that make an orthonormal basis with the decoded normal n, whose z is not -0: right-handed, (first,
// second, n).
void unitvec_frame_basis(vec3 n, out vec3 first, out vec3 second) {
    float s = unitvec_with_sign(1.0, n.z);
    UNITVEC_PRECISE float beyond = s + n.z;
    float a = unitvec_signed_quotient(-1.0, beyond);
    UNITVEC_PRECISE float b = (n.x * n.y) * a;
    UNITVEC_PRECISE vec3 e = vec3(1.0 + s * ((n.x * n.x) * a), s * b, -(s * n.x));
    UNITVEC_PRECISE vec3 f = vec3(b, s + (n.y * n.y) * a, -n.y);
    first = e;
    second = f;
}

// Code of the angle of `tangent` about the decoded normal n. A tangent must have more of its L1 norm left in the plane
// than the part `parallel`, along both axes together.
uint unitvec_frame_angle_code(vec3 n, vec3 tangent, uint angle_bits, float parallel) {
    vec3 first;
    vec3 second;
    unitvec_frame_basis(n, first, second);
    float x = unitvec_dot(tangent, first);
    float y = unitvec_dot(tangent, second);
    float norm = unitvec_l1_norm(tangent);
    UNITVEC_PRECISE float sum = abs(x) + abs(y);
    UNITVEC_PRECISE float least = parallel * norm;
    bool usable = unitvec_is_usable(norm) && sum > least;
    uint code = unitvec_diamond_code(x, y, sum, angle_bits);
    return usable ? code : 0u;
}

// Tangent of an angle's code, about the decoded normal n: unit length to within 2 ULP.
vec3 unitvec_frame_tangent(vec3 n, uint code, uint angle_bits) {
    vec3 first;
    vec3 second;
    unitvec_frame_basis(n, first, second);
    vec2 p = unitvec_diamond_point(code, angle_bits);
    UNITVEC_PRECISE vec3 t = first * p.x + second * p.y;
    return unitvec_normalize(t);
}

// 1 for a handedness below zero, 0 for any other, zeros, denormals and NaN included, by a comparison of integers.
uint unitvec_frame_handedness_code(float handedness) {
    return floatBitsToUint(handedness) - 0x80800000u < 0x7f000001u ? 1u : 0u;
}

// -1 where bit 31 of a code is set, else +1.
float unitvec_frame_handedness(uint code) {
    return unitvec_flip_sign(1.0, code & UNITVEC_SIGN_BIT);
}

uint frame32_encode(vec3 normal, vec4 tangent) {
    float m = unitvec_snorm_max(11u);
    vec2 e = unitvec_oct_lattice_precise(normal, m);
    uint angle = unitvec_frame_angle_code(unitvec_oct_from_lattice(e, m), tangent.xyz, 9u, 0.00390625);
    return unitvec_nearest_pair(e, 11u) | (angle << 22u) | (unitvec_frame_handedness_code(tangent.w) << 31u);
}

uvec2 frame64_encode(vec3 normal, vec4 tangent) {
    float m = unitvec_snorm_max(21u);
    vec2 e = unitvec_oct_lattice_precise(normal, m);
    uint angle = unitvec_frame_angle_code(unitvec_oct_from_lattice(e, m), tangent.xyz, 21u, 3.814697265625e-6);
    uint x = unitvec_nearest_code(e.x, 21u);
    uint y = unitvec_nearest_code(e.y, 21u);
    return uvec2(x | (y << 21u), (y >> 11u) | (angle << 10u) | (unitvec_frame_handedness_code(tangent.w) << 31u));
}

void frame32_decode(uint code, out vec3 normal, out vec4 tangent) {
    normal = oct22_decode(code);
    tangent = vec4(unitvec_frame_tangent(normal, code >> 22u, 9u), unitvec_frame_handedness(code));
}

void frame64_decode(uvec2 code, out vec3 normal, out vec4 tangent) {
    vec2 e = vec2(unitvec_snorm_integer(code.x, 21u), unitvec_snorm_integer((code.x >> 21u) | (code.y << 11u), 21u));
    normal = unitvec_oct_from_lattice(e, unitvec_snorm_max(21u));
    tangent = vec4(unitvec_frame_tangent(normal, code.y >> 10u, 21u), unitvec_frame_handedness(code.y));
}

#endif
