//! A mesh so fine that its normal maps are normals of vertices: drawn as any other, with the normals of the file or with those
//! of a codec under the same maps.

use glam::{Vec2, Vec3};
use std::rc::Rc;
use unitvec_mesh::{Shape, has_direction};

/// A normal map of tangent space, y up.
pub struct NormalMap {
    /// Texels in a row, and rows.
    pub size: [u32; 2],
    /// A vector for each texel, row by row from the top.
    pub texels: Vec<[f32; 3]>,
    /// The factor of x and y.
    pub scale: f32,
}

/// Vertices of all finer shapes: the triangles of more are less fine than their maps.
const MOST: u64 = 2_000_000;

/// A vertex of a finer shape: the vertices around it, counted over all shapes, their shares, and the map's vector, if any.
struct Point {
    corners: [usize; 3],
    shares: Vec3,
    mapped: Option<Vec3>,
}

/// Finer shapes, without normals, and what these depend on.
pub(super) struct Detail {
    pub(super) shapes: Vec<Shape>,
    /// The density of vertices beside that of texels, 1 at most; 0 where triangles were not divided.
    pub(super) fineness: f32,
    points: Vec<Point>,
    /// The tangents of the vertices of all shapes, and the signs of their bitangents.
    tangents: Vec<[f32; 4]>,
}

impl Detail {
    /// Divides triangles until their edges are as long as a texel of the shape's map.
    pub(super) fn new(shapes: &[Shape], maps: &[Option<Rc<NormalMap>>]) -> Self {
        let fineness = (0..16).map(|halvings| 0.5f32.powi(halvings)).find(|share| {
            let parts = shapes.iter().zip(maps).flat_map(|(shape, map)| {
                shape.triangles.iter().map(|corners| u64::from(parts(shape, map.as_deref(), corners, *share)))
            });
            parts.map(|n| (n + 1) * (n + 2) / 2).sum::<u64>() <= MOST
        });
        let fineness = fineness.unwrap_or(0.0);
        let mut detail = Self { shapes: Vec::new(), fineness, points: Vec::new(), tangents: Vec::new() };
        for (shape, map) in shapes.iter().zip(maps) {
            let first = detail.tangents.len();
            detail.tangents.extend(&shape.tangents);
            detail.tangents.resize(first + shape.positions.len(), [0.0; 4]);
            let mut fine = Shape::default();
            for corners in &shape.triangles {
                let n = parts(shape, map.as_deref(), corners, fineness);
                let before = fine.positions.len() as u32;
                let corners = corners.map(|corner| corner as usize);
                for point in lattice(n) {
                    let at =
                        |vectors: &[[f32; 3]]| blended(corners.map(|corner| vectors[corner].into()), point);
                    fine.positions.push(at(&shape.positions).to_array());
                    let mapped = map.as_ref().map(|map| {
                        let [a, b, c] = corners.map(|corner| Vec2::from(shape.texture[corner]));
                        map.sample(point.x * a + point.y * b + point.z * c)
                    });
                    let corners = corners.map(|corner| first + corner);
                    detail.points.push(Point { corners, shares: point, mapped });
                }
                fine.triangles.extend(triangles(n).map(|corners| corners.map(|corner| before + corner)));
            }
            detail.shapes.push(fine);
        }
        detail
    }

    /// The normals of the finer vertices, from those of the vertices of all shapes, of which those without a
    /// direction are +Z, as of codecs.
    pub(super) fn normals(&self, coarse: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let normal = |point: &Point| {
            let unit = |corner: usize| Vec3::from(coarse[corner]).normalize_or(Vec3::Z);
            let normal = blended(point.corners.map(unit), point.shares).normalize_or_zero();
            let Some(mapped) = point.mapped else { return normal };
            let tangents = point.corners.map(|corner| self.tangents[corner]);
            let tangent = blended(tangents.map(|[x, y, z, _]| Vec3::new(x, y, z)), point.shares);
            let tangent = (tangent - normal * normal.dot(tangent)).normalize_or_zero();
            match has_direction(tangent.to_array()) {
                true => {
                    let bitangent = normal.cross(tangent) * tangents[0][3];
                    (mapped.x * tangent + mapped.y * bitangent + mapped.z * normal).normalize_or_zero()
                }
                false => normal,
            }
        };
        self.points.iter().map(|point| normal(point).to_array()).collect()
    }
}

impl NormalMap {
    /// The map's vector at texture coordinates, blended of four texels; the map repeats.
    fn sample(&self, at: Vec2) -> Vec3 {
        let [width, height] = self.size.map(|side| side as f32);
        let place = Vec2::new(at.x * width - 0.5, at.y * height - 0.5);
        let (low, part) = (place.floor(), place - place.floor());
        let texel = |right: f32, down: f32| {
            let [x, y] =
                [(low.x + right).rem_euclid(width), (low.y + down).rem_euclid(height)].map(|at| at as usize);
            Vec3::from(self.texels[y * self.size[0] as usize + x])
        };
        let row = |down| texel(0.0, down).lerp(texel(1.0, down), part.x);
        row(0.0).lerp(row(1.0), part.y) * Vec3::new(self.scale, self.scale, 1.0)
    }
}

/// The parts of an edge of a triangle: as many as its longest has texels, times `fineness`.
fn parts(shape: &Shape, map: Option<&NormalMap>, corners: &[u32; 3], fineness: f32) -> u32 {
    let Some(map) = map else { return 1 };
    let size = Vec2::from(map.size.map(|side| side as f32));
    let [a, b, c] = corners.map(|corner| Vec2::from(shape.texture[corner as usize]) * size);
    let longest = (a - b).length().max((b - c).length()).max((c - a).length());
    let parts = (longest * fineness).ceil();
    // One, too, where coordinates are no numbers.
    if parts > 1.0 { parts.min(1e6) as u32 } else { 1 }
}

/// The shares of the corners at the points of a triangle with n parts to an edge, row by row.
fn lattice(n: u32) -> impl Iterator<Item = Vec3> {
    let point = move |row: u32, at: u32| Vec3::new((n - row) as f32, (row - at) as f32, at as f32) / n as f32;
    (0..=n).flat_map(move |row| (0..=row).map(move |at| point(row, at)))
}

/// The triangles between the points of [`lattice`].
fn triangles(n: u32) -> impl Iterator<Item = [u32; 3]> {
    let first = |row: u32| row * (row + 1) / 2;
    let row = move |row: u32| {
        let [above, below] = [first(row), first(row + 1)];
        let down = (0..=row).map(move |at| [above + at, below + at, below + at + 1]);
        down.chain((0..row).map(move |at| [above + at, below + at + 1, above + at + 1]))
    };
    (0..n).flat_map(row)
}

fn blended([a, b, c]: [Vec3; 3], shares: Vec3) -> Vec3 {
    a * shares.x + b * shares.y + c * shares.z
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of a square, whose texture is upright.
    fn square(sign: f32) -> Shape {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        Shape {
            positions: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
            texture: corners.map(|[x, y]| [x, 1.0 - y]).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            tangents: vec![[1.0, 0.0, 0.0, sign]; 4],
            ..Shape::default()
        }
    }

    const TILTED: [f32; 3] = [0.48, 0.6, 0.64];

    /// Under a flat vertex normal the map's vectors are the normals; turned to +X, their z is along +X and the tangent, which has
    /// to leave +X, is a diagonal's. Mirrored, y is turned round.
    #[test]
    fn maps_are_seen() {
        for sign in [1.0, -1.0] {
            let shapes = [square(sign)];
            // The left half of two by one texels is flat; at a texel's middle there is that texel alone.
            let map = NormalMap { size: [2, 1], texels: vec![[0.0, 0.0, 1.0], TILTED], scale: 1.0 };
            let detail = Detail::new(&shapes, &[Some(map.into())]);
            let [fine] = &detail.shapes[..] else { panic!("one shape") };
            assert_eq!((fine.positions.len(), fine.triangles.len()), (2 * 10, 2 * 9));
            assert!(
                fine.triangles.as_flattened().iter().all(|corner| (*corner as usize) < fine.positions.len())
            );
            let close = |a: [f32; 3], b: [f32; 3]| Vec3::from(a).distance(b.into()) < 1e-6;
            let flat = detail.normals(&[[0.0, 0.0, 2.0]; 4]);
            let [tilt_x, tilt_y, tilt_z] = TILTED;
            // At thirds of the square: 1/3 is 1/6 of a texel to the right of the first middle.
            for (position, normal) in fine.positions.iter().zip(&flat) {
                let part = match position[0] {
                    x if (x - 1.0 / 3.0).abs() < 1e-6 => 1.0 / 6.0,
                    x if (x - 2.0 / 3.0).abs() < 1e-6 => 5.0 / 6.0,
                    // The map repeats: its border is half of either.
                    _ => 0.5,
                };
                let blend = Vec3::Z.lerp(Vec3::new(tilt_x, sign * tilt_y, tilt_z), part).normalize();
                assert!(close(*normal, blend.to_array()), "{position:?} {normal:?} {blend}");
            }
            let diagonal = 0.5f32.sqrt();
            let turned = detail.normals(&[[diagonal, 0.0, diagonal]; 4]);
            let dots = turned.iter().zip(&flat).map(|(a, b)| (a[0] + a[2]) * diagonal - b[2]);
            assert!(dots.into_iter().all(|off| off.abs() < 1e-6));
            assert_eq!(detail.normals(&[[0.0; 3]; 4]), flat);
        }
    }

    /// Shapes without a map keep their triangles, and large maps stay within the most vertices.
    #[test]
    fn sizes() {
        let shapes = [square(1.0), square(1.0)];
        let map = NormalMap { size: [4096, 4096], texels: vec![[0.0, 0.0, 1.0]; 1 << 24], scale: 1.0 };
        let detail = Detail::new(&shapes, &[None, Some(map.into())]);
        assert_eq!(detail.shapes[0].triangles, [[0, 1, 2], [3, 4, 5]]);
        let fine = detail.shapes[1].positions.len() as u64;
        assert!((MOST / 8..=MOST).contains(&fine), "{fine}");
        assert!(detail.fineness < 1.0, "{}", detail.fineness);
        for wild in [f32::INFINITY, f32::NAN] {
            let shape =
                Shape { texture: vec![[wild, 0.0]; 4], triangles: vec![[0, 1, 2]; 50], ..square(1.0) };
            let map = NormalMap { size: [4, 4], texels: vec![TILTED; 16], scale: 1.0 };
            let shapes = [shape];
            let detail = Detail::new(&shapes, &[Some(map.into())]);
            assert_eq!(detail.shapes[0].positions.len(), 150);
            assert_eq!(detail.normals(&[[0.0, 0.0, 1.0]; 4]).len(), 150);
        }
    }
}
