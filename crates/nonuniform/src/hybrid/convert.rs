//! The first level of HNUSS (Li, Wei and Zhang 2019, section 3): lines of edges are doubled.
//!
//! From every extraordinary vertex each spoke is followed straight on through regular vertices, to another
//! extraordinary vertex or to the boundary. The edges on the way are *virtual*; each becomes a quad of zero
//! width. At each vertex the fan of faces is cut at its virtual spokes, and each part has a point of its own;
//! three parts or more are the corners of a new face.
//!
//! The point of vertex V in a face with corners V, W1 (on spoke i), X, W2 (on spoke i+1) is
//!
//! ```text
//! p q X + (1-p) q W1 + p (1-q) W2 + (1-p)(1-q) V,     p = b/(b + h + a) if spoke i is virtual, else 0
//! ```
//!
//! with the interval h of V-W2, b across V-W1 and a across X-W2; q likewise for spoke i+1. Faces of one part
//! agree. At irregular vertices this is the rule `simple` of [`first_level`], which has others; at valence 4
//! it is the doubling of knots, which no other rule can better.

use super::{Converted, HybridNet, Outside};
use crate::primal::around;
use crate::row::Row;
use crate::{Error, FirstLevel, KnotIntervals, NGon, Net, first_level};
use eigenring_scheme::Table;
use eigenring_surface::{Mesh, NONE, Topology};

pub(super) fn convert(net: &Net, rule: FirstLevel, outside: Outside) -> Result<Converted, Error> {
    check(net)?;
    let virtuals = virtual_edges(net);
    let groups = Groups::new(net, &virtuals);
    let mut simple = Vec::new();
    let mut table = Table::default();
    let mut rows: Vec<Row> = vec![Row::default(); groups.count as usize];
    for vertex in 0..net.topology().vertex_count() as u32 {
        let spokes = net.topology().fan(vertex).spokes;
        if net.is_irregular(vertex) {
            let d: Vec<f64> = spokes.iter().map(|&spoke| net.interval(spoke)).collect();
            NGon::new(&d).map_err(|error| net.error_at(error, vertex))?;
            let found = match irregular_rows(net, vertex, &spokes, rule) {
                Err(Error::OutsideDomain { .. }) if outside == Outside::Simple => {
                    simple.push(net.place(vertex));
                    None
                }
                found => Some(found.map_err(|error| net.error_at(error, vertex))?),
            };
            if let Some(found) = found.flatten() {
                for (&spoke, row) in spokes.iter().zip(found) {
                    rows[groups.of[spoke as usize] as usize] = row;
                }
                continue;
            }
        }
        for &spoke in &spokes {
            let group = groups.of[spoke as usize] as usize;
            // faces of one part agree: the first one gives the point
            if rows[group] == Row::default() {
                rows[group] = doubled(net, &virtuals, spoke)?;
            } else {
                debug_assert!(
                    rows[group].is_close(&doubled(net, &virtuals, spoke)?),
                    "faces of one part of vertex {vertex} disagree"
                );
            }
        }
    }
    for row in &rows {
        table.push(row.terms())?;
    }
    Ok(Converted {
        table,
        net: HybridNet::known(groups.net(net, &virtuals)?),
        simple,
    })
}

/// What HNUSS has no rules for.
fn check(net: &Net) -> Result<(), Error> {
    net.check_quads()?;
    let topology = net.topology();
    for vertex in 0..topology.vertex_count() as u32 {
        let valence = net.valence(vertex);
        let (what, accepted) = if net.is_on_boundary(vertex) && valence > 3 {
            (
                format!("lies on the boundary and has {valence} edges"),
                "by HNUSS are three edges there, or two at a corner",
            )
        } else if !net.is_on_boundary(vertex) && valence < 3 {
            (
                format!("has {valence} edges"),
                "by HNUSS are three and more at inner vertices",
            )
        } else {
            continue;
        };
        let place = net.place(vertex);
        return Err(Error::Vertex { place, what, accepted });
    }
    Ok(())
}

/// The edges that are doubled.
fn virtual_edges(net: &Net) -> Vec<bool> {
    let topology = net.topology();
    let mut virtuals = vec![false; topology.edge_count()];
    for vertex in (0..topology.vertex_count() as u32).filter(|&vertex| net.is_extraordinary(vertex)) {
        for mut half in topology.fan(vertex).spokes {
            loop {
                virtuals[topology.edge(half) as usize] = true;
                let head = topology.head(half);
                if net.is_extraordinary(head) || net.is_on_boundary(head) {
                    break;
                }
                // twice a quarter turn at the regular vertex that is reached
                match topology.twin(topology.next(half)) {
                    Some(twin) => half = topology.next(twin),
                    None => break,
                }
            }
        }
    }
    virtuals
}

/// The weight of knot doubling across the line of a spoke, seen from the face on one side.
fn weight(net: &Net, line: u32, own: u32, opposite: u32) -> Result<f64, Error> {
    let (b, h, a) = (net.across(line), net.interval(own), net.across(opposite));
    if b + h + a > 0.0 {
        return Ok(b / (b + h + a));
    }
    let topology = net.topology();
    let [v, w] = topology.edge_points(topology.edge(own));
    Err(Error::ZeroSum {
        what: format!(
            "edge {} and of the edges beside it on its line",
            net.edge_in_words(v, w)
        ),
        rule: "doubling a knot",
    })
}

/// The point of the vertex from which `corner` starts, in its face.
fn doubled(net: &Net, virtuals: &[bool], corner: u32) -> Result<Row, Error> {
    let topology = net.topology();
    let is_virtual = |half: u32| virtuals[topology.edge(half) as usize];
    let (next, last) = (topology.next(corner), topology.previous(corner));
    let opposite = topology.next(next);
    let p = if is_virtual(corner) {
        weight(net, corner, last, opposite)?
    } else {
        0.0
    };
    let q = if is_virtual(last) {
        weight(net, last, corner, next)?
    } else {
        0.0
    };
    Ok(Row::of([
        (topology.origin(opposite), p * q),
        (topology.head(corner), (1.0 - p) * q),
        (topology.origin(last), p * (1.0 - q)),
        (topology.origin(corner), (1.0 - p) * (1.0 - q)),
    ]))
}

/// The rows of the corners of a new n-gon, unless the rule is simple.
fn irregular_rows(net: &Net, vertex: u32, spokes: &[u32], rule: FirstLevel) -> Result<Option<Vec<Row>>, Error> {
    if !rule.needs_polyhedron() {
        return Ok(None);
    }
    let matrix = first_level::rows(&net.spokes(spokes)?, rule)?;
    let points = around(net.topology(), vertex, spokes);
    let row = |i: usize| Row::of(points.iter().copied().zip(matrix.row(i).iter().copied()));
    Ok(Some((0..spokes.len()).map(row).collect()))
}

/// The parts into which the faces around each vertex fall.
struct Groups {
    /// The new point of each corner of a face, by half-edge.
    of: Vec<u32>,
    count: u32,
    /// The vertices with three parts or more inside the mesh, and the first spoke of each part.
    split: Vec<Vec<u32>>,
}

impl Groups {
    fn new(net: &Net, virtuals: &[bool]) -> Self {
        let topology = net.topology();
        let mut groups = Groups {
            of: vec![NONE; topology.half_count()],
            count: 0,
            split: Vec::new(),
        };
        for vertex in 0..topology.vertex_count() as u32 {
            let fan = topology.fan(vertex);
            let is_virtual = |spoke: &u32| virtuals[topology.edge(*spoke) as usize];
            let start = match fan.is_closed() {
                true => fan.spokes.iter().position(is_virtual).unwrap_or(0),
                false => 0,
            };
            let mut first = Vec::new();
            for i in 0..fan.spokes.len() {
                let spoke = fan.spokes[(start + i) % fan.spokes.len()];
                if i == 0 || is_virtual(&spoke) {
                    first.push(spoke);
                    groups.count += 1;
                }
                groups.of[spoke as usize] = groups.count - 1;
            }
            if fan.is_closed() && first.len() > 2 {
                groups.split.push(first);
            }
        }
        groups
    }

    fn net(&self, net: &Net, virtuals: &[bool]) -> Result<Net, Error> {
        let topology = net.topology();
        let mut corners = self.of.clone();
        // intervals by corner of the new faces: of the edge that leaves it
        let mut intervals: Vec<f64> = (0..topology.half_count() as u32)
            .map(|half| net.interval(half))
            .collect();
        let mut sizes = vec![4_usize; topology.face_count()];
        let of = |half: u32| self.of[half as usize];
        for edge in (0..topology.edge_count() as u32).filter(|&edge| virtuals[edge as usize]) {
            let half = topology.half_of_edge(edge);
            let twin = topology.twin(half).expect("lines run inside the mesh");
            corners.extend([of(topology.next(half)), of(half), of(topology.next(twin)), of(twin)]);
            let own = net.interval(half);
            intervals.extend([own, 0.0, own, 0.0]);
            sizes.push(4);
        }
        for first in &self.split {
            corners.extend(first.iter().map(|&spoke| of(spoke)));
            intervals.extend(first.iter().map(|_| 0.0));
            sizes.push(first.len());
        }
        let origin = eigenring_surface::Point3::origin();
        let mut mesh = Mesh::of_points(vec![origin; self.count as usize]);
        let mut rest = corners.as_slice();
        for size in sizes {
            let (face, others) = rest.split_at(size);
            mesh.push_face(face)?;
            rest = others;
        }
        let fine = Topology::unchecked(&mesh);
        let known = KnotIntervals::known(&fine, |half| intervals[half as usize]);
        Ok(Net::known(mesh, fine, known).of_new_vertices())
    }
}
