/* A program with one codec's functions, or, with WITHOUT_UNITVEC defined, the same without them. */
#include <unitvec.h>

int main(int argc, char **argv) {
    (void)argv;
    unitvec_vec3 vector = {(float)argc, 2.0f, 3.0f};
#ifndef WITHOUT_UNITVEC
    vector = unitvec_oct32_decode(unitvec_oct32_encode(vector));
#endif
    return (int)vector.x;
}
