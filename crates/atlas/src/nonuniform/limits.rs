//! Exact points of HNUSS surfaces, in the tables of other surfaces.
//!
//! Places count as there: s and t run from 0 to 1 on a face, or on the quad `sub` around a corner of a face
//! that is no quad. Derivatives are by s and t. Curvature is not computed.

use crate::error::Error;
use crate::limits::{VERTEX_COLUMNS, number};
use crate::table::{Cell, Table};
use eigenring_nonuniform::{Sample, Surface};
use eigenring_surface::limit::Place;
use eigenring_surface::{Mesh, Topology, Vector3};

/// A point with its derivatives by the parameters of the face.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    place: Place,
    sample: Sample,
}

fn range(what: &'static str, given: impl ToString, accepted: String) -> Error {
    Error::Range {
        what,
        given: given.to_string(),
        accepted,
    }
}

/// A place of the mesh on an element of the surface: the quad, its parameters from 0 to 1, and how often its
/// parameters are turned against those of the place.
fn element(surface: &Surface, mesh: &Mesh, place: Place) -> Result<(u32, [f64; 2], u32), Error> {
    if place.face as usize >= mesh.face_count() {
        return Err(range(
            "face",
            place.face,
            format!("0 to {}", mesh.face_count() as i64 - 1),
        ));
    }
    for (what, x) in [("s", place.s), ("t", place.t)] {
        if !(0.0..=1.0).contains(&x) {
            return Err(range(what, x, "0 to 1".to_owned()));
        }
    }
    let size = mesh.face(place.face as usize).len() as u32;
    // the n-gons of a hybrid net that was read have no inside
    let quads = size == 4 || !surface.is_split();
    let (subs, corners) = if quads { (1, 4) } else { (size, 1) };
    if place.sub >= subs {
        return Err(range("sub", place.sub, format!("0 to {}", subs - 1)));
    }
    if place.corner >= corners {
        return Err(range("corner", place.corner, format!("0 to {}", corners - 1)));
    }
    let first = mesh.starts()[place.face as usize];
    // from parameters of a corner to those of corner 0
    let turn = |[s, t]: [f64; 2]| [1.0 - t, s];
    let mut at = [place.s, place.t];
    if !surface.is_split() {
        (0..place.corner).for_each(|_| at = turn(at));
        return Ok((place.face, at, place.corner));
    }
    if size != 4 {
        return Ok((first + place.sub, at, 0));
    }
    (0..place.corner).for_each(|_| at = turn(at));
    // the quarter, in parameters of its own corner
    let quarter = match (at[0] < 0.5, at[1] < 0.5) {
        (true, true) => 0,
        (false, true) => 1,
        (false, false) => 2,
        (true, false) => 3,
    };
    let back = |[s, t]: [f64; 2]| [t, 1.0 - s];
    (0..quarter).for_each(|_| at = back(at));
    Ok((first + quarter, at.map(|x| 2.0 * x), place.corner + 4 - quarter))
}

/// The points at places, in their order.
///
/// # Errors
/// [`Error::Range`] for a place that is none; elements without area.
pub fn samples(surface: &Surface, mesh: &Mesh, places: &[Place]) -> Result<Vec<Found>, Error> {
    let at = |&place: &Place| {
        let (quad, [s, t], turns) = element(surface, mesh, place)?;
        let sides = surface.sides(quad)?;
        let mut sample = surface.at(quad, s * sides[0], t * sides[1])?;
        // quarters have half the width of their face in s and t
        let is_quarter = surface.is_split() && mesh.face(place.face as usize).len() == 4;
        let width = if is_quarter { 2.0 } else { 1.0 };
        sample.derivatives = sample.derivatives.map(|[u, v]| {
            let mut first: [Vector3<f64>; 2] = [u * (sides[0] * width), v * (sides[1] * width)];
            // a turn of the place against the element by a quarter: s runs as v did, t against u
            (0..turns % 4).for_each(|_| first = [first[1], -first[0]]);
            first
        });
        Ok(Found { place, sample })
    };
    places.iter().map(at).collect()
}

/// The columns of points: place, point, derivatives up to the given order, normal; curvatures are empty.
pub fn point_table(found: &[Found], derivatives: usize) -> Table {
    let mut columns = vec!["face", "sub", "s", "t", "x", "y", "z"];
    if derivatives > 0 {
        columns.extend(["xs", "ys", "zs", "xt", "yt", "zt"]);
    }
    columns.extend(["nx", "ny", "nz", "gauss", "mean", "k1", "k2", "kind"]);
    let mut table = Table::new(columns);
    for Found { place, sample } in found {
        let mut row: Vec<Cell> = vec![
            (place.face as usize).into(),
            (place.sub as usize).into(),
            place.s.into(),
            place.t.into(),
        ];
        row.extend(sample.position.iter().map(|&x| Cell::from(x)));
        if derivatives > 0 {
            let values = sample
                .derivatives
                .iter()
                .flatten()
                .flat_map(|v| v.iter().copied().map(Some));
            row.extend(values.chain(std::iter::repeat(None)).take(6).map(number));
        }
        row.extend((0..3).map(|k| number(sample.normal.map(|n| n[k]))));
        row.extend([Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty]);
        row.push(kind(sample).into());
        table.push(row);
    }
    table
}

fn kind(sample: &Sample) -> &'static str {
    if sample.derivatives.is_some() {
        "regular"
    } else {
        "extraordinary"
    }
}

/// The columns of vertices. Vertices that were split from faces have no row; a vertex whose faces have no
/// area, and an unused one, has an empty row.
///
/// # Errors
/// Those of [`Surface`].
pub fn vertex_table(surface: &Surface, mesh: &Mesh) -> Result<Table, Error> {
    let mut table = Table::new(VERTEX_COLUMNS);
    let plain = mesh.without_unused();
    let topology = Topology::unchecked(&plain);
    let unused = mesh.unused();
    let net = surface.net();
    let mut number_of = 0;
    for vertex in 0..mesh.points().len() as u32 {
        let mut row: Vec<Cell> = vec![(vertex as usize).into()];
        if unused.binary_search(&vertex).is_err() {
            let spokes = topology.fan(number_of).spokes;
            number_of += 1;
            let faces: Vec<String> = spokes.iter().map(|&spoke| topology.face(spoke).to_string()).collect();
            row.extend([0_usize.into(), faces.join(" ").into()]);
            // the quad at this corner of each face
            let quads = spokes.iter().map(|&spoke| {
                let face = topology.face(spoke);
                if surface.is_split() {
                    (spoke, 0)
                } else {
                    (face, spoke - topology.face_halves(face).start)
                }
            });
            let mut found = None;
            for (quad, corner) in quads {
                let half = net.net().topology().face_halves(quad).start + corner;
                if let Some(ngon) = net.ngon_at(net.net().topology().origin(half)) {
                    found = Some((surface.centre(net.net().topology().face(ngon))?, "extraordinary"));
                    break;
                }
                if let Ok([a, b]) = surface.sides(quad) {
                    let at = [[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]][corner as usize];
                    found = Some((surface.at(quad, at[0], at[1])?, "regular"));
                    break;
                }
            }
            if let Some((sample, rule)) = found {
                row.push(rule.into());
                row.extend(sample.position.iter().map(|&x| Cell::from(x)));
                row.extend((0..3).map(|k| number(sample.normal.map(|n| n[k]))));
                row.push(kind(&sample).into());
            }
        }
        row.resize(VERTEX_COLUMNS.len(), Cell::Empty);
        table.push(row);
    }
    Ok(table)
}
