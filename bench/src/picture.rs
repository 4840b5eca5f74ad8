//! `cargo run -p unitvec-bench --bin picture`: the README's pictures, of a mirror whose normals went through a codec.

use glam::{Vec2, Vec3};
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use unitvec::{Codec, OctPrecise16, OctPrecise24, Snorm8x3};

/// Pixels along a side.
const SIZE: u32 = 216;

/// Samples along a pixel's side: a normal is stored for each.
const SAMPLES: u32 = 3;

/// The normal of a gently waved sheet, as a car's door has it: it turns by some 15 degrees over the picture.
fn normal(at: Vec2) -> Vec3 {
    let wave = 0.03 * (3.1 * at.x + 1.7 * at.y).sin();
    Vec3::new(0.11 * at.x + wave + 0.2, 0.09 * at.y - wave - 0.27, 1.0).normalize()
}

/// The light from a direction: tubes under a ceiling, warm in one corner and cold in the other.
fn light(from: Vec3) -> Vec3 {
    let ceiling = Vec2::new(from.x, from.y) / from.z.max(0.1);
    let tube = (0.5 + 0.5 * (19.0 * (ceiling.x + 0.4 * ceiling.y)).sin()).powi(5);
    let across = (0.5 + 0.9 * (ceiling.y - 0.3 * ceiling.x)).clamp(0.0, 1.0);
    let ambient = Vec3::new(0.02, 0.05, 0.13).lerp(Vec3::new(0.22, 0.10, 0.06), across);
    ambient.lerp(Vec3::new(0.62, 0.88, 1.0).lerp(Vec3::new(1.0, 0.86, 0.60), across), tube)
}

/// The colour of a pixel with the normals as `stored` gives them back.
fn pixel(x: u32, y: u32, stored: fn(Vec3) -> Vec3) -> [u8; 3] {
    let mut sum = Vec3::ZERO;
    for sample in 0..SAMPLES * SAMPLES {
        let place = |pixel: u32, offset: u32| {
            2.0 * (pixel as f32 + (offset as f32 + 0.5) / SAMPLES as f32) / SIZE as f32 - 1.0
        };
        let n = stored(normal(Vec2::new(place(x, sample % SAMPLES), place(y, sample / SAMPLES)))).normalize();
        let view = Vec3::new(0.0, 0.55, 0.83).normalize();
        sum += light(2.0 * n.dot(view) * n - view);
    }
    let mean = sum / (SAMPLES * SAMPLES) as f32;
    mean.to_array().map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.2) + 0.5) as u8)
}

fn write(path: &Path, stored: fn(Vec3) -> Vec3) -> Result<(), Box<dyn Error>> {
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgb);
    let pixels: Vec<u8> = (0..SIZE * SIZE).flat_map(|i| pixel(i % SIZE, i / SIZE, stored)).collect();
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}

fn stored<C: Codec>(v: Vec3) -> Vec3 {
    C::decode(C::encode(v))
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/mirror");
    std::fs::create_dir_all(&folder)?;
    write(&folder.join("float32x3.png"), |v| v)?;
    write(&folder.join("snorm8x3.png"), stored::<Snorm8x3>)?;
    write(&folder.join("oct16p.png"), stored::<OctPrecise16>)?;
    write(&folder.join("oct24p.png"), stored::<OctPrecise24>)
}
