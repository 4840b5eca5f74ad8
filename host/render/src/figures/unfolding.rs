//! The unfolding of a sphere's octants into a square (figure 3).

use super::canvas::Cell;
use super::paint::{self, Colour, SAMPLES, from_srgb};
use super::{Figure, Options, Shown};
use glam::{DMat3, DVec2, DVec3};
use unitvec_oracle::{Oct, Oracle};

/// A colour for each octant, the brighter ones above.
fn octant_colour(v: DVec3) -> Colour {
    const COLOURS: [[u8; 3]; 4] = [[230, 159, 0], [86, 180, 233], [0, 158, 115], [204, 121, 167]];
    let colour = from_srgb(COLOURS[usize::from(v.x < 0.0) + 2 * usize::from(v.y < 0.0)]);
    if v.z >= 0.0 { colour } else { 0.42 * colour }
}

/// The octant's colour, with lines where the square has its grid.
fn unfolded_colour(v: DVec3) -> Colour {
    const LINES: f64 = 4.0;
    let grid = Oct::position(v.to_array()).map(|t| {
        let t = (t + 1.0) * LINES;
        (t - t.round()).abs() < 0.06
    });
    if grid.contains(&true) { 0.35 * octant_colour(v) } else { octant_colour(v) }
}

/// The point of the octahedron that is seen at a place, as far as it is hit.
fn on_octahedron(place: DVec2, view: DMat3) -> Option<(DVec3, DVec3)> {
    let back = view.transpose();
    let (from, toward) = (back * (place * 1.03).extend(3.0), back * DVec3::NEG_Z);
    let faces =
        (0..8).map(|n| DVec3::from_array([0, 1, 2].map(|bit| if n >> bit & 1 == 0 { 1.0 } else { -1.0 })));
    faces.filter(|face| face.dot(toward) < 0.0).find_map(|face| {
        let point = from + (1.0 - face.dot(from)) / face.dot(toward) * toward;
        (point * face).cmpge(DVec3::splat(-1e-9)).all().then_some((point, face.normalize()))
    })
}

/// Figure 3: how the octants of a sphere become a square.
pub fn unfolding(options: &Options) -> Figure {
    let side = if options.small { 360 } else { 480 };
    let view = paint::from_the_side();
    let sphere = paint::disc(options.theme, side, SAMPLES, view, |v| {
        unfolded_colour(v) * (0.55 + 0.45 * (view * v).z)
    });
    let octahedron = paint::square(side, SAMPLES, |place| {
        let lit =
            |(point, normal): (DVec3, DVec3)| unfolded_colour(point) * (0.45 + 0.55 * (view * normal).z);
        on_octahedron(place, view).map_or(from_srgb(options.theme.paper), lit)
    });
    let square = paint::square(side, SAMPLES, |place| {
        unfolded_colour(DVec3::from_array(Oct::direction(place.to_array())))
    });
    let cells = [(sphere, "sphere"), (octahedron, "octahedron"), (square, "square")]
        .map(|(picture, name)| Cell { picture, lines: vec![name.to_owned()] });
    let caption = "How oct maps the octants of the sphere to the faces of an octahedron, projects these to the plane, and \
                   unfolds the lower four outwards, which fills the square. The lines are those of a grid on the square.";
    let alt = "The same eight coloured octants on a sphere, on an octahedron and on a square";
    let pictures =
        vec![Shown::picture("figure3.png", alt, options.theme.captioned_sheet(&cells, 3, caption))];
    Figure::new("3", "oct unfolds the sphere", caption, pictures)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_octahedron_is_hit_in_its_middle() {
        let (point, _) = on_octahedron(DVec2::ZERO, paint::from_the_side()).unwrap();
        assert!((point.abs().element_sum() - 1.0).abs() < 1e-9);
        assert!(on_octahedron(DVec2::ONE, paint::from_the_side()).is_none());
    }
}
