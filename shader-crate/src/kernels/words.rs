//! Four vectors and four codes as whole words.

use glam::Vec3;

/// Four vectors, as words of f32 bits.
pub type Vectors = [u32; 12];

#[inline(always)]
pub fn vector(words: &Vectors, n: usize) -> Vec3 {
    Vec3::new(
        f32::from_bits(words[3 * n]),
        f32::from_bits(words[3 * n + 1]),
        f32::from_bits(words[3 * n + 2]),
    )
}

#[inline(always)]
pub fn set_vector(words: &mut Vectors, n: usize, v: Vec3) {
    words[3 * n] = v.x.to_bits();
    words[3 * n + 1] = v.y.to_bits();
    words[3 * n + 2] = v.z.to_bits();
}

/// Low and high word of a code.
pub type CodeWords = [u32; 2];

/// The words that four codes fill.
pub trait Words {
    fn pack(codes: [CodeWords; 4]) -> Self;
    fn unpack(&self) -> [CodeWords; 4];
}

impl Words for [u32; 1] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a | (b << 8) | (c << 16) | (d << 24)]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a] = *self;
        [[a, 0], [a >> 8, 0], [a >> 16, 0], [a >> 24, 0]]
    }
}

impl Words for [u32; 2] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a | (b << 16), c | (d << 16)]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, c] = *self;
        [[a, 0], [a >> 16, 0], [c, 0], [c >> 16, 0]]
    }
}

impl Words for [u32; 3] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a | (b << 24), (b >> 8) | (c << 16), (c >> 16) | (d << 8)]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [u, v, w] = *self;
        [[u, 0], [(u >> 24) | (v << 8), 0], [(v >> 16) | (w << 16), 0], [w >> 8, 0]]
    }
}

impl Words for [u32; 4] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a, b, c, d]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, b, c, d] = *self;
        [[a, 0], [b, 0], [c, 0], [d, 0]]
    }
}

impl Words for [u32; 6] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; 4]) -> Self {
        let pack_two =
            |low, low_high, high, high_high| [low, low_high | (high << 16), (high >> 16) | (high_high << 16)];
        let ([t, u, v], [w, x, y]) = (pack_two(a, a_high, b, b_high), pack_two(c, c_high, d, d_high));
        [t, u, v, w, x, y]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [t, u, v, w, x, y] = *self;
        [[t, u & 0xffff], [(u >> 16) | (v << 16), v >> 16], [w, x & 0xffff], [(x >> 16) | (y << 16), y >> 16]]
    }
}

impl Words for [u32; 8] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; 4]) -> Self {
        [a, a_high, b, b_high, c, c_high, d, d_high]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, a_high, b, b_high, c, c_high, d, d_high] = *self;
        [[a, a_high], [b, b_high], [c, c_high], [d, d_high]]
    }
}
