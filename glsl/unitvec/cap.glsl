// unitvec: any codec over the directions within an angle of an axis, or with more codes on one side of an axis.
//
// Functions of vectors around the functions of a codec, whose bits the result has:
//
//   vec4 cap = cap_about(axis, radians(20.0));
//   uint code = hemioct16p_encode(cap_to_hemisphere(v, cap));
//   vec3 back = hemisphere_to_cap(hemioct16p_decode(code), cap);
//
//   cap_about(axis, half_angle)     the cap: its axis at unit length, +Z where it has no direction, and
//                                   (1 - cos half_angle) / 2. Radians, 2^-12 to 120 degrees; larger ones and NaN are
//                                   the whole sphere, for a hemisphere's codec 120 degrees
//   cap_to_hemisphere(v, cap)       what a codec of the hemisphere is to encode: the better choice
//   hemisphere_to_cap(u, cap)       the direction that the codec's vector u, of unit length, stands for
//   cap_to_sphere, sphere_to_cap    the same for a codec of the sphere, a quarter of whose codes stay unused
//   dense_about(axis, ratio)        `ratio` times as many codes in front of the axis as behind, 1 to 64
//   dense_to_sphere(v, dense), sphere_to_dense(u, dense)    the same for these, and a codec of the sphere
//
// The maps keep areas, and shrink the codec's error by up to the root of the area's part. Any v will do: those outside
// of the cap get the nearest direction of its rim, those without a direction the axis. The Rust crate's module `wrap`
// has the error.

#ifndef UNITVEC_CAP_GLSL
#define UNITVEC_CAP_GLSL

#ifndef UNITVEC_FRAME_GLSL
#include "frame.glsl"
#endif

precision highp float;
precision highp int;

// 2^-80, the least that x^2 + y^2 counts as. So no denormal counts.
const float UNITVEC_CAP_LEAST_SQUARE = 8.271806125530277e-25;

// 2^-12, the least half-angle.
const float UNITVEC_CAP_LEAST_ANGLE = 0.000244140625;

// (1 - cos b) / 2 of the part of a sphere's codec that a cap fills, for b = 120 degrees, and the cotangent of b.
const float UNITVEC_CAP_SPHERE_PART = 0.75;
const float UNITVEC_CAP_SPHERE_RIM = -0.57735026;

// A direction by its place about an axis: its components across, the square of their length, 1 - |cos| and 1 + |cos| of
// its angle from the axis, and whether that is beyond 90 degrees.
struct UnitvecCapPlace {
    float x;
    float y;
    float square;
    float near_part;
    float far_part;
    bool behind;
};

// The place of a unit vector, its last component along the axis.
UnitvecCapPlace unitvec_cap_place(vec3 u) {
    UNITVEC_PRECISE float far_part = 1.0 + min(abs(u.z), 1.0);
    UNITVEC_PRECISE float sum = u.x * u.x + u.y * u.y;
    float square = max(sum, UNITVEC_CAP_LEAST_SQUARE);
    float near_part = unitvec_quotient(square, far_part);
    UnitvecCapPlace at = UnitvecCapPlace(u.x, u.y, square, near_part, far_part, unitvec_is_negative(u.z));
    return at;
}

// The place of the direction of v about a unit axis; that of the axis where v has none. The difference from the axis,
// or its opposite, keeps small angles exact.
UnitvecCapPlace unitvec_cap_place_about(vec3 axis, vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec3 n = unitvec_is_usable(norm) ? unitvec_normalize(unitvec_scaled_to_one(v, norm)) : axis;
    float z = unitvec_dot(n, axis);
    UNITVEC_PRECISE vec3 sum = n + axis;
    UNITVEC_PRECISE vec3 difference = n - axis;
    vec3 off = unitvec_is_negative(z) ? sum : difference;
    vec3 first;
    vec3 second;
    unitvec_frame_basis(axis, first, second);
    return unitvec_cap_place(vec3(unitvec_dot(off, first), unitvec_dot(off, second), z));
}

// 2 - k (1 - cos), exact beside its size for a k of 1 too.
float unitvec_cap_rest(UnitvecCapPlace at, float k) {
    UNITVEC_PRECISE float part = k * at.near_part;
    UNITVEC_PRECISE float from_behind = 2.0 * (1.0 - k) + part;
    UNITVEC_PRECISE float from_front = 2.0 - part;
    return at.behind ? from_behind : from_front;
}

// (x, y) and the square of its length, (1, 0) where that has no direction.
vec3 unitvec_cap_azimuth(UnitvecCapPlace at) {
    return at.square > UNITVEC_CAP_LEAST_SQUARE ? vec3(at.x, at.y, at.square) : vec3(1.0, 0.0, 1.0);
}

// The unit vector of components e along the basis of a unit axis, and 1 - h along this axis or, where `behind`, its
// opposite; that itself for an e of 0.
vec3 unitvec_cap_lifted(vec3 axis, bool behind, vec2 e, float h) {
    vec3 first;
    vec3 second;
    unitvec_frame_basis(axis, first, second);
    vec3 along = behind ? -axis : axis;
    UNITVEC_PRECISE vec3 v = along + ((first * e.x + second * e.y) - along * h);
    vec3 pole = h > 1.0 ? -along : along;
    return unitvec_without_denormals(e.x == 0.0 && e.y == 0.0 ? pole : unitvec_normalize(v));
}

// The direction of v at unit length, +Z where it has none.
vec3 unitvec_cap_axis(vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec3 n = unitvec_is_usable(norm) ? unitvec_normalize(unitvec_scaled_to_one(v, norm)) : vec3(0.0, 0.0, 1.0);
    return unitvec_without_denormals(n);
}

vec4 cap_about(vec3 axis, float half_angle) {
    float within = min(max(half_angle, UNITVEC_CAP_LEAST_ANGLE), UNITVEC_PI);
    float angle = unitvec_is_nan(half_angle) ? UNITVEC_PI : within;
    UNITVEC_PRECISE float half_of_it = 0.5 * angle;
    float chord = unitvec_sin(half_of_it);
    UNITVEC_PRECISE float area = chord * chord;
    return vec4(unitvec_cap_axis(axis), area);
}

// The map from a cap to the part `image` of the codec's sphere, whose rim has the cotangent `rim`.
vec3 unitvec_cap_image(vec3 v, vec3 axis, float area, float image, float rim) {
    UnitvecCapPlace at = unitvec_cap_place_about(axis, v);
    float h = at.behind ? at.far_part : at.near_part;
    float rest = at.behind ? at.near_part : at.far_part;
    float k = unitvec_quotient(image, area);
    UNITVEC_PRECISE float product = k * max(unitvec_cap_rest(at, k), 0.0);
    float across = unitvec_root(unitvec_quotient(product, rest));
    UNITVEC_PRECISE vec3 inside = vec3(at.x * across, at.y * across, 1.0 - k * h);
    vec3 azimuth = unitvec_cap_azimuth(at);
    UNITVEC_PRECISE float height = unitvec_root(azimuth.z) * rim;
    UNITVEC_PRECISE float most = 2.0 * area;
    return h > most ? vec3(azimuth.xy, height) : inside;
}

// The inverse of unitvec_cap_image, which gives the rim for what lies beyond.
vec3 unitvec_cap_of_image(vec3 u, vec3 axis, float area, float image) {
    UnitvecCapPlace at = unitvec_cap_place(u);
    float h = at.behind ? at.far_part : at.near_part;
    float rest = at.behind ? at.near_part : at.far_part;
    float k = unitvec_quotient(area, image);
    vec3 azimuth = unitvec_cap_azimuth(at);
    UNITVEC_PRECISE float most = 2.0 * image;
    bool beyond = h > most;
    UNITVEC_PRECISE float at_rim = (4.0 * area) * (1.0 - area);
    UNITVEC_PRECISE float product = k * unitvec_cap_rest(at, k);
    float across = unitvec_root(unitvec_quotient(beyond ? at_rim : product, beyond ? azimuth.z : rest));
    UNITVEC_PRECISE float rim_height = 2.0 * area;
    UNITVEC_PRECISE float height = k * h;
    UNITVEC_PRECISE vec2 e = (beyond ? azimuth.xy : vec2(at.x, at.y)) * across;
    return unitvec_cap_lifted(axis, false, e, beyond ? rim_height : height);
}

vec3 cap_to_hemisphere(vec3 v, vec4 cap) {
    return unitvec_cap_image(v, cap.xyz, min(cap.w, UNITVEC_CAP_SPHERE_PART), 0.5, 0.0);
}

vec3 hemisphere_to_cap(vec3 u, vec4 cap) {
    return unitvec_cap_of_image(u, cap.xyz, min(cap.w, UNITVEC_CAP_SPHERE_PART), 0.5);
}

vec3 cap_to_sphere(vec3 v, vec4 cap) {
    bool whole = cap.w > UNITVEC_CAP_SPHERE_PART;
    float image = whole ? 1.0 : UNITVEC_CAP_SPHERE_PART;
    return unitvec_cap_image(v, cap.xyz, whole ? 1.0 : cap.w, image, UNITVEC_CAP_SPHERE_RIM);
}

vec3 sphere_to_cap(vec3 u, vec4 cap) {
    bool whole = cap.w > UNITVEC_CAP_SPHERE_PART;
    return unitvec_cap_of_image(u, cap.xyz, whole ? 1.0 : cap.w, whole ? 1.0 : UNITVEC_CAP_SPHERE_PART);
}

vec4 dense_about(vec3 axis, float ratio) {
    float within = unitvec_is_nan(ratio) ? 1.0 : min(max(ratio, 1.0), 64.0);
    UNITVEC_PRECISE float sum = within + 1.0;
    return vec4(unitvec_cap_axis(axis), unitvec_over(2.0, sum));
}

vec3 dense_to_sphere(vec3 v, vec4 dense) {
    UnitvecCapPlace at = unitvec_cap_place_about(dense.xyz, v);
    UNITVEC_PRECISE float front = 2.0 - dense.w;
    float k = at.behind ? dense.w : front;
    UNITVEC_PRECISE float product = k * (2.0 - k * at.near_part);
    float across = unitvec_root(unitvec_quotient(product, at.far_part));
    UNITVEC_PRECISE float z = 1.0 - k * at.near_part;
    UNITVEC_PRECISE vec2 e = vec2(at.x, at.y) * across;
    return vec3(e, at.behind ? -z : z);
}

vec3 sphere_to_dense(vec3 u, vec4 dense) {
    UnitvecCapPlace at = unitvec_cap_place(u);
    float from_front = at.behind ? at.far_part : at.near_part;
    float from_behind = at.behind ? at.near_part : at.far_part;
    UNITVEC_PRECISE float front = 2.0 - dense.w;
    bool is_front = from_front <= front;
    float k = is_front ? front : dense.w;
    float h = min(unitvec_quotient(is_front ? from_front : from_behind, k), 1.0);
    UNITVEC_PRECISE float rest = 2.0 - h;
    UNITVEC_PRECISE float product = k * (is_front ? from_behind : from_front);
    float across = unitvec_root(unitvec_quotient(rest, product));
    UNITVEC_PRECISE vec2 e = vec2(at.x, at.y) * across;
    return unitvec_cap_lifted(dense.xyz, !is_front, e, h);
}

#endif
