//! A mesh with knot intervals, and what rules ask of it.

use crate::error::edge_between;
use crate::intervals::KnotIntervals;
use crate::{Error, Place, Spokes};
use eigenring_surface::{Features, Mesh, Point3, Topology};
use std::collections::BTreeSet;
use std::sync::Arc;

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
    origin: Origin,
}

/// What a net was made from, for messages.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origin {
    /// What the first vertices are; if unset, all are those of the mesh.
    places: Option<Arc<Vec<Place>>>,
    /// How often intervals were halved.
    halvings: i32,
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
                place: Place::Vertex(vertex),
                what: "has a crease or is marked as a corner".to_owned(),
                accepted: "are knot and extraordinary tags under schemes with knot intervals; zero intervals make creases",
            });
        }
        // edges belong to faces, so that they have the same numbers without unused vertices
        let given = features.knots.iter().map(|(&pair, &d)| (pair, d));
        let intervals = KnotIntervals::new(&Topology::unchecked(mesh), given)?;
        let unused = mesh.unused();
        let mesh = mesh.without_unused();
        let extraordinary: Vec<u32> = mesh.features.extraordinary.iter().copied().collect();
        let topology = Topology::unchecked(&mesh);
        let mut net = Net::known(mesh, topology, intervals);
        if !unused.is_empty() {
            let all = 0..(net.valences.len() + unused.len()) as u32;
            let used = all.filter(|vertex| unused.binary_search(vertex).is_err());
            net.origin.places = Some(Arc::new(used.map(Place::Vertex).collect()));
        }
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
            origin: Origin::default(),
        }
    }

    /// What a vertex is to whoever gave the mesh.
    pub fn place(&self, vertex: u32) -> Place {
        match &self.origin.places {
            None => Place::Vertex(vertex),
            Some(places) => places.get(vertex as usize).copied().unwrap_or(Place::New),
        }
    }

    /// An edge in words.
    pub(crate) fn edge_in_words(&self, from: u32, to: u32) -> String {
        edge_between([self.place(from), self.place(to)])
    }

    /// An error of the rules around a vertex in the words of the mesh that was given.
    pub(crate) fn error_at(&self, error: Error, vertex: u32) -> Error {
        let spokes = self.topology.fan(vertex).spokes.into_iter();
        let heads: Vec<Place> = spokes.map(|spoke| self.place(self.topology.head(spoke))).collect();
        error.at(self.place(vertex), &heads, self.origin.halvings)
    }

    /// This net as one that a level has made of another, whose vertices and faces have become its first and
    /// last vertices.
    pub(crate) fn refined_from(mut self, coarse: &Net) -> Self {
        self.origin = coarse.origin.clone();
        self.origin.halvings += 1;
        if coarse.origin.halvings == 0 {
            let topology = &coarse.topology;
            let vertices = (0..topology.vertex_count() as u32).map(|vertex| coarse.place(vertex));
            let edges = (0..topology.edge_count()).map(|_| Place::New);
            let faces = (0..topology.face_count() as u32).map(Place::Face);
            self.origin.places = Some(Arc::new(vertices.chain(edges).chain(faces).collect()));
        }
        self
    }

    /// This net as one whose vertices are all new.
    pub(crate) fn of_new_vertices(mut self) -> Self {
        self.origin.places = Some(Arc::new(Vec::new()));
        self
    }

    pub(crate) fn with_marked(mut self, vertices: &[u32]) -> Result<Self, Error> {
        for &vertex in vertices {
            if self.is_on_boundary(vertex) {
                return Err(Error::Vertex {
                    place: self.place(vertex),
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
        let mut part = Net::known(mesh, topology, known);
        let places = originals.iter().map(|&vertex| self.place(vertex)).collect();
        part.origin = Origin {
            places: Some(Arc::new(places)),
            halvings: self.origin.halvings,
        };
        Ok((part, originals))
    }

    /// Refuses faces that are no quads.
    pub(crate) fn check_quads(&self) -> Result<(), Error> {
        let topology = &self.topology;
        let odd = (0..topology.face_count() as u32).find(|&face| topology.face_size(face) != 4);
        match odd {
            None => Ok(()),
            Some(face) => Err(Error::Vertex {
                place: self.place(topology.origin(topology.face_halves(face).start)),
                what: format!("belongs to a face of {} corners", topology.face_size(face)),
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
