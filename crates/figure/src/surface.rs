//! Surfaces in space: orthographic projection, painter's algorithm, diffuse shading.
//!
//! A surface is a list of small quadrilaterals. Seen along the unit vector `d = (cos e cos a, cos e sin a,
//! sin e)` from the eye's side (azimuth a, elevation e), a point is drawn at its coordinates along `(-sin a,
//! cos a, 0)` and `d x` that; quadrilaterals are drawn in the order of their centres' depth `p . d`, the
//! farthest first (Newell, Newell and Sancha 1972). That is exact for the graphs of functions over fine
//! grids, which is what second-order maps are; larger quadrilaterals that pass through each other are not
//! resolved.

use crate::chart::range_of;
use crate::colour::{Colour, ColourScale};
use crate::scene::{Rect, Scene, Shape, Stroke};

/// Where a surface is seen from, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye's direction in the plane, from the x axis.
    pub azimuth: f64,
    /// The eye's height above the plane.
    pub elevation: f64,
}

impl Default for View {
    fn default() -> Self {
        View {
            azimuth: -60.0,
            elevation: 28.0,
        }
    }
}

impl View {
    /// Right, up, and toward the eye.
    fn frame(&self) -> [[f64; 3]; 3] {
        let ((sa, ca), (se, ce)) = (
            self.azimuth.to_radians().sin_cos(),
            self.elevation.to_radians().sin_cos(),
        );
        [[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]]
    }
}

/// A quadrilateral with a colour.
#[derive(Clone, Debug, PartialEq)]
struct Quad {
    corners: [[f64; 3]; 4],
    colour: Colour,
}

/// A surface with lines on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Where it is seen from.
    pub view: View,
    /// How much darker a face turned away from the light is: 0 shows values as they are in the colour bar, 1
    /// full shading.
    pub shade: f64,
    quads: Vec<Quad>,
    lines: Vec<(Vec<[f64; 3]>, Stroke)>,
    box_: Option<[[f64; 3]; 2]>,
    pub(crate) scales: Vec<(ColourScale, [bool; 2])>,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Twice the area, as a vector: the product of the diagonals, which needs no planar quadrilateral.
fn normal(corners: &[[f64; 3]; 4]) -> [f64; 3] {
    let (a, b) = (minus(corners[2], corners[0]), minus(corners[3], corners[1]));
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn mean<'a>(points: impl ExactSizeIterator<Item = &'a [f64; 3]>) -> [f64; 3] {
    let count = points.len() as f64;
    let sum = points.fold([0.0; 3], |sum, p| [sum[0] + p[0], sum[1] + p[1], sum[2] + p[2]]);
    sum.map(|s| s / count)
}

/// Lines lie on the surface, and are drawn before what is nearer than they by this part of the surface's
/// extent.
const BIAS: f64 = 0.02;

impl Surface {
    /// An empty surface.
    pub fn new(view: View) -> Self {
        Surface {
            view,
            shade: 0.35,
            quads: Vec::new(),
            lines: Vec::new(),
            box_: None,
            scales: Vec::new(),
        }
    }

    /// Quadrilaterals, corners in turn, coloured by a value each. Those with a corner that is not finite are
    /// left out.
    pub fn quads(mut self, quads: impl IntoIterator<Item = ([[f64; 3]; 4], f64)>, scale: &ColourScale) -> Self {
        let quads: Vec<_> = quads.into_iter().collect();
        self.scales
            .push((scale.clone(), scale.beyond(quads.iter().map(|quad| quad.1))));
        let quads = quads.into_iter().map(|(corners, value)| Quad {
            corners,
            colour: scale.colour(value),
        });
        let finite = |quad: &Quad| quad.corners.iter().flatten().all(|c| c.is_finite());
        self.quads.extend(quads.filter(finite));
        self
    }

    /// A line on the surface: a mesh line, or the outline of a region.
    pub fn line(mut self, points: impl IntoIterator<Item = [f64; 3]>, stroke: Stroke) -> Self {
        self.lines.push((points.into_iter().collect(), stroke));
        self
    }

    /// Scales the picture so that this box, given by two opposite corners, fits; panels with the same box
    /// have the same scale. Otherwise the surface itself fills the panel.
    pub fn within(mut self, corners: [[f64; 3]; 2]) -> Self {
        self.box_ = Some(corners);
        self
    }

    fn extent(&self) -> Vec<[f64; 3]> {
        match self.box_ {
            Some([a, b]) => (0..8)
                .map(|k| std::array::from_fn(|i| if k >> i & 1 == 0 { a[i] } else { b[i] }))
                .collect(),
            None => self.quads.iter().flat_map(|quad| quad.corners).collect(),
        }
    }

    pub(crate) fn draw(&self, scene: &mut Scene, to: Rect) {
        let [right, up, toward] = self.view.frame();
        let extent = self.extent();
        let across = |axis: [f64; 3]| range_of(extent.iter().map(|&p| dot(p, axis)), 0.0).unwrap_or((-1.0, 1.0));
        let ((l, r), (d, u), (near, far)) = (across(right), across(up), across(toward));
        let scale = (to.width() / (r - l)).min(to.height() / (u - d));
        let centre = [(to.left + to.right) / 2.0, (to.top + to.bottom) / 2.0];
        let place = |p: [f64; 3]| {
            [
                centre[0] + scale * (dot(p, right) - (l + r) / 2.0),
                centre[1] - scale * (dot(p, up) - (d + u) / 2.0),
            ]
        };
        // from above, half left of the eye
        let light: [f64; 3] = std::array::from_fn(|i| 0.75 * toward[i] - 0.35 * right[i] + 0.56 * up[i]);
        let length = dot(light, light).sqrt();
        let lit = |quad: &Quad| {
            let n = normal(&quad.corners);
            let size = dot(n, n).sqrt();
            if size == 0.0 {
                return 1.0;
            }
            // both sides are surface
            let facing = if dot(n, toward) < 0.0 { -1.0 } else { 1.0 };
            (facing * dot(n, light) / (size * length)).max(0.0)
        };

        enum Item {
            Face(Colour, Vec<[f64; 2]>),
            Piece(Vec<[f64; 2]>, Stroke),
        }
        let mut items: Vec<(f64, Item)> = Vec::new();
        for quad in &self.quads {
            let dark = Colour(0, 0, 0).mix(quad.colour, 1.0 - self.shade * (1.0 - lit(quad)));
            let corners = quad.corners.iter().map(|&p| place(p)).collect();
            items.push((dot(mean(quad.corners.iter()), toward), Item::Face(dark, corners)));
        }
        let lift = BIAS * (far - near);
        for (line, stroke) in &self.lines {
            for pair in line.windows(2) {
                if pair.iter().flatten().all(|c| c.is_finite()) {
                    let piece = pair.iter().map(|&p| place(p)).collect();
                    items.push((dot(mean(pair.iter()), toward) + lift, Item::Piece(piece, *stroke)));
                }
            }
        }
        items.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, item) in items {
            match (item, scene.shapes.last_mut()) {
                (Item::Face(colour, corners), Some(Shape::Mesh { cells })) => cells.push((colour, corners)),
                (Item::Face(colour, corners), _) => scene.shapes.push(Shape::Mesh {
                    cells: vec![(colour, corners)],
                }),
                (
                    Item::Piece(piece, stroke),
                    Some(Shape::Path {
                        lines,
                        closed: false,
                        fill: None,
                        stroke: Some(last),
                    }),
                ) if *last == stroke => match lines.last_mut() {
                    Some(line) if line.last() == piece.first() => line.extend_from_slice(&piece[1..]),
                    _ => lines.push(piece),
                },
                (Item::Piece(piece, stroke), _) => scene.shapes.push(Shape::Path {
                    lines: vec![piece],
                    closed: false,
                    fill: None,
                    stroke: Some(stroke),
                }),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::ColourMap;

    fn drawn(surface: &Surface) -> Vec<(Colour, Vec<[f64; 2]>)> {
        let mut scene = Scene {
            size: [100.0, 100.0],
            shapes: Vec::new(),
        };
        surface.draw(&mut scene, Rect::new(10.0, 10.0, 90.0, 90.0));
        let mut found = Vec::new();
        for shape in scene.shapes {
            if let Shape::Mesh { cells } = shape {
                found.extend(cells);
            }
        }
        found
    }

    fn square(z: f64) -> [[f64; 3]; 4] {
        [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]]
    }

    #[test]
    fn the_nearer_face_is_drawn_last_and_all_fit() {
        let scale = ColourScale::new(ColourMap::Viridis, (0.0, 1.0), "z");
        let mut surface = Surface::new(View {
            azimuth: -60.0,
            elevation: 60.0,
        })
        .quads([(square(1.0), 1.0), (square(0.0), 0.0)], &scale);
        surface.shade = 0.0;
        let cells = drawn(&surface);
        assert_eq!(cells[1].0, scale.colour(1.0), "the upper one is nearer to an eye above");
        let all: Vec<[f64; 2]> = cells.iter().flat_map(|c| c.1.clone()).collect();
        for axis in 0..2 {
            let (low, high) = range_of(all.iter().map(|p| p[axis]), 0.0).unwrap();
            assert!(low > 10.0 - 1e-9 && high < 90.0 + 1e-9);
        }
    }

    #[test]
    fn seen_from_above_the_plane_is_itself() {
        let scale = ColourScale::new(ColourMap::Viridis, (0.0, 1.0), "z");
        let view = View {
            azimuth: -90.0,
            elevation: 90.0,
        };
        let cells = drawn(&Surface::new(view).quads([(square(0.0), 0.5), ([[f64::NAN; 3]; 4], 0.5)], &scale));
        assert_eq!(cells.len(), 1);
        for (corner, [x, y]) in cells[0]
            .1
            .iter()
            .zip([[10.0, 90.0], [90.0, 90.0], [90.0, 10.0], [10.0, 10.0]])
        {
            assert!(
                (corner[0] - x).abs() < 1e-9 && (corner[1] - y).abs() < 1e-9,
                "{corner:?}"
            );
        }
    }
}
