//! Exact points of the limit surface, with derivatives and curvature, anywhere.
//!
//! **Isolation.** The faces around a face are refined, not the mesh, until the face's support is regular, or
//! has one irregular centre at a corner of the face and refinement reproduces it (`local.rs`). **Regular**
//! patches are bicubic B-splines, continued by reflection at boundaries and creases (`patch.rs`). **Beside a
//! centre** at depth m the control points are never multiplied out and differenced: they are kept as
//! `1 p + lambda^m R a + T`, p the limit of the centre, a its tangents, T the rest, which is projected free
//! of both at every level (`centre.rs`). In the frame of the tangent plane, with x and y divided by
//! `lambda^m` and z by `lambda^2m`, nothing cancels and nothing underflows down to parameters of 1e-18 and
//! below.

mod centre;
mod dual;
mod evaluate;
mod local;
mod patch;
mod vertices;

pub use evaluate::{Evaluator, Kind, Sample, Undefined};
pub use vertices::{Rule, VertexFan};

use crate::active::Ends;
use crate::refine::step;
use crate::refiner::{Refiner, RulesOn};
use crate::rules::{Method, Rules};
use crate::{Error, Mesh, Topology};
use centre::Centre;
use nalgebra::Point3;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// A place on a surface: a face of the control mesh and parameters.
///
/// On quads `s` runs along the first edge and `t` towards the last vertex, or likewise from `corner`. Other
/// faces consist of quads around their corners: `sub` is the corner at (0, 0), (1, 0) is the middle of the
/// edge that leaves it, (1, 1) the middle of the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The face.
    pub face: u32,
    /// For faces that are no quads the corner.
    pub sub: u32,
    /// For quads the corner from which parameters count.
    pub corner: u32,
    /// Along the edge that leaves the corner, 0 to 1.
    pub s: f64,
    /// Along the edge that ends there, 0 to 1.
    pub t: f64,
}

/// A subdivision surface.
#[derive(Debug)]
pub struct Surface<'a> {
    rules: &'a Rules,
    ends: Ends,
    control: Mesh,
    /// The mesh on which evaluation starts: quads whose special vertices lie apart.
    base: Mesh,
    topology: Topology,
    /// Of dual schemes the points of the base, one for each face.
    values: Option<Vec<Point3<f64>>>,
    /// How many levels the base is finer than the control mesh.
    lift: usize,
    /// What is known of irregular centres, by the structure around them.
    centres: Mutex<HashMap<local::Key, Arc<Centre>>>,
}

impl<'a> Surface<'a> {
    /// The surface of a control mesh.
    ///
    /// # Errors
    /// [`Error::Defects`] for what is no surface; [`Error::NoRule`] for schemes other than bicubic ones of
    /// levels that are alike.
    pub fn new(mesh: &Mesh, rules: &'a Rules) -> Result<Self, Error> {
        if mesh.face_count() == 0 {
            return Err(Error::Empty);
        }
        Topology::new(mesh)?;
        match rules.method()? {
            Method::Bicubic => {}
            Method::Even { order: 4, u0: 1.0 } => {}
            Method::Odd { u0: 1.0 } if rules.inner(None, 4)?.limit().passes().len() == 1 => {
                return Surface::dual(mesh, rules);
            }
            _ => {
                return Err(Error::NoRule {
                    what: format!("no exact limits of {}", rules.definition().name()),
                    elements: "any face".to_owned(),
                    accepted: "are catmull-clark, the lambda-scheme, doo-sabin, orders 3 and 4 at u0 = 1, and bicubic scheme files"
                        .to_owned(),
                });
            }
        }
        let refiner = Refiner::new(rules);
        let ends = refiner.ends(mesh);
        let (mut base, mut lift) = (mesh.clone(), 0);
        loop {
            let topology = Topology::unchecked(&base);
            let on_base = refiner.rules_on(&base, &topology)?;
            let polygons = !base.is_quads();
            if matches!(on_base, RulesOn::Own(_)) && !polygons {
                return Ok(Surface {
                    rules,
                    ends,
                    control: mesh.clone(),
                    base,
                    topology,
                    values: None,
                    lift,
                    centres: Mutex::default(),
                });
            }
            if ends == Ends::Open && !topology.boundary_loops().is_empty() {
                return Err(Error::NoRule {
                    what: "a shrinking boundary under limits".to_owned(),
                    elements: "the boundary".to_owned(),
                    accepted: "are boundary edge and corner".to_owned(),
                });
            }
            base = step(&base, &topology, on_base.get(), lift, ends)?.mesh;
            lift += 1;
        }
    }

    /// The surface of corner cutting: the base are the quarters of faces, each with the point that the first
    /// level gives its corner.
    fn dual(mesh: &Mesh, rules: &'a Rules) -> Result<Self, Error> {
        let control = Topology::unchecked(mesh);
        if !control.boundary_loops().is_empty() || !mesh.features.is_empty() {
            return Err(Error::NoRule {
                what: format!(
                    "no exact limits of {} beside boundaries and creases",
                    rules.definition().name()
                ),
                elements: "an open or creased mesh".to_owned(),
                accepted: "are closed meshes without marks".to_owned(),
            });
        }
        let base = crate::refine::quads(mesh, &control);
        let topology = Topology::unchecked(&base);
        Ok(Surface {
            rules,
            ends: Ends::Open,
            control: mesh.clone(),
            base,
            topology,
            values: Some(crate::dual_block::first_points(mesh, &control, rules)?),
            lift: 1,
            centres: Mutex::default(),
        })
    }

    /// The control mesh.
    pub fn control(&self) -> &Mesh {
        &self.control
    }

    /// The rules.
    pub fn rules(&self) -> &Rules {
        self.rules
    }

    /// The point at a place.
    ///
    /// # Errors
    /// [`Error::Range`] for a place that is not there; those of the rules.
    pub fn at(&self, place: Place) -> Result<Sample, Error> {
        self.evaluator(place.face)?.at(place)
    }

    /// The points at places of any order. Those of one face are evaluated together.
    ///
    /// # Errors
    /// As [`Surface::at`], for the first place that is refused.
    pub fn at_all(&self, places: &[Place]) -> Result<Vec<Sample>, Error> {
        // places by faces, as grids are, need no second copy of all samples
        if places.is_sorted_by_key(|place| place.face) {
            let mut samples = Vec::with_capacity(places.len());
            for group in places.chunk_by(|a, b| a.face == b.face) {
                let mut evaluator = self.evaluator(group[0].face)?;
                for &place in group {
                    samples.push(evaluator.at(place)?);
                }
            }
            return Ok(samples);
        }
        let mut order: Vec<u32> = (0..places.len() as u32).collect();
        order.sort_by_key(|&index| places[index as usize].face);
        let mut samples = vec![None; places.len()];
        for group in order.chunk_by(|&a, &b| places[a as usize].face == places[b as usize].face) {
            let mut evaluator = self.evaluator(places[group[0] as usize].face)?;
            for &index in group {
                samples[index as usize] = Some(evaluator.at(places[index as usize])?);
            }
        }
        Ok(samples.into_iter().flatten().collect())
    }

    /// What evaluates a face: it keeps what it has refined.
    ///
    /// # Errors
    /// [`Error::Range`] for a face that is not there.
    pub fn evaluator(&self, face: u32) -> Result<Evaluator<'_, 'a>, Error> {
        if face as usize >= self.control.face_count() {
            return Err(Error::Range {
                what: "face",
                given: face.to_string(),
                accepted: format!("0 to {}", self.control.face_count() - 1),
            });
        }
        Ok(Evaluator::new(self, face))
    }

    /// The weights of the control points in the point at a place, by their numbers; they add up to 1. Found
    /// by evaluating the place for unit control points, three at a time: for tables that are used often.
    ///
    /// # Errors
    /// As [`Surface::at`].
    pub fn stencil(&self, place: Place) -> Result<Vec<(u32, f64)>, Error> {
        self.at(place)?;
        let topology = Topology::unchecked(&self.control);
        // a point depends on the faces that touch those which touch its face
        let mut vertices: std::collections::BTreeSet<u32> =
            self.control.face(place.face as usize).iter().copied().collect();
        for _ in 0..2 {
            let ring: Vec<u32> = vertices.iter().copied().collect();
            for vertex in ring {
                for spoke in topology.fan(vertex).spokes {
                    vertices.extend(self.control.face(topology.face(spoke) as usize));
                }
            }
        }
        let vertices: Vec<u32> = vertices.into_iter().collect();
        let mut weights = Vec::with_capacity(vertices.len());
        let mut unit = self.control.clone();
        for three in vertices.chunks(3) {
            unit.points_mut().fill(Point3::origin());
            for (axis, &vertex) in three.iter().enumerate() {
                unit.points_mut()[vertex as usize][axis] = 1.0;
            }
            let position = Surface::new(&unit, self.rules)?.at(place)?.position;
            let found = three.iter().enumerate().map(|(axis, &vertex)| (vertex, position[axis]));
            weights.extend(found.filter(|(_, weight)| *weight != 0.0));
        }
        Ok(weights)
    }

    /// Places spread over all faces: `n x n` on a quad and on each quarter of another face, at the middles of
    /// equal cells.
    pub fn grid(&self, n: usize) -> Vec<Place> {
        let mut places = Vec::new();
        let at = |i: usize| (i as f64 + 0.5) / n as f64;
        for (face, corners) in self.control.faces().enumerate() {
            let subs = if corners.len() == 4 { 1 } else { corners.len() };
            for sub in 0..subs {
                for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
                    places.push(Place {
                        face: face as u32,
                        sub: sub as u32,
                        corner: 0,
                        s: at(i),
                        t: at(j),
                    });
                }
            }
        }
        places
    }
}
