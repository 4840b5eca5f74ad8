//! The functions of Vulkan's formats: values follow the specification, codes come back, and GLSL has Rust's bits.

use super::assert_same_words;
use unitvec::formats::*;
use unitvec::glam::{IVec2, Vec2, Vec3};
use unitvec_tests::directions::Rng;

/// The type of a component.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Snorm,
    Unorm,
    Sint,
    Half,
}

/// The functions of a format. Values are the bits of three floats, or three integers; codes are two words.
pub struct Format {
    name: &'static str,
    kind: Kind,
    bits: u32,
    components: usize,
    code_words: usize,
    to_values: fn([u32; 2]) -> [u32; 3],
    to_code: fn([u32; 3]) -> [u32; 2],
}

fn floats(values: &[f32]) -> [u32; 3] {
    std::array::from_fn(|i| values.get(i).map_or(0, |value| value.to_bits()))
}

macro_rules! of_format {
    (@values Vec2, $values:expr) => { floats(&$values.to_array()) };
    (@values Vec3, $values:expr) => { floats(&$values.to_array()) };
    (@values IVec2, $values:expr) => { [$values.x as u32, $values.y as u32, 0] };
    (@from Vec2, $w:ident) => { Vec2::new(f32::from_bits($w[0]), f32::from_bits($w[1])) };
    (@from Vec3, $w:ident) => { Vec3::from_array($w.map(f32::from_bits)) };
    (@from IVec2, $w:ident) => { IVec2::new($w[0] as i32, $w[1] as i32) };
    (@read 1, $code:ident) => { $code[0] };
    (@read 2, $code:ident) => { $code };
    (@written 1, $code:expr) => { [$code, 0] };
    (@written 2, $code:expr) => { $code };
    ($name:literal, $kind:ident, $bits:literal, $type:ident, $words:tt, $to_values:ident, $to_code:ident) => {
        Format {
            name: $name,
            kind: Kind::$kind,
            bits: $bits,
            components: size_of::<$type>() / 4,
            code_words: $words,
            to_values: |code| of_format!(@values $type, $to_values(of_format!(@read $words, code))),
            to_code: |w| of_format!(@written $words, $to_code(of_format!(@from $type, w))),
        }
    };
}

/// All formats.
pub const FORMATS: [Format; 13] = [
    of_format!("snorm8x2", Snorm, 8, Vec2, 1, code_to_snorm8x2, snorm8x2_to_code),
    of_format!("snorm16x2", Snorm, 16, Vec2, 1, code_to_snorm16x2, snorm16x2_to_code),
    of_format!("snorm8x3", Snorm, 8, Vec3, 1, code_to_snorm8x3, snorm8x3_to_code),
    of_format!("snorm10x3", Snorm, 10, Vec3, 1, code_to_snorm10x3, snorm10x3_to_code),
    of_format!("snorm16x3", Snorm, 16, Vec3, 2, code_to_snorm16x3, snorm16x3_to_code),
    of_format!("unorm8x3", Unorm, 8, Vec3, 1, code_to_unorm8x3, unorm8x3_to_code),
    of_format!("unorm8x2", Unorm, 8, Vec2, 1, code_to_unorm8x2, unorm8x2_to_code),
    of_format!("unorm10x2", Unorm, 10, Vec2, 1, code_to_unorm10x2, unorm10x2_to_code),
    of_format!("unorm16x2", Unorm, 16, Vec2, 1, code_to_unorm16x2, unorm16x2_to_code),
    of_format!("sint8x2", Sint, 8, IVec2, 1, code_to_sint8x2, sint8x2_to_code),
    of_format!("sint16x2", Sint, 16, IVec2, 1, code_to_sint16x2, sint16x2_to_code),
    of_format!("float16x2", Half, 16, Vec2, 1, code_to_float16x2, float16x2_to_code),
    of_format!("float16x3", Half, 16, Vec3, 2, code_to_float16x3, float16x3_to_code),
];

impl Format {
    /// The names of its functions.
    pub fn functions(&self) -> [String; 2] {
        [format!("code_to_{}", self.name), format!("{}_to_code", self.name)]
    }

    /// The code with these integers in its components.
    fn code(&self, integers: &[u32]) -> [u32; 2] {
        let all = integers
            .iter()
            .enumerate()
            .fold(0u64, |code, (index, integer)| code | u64::from(*integer) << (index as u32 * self.bits));
        [all as u32, (all >> 32) as u32]
    }

    /// Codes with every pattern in every component, and a pattern far from it in the others.
    fn codes(&self) -> Vec<[u32; 2]> {
        let patterns = 1 << self.bits;
        let code = |pattern: u32| {
            let integers = [0, 40_503, 27_644].map(|step| (pattern + step * pattern) % patterns);
            let rotated = |by: usize| {
                (0..self.components).map(|i| integers[(i + by) % self.components]).collect::<Vec<_>>()
            };
            (0..self.components).map(move |by| self.code(&rotated(by))).collect::<Vec<_>>()
        };
        (0..patterns).flat_map(code).collect()
    }

    /// The specification's value for a component's integer, and whether an encoder writes it.
    fn component(&self, integer: u32) -> (f64, bool) {
        let signed = f64::from((integer << (32 - self.bits)) as i32 >> (32 - self.bits));
        let most = 2f64.powi(self.bits as i32 - 1) - 1.0;
        match self.kind {
            Kind::Snorm => ((signed / most).max(-1.0), signed >= -most),
            Kind::Unorm => (f64::from(integer) / (2.0 * most + 1.0), true),
            Kind::Sint => (signed, true),
            Kind::Half => {
                let (exponent, significand) = (integer >> 10 & 31, f64::from(integer & 1023));
                let magnitude = match exponent {
                    0 => significand * 2f64.powi(-24),
                    _ => (1024.0 + significand) * 2f64.powi(exponent as i32 - 25),
                };
                let sign = if integer & 0x8000 == 0 { 1.0 } else { -1.0 };
                (sign * magnitude, exponent < 31 && integer != 0x8000)
            }
        }
    }

    /// The integer of a component of a code.
    fn integer(&self, code: [u32; 2], index: usize) -> u32 {
        let all = u64::from(code[0]) | u64::from(code[1]) << 32;
        (all >> (index as u32 * self.bits)) as u32 & ((1 << self.bits) - 1)
    }

    /// A call of the function that gives values, of the code in `w`, as a uvec3.
    fn values_in_glsl(&self) -> String {
        let code = if self.code_words == 1 { "w.x" } else { "w.xy" };
        match (self.kind, self.components) {
            (Kind::Sint, _) => format!("uvec3(uvec2(code_to_{}({code})), 0u)", self.name),
            (_, 2) => format!("uvec3(floatBitsToUint(code_to_{}({code})), 0u)", self.name),
            _ => format!("floatBitsToUint(code_to_{}({code}))", self.name),
        }
    }

    /// A call of the function that gives a code, of the values in `w`, as a uvec3.
    fn code_in_glsl(&self) -> String {
        let values = match (self.kind, self.components) {
            (Kind::Sint, _) => "ivec2(w.xy)",
            (_, 2) => "v.xy",
            _ => "v",
        };
        let rest = if self.code_words == 1 { "0u, 0u" } else { "0u" };
        format!("uvec3({}_to_code({values}), {rest})", self.name)
    }
}

/// Values are the correctly rounded ones of the specification, and give back the code; of patterns that no encoder writes, one
/// that stands for the same.
#[test]
fn values_are_the_specifications_and_codes_come_back() {
    for format in FORMATS {
        for code in format.codes() {
            let values = (format.to_values)(code);
            let back = (format.to_code)(values);
            let mut is_written = true;
            for (index, value) in values[..format.components].iter().enumerate() {
                let (expected, written) = format.component(format.integer(code, index));
                is_written &= written;
                let value = match format.kind {
                    Kind::Sint => f64::from(*value as i32),
                    _ => f64::from(f32::from_bits(*value)),
                };
                let expected = f64::from(expected as f32);
                let is_finite = expected.abs() <= 65504.0;
                assert!(value == expected || !is_finite, "{} of {code:x?}: {value}", format.name);
            }
            if is_written {
                assert_eq!(back, code, "{}", format.name);
            }
            assert_eq!((format.to_values)(back), values, "{} of {code:x?}", format.name);
        }
    }
}

/// Hardware may convert inexactly: by four units in the last place, here.
#[test]
fn values_that_are_off_give_their_codes() {
    for format in FORMATS.iter().filter(|format| [Kind::Snorm, Kind::Unorm].contains(&format.kind)) {
        for code in format.codes() {
            let values = (format.to_values)(code);
            for off in [-4i32, 4] {
                let moved = values.map(|bits| if bits == 0 { 0 } else { bits.wrapping_add_signed(off) });
                assert_eq!((format.to_code)(moved), (format.to_code)(values), "{} of {code:x?}", format.name);
            }
        }
    }
}

/// Values of all kinds: any bits, and odd or large ones.
fn values() -> Vec<[u32; 3]> {
    let mut rng = Rng::new(31);
    let odd =
        [0.0, 1e-40, f32::MIN_POSITIVE, 6e-8, 0.5, 1.0, 1.5, 65504.0, 65520.0, 1e38, f32::INFINITY, f32::NAN];
    let odd: Vec<u32> = odd.into_iter().flat_map(|x| [x, -x]).map(f32::to_bits).collect();
    let triples = odd.iter().flat_map(|&x| odd.iter().map(move |&y| [x, y, x]));
    let any = (0..100_000).map(|_| [(); 3].map(|()| rng.bits() as u32)).collect::<Vec<_>>();
    let near_one = any.clone().into_iter().map(|words| words.map(|w| (w & 0x83ff_ffff) | 0x3c00_0000));
    triples.chain(any.iter().copied()).chain(near_one).collect()
}

/// GLSL has Rust's bits, of every code and of any values; of NaN it is the code of 0.
#[test]
fn formats_in_glsl_have_the_bits_of_rust() {
    for format in &FORMATS {
        let codes: Vec<[u32; 3]> = format.codes().into_iter().map(|[low, high]| [low, high, 0]).collect();
        let in_rust = |[low, high, _]: [u32; 3]| (format.to_values)([low, high]);
        assert_same_words(&[(format.values_in_glsl(), in_rust)], &codes);
        if format.kind != Kind::Sint {
            let of_nan = (format.to_code)([f32::NAN.to_bits(); 3]);
            assert_eq!(of_nan, (format.to_code)([0; 3]), "{}", format.name);
        }
    }
    let to_codes = FORMATS.iter().map(|format| {
        let in_rust = |w| {
            let [low, high] = (format.to_code)(w);
            [low, high, 0]
        };
        (format.code_in_glsl(), in_rust)
    });
    assert_same_words(&to_codes.collect::<Vec<_>>(), &values());
}
