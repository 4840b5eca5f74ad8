/* Elements among other data give the codes of unitvec_encode, and codes the elements of unitvec_decode. */
#include "expect.h"
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <unitvec.h>

enum { COUNT = 1000, MOST = 7 * COUNT };

static float elements[MOST], decoded[MOST];
static unsigned char codes[8 * COUNT], strided[10 * COUNT];

static float component(void) {
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (float)(int32_t)state / 2147483648.0f;
}

/* The codes of the elements, and what they decode to, by the functions for arrays without gaps. */
static void expected(const unitvec_codec *codec) {
    for (size_t i = 0; i < MOST; i++) {
        elements[i] = component();
    }
    const size_t size = COUNT * unitvec_codec_bytes(codec);
    EXPECT(unitvec_encode(codec, elements, COUNT, codes, size) == UNITVEC_OK);
    EXPECT(unitvec_decode(codec, codes, size, decoded, COUNT) == UNITVEC_OK);
}

static void expect_codes(const unitvec_codec *codec, const void *actual, size_t stride) {
    const size_t bytes = unitvec_codec_bytes(codec);
    for (size_t i = 0; i < COUNT; i++) {
        EXPECT(memcmp((const char *)actual + i * stride, codes + i * bytes, bytes) == 0);
    }
}

/* Every codec: doubles in arrays of components; unaligned floats with a byte between elements; a byte between codes. */
static void every_codec(const unitvec_codec *codec) {
    static double arrays[7][COUNT];
    static unsigned char bytes[1 + 29 * COUNT];
    const size_t floats = unitvec_codec_floats(codec), stride = unitvec_codec_bytes(codec) + 1;
    expected(codec);
    unitvec_elements of_doubles = {.stride = sizeof(double), .scalar = UNITVEC_FLOAT64};
    unitvec_elements of_floats = {.stride = 4 * floats + 1, .scalar = UNITVEC_FLOAT32};
    memset(bytes, 0xaa, sizeof bytes);
    for (size_t c = 0; c < floats; c++) {
        of_doubles.components[c] = arrays[c];
        of_floats.components[c] = bytes + 1 + 4 * c;
        for (size_t i = 0; i < COUNT; i++) {
            arrays[c][i] = (double)elements[i * floats + c];
            memcpy(bytes + 1 + i * (4 * floats + 1) + 4 * c, &elements[i * floats + c], 4);
        }
    }
    for (int k = 0; k < 2; k++) {
        const unitvec_elements *from = k == 0 ? &of_doubles : &of_floats;
        memset(strided, 0xaa, sizeof strided);
        size_t lacking = 1;
        EXPECT(unitvec_encode_strided(codec, from, COUNT, strided, stride, &lacking) == UNITVEC_OK && lacking == 0);
        expect_codes(codec, strided, stride);
        EXPECT(unitvec_decode_strided(codec, strided, stride, from, COUNT) == UNITVEC_OK);
        for (size_t i = 0; i < COUNT; i++) {
            EXPECT(strided[(i + 1) * stride - 1] == 0xaa && bytes[(i + 1) * (4 * floats + 1)] == 0xaa);
        }
    }
    for (size_t i = 0; i < COUNT * floats; i++) {
        EXPECT(arrays[i % floats][i / floats] == (double)decoded[i]);
        EXPECT(memcmp(bytes + 1 + i / floats * (4 * floats + 1) + i % floats * 4, &decoded[i], 4) == 0);
    }
}

/* A field of the vertices takes the codes of another. */
static void in_vertices(void) {
    static struct {
        float position[3], normal[3], uv;
        uint32_t code;
    } vertices[COUNT];
    const size_t stride = sizeof *vertices;
    const unitvec_codec *codec = unitvec_find("oct32p");
    expected(codec);
    for (size_t i = 0; i < COUNT; i++) {
        memcpy(vertices[i].normal, elements + 3 * i, sizeof vertices[i].normal);
        vertices[i].uv = (float)i;
    }
    float *n = vertices[0].normal, *p = vertices[0].position;
    const unitvec_elements normals = {{n, n + 1, n + 2}, stride, 0, UNITVEC_FLOAT32};
    const unitvec_elements positions = {{p, p + 1, p + 2}, stride, 0, UNITVEC_FLOAT32};
    EXPECT(unitvec_encode_strided(codec, &normals, COUNT, &vertices[0].code, stride, NULL) == UNITVEC_OK);
    expect_codes(codec, &vertices[0].code, stride);
    EXPECT(unitvec_decode_strided(codec, &vertices[0].code, stride, &positions, COUNT) == UNITVEC_OK);
    for (size_t i = 0; i < COUNT; i++) {
        EXPECT(memcmp(vertices[i].position, decoded + 3 * i, sizeof vertices[i].position) == 0);
        EXPECT(memcmp(vertices[i].normal, elements + 3 * i, sizeof vertices[i].normal) == 0);
        EXPECT(vertices[i].uv == (float)i);
    }
    EXPECT(unitvec_encode_strided(codec, &normals, COUNT, n + 2, stride, NULL) == UNITVEC_ERROR_OVERLAP);
    EXPECT(unitvec_encode_strided(codec, &normals, COUNT, (char *)p + 9, stride, NULL) == UNITVEC_ERROR_OVERLAP);
    EXPECT(unitvec_encode_strided(codec, &normals, COUNT, vertices, 4, NULL) == UNITVEC_ERROR_OVERLAP);
    const unitvec_elements twice = {{n, n + 1, n + 1}, stride, 0, UNITVEC_FLOAT32};
    EXPECT(unitvec_encode_strided(codec, &twice, COUNT, strided, 4, NULL) == UNITVEC_OK);
    EXPECT(unitvec_decode_strided(codec, strided, 4, &twice, COUNT) == UNITVEC_ERROR_OVERLAP);
}

/* Normals and tangents lie in arrays of their own, as in glTF. */
static void frames_apart(void) {
    static float normals[COUNT][3], tangents[COUNT][4];
    const unitvec_codec *codec = unitvec_find("frame64");
    expected(codec);
    for (size_t i = 0; i < COUNT; i++) {
        memcpy(normals[i], elements + 7 * i, sizeof normals[i]);
        memcpy(tangents[i], elements + 7 * i + 3, sizeof tangents[i]);
    }
    float *n = normals[0], *t = tangents[0];
    const unitvec_elements frames = {{n, n + 1, n + 2, t, t + 1, t + 2, t + 3}, 12, 16, UNITVEC_FLOAT32};
    EXPECT(unitvec_encode_strided(codec, &frames, COUNT, strided, 8, NULL) == UNITVEC_OK);
    expect_codes(codec, strided, 8);
    memset(normals[3], 0, sizeof normals[3]);
    memset(tangents[4], 0, sizeof tangents[4]);
    size_t lacking;
    EXPECT(unitvec_encode_strided(codec, &frames, COUNT, strided, 8, &lacking) == UNITVEC_OK && lacking == 1);
}

/* Doubles keep directions that floats have no room for. Others are counted, and get the code of +Z. */
static void directions(void) {
    double v[][3] = {{1e300, 0, -1e300}, {-1e-300, 1e-300, 0},  {4e-320, 0, 0},    {1e38, 1e38, 1e38}, {0, 0, 0},
                     {NAN, 1, 1},        {1, -INFINITY, 1e300}, {3e-20, 0, 3e-20}, {0, 1, 0}};
    enum { VECTORS = sizeof v / sizeof *v };
    const unitvec_vec3 same[VECTORS] = {{1, 0, -1}, {-1, 1, 0}, {1, 0, 0}, {1, 1, 1}, {0, 0, 1},
                                        {0, 0, 1},  {0, 0, 1},  {1, 0, 1}, {0, 1, 0}};
    const unitvec_elements doubles = {{v[0], v[0] + 1, v[0] + 2}, sizeof *v, 0, UNITVEC_FLOAT64};
    uint32_t of_doubles[VECTORS];
    size_t lacking;
    EXPECT(unitvec_encode_strided(unitvec_find("oct32"), &doubles, VECTORS, of_doubles, 4, &lacking) == UNITVEC_OK);
    EXPECT(lacking == 3);
    for (size_t i = 0; i < VECTORS; i++) {
        EXPECT(of_doubles[i] == unitvec_oct32_encode(same[i]));
    }
    EXPECT(unitvec_encode_strided(unitvec_find("oct32"), NULL, 0, NULL, 0, &lacking) == UNITVEC_OK && lacking == 0);
}

/* Both functions, with the same arguments, give the same status, and write nothing. */
static void both(const unitvec_codec *codec, const unitvec_elements *which, size_t count, void *to, size_t stride,
                 unitvec_status status) {
    size_t lacking = 42;
    EXPECT(unitvec_encode_strided(codec, which, count, to, stride, &lacking) == status && lacking == 42);
    EXPECT(unitvec_decode_strided(codec, to, stride, which, count) == status);
}

static void wrong_arguments(void) {
    const unitvec_codec *codec = unitvec_find("oct24"), *frame = unitvec_find("frame32");
    unitvec_elements e = {{elements, elements + 1, elements + 2}, 12, 0, UNITVEC_FLOAT32};
    both(NULL, &e, 2, codes, 3, UNITVEC_ERROR_UNKNOWN_CODEC);
    both(codec, NULL, 2, codes, 3, UNITVEC_ERROR_NULL_POINTER);
    both(codec, &e, 2, NULL, 3, UNITVEC_ERROR_NULL_POINTER);
    both(frame, &e, 2, codes, 4, UNITVEC_ERROR_NULL_POINTER);
    both(codec, &e, 2, codes, 2, UNITVEC_ERROR_LAYOUT);
    both(codec, &e, 2, codes, 0, UNITVEC_ERROR_LAYOUT);
    both(codec, &e, SIZE_MAX, codes, 3, UNITVEC_ERROR_SIZE);
    both(codec, &e, SIZE_MAX / 24 + 2, codes, 3, UNITVEC_ERROR_SIZE);
    both(codec, &e, 2, codes, SIZE_MAX / 2, UNITVEC_ERROR_SIZE);
    both(codec, &e, 2, (char *)elements + 9, 12, UNITVEC_ERROR_OVERLAP);
    both(codec, &e, 2, (char *)elements + 22, 12, UNITVEC_ERROR_OVERLAP);
    e.stride = 3;
    both(codec, &e, 2, codes, 3, UNITVEC_ERROR_LAYOUT);
    e.scalar = 16;
    both(codec, &e, 2, codes, 3, UNITVEC_ERROR_LAYOUT);
    e.scalar = UNITVEC_FLOAT32, e.stride = 0;
    EXPECT(unitvec_encode_strided(codec, &e, 1, codes, 0, NULL) == UNITVEC_OK);
    EXPECT(unitvec_decode_strided(codec, codes, 0, &e, 1) == UNITVEC_OK);
}

int main(void) {
    for (size_t i = 0; i < unitvec_codec_count(); i++) {
        every_codec(unitvec_codec_at(i));
    }
    in_vertices();
    frames_apart();
    directions();
    wrong_arguments();
    return 0;
}
