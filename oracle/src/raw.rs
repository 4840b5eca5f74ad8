//! Raw components: snorm, biased unorm and half floats.

/// Survey, section 1.2: the value of the low `b` bits of `bits` as an snorm.
pub fn snorm(bits: u64, b: u32) -> f64 {
    let low = (bits % (1 << b)) as i64;
    let integer = if low < 1 << (b - 1) { low } else { low - (1 << b) };
    (integer as f64 / ((1i64 << (b - 1)) - 1) as f64).max(-1.0)
}

/// Three snorm components of these widths; +Z for zeros.
pub fn snorm3(bits: u64, widths: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = widths;
    match [snorm(bits, a), snorm(bits >> a, b), snorm(bits >> (a + b), c)] {
        [0.0, 0.0, 0.0] => [0.0, 0.0, 1.0],
        v => v,
    }
}

/// Article 001: `f * 2 - 1` of three unorm8.
pub fn unorm8x3(bits: u64) -> [f64; 3] {
    [0, 8, 16].map(|shift| ((bits >> shift) & 255) as f64 / 255.0 * 2.0 - 1.0)
}

/// IEEE 754 binary16, section 3.4; exponent 31 as +-65504.
pub fn half(bits: u64) -> f64 {
    let (exponent, fraction) = ((bits >> 10) & 31, (bits & 1023) as f64 / 1024.0);
    let magnitude = match exponent {
        0 => fraction * 2f64.powi(-14),
        31 => 65504.0,
        e => (1.0 + fraction) * 2f64.powi(e as i32 - 15),
    };
    if bits & 0x8000 == 0 { magnitude } else { -magnitude }
}

/// Three halves; +Z for zeros.
pub fn half3(bits: u64) -> [f64; 3] {
    match [0, 16, 32].map(|shift| half(bits >> shift)) {
        [0.0, 0.0, 0.0] => [0.0, 0.0, 1.0],
        v => v,
    }
}
