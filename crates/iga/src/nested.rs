//! The embedding of one level's space in the next.
//!
//! Refinement R of control points, ghosts included, is that of the scheme around extraordinary vertices and
//! the regular one elsewhere. In unknowns the embedding is `P = C_f^-1 R C_c`, C the transform of each
//! level's boundary.

use crate::Error;
use crate::space::{Corner, Space, extended, rings};
use crate::sparse::Sparse;
use eigenring_surface::{Mesh, Topology};

struct Coarse<'a> {
    space: &'a Space,
    topology: Topology,
}

type Row = Vec<(u32, f64)>;

impl Coarse<'_> {
    /// The valence of an extraordinary vertex.
    fn special(&self, v: u32) -> Option<usize> {
        let inside = (v as usize) < self.space.inner;
        let valence = inside.then(|| self.topology.fan(v).spokes.len())?;
        (valence != 4).then_some(valence)
    }

    /// The rule of the centre, the edge or the face (0, 1, 2) at a spoke of an extraordinary vertex.
    fn special_row(&self, kind: usize, spoke: u32, valence: usize) -> Row {
        let points = rings(&self.topology, spoke, valence, 1).expect("an inner vertex has its ring");
        let weights = self.space.around[&valence].rule(kind);
        points
            .into_iter()
            .zip(weights.iter().copied())
            .filter(|(_, w)| *w != 0.0)
            .collect()
    }

    fn vertex(&self, v: u32) -> Row {
        let spokes = self.topology.fan(v).spokes;
        if let Some(valence) = self.special(v) {
            return self.special_row(0, spokes[0], valence);
        }
        let around = |&spoke: &u32| {
            let diagonal = self.topology.head(self.topology.next(spoke));
            [(self.topology.head(spoke), 3.0 / 32.0), (diagonal, 1.0 / 64.0)]
        };
        std::iter::once((v, 9.0 / 16.0))
            .chain(spokes.iter().flat_map(around))
            .collect()
    }

    /// Of an edge with faces on both sides.
    fn edge(&self, half: u32) -> Row {
        let topology = &self.topology;
        let twin = topology.twin(half).expect("ghosts are around the boundary");
        for spoke in [half, twin] {
            if let Some(valence) = self.special(topology.origin(spoke)) {
                return self.special_row(1, spoke, valence);
            }
        }
        let side = |half: u32| {
            let next = topology.next(half);
            [
                (topology.origin(half), 0.375),
                (topology.head(next), 0.0625),
                (topology.origin(topology.previous(half)), 0.0625),
            ]
        };
        side(half).into_iter().chain(side(twin)).collect()
    }

    fn face(&self, half: u32) -> Row {
        let topology = &self.topology;
        let halves = topology.face_halves(topology.face(half));
        for spoke in halves.clone() {
            if let Some(valence) = self.special(topology.origin(spoke)) {
                return self.special_row(2, spoke, valence);
            }
        }
        halves.map(|half| (topology.origin(half), 0.25)).collect()
    }

    /// The half-edge from a vertex to a neighbour.
    fn spoke(&self, from: u32, to: u32) -> u32 {
        let spokes = self.topology.fan(from).spokes;
        let found = spokes.into_iter().find(|&spoke| self.topology.head(spoke) == to);
        found.expect("a ghost is a neighbour of its vertex")
    }
}

fn sparse(mut rows: Vec<Row>, width: usize) -> Sparse {
    rows.iter_mut()
        .for_each(|row| row.sort_unstable_by_key(|(column, _)| *column));
    Sparse::from_rows(&rows, width)
}

/// R over control points and ghosts. The finer mesh numbers vertices, then edges, then faces of the coarse.
pub(crate) fn refinement(mesh: &Mesh, space: &Space, fine: &Space) -> Result<Sparse, Error> {
    let own = Topology::new(mesh).map_err(eigenring_surface::Error::from)?;
    let (full, layers) = extended(mesh, &own)?;
    let coarse = Coarse {
        space,
        topology: Topology::unchecked(&full),
    };
    let vertices = own.vertex_count() as u32;
    let mut rows: Vec<Row> = (0..vertices).map(|v| coarse.vertex(v)).collect();
    rows.extend((0..own.edge_count() as u32).map(|edge| coarse.edge(own.half_of_edge(edge))));
    rows.extend((0..own.face_count() as u32).map(|face| coarse.face(own.face_halves(face).start)));
    rows.resize(fine.positions.len(), Row::new());
    let mut corners = vec![None; vertices as usize];
    layers
        .into_iter()
        .for_each(|(v, corner)| corners[v as usize] = Some(corner));
    for &(v, corner) in &fine.layers {
        match corner {
            Corner::One(_, ghost) if v >= vertices => {
                let twin = coarse.topology.twin(own.half_of_edge(v - vertices));
                rows[ghost as usize] = coarse.face(twin.expect("a ghost face is beyond"));
            }
            Corner::One(_, ghost) => {
                let Some(Corner::One(_, before)) = corners[v as usize] else {
                    unreachable!("a vertex keeps its faces")
                };
                rows[ghost as usize] = coarse.edge(coarse.spoke(v, before));
            }
            Corner::Two(_, [west, both, south]) => {
                let Some(Corner::Two(_, before)) = corners[v as usize] else {
                    unreachable!("a corner stays one")
                };
                let [to_west, to_south] = [before[0], before[2]].map(|ghost| coarse.spoke(v, ghost));
                rows[west as usize] = coarse.edge(to_west);
                rows[both as usize] = coarse.face(to_west);
                rows[south as usize] = coarse.edge(to_south);
            }
        }
    }
    Ok(sparse(rows, space.positions.len()))
}

/// P over unknowns.
pub(crate) fn embedding(mesh: &Mesh, space: &Space, fine: &Space) -> Result<Sparse, Error> {
    let refinement = refinement(mesh, space, fine)?;
    Ok(fine.inverse.product(&refinement.product(&space.transform)).pruned())
}
