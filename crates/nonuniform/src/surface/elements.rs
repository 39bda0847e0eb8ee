//! Elements of hybrid nets as bicubic pieces over points of the net: what finite elements need.
//!
//! An element without a corner on an n-gon is one piece over the 16 points around it, in its order. One with
//! such a corner is halved, twice in nets of the first two levels, and then at every level in the
//! [neighbourhood](super::corner) of the n-gon; of its four children three are pieces each time. What is
//! left at the corner has `4^-depth` of the area.

use super::corner::Corner;
use super::vertices::VertexFan;
use super::{children, patch};
use crate::{Error, HybridNet};
use eigenring_spectral::Matrix;
use eigenring_surface::Topology;
use std::sync::Arc;

/// A bicubic piece: a tensor product B-spline on one knot span in each direction.
#[derive(Clone, Debug)]
pub struct Piece {
    /// In both directions the intervals of the two spans before, the own one, and the two after.
    pub intervals: [[f64; 5]; 2],
    /// Its 16 control points, by rows along u, as combinations of the element's points.
    pub values: Matrix<f64>,
    /// The same up to a combination that all 16 share: what derivatives need, with more digits.
    pub derivatives: Matrix<f64>,
    /// Whether it is one of the last annulus at a corner on an n-gon.
    pub is_last: bool,
}

/// An element as a recipe for its pieces.
#[derive(Clone, Debug)]
pub struct Element {
    columns: usize,
    pieces: Vec<Piece>,
    /// The neighbourhoods of corners on n-gons with their points as combinations of the element's.
    corners: Vec<(Corner, Matrix<f64>)>,
    /// What is around a corner that is an extraordinary vertex.
    vertex: Option<Arc<VertexFan>>,
    halvings: usize,
}

pub(super) fn product(a: &Matrix<f64>, b: &Matrix<f64>) -> Matrix<f64> {
    let mut rows = vec![vec![0.0; b.columns()]; a.rows()];
    for (i, row) in rows.iter_mut().enumerate() {
        for (k, &weight) in a.row(i).iter().enumerate().filter(|(_, w)| **w != 0.0) {
            row.iter_mut().zip(b.row(k)).for_each(|(sum, x)| *sum += weight * x);
        }
    }
    Matrix::from_rows(rows, b.columns())
}

fn identity(n: usize) -> Matrix<f64> {
    Matrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)))
}

impl Element {
    /// One piece over the 16 points around it.
    pub(super) fn of_piece(intervals: [[f64; 5]; 2]) -> Self {
        let piece = Piece {
            intervals,
            values: identity(16),
            derivatives: identity(16),
            is_last: false,
        };
        Element::of_pieces(16, vec![piece])
    }

    pub(super) fn of_pieces(columns: usize, pieces: Vec<Piece>) -> Self {
        Element {
            columns,
            pieces,
            corners: Vec::new(),
            vertex: None,
            halvings: 0,
        }
    }

    pub(super) fn at_vertex(fan: Arc<VertexFan>) -> Self {
        Element {
            columns: fan.columns(),
            vertex: Some(fan),
            ..Element::of_pieces(0, Vec::new())
        }
    }

    /// The part of the area at a corner that a level leaves: 1/4 at n-gons, the product of both subdominant
    /// eigenvalues at vertices.
    pub fn left(&self) -> f64 {
        self.vertex.as_ref().map_or(0.25, |fan| fan.area())
    }

    /// The depth at which what is left of the area is rounding.
    pub fn depth(&self) -> usize {
        (1e-16_f64.ln() / self.left().ln()).ceil() as usize
    }

    /// How many points it has.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Whether no corner is on an n-gon.
    pub fn is_regular(&self) -> bool {
        self.corners.is_empty() && self.vertex.is_none()
    }

    /// The pieces down to a depth in halvings, at least one at each n-gon, and the limit at the n-gon as a
    /// combination of the points.
    pub fn pieces(&self, depth: usize) -> (Vec<Piece>, Option<Vec<f64>>) {
        let mut pieces = self.pieces.clone();
        let mut centre = None;
        for (corner, rows) in &self.corners {
            let (own, limit) = corner.pieces(rows, depth.saturating_sub(self.halvings).max(1));
            pieces.extend(own);
            centre = Some(limit);
        }
        if let Some(fan) = &self.vertex {
            let (own, limit) = fan.pieces(depth.max(1));
            pieces.extend(own);
            centre = Some(limit);
        }
        (pieces, centre)
    }

    /// Numbers that two elements share only if their pieces are the same but for the size of intervals: the
    /// ratios of intervals of a regular one, those of the spokes of one after two halvings. `None` for
    /// others.
    pub fn key(&self) -> Option<Vec<u64>> {
        let ratios = |of: &[f64], to: f64| -> Vec<u64> { of.iter().map(|d| (d / to).to_bits()).collect() };
        if let Some(fan) = &self.vertex {
            let d = fan.intervals();
            return Some([ratios(d, d[0]), vec![u64::MAX - 1]].concat());
        }
        match (&self.pieces[..], &self.corners[..]) {
            ([piece], []) => {
                let [u, v] = piece.intervals;
                Some([ratios(&u, u[2]), ratios(&v, v[2])].concat())
            }
            ([], [(corner, _)]) => {
                let d = corner.intervals();
                // no ratio is the number at the end; without width rules depend on what is behind
                let shared = d.iter().all(|d| *d > 0.0);
                shared.then(|| [ratios(d, d[0]), vec![u64::MAX]].concat())
            }
            _ => None,
        }
    }
}

/// The 16 points around the quad of a half-edge, which runs from (0, 0) to (1, 0): point (i, j) at
/// `4 (j + 1) + i + 1`. `None` beside a boundary. The corners of the quad have valence 4.
pub fn grid(topology: &Topology, half: u32) -> Option<[u32; 16]> {
    let mut points = [0; 16];
    let mut half = half;
    let (mut at, mut d) = ([0_i32, 0], [1_i32, 0]);
    for _ in 0..4 {
        let e = [-d[1], d[0]];
        let west = topology.turned(topology.turned(half)?)?;
        let south = topology.turned(west)?;
        let mut set = |x: i32, y: i32, v: u32| points[(4 * (y + 1) + x + 1) as usize] = v;
        set(at[0], at[1], topology.origin(half));
        set(at[0] - d[0], at[1] - d[1], topology.head(west));
        set(
            at[0] - d[0] - e[0],
            at[1] - d[1] - e[1],
            topology.head(topology.next(west)),
        );
        set(at[0] - e[0], at[1] - e[1], topology.head(south));
        at = [at[0] + d[0], at[1] + d[1]];
        d = e;
        half = topology.next(half);
    }
    Some(points)
}

/// Rings of faces around a corner of an n-gon that hold the first three quads of all its sectors.
const RINGS: usize = 4;

/// A part of a net and its halvings, with the tables between them.
struct Part {
    nets: Vec<HybridNet>,
    tables: Vec<eigenring_scheme::Table<f64>>,
    children: Vec<Vec<u32>>,
}

impl Part {
    /// A point of a level as a combination of those of the first.
    fn row(&self, level: usize, vertex: u32) -> Vec<f64> {
        let count = self.nets[0].net().topology().vertex_count();
        let mut row = vec![0.0; count];
        let Some(above) = level.checked_sub(1) else {
            row[vertex as usize] = 1.0;
            return row;
        };
        for (source, weight) in self.tables[above].row(vertex as usize) {
            for (sum, x) in row.iter_mut().zip(self.row(above, source as u32)) {
                *sum += weight * x;
            }
        }
        row
    }

    fn rows(&self, level: usize, vertices: &[u32]) -> Matrix<f64> {
        let count = self.nets[0].net().topology().vertex_count();
        Matrix::from_rows(vertices.iter().map(|&v| self.row(level, v)).collect(), count)
    }

    fn collect(&self, level: usize, face: u32, element: &mut Element) -> Result<(), Error> {
        let net = &self.nets[level];
        let start = net.net().topology().face_halves(face).start;
        if let Some(corner) = net.ngon_beside(face) {
            if level < self.tables.len() {
                let first = self.children[level][face as usize];
                return (first..first + 4).try_for_each(|child| self.collect(level + 1, child, element));
            }
            let corner = net.neighbourhood(corner)?;
            let rows = self.rows(level, &corner.vertices);
            element.corners.push((corner, rows));
            return Ok(());
        }
        let points = grid(net.net().topology(), start).ok_or_else(|| net.too_narrow(face))?;
        let rows = self.rows(level, &points);
        element.pieces.push(Piece {
            intervals: patch::intervals(net.net(), start),
            values: rows.clone(),
            derivatives: rows,
            is_last: false,
        });
        Ok(())
    }
}

impl HybridNet {
    /// Whether a face has an area: a quad with positive intervals.
    pub fn is_element(&self, face: u32) -> bool {
        let topology = self.net().topology();
        let start = topology.face_halves(face).start;
        topology.face_size(face) == 4 && self.net().interval(start) > 0.0 && self.net().interval(start + 1) > 0.0
    }

    /// The half-edge of an n-gon that leaves a corner of a face.
    fn ngon_beside(&self, face: u32) -> Option<u32> {
        let topology = self.net().topology();
        topology
            .face_halves(face)
            .find_map(|half| self.ngon_at(topology.origin(half)))
    }

    fn neighbourhood(&self, half: u32) -> Result<Corner, Error> {
        let topology = self.net().topology();
        let ngon = topology.face(half);
        let sector = half - topology.face_halves(ngon).start;
        Corner::new(self, ngon, sector as usize)
    }

    fn too_narrow(&self, face: u32) -> Error {
        Error::Range {
            what: "face",
            given: face.to_string(),
            accepted: "one with quads on all sides".to_owned(),
        }
    }

    /// An element with its points, in a net that has been halved so often since it was made of a mesh. From
    /// two halvings on the rules around an n-gon are the same at all levels. The net must go on around the
    /// element: by one ring of quads, two in nets of fewer halvings, and its n-gons by as many as they have
    /// sectors' first three.
    ///
    /// # Errors
    /// [`Error::Range`] for a face that is none, or at the end of the net; those of
    /// [`NGon::new`](crate::NGon::new).
    pub fn element(&self, face: u32, halvings: usize) -> Result<(Vec<u32>, Element), Error> {
        let topology = self.net().topology();
        if face as usize >= topology.face_count() || !self.is_element(face) {
            return Err(self.too_narrow(face));
        }
        let start = topology.face_halves(face).start;
        let Some(half) = self.ngon_beside(face) else {
            let points = grid(topology, start).ok_or_else(|| self.too_narrow(face))?;
            let element = Element::of_piece(patch::intervals(self.net(), start));
            return Ok((points.to_vec(), element));
        };
        if halvings >= 2 {
            let corner = self.neighbourhood(half)?;
            let points = corner.vertices.clone();
            let element = Element {
                columns: points.len(),
                pieces: Vec::new(),
                corners: vec![(corner, identity(points.len()))],
                vertex: None,
                halvings: 0,
            };
            return Ok((points, element));
        }
        let (net, originals) = self.net().part(topology.origin(half), RINGS)?;
        let own: Vec<u32> = topology.face_halves(face).map(|half| topology.origin(half)).collect();
        let there = net.topology();
        let is_own = |face: &u32| {
            let corners = there
                .face_halves(*face)
                .map(|half| originals[there.origin(half) as usize]);
            corners.eq(own.iter().copied())
        };
        let face = (0..there.face_count() as u32)
            .find(is_own)
            .ok_or_else(|| self.too_narrow(face))?;
        let mut part = Part {
            nets: vec![HybridNet::known(net)],
            tables: Vec::new(),
            children: Vec::new(),
        };
        for level in 0..2 - halvings {
            let (table, net) = part.nets[level].halved()?;
            part.children.push(children(&part.nets[level]));
            part.tables.push(table);
            part.nets.push(net);
        }
        let mut element = Element {
            columns: 0,
            pieces: Vec::new(),
            corners: Vec::new(),
            vertex: None,
            halvings: 2 - halvings,
        };
        part.collect(0, face, &mut element)?;
        Ok(element.restricted(&originals))
    }
}

impl Element {
    /// Without the points that nothing reads; the numbers of the others.
    pub(super) fn restricted(self, originals: &[u32]) -> (Vec<u32>, Self) {
        let all = self.pieces.iter().map(|piece| &piece.values);
        let all: Vec<&Matrix<f64>> = all.chain(self.corners.iter().map(|(_, rows)| rows)).collect();
        let read = |column: &usize| all.iter().any(|m| (0..m.rows()).any(|row| m[(row, *column)] != 0.0));
        let kept: Vec<usize> = (0..originals.len()).filter(read).collect();
        let part = |m: &Matrix<f64>| Matrix::from_fn(m.rows(), kept.len(), |i, j| m[(i, kept[j])]);
        let pieces = self.pieces.iter().map(|piece| Piece {
            values: part(&piece.values),
            derivatives: part(&piece.derivatives),
            ..*piece
        });
        let element = Element {
            columns: kept.len(),
            pieces: pieces.collect(),
            corners: self
                .corners
                .iter()
                .map(|(corner, rows)| (corner.clone(), part(rows)))
                .collect(),
            vertex: None,
            halvings: self.halvings,
        };
        (kept.iter().map(|&k| originals[k]).collect(), element)
    }
}
