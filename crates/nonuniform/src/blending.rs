//! Blending functions of extraordinary vertices, and how many maxima they have.
//!
//! The blending function of a vertex is the surface's height where the vertex has height 1 and all others 0.
//! It is taken at the vertices of a deep net, in their limits, and maxima are counted by *persistence*: a
//! maximum's depth is how far the function must fall on the way to a higher one. Small ones are rounding of
//! the net, so that a count is of those that are deeper than a given share of the highest value.

use crate::eigen_polyhedron::left_eigenvectors;
use crate::primal::around;
use crate::{EigenPolyhedron, Error, HybridNet, NGon, Net, Outside, Refinement, Scheme, Spokes, Star, nurss};
use eigenring_spline::intervals::limit;

/// Rings of faces around the vertex: its function reaches three at most.
const RINGS: usize = 4;

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
    /// The values at the vertices of the net.
    pub values: Vec<f64>,
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
        let pairs = spokes.intervals().iter().zip(spokes.next());
        let intervals: Vec<Vec<f64>> = pairs.map(|(&d, &a)| vec![d, a]).collect();
        let star = Star::new(&intervals, RINGS)?;
        let mut refinement = Refinement::new(star.mesh(), scheme, Outside::Error).map_err(Error::of_spokes)?;
        for _ in 0..levels {
            refinement.refine().map_err(Error::of_spokes)?;
        }
        let mut unit = vec![[0.0]; star.mesh().points().len()];
        unit[0] = [1.0];
        let points: Vec<f64> = refinement.apply(&unit)?.into_iter().map(|[x]| x).collect();
        let net = refinement.net();
        let hybrid = refinement.hybrid();
        let mut values = Vec::with_capacity(points.len());
        for vertex in 0..points.len() as u32 {
            values.push(value(scheme, net, hybrid, &points, vertex)?);
        }
        // vertices around a vertex keep its number; the corners of an n-gon have one limit
        let corner = hybrid.and_then(|net| (0..points.len()).find(|&v| net.ngon_at(v as u32).is_some()));
        Ok(Blending {
            centre: values[corner.unwrap_or(0)],
            peaks: peaks(net, &values),
            values,
        })
    }

    /// The maxima beside the highest one that are deeper than this share of it.
    pub fn others(&self, share: f64) -> impl Iterator<Item = &Peak> {
        let bound = share * self.peaks.first().map_or(0.0, |peak| peak.value);
        self.peaks.iter().skip(1).filter(move |peak| peak.depth > bound)
    }
}

/// The limit at a vertex; on the boundary, where the function has vanished, the point.
fn value(scheme: Scheme, net: &Net, hybrid: Option<&HybridNet>, points: &[f64], vertex: u32) -> Result<f64, Error> {
    let topology = net.topology();
    let at = |vertex: u32| points[vertex as usize];
    if net.is_on_boundary(vertex) {
        return Ok(at(vertex));
    }
    if let Some((hybrid, half)) = hybrid.and_then(|hybrid| Some((hybrid, hybrid.ngon_at(vertex)?))) {
        let face = topology.face(half);
        let weights = NGon::new(&hybrid.spokes(face))?.limit_weights();
        let corners = topology.face_halves(face).map(|half| at(topology.origin(half)));
        return Ok(corners.zip(weights).map(|(x, w)| x * w).sum());
    }
    let spokes = topology.fan(vertex).spokes;
    let places = around(topology, vertex, &spokes);
    if net.is_irregular(vertex) {
        let d: Vec<f64> = spokes.iter().map(|&spoke| net.interval(spoke)).collect();
        let weights = match scheme {
            Scheme::EigenPolyhedron => EigenPolyhedron::new(&d)?.limit_weights()?,
            _ => {
                let matrix = nurss::matrix::<f64>(&Spokes::stationary(d)?)?;
                let left = left_eigenvectors(&matrix, 1.0)?.swap_remove(0);
                let sum: f64 = left.iter().sum();
                left.into_iter().map(|w| w / sum).collect()
            }
        };
        return Ok(places.into_iter().zip(weights).map(|(place, w)| w * at(place)).sum());
    }
    let line = |ahead: u32, back: u32| {
        limit::<f64>([
            net.beyond(back),
            net.interval(back),
            net.interval(ahead),
            net.beyond(ahead),
        ])
    };
    let (u, v) = (line(spokes[0], spokes[2]), line(spokes[1], spokes[3]));
    // V, the ends of the spokes, the far corners of the faces between them
    let weights = [
        u[1] * v[1],
        u[2] * v[1],
        u[1] * v[2],
        u[0] * v[1],
        u[1] * v[0],
        u[2] * v[2],
        u[0] * v[2],
        u[0] * v[0],
        u[2] * v[0],
    ];
    Ok(places.into_iter().zip(weights).map(|(place, w)| w * at(place)).sum())
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
