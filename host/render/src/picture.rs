//! Pictures.

use std::sync::LazyLock;

/// Pixels of a picture each way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Size {
    /// The number of pixels from left to right.
    pub width: u32,
    /// The number of pixels from top to bottom.
    pub height: u32,
}

impl Size {
    /// The number of all pixels.
    pub const fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }

    pub(super) const fn pair(self) -> (u32, u32) {
        (self.width, self.height)
    }
}

/// A picture of linear colours, which may be brighter than white.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The picture's size.
    pub size: Size,
    /// Red, green, blue and 1, row by row from the top.
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// Its pixels as sRGB, three bytes each. Colours brighter than white go to white by degrees, so that highlights
    /// keep a shape.
    pub fn to_srgb8(&self) -> Vec<u8> {
        let bytes = |pixel: &[f32; 4]| [pixel[0], pixel[1], pixel[2]].map(|linear| srgb8(shoulder(linear)));
        self.pixels.iter().flat_map(bytes).collect()
    }
}

/// The identity up to 0.8, and from there on a curve towards 1, with the same slope.
fn shoulder(linear: f32) -> f64 {
    const KNEE: f64 = 0.8;
    let linear = f64::from(linear).max(0.0);
    let beyond = (linear - KNEE).max(0.0) / (1.0 - KNEE);
    linear.min(KNEE) + (1.0 - KNEE) * (1.0 - 1.0 / (1.0 + beyond))
}

/// The linear value of a byte, or of a place between two, by the curve of sRGB (IEC 61966-2-1).
pub(crate) fn linear(byte: f64) -> f64 {
    let value = byte / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The byte nearest to a linear value on the curve of sRGB; 0 for NaN.
pub(crate) fn srgb8(value: f64) -> u8 {
    // Searched, since a power for each pixel takes as long as drawing it.
    static BETWEEN: LazyLock<[f64; 255]> =
        LazyLock::new(|| std::array::from_fn(|byte| linear(byte as f64 + 0.5)));
    BETWEEN.partition_point(|step| *step <= value) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Middle grey of sRGB, its ends, and colours that are no colours.
    #[test]
    fn colours_become_bytes() {
        let size = Size { width: 2, height: 1 };
        let pixels = vec![[0.0, 0.212_230_76, f32::INFINITY, 1.0], [-1.0, f32::NAN, 1e9, 1.0]];
        let bytes = Picture { size, pixels }.to_srgb8();
        assert_eq!(bytes, [0, 127, 255, 0, 0, 255]);
    }

    /// Brighter never becomes darker, and up to the knee colours stay.
    #[test]
    fn the_shoulder_rises() {
        let values = (0..4000).map(|step| step as f32 * 0.01);
        assert!(values.clone().map(shoulder).is_sorted());
        assert!(values.map(shoulder).all(|value| value < 1.0));
        assert_eq!(shoulder(0.5), 0.5);
    }
}
