//! The faces around one face, numbered by how they lie: the same structure has the same numbers.
//!
//! The face is face 0 with points 0 to 3. Then follow the faces around its corners, counter-clockwise and
//! back, up to sharp edges once no sharpness is left that ends; the edge of a dart is no end. Where special
//! rules reach farther than the vertex itself, the faces around these follow.

use crate::active::{Active, Ends, Kind, Masks};
use crate::features::{INFINITE, edge};
use crate::refine::{Step, step};
use crate::rules::Rules;
use crate::{Error, Mesh, Topology};
use nalgebra::Point3;
use std::collections::{HashMap, HashSet};

/// What the structure around a face is: two faces with the same key have the same rules.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    corners: Vec<u32>,
    creases: Vec<([u32; 2], u64)>,
    fixed: Vec<(u32, u64)>,
    definitions: Vec<(u32, u32)>,
}

/// A part of a mesh around a face.
#[derive(Debug)]
pub(crate) struct Local {
    pub mesh: Mesh,
    pub topology: Topology,
    /// The point of the mesh before, for each point.
    pub ids: Vec<u32>,
    /// The face of the mesh before, for each face.
    pub faces: Vec<u32>,
    /// Of dual schemes the points, which sit on faces.
    pub values: Option<Vec<Point3<f64>>>,
    /// The vertex of the control mesh with a definition of its own, for each point that is one.
    pub named: HashMap<u32, u32>,
}

/// How much of the neighbourhood is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    /// The faces that touch the face.
    One,
    /// The faces that touch these.
    Two,
}

/// A mesh of which parts are taken.
pub(crate) struct Source<'a> {
    pub mesh: &'a Mesh,
    pub topology: &'a Topology,
    pub ends: Ends,
    /// Of dual schemes the point of each face.
    pub values: Option<&'a [Point3<f64>]>,
}

impl Source<'_> {
    /// The sharpness of an edge, infinite on a boundary with rules.
    pub fn sharpness(&self, half: u32) -> f64 {
        if self.topology.twin(half).is_none() && self.ends != Ends::Open {
            return INFINITE;
        }
        let [a, b] = self.topology.ends(half);
        let sharpness = self.mesh.features.creases.get(&edge(a, b)).copied().unwrap_or(0.0);
        sharpness.min(INFINITE)
    }

    fn spokes(&self, vertex: u32) -> Vec<u32> {
        let fan = self.topology.fan(vertex);
        fan.spokes.iter().copied().chain(fan.last).collect()
    }

    pub fn sharp_spokes(&self, vertex: u32) -> usize {
        let spokes = self.spokes(vertex).into_iter();
        spokes.filter(|&spoke| self.sharpness(spoke) >= INFINITE).count()
    }

    pub fn own(&self, vertex: u32) -> f64 {
        if let Ends::Rim { corners: true } = self.ends {
            let fan = self.topology.fan(vertex);
            if !fan.is_closed() && fan.spokes.len() == 1 {
                return INFINITE;
            }
        }
        self.mesh
            .features
            .corners
            .get(&vertex)
            .copied()
            .unwrap_or(0.0)
            .min(INFINITE)
    }

    /// The corners of faces around the origin of a half-edge, itself first, then counter-clockwise, then
    /// back.
    fn around(&self, start: u32, cut: bool) -> Vec<u32> {
        let vertex = self.topology.origin(start);
        let stops = |half: u32| cut && self.sharpness(half) >= INFINITE && self.sharp_spokes(vertex) != 1;
        let mut found = vec![start];
        let mut spoke = start;
        while !stops(self.topology.previous(spoke)) {
            match self.topology.turned(spoke) {
                Some(next) if next == start => return found,
                Some(next) => spoke = next,
                None => break,
            }
            found.push(spoke);
        }
        // the way back ends at another sharp edge or at the boundary, before what was found forwards
        spoke = start;
        while !stops(spoke) {
            match self.topology.turned_back(spoke) {
                Some(next) if next != start => spoke = next,
                _ => break,
            }
            found.push(spoke);
        }
        found
    }

    /// The part around the face of `start`, counted from there.
    pub fn part(&self, start: u32, reach: Reach, named: impl Fn(u32) -> Option<u32>) -> Local {
        let topology = self.topology;
        let mut corners = vec![start];
        for _ in 0..3 {
            corners.push(topology.next(corners[corners.len() - 1]));
        }
        let ending = |half: u32| {
            let s = self.sharpness(half);
            s > 0.0 && s < INFINITE
        };
        let soft = corners.iter().any(|&corner| {
            let vertex = topology.origin(corner);
            let own = self.own(vertex);
            (own > 0.0 && own < INFINITE) || self.spokes(vertex).into_iter().any(ending)
        });
        let cut = !soft;
        // faces by the half-edge from which they are counted
        let mut faces = vec![start];
        let mut seen: HashSet<u32> = HashSet::from([topology.face(start)]);
        let collect = |from: u32, faces: &mut Vec<u32>, seen: &mut HashSet<u32>| {
            for half in self.around(from, cut) {
                if seen.insert(topology.face(half)) {
                    faces.push(half);
                }
            }
        };
        for &corner in &corners {
            collect(corner, &mut faces, &mut seen);
        }
        if reach == Reach::Two {
            for face in faces.clone() {
                let mut half = face;
                for _ in 0..4 {
                    collect(half, &mut faces, &mut seen);
                    half = topology.next(half);
                }
            }
        }
        let mut numbers: HashMap<u32, u32> = HashMap::new();
        let mut ids = Vec::new();
        let mut list = Vec::with_capacity(4 * faces.len());
        let mut halves = Vec::with_capacity(4 * faces.len());
        for &face in &faces {
            let mut half = face;
            for _ in 0..4 {
                let vertex = topology.origin(half);
                let number = *numbers.entry(vertex).or_insert_with(|| {
                    ids.push(vertex);
                    ids.len() as u32 - 1
                });
                list.push(number);
                halves.push(half);
                half = topology.next(half);
            }
        }
        let points = ids.iter().map(|&id| self.mesh.points()[id as usize]).collect();
        let mut mesh = Mesh::of_quads(points, list);
        for &half in &halves {
            let sharpness = self.sharpness(half);
            if sharpness > 0.0 {
                let [a, b] = topology.ends(half).map(|id| numbers[&id]);
                mesh.features.creases.insert(edge(a, b), sharpness);
            }
        }
        for (number, &id) in ids.iter().enumerate() {
            let own = self.own(id);
            // of a vertex that stays only one fan is here
            let stays = cut && self.sharp_spokes(id) > 2;
            if own > 0.0 || stays {
                mesh.features
                    .corners
                    .insert(number as u32, if stays { INFINITE } else { own });
            }
        }
        let named = ids
            .iter()
            .enumerate()
            .filter_map(|(number, &id)| Some((number as u32, named(id)?)))
            .collect();
        let faces: Vec<u32> = faces.into_iter().map(|half| topology.face(half)).collect();
        let values = self
            .values
            .map(|values| faces.iter().map(|&face| values[face as usize]).collect());
        Local {
            topology: Topology::unchecked(&mesh),
            mesh,
            ids,
            faces,
            values,
            named,
        }
    }
}

impl Local {
    pub fn key(&self) -> Key {
        let features = &self.mesh.features;
        let mut definitions: Vec<(u32, u32)> = self.named.iter().map(|(&a, &b)| (a, b)).collect();
        definitions.sort_unstable();
        Key {
            corners: self.mesh.corners().to_vec(),
            creases: features.creases.iter().map(|(&pair, s)| (pair, s.to_bits())).collect(),
            fixed: features.corners.iter().map(|(&v, s)| (v, s.to_bits())).collect(),
            definitions,
        }
    }

    pub fn source(&self) -> Source<'_> {
        Source {
            mesh: &self.mesh,
            topology: &self.topology,
            ends: Ends::Open,
            values: self.values.as_deref(),
        }
    }

    /// The control points.
    pub fn points(&self) -> &[Point3<f64>] {
        self.values.as_deref().unwrap_or(self.mesh.points())
    }

    /// The numbers that the control points have in the refined part before.
    pub fn unknowns(&self) -> &[u32] {
        if self.values.is_some() { &self.faces } else { &self.ids }
    }

    /// The same part counted from another corner of its face.
    pub fn turned(&self, corner: u32, reach: Reach) -> Local {
        let mut turned = self.source().part(corner, reach, |id| self.named.get(&id).copied());
        turned.ids = turned.ids.iter().map(|&id| self.ids[id as usize]).collect();
        turned
    }

    /// The part, refined once.
    pub fn refined(&self, rules: &Rules) -> Result<Step, Error> {
        if self.values.is_some() {
            return super::dual::step(self, rules);
        }
        if self.named.is_empty() {
            return step(&self.mesh, &self.topology, rules, 0, Ends::Open);
        }
        step(
            &self.mesh,
            &self.topology,
            &rules.renumbered(&self.named),
            0,
            Ends::Open,
        )
    }

    /// The quarter of the face at one of its corners, counted so that parameters run as on the face.
    pub fn child(&self, refined: &Step, corner: u32, reach: Reach) -> Option<Local> {
        let face = refined.halves.iter().position(|&half| half == corner)? as u32;
        let topology = Topology::unchecked(&refined.mesh);
        let source = Source {
            mesh: &refined.mesh,
            topology: &topology,
            ends: Ends::Open,
            values: refined.values.as_deref(),
        };
        let start = 4 * face + (4 - corner) % 4;
        // old points keep their numbers
        Some(source.part(start, reach, |id| self.named.get(&id).copied()))
    }

    /// Whether sharpness is left that ends.
    pub fn is_soft(&self) -> bool {
        self.mesh.features.largest_finite_sharpness() > 0.0
    }

    /// The faces around the corner of the half-edge between sharp edges, and whether the way round is closed.
    fn sector(&self, half: u32) -> (usize, bool) {
        let source = self.source();
        let vertex = self.topology.origin(half);
        let sharp = |half: u32| source.sharpness(half) >= INFINITE;
        if source.sharp_spokes(vertex) < 2 {
            let fan = self.topology.fan(vertex);
            return (fan.spokes.len(), fan.is_closed());
        }
        let mut count = 1;
        let mut spoke = half;
        while !sharp(self.topology.previous(spoke)) {
            match self.topology.turned(spoke) {
                Some(next) => spoke = next,
                None => return (count, false),
            }
            count += 1;
        }
        spoke = half;
        while !sharp(spoke) {
            match self.topology.turned_back(spoke) {
                Some(next) => spoke = next,
                None => return (count, false),
            }
            count += 1;
        }
        (count, false)
    }

    /// The corners of the face that are not regular.
    pub fn irregular(&self, rules: &Rules) -> Vec<u32> {
        let active = Active::new(&self.topology, &self.mesh.features, Ends::Open, None);
        let source = self.source();
        let regular = |&corner: &u32| {
            let vertex = self.topology.origin(corner);
            let (faces, closed) = self.sector(corner);
            match active.masks(vertex, 0) {
                Masks::One(Kind::Smooth) => {
                    closed && faces == 4 && active.is_plain(vertex) && !self.is_special(rules, vertex, 4)
                }
                Masks::One(Kind::Crease(..)) => faces == 2,
                Masks::One(Kind::Stays) => faces == 1 && source.sharp_spokes(vertex) >= 2,
                Masks::Blend(..) => false,
            }
        };
        (0..4).filter(|corner| !regular(corner)).collect()
    }

    fn is_special(&self, rules: &Rules, vertex: u32, valence: usize) -> bool {
        valence != 4 || self.named.contains_key(&vertex) || rules.lists_four()
    }

    /// Whether a vertex with rules that reach farther than itself is among the control points of the face.
    pub fn is_near_special(&self, rules: &Rules) -> bool {
        let active = Active::new(&self.topology, &self.mesh.features, Ends::Open, None);
        let mut vertices: HashSet<u32> = HashSet::new();
        for corner in 0..4 {
            for half in self.source().around(corner, true) {
                vertices.extend(self.mesh.face(self.topology.face(half) as usize));
            }
        }
        vertices.into_iter().any(|vertex| {
            let fan = self.topology.fan(vertex);
            fan.is_closed() && active.is_plain(vertex) && self.is_special(rules, vertex, fan.spokes.len())
        })
    }

    /// Whether an edge of the face is a boundary or a crease.
    pub fn is_rim(&self, half: u32) -> bool {
        self.source().sharpness(half) >= INFINITE
    }
}
