// What a surface looks like under a procedural sky. The world's up is +Y; colours are linear.
//
// Only operations that round the same everywhere, in a stated order: the Rust shaders have the same functions, and both
// pictures are equal to the bit.

const vec3 SUN_DIRECTION = vec3(0.48, 0.6, 0.64);
// The cosine of the disc's radius, 2.5 degrees: some ten times the real one's, to be seen in reflections.
const float SUN_COSINE = 0.99905;
const vec3 SUN_COLOUR = vec3(24.0, 22.0, 18.0);
// What falls on a surface that faces the sun, over pi.
const vec3 SUN_LIGHT = vec3(1.1, 1.0, 0.85);

// The sky above the horizon, and what is added to it at the zenith.
const vec3 HORIZON = vec3(0.72, 0.82, 0.92);
const vec3 TO_ZENITH = vec3(-0.6, -0.54, -0.26);
// Light from all around on a surface that faces the ground, and what is added to it where that faces the zenith.
const vec3 LIGHT_FROM_BELOW = vec3(0.09, 0.08, 0.06);
const vec3 LIGHT_TO_ZENITH = vec3(0.13, 0.2, 0.32);
const vec3 GROUND = vec3(0.22, 0.19, 0.16);
const vec3 LAMP = vec3(5.0, 5.0, 4.8);

// Materials; 0 is Lambertian.
const uint GLOSSY = 1u;
const uint MIRROR = 2u;
const uint GGX = 3u;

float fraction(float x) {
    UNITVEC_PRECISE float rest = x - floor(x);
    return rest;
}

// Well-mixed bits of a small number.
uint mixed(uint n) {
    uint h = n * 0x9e3779b9u;
    h = (h ^ (h >> 15u)) * 0x85ebca6bu;
    return h ^ (h >> 13u);
}

// A plain of tiles, a unit below the eye. Their contrast fades towards the horizon, where they are less than a pixel.
vec3 ground(vec3 d) {
    float depth = max(-d.y, 0.01);
    UNITVEC_PRECISE float x = floor(d.x / depth);
    UNITVEC_PRECISE float z = floor(d.z / depth);
    UNITVEC_PRECISE float is_dark = 2.0 * fraction((x + z) * 0.5);
    UNITVEC_PRECISE float contrast = min(2.0 * depth, 0.7);
    UNITVEC_PRECISE float brightness = 1.0 - contrast * is_dark;
    UNITVEC_PRECISE vec3 tile = GROUND * brightness;
    return tile;
}

// Lamps in a row, a unit above the eye: bars that a curved surface bends.
bool is_lamp(vec3 d) {
    float height = max(d.y, 0.5);
    UNITVEC_PRECISE float x = d.x / height;
    UNITVEC_PRECISE float z = d.z / height;
    UNITVEC_PRECISE float place = x * 4.0;
    return abs(x) < 0.75 && abs(z) < 0.75 && fraction(place) < 0.3;
}

vec3 clear_sky(vec3 d) {
    if (unitvec_dot(d, SUN_DIRECTION) > SUN_COSINE) return SUN_COLOUR;
    if (is_lamp(d)) return LAMP;
    UNITVEC_PRECISE float below = 1.0 - d.y;
    UNITVEC_PRECISE float share = 1.0 - below * below;
    UNITVEC_PRECISE vec3 sky_colour = HORIZON + TO_ZENITH * share;
    return sky_colour;
}

// A town all around, on the four sides of a square: 16 buildings a side, of two columns of windows.
struct Town {
    // The direction's height above the ground, a side being 2 wide, and the height of the building there.
    float height;
    float roof;
    // The place in a window with its frame, 0 to 1 each way, and bits that each window has of its own.
    vec2 place;
    uint bits;
};

Town town(vec3 d) {
    bool on_x = abs(d.x) > abs(d.z);
    // Of directions that are nearly upright, which see no building, any.
    float distance_to_side = max(max(abs(d.x), abs(d.z)), 0.01);
    UNITVEC_PRECISE float along = (on_x ? d.z : d.x) / distance_to_side;
    UNITVEC_PRECISE float height = d.y / distance_to_side;
    uint side = (on_x ? 1u : 0u) + ((on_x ? d.x : d.z) < 0.0 ? 2u : 0u);
    UNITVEC_PRECISE float window_x = (along + 1.0) * 16.0;
    UNITVEC_PRECISE float window_y = min(max(height, 0.0), 1.0) * 18.0;
    uint column = unitvec_whole_to_u32(floor(window_x));
    uint building = mixed((column >> 1u) + 64u * side);
    UNITVEC_PRECISE float roof = float(building >> 27u) * 0.008 + 0.06;
    uint window = mixed(column + 64u * side + 1024u * unitvec_whole_to_u32(floor(window_y)));
    return Town(height, roof, vec2(fraction(window_x), fraction(window_y)), window);
}

// Walls, and windows, a quarter of them lit.
vec3 facade(Town t) {
    bool is_wall = t.place.x < 0.25 || t.place.x > 0.75 || t.place.y < 0.3 || t.place.y > 0.8;
    if (is_wall) return vec3(0.16, 0.13, 0.12);
    return (t.bits & 3u) == 0u ? vec3(1.6, 1.2, 0.7) : vec3(0.03, 0.04, 0.06);
}

// What is seen in the direction d, a unit vector.
vec3 sky(vec3 d) {
    if (d.y < 0.0) return ground(d);
    Town t = town(d);
    return t.height < t.roof ? facade(t) : clear_sky(d);
}

// The colour of an object's surface.
vec3 albedo(float object) {
    if (object < 1.5) return vec3(0.72, 0.45, 0.32);
    if (object < 2.5) return vec3(0.28, 0.52, 0.62);
    if (object < 3.5) return vec3(0.66, 0.58, 0.3);
    if (object < 4.5) return vec3(0.42, 0.58, 0.36);
    return vec3(0.62, 0.12, 0.12);
}

// The cosine of an angle, 0 beyond the right angle.
float facing(vec3 a, vec3 b) {
    return max(unitvec_dot(a, b), 0.0);
}

// Sunlight and what comes from sky and ground, as a smooth surface without a direction of its own sends it back.
vec3 diffuse(vec3 n) {
    UNITVEC_PRECISE float above = n.y * 0.5 + 0.5;
    UNITVEC_PRECISE vec3 from_around = LIGHT_FROM_BELOW + LIGHT_TO_ZENITH * above;
    UNITVEC_PRECISE vec3 light = SUN_LIGHT * facing(n, SUN_DIRECTION) + from_around;
    return light;
}

float square(float x) {
    UNITVEC_PRECISE float product = x * x;
    return product;
}

// x^256. What is below 0.75 counts as that, 2^-106: some devices flush denormal powers.
float power_256(float x) {
    float power_16 = square(square(square(square(max(x, 0.75)))));
    return square(square(square(square(power_16))));
}

// Normalised Blinn-Phong with the exponent 256: (e + 8) / 8, since SUN_LIGHT is over pi.
float blinn_phong(float cosine) {
    UNITVEC_PRECISE float value = 33.0 * power_256(cosine);
    return value;
}

// GGX (Walter et al. 2007, eq. 33) with a roughness of 0.3, a = roughness^2: pi D / 4, which is 1 / (4 a^2 q^2), where
// q = 1 + k (1 - cos^2) and k = 1 / a^2 - 1.
float ggx(float cosine) {
    UNITVEC_PRECISE float rest = 1.0 - square(cosine);
    UNITVEC_PRECISE float q = 122.46 * rest + 1.0;
    UNITVEC_PRECISE float value = 30.86 / square(q);
    return value;
}

// A highlight on a surface that is matt below.
vec3 glossy(vec3 matt, uint material, vec3 n, vec3 ray) {
    UNITVEC_PRECISE vec3 middle = SUN_DIRECTION - ray;
    UNITVEC_PRECISE float cosine = facing(n, unitvec_normalize(middle));
    UNITVEC_PRECISE float highlight = material == GGX ? ggx(cosine) : blinn_phong(cosine);
    UNITVEC_PRECISE float specular = 0.05 * (highlight * facing(n, SUN_DIRECTION));
    UNITVEC_PRECISE vec3 light = matt * 0.35 + SUN_LIGHT * specular;
    return light;
}

// r = d - 2 (d . n) n
vec3 mirrored(vec3 ray, vec3 n) {
    UNITVEC_PRECISE vec3 direction = ray - n * (2.0 * unitvec_dot(ray, n));
    return unitvec_normalize(direction);
}

// What is seen along a ray that meets an object's surface with the normal n, or none, object 0; both vectors have unit length.
vec3 seen(uint material, float object, vec3 n, vec3 ray) {
    bool is_sky = object < 0.5;
    // In one place, since compilers repeat the sky wherever it is called.
    if (is_sky || material == MIRROR) return sky(is_sky ? ray : mirrored(ray, n));
    UNITVEC_PRECISE vec3 matt = albedo(object) * diffuse(n);
    return material == GLOSSY || material == GGX ? glossy(matt, material, n, ray) : matt;
}
