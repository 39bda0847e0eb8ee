//! Knot intervals on the edges of a mesh.

use crate::error::{Error, Marked};
use eigenring_scheme::is_interval;
use eigenring_surface::Topology;

/// One interval for each edge: 0 or 1e-60 to 1e60, and the same on opposite edges of a quad, that is on
/// each *strip* of quads. Around a face of another size the edges before and after each edge have one
/// interval, since its split makes them opposite.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotIntervals {
    by_edge: Vec<f64>,
}

impl KnotIntervals {
    /// The intervals that are given for some edges, by their points: one value on a strip holds for all of
    /// it, and strips without a value have 1.
    ///
    /// # Errors
    /// [`Error::NoSuchEdge`], [`Error::Interval`], [`Error::Conflict`] for two values on one strip,
    /// [`Error::OpenStrip`] around faces that are no quads.
    pub fn new(topology: &Topology, given: impl IntoIterator<Item = ([u32; 2], f64)>) -> Result<Self, Error> {
        let strips = Strips::new(topology);
        let mut known: Vec<Option<Marked>> = vec![None; topology.edge_count()];
        for (edge, value) in given {
            let Some(number) = find(topology, edge) else {
                return Err(Error::NoSuchEdge(edge));
            };
            if !is_interval(value) {
                return Err(Error::Interval {
                    what: format!("edge {}-{}", edge[0], edge[1]),
                    value,
                });
            }
            let marked = Marked { edge, value };
            match &mut known[strips.root(number) as usize] {
                Some(before) if before.value != value => return Err(Error::Conflict(*before, marked)),
                slot => *slot = Some(slot.unwrap_or(marked)),
            }
        }
        let edges = 0..topology.edge_count() as u32;
        let value = |edge: u32| known[strips.root(edge) as usize].map_or(1.0, |marked| marked.value);
        let intervals = KnotIntervals {
            by_edge: edges.map(value).collect(),
        };
        intervals.check_faces(topology)?;
        Ok(intervals)
    }

    /// Intervals that are known to fit, by the numbers of the edges.
    pub(crate) fn known(topology: &Topology, by_half: impl Fn(u32) -> f64) -> Self {
        let halves = (0..topology.edge_count() as u32).map(|edge| topology.half_of_edge(edge));
        KnotIntervals {
            by_edge: halves.map(by_half).collect(),
        }
    }

    fn check_faces(&self, topology: &Topology) -> Result<(), Error> {
        for face in (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) != 4) {
            for half in topology.face_halves(face) {
                let other = topology.next(topology.next(half));
                let [first, second] = [half, other].map(|half| Marked {
                    edge: topology.edge_points(topology.edge(half)),
                    value: self.of_edge(topology.edge(half)),
                });
                if first.value != second.value {
                    return Err(Error::OpenStrip {
                        face,
                        size: topology.face_size(face),
                        first,
                        second,
                    });
                }
            }
        }
        Ok(())
    }

    /// The interval of an edge by its number in the topology.
    pub fn of_edge(&self, edge: u32) -> f64 {
        self.by_edge[edge as usize]
    }
}

/// The number of the edge between two points.
fn find(topology: &Topology, [a, b]: [u32; 2]) -> Option<u32> {
    if a.max(b) as usize >= topology.vertex_count() {
        return None;
    }
    let fan = topology.fan(a);
    let leaves = fan.spokes.iter().find(|&&spoke| topology.head(spoke) == b);
    let arrives = fan.last.filter(|&last| topology.origin(last) == b);
    leaves.copied().or(arrives).map(|half| topology.edge(half))
}

/// Edges that are opposite in quads, joined (union by the smaller number, with halved paths).
struct Strips {
    parents: Vec<u32>,
}

impl Strips {
    fn new(topology: &Topology) -> Self {
        let mut strips = Strips {
            parents: (0..topology.edge_count() as u32).collect(),
        };
        for face in (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) == 4) {
            let start = topology.face_halves(face).start;
            for half in [start, start + 1] {
                let [a, b] = [half, half + 2].map(|half| topology.edge(half));
                let [a, b] = [a, b].map(|edge| strips.compressed(edge));
                strips.parents[a.max(b) as usize] = a.min(b);
            }
        }
        strips
    }

    fn compressed(&mut self, mut edge: u32) -> u32 {
        while self.parents[edge as usize] != edge {
            let above = self.parents[edge as usize];
            self.parents[edge as usize] = self.parents[above as usize];
            edge = above;
        }
        edge
    }

    fn root(&self, mut edge: u32) -> u32 {
        while self.parents[edge as usize] != edge {
            edge = self.parents[edge as usize];
        }
        edge
    }
}
