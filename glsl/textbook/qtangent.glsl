// Textbook, only to measure against: a tangent frame as a quaternion, Frey and Herzberg 2011, "Spherical skinning with
// dual quaternions and QTangents". A quaternion and its negative are one rotation, so that the sign of w is free for the
// handedness; where w would be stored as 0 it gets the least step, and the rest gets shorter.

#ifndef TEXTBOOK_QTANGENT_GLSL
#define TEXTBOOK_QTANGENT_GLSL

// The quaternion that turns X to the tangent and Z to the normal, by a component that is not small: Shepperd 1978.
vec4 textbook_frame_quaternion(vec3 n, vec3 t) {
    vec3 b = cross(n, t);
    // Four times the squares of x, y, z and w; sums and differences are four times products.
    vec4 s = vec4(t.x - b.y - n.z, b.y - t.x - n.z, n.z - t.x - b.y, t.x + b.y + n.z) + 1.0;
    vec3 sums = vec3(b.z + n.y, n.x + t.z, t.y + b.x);
    vec3 differences = vec3(b.z - n.y, n.x - t.z, t.y - b.x);
    if (s.w >= 1.0) return normalize(vec4(differences, s.w));
    if (s.x >= max(s.y, s.z)) return normalize(vec4(s.x, sums.z, sums.y, differences.x));
    if (s.y >= s.z) return normalize(vec4(sums.z, s.y, sums.x, differences.y));
    return normalize(vec4(sums.y, sums.x, s.z, differences.z));
}

vec4 textbook_qtangent(vec3 normal, vec4 tangent, float steps) {
    float least = 1.0 / steps;
    vec4 q = textbook_frame_quaternion(normal, tangent.xyz);
    if (q.w < 0.0) q = -q;
    if (q.w < least) q = vec4(q.xyz * sqrt(1.0 - least * least), least);
    return tangent.w < 0.0 ? -q : q;
}

void textbook_from_qtangent(vec4 q, out vec3 normal, out vec4 tangent) {
    q = normalize(q);
    normal = vec3(0.0, 0.0, 1.0) + 2.0 * vec3(q.x * q.z + q.w * q.y, q.y * q.z - q.w * q.x, -q.x * q.x - q.y * q.y);
    vec3 t = vec3(1.0, 0.0, 0.0) + 2.0 * vec3(-q.y * q.y - q.z * q.z, q.x * q.y + q.w * q.z, q.x * q.z - q.w * q.y);
    tangent = vec4(t, q.w < 0.0 ? -1.0 : 1.0);
}

uint textbook_qtangent32_encode(vec3 normal, vec4 tangent) {
    return packSnorm4x8(textbook_qtangent(normal, tangent, 127.0));
}

void textbook_qtangent32_decode(uint code, out vec3 normal, out vec4 tangent) {
    textbook_from_qtangent(unpackSnorm4x8(code), normal, tangent);
}

uvec2 textbook_qtangent64_encode(vec3 normal, vec4 tangent) {
    vec4 q = textbook_qtangent(normal, tangent, 32767.0);
    return uvec2(packSnorm2x16(q.xy), packSnorm2x16(q.zw));
}

void textbook_qtangent64_decode(uvec2 code, out vec3 normal, out vec4 tangent) {
    textbook_from_qtangent(vec4(unpackSnorm2x16(code.x), unpackSnorm2x16(code.y)), normal, tangent);
}

#endif
