//! The normal maps of a file's materials, as the files that they are.

use super::document::Primitive;
use super::{File, buffers};
use crate::shape::{NormalTexture, Shape};
use crate::{Generated, MeshError, Reach};
use ::gltf::Semantic::{Tangents, TexCoords};
use ::gltf::accessor::Dimensions;
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_files::one_line;

/// Bytes of a picture that are read: 16384 by 16384 texels of four bytes.
const MOST: u64 = 1 << 30;

const NO_COORDINATES: &str = "the mesh lacks its texture coordinates, of which the first two sets are read";

/// The part of a document that normal maps depend on.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Appearance {
    materials: Vec<Material>,
    textures: Vec<Texture>,
    images: Vec<Image>,
    /// The damage of a document whose materials, textures or images cannot be read.
    #[serde(skip)]
    damage: Option<String>,
    /// The textures of materials that shapes had so far.
    #[serde(skip)]
    read: HashMap<u32, Arc<NormalTexture>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Material {
    normal_texture: Option<Reference>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Reference {
    index: usize,
    #[serde(default)]
    tex_coord: u32,
    scale: Option<f32>,
    #[serde(default)]
    extensions: Extensions,
}

#[derive(Default, Deserialize)]
struct Extensions {
    #[serde(default, rename = "KHR_texture_transform")]
    transform: Transform,
}

/// How texture coordinates are moved.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Transform {
    offset: [f32; 2],
    /// Radians, counter-clockwise where v grows downwards.
    rotation: f32,
    scale: [f32; 2],
    /// The set, in place of the reference's.
    tex_coord: Option<u32>,
}

impl Default for Transform {
    fn default() -> Self {
        Self { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2], tex_coord: None }
    }
}

impl Transform {
    /// Scales, turns, moves.
    fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let (sine, cosine) = self.rotation.sin_cos();
        let (u, v) = (self.scale[0] * u, self.scale[1] * v);
        [self.offset[0] + cosine * u + sine * v, self.offset[1] + cosine * v - sine * u]
    }
}

#[derive(Deserialize)]
struct Texture {
    source: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Image {
    uri: Option<Box<str>>,
    buffer_view: Option<usize>,
}

impl Appearance {
    /// The part in a document's JSON. Where it is damaged, shapes are told so, since geometry can be read without it.
    pub(super) fn of_json(json: &[u8]) -> Self {
        serde_json::from_slice(json)
            .unwrap_or_else(|error| Self { damage: Some(one_line(error)), ..Self::default() })
    }

    /// Gives a shape the normal map of the primitive's material, where it has one, and the tangents that it needs.
    /// `is_shared`: other materials' primitives have the same vertices.
    pub(super) fn add(
        &mut self,
        file: &File<'_>,
        primitive: &Primitive,
        is_shared: bool,
        reach: Reach,
        shape: &mut Shape,
    ) -> Result<(), MeshError> {
        let Some(at) = primitive.material else { return Ok(()) };
        if let Some(damage) = &self.damage {
            let name = format!("normal texture of material {at}");
            shape.normal_map =
                Some(Arc::new(NormalTexture { name, scale: 1.0, picture: Err(damage.clone()) }));
            return Ok(());
        }
        let material = self.materials.get(at as usize);
        let Some(Material { normal_texture: Some(reference) }) = material else { return Ok(()) };
        let name = format!("normal texture {}", reference.index);
        let scale = reference.scale.filter(|scale| scale.is_finite()).unwrap_or(1.0);
        let texture = |picture| Arc::new(NormalTexture { name, scale, picture });
        let transform = &reference.extensions.transform;
        if let set @ 1.. = transform.tex_coord.unwrap_or(reference.tex_coord) {
            // Those of a buffer that nothing else is in are not read.
            shape.texture = file.all(primitive, TexCoords(set), Dimensions::Vec2).unwrap_or_default();
        }
        shape.texture.iter_mut().for_each(|at| *at = transform.apply(*at));
        let texture = match self.read.get(&at) {
            _ if is_shared => texture(Err("other materials have the same vertices".to_owned())),
            _ if shape.texture.is_empty() => texture(Err(NO_COORDINATES.to_owned())),
            Some(texture) => texture.clone(),
            None => {
                let texture = texture(self.picture(file, reference, reach));
                self.read.insert(at, texture.clone());
                texture
            }
        };
        if texture.picture.is_ok() {
            shape.tangents = file.all(primitive, Tangents, Dimensions::Vec4).unwrap_or_default();
        }
        if texture.picture.is_ok() && shape.tangents.is_empty() {
            let frames = shape.frames(file.path, -1.0, &mut Generated::default())?;
            shape.tangents = frames.iter().map(|[.., x, y, z, sign]| [*x, *y, *z, *sign]).collect();
        }
        shape.normal_map = Some(texture);
        Ok(())
    }

    fn picture(&self, file: &File<'_>, reference: &Reference, reach: Reach) -> Result<Vec<u8>, String> {
        let source = self.textures.get(reference.index).and_then(|texture| texture.source);
        let image = source.and_then(|source| self.images.get(source)).ok_or("it has no image")?;
        let read = |uri: &str| match uri.strip_prefix("data:") {
            Some(data) => buffers::decode_data(data),
            None => buffers::read_file(&buffers::file_of(file.path, uri, reach)?, MOST),
        };
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) => read(uri).map_err(one_line),
            (None, Some(view)) => {
                let bytes = file.document.views().nth(view).and_then(|view| {
                    let end = view.offset().checked_add(view.length())?;
                    file.buffers.get(view.buffer().index())?.get(view.offset()..end)
                });
                let bytes = bytes.map(<[u8]>::to_vec);
                bytes.ok_or_else(|| "its buffer view has not the bytes of a picture".to_owned())
            }
            (None, None) => Err("its image has neither a URI nor a buffer view".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Transform;

    /// A quarter turn counter-clockwise, v growing downwards, brings what is to the right of the origin above it, and what is below
    /// it to its right.
    #[test]
    fn coordinates_are_scaled_turned_and_moved() {
        let quarter = std::f32::consts::FRAC_PI_2;
        let transform =
            Transform { offset: [0.25, 0.5], rotation: quarter, scale: [1.5, 3.0], tex_coord: None };
        // Scaled: (1.5, 0), then up a quarter of a circle: (0, -1.5).
        let [u, v] = transform.apply([1.0, 0.0]);
        assert!((u - 0.25).abs() < 1e-6 && (v + 1.0).abs() < 1e-6, "{u} {v}");
        let [u, v] = transform.apply([0.0, 1.0]);
        assert!((u - 3.25).abs() < 1e-6 && (v - 0.5).abs() < 1e-6, "{u} {v}");
    }
}
