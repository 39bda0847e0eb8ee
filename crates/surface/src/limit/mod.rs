//! Exact points of the limit surface, with derivatives and curvature, anywhere.
//!
//! **Isolation.** The faces around a face are refined, not the mesh, until the face's support is regular, or
//! has one irregular centre at a corner of the face and refinement reproduces it (`local.rs`). **Regular**
//! pieces are tensor products of the scheme's order and of the level's tension (`kernel.rs`, `patch.rs`),
//! continued by reflection at boundaries and creases (`net.rs`). **Beside a centre** at depth m the control
//! points are never multiplied out and differenced: they are kept as `1 p + lambda^m R a + T`, p the limit of
//! the centre, a its tangents, T the rest, which is projected free of both at every level (`centre.rs`,
//! `ladder.rs`). In the frame of the tangent plane, with x and y divided by `lambda^m` and z by `lambda^2m`,
//! nothing cancels and nothing underflows down to parameters of 1e-18 and below.

mod centre;
mod dual;
mod evaluate;
mod half_cells;
mod kernel;
mod ladder;
mod local;
mod net;
mod numbers;
mod pair;
mod partial;
mod patch;
mod quarter;
mod rotation;
mod structure;
mod vertices;

pub(crate) use dual::DualNet;
pub use evaluate::{Evaluator, Kind, Sample, Undefined};
pub use half_cells::HalfCell;
pub use vertices::{Rule, VertexFan};

use crate::active::Ends;
use crate::dual::CellNet;
use crate::refine::step;
use crate::refiner::{Refiner, RulesOn};
use crate::rules::Rules;
use crate::{Error, Mesh, Topology};
use kernel::Kernel;
use nalgebra::Point3;
use quarter::Context;
use std::sync::Mutex;
use structure::Known;

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
    /// The same rules for parts of the mesh, on which creases name their steps themselves.
    named_steps: Option<Rules>,
    kernel: Kernel,
    ends: Ends,
    control: Mesh,
    /// The mesh on which evaluation starts: quads whose special vertices lie apart.
    base: Mesh,
    topology: Topology,
    /// Whether the base has sharpness that ends.
    soft: bool,
    /// Of dual schemes the control points on the base.
    net: Option<DualNet>,
    /// How many levels the base is finer than the control mesh.
    lift: usize,
    known: Mutex<Known>,
}

impl<'a> Surface<'a> {
    /// The surface of a control mesh.
    ///
    /// # Errors
    /// [`Error::Defects`] for what is no surface; [`Error::NoRule`] for schemes whose regular surfaces are
    /// neither bicubic in one pass nor those of the tension scheme; [`Error::Range`] for creases that act in
    /// more smoothing steps than there are.
    pub fn new(mesh: &Mesh, rules: &'a Rules) -> Result<Self, Error> {
        if mesh.face_count() == 0 {
            return Err(Error::Empty);
        }
        let topology = Topology::new(mesh)?;
        let kernel = Kernel::new(rules)?;
        let refiner = Refiner::new(rules);
        let ends = refiner.ends(mesh);
        if ends == Ends::Open && !topology.boundary_loops().is_empty() {
            return Err(Error::NoRule {
                what: "a shrinking boundary under limits".to_owned(),
                elements: "the boundary".to_owned(),
                accepted: "are boundary edge and corner".to_owned(),
            });
        }
        let full = kernel.full_steps();
        let is_partial =
            rules.steps.is_some() || !(mesh.features.edge_steps.is_empty() && mesh.features.vertex_steps.is_empty());
        let own;
        let mesh = if full > 0 && is_partial {
            own = with_steps(mesh, &topology, rules, full)?;
            &own
        } else {
            mesh
        };
        let mut surface = Surface {
            rules,
            named_steps: rules.steps.map(|_| rules.with_all_steps()),
            kernel,
            ends,
            control: mesh.clone(),
            base: mesh.clone(),
            topology,
            soft: false,
            net: None,
            lift: 0,
            known: Mutex::default(),
        };
        if surface.kernel.dual {
            // the quarters of faces, each with the point that the first level gives its corner
            surface.net = Some(CellNet::new(mesh.clone(), refiner.boundary_of(mesh)).first_on_quads(rules)?);
            surface.base = crate::refine::quads(mesh, &surface.topology);
            surface.lift = 1;
        } else {
            loop {
                surface.topology = Topology::unchecked(&surface.base);
                let on_base = refiner.rules_on(&surface.base, &surface.topology)?;
                if matches!(on_base, RulesOn::Own(_)) && surface.base.is_quads() {
                    break;
                }
                surface.base = step(&surface.base, &surface.topology, on_base.get(), surface.lift, ends)?.mesh;
                surface.lift += 1;
            }
        }
        surface.topology = Topology::unchecked(&surface.base);
        surface.soft = surface.base.features.largest_finite_sharpness() > 0.0;
        Ok(surface)
    }

    fn context(&self) -> Context<'_> {
        Context {
            rules: self.local_rules(),
            kernel: &self.kernel,
        }
    }

    fn local_rules(&self) -> &Rules {
        self.named_steps.as_ref().unwrap_or(self.rules)
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

    /// The points at places of any order.
    ///
    /// # Errors
    /// As [`Surface::at_each`].
    pub fn at_all(&self, places: &[Place]) -> Result<Vec<Sample>, Error> {
        let mut samples = vec![Sample::ORIGIN; places.len()];
        self.at_each(places, |numbers, found| {
            for (&number, sample) in numbers.iter().zip(found) {
                samples[number as usize] = *sample;
            }
        })?;
        Ok(samples)
    }

    /// Hands the points at places of any order to `take`, some hundred at a time and face by face, with the
    /// numbers of the places: a million samples are never all in memory.
    ///
    /// # Errors
    /// As [`Surface::at`], for the first place that is refused, face by face; points before it have been
    /// handed over.
    pub fn at_each(&self, places: &[Place], mut take: impl FnMut(&[u32], &[Sample])) -> Result<(), Error> {
        self.each(places, &mut take)
    }

    /// The same, compiled here: as a part of whoever calls it, it would take four times as long.
    fn each(&self, places: &[Place], take: &mut dyn FnMut(&[u32], &[Sample])) -> Result<(), Error> {
        let faces = self.control.face_count();
        if let Some(place) = places.iter().find(|place| place.face as usize >= faces) {
            return Err(self.no_face(place.face));
        }
        let mut samples = vec![Sample::ORIGIN; AT_ONCE.min(places.len())];
        let mut numbers = Vec::with_capacity(samples.len());
        for group in by_face(places, faces).chunk_by(|(_, a), (_, b)| a.face == b.face) {
            let mut evaluator = Evaluator::new(self, group[0].1.face);
            for group in group.chunks(AT_ONCE) {
                numbers.clear();
                for ((number, place), sample) in group.iter().zip(&mut samples) {
                    evaluator.fill(*place, sample)?;
                    numbers.push(*number);
                }
                take(&numbers, &samples[..group.len()]);
            }
        }
        Ok(())
    }

    /// Whether a place is there.
    ///
    /// # Errors
    /// [`Error::Range`].
    pub fn check(&self, place: Place) -> Result<(), Error> {
        self.evaluator(place.face)?.check(place)
    }

    /// What evaluates a face: it keeps what it has refined.
    ///
    /// # Errors
    /// [`Error::Range`] for a face that is not there.
    pub fn evaluator(&self, face: u32) -> Result<Evaluator<'_, 'a>, Error> {
        if face as usize >= self.control.face_count() {
            return Err(self.no_face(face));
        }
        Ok(Evaluator::new(self, face))
    }

    fn no_face(&self, face: u32) -> Error {
        Error::Range {
            what: "face",
            given: face.to_string(),
            accepted: format!("0 to {}", self.control.face_count() - 1),
        }
    }

    /// The weights of the control points in the point at a place, by their numbers; they add up to 1. Found
    /// by evaluating the place for unit control points, three at a time: for tables that are used often.
    ///
    /// # Errors
    /// As [`Surface::at`].
    pub fn stencil(&self, place: Place) -> Result<Vec<(u32, f64)>, Error> {
        self.at(place)?;
        let topology = Topology::unchecked(&self.control);
        // a point depends on the faces its piece reads, and on those which the levels before that read
        let mut vertices: std::collections::BTreeSet<u32> =
            self.control.face(place.face as usize).iter().copied().collect();
        for _ in 0..=self.kernel.reach().max(1) {
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
        grid(&self.control, n)
    }
}

/// So many samples, 150 kB, stay in the processor's cache until they are taken.
const AT_ONCE: usize = 512;

/// Places with their numbers in the order of their faces, by counting.
fn by_face(places: &[Place], faces: usize) -> Vec<(u32, Place)> {
    let mut order: Vec<(u32, Place)> = (0..).zip(places.iter().copied()).collect();
    if places.is_sorted_by_key(|place| place.face) {
        return order;
    }
    let mut next = vec![0_u32; faces + 1];
    places.iter().for_each(|place| next[place.face as usize + 1] += 1);
    (0..faces).for_each(|face| next[face + 1] += next[face]);
    for (number, &place) in (0..).zip(places) {
        let at = &mut next[place.face as usize];
        order[*at as usize] = (number, place);
        *at += 1;
    }
    order
}

/// The middles of n by n cells of each face, and of each quad around a corner of a face that is none.
pub fn grid(mesh: &Mesh, n: usize) -> Vec<Place> {
    let mut places = Vec::new();
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    for (face, corners) in mesh.faces().enumerate() {
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

/// The mesh with the steps of all creases and corners written down. What acts in no step is none.
fn with_steps(mesh: &Mesh, topology: &Topology, rules: &Rules, full: u32) -> Result<Mesh, Error> {
    let mut mesh = mesh.clone();
    let default = rules.steps.map_or(full, |steps| steps as u32);
    mesh.features.check_steps(rules.steps, full)?;
    let features = &mut mesh.features;
    let mut edge_steps = std::mem::take(&mut features.edge_steps);
    features
        .creases
        .retain(|pair, _| *edge_steps.entry(*pair).or_insert(default) > 0);
    edge_steps.retain(|pair, _| features.creases.contains_key(pair));
    let mut vertex_steps = std::mem::take(&mut features.vertex_steps);
    let on_boundary = |vertex: u32| !topology.fan(vertex).is_closed();
    features.corners.retain(|&vertex, _| {
        let steps = vertex_steps.entry(vertex).or_insert(default);
        if on_boundary(vertex) {
            *steps = full;
        }
        *steps > 0
    });
    vertex_steps.retain(|vertex, _| features.corners.contains_key(vertex));
    (features.edge_steps, features.vertex_steps) = (edge_steps, vertex_steps);
    Ok(mesh)
}
