//! The space of one level of a scheme with knot intervals: the functions of all points of its net.
//!
//! Elements are the faces with an area; strips of no width, which hybrid nets have, carry none, but their
//! points have functions. Regular elements have knot intervals of their own, those at extraordinary faces of
//! HNUSS and at extraordinary vertices of the others consist of pieces of many levels ([`Element`]). A second
//! layer of ghosts, which no function of an element reads, carries the intervals that the boundary mirrors.

use crate::Error;
use crate::cells::{Cells, Kind};
use crate::space::{Corner, Edge, Ends, Space, extended, transforms};
use eigenring_nonuniform::{Element, HybridNet, Net, Refinement, VertexElements, grid};
use eigenring_surface::features::edge;
use eigenring_surface::{Point3, Topology};
use std::collections::{BTreeMap, HashMap};

/// The intervals of the first two edges that lead inward from a boundary vertex, towards each of its inner
/// neighbours.
type Inward = HashMap<u32, Vec<[f64; 2]>>;

fn inward(net: &Net, layers: &[(u32, Corner)]) -> Inward {
    let topology = net.topology();
    let of = |(v, corner): &(u32, Corner)| {
        let fan = topology.fan(*v);
        let first = |half: u32| [net.interval(half), net.beyond(half)];
        let pairs = match (corner, fan.last) {
            (Corner::Two(..), Some(last)) => vec![first(fan.spokes[0]), [net.interval(last), net.behind(last)]],
            _ => vec![first(fan.spokes[1])],
        };
        (*v, pairs)
    };
    layers.iter().map(of).collect()
}

/// A net with two layers of ghosts.
struct Ghosts {
    net: Net,
    /// The first layer, and the points with it.
    layers: Vec<(u32, Corner)>,
    points: Vec<Point3<f64>>,
    inward: Inward,
}

fn with_ghosts(net: &Net, points: &[[f64; 3]]) -> Result<Ghosts, Error> {
    let mesh = net.with_points(points.iter().map(|p| Point3::from(*p)).collect(), None);
    let (first, layers) = extended(&mesh, net.topology())?;
    let inward = inward(net, &layers);
    let (mut second, outer) = extended(&first, &Topology::unchecked(&first))?;
    let mut knots = mesh.features.knots.clone();
    // the interval beyond each ghost, by the vertex that it continues
    let mut beyond: HashMap<u32, f64> = HashMap::new();
    for (v, corner) in &layers {
        let pairs = &inward[v];
        let ghosts = match *corner {
            Corner::One(_, ghost) => vec![ghost],
            Corner::Two(_, [west, _, south]) => vec![west, south],
        };
        for (ghost, [own, next]) in ghosts.into_iter().zip(pairs) {
            knots.insert(edge(*v, ghost), *own);
            beyond.insert(ghost, *next);
        }
    }
    for (ghost, corner) in &outer {
        if let (Corner::One(_, last), Some(interval)) = (corner, beyond.get(ghost)) {
            knots.insert(edge(*ghost, *last), *interval);
        }
    }
    second.features.knots = knots;
    Ok(Ghosts {
        net: Net::new(&second)?,
        layers,
        points: first.points().to_vec(),
        inward,
    })
}

/// An element with its points; `None` beside what is too close.
type Found = Option<(Vec<u32>, Element)>;

/// The space over the last net of a refinement, so many levels after the first; `None` if boundaries or
/// extraordinary vertices or faces are too close to each other.
pub(crate) fn space(
    refinement: &Refinement,
    points: &[[f64; 3]],
    halvings: usize,
    ends: Ends,
) -> Result<Option<Space>, Error> {
    let own = refinement.net();
    let coarse = own.topology();
    let Ghosts {
        net,
        layers,
        points: full,
        inward,
    } = with_ghosts(own, points)?;
    let extended = HybridNet::known(net);
    let vertices = VertexElements::new(extended.net(), refinement.scheme());
    let is_element = |face: u32| refinement.hybrid().is_none_or(|hybrid| hybrid.is_element(face));
    let element = |face: u32| -> Result<Found, Error> {
        Ok(match refinement.hybrid() {
            Some(_) => Some(extended.element(face, halvings)?),
            None => vertices.element(face)?,
        })
    };
    let topology = extended.net().topology();
    let mut boundary = vec![false; full.len()];
    layers.iter().for_each(|(v, _)| boundary[*v as usize] = true);
    for number in 0..coarse.edge_count() as u32 {
        let [a, b] = coarse.edge_points(number);
        if !coarse.is_boundary(number) && boundary[a as usize] && boundary[b as usize] {
            return Ok(None);
        }
    }
    if inward.values().flatten().any(|[first, _]| *first == 0.0) {
        return Err(Error::Combination {
            what: "a knot interval of zero across a boundary",
            accepted: "a positive one",
        });
    }
    let (mut cells, mut elements) = (Cells::default(), Vec::<Element>::new());
    let mut known: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
    for face in (0..coarse.face_count() as u32).filter(|&face| is_element(face)) {
        let Some((points, element)) = element(face)? else {
            return Ok(None);
        };
        if points.iter().any(|&v| v as usize >= full.len()) {
            return Ok(None);
        }
        let next = elements.len();
        let place = match element.key() {
            Some(key) => *known.entry(key).or_insert(next),
            None => next,
        };
        if place == next {
            elements.push(element);
        }
        cells.push(face, Kind::Element(place), &points);
    }
    let mut edges = Vec::new();
    for half in (0..coarse.half_count() as u32).filter(|&half| coarse.twin(half).is_none()) {
        let face = coarse.face(half);
        if own.interval(half) == 0.0 {
            continue;
        }
        let (Some((_, element)), Some(points)) = (element(face)?, grid(topology, half)) else {
            return Ok(None);
        };
        // one at an extraordinary vertex, or beside one, has several
        let [piece] = &element.pieces(1).0[..] else {
            return Ok(None);
        };
        let [u, v] = piece.intervals;
        let turned = |mut five: [f64; 5]| {
            five.reverse();
            five
        };
        let intervals = match half - coarse.face_halves(face).start {
            0 => [u, v],
            1 => [v, turned(u)],
            2 => [turned(u), turned(v)],
            _ => [turned(v), u],
        };
        edges.push(Edge {
            points,
            intervals: Some(intervals),
        });
    }
    let ratio = |v: u32, direction: usize| {
        let [first, second] = inward[&v][direction];
        (first + second) / first
    };
    let Some([transform, inverse]) = transforms(full.len(), &layers, ends, ratio) else {
        return Ok(None);
    };
    Ok(Some(Space {
        planar: full.iter().all(|p| p.z == 0.0),
        positions: full.iter().map(|p| [p.x, p.y, p.z]).collect(),
        cells,
        inner: points.len(),
        boundary,
        transform,
        inverse,
        layers,
        edges,
        around: BTreeMap::new(),
        elements,
    }))
}
