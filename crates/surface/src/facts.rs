//! What a mesh is, in numbers.

use crate::{Features, Mesh, Topology};
use std::collections::BTreeMap;

/// The numbers that describe a mesh without defects.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Vertices that belong to faces.
    pub vertices: usize,
    /// Faces.
    pub faces: usize,
    /// Edges.
    pub edges: usize,
    /// The number of faces of each size.
    pub faces_by_size: BTreeMap<usize, usize>,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// The sum over components of the number of handles.
    pub genus: i64,
    /// Connected pieces.
    pub components: usize,
    /// The number of edges of each boundary loop.
    pub boundary_loops: Vec<usize>,
    /// The number of inner vertices of each valence.
    pub valences: BTreeMap<usize, usize>,
    /// The number of boundary vertices of each valence.
    pub boundary_valences: BTreeMap<usize, usize>,
    /// The numbers of creases and corners, of sharpness that ends and that does not.
    pub features: FeatureCounts,
    /// Catmull-Clark levels until no face touches two irregular centres: inner vertices of other valence than
    /// 4, and middles of faces that are no quads.
    pub isolation: usize,
}

/// How much is marked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeatureCounts {
    /// Edges of sharpness 10 and above.
    pub sharp_edges: usize,
    /// Edges of lower sharpness.
    pub semi_sharp_edges: usize,
    /// Marked vertices.
    pub corners: usize,
    /// Edges with knot intervals.
    pub knots: usize,
    /// Vertices that are marked as extraordinary.
    pub extraordinary: usize,
}

impl FeatureCounts {
    fn of(features: &Features) -> Self {
        let sharp = |&&s: &&f64| s >= crate::features::INFINITE;
        let sharp_edges = features.creases.values().filter(sharp).count();
        FeatureCounts {
            sharp_edges,
            semi_sharp_edges: features.creases.values().filter(|&&s| s > 0.0).count() - sharp_edges,
            corners: features.corners.values().filter(|&&s| s > 0.0).count(),
            knots: features.knots.len(),
            extraordinary: features.extraordinary.len(),
        }
    }
}

impl Facts {
    /// The facts about a mesh with its half-edges.
    pub fn of(mesh: &Mesh, topology: &Topology) -> Self {
        let mut inner = BTreeMap::new();
        let mut boundary = BTreeMap::new();
        let valences = topology.valences();
        for &(valence, on_boundary) in valences.iter().filter(|(valence, _)| *valence > 0) {
            let counts = if on_boundary { &mut boundary } else { &mut inner };
            *counts.entry(valence).or_insert(0) += 1;
        }
        let vertices = valences.iter().filter(|(valence, _)| *valence > 0).count();
        let (faces, edges) = (mesh.face_count(), topology.edge_count());
        let euler = vertices as i64 - edges as i64 + faces as i64;
        let (_, components) = topology.components();
        let boundary_loops = topology.boundary_loops();
        Facts {
            vertices,
            faces,
            edges,
            faces_by_size: mesh.faces_by_size(),
            euler,
            // an orientable surface with b holes has 2 - 2g - b a component
            genus: (2 * components as i64 - boundary_loops.len() as i64 - euler) / 2,
            components,
            boundary_loops,
            valences: inner,
            boundary_valences: boundary,
            features: FeatureCounts::of(&mesh.features),
            isolation: isolation(mesh, topology, |v| {
                let (valence, boundary) = valences[v as usize];
                !boundary && valence != 4
            }),
        }
    }
}

/// The number of Catmull-Clark levels until no face touches two special centres: vertices that `special`
/// names, and middles of faces that are no quads.
pub fn isolation(mesh: &Mesh, topology: &Topology, special: impl Fn(u32) -> bool) -> usize {
    let mut levels = 0;
    for face in mesh.faces() {
        let touched = face.iter().filter(|&&v| special(v)).count();
        if face.len() == 4 {
            levels = levels.max(usize::from(touched > 1));
        } else {
            // after one level the face's middle is special and opposite to each special corner; beside an
            // n-gon's middle, two levels leave one of them at most
            levels = levels.max(if touched > 0 { 2 } else { 1 });
        }
    }
    debug_assert_eq!(topology.face_count(), mesh.face_count());
    levels
}
