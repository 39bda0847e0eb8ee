//! Hybrid nets: the net that HNUSS makes of a mesh first, and its refinement.
//!
//! All inner vertices of a hybrid net have valence 4. Its faces are quads, of which some have zero intervals
//! in one direction (a doubled line) or in both (where two such lines cross), and extraordinary n-gons, one
//! for each irregular vertex of the mesh.

mod blocks;
mod convert;
mod halve;

pub use blocks::Blocks;

use crate::{Error, FirstLevel, Net, Place};
use eigenring_scheme::Table;

/// What is done where the eigen-polyhedron, on which the rules `printed` and `improved` rest, does not exist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// The mesh is refused.
    #[default]
    Error,
    /// The simple rule is taken at these vertices.
    Simple,
}

/// The net of HNUSS.
#[derive(Clone, Debug)]
pub struct HybridNet {
    net: Net,
    /// The faces that are no quads, by corner: for each vertex the half-edge of an n-gon that leaves it.
    corners: Vec<Option<u32>>,
}

/// A hybrid net, with its points as rows over those of the mesh.
#[derive(Clone, Debug)]
pub struct Converted {
    /// One row for each point of the net.
    pub table: Table<f64>,
    /// The net.
    pub net: HybridNet,
    /// Vertices of the mesh where the simple rule was taken because there is no eigen-polyhedron.
    pub simple: Vec<Place>,
}

impl HybridNet {
    /// The hybrid net of a mesh of quads. The faces of the mesh come first, in their order; then the doubled
    /// edges, in that of the edges; then the extraordinary n-gons and the crossings of doubled lines, in that
    /// of the vertices.
    ///
    /// # Errors
    /// [`Error::Vertex`] for faces that are no quads and for extraordinary vertices on the boundary or with
    /// less than three edges, [`Error::ZeroSum`] where a rule divides by zero, [`Error::ZeroSpokes`], and
    /// where `outside` does not allow for it [`Error::OutsideDomain`].
    pub fn of(net: &Net, rule: FirstLevel, outside: Outside) -> Result<Converted, Error> {
        convert::convert(net, rule, outside)
    }

    /// The net itself, if it is a hybrid net already, such as one that was written and is read again: one
    /// with n-gons whose corners are inner vertices, whose edges have zero intervals and lie beside quads,
    /// and all whose inner vertices have valence 4. Of no other mesh could these n-gons be refined: a level
    /// of NURSS would leave a vertex with zero intervals at all its spokes.
    pub fn again(net: &Net) -> Option<Self> {
        let topology = net.topology();
        let regular = |vertex: u32| match net.is_on_boundary(vertex) {
            true => net.valence(vertex) <= 3,
            false => net.valence(vertex) == 4,
        };
        let in_place = |half: u32| {
            let beside = topology.twin(half).map(|twin| topology.face_size(topology.face(twin)));
            net.interval(half) == 0.0 && beside == Some(4) && !net.is_on_boundary(topology.origin(half))
        };
        let hybrid = HybridNet::known(net.clone());
        let ngons: Vec<u32> = hybrid.extraordinary_faces().collect();
        let is_one = !ngons.is_empty()
            && ngons.iter().all(|&face| topology.face_halves(face).all(in_place))
            && (0..topology.vertex_count() as u32).all(regular)
            && net.marked().next().is_none();
        is_one.then_some(hybrid)
    }

    /// A net that is known to be a hybrid net: its faces that are no quads are n-gons.
    pub fn known(net: Net) -> Self {
        let topology = net.topology();
        let mut corners = vec![None; topology.vertex_count()];
        for face in (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) != 4) {
            for half in topology.face_halves(face) {
                corners[topology.origin(half) as usize] = Some(half);
            }
        }
        HybridNet { net, corners }
    }

    /// Its faces and intervals.
    pub fn net(&self) -> &Net {
        &self.net
    }

    /// The extraordinary faces.
    pub fn extraordinary_faces(&self) -> impl Iterator<Item = u32> + '_ {
        let topology = self.net.topology();
        (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) != 4)
    }

    /// The half-edge of the n-gon that leaves a vertex, if the vertex is a corner of one.
    pub fn ngon_at(&self, vertex: u32) -> Option<u32> {
        self.corners[vertex as usize]
    }

    /// The intervals of the spokes of an n-gon: spoke i lies across its half-edge i-1, from corner i-1 to
    /// corner i, so that corner i has spokes i and i+1.
    pub fn spokes(&self, face: u32) -> Vec<f64> {
        let halves = self.net.topology().face_halves(face);
        let n = halves.len() as u32;
        let before = |i: u32| halves.start + (i + n - 1) % n;
        (0..n).map(|i| self.net.across(before(i))).collect()
    }
}
