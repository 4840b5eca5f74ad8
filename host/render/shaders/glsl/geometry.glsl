// The push constants of the geometry pass.

layout(push_constant) uniform Geometry {
    mat4 clip_from_object;
    // Rows of a rotation; w is unused.
    vec4 world_from_object[3];
    // 1 and up: 0 is where nothing is drawn.
    uint object;
    uint flags;
    // What the offset of a dithered code comes from.
    uint key;
    // Moves the keys that belong to the screen.
    uint seed;
};

// A flag: normals are the points of a conformance run, not to be rotated and normalised.
const uint RAW = 1u;
