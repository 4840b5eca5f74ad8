/* Normals of a mesh to codes and back, in C99.
 *
 *     cc -std=c99 normals.c $(pkg-config --cflags --libs unitvec) -o normals
 */
#include <stdio.h>
#include <unitvec.h>

int main(void) {
    /* One normal at a time: the codec is chosen in the source. */
    const unitvec_vec3 normal = {0.0f, 0.6f, -0.8f};
    const uint32_t code = unitvec_oct32_encode(normal);
    const unitvec_vec3 decoded = unitvec_oct32_decode(code);
    printf("oct32 of (0, 0.6, -0.8): 0x%08x, back (%.4f, %.4f, %.4f)\n", (unsigned)code, (double)decoded.x,
           (double)decoded.y, (double)decoded.z);

    /* Arrays: the codec is chosen at run time. */
    const unitvec_codec *codec = unitvec_find("oct32p");
    const float normals[3][3] = {{1.0f, 0.0f, 0.0f}, {0.36f, 0.48f, 0.8f}, {0.0f, 0.0f, -1.0f}};
    unsigned char codes[3 * 8];
    const size_t size = 3 * unitvec_codec_bytes(codec);
    unitvec_status status = unitvec_encode(codec, normals[0], 3, codes, size);
    if (status != UNITVEC_OK) {
        fprintf(stderr, "encode: %s\n", unitvec_status_text(status));
        return 1;
    }
    printf("%s: 3 normals in %u bytes, at most %.5f degrees off\n", unitvec_codec_id(codec), (unsigned)size,
           (double)unitvec_codec_max_error_deg(codec));

    /* What is not there is an error, and no crash. */
    status = unitvec_encode(unitvec_find("oct17"), normals[0], 3, codes, size);
    printf("an unknown codec: %s\n", unitvec_status_text(status));
    return status == UNITVEC_ERROR_UNKNOWN_CODEC ? 0 : 1;
}
