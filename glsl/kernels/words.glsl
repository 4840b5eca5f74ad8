// Four vectors and four codes as whole words; BYTES is the size of a code.

struct Vectors { float f[12]; };
struct Codes { uint w[BYTES]; };

Codes pack(uint c[4]) {
    Codes codes;
#if BYTES == 2
    codes.w[0] = c[0] | (c[1] << 16u);
    codes.w[1] = c[2] | (c[3] << 16u);
#elif BYTES == 3
    codes.w[0] = c[0] | (c[1] << 24u);
    codes.w[1] = (c[1] >> 8u) | (c[2] << 16u);
    codes.w[2] = (c[2] >> 16u) | (c[3] << 8u);
#elif BYTES == 4
    codes.w = c;
#endif
    return codes;
}

uint[4] unpack(Codes codes) {
    uint c[4];
#if BYTES == 2
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
#endif
    return c;
}
