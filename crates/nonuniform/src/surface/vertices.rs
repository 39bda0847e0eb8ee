//! Elements of nets of NURSS and of eigen-polyhedra as bicubic pieces.
//!
//! After two levels four edges of each spoke of an extraordinary vertex have one interval, and the rules
//! around it are the same at all further levels: a matrix S over two rings of points. Special rules make
//! points of the first two rings only, since the interval behind the vertex, which is a mean there, is read
//! no further. So
//! a quad two or more steps away is one piece, with the intervals of its own sector and, across a spoke, of
//! the next one; a quad one step away is four, of the level below. A quad at the vertex consists of annuli
//! m = 0, 1, .. of twelve pieces with points `T_53 T_32 S^m`, `T_ba` leading from a to b rings. Derivatives
//! take S without its eigenvalue 1, whose left eigenvector is the limit.

use super::elements::{Element, Piece, grid, product};
use super::patch;
use crate::{EigenPolyhedron, Error, Net, Scheme, Spokes, Star, eigen_polyhedron_step, nurss, nurss_step};
use eigenring_spectral::{Block, Matrix};
use eigenring_surface::Topology;
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

/// Rings from which five of the next level follow.
const RINGS: usize = 3;

/// Multiplications by S after which rows are limits, if its other eigenvalues are at most [`SLOWEST`]:
/// 0.9^400 is 5e-19.
const LIMIT: usize = 400;
const SLOWEST: f64 = 0.9;

/// What the rules around a vertex give, its face being the first sector's.
#[derive(Clone, Debug)]
pub(super) struct VertexFan {
    intervals: Vec<f64>,
    /// The moduli of both subdominant eigenvalues.
    lambdas: [f64; 2],
    s: Matrix<f64>,
    deflated: Matrix<f64>,
    limit: Vec<f64>,
    inner: Matrix<f64>,
    /// From three rings to the points of the first sector's pieces.
    outer: Matrix<f64>,
    points: Vec<(usize, usize, usize)>,
}

/// Points of some rings, sector by sector, in the order of [`Star`].
fn places(sectors: usize, rings: usize) -> Vec<(usize, usize, usize)> {
    let of = |i: usize| (1..=rings).flat_map(move |a| (0..=rings).map(move |b| (i, a, b)));
    // the centre is (0, 0) of any sector
    [(0, 0, 0)].into_iter().chain((0..sectors).flat_map(of)).collect()
}

/// A point (x, y) of the first sector or beside it.
fn folded(sectors: usize, x: i32, y: i32) -> (usize, usize, usize) {
    let [a, b] = [x, y].map(|c| c.unsigned_abs() as usize);
    match (x < 0, y < 0) {
        (true, _) => (1, b, a),
        (_, true) => (sectors - 1, b, a),
        _ if x == 0 => (1 % sectors, b, 0),
        _ => (0, a, b),
    }
}

impl VertexFan {
    fn new(scheme: Scheme, intervals: Vec<f64>) -> Result<Self, Error> {
        let spokes = Spokes::stationary(intervals)?;
        let (n, d) = (spokes.valence(), spokes.intervals());
        let star = Star::new(&d.iter().map(|&d| vec![d]).collect::<Vec<_>>(), RINGS)?;
        let net = Net::new(star.mesh())?;
        let (step, near) = match scheme {
            Scheme::EigenPolyhedron => (eigen_polyhedron_step(&net), EigenPolyhedron::new(d)?.matrix()?),
            _ => (nurss_step(&net), nurss::matrix::<f64>(&spokes)?),
        };
        let table = step.map_err(Error::of_spokes)?.table;
        let mut moduli: Vec<f64> = Vec::new();
        for value in Block::Real(near).eigenvalues()? {
            moduli.extend(std::iter::repeat_n(
                value.value.re.hypot(value.value.im),
                value.multiplicity,
            ));
        }
        moduli.sort_by(|a, b| b.total_cmp(a));
        if moduli[1] > SLOWEST {
            return Err(Error::Range {
                what: "subdominant eigenvalue of finite elements",
                given: moduli[1].to_string(),
                accepted: format!("at most {SLOWEST}: knot intervals of the spokes that differ less"),
            });
        }
        let topology = net.topology();
        let [vertices, edges] = [topology.vertex_count(), topology.edge_count()];
        let row = |&(i, a, b): &(usize, usize, usize)| -> usize {
            let corner = star.point(i, a / 2, b / 2);
            let along = |to: u32| {
                let spokes = topology.fan(corner).spokes;
                let spoke = spokes.into_iter().find(|&spoke| topology.head(spoke) == to);
                vertices + topology.edge(spoke.expect("points of a star are joined")) as usize
            };
            match (a % 2, b % 2) {
                (0, 0) => corner as usize,
                (1, 0) => along(star.point(i, a / 2 + 1, b / 2)),
                (0, _) => along(star.point(i, a / 2, b / 2 + 1)),
                _ => vertices + edges + i * RINGS * RINGS + (b / 2) * RINGS + a / 2,
            }
        };
        let matrix = |to: &[(usize, usize, usize)], from: usize| {
            let columns: Vec<usize> = places(n, from)
                .iter()
                .map(|&(i, a, b)| star.point(i, a, b) as usize)
                .collect();
            let mut place = vec![usize::MAX; vertices];
            columns.iter().enumerate().for_each(|(k, &point)| place[point] = k);
            let mut rows = vec![vec![0.0; columns.len()]; to.len()];
            for (entries, point) in rows.iter_mut().zip(to) {
                for (source, weight) in table.row(row(point)).filter(|(_, weight)| **weight != 0.0) {
                    entries[place[source]] += weight;
                }
            }
            Matrix::from_rows(rows, columns.len())
        };
        let grids = (0..4).flat_map(|q| (0..4).map(move |p| (p, q)));
        let mut points: Vec<(usize, usize, usize)> = grids
            .filter(|(p, q)| *p.max(q) >= 2)
            .flat_map(|(p, q)| Self::grid(n, p, q))
            .collect();
        points.sort_unstable();
        points.dedup();
        let s = matrix(&places(n, 2), 2);
        let mut limit = vec![1.0 / s.rows() as f64; s.rows()];
        for _ in 0..LIMIT {
            let mut next = vec![0.0; limit.len()];
            for (i, weight) in limit.iter().enumerate() {
                next.iter_mut()
                    .zip(s.row(i))
                    .for_each(|(sum, entry)| *sum += weight * entry);
            }
            let sum: f64 = next.iter().sum();
            limit = next.into_iter().map(|weight| weight / sum).collect();
        }
        Ok(VertexFan {
            lambdas: [moduli[1], moduli[2]],
            deflated: Matrix::from_fn(s.rows(), s.columns(), |i, j| s[(i, j)] - limit[j]),
            s,
            limit,
            inner: matrix(&places(n, 3), 2),
            outer: matrix(&points, 3),
            points,
            intervals: d.to_vec(),
        })
    }

    /// The 16 points around the quad whose lower corner is (p, q).
    fn grid(sectors: usize, p: i32, q: i32) -> [(usize, usize, usize); 16] {
        std::array::from_fn(|k| folded(sectors, p - 1 + k as i32 % 4, q - 1 + k as i32 / 4))
    }

    /// The rows of these among the points of pieces.
    fn rows(&self, p: i32, q: i32) -> [usize; 16] {
        let of = |point| self.points.binary_search(&point).expect("all are listed");
        Self::grid(self.intervals.len(), p, q).map(of)
    }

    /// The intervals of that quad: across a spoke those of the next sector.
    fn spans(&self, p: i32, q: i32) -> [[f64; 5]; 2] {
        let (d, n) = (&self.intervals, self.intervals.len());
        let five = |first: i32, own: f64, beyond: f64| {
            std::array::from_fn(|k| if first - 2 + (k as i32) < 0 { beyond } else { own })
        };
        [five(p, d[0], d[2 % n]), five(q, d[1], d[n - 1])]
    }

    fn piece(&self, at: (i32, i32), values: &Matrix<f64>, derivatives: &Matrix<f64>, is_last: bool) -> Piece {
        let rows = self.rows(at.0, at.1);
        let part = |m: &Matrix<f64>| Matrix::from_fn(16, m.columns(), |k, j| m[(rows[k], j)]);
        Piece {
            intervals: self.spans(at.0, at.1),
            values: part(values),
            derivatives: part(derivatives),
            is_last,
        }
    }

    /// The pieces of the first annuli of the face at the vertex, over two rings, and the limit there.
    pub fn pieces(&self, annuli: usize) -> (Vec<Piece>, Vec<f64>) {
        let lift = product(&self.outer, &self.inner);
        let (mut values, mut derivatives) = (lift.clone(), lift);
        let mut pieces = Vec::with_capacity(12 * annuli);
        for m in 0..annuli {
            let places = (0..4).flat_map(|q| (0..4).map(move |p| (p, q)));
            for at in places.filter(|(p, q)| *p.max(q) >= 2) {
                pieces.push(self.piece(at, &values, &derivatives, m + 1 == annuli));
            }
            values = product(&values, &self.s);
            derivatives = product(&derivatives, &self.deflated);
        }
        (pieces, self.limit.clone())
    }

    pub fn intervals(&self) -> &[f64] {
        &self.intervals
    }

    pub fn columns(&self) -> usize {
        self.limit.len()
    }

    /// What is left of the area by an annulus.
    pub fn area(&self) -> f64 {
        self.lambdas[0] * self.lambdas[1]
    }
}

/// Points of some rings around the origin of a half-edge, which is the first spoke; `None` at boundaries.
fn around(topology: &Topology, spoke: u32, sectors: usize, rings: usize) -> Option<Vec<u32>> {
    let mut spokes = vec![spoke];
    while spokes.len() < sectors {
        spokes.push(topology.turned(*spokes.last()?)?);
    }
    let straight = |half: u32| topology.turned_back(topology.next(half));
    let point = |(i, a, b): (usize, usize, usize)| {
        let mut at = spokes[i];
        if a == 0 {
            return Some(topology.origin(at));
        }
        for _ in 1..a {
            at = straight(at)?;
        }
        for step in 0..b {
            at = if step == 0 { topology.next(at) } else { straight(at)? };
        }
        Some(topology.head(at))
    };
    places(sectors, rings).into_iter().map(point).collect()
}

/// Whether the edges straight on from each spoke, of which rules read four, have its interval; mirrored at
/// boundaries they do.
fn is_stationary(net: &Net, spokes: &[u32]) -> bool {
    let topology = net.topology();
    let straight = |half: &u32| topology.turned_back(topology.next(*half));
    let ahead = |spoke: u32| std::iter::successors(Some(spoke), straight).take(RINGS + 1);
    spokes
        .iter()
        .all(|&spoke| ahead(spoke).all(|half| net.interval(half) == net.interval(spoke)))
}

/// The elements of a net after levels of NURSS, under it or eigen-polyhedra.
#[derive(Debug)]
pub struct VertexElements<'a> {
    net: &'a Net,
    scheme: Scheme,
    /// What is around vertices, by the bits of the intervals of their spokes: all faces there share it.
    fans: RefCell<HashMap<Vec<u64>, Arc<VertexFan>>>,
}

impl<'a> VertexElements<'a> {
    /// Those of a net with two rings of quads beyond every element.
    pub fn new(net: &'a Net, scheme: Scheme) -> Self {
        VertexElements {
            net,
            scheme,
            fans: RefCell::default(),
        }
    }

    fn fan(&self, spoke: u32) -> Result<Arc<VertexFan>, Error> {
        let topology = self.net.topology();
        let mut spokes = vec![spoke];
        while let Some(next) = spokes
            .last()
            .and_then(|&last| topology.turned(last))
            .filter(|&next| next != spoke)
        {
            spokes.push(next);
        }
        let intervals: Vec<f64> = spokes.iter().map(|&spoke| self.net.interval(spoke)).collect();
        let key: Vec<u64> = intervals.iter().map(|d| d.to_bits()).collect();
        if let Some(known) = self.fans.borrow().get(&key) {
            return Ok(Arc::clone(known));
        }
        let fan = Arc::new(VertexFan::new(self.scheme, intervals)?);
        self.fans.borrow_mut().insert(key, Arc::clone(&fan));
        Ok(fan)
    }

    /// An element with its points; `None` if another extraordinary vertex, the end of the net or another
    /// interval along a spoke is within the rings that it reads.
    ///
    /// # Errors
    /// [`Error::Range`] for intervals of zero; those of the scheme's matrices.
    pub fn element(&self, face: u32) -> Result<Option<(Vec<u32>, Element)>, Error> {
        let topology = self.net.topology();
        let start = topology.face_halves(face).start;
        if self.net.interval(start) == 0.0 || self.net.interval(start + 1) == 0.0 {
            return Err(Error::Range {
                what: "knot interval",
                given: "0".to_owned(),
                accepted: "above 0: faces without width are no elements here".to_owned(),
            });
        }
        let irregular = |v: u32| self.net.is_irregular(v);
        let one = |points: &[u32]| points.iter().skip(1).all(|&v| !irregular(v));
        if let Some(spoke) = topology
            .face_halves(face)
            .find(|&half| irregular(topology.origin(half)))
        {
            let spokes = topology.fan(topology.origin(spoke)).spokes;
            let points = around(topology, spoke, spokes.len(), 2).filter(|points| one(points));
            let Some(points) = points.filter(|_| is_stationary(self.net, &spokes)) else {
                return Ok(None);
            };
            return Ok(Some((points, Element::at_vertex(self.fan(spoke)?))));
        }
        let grids: Option<Vec<[u32; 16]>> = topology.face_halves(face).map(|half| grid(topology, half)).collect();
        let Some(grids) = grids else { return Ok(None) };
        let Some((grid, at, v, to)) = grids.iter().find_map(|grid| {
            // the vertex in the grid, where the face is from there, and the end of the first spoke
            let cases = [(4, (1, 0), 5), (0, (1, 1), 1), (1, (0, 1), 2)];
            let found = cases.into_iter().find(|(k, ..)| irregular(grid[*k]));
            found.map(|(k, at, to)| (grid, at, grid[k], grid[to]))
        }) else {
            let element = Element::of_piece(patch::intervals(self.net, start));
            return Ok(Some((grids[0].to_vec(), element)));
        };
        if grid.iter().filter(|&&v| irregular(v)).count() > 1 {
            return Ok(None);
        }
        let spokes = topology.fan(v).spokes;
        let spoke = spokes.iter().find(|&&spoke| topology.head(spoke) == to);
        let points = spoke.and_then(|&spoke| around(topology, spoke, spokes.len(), RINGS));
        let (Some(&spoke), Some(points)) = (
            spoke,
            points.filter(|points| one(points) && is_stationary(self.net, &spokes)),
        ) else {
            return Ok(None);
        };
        let fan = self.fan(spoke)?;
        let parts = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| (2 * at.0 + i, 2 * at.1 + j));
        let pieces = parts.map(|at| fan.piece(at, &fan.outer, &fan.outer, false));
        Ok(Some(
            Element::of_pieces(points.len(), pieces.to_vec()).restricted(&points),
        ))
    }

    /// The moduli of both subdominant eigenvalues at each irregular vertex, the larger one first, with its
    /// valence.
    ///
    /// # Errors
    /// Those of the scheme's matrices.
    pub fn lambdas(&self) -> Result<Vec<(usize, [f64; 2])>, Error> {
        let vertices = 0..self.net.topology().vertex_count() as u32;
        let of = |v: u32| {
            let spoke = self.net.topology().fan(v).spokes[0];
            Ok((self.net.valence(v), self.fan(spoke)?.lambdas))
        };
        vertices.filter(|&v| self.net.is_irregular(v)).map(of).collect()
    }
}
