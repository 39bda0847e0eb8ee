//! What is marked on a mesh: creases, corners, and how its boundary is treated.

use crate::Error;
use std::collections::{BTreeMap, BTreeSet};

/// Sharpness from which on an edge or a vertex stays sharp at every level.
pub const INFINITE: f64 = 10.0;

/// What happens at the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// It is a crease; so is a vertex with one face.
    Edge,
    /// It is a crease; vertices with one face are corners.
    Corner,
    /// It has no rules: what would read beyond the mesh is left out, and the mesh shrinks.
    Shrink,
}

/// The pair of an edge's points, the smaller first.
pub fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Marks on edges, which are named by their points, and on vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// The sharpness of edges. It falls by 1 a level; from [`INFINITE`] on it does not.
    pub creases: BTreeMap<[u32; 2], f64>,
    /// The sharpness of vertices, likewise.
    pub corners: BTreeMap<u32, f64>,
    /// What happens at the boundary, if the mesh says so.
    pub boundary: Option<Boundary>,
    /// In how many smoothing steps of a level an edge's crease acts.
    pub edge_steps: BTreeMap<[u32; 2], u32>,
    /// In how many smoothing steps of a level a vertex is kept.
    pub vertex_steps: BTreeMap<u32, u32>,
    /// Knot intervals of edges.
    pub knots: BTreeMap<[u32; 2], f64>,
    /// Vertices that count as extraordinary whatever their valence is.
    pub extraordinary: BTreeSet<u32>,
    /// How many levels of a scheme with knot intervals made the mesh, for schemes whose first level differs
    /// from the others.
    pub levels: u32,
}

/// What is left of a sharpness after one level.
pub fn after_one_level(sharpness: f64) -> f64 {
    if sharpness >= INFINITE {
        sharpness
    } else {
        (sharpness - 1.0).max(0.0)
    }
}

impl Features {
    /// Whether nothing is marked on edges and vertices.
    pub fn is_empty(&self) -> bool {
        *self
            == Features {
                boundary: self.boundary,
                levels: self.levels,
                ..Features::default()
            }
    }

    /// The marks of points with other numbers; those of points without one are left out.
    pub fn renumbered(&self, map: impl Fn(u32) -> Option<u32>) -> Features {
        fn edges<T: Copy>(of: &BTreeMap<[u32; 2], T>, map: &impl Fn(u32) -> Option<u32>) -> BTreeMap<[u32; 2], T> {
            let moved = of
                .iter()
                .filter_map(|(&[a, b], &value)| Some((edge(map(a)?, map(b)?), value)));
            moved.collect()
        }
        fn vertices<T: Copy>(of: &BTreeMap<u32, T>, map: &impl Fn(u32) -> Option<u32>) -> BTreeMap<u32, T> {
            of.iter().filter_map(|(&v, &value)| Some((map(v)?, value))).collect()
        }
        Features {
            creases: edges(&self.creases, &map),
            corners: vertices(&self.corners, &map),
            boundary: self.boundary,
            edge_steps: edges(&self.edge_steps, &map),
            vertex_steps: vertices(&self.vertex_steps, &map),
            knots: edges(&self.knots, &map),
            extraordinary: self.extraordinary.iter().filter_map(|&v| map(v)).collect(),
            levels: self.levels,
        }
    }

    /// The marks with sharpness rounded to 32 bits, as OpenSubdiv stores it.
    pub fn in_single_precision(mut self) -> Features {
        for sharpness in self.creases.values_mut().chain(self.corners.values_mut()) {
            *sharpness = f64::from(*sharpness as f32);
        }
        self
    }

    /// The largest sharpness that ends.
    pub fn largest_finite_sharpness(&self) -> f64 {
        let all = self.creases.values().chain(self.corners.values());
        all.copied()
            .filter(|&sharpness| sharpness < INFINITE)
            .fold(0.0, f64::max)
    }

    /// Refuses creases and vertices that act in more smoothing steps than a level has; `default` is what
    /// those have that do not say so.
    pub(crate) fn check_steps(&self, default: Option<usize>, full: u32) -> Result<(), Error> {
        let given = self.edge_steps.values().chain(self.vertex_steps.values()).copied();
        let default = default.map(|steps| u32::try_from(steps).unwrap_or(u32::MAX));
        match given.chain(default).find(|&steps| steps > full) {
            Some(steps) => Err(Error::Range {
                what: "cs",
                given: steps.to_string(),
                accepted: format!("0 to {full}, the smoothing steps of a level"),
            }),
            None => Ok(()),
        }
    }

    /// The largest number of a point that is marked.
    pub fn largest_index(&self) -> Option<u32> {
        let edges = self
            .creases
            .keys()
            .chain(self.edge_steps.keys())
            .chain(self.knots.keys());
        let vertices = self
            .corners
            .keys()
            .chain(self.vertex_steps.keys())
            .chain(&self.extraordinary);
        edges.map(|[_, b]| *b).chain(vertices.copied()).max()
    }
}
