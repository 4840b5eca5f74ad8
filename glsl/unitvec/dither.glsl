// unitvec: codes with subtractive dither, whose errors do not line up in bands.
//
//   oct16_encode_dithered(v, offset), oct16_decode_dithered(code, offset)    so for all widths of oct, hemioct, soct, eaoct
//   oct16p_encode_dithered(v, offset), ...       and of the precise encoders
//   dither_from_key(key)                         an offset from a vertex index, or another number that both sides know
//   dither_from_pixel(pixel)                     from a pixel
//   dither_from_texel(texel)                     from a texel of a tile of noise in R8G8_UNORM
//   dither_from_position(position)               from the bits of a position, best in the object's own coordinates
//
// Encoder and decoder need the same offset, in steps of the code's lattice. The encoder rounds the position moved by it, and the
// decoder moves the lattice point back. Offset (0, 0) gives the code of the fast encoder, and its decoded vector, exactly.
//
// All take any input. Components of an offset are clamped to [-1/2, 1/2], and 0 for NaN; of v the length does not
// matter, and +Z stands in for vectors without a direction. Layout: that of the codec.

#ifndef UNITVEC_DITHER_GLSL
#define UNITVEC_DITHER_GLSL

#ifndef UNITVEC_EAOCT_GLSL
#include "eaoct.glsl"
#endif
#ifndef UNITVEC_SOCT_GLSL
#include "soct.glsl"
#endif

precision highp float;
precision highp int;

// Every bit of the result depends on every bit of x. The multipliers are those of C. Wellons' "lowbias32". The sum makes 0 a key
// as good as others.
uint unitvec_dither_hash(uint x) {
    x = x + 0x9e3779b9u;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

// The middle of one of 2^16 intervals of [-1/2, 1/2]: every step is exact.
vec2 unitvec_dither_components(uint bits) {
    vec2 whole = vec2(float(bits & 0xffffu), float(bits >> 16u));
    UNITVEC_PRECISE vec2 middle = (whole + 0.5) * 0.0000152587890625 - 0.5;
    return middle;
}

vec2 dither_from_key(uint key) { return unitvec_dither_components(unitvec_dither_hash(key)); }

// To have other offsets in each frame, add the frame's number, times some large odd number, to a component.
vec2 dither_from_pixel(uvec2 pixel) { return dither_from_key(pixel.x ^ unitvec_dither_hash(pixel.y)); }

// The middles of 256 intervals of [-1/2, 1/2].
vec2 dither_from_texel(vec2 texel) {
    UNITVEC_PRECISE vec2 middle = texel * 0.99609375 - 0.498046875;
    return middle;
}

// The bits of a coordinate; zeros of both signs and denormals, which some devices flush, give the same bits.
uint unitvec_dither_coordinate(float x) {
    return abs(x) < UNITVEC_MIN_POSITIVE ? 0u : floatBitsToUint(x);
}

vec2 dither_from_position(vec3 position) {
    uint x = unitvec_dither_hash(unitvec_dither_coordinate(position.x));
    uint xy = unitvec_dither_hash(x ^ unitvec_dither_coordinate(position.y));
    return dither_from_key(xy ^ unitvec_dither_coordinate(position.z));
}

// An offset's component, clamped to [-1/2, 1/2]; 0 for NaN.
float unitvec_dither_component(float x) {
    return unitvec_is_nan(x) ? 0.0 : min(max(x, -0.5), 0.5);
}

vec2 unitvec_dither_usable(vec2 offset) {
    return vec2(unitvec_dither_component(offset.x), unitvec_dither_component(offset.y));
}

// A position, moved by an offset, within the square [-m, m]^2.
vec2 unitvec_dither_moved(vec2 position, vec2 offset, float m) {
    UNITVEC_PRECISE vec2 moved = position + unitvec_dither_usable(offset);
    return min(max(moved, -m), m);
}

// A lattice point, moved back.
vec2 unitvec_dither_moved_back(vec2 e, vec2 offset, float m) {
    UNITVEC_PRECISE vec2 moved = e - unitvec_dither_usable(offset);
    return min(max(moved, -m), m);
}

// The direction of v, of this L1 norm, at unit length. Unspecified without a usable direction.
vec3 unitvec_dither_unit(vec3 v, float norm) {
    return unitvec_normalize(unitvec_scaled_to_one(v, norm));
}

// A lattice point that decodes to `decoded`, and the square of its chord from n.
vec3 unitvec_dither_candidate(vec2 e, vec3 decoded, vec3 n) {
    UNITVEC_PRECISE vec3 off = decoded - n;
    return vec3(e, unitvec_dot(off, off));
}

// b where it is nearer, else a.
vec3 unitvec_dither_nearer(vec3 a, vec3 b) {
    return b.z < a.z ? b : a;
}

// oct

uint unitvec_dither_oct_encode(vec3 v, vec2 offset, uint bits) {
    float norm = unitvec_l1_norm(v);
    float m = unitvec_snorm_max(bits / 2u);
    vec2 e = unitvec_dither_moved(unitvec_oct_position(v, norm, m), offset, m);
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

vec3 unitvec_dither_oct_corner(vec2 e, vec2 offset, vec3 n, float m) {
    vec3 decoded = unitvec_oct_from_lattice(unitvec_dither_moved_back(e, offset, m), m);
    return unitvec_dither_candidate(e, decoded, n);
}

// The best of the four corners of the moved point's cell.
uint unitvec_dither_oct_encode_precise(vec3 v, vec2 offset, uint bits) {
    float norm = unitvec_l1_norm(v);
    float m = unitvec_snorm_max(bits / 2u);
    vec3 n = unitvec_dither_unit(v, norm);
    UNITVEC_PRECISE float last = m - 1.0;
    vec2 low = min(floor(unitvec_dither_moved(unitvec_oct_position(v, norm, m), offset, m)), last);
    UNITVEC_PRECISE vec2 high = low + 1.0;
    vec3 near = unitvec_dither_oct_corner(low, offset, n, m);
    vec3 right = unitvec_dither_oct_corner(vec2(high.x, low.y), offset, n, m);
    vec3 up = unitvec_dither_oct_corner(vec2(low.x, high.y), offset, n, m);
    vec3 far = unitvec_dither_oct_corner(high, offset, n, m);
    vec3 nearest = unitvec_dither_nearer(unitvec_dither_nearer(unitvec_dither_nearer(near, right), up), far);
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(nearest.xy, bits), bits);
}

vec3 unitvec_dither_oct_decode(uint code, vec2 offset, uint bits) {
    float m = unitvec_snorm_max(bits / 2u);
    return unitvec_oct_from_lattice(unitvec_dither_moved_back(unitvec_oct_unpack(code, bits), offset, m), m);
}

// hemioct

uint unitvec_dither_hemioct_encode(vec3 v, vec2 offset, uint bits) {
    vec2 norms = unitvec_hemioct_norms(v);
    float m = unitvec_snorm_max(bits / 2u);
    vec2 e = unitvec_dither_moved(unitvec_hemioct_position(v, norms.y, m), offset, m);
    uint code = unitvec_nearest_pair(e, bits / 2u);
    return unitvec_hemioct_is_usable(norms) ? code : 0u;
}

vec3 unitvec_dither_hemioct_corner(vec2 e, vec2 offset, vec3 n, float m) {
    vec3 decoded = unitvec_hemioct_from_lattice(unitvec_dither_moved_back(e, offset, m), m);
    return unitvec_dither_candidate(e, decoded, n);
}

// The best of the four corners of the moved point's cell.
uint unitvec_dither_hemioct_encode_precise(vec3 v, vec2 offset, uint bits) {
    vec2 norms = unitvec_hemioct_norms(v);
    float m = unitvec_snorm_max(bits / 2u);
    vec3 n = unitvec_dither_unit(vec3(v.xy, max(v.z, 0.0)), norms.y);
    UNITVEC_PRECISE float last = m - 1.0;
    vec2 low = min(floor(unitvec_dither_moved(unitvec_hemioct_position(v, norms.y, m), offset, m)), last);
    UNITVEC_PRECISE vec2 high = low + 1.0;
    vec3 near = unitvec_dither_hemioct_corner(low, offset, n, m);
    vec3 right = unitvec_dither_hemioct_corner(vec2(high.x, low.y), offset, n, m);
    vec3 up = unitvec_dither_hemioct_corner(vec2(low.x, high.y), offset, n, m);
    vec3 far = unitvec_dither_hemioct_corner(high, offset, n, m);
    vec3 nearest = unitvec_dither_nearer(unitvec_dither_nearer(unitvec_dither_nearer(near, right), up), far);
    uint code = unitvec_nearest_pair(nearest.xy, bits / 2u);
    return unitvec_hemioct_is_usable(norms) ? code : 0u;
}

vec3 unitvec_dither_hemioct_decode(uint code, vec2 offset, uint bits) {
    float m = unitvec_snorm_max(bits / 2u);
    vec2 e = unitvec_snorm_integers(code, bits / 2u);
    return unitvec_hemioct_from_lattice(unitvec_dither_moved_back(e, offset, m), m);
}

// soct

// The code of u and v of `bits` bits each, and 1 below the equator, else 0. The code of +Z where v has no direction.
uvec2 unitvec_dither_soct_parts(vec3 v, vec2 offset, uint bits) {
    float norm = unitvec_l1_norm(v);
    float m = unitvec_snorm_max(bits);
    vec2 e = unitvec_dither_moved(unitvec_hemioct_position(v, norm, m), offset, m);
    uvec2 parts = uvec2(unitvec_nearest_pair(e, bits), unitvec_is_negative(v.z) ? 1u : 0u);
    return unitvec_is_usable(norm) ? parts : uvec2(0u);
}

vec3 unitvec_dither_soct_direction(uint code, uint sign_bit, vec2 offset, uint bits) {
    float m = unitvec_snorm_max(bits);
    vec2 e = unitvec_snorm_integers(code, bits);
    return unitvec_soct_from_lattice(unitvec_dither_moved_back(e, offset, m), sign_bit, m);
}

uint unitvec_dither_soct_encode(vec3 v, vec2 offset, uint bits) {
    uvec2 parts = unitvec_dither_soct_parts(v, offset, bits / 2u);
    return parts.x | (parts.y << (bits - 1u));
}

vec3 unitvec_dither_soct_decode(uint code, vec2 offset, uint bits) {
    return unitvec_dither_soct_direction(code, code << (32u - bits), offset, bits / 2u);
}

// eaoct: an offset's first component counts rings, its second points on a ring.

// An offset in the sense of a half octant. Rings count from +Z to -Z and points from +X towards +Y: so the octants'
// borders, where codes do not tell the octant, are like the inside. e has the octant's signs of x and y.
vec2 unitvec_dither_turned(vec2 offset, vec2 e, bool swapped, bool below) {
    vec2 usable = unitvec_dither_usable(offset);
    uint swap = swapped ? UNITVEC_SIGN_BIT : 0u;
    uint backward = (floatBitsToUint(e.x) ^ floatBitsToUint(e.y) ^ swap) & UNITVEC_SIGN_BIT;
    return vec2(unitvec_negate_if(below, usable.x), unitvec_flip_sign(usable.y, backward));
}

// The lattice point on a ring that is nearest to the direction of v, moved along the ring by a turned offset.
vec2 unitvec_dither_eaoct_point(float ring, vec3 v, UnitvecEaoctPolar p, vec2 turned, float m) {
    UNITVEC_PRECISE float along = p.turn * ring + turned.y + 0.5;
    return unitvec_eaoct_unfolded(v, p.swapped, ring, min(max(floor(along), 0.0), ring), m);
}

// The direction of a lattice point, moved back. Before the octant's edge it is the neighbour's, and beyond the octant's middle
// x and y are the other way around.
vec3 unitvec_dither_eaoct_direction(vec2 e, vec2 offset, float m) {
    UnitvecEaoctRing at = unitvec_eaoct_ring_of(e, m);
    vec2 turned = unitvec_dither_turned(offset, e, at.swapped, at.above < 0.0);
    UNITVEC_PRECISE float ring = at.ring - turned.x;
    bool past_equator = ring > m;
    UNITVEC_PRECISE float beyond_equator = 2.0 * m - ring;
    float mirrored = past_equator ? beyond_equator : ring;
    UNITVEC_PRECISE float place = at.place - turned.y;
    float turn = unitvec_signed_quotient(place, max(at.ring, 1.0));
    uint flip = turn < 0.0 ? UNITVEC_SIGN_BIT : 0u;
    vec2 signs = vec2(unitvec_flip_sign(unitvec_with_sign(1.0, e.x), at.swapped ? flip : 0u),
        unitvec_flip_sign(unitvec_with_sign(1.0, e.y), at.swapped ? 0u : flip));
    bool beyond = abs(turn) > 0.5;
    UNITVEC_PRECISE float rest = 1.0 - abs(turn);
    return unitvec_eaoct_from_ring(signs, at.ring > 0.0 ? mirrored : 0.0, beyond ? rest : abs(turn),
        at.swapped != beyond, past_equator ? -1.0 : at.above, m);
}

uint unitvec_dither_eaoct_encode(vec3 v, vec2 offset, uint bits) {
    float norm = unitvec_l1_norm(v);
    float m = unitvec_snorm_max(bits / 2u);
    UnitvecEaoctPolar p = unitvec_eaoct_polar(v, norm);
    vec2 turned = unitvec_dither_turned(offset, v.xy, p.swapped, unitvec_is_negative(v.z));
    UNITVEC_PRECISE float steps = p.radius * m + turned.x + 0.5;
    vec2 e = unitvec_dither_eaoct_point(min(floor(steps), m), v, p, turned, m);
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

// A ring's candidate: its lattice point as in the code, without the sign of 0.
vec3 unitvec_dither_eaoct_on(float ring, vec3 v, vec3 n, UnitvecEaoctPolar p, vec2 offset, vec2 turned, float m) {
    vec2 e = unitvec_dither_eaoct_point(ring, v, p, turned, m);
    e = vec2(e.x == 0.0 ? 0.0 : e.x, e.y == 0.0 ? 0.0 : e.y);
    return unitvec_dither_candidate(e, unitvec_dither_eaoct_direction(e, offset, m), n);
}

// The better of the nearest points of the two rings around the moved point.
uint unitvec_dither_eaoct_encode_precise(vec3 v, vec2 offset, uint bits) {
    float norm = unitvec_l1_norm(v);
    float m = unitvec_snorm_max(bits / 2u);
    vec3 n = unitvec_dither_unit(v, norm);
    UnitvecEaoctPolar p = unitvec_eaoct_polar(v, norm);
    vec2 turned = unitvec_dither_turned(offset, v.xy, p.swapped, unitvec_is_negative(v.z));
    UNITVEC_PRECISE float steps = p.radius * m + turned.x;
    UNITVEC_PRECISE float last = m - 1.0;
    float below = min(max(floor(steps), 0.0), last);
    UNITVEC_PRECISE float above = below + 1.0;
    vec3 inner = unitvec_dither_eaoct_on(below, v, n, p, offset, turned, m);
    vec3 outer = unitvec_dither_eaoct_on(above, v, n, p, offset, turned, m);
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(unitvec_dither_nearer(inner, outer).xy, bits), bits);
}

vec3 unitvec_dither_eaoct_decode(uint code, vec2 offset, uint bits) {
    float m = unitvec_snorm_max(bits / 2u);
    return unitvec_dither_eaoct_direction(unitvec_oct_unpack(code, bits), offset, m);
}

uint oct8_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 8u);
}
uint oct12_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 12u);
}
uint oct16_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 16u);
}
uint oct18_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 18u);
}
uint oct20_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 20u);
}
uint oct22_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 22u);
}
uint oct24_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 24u);
}
uint oct32_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode(v, offset, 32u);
}

uint oct8p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 8u);
}
uint oct12p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 12u);
}
uint oct16p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 16u);
}
uint oct18p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 18u);
}
uint oct20p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 20u);
}
uint oct22p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 22u);
}
uint oct24p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 24u);
}
uint oct32p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_oct_encode_precise(v, offset, 32u);
}

vec3 oct8_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 8u);
}
vec3 oct12_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 12u);
}
vec3 oct16_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 16u);
}
vec3 oct18_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 18u);
}
vec3 oct20_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 20u);
}
vec3 oct22_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 22u);
}
vec3 oct24_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 24u);
}
vec3 oct32_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_oct_decode(code, offset, 32u);
}

vec3 oct8p_decode_dithered(uint code, vec2 offset) { return oct8_decode_dithered(code, offset); }
vec3 oct12p_decode_dithered(uint code, vec2 offset) { return oct12_decode_dithered(code, offset); }
vec3 oct16p_decode_dithered(uint code, vec2 offset) { return oct16_decode_dithered(code, offset); }
vec3 oct18p_decode_dithered(uint code, vec2 offset) { return oct18_decode_dithered(code, offset); }
vec3 oct20p_decode_dithered(uint code, vec2 offset) { return oct20_decode_dithered(code, offset); }
vec3 oct22p_decode_dithered(uint code, vec2 offset) { return oct22_decode_dithered(code, offset); }
vec3 oct24p_decode_dithered(uint code, vec2 offset) { return oct24_decode_dithered(code, offset); }
vec3 oct32p_decode_dithered(uint code, vec2 offset) { return oct32_decode_dithered(code, offset); }

uint hemioct16_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode(v, offset, 16u);
}
uint hemioct24_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode(v, offset, 24u);
}
uint hemioct32_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode(v, offset, 32u);
}
uint hemioct16p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode_precise(v, offset, 16u);
}
uint hemioct24p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode_precise(v, offset, 24u);
}
uint hemioct32p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_hemioct_encode_precise(v, offset, 32u);
}

vec3 hemioct16_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_hemioct_decode(code, offset, 16u);
}
vec3 hemioct24_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_hemioct_decode(code, offset, 24u);
}
vec3 hemioct32_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_hemioct_decode(code, offset, 32u);
}
vec3 hemioct16p_decode_dithered(uint code, vec2 offset) {
    return hemioct16_decode_dithered(code, offset);
}
vec3 hemioct24p_decode_dithered(uint code, vec2 offset) {
    return hemioct24_decode_dithered(code, offset);
}
vec3 hemioct32p_decode_dithered(uint code, vec2 offset) {
    return hemioct32_decode_dithered(code, offset);
}

uint soct17_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_soct_encode(v, offset, 17u);
}
uint soct25_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_soct_encode(v, offset, 25u);
}

vec3 soct17_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_soct_decode(code, offset, 17u);
}
vec3 soct25_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_soct_decode(code, offset, 25u);
}

uvec2 soct33_encode_dithered(vec3 v, vec2 offset) { return unitvec_dither_soct_parts(v, offset, 16u); }
vec3 soct33_decode_dithered(uvec2 code, vec2 offset) {
    return unitvec_dither_soct_direction(code.x, code.y << 31u, offset, 16u);
}

uint eaoct16_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode(v, offset, 16u);
}
uint eaoct20_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode(v, offset, 20u);
}
uint eaoct22_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode(v, offset, 22u);
}
uint eaoct24_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode(v, offset, 24u);
}
uint eaoct32_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode(v, offset, 32u);
}

uint eaoct16p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode_precise(v, offset, 16u);
}
uint eaoct20p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode_precise(v, offset, 20u);
}
uint eaoct22p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode_precise(v, offset, 22u);
}
uint eaoct24p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode_precise(v, offset, 24u);
}
uint eaoct32p_encode_dithered(vec3 v, vec2 offset) {
    return unitvec_dither_eaoct_encode_precise(v, offset, 32u);
}

vec3 eaoct16_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_eaoct_decode(code, offset, 16u);
}
vec3 eaoct20_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_eaoct_decode(code, offset, 20u);
}
vec3 eaoct22_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_eaoct_decode(code, offset, 22u);
}
vec3 eaoct24_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_eaoct_decode(code, offset, 24u);
}
vec3 eaoct32_decode_dithered(uint code, vec2 offset) {
    return unitvec_dither_eaoct_decode(code, offset, 32u);
}

vec3 eaoct16p_decode_dithered(uint code, vec2 offset) { return eaoct16_decode_dithered(code, offset); }
vec3 eaoct20p_decode_dithered(uint code, vec2 offset) { return eaoct20_decode_dithered(code, offset); }
vec3 eaoct22p_decode_dithered(uint code, vec2 offset) { return eaoct22_decode_dithered(code, offset); }
vec3 eaoct24p_decode_dithered(uint code, vec2 offset) { return eaoct24_decode_dithered(code, offset); }
vec3 eaoct32p_decode_dithered(uint code, vec2 offset) { return eaoct32_decode_dithered(code, offset); }

#endif
