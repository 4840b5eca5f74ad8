// Groups of four vectors, frames, rotations or codes as whole words. BYTES is the size of a code, FRAME is defined for
// frames, ROTATION for rotations, ENCODE or DECODE tells the direction. Codes of more than 32 bits are uvec2, low word first.

#ifdef FRAME
#define FLOATS 7
#elif defined(ROTATION)
#define FLOATS 4
#else
#define FLOATS 3
#endif
#ifdef ENCODE
#define READ (4 * FLOATS)
#define WRITTEN BYTES
#else
#define READ BYTES
#define WRITTEN (4 * FLOATS)
#endif

#if BYTES > 4
#define CODE uvec2
#else
#define CODE uint
#endif

uint[BYTES] pack(CODE c[4]) {
    uint w[BYTES];
#if BYTES == 1
    w[0] = c[0] | (c[1] << 8u) | (c[2] << 16u) | (c[3] << 24u);
#elif BYTES == 2
    w[0] = c[0] | (c[1] << 16u);
    w[1] = c[2] | (c[3] << 16u);
#elif BYTES == 3
    w[0] = c[0] | (c[1] << 24u);
    w[1] = (c[1] >> 8u) | (c[2] << 16u);
    w[2] = (c[2] >> 16u) | (c[3] << 8u);
#elif BYTES == 4
    w = c;
#elif BYTES == 6
    for (int n = 0; n < 2; ++n) {
        uvec2 low = c[2 * n], high = c[2 * n + 1];
        w[3 * n] = low.x;
        w[3 * n + 1] = low.y | (high.x << 16u);
        w[3 * n + 2] = (high.x >> 16u) | (high.y << 16u);
    }
#elif BYTES == 8
    for (int n = 0; n < 4; ++n) {
        w[2 * n] = c[n].x;
        w[2 * n + 1] = c[n].y;
    }
#endif
    return w;
}

CODE[4] unpack(uint w[BYTES]) {
    CODE c[4];
#if BYTES == 1
    for (int n = 0; n < 4; ++n) c[n] = w[0] >> (8 * n);
#elif BYTES == 2
    c[0] = w[0];
    c[1] = w[0] >> 16u;
    c[2] = w[1];
    c[3] = w[1] >> 16u;
#elif BYTES == 3
    c[0] = w[0];
    c[1] = (w[0] >> 24u) | (w[1] << 8u);
    c[2] = (w[1] >> 16u) | (w[2] << 16u);
    c[3] = w[2] >> 8u;
#elif BYTES == 4
    c = w;
#elif BYTES == 6
    for (int n = 0; n < 2; ++n) {
        uint first = w[3 * n], middle = w[3 * n + 1], last = w[3 * n + 2];
        c[2 * n] = uvec2(first, middle & 0xffffu);
        c[2 * n + 1] = uvec2((middle >> 16u) | (last << 16u), last >> 16u);
    }
#elif BYTES == 8
    for (int n = 0; n < 4; ++n) c[n] = uvec2(w[2 * n], w[2 * n + 1]);
#endif
    return c;
}
