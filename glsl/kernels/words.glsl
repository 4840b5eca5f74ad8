// Four vectors and four codes as whole words; BYTES is the size of a code. Codes of more than 32 bits are uvec2, low
// word first.

#if BYTES > 4
#define CODE uvec2
#else
#define CODE uint
#endif

struct Vectors { float f[12]; };
struct Codes { uint w[BYTES]; };

Codes pack(CODE c[4]) {
    Codes codes;
#if BYTES == 1
    codes.w[0] = c[0] | (c[1] << 8u) | (c[2] << 16u) | (c[3] << 24u);
#elif BYTES == 2
    codes.w[0] = c[0] | (c[1] << 16u);
    codes.w[1] = c[2] | (c[3] << 16u);
#elif BYTES == 3
    codes.w[0] = c[0] | (c[1] << 24u);
    codes.w[1] = (c[1] >> 8u) | (c[2] << 16u);
    codes.w[2] = (c[2] >> 16u) | (c[3] << 8u);
#elif BYTES == 4
    codes.w = c;
#elif BYTES == 6
    for (int n = 0; n < 2; ++n) {
        uvec2 low = c[2 * n], high = c[2 * n + 1];
        codes.w[3 * n] = low.x;
        codes.w[3 * n + 1] = low.y | (high.x << 16u);
        codes.w[3 * n + 2] = (high.x >> 16u) | (high.y << 16u);
    }
#elif BYTES == 8
    for (int n = 0; n < 4; ++n) {
        codes.w[2 * n] = c[n].x;
        codes.w[2 * n + 1] = c[n].y;
    }
#endif
    return codes;
}

CODE[4] unpack(Codes codes) {
    CODE c[4];
#if BYTES == 1
    for (int n = 0; n < 4; ++n) c[n] = codes.w[0] >> (8 * n);
#elif BYTES == 2
    c[0] = codes.w[0];
    c[1] = codes.w[0] >> 16u;
    c[2] = codes.w[1];
    c[3] = codes.w[1] >> 16u;
#elif BYTES == 3
    c[0] = codes.w[0];
    c[1] = (codes.w[0] >> 24u) | (codes.w[1] << 8u);
    c[2] = (codes.w[1] >> 16u) | (codes.w[2] << 16u);
    c[3] = codes.w[2] >> 8u;
#elif BYTES == 4
    c = codes.w;
#elif BYTES == 6
    for (int n = 0; n < 2; ++n) {
        uint first = codes.w[3 * n], middle = codes.w[3 * n + 1], last = codes.w[3 * n + 2];
        c[2 * n] = uvec2(first, middle & 0xffffu);
        c[2 * n + 1] = uvec2((middle >> 16u) | (last << 16u), last >> 16u);
    }
#elif BYTES == 8
    for (int n = 0; n < 4; ++n) c[n] = uvec2(codes.w[2 * n], codes.w[2 * n + 1]);
#endif
    return c;
}
