//! A deferred renderer as engines have it, to look at codecs and to show that they go through the graphics pipeline unchanged.
//!
//! A geometry pass rotates the vertices' normals, encodes them and writes the codes to an attachment of the codec's own
//! Vulkan format; a lighting pass fetches the codes, decodes them and lights the surfaces. Normals of vertices are
//! floats or codes. The shaders are in Rust and in GLSL, and both give the same picture in every bit.
//!
//! * [`conform`]: shows that every codec goes through the graphics pipeline unchanged.
//! * [`figures`]: pictures of codecs. [`report`]: one page of tables and pictures.
//! * [`visible`]: how far pictures show the errors of codecs.

#![deny(unsafe_code)]

mod camera;
pub mod conform;
mod error;
pub mod figures;
mod picture;
mod projection;
mod renderer;
pub mod report;
mod scene;
mod seen;
pub mod shaders;
mod shapes;
mod storage;
mod variant;
pub mod visible;

pub use error::{Error, Result};
pub use picture::{Picture, Size};
pub use projection::{PROJECTIONS, Projection};
pub use renderer::{Layers, MAX_SAMPLES, Renderer};
pub use scene::OBJECTS;
pub use seen::Seen;
pub use storage::Storage;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use unitvec_catalogue::AnyCodec;

/// The material of objects, in the order of the shaders' numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Material {
    /// Matt.
    Lambertian,
    /// With a highlight, by normalised Blinn-Phong.
    Glossy,
    /// A mirror.
    Mirror,
    /// With a highlight, by GGX.
    Ggx,
}

impl Material {
    /// The survey's three, and GGX.
    pub const ALL: [Self; 4] = [Self::Lambertian, Self::Glossy, Self::Mirror, Self::Ggx];

    /// The name in options, files and pages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lambertian => "lambertian",
            Self::Glossy => "glossy",
            Self::Mirror => "mirror",
            Self::Ggx => "ggx",
        }
    }
}

/// The normals in the G-buffer.
#[derive(Clone, Copy, Debug)]
pub enum Normals {
    /// Normals as three floats.
    Float,
    /// Codes.
    Codec(&'static AnyCodec),
    /// Codes with an offset, for one of [`shaders::dithered`].
    Dithered(&'static AnyCodec, Key),
}

/// The source of a dithered code's offset, in the order of the shaders' numbers, which begin with 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Key {
    /// A hash of the pixel.
    Pixel,
    /// The pixel's texel of the tile of blue noise.
    BlueNoise,
    /// A hash of the position in object space.
    Position,
}

/// The vertices' normals.
#[derive(Clone, Copy, Debug)]
pub enum Vertices {
    /// Three floats.
    Float,
    /// Codes, in the codec's format or as integers.
    Codec(&'static AnyCodec),
}

/// The scene in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// All objects.
    Scene,
    /// The panel and the highlight on it.
    Panel,
    /// The bumpy sphere on a turntable.
    Turning,
    /// The bumpy sphere from one of [`SIDES`] sides. Together they show all of it.
    Side(u8),
    /// A mesh of one's own, with this direction of it turned to the eye; +Z for zero.
    Model([f32; 3]),
}

/// Sides of [`View::Side`], the corners of a tetrahedron.
pub const SIDES: u8 = 4;

/// A picture to render.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// The normals in the G-buffer.
    pub normals: Normals,
    /// The normals in the vertex buffers.
    pub vertices: Vertices,
    /// The material of all objects.
    pub material: Material,
    /// The scene.
    pub view: View,
    /// The angle by which the sphere of [`View::Turning`] has turned, or the panel of [`View::Panel`].
    pub turn_degrees: f32,
    /// Moves the offsets that belong to the screen from frame to frame; 0 for ones that stay.
    pub seed: u32,
    /// The part of the view that fills the picture: left, top, width and height in pixels of the whole, neither 0.
    pub part: Option<[u32; 4]>,
}

impl Shot {
    /// All objects, from the front, with normals as floats throughout.
    pub const fn new(material: Material) -> Self {
        Self {
            normals: Normals::Float,
            vertices: Vertices::Float,
            material,
            view: View::Scene,
            turn_degrees: 0.0,
            seed: 0,
            part: None,
        }
    }

    /// The direction from what the camera looks at to the camera.
    pub fn toward_camera(&self) -> [f32; 3] {
        (-scene::arrange(self, Size { width: 1, height: 1 }).0.forward).as_vec3().to_array()
    }
}
