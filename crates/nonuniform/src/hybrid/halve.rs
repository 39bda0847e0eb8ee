//! Later levels of HNUSS (Li, Wei and Zhang 2019, section 3): positive intervals are halved.
//!
//! A quad with zero intervals in both directions stays, one with zero intervals in one direction becomes two,
//! others four; n-gons stay. Corners of n-gons have the rule of [`NGon`], all other points the tensor product
//! of [univariate rules](eigenring_spline::intervals), which holds with zero intervals as it stands. Points
//! of vertices come first, those of edges next, in the order of the edges, then those of faces.

use super::HybridNet;
use crate::{Error, KnotIntervals, NGon, Net, Step};
use eigenring_scheme::Table;
use eigenring_spline::intervals::{edge, vertex};
use eigenring_surface::{Mesh, NONE, Point3, Topology};

impl HybridNet {
    /// The net after one halving, with its points as rows over the points before.
    ///
    /// # Errors
    /// Those of [`NGon::new`] with a corner of the face; tables of more than 32 bits.
    pub fn halved(&self) -> Result<(Table<f64>, HybridNet), Error> {
        let Step { table, net } = self.step()?;
        Ok((table, HybridNet::known(net)))
    }

    fn step(&self) -> Result<Step, Error> {
        let net = &self.net;
        let topology = net.topology();
        let [vertices, edges, faces] = [topology.vertex_count(), topology.edge_count(), topology.face_count()];
        // n-gons of more corners than a vertex has neighbours are few
        let mut table = Table::with_capacity(vertices + edges + faces, 9 * vertices + 6 * edges + 4 * faces);
        for number in 0..topology.vertex_count() as u32 {
            match self.corners[number as usize] {
                Some(half) => self.corner(&mut table, half)?,
                None => self.vertex(&mut table, number)?,
            }
        }
        let mut count = topology.vertex_count() as u32;
        let mut numbered = |wanted: bool| {
            count += u32::from(wanted);
            if wanted { count - 1 } else { NONE }
        };
        let positive = |half: u32| net.interval(half) > 0.0;
        let mut edges = Vec::with_capacity(topology.edge_count());
        for number in 0..topology.edge_count() as u32 {
            let half = topology.half_of_edge(number);
            edges.push(numbered(positive(half)));
            if positive(half) {
                self.edge(&mut table, half)?;
            }
        }
        let mut faces = Vec::with_capacity(topology.face_count());
        for number in 0..topology.face_count() as u32 {
            let half = topology.face_halves(number).start;
            let split = topology.face_size(number) == 4 && positive(half) && positive(half + 1);
            faces.push(numbered(split));
            if split {
                self.face(&mut table, half)?;
            }
        }
        table.shrink();
        Ok(Step {
            table,
            net: self.split(count, &edges, &faces)?,
        })
    }

    /// A corner of an n-gon, from which `half` leaves around it.
    fn corner(&self, table: &mut Table<f64>, half: u32) -> Result<(), Error> {
        let topology = self.net.topology();
        let face = topology.face(half);
        let halves = topology.face_halves(face);
        // each corner makes the weights of all: n is small, and corners are few
        let ngon = NGon::new(&self.spokes(face)).map_err(|error| self.net.error_at(error, topology.origin(half)))?;
        let own = (half - halves.start) as usize;
        let terms = halves
            .enumerate()
            .map(|(j, half)| (topology.origin(half), ngon.weight(own, j)));
        Ok(table.push(terms)?)
    }

    fn vertex(&self, table: &mut Table<f64>, number: u32) -> Result<(), Error> {
        let net = &self.net;
        let topology = net.topology();
        let first = topology.first_spoke(number).expect("points of a net belong to faces");
        let line = |ahead: u32, back: u32| {
            vertex::<f64>([
                net.beyond(back),
                net.interval(back),
                net.interval(ahead),
                net.beyond(ahead),
            ])
        };
        if net.is_on_boundary(number) {
            let mut last = first;
            while let Some(next) = topology.turned(last) {
                last = next;
            }
            if last == first {
                return Ok(table.push([(number, 1.0)])?);
            }
            let arrives = topology.previous(last);
            let [before, own, after] = vertex::<f64>([
                net.behind(arrives),
                net.interval(arrives),
                net.interval(first),
                net.beyond(first),
            ]);
            let terms = [
                (topology.origin(arrives), before),
                (number, own),
                (topology.head(first), after),
            ];
            return Ok(table.push(terms.into_iter().filter(|(_, weight)| *weight != 0.0))?);
        }
        let turned = |spoke: u32| topology.turned(spoke).expect("an inner vertex is closed");
        let s1 = turned(first);
        let s2 = turned(s1);
        let s3 = turned(s2);
        debug_assert!(turned(s3) == first, "inner vertices of a hybrid net have valence 4");
        let u = line(first, s2);
        let v = line(s1, s3);
        let (head, face) = (
            |spoke: u32| topology.head(spoke),
            |spoke: u32| topology.head(topology.next(spoke)),
        );
        let terms = [
            (number, u[1] * v[1]),
            (head(first), u[2] * v[1]),
            (head(s1), u[1] * v[2]),
            (head(s2), u[0] * v[1]),
            (head(s3), u[1] * v[0]),
            (face(first), u[2] * v[2]),
            (face(s1), u[0] * v[2]),
            (face(s2), u[0] * v[0]),
            (face(s3), u[2] * v[0]),
        ];
        Ok(table.push(terms.into_iter().filter(|(_, weight)| *weight != 0.0))?)
    }

    fn edge(&self, table: &mut Table<f64>, half: u32) -> Result<(), Error> {
        let net = &self.net;
        let topology = net.topology();
        let [near, far] = edge::<f64>([net.behind(half), net.interval(half), net.beyond(half)]);
        let [start, end] = topology.ends(half);
        let Some(twin) = topology.twin(half) else {
            return Ok(table.push([(start, near), (end, far)])?);
        };
        let opposite = |half: u32| topology.next(topology.next(half));
        let (left, right) = (opposite(half), opposite(twin));
        let [r, own, l] = vertex::<f64>([
            net.across(right),
            net.transversal(twin),
            net.transversal(half),
            net.across(left),
        ]);
        let terms = [
            (start, own * near),
            (end, own * far),
            (topology.head(left), l * near),
            (topology.origin(left), l * far),
            (topology.origin(right), r * near),
            (topology.head(right), r * far),
        ];
        Ok(table.push(terms.into_iter().filter(|(_, weight)| *weight != 0.0))?)
    }

    fn face(&self, table: &mut Table<f64>, half: u32) -> Result<(), Error> {
        let net = &self.net;
        let topology = net.topology();
        // quads have four half-edges in a row
        let [s0, s1] = edge::<f64>([net.across(half + 3), net.interval(half), net.across(half + 1)]);
        let [t0, t1] = edge::<f64>([net.across(half), net.interval(half + 1), net.across(half + 2)]);
        let corner = |k: u32| topology.origin(half + k);
        let terms = [
            (corner(0), s0 * t0),
            (corner(1), s1 * t0),
            (corner(2), s1 * t1),
            (corner(3), s0 * t1),
        ];
        Ok(table.push(terms)?)
    }

    fn split(&self, count: u32, edges: &[u32], faces: &[u32]) -> Result<Net, Error> {
        let net = &self.net;
        let topology = net.topology();
        let mut mesh = Mesh::of_points(vec![Point3::origin(); count as usize]);
        let mut intervals = Vec::with_capacity(4 * topology.half_count());
        let edge_point = |half: u32| edges[topology.edge(half) as usize];
        for (number, &middle) in (0..).zip(faces) {
            let halves = topology.face_halves(number);
            let start = halves.start;
            let corner = |k: u32| topology.origin(start + k % 4);
            let d = |k: u32| net.interval(start + k % 4);
            if middle != NONE {
                for k in 0..4 {
                    let (own, before) = (start + k, start + (k + 3) % 4);
                    mesh.push_face(&[corner(k), edge_point(own), middle, edge_point(before)])?;
                    intervals.extend([0.5 * d(k), 0.5 * d(k + 1), 0.5 * d(k), 0.5 * d(k + 1)]);
                }
                continue;
            }
            let direction = (0..2).find(|&k| halves.len() == 4 && d(k) > 0.0);
            match direction {
                Some(k) => {
                    // halves k and k+2 are cut, the others have no width
                    let (one, other) = (edge_point(start + k), edge_point(start + (k + 2) % 4));
                    mesh.push_face(&[corner(k), one, other, corner(k + 3)])?;
                    mesh.push_face(&[one, corner(k + 1), corner(k + 2), other])?;
                    let half = 0.5 * d(k);
                    intervals.extend([half, 0.0, half, 0.0, half, 0.0, half, 0.0]);
                }
                None => {
                    let corners: Vec<u32> = halves.map(|half| topology.origin(half)).collect();
                    mesh.push_face(&corners)?;
                    intervals.extend(corners.iter().map(|_| 0.0));
                }
            }
        }
        let fine = Topology::unchecked(&mesh);
        let known = KnotIntervals::known(&fine, |half| intervals[half as usize]);
        Ok(Net::known(mesh, fine, known).of_new_vertices())
    }
}
