//! Bicubic patches of hybrid nets.

use super::Sample;
use crate::Net;
use eigenring_spline::intervals::basis;
use eigenring_surface::{Point3, Topology, Vector3};

/// A point in homogeneous coordinates with first derivatives, or with two tangents where there are none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub value: [f64; 4],
    pub first: [[f64; 4]; 2],
    /// Whether `first` are derivatives by the parameters.
    pub is_regular: bool,
}

impl Jet {
    /// The jet in the parameters of corner 0, if this one is in those of corner k.
    pub fn turned(self, corner: u32) -> Self {
        let [u, v] = self.first;
        let minus = |a: [f64; 4]| a.map(|x| -x);
        let first = match corner {
            0 => [u, v],
            1 => [minus(v), u],
            2 => [minus(u), minus(v)],
            _ => [v, minus(u)],
        };
        Jet { first, ..self }
    }

    /// The point in space.
    pub fn sample(self) -> Sample {
        let [x, y, z, w] = self.value;
        let position = Point3::new(x / w, y / w, z / w);
        let [u, v] = self
            .first
            .map(|[x, y, z, slope]| (Vector3::new(x, y, z) - slope * position.coords) / w);
        let normal = u.cross(&v);
        Sample {
            position,
            derivatives: self.is_regular.then_some([u, v]),
            normal: Some(normal.normalize()).filter(|n| n.iter().all(|x| x.is_finite())),
        }
    }
}

/// The patch of 4 x 4 points, by rows along u, with five intervals in each direction.
pub(super) fn evaluate(points: &[[[f64; 4]; 4]; 4], intervals: [[f64; 5]; 2], [u, v]: [f64; 2]) -> Jet {
    let [in_u, by_u, _] = basis(intervals[0], u);
    let [in_v, by_v, _] = basis(intervals[1], v);
    let combined = |a: &[f64; 4], b: &[f64; 4]| {
        let mut sum = [0.0; 4];
        for (row, wb) in points.iter().zip(b) {
            for (point, wa) in row.iter().zip(a) {
                for (sum, x) in sum.iter_mut().zip(point) {
                    *sum += wa * wb * x;
                }
            }
        }
        sum
    };
    Jet {
        value: combined(&in_u, &in_v),
        first: [combined(&by_u, &in_v), combined(&in_u, &by_v)],
        is_regular: true,
    }
}

/// The interval of the face across an edge and that beyond it: mirrored at boundaries.
fn two_across(net: &Net, half: u32) -> [f64; 2] {
    let topology = net.topology();
    let opposite = |half: u32| topology.next(topology.next(half));
    match topology.twin(half) {
        Some(twin) => [net.transversal(twin), net.across(opposite(twin))],
        None => [net.transversal(half), net.across(opposite(half))],
    }
}

/// The five intervals in both directions of a quad whose first half-edge is `start`.
pub(super) fn intervals(net: &Net, start: u32) -> [[f64; 5]; 2] {
    let five = |near: u32, far: u32, own: u32| {
        let ([a, b], [c, d]) = (two_across(net, near), two_across(net, far));
        [b, a, net.interval(own), c, d]
    };
    [five(start + 3, start + 1, start), five(start, start + 2, start + 1)]
}

/// The point of a quad without a corner on an n-gon, whose first half-edge is `start`.
pub(super) fn regular(net: &Net, points: &[[f64; 4]], start: u32, parameters: [f64; 2]) -> Jet {
    let topology = net.topology();
    let intervals = intervals(net, start);
    // rows k = -1 .. 2 of points j = -1 .. 2
    let middle = [
        row(topology, points, start),
        row(topology, points, topology.next(topology.next(start))),
    ];
    // the upper row was found from the other end
    let [lower, mut upper] = middle;
    upper.reverse();
    let outer = |half: u32, own: &[[f64; 4]; 4], other: &[[f64; 4]; 4], turned: bool| match topology.twin(half) {
        Some(twin) => {
            let mut found = row(topology, points, topology.next(topology.next(twin)));
            // seen from the neighbour the row runs as the edge does in this face
            if turned {
                found.reverse();
            }
            found
        }
        None => reflected(own, other),
    };
    let below = outer(start, &lower, &upper, false);
    let above = outer(start + 2, &upper, &lower, true);
    evaluate(&[below, lower, upper, above], intervals, parameters)
}

/// Points -1 .. 2 on the line of a half-edge of which points 0 and 1 are the ends.
fn row(topology: &Topology, points: &[[f64; 4]], half: u32) -> [[f64; 4]; 4] {
    let at = |vertex: u32| points[vertex as usize];
    let [a, b] = topology.ends(half).map(at);
    // straight on through the faces beside the line, on whichever side they are
    let ahead = beyond(topology, half).map_or_else(|| reflection(b, a), at);
    let back = before(topology, half).map_or_else(|| reflection(a, b), at);
    [back, a, b, ahead]
}

/// The vertex after the head of a half-edge, straight on.
fn beyond(topology: &Topology, half: u32) -> Option<u32> {
    let next = topology.next(half);
    let twin = topology.twin(next)?;
    Some(topology.head(topology.next(twin)))
}

/// The vertex before the start of a half-edge, straight back.
fn before(topology: &Topology, half: u32) -> Option<u32> {
    let previous = topology.previous(half);
    let twin = topology.twin(previous)?;
    Some(topology.origin(topology.previous(twin)))
}

fn reflection(at: [f64; 4], of: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|k| 2.0 * at[k] - of[k])
}

fn reflected(own: &[[f64; 4]; 4], other: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    std::array::from_fn(|i| reflection(own[i], other[i]))
}
