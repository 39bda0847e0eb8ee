//! Which faces meet where: half-edges of a mesh without defects.
//!
//! The half-edge `h` is the corner of that number, counted through all faces: it starts at the corner's point
//! and leads to the face's next one, with the face on its left. Around a vertex, half-edges that leave it are
//! the spokes of [`eigenring_scheme`]'s fans, counter-clockwise; on a boundary the first one has nothing on
//! its right, and the last spoke is a half-edge that arrives, turned round.

use crate::{Defect, Mesh, features::edge};

/// No half-edge.
pub const NONE: u32 = u32::MAX;

/// The half-edges of a mesh.
#[derive(Clone, Debug)]
pub struct Topology {
    starts: Vec<u32>,
    origins: Vec<u32>,
    twins: Vec<u32>,
    faces: Vec<u32>,
    /// The number of the edge of each half-edge.
    edges: Vec<u32>,
    /// One half-edge of each edge: the first one.
    halves: Vec<u32>,
    /// For each vertex the first spoke, [`NONE`] if it belongs to no face.
    first: Vec<u32>,
}

/// The spokes and faces around a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct FanAt {
    /// Half-edges that leave the vertex, counter-clockwise: one for each face.
    pub spokes: Vec<u32>,
    /// On a boundary the half-edge that arrives at the end.
    pub last: Option<u32>,
}

impl FanAt {
    /// Whether the vertex is inside.
    pub fn is_closed(&self) -> bool {
        self.last.is_none()
    }
}

impl Topology {
    /// The half-edges of a mesh.
    ///
    /// # Errors
    /// All defects, if there are any.
    pub fn new(mesh: &Mesh) -> Result<Self, Vec<Defect>> {
        let defects = mesh.defects();
        if defects.is_empty() {
            Ok(Topology::unchecked(mesh))
        } else {
            Err(defects)
        }
    }

    /// The half-edges of a mesh that is known to be without defects, as one that was made from such is; of
    /// another one they make no sense.
    pub fn unchecked(mesh: &Mesh) -> Self {
        let (starts, origins) = (mesh.starts().to_vec(), mesh.corners().to_vec());
        let mut faces = Vec::with_capacity(origins.len());
        for face in 0..mesh.face_count() {
            faces.extend(std::iter::repeat_n(face as u32, mesh.face(face).len()));
        }
        let mut topology = Topology {
            twins: vec![NONE; origins.len()],
            edges: vec![NONE; origins.len()],
            halves: Vec::with_capacity(origins.len() / 2),
            first: vec![NONE; mesh.points().len()],
            starts,
            origins,
            faces,
        };
        topology.join();
        for half in 0..topology.origins.len() as u32 {
            if topology.edges[half as usize] == NONE {
                let number = topology.halves.len() as u32;
                topology.halves.push(half);
                topology.edges[half as usize] = number;
                if let Some(twin) = topology.twin(half) {
                    topology.edges[twin as usize] = number;
                }
            }
            let origin = topology.origin(half) as usize;
            // a half-edge without a twin is the first spoke of its vertex, else any of them
            if topology.first[origin] == NONE || topology.twin(half).is_none() {
                topology.first[origin] = half;
            }
        }
        topology
    }

    /// Finds the twins: half-edges in lists by their smaller end, and in each list by the other one.
    fn join(&mut self) {
        let mut ends = vec![0_u32; self.first.len() + 1];
        for half in 0..self.origins.len() as u32 {
            let [low, _] = self.pair(half);
            ends[low as usize + 1] += 1;
        }
        for vertex in 0..self.first.len() {
            ends[vertex + 1] += ends[vertex];
        }
        let mut lists = vec![(0_u32, 0_u32); self.origins.len()];
        let mut next = ends.clone();
        for half in 0..self.origins.len() as u32 {
            let [low, high] = self.pair(half);
            let at = &mut next[low as usize];
            lists[*at as usize] = (high, half);
            *at += 1;
        }
        for vertex in 0..self.first.len() {
            let list = &mut lists[ends[vertex] as usize..ends[vertex + 1] as usize];
            list.sort_unstable();
            for pair in list.windows(2) {
                if pair[0].0 == pair[1].0 {
                    self.twins[pair[0].1 as usize] = pair[1].1;
                    self.twins[pair[1].1 as usize] = pair[0].1;
                }
            }
        }
    }

    /// The ends of a half-edge, the smaller number first.
    fn pair(&self, half: u32) -> [u32; 2] {
        let [a, b] = self.ends(half);
        edge(a, b)
    }

    /// The number of vertices, unused ones included.
    pub fn vertex_count(&self) -> usize {
        self.first.len()
    }

    /// The number of edges.
    pub fn edge_count(&self) -> usize {
        self.halves.len()
    }

    /// The number of faces.
    pub fn face_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of half-edges: of corners of faces.
    pub fn half_count(&self) -> usize {
        self.origins.len()
    }

    /// Where a half-edge starts.
    #[inline]
    pub fn origin(&self, half: u32) -> u32 {
        self.origins[half as usize]
    }

    /// Where a half-edge leads to.
    #[inline]
    pub fn head(&self, half: u32) -> u32 {
        self.origin(self.next(half))
    }

    /// Both, the start first.
    #[inline]
    pub fn ends(&self, half: u32) -> [u32; 2] {
        [self.origin(half), self.head(half)]
    }

    /// The face of a half-edge.
    #[inline]
    pub fn face(&self, half: u32) -> u32 {
        self.faces[half as usize]
    }

    /// The half-edges of a face.
    #[inline]
    pub fn face_halves(&self, face: u32) -> std::ops::Range<u32> {
        self.starts[face as usize]..self.starts[face as usize + 1]
    }

    /// The number of corners of a face.
    #[inline]
    pub fn face_size(&self, face: u32) -> usize {
        self.face_halves(face).len()
    }

    /// The next half-edge of the face.
    #[inline]
    pub fn next(&self, half: u32) -> u32 {
        let range = self.face_halves(self.face(half));
        if half + 1 == range.end { range.start } else { half + 1 }
    }

    /// The half-edge before it.
    #[inline]
    pub fn previous(&self, half: u32) -> u32 {
        let range = self.face_halves(self.face(half));
        if half == range.start { range.end - 1 } else { half - 1 }
    }

    /// The half-edge on the other side; `None` on the boundary.
    #[inline]
    pub fn twin(&self, half: u32) -> Option<u32> {
        Some(self.twins[half as usize]).filter(|&twin| twin != NONE)
    }

    /// The number of a half-edge's edge.
    #[inline]
    pub fn edge(&self, half: u32) -> u32 {
        self.edges[half as usize]
    }

    /// The first half-edge of an edge.
    #[inline]
    pub fn half_of_edge(&self, edge: u32) -> u32 {
        self.halves[edge as usize]
    }

    /// The points of an edge, the smaller first.
    #[inline]
    pub fn edge_points(&self, number: u32) -> [u32; 2] {
        let [a, b] = self.ends(self.half_of_edge(number));
        edge(a, b)
    }

    /// Whether an edge has one face.
    pub fn is_boundary(&self, edge: u32) -> bool {
        self.twin(self.half_of_edge(edge)).is_none()
    }

    /// The next spoke counter-clockwise: `None` at the end of an open fan.
    #[inline]
    pub fn turned(&self, spoke: u32) -> Option<u32> {
        self.twin(self.previous(spoke))
    }

    /// The spoke before it.
    #[inline]
    pub fn turned_back(&self, spoke: u32) -> Option<u32> {
        self.twin(spoke).map(|twin| self.next(twin))
    }

    /// The first spoke of a vertex; `None` for an unused one.
    #[inline]
    pub fn first_spoke(&self, vertex: u32) -> Option<u32> {
        Some(self.first[vertex as usize]).filter(|&half| half != NONE)
    }

    /// The fan around a vertex, empty for an unused one.
    pub fn fan(&self, vertex: u32) -> FanAt {
        let mut fan = FanAt {
            spokes: Vec::new(),
            last: None,
        };
        let Some(first) = self.first_spoke(vertex) else {
            return fan;
        };
        let mut spoke = first;
        loop {
            fan.spokes.push(spoke);
            match self.turned(spoke) {
                Some(next) if next == first => return fan,
                Some(next) => spoke = next,
                None => {
                    fan.last = Some(self.previous(spoke));
                    return fan;
                }
            }
        }
    }

    /// The number of edges at each vertex, and whether the vertex is on the boundary.
    pub fn valences(&self) -> Vec<(usize, bool)> {
        let mut valences = vec![(0, false); self.vertex_count()];
        for edge in 0..self.edge_count() as u32 {
            for vertex in self.edge_points(edge) {
                valences[vertex as usize].0 += 1;
                valences[vertex as usize].1 |= self.is_boundary(edge);
            }
        }
        valences
    }

    /// As [`Topology::valences`], of a mesh that is known to be a surface.
    pub fn unchecked_valences(mesh: &Mesh) -> Vec<(usize, bool)> {
        Topology::unchecked(mesh).valences()
    }

    /// The number of the component of each face, counted in the order of faces, and how many there are.
    pub fn components(&self) -> (Vec<u32>, usize) {
        let mut numbers = vec![NONE; self.face_count()];
        let mut count = 0;
        let mut stack = Vec::new();
        for face in 0..self.face_count() {
            if numbers[face] != NONE {
                continue;
            }
            stack.push(face as u32);
            numbers[face] = count;
            while let Some(face) = stack.pop() {
                for half in self.face_halves(face) {
                    if let Some(twin) = self.twin(half) {
                        let other = self.face(twin);
                        if numbers[other as usize] == NONE {
                            numbers[other as usize] = count;
                            stack.push(other);
                        }
                    }
                }
            }
            count += 1;
        }
        (numbers, count as usize)
    }

    /// The lengths of the loops of boundary edges.
    pub fn boundary_loops(&self) -> Vec<usize> {
        let mut seen = vec![false; self.half_count()];
        let mut loops = Vec::new();
        for start in 0..self.half_count() as u32 {
            if self.twin(start).is_some() || seen[start as usize] {
                continue;
            }
            let (mut half, mut length) = (start, 0);
            while !seen[half as usize] {
                seen[half as usize] = true;
                length += 1;
                // the boundary goes on with the first spoke of the point that is reached
                half = self.first_spoke(self.head(half)).unwrap_or(start);
            }
            loops.push(length);
        }
        loops
    }
}
