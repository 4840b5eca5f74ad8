/* Encodes and decodes by all functions of a codec: `codecs ID COUNT`. It reads COUNT elements and COUNT codes, and writes
 * their codes and their elements, by the functions of single elements, of arrays, and of arrays on all cores. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unitvec.h>

/* The low bytes of a number, and a number of them. */
static void store(uint64_t code, unsigned char *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (unsigned char)(code >> (8 * i));
    }
}

/* What is above the bytes is 1: it must not count. */
static uint64_t load(const unsigned char *bytes, size_t size) {
    uint64_t code = UINT64_MAX;
    for (size_t i = size; i-- > 0;) {
        code = (code << 8) | bytes[i];
    }
    return code;
}

/* Functions that encode and decode one element of floats, for each codec. */
#define FUNCTIONS(id, type, word)                                                                                      \
    static uint64_t id##_encode_one(const float *floats) {                                                             \
        type element;                                                                                                  \
        memcpy(&element, floats, sizeof element);                                                                      \
        return unitvec_##id##_encode(element);                                                                         \
    }                                                                                                                  \
    static void id##_decode_one(uint64_t code, float *floats) {                                                        \
        type element = unitvec_##id##_decode((word)code);                                                              \
        memcpy(floats, &element, sizeof element);                                                                      \
    }
#define VECTOR32(id) FUNCTIONS(id, unitvec_vec3, uint32_t)
#define VECTOR64(id) FUNCTIONS(id, unitvec_vec3, uint64_t)
#define FRAME32(id) FUNCTIONS(id, unitvec_frame, uint32_t)
#define FRAME64(id) FUNCTIONS(id, unitvec_frame, uint64_t)
#define ROTATION32(id) FUNCTIONS(id, unitvec_quat, uint32_t)
#define ROTATION64(id) FUNCTIONS(id, unitvec_quat, uint64_t)
#include "codecs.inc"
#undef VECTOR32
#undef VECTOR64
#undef FRAME32
#undef FRAME64
#undef ROTATION32
#undef ROTATION64

#define VECTOR32(id) {#id, id##_encode_one, id##_decode_one},
#define VECTOR64 VECTOR32
#define FRAME32 VECTOR32
#define FRAME64 VECTOR32
#define ROTATION32 VECTOR32
#define ROTATION64 VECTOR32
static const struct {
    const char *id;
    uint64_t (*encode)(const float *);
    void (*decode)(uint64_t, float *);
} single[] = {
#include "codecs.inc"
};

static void expect(int condition, const char *what) {
    if (!condition) {
        fprintf(stderr, "%s\n", what);
        exit(1);
    }
}

int main(int argc, char **argv) {
    expect(argc == 3, "usage: codecs ID COUNT");
    size_t which = 0;
    while (which < sizeof single / sizeof *single && strcmp(single[which].id, argv[1]) != 0) {
        which++;
    }
    expect(which < sizeof single / sizeof *single, "no such functions");
    const unitvec_codec *codec = unitvec_find(argv[1]);
    expect(codec != NULL, "no such codec");

    const size_t count = (size_t)strtoul(argv[2], NULL, 10);
    const size_t floats = unitvec_codec_floats(codec), bytes = unitvec_codec_bytes(codec);
    float *elements = malloc(count * floats * sizeof *elements);
    float *decoded = malloc(count * floats * sizeof *decoded);
    unsigned char *codes = malloc(count * bytes), *encoded = malloc(count * bytes);
    expect(elements && decoded && codes && encoded, "no memory");
    expect(fread(elements, floats * sizeof *elements, count, stdin) == count, "too few elements");
    expect(fread(codes, bytes, count, stdin) == count, "too few codes");

    for (int way = 0; way < 3; way++) {
        if (way == 0) {
            for (size_t i = 0; i < count; i++) {
                store(single[which].encode(elements + i * floats), encoded + i * bytes, bytes);
                single[which].decode(load(codes + i * bytes, bytes), decoded + i * floats);
            }
        } else {
            unitvec_status (*encode)(const unitvec_codec *, const float *, size_t, void *, size_t) =
                way == 1 ? unitvec_encode : unitvec_encode_parallel;
            unitvec_status (*decode)(const unitvec_codec *, const void *, size_t, float *, size_t) =
                way == 1 ? unitvec_decode : unitvec_decode_parallel;
            expect(encode(codec, elements, count, encoded, count * bytes) == UNITVEC_OK, "encode");
            expect(decode(codec, codes, count * bytes, decoded, count) == UNITVEC_OK, "decode");
        }
        expect(fwrite(encoded, bytes, count, stdout) == count, "stdout");
        expect(fwrite(decoded, floats * sizeof *decoded, count, stdout) == count, "stdout");
        memset(encoded, 0, count * bytes);
        memset(decoded, 0, count * floats * sizeof *decoded);
    }
    free(elements);
    free(decoded);
    free(codes);
    free(encoded);
    return 0;
}
