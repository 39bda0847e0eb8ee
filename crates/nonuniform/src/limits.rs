//! Limits and tangents at the vertices of a net, under any of the three schemes.
//!
//! At a regular vertex the limit is the tensor product of univariate limits `f(t_j, t_j, t_j)`, and tangents
//! are those of the two directions, `f(t_j, t_j, t_(j+1)) - f(t_(j-1), t_j, t_j)` in one and the limit in the
//! other. All corners of an n-gon of HNUSS have one limit, that of [`NGon`].
//!
//! Rules of NURSS and of eigen-polyhedra reach the corners of the faces around an irregular vertex, so that
//! there and at the vertex itself the limit is taken one level later: by then a corner is two steps away,
//! where all rules around are regular, and the vertex has the constant matrix whose left eigenvectors have
//! its limit and tangents. With two different subdominant eigenvalues, as NURSS has them, the tangent
//! plane is still that of both eigenvectors.

use crate::eigen_polyhedron::left_eigenvectors;
use crate::primal::around;
use crate::row::Row;
use crate::{EigenPolyhedron, Error, HybridNet, NGon, Net, Refinement, Scheme, Spokes, eigen_polyhedron_step};
use crate::{nurss, nurss_step};
use eigenring_spectral::{Block, Matrix};
use eigenring_spline::intervals::{doubled, limit};
use std::collections::BTreeMap;

/// The limit at a vertex and two tangents, as weights of points of the net. Tangents are zero where they are
/// not determined.
#[derive(Clone, Debug, Default)]
pub struct VertexLimit {
    pub(crate) point: Row,
    pub(crate) tangents: [Row; 2],
}

/// Limits at all vertices of a net of quads, or of a hybrid net.
#[derive(Debug)]
pub struct Limits<'a> {
    net: &'a Net,
    hybrid: Option<&'a HybridNet>,
    /// Those at irregular vertices and their neighbours.
    near: BTreeMap<u32, VertexLimit>,
}

impl<'a> Limits<'a> {
    /// The limits at the vertices of the last net.
    ///
    /// # Errors
    /// [`Error::Vertex`] for faces that are no quads, unless they are n-gons of a hybrid net; those of the
    /// scheme's next level.
    pub fn new(refinement: &'a Refinement) -> Result<Self, Error> {
        let net = refinement.net();
        let hybrid = refinement.hybrid();
        let near = match hybrid {
            Some(_) => BTreeMap::new(),
            None => {
                net.check_quads()?;
                near_irregular(net, refinement.scheme(), refinement.levels() > 0)?
            }
        };
        Ok(Limits { net, hybrid, near })
    }

    /// The limit at a vertex.
    ///
    /// # Errors
    /// Those of [`NGon::new`].
    pub fn at(&self, vertex: u32) -> Result<VertexLimit, Error> {
        if let Some(known) = self.near.get(&vertex) {
            return Ok(known.clone());
        }
        let corner = self.hybrid.and_then(|hybrid| Some((hybrid, hybrid.ngon_at(vertex)?)));
        match corner {
            Some((hybrid, half)) => ngon(hybrid, self.net.topology().face(half)),
            None => Ok(regular(self.net, vertex)),
        }
    }

    /// The limits of points with any numbers of the net.
    ///
    /// # Errors
    /// As [`Limits::at`].
    pub fn of<const D: usize>(&self, points: &[[f64; D]]) -> Result<Vec<[[f64; D]; 3]>, Error> {
        let count = self.net.topology().vertex_count() as u32;
        let at = |vertex: u32| {
            let VertexLimit {
                point,
                tangents: [s, t],
            } = self.at(vertex)?;
            Ok([&point, &s, &t].map(|row| row.applied(points)))
        };
        (0..count).map(at).collect()
    }
}

/// The limit of an n-gon.
fn ngon(hybrid: &HybridNet, face: u32) -> Result<VertexLimit, Error> {
    let topology = hybrid.net().topology();
    let ngon = NGon::new(&hybrid.spokes(face))?;
    let row = |weights: Vec<f64>| {
        let corners = topology.face_halves(face).map(|half| topology.origin(half));
        Row::of(corners.zip(weights))
    };
    Ok(VertexLimit {
        point: row(ngon.limit_weights()),
        tangents: ngon.tangent_weights().map(row),
    })
}

/// The univariate limit and derivative, up to a factor, over the points before, at and after a vertex.
fn line(intervals: [f64; 4]) -> [[f64; 3]; 2] {
    let [far, before, after, beyond] = intervals;
    if before + after == 0.0 {
        return [[0.0, 1.0, 0.0], [0.0; 3]];
    }
    let [q, p] = doubled::<f64>([after, before, far]);
    let [r, s] = doubled::<f64>([before, after, beyond]);
    [limit(intervals), [-p, r - q, s]]
}

/// The limit at a vertex with regular rules around it.
fn regular(net: &Net, vertex: u32) -> VertexLimit {
    let topology = net.topology();
    let fan = topology.fan(vertex);
    let spokes = &fan.spokes;
    if let Some(last) = fan.last {
        return on_boundary(net, vertex, spokes, last);
    }
    let along = |ahead: u32, back: u32| {
        line([
            net.beyond(back),
            net.interval(back),
            net.interval(ahead),
            net.beyond(ahead),
        ])
    };
    let (u, v) = (along(spokes[0], spokes[2]), along(spokes[1], spokes[3]));
    let places = around(topology, vertex, spokes);
    let product = |u: [f64; 3], v: [f64; 3]| {
        // V, the ends of the spokes, the far corners of the faces between them
        let weights = [
            u[1] * v[1],
            u[2] * v[1],
            u[1] * v[2],
            u[0] * v[1],
            u[1] * v[0],
            u[2] * v[2],
            u[0] * v[2],
            u[0] * v[0],
            u[2] * v[0],
        ];
        Row::of(places.iter().copied().zip(weights))
    };
    VertexLimit {
        point: product(u[0], v[0]),
        tangents: [product(u[1], v[0]), product(u[0], v[1])],
    }
}

/// The limit of the boundary curve; by reflection the tangent across it is the difference of the next row and
/// the boundary's.
fn on_boundary(net: &Net, vertex: u32, spokes: &[u32], last: u32) -> VertexLimit {
    let topology = net.topology();
    let (before, after) = (topology.origin(last), topology.head(spokes[0]));
    let difference = |from: u32, to: u32| Row::of([(to, 1.0), (from, -1.0)]);
    if spokes.len() == 1 {
        return VertexLimit {
            point: Row::unit(vertex),
            tangents: [difference(vertex, after), difference(vertex, before)],
        };
    }
    let [point, along] = line([
        net.behind(last),
        net.interval(last),
        net.interval(spokes[0]),
        net.beyond(spokes[0]),
    ]);
    let boundary = [before, vertex, after];
    let of = |weights: [f64; 3], places: [u32; 3]| Row::of(places.into_iter().zip(weights));
    // the row behind, where two faces meet; at other boundary vertices that of the middle edge alone
    let middle = spokes[spokes.len() / 2];
    let mut across = match spokes.len() {
        2 => of(
            point,
            [
                topology.head(topology.next(middle)),
                topology.head(middle),
                topology.head(topology.next(spokes[0])),
            ],
        ),
        _ => Row::unit(topology.head(middle)),
    };
    across.add(-1.0, &of(point, boundary));
    VertexLimit {
        point: of(point, boundary),
        tangents: [of(along, boundary), across],
    }
}

/// The limit and tangents over V, E_0.., F_0.. by the left eigenvectors of a constant matrix.
fn irregular(d: &[f64], scheme: Scheme) -> Result<[Vec<f64>; 3], Error> {
    let matrix: Matrix<f64> = match scheme {
        Scheme::EigenPolyhedron => EigenPolyhedron::new(d)?.matrix()?,
        _ => nurss::matrix(&Spokes::stationary(d.to_vec())?)?,
    };
    let mut limit = left_eigenvectors(&matrix, 1.0)?.swap_remove(0);
    let sum: f64 = limit.iter().sum();
    limit.iter_mut().for_each(|weight| *weight /= sum);
    let mut values = Block::Real(matrix.clone()).eigenvalues()?;
    values.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
    let mut tangents = Vec::new();
    for value in values.iter().skip(1).take(2) {
        if value.value.im == 0.0 && tangents.len() < 2 {
            tangents.extend(left_eigenvectors(&matrix, value.value.re)?);
        }
    }
    let zero = || vec![0.0; matrix.columns()];
    let mut tangents = tangents.into_iter();
    Ok([
        limit,
        tangents.next().unwrap_or_else(zero),
        tangents.next().unwrap_or_else(zero),
    ])
}

/// Limits at irregular vertices and their neighbours, from the level that follows: of a part of the net that
/// holds all that their rules read.
fn near_irregular(net: &Net, scheme: Scheme, later: bool) -> Result<BTreeMap<u32, VertexLimit>, Error> {
    let topology = net.topology();
    let irregular_ones: Vec<u32> = (0..topology.vertex_count() as u32)
        .filter(|&vertex| net.is_irregular(vertex))
        .collect();
    let mut found = BTreeMap::new();
    for &centre in &irregular_ones {
        let (part, originals) = net.part(centre, RINGS)?;
        let own = |vertex: u32| originals.iter().position(|&original| original == vertex);
        let step = match scheme {
            Scheme::EigenPolyhedron if later => eigen_polyhedron_step(&part),
            _ => nurss_step(&part),
        }?;
        // a limit over points of the next level as one over those of the net
        let composed = |fine: &Row| {
            let mut row = Row::default();
            for (point, weight) in fine.terms() {
                for (at, own) in step.table.row(point as usize) {
                    row.push(originals[at], weight * own);
                }
            }
            row
        };
        let pulled = |limit: &VertexLimit| VertexLimit {
            point: composed(&limit.point),
            tangents: limit.tangents.each_ref().map(composed),
        };
        let at = own(centre).expect("a part holds its middle") as u32;
        let spokes = step.net.topology().fan(at).spokes;
        let d: Vec<f64> = spokes.iter().map(|&spoke| step.net.interval(spoke)).collect();
        let places = around(step.net.topology(), at, &spokes);
        let rows = irregular(&d, scheme)
            .map_err(|error| step.net.error_at(error, at))?
            .map(|weights| Row::of(places.iter().copied().zip(weights)));
        let [point, s, t] = rows;
        found.insert(
            centre,
            pulled(&VertexLimit {
                point,
                tangents: [s, t],
            }),
        );
        // the ends of the spokes and the far corners of the faces between them
        let neighbours = around(topology, centre, &topology.fan(centre).spokes);
        for &vertex in &neighbours[1..] {
            if !net.is_irregular(vertex) && !net.is_on_boundary(vertex) {
                let at = own(vertex).expect("a part holds the neighbours of its middle") as u32;
                found.insert(vertex, pulled(&regular(&step.net, at)));
            }
        }
    }
    Ok(found)
}

/// Rings of faces whose points and intervals the next level reads at an irregular vertex and its neighbours.
const RINGS: usize = 4;
