/* Wrong arguments, and what says of a codec. `errors VERSION`. */
#include "expect.h"
#include <string.h>
#include <unitvec.h>

static float vectors[3 * 5];
static unsigned char codes[4 * 5];

/* Both functions, with the same arguments, give the same status, and write nothing. */
static void both(const unitvec_codec *codec, float *elements, size_t count, void *bytes, size_t size, unitvec_status status) {
    unsigned char codes_before[sizeof codes];
    float vectors_before[sizeof vectors / sizeof *vectors];
    memcpy(codes_before, codes, sizeof codes);
    memcpy(vectors_before, vectors, sizeof vectors);
    EXPECT(unitvec_encode(codec, elements, count, bytes, size) == status);
    EXPECT(unitvec_decode(codec, bytes, size, elements, count) == status);
    EXPECT(unitvec_encode_parallel(codec, elements, count, bytes, size) == status);
    EXPECT(unitvec_decode_parallel(codec, bytes, size, elements, count) == status);
    EXPECT(memcmp(codes_before, codes, sizeof codes) == 0);
    EXPECT(memcmp(vectors_before, vectors, sizeof vectors) == 0);
}

static void wrong_arguments(const unitvec_codec *codec) {
    const size_t size = sizeof codes;
    both(NULL, vectors, 5, codes, size, UNITVEC_ERROR_UNKNOWN_CODEC);
    both((const unitvec_codec *)vectors, vectors, 5, codes, size, UNITVEC_ERROR_UNKNOWN_CODEC);
    both((const unitvec_codec *)((const char *)codec + 1), vectors, 5, codes, size, UNITVEC_ERROR_UNKNOWN_CODEC);
    both(codec, NULL, 5, codes, size, UNITVEC_ERROR_NULL_POINTER);
    both(codec, vectors, 5, NULL, size, UNITVEC_ERROR_NULL_POINTER);
    both(codec, vectors, 5, codes, size - 1, UNITVEC_ERROR_SIZE);
    both(codec, vectors, 4, codes, size, UNITVEC_ERROR_SIZE);
    both(codec, vectors, 0, codes, size, UNITVEC_ERROR_SIZE);
    both(codec, vectors, SIZE_MAX, codes, size, UNITVEC_ERROR_SIZE);
    both(codec, vectors, SIZE_MAX / 12, codes, SIZE_MAX / 12 * 4, UNITVEC_ERROR_SIZE);
    /* 2^62 times 12 bytes, and times 4, are 0 but for what does not fit. */
    both(codec, vectors, SIZE_MAX / 4 + 1, codes, 0, UNITVEC_ERROR_SIZE);
    both(codec, (float *)(void *)((char *)vectors + 1), 1, codes, 4, UNITVEC_ERROR_ALIGNMENT);
    both(codec, vectors, 1, vectors, 4, UNITVEC_ERROR_OVERLAP);
    both(codec, vectors, 1, (char *)vectors + 11, 4, UNITVEC_ERROR_OVERLAP);
    both(codec, vectors + 1, 1, (char *)vectors + 1, 4, UNITVEC_ERROR_OVERLAP);
}

/* Codes next to the vectors, and none at all, are right. */
static void right_arguments(const unitvec_codec *codec) {
    EXPECT(unitvec_encode(codec, NULL, 0, NULL, 0) == UNITVEC_OK);
    EXPECT(unitvec_decode(codec, NULL, 0, NULL, 0) == UNITVEC_OK);
    both(codec, (float *)(void *)((char *)vectors + 1), 0, codes, 0, UNITVEC_OK);
    vectors[2] = -1.0f;
    EXPECT(unitvec_encode(codec, vectors, 1, vectors + 3, 4) == UNITVEC_OK);
    EXPECT(unitvec_encode(codec, vectors, 1, codes + 1, 4) == UNITVEC_OK);
    EXPECT(memcmp(vectors + 3, codes + 1, 4) == 0);
    EXPECT(unitvec_decode(codec, vectors + 3, 4, vectors, 1) == UNITVEC_OK);
    EXPECT(vectors[0] == 0.0f && vectors[1] == 0.0f && vectors[2] == -1.0f);
}

/* What is known of a codec, and of none. */
static void what_is_known(void) {
    const unitvec_codec *frame = unitvec_find("frame64"), *wide = unitvec_find("oct52p");
    EXPECT(unitvec_codec_bits(wide) == 52 && unitvec_codec_bytes(wide) == 8 && unitvec_codec_floats(wide) == 3);
    EXPECT(unitvec_codec_floats(frame) == 7 && unitvec_codec_bytes(frame) == 8);
    EXPECT(strcmp(unitvec_codec_vk_format(frame), "VK_FORMAT_R32G32_UINT") == 0);
    EXPECT(unitvec_codec_vk_format(wide) == NULL);
    /* The tangent's bound is the greater. */
    EXPECT(unitvec_codec_max_error_deg(frame) > 1.0e-4f && unitvec_codec_max_error_deg(frame) < 1.5e-4f);
    for (size_t i = 0; i < unitvec_codec_count(); i++) {
        const unitvec_codec *codec = unitvec_codec_at(i);
        EXPECT(unitvec_find(unitvec_codec_id(codec)) == codec);
        EXPECT(8 * unitvec_codec_bytes(codec) >= unitvec_codec_bits(codec));
    }
    EXPECT(unitvec_codec_at(unitvec_codec_count()) == NULL);
    EXPECT(unitvec_find(NULL) == NULL && unitvec_find("") == NULL && unitvec_find("oct\xff") == NULL);
    EXPECT(unitvec_find("OCT16") == NULL);
    EXPECT(unitvec_codec_id(NULL) == NULL && unitvec_codec_vk_format(NULL) == NULL);
    EXPECT(unitvec_codec_bits(NULL) == 0 && unitvec_codec_bytes(NULL) == 0 && unitvec_codec_floats(NULL) == 0);
    EXPECT(unitvec_codec_max_error_deg(NULL) == 0.0f);
    EXPECT(unitvec_codec_null(NULL) == UNITVEC_NO_NULL && unitvec_codec_null(frame) == UNITVEC_NO_NULL);
    EXPECT(unitvec_codec_null(wide) == 0x2000000u);
}

/* Vectors without a direction get the null code, and it gives zeros. */
static void null_codes(void) {
    const unitvec_vec3 zero = {0.0f, -0.0f, 0.0f}, x = {1.0f, 0.0f, 0.0f};
    EXPECT(unitvec_code_or_null(zero, 1, 7) == 7 && unitvec_code_or_null(x, 1, 7) == 1);
    EXPECT(unitvec_vector_or_zero(x, 7, 7).x == 0.0f && unitvec_vector_or_zero(x, 1, 7).x == 1.0f);
}

/* Each status has the text of its meaning, and any other number has one. */
static void texts(void) {
    const struct {
        unitvec_status status;
        const char *begin;
    } expected[] = {
        {UNITVEC_OK, "success"},
        {UNITVEC_ERROR_UNKNOWN_CODEC, "unknown codec"},
        {UNITVEC_ERROR_NULL_POINTER, "the pointer to the elements or to the codes is NULL"},
        {UNITVEC_ERROR_SIZE, "the size of the codes is not"},
        {UNITVEC_ERROR_ALIGNMENT, "the pointer to the elements is not aligned"},
        {UNITVEC_ERROR_OVERLAP, "elements or codes that would be written overlap"},
        {UNITVEC_ERROR_INTERNAL, "internal error"},
        {UNITVEC_ERROR_LAYOUT, "a stride is less"},
        {UNITVEC_ERROR_LAYOUT + 1, "not a unitvec_status"},
        {UINT32_MAX, "not a unitvec_status"},
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const char *text = unitvec_status_text(expected[i].status);
        EXPECT(strncmp(text, expected[i].begin, strlen(expected[i].begin)) == 0);
    }
}

int main(int argc, char **argv) {
    EXPECT(argc == 2 && strcmp(unitvec_version(), argv[1]) == 0);
    const unitvec_codec *codec = unitvec_find("oct32p");
    EXPECT(codec != NULL);
    wrong_arguments(codec);
    right_arguments(codec);
    what_is_known();
    null_codes();
    texts();
    return 0;
}
