//! Which edges and vertices act in a smoothing step: from sharpness to masks.
//!
//! In every step a vertex counts its active edges: with none or one it is smooth (one: a dart), with two it
//! follows the curve along them, with three or more it stays, as it does if it is marked itself. A level has
//! two such masks, that of the sharpness before it (p) and that of what is left after it (c); where they
//! differ in kind, the new point is `w p + (1-w) c`, w the mean of the sharpnesses that end in this level.

use crate::features::after_one_level;
use crate::{Features, Topology};
use std::collections::HashMap;

/// What happens where faces end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// Boundary edges are creases that act in all steps; vertices with one face are corners, or not.
    Rim { corners: bool },
    /// There are no rules.
    Open,
}

/// The kind of a vertex in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Smooth,
    /// Along the edges to these two points.
    Crease(u32, u32),
    Stays,
}

impl Kind {
    fn same(self, other: Kind) -> bool {
        std::mem::discriminant(&self) == std::mem::discriminant(&other)
    }
}

/// A sharp edge at a vertex.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    other: u32,
    sharpness: f64,
    steps: u32,
}

/// The masks of a step: one kind, or two with the weight of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Masks {
    One(Kind),
    Blend(Kind, f64, Kind),
}

/// The sharp edges and vertices of a mesh.
#[derive(Debug, Default)]
pub(crate) struct Active {
    spokes: HashMap<u32, Vec<Spoke>>,
    /// A vertex's own sharpness, and the number of steps it acts in.
    own: HashMap<u32, (f64, u32)>,
}

const ALL: u32 = u32::MAX;

impl Active {
    /// The sharp edges of a mesh; `steps` is what marks without steps of their own have.
    pub fn new(topology: &Topology, features: &Features, ends: Ends, steps: Option<usize>) -> Self {
        let mut active = Active::default();
        let default = steps.map_or(ALL, |steps| steps as u32);
        let mut push = |[a, b]: [u32; 2], sharpness: f64, steps: u32| {
            for (vertex, other) in [(a, b), (b, a)] {
                active.spokes.entry(vertex).or_default().push(Spoke {
                    other,
                    sharpness,
                    steps,
                });
            }
        };
        for number in 0..topology.edge_count() as u32 {
            let pair = topology.edge_points(number);
            if topology.is_boundary(number) && ends != Ends::Open {
                push(pair, f64::INFINITY, ALL);
            } else if let Some(&sharpness) = features.creases.get(&pair).filter(|&&s| s > 0.0) {
                let steps = features.edge_steps.get(&pair).copied().unwrap_or(default);
                push(pair, sharpness, steps);
            }
        }
        for (&vertex, &sharpness) in features.corners.iter().filter(|(_, s)| **s > 0.0) {
            let steps = features.vertex_steps.get(&vertex).copied().unwrap_or(default);
            active.own.insert(vertex, (sharpness, steps));
        }
        if let Ends::Rim { corners } = ends {
            for number in (0..topology.edge_count() as u32).filter(|&number| topology.is_boundary(number)) {
                let vertex = topology.origin(topology.half_of_edge(number));
                if let Some((_, steps)) = active.own.get_mut(&vertex) {
                    *steps = ALL;
                }
                if corners && topology.fan(vertex).spokes.len() == 1 {
                    active.own.insert(vertex, (f64::INFINITY, ALL));
                }
            }
        }
        active
    }

    /// Whether anything at a vertex is sharp.
    pub fn is_plain(&self, vertex: u32) -> bool {
        !self.spokes.contains_key(&vertex) && !self.own.contains_key(&vertex)
    }

    fn kind(&self, vertex: u32, step: usize, sharp: impl Fn(f64) -> bool) -> Kind {
        let acts = |sharpness: f64, steps: u32| (step as u32) < steps && sharp(sharpness);
        if self.own.get(&vertex).is_some_and(|&(s, steps)| acts(s, steps)) {
            return Kind::Stays;
        }
        let spokes = self.spokes.get(&vertex).map_or(&[][..], Vec::as_slice);
        let mut count = 0;
        let mut ends = [0; 2];
        for spoke in spokes.iter().filter(|spoke| acts(spoke.sharpness, spoke.steps)) {
            if count < 2 {
                ends[count] = spoke.other;
            }
            count += 1;
        }
        match count {
            0 | 1 => Kind::Smooth,
            2 => Kind::Crease(ends[0], ends[1]),
            _ => Kind::Stays,
        }
    }

    /// The masks of a vertex in a step.
    pub fn masks(&self, vertex: u32, step: usize) -> Masks {
        if self.is_plain(vertex) {
            return Masks::One(Kind::Smooth);
        }
        let before = self.kind(vertex, step, |s| s > 0.0);
        let after = self.kind(vertex, step, |s| after_one_level(s) > 0.0);
        if before == Kind::Smooth || before.same(after) {
            return Masks::One(before);
        }
        let spokes = self.spokes.get(&vertex).map_or(&[][..], Vec::as_slice);
        let edges = spokes.iter().map(|spoke| (spoke.sharpness, spoke.steps));
        let ending = edges
            .chain(self.own.get(&vertex).copied())
            .filter(|&(s, steps)| (step as u32) < steps && s > 0.0 && after_one_level(s) == 0.0);
        let (sum, count) = ending.fold((0.0, 0.0), |(sum, count), (s, _)| (sum + s, count + 1.0));
        if count == 0.0 {
            return Masks::One(before);
        }
        Masks::Blend(before, f64::min(1.0, sum / count), after)
    }

    /// Whether an edge is sharp in a step.
    pub fn acts(&self, [a, b]: [u32; 2], step: usize) -> bool {
        let mut spokes = self.spokes.get(&a).map_or(&[][..], Vec::as_slice).iter();
        spokes.any(|spoke| spoke.other == b && (step as u32) < spoke.steps && spoke.sharpness > 0.0)
    }

    /// How sharp an edge is in this level: 1 a crease, 0 smooth, between them a blend of both.
    pub fn edge_weight(&self, [a, b]: [u32; 2]) -> f64 {
        let spokes = self.spokes.get(&a).map_or(&[][..], Vec::as_slice);
        let sharpness = spokes
            .iter()
            .find(|spoke| spoke.other == b)
            .map_or(0.0, |spoke| spoke.sharpness);
        sharpness.min(1.0)
    }
}
