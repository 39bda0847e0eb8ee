//! Surfaces in space: orthographic projection, painter's algorithm.
//!
//! Colours are those of the bar and nothing else: light and shadow would alter the values that a reader takes
//! from them. The lines on a surface show its form.
//!
//! A surface is a list of small quadrilaterals. Seen along the unit vector `d = (cos e cos a, cos e sin a,
//! sin e)` from the eye's side (azimuth a, elevation e), a point is drawn at its coordinates along `(-sin
//! a, cos a, 0)` and `d x` that; quadrilaterals are drawn in the order of their centres' depth `p . d`,
//! the farthest first (Newell, Newell and Sancha 1972), in thin slices: what lies in one is drawn colour
//! by colour, which makes small files. That is right for the graphs of functions over fine grids, which is
//! what second-order maps are: where a surface turns away from the eye, two of its parts in one slice
//! overlap by the square of the slice's thickness only. Larger quadrilaterals that pass through each other
//! are not resolved.

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
    quads: Vec<Quad>,
    lines: Vec<(Vec<[f64; 3]>, Stroke)>,
    box_: Option<[[f64; 3]; 2]>,
    pub(crate) scales: Vec<(ColourScale, [bool; 2])>,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn mean<'a>(points: impl ExactSizeIterator<Item = &'a [f64; 3]>) -> [f64; 3] {
    let count = points.len() as f64;
    let sum = points.fold([0.0; 3], |sum, p| [sum[0] + p[0], sum[1] + p[1], sum[2] + p[2]]);
    sum.map(|s| s / count)
}

/// Lines lie on the surface, and are drawn before what is nearer than they by this part of the surface's
/// extent.
const BIAS: f64 = 0.02;
/// Slices of the surface, by depth.
const SLICES: f64 = 40.0;

impl Surface {
    /// An empty surface.
    pub fn new(view: View) -> Self {
        Surface {
            view,
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
        let slice = |depth: f64| (SLICES * (depth - near) / (far - near)).floor() as i64;
        let mut faces: Vec<(i64, Colour, Vec<[f64; 2]>)> = Vec::new();
        for Quad { corners, colour } in &self.quads {
            let depth = dot(mean(corners.iter()), toward);
            faces.push((slice(depth), *colour, corners.iter().map(|&p| place(p)).collect()));
        }
        let mut pieces: Vec<(i64, Stroke, [[f64; 2]; 2])> = Vec::new();
        for (line, stroke) in &self.lines {
            for pair in line.windows(2) {
                if pair.iter().flatten().all(|c| c.is_finite()) {
                    let depth = dot(mean(pair.iter()), toward) + BIAS * (far - near);
                    pieces.push((slice(depth), *stroke, [place(pair[0]), place(pair[1])]));
                }
            }
        }
        faces.sort_by_key(|&(slice, colour, _)| (slice, colour));
        pieces.sort_by_key(|&(slice, ..)| slice);
        let mut pieces = pieces.chunk_by(|a, b| a.0 == b.0).peekable();
        for run in faces.chunk_by(|a, b| a.0 == b.0) {
            while let Some(lines) = pieces.next_if(|lines| lines[0].0 < run[0].0) {
                draw_pieces(lines, scene);
            }
            let cells = run.iter().map(|(_, colour, corners)| (*colour, corners.clone()));
            scene.shapes.push(Shape::Mesh { cells: cells.collect() });
        }
        pieces.for_each(|lines| draw_pieces(lines, scene));
    }
}

/// Pieces of lines in one slice: those of one stroke as one path.
fn draw_pieces(pieces: &[(i64, Stroke, [[f64; 2]; 2])], scene: &mut Scene) {
    for run in pieces.chunk_by(|a, b| a.1 == b.1) {
        let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
        for (_, _, [from, until]) in run {
            match lines.last_mut() {
                Some(line) if line.last() == Some(from) => line.push(*until),
                _ => lines.push(vec![*from, *until]),
            }
        }
        scene.shapes.push(Shape::Path {
            lines,
            closed: false,
            fill: None,
            stroke: Some(run[0].1),
        });
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
        let surface = Surface::new(View {
            azimuth: -60.0,
            elevation: 60.0,
        })
        .quads([(square(1.0), 1.0), (square(0.0), 0.0)], &scale);
        let cells = drawn(&surface);
        // the upper one is nearer to an eye above, and colours are those of the bar
        assert_eq!([cells[0].0, cells[1].0], [0.0, 1.0].map(|value| scale.colour(value)));
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
