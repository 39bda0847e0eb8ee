//! One level of NURSS, and of subdivision by eigen-polyhedra, on a mesh.
//!
//! Every face is split as by Catmull-Clark, zero intervals too. In this order, with the averages that
//! [`Net::behind`] takes,
//!
//! * **face points** of quads are bilinear, with univariate weights in both directions; at an irregular
//!   corner the interval behind it is the mean of both sides, and with two of them at one end the mean of
//!   these. Of other faces they are the mean of the corners;
//! * **edge points** are half the point M on the edge, and half the mean of the face points beside it, each
//!   weighed by the interval of the other face. On a boundary they are M;
//! * **vertex points** are the univariate rule of edge points across a line and of M along it (Eq. 3); at
//!   irregular vertices Eq. 7, on boundaries the curve's rule, and a vertex of one face stays.
//!
//! Eigen-polyhedra replace points V, `E_i` and `F_i` around irregular vertices, from the second level on.
//! Face points are read by all rules around; the vertex point of `E_i` reads the edge points across its spoke
//! and never that of the spoke.

use crate::row::Row;
use crate::{EigenPolyhedron, Error, KnotIntervals, Net, nurss};
use eigenring_scheme::Table;
use eigenring_spline::intervals::edge;
use eigenring_surface::{Topology, quads};

/// One level: the points that it makes as rows over the points before, and the net of them.
#[derive(Clone, Debug)]
pub struct Step {
    /// One row for each point of the net.
    pub table: Table<f64>,
    /// The refined net.
    pub net: Net,
}

/// One level of NURSS.
///
/// # Errors
/// [`Error::ZeroSum`] where a rule divides by intervals that are all zero.
pub fn nurss_step(net: &Net) -> Result<Step, Error> {
    Primal::new(net).step(false)
}

/// One level by eigen-polyhedra: not the first one, which is that of NURSS.
///
/// # Errors
/// As [`nurss_step`], those of [`EigenPolyhedron::new`] with the vertex, and [`Error::Vertex`] for faces that
/// are no quads.
pub fn eigen_polyhedron_step(net: &Net) -> Result<Step, Error> {
    net.check_quads()?;
    Primal::new(net).step(true)
}

struct Primal<'a> {
    net: &'a Net,
    faces: Vec<Row>,
    /// The points M on the edges.
    middles: Vec<Row>,
    edges: Vec<Row>,
    /// For each vertex that has an irregular neighbour, the spoke towards it.
    towards: Vec<Option<u32>>,
    irregular: Vec<u32>,
}

impl<'a> Primal<'a> {
    fn new(net: &'a Net) -> Self {
        let topology = net.topology();
        let mut towards = vec![None; topology.vertex_count()];
        let irregular: Vec<u32> = (0..topology.vertex_count() as u32)
            .filter(|&v| net.is_irregular(v))
            .collect();
        for &vertex in &irregular {
            for spoke in topology.fan(vertex).spokes {
                towards[topology.head(spoke) as usize] = topology.twin(spoke);
            }
        }
        let middle = |number: u32| {
            let half = topology.half_of_edge(number);
            let [near, far] = edge::<f64>([net.behind(half), net.interval(half), net.beyond(half)]);
            Row::of([(topology.origin(half), near), (topology.head(half), far)])
        };
        let edges = 0..topology.edge_count() as u32;
        let mut primal = Primal {
            net,
            faces: Vec::new(),
            middles: edges.map(middle).collect(),
            edges: Vec::new(),
            towards,
            irregular,
        };
        primal.faces = (0..topology.face_count() as u32)
            .map(|face| primal.face(face))
            .collect();
        primal
    }

    fn face(&self, face: u32) -> Row {
        let topology = self.net.topology();
        let halves: Vec<u32> = topology.face_halves(face).collect();
        let &[h0, h1, h2, h3] = halves.as_slice() else {
            let weight = 1.0 / halves.len() as f64;
            return Row::of(halves.iter().map(|&half| (topology.origin(half), weight)));
        };
        let s = self.weight([h0, h1, h2, h3]);
        let t = self.weight([h1, h2, h3, h0]);
        let corner = |half: u32| topology.origin(half);
        Row::of([
            (corner(h0), (1.0 - s) * (1.0 - t)),
            (corner(h1), s * (1.0 - t)),
            (corner(h2), s * t),
            (corner(h3), (1.0 - s) * t),
        ])
    }

    /// The weight towards the far ends in the direction of the first half-edge of a quad.
    fn weight(&self, [along, far, back, near]: [u32; 4]) -> f64 {
        let net = self.net;
        let irregular = |half: u32| net.is_irregular(net.topology().origin(half));
        let mean = |side: u32, corners: [Option<f64>; 2]| match corners {
            [None, None] => net.across(side),
            [Some(one), None] | [None, Some(one)] => one,
            [Some(one), Some(two)] => 0.5 * (one + two),
        };
        let before = mean(
            near,
            [
                irregular(along).then(|| net.behind(along)),
                irregular(near).then(|| net.beyond(back)),
            ],
        );
        let after = mean(
            far,
            [
                irregular(far).then(|| net.beyond(along)),
                irregular(back).then(|| net.behind(back)),
            ],
        );
        edge::<f64>([before, net.interval(along), after])[1]
    }

    fn edge(&self, number: u32) -> Result<Row, Error> {
        let (net, topology) = (self.net, self.net.topology());
        let half = topology.half_of_edge(number);
        let middle = &self.middles[number as usize];
        let Some(twin) = topology.twin(half) else {
            return Ok(middle.clone());
        };
        let [own, other] = [half, twin].map(|half| net.transversal(half));
        if own + other == 0.0 {
            let irregular = |half: &u32| net.is_irregular(topology.origin(*half));
            return match [half, twin].into_iter().find(irregular) {
                Some(spoke) => {
                    let vertex = topology.origin(spoke);
                    let [left, right] = [topology.turned(spoke), topology.turned_back(spoke)];
                    let end = |half: Option<u32>| half.map_or(vertex, |half| topology.head(half));
                    Err(Error::ZeroSum {
                        what: format!(
                            "edges {} and {}",
                            net.edge_in_words(vertex, end(right)),
                            net.edge_in_words(vertex, end(left))
                        ),
                        rule: "the edge point between them",
                    })
                }
                None => Ok(middle.clone()),
            };
        }
        let mut row = Row::default();
        row.add(0.5, middle);
        let sum = 2.0 * (own + other);
        row.add(other / sum, &self.faces[topology.face(half) as usize]);
        row.add(own / sum, &self.faces[topology.face(twin) as usize]);
        Ok(row)
    }

    /// A vertex that is regular or on the boundary.
    fn vertex(&self, vertex: u32) -> Row {
        let (net, topology) = (self.net, self.net.topology());
        let fan = topology.fan(vertex);
        let edge_of = |spoke: u32| topology.edge(spoke) as usize;
        // half the own row and half the mean of those before and after
        let line = |own: &Row, [first, second]: [u32; 2], rows: &[Row]| {
            let [d, e] = [first, second].map(|half| net.interval(half));
            if d + e == 0.0 {
                return own.clone();
            }
            let mut row = Row::default();
            row.add(0.5, own);
            row.add(e / (2.0 * (d + e)), &rows[edge_of(first)]);
            row.add(d / (2.0 * (d + e)), &rows[edge_of(second)]);
            row
        };
        let own = Row::unit(vertex);
        if let Some(last) = fan.last {
            return match fan.spokes.len() {
                1 => own,
                _ => line(&own, [fan.spokes[0], last], &self.middles),
            };
        }
        let first = self.towards[vertex as usize].unwrap_or(fan.spokes[0]);
        let at = fan.spokes.iter().position(|&spoke| spoke == first).unwrap_or(0);
        let spoke = |i: usize| fan.spokes[(at + i) % 4];
        let along = line(&own, [spoke(0), spoke(2)], &self.middles);
        line(&along, [spoke(1), spoke(3)], &self.edges)
    }

    /// Eq. 7.
    fn irregular_vertex(&self, vertex: u32, spokes: &[u32]) -> Result<Row, Error> {
        let (net, topology) = (self.net, self.net.topology());
        let n = spokes.len();
        let d = |i: usize| net.interval(spokes[i % n]);
        let f = |i: usize| d(i + n - 1) * d(i + 2);
        let mut sum = 0.0;
        let mut mean = Row::default();
        for (i, &spoke) in spokes.iter().enumerate() {
            let m = f(i) + f(i + n - 1);
            mean.add(m, &self.middles[topology.edge(spoke) as usize]);
            mean.add(f(i), &self.faces[topology.face(spoke) as usize]);
            sum += m + f(i);
        }
        if sum == 0.0 {
            let zeros: Vec<String> = spokes
                .iter()
                .filter(|&&spoke| net.interval(spoke) == 0.0)
                .map(|&spoke| net.edge_in_words(vertex, topology.head(spoke)))
                .collect();
            return Err(Error::ZeroSum {
                what: format!("edges {}", zeros.join(", ")),
                rule: "the vertex point",
            });
        }
        let size = n as f64;
        let mut row = Row::default();
        row.push(vertex, (size - 3.0) / size);
        row.add(3.0 / (size * sum), &mean);
        Ok(row)
    }

    /// Face points around irregular vertices by their eigen-polyhedra; edge points are returned, since no
    /// other rule reads them.
    fn replace_faces(&mut self) -> Result<Vec<(u32, Row)>, Error> {
        let topology = self.net.topology();
        let mut edges = Vec::new();
        for &vertex in &self.irregular {
            let spokes = topology.fan(vertex).spokes;
            let d: Vec<f64> = spokes.iter().map(|&spoke| self.net.interval(spoke)).collect();
            let matrix = EigenPolyhedron::new(&d).and_then(|polyhedron| polyhedron.matrix());
            let matrix = matrix.map_err(|error| self.net.error_at(error, vertex))?;
            let points = around(topology, vertex, &spokes);
            let order = nurss::Order { n: spokes.len() };
            let row = |i: usize| Row::of(points.iter().copied().zip(matrix.row(i).iter().copied()));
            for (i, &spoke) in (0..).zip(&spokes) {
                self.faces[topology.face(spoke) as usize] = row(order.face(i));
                edges.push((topology.edge(spoke), row(order.edge(i))));
            }
        }
        Ok(edges)
    }

    fn step(mut self, by_polyhedra: bool) -> Result<Step, Error> {
        let topology = self.net.topology();
        // irregular vertices read the face points of NURSS, all others those that are there in the end
        let irregular: Vec<Row> = self
            .irregular
            .iter()
            .map(|&vertex| self.irregular_vertex(vertex, &topology.fan(vertex).spokes))
            .collect::<Result<_, _>>()?;
        let replaced = if by_polyhedra {
            self.replace_faces()?
        } else {
            Vec::new()
        };
        let numbers = 0..topology.edge_count() as u32;
        self.edges = numbers.map(|number| self.edge(number)).collect::<Result<_, _>>()?;
        let mut irregular = irregular.into_iter();
        let mut vertices = Vec::with_capacity(topology.vertex_count());
        for vertex in 0..topology.vertex_count() as u32 {
            let own = if self.net.is_irregular(vertex) {
                irregular.next()
            } else {
                None
            };
            vertices.push(own.unwrap_or_else(|| self.vertex(vertex)));
        }
        for (edge, row) in replaced {
            self.edges[edge as usize] = row;
        }
        let mut table = Table::default();
        for row in vertices.iter().chain(&self.edges).chain(&self.faces) {
            table.push(row.terms())?;
        }
        Ok(Step {
            table,
            net: split(self.net)?,
        })
    }
}

/// The points V, E_0.., F_0.. around an inner vertex of quads.
pub(crate) fn around(topology: &Topology, vertex: u32, spokes: &[u32]) -> Vec<u32> {
    let faces = spokes.iter().map(|&spoke| topology.head(topology.next(spoke)));
    let edges = spokes.iter().map(|&spoke| topology.head(spoke));
    [vertex].into_iter().chain(edges).chain(faces).collect()
}

/// The net of quads: both halves of an edge have half its interval, an edge within a face half of the edge
/// that it runs along.
fn split(net: &Net) -> Result<Net, Error> {
    let mesh = quads(net.mesh(), net.topology());
    let topology = Topology::unchecked(&mesh);
    let intervals = KnotIntervals::known(&topology, |fine| {
        // the quad of a half-edge: corner, edge, face, edge before
        let half = fine / 4;
        0.5 * match fine % 4 {
            0 | 2 => net.interval(half),
            _ => net.transversal(half),
        }
    });
    let marked: Vec<u32> = net.marked().collect();
    Net::known(mesh, topology, intervals)
        .refined_from(net)
        .with_marked(&marked)
}
