//! Faces: polygons to triangles, and the normals that vertices get from them.

use crate::{Mesh, MeshError, one_part, reserve};
use glam::{DVec3, Vec3};
use std::path::Path;

/// Splits a polygon into triangles that share its first corner; fewer than three corners give none.
#[derive(Default)]
pub(crate) struct Fan {
    first: Option<i64>,
    last: Option<i64>,
}

impl Fan {
    /// Takes the next corner; gives the triangle that it completes.
    pub(crate) fn push(&mut self, corner: i64) -> Option<[i64; 3]> {
        match (self.first, self.last.replace(corner)) {
            (Some(first), Some(last)) => Some([first, last, corner]),
            _ => {
                // The second corner is the first that is kept as the last one.
                self.last = self.first.map(|_| corner);
                self.first = self.first.or(Some(corner));
                None
            }
        }
    }
}

/// Splits a strip into triangles, all wound as the first; a corner below zero begins another strip.
#[derive(Default)]
pub(crate) struct Strip {
    last: [i64; 2],
    corners: usize,
}

impl Strip {
    /// Takes the next corner; gives the triangle that it completes.
    pub(crate) fn push(&mut self, corner: i64) -> Option<[i64; 3]> {
        if corner < 0 {
            *self = Self::default();
            return None;
        }
        let [a, b] = self.last;
        *self = Self { last: [b, corner], corners: self.corners + 1 };
        match self.corners {
            0..3 => None,
            corners if corners % 2 == 1 => Some([a, b, corner]),
            _ => Some([a, corner, b]),
        }
    }
}

/// Positions of vertices, in the precision that the file has them in: `f64` for all would take twice the memory.
pub(crate) enum Positions {
    Single(Vec<[f32; 3]>),
    Double(Vec<[f64; 3]>),
}

impl Positions {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Single(positions) => positions.len(),
            Self::Double(positions) => positions.len(),
        }
    }

    pub(crate) fn get(&self, vertex: usize) -> DVec3 {
        match self {
            Self::Single(positions) => Vec3::from(positions[vertex]).as_dvec3(),
            Self::Double(positions) => positions[vertex].into(),
        }
    }
}

/// Area-weighted vertex normals: the sums of the cross products of each vertex's faces.
pub(crate) struct Sums<'p> {
    path: &'p Path,
    positions: Positions,
    /// Empty before the first face.
    sums: Vec<DVec3>,
}

impl<'p> Sums<'p> {
    pub(crate) fn new(path: &'p Path, positions: Positions) -> Self {
        Self { path, positions, sums: Vec::new() }
    }

    pub(crate) fn has_faces(&self) -> bool {
        !self.sums.is_empty()
    }

    pub(crate) fn add(&mut self, triangle: [i64; 3]) -> Result<(), MeshError> {
        let [a, b, c] = resolve(self.path, triangle, self.positions.len())?;
        if self.sums.is_empty() {
            reserve(self.path, &mut self.sums, self.positions.len())?;
            self.sums.resize(self.positions.len(), DVec3::ZERO);
        }
        let [at_a, at_b, at_c] = [a, b, c].map(|corner| self.positions.get(corner));
        // Twice the area long, so that adding it weights the face by its area.
        let normal = (at_b - at_a).cross(at_c - at_a);
        [a, b, c].into_iter().for_each(|corner| self.sums[corner] += normal);
        Ok(())
    }

    pub(crate) fn add_all(&mut self, triangles: impl IntoIterator<Item = [i64; 3]>) -> Result<(), MeshError> {
        triangles.into_iter().try_for_each(|triangle| self.add(triangle))
    }

    /// Unit normals. A vertex whose sum is zero keeps its place with a normal of zero.
    pub(crate) fn normals(self) -> Vec<[f32; 3]> {
        let Self { positions, sums, .. } = self;
        if sums.is_empty() {
            return vec![[0.0; 3]; positions.len()];
        }
        drop(positions);
        sums.into_iter().map(|sum| unit_or_zero(sum).as_vec3().to_array()).collect()
    }

    /// The [`Mesh`] of a file without normals. One without triangles is [`MeshError::NoFaces`].
    pub(crate) fn into_mesh(self) -> Result<Mesh, MeshError> {
        match self.has_faces() {
            true => one_part(self.path, self.normals(), true),
            false => Err(MeshError::NoFaces { path: self.path.into() }),
        }
    }
}

/// Dividing by the length serves the smallest vectors, for which glam's `normalize_or_zero` gives zero.
fn unit_or_zero(v: DVec3) -> DVec3 {
    if v.length() > 0.0 { v / v.length() } else { DVec3::ZERO }
}

/// The vertices of a triangle, all of which have to be there.
pub(crate) fn resolve(path: &Path, triangle: [i64; 3], vertices: usize) -> Result<[usize; 3], MeshError> {
    let mut corners = [0; 3];
    for (corner, index) in corners.iter_mut().zip(triangle) {
        *corner = usize::try_from(index)
            .ok()
            .filter(|&i| i < vertices)
            .ok_or_else(|| MeshError::IndexOutOfRange { path: path.into(), index, vertices })?;
    }
    Ok(corners)
}
