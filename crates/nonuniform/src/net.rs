//! A mesh with knot intervals, and what rules ask of it.

use crate::intervals::KnotIntervals;
use crate::{Error, Spokes};
use eigenring_surface::{Features, Mesh, Point3, Topology};
use std::collections::BTreeSet;

/// A mesh with knot intervals on its edges; where its points are does not matter here.
#[derive(Clone, Debug)]
pub struct Net {
    mesh: Mesh,
    topology: Topology,
    intervals: KnotIntervals,
    /// For each vertex the number of its edges, and whether it is on the boundary.
    valences: Vec<(usize, bool)>,
    /// Inner vertices that are marked as extraordinary.
    marked: Vec<bool>,
}

impl Net {
    /// The net of a mesh with its marks: `knots` of its features are intervals. Points that belong to no face
    /// are left out.
    ///
    /// # Errors
    /// [`eigenring_surface::Error::Empty`] and `Defects` for what is no surface, those of
    /// [`KnotIntervals::new`], [`Error::Weight`], and [`Error::Vertex`] for marks that have no rule: creases,
    /// corners, and extraordinary vertices on the boundary.
    pub fn new(mesh: &Mesh) -> Result<Self, Error> {
        if mesh.face_count() == 0 {
            return Err(eigenring_surface::Error::Empty.into());
        }
        // what a mark says of no edge is told in the words of intervals
        let mut plain = mesh.clone();
        plain.features.knots.clear();
        Topology::new(&plain).map_err(eigenring_surface::Error::from)?;
        let mesh = mesh.without_unused();
        let topology = Topology::unchecked(&mesh);
        for (vertex, &value) in mesh.weights().unwrap_or_default().iter().enumerate() {
            if !(value.is_finite() && value > 0.0) {
                let vertex = vertex as u32;
                return Err(Error::Weight { vertex, value });
            }
        }
        let features = &mesh.features;
        let creased = features.creases.keys().map(|pair| pair[0]);
        if let Some(vertex) = creased.chain(features.corners.keys().copied()).next() {
            return Err(Error::Vertex {
                vertex,
                what: "has a crease or is marked as a corner".to_owned(),
                accepted: "are knot and extraordinary tags under schemes with knot intervals; zero intervals make creases",
            });
        }
        let intervals = KnotIntervals::new(&topology, features.knots.iter().map(|(&pair, &d)| (pair, d)))?;
        let extraordinary: Vec<u32> = features.extraordinary.iter().copied().collect();
        let net = Net::known(mesh, topology, intervals);
        net.with_marked(&extraordinary)
    }

    /// A net whose parts are known to fit.
    pub(crate) fn known(mesh: Mesh, topology: Topology, intervals: KnotIntervals) -> Self {
        let valences = topology.valences();
        Net {
            marked: vec![false; valences.len()],
            mesh,
            topology,
            intervals,
            valences,
        }
    }

    pub(crate) fn with_marked(mut self, vertices: &[u32]) -> Result<Self, Error> {
        for &vertex in vertices {
            if self.is_on_boundary(vertex) {
                return Err(Error::Vertex {
                    vertex,
                    what: "lies on the boundary and is marked as extraordinary".to_owned(),
                    accepted: "are inner vertices",
                });
            }
            self.marked[vertex as usize] = true;
        }
        Ok(self)
    }

    /// The faces around a vertex in so many rings as a net, with the numbers of its vertices in this one.
    pub(crate) fn part(&self, centre: u32, rings: usize) -> Result<(Net, Vec<u32>), Error> {
        let topology = &self.topology;
        let (mut vertices, mut faces) = (BTreeSet::from([centre]), BTreeSet::new());
        for _ in 0..rings {
            for &vertex in &vertices {
                let spokes = topology.fan(vertex).spokes;
                faces.extend(spokes.into_iter().map(|spoke| topology.face(spoke)));
            }
            let corners = faces.iter().flat_map(|&face| topology.face_halves(face));
            vertices.extend(corners.map(|half| topology.origin(half)));
        }
        let originals: Vec<u32> = vertices.into_iter().collect();
        let mut mesh = Mesh::of_points(vec![Point3::origin(); originals.len()]);
        let mut intervals = Vec::new();
        for &face in &faces {
            let halves = topology.face_halves(face);
            let number = |half: u32| originals.binary_search(&topology.origin(half)).unwrap_or(0) as u32;
            mesh.push_face(&halves.clone().map(number).collect::<Vec<u32>>())?;
            intervals.extend(halves.map(|half| self.interval(half)));
        }
        let topology = Topology::unchecked(&mesh);
        let known = KnotIntervals::known(&topology, |half| intervals[half as usize]);
        Ok((Net::known(mesh, topology, known), originals))
    }

    /// Refuses faces that are no quads.
    pub(crate) fn check_quads(&self) -> Result<(), Error> {
        let topology = &self.topology;
        let odd = (0..topology.face_count() as u32).find(|&face| topology.face_size(face) != 4);
        match odd {
            None => Ok(()),
            Some(face) => Err(Error::Vertex {
                vertex: topology.origin(topology.face_halves(face).start),
                what: format!("belongs to face {face} of {} corners", topology.face_size(face)),
                accepted: "are quads; one level of NURSS makes them of all faces",
            }),
        }
    }

    /// The faces, with points as they were given or unset.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Which faces meet where.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The intervals.
    pub fn intervals(&self) -> &KnotIntervals {
        &self.intervals
    }

    /// The mesh of these points, with its intervals as marks of all edges.
    pub fn with_points(&self, points: Vec<Point3<f64>>, weights: Option<Vec<f64>>) -> Mesh {
        let mut mesh = self.mesh.clone();
        mesh.points_mut().copy_from_slice(&points);
        if let Some(weights) = weights {
            mesh.set_weights(weights);
        }
        let edges = 0..self.topology.edge_count() as u32;
        mesh.features = Features {
            knots: edges
                .map(|edge| (self.topology.edge_points(edge), self.intervals.of_edge(edge)))
                .collect(),
            extraordinary: self.marked().collect(),
            ..Features::default()
        };
        mesh
    }

    /// The vertices that are marked as extraordinary.
    pub(crate) fn marked(&self) -> impl Iterator<Item = u32> + '_ {
        let marked = self.marked.iter().enumerate();
        marked.filter(|(_, marked)| **marked).map(|(vertex, _)| vertex as u32)
    }

    /// The number of edges of a vertex.
    pub fn valence(&self, vertex: u32) -> usize {
        self.valences[vertex as usize].0
    }

    /// Whether a vertex is on the boundary.
    pub fn is_on_boundary(&self, vertex: u32) -> bool {
        self.valences[vertex as usize].1
    }

    /// Whether a vertex is an inner one of valence other than 4.
    pub fn is_irregular(&self, vertex: u32) -> bool {
        let (valence, boundary) = self.valences[vertex as usize];
        !boundary && valence != 4
    }

    /// Whether a vertex is irregular, or marked as extraordinary.
    pub fn is_extraordinary(&self, vertex: u32) -> bool {
        self.is_irregular(vertex) || self.marked[vertex as usize]
    }

    /// The interval of a half-edge.
    pub fn interval(&self, half: u32) -> f64 {
        self.intervals.of_edge(self.topology.edge(half))
    }

    /// The interval of the face of a half-edge across it: of the face's edges before and after.
    pub fn transversal(&self, half: u32) -> f64 {
        self.interval(self.topology.previous(half))
    }

    /// The interval of the neighbouring face across the edge: beyond a boundary the face's own, mirrored.
    /// This gives every interval that regular rules need.
    pub fn across(&self, half: u32) -> f64 {
        self.transversal(self.topology.twin(half).unwrap_or(half))
    }

    /// The interval that continues a half-edge backward, beyond its start: the mean of the values across the
    /// faces on both sides, on a boundary that of the next boundary edge, mirrored at a vertex of one face.
    pub fn behind(&self, half: u32) -> f64 {
        let topology = &self.topology;
        match topology.twin(half) {
            Some(twin) => {
                let left = self.across(topology.previous(half));
                let right = self.across(topology.next(twin));
                0.5 * (left + right)
            }
            None => match topology.turned(half) {
                None => self.interval(half),
                Some(mut spoke) => {
                    while let Some(next) = topology.turned(spoke) {
                        spoke = next;
                    }
                    self.interval(topology.previous(spoke))
                }
            },
        }
    }

    /// The interval that continues a half-edge forward, beyond its end.
    pub fn beyond(&self, half: u32) -> f64 {
        let topology = &self.topology;
        if let Some(twin) = topology.twin(half) {
            return self.behind(twin);
        }
        let next = topology.next(half);
        match topology.twin(next) {
            None => self.interval(half),
            Some(_) => {
                let first = topology.first_spoke(topology.head(half));
                self.interval(first.expect("a vertex of a face has a spoke"))
            }
        }
    }

    /// The intervals around an inner vertex, in the order of its spokes.
    ///
    /// # Errors
    /// Those of [`Spokes::new`].
    pub fn spokes(&self, spokes: &[u32]) -> Result<Spokes, Error> {
        Spokes::new(
            spokes.iter().map(|&spoke| self.interval(spoke)).collect(),
            spokes.iter().map(|&spoke| self.beyond(spoke)).collect(),
        )
    }
}
