//! Raw components: snorm, biased unorm and half floats.

use super::{field, normalize, twos_complement};

/// Survey, section 1.2: the largest integer of an snorm of `b` bits.
pub fn snorm_max(b: u32) -> f64 {
    ((1i64 << (b - 1)) - 1) as f64
}

/// Survey, section 1.2: the value of the low `b` bits of `bits` as an snorm.
pub fn snorm(bits: u64, b: u32) -> f64 {
    (twos_complement(bits, b) as f64 / snorm_max(b)).max(-1.0)
}

/// Three snorm components of these widths as they are.
pub fn components(bits: u64, [a, b, c]: [u32; 3]) -> [f64; 3] {
    [snorm(bits, a), snorm(bits >> a, b), snorm(bits >> (a + b), c)]
}

/// Three snorm components of these widths; +Z for zeros.
pub fn snorm3(bits: u64, widths: [u32; 3]) -> [f64; 3] {
    or_z(components(bits, widths))
}

/// The code of three integers in these widths.
pub fn pack([x, y, z]: [f64; 3], [a, b, c]: [u32; 3]) -> u64 {
    field(x as i64, a) | (field(y as i64, b) << a) | (field(z as i64, c) << (a + b))
}

/// The code of the unit vector's components, rounded.
pub fn snorm3_encode(v: [f64; 3], widths: [u32; 3]) -> u64 {
    let unit = normalize(v);
    pack([0, 1, 2].map(|i| (unit[i] * snorm_max(widths[i])).round()), widths)
}

fn or_z(v: [f64; 3]) -> [f64; 3] {
    if v == [0.0; 3] { [0.0, 0.0, 1.0] } else { v }
}

/// Article 001: `f * 2 - 1` of three unorm8.
pub fn unorm8x3(bits: u64) -> [f64; 3] {
    [0, 8, 16].map(|shift| ((bits >> shift) & 255) as f64 / 255.0 * 2.0 - 1.0)
}

/// The code of the unit vector's components as unorm8, ties up.
pub fn unorm8x3_encode(v: [f64; 3]) -> u64 {
    let [x, y, z] = normalize(v).map(|t| ((t * 0.5 + 0.5) * 255.0 + 0.5).floor() as u64);
    x | (y << 8) | (z << 16)
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
    or_z([0, 16, 32].map(|shift| half(bits >> shift)))
}

/// The half nearest to a number from 0 to 1, ties to even (IEEE 754, sections 3.4 and 4.3.1).
pub fn half_code(x: f64) -> u64 {
    let exponent = (((x.to_bits() >> 52) as i32) - 1023).max(-14);
    let significand = (x * 2f64.powi(10 - exponent)).round_ties_even() as u64;
    (((exponent + 14) as u64) << 10) + significand
}

/// The code of the unit vector's components as halves.
pub fn half3_encode(v: [f64; 3]) -> u64 {
    let [x, y, z] = normalize(v).map(|t| half_code(t.abs()) | if t < 0.0 { 0x8000 } else { 0 });
    x | (y << 16) | (z << 32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Halves: all of those from 0 to 1 come back, from numbers a bit off them too.
    #[test]
    fn halves_round_to_nearest() {
        for code in 0..=0x3c00 {
            let (x, above) = (half(code), half(code + 1));
            assert_eq!(half_code(x), code);
            assert_eq!(half_code(x + (above - x) * 0.499), code);
            assert_eq!(half_code(x + (above - x) * 0.5), code + code % 2);
        }
    }
}
