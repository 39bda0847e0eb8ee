//! The faces around one face, numbered by how they lie: the same structure has the same numbers.
//!
//! The face is face 0 with points 0 to 3. Then follow the faces around its corners, counter-clockwise and
//! back, up to sharp edges once no sharpness is left that ends; the edge of a dart is no end. Then, ring by
//! ring, those around these, as far as the pieces of the surface read ([`Kernel::reach`]).

use super::dual::{self, DualNet};
use super::kernel::Kernel;
use crate::active::{Active, Ends, Kind, Masks};
use crate::features::{INFINITE, edge};
use crate::refine::{Step, step};
use crate::rules::Rules;
use crate::{Error, Mesh, Topology};
use std::collections::{HashMap, HashSet};

/// What the structure around a face is: two faces with the same key have the same rules.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    corners: Vec<u32>,
    creases: Vec<([u32; 2], u64)>,
    fixed: Vec<(u32, u64)>,
    edge_steps: Vec<([u32; 2], u32)>,
    vertex_steps: Vec<(u32, u32)>,
    definitions: Vec<(u32, u32)>,
}

/// A part of a mesh around a face.
#[derive(Debug)]
pub(crate) struct Local {
    pub mesh: Mesh,
    pub topology: Topology,
    /// The vertex of the mesh before, for each vertex.
    pub ids: Vec<u32>,
    /// Of dual schemes the control points, and their numbers in the net before.
    pub net: Option<(DualNet, Vec<u32>)>,
    /// The vertex of the control mesh with a definition of its own, for each point that is one.
    pub named: HashMap<u32, u32>,
}

/// A mesh of which parts are taken.
pub(crate) struct Source<'a> {
    pub mesh: &'a Mesh,
    pub topology: &'a Topology,
    pub ends: Ends,
    /// Whether anything has a sharpness that ends.
    pub soft: bool,
    /// Of dual schemes the control points.
    pub net: Option<&'a DualNet>,
    /// In how many smoothing steps what is sharp throughout acts.
    pub full: u32,
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

    /// In how many smoothing steps an edge is a crease, if it is one in some of them only.
    pub fn steps(&self, half: u32) -> Option<u32> {
        let [a, b] = self.topology.ends(half);
        let features = &self.mesh.features;
        let steps = *features.edge_steps.get(&edge(a, b))?;
        let soft = steps < self.full && features.creases.contains_key(&edge(a, b));
        (soft && self.topology.twin(half).is_some()).then_some(steps)
    }

    /// Likewise a vertex that is marked itself.
    pub fn own_steps(&self, vertex: u32) -> Option<u32> {
        let steps = *self.mesh.features.vertex_steps.get(&vertex)?;
        (steps < self.full && self.own(vertex) > 0.0).then_some(steps)
    }

    /// Whether the surface is two surfaces with a common curve here: at a boundary or crease that acts in all
    /// steps of all levels.
    pub fn cuts(&self, half: u32) -> bool {
        self.sharpness(half) >= INFINITE && self.steps(half).is_none()
    }

    fn spokes(&self, vertex: u32) -> Vec<u32> {
        let fan = self.topology.fan(vertex);
        fan.spokes.iter().copied().chain(fan.last).collect()
    }

    pub fn sharp_spokes(&self, vertex: u32) -> usize {
        // around vertices of many faces a look at each spoke takes as long as they are many
        let first = self.topology.first_spoke(vertex);
        let is_inside = first.is_some_and(|spoke| self.topology.turned_back(spoke).is_some());
        if is_inside && self.mesh.features.creases.is_empty() {
            return 0;
        }
        let spokes = self.spokes(vertex).into_iter();
        spokes.filter(|&spoke| self.cuts(spoke)).count()
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
        let stops = |half: u32| cut && self.cuts(half) && self.sharp_spokes(vertex) != 1;
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
    pub fn part(&self, start: u32, rings: usize, named: impl Fn(u32) -> Option<u32>) -> Local {
        let topology = self.topology;
        // sharpness that ends may act across an edge that stays sharp, as a third one at its end
        let cut = !self.soft || !self.is_soft(start, rings);
        let faces = self.faces(start, rings, cut);
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
                if let Some(steps) = self.steps(half) {
                    mesh.features.edge_steps.insert(edge(a, b), steps);
                }
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
            // nor are creases there that hold the vertex in some steps from another fan
            let held = if cut { self.held(id) } else { None };
            let steps = match self.own_steps(id) {
                None if own > 0.0 || stays => None,
                steps => steps.max(held),
            };
            if let Some(steps) = steps {
                mesh.features.corners.entry(number as u32).or_insert(INFINITE);
                mesh.features.vertex_steps.insert(number as u32, steps);
            }
        }
        let named = ids
            .iter()
            .enumerate()
            .filter_map(|(number, &id)| Some((number as u32, named(id)?)))
            .collect();
        let fine = Topology::unchecked(&mesh);
        let net = self.net.map(|net| {
            let faces = faces.iter().map(|&half| topology.face(half));
            let rims = (0..fine.edge_count() as u32).filter_map(|number| {
                let pair = fine.edge_points(number);
                let [a, b] = pair.map(|end| ids[end as usize]);
                Some((pair, *net.rims.get(&edge(a, b))?))
            });
            let corners = (0..)
                .zip(&ids)
                .filter_map(|(number, id)| Some((number, *net.corners.get(id)?)));
            net.part(faces, rims, corners)
        });
        Local {
            topology: fine,
            mesh,
            ids,
            net,
            named,
        }
    }

    /// In how many steps creases that act in some steps hold a vertex on a line of two that always act.
    fn held(&self, vertex: u32) -> Option<u32> {
        if self.full == 0 || self.sharp_spokes(vertex) != 2 {
            return None;
        }
        self.spokes(vertex)
            .into_iter()
            .filter_map(|spoke| self.steps(spoke))
            .max()
    }

    /// The faces of a part, each by the half-edge from which it is counted.
    fn faces(&self, start: u32, rings: usize, cut: bool) -> Vec<u32> {
        let topology = self.topology;
        let mut faces = vec![start];
        let mut seen: HashSet<u32> = HashSet::from([topology.face(start)]);
        let mut from = 0;
        for _ in 0..rings {
            let end = faces.len();
            for index in from..end {
                let mut half = faces[index];
                for _ in 0..4 {
                    for around in self.around(half, cut) {
                        if seen.insert(topology.face(around)) {
                            faces.push(around);
                        }
                    }
                    half = topology.next(half);
                }
            }
            from = end;
        }
        faces
    }

    /// Whether a part has sharpness that ends.
    fn is_soft(&self, start: u32, rings: usize) -> bool {
        let ending = |s: f64| s > 0.0 && s < INFINITE;
        self.faces(start, rings, false).into_iter().any(|face| {
            let mut half = face;
            (0..4).any(|_| {
                half = self.topology.next(half);
                let vertex = self.topology.origin(half);
                ending(self.own(vertex)) || self.spokes(vertex).into_iter().any(|half| ending(self.sharpness(half)))
            })
        })
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
            edge_steps: features
                .edge_steps
                .iter()
                .map(|(&pair, &steps)| (pair, steps))
                .collect(),
            vertex_steps: features.vertex_steps.iter().map(|(&v, &steps)| (v, steps)).collect(),
            definitions,
        }
    }

    pub fn source(&self) -> Source<'_> {
        Source {
            mesh: &self.mesh,
            topology: &self.topology,
            ends: Ends::Open,
            soft: self.is_soft(),
            net: self.net.as_ref().map(|(net, _)| net),
            // a part names no steps but those of what acts in some
            full: u32::MAX,
        }
    }

    /// The numbers that the control points have in the refined part before.
    pub fn unknowns(&self) -> &[u32] {
        self.net.as_ref().map_or(&self.ids, |(_, ids)| ids)
    }

    /// The same part counted from another corner of its face, with the numbers of its control points here.
    pub fn turned(&self, corner: u32, rings: usize) -> Local {
        self.source().part(corner, rings, |id| self.named.get(&id).copied())
    }

    /// The part, refined once, as the given level.
    pub fn refined(&self, rules: &Rules, kernel: &Kernel, level: usize) -> Result<Step, Error> {
        if self.net.is_some() {
            return dual::step(self, rules, kernel, level);
        }
        // without names no vertex of the part has rules of its own, whatever its number here is
        if rules.vertices().next().is_none() {
            return step(&self.mesh, &self.topology, rules, level, Ends::Open);
        }
        let rules = rules.renumbered(&self.named);
        step(&self.mesh, &self.topology, &rules, level, Ends::Open)
    }

    /// The quarter of the face at one of its corners, counted so that parameters run as on the face.
    pub fn child(&self, refined: &Step, topology: &Topology, corner: u32, rings: usize) -> Option<Local> {
        let face = refined.halves.iter().position(|&half| half == corner)? as u32;
        let source = Source {
            mesh: &refined.mesh,
            topology,
            ends: Ends::Open,
            soft: refined.mesh.features.largest_finite_sharpness() > 0.0,
            net: refined.net.as_ref(),
            full: u32::MAX,
        };
        let start = 4 * face + (4 - corner) % 4;
        // old points keep their numbers
        Some(source.part(start, rings, |id| self.named.get(&id).copied()))
    }

    /// Whether sharpness is left that ends.
    pub fn is_soft(&self) -> bool {
        self.mesh.features.largest_finite_sharpness() > 0.0
    }

    /// The faces around the corner of the half-edge between sharp edges, and whether the way round is closed.
    fn sector(&self, half: u32) -> (usize, bool) {
        let source = self.source();
        let vertex = self.topology.origin(half);
        let sharp = |half: u32| source.cuts(half);
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

    /// The irregular vertices inside the control points of the face's piece, each by a half-edge of the part
    /// that leaves it, first those at corners of the face.
    pub fn irregular(&self, rules: &Rules, rings: usize) -> Vec<u32> {
        let active = Active::new(&self.topology, &self.mesh.features, Ends::Open, None);
        let source = self.source();
        let regular = |corner: u32| {
            let vertex = self.topology.origin(corner);
            let (faces, closed) = self.sector(corner);
            if self.has_steps() && (source.own_steps(vertex).is_some() || self.meets_steps(vertex)) {
                return self.is_straight(corner);
            }
            match active.masks(vertex, 0) {
                Masks::One(Kind::Smooth) => {
                    closed && faces == 4 && active.is_plain(vertex) && !self.is_special(rules, vertex, 4)
                }
                Masks::One(Kind::Crease(..)) => faces == 2,
                Masks::One(Kind::Stays) => faces == 1 && source.sharp_spokes(vertex) >= 2,
                Masks::Blend(..) => false,
            }
        };
        let mut found: Vec<u32> = Vec::new();
        let mut seen: HashSet<u32> = HashSet::new();
        for face in source.faces(0, rings - 1, true) {
            let mut half = face;
            for _ in 0..4 {
                let vertex = self.topology.origin(half);
                // a vertex on a crease may be seen from both sides
                if !regular(half) && seen.insert(vertex) {
                    found.push(half);
                }
                half = self.topology.next(half);
            }
        }
        found
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
        self.source().cuts(half)
    }

    /// In how many smoothing steps an edge of the face is a crease, if in some only.
    pub fn steps(&self, half: u32) -> Option<u32> {
        self.source().steps(half)
    }

    /// Whether a crease or a vertex acts in some smoothing steps only.
    pub fn has_steps(&self) -> bool {
        let features = &self.mesh.features;
        !features.edge_steps.is_empty() || !features.vertex_steps.is_empty()
    }

    fn meets_steps(&self, vertex: u32) -> bool {
        let source = self.source();
        source
            .spokes(vertex)
            .into_iter()
            .any(|spoke| source.steps(spoke).is_some())
    }

    /// Whether the surface around a vertex, seen from a face, is a tensor product of functions that know the
    /// creases through it which act in some steps only: these run straight on.
    fn is_straight(&self, corner: u32) -> bool {
        let source = self.source();
        let vertex = self.topology.origin(corner);
        let (faces, closed) = self.sector(corner);
        let own = source.own_steps(vertex).unwrap_or(0);
        let fan = self.topology.fan(vertex);
        let steps = |half: u32| source.steps(half).unwrap_or(0);
        let cuts = source.sharp_spokes(vertex);
        if closed && cuts == 0 && faces == 4 {
            let steps: Vec<u32> = fan.spokes.iter().map(|&spoke| steps(spoke)).collect();
            return steps[0] == steps[2] && steps[1] == steps[3] && own <= steps[0].min(steps[1]);
        }
        // one side of a line: the spoke in its middle
        let middle = if source.cuts(corner) {
            self.topology.previous(corner)
        } else {
            corner
        };
        let fixed = source.own(vertex) >= INFINITE && source.own_steps(vertex).is_none();
        match faces {
            1 => cuts >= 2 && (fixed || cuts > 2),
            2 => cuts == 2 && !fixed && own <= steps(middle),
            _ => false,
        }
    }
}
