// Textbook, only to measure against: the sphere map of G-buffers, Mittring 2009, "A bit more deferred: CryEngine 3". It is
// the Lambert azimuthal equal-area projection of the whole sphere on a disk, stored as two unorm.

#ifndef TEXTBOOK_SPHEREMAP_GLSL
#define TEXTBOOK_SPHEREMAP_GLSL

// The disk has the radius 1/2 about (1/2, 1/2).
vec2 textbook_spheremap(vec3 v) {
    return v.xy / sqrt(8.0 * v.z + 8.0) + 0.5;
}

vec3 textbook_from_spheremap(vec2 e) {
    vec2 p = 4.0 * e - 2.0;
    float square = dot(p, p);
    return vec3(p * sqrt(1.0 - square / 4.0), 1.0 - square / 2.0);
}

uint textbook_spheremap16_encode(vec3 v) { return packUnorm4x8(vec4(textbook_spheremap(v), 0.0, 0.0)); }
uint textbook_spheremap32_encode(vec3 v) { return packUnorm2x16(textbook_spheremap(v)); }

vec3 textbook_spheremap16_decode(uint code) { return textbook_from_spheremap(unpackUnorm4x8(code).xy); }
vec3 textbook_spheremap32_decode(uint code) { return textbook_from_spheremap(unpackUnorm2x16(code)); }

#endif
