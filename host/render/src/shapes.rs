//! The bodies of the scene, each within a unit or so of its origin: vertices, unit normals and triangles.

use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use unitvec_mesh::{self as mesh, FileFormat, MeshError, Reach, Shape};

/// A body, ready to be drawn.
#[derive(Clone)]
pub(super) struct Body {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) indices: Vec<u32>,
}

/// A mesh in OBJ, with a smooth normal at each vertex, centred and scaled to a half height of 1.
pub(super) fn of_obj(name: &str, text: &[u8]) -> Result<Body, MeshError> {
    let mut shapes = mesh::parse_shapes(Path::new(name), FileFormat::Obj, text, Reach::Folder)?;
    let shape = shapes.pop().unwrap_or_default();
    let points = || shape.positions.iter().map(|point| glam::Vec3::from(*point));
    let low = points().fold(glam::Vec3::INFINITY, glam::Vec3::min);
    let high = points().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
    let (middle, half) = (0.5 * (low + high), 0.5 * (high.y - low.y));
    let positions = points().map(|point| ((point - middle) / half).to_array()).collect();
    Ok(Body { positions, normals: shape.normals, indices: shape.triangles.into_flattened() })
}

/// A mesh of one's own, centred and scaled to reach 1 from its middle; normals without a direction are +Z, as of codecs.
pub(super) fn of_shapes(shapes: &[Shape]) -> Body {
    let points =
        || shapes.iter().flat_map(|shape| &shape.positions).map(|point| glam::Vec3::from(*point).as_dvec3());
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let middle = 0.5 * (low + high);
    let reach = points().map(|point| point.distance(middle)).fold(0.0, f64::max);
    let scale = if reach > 0.0 { 1.0 / reach } else { 1.0 };
    let unit = |normal: &[f32; 3]| {
        let normal =
            if mesh::has_direction(*normal) { glam::Vec3::from(*normal).as_dvec3() } else { DVec3::Z };
        normal.normalize().as_vec3().to_array()
    };
    let (mut indices, mut before) = (Vec::new(), 0);
    for shape in shapes {
        indices.extend(shape.triangles.as_flattened().iter().map(|corner| before + corner));
        before += shape.positions.len() as u32;
    }
    Body {
        positions: points().map(|point| ((point - middle) * scale).as_vec3().to_array()).collect(),
        normals: shapes.iter().flat_map(|shape| &shape.normals).map(unit).collect(),
        indices,
    }
}

/// Eighty flat faces: an icosahedron's, each split in four.
pub(super) fn faceted() -> Body {
    let mut body = Body { positions: Vec::new(), normals: Vec::new(), indices: Vec::new() };
    for [a, b, c] in icosahedron() {
        let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
        for face in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            // The normal points from the origin outwards, whichever way round the corners come.
            let cross = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
            let normal = cross * cross.dot(face[0]).signum();
            for corner in face {
                body.indices.push(body.positions.len() as u32);
                body.positions.push(corner.as_vec3().to_array());
                body.normals.push(normal.as_vec3().to_array());
            }
        }
    }
    body
}

/// The triples of an icosahedron's corners that are next to each other.
fn icosahedron() -> impl Iterator<Item = [DVec3; 3]> {
    let golden = 0.5 * (1.0 + 5.0f64.sqrt());
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let corners: Vec<DVec3> = signs
        .into_iter()
        .flat_map(|(s, t)| {
            let (one, g) = (s, t * golden);
            [DVec3::new(0.0, one, g), DVec3::new(one, g, 0.0), DVec3::new(g, 0.0, one)]
        })
        .collect();
    let count = corners.len();
    let triples = (0..count).flat_map(move |a| (0..a).flat_map(move |b| (0..b).map(move |c| [a, b, c])));
    // Edges have length 2, and the next distance is 2 golden.
    let is_near = |a: DVec3, b: DVec3| a.distance(b) < 2.5;
    triples.map(move |triple| triple.map(|index| corners[index])).filter_map(move |[a, b, c]| {
        let is_face = is_near(a, b) && is_near(b, c) && is_near(c, a);
        is_face.then(|| [a, b, c].map(DVec3::normalize))
    })
}

/// A sphere whose radius is `1 + 0.05 sin 7x sin 7y sin 7z` in the direction (x, y, z), with the normals of that surface.
pub(super) fn bumpy_sphere() -> Body {
    const HEIGHT: f64 = 0.05;
    const FREQUENCY: f64 = 7.0;
    grid([256, 128], |at| {
        let (polar, azimuth) = (PI * at.y, TAU * at.x);
        let direction = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin());
        let (sine, cosine) = ((direction * FREQUENCY).map(f64::sin), (direction * FREQUENCY).map(f64::cos));
        let radius = 1.0 + HEIGHT * sine.x * sine.y * sine.z;
        let slopes =
            DVec3::new(cosine.x * sine.y * sine.z, sine.x * cosine.y * sine.z, sine.x * sine.y * cosine.z)
                * (HEIGHT * FREQUENCY);
        // The gradient of |p| - radius(p / |p|).
        let along = slopes - direction * slopes.dot(direction);
        (direction * radius, direction - along / radius)
    })
}

/// A nearly flat panel as a car's bonnet, 2 wide and 1.3 deep, +Y being its front: it falls off to both sides and has a
/// shallow crease along the middle of each half.
pub(super) fn panel() -> Body {
    grid([384, 192], |at| {
        let (x, z) = (2.0 * at.x - 1.0, 1.3 * (at.y - 0.5));
        let crease = |middle: f64| {
            let from = (x - middle) / 0.12;
            let bump = 0.004 * (-from * from).exp();
            (bump, bump * (-2.0 * from / 0.12))
        };
        let (left, right) = (crease(-0.45), crease(0.45));
        let y = left.0 + right.0 - 0.12 * x * x - 0.03 * x.powi(4) - 0.08 * z * z;
        let slope_x = left.1 + right.1 - 0.24 * x - 0.12 * x.powi(3);
        (DVec3::new(x, y, z), DVec3::new(-slope_x, 1.0, 0.16 * z))
    })
}

/// A surface over the unit square: points and normals of any length at the corners of so many cells.
fn grid([columns, rows]: [u32; 2], at: impl Fn(DVec2) -> (DVec3, DVec3)) -> Body {
    let mut body = Body { positions: Vec::new(), normals: Vec::new(), indices: Vec::new() };
    for row in 0..=rows {
        for column in 0..=columns {
            let place = DVec2::new(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            let (point, normal) = at(place);
            body.positions.push(point.as_vec3().to_array());
            body.normals.push(normal.normalize().as_vec3().to_array());
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let [b, c, d] = [a + 1, a + columns + 1, a + columns + 2];
            body.indices.extend([a, b, c, c, b, d]);
        }
    }
    body
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(v: [f32; 3]) -> DVec3 {
        glam::Vec3::from(v).as_dvec3()
    }

    fn triangles(body: &Body) -> impl Iterator<Item = [usize; 3]> {
        body.indices.chunks_exact(3).map(|indices| [indices[0], indices[1], indices[2]].map(|i| i as usize))
    }

    /// The formulas of the normals against the faces that the positions span: of each face with an area, the normal of
    /// either corner is within so many degrees.
    fn assert_normals_fit(body: &Body, degrees: f64) {
        assert_eq!(body.positions.len(), body.normals.len());
        for corners in triangles(body) {
            let [a, b, c] = corners.map(|corner| vector(body.positions[corner]));
            let face = (b - a).cross(c - a);
            if face.length() < 1e-9 {
                continue;
            }
            for corner in corners {
                let normal = vector(body.normals[corner]);
                assert!((normal.length() - 1.0).abs() < 1e-6);
                let angle = face.angle_between(normal).to_degrees();
                assert!(angle.min(180.0 - angle) < degrees, "{corner}: {angle} degrees");
            }
        }
    }

    #[test]
    fn normals_are_those_of_the_surface() {
        // A cell is 1.4 degrees wide, and the bumps turn the normal up to 1 + 0.05 * 7^2 times as much.
        assert_normals_fit(&bumpy_sphere(), 4.9);
        assert_normals_fit(&panel(), 0.5);
        assert_normals_fit(&faceted(), 0.001);
    }

    /// Each face of the faceted body looks outwards, and there are eighty.
    #[test]
    fn the_faceted_body_is_closed() {
        let body = faceted();
        assert_eq!(body.indices.len(), 80 * 3);
        for (position, normal) in body.positions.iter().zip(&body.normals) {
            assert!(vector(*position).dot(vector(*normal)) > 0.8);
        }
    }
}
