//! Tensor-product surfaces as meshes: revolved and swept curves, grids of control points.
//!
//! A grid has an order and a tension of its own in each direction (Fang, Ma and Wang, *A generalized surface
//! subdivision scheme of arbitrary order with a tension parameter*, Algorithms 1 and 2). Where both are the
//! same, its control mesh is one of the tension scheme, which refines it to the same surface: closed
//! directions as they are, open ones with a boundary that shrinks.

mod named;

pub use named::{Kind, Named, Product};

use crate::curve::faces;
use crate::error::Error;
use crate::numbers::{Called, read};
use eigenring_spline::curve::{Axis, Curve, Ends, Grid};
use eigenring_surface::{Mesh, Point3};

/// The most points of a mesh that is made here.
const MOST: usize = 1 << 22;

/// What of a grid becomes a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The control points after so many levels.
    Levels(u32),
    /// Points of the limit, so many in each interval between knots.
    Limit(usize),
}

/// The mesh of a grid.
///
/// # Errors
/// [`Error::Range`] for more points than a mesh shall have; those of the grid.
pub fn mesh(grid: &Grid, shown: Shown) -> Result<Mesh, Error> {
    let axes = [grid.u(), grid.v()];
    let count = |per: f64| {
        axes.iter()
            .map(|axis| per * axis.intervals() as f64 + axis.order() as f64)
            .product::<f64>()
    };
    let (what, per, given) = match shown {
        Shown::Levels(levels) => ("levels", 2_f64.powi(levels.min(64) as i32), levels as usize),
        Shown::Limit(samples) => ("limit", samples as f64, samples),
    };
    if !(count(per) <= MOST as f64) || given == 0 && what == "limit" {
        return Err(Error::Range {
            what,
            given: given.to_string(),
            accepted: format!("{} and above, up to {MOST} points in all", usize::from(what == "limit")),
        });
    }
    let (points, faces) = match shown {
        Shown::Levels(levels) => {
            let fine = grid.refine_levels(levels)?;
            (fine.points().map(<[f64]>::to_vec).collect::<Vec<_>>(), faces(&fine))
        }
        Shown::Limit(samples) => {
            let mut rows = grid.sample(samples)?;
            // where a direction is closed, its last sample is the first again
            let closed = axes.map(|axis| axis.ends() == Ends::Closed);
            if closed[0] {
                rows.pop();
            }
            if closed[1] {
                rows.iter_mut().for_each(|row| drop(row.pop()));
            }
            let faces = sampled_faces([rows.len(), rows.first().map_or(0, Vec::len)], closed);
            (rows.into_iter().flatten().collect(), faces)
        }
    };
    let points = points.iter().map(|p| Point3::new(p[0], p[1], p[2])).collect();
    let faces = faces.into_iter().map(|face| face.map(|corner| corner as u32).to_vec());
    Ok(Mesh::new(points, faces)?)
}

/// The faces of rows of samples.
fn sampled_faces([rows, columns]: [usize; 2], closed: [bool; 2]) -> Vec<[usize; 4]> {
    let at = |i: usize, j: usize| (i % rows) * columns + j % columns;
    let along = |count: usize, closed: bool| if closed { count } else { count.saturating_sub(1) };
    let across = along(columns, closed[1]);
    (0..along(rows, closed[0]))
        .flat_map(|i| (0..across).map(move |j| (i, j)))
        .map(|(i, j)| [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)])
        .collect()
}

/// Two coordinates of a profile are radius and height.
fn upright(curve: &Curve) -> Result<Curve, Error> {
    let axis = curve.axis();
    let points: Vec<[f64; 3]> = match curve.dimension() {
        2 => curve.points().map(|p| [p[0], 0.0, p[1]]).collect(),
        3 => return Ok(curve.clone()),
        dimension => {
            return Err(Error::Usage {
                message: format!("a profile with {dimension} coordinates"),
                accepted: "2 (radius and height) or 3".to_owned(),
            });
        }
    };
    Ok(Curve::new(axis.order(), axis.tension().value(), axis.ends(), &points)?)
}

/// A profile turned around the z axis, with an order of its own and so many segments around it.
///
/// # Errors
/// [`Error::Usage`] for coordinates other than 2 (radius and height) or 3; those of the grid.
pub fn revolved(profile: &Curve, around: usize, segments: usize) -> Result<Grid, Error> {
    Ok(Grid::revolution(&upright(profile)?, around, segments)?)
}

/// Whether a profile of radius and height meets the axis: there the surface closes in a point or folds.
pub fn meets_axis(profile: &Curve) -> bool {
    let radii: Vec<f64> = profile.points().map(|p| p[0]).collect();
    profile.dimension() == 2 && (radii.iter().any(|&r| r <= 0.0) && radii.iter().any(|&r| r >= 0.0))
}

/// A profile moved along a spine, multiplied by a factor at each of its points: `S_j + a_j P_i`.
///
/// # Errors
/// [`Error::Usage`] for coordinates other than 2 or 3 and for other than one factor for each point; those of
/// the grid.
pub fn swept(profile: &Curve, spine: &Curve, scale: Option<&[f64]>) -> Result<Grid, Error> {
    let spatial = |p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)];
    for (what, curve) in [("profile", profile), ("spine", spine)] {
        if !(2..=3).contains(&curve.dimension()) {
            return Err(Error::Usage {
                message: format!("a {what} with {} coordinates", curve.dimension()),
                accepted: "2 or 3".to_owned(),
            });
        }
    }
    let count = spine.axis().count();
    let factors = match scale {
        None => vec![1.0; count],
        Some(scale) if scale.len() == count => scale.to_vec(),
        Some(scale) => {
            return Err(Error::Usage {
                message: format!("{} scales for a spine of {count} points", scale.len()),
                accepted: format!("{count}, one for each point of the spine"),
            });
        }
    };
    let spine_points: Vec<[f64; 3]> = spine.points().map(spatial).collect();
    let mut points = Vec::with_capacity(profile.axis().count() * count);
    for p in profile.points().map(spatial) {
        for (s, factor) in spine_points.iter().zip(&factors) {
            points.push([0, 1, 2].map(|k| s[k] + factor * p[k]));
        }
    }
    Ok(Grid::new(profile.axis().clone(), spine.axis().clone(), &points)?)
}

/// A grid of control points from a table with the columns i, j, x, y, z, in any order of rows, each place
/// once.
///
/// # Errors
/// [`Error::Content`] for other tables and places; those of the grid.
pub fn tensor(bytes: &[u8], orders: [usize; 2], tensions: [f64; 2], closed: [bool; 2]) -> Result<Grid, Error> {
    let numbers = read(bytes, Called::Line)?;
    let rows = numbers.columns(&["i", "j", "x", "y", "z"]);
    let Some(rows) = rows.or_else(|| {
        numbers
            .rows
            .iter()
            .all(|row| row.len() == 5)
            .then(|| numbers.rows.clone())
    }) else {
        return Err(Error::content(
            "a grid without the columns i, j, x, y, z: accepted are those five",
        ));
    };
    let whole = |x: f64| (x >= 0.0 && x.fract() == 0.0 && x < MOST as f64).then_some(x as usize);
    let mut places = Vec::with_capacity(rows.len());
    for (number, row) in rows.iter().enumerate() {
        let (Some(i), Some(j)) = (whole(row[0]), whole(row[1])) else {
            return Err(Error::content(format!(
                "row {}: place {}, {}: accepted are whole numbers from 0",
                number + 1,
                row[0],
                row[1]
            )));
        };
        places.push((i, j));
    }
    let size = [
        places.iter().map(|place| place.0 + 1).max().unwrap_or(0),
        places.iter().map(|place| place.1 + 1).max().unwrap_or(0),
    ];
    let complete = size[0].checked_mul(size[1]) == Some(rows.len());
    let mut points = vec![None; if complete { rows.len() } else { 0 }];
    for ((i, j), row) in places.iter().zip(&rows) {
        if let Some(point) = points.get_mut(i * size[1] + j) {
            *point = Some([row[2], row[3], row[4]]);
        }
    }
    let points: Option<Vec<[f64; 3]>> = points.into_iter().collect();
    let Some(points) = points.filter(|_| complete) else {
        return Err(Error::content(format!(
            "{} rows for a grid of {} x {}: accepted is each place once",
            rows.len(),
            size[0],
            size[1]
        )));
    };
    let axis = |k: usize| {
        let ends = if closed[k] { Ends::Closed } else { Ends::Open };
        Axis::new(orders[k], tensions[k], ends, size[k])
    };
    Ok(Grid::new(axis(0)?, axis(1)?, &points)?)
}

/// What a mesh of a grid is, for comments in files: a line each.
pub fn remarks(title: &str, grid: &Grid, shown: Shown) -> Vec<String> {
    let direction = |name: &str, axis: &Axis| {
        let ends = if axis.ends() == Ends::Closed { "closed" } else { "open" };
        let (order, u0, count) = (axis.order(), axis.tension().value(), axis.count());
        format!("{name}: order {order}, u0 = {u0:?}, {count} control points, {ends}")
    };
    let mut lines = vec![
        title.to_owned(),
        direction("first direction", grid.u()),
        direction("second direction", grid.v()),
    ];
    let (u, v) = (grid.u(), grid.v());
    let alike = u.order() == v.order() && (u.tension().value() - v.tension().value()).abs() < 1e-15;
    if alike && shown == Shown::Levels(0) {
        lines.push(format!(
            "refine with --scheme tension:order={},u0={:?} --boundary shrink",
            u.order(),
            u.tension().value()
        ));
    }
    lines
}
