//! Whole vertices of primitives: positions, normals, texture coordinates and triangles.

use super::document::Primitive;
use super::texture::Appearance;
use super::{File, chunks, load, triangles};
use crate::faces::resolve;
use crate::shape::Shape;
use crate::{MeshError, Reach, list_of};
use ::gltf::Semantic::{self, Normals, Positions, TexCoords};
use ::gltf::accessor::{Dimensions, Item};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// The accessors of a shape: of positions, normals and texture coordinates.
pub(super) type Key = [Option<u32>; 3];

pub(super) fn key(primitive: &Primitive) -> Key {
    [Positions, Normals, TexCoords(0)].map(|semantic| primitive.get(&semantic))
}

/// Reads the shapes of a file, in the order of their first primitives.
pub(crate) fn parse_shapes(path: &Path, bytes: &[u8], reach: Reach) -> Result<Vec<Shape>, MeshError> {
    let file = load(path, bytes, reach, &[Positions, Normals, TexCoords(0)])?;
    let mut appearance = Appearance::of_json(&chunks(path, bytes)?.0);
    let groups = file.grouped(|primitive| Some(key(primitive)))?;
    let (mut shapes, mut seen, mut vertices) = (Vec::new(), HashSet::new(), 0_usize);
    for (.., primitive) in file.primitives().filter(|(.., primitive)| seen.insert(key(primitive))) {
        vertices = vertices.saturating_add(file.attribute(primitive, &Positions)?.count());
        file.check_vertices(vertices)?;
        let shape = file.shape(primitive, &groups)?;
        if !shape.triangles.is_empty() {
            let mut shape = shape.with_normals(path)?;
            let mut of_vertices = groups.get(&key(primitive)).into_iter().flatten();
            let is_shared = of_vertices.any(|other| other.material != primitive.material);
            appearance.add(&file, primitive, is_shared, reach, &mut shape)?;
            shapes.push(shape);
        }
    }
    if shapes.is_empty() {
        return Err(MeshError::NoSurface { path: path.into() });
    }
    Ok(shapes)
}

impl File<'_> {
    /// The shape of a primitive, with the triangles of all that have its accessors; without normals where it has none.
    pub(super) fn shape(
        &self,
        primitive: &Primitive,
        groups: &HashMap<Key, Vec<&Primitive>>,
    ) -> Result<Shape, MeshError> {
        let mut shape = Shape::default();
        let count = self.attribute(primitive, &Positions)?.count();
        shape.positions = list_of(self.path, count)?;
        self.positions(primitive, |position| shape.positions.push(position))?;
        shape.normals = self.all(primitive, Normals, Dimensions::Vec3)?;
        shape.texture = self.all(primitive, TexCoords(0), Dimensions::Vec2)?;
        for primitive in groups.get(&key(primitive)).into_iter().flatten() {
            for triangle in triangles(self.mode(primitive)?, self.corners(primitive)?) {
                shape.triangles.push(resolve(self.path, triangle, count)?.map(|corner| corner as u32));
            }
        }
        Ok(shape)
    }

    /// An attribute of each vertex; none where the primitive lacks it.
    pub(super) fn all<const N: usize>(
        &self,
        primitive: &Primitive,
        semantic: Semantic,
        dimensions: Dimensions,
    ) -> Result<Vec<[f32; N]>, MeshError>
    where
        [f32; N]: Item,
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
    {
        if primitive.get(&semantic).is_none() {
            return Ok(Vec::new());
        }
        self.check_counts(primitive, [Positions, semantic.clone()])?;
        let mut all = list_of(self.path, self.attribute(primitive, &semantic)?.count())?;
        self.vectors(primitive, &semantic, dimensions, |vector| all.push(vector))?;
        Ok(all)
    }
}
