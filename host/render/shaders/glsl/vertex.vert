// The geometry pass: vertices whose normals are stored in a codec's format. The compiler is given what storage.glsl names.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "storage.glsl"
#include "geometry.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in ATTRIBUTE stored_normal;
layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec3 object_position;

vec4 to_clip(vec3 p) {
    UNITVEC_PRECISE vec4 clip = ((clip_from_object[0] * p.x + clip_from_object[1] * p.y) + clip_from_object[2] * p.z)
        + clip_from_object[3];
    return clip;
}

vec3 to_world(vec3 n) {
    return vec3(unitvec_dot(world_from_object[0].xyz, n), unitvec_dot(world_from_object[1].xyz, n),
        unitvec_dot(world_from_object[2].xyz, n));
}

void main() {
    vec3 n = NORMAL_OF(stored_normal, vec2(0.0));
    world_normal = (flags & RAW) != 0u ? n : to_world(n);
    object_position = position;
    gl_Position = to_clip(position);
    gl_PointSize = 1.0;
}
