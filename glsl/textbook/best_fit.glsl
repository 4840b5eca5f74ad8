// Textbook, only to measure against: best fit normals, Kaplanyan 2010, "CryENGINE 3: Reaching the speed of light". The
// vector is scaled to the length that a table of 1024 x 1024 bytes, the texture's size in use, gives for its direction,
// where rounding turns it least, and stored as three snorm bytes. The table is addressed by the direction's point on the unit cube, folded to x >= y: x,
// and y over x.

#ifndef TEXTBOOK_BEST_FIT_GLSL
#define TEXTBOOK_BEST_FIT_GLSL

#ifdef TABLE
float textbook_best_fit_length(vec2 place) {
    uvec2 texel = min(uvec2(place * 1024.0), uvec2(1023u));
    uint index = texel.y * 1024u + texel.x;
    return float((table_words[index / 4u] >> (8u * (index % 4u))) & 255u) / 127.0;
}

uint textbook_crytek_bfn24_encode(vec3 v) {
    vec3 a = abs(v);
    float largest = max(max(a.x, a.y), a.z);
    vec2 others = a.z < largest ? (a.y < largest ? a.yz : a.xz) : a.xy;
    others = others.x < others.y ? others.yx : others;
    vec2 place = vec2(others.x / largest, others.y / others.x);
    return packSnorm4x8(vec4(v / largest * textbook_best_fit_length(place), 0.0));
}
#endif

vec3 textbook_crytek_bfn24_decode(uint code) { return normalize(unpackSnorm4x8(code).xyz); }

#endif
