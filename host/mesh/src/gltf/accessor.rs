//! The elements of accessors, and where these lie in buffers.

use super::File;
use super::document::Primitive;
use crate::MeshError;
use ::gltf::Semantic;
use ::gltf::accessor::sparse::Sparse;
use ::gltf::accessor::{Accessor, DataType, Dimensions, Item, Iter};
use ::gltf::buffer::View;

impl File<'_> {
    /// Reads an attribute in floats or, as `KHR_mesh_quantization` has it, in integers: normalised for normals and tangents,
    /// of any kind for positions and texture coordinates.
    pub(super) fn vectors<const N: usize>(
        &self,
        primitive: &Primitive,
        semantic: &Semantic,
        dimensions: Dimensions,
        each: impl FnMut([f32; N]),
    ) -> Result<(), MeshError>
    where
        [f32; N]: Item,
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
    {
        let accessor = self.attribute(primitive, semantic)?;
        let is_of_any_kind = matches!(semantic, Semantic::Positions | Semantic::TexCoords(_));
        self.vectors_of(&accessor, is_of_any_kind, dimensions, each)
    }

    /// Reads the vectors of an accessor, as [`vectors`](Self::vectors) does.
    pub(super) fn vectors_of<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        is_of_any_kind: bool,
        dimensions: Dimensions,
        mut each: impl FnMut([f32; N]),
    ) -> Result<(), MeshError>
    where
        [f32; N]: Item,
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
    {
        self.check_extents(accessor)?;
        let each = &mut each;
        let read = match (accessor.data_type(), accessor.normalized()) {
            _ if accessor.dimensions() != dimensions => None,
            (DataType::F32, _) => self.components(accessor, each, |c: f32| c),
            (DataType::I8, true) => self.components(accessor, each, |c: i8| snorm(c, i8::MAX)),
            (DataType::I16, true) => self.components(accessor, each, |c: i16| snorm(c, i16::MAX)),
            // Neither the normals nor the tangents of faces depend on the scale.
            (DataType::I8, false) if is_of_any_kind => self.components(accessor, each, |c: i8| c.into()),
            (DataType::I16, false) if is_of_any_kind => self.components(accessor, each, |c: i16| c.into()),
            (DataType::U8, _) if is_of_any_kind => self.components(accessor, each, |c: u8| c.into()),
            (DataType::U16, _) if is_of_any_kind => self.components(accessor, each, |c: u16| c.into()),
            _ => None,
        };
        read.ok_or_else(|| {
            let kinds =
                if is_of_any_kind { "floats or short integers" } else { "floats or normalised integers" };
            self.error(format!("accessor {} does not have {dimensions:?} of {kinds}", accessor.index()))
        })
    }

    /// Reads the vectors of an accessor of the type `T`; `None` where the parser does not read it.
    fn components<T, const N: usize>(
        &self,
        accessor: &Accessor,
        each: &mut impl FnMut([f32; N]),
        to_f32: impl Fn(T) -> f32,
    ) -> Option<()>
    where
        [T; N]: Item,
    {
        if accessor.view().is_none() && accessor.sparse().is_none() {
            (0..accessor.count()).for_each(|_| each([0.0; N]));
            return Some(());
        }
        let vectors = Iter::<[T; N]>::new(accessor.clone(), |buffer| self.data(buffer))?;
        vectors.for_each(|vector| each(vector.map(&to_f32)));
        Some(())
    }

    /// Checks that all parts of an accessor lie in their buffers: the reader takes that for granted.
    pub(crate) fn check_extents(&self, accessor: &Accessor) -> Result<(), MeshError> {
        if accessor.view().is_none() {
            self.check_vertices(accessor.count())?;
        }
        let parts = extents(accessor);
        let index = accessor.index();
        if !parts.iter().all(|(view, offset, count, size)| self.holds(view, *offset, *count, *size)) {
            return Err(self.error(format!("accessor {index} is empty or ends past its buffer")));
        }
        match accessor.sparse().is_none_or(|sparse| self.increase(&sparse, accessor.count())) {
            true => Ok(()),
            false => {
                let reason = "has sparse indices that do not increase, or lie beyond its count";
                Err(self.error(format!("accessor {index} {reason}")))
            }
        }
    }

    /// True where sparse indices, which lie in their buffer, increase and are below the accessor's count: at the first that
    /// does not, the reader would stop to put values in.
    fn increase(&self, sparse: &Sparse, count: usize) -> bool {
        let (indices, view) = (sparse.indices(), sparse.indices().view());
        let size = indices.index_type().size();
        let bytes = self.data(view.buffer()).unwrap_or_default();
        let bytes = bytes.get(view.offset() + indices.offset()..).unwrap_or_default();
        // Little-endian, of one, two or four bytes.
        let number =
            |bytes: &[u8]| bytes.iter().take(size).rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        let mut indices = bytes.chunks(view.stride().unwrap_or(size)).take(sparse.count()).map(number);
        let mut least = 0;
        indices.all(|index| {
            let is_next = (least..count).contains(&index);
            least = index + 1;
            is_next
        })
    }

    fn holds(&self, view: &View, offset: usize, count: usize, size: usize) -> bool {
        let stride = view.stride().unwrap_or(size);
        let end = || count.checked_sub(1)?.checked_mul(stride)?.checked_add(size)?.checked_add(offset);
        let view_end = view.offset().checked_add(view.length());
        let buffer_length = self.buffers.get(view.buffer().index()).map_or(0, |buffer| buffer.len());
        stride >= size
            && end().is_some_and(|end| end <= view.length())
            && view_end.is_some_and(|end| end <= buffer_length)
    }
}

/// The parts of buffers that an accessor lies in: the view, and the offset there, number and size of the elements.
pub(crate) fn extents<'a>(accessor: &Accessor<'a>) -> Vec<(View<'a>, usize, usize, usize)> {
    let view = accessor.view().map(|view| (view, accessor.offset(), accessor.count(), accessor.size()));
    let sparse = accessor.sparse().map(|sparse| {
        let (indices, values) = (sparse.indices(), sparse.values());
        [
            (indices.view(), indices.offset(), sparse.count(), indices.index_type().size()),
            (values.view(), values.offset(), sparse.count(), accessor.size()),
        ]
    });
    view.into_iter().chain(sparse.into_iter().flatten()).collect()
}

/// A signed normalised integer as glTF defines it: the lowest value counts as the one above it.
fn snorm<T: Into<f32>>(value: T, max: T) -> f32 {
    (value.into() / max.into()).max(-1.0)
}
