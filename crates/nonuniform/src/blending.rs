//! Blending functions of extraordinary vertices, and how many maxima they have.
//!
//! The blending function of a vertex is the surface's height where the vertex has height 1 and all others 0.
//! It is taken at the vertices of a deep net, in their limits, and maxima are counted by *persistence*: a
//! maximum's depth is how far the function must fall on the way to a higher one. Small ones are rounding of
//! the net, so that a count is of those that are deeper than a given share of the highest value.

use crate::{Error, Limits, Net, Outside, Refinement, Scheme, Spokes, Star};

/// Rings of faces around the vertex: its function reaches three at most.
const RINGS: usize = 3;

/// A maximum of a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The value there.
    pub value: f64,
    /// How far the function falls on the way to a higher maximum; of the highest one its own value.
    pub depth: f64,
}

/// The blending function of an extraordinary vertex at the vertices of a net.
#[derive(Clone, Debug)]
pub struct Blending {
    net: Net,
    /// Vertices of the net before all levels.
    coarse: u32,
    /// The graph of the function at the vertices of the net: z over the limit (x, y) of a star in the plane,
    /// whose edges are one long and whose spokes are at equal angles.
    pub graph: Vec<[f64; 3]>,
    /// The value at the extraordinary vertex.
    pub centre: f64,
    /// The maxima, by falling depth.
    pub peaks: Vec<Peak>,
}

impl Blending {
    /// The function of a vertex with these intervals under a scheme, on the net after so many levels.
    ///
    /// # Errors
    /// Those of [`Refinement`].
    pub fn new(scheme: Scheme, spokes: &Spokes, levels: usize) -> Result<Self, Error> {
        scheme.check(spokes)?;
        let pairs = spokes.intervals().iter().zip(spokes.next());
        let intervals: Vec<Vec<f64>> = pairs.map(|(&d, &a)| vec![d, a]).collect();
        let star = Star::new(&intervals, RINGS)?;
        let mut refinement = Refinement::new(star.mesh(), scheme, Outside::Error).map_err(Error::of_spokes)?;
        let coarse = refinement.net().topology().vertex_count() as u32;
        for _ in 0..levels {
            refinement.refine().map_err(Error::of_spokes)?;
        }
        let mut control = star.in_the_plane();
        control[0][2] = 1.0;
        let points = refinement.apply(&control)?;
        let limits = Limits::new(&refinement).map_err(Error::of_spokes)?;
        let graph: Vec<[f64; 3]> = limits.of(&points)?.into_iter().map(|[point, ..]| point).collect();
        let (net, hybrid) = (refinement.net(), refinement.hybrid());
        // vertices around a vertex keep its number; the corners of an n-gon have one limit
        let corner = hybrid.and_then(|net| (0..graph.len()).find(|&v| net.ngon_at(v as u32).is_some()));
        let values: Vec<f64> = graph.iter().map(|point| point[2]).collect();
        Ok(Blending {
            centre: values[corner.unwrap_or(0)],
            peaks: peaks(net, &values),
            net: net.clone(),
            coarse,
            graph,
        })
    }

    /// The faces of the graph that have an area, by their points.
    pub fn quads(&self) -> impl Iterator<Item = [u32; 4]> + '_ {
        let topology = self.net.topology();
        (0..topology.face_count() as u32).filter_map(|face| {
            let halves = topology.face_halves(face);
            let start = halves.start;
            let has_area = halves.len() == 4 && [start, start + 1].iter().all(|&half| self.net.interval(half) > 0.0);
            has_area.then(|| [0, 1, 2, 3].map(|k| topology.origin(start + k)))
        })
    }

    /// The edges of the net before all levels, as points of the graph.
    pub fn lines(&self) -> Vec<Vec<u32>> {
        let topology = self.net.topology();
        let mut lines = Vec::new();
        for half in 0..topology.half_count() as u32 {
            let from = topology.origin(half);
            if from >= self.coarse || self.net.interval(half) == 0.0 {
                continue;
            }
            let (mut line, mut at) = (vec![from], half);
            loop {
                line.push(topology.head(at));
                if topology.head(at) < self.coarse {
                    break;
                }
                // straight on, along the boundary too
                let next = topology.next(at);
                at = topology.twin(next).map_or(next, |twin| topology.next(twin));
            }
            // a line is met from both ends, unless it runs along the boundary
            let ends = [line[0], line[line.len() - 1]];
            if topology.twin(half).is_none() || ends[0] < ends[1] {
                lines.push(line);
            }
        }
        lines
    }

    /// The maxima beside the highest one that are deeper than this share of it.
    pub fn others(&self, share: f64) -> impl Iterator<Item = &Peak> {
        let bound = share * self.peaks.first().map_or(0.0, |peak| peak.value);
        self.peaks.iter().skip(1).filter(move |peak| peak.depth > bound)
    }
}

/// The maxima of values at the vertices of a net, where the vertices of a face are neighbours: vertices are
/// added by falling value, and where two hills meet the lower one ends.
fn peaks(net: &Net, values: &[f64]) -> Vec<Peak> {
    let topology = net.topology();
    let mut order: Vec<u32> = (0..values.len() as u32).collect();
    order.sort_by(|&a, &b| values[b as usize].total_cmp(&values[a as usize]).then(a.cmp(&b)));
    // for each vertex one above it on its hill, the top of a hill being its own
    let mut above: Vec<Option<u32>> = vec![None; values.len()];
    let mut found = Vec::new();
    for vertex in order {
        let mut top = vertex;
        above[vertex as usize] = Some(vertex);
        for spoke in topology.fan(vertex).spokes {
            for half in topology.face_halves(topology.face(spoke)) {
                let Some(mut other) = above[topology.origin(half) as usize] else {
                    continue;
                };
                while let Some(next) = above[other as usize].filter(|&next| next != other) {
                    other = next;
                }
                if other == top {
                    continue;
                }
                let (low, high) = match values[other as usize] > values[top as usize] {
                    true => (top, other),
                    false => (other, top),
                };
                let depth = values[low as usize] - values[vertex as usize];
                if depth > 0.0 {
                    let value = values[low as usize];
                    found.push(Peak { value, depth });
                }
                above[low as usize] = Some(high);
                top = high;
            }
        }
    }
    let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    found.push(Peak {
        value: highest,
        depth: highest,
    });
    found.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    found
}
