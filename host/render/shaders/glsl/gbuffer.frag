// The geometry pass: writes the normal's code, the normal and the position. The compiler is given what storage.glsl names.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include "storage.glsl"
#include "key.glsl"
#include "geometry.glsl"

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec3 object_position;
layout(location = 0) out VALUE stored;
layout(location = 1) out vec4 normal;
// In object space, with the object's number as the fourth component.
layout(location = 2) out vec4 surface;

void main() {
    vec3 n = (flags & RAW) != 0u ? world_normal : unitvec_normalize(world_normal);
    stored = value_of(n, dither_offset(key, seed, gl_FragCoord.xy, object_position));
    normal = vec4(n, 1.0);
    surface = vec4(object_position, float(object));
}
