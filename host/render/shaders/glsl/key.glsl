// The offset of a dithered code, from what both passes know of a pixel. Needs GL_EXT_samplerless_texture_functions.

#ifdef DITHERED
layout(set = 0, binding = 2) uniform texture2D blue_noise;

const uint KEY_PIXEL = 1u;
const uint KEY_BLUE_NOISE = 2u;
const uint KEY_POSITION = 3u;

// Where the key of a pixel is looked up in the frame of this seed: multiples of two irrational numbers, times 2^32, spread
// frames evenly.
uvec2 moved(uvec2 pixel, uint seed) {
    return pixel + ((seed * uvec2(3242174889u, 2447445414u)) >> 16u);
}

// The cell of a position, of 1/256 a side: positions themselves differ from frame to frame where an object moves, since pixels
// meet other points of it.
vec3 cell(vec3 position) {
    UNITVEC_PRECISE vec3 cells = position * 256.0;
    return floor(cells);
}

vec2 dither_offset(uint key, uint seed, vec2 pixel_centre, vec3 position) {
    uvec2 pixel = moved(uvec2(pixel_centre), seed);
    if (key == KEY_PIXEL) return dither_from_pixel(pixel);
    if (key == KEY_BLUE_NOISE) return dither_from_texel(texelFetch(blue_noise, ivec2(pixel & 63u), 0).xy);
    if (key == KEY_POSITION) return dither_from_position(cell(position));
    return vec2(0.0);
}
#else
vec2 dither_offset(uint key, uint seed, vec2 pixel_centre, vec3 position) {
    return vec2(0.0);
}
#endif
