//! Exact points and first derivatives of HNUSS surfaces.
//!
//! *Elements* are the quads of the hybrid net with positive intervals, with natural parameters `0 <= u <= d`
//! from a corner along the edge that leaves it, and v along the edge that arrives. An element without a
//! corner on an n-gon is a bicubic [patch](patch). One with such a corner is halved twice; what is left at
//! the corner is an element of the n-gon's [neighbourhood](corner), where three of four children are patches
//! at every level.
//!
//! Surfaces are C1 across doubled lines within two edges of an extraordinary vertex, C2 elsewhere, and G1 at
//! the vertex itself.

mod corner;
pub mod elements;
mod patch;
pub mod vertices;

use crate::{Error, FirstLevel, HybridNet, Outside, Place, Refinement, Scheme};
use corner::Corner;
use eigenring_surface::{Mesh, Point3, Vector3};
use patch::Jet;

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point.
    pub position: Point3<f64>,
    /// Derivatives by the natural parameters; at an extraordinary vertex there are none.
    pub derivatives: Option<[Vector3<f64>; 2]>,
    /// The unit normal, unless the tangent plane is not determined.
    pub normal: Option<Vector3<f64>>,
}

/// The HNUSS surface of a control mesh.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The hybrid net, and the nets after one and two halvings.
    levels: Vec<Level>,
    /// Vertices, and faces as vertices, with the simple rule for want of an eigen-polyhedron.
    pub simple: Vec<Place>,
    /// Whether faces were split by a level of NURSS first.
    split: bool,
}

/// A net with its points in homogeneous coordinates.
#[derive(Clone, Debug)]
struct Level {
    net: HybridNet,
    points: Vec<[f64; 4]>,
    /// For each face the first of its children.
    children: Vec<u32>,
}

/// For each face of a net the first of its children after a halving.
fn children(net: &HybridNet) -> Vec<u32> {
    let topology = net.net().topology();
    let mut children = Vec::with_capacity(topology.face_count());
    let mut count = 0;
    for face in 0..topology.face_count() as u32 {
        children.push(count);
        let half = topology.face_halves(face).start;
        let cut = |half: u32| topology.face_size(face) == 4 && net.net().interval(half) > 0.0;
        count += match (cut(half), cut(half + 1)) {
            (true, true) => 4,
            (false, false) => 1,
            _ => 2,
        };
    }
    children
}

impl Level {
    fn new(net: HybridNet, points: Vec<[f64; 4]>) -> Self {
        let children = children(&net);
        Level { net, points, children }
    }

    fn halved(&self) -> Result<Self, Error> {
        let (table, net) = self.net.halved()?;
        Ok(Level::new(net, table.apply(&self.points)?))
    }
}

impl Surface {
    /// The surface of a mesh. Two halvings of its hybrid net are kept, of sixteen times as many faces.
    ///
    /// # Errors
    /// Those of [`Refinement`].
    pub fn new(mesh: &Mesh, rule: FirstLevel, outside: Outside) -> Result<Self, Error> {
        let refinement = Refinement::new(mesh, Scheme::Hnuss(rule), outside)?;
        let mesh = mesh.without_unused();
        let points: Vec<[f64; 4]> = (0..mesh.points().len())
            .map(|i| {
                let (p, w) = (mesh.points()[i], mesh.weights().map_or(1.0, |weights| weights[i]));
                [w * p.x, w * p.y, w * p.z, w]
            })
            .collect();
        let points = refinement.apply(&points)?;
        let net = refinement.hybrid().expect("HNUSS has a hybrid net").clone();
        let first = Level::new(net, points);
        let second = first.halved()?;
        let third = second.halved()?;
        Ok(Surface {
            levels: vec![first, second, third],
            split: refinement.is_split(),
            simple: refinement.simple,
        })
    }

    /// The hybrid net, whose first faces are those of the mesh, or of the mesh of quads that NURSS made of
    /// it.
    pub fn net(&self) -> &HybridNet {
        &self.levels[0].net
    }

    /// Whether faces were split by a level of NURSS before the hybrid net was made.
    pub fn is_split(&self) -> bool {
        self.split
    }

    /// The sides of an element, in natural parameters.
    ///
    /// # Errors
    /// [`Error::Range`] for a face that is none, or has no area.
    pub fn sides(&self, face: u32) -> Result<[f64; 2], Error> {
        let net = self.net().net();
        let topology = net.topology();
        let is_quad = (face as usize) < topology.face_count() && topology.face_size(face) == 4;
        let sides = is_quad
            .then(|| topology.face_halves(face).start)
            .map(|half| [half, half + 1].map(|h| net.interval(h)));
        sides
            .filter(|sides| sides[0] > 0.0 && sides[1] > 0.0)
            .ok_or_else(|| Error::Range {
                what: "face",
                given: face.to_string(),
                accepted: "a quad of the hybrid net with positive knot intervals".to_owned(),
            })
    }

    /// The point of an element at natural parameters.
    ///
    /// # Errors
    /// [`Error::Range`].
    pub fn at(&self, face: u32, u: f64, v: f64) -> Result<Sample, Error> {
        let sides = self.sides(face)?;
        for (what, x, side) in [("parameter u", u, sides[0]), ("parameter v", v, sides[1])] {
            if !(0.0..=side).contains(&x) {
                return Err(Error::Range {
                    what,
                    given: x.to_string(),
                    accepted: format!("0 to {side}"),
                });
            }
        }
        Ok(self.jet(0, face, [u, v])?.sample())
    }

    /// The point of an element of a level.
    fn jet(&self, level: usize, face: u32, [u, v]: [f64; 2]) -> Result<Jet, Error> {
        let own = &self.levels[level];
        let net = own.net.net();
        let topology = net.topology();
        let start = topology.face_halves(face).start;
        let Some(corner) = (0..4).find(|&k| own.net.ngon_at(topology.origin(start + k)).is_some()) else {
            return Ok(patch::regular(net, &own.points, start, [u, v]));
        };
        let sides = [net.interval(start), net.interval(start + 1)];
        if level + 1 < self.levels.len() {
            let child = match (u < 0.5 * sides[0], v < 0.5 * sides[1]) {
                (true, true) => 0,
                (false, true) => 1,
                (false, false) => 2,
                (true, false) => 3,
            };
            let jet = self.jet(
                level + 1,
                own.children[face as usize] + child,
                turned([u, v], sides, child),
            )?;
            return Ok(jet.turned(child));
        }
        let half = own
            .net
            .ngon_at(topology.origin(start + corner))
            .expect("it was found there");
        let sector = half - topology.face_halves(topology.face(half)).start;
        let neighbourhood = Corner::new(&own.net, topology.face(half), 0)?;
        let jet = neighbourhood.at(&own.points, sector as usize, turned([u, v], sides, corner));
        Ok(jet.turned(corner))
    }

    /// The point and normal of an extraordinary vertex, by its n-gon in the hybrid net.
    ///
    /// # Errors
    /// [`Error::Range`] for a face that is no n-gon.
    pub fn centre(&self, ngon: u32) -> Result<Sample, Error> {
        let own = &self.levels[0];
        let topology = own.net.net().topology();
        if ngon as usize >= topology.face_count() || topology.face_size(ngon) == 4 {
            return Err(Error::Range {
                what: "face",
                given: ngon.to_string(),
                accepted: "an n-gon of the hybrid net".to_owned(),
            });
        }
        Ok(corner::centre(&own.net, &own.points, ngon)?.sample())
    }
}

/// Parameters from corner k of an element with these sides, along the edge that leaves it.
fn turned([u, v]: [f64; 2], [a, b]: [f64; 2], corner: u32) -> [f64; 2] {
    match corner {
        0 => [u, v],
        1 => [v, a - u],
        2 => [a - u, b - v],
        _ => [b - v, u],
    }
}
