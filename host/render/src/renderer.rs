//! The two passes, and the objects that they keep from picture to picture.

use super::camera::Camera;
use super::picture::{Picture, Size};
use super::scene::{self, Placed};
use super::seen::{Seen, seen};
use super::shapes::Body;
use super::storage::{Storage, float_texels, texels_of};
use super::variant::{Shaders, Stage, Variant};
use super::{Error, Normals, Shot, Vertices};
use crate::Result;
use bytemuck::{Pod, Zeroable};
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Element};
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::{
    Device, Draw, Graphics, Image, ImageFormat, Mesh, Pipeline, PipelineOptions, Shader, Target,
};

/// The most samples in each direction of a pixel.
pub const MAX_SAMPLES: u32 = 64;

/// Flag of the push constants: normals are not rotated, normalised or lit.
pub(super) const RAW: u32 = 1;

/// Attachments of the geometry pass besides the code: the normal as it was encoded, and the position in object space with the
/// object's number.
pub(super) const FLOATS: [ImageFormat; 2] = [ImageFormat::R32G32B32A32_SFLOAT; 2];

/// Renders pictures of the scene on a device.
pub struct Renderer {
    pub(super) graphics: Arc<Graphics>,
    pub(super) shaders: Shaders,
    pub(super) size: Size,
    samples: u32,
    bodies: Vec<Body>,
    meshes: HashMap<String, Vec<Mesh>>,
    geometry: HashMap<ImageFormat, Target>,
    light: Target,
    noise: Image,
    pipelines: HashMap<String, Pipeline>,
}

/// The output of the geometry pass, row by row from the top.
pub struct Layers {
    /// Texels of the code's format.
    pub codes: Vec<u8>,
    /// Normals as they were encoded, and 1; 0 where nothing is drawn.
    pub normals: Vec<[f32; 4]>,
    /// Positions in object space, and the object's number; 0 where nothing is drawn.
    pub surfaces: Vec<[f32; 4]>,
}

/// Push constants of the geometry pass.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Geometry {
    pub(super) clip_from_object: [[f32; 4]; 4],
    pub(super) world_from_object: [[f32; 4]; 3],
    pub(super) object: u32,
    pub(super) flags: u32,
    pub(super) key: u32,
    pub(super) seed: u32,
}

/// Push constants of the lighting pass. Rays are `forward + right x + up y` at `centre * viewport.xy + viewport.zw`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Lighting {
    pub(super) right: [f32; 4],
    pub(super) up: [f32; 4],
    pub(super) forward: [f32; 4],
    pub(super) viewport: [f32; 4],
    pub(super) material: u32,
    pub(super) flags: u32,
    pub(super) key: u32,
    pub(super) seed: u32,
}

/// Texels of the tile of blue noise, across and down.
const NOISE: (u32, u32) = (64, 64);

impl Renderer {
    /// A renderer of pictures of this size, with `samples` times `samples` samples a pixel, on a device of
    /// [`Device::open_for_graphics`]. `source`: [`BackendKind::Rust`] or [`BackendKind::Glsl`].
    ///
    /// # Errors
    /// [`Error::BadSamples`], a feature that the device lacks, or a failed call.
    pub fn new(device: &Arc<Device>, source: BackendKind, size: Size, samples: u32) -> Result<Self> {
        if !(1..=MAX_SAMPLES).contains(&samples) {
            return Err(Error::BadSamples(samples));
        }
        let graphics = Graphics::new(device)?;
        let light = Target::new(&graphics, size.pair(), &FLOATS, false)?;
        let noise = Image::texture(&graphics, ImageFormat::R8G8_UNORM, NOISE, unitvec_shaders::blue_noise())?;
        Ok(Self {
            graphics,
            shaders: Shaders::of(source)?,
            size,
            samples,
            bodies: scene::bodies()?,
            meshes: HashMap::new(),
            geometry: HashMap::new(),
            light,
            noise,
            pipelines: HashMap::new(),
        })
    }

    /// Puts a body in the place of the scene's, for [`View::Model`](super::View::Model).
    pub(super) fn show(&mut self, body: Body) {
        self.bodies = vec![body];
        self.meshes.clear();
    }

    /// Renders a picture.
    ///
    /// # Errors
    /// [`Error::NotDithered`], a missing feature, shaders that are missing or do not compile, or a failed call.
    pub fn render(&mut self, shot: &Shot) -> Result<Picture> {
        let mut sums = vec![[0.0f32; 4]; self.size.pixels()];
        let step = 1.0 / f64::from(self.samples);
        for row in 0..self.samples {
            for column in 0..self.samples {
                let offset = [column, row].map(|at| (f64::from(at) + 0.5) * step - 0.5);
                self.sample(shot, offset)?;
                let pixels = self.light.read(0)?;
                for (sum, pixel) in sums.iter_mut().zip(float_texels(&pixels)) {
                    sum.iter_mut().zip(pixel).for_each(|(sum, component)| *sum += component);
                }
            }
        }
        let share = (step * step) as f32;
        Ok(Picture { size: self.size, pixels: sums.into_iter().map(|sum| sum.map(|c| c * share)).collect() })
    }

    /// The surface that each pixel of a shot shows at its centre; row by row from the top.
    ///
    /// # Errors
    /// The errors of [`render`](Self::render).
    pub fn seen(&mut self, shot: &Shot) -> Result<Vec<Option<Seen>>> {
        self.sample(shot, [0.0; 2])?;
        let target = &self.geometry[&self.variant(shot.normals)?.storage.texel()];
        Ok(seen(&target.read(2)?, &target.read(1)?, &self.light.read(1)?))
    }

    /// Draws both passes; pixels are seen at an offset from their centres.
    fn sample(&mut self, shot: &Shot, offset: [f64; 2]) -> Result<()> {
        let variant = self.variant(shot.normals)?;
        let (camera, objects) = scene::arrange(shot, self.size);
        self.draw_geometry(shot, &variant, &camera, &objects, offset)?;
        let name = self.light_pipeline(&variant)?;
        let lighting = Lighting {
            material: shot.material as u32,
            key: key_number(shot.normals),
            seed: shot.seed,
            ..camera.lighting(offset)
        };
        let geometry = &self.geometry[&variant.storage.texel()];
        let textures = (0..).zip([geometry.colour(0), geometry.colour(2), Some(&self.noise)]);
        let textures: Vec<_> = textures.filter_map(|(binding, image)| Some((binding, image?))).collect();
        let draw =
            Draw { pipeline: &self.pipelines[&name], mesh: None, constants: bytemuck::bytes_of(&lighting) };
        Ok(self.graphics.draw(&self.light, &textures, &[draw])?)
    }

    /// Draws the geometry pass of a shot alone, with one sample a pixel.
    ///
    /// # Errors
    /// The errors of [`render`](Self::render).
    pub fn layers(&mut self, shot: &Shot) -> Result<Layers> {
        let variant = self.variant(shot.normals)?;
        let (camera, objects) = scene::arrange(shot, self.size);
        self.draw_geometry(shot, &variant, &camera, &objects, [0.0; 2])?;
        let target = &self.geometry[&variant.storage.texel()];
        let (codes, normals, surfaces) = (target.read(0)?, target.read(1)?, target.read(2)?);
        Ok(Layers {
            codes,
            normals: float_texels(&normals).collect(),
            surfaces: float_texels(&surfaces).collect(),
        })
    }

    fn draw_geometry(
        &mut self,
        shot: &Shot,
        variant: &Variant,
        camera: &Camera,
        objects: &[Placed],
        offset: [f64; 2],
    ) -> Result<()> {
        let pipeline = self.geometry_pipeline(variant, shot.vertices)?;
        let meshes = self.place_meshes(shot.vertices)?;
        let constants = objects.iter().map(|placed| geometry_of(shot, placed, camera, offset));
        let constants: Vec<Geometry> = constants.collect();
        let draws = constants.iter().map(|constants| Draw {
            pipeline: &self.pipelines[&pipeline],
            mesh: self.meshes[&meshes].get(constants.object as usize - 1),
            constants: bytemuck::bytes_of(constants),
        });
        let draws: Vec<_> = draws.collect();
        let target = &self.geometry[&variant.storage.texel()];
        Ok(self.graphics.draw(target, &[(2, &self.noise)], &draws)?)
    }

    fn device(&self) -> &Arc<Device> {
        self.graphics.device()
    }

    /// The storage of a codec's codes in the G-buffer, without a test of how the device rounds 10 bits.
    pub(super) fn storage(&self, format: &AnyCodec) -> Storage {
        Storage::drawn(format, self.device(), false)
    }

    fn variant(&self, normals: Normals) -> Result<Variant> {
        Ok(match normals {
            Normals::Float => Variant::FLOAT,
            Normals::Codec(format) => Variant::codec(format, self.storage(format)),
            Normals::Dithered(format, _) => {
                Variant::dithered(format).ok_or(Error::NotDithered { id: format.id })?
            }
        })
    }

    /// Makes the target and the pipeline of the geometry pass where they are not there yet; the pipeline's name.
    fn geometry_pipeline(&mut self, variant: &Variant, vertices: Vertices) -> Result<String> {
        let format = variant.storage.texel();
        if !self.geometry.contains_key(&format) {
            let formats = [&[format], &FLOATS[..]].concat();
            self.geometry.insert(format, Target::new(&self.graphics, self.size.pair(), &formats, true)?);
        }
        let from = self.vertex_variant(vertices);
        let name = format!("{} from {}", variant.name(), from.name());
        if !self.pipelines.contains_key(&name) {
            let attributes = [ImageFormat::R32G32B32_SFLOAT, from.storage.attribute(self.device())];
            let stages = [(&from, Stage::Vertex), (variant, Stage::Gbuffer)];
            let pipeline = pipeline(&self.shaders, &self.geometry[&format], stages, &attributes, false)?;
            self.pipelines.insert(name.clone(), pipeline);
        }
        Ok(name)
    }

    /// Makes the pipeline of the lighting pass where it is not there yet; its name.
    fn light_pipeline(&mut self, variant: &Variant) -> Result<String> {
        let name = format!("light of {}", variant.name());
        if !self.pipelines.contains_key(&name) {
            let stages = [(variant, Stage::Fullscreen), (variant, Stage::Light)];
            let pipeline = pipeline(&self.shaders, &self.light, stages, &[], false)?;
            self.pipelines.insert(name.clone(), pipeline);
        }
        Ok(name)
    }

    fn vertex_variant(&self, vertices: Vertices) -> Variant {
        match vertices {
            Vertices::Float => Variant::FLOAT,
            Vertices::Codec(format) => Variant::codec(format, Storage::of(format)),
        }
    }

    /// Makes the meshes with these normals where they are not there yet; their name.
    fn place_meshes(&mut self, vertices: Vertices) -> Result<String> {
        let variant = self.vertex_variant(vertices);
        let name = variant.name();
        if self.meshes.contains_key(&name) {
            return Ok(name);
        }
        let attribute = variant.storage.attribute(self.device());
        let mut meshes = Vec::new();
        for body in &self.bodies {
            let normals = match vertices {
                Vertices::Float => bytemuck::cast_slice(&body.normals).to_vec(),
                Vertices::Codec(format) => {
                    texels_of(&encoded(format, &body.normals)?, attribute, format.bytes)
                }
            };
            let positions = bytemuck::cast_slice(&body.positions);
            let attributes = [(ImageFormat::R32G32B32_SFLOAT, positions), (attribute, normals.as_slice())];
            meshes.push(Mesh::new(&self.graphics, &attributes, Some(&body.indices))?);
        }
        self.meshes.insert(name.clone(), meshes);
        Ok(name)
    }
}

/// The codes of normals, by the CPU. The frames' tangents are those of the shaders.
pub(super) fn encoded(format: &AnyCodec, normals: &[[f32; 3]]) -> Result<Vec<u8>> {
    let mut codes = vec![0; normals.len() * format.bytes];
    let elements: Vec<f32> = match format.element {
        Element::Vector => normals.as_flattened().to_vec(),
        // Nothing draws rotations.
        Element::Rotation => Vec::new(),
        Element::Frame => normals.iter().flat_map(|[x, y, z]| [*x, *y, *z, *y, *z, *x, 1.0]).collect(),
    };
    format.encode_cpu(&elements, &mut codes)?;
    Ok(codes)
}

/// The normals of codes, by the CPU.
pub(super) fn decoded(format: &AnyCodec, codes: &[u8]) -> Result<Vec<[f32; 3]>> {
    let floats = format.element.floats();
    let mut elements = vec![0.0; codes.len() / format.bytes * floats];
    format.decode_cpu(codes, &mut elements)?;
    Ok(elements.chunks_exact(floats).map(|element| [element[0], element[1], element[2]]).collect())
}

/// A pipeline of a vertex and a fragment stage.
pub(super) fn pipeline(
    shaders: &Shaders,
    target: &Target,
    [vertex, fragment]: [(&Variant, Stage); 2],
    attributes: &[ImageFormat],
    points: bool,
) -> Result<Pipeline> {
    let [vertex, fragment] = [shaders.compile(vertex.0, vertex.1)?, shaders.compile(fragment.0, fragment.1)?];
    let options = PipelineOptions {
        vertex: Shader { spirv: &vertex.spirv, entry_point: &vertex.entry_point },
        fragment: Shader { spirv: &fragment.spirv, entry_point: &fragment.entry_point },
        attributes,
        points,
    };
    Ok(Pipeline::new(target, &options)?)
}

fn geometry_of(shot: &Shot, placed: &Placed, camera: &Camera, offset: [f64; 2]) -> Geometry {
    let clip = camera.clip_from_world(offset) * placed.world_from_object();
    let rows = placed.rotation.transpose().to_cols_array_2d();
    Geometry {
        clip_from_object: clip.as_mat4().to_cols_array_2d(),
        world_from_object: rows.map(|[x, y, z]| [x as f32, y as f32, z as f32, 0.0]),
        object: placed.object,
        flags: 0,
        key: key_number(shot.normals),
        seed: shot.seed,
    }
}

/// The number that shaders have for the source of an offset; 0 without one.
fn key_number(normals: Normals) -> u32 {
    match normals {
        Normals::Float | Normals::Codec(_) => 0,
        Normals::Dithered(_, key) => 1 + key as u32,
    }
}
