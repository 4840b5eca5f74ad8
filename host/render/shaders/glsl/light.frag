// The lighting pass: decodes the normal of a pixel and lights it. The compiler is given what storage.glsl names.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include "storage.glsl"
#include "key.glsl"
#include "shading.glsl"

layout(push_constant) uniform Lighting {
    // A pixel's ray is forward + right x + up y, with (x, y) = centre * viewport.xy + viewport.zw.
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 viewport;
    uint material;
    uint flags;
    uint key;
    uint seed;
};

// A flag: codes of a conformance run, to be decoded and not lit.
const uint RAW = 1u;

layout(set = 0, binding = 0) uniform TEXTURE stored;
layout(set = 0, binding = 1) uniform texture2D surfaces;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 normal;

vec3 view_ray(vec2 centre) {
    UNITVEC_PRECISE vec2 place = centre * viewport.xy + viewport.zw;
    UNITVEC_PRECISE vec3 ray = (forward.xyz + right.xyz * place.x) + up.xyz * place.y;
    return unitvec_normalize(ray);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(surfaces, pixel, 0);
    VALUE value = texelFetch(stored, pixel, 0);
    vec3 n = NORMAL_OF(value, dither_offset(key, seed, gl_FragCoord.xy, surface.xyz));
    normal = vec4(n, 1.0);
    vec3 lit = vec3(0.0);
    if ((flags & RAW) == 0u) {
        vec3 ray = view_ray(gl_FragCoord.xy);
        lit = seen(material, surface.w, unitvec_normalize(n), ray);
    }
    colour = vec4(lit, 1.0);
}
