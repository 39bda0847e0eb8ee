//! Halvings of hybrid nets as blocks: no adjacency structure is made for fine levels.
//!
//! Each quad of the net becomes a block of `n x n` quads, `n = 2, 4, 8, ..`, of `n x 1` where its intervals
//! are zero in one direction, and stays one where they are in both; n-gons stay. Inside a block intervals of
//! a direction are equal, and its neighbours' are seen at its ends only: so the rules of a line are those of
//! uniform splines but for two points at either end. All of them are tensor products, which run along rows
//! first. They are the rules of [`halve`](super::halve), whose tables are for few levels and many channels;
//! points come in the order of the [`Layout`].

use super::HybridNet;
use crate::{Error, NGon};
use eigenring_spline::intervals::{edge, vertex};
use eigenring_surface::{Layout, Mesh, Point3};

/// A hybrid net after some halvings, with `D` numbers at each point.
#[derive(Clone, Debug)]
pub struct Blocks<'a, const D: usize> {
    net: &'a HybridNet,
    /// A positive interval has become so many.
    n: usize,
    points: Vec<[f64; D]>,
}

/// The weights of a point on a line of points: of the first source and those after it.
type Weights = [f64; 3];

/// Where the sources of the `i`-th fine point of a line begin.
fn first_source(i: usize) -> usize {
    if i % 2 == 1 { i / 2 } else { i / 2 - 1 }
}

/// The weights of the fine points 1 to 2n-1 of a line of n equal intervals, given those before, of and after
/// it.
fn weights(n: usize, [before, own, after]: [f64; 3]) -> Vec<Weights> {
    let interval = |j: isize| match j {
        _ if j < 0 => before,
        _ if j >= n as isize => after,
        _ => own,
    };
    let rule = |i: usize| -> Weights {
        let j = (i / 2) as isize;
        if i % 2 == 1 {
            let [a, b] = edge::<f64>([j - 1, j, j + 1].map(interval));
            [a, b, 0.0]
        } else {
            vertex::<f64>([j - 2, j - 1, j, j + 1].map(interval))
        }
    };
    if n < 5 {
        return (1..2 * n).map(rule).collect();
    }
    // points 4 and 5 see nothing of the ends
    let inner = [rule(4), rule(5)];
    let one = |i: usize| if i < 4 || i + 4 > 2 * n { rule(i) } else { inner[i % 2] };
    (1..2 * n).map(one).collect()
}

fn combined<'p, const D: usize>(terms: impl IntoIterator<Item = (&'p [f64; D], f64)>) -> [f64; D] {
    let mut sum = [0.0; D];
    for (point, weight) in terms {
        sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
    }
    sum
}

/// The fine points between the ends of a line.
fn along<const D: usize>(line: &[[f64; D]], weights: &[Weights], into: &mut [[f64; D]]) {
    for ((target, weights), i) in into.iter_mut().zip(weights).zip(1..) {
        let first = first_source(i);
        let sources = &line[first..first + 3 - i % 2];
        *target = combined(sources.iter().zip(weights.iter().copied()));
    }
}

impl HybridNet {
    /// The net with points, to be halved any number of times.
    ///
    /// # Panics
    /// If there is not one point for each vertex of the net.
    pub fn blocks<const D: usize>(&self, points: Vec<[f64; D]>) -> Blocks<'_, D> {
        assert_eq!(points.len(), self.net.topology().vertex_count(), "points of a net");
        Blocks {
            net: self,
            n: 1,
            points,
        }
    }
}

impl<'a, const D: usize> Blocks<'a, D> {
    fn layout(&self, n: usize) -> Layout<'a> {
        let net = &self.net.net;
        Layout::new(net.topology(), n, |edge| net.intervals().of_edge(edge) > 0.0)
    }

    /// The points of the last level.
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// Halves all positive intervals.
    ///
    /// # Errors
    /// Those of [`NGon::new`], and [`eigenring_surface::Error::TooLarge`] beyond indices of 32 bits.
    pub fn halve(&mut self) -> Result<(), Error> {
        let (coarse, fine) = (self.layout(self.n), self.layout(2 * self.n));
        let corners = 4.0 * fine.face_count() as f64;
        if corners >= f64::from(u32::MAX) {
            return Err(Error::from(eigenring_surface::Error::TooLarge {
                what: "corners of faces",
                count: corners as usize,
            }));
        }
        let mut new = vec![[0.0; D]; fine.count()];
        self.corners(&coarse, &mut new)?;
        let topology = self.net.net.topology();
        for edge in 0..topology.edge_count() as u32 {
            let targets = &mut new[fine.side(edge)];
            if !targets.is_empty() {
                self.side(&coarse, topology.half_of_edge(edge), targets);
            }
        }
        for face in 0..topology.face_count() as u32 {
            let targets = &mut new[fine.inner(face)];
            if !targets.is_empty() {
                self.inner(&coarse, face, targets);
            }
        }
        self.points = new;
        self.n *= 2;
        Ok(())
    }

    /// The interval that follows one of the coarse net: once it is cut, its own.
    fn next(&self, own: f64, next: f64) -> f64 {
        if self.n > 1 && own > 0.0 { own } else { next }
    }

    fn corners(&self, layout: &Layout<'_>, new: &mut [[f64; D]]) -> Result<(), Error> {
        let net = &self.net.net;
        let topology = net.topology();
        let point = |half: u32, p: usize, q: usize| &self.points[layout.at(half, p, q)];
        for face in self.net.extraordinary_faces() {
            let spokes = self.net.spokes(face);
            let first = topology.origin(topology.face_halves(face).start);
            let ngon = NGon::new(&spokes).map_err(|error| net.error_at(error, first))?;
            let corners: Vec<usize> = topology
                .face_halves(face)
                .map(|half| topology.origin(half) as usize)
                .collect();
            for (i, &corner) in corners.iter().enumerate() {
                let terms = corners.iter().enumerate();
                new[corner] = combined(terms.map(|(j, &corner)| (&self.points[corner], ngon.weight(i, j))));
            }
        }
        for number in (0..topology.vertex_count() as u32).filter(|&number| self.net.ngon_at(number).is_none()) {
            let own = &self.points[number as usize];
            let spokes = topology.fan(number);
            let ahead = |half: u32| self.next(net.interval(half), net.beyond(half));
            let target = &mut new[number as usize];
            if let Some(arrives) = spokes.last {
                let first = spokes.spokes[0];
                if spokes.spokes.len() == 1 {
                    *target = *own;
                    continue;
                }
                let before = self.next(net.interval(arrives), net.behind(arrives));
                let [a, b, c] = vertex::<f64>([before, net.interval(arrives), net.interval(first), ahead(first)]);
                let last = point(arrives, layout.parts(arrives) - 1, 0);
                *target = combined([(last, a), (own, b), (point(first, 1, 0), c)]);
                continue;
            }
            let spokes = &spokes.spokes;
            debug_assert!(spokes.len() == 4, "inner vertices of a hybrid net have valence 4");
            let line = |forth: u32, back: u32| {
                vertex::<f64>([ahead(back), net.interval(back), net.interval(forth), ahead(forth)])
            };
            let (u, v) = (line(spokes[0], spokes[2]), line(spokes[1], spokes[3]));
            let (head, face) = (|k: usize| point(spokes[k], 1, 0), |k: usize| point(spokes[k], 1, 1));
            *target = combined([
                (own, u[1] * v[1]),
                (head(0), u[2] * v[1]),
                (head(1), u[1] * v[2]),
                (head(2), u[0] * v[1]),
                (head(3), u[1] * v[0]),
                (face(0), u[2] * v[2]),
                (face(1), u[0] * v[2]),
                (face(2), u[0] * v[0]),
                (face(3), u[2] * v[0]),
            ]);
        }
        Ok(())
    }

    /// The inner points of an edge with a positive interval.
    fn side(&self, layout: &Layout<'_>, half: u32, targets: &mut [[f64; D]]) {
        let net = &self.net.net;
        let topology = net.topology();
        let mut line = Vec::new();
        layout.line(&self.points, half, 0, &mut line);
        if let Some(twin) = topology.twin(half) {
            let opposite = |half: u32| topology.next(topology.next(half));
            let far = |half: u32| self.next(net.transversal(half), net.across(opposite(half)));
            let across = vertex::<f64>([far(twin), net.transversal(twin), net.transversal(half), far(half)]);
            let (mut left, mut right) = (Vec::new(), Vec::new());
            layout.line(&self.points, half, 1, &mut left);
            layout.line(&self.points, twin, 1, &mut right);
            for ((own, left), right) in line.iter_mut().zip(&left).zip(right.iter().rev()) {
                *own = combined([(right, across[0]), (&*own, across[1]), (left, across[2])]);
            }
        }
        let intervals = [net.behind(half), net.interval(half), net.beyond(half)];
        along(&line, &weights(self.n, intervals), targets);
    }

    /// The inner points of a block, row by row.
    fn inner(&self, layout: &Layout<'_>, face: u32, targets: &mut [[f64; D]]) {
        let net = &self.net.net;
        // quads have four half-edges in a row
        let first = net.topology().face_halves(face).start;
        let in_s = weights(
            self.n,
            [net.across(first + 3), net.interval(first), net.across(first + 1)],
        );
        let in_t = weights(
            self.n,
            [net.across(first), net.interval(first + 1), net.across(first + 2)],
        );
        let width = in_s.len();
        // the rows that a row reads, three at a time
        let mut rows = [0; 3].map(|_| vec![[0.0; D]; width]);
        let (mut row, mut known) = (Vec::new(), 0);
        for ((targets, weights), k) in targets.chunks_exact_mut(width).zip(&in_t).zip(1..) {
            let from = first_source(k);
            let count = 3 - k % 2;
            while known < from + count {
                row.clear();
                layout.row(&self.points, face, known, &mut row);
                along(&row, &in_s, &mut rows[known % 3]);
                known += 1;
            }
            let [a, b, c] = [0, 1, 2].map(|i| &rows[(from + i) % 3][..width]);
            let [wa, wb, wc] = *weights;
            let sources = targets.iter_mut().zip(a).zip(b);
            if count == 2 {
                for ((target, a), b) in sources {
                    *target = std::array::from_fn(|d| wa * a[d] + wb * b[d]);
                }
            } else {
                for (((target, a), b), c) in sources.zip(c) {
                    *target = std::array::from_fn(|d| wa * a[d] + wb * b[d] + wc * c[d]);
                }
            }
        }
    }

    /// The faces, of each block row by row and in the order of those of the net, with other points.
    ///
    /// # Errors
    /// [`eigenring_surface::Error::TooLarge`] beyond indices of 32 bits.
    pub fn mesh(&self, points: Vec<Point3<f64>>) -> Result<Mesh, Error> {
        Ok(self.layout(self.n).mesh(points)?)
    }

    /// The edges with their intervals.
    pub fn intervals(&self) -> Vec<([u32; 2], f64)> {
        let (layout, net) = (self.layout(self.n), &self.net.net);
        let topology = net.topology();
        let mut found = Vec::new();
        let mut line = |half: u32, q: usize| {
            let parts = layout.parts(half);
            let interval = net.interval(half) / parts as f64;
            for p in 0..parts {
                let [a, b] = [p, p + 1].map(|p| layout.at(half, p, q) as u32);
                found.push(([a.min(b), a.max(b)], interval));
            }
        };
        for edge in 0..topology.edge_count() as u32 {
            line(topology.half_of_edge(edge), 0);
        }
        for face in (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) == 4) {
            let first = topology.face_halves(face).start;
            for half in [first, first + 1] {
                (1..layout.parts(half + 1)).for_each(|q| line(half, q));
            }
        }
        found
    }
}

impl Blocks<'_, 3> {
    /// The mesh of the last level.
    ///
    /// # Errors
    /// As [`Blocks::mesh`].
    pub fn into_mesh(self) -> Result<Mesh, Error> {
        let layout = self.layout(self.n);
        Ok(layout.mesh(self.points.into_iter().map(Point3::from).collect())?)
    }
}
