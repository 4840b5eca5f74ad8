/* A process that was forked after a parallel call has no threads, and encodes without. */
#define _POSIX_C_SOURCE 200809L
#include "expect.h"
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <unitvec.h>

enum { COUNT = 2000000 };

static void run(float *vectors, unsigned char *codes) {
    const unitvec_codec *codec = unitvec_find("oct32");
    EXPECT(unitvec_encode_parallel(codec, vectors, COUNT, codes, 4 * COUNT) == UNITVEC_OK);
    EXPECT(unitvec_decode_parallel(codec, codes, 4 * COUNT, vectors, COUNT) == UNITVEC_OK);
}

int main(void) {
    float *vectors = malloc(COUNT * 3 * sizeof *vectors);
    unsigned char *codes = malloc(4 * COUNT), *before = malloc(4 * COUNT);
    EXPECT(vectors && codes && before);
    for (size_t i = 0; i < 3 * COUNT; i++) {
        vectors[i] = (float)(i % 1009) - 500.0f;
    }
    run(vectors, before);
    const pid_t child = fork();
    EXPECT(child >= 0);
    /* Either process ends by this signal if it hangs. */
    alarm(60);
    if (child == 0) {
        run(vectors, codes);
        EXPECT(memcmp(codes, before, 4 * COUNT) == 0);
        return 0;
    }
    int status;
    EXPECT(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    run(vectors, codes);
    return 0;
}
