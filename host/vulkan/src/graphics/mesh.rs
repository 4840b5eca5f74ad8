use super::super::buffer::Buffer;
use super::super::memory::Place;
use super::super::{Error, FormatUse, ImageFormat, bytes_per_texel};
use super::Graphics;
use std::borrow::Cow;
use std::sync::Arc;

/// Vertices, each attribute in a buffer of its own, and maybe indices.
pub struct Mesh {
    pub(super) attributes: Vec<(ImageFormat, Buffer)>,
    pub(super) indices: Option<Buffer>,
    /// Vertices to draw: as many as there are indices, if there are any.
    pub(super) count: u32,
    vertices: usize,
    pub(super) graphics: Arc<Graphics>,
}

impl Mesh {
    /// Vertices with these attributes. Without indices they are drawn as they follow each other.
    ///
    /// # Errors
    /// [`Error::UnsupportedFormat`]; [`Error::BadDraw`] where attributes differ in their number of vertices or an index is beyond them;
    /// or a failed call.
    pub fn new(
        graphics: &Arc<Graphics>,
        attributes: &[(ImageFormat, &[u8])],
        indices: Option<&[u32]>,
    ) -> Result<Self, Error> {
        let mut mesh = Self {
            attributes: Vec::new(),
            indices: None,
            count: 0,
            vertices: vertices(attributes)?,
            graphics: graphics.clone(),
        };
        let limit = graphics.device.limits.max_draw_indexed_index_value;
        let indices_fit = indices.unwrap_or_default().iter().all(|index| (*index as usize) < mesh.vertices);
        if mesh.vertices > limit as usize || !indices_fit {
            return Err(Error::BadDraw { reason: "an index of a mesh is beyond its vertices" });
        }
        let count = indices.map_or(mesh.vertices, <[u32]>::len);
        mesh.count = u32::try_from(count)
            .map_err(|_| Error::BadDraw { reason: "a mesh has more than 2^32 vertices" })?;
        for (format, bytes) in attributes {
            graphics.device.expect(*format, FormatUse::Vertex)?;
            let size = bytes_per_texel(*format).unwrap_or_default();
            mesh.attributes.push((*format, mesh.filled(&spread(bytes, size))?));
        }
        mesh.indices = indices.map(|indices| mesh.filled(bytemuck::cast_slice(indices))).transpose()?;
        Ok(mesh)
    }

    /// The number of vertices, whether indices name them or not.
    pub fn vertices(&self) -> usize {
        self.vertices
    }

    /// A buffer of these bytes, in memory that the host sees: a mesh is drawn a few times, and devices read it from there.
    fn filled(&self, bytes: &[u8]) -> Result<Buffer, Error> {
        let mut buffer = Buffer::new(&self.graphics.device, bytes.len(), Place::Host)?;
        buffer.write(bytes);
        Ok(buffer)
    }

    pub(super) fn formats(&self) -> impl Iterator<Item = ImageFormat> {
        self.attributes.iter().map(|(format, _)| *format)
    }
}

/// The bytes from a vertex to the next, for an attribute of this size: whole words, since Metal takes no others.
pub(super) const fn stride(size: usize) -> usize {
    size.next_multiple_of(4)
}

/// An attribute of this size, with as many bytes for each vertex as the stride has.
fn spread(bytes: &[u8], size: usize) -> Cow<'_, [u8]> {
    let rest = [0; 3];
    match stride(size) - size {
        0 => bytes.into(),
        lacking => bytes.chunks(size).flat_map(|vertex| [vertex, &rest[..lacking]].concat()).collect(),
    }
}

/// The number of vertices: at least one, and the same for each attribute.
fn vertices(attributes: &[(ImageFormat, &[u8])]) -> Result<usize, Error> {
    let mut counts = attributes.iter().map(|(format, bytes)| {
        let size = bytes_per_texel(*format).filter(|size| bytes.len() % size == 0)?;
        Some(bytes.len() / size)
    });
    let first = counts.next().flatten().unwrap_or_default();
    if first == 0 || counts.any(|count| count != Some(first)) {
        return Err(Error::BadDraw { reason: "the attributes of a mesh are not of equally many vertices" });
    }
    Ok(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_begin_at_words() {
        assert_eq!(*spread(&[1, 2, 3, 4, 5, 6], 3), [1, 2, 3, 0, 4, 5, 6, 0]);
        assert_eq!(*spread(&[1, 2, 3, 4], 2), [1, 2, 0, 0, 3, 4, 0, 0]);
        assert!(matches!(spread(&[1; 8], 4), Cow::Borrowed([1, ..])));
    }

    #[test]
    fn attributes_are_of_equally_many_vertices() {
        let (three, two) = (ImageFormat::R32G32B32_SFLOAT, ImageFormat::R8G8_SNORM);
        assert_eq!(vertices(&[(three, &[0; 24]), (two, &[0; 4])]).ok(), Some(2));
        for (positions, normals) in [(24, 2), (24, 5), (0, 0), (23, 4)] {
            let attributes: &[(_, &[u8])] = &[(three, &[0; 24][..positions]), (two, &[0; 8][..normals])];
            let error = vertices(attributes).unwrap_err();
            assert!(error.to_string().contains("equally many"), "{positions} {normals}: {error}");
        }
    }
}
