//! Surfaces of revolution: the generatrix turns around the third axis (Fang, Ma and Wang, Algorithm 2).
//!
//! A generatrix of two coordinates is taken as radius and height. The grid is refined in both directions
//! (Algorithm 1); faces join points (i, j), (i, j+1), (i+1, j+1), (i+1, j), counterclockwise seen from
//! outside where the generatrix rises.

use super::picture::{size_of, visible_range};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Colour, ColourMap, ColourScale, Figure, Panel, Stroke, Surface, View, Width, range_of};
use eigenring_spline::curve::{Curve, Ends, Grid, MIN_ORDER};
use std::fmt::Write;

/// The grid that the curve sweeps, in so many segments around the axis.
pub fn revolved(generatrix: &Curve, segments: usize) -> Result<Grid, Error> {
    let axis = generatrix.axis();
    let upright;
    let spatial = match generatrix.dimension() {
        2 => {
            let points: Vec<[f64; 3]> = generatrix.points().map(|p| [p[0], 0.0, p[1]]).collect();
            upright = Curve::new(axis.order(), axis.tension().value(), axis.ends(), &points)?;
            &upright
        }
        3 => generatrix,
        dimension => {
            return Err(Error::Usage {
                message: format!("a generatrix with {dimension} coordinates"),
                accepted: "2 (radius and height) or 3".to_owned(),
            });
        }
    };
    // no circle has order 2
    Ok(Grid::revolution(spatial, axis.order().max(MIN_ORDER), segments)?)
}

/// The point of a generatrix turned by a number of segments.
pub fn turned(point: &[f64], segments: usize, t: f64) -> [f64; 3] {
    let (s, c) = (std::f64::consts::TAU * t / segments as f64).sin_cos();
    let [x, y, z] = match *point {
        [radius, height] => [radius, 0.0, height],
        [x, y, z, ..] => [x, y, z],
        _ => [f64::NAN; 3],
    };
    [c * x - s * y, s * x + c * y, z]
}

/// Level, parameters and coordinates of all points of these levels.
pub fn points(levels: &[Grid]) -> Table {
    let mut table = Table::new(["level", "u", "v", "x", "y", "z"]);
    for grid in levels {
        let (u, v) = (grid.u(), grid.v());
        for (index, point) in grid.points().enumerate() {
            let (i, j) = (index / v.count(), index % v.count());
            let mut row = vec![
                (u.level() as usize).into(),
                u.parameter(i).into(),
                v.parameter(j).into(),
            ];
            row.extend(point.iter().map(|&x| x.into()));
            table.push(row);
        }
    }
    table
}

/// The faces of a grid as indices of their corners.
pub(crate) fn faces(grid: &Grid) -> Vec<[usize; 4]> {
    let (rows, columns) = (grid.u().count(), grid.v().count());
    let along = |count: usize, ends: Ends| if ends == Ends::Closed { count } else { count - 1 };
    let index = move |i: usize, j: usize| (i % rows) * columns + j % columns;
    let around = along(columns, grid.v().ends());
    (0..along(rows, grid.u().ends()))
        .flat_map(|i| (0..around).map(move |j| [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]))
        .map(|corners| corners.map(|(i, j)| index(i, j)))
        .collect()
}

/// A grid as Wavefront OBJ: its points, and quadrilaterals that count them from 1.
pub fn obj(grid: &Grid) -> String {
    let mut text = String::new();
    // writing to a String cannot fail
    for point in grid.points() {
        let coordinates: Vec<String> = point.iter().map(f64::to_string).collect();
        let _ = writeln!(text, "v {}", coordinates.join(" "));
    }
    for [a, b, c, d] in faces(grid) {
        let _ = writeln!(text, "f {} {} {} {}", a + 1, b + 1, c + 1, d + 1);
    }
    text
}

/// Faces of the limit that a picture shows at most; they are then smaller than half a millimetre.
const FACES: usize = 20_000;

fn spatial(point: &[f64]) -> [f64; 3] {
    turned(point, 1, 0.0)
}

/// The limit, coloured by its height, in the control mesh.
pub fn figure(grid: &Grid, samples: usize, width: Width, title: &str) -> Result<Figure, Error> {
    let intervals = grid.u().intervals() * grid.v().intervals();
    let fine = ((FACES / intervals.max(1)) as f64).sqrt() as usize;
    let rows = grid.sample(samples.clamp(1, fine.max(1)))?;
    let height = |point: &[f64; 3]| point[2];
    let rows: Vec<Vec<[f64; 3]>> = rows
        .iter()
        .map(|row| row.iter().map(|p| spatial(p)).collect())
        .collect();
    let control: Vec<[f64; 3]> = grid.points().map(spatial).collect();
    let size = size_of(control.iter().flatten());
    // a plane disc has one height
    let heights = visible_range(rows.iter().flatten().map(height), size, 0.0);
    let scale = ColourScale::new(ColourMap::Viridis, heights, "height $z$");
    let quads = rows.windows(2).flat_map(|pair| {
        pair[0].windows(2).zip(pair[1].windows(2)).map(|(a, b)| {
            let corners = [a[0], a[1], b[1], b[0]];
            (corners, corners.iter().map(height).sum::<f64>() / 4.0)
        })
    });
    let mut surface = Surface::new(View::default()).quads(quads.collect::<Vec<_>>(), &scale);
    let stroke = Stroke::solid(Colour::GREY, 0.12);
    for corners in faces(grid) {
        let corners = corners.map(|i| control[i]);
        // each edge of a closed mesh once; the last row of an open one has no face beyond it
        surface = surface.line(in_pieces(corners[0], corners[1]), stroke);
        surface = surface.line(in_pieces(corners[0], corners[3]), stroke);
    }
    if grid.u().ends() != Ends::Closed {
        let columns = grid.v().count();
        let last = control.len() - columns;
        for j in 0..columns {
            let edge = in_pieces(control[last + j], control[last + (j + 1) % columns]);
            surface = surface.line(edge, stroke);
        }
    }
    let all = || rows.iter().flatten().chain(&control);
    let range = |axis: usize| range_of(all().map(|p| p[axis]), 0.0).unwrap_or((-1.0, 1.0));
    let ranges = [0, 1, 2].map(range);
    let surface = surface.within([ranges.map(|r| r.0), ranges.map(|r| r.1)]);
    let tall = if width == Width::Two { 0.55 } else { 0.85 };
    Ok(Figure::new(
        width,
        width.millimetres() * tall,
        format!("Surface of revolution, {title}"),
    )
    .panel(0, 0, Panel::new(surface).title(title).colour_bar(&scale)))
}

/// An edge in pieces as short as the faces that may hide them.
fn in_pieces(a: [f64; 3], b: [f64; 3]) -> Vec<[f64; 3]> {
    let at = |k: usize| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * k as f64 / 24.0);
    (0..=24).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tube() -> Grid {
        let line = Curve::new(3, 1.0, Ends::Open, &[[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]]).unwrap();
        revolved(&line, 5).unwrap()
    }

    #[test]
    fn faces_close_around_the_axis_and_look_outwards() {
        let grid = tube().refine().unwrap();
        let faces = faces(&grid);
        assert_eq!((grid.u().count(), grid.v().count(), faces.len()), (4, 10, 30));
        let points: Vec<[f64; 3]> = grid.points().map(spatial).collect();
        for face in faces {
            let [a, b, _, d] = face.map(|i| points[i]);
            let (e, f) = ([b[0] - a[0], b[1] - a[1]], [d[0] - a[0], d[1] - a[1], d[2] - a[2]]);
            // horizontal edge first: the normal's plane part is (e_y f_z, -e_x f_z)
            let outwards = (e[1] * a[0] - e[0] * a[1]) * f[2];
            assert!(outwards > 0.0, "{face:?}");
        }
        let text = obj(&grid);
        assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), 40);
        assert!(text.ends_with("f 30 21 31 40\n"), "{text}");
    }

    #[test]
    fn the_limit_is_the_turned_generatrix() {
        let grid = tube();
        for t in [0.0, 0.3, 4.9] {
            let point = grid.limit(1.5, t).unwrap();
            // the line's parameter 1.5 is that of its point 1
            let expected = turned(&[1.0, 1.0], 5, t);
            assert!(
                point.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14),
                "{t}: {point:?}"
            );
        }
    }

    #[test]
    fn the_picture_has_room() {
        for width in [Width::One, Width::Two] {
            let figure = figure(&tube(), 16, width, "order 3, $u_0$ = 1, 5 segments").unwrap();
            assert!(figure.layout().unwrap().faults().is_empty());
        }
    }
}
